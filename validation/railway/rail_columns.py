"""What a comparison of a rail has beside its quantity: sound power by each filter, and a table of its filter.

The A-weighted contact force is for files alone, and for one release.
"""

import math
from dataclasses import replace

import numpy as np

from validation.advice.compare import Comparison
from validation.advice.hierarchy import Candidate
from validation.advice.sound_power import ContactForce, SoundPower
from validation.advice.tolerance import decibels, relative
from validation.analysis.evidence import Table
from validation.analysis.spectra import LONGEST, NominalBands, a_weighting
from validation.engine.engine import FloatArray
from validation.railway.problems.rail_models import RailModel, rail_quantity
from validation.railway.problems.rail_power import RailPower
from validation.railway.scenes.level_files import MICROMETRE
from validation.railway.scenes.rail import CONTACT_FILTER, SOUND_POWER, RailScene
from validation.railway.theory.sound_power import frequencies, weighting
from validation.simulation.model import Target


def sound_power(scene: RailScene, comparison: Comparison) -> SoundPower | None:
    """Of all filters that were solved or are closed forms; None without a speed or an answer."""
    chosen, name = comparison.selection.best, str(SOUND_POWER)
    if scene.no_answer(name) or chosen is None or not np.isfinite(comparison.a3_of(chosen)).any():
        return None
    levels = dict[str, FloatArray]()
    for candidate in (chosen, *comparison.models):
        if candidate in comparison.selection.solved and comparison.quantity == name:
            levels[candidate.name] = comparison.value_of(candidate) + weighting()
        elif (a3 := _a3(comparison, candidate)) is not None:
            levels[candidate.name] = RailPower(scene, a3).weighted
    missing = frequencies()[np.isnan(scene.added_to_filter(name)[0])]
    return SoundPower(
        levels=levels,
        error=_error_of_sum(scene, comparison, chosen),
        speed=scene.speed or math.nan,
        of=scene.sound_transfer.in_words,
        missing=", ".join(f"{f:g}" for f in missing) + " Hz" if missing.size else "",
    )


def _error_of_sum(scene: RailScene, comparison: Comparison, chosen: Candidate) -> float:
    """Half-width of the sum by a model that was solved [dB]."""
    if comparison.quantity == str(SOUND_POWER):
        return decibels(chosen.error)
    power, parts = RailPower(scene, comparison.a3_of(chosen)), comparison.error_parts_of(chosen)
    model, grid, sample = (relative(power.error_of_total(parts[name])) for name in ("model", "grid", "sample"))
    return decibels(model + math.hypot(grid, sample))


def contact_force(scene: RailScene, comparison: Comparison) -> ContactForce | None:
    """Of all filters that were solved or are closed forms; None without a speed or an answer, and of sound power."""
    chosen = comparison.selection.best
    if scene.speed is None or chosen is None or comparison.quantity == str(SOUND_POWER):
        return None
    bands, stiffness = scene.levels.bands, scene.contact.stiffness
    of_force = comparison.roughness + 20 * math.log10(stiffness * MICROMETRE)
    of_force = of_force + a_weighting(scene.speed / bands.wavelengths)
    filters = {candidate.name: _a3(comparison, candidate) for candidate in (chosen, *comparison.models)}
    if not np.isfinite(comparison.a3_of(chosen)).any():
        return None
    return ContactForce({name: of_force + a3 for name, a3 in filters.items() if a3 is not None})


def _a3(comparison: Comparison, candidate: Candidate) -> FloatArray | None:
    """Of a model that was solved, or has a closed form on this ground."""
    if candidate in comparison.selection.solved:
        return comparison.a3_of(candidate)
    if not isinstance(candidate.model.model, RailModel):
        return None
    closed_form = candidate.model.model.filter
    if closed_form.on_strips or not candidate.estimate.in_range:
        return None
    return np.asarray(closed_form.closed(rail_quantity(candidate.model.target)).mean(axis=0))


def filter_table(comparison: Comparison) -> Table:
    """A contact filter in the columns of CNOSSOS-EU: wheel load and diameter, A3 to a tenth of a decibel.

    A row a nominal wavelength from 2000 to 0.8 mm. Waves longer than those of the scene have the closed filter of the
    model, of a one-sided one that of its linear twin; shorter ones are NaN. Raises ValueError for any other quantity,
    and where no model has an answer.
    """
    scene, best = comparison.scene, comparison.selection.best
    if not isinstance(scene, RailScene) or comparison.scene_quantity is not CONTACT_FILTER:
        raise ValueError(f"--cnossos is for the quantity contact-filter of a rail, got {comparison.quantity}")
    if best is None:
        raise ValueError("--cnossos needs a contact filter, got none: no model has a result")
    bands, own = NominalBands(), scene.levels.bands
    a3 = np.full(len(bands), np.nan)
    first = bands.longest - own.longest
    if first and isinstance(best.model.model, RailModel):
        a3[:first] = of_longer_waves(best.model.model, best.model.target)[:first]
    a3[first : first + len(own)] = comparison.value
    return Table(
        "contact-filter",
        {
            "wheel_load_kN": [scene.load / 1e3] * len(bands),
            "wheel_diameter_mm": [2e3 * scene.radius] * len(bands),
            "wavelength_mm": (1e3 * bands.nominal).tolist(),
            "a3_dB": (a3.round(1) + 0.0).tolist(),  # no minus in front of a zero
        },
    )


def of_longer_waves(model: RailModel, target: Target) -> FloatArray:
    """A3 of the linear filter in all bands from 2000 mm to the last of the roughness [dB]."""
    quantity = replace(rail_quantity(target), longest=LONGEST)
    return np.asarray(model.filter.closed(quantity).mean(axis=0))
