"""The tables that a text or a page prints: names of columns, and their cells."""

import math
import string
from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np

from validation.advice.advice import is_solved, springs_of
from validation.advice.compare import Comparison
from validation.advice.contact_force import ContactForce
from validation.advice.hierarchy import Candidate, Status
from validation.advice.side_by_side import TOGETHER, differences, error_of_difference, reference_of
from validation.advice.tolerance import NAMES, Columns, percentage
from validation.analysis.number_text import (
    NONE,
    format_seconds,
    half_width_text,
    scaled,
    short,
    signed,
    tenth,
    two_digits,
)
from validation.engine.engine import FloatArray

ABREAST = 10
"""Models in a table, so that its lines fit."""
STATUS_IN_WORDS: dict[Status, str] = {
    "accepted": "enough, and the cheapest that is",
    "not accurate enough": "solved: not enough",
    "skipped": "not solved: its claim is too high",
    "not needed": "not solved: a cheaper is enough",
    "failed": "solved: no result",
    "out of range": "not solved: its error is unknown",
    "not asked": "not solved: not asked for",
}
"""What became of a model, in words."""
BANDS: dict[str, tuple[str, Callable[[float], str]]] = {
    "wavelength_mm": ("wavelength [mm]", "{:.4g}".format),
    "frequency_hz": ("f [Hz]", "{:.4g}".format),
    "nominal_hz": ("band [Hz]", "{:g}".format),
    "q a": ("q a", "{:.2f}".format),
    "amplitude": ("rms [{amplitude}]", "{:.4g}".format),
    "value": ("level [{unit}]", tenth),
    "roughness_dB": ("L_r", tenth),
    "a3_dB": ("A3", tenth),
    "equivalent_dB": ("L_eq", tenth),
    "error": ("± [dB]", two_digits),
    "force_dBA": ("L_FA", tenth),
}
"""Of a table of bands: head and cells, by the names that JSON and CSV have, in the order that is printed."""


def levels_of(comparison: Comparison, candidate: Candidate | None, force: ContactForce | None) -> dict[str, FloatArray]:
    """All that a model that was solved has in each band, by the names of JSON and CSV; of none, NaN."""
    columns = {name: getattr(comparison, name) for name in ("wavelength_mm", "frequency_hz", "nominal_hz")}
    if candidate is None:
        return columns | {"value": comparison.value, "error": np.full_like(comparison.value, math.nan)}
    columns |= {"value": comparison.value_of(candidate), "error": comparison.errors_of(candidate)}
    if comparison.roughness.size:
        roughness, a3 = comparison.roughness, comparison.a3_of(candidate)
        columns |= {"roughness_dB": roughness, "a3_dB": a3, "equivalent_dB": roughness + a3}
    return columns | ({"force_dBA": force.levels[candidate.name]} if force else {})


def bands_of(comparison: Comparison, candidate: Candidate) -> Columns:
    """A row a band: wavelength, frequency, q a, root mean square, levels and their error, as the scene has them."""
    assert candidate.answer is not None  # of a model that was solved
    columns, contact = levels_of(comparison, candidate, comparison.force), comparison.scene.smooth_contact
    if comparison.roughness.size:
        del columns["value"]
    elif contact:
        columns |= {"q a": contact.along * comparison.wavenumbers, "amplitude": candidate.answer.value}
    units = {"unit": comparison.unit, "amplitude": comparison.scene_quantity.unit}
    return _cells_of_bands(columns, units)


def _cells_of_bands(columns: Mapping[str, FloatArray], units: Mapping[str, str]) -> Columns:
    """Printed cells of the columns that `BANDS` names and that have values. units: what heads are formatted with."""
    return {
        head.format(**units): [cell(value) for value in columns[name].tolist()]
        for name, (head, cell) in BANDS.items()
        if name in columns and columns[name].size
    }


def models_of_page(comparison: Comparison) -> list[dict[str, str]]:
    """A row a model: what it claims, found and costs, how far it is from the reference, and what became of it."""
    tolerance, solved = comparison.tolerance, comparison.selection.solved
    return [
        {
            "model": label(candidate),
            "claims": tolerance.shown(candidate.predicted_error) if candidate.estimate.in_range else "out of range",
            "found": NONE if candidate.answer is None else tolerance.shown_distinct(candidate.error),
            "apart": _largest_difference(comparison, candidate) if candidate in solved else NONE,
            "cost": format_seconds(candidate.cost if candidate.answer is None else candidate.answer.cost.seconds),
            "took": format_seconds(comparison.seconds_of(candidate), least="< 1 ms"),
            "became": _status_in_words(comparison, candidate),
            "why": candidate.reason,
            "selected": "selected" if candidate.name == comparison.model else "",
        }
        for candidate in comparison.models
    ]


def _status_in_words(comparison: Comparison, candidate: Candidate) -> str:
    """The status of a model as the table prints it; beyond linear elasticity no status says enough or not needed."""
    solved = "solved" if candidate.answer else "not solved"
    if comparison.beyond_elasticity and candidate.status in ("accepted", "not accurate enough", "not needed"):
        return f"{solved}: no elastic half-space"
    return STATUS_IN_WORDS[candidate.status].removeprefix("not " if candidate.answer else "")


def label(candidate: Candidate) -> str:
    """The name of a model, and whether it is MDR."""
    return f"{candidate.name} (MDR)" if candidate.is_mdr else candidate.name


def _largest_difference(comparison: Comparison, candidate: Candidate) -> str:
    """The largest difference from the model with the smallest error, in any band."""
    reference = reference_of(comparison)
    if candidate is reference:
        return NONE
    off = differences(candidate, reference)
    worst = abs(off).argmax()
    largest, error = float(off[worst]), float(error_of_difference(comparison, candidate)[worst])
    if comparison.is_level or comparison.in_decibels:
        return f"{'+' if largest > 0 else ''}{short(largest)} {half_width_text(error)} dB"
    return f"{percentage(largest):+.2g} {half_width_text(percentage(error))} %"


def numbers_of_models(comparison: Comparison) -> Columns:
    """A row a model that was solved: its number, its error, and how far it is from the reference, with the error."""
    reference, solved = reference_of(comparison), comparison.selection.solved
    numbers = [
        (float(comparison.value_of(candidate)[0]), float(comparison.errors_of(candidate)[0])) for candidate in solved
    ]
    columns = {
        NAMES: [candidate.name for candidate in solved],
        f"{comparison.quantity} [{comparison.unit}]": [f"{value:.4g}" for value, _ in numbers],
        "±": [two_digits(half) for _, half in numbers],
    }
    offsets = [
        (float(differences(candidate, reference)[0]), float(error_of_difference(comparison, candidate)[0]))
        for candidate in solved
    ]
    for head, convert, digits in (("difference [dB]", float, 2), ("[%]", percentage, 1)):
        cells = [f"{signed(convert(offset), digits)} {half_width_text(convert(error))}" for offset, error in offsets]
        columns[head] = [
            NONE if candidate is reference else cell for candidate, cell in zip(solved, cells, strict=True)
        ]
    return columns


def levels_of_models(comparison: Comparison) -> tuple[dict[str, str], Columns]:
    """A row a band: the level of the reference, and what is to be added to it for each other model.

    Returns the names of these models by their letters, with the error of the difference, and the columns.
    """
    reference = reference_of(comparison)
    candidates = [candidate for candidate in comparison.selection.solved if candidate is not reference]
    letters = dict(zip(string.ascii_uppercase, candidates, strict=False))
    axis = {"wavelength_mm": comparison.wavelength_mm, "nominal_hz": comparison.nominal_hz}
    columns = _cells_of_bands(axis, {}) | {"level": [tenth(level) for level in comparison.value_of(reference)]}
    for letter, candidate in letters.items():
        columns[letter] = [signed(off, 1) for off in differences(candidate, reference).tolist()]
    names = {
        letter: f"{candidate.name}, {_error_in_words(candidate, error_of_difference(comparison, candidate))}"
        for letter, candidate in letters.items()
    }
    return names, columns


def _error_in_words(candidate: Candidate, errors: np.ndarray) -> str:
    """As ± 1.2 dB: the error of the rms over bands, or the smallest and the largest where each band has its own."""
    assert candidate.answer is not None  # as solved
    ends = dict.fromkeys(half_width_text(float(end)) for end in (errors.min(), errors.max()))
    shown = " to ".join(ends).replace("to ± ", "to ")
    where = "each band" if candidate.answer.band_errors else "the rms over bands"
    return shown if "unknown" in shown else f"{shown} dB in {where}"


def columns_as_lines(columns: Mapping[str, list[str]]) -> Iterator[str]:
    """Names of models to the left, all else to the right; columns under a letter are narrow and close together."""
    widths = {name: max(5 if len(name) == 1 else 8, *map(len, [name, *cells])) for name, cells in columns.items()}
    signs = {name: "<" if name == NAMES else ">" for name in columns}
    for row in (tuple(columns), *zip(*columns.values(), strict=True)):
        cells = [f"{text:{signs[name]}{widths[name]}s}" for name, text in zip(columns, row, strict=True)]
        yield "".join(f"{' ' if len(name) == 1 else '  '}{cell}" for name, cell in zip(columns, cells, strict=True))[2:]


def side_by_side(comparison: Comparison) -> Iterator[str]:
    """Lines of a table, a number a line or a band a line; none where only one model was solved."""
    if len(comparison.selection.solved) < 2:
        return
    reference = reference_of(comparison).name
    if not comparison.is_level:
        lines = [f"  {line}" for line in columns_as_lines(numbers_of_models(comparison))]
        yield from ("", f"side by side; differences from {reference}, ± {TOGETHER}", *lines, "")
        return
    letters, columns = levels_of_models(comparison)
    level = f"level by {reference} [{comparison.unit}]"
    yield from ("", f"side by side: {level}, and from there to the others, ± {TOGETHER}")
    yield from (f"  {letter}: {name}" for letter, name in letters.items())
    axis = {name: cells for name, cells in columns.items() if name not in letters}
    heads = list(letters)
    for first in range(0, len(heads), ABREAST):
        yield from columns_as_lines(axis | {name: columns[name] for name in heads[first : first + ABREAST]})
    yield ""


def overview_of(comparisons: Sequence[Comparison]) -> Columns:
    """A row a scene: the model that is enough, its error, that of MDR, and the result, one number or the force."""
    several = len({comparison.quantity for comparison in comparisons}) > 1
    rows = [_row_of_scene(comparison, several) for comparison in comparisons]
    return {name: [row[name] for row in rows] for name in rows[0]}


def _row_of_scene(comparison: Comparison, several: bool) -> dict[str, str]:
    """The cells of one scene by their heads. several: whether the scene is named with its quantity."""
    best, shown, scene = comparison.selection.best, comparison.tolerance.shown, comparison.scene.name
    springs = springs_of(comparison)
    if best is None:
        result = ""
    elif comparison.is_level:
        result = force.shown if (force := comparison.force) else f"{comparison.value.size} bands"
    else:
        (value,), (half,) = comparison.value, comparison.errors_of(best)
        result = f"{scaled(float(value), float(half))} {comparison.unit}"
    return {
        "scene": f"{scene}: {comparison.quantity}" if several else scene,
        "model": label(best) if best and comparison.met else "none is enough",
        "error": shown(best.error) if best else "none",
        "MDR": NONE if springs is None else f"{shown(springs.error)}{_prediction_note(comparison, springs)}",
        "result": result,
    }


def _prediction_note(comparison: Comparison, springs: Candidate) -> str:
    """Text that marks the error of MDR as predicted; empty where MDR was solved or its error is unknown."""
    return "" if is_solved(comparison, springs) or not math.isfinite(springs.error) else ", predicted"
