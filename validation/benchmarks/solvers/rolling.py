"""Positions a second of a rolling wheel on boundary elements, beside the floor of its operator applications."""

from dataclasses import dataclass

import numpy as np

import bem3d
from validation.analysis.evidence import Table, table_of
from validation.benchmarks.isolation import isolated_process, one_thread, timed
from validation.engine.engine import Engine, Outcome
from validation.simulation.method import FloatArray
from validation.simulation.rolling_strip import Strip, crop_to_reach
from validation.simulation.track_spectrum import PiecewisePowerLaw

WARM = 40
"""Positions before the clock runs: a cold start, frames that find their size, plans."""
WARM_SOLVES, APPLICATIONS = 60, 100
"""Of which the mean is taken."""


@dataclass(frozen=True, kw_only=True)
class RollingThroughput:
    """A wheel over rough strips, each in a process of its own with one thread.

    heights: h_rms / d; cells: to a contact radius, four to the shortest wave; tolerance: residual; positions: timed.
    """

    heights: tuple[float, ...] = (0.01, 0.3)
    cells: int = 32
    tolerance: float = 1e-4
    positions: int = 400
    seed: int = 145

    def rolls(self) -> list["RolledStrip"]:
        """One strip a height."""
        spectrum = PiecewisePowerLaw(edges=(1.0, np.pi / 2 * self.cells), exponents=(3.4,))
        return [
            RolledStrip(
                strip=Strip(
                    spectrum=spectrum,
                    height=height,
                    realisation=0,
                    length=32.0,
                    width=16.0,
                    cells=self.cells,
                    tolerance=self.tolerance,
                    seed=self.seed,
                ),
                positions=self.positions,
            )
            for height in self.heights
        ]


@dataclass(frozen=True, kw_only=True)
class RolledStrip:
    """Some positions along one strip."""

    strip: Strip
    positions: int


def rolling_throughput(rolling: RollingThroughput, engine: Engine) -> Table:
    """Positions a second; the floor: as many operator applications on a fixed window; warm solves on that window."""
    rolls = rolling.rolls()
    outcomes, solves = engine.map(measure_roll, rolls), engine.map(measure_warm_solves, rolls)
    rows: list[dict[str, object]] = []
    for roll, outcome, solve in zip(rolls, outcomes, solves, strict=True):
        seconds, applications = float(outcome["seconds"]), float(outcome["applications"])
        rows.append(
            {
                "h/d": roll.strip.height,
                "positions a second": round(1 / seconds, 1),
                "applications a position": round(applications, 2),
                "one on 3a x 3a [s]": float(f"{float(solve['application']):.3g}"),
                "time over applications on 3a x 3a": round(seconds / (applications * float(solve["application"])), 2),
                "by warm solves on 3a x 3a": round(1 / float(solve["seconds"]), 1),
            }
        )
    return table_of(
        f"Rolling: a = {rolling.cells} cells, 4 cells to the shortest wave, residual {rolling.tolerance:g}", rows
    )


def measure_roll(roll: RolledStrip) -> Outcome:
    """Seconds and operator applications a position of a wheel that already rolls."""
    with one_thread(), isolated_process() as worker:
        return worker.submit(_measure_roll, roll).result()


def _measure_roll(roll: RolledStrip) -> Outcome:
    strip = roll.strip
    height = crop_to_reach(strip.surface(), 1 / strip.cells)
    track = bem3d.Track(height=height, spacing=1 / strip.cells, radius=1.0, modulus=1.0)
    wheel = bem3d.RollingContact(track, tolerance=strip.tolerance)
    for position in range(WARM):
        wheel.press(position, 1.0)
    after, seconds = timed(lambda: [wheel.press(i, 1.0) for i in range(WARM, roll.positions)])
    # plans were made meanwhile, as many as there are sizes of frames: the faster of two looks counts
    again = bem3d.RollingContact(track, tolerance=strip.tolerance)
    again.press(0, 1.0)
    _, repeated = timed(lambda: [again.press(i, 1.0) for i in range(1, roll.positions)])
    return {
        "seconds": np.array(min(seconds / len(after), repeated / (roll.positions - 1))),
        "applications": np.array(float(np.mean([contact.operator_applications for contact in after]))),
    }


def measure_warm_solves(roll: RolledStrip) -> Outcome:
    """The same by `solve`, each position from the pressure of the last, moved with the ground, on one fixed window."""
    with one_thread(), isolated_process() as worker:
        return worker.submit(_measure_warm_solves, roll).result()


def _measure_warm_solves(roll: RolledStrip) -> Outcome:
    strip = roll.strip
    n, spacing = 3 * strip.cells, 1 / strip.cells
    surface = strip.surface()
    middle = surface.shape[1] // 2
    height = surface[:, middle - n // 2 : middle - n // 2 + n]
    half_space = bem3d.HalfSpace(shape=(n, n), spacing=spacing, modulus=1.0)
    x, y = (np.arange(n) - n // 2) * spacing, (np.arange(n) - (n - 1) / 2) * spacing
    sphere = (x[:, np.newaxis] ** 2 + y**2) / 2

    def solve(position: int, start: FloatArray | None = None) -> bem3d.Contact:
        gap = sphere - height.take(np.arange(n) - n // 2 + position, axis=0, mode="wrap")
        return bem3d.solve(half_space, gap, approach=1.0, start=start, tolerance=strip.tolerance)

    contact, total = solve(0), 0.0
    count = min(roll.positions, WARM_SOLVES)
    for position in range(1, 1 + count):
        moved = np.zeros_like(contact.pressure)
        moved[:-1] = contact.pressure[1:]
        contact, seconds = timed(lambda p=position, s=moved: solve(p, s))  # type: ignore[misc]
        total += seconds
    _, application = timed(lambda: [half_space.apply(contact.pressure) for _ in range(APPLICATIONS)])
    return {"seconds": np.array(total / count), "application": np.array(application / APPLICATIONS)}
