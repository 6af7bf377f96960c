"""Tables of Fig. 14.1: statistics of both methods force by force and on each grid; what its figures mark."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from validation.analysis.evidence import Number, Table
from validation.cases.punch.ensembles import Row, cells_in_contact, interval_columns
from validation.cases.punch.fractal_punch import LONG, Ensemble
from validation.cases.punch.fractal_punch_decades import (
    DEVIATION,
    MARGIN,
    MARGINS,
    MEAN,
    QUANTITIES,
    DecadeComparison,
    PunchStatistics,
)
from validation.cases.punch.fractal_punch_numbers import PUBLISHED
from validation.engine.engine import Outcome
from validation.simulation.rough_punch import BEM, MDR


def curve(found: PunchStatistics, ensemble: Ensemble) -> list[Row]:
    """One row a force: the statistics of both methods with their 95 % intervals, and the ratio of the deviations."""
    return [_row(found, ensemble, level) for level in range(len(found.case.forces))]


def _row(found: PunchStatistics, ensemble: Ensemble, level: int) -> Row:
    case, hurst = found.case, ensemble.hurst
    row = {"H": hurst, "Fbar": case.forces[level]}
    before, after = max(level - 1, 0), min(level + 1, len(case.forces) - 1)
    for method in (BEM, MDR, LONG):
        mean, deviation = (found.at(hurst, method, name, level).value for name in (MEAN, DEVIATION))
        slope = found.exponent(hurst, method, before, after).value
        row |= interval_columns(f"{method} {MEAN}", mean, math.exp)
        row |= interval_columns(f"{method} {DEVIATION}", deviation, math.exp)
        row |= interval_columns(f"{method} exponent", slope, float)
    mdr, bem = (found.at(hurst, method, DEVIATION, level).value for method in (MDR, BEM))
    row |= interval_columns(f"mdr over bem3d {DEVIATION}", mdr.beside(bem), math.exp)
    pressed = {cells: ensemble.outcomes[BEM][cells] for cells in case.grids_at(case.forces[level])}
    row["bem3d contact fraction"] = float(np.nanmean(pressed[max(pressed)]["area"][:, level]))
    row |= cells_in_contact(row["bem3d contact fraction"], max(pressed))
    row["mdr contact fraction"] = float(ensemble.outcomes[MDR][case.points]["area"][:, level].mean())
    row["bem3d applications"] = _mean_over_grids(pressed, "applications", level)
    row["bem3d applications of the stiffness"] = _mean_over_grids(pressed, "frozen applications", level)
    row["bem3d surfaces"] = max(int(np.isfinite(mine["stiffness"][:, level]).sum()) for mine in pressed.values())
    return row


def _mean_over_grids(pressed: Mapping[int, Outcome], name: str, level: int) -> float:
    return float(np.nanmean(np.concatenate([mine[name][:, level] for mine in pressed.values()])))


def grids(found: PunchStatistics, ensemble: Ensemble) -> list[Row]:
    """One row a force: surfaces on each grid, both statistics there, and extrapolated; NaN on a grid without any."""
    case = found.case
    rows = []
    for level, force in enumerate(case.forces):
        row: Row = {"H": ensemble.hurst, "Fbar": force}
        row |= {f"surfaces, {cells}²": float(case.count(force, cells)) for cells in case.grids}
        for name in (MEAN, DEVIATION):
            resolved = found.at(ensemble.hurst, BEM, name, level)
            row |= {f"{name}, {cells}²": math.exp(resolved.on.get(cells, math.nan)) for cells in case.grids}
            row[f"{name}, extrapolated"] = math.exp(resolved.value.value)
            row[f"± sample of ln {name}"] = resolved.value.half_width
            row[f"± grid of ln {name}"] = resolved.grid
        rows.append(row)
    return rows


def points(comparisons: Iterable[DecadeComparison]) -> list[dict[str, object]]:
    """One row a force, once in each decade that it belongs to: the ratio, its interval, the verdict at each margin."""
    rows = []
    for comparison in comparisons:
        if QUANTITIES[comparison.name].unit != "dB":
            continue
        for point in comparison.points:
            row: dict[str, object] = {
                "quantity": comparison.name,
                "H": _hurst(comparison),
                "Fbar from": comparison.first,
                "Fbar": point.force,
                "mdr": math.exp(point.springs.value.value),
                "bem3d": math.exp(point.bem.value.value),
                **_interval(point.number),
            }
            verdicts = {
                name: point.number and replace(point.number, tolerance=m).verdict for name, m in MARGINS.items()
            }
            rows.append(row | {f"within {name}": str(verdict or "") for name, verdict in verdicts.items()})
    return rows


def decades(comparisons: Iterable[DecadeComparison]) -> list[dict[str, object]]:
    """What stands behind a verdict: the worst point of a decade, beside the signed mean over its points."""
    rows = []
    for comparison in comparisons:
        number, quantity = comparison.number, QUANTITIES[comparison.name]
        in_decibels = quantity.unit == "dB"
        worst = next((p for p in comparison.points if number and p.force == number.where.get("worst at")), None)
        point = worst or comparison.points[0]
        value = math.exp if in_decibels else float
        row: dict[str, object] = {
            "quantity": comparison.name,
            "H": _hurst(comparison),
            "Fbar from": comparison.first,
            "Fbar to": 10 * comparison.first,
            "worst at Fbar": math.nan if worst is None else worst.force,
            "mdr": value(point.springs.value.value),
            "bem3d": value(point.bem.value.value),
            "unit of the difference": quantity.unit,
            **_interval(number),
            "signed mean of MDR / bem3d - 1": comparison.signed_mean if in_decibels else math.nan,
            "verdict": "" if number is None else str(number.verdict),
            "times the sample that would decide": math.nan if number is None else number.sample_needed,
        }
        for name, margin in MARGINS.items():
            within = comparison.within(margin) if in_decibels else None
            row[f"within {name}"] = "" if within is None else str(within.verdict)
        rows.append(row)
    return rows


def _hurst(comparison: DecadeComparison) -> float:
    """NaN for the mean over all."""
    return math.nan if comparison.hurst is None else comparison.hurst


def _interval(number: Number | None) -> dict[str, float]:
    parts = ("difference", "sample", "grid")
    value, sample, grid = (math.nan if number is None else getattr(number, part) for part in parts)
    return {"difference": value, "± sample": sample, "± grid": grid}


def order(found: PunchStatistics) -> list[Row]:
    """One row a force: how the deviation of both methods changes with H; its phases are those of every H."""
    rows = []
    for level, force in enumerate(found.case.forces):
        row: Row = {"Fbar": force}
        for method in (BEM, MDR):
            trend = found.trend(method, level)
            row |= interval_columns(f"{method} d ln deviation / d H", trend.value, float)
            row[f"{method} ± grid"] = trend.grid
        rows.append(row)
    return rows


def marks() -> Table:
    """Constants that the figures draw."""
    values = {
        "tolerance of the relative deviation [dB]": MARGINS[MARGIN],
        "claimed of rolling [dB]": MARGINS["3 dB"],
        "smallest published exponent": PUBLISHED[0],
        "largest published exponent": PUBLISHED[1],
    }
    return Table("marks", {"mark": list(values), "value": list(values.values())})
