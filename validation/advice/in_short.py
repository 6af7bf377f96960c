"""What `compare` prints of a scene without `--verbose`: its models, its bands, and three lines that answer."""

from collections.abc import Iterator, Sequence

from validation.advice import on_mdr
from validation.advice.advice import would_help
from validation.advice.cells import scaled
from validation.advice.columns import bands_of, columns_as_lines, side_by_side
from validation.advice.compare import Comparison
from validation.advice.contact_force import LEVELS
from validation.advice.scene_model import Answer
from validation.advice.summary import error_of_levels, models_as_lines, no_answer


def in_short(quantities: Sequence[Comparison]) -> Iterator[str]:
    """Of quantities that have the same solves and errors."""
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
        yield from (_value(quantities, best.answer), _error(comparison, best.answer))
    yield on_mdr.in_short(comparison)


def _value(quantities: Sequence[Comparison], answer: Answer) -> str:
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


def _error(comparison: Comparison, answer: Answer) -> str:
    """Beside what was wanted, with its parts."""
    tolerance = comparison.tolerance
    parts = {name: part for name in ("model", "grid", "sample") if (part := getattr(answer, name))}
    found = error_of_levels(comparison, answer) if comparison.is_level else tolerance.shown_beside(answer.error)
    of = ", ".join(f"{name} {tolerance.shown(part)}" for name, part in parts.items())
    of = f": {of}" if len(parts) > 1 else "".join(f"; all of it is the {name}'s" for name in parts)
    return f"error {found}, {'within' if comparison.met else 'not within'} {tolerance}{of}"
