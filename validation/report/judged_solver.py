"""What a person reads of a contact solver: right or wrong and why, how near, how fast."""

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from importlib import metadata

from validation.analysis.judgement import AGREE, JudgedPoint

SHOWN = 5
"""Reasons, and problems of each."""
COLUMNS = ("complementarity", "penetration", "force balance", "approach", "force", "pressure")


def solver_lines(model: str, points: Sequence[JudgedPoint], seconds: float) -> Iterator[str]:
    """Of one solver. points: those that decide, and times."""
    checks, times = ([point for point in points if point.decides is kind] for kind in (True, False))
    wrong = [point for point in checks if point.verdict != AGREE]
    said = f"wrong in {len(wrong)} of {len(checks)} checks" if wrong else f"right in all {len(checks)} checks"
    yield f"{model}: contact solver, {said}, {seconds:.1f} s"
    yield from (f"  {line}" for line in reasons(wrong))
    yield from ["", *table_of_problems(checks)]
    if timed := [point for point in times if point.value > 0 and point.reference > 0]:
        yield from ["", "seconds beside bem3d, same grid and residual, one thread each:"]
        yield from (
            f"  {point.where['cells']:.0f}²{point.value:12.3g} s{point.value / point.reference:9.2g} times"
            for point in timed
        )
        yield f"  {growth(timed)}" if len(timed) > 1 else ""
    yield from ["", "For a paper:", f"  {sentence(model, checks, wrong)}"]


def reasons(wrong: Sequence[JudgedPoint]) -> Iterator[str]:
    """The commonest first, each with what shows it and where."""
    known = Counter(point.reason for point in wrong)
    for reason, _ in known.most_common(SHOWN):
        mine = [point for point in wrong if point.reason == reason]
        quantities = ", ".join(dict.fromkeys(point.quantity for point in mine))
        places = list(dict.fromkeys(str(point.where["problem"]) for point in mine))
        more = f" and {len(places) - SHOWN} more" if len(places) > SHOWN else ""
        yield f"{reason or 'not the answer'}: {quantities}, in {'; '.join(places[:SHOWN])}{more}"
    if len(known) > SHOWN:
        yield f"and {len(known) - SHOWN} other reasons"


def table_of_problems(checks: Sequence[JudgedPoint]) -> Iterator[str]:
    """A row a problem: how far off each number is; then the properties."""
    there = [name for name in COLUMNS if any(point.quantity == name for point in checks)]
    yield f"{'off by':40s}" + "".join(f"{name:>16s}" for name in there)
    for problem in dict.fromkeys(str(point.where["problem"]) for point in checks):
        mine = {p.quantity: p for p in checks if p.where["problem"] == problem and p.quantity in there}
        if mine:
            yield f"  {problem:38s}" + "".join(f"{_off(mine.get(name)):>16s}" for name in there)
    others = [point for point in checks if point.quantity not in (*COLUMNS, "tension", "answer")]
    for name in dict.fromkeys(point.quantity for point in others):
        held = all(point.verdict == AGREE for point in others if point.quantity == name)
        yield f"  {name:38s}{'holds' if held else 'does not hold':>16s}"


def _off(point: JudgedPoint | None) -> str:
    if point is None:
        return ""
    return f"{abs(point.difference):.1e}{'' if point.verdict == AGREE else ' !'}"


def growth(timed: Sequence[JudgedPoint]) -> str:
    """Between the two finest grids."""
    before, after = timed[-2:]
    cells = [float(point.where["cells"]) ** 2 for point in (before, after)]
    power = math.log(after.value / before.value) / math.log(cells[1] / cells[0])
    ours = math.log(after.reference / before.reference) / math.log(cells[1] / cells[0])
    return f"its time grows as the number of cells to the power {power:.2g}, that of bem3d {ours:.2g}"


def sentence(model: str, checks: Sequence[JudgedPoint], wrong: Sequence[JudgedPoint]) -> str:
    count = len({point.where["problem"] for point in checks})
    version = metadata.version("mdr-validation")
    if not wrong:
        return (
            f"{model!r} solves the {count} discrete problems of mdr-validation {version} to its residual, by an "
            "operator that is not its own."
        )
    failed = len({point.where["problem"] for point in wrong})
    return f"{model!r} is wrong on {failed} of the {count} discrete problems of mdr-validation {version}."
