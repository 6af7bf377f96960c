"""All models that were solved, beside the one with the smallest error: differences in decibels."""

import math
import string

import numpy as np

from validation.selection.compare import Comparison
from validation.selection.hierarchy import Candidate


def side_by_side(comparison: Comparison) -> list[str]:
    """Lines of a table, a number a line or a band a line; none where only one model was solved."""
    solved = comparison.selection.solved
    if len(solved) < 2:
        return []
    reference = min(reversed(solved), key=lambda one: one.error)
    table = _spectra if comparison.wavenumbers.size else _numbers
    return ["", *table(comparison, solved, reference), ""]


def differences(comparison: Comparison, candidate: Candidate, reference: Candidate) -> np.ndarray:
    """Of the levels of two models, 20 lg of the ratio of their amplitudes [dB]."""
    assert candidate.answer is not None and reference.answer is not None  # as solved
    return np.asarray(20 * np.log10(candidate.answer.value / reference.answer.value))


def _numbers(comparison: Comparison, solved: tuple[Candidate, ...], reference: Candidate) -> list[str]:
    lines = [f"side by side; differences from {reference.name}"]
    for one in solved:
        (value,), (half,) = comparison.value_of(one), comparison.errors_of(one)
        (off,) = differences(comparison, one, reference)
        number = f"{value:12.4g} ± {half:<9.2g}{comparison.unit:8s}"
        lines.append(f"  {one.name:36s}{number}{off:+8.2f} dB  {10 ** (off / 20) - 1:+7.1%}")
    return lines


def _spectra(comparison: Comparison, solved: tuple[Candidate, ...], reference: Candidate) -> list[str]:
    """The level of the reference, and what is to be added to it for each of the others."""
    others = [one for one in solved if one is not reference]
    letters = dict(zip(string.ascii_uppercase, others, strict=False))
    lines = [f"side by side: level by {reference.name} [{comparison.unit}], and from there to"]
    lines += [f"  {letter}: {one.name}" for letter, one in letters.items()]
    hertz = "f [Hz]" if comparison.frequency_hz.size else ""
    lines.append(f"{'wavelength [mm]':>16s}{hertz:>10s}{'level':>10s}" + "".join(f"{key:>8s}" for key in letters))
    level, apart = comparison.value_of(reference), [differences(comparison, one, reference) for one in others]
    frequencies = comparison.frequency_hz if comparison.frequency_hz.size else np.full(level.size, math.nan)
    for i, wavelength in enumerate(comparison.wavelength_mm):
        frequency = "" if math.isnan(frequencies[i]) else f"{frequencies[i]:.4g}"
        lines.append(
            f"{wavelength:16.4g}{frequency:>10s}{level[i]:10.1f}" + "".join(f"{row[i]:+8.1f}" for row in apart)
        )
    return lines
