"""The text that `compare` prints: what was understood, what became of each model, the result, whether MDR is enough."""

import math
import textwrap
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from validation.analysis.evidence import plus_minus
from validation.scenes.description import description_lines
from validation.scenes.indentation import IndentationScene
from validation.scenes.load import Scene
from validation.scenes.measured import MeasuredHeights
from validation.scenes.rail import RailScene
from validation.scenes.rolling import RollingScene
from validation.selection.calibrate import calibration_age
from validation.selection.compare import Comparison, OneOrSeveral, listed
from validation.selection.contact_force import LEVELS, contact_force
from validation.selection.hierarchy import Answer, Candidate, Status
from validation.selection.quantities import MOVING, UNITS
from validation.selection.rail_model import what_would_state_the_ground
from validation.selection.reasons import grouped
from validation.selection.side_by_side import axis_of, columns_as_lines, side_by_side
from validation.selection.tolerance import Tolerance, short
from validation.simulation.model import Target
from validation.simulation.rail_models import MEASURED_ON_STRIPS, rail_quantity

FloatArray = NDArray[np.float64]

WIDTH = 100
"""Columns of a terminal."""
ASSUMED = "elastic half-spaces, isotropic, without friction and adhesion"
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


def summary(comparison: OneOrSeveral) -> str:
    """Text of a comparison: the scene, what became of each model, the result with its error, a sentence on MDR.

    Parameters
    ----------
    comparison : Comparison or list of Comparison
        What `compare` returns; of a list, a line a scene, and what would help those whose tolerance is not met.

    Returns
    -------
    str
        The lines that the command ``mdr-validation compare`` prints.

    Examples
    --------
    >>> text = validation.summary(validation.compare(validation.load_scene("sphere")))
    >>> print(text.splitlines()[0])
    Smooth sphere: stiffness within 10 %
    """
    if not isinstance(comparison, Comparison):
        from validation.selection.several import help_with, overview  # which are made of this module's words

        found = listed(comparison)
        return "\n".join([*overview(found), *help_with(found)])
    understood = heading(comparison.scene, [comparison.quantity], comparison.tolerance)
    return f"{understood}\n{findings([comparison])}"


def heading(scene: Scene, quantities: Sequence[str], tolerance: Tolerance) -> str:
    """What was understood, before anything is solved: what is asked, bodies, contact, roughness, what is assumed."""
    described = description_lines(scene, moving=any(quantity in MOVING for quantity in quantities))
    lines = [f"{scene.name}: {', '.join(quantities)} within {tolerance}", *described, f"  {'assumed':18s}  {ASSUMED}"]
    return "\n".join(part for line in lines for part in wrapped([line], indent=22 if line[0] == " " else 4))


def findings(comparisons: Sequence[Comparison]) -> str:
    """What became of each model, the result, and whether MDR is enough; both quantities of a rail have one table."""
    parts = [comparisons] if comparisons[0].roughness.size else [[one] for one in comparisons]
    lines = [line for part in parts for line in _lines(part)]
    # no blank line below another
    apart = [line for before, line in zip(["text", *lines], lines, strict=False) if line or before]
    return "\n".join(wrapped(apart, indent=4))


def _lines(quantities: Sequence[Comparison]) -> Iterator[str]:
    """Of quantities that have the same solves and errors."""
    comparison = quantities[0]
    best, spent = comparison.selection.best, "took" if comparison.timed else "cost"
    yield from ("", f"{'model':36s}{'claims':>12s}{'found':>9s}{spent:>8s}  what became of it")
    yield from (*_rows(comparison), "", *_reasons(comparison), "")
    if best is None or best.answer is None:
        yield f"no model has {'a known error' if comparison.selection.solved else 'a result'}"
        yield from side_by_side(comparison)
    else:
        yield from (result_of(one, best.answer) for one in quantities)
        yield from (line for line in (best.answer.counted, LEVELS if comparison.roughness.size else "") if line)
        yield from columns_as_lines(bands_of(comparison, best)) if comparison.is_level else ()
        if force := contact_force(comparison):
            yield from ("", *force.sentences, *(f"  {line}" for line in columns_as_lines(force.table)), "")
        yield from side_by_side(comparison)
        yield from (age_of_errors(comparison), cost_of(comparison))
    yield from (*what_would_help(comparison), *sentences_on_mdr(comparison))


def label(candidate: Candidate) -> str:
    """The name of a model, and whether it is MDR."""
    return f"{candidate.name} (MDR)" if candidate.model.is_mdr else candidate.name


def sentences_on_mdr(comparison: Comparison) -> list[str]:
    """Whether springs by the method of dimensionality reduction are enough: one a model of them."""
    springs = [one for one in comparison.models if one.model.is_mdr]
    if not springs:
        return ["MDR: no springs are among the models of this scene."]
    names = ["MDR"] if len(springs) == 1 else [f"MDR, {one.name}" for one in springs]
    return [f"{name}: {_on_mdr(comparison, one)}." for name, one in zip(names, springs, strict=True)]


def _on_mdr(comparison: Comparison, springs: Candidate) -> str:
    tolerance, selection = comparison.tolerance, comparison.selection
    if not math.isfinite(springs.error):
        return "not known to be enough"
    shown = tolerance.shown_beside(springs.error)
    if springs.answer is None:
        errors = f"for {_asked_of(comparison.scene)} ({shown} claimed before a solve, {tolerance} wanted)"
    else:
        errors = f"({shown} found, {tolerance} wanted)"
    if springs.error > selection.tolerance:
        return f"not enough {errors}"
    cheaper = selection.best
    others = f"; {cheaper.name} is cheaper" if cheaper is not None and cheaper.model is not springs.model else ""
    return f"enough {errors}{others}"


def _asked_of(scene: Scene) -> str:
    """What a claim is about: one surface that was measured, or one scene; a report finds the mean over surfaces."""
    heights = scene.roughness if isinstance(scene, RailScene) else scene.ground
    return "this surface" if isinstance(heights, MeasuredHeights) else "this scene"


def claim_of(comparison: Comparison, one: Candidate) -> str:
    """The error that a model claims, in the unit of the tolerance."""
    return comparison.tolerance.shown(one.claimed) if one.estimate.in_range else "out of range"


def found_of(comparison: Comparison, one: Candidate) -> str:
    """The error that a solve left, in the unit of the tolerance."""
    return "—" if one.answer is None else comparison.tolerance.shown_beside(one.error)


def became_of(one: Candidate) -> str:
    """What became of a model, in words."""
    return BECAME[one.status] if one.answer is None else BECAME[one.status].replace("not solved", "solved")


def _rows(comparison: Comparison) -> Iterator[str]:
    """A line a model; what a solve took where all were timed, else what it costs."""
    for one in comparison.models:
        claimed, found = claim_of(comparison, one), found_of(comparison, one)
        spent = took_by(comparison, one) if comparison.timed else format_seconds(one.cost)
        yield f"{label(one):36s}{claimed:>12s}{found:>9s}{spent:>8s}  {became_of(one)}"


def took_by(comparison: Comparison, one: Candidate) -> str:
    """Seconds of a solve by the clock."""
    seconds = comparison.seconds_of(one)
    return ("< 1 ms" if seconds < 1e-3 else format_seconds(seconds)) if math.isfinite(seconds) else "—"


def _reasons(comparison: Comparison) -> Iterator[str]:
    """What errors rest on, each clause once."""
    yield "why"
    every = tuple(one.name for one in comparison.models)
    for names, reason in grouped({one.name: one.reason for one in comparison.models}):
        yield f"  {'all' if names == every and len(every) > 1 else '; '.join(names)}: {reason}"


def result_of(comparison: Comparison, answer: Answer) -> str:
    """The number with its error, or the model of a spectrum with its error, and the parts of that."""
    shown = comparison.tolerance.shown
    parts = f"model {shown(answer.model)}, grid {shown(answer.grid)}, sample {shown(answer.sample)}"
    if not comparison.is_level:
        value = float(answer.value[0])
        number = f"{scaled(value, value * answer.error)} {comparison.unit}"
        return f"{comparison.quantity} = {number} ({shown(answer.error)}: {parts}), by {comparison.model}"
    decibels = f"{short(20 * math.log10(1 + answer.error))} dB"
    both = decibels if comparison.in_decibels else f"{shown(answer.error)}, {decibels},"
    where = "in the bands that count" if answer.band_errors else "over all bands"
    return f"{comparison.quantity} by {comparison.model}, one-third octaves, ± {both} {where} ({parts})"


def bands_of(comparison: Comparison, one: Candidate) -> dict[str, list[str]]:
    """A row a band: wavelength, frequency, q a, root mean square, levels and their error, as the scene has them."""
    scene, unit, answer = comparison.scene, UNITS[comparison.quantity], one.answer
    assert answer is not None  # of a model that was solved
    columns = axis_of(comparison)
    if isinstance(scene, RailScene):
        return columns | _levels_of_rail(comparison, one)
    if isinstance(scene, RollingScene):
        columns["q a"] = [f"{q * scene.contact_radius:.2f}" for q in comparison.wavenumbers]
        columns[f"rms [{unit}]"] = [f"{value:.4g}" for value in answer.value]
    columns[f"level [{comparison.unit}]"] = _decibels(comparison.value_of(one))
    return columns | {"± [dB]": _half_widths(comparison, one)}


def _levels_of_rail(comparison: Comparison, one: Candidate) -> dict[str, list[str]]:
    """`LEVELS`, and the error of the filter; the force where the wheel has a speed."""
    a3, roughness, force = comparison.a3_of(one), comparison.roughness, contact_force(comparison)
    levels = {"L_r": roughness, "A3": a3, "L_eq": roughness + a3}
    columns = {name: _decibels(of) for name, of in levels.items()} | {"± [dB]": _half_widths(comparison, one)}
    return columns | ({"L_FA": _decibels(force.levels[one.name])} if force else {})


def _decibels(levels: FloatArray) -> list[str]:
    """To a tenth, without the sign of a zero."""
    return [f"{round(float(level), 1) + 0.0:.1f}" if math.isfinite(level) else "—" for level in levels]


def _half_widths(comparison: Comparison, one: Candidate) -> list[str]:
    return [f"{half:.2g}" if math.isfinite(half) else "unknown" for half in comparison.errors_of(one)]


def age_of_errors(comparison: Comparison) -> str:
    """Where the errors of the models are from."""
    if isinstance(comparison.scene, RailScene):
        return MEASURED_ON_STRIPS
    if isinstance(comparison.scene, IndentationScene) and comparison.scene.ground is None:
        return "errors of models: closed forms are exact for smooth bodies, no measured error is used"
    return calibration_age(target=Target(comparison.scene, comparison.quantity))


def cost_of(comparison: Comparison) -> str:
    """What the solves cost, and what those would have cost that were not needed."""
    spent = format_seconds(comparison.selection.spent)
    text = f"cost of the solves: about {spent}, from counted operations, without program start"
    saved = sum(one.cost for one in comparison.models if one.answer is None and one.status != "out of range")
    return f"{text}; the models that were not solved would have cost {format_seconds(saved)}" if saved else text


def what_would_help(comparison: Comparison) -> Iterator[str]:
    """Where no model meets the tolerance: the tolerance that would be met, and what most of the error is due to."""
    best, tolerance = comparison.selection.best, comparison.tolerance
    if comparison.met:
        return
    others = [one for one in comparison.models if one.status == "not asked" and one.claimed <= tolerance.relative]
    other = others and f"{others[0].name}, which was not asked and claims {tolerance.shown(others[0].claimed)}"
    if best is None or best.answer is None:
        if comparison.models:
            yield f"what would help: {other or _another_scene(comparison)}"
        return
    yield f"not reached: the tolerance of {tolerance}; the smallest error is {tolerance.shown_beside(best.error)}"
    if (left := best.estimate.of_scene) > min(tolerance.relative, best.answer.error / 2):
        asked = rail_quantity(Target(comparison.scene, comparison.quantity))
        yield (
            f"what would help: {what_would_state_the_ground(asked)}: the ground leaves ± {tolerance.shown(left)}, "
            f"whatever the model; or a tolerance of {tolerance.shown(1.05 * best.answer.error)}"
        )
        return
    causes = {
        "the model's: lower roughness has less": best.answer.model,
        "left by the grid: longer waves (`shortest`), or heights on more points, have less": best.answer.grid,
        "the scatter of the surfaces that are drawn": best.answer.sample,
    }
    met = f"{other}; or " if other else ""
    met += f"a tolerance of {tolerance.shown(1.05 * best.answer.error)}"
    yield f"what would help: {met}; most of the error is {max(causes, key=causes.__getitem__)}"


def _another_scene(comparison: Comparison) -> str:
    return f"a scene for which this does not hold: {comparison.models[-1].reason}"


def wrapped(lines: list[str], indent: int) -> Iterator[str]:
    """Lines of the width at the most; what goes on in the next line is indented."""
    for line in lines:
        own = line[: len(line) - len(line.lstrip())]
        more = " " * max(indent, len(own))
        whole = len(line) <= WIDTH
        yield from [line] if whole else textwrap.wrap(line.strip(), WIDTH, initial_indent=own, subsequent_indent=more)


def scaled(value: float, error: float) -> str:
    """With its error, over a power of ten where that is far from one: (5.49 ± 0.50)e7."""
    power = math.floor(math.log10(value))
    if -3 < power < 4:
        return plus_minus(value, error)
    shown = plus_minus(value / 10**power, error / 10**power)
    return f"({shown})e{power}" if "±" in shown else f"{shown}e{power}"


def format_seconds(seconds: float) -> str:
    """In a unit that fits."""
    for unit, size in (("h", 3600.0), ("min", 60.0), ("s", 1.0), ("ms", 1e-3)):
        if seconds >= size:
            return f"{short(seconds / size)} {unit}"
    return "1 ms"
