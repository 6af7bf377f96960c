"""What a model costs in seconds, as `precision` has timed it: behind its name on the front page."""

import math
from collections.abc import Callable

from validation.analysis.evidence import Evidence
from validation.analysis.study import Settings
from validation.benchmarks.timing import FINISHED
from validation.benchmarks.work_precision.case import POINTS
from validation.benchmarks.work_precision.figure_cost import COST_OF_STEPS
from validation.benchmarks.work_precision.pressed import RoughPunchProblem
from validation.benchmarks.work_precision.problem import BEM, FILTER_3D
from validation.benchmarks.work_precision.rolling import RollingProblem

TIMES = "precision"
"""The case that times all methods."""
Timed = Callable[[Evidence], str]


def in_seconds(seconds: float) -> str:
    """Two digits: "54 ms"."""
    return Settings().format("{:SI}s", float(f"{seconds:.2g}"))


def finest(evidence: Evidence, scene: str, method: str, most: float = math.inf) -> tuple[str, str] | None:
    """Median seconds and the setting of a method on a scene, on the finest grid up to some cells; None without one."""
    points = evidence.table(POINTS).where(scene=scene, method=method, status=FINISHED)
    points = points.rows(points["value"] <= most)
    return (in_seconds(points["median [s]"][-1]), points["setting"][-1]) if len(points["value"]) else None


def a_surface(evidence: Evidence) -> str:
    """Boundary elements press a rough punch."""
    found = finest(evidence, RoughPunchProblem.name, BEM)
    return f"{found[0]} a surface and load, {found[1]}" if found else ""


def a_track(cells: float) -> Timed:
    """Boundary elements roll along a strip, with so many cells to a contact radius."""

    def timed(evidence: Evidence) -> str:
        found = finest(evidence, RollingProblem.name, BEM, cells)
        return f"{found[0]} a strip, {found[1]}" if found else ""

    return timed


def an_integral(evidence: Evidence) -> str:
    found = finest(evidence, RollingProblem.name, FILTER_3D)
    return found[0] if found else ""


def a_wheel(evidence: Evidence) -> str:
    """Boundary elements in each time step of one wheel of Fig. 14.4."""
    (found,) = evidence.table(COST_OF_STEPS).where(method="boundary elements")["one wheel [s]"]
    return f"{in_seconds(found)} a wheel of Fig. 14.4"
