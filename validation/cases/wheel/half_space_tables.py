"""Tables of the wheel in three dimensions, behind its figure and on its page."""

import math

import numpy as np

from validation.analysis.evidence import Number, Table, columns, numbers_with, table_of, with_reference
from validation.analysis.features import FEATURES
from validation.analysis.spectra import band_means
from validation.analysis.statistics import POWER_DECIBEL
from validation.cases.wheel.contrast import contrast_table, linear_contrasts, log_contrasts, zeros_of
from validation.cases.wheel.features import SLOPE, linear_force_3d
from validation.cases.wheel.half_space_levels import GEIKE, LINEAR_1D, LINEAR_3D, MODELS, FloatArray, WheelLevels
from validation.cases.wheel.half_space_numbers import CONTACTS, LEVEL, OVER_BEM
from validation.scenes.description import slope_ratio

WHEEL = "wheel"
ONE_DECIBEL, THREE_DECIBELS = FEATURES["level"].tolerance, 3.0


def levels_of(levels: WheelLevels) -> Table:
    """One-third octaves of boundary elements, with their errors, and of each model over them."""
    values = {
        "omega [rad/s]": levels.centres,
        "from [rad/s]": levels.edges[:-1],
        "to [rad/s]": levels.edges[1:],
        "bem3d [dB]": POWER_DECIBEL * levels.bem,
        "± sample [dB]": POWER_DECIBEL * np.array([estimate.half_width for estimate in levels.ratio]),
        "± grid [dB]": POWER_DECIBEL * levels.grid,
        "± solver [dB]": POWER_DECIBEL * levels.solver,
        **{f"{model} over bem3d [dB]": POWER_DECIBEL * levels.over_bem(model) for model in MODELS},
    }
    return Table("levels", columns(**values))


def wheel_of(levels: WheelLevels) -> Table:
    """Its roughness over the approach, the slope of that along the track, of all waves, and what a time step takes."""
    case, scene = levels.result.case, levels.result.case.scene
    values = {
        "h/d": scene.rms / scene.approach,
        "h' a/d": slope_ratio(scene.slope_along, scene),
        "cells to a contact radius": case.cells,
        "applications a time step": float(np.mean([strip["applications"] for strip in levels.converged])),
    }
    return Table(WHEEL, {name: [value] for name, value in values.items()})


def oscillation_of(levels: WheelLevels) -> Table:
    """Spectra in bands of a twelfth of the period of the oscillation."""
    scene = levels.result.case.scene
    period = scene.oscillation_period
    spectra = _spectra(levels)
    line = float(spectra["bem3d"][0][0])
    edges = np.arange(0.7 * scene.jump, min(scene.cutoff, 12 * period), max(period / 12, 2 * line))
    means = {model: band_means(omega, density.mean(axis=0), edges) for model, (omega, density) in spectra.items()}
    return Table("oscillation", columns(**{"omega [rad/s]": (edges[1:] + edges[:-1]) / 2, **means}))


def _spectra(levels: WheelLevels) -> dict[str, tuple[FloatArray, FloatArray]]:
    """omega and A, (strips or groups, frequencies), of boundary elements, the linear contact and springs."""
    springs = levels.result.springs["geike"]
    on_springs = springs[0]["omega"], np.concatenate([batch["hann"] for batch in springs])
    return {**{model: levels.spectra(contact) for model, contact in CONTACTS.items()}, GEIKE: on_springs}


def contrast_of(levels: WheelLevels) -> list[Table]:
    """Of boundary elements, of the linear contact on the same strips, of springs, and of sin²(q a)."""
    scene, spectra = levels.result.case.scene, _spectra(levels)
    if not zeros_of(scene).size:
        return []
    curves = {model: log_contrasts(omega, density, scene) for model, (omega, density) in spectra.items()}
    return [contrast_table(scene, {**curves, LINEAR_1D: linear_contrasts(spectra["bem3d"][0], scene)})]


def shown_regions(levels: WheelLevels, numbers: list[Number]) -> Table:
    """The chapter's regions in three dimensions."""
    scene = levels.result.case.scene
    plateau = numbers_with(numbers, LEVEL, OVER_BEM[LINEAR_3D], range="region 2")
    slope = numbers_with(numbers, FEATURES[SLOPE].quantity, "bem3d")
    resonance = f"excited by the roughness: its force there over that at q_min v₀ is {_at_resonance(levels):+.1f} dB"
    beyond = f"beyond 1.3 q_max v₀ {_beyond(levels):.0f} dB below the last tenth of the roughness, with Hann's window"
    on_springs = [
        "excited by the start alone: no wave of the track has the resonance",
        "leakage and nonlinearity",
        "-2 H - 3, and zeros of sin²(q a)",
        "leakage; the roughness ends at q_max",
    ]
    by_boundary_elements = [
        resonance,
        f"real; linear theory over it {with_reference(plateau[0])}" if plateau else "no band holds it",
        f"{f'slope {with_reference(slope[0])}' if slope else 'too few periods for a slope'}; zeros filled",
        beyond,
    ]
    eigenfrequency, jump, cutoff = (f"{omega:.4g}" for omega in (scene.eigenfrequency, scene.jump, scene.cutoff))
    return Table(
        "the regions in three dimensions",
        {
            "region": ["1", "2", "3", "4"],
            "on springs of Geike's spectrum": on_springs,
            "by boundary elements": by_boundary_elements,
            "ω [rad/s]": [eigenfrequency, f"up to {jump}", f"up to {cutoff}", f"from {cutoff}"],
        },
    )


def _at_resonance(levels: WheelLevels) -> float:
    """C_F of linear theory in 3D at the resonance over that where the band begins [dB]."""
    scene = levels.result.case.scene
    edge = 1.001 * scene.jump / scene.speed
    at_resonance, behind = linear_force_3d(scene, np.array([scene.eigenfrequency / scene.speed, edge]))
    return POWER_DECIBEL * math.log(at_resonance / behind)


def _beyond(levels: WheelLevels) -> float:
    """How far boundary elements fall beyond the roughness [dB]."""
    cutoff = levels.result.case.scene.cutoff
    inside, outside = (
        levels.of_strips(levels.converged, "bem", np.array(band) * cutoff)[:, 0].mean() / (band[1] - band[0])
        for band in ((0.9, 1.0), (1.3, 1.8))
    )
    return -POWER_DECIBEL * math.log(outside / inside)


def shown_within(levels: WheelLevels) -> Table:
    """Bands of each range in which each model is within 1 and within 3 dB of boundary elements."""
    rows: list[dict[str, object]] = []
    for model in MODELS:
        off = np.abs(POWER_DECIBEL * levels.over_bem(model))
        near = {
            name: f"{(off[bands] <= ONE_DECIBEL).sum()} and {(off[bands] <= THREE_DECIBELS).sum()} of {bands.sum()}"
            for name, bands in levels.ranges.items()
        }
        rows.append({"model": model, **near})
    return table_of("one-third octaves within 1 and within 3 dB of boundary elements", rows)
