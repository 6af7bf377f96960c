"""All models that were solved, beside the one with the smallest error: how far off, with both errors, and how fast."""

import math

import numpy as np
from numpy.typing import NDArray

from validation.advice.compare import Comparison
from validation.advice.hierarchy import ALIKE, Candidate, bias
from validation.advice.tolerance import decibels, percentage
from validation.analysis.evidence import Table, table_of

TOGETHER = "both errors together: of the models the sum, of grid and sample the root of the sum of squares"
"""How the half-width of a difference follows from the errors of both models."""


def reference_of(comparison: Comparison) -> Candidate:
    """The least biased of the solved models whose errors are alike the smallest, the dearest of several."""
    solved, least = comparison.selection.solved[::-1], comparison.selection.least_error
    alike = [candidate for candidate in solved if candidate.error <= ALIKE * least]
    return min(alike, key=lambda candidate: bias(candidate.solved_answer))


def differences(candidate: Candidate, reference: Candidate) -> np.ndarray:
    """Of the levels of two models, 20 lg of the ratio of their amplitudes [dB]."""
    assert candidate.answer is not None and reference.answer is not None  # as solved
    return np.asarray(20 * np.log10(candidate.answer.value / reference.answer.value))


def error_of_difference(comparison: Comparison, candidate: Candidate) -> np.ndarray:
    """Half-widths of 95 % of `differences` from the reference [dB]: `TOGETHER`; infinite where one is unknown."""
    parts = [
        {
            name: part / (1.0 if comparison.is_level else np.abs(comparison.value_of(model)))
            for name, part in errors.items()
        }
        for model in (candidate, reference_of(comparison))
        for errors in [comparison.error_parts_of(model)]
    ]
    random = [errors[name] for errors in parts for name in ("grid", "sample")]
    half_width = sum(errors["model"] for errors in parts) + np.sqrt(np.sum(np.square(random), axis=0))
    return np.asarray(half_width if comparison.is_level else 20 * np.log10(1 + half_width))


def counted_bands(comparison: Comparison, candidate: Candidate) -> NDArray[np.bool_]:
    """Mask of the bands in which the tolerance counts: of a rail, those of which more than next to nothing is left."""
    level = comparison.a3_of(candidate) if comparison.roughness.size else np.zeros(comparison.value_of(candidate).size)
    return np.asarray(level > comparison.scene_quantity.counted_above)


def shown_models(comparison: Comparison) -> list[str]:
    """Names of the solved models, in the order that a figure shows: selected, reference, MDR, the nearest others."""
    solved, reference = comparison.selection.solved, reference_of(comparison)
    chosen = comparison.selection.best or reference
    springs = min(
        (candidate for candidate in solved if candidate.is_mdr), key=lambda candidate: candidate.error, default=chosen
    )

    def distance(candidate: Candidate) -> float:
        off = differences(candidate, chosen)[counted_bands(comparison, chosen)]
        return float(np.sqrt(np.nanmean(off**2))) if np.isfinite(off).any() else math.inf

    first = [chosen.name, reference.name, springs.name]
    return list(dict.fromkeys([*first, *(candidate.name for candidate in sorted(solved, key=distance))]))


def speed_and_accuracy(comparison: Comparison) -> Table:
    """A row a model that was solved: seconds by the clock, and its distance from the reference.

    Columns model, is_mdr, selected, is_reference, seconds, error, low, high, unit; low and high end the interval of
    both errors together, NaN where one is unknown. As the tolerance counts it: the largest of the bands that count, of
    spectra the root mean square over bands. The reference has no distance: its high is the error that it has.
    """
    reference, rows = reference_of(comparison), list[dict[str, object]]()
    unit = "dB" if comparison.is_level else comparison.tolerance.unit
    of_reference = decibels(reference.error) if unit == "dB" else 100 * reference.error
    for candidate in comparison.selection.solved:
        error, half = (
            level if unit == "dB" else percentage(level) for level in _distance_from_reference(comparison, candidate)
        )
        low, high = (max(error - half, 0.0), error + half) if math.isfinite(half) else (math.nan, math.nan)
        if is_reference := candidate is reference:
            error, low, high = math.nan, math.nan, of_reference if math.isfinite(of_reference) else math.nan
        named = {"model": candidate.name, "is_mdr": candidate.is_mdr, "selected": candidate.name == comparison.model}
        timed = {"is_reference": is_reference, "seconds": comparison.seconds_of(candidate)}
        rows.append({**named, **timed, "error": error, "low": low, "high": high, "unit": unit})
    return table_of(comparison.quantity, rows)


def _distance_from_reference(comparison: Comparison, candidate: Candidate) -> tuple[float, float]:
    """Distance from the reference, and its half-width of 95 % [dB]."""
    reference = reference_of(comparison)
    off, half = np.abs(differences(candidate, reference)), error_of_difference(comparison, candidate)
    within = counted_bands(comparison, reference) & np.isfinite(off)
    if not within.any():
        return math.nan, math.nan
    if comparison.scene_quantity.by_worst_band:
        at = int(np.argmax(np.where(within, off, -1.0)))
        return float(off[at]), float(half[at])
    return float(np.sqrt(np.mean(off[within] ** 2))), float(np.sqrt(np.mean(half[within] ** 2)))
