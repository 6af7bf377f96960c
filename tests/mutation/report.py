"""What has become of mutants, as a table to read."""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum

from scipy import stats

from tests.mutation.mutants import Mutant


class Outcome(StrEnum):
    """Of a mutant: a test has failed; the tests have taken far too long; none has noticed."""

    KILLED = "killed"
    TIMED_OUT = "timed out"
    SURVIVED = "survived"


@dataclass(frozen=True)
class Survey:
    """What has become of those tried, of all mutants; the seed of a sample, None where all were tried; and the seconds
    of tests that each was met by at most."""

    trials: list[tuple[Mutant, Outcome]]
    everything: list[Mutant]
    seed: int | None
    seconds: float


def table(survey: Survey, reasons: dict[str, dict[str, str]]) -> str:
    """The score file by file, and the survivors with their reasons, by file and by what they are called."""
    left = [mutant for mutant, outcome in survey.trials if outcome is Outcome.SURVIVED]
    why = {mutant: reasons.get(mutant.path, {}).get(mutant.key, "") for mutant in left}
    rows = [[m.path, m.scope, f"`{m.change}`", reason or "**no test notices**"] for m, reason in why.items()]
    lines = [
        *_introduction(survey, len(left), sum(map(bool, why.values()))),
        *["", "| file | mutants | tried | killed | timed out | survived | gone |", "|---|--:|--:|--:|--:|--:|--:|"],
        *(_score(path, survey) for path in sorted({mutant.path for mutant in survey.everything})),
        *[_score("", survey), "", "## Survivors", ""],
        *(["| file | where | change | why it lives |", "|---|---|---|---|"] if left else ["None."]),
        *map(_row, rows),
    ]
    return "\n".join([*lines, ""])


def _introduction(survey: Survey, left: int, excused: int) -> list[str]:
    tried, everything = len(survey.trials), len(survey.everything)
    gone = tried - left
    low, high = stats.binomtest(gone, tried).proportion_ci(method="wilson")
    which, interval = f"All {everything} were tried", ""
    if survey.seed is not None:
        which = f"{tried} of {everything} were tried, drawn at random with the seed {survey.seed}"
        interval = f", {low:.1%} to {high:.1%} with 95 % confidence (Wilson) for all of them"
    return [
        "# Mutants",
        "",
        "Written by `make mutation`. A mutant is the code with one small change: an operator, a comparison, a number,",
        "a condition, a value that is returned, a call or an assignment left out",
        "(`tests/mutation/mutants.py`). It is killed",
        f"where a test fails, and met by tests of {survey.seconds:g} s in all: the quickest that execute its lines.",
        "",
        f"**{which}; {gone} of them were killed or timed out: {gone / tried:.1%}{interval}.**",
        f"Of the {left} survivors {excused} change no answer, for the reasons below: without them",
        f"{gone / (tried - excused):.1%} are gone.",
    ]


def _score(path: str, survey: Survey) -> str:
    """The row of a file; of all without one."""
    mutants = sum(path in ("", mutant.path) for mutant in survey.everything)
    found = [outcome for mutant, outcome in survey.trials if path in ("", mutant.path)]
    gone = f"{1 - found.count(Outcome.SURVIVED) / len(found):.0%}" if found else ""
    return _row([path or "**all**", str(mutants), str(len(found)), *(str(found.count(o)) for o in Outcome), gone])


def _row(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |"
