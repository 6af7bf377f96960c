"""What the scenes at the edges show: a row a kind, and the share of answers that hold."""

import math
from collections.abc import Sequence
from functools import partial

import numpy as np
from scipy import stats

from validation.analysis.evidence import Number, Role, Table, table_of
from validation.cases.selection.edge_scenes import EDGE_KINDS
from validation.cases.selection.edge_test import EdgeTrial
from validation.engine.engine import Outcome

HELD = "share of answers at the edges whose true error is within the estimated one"
REFUSED = "share of questions at the edges that are refused, though fine boundary elements meet the tolerance"
FAR_OFF = "true error at the edges above twice the estimated one where the tolerance is met, worst, in decades"
KIND_HELD = "share of scenes of a kind at the edges, all of whose answers are within their estimated errors"
NEEDED = 99
"""Scenes of which all hold with a chance of 5 % where 97 % do."""
MOST = 2.0
"""True over estimated error, of an answer that is called enough."""


def edge_table(trials: Sequence[EdgeTrial], outcomes: Sequence[Outcome]) -> Table:
    """A row a scene and tolerance."""
    rows: list[dict[str, object]] = [
        {
            "kind": trial.kind,
            "number": trial.number,
            "quantity": trial.quantity,
            "tolerance": tolerance,
            "met": int(outcome["met"][i]),
            "estimated error": float(outcome["estimated"][i]),
            "true error": float(outcome["true"][i]),
            "error of the reference": float(outcome["reference"]),
            "error of fine boundary elements": float(outcome["offered"]),
            "answerable": int(not outcome["failed"]),
        }
        for trial, outcome in zip(trials, outcomes, strict=True)
        for i, tolerance in enumerate(trial.tolerances)
    ]
    return table_of("edges", rows)


def by_scene(trials: Sequence[EdgeTrial], outcomes: Sequence[Outcome]) -> Table:
    """The same, a row a scene, for who reads the data: of a thousand scenes, in three digits."""
    tolerances = sorted({tolerance for trial in trials for tolerance in trial.tolerances})
    rows: list[dict[str, object]] = []
    for trial, outcome in zip(trials, outcomes, strict=True):
        row: dict[str, object] = {
            "kind": trial.kind,
            "number": trial.number,
            "quantity": trial.quantity,
            "error of the reference": _short(outcome["reference"]),
            "error of fine boundary elements": _short(outcome["offered"]),
        }
        for tolerance in tolerances:
            at = trial.tolerances.index(tolerance) if tolerance in trial.tolerances else None
            for name, told in (("met", "met"), ("estimated", "estimated error"), ("true", "true error")):
                row[f"{told}, {tolerance:.0%}"] = math.nan if at is None else _short(outcome[name][at])
        rows.append(row)
    return table_of("edges", rows)


def _short(error: np.ndarray) -> float:
    return float(f"{float(error):.3g}")


def edge_numbers(table: Table) -> tuple[Number, ...]:
    """Three a tolerance, over all kinds, where an answer was tested."""
    tested = table["tolerance"][np.isfinite(table["true error"])]
    mine = [(tolerance, table.where(tolerance=tolerance)) for tolerance in np.unique(tested).tolist()]
    return tuple(number for tolerance, some in mine for number in _numbers(tolerance, some))


def _numbers(tolerance: float, mine: Table) -> tuple[Number, ...]:
    finding = partial(Number, where={"tolerance": tolerance}, role=Role.FINDING)
    held = _held(mine)[np.isfinite(mine["true error"])]
    beyond = max(math.log10(max(_over(mine)[mine["met"] == 1], default=1.0) / MOST), 0.0)
    numbers = [
        finding(
            quantity=HELD,
            value=float(held.mean()),
            reference=1.0,
            source="an upper bound of the error",
            tolerance=0.03,
            reason="0.97: what 95 % intervals reach where many are wide",
            sample=_sample(held),
        ),
        finding(
            quantity=FAR_OFF,
            value=beyond,
            reference=0.0,
            source=f"no error above {MOST:g} times the estimated one",
            tolerance=0.02,
            reason="0.02 decades: 5 % of the factor",
        ),
    ]
    if (answerable := _answerable(mine)).any():
        refused = _refused(mine)[answerable]
        numbers.append(
            finding(
                quantity=REFUSED,
                value=float(refused.mean()),
                reference=0.0,
                source="no refusal where a model has an answer",
                tolerance=0.1,
                reason="one in ten",
                sample=_sample(refused),
            )
        )
    return tuple(numbers)


def kind_numbers(table: Table) -> tuple[Number, ...]:
    """One a kind that has tested answers."""
    kinds = [(kind, held) for kind in EDGE_KINDS if (held := _scenes_held(table.where(kind=kind))).size]
    return tuple(
        Number(
            quantity=KIND_HELD,
            where={"scene": kind},
            value=float(held.mean()),
            reference=1.0,
            source="an upper bound of the error",
            tolerance=0.03,
            reason="0.97: what 95 % intervals reach where many are wide",
            sample=_sample(held, confidence=0.9),
            role=Role.FINDING,
        )
        for kind, held in kinds
    )


def _scenes_held(table: Table) -> np.ndarray:
    """Whether all tested answers of a scene hold, at whatever tolerance: these are not independent."""
    tested = np.isfinite(table["true error"])
    numbers, held = table["number"][tested], _held(table)[tested]
    return np.array([held[numbers == number].all() for number in np.unique(numbers)])


def _sample(found: np.ndarray, confidence: float = 0.95) -> float:
    """Half-width of the interval of a share; with 0.9 its lower end alone is that of 95 %."""
    interval = stats.binomtest(int(found.sum()), found.size).proportion_ci(confidence_level=confidence)
    return float(max(found.mean() - interval.low, interval.high - found.mean()))


def _over(table: Table) -> np.ndarray:
    """True over estimated error, of tested answers; zero for others."""
    found = table["true error"] / np.hypot(table["estimated error"], table["error of the reference"])
    return np.asarray(np.nan_to_num(found, nan=0.0))


def _answerable(table: Table) -> np.ndarray:
    """Whether fine boundary elements meet the tolerance."""
    return np.asarray(table["error of fine boundary elements"] <= table["tolerance"])


def _refused(table: Table) -> np.ndarray:
    """Although fine boundary elements meet the tolerance."""
    return np.asarray(_answerable(table) & (table["met"] == 0))


def edges_by_kind(table: Table) -> Table:
    """Answers, held, refused, and the worst error over what was estimated."""
    rows: list[dict[str, object]] = []
    for kind in EDGE_KINDS:
        mine = table.where(kind=kind)
        if not mine["kind"].size:
            continue
        answers, tested = np.isfinite(mine["estimated error"]), np.isfinite(mine["true error"])
        ratio = _over(mine)[tested]
        rows.append(
            {
                "scene": kind,
                "scenes times tolerances": int(answers.size),
                "answers": int(answers.sum()),
                "tolerance met": int(mine["met"].sum()),
                "refused, but within the tolerance of fine boundary elements": int(_refused(mine).sum()),
                "tested": int(tested.sum()),
                "held": int(_held(mine)[tested].sum()),
                "true over estimated error, worst": f"{ratio.max():.2g}" if ratio.size else "—",
            }
        )
    return table_of("Answers at the edges of the ranges", rows)


def edge_answer(table: Table) -> str:
    """In a sentence."""
    tested = np.isfinite(table["true error"])
    held = _held(table)[tested]
    return (
        f"at the edges of the ranges and beyond, {np.count_nonzero(held)} of {held.size} answers hold, and "
        f"{np.count_nonzero(_refused(table))} of {np.count_nonzero(_answerable(table))} questions that fine boundary "
        "elements answer within the tolerance are refused."
    )


def kind_answer(numbers: Sequence[Number], table: Table) -> str:
    """In a sentence: of which kinds the share is known, and on how many scenes all answers hold."""
    kinds: dict[bool, list[str]] = {True: [], False: []}
    for number in numbers:
        kind = str(number.where["scene"])
        held = _scenes_held(table.where(kind=kind))
        kinds[number.verdict != "undecided"].append(f"{kind} {np.count_nonzero(held)} of {held.size}")
    decided, undecided = (", ".join(kinds[known]) for known in (True, False))
    enough = f"; undecided: {undecided} ({NEEDED} scenes of a kind decide if all hold)" if undecided else ""
    return f"scenes all of whose answers hold: {decided or 'none decided'}{enough}."


def _held(table: Table) -> np.ndarray:
    """Beside a reference that has an error of its own, independent of the estimated one."""
    found = np.hypot(table["estimated error"], table["error of the reference"])
    return np.asarray(np.where(np.isfinite(table["true error"]), table["true error"] <= found, math.nan) == 1)
