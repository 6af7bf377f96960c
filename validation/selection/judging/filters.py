"""A contact filter of others beside boundary elements: A3 of five wheels on a rail, over what lies across."""

import math
from collections.abc import Iterator, Mapping
from functools import cache, partial

import numpy as np

from validation.analysis.judgement import JudgedPoint, compared, compared_levels
from validation.analysis.statistics import FloatArray
from validation.engine.offered import Caller, Failed
from validation.scenes.level_files import curve as levels_of
from validation.scenes.rail import RailScene
from validation.selection.judging.references import Place, about, curve
from validation.selection.judging.spectra import unanswered
from validation.simulation.rail_strip import StatedAcross, line_of, strip_bands, structure_of
from validation.theory.contact_filters import half_space_filter

FILTER, LONG = "contact filter", "contact filter of a long wave"
LOAD, DIAMETER, OFFSET, ALPHA, WAVE = "load [kN]", "diameter [mm]", "over ISO 3095 [dB]", "alpha", "wavelength [mm]"
STEEL = 210e9 / (2 * (1 - 0.3**2))
"""E* of steel on steel [Pa]."""
COUNTED = -15.0
"""dB of A3 of linear theory: shorter waves, from the first band below on, are no gate."""
NOTHING = 1e-30
"""A share that has a logarithm."""
LONG_WAVE = 1e-4
"""Its wavenumber times the semi-axis along."""


def judged(model: Caller, tolerance: float) -> Iterator[JudgedPoint]:
    """In one-third octaves from ridges to isotropic ground; boundary elements rolled over rougher rails too."""
    known = curve(FILTER)
    yield _long_wave(model, scene_of(known[0].where), tolerance)
    # the filter is the same at all levels of the roughness
    found: dict[tuple[Place, ...], FloatArray | Failed] = {}
    for one in known:
        where, scene, alpha = one.where, scene_of(one.where), float(one.where[ALPHA])
        key = where[LOAD], where[DIAMETER], alpha
        band = _waves(scene).index(float(where[WAVE]))
        if _linear(scene, alpha)[: band + 1].min() <= COUNTED or not _serves(model, alpha):
            continue
        if key not in found:
            found[key] = a3(model, scene, alpha)
        rougher = f", {where[OFFSET]:+g} dB" if where[OFFSET] else ""
        stated: dict[str, Place] = {
            "wheel": f"{scene.name}{rougher}",
            ALPHA: "isotropic" if math.isinf(alpha) else alpha,
            WAVE: where[WAVE],
        }
        if isinstance(mine := found[key], Failed):
            yield unanswered(FILTER, stated, mine, one.value, "dB")
        else:
            yield compared_levels(FILTER, stated, float(mine[band]), one.value, one.error, tolerance)


def _serves(model: Caller, alpha: float) -> bool:
    """A filter of the line that goes by alpha has none for isotropic ground."""
    return math.isfinite(alpha) or "k_y" in model.asks or ALPHA not in model.asks


def _waves(scene: RailScene) -> list[float]:
    """Nominal, of a strip [mm]."""
    return [float(one) for one in np.round(1000 * strip_bands(scene).nominal, 2)]


def a3(model: Caller, scene: RailScene, alpha: float) -> FloatArray | Failed:
    """10 lg of int abs(H)^2 C_line dq over int C_line dq in the bands of a strip [dB].

    A filter that does not ask for k_y is one of the line itself, whatever lies across.
    """
    line, contact, bands = line_of(scene), scene.contact, strip_bands(scene)
    structure = structure_of(_across(alpha) if "k_y" in model.asks else "ridges", line)
    power = partial(structure.band_power, line, edges=bands.edges, semi_axes=contact.semi_axes)
    asked: list[tuple[FloatArray, FloatArray]] = []

    def noted(k_x: FloatArray, k_y: FloatArray) -> FloatArray:
        asked.append(
            (np.broadcast_to(k_x, shape := np.broadcast_shapes(k_x.shape, k_y.shape)), np.broadcast_to(k_y, shape))
        )
        return np.ones(shape)

    power(noted)
    k_x, k_y = (np.concatenate([one.ravel() for one in some]) for some in zip(*asked, strict=True))
    found = model.call(k_x=k_x, k_y=k_y, **_contact(scene), alpha=alpha)
    if isinstance(found, Failed):
        return found
    answers = iter(np.split(found, np.cumsum([one.size for one, _ in asked])[:-1]))
    share = power(lambda k_x, k_y: next(answers).reshape(np.broadcast_shapes(k_x.shape, k_y.shape)))
    return np.asarray(10 * np.log10(np.maximum(share, NOTHING)))


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


def scene_of(where: Mapping[str, Place]) -> RailScene:
    return _scene(float(where[LOAD]), float(where[DIAMETER]))


@cache
def _scene(load: float, diameter: float) -> RailScene:
    """A conical wheel on a crowned rail of the roughness of ISO 3095."""
    return RailScene(
        name=f"{load:g} kN, {diameter:g} mm",
        radius=diameter / 2000,
        load=1000 * load,
        modulus=STEEL,
        roughness=levels_of("iso3095-2013"),
        crown_radius=about(FILTER)["settings"]["crown"],
    )


def _long_wave(model: Caller, scene: RailScene, tolerance: float) -> JudgedPoint:
    k_x = np.array([LONG_WAVE / scene.contact.along])
    found = model.call(k_x=k_x, k_y=0 * k_x, **_contact(scene), alpha=1.0)
    where: dict[str, Place] = {"k_x a_x": LONG_WAVE}
    if isinstance(found, Failed):
        return unanswered(LONG, where, found, 1.0)
    return compared(LONG, where, float(np.abs(found[0])), 1.0, LONG_WAVE, tolerance)
