"""What the race shows: times to equal residual, agreement of the answers, and how time and memory grow."""

import numpy as np

from validation.evidence import Evidence, Number, Table
from validation.peers import CONTESTANTS
from validation.race import FINISHED, RaceResult

PRESSURE, FORCE, AREA = 1e-4, 1e-6, 1e-3
OTHERS = [i for i, contestant in enumerate(CONTESTANTS) if contestant.package != CONTESTANTS[0].package]


def evidence(result: RaceResult) -> Evidence:
    """Numbers for what must agree; the times as tables and conclusions, since no time is right or wrong."""
    return Evidence(
        title="The race: time to the same residual, one thread each",
        compared=(
            f"Everyone solves the same discrete problems, cold, to a residual of {result.race.residual:g} as this "
            "project defines it, from a fresh operator application on the returned pressure; with the loosest of their "
            "own tolerances that reaches it. A process each, in turns, one thread; the median of up to five runs. "
            "Set-up (operators, plans) is timed apart. "
            + "; ".join(
                f"{c.name}: {c.mode}{f' ({c.version})' if c.version else ', not installed'}" for c in CONTESTANTS
            )
            + "."
        ),
        numbers=tuple(_agreement(result)),
        tables=(_heats(result), _scaling(result)),
        conclusions=tuple(_conclusions(result)),
        caption=(
            "(a) Median time to the residual, bars from the fastest to the slowest run. (b) The same beside our "
            "solver's. (c) Our solver alone: seconds (filled) and peak memory of its process, less what it takes to "
            "start (open), against the cells along a side."
        ),
        unconverged=tuple(
            f"{heat.course.label}: {CONTESTANTS[i].name} {outcome['status'][i]}"
            for heat, outcome in zip(result.heats, result.outcomes, strict=True)
            for i in range(2)
            if outcome["status"][i] != FINISHED
        ),
    )


def _heats(result: RaceResult) -> Table:
    names = (
        ("seconds", 0, "median [s]"),
        ("seconds", 1, "fastest [s]"),
        ("seconds", 2, "slowest [s]"),
        ("seconds", 3, "runs"),
        ("setup", None, "set-up [s]"),
        ("residual", None, "residual"),
        ("applications", None, "operator applications"),
        ("difference", 0, "pressure difference to ours, L2"),
        ("difference", 1, "force difference to ours"),
        ("difference", 2, "area difference to ours"),
    )
    rows: dict[str, list[object]] = {}
    for heat, outcome in zip(result.heats, result.outcomes, strict=True):
        course = heat.course
        for i, contestant in enumerate(CONTESTANTS):
            facts: dict[str, object] = {
                "problem": course.label,
                "surface": course.surface,
                "half-space": "periodic" if course.periodic else "free",
                "cells": course.cells,
                "area": float(outcome["area"]),
                "contestant": contestant.name,
                "status": str(outcome["status"][i]),
            }
            for key, column, name in names:
                facts[name] = float(outcome[key][i] if column is None else outcome[key][i, column])
            for name, value in facts.items():
                rows.setdefault(name, []).append(value)
    return Table("heats", rows)


def _scaling(result: RaceResult) -> Table:
    rows: dict[str, list[object]] = {}
    for measured, outcome in zip(result.measured, result.costs, strict=True):
        course = measured.course
        values = {
            "problem": f"{course.surface}, {'periodic' if course.periodic else 'free'}",
            "cells": course.cells,
            "solve [s]": float(outcome["seconds"]),
            "first solve, with plans [s]": float(outcome["first"]),
            "one application [s]": float(outcome["application"]),
            "operator applications": int(outcome["applications"]),
            "on coarser grids": int(outcome["coarse"]),
            "solve / (applications x one application)": float(
                outcome["seconds"] / (outcome["applications"] * outcome["application"])
            ),
            "peak memory less start [MiB]": float((outcome["peak"] - outcome["before"]) / 2**20),
            "peak memory [MiB]": float(outcome["peak"] / 2**20),
        }
        for name, value in values.items():
            rows.setdefault(name, []).append(value)
    return Table("scaling", rows)


def _agreement(result: RaceResult) -> list[Number]:
    """The largest difference to our answer over all heats that a contestant has finished."""
    numbers = []
    for i, contestant in enumerate(CONTESTANTS[1:], start=1):
        done = [o["difference"][i] for o in result.outcomes if o["status"][i] == o["status"][0] == FINISHED]
        if not done:
            continue
        for column, (what, tolerance) in enumerate(
            (("pressure field, relative L2", PRESSURE), ("force", FORCE), ("contact area", AREA))
        ):
            numbers.append(
                Number(
                    label=f"{what}: largest difference between {contestant.name} and us in {len(done)} problems",
                    value=float(np.max([row[column] for row in done])),
                    reference=0.0,
                    source="the same discrete problem has one solution",
                    tolerance=tolerance,
                    reason=f"what a residual of {result.race.residual:g} leaves open, hundredfold; "
                    "an area changes by whole cells",
                )
            )
    return numbers


def _conclusions(result: RaceResult) -> list[str]:
    sentences = [_standing(result, periodic) for periodic in (True, False)]
    lost = [
        f"{heat.course.label}: {CONTESTANTS[i].name} {outcome['status'][i]}"
        for heat, outcome in zip(result.heats, result.outcomes, strict=True)
        for i in OTHERS
        if outcome["status"][i].startswith("failed")
    ]
    sentences += [f"Not finished: {row}." for row in lost]
    table = _scaling(result)
    for problem in dict.fromkeys(table["problem"].tolist()):
        rows = table.where(problem=problem)
        n, large = rows["cells"], rows["cells"] >= 512
        use = large if np.count_nonzero(large) > 1 else np.full(n.shape, True)
        if np.count_nonzero(use) < 2:
            continue
        time, reference = (_exponent(n[use], y) for y in (rows["solve [s]"][use], (n**2 * np.log(n))[use]))
        memory = _exponent(n[use], rows["peak memory [MiB]"][use])
        sentences.append(
            f"{problem}: from {n[use].min()}² to {n[use].max()}² the time grows like n^{time:.2f}, n² log n like "
            f"n^{reference:.2f} there, the peak memory like n^{memory:.2f}; "
            f"{rows['operator applications'].min()} to {rows['operator applications'].max()} applications on the "
            f"finest grid; at {n.max()}² {rows['solve [s]'][-1]:.3g} s and {rows['peak memory [MiB]'][-1]:.0f} MiB, "
            f"{rows['solve / (applications x one application)'][-1]:.2f} times its applications alone."
        )
    return sentences


def _standing(result: RaceResult, periodic: bool) -> str:
    """Against the fastest peer of each heat."""
    where = "Periodic" if periodic else "Free space"
    ratios = []
    for heat, outcome in zip(result.heats, result.outcomes, strict=True):
        if heat.course.periodic == periodic and outcome["status"][0] == FINISHED:
            peers = [outcome["seconds"][i, 0] for i in OTHERS if outcome["status"][i] == FINISHED]
            if peers:
                ratios.append(min(peers) / outcome["seconds"][0, 0])
    if not ratios:
        return f"{where}: no peer is installed, or none has finished."
    first = sum(ratio > 1 for ratio in ratios)
    return (
        f"{where}: first on {first} of {len(ratios)} problems; {np.exp(np.mean(np.log(ratios))):.1f} times as fast as "
        f"the fastest peer in the geometric mean, {min(ratios):.1f} to {max(ratios):.1f} times on single problems."
    )


def _exponent(n: np.ndarray, y: np.ndarray) -> float:
    return float(np.polyfit(np.log(n), np.log(y), 1)[0])
