"""A contact filter of others beside boundary elements: A3 of five wheels on a rail, over what lies across."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cache, partial
from itertools import groupby

import numpy as np

from validation.analysis.quantity import Quantity
from validation.analysis.statistics import FloatArray
from validation.judging.kinds.judge import Finding, answer_of, attempted, compared, rule
from validation.judging.kinds.references import Reference, about, reference_rows
from validation.judging.registry import Caller
from validation.railway.problems.rail_strip import line_of, strip_bands, structure_of
from validation.railway.scenes.level_files import curve as levels_of
from validation.railway.scenes.rail import RailScene
from validation.railway.theory.contact_filters import half_space_filter

Transfer = Callable[[FloatArray, FloatArray], FloatArray]
"""abs(H)(k_x, k_y)."""
FILTER, LONG = Quantity("contact_filter"), "contact filter of a long wave"
LOAD, DIAMETER, OFFSET, ALPHA, WAVE = "load [kN]", "diameter [mm]", "over ISO 3095 [dB]", "alpha", "wavelength [mm]"
STEEL = 210e9 / (2 * (1 - 0.3**2))
"""E* of steel on steel [Pa]."""
COUNTED = -15.0
"""dB of A3 of linear theory: shorter waves, from the first band below on, are no gate."""
NOTHING = 1e-30
"""A share that has a logarithm."""
LONG_WAVE = 1e-4
"""Its wavenumber times the semi-axis along."""


def judged(model: Caller) -> Iterator[Finding]:
    """In one-third octaves from ridges to isotropic ground; boundary elements rolled over rougher rails too."""
    rows = reference_rows(FILTER)
    scene = scene_of(rows[0][LOAD], rows[0][DIAMETER])
    k_x = np.array([LONG_WAVE / scene.contact.along])
    long = attempted(lambda: float(np.abs(_transfer(model, scene, 1.0)(k_x, 0 * k_x)[0])))
    yield rule(LONG, {"k_x a_x": LONG_WAVE}, long, LONG_WAVE)
    for (load, diameter, offset, alpha), ground in groupby(rows, _ground):
        if math.isfinite(alpha) or answers_isotropic(model):
            yield from _over_ground(model, scene_of(load, diameter), offset, alpha, ground)


def answers_isotropic(model: Caller) -> bool:
    """A filter of the line that goes by alpha has no value for isotropic ground."""
    return "k_y" in model.asks or ALPHA not in model.asks


def _ground(row: Reference) -> tuple[float, ...]:
    return tuple(row[name] for name in (LOAD, DIAMETER, OFFSET, ALPHA))


def _over_ground(
    model: Caller, scene: RailScene, offset: float, alpha: float, rows: Iterator[Reference]
) -> Iterator[Finding]:
    """One ground, in the bands that count."""
    wheel = f"{scene.name}, {offset:+g} dB" if offset else scene.name
    waves = np.round(1000 * strip_bands(scene).nominal, 2).tolist()
    lowest = np.minimum.accumulate(_linear_levels(scene, alpha))
    counted = [row for row in rows if lowest[waves.index(row[WAVE])] > COUNTED]
    bands = [waves.index(row[WAVE]) for row in counted]
    ground = {"wheel": wheel, ALPHA: "isotropic" if math.isinf(alpha) else alpha}
    levels = attempted(in_bands, model, scene, alpha, bands)
    yield from compared([replace(row, where={**ground, WAVE: row[WAVE]}) for row in counted], levels)


def in_bands(model: Caller, scene: RailScene, alpha: float, bands: Sequence[int]) -> FloatArray:
    """A3 of a model in these bands of a strip [dB]."""
    across = alpha if "k_y" in model.asks else 0.0
    return _in_one_call(partial(a3, scene, across), _transfer(model, scene, alpha))[bands]


def a3(scene: RailScene, alpha: float, transfer: Transfer) -> FloatArray:
    """10 lg of int abs(H)^2 C_line dq over int C_line dq in the bands of a strip, over ground of that alpha [dB]."""
    structure = structure_of("isotropic" if math.isinf(alpha) else alpha or "ridges", line := line_of(scene))
    edges, axes = strip_bands(scene).edges, scene.contact.semi_axes
    share = structure.band_power(line, transfer, edges=edges, semi_axes=axes)
    return np.asarray(10 * np.log10(np.maximum(share, NOTHING)))


def _transfer(model: Caller, scene: RailScene, alpha: float) -> Transfer:
    """What a model has for the amplitude; one that does not ask for k_y is a filter of the line, as over ridges."""
    contact = scene.contact
    arguments = {"a_x": contact.along, "a_y": contact.across, "approach": contact.approach, "alpha": alpha}

    return lambda k_x, k_y: answer_of(model, k_x=k_x, k_y=k_y, **arguments)


def _in_one_call(integral: Callable[[Transfer], FloatArray], transfer: Transfer) -> FloatArray:
    """Of a function that is asked for all waves at once: they are noted first."""
    waves: list[tuple[FloatArray, ...]] = []

    def noted(k_x: FloatArray, k_y: FloatArray) -> FloatArray:
        waves.append(tuple(np.broadcast_arrays(k_x, k_y)))
        return np.ones(waves[-1][0].shape)

    integral(noted)
    k_x, k_y = (np.concatenate([wave.ravel() for wave in component]) for component in zip(*waves, strict=True))
    values = iter(np.split(transfer(k_x, k_y), np.cumsum([wave.size for wave, _ in waves])[:-1]))
    return integral(lambda k_x, k_y: next(values).reshape(np.broadcast_shapes(k_x.shape, k_y.shape)))


@cache
def _linear_levels(scene: RailScene, alpha: float) -> FloatArray:
    return a3(scene, alpha, partial(half_space_filter, semi_axes=scene.contact.semi_axes))


@cache
def scene_of(load: float, diameter: float, crown: float = 0.0) -> RailScene:
    """A conical wheel on a rail of the roughness of ISO 3095. crown: of its crown, by default of the table [m]."""
    return RailScene(
        name=f"{load:g} kN, {diameter:g} mm{f', crown {1000 * crown:g} mm' if crown else ''}",
        radius=diameter / 2000,
        load=1000 * load,
        modulus=STEEL,
        roughness=levels_of("iso3095-2013"),
        crown_radius=crown or about(FILTER)["settings"]["crown"],
    )
