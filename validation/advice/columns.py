"""The tables that a text or a page prints: names of columns, and their cells."""

import math
import string
from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np

from validation.advice.advice import is_solved, springs_of
from validation.advice.compare import Comparison
from validation.advice.contact_force import ContactForce
from validation.advice.hierarchy import Candidate, Status
from validation.advice.side_by_side import TOGETHER, differences, error_of_difference, per_cent, reference_of
from validation.advice.tolerance import (
    NAMES,
    NONE,
    Columns,
    format_seconds,
    half_width,
    scaled,
    short,
    signed,
    tenth,
    two_digits,
)
from validation.engine.engine import FloatArray

ABREAST = 10
"""Models in a table, so that its lines fit."""
BECAME: dict[Status, str] = {
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


def levels_of(comparison: Comparison, one: Candidate | None, force: ContactForce | None) -> dict[str, FloatArray]:
    """All that a model that was solved has in each band, by the names of JSON and CSV; of none, NaN."""
    found = {name: getattr(comparison, name) for name in ("wavelength_mm", "frequency_hz", "nominal_hz")}
    if one is None:
        return found | {"value": comparison.value, "error": np.full_like(comparison.value, math.nan)}
    found |= {"value": comparison.value_of(one), "error": comparison.errors_of(one)}
    if comparison.roughness.size:
        roughness, a3 = comparison.roughness, comparison.a3_of(one)
        found |= {"roughness_dB": roughness, "a3_dB": a3, "equivalent_dB": roughness + a3}
    return found | ({"force_dBA": force.levels[one.name]} if force else {})


def bands_of(comparison: Comparison, one: Candidate) -> Columns:
    """A row a band: wavelength, frequency, q a, root mean square, levels and their error, as the scene has them."""
    assert one.answer is not None  # of a model that was solved
    found, contact = levels_of(comparison, one, comparison.force), comparison.scene.smooth_contact
    if comparison.roughness.size:
        del found["value"]
    elif contact:
        found |= {"q a": contact.along * comparison.wavenumbers, "amplitude": one.answer.value}
    units = {"unit": comparison.unit, "amplitude": comparison.asked.unit}
    return _cells(found, units)


def _cells(found: Mapping[str, FloatArray], units: Mapping[str, str]) -> Columns:
    return {
        head.format(**units): [cell(value) for value in found[name].tolist()]
        for name, (head, cell) in BANDS.items()
        if name in found and found[name].size
    }


def models_of_page(comparison: Comparison) -> list[dict[str, str]]:
    """A row a model: what it claims, found and costs, how far it is from the reference, and what became of it."""
    tolerance, solved = comparison.tolerance, comparison.selection.solved
    return [
        {
            "model": label(one),
            "claims": tolerance.shown(one.claimed) if one.estimate.in_range else "out of range",
            "found": NONE if one.answer is None else tolerance.shown_beside(one.error),
            "apart": _apart(comparison, one) if one in solved else NONE,
            "cost": format_seconds(one.cost if one.answer is None else one.answer.cost.seconds),
            "took": format_seconds(comparison.seconds_of(one), least="< 1 ms"),
            "became": _became(comparison, one),
            "why": one.reason,
            "selected": "selected" if one.name == comparison.model else "",
        }
        for one in comparison.models
    ]


def _became(comparison: Comparison, one: Candidate) -> str:
    """In words; beyond linear elasticity none is enough, and none is not needed for that."""
    solved = "solved" if one.answer else "not solved"
    if comparison.beyond_elasticity and one.status in ("accepted", "not accurate enough", "not needed"):
        return f"{solved}: no elastic half-space"
    return BECAME[one.status].removeprefix("not " if one.answer else "")


def label(candidate: Candidate) -> str:
    """The name of a model, and whether it is MDR."""
    return f"{candidate.name} (MDR)" if candidate.is_mdr else candidate.name


def _apart(comparison: Comparison, one: Candidate) -> str:
    """The largest difference from the model with the smallest error, in any band."""
    reference = reference_of(comparison)
    if one is reference:
        return NONE
    off = differences(one, reference)
    worst = abs(off).argmax()
    largest, error = (float(of[worst]) for of in (off, error_of_difference(comparison, one)))
    if comparison.is_level or comparison.in_decibels:
        return f"{'+' if largest > 0 else ''}{short(largest)} {half_width(error)} dB"
    return f"{per_cent(largest):+.2g} {half_width(per_cent(error))} %"


def numbers_beside(comparison: Comparison) -> Columns:
    """A row a model that was solved: its number, its error, and how far it is from the reference, with the error."""
    reference, solved = reference_of(comparison), comparison.selection.solved
    found = [[float(of(one)[0]) for of in (comparison.value_of, comparison.errors_of)] for one in solved]
    columns = {
        NAMES: [one.name for one in solved],
        f"{comparison.quantity} [{comparison.unit}]": [f"{value:.4g}" for value, _ in found],
        "±": [two_digits(half) for _, half in found],
    }
    off = [(float(differences(one, reference)[0]), float(error_of_difference(comparison, one)[0])) for one in solved]
    for head, of, digits in (("difference [dB]", float, 2), ("[%]", per_cent, 1)):
        cells = [f"{signed(of(apart), digits)} {half_width(of(error))}" for apart, error in off]
        columns[head] = [NONE if one is reference else cell for one, cell in zip(solved, cells, strict=True)]
    return columns


def levels_beside(comparison: Comparison) -> tuple[dict[str, str], Columns]:
    """A row a band: the level of the reference, and what is to be added to it for each other model.

    Returns the names of these models by their letters, with the error of the difference, and the columns.
    """
    reference = reference_of(comparison)
    others = [one for one in comparison.selection.solved if one is not reference]
    letters = dict(zip(string.ascii_uppercase, others, strict=False))
    axis = {"wavelength_mm": comparison.wavelength_mm, "nominal_hz": comparison.nominal_hz}
    columns = _cells(axis, {}) | {"level": [tenth(level) for level in comparison.value_of(reference)]}
    for letter, one in letters.items():
        columns[letter] = [signed(off, 1) for off in differences(one, reference).tolist()]
    names = {
        letter: f"{one.name}, {_range(one, error_of_difference(comparison, one))}" for letter, one in letters.items()
    }
    return names, columns


def _range(one: Candidate, errors: np.ndarray) -> str:
    """± 1.2 dB, of the root mean square over bands; from the smallest to the largest where each band has its own."""
    assert one.answer is not None  # as solved
    ends = dict.fromkeys(half_width(float(end)) for end in (errors.min(), errors.max()))
    shown = " to ".join(ends).replace("to ± ", "to ")
    where = "each band" if one.answer.band_errors else "the rms over bands"
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
        lines = [f"  {line}" for line in columns_as_lines(numbers_beside(comparison))]
        yield from ("", f"side by side; differences from {reference}, ± {TOGETHER}", *lines, "")
        return
    letters, columns = levels_beside(comparison)
    level = f"level by {reference} [{comparison.unit}]"
    yield from ("", f"side by side: {level}, and from there to the others, ± {TOGETHER}")
    yield from (f"  {letter}: {name}" for letter, name in letters.items())
    axis = {name: cells for name, cells in columns.items() if name not in letters}
    others = list(letters)
    for first in range(0, len(others), ABREAST):
        yield from columns_as_lines(axis | {name: columns[name] for name in others[first : first + ABREAST]})
    yield ""


def overview_of(comparisons: Sequence[Comparison]) -> Columns:
    """A row a scene: the model that is enough, its error, that of MDR, and the result, one number or the force."""
    several = len({one.quantity for one in comparisons}) > 1
    rows = [_row_of_scene(one, several) for one in comparisons]
    return {name: [row[name] for row in rows] for name in rows[0]}


def _row_of_scene(comparison: Comparison, several: bool) -> dict[str, str]:
    """several: whether quantities are told apart."""
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
        "MDR": NONE if springs is None else f"{shown(springs.error)}{_how(comparison, springs)}",
        "result": result,
    }


def _how(comparison: Comparison, springs: Candidate) -> str:
    """Where an error is predicted alone."""
    return "" if is_solved(comparison, springs) or not math.isfinite(springs.error) else ", predicted"
