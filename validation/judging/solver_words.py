"""What a person reads of a contact solver: right or wrong and why, how near, how fast."""

import math
from collections.abc import Iterator, Sequence
from importlib import metadata
from typing import TYPE_CHECKING

from validation.judging.judgement import AGREE, REFUSED, JudgedPoint, placed

if TYPE_CHECKING:
    from validation.judging.solvers.judged import SolverTime

SHOWN = 5
"""Reasons, and problems of each."""
COLUMNS = ("complementarity", "penetration", "force balance", "approach", "force", "pressure")
NO_ROW = (*COLUMNS, "tension", "answer", "conditions")
UNEXPLAINED = dict.fromkeys(
    (
        "more than the residual that it names",
        "off by more than the residual that it names allows",
        "force not held",
        "the pressure is another one",
        "the contact shrinks under more load",
        "it falls under more load",
        "the error does not fall with the cell size",
    ),
    1,
)
"""Reasons that are no cause: what is measured."""


def solver_lines(
    model: str, points: Sequence[JudgedPoint], times: Sequence["SolverTime"], seconds: float
) -> Iterator[str]:
    """Of one solver."""
    rest, checks = [point for point in points if not point.decides], [point for point in points if point.decides]
    unserved = [point for point in rest if point.verdict == REFUSED]
    wrong = [point for point in checks if point.verdict != AGREE]
    said = f"wrong in {len(wrong)} of {len(checks)} checks" if wrong else f"right in all {len(checks)} checks"
    said = said if checks else "without an answer"
    more = f", {len(unserved)} not served" if unserved else ""
    yield f"{model}: contact solver, {said}{more}, {seconds:.1f} s"
    yield from reasons(wrong)
    yield from not_served(unserved, checks)
    yield from (
        f"  {', '.join(filter(None, [p.quantity, placed(p.where)]))}: {p.reason}" for p in rest if p not in unserved
    )
    yield from ["", *table_of_problems(checks)]
    if times:
        yield "\nseconds beside bem3d, same grid and residual, one thread and its set-up each:"
        yield from (f"  {t.cells:.0f}²{t.seconds:12.3g} s{t.seconds / t.bem3d:9.2g} times" for t in times)
    if len(times) > 1:
        mine, ours = (growth(times, name) for name in ("seconds", "bem3d"))
        yield f"  its time grows as the number of cells to the power {mine:.2g}, that of bem3d {ours:.2g}"
    yield from ["\nFor a paper:", f"  {for_a_paper(model, wrong, checks, unserved)}"]


def for_a_paper(
    model: str, wrong: Sequence[JudgedPoint], checks: Sequence[JudgedPoint], unserved: Sequence[JudgedPoint]
) -> str:
    """A sentence that goes no further than what was asked."""
    failed, asked = len(_problems(wrong)), len(_problems(checks))
    what = f"is wrong on {failed} of the {asked}" if wrong else f"solves the {asked}" if asked else "solves none of the"
    how = "" if wrong or not asked else " to its residual, by an operator that is not its own"
    left = f"; {len(_problems(unserved) - _problems(checks))} others it does not serve" if unserved else ""
    periodic = {"periodic" in name for name in _problems(checks)}
    of = "" if len(periodic) != 1 else " of periodic half-spaces" if True in periodic else " of free half-spaces"
    return f"{model!r} {what} discrete problems{of} of mdr-validation {metadata.version('mdr-validation')}{how}{left}."


def not_served(unserved: Sequence[JudgedPoint], checks: Sequence[JudgedPoint]) -> Iterator[str]:
    """What a solver declares that it does not serve, and what the verdict covers then."""
    if not unserved:
        return
    lost, asked = _problems(unserved), _problems(checks)
    left = {"of {} others": len(lost - asked), "of {} in part": len(lost & asked)}
    silent = ", and ".join(words.format(count) for words, count in left.items() if count)
    yield f"  the verdict covers {len(asked)} problems that the solver serves; {silent} it says nothing"
    yield from reasons(unserved)


def _reasons(points: Sequence[JudgedPoint]) -> list[str]:
    return list(dict.fromkeys(point.reason for point in points))


def _problems(points: Sequence[JudgedPoint]) -> set[str]:
    return {str(point.where["problem"]) for point in points}


def reasons(wrong: Sequence[JudgedPoint]) -> Iterator[str]:
    """Causes before what is shown without one, that of most problems first, each with what shows it and where."""
    problems = {reason: {p.where["problem"] for p in wrong if p.reason == reason} for reason in _reasons(wrong)}
    known = sorted(problems, key=lambda reason: (UNEXPLAINED.get(reason, 0), -len(problems[reason])))
    for reason in known[:SHOWN]:
        mine = [point for point in wrong if point.reason == reason]
        quantities = ", ".join(dict.fromkeys(point.quantity for point in mine))
        places = list(dict.fromkeys(str(point.where["problem"]) for point in mine))
        more = f" and {len(places) - SHOWN} more" if len(places) > SHOWN else ""
        yield f"  {reason}: {quantities}, in {'; '.join(places[:SHOWN])}{more}"
    if len(known) > SHOWN:
        yield f"  and {len(known) - SHOWN} other reasons"


def table_of_problems(checks: Sequence[JudgedPoint]) -> Iterator[str]:
    """A row a problem: how far off each number is; then the properties."""
    there = [name for name in COLUMNS if any(point.quantity == name for point in checks)]
    yield f"{'off by':40s}" + "".join(f"{name:>16s}" for name in there)
    for problem in dict.fromkeys(str(point.where["problem"]) for point in checks):
        mine = {p.quantity: p for p in checks if p.where["problem"] == problem and p.quantity in there}
        if mine:
            yield f"  {problem:38s}" + "".join(f"{_off(mine.get(name)):>16s}" for name in there)
    others = [point for point in checks if point.quantity not in NO_ROW]
    for name in dict.fromkeys(point.quantity for point in others):
        held = all(point.verdict == AGREE for point in others if point.quantity == name)
        yield f"  {name:38s}{'holds' if held else 'does not hold':>16s}"


def _off(point: JudgedPoint | None) -> str:
    return f"{abs(point.difference):.1e}{'' if point.verdict == AGREE else ' !'}" if point else ""


def growth(times: Sequence["SolverTime"], what: str) -> float:
    """Power of the number of cells, between the two finest grids."""
    before, after = times[-2:]
    ratio = getattr(after, what) / getattr(before, what)
    return math.log(ratio) / math.log(after.cells / before.cells) / 2
