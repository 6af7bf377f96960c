"""What each model of a scene takes, and how far it is from the reference: speed against accuracy."""

import math

import numpy as np

from validation.analysis.evidence import Table, table_of
from validation.scenes.rail import RailScene
from validation.selection.compare import Comparison
from validation.selection.hierarchy import Candidate
from validation.selection.side_by_side import counts, differences, error_of_difference, per_cent, reference_of


def speed_and_accuracy(comparison: Comparison) -> Table:
    """A row a model that was solved: seconds by the clock, and its distance from the reference.

    Columns model, is_mdr, selected, is_reference, seconds, error, low, high, unit; low and high end the interval of
    both errors together, NaN where one is unknown. As the tolerance counts it: the largest of the bands that count, of
    spectra the root mean square over bands. The reference has no distance: its high is the error that it has.
    """
    reference = reference_of(comparison)
    rows: list[dict[str, object]] = []
    for one in comparison.selection.solved:
        here = one is reference
        off, half = (0.0, reference_error(comparison, reference)) if here else apart(comparison, one, reference)
        low, error, high = (max(off - half, 0.0), off, off + half) if math.isfinite(half) else (math.nan, off, math.nan)
        rows.append(
            {
                **{"model": one.name, "is_mdr": one.model.is_mdr, "selected": one.name == comparison.model},
                **{"is_reference": here, "seconds": comparison.seconds_of(one), "error": math.nan if here else error},
                **{"low": math.nan if here else low, "high": high, "unit": unit_of(comparison)},
            }
        )
    return table_of(comparison.quantity, rows)


def unit_of(comparison: Comparison) -> str:
    """Decibels of levels, and of numbers where the tolerance is in decibels."""
    return "dB" if comparison.is_level or comparison.in_decibels else "%"


def apart(comparison: Comparison, one: Candidate, reference: Candidate) -> tuple[float, float]:
    """Distance from the reference, and its half-width of 95 %, in the unit of `unit_of`."""
    off = np.abs(differences(one, reference))
    half = np.broadcast_to(error_of_difference(comparison, one, reference), off.shape)
    within = counts(comparison, reference) & np.isfinite(off)
    if not within.any():
        return math.nan, math.nan
    if isinstance(comparison.scene, RailScene):
        at = int(np.argmax(np.where(within, off, -1.0)))
        found = float(off[at]), float(half[at])
    else:
        found = tuple(float(np.sqrt(np.mean(of[within] ** 2))) for of in (off, half))  # type: ignore[assignment]
    return found if unit_of(comparison) == "dB" else (per_cent(found[0]), per_cent(found[1]))


def reference_error(comparison: Comparison, reference: Candidate) -> float:
    """Half-width of 95 % that it has itself."""
    return 20 * math.log10(1 + reference.error) if unit_of(comparison) == "dB" else 100 * reference.error
