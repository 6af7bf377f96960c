"""The suite's own models, offered as anyone offers theirs: their errors are kept, and they are timed beside another."""

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

import mdr
from validation.analysis.statistics import FloatArray
from validation.judging import registry as offered
from validation.judging.judgement import JudgedNumber
from validation.judging.kinds import interfaces
from validation.judging.kinds.judge import points_of
from validation.judging.kinds.references import Reference, reference_rows
from validation.judging.kinds.rolling import FILTER, LEVEL
from validation.judging.kinds.stiffness import MEAN, PlateauRoughness
from validation.judging.registry import Failed, Offered
from validation.judging.worker import Called
from validation.railway.theory.contact_filters import half_space_filter, spring_bed_filter
from validation.simulation.model_names import BED, FILTER_1D, FILTER_3D, LINEAR, LINEAR_ON_LINE, SPRINGS
from validation.theory import rolling
from validation.theory.interface import (
    BushGibsonThomas,
    GreenwoodWilliamson,
    InterfaceModel,
    Persson,
    RoughnessSpectrum,
)

ERRORS = "median error of the suite's own models"
MAIN = {"stiffness_model": MEAN, "contact_filter": FILTER, "interface_model": interfaces.STIFFNESS} | dict.fromkeys(
    ("force_spectrum", "rolling_model", "profile_spectrum"), LEVEL
)
"""The quantity by whose median error models of a kind are ranked."""


@offered.stiffness_model(SPRINGS)
def springs(load: float, side: float, modulus: float, roughness: mdr.SelfAffine, rng: np.random.Generator) -> float:
    profile = mdr.rough_profile(roughness.c1d, length=side, points=2048, rng=rng, rms=roughness.rms)
    return float(mdr.load_curve(profile, length=side, modulus=modulus).at_force(load).stiffness)


@offered.force_spectrum(FILTER_1D)
def in_1d(q: FloatArray, contact_radius: float, modulus: float, roughness: mdr.SelfAffine) -> FloatArray:
    return rolling.force_spectrum_1d(q, roughness.c1d, contact_radius=contact_radius, modulus=modulus)


@offered.force_spectrum(FILTER_3D)
def in_3d(q: FloatArray, contact_radius: float, modulus: float, roughness: mdr.SelfAffine) -> FloatArray:
    edges = roughness.q_min, roughness.q_max
    return rolling.force_spectrum_3d(q, roughness.c2d, edges=edges, contact_radius=contact_radius, modulus=modulus)


@offered.rolling_model(FILTER_3D)
def half_space(
    height: FloatArray, spacing: tuple[float, float], radius: float, modulus: float, approach: float
) -> FloatArray:
    # as rolling.linear_force, on cells of two lengths
    (nx, ny), a = height.shape, math.sqrt(radius * approach)
    q_x, q_y = (2 * np.pi * np.fft.fftfreq(n, side) for n, side in zip((nx, ny), spacing, strict=True))
    transfer = rolling.response(np.hypot(q_x[:, np.newaxis], q_y), contact_radius=a, modulus=modulus)
    above_the_middle = np.exp(1j * q_y * spacing[1] * (ny - 1) / 2) / ny
    change = np.fft.ifft(transfer * np.fft.fft2(height) @ above_the_middle).real
    return np.asarray(4 / 3 * modulus * a * approach + change)


ellipse = offered.contact_filter(LINEAR)(lambda k_x, k_y, a_x, a_y: half_space_filter(k_x, k_y, semi_axes=(a_x, a_y)))
line = offered.contact_filter(LINEAR_ON_LINE)(lambda k_x, a_x: np.sinc(k_x * a_x / math.pi))
bed = offered.contact_filter(BED)(lambda k_x, k_y, a_x, a_y: spring_bed_filter(k_x, k_y, semi_axes=(a_x, a_y)))
geike = offered.profile_spectrum("Geike's rule")(lambda q, roughness: math.pi * q * roughness.c2d(q))
trace = offered.profile_spectrum("line trace")(lambda q, roughness: roughness.line(q))


def _offered(name: str, theory: Callable[..., InterfaceModel]) -> Offered[..., Any]:
    """A model of the core, of C_2D between the ends of the band and of the plateau."""

    def of_roughness(pressure: float, modulus: float, roughness: PlateauRoughness, quantity: str) -> float:
        edges = roughness.q_min, roughness.q_roll_off, roughness.q_max
        model = theory(RoughnessSpectrum.of_c2d(roughness.c2d, edges), modulus)
        return float(getattr(model, quantity)(pressure))

    return offered.interface_model(name)(of_roughness)


persson = _offered("Persson, γ = 0.45", Persson)
spheres, ellipsoids = (_offered(theory.name, theory) for theory in (GreenwoodWilliamson, BushGibsonThomas))
OWN: Sequence[Offered[..., Any]] = (
    *(springs, ellipse, line, bed, in_1d, in_3d, half_space, geike, trace),
    *(persson, spheres, ellipsoids),
)


class ErrorOfCall(NamedTuple):
    """A point of the chart of error against seconds. error: the median, over the reference, of levels in dB."""

    model: str
    error: float
    unit: str
    seconds: float


def error_of(kind: str, points: Sequence[JudgedNumber]) -> float:
    """NaN where there is none."""
    deviations = [abs(p.difference) for p in points if p.quantity == MAIN.get(kind) and math.isfinite(p.difference)]
    return float(np.median(deviations)) if deviations else math.nan


def errors() -> Iterator[Reference]:
    """Of all of them, by their judges; half a minute."""
    for model in OWN:
        error = error_of(model.kind, list(points_of(Called(model), 0.1)))
        yield Reference({"kind": model.kind, "model": model.name}, error)


def costs_of(model: Called, points: Sequence[JudgedNumber]) -> list[ErrorOfCall]:
    """The model, and those of its kind, timed by the same arguments: those that it took longest for."""
    error = error_of(model.kind, points)
    if not math.isfinite(error):
        return []
    unit = next(point.unit for point in points if point.quantity == MAIN[model.kind])
    arguments = {"rng": np.random.default_rng(0), **model.longest}
    kept = {row.where["model"]: row.value for row in reference_rows(ERRORS, where={"kind": model.kind})}
    suite = [(kept[function.name], Called(function)) for function in OWN if function.kind == model.kind]
    ranked = [(error, model), *suite]
    return [ErrorOfCall(function.name, median, unit, _seconds(function, arguments)) for median, function in ranked]


def _seconds(model: Called, arguments: dict[str, object]) -> float:
    """The least of three calls; NaN of one that is not asked any more."""
    model.calls("", [None] * 3, arguments)
    return min((reply.seconds for reply in model.replies if not isinstance(reply.value, Failed)), default=math.nan)
