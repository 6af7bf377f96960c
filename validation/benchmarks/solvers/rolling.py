"""Positions a second of a rolling wheel on boundary elements, beside the floor of its operator applications."""

from dataclasses import dataclass

import numpy as np

import bem3d
from validation.analysis.evidence import Table, table_of
from validation.benchmarks.isolation import measure_alone, timed
from validation.benchmarks.work_precision.rolling import moving_window
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import Engine, Outcome
from validation.simulation.method import FloatArray
from validation.simulation.rolling_strip import RoughStrip, Strip, crop_to_reach
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
        spectrum = PiecewisePowerLaw(edges=(1.0, np.pi / 2 * self.cells), exponents=(3.4,))
        return [
            RolledStrip(
                strip=Strip(
                    scene=RoughStrip(spectrum=spectrum, height=height, length=32.0, width=16.0, seed=self.seed),
                    realisation=0,
                    cells=self.cells,
                    tolerance=self.tolerance,
                ),
                positions=self.positions,
            )
            for height in self.heights
        ]


def rolling_throughput(rolling: RollingThroughput, engine: Engine) -> Table:
    """Positions a second; the floor: as many operator applications on a fixed window; warm solves on that window."""
    rows: list[dict[str, object]] = []
    for height, outcome in zip(rolling.heights, engine.map(measure_alone, rolling.rolls()), strict=True):
        names = ("seconds", "applications", "warm solve", "application")
        seconds, applications, warm, one = (float(outcome[name]) for name in names)
        rows.append(
            {
                "h/d": height,
                "positions a second": round(1 / seconds, 1),
                "applications a position": round(applications, 2),
                "one on 3a x 3a [s]": float(f"{one:.3g}"),
                "time over applications on 3a x 3a": round(seconds / (applications * one), 2),
                "by warm solves on 3a x 3a": round(1 / warm, 1),
            }
        )
    return table_of(
        f"Rolling: a = {rolling.cells} cells, 4 cells to the shortest wave, residual {rolling.tolerance:g}", rows
    )


@dataclass(frozen=True, kw_only=True)
class RolledStrip:
    """Some positions along one strip."""

    strip: Strip
    positions: int

    def measure(self) -> Outcome:
        """Seconds and applications a position of a wheel that already rolls; seconds of the same by warm solves."""
        return {**self._rolled(), **self._warm_solves()}

    def _rolled(self) -> Outcome:
        strip = self.strip
        height = crop_to_reach(strip.surface(), 1 / strip.cells)
        track = bem3d.Track(height=height, spacing=1 / strip.cells, radius=1.0, modulus=1.0)
        wheel = bem3d.RollingContact(track, tolerance=strip.tolerance)
        before = [wheel.press(position, 1.0) for position in range(WARM)]
        after, seconds = timed(lambda: [wheel.press(i, 1.0) for i in range(WARM, self.positions)])
        if lost := sum(not contact.converged for contact in (*before, *after)):
            raise NotConvergedError(f"{lost} positions at h/d = {strip.scene.height:g} did not converge")
        # plans were made meanwhile, as many as there are sizes of frames: the faster of two looks counts
        again = bem3d.RollingContact(track, tolerance=strip.tolerance)
        again.press(0, 1.0)
        _, repeated = timed(lambda: [again.press(i, 1.0) for i in range(1, self.positions)])
        return {
            "seconds": np.array(min(seconds / len(after), repeated / (self.positions - 1))),
            "applications": np.array(float(np.mean([contact.operator_applications for contact in after]))),
        }

    def _warm_solves(self) -> Outcome:
        """By `solve`, each position from the pressure of the last, moved with the ground, on one fixed window."""
        strip = self.strip
        half_space, gap = moving_window(strip.surface(), strip.cells)

        def solve(position: int, start: FloatArray | None = None) -> bem3d.Contact:
            return bem3d.solve(half_space, gap(position), approach=1.0, start=start, tolerance=strip.tolerance)

        contact, total = solve(0), 0.0
        count = min(self.positions, WARM_SOLVES)
        for position in range(1, 1 + count):
            moved = np.zeros_like(contact.pressure)
            moved[:-1] = contact.pressure[1:]
            contact, seconds = timed(lambda p=position, s=moved: solve(p, s))  # type: ignore[misc]
            total += seconds
        _, application = timed(lambda: [half_space.apply(contact.pressure) for _ in range(APPLICATIONS)])
        return {"warm solve": np.array(total / count), "application": np.array(application / APPLICATIONS)}
