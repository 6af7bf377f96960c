"""What would help where no model meets the tolerance: keys and options that the scene has, with what they cost."""

import math
from collections.abc import Iterator
from dataclasses import replace

from validation.advice.calibration import SHARE
from validation.advice.compare import MOST_REALISATIONS, Comparison
from validation.advice.hierarchy import Candidate, contradicting
from validation.advice.scene_model import SAMPLE_SHARE
from validation.analysis.number_text import format_seconds
from validation.analysis.statistics import student
from validation.scenes.scene import INTERFACE, Scene
from validation.simulation.method import realisations

SOLVES_IT = "not solved (--models mdr solves it)"


def springs_of(comparison: Comparison) -> Candidate | None:
    """The springs that are selected, or were solved and are enough, or else have the smallest error; None without."""
    best, tolerance = comparison.selection.best, comparison.tolerance.relative

    def order(candidate: Candidate) -> tuple[bool, bool, float]:
        enough = is_solved(comparison, candidate) and candidate.error <= tolerance
        return candidate is not best, not enough, candidate.error

    return min((candidate for candidate in comparison.models if candidate.is_mdr), key=order, default=None)


def is_solved(comparison: Comparison, springs: Candidate) -> bool:
    """Whether the springs have an answer."""
    return any(springs is candidate for candidate in comparison.selection.solved)


def verdict(comparison: Comparison, springs: Candidate) -> tuple[str, str]:
    """Whether the springs are accurate enough, in words that say where that is predicted alone, and why."""
    shown, limit = comparison.tolerance.shown_distinct(springs.error), comparison.tolerance.relative
    of = f" ({comparison.statistic})" if comparison.statistic else ""
    if comparison.beyond_elasticity:
        return "not accurate enough", comparison.beyond_elasticity
    if not math.isfinite(springs.error):
        return "not known to be accurate enough", springs.reason
    if not is_solved(comparison, springs):
        enough = "predicted to be accurate enough" if springs.error <= limit else "not predicted to be accurate enough"
        bound = "" if comparison.scene.error_source else f", an upper bound in {100 * SHARE:.0f} % of scenes"
        return enough, f"its predicted error{of} is {shown}{bound}; {SOLVES_IT}"
    if against := contradicting(comparison.selection, springs):
        return "not accurate enough", f"{against.name}, with less bias, contradicts it"
    if springs.error > limit:
        return "not accurate enough", f"its error{of} is {shown}"
    return "accurate enough", "it is selected" if springs is comparison.selection.best else f"its error{of} is {shown}"


def in_short(comparison: Comparison) -> str:
    """The verdict on MDR in one sentence."""
    springs = springs_of(comparison)
    if springs is None:
        return f"MDR has no {_lacking(comparison) or 'springs for this scene'}"
    enough, why = verdict(comparison, springs)
    return f"MDR ({springs.name}) is {enough}: {why}"


def _lacking(comparison: Comparison) -> str:
    """The quantity that MDR has of no scene; empty for any other."""
    return comparison.quantity.replace("-", " ") if comparison.quantity in map(str, INTERFACE) else ""


def in_full(comparison: Comparison) -> list[str]:
    """The verdict on MDR, a sentence for each model of springs."""
    springs = [candidate for candidate in comparison.models if candidate.is_mdr]
    if not springs:
        if lacking := _lacking(comparison):
            return [f"MDR: its springs have no neighbours, and it has no {lacking}."]
        return ["MDR: no springs are among the models of this scene."]
    return [
        f"MDR{f' ({candidate.name})' if len(springs) > 1 else ''}: {_sentence(comparison, candidate)}."
        for candidate in springs
    ]


def _sentence(comparison: Comparison, springs: Candidate) -> str:
    """The verdict with the tolerance, and the model of the result where that is cheaper."""
    enough, why = verdict(comparison, springs)
    best = comparison.selection.best
    cheaper = enough.endswith("enough") and best is not None and best.model is not springs.model and comparison.met
    remark = f"; {best.name} is cheaper" if cheaper and best is not None and best.cost < springs.cost else ""
    return f"{enough}: {why} ({comparison.tolerance} wanted){remark}"


ROUND = 2
"""Digits of a number of realisations that is advised."""


def what_would_help(comparison: Comparison) -> Iterator[str]:
    """Where no model meets the tolerance: the error that is left, and `would_help`."""
    best, tolerance = comparison.selection.best, comparison.tolerance
    if best is not None and best.answer is not None and not (comparison.met or comparison.beyond_elasticity):
        yield f"not reached: the tolerance of {tolerance}; the error is {tolerance.shown_distinct(best.error)}"
    yield from would_help(comparison)


def would_help(comparison: Comparison) -> Iterator[str]:
    """The tolerance that would be met, and what most of the error is due to; nothing where one is met."""
    best, tolerance = comparison.selection.best, comparison.tolerance
    if comparison.met:
        return
    if comparison.beyond_elasticity:
        yield f"no answer: {comparison.beyond_elasticity}"
        return
    unasked = (
        candidate
        for candidate in comparison.models
        if candidate.status == "not asked" and candidate.predicted_error <= tolerance.relative
    )
    cheapest = next(unasked, None)
    unasked_model = cheapest and (
        f"{cheapest.name}, which was not asked, with a predicted error of {tolerance.shown(cheapest.predicted_error)}"
    )
    if best is None or best.answer is None:
        if comparison.models:
            other_scene = f"a scene for which this does not hold: {comparison.models[-1].reason}"
            yield f"what would help: {unasked_model or other_scene}"
        return
    if (error_of_scene := best.estimate.of_scene) > min(tolerance.relative, best.answer.error / 2):
        stated = best.model.model.helps(best.model.target)
        yield (
            f"what would help: {stated}: the ground leaves ± {tolerance.shown(error_of_scene)}, "
            f"whatever the model; or a tolerance of {tolerance.shown(1.05 * best.answer.error)}"
        )
        return
    larger_sample = more_realisations(comparison)
    remedies = "; or ".join(
        part
        for part in (unasked_model, larger_sample, f"a tolerance of {tolerance.shown(1.05 * best.answer.error)}")
        if part
    )
    yield f"what would help: {remedies}; most of the error is {_main_cause(comparison.scene, best)}"


def more_realisations(comparison: Comparison) -> str:
    """How many realisations would do, and how long they take; empty where no number does."""
    for candidate in sorted(comparison.selection.with_error, key=lambda candidate: candidate.solved_answer.error):
        count = sufficient_realisations(candidate, comparison.tolerance.relative)
        if count:
            seconds = replace(candidate.model, realisations=count).cost().seconds
            cost = f"about {format_seconds(seconds)} ({candidate.solved_answer.realisations} were solved)"
            return f"{count} realisations by {candidate.name}, {cost}: --realisations {count}"
    return ""


def sufficient_realisations(candidate: Candidate, tolerance: float) -> int:
    """Number of realisations that leave most of the tolerance; zero where more of them do not help.

    N = (2 s / (0.9 (t - m)))^2, s of one realisation, t the tolerance, m what the model leaves. What is left by a grid
    is compared on more surfaces, too, where it is less than what the sample leaves.
    """
    answer, left = candidate.solved_answer, tolerance - candidate.solved_answer.model
    if not candidate.model.is_sampled or left <= 0 or answer.sample <= answer.grid or answer.realisations < 2:
        return 0
    scatter = answer.sample * math.sqrt(answer.realisations) / student(answer.realisations - 1)
    count = realisations(scatter, SAMPLE_SHARE * left, least=answer.realisations + 1, most=MOST_REALISATIONS + 1)
    step = 10 ** max(0, math.floor(math.log10(count)) + 1 - ROUND)
    rounded = step * math.ceil(count / step)
    return rounded if rounded <= MOST_REALISATIONS else 0


def _main_cause(scene: Scene, best: Candidate) -> str:
    """What most of the error of a model is due to, and what has less of it."""
    answer = best.solved_answer
    causes = {
        f"the model's{_help_for_model(scene)}": answer.model,
        f"left by the grid: {_help_for_grid(scene)}": answer.grid,
        "the sample's: the scatter of the surfaces that are drawn": answer.sample,
    }
    return max(causes, key=causes.__getitem__)


def _help_for_model(scene: Scene) -> str:
    """What lowers the error of a model: lower roughness, where that is drawn; measured roughness is as it is."""
    if scene.ground is None or scene.ground.is_single:
        return ""
    return ": lower roughness has less"


def _help_for_grid(scene: Scene) -> str:
    """What lowers the error of a grid, in words."""
    if not scene.roughness_key:
        return "cells of a strip"
    if scene.ground is not None and scene.ground.is_single:
        return "heights on more points have less"
    return f"longer waves (`shortest` in [{scene.roughness_key}]) have less"
