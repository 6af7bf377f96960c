"""What a position of a rolling wheel costs, and how wrong its force is: cells, tolerance and roughness."""

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import bem3d
from validation.analysis.evidence import Table, table_of
from validation.benchmarks.isolation import one_thread, own_process, timed
from validation.engine.engine import Engine, Outcome
from validation.simulation.rolling_strip import HERTZ, Strip, crop_to_reach
from validation.simulation.track_spectrum import PiecewisePowerLaw

FloatArray = NDArray[np.float64]

TIGHT = 1e-9
"""The residual of what errors are measured against."""
WARM = 40
"""Positions before the clock runs: a cold start, frames that find their size, plans."""


@dataclass(frozen=True, kw_only=True)
class RollingThroughput:
    """All that is rolled, each in a process of its own with one thread.

    heights: h_rms / d; cells: to a contact radius, ascending; tolerances: residuals; finest: cells to a radius of the
    force that counts as true; length: of the track over a; last: q a of the shortest wave;
    goal: cells, tolerance and heights of the scene that has a goal, 4 cells to its shortest wave, on windows that would
    be 3 a wide; goals: positions a second for each height; positions: that are timed of it.
    """

    heights: tuple[float, ...] = (0.01, 0.3)
    cells: tuple[int, ...] = (8, 16)
    tolerances: tuple[float, ...] = (1e-3, 1e-4, 1e-5, 1e-6)
    finest: int = 32
    length: int = 16
    last: float = 10.0
    goal: tuple[int, float] = (32, 1e-4)
    goals: tuple[float, ...] = (800.0, 400.0)
    positions: int = 400
    seed: int = 145

    def strip(self, height: float, cells: int, last: float, length: int) -> Strip:
        """The rough strip, the same on every grid."""
        return Strip(
            spectrum=PiecewisePowerLaw(edges=(1.0, last), exponents=(3.4,)),
            height=height,
            realisation=0,
            length=length,
            width=16.0,
            cells=cells,
            tolerance=TIGHT,
            seed=self.seed,
        )


@dataclass(frozen=True, kw_only=True)
class Roll:
    """One track at one tolerance."""

    strip: Strip
    tolerance: float
    positions: int


def measure_rolls(rolls: RollingThroughput, engine: Engine) -> list[Table]:
    """Positions a second beside the error of the force; the scene with a goal. One after the other."""
    rows = [
        Roll(strip=rolls.strip(h, n, rolls.last, rolls.length), tolerance=t, positions=rolls.length * n)
        for h, n, t in itertools.product(rolls.heights, rolls.cells, (*rolls.tolerances, TIGHT))
    ]
    truth = [
        Roll(strip=rolls.strip(h, rolls.finest, rolls.last, rolls.length), tolerance=TIGHT, positions=0)
        for h in rolls.heights
    ]
    cells, tolerance = rolls.goal
    scenes = [
        Roll(strip=rolls.strip(h, cells, np.pi / 2 * cells, 32), tolerance=tolerance, positions=rolls.positions)
        for h in rolls.heights
    ]
    outcomes, fine = engine.map(measure_roll, rows), engine.map(measure_roll, truth)
    return [
        _errors(rolls, rows, outcomes, dict(zip(rolls.heights, fine, strict=True))),
        _scenes(rolls, scenes, engine.map(measure_roll, scenes), engine.map(measure_warm_solves, scenes)),
    ]


def measure_roll(roll: Roll) -> Outcome:
    """Seconds a position of a wheel that already rolls, and its force at all positions if the whole track is rolled."""
    with one_thread(), own_process() as lane:
        return lane.submit(_measure_roll, roll).result()


def _measure_roll(roll: Roll) -> Outcome:
    strip = roll.strip
    height = crop_to_reach(strip.surface(), 1 / strip.cells)
    track = bem3d.Track(height=height, spacing=1 / strip.cells, radius=1.0, modulus=1.0)
    wheel = bem3d.RollingContact(track, tolerance=roll.tolerance)
    count = roll.positions or height.shape[0]
    before = [wheel.press(i, 1.0) for i in range(min(WARM, count))]
    after, seconds = timed(lambda: [wheel.press(i, 1.0) for i in range(len(before), count)])
    # as many frames as the contact wants: plans are made meanwhile, so the faster half of a second look counts
    again = bem3d.RollingContact(track, tolerance=roll.tolerance)
    again.press(0, 1.0)
    _, repeated = timed(lambda: [again.press(i, 1.0) for i in range(1, count)])
    contacts = before + after
    return {
        "force": np.array([contact.force for contact in contacts]) / HERTZ,
        "seconds": np.array(min(seconds / max(len(after), 1), repeated / max(count - 1, 1))),
        "applications": np.array(float(np.mean([contact.operator_applications for contact in after or before]))),
        "failed": np.array(float(sum(not contact.converged for contact in contacts))),
    }


def measure_warm_solves(roll: Roll) -> Outcome:
    """The same by `solve`, each position from the pressure of the last, moved with the ground, on one fixed window."""
    with one_thread(), own_process() as lane:
        return lane.submit(_measure_warm_solves, roll).result()


def _measure_warm_solves(roll: Roll) -> Outcome:
    strip = roll.strip
    n, spacing = 3 * strip.cells, 1 / strip.cells
    surface = strip.surface()
    middle = surface.shape[1] // 2
    height = surface[:, middle - n // 2 : middle - n // 2 + n]
    half_space = bem3d.HalfSpace(shape=(n, n), spacing=spacing, modulus=1.0)
    x, y = (np.arange(n) - n // 2) * spacing, (np.arange(n) - (n - 1) / 2) * spacing
    sphere = (x[:, np.newaxis] ** 2 + y**2) / 2

    def gap(position: int) -> FloatArray:
        return np.asarray(sphere - height.take(np.arange(n) - n // 2 + position, axis=0, mode="wrap"))

    contact = bem3d.solve(half_space, gap(0), approach=1.0, tolerance=roll.tolerance)
    count, seconds = 0, 0.0
    for position in range(1, 1 + min(roll.positions, 60)):
        moved = np.zeros_like(contact.pressure)
        moved[:-1] = contact.pressure[1:]
        contact, taken = timed(
            lambda p=position, s=moved: bem3d.solve(  # type: ignore[misc]
                half_space, gap(p), approach=1.0, start=s, tolerance=roll.tolerance
            )
        )
        count, seconds = count + 1, seconds + taken
    _, application = timed(lambda: [half_space.apply(contact.pressure) for _ in range(100)])
    return {"seconds": np.array(seconds / count), "application": np.array(application / 100)}


def _errors(rolls: RollingThroughput, rows: list[Roll], outcomes: list[Outcome], truth: dict[float, Outcome]) -> Table:
    tight = {(r.strip.height, r.strip.cells): o for r, o in zip(rows, outcomes, strict=True) if r.tolerance == TIGHT}
    found: list[dict[str, object]] = []
    for roll, outcome in zip(rows, outcomes, strict=True):
        height, cells = roll.strip.height, roll.strip.cells
        true = interpolated(truth[height]["force"], rolls.length, (np.arange(outcome["force"].size) + 0.5) / cells)
        same = tight[height, cells]["force"]
        found.append(
            {
                "h/d": height,
                "cells to a radius": cells,
                "tolerance": roll.tolerance,
                "positions a second": 1 / float(outcome["seconds"]),
                "applications a position": float(outcome["applications"]),
                "rms error of the force, solver": _rms(outcome["force"] - same),
                "rms error of the force, solver and grid": _rms(outcome["force"] - true),
                "rms fluctuation of the force": float(true.std()),
                "not converged": int(outcome["failed"]),
            }
        )
    return table_of("rolling", found)


def _scenes(rolls: RollingThroughput, scenes: list[Roll], outcomes: list[Outcome], solves: list[Outcome]) -> Table:
    found: list[dict[str, object]] = []
    for goal, roll, outcome, solve in zip(rolls.goals, scenes, outcomes, solves, strict=True):
        seconds, application = float(outcome["seconds"]), float(solve["application"])
        floor = float(outcome["applications"]) * application
        found.append(
            {
                "h/d": roll.strip.height,
                "positions a second": round(1 / seconds, 1),
                "goal": goal,
                "applications a position": round(float(outcome["applications"]), 2),
                "one on 3a x 3a [s]": float(f"{application:.3g}"),
                "time over applications on 3a x 3a": round(seconds / floor, 2),
                "by warm solves on 3a x 3a": round(1 / float(solve["seconds"]), 1),
            }
        )
    return table_of("Rolling: a = 32 cells, 4 cells to the shortest wave, residual 1e-4", found)


def interpolated(force: FloatArray, length: float, x: FloatArray) -> FloatArray:
    """A periodic series at the centres of its cells, by its waves, at other places."""
    n = force.size
    amplitude = np.fft.rfft(force) / n
    q = 2 * np.pi / length * np.arange(amplitude.size)
    waves = np.exp(1j * np.outer(x - 0.5 * length / n, q)) * amplitude
    weights = np.where((np.arange(amplitude.size) == 0) | (2 * np.arange(amplitude.size) == n), 1.0, 2.0)
    return np.asarray((waves * weights).real.sum(axis=1))


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2)))
