"""Claims about solvers: that ours is the fastest, by its times beside those of the others, and that all agree."""

from collections.abc import Sequence

from validation.analysis.answers import answered
from validation.analysis.evidence import JudgedClaim, Number, Role, Verdict
from validation.analysis.wording import share
from validation.benchmarks.peers import OUR_SOLVER, SOLVERS, peers_installed, place_of
from validation.benchmarks.solvers.case import SolverComparisonResult
from validation.benchmarks.timing import FINISHED

CLAIM = "Our solver is the fastest at the same residual."
SAME_PRESSURE = "Different solvers of the same discrete problem find the same pressure."


def speed_numbers(result: SolverComparisonResult) -> tuple[Number, ...]:
    """Our time over that of the fastest other solver, for each problem: above one another solver is faster."""
    found, us = [], place_of(OUR_SOLVER)
    for problem, outcome in result.problems:
        rivals = [i for i in range(len(SOLVERS)) if i != us and outcome["status"][i] == FINISHED]
        if outcome["status"][us] != FINISHED or not rivals:
            continue
        rival = min(rivals, key=lambda i: float(outcome["seconds"][i, 0]))
        ours, other = outcome["seconds"][[us, rival], 0]
        (low, high), (rival_low, rival_high) = outcome["interval"][[us, rival]]
        ratio = float(ours / other)
        found.append(
            Number(
                quantity="time over that of the fastest other solver",
                model=OUR_SOLVER,
                where={"problem": problem.label},
                value=ratio,
                reference=0.0,
                source=SOLVERS[rival].name,
                tolerance=1.0,
                reason="above one another solver is faster",
                sample=float(max(high / rival_low - ratio, ratio - low / rival_high)),
                role=Role.FINDING,
            )
        )
    return tuple(found)


def claims_of(
    result: SolverComparisonResult, speed: Sequence[Number], agreement: Sequence[Number]
) -> tuple[JudgedClaim, ...]:
    return (
        *((_fastest(result, speed),) if speed else ()),
        *((answered(SAME_PRESSURE, agreement, _largest(agreement)),) if agreement else ()),
    )


def headline(speed: Sequence[Number]) -> str:
    """On how many problems our solver is the fastest, undecided ones apart."""
    undecided = sum(number.verdict is Verdict.UNDECIDED for number in speed)
    rest = f", undecided on {undecided}" if undecided else ""
    return f"Our solver is the fastest on {share(speed, Verdict.AGREE)} problems{rest}"


def _fastest(result: SolverComparisonResult, speed: Sequence[Number]) -> JudgedClaim:
    cells = {problem.label: problem.cells for problem, _ in result.problems}
    size = {number.label: cells[str(number.where["problem"])] for number in speed}
    undone = [size[number.label] for number in speed if number.verdict is not Verdict.AGREE]
    inside = tuple(number for number in speed if size[number.label] > max(undone, default=0))
    limits = f"from {min(size[number.label] for number in inside)}² cells on" if undone and inside else ""
    faster, slower = (sum(number.verdict is v for number in speed) for v in (Verdict.AGREE, Verdict.DIFFER))
    least, most = (extreme(speed, key=lambda number: number.value) for extreme in (min, max))
    rivals = ", ".join(dict.fromkeys(number.source for number in speed))
    none = "" if peers_installed() else "; no other package is installed"
    answer = (
        f"it is faster on {faster} of {len(speed)} problems, slower on {slower}; its time is {least.value:.2g} to "
        f"{most.value:.2g} of that of the fastest other solver ({rivals}), the largest part on {most.where['problem']}"
        f"{none}."
    )
    return answered(CLAIM, speed, answer, limits=limits, inside=inside if limits else ())


def _largest(agreement: Sequence[Number]) -> str:
    worst = max(agreement, key=lambda number: number.value / number.tolerance)
    return (
        f"of pressures, forces and areas, {worst.quantity} of {worst.model} is the largest beside its tolerance, "
        f"{worst.value:.1g} and {worst.tolerance:.0g}."
    )
