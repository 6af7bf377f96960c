"""A contact filter of others beside boundary elements: A3 of five wheels on a rail, over what lies across."""

import math
from collections.abc import Iterator, Sequence
from functools import cache, partial
from itertools import groupby

import numpy as np

from validation.analysis.statistics import FloatArray
from validation.engine.offered import Caller, Failed
from validation.scenes.level_files import curve as level_curve
from validation.scenes.rail import RailScene
from validation.selection.judging.judgement import Verdict, compared, lost
from validation.selection.judging.references import Curve, Place, about, curves
from validation.simulation.rail_strip import StatedAcross, line_of, strip_bands, structure_of
from validation.theory.contact_filters import half_space_filter

QUANTITY, LONG = "contact filter", "contact filter of a long wave"
LOAD, DIAMETER, OFFSET, ALPHA = "load [kN]", "diameter [mm]", "over ISO 3095 [dB]", "alpha"
STEEL = 210e9 / (2 * (1 - 0.3**2))
"""E* of steel on steel [Pa]."""
COUNTED = -15.0
"""dB of A3 of linear theory: shorter waves, from the first band below on, are no gate."""
LONG_WAVE = 1e-4
"""Its wavenumber times the semi-axis along."""


def judged(model: Caller, tolerance: float) -> Iterator[Verdict]:
    """In one-third octaves from ridges to isotropic ground; boundary elements rolled over rougher rails too."""
    wheels = groupby(curves(QUANTITY), key=lambda one: (one.where[LOAD], one.where[DIAMETER]))
    for place, (_, same) in enumerate(wheels):
        known = list(same)
        if not place:
            yield _long_wave(model, scene_of(known[0]), tolerance)
        for across in dict.fromkeys(one.where[ALPHA] for one in known):
            here = [one for one in known if one.where[ALPHA] == across]
            yield from _on_ground(model, here, float(across), tolerance)


def _on_ground(model: Caller, known: Sequence[Curve], alpha: float, tolerance: float) -> Iterator[Verdict]:
    """The filter is the same at all levels of the roughness."""
    scene = scene_of(known[0])
    found = a3(model, scene, alpha)
    linear = _linear(scene, alpha)
    for curve in known:
        for i, (where, value, error) in enumerate(curve.points()):
            if linear[: i + 1].min() <= COUNTED:
                break
            stated: dict[str, Place] = {**where, ALPHA: "isotropic" if math.isinf(alpha) else alpha}
            if isinstance(found, Failed):
                yield lost(QUANTITY, stated, found.reason)
            else:
                yield compared(QUANTITY, stated, float(found[i]), value, error, tolerance, decibels=True)


def a3(model: Caller, scene: RailScene, alpha: float) -> FloatArray | Failed:
    """10 lg of int abs(H)^2 C_line dq over int C_line dq in the bands of a strip [dB].

    A filter that does not ask for k_y is one of the line itself, whatever lies across.
    """
    line, contact, bands = line_of(scene), scene.contact, strip_bands(scene)
    structure = structure_of(_across(alpha) if "k_y" in model.asks else "ridges", line)
    power = partial(structure.band_power, line, edges=bands.edges, semi_axes=contact.semi_axes)
    asked: list[tuple[FloatArray, FloatArray]] = []

    def noted(k_x: FloatArray, k_y: FloatArray) -> FloatArray:
        asked.append((np.broadcast_to(k_x, shape := np.broadcast_shapes(k_x.shape, k_y.shape)), np.broadcast_to(k_y, shape)))
        return np.ones(shape)

    power(noted)
    k_x, k_y = (np.concatenate([one.ravel() for one in some]) for some in zip(*asked, strict=True))
    found = model.call(k_x=k_x, k_y=k_y, **_contact(scene), alpha=alpha)
    if isinstance(found, Failed):
        return found
    answers = iter(np.split(found, np.cumsum([one.size for one, _ in asked])[:-1]))
    with np.errstate(divide="ignore"):
        return 10 * np.log10(power(lambda k_x, k_y: next(answers).reshape(np.broadcast_shapes(k_x.shape, k_y.shape))))


def _contact(scene: RailScene) -> dict[str, float]:
    contact = scene.contact
    return {"a_x": contact.along, "a_y": contact.across, "approach": contact.approach}


def _across(alpha: float) -> StatedAcross:
    return "isotropic" if math.isinf(alpha) else alpha or "ridges"


@cache
def _linear(scene: RailScene, alpha: float) -> FloatArray:
    line, axes = line_of(scene), scene.contact.semi_axes
    transfer = partial(half_space_filter, semi_axes=axes)
    found = structure_of(_across(alpha), line).band_power(
        line, transfer, edges=strip_bands(scene).edges, semi_axes=axes
    )
    return np.asarray(10 * np.log10(found))


def scene_of(known: Curve) -> RailScene:
    """A conical wheel on a crowned rail of the roughness of ISO 3095."""
    return _scene(float(known.where[LOAD]), float(known.where[DIAMETER]))


@cache
def _scene(load: float, diameter: float) -> RailScene:
    return RailScene(
        name=f"{load:g} kN, {diameter:g} mm",
        radius=diameter / 2000,
        load=1000 * load,
        modulus=STEEL,
        roughness=level_curve("iso3095-2013"),
        crown_radius=about(QUANTITY)["settings"]["crown"],
    )


def _long_wave(model: Caller, scene: RailScene, tolerance: float) -> Verdict:
    k_x = np.array([LONG_WAVE / scene.contact.along])
    found = model.call(k_x=k_x, k_y=0 * k_x, **_contact(scene), alpha=1.0)
    where: dict[str, Place] = {"k_x a_x": LONG_WAVE}
    if isinstance(found, Failed):
        return lost(LONG, where, found.reason)
    return compared(LONG, where, float(np.abs(found[0])), 1.0, LONG_WAVE, tolerance)
