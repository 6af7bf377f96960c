"""What the scenes at the edges show: a row a kind, and the share of answers that hold."""

import math
from collections.abc import Sequence

import numpy as np
from scipy import stats

from validation.analysis.evidence import Number, Role, Table, table_of
from validation.cases.selection.edge_scenes import EDGE_KINDS
from validation.cases.selection.edge_test import EdgeTrial
from validation.engine.engine import Outcome

HELD = "share of answers at the edges whose true error is within the estimated one"


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
            "answerable": int(not outcome["failed"]),
        }
        for trial, outcome in zip(trials, outcomes, strict=True)
        for i, tolerance in enumerate(trial.tolerances)
    ]
    return table_of("edges", rows)


def edge_numbers(table: Table) -> tuple[Number, ...]:
    """One a tolerance, over all kinds, where an answer was tested."""
    tested = table["tolerance"][np.isfinite(table["true error"])]
    return tuple(_number(table.where(tolerance=tolerance), tolerance) for tolerance in np.unique(tested).tolist())


def _number(mine: Table, tolerance: float) -> Number:
    held = _held(mine)[np.isfinite(mine["true error"])]
    interval = stats.binomtest(int(held.sum()), held.size).proportion_ci()
    return Number(
        quantity=HELD,
        where={"tolerance": tolerance},
        value=float(held.mean()),
        reference=1.0,
        source="an upper bound of the error",
        tolerance=0.03,
        reason="0.97: what 95 % intervals reach where many are wide",
        sample=float(max(held.mean() - interval.low, interval.high - held.mean())),
        role=Role.FINDING,
    )


def edges_by_kind(table: Table) -> Table:
    """Answers, held, refused, and the worst error over what was estimated."""
    rows: list[dict[str, object]] = []
    for kind in EDGE_KINDS:
        mine = table.where(kind=kind)
        if not mine["kind"].size:
            continue
        answers, tested = np.isfinite(mine["estimated error"]), np.isfinite(mine["true error"])
        ratio = mine["true error"][tested] / np.hypot(mine["estimated error"], mine["error of the reference"])[tested]
        rows.append(
            {
                "scene": kind,
                "scenes times tolerances": int(answers.size),
                "answers": int(answers.sum()),
                "tolerance met": int(mine["met"].sum()),
                "refused, but answered by fine boundary elements": int((~answers & (mine["answerable"] == 1)).sum()),
                "tested": int(tested.sum()),
                "held": int(_held(mine)[tested].sum()),
                "true over estimated error, worst": f"{ratio.max():.2g}" if ratio.size else "—",
            }
        )
    return table_of("Answers at the edges of the ranges", rows)


def edge_answer(table: Table) -> str:
    """In a sentence."""
    tested = np.isfinite(table["true error"])
    held, answers = _held(table)[tested], np.isfinite(table["estimated error"])
    refused = int((~answers & (table["answerable"] == 1)).sum())
    return (
        f"at the edges of the ranges and beyond, {np.count_nonzero(held)} of {held.size} answers hold, and {refused} "
        f"of {np.count_nonzero(table['answerable'] == 1)} questions that fine boundary elements answer are refused."
    )


def _held(table: Table) -> np.ndarray:
    """Beside a reference that has an error of its own, independent of the estimated one."""
    found = np.hypot(table["estimated error"], table["error of the reference"])
    return np.asarray(np.where(np.isfinite(table["true error"]), table["true error"] <= found, math.nan) == 1)
