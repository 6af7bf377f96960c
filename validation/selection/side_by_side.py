"""All models that were solved, beside the one with the smallest error: differences in decibels, with their errors."""

import math
import string
from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from validation.selection.compare import Comparison
from validation.selection.hierarchy import Candidate
from validation.selection.tolerance import short
from validation.simulation.rail_quantity import COUNTED

Columns = dict[str, list[str]]
ABREAST = 10
"""Models in a table, so that its lines fit."""
NAMES = "by"
"""The column of the names of models."""
TOGETHER = "both errors together: of the models the sum, of grid and sample the root of the sum of squares"
"""How the half-width of a difference follows from the errors of both models."""


def side_by_side(comparison: Comparison) -> list[str]:
    """Lines of a table, a number a line or a band a line; none where only one model was solved."""
    solved = comparison.selection.solved
    if len(solved) < 2:
        return []
    return ["", *(_spectra(comparison) if comparison.is_level else _numbers(comparison)), ""]


def reference_of(comparison: Comparison) -> Candidate:
    """The solved model with the smallest error, the dearest of several."""
    return min(reversed(comparison.selection.solved), key=lambda one: one.error)


def differences(candidate: Candidate, reference: Candidate) -> np.ndarray:
    """Of the levels of two models, 20 lg of the ratio of their amplitudes [dB]."""
    assert candidate.answer is not None and reference.answer is not None  # as solved
    return np.asarray(20 * np.log10(candidate.answer.value / reference.answer.value))


def error_of_difference(comparison: Comparison, candidate: Candidate, reference: Candidate) -> np.ndarray:
    """Half-widths of 95 % of `differences` [dB]: `TOGETHER`; infinite where one is unknown."""
    ours, theirs = (_parts(comparison, one) for one in (candidate, reference))
    random = [part for parts in (ours, theirs) for part in (parts["grid"], parts["sample"])]
    both = ours["model"] + theirs["model"] + np.sqrt(np.sum(np.square(random), axis=0))
    return np.asarray(both if comparison.is_level else 20 * np.log10(1 + both))


def _parts(comparison: Comparison, one: Candidate) -> dict[str, np.ndarray]:
    """Errors by their names: of levels in dB, else relative."""
    scale = 1.0 if comparison.is_level else np.abs(comparison.value_of(one))
    return {name: part / scale for name, part in comparison.error_parts_of(one).items()}


def half_width(error: float) -> str:
    """As "± 1.2", or "± unknown"."""
    return f"± {short(error)}" if math.isfinite(error) else "± unknown"


def signed(value: float, digits: int) -> str:
    """With its sign, but for a zero; a dash where there is no number."""
    if not math.isfinite(value):
        return "—"
    return f"{rounded:+.{digits}f}" if (rounded := round(value, digits)) else f"{0:.{digits}f}"


def axis_of(comparison: Comparison) -> Columns:
    """Wavelength of each band; with a speed also its frequency, and the nominal band in which that lies."""
    columns = {"wavelength [mm]": [f"{wave:.4g}" for wave in comparison.wavelength_mm]}
    if comparison.frequency_hz.size:
        columns["f [Hz]"] = [f"{frequency:.4g}" for frequency in comparison.frequency_hz]
        columns["band [Hz]"] = [f"{nominal:g}" for nominal in comparison.nominal_hz]
    return columns


def numbers_beside(comparison: Comparison) -> Columns:
    """A row a model that was solved: its number, its error, and how far it is from the reference, with the error."""
    reference, columns = reference_of(comparison), Columns()
    for one in comparison.selection.solved:
        (value,), (half,) = comparison.value_of(one), comparison.errors_of(one)
        (off,), (apart,) = differences(one, reference), error_of_difference(comparison, one, reference)
        here = one is reference
        row = {
            NAMES: one.name,
            f"{comparison.quantity} [{comparison.unit}]": f"{value:.4g}",
            "±": f"{half:.2g}" if math.isfinite(half) else "unknown",
            "difference [dB]": "—" if here else f"{signed(float(off), 2)} {half_width(apart)}",
            "[%]": "—" if here else f"{signed(per_cent(off), 1)} {half_width(per_cent(apart))}",
        }
        for name, text in row.items():
            columns.setdefault(name, []).append(text)
    return columns


def per_cent(decibels: float) -> float:
    """Of an amplitude, from its level [dB]."""
    return float(100 * (10 ** (decibels / 20) - 1))


def levels_beside(comparison: Comparison) -> tuple[dict[str, str], Columns]:
    """A row a band: the level of the reference, and what is to be added to it for each other model.

    Returns the names of these models by their letters, with the error of the difference, and the columns.
    """
    reference = reference_of(comparison)
    others = [one for one in comparison.selection.solved if one is not reference]
    letters = dict(zip(string.ascii_uppercase, others, strict=False))
    columns = axis_of(comparison)
    columns.pop("f [Hz]", None)
    columns["level"] = [f"{x:.1f}" if math.isfinite(x) else "—" for x in comparison.value_of(reference).round(1) + 0.0]
    for letter, one in letters.items():
        columns[letter] = [signed(off, 1) for off in differences(one, reference).tolist()]
    errors = {letter: error_of_difference(comparison, one, reference) for letter, one in letters.items()}
    return {letter: f"{one.name}, {_range(one, errors[letter])}" for letter, one in letters.items()}, columns


def _range(one: Candidate, errors: np.ndarray) -> str:
    """± 1.2 dB, of the root mean square over bands; from the smallest to the largest where each band has its own."""
    assert one.answer is not None  # as solved
    ends = [half_width(float(end)) for end in (errors.min(), errors.max())]
    shown = ends[0] if ends[0] == ends[1] else f"{ends[0]} to {ends[1][2:]}"
    return (
        shown
        if "unknown" in shown
        else f"{shown} dB in {'each band' if one.answer.band_errors else 'the rms over bands'}"
    )


def counts(comparison: Comparison, one: Candidate) -> NDArray[np.bool_]:
    """Where the tolerance counts: of a rail not in bands of which next to nothing is left."""
    level = comparison.a3_of(one) if comparison.roughness.size else np.zeros(comparison.value_of(one).size)
    return np.asarray(level > COUNTED)


def shown_models(comparison: Comparison) -> list[str]:
    """Names of the solved models, in the order that a figure shows: selected, reference, MDR, the nearest others."""
    solved, reference = comparison.selection.solved, reference_of(comparison)
    chosen = comparison.selection.best or reference
    springs = min((one for one in solved if one.model.is_mdr), key=lambda one: one.error, default=chosen)

    def apart(one: Candidate) -> float:
        off = differences(one, chosen)[counts(comparison, chosen)]
        return float(np.sqrt(np.nanmean(off**2))) if np.isfinite(off).any() else math.inf

    first = [chosen.name, reference.name, springs.name]
    return list(dict.fromkeys([*first, *(one.name for one in sorted(solved, key=apart))]))


def columns_as_lines(columns: Mapping[str, list[str]]) -> Iterator[str]:
    """Names of models to the left, all else to the right; columns under a letter are narrow and close together."""
    widths = {name: max(5 if len(name) == 1 else 8, *map(len, [name, *cells])) for name, cells in columns.items()}
    signs = {name: "<" if name == NAMES else ">" for name in columns}
    for row in (tuple(columns), *zip(*columns.values(), strict=True)):
        cells = [f"{text:{signs[name]}{widths[name]}s}" for name, text in zip(columns, row, strict=True)]
        yield "".join(f"{' ' if len(name) == 1 else '  '}{cell}" for name, cell in zip(columns, cells, strict=True))[2:]


def _numbers(comparison: Comparison) -> Iterator[str]:
    yield f"side by side; differences from {reference_of(comparison).name}, ± {TOGETHER}"
    yield from (f"  {line}" for line in columns_as_lines(numbers_beside(comparison)))


def _spectra(comparison: Comparison) -> Iterator[str]:
    letters, columns = levels_beside(comparison)
    level = f"level by {reference_of(comparison).name} [{comparison.unit}]"
    yield f"side by side: {level}, and from there to the others, ± {TOGETHER}"
    yield from (f"  {letter}: {name}" for letter, name in letters.items())
    others = list(letters)
    for first in range(0, len(others), ABREAST):
        abreast = others[first : first + ABREAST]
        yield from columns_as_lines({name: of for name, of in columns.items() if name not in set(others) - {*abreast}})
