"""Whether springs are enough: from a solve, or said to be predicted."""

import math

from validation.advice.calibration import SHARE
from validation.advice.compare import Comparison
from validation.advice.hierarchy import Candidate, contradicting

SOLVES_IT = "not solved (--models mdr solves it)"


def springs_of(comparison: Comparison) -> Candidate | None:
    """Those that are selected, or were solved and are enough, or else have the smallest error; None without springs."""
    best, tolerance = comparison.selection.best, comparison.tolerance.relative

    def order(one: Candidate) -> tuple[bool, bool, float]:
        enough = is_solved(comparison, one) and one.error <= tolerance
        return one is not best, not enough, one.error

    return min((one for one in comparison.models if one.is_mdr), key=order, default=None)


def is_solved(comparison: Comparison, springs: Candidate) -> bool:
    """Whether they have an answer."""
    return any(springs is one for one in comparison.selection.solved)


def verdict(comparison: Comparison, springs: Candidate) -> tuple[str, str]:
    """Whether they are enough, in words that say where that is predicted alone, and why."""
    shown, limit = comparison.tolerance.shown_beside(springs.error), comparison.tolerance.relative
    of = f" ({comparison.statistic})" if comparison.statistic else ""
    if comparison.beyond_elasticity:
        return "not enough", comparison.beyond_elasticity
    if not math.isfinite(springs.error):
        return "not known to be enough", springs.reason
    if not is_solved(comparison, springs):
        enough = "predicted to be enough" if springs.error <= limit else "not sure to be enough"
        bound = "" if comparison.scene.error_source else f", an upper bound in {100 * SHARE:.0f} % of scenes"
        return enough, f"its predicted error{of} is {shown}{bound}; {SOLVES_IT}"
    if against := contradicting(comparison.selection, springs):
        return "not enough", f"{against.name}, with less bias, contradicts it"
    if springs.error > limit:
        return "not enough", f"its error{of} is {shown}"
    return "enough", "the result is its own" if springs is comparison.selection.best else f"its error{of} is {shown}"


def in_short(comparison: Comparison) -> str:
    """One sentence."""
    springs = springs_of(comparison)
    if springs is None:
        return "MDR has no springs for this scene"
    enough, why = verdict(comparison, springs)
    return f"MDR ({springs.name}) is {enough}: {why}"


def in_full(comparison: Comparison) -> list[str]:
    """A sentence a model of springs."""
    springs = [one for one in comparison.models if one.is_mdr]
    if not springs:
        return ["MDR: no springs are among the models of this scene."]
    return [f"MDR{f' ({one.name})' if len(springs) > 1 else ''}: {_of(comparison, one)}." for one in springs]


def _of(comparison: Comparison, springs: Candidate) -> str:
    enough, why = verdict(comparison, springs)
    best = comparison.selection.best
    cheaper = enough.endswith("enough") and best is not None and best.model is not springs.model and comparison.met
    others = f"; {best.name} is cheaper" if cheaper and best is not None and best.cost < springs.cost else ""
    return f"{enough}: {why} ({comparison.tolerance} wanted){others}"
