"""What has become of mutants, as a table to read."""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum

from scipy import stats

from tests.mutation.mutants import Mutant

Reasons = dict[str, dict[str, str]]
"""Of survivors, by file and by what they are called."""


class Outcome(StrEnum):
    """Of a mutant: a test has failed; one has taken far too long; none has noticed."""

    KILLED = "killed"
    TIMED_OUT = "timed out"
    SURVIVED = "survived"


@dataclass(frozen=True)
class Trial:
    """A mutant, what has become of it, and the test that has ended it."""

    mutant: Mutant
    outcome: Outcome
    killer: str = ""


@dataclass(frozen=True)
class Survey:
    """All trials; how many mutants there are of each file; the seed of a sample, None where all were tried; and the
    seconds of tests that each was met by at most."""

    trials: list[Trial]
    counts: dict[str, int]
    seed: int | None
    seconds: float


def table(survey: Survey, reasons: Reasons) -> str:
    """The score file by file, and the survivors with their reasons."""
    return "\n".join([*_introduction(survey, reasons), "", *_scores(survey), "", *_survivors(survey, reasons), ""])


def _introduction(survey: Survey, reasons: Reasons) -> list[str]:
    tried, everything = len(survey.trials), sum(survey.counts.values())
    left = [trial.mutant for trial in survey.trials if trial.outcome is Outcome.SURVIVED]
    gone = tried - len(left)
    excused = sum(mutant.key in reasons.get(mutant.path, {}) for mutant in left)
    low, high = stats.binomtest(gone, tried).proportion_ci(method="wilson")
    which = (
        f"All {everything} were tried"
        if survey.seed is None
        else f"{tried} of {everything} were tried, drawn at random with the seed {survey.seed}"
    )
    interval = "" if survey.seed is None else f", {low:.1%} to {high:.1%} with 95 % confidence (Wilson) for all of them"
    return [
        "# Mutants",
        "",
        "Written by `make mutation`. A mutant is the code with one small change: an operator, a comparison, a number,",
        "a condition, a value that is returned, a call or an assignment left out",
        "(`tests/mutation/mutants.py`). It is killed",
        f"where a test fails, and met by tests of {survey.seconds:g} s in all: the quickest that execute its lines.",
        "",
        f"**{which}; {gone} of them were killed or timed out: {gone / tried:.1%}{interval}.**",
        f"Of the {tried - gone} survivors {excused} change no answer, for the reasons below: without them",
        f"{gone / (tried - excused):.1%} are gone.",
    ]


def _scores(survey: Survey) -> list[str]:
    rows = ["| file | mutants | tried | killed | timed out | survived | gone |", "|---|--:|--:|--:|--:|--:|--:|"]
    for path in sorted(survey.counts):
        rows.append(_score(path, survey.counts[path], [t for t in survey.trials if t.mutant.path == path]))
    return [*rows, _score("**all**", sum(survey.counts.values()), survey.trials)]


def _score(name: str, count: int, trials: list[Trial]) -> str:
    of = {outcome: sum(trial.outcome is outcome for trial in trials) for outcome in Outcome}
    gone = f"{1 - of[Outcome.SURVIVED] / len(trials):.0%}" if trials else ""
    return f"| {name} | {count} | {len(trials)} | {' | '.join(str(of[outcome]) for outcome in Outcome)} | {gone} |"


def _survivors(survey: Survey, reasons: Reasons) -> list[str]:
    left = [trial.mutant for trial in survey.trials if trial.outcome is Outcome.SURVIVED]
    rows = ["| file | where | change | why it lives |", "|---|---|---|---|"]
    for mutant in left:
        reason = reasons.get(mutant.path, {}).get(mutant.key, "**no test notices**")
        rows.append(_row([mutant.path, mutant.scope, f"`{mutant.change}`", reason]))
    return ["## Survivors", "", *(rows if left else ["None."])]


def _row(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |"
