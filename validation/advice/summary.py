"""The text that `compare` prints: the result with its error, whether MDR is accurate enough, each model, the scene."""

import math
import string
import textwrap
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np

from validation.advice import advice as on_mdr
from validation.advice.advice import is_solved, springs_of, what_would_help, would_help
from validation.advice.compare import Comparison, OneOrSeveral, comparisons_of
from validation.advice.hierarchy import Candidate, Status
from validation.advice.models_of_scene import quantity_of
from validation.advice.scene_model import Answer
from validation.advice.sound_power import LEVELS
from validation.advice.table import (
    DIFFERENCES,
    TOGETHER,
    first_row,
    has_numbers,
    reference_of,
    result_table,
    tables_of_models,
)
from validation.advice.tolerance import NAMES, Columns, Tolerance, decibels, percentage
from validation.analysis.evidence import Table, Verdict
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
from validation.scenes.description import description_lines
from validation.scenes.scene import Scene
from validation.simulation.model import Target

WIDTH = 100
"""Columns of a terminal."""
CAUSE, CLAUSE = ": ", "; "
"""Between a clause and its cause, and between clauses of a reason."""
ASSUMED = "elastic half-spaces, isotropic, without friction and adhesion"
LEAST_ROOM = 12
"""Characters of a column of status, at the least."""
ABREAST = 10
"""Models in a table, so that its lines fit."""
STATUS_IN_WORDS: dict[Status, str] = {
    "accepted": "selected",
    "not accurate enough": "rejected: estimated error above the tolerance",
    "skipped": "rejected: predicted error above the tolerance",
    "not needed": "not needed",
    "failed": "no result",
    "out of range": "rejected: predicted error unknown",
    "not asked": "not requested",
}
"""The status of a model as it is printed."""
PARTS = {"model": "model", "grid": "discretisation", "sample": "sampling"}
"""Parts of an error by the names that `Answer` has, in words."""
BANDS: dict[str, tuple[str, Callable[[float], str]]] = {
    "wavelength_mm": ("wavelength [mm]", "{:.4g}".format),
    "frequency_hz": ("f [Hz]", "{:.4g}".format),
    "nominal_hz": ("band [Hz]", "{:g}".format),
    "q_a": ("q a", "{:.2f}".format),
    "amplitude": ("rms [{amplitude}]", "{:.4g}".format),
    "value": ("level [{unit}]", tenth),
    "roughness_dB": ("L_r", tenth),
    "a3_dB": ("A3", tenth),
    "equivalent_dB": ("L_eq", tenth),
    "error": ("± [dB]", two_digits),
}
"""Of a table of bands: head and cells, by the names that JSON and CSV have, in the order that is printed."""


def summary(comparison: OneOrSeveral) -> str:
    """Text of a comparison: the scene, what became of each model, the result with its error, a sentence on MDR.

    Parameters
    ----------
    comparison : Comparison or list of Comparison
        What `compare` returns; of a list, a line a scene, and what would help those whose tolerance is not met.

    Returns
    -------
    str
        The lines that the command ``mdr-validation compare --verbose`` prints.

    Examples
    --------
    >>> text = validation.summary(validation.compare(validation.load_scene("sphere")))
    >>> print(text.splitlines()[0])
    Smooth sphere: stiffness within 10 %
    """
    if not isinstance(comparison, Comparison):
        comparisons = comparisons_of(comparison)
        return "\n".join([*overview(comparisons), *help_with(comparisons)])
    asked = heading(comparison.scene, [comparison.quantity], comparison.tolerance)
    return "\n".join([asked, findings([comparison], in_full), facts(comparison.scene, [comparison.quantity])])


def heading(scene: Scene, quantities: Sequence[str], tolerance: Tolerance) -> str:
    """What is asked, and notes on the scene, before anything is solved."""
    notes = [line for line in _description(scene, quantities) if line[0] != " "]
    lines = [f"{scene.name}: {', '.join(quantities)} within {tolerance}", *notes]
    return "\n".join(wrapped(lines, indent=4))


def facts(scene: Scene, quantities: Sequence[str]) -> str:
    """The scene as it was read: bodies, contact, roughness, what is assumed."""
    described = [line for line in _description(scene, quantities) if line[0] == " "]
    lines = ["", "scene", *described, f"  {'assumed':18s}  {ASSUMED}"]
    return "\n".join(wrapped(lines, indent=22))


def _description(scene: Scene, quantities: Sequence[str]) -> list[str]:
    """Notes, and indented lines of the description; of motion where a quantity is of it."""
    return description_lines(scene, moving=any(quantity_of(scene, key).of_motion for key in quantities))


def findings(comparisons: Sequence[Comparison], lines_of: Callable[[Sequence[Comparison]], Iterator[str]]) -> str:
    """Text of quantities with the same solves; of a rail those in the same bands share a table. lines_of: `in_full`."""
    parts = dict[tuple[float, ...], list[Comparison]]()
    for number, comparison in enumerate(comparisons):
        parts.setdefault(tuple(comparison.roughness.tolist()) or (number,), []).append(comparison)
    lines = [line for part in parts.values() for line in lines_of(part)]
    # no blank line below another
    single_spaced = [line for before, line in zip(["text", *lines], lines, strict=False) if line or before]
    return "\n".join(wrapped(single_spaced, indent=4)).rstrip("\n")


def in_full(quantities: Sequence[Comparison]) -> Iterator[str]:
    """`in_short`, and why each model has its status, sound power in bands, and what errors rest on and cost."""
    comparison = quantities[0]
    best = comparison.selection.best
    yield from (*_answer_lines(quantities), *on_mdr.in_full(comparison), "", *would_help(comparison))
    yield from (*models_as_lines(comparison), "", *_reasons(comparison), "")
    yield from _bands_as_lines(comparison)
    if best is not None and (power := comparison.power):
        yield from ("", *power.sentences, *(f"  {line}" for line in columns_as_lines(power.table)), "")
    yield from side_by_side(comparison)
    if best is not None:
        yield from (age_of_errors(comparison), cost_of(comparison))


def models_as_lines(comparison: Comparison) -> Iterator[str]:
    """A row a model: predicted and estimated error, cost, and status; a long status goes on below."""
    head, spent = ("took", "seconds") if comparison.timed else ("cost", "cost")
    rows = models_of_page(comparison)
    width = max((len(row["model"]) for row in rows), default=5) + 1
    yield from ("", f"{'model':{width}s}{'predicted':>10s}{'estimated':>11s}{head:>9s}  status")
    for row in rows:
        cells = f"{row['model']:{width}s}{row['predicted_error']:>10s}{row['error']:>11s}{row[spent]:>9s}  "
        room = WIDTH - len(cells)
        status = textwrap.wrap(row["status"], room) if room >= LEAST_ROOM else [row["status"]]
        yield f"{cells}{status[0]}"
        yield from (f"{'':{len(cells)}s}{line}" for line in status[1:])


def no_answer(comparison: Comparison) -> str:
    return f"no model has {'a known error' if comparison.selection.solved else 'a result'}"


def _reasons(comparison: Comparison) -> Iterator[str]:
    """What errors rest on, each clause once."""
    yield "why"
    all_names = tuple(candidate.name for candidate in comparison.models)
    for names, reason in grouped({candidate.name: candidate.reason for candidate in comparison.models}):
        yield f"  {'all' if names == all_names and len(all_names) > 1 else '; '.join(names)}: {reason}"


def grouped(reasons: Mapping[str, str]) -> Iterator[tuple[tuple[str, ...], str]]:
    """Names of models and the clauses that these and no others have, in their order. reasons: by name."""
    times = Counter(end for reason in set(reasons.values()) for end in _clauses_and_causes(reason))
    names = dict[str, dict[str, None]]()
    for name, reason in reasons.items():
        for clause in _clauses(reason, times):
            names.setdefault(clause, {})[name] = None
    clauses = dict[tuple[str, ...], list[str]]()
    for clause, those in names.items():
        clauses.setdefault(tuple(those), []).append(clause)
    return ((those, CLAUSE.join(same)) for those, same in clauses.items())


def _clauses_and_causes(reason: str) -> set[str]:
    """Clauses, and what stands behind the colon of one."""
    clauses = reason.split(CLAUSE)
    return {*clauses, *(clause.partition(CAUSE)[2] for clause in clauses)}


def _clauses(reason: str, times: Mapping[str, int]) -> Iterator[str]:
    """What stands in several reasons is a clause of its own, but for a word or a number, which says nothing alone."""
    for clause in reason.split(CLAUSE):
        head, _, cause = clause.partition(CAUSE)
        yield from (head, cause) if " " in cause and times[cause] > 1 else (clause,)


def overview(comparisons: Sequence[Comparison]) -> list[str]:
    """A line a scene, of the columns of `overview_of`; two lines a scene where names are long."""
    scenes, *columns = ([name, *column] for name, column in overview_of(comparisons).items())
    model, error, mdr = (max(map(len, column)) for column in columns[:3])
    rests = [
        f"{row[0]:{model}s}  {row[1]:>{error}s}  {row[2]:>{mdr}s}   {row[3]}".rstrip()
        for row in zip(*columns, strict=True)
    ]
    width = max(map(len, scenes))
    if width + 2 + max(map(len, rests)) <= WIDTH:
        return [f"{scene:{width}s}  {rest}" for scene, rest in zip(scenes, rests, strict=True)]
    head, *pairs = zip(scenes, rests, strict=True)
    return [head[0], f"  {head[1]}", *(line for scene, rest in pairs for line in (scene, f"  {rest}"))]


def help_with(comparisons: Sequence[Comparison]) -> list[str]:
    """What would help each scene whose tolerance is not met."""
    lines = [f"{comparison.scene.name}: {line}" for comparison in comparisons for line in what_would_help(comparison)]
    return list(wrapped(lines, indent=4))


def bands_of(comparison: Comparison, model: str) -> Columns:
    """A row a band of a model: wavelength, frequency, q a, rms, levels and their error, as the scene has them."""
    table = result_table(comparison).where(model=model)
    names = [name for name in BANDS if has_numbers(table, name) and not (name == "value" and "a3_dB" in table.columns)]
    units = {"unit": comparison.unit, "amplitude": comparison.scene_quantity.unit}
    return _cells_of_bands(table, names, units)


def _cells_of_bands(table: Table, names: Iterable[str], units: Mapping[str, str] = MappingProxyType({})) -> Columns:
    """Printed cells of columns that `BANDS` has, by their heads. units: what heads are formatted with."""
    return {
        head.format(**units): [cell(value) for value in table[name].tolist()]
        for name in names
        for head, cell in [BANDS[name]]
    }


def models_of_page(comparison: Comparison) -> list[dict[str, str]]:
    """A row a model: predicted and estimated error, cost, status, and how far it is from the reference."""
    return [_cells_of_model(comparison, table) for table in tables_of_models(result_table(comparison))]


def _cells_of_model(comparison: Comparison, table: Table) -> dict[str, str]:
    """The printed cells of one model. table: its rows of `result_table`."""
    model, tolerance = first_row(table), comparison.tolerance
    predicted, answered = model["predicted_error"], model["answered"]
    return {
        "model": label(model["model"], is_mdr=model["is_mdr"]),
        "predicted_error": tolerance.shown(predicted) if math.isfinite(predicted) else "unknown",
        "error": tolerance.shown_distinct(model["relative_error"]) if answered else NONE,
        "difference": _largest_difference(comparison, table) if model["solved"] and not model["is_reference"] else NONE,
        "cost": format_seconds(model["spent_s"] if answered else model["cost_s"]),
        "seconds": format_seconds(model.get("seconds", math.nan), least="< 1 ms"),
        "status": _status_in_words(comparison, model),
        "reason": model["reason"],
        "selected": "selected" if model["selected"] else "",
    }


def _status_in_words(comparison: Comparison, model: Mapping[str, Any]) -> str:
    """The status of a model as the table prints it. model: its row of `result_table`.

    A model that is rejected although its error is within the tolerance has the first clause of its reason.
    """
    status, reason = model["status"], model["reason"].partition(CLAUSE)[0]
    if comparison.beyond_elasticity and status in ("accepted", "not accurate enough", "not needed"):
        return "rejected: no elastic half-space"
    if status == "failed":
        return f"{STATUS_IN_WORDS[status]}: {reason}"
    if status == "not accurate enough" and model["relative_error"] <= comparison.tolerance.relative:
        return f"rejected: {reason}"
    return STATUS_IN_WORDS[status]


def label(model: str, *, is_mdr: bool) -> str:
    """The name of a model, and whether it is MDR."""
    return f"{model} (MDR)" if is_mdr else model


def _largest_difference(comparison: Comparison, table: Table) -> str:
    """The largest difference of a model from the one with the smallest error, in any band."""
    worst = np.abs(table["difference_dB"]).argmax()
    largest, error = (float(table[name][worst]) for name in DIFFERENCES)
    if comparison.is_level or comparison.in_decibels:
        return f"{'+' if largest > 0 else ''}{short(largest)} {half_width_text(error)} dB"
    return f"{percentage(largest):+.2g} {half_width_text(percentage(error))} %"


def numbers_of_models(comparison: Comparison) -> Columns:
    """A row a model that was solved: its number, its error, and how far it is from the reference, with the error."""
    table = result_table(comparison).where(solved=True)
    columns: Columns = {
        NAMES: list(map(str, table["model"])),
        f"{comparison.quantity} [{comparison.unit}]": [f"{value:.4g}" for value in table["value"]],
        "±": [two_digits(half) for half in table["error"].tolist()],
    }
    for head, convert, digits in (("difference [dB]", float, 2), ("[%]", percentage, 1)):
        columns[head] = [
            NONE if is_reference else f"{signed(convert(off), digits)} {half_width_text(convert(error))}"
            for is_reference, off, error in zip(
                *(table[name].tolist() for name in ("is_reference", *DIFFERENCES)), strict=True
            )
        ]
    return columns


def levels_of_models(comparison: Comparison) -> tuple[dict[str, str], Columns]:
    """A row a band: the level of the reference, and what is to be added to it for each other model.

    Returns the names of these models by their letters, with the error of the difference, and the columns.
    """
    solved = result_table(comparison).where(solved=True)
    reference, others = solved.where(is_reference=True), tables_of_models(solved.where(is_reference=False))
    axes = [name for name in ("wavelength_mm", "nominal_hz") if has_numbers(reference, name)]
    columns = _cells_of_bands(reference, axes) | {"level": [tenth(level) for level in reference["value"].tolist()]}
    letters = dict(zip(string.ascii_uppercase, others, strict=False))
    for letter, table in letters.items():
        columns[letter] = [signed(off, 1) for off in table["difference_dB"].tolist()]
    return {letter: f"{table['model'][0]}, {_error_in_words(table)}" for letter, table in letters.items()}, columns


def _error_in_words(table: Table) -> str:
    """As ± 1.2 dB: the error of the rms over bands, or the smallest and the largest where each band has its own."""
    errors = table["difference_error_dB"]
    ends = dict.fromkeys(half_width_text(float(end)) for end in (errors.min(), errors.max()))
    shown = " to ".join(ends).replace("to ± ", "to ")
    where = "each band" if table["errors_by_band"][0] else "the rms over bands"
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
    """A row a scene: the selected model, its error, that of MDR, and the result, a number or the sound power."""
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
        result = power.shown if (power := comparison.power) else f"{np.size(comparison.value)} bands"
    else:
        value, half = float(comparison.value), float(comparison.errors_of(best))
        result = f"{scaled(float(value), float(half))} {comparison.unit}"
    return {
        "scene": f"{scene}: {comparison.quantity}" if several else scene,
        "model": label(best.name, is_mdr=best.is_mdr) if best and comparison.met else "none",
        "error": shown(best.error) if best else "none",
        "MDR": NONE if springs is None else f"{shown(springs.error)}{_prediction_note(comparison, springs)}",
        "result": result,
    }


def _prediction_note(comparison: Comparison, springs: Candidate) -> str:
    """Text that marks the error of MDR as predicted; empty where MDR was solved or its error is unknown."""
    return "" if is_solved(comparison, springs) or not math.isfinite(springs.error) else ", predicted"


def result_of(comparison: Comparison, answer: Answer) -> str:
    """The number with its error, or the model of a spectrum with its error, and the parts of that."""
    shown = comparison.tolerance.shown
    of = f", {comparison.statistic}" if comparison.statistic else ""
    parts = f"model {shown(answer.model)}, grid {shown(answer.grid)}, sample {shown(answer.sample)}"
    if not comparison.is_level:
        value = float(answer.value[0])
        number = f"{scaled(value, value * answer.error)} {comparison.unit}"
        return f"{comparison.quantity} = {number} ({shown(answer.error)}: {parts}), by {comparison.model}{of}"
    level = error_of_levels(comparison, answer)
    return f"{comparison.quantity} by {comparison.model}{of}, one-third octaves, ± {level}: {parts}"


def error_of_levels(comparison: Comparison, answer: Answer) -> str:
    """In the unit of the tolerance and in dB, and in which bands."""
    level = f"{short(decibels(answer.error))} dB"
    both = level if comparison.in_decibels else f"{comparison.tolerance.shown(answer.error)} ({level})"
    of_sum = "in the bands that count" if comparison.scene_quantity.by_worst_band else "of the sum in dB(A)"
    return f"{both} {of_sum if answer.band_errors else 'over all bands'}"


def age_of_errors(comparison: Comparison) -> str:
    """Where the errors of the models are from."""
    if source := comparison.scene.error_source:
        return source
    from validation.advice.calibrate import calibration_age  # imported where errors were measured

    return calibration_age(target=Target(comparison.scene, comparison.quantity))


def cost_of(comparison: Comparison) -> str:
    """What the solves cost, and what those would have cost that were not needed."""
    spent = format_seconds(comparison.selection.spent)
    text = f"cost of the solves: about {spent}, from counted operations, without program start"
    saved = sum(
        candidate.cost
        for candidate in comparison.models
        if candidate.answer is None and candidate.status != "out of range"
    )
    return f"{text}; the models that were not solved would have cost {format_seconds(saved)}" if saved else text


def wrapped(lines: list[str], indent: int) -> Iterator[str]:
    """Lines of the width at the most; what goes on in the next line is indented."""
    for line in lines:
        own = line[: len(line) - len(line.lstrip())]
        more = " " * max(indent, len(own))
        fits = len(line) <= WIDTH
        yield from [line] if fits else textwrap.wrap(line.strip(), WIDTH, initial_indent=own, subsequent_indent=more)


def in_short(quantities: Sequence[Comparison]) -> Iterator[str]:
    """The answer, its error, a sentence on MDR and the table of models, of quantities with the same solves."""
    comparison = quantities[0]
    yield from (*_answer_lines(quantities), on_mdr.in_short(comparison), "", *would_help(comparison))
    yield from (*models_as_lines(comparison), "")
    yield from (*_bands_as_lines(comparison), *side_by_side(comparison))


def _answer_lines(quantities: Sequence[Comparison]) -> Iterator[str]:
    """The value with its error, its model and its verdict, and the parts of the error."""
    comparison = quantities[0]
    best = comparison.selection.best
    yield ""
    if best is None or best.answer is None:
        yield no_answer(comparison)
    else:
        yield from (_value_sentence(quantities, best, best.answer), _error_sentence(comparison, best.answer))


def _bands_as_lines(comparison: Comparison) -> Iterator[str]:
    """The spectrum of the result, a row a band; nothing of a single number."""
    best = comparison.selection.best
    if best is not None and best.answer is not None and comparison.is_level:
        yield from (line for line in (best.answer.counted, LEVELS if comparison.roughness.size else "") if line)
        yield from columns_as_lines(bands_of(comparison, best.name))


def _value_sentence(quantities: Sequence[Comparison], best: Candidate, answer: Answer) -> str:
    """One number with its error, or how many bands there are, of a rail with the sound power that they leave.

    Behind it the model, what its solve took, and whether the tolerance is met.
    """
    comparison = quantities[0]
    name = comparison.quantity if len(quantities) == 1 else "both"
    if not comparison.is_level:
        value = float(answer.value[0])
        result = f"{name} = {scaled(value, value * answer.error)} {comparison.unit}"
    else:
        power = comparison.power
        result = f"{name} in {np.size(comparison.value)} bands{f', sound power {power.shown}' if power else ''}"
    of = f"{comparison.statistic}, " if comparison.statistic else ""
    seconds = comparison.seconds_of(best)
    took = format_seconds(seconds if math.isfinite(seconds) else answer.cost.seconds)
    verdict = Verdict.WITHIN if comparison.met else Verdict.OUTSIDE
    return f"{result} ({of}by {label(best.name, is_mdr=best.is_mdr)}, {took}): {verdict}"


def _error_sentence(comparison: Comparison, answer: Answer) -> str:
    """The error beside the tolerance, and its parts: model, discretisation and sampling."""
    tolerance = comparison.tolerance
    parts = {words: part for name, words in PARTS.items() if (part := getattr(answer, name))}
    error = error_of_levels(comparison, answer) if comparison.is_level else tolerance.shown_distinct(answer.error)
    listed = ", ".join(f"{words} {tolerance.shown(part)}" for words, part in parts.items())
    budget = f", of which {listed}" if len(parts) > 1 else "".join(f", all of it {words} error" for words in parts)
    return f"error ± {error} (95 %){budget}; tolerance {tolerance}"
