"""The text that `compare` prints: what was understood, what became of each model, the result, whether MDR is enough."""

import textwrap
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence

from validation.advice import advice as on_mdr
from validation.advice.advice import what_would_help, would_help
from validation.advice.columns import bands_of, columns_as_lines, models_of_page, overview_of, side_by_side
from validation.advice.compare import Comparison, OneOrSeveral, listed
from validation.advice.contact_force import LEVELS
from validation.advice.quantities import quantity_of
from validation.advice.scene_model import Answer
from validation.advice.tolerance import Tolerance, decibels
from validation.analysis.number_text import format_seconds, scaled, short
from validation.scenes.description import description_lines
from validation.scenes.scene import Scene
from validation.simulation.model import Target

WIDTH = 100
"""Columns of a terminal."""
CAUSE, CLAUSE = ": ", "; "
"""Between a clause and its cause, and between clauses of a reason."""
ASSUMED = "elastic half-spaces, isotropic, without friction and adhesion"


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
        comparisons = listed(comparison)
        return "\n".join([*overview(comparisons), *help_with(comparisons)])
    understood = heading(comparison.scene, [comparison.quantity], comparison.tolerance)
    return f"{understood}\n{findings([comparison], in_full)}"


def heading(scene: Scene, quantities: Sequence[str], tolerance: Tolerance) -> str:
    """What was understood, before anything is solved: what is asked, bodies, contact, roughness, what is assumed."""
    described = description_lines(scene, moving=any(quantity_of(scene, key).of_motion for key in quantities))
    lines = [f"{scene.name}: {', '.join(quantities)} within {tolerance}", *described, f"  {'assumed':18s}  {ASSUMED}"]
    return "\n".join(part for line in lines for part in wrapped([line], indent=22 if line[0] == " " else 4))


def findings(comparisons: Sequence[Comparison], lines_of: Callable[[Sequence[Comparison]], Iterator[str]]) -> str:
    """Text of quantities that share their solves; both quantities of a rail have one table. lines_of: as `in_full`."""
    parts = [comparisons] if comparisons[0].roughness.size else [[comparison] for comparison in comparisons]
    lines = [line for part in parts for line in lines_of(part)]
    # no blank line below another
    single_spaced = [line for before, line in zip(["text", *lines], lines, strict=False) if line or before]
    return "\n".join(wrapped(single_spaced, indent=4))


def in_full(quantities: Sequence[Comparison]) -> Iterator[str]:
    """What became of each model and why, the result, what it rests on and cost, and whether MDR is enough."""
    comparison = quantities[0]
    best = comparison.selection.best
    yield from (*models_as_lines(comparison), "", *_reasons(comparison), "")
    if best is None or best.answer is None:
        yield no_answer(comparison)
        yield from side_by_side(comparison)
    else:
        yield from (result_of(quantity, best.answer) for quantity in quantities)
        yield from (line for line in (best.answer.counted, LEVELS if comparison.roughness.size else "") if line)
        yield from columns_as_lines(bands_of(comparison, best)) if comparison.is_level else ()
        if force := comparison.force:
            yield from ("", *force.sentences, *(f"  {line}" for line in columns_as_lines(force.table)), "")
        yield from side_by_side(comparison)
        yield from (age_of_errors(comparison), cost_of(comparison))
    yield from (*what_would_help(comparison), *on_mdr.in_full(comparison))


def models_as_lines(comparison: Comparison) -> Iterator[str]:
    """What became of each model."""
    spent = "took" if comparison.timed else "cost"
    yield from ("", f"{'model':36s}{'claims':>12s}{'found':>9s}{spent:>8s}  what became of it")
    for row in models_of_page(comparison):
        yield f"{row['model']:36s}{row['claims']:>12s}{row['found']:>9s}{row[spent]:>8s}  {row['became']}"


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
    return f"{both} {'in the bands that count' if answer.band_errors else 'over all bands'}"


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
    """Table of models, result, error and a sentence on MDR, of quantities that have the same solves and errors."""
    comparison = quantities[0]
    best = comparison.selection.best
    yield from models_as_lines(comparison)
    yield ""
    if best is not None and best.answer is not None and comparison.is_level:
        yield from (line for line in (best.answer.counted, LEVELS if comparison.roughness.size else "") if line)
        yield from columns_as_lines(bands_of(comparison, best))
    yield from side_by_side(comparison)
    yield from would_help(comparison)
    yield ""
    if best is None or best.answer is None:
        yield no_answer(comparison)
    else:
        yield from (_value_sentence(quantities, best.answer), _error_sentence(comparison, best.answer))
    yield on_mdr.in_short(comparison)


def _value_sentence(quantities: Sequence[Comparison], answer: Answer) -> str:
    """One number with its error, or how many bands there are, of a rail with the force that they leave."""
    comparison = quantities[0]
    name = comparison.quantity if len(quantities) == 1 else "both"
    of = f", {comparison.statistic}" if comparison.statistic else ""
    if not comparison.is_level:
        value = float(answer.value[0])
        return f"{name} = {scaled(value, value * answer.error)} {comparison.unit} by {comparison.model}{of}"
    force = comparison.force
    weighted = f", contact force {force.shown}" if force else ""
    return f"{name} by {comparison.model}: {comparison.value.size} bands{of}{weighted}"


def _error_sentence(comparison: Comparison, answer: Answer) -> str:
    """The error compared with the tolerance, and its parts: model, grid and sample."""
    tolerance = comparison.tolerance
    parts = {name: part for name in ("model", "grid", "sample") if (part := getattr(answer, name))}
    error = error_of_levels(comparison, answer) if comparison.is_level else tolerance.shown_distinct(answer.error)
    parts_text = ", ".join(f"{name} {tolerance.shown(part)}" for name, part in parts.items())
    parts_text = f": {parts_text}" if len(parts) > 1 else "".join(f"; all of it is the {name}'s" for name in parts)
    return f"error {error}, {'within' if comparison.met else 'not within'} {tolerance}{parts_text}"
