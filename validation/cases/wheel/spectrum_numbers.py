"""Numbers of Fig. 14.4: each feature of the spectrum beside theory, and what must hold to rounding."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from validation.analysis import features as shared
from validation.analysis.evidence import Number, Role
from validation.analysis.over_range import worst
from validation.analysis.spectra import band_levels, one_third_octaves
from validation.analysis.statistics import log_ratio_of_means
from validation.cases.wheel import features
from validation.cases.wheel.contrast import contrast_numbers, linear_contrasts, log_contrasts, zeros_of
from validation.cases.wheel.features import (
    BREAK,
    FLOOR,
    JUMP,
    PEAK,
    PERIOD,
    PREDICTED,
    SLOPE,
    Spectrum,
    level_number,
)
from validation.engine.engine import Outcome

OMEGA = "ω [rad/s]"
IDENTITIES = (FLOOR + PREDICTED,)
"""Features that records have by construction if the roughness ends at q_max: evidence of no claim."""


@dataclass(frozen=True)
class Feature:
    """A feature of the spectrum: what the chapter says of it, and what theory has for it."""

    judged: shared.JudgedFeature
    region: str
    chapter: str
    source: str

    @property
    def quantity(self) -> str:
        return self.judged.quantity

    @property
    def name(self) -> str:
        return self.quantity if self.judged.unit == "-" else f"{self.quantity} [{self.judged.unit}]"


JUMP_OF_RECORDS = "<J²> / (ω² T), J the jump of a(t) from the end of each record to its beginning"
OSCILLATION = "an oscillating substructure of constant period"
FEATURES = {
    name: Feature(shared.FEATURES[name.removesuffix(PREDICTED)], *texts)
    for name, *texts in (
        (PEAK, "1", "a sharp maximum at the eigenfrequency", "sqrt(2 a E* / M)"),
        (JUMP, "2 to 3", "a plateau, and a sharp rise at its end", "q_min v₀, (14.20)"),
        (SLOPE, "3", "a power law", "-2 H - 3, (14.13)"),
        (PERIOD, "3", OSCILLATION, "π v₀ / a, (14.12)"),
        (FLOOR + PREDICTED, "4", "another slope, an artefact of the finite distance?", JUMP_OF_RECORDS),
        (BREAK + PREDICTED, "3 to 4", "a break", "where (14.14) through the resonator meets that floor"),
    )
}


OF_FIGURE = 5
"""Numbers of the claim of Fig. 14.4, whose intervals hold at once: four features, and the level of region 3."""


def feature_numbers(name: str, spectrum: Spectrum, among: int = 1) -> dict[str, Number]:
    """The features that the spectrum of a scene has, beside theory; among: scenes whose intervals hold at once."""
    values, theory = features.measured(spectrum), features.expected(spectrum)
    return {
        key: feature.judged.number(
            values[key].value,
            theory.get(key, 1.0),
            feature.source,
            model="springs",
            where={"scene": name},
            grid=float(spectrum.omega[0]) / 2 if key == JUMP else 0.0,
            sample=values[key].half_width_among(among),
            role=Role.IDENTITY if key in IDENTITIES else Role.FINDING,
        )
        for key, feature in FEATURES.items()
        if key in values
    }


def worst_scene(numbers: Sequence[Number]) -> Number:
    """The scene, of those where one parameter was changed, whose verdict is that of all."""
    found = worst([replace(number, where={"scene": float(i)}) for i, number in enumerate(numbers)], "scene")
    name = numbers[int(float(str(found.where["worst at"])))].where["scene"]
    return replace(found, where={"scenes": f"worst of {len(numbers)} with one parameter changed: {name}"})


def levels_over_linear(spectrum: Spectrum) -> list[Number]:
    """One-third octaves of region 3 over (14.12) through the resonator, up to where the floor is far below."""
    scene, omega = spectrum.scene, spectrum.omega
    first = max(1.2 * scene.jump, features.FREE_MASS * scene.eigenfrequency)
    last = min(0.7 * features.expected(spectrum)[BREAK], 0.9 * scene.cutoff)
    edges = one_third_octaves(first, last) if first < last else np.empty(0)
    if edges.size < 2:
        return []
    groups = band_levels(omega, spectrum.hann.T, edges).T
    linear = band_levels(omega, spectrum.linear, edges)
    return [
        level_number(
            log_ratio_of_means(groups, linear, weights=one_band),
            model="springs over linear theory",
            where={"region": "region 3", OMEGA: float(centre)},
            source="(14.12) through the resonator: a contact of fixed radius",
            among=OF_FIGURE * linear.size,
        )
        for centre, one_band in zip(np.sqrt(edges[1:] * edges[:-1]), np.eye(linear.size), strict=True)
    ]


def contrasts_beside_linear(spectrum: Spectrum) -> list[Number]:
    """Of the oscillation of region 3, with Hann's window; none where region 3 has no whole period."""
    scene, omega = spectrum.scene, spectrum.omega
    if not zeros_of(scene).size:
        return []
    found = log_contrasts(omega, spectrum.hann, scene)
    return contrast_numbers("springs", found, linear_contrasts(omega, scene), scene)


def identities(batches: list[Outcome]) -> list[Number]:
    """Parseval's theorem and Newton's law."""
    wheels = sum(batch["jump"].size for batch in batches)
    return [
        Number(
            quantity="integral of A over f, over the mean square acceleration, less one",
            where={"batches": f"worst of {len(batches)} batches"},
            value=max(abs(_parseval(batch)) for batch in batches),
            reference=0.0,
            source="Parseval",
            tolerance=1e-11,
            reason="rounding of the Fourier transforms",
            role=Role.IDENTITY,
        ),
        Number(
            quantity="mean of F - F_N less M times the velocity change over T, over the rms of F - F_N",
            where={"wheels": f"worst of {wheels} wheels"},
            value=max(float(np.abs(batch["balance"]).max()) for batch in batches),
            reference=0.0,
            source="Newton: mean force and load balance",
            tolerance=1e-11,
            reason="rounding of a sum over all steps",
            role=Role.IDENTITY,
        ),
    ]


def _parseval(batch: Outcome) -> float:
    square = float(np.mean(batch["square"]))
    density = batch["plain"].mean(axis=0)
    steps = round(float(batch["duration"] / batch["time step"]))
    weights = np.full(density.size, 2.0)
    weights[-1] = 2.0 if steps % 2 else 1.0
    return (float(weights @ density) / float(batch["duration"]) + float(np.mean(batch["mean"] ** 2))) / square - 1
