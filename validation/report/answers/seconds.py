"""What a model costs in seconds, as `precision` has timed it: behind its name on the front page."""

import math
from collections.abc import Callable

from validation.analysis.evidence import Evidence
from validation.analysis.number_text import in_seconds
from validation.benchmarks.timing import FINISHED
from validation.benchmarks.work_precision.case import POINTS
from validation.benchmarks.work_precision.figure_cost import COST_OF_STEPS
from validation.benchmarks.work_precision.pressed import RoughPunchProblem
from validation.benchmarks.work_precision.problem import BEM, FILTER_3D
from validation.benchmarks.work_precision.rolling import RollingProblem

TIMES = "precision"
"""The case that times all methods."""
ENOUGH = {"%": 10.0, "dB": 1.0}
"""Largest error of what is enough, as in the verdicts of `precision`."""
Timed = Callable[[Evidence], str]


def timed_at(
    evidence: Evidence, scene: str, method: str, quantity: str = "", most: float = math.inf
) -> tuple[str, str] | None:
    """Median seconds and the setting of a method on a scene, None without one.

    On the coarsest grid that is enough for a quantity; without one on the finest up to some cells.
    """
    points = evidence.table(POINTS).where(scene=scene, method=method, status=FINISHED)
    if quantity:
        points = points.where(quantity=quantity)
        close = points.rows(points["error"] + points["± sample"] <= ENOUGH["%"] / 100)
        at = 0
    else:
        close, at = points.rows(points["value"] <= most), -1
    return (in_seconds(close["median [s]"][at]), close["setting"][at]) if len(close["value"]) else None


def a_surface(quantity: str = "") -> Timed:
    """Boundary elements press a rough punch."""

    def timed(evidence: Evidence) -> str:
        timing = timed_at(evidence, RoughPunchProblem.name, BEM, quantity)
        return f"{timing[0]} a surface and load, {timing[1]}" if timing else ""

    return timed


def a_track(cells: float) -> Timed:
    """Boundary elements roll along a strip, with so many cells to a contact radius."""

    def timed(evidence: Evidence) -> str:
        timing = timed_at(evidence, RollingProblem.name, BEM, most=cells)
        return f"{timing[0]} a strip, {timing[1]}" if timing else ""

    return timed


def an_integral(evidence: Evidence) -> str:
    timing = timed_at(evidence, RollingProblem.name, FILTER_3D)
    return timing[0] if timing else ""


def a_wheel(evidence: Evidence) -> str:
    """Boundary elements in each time step of one wheel of Fig. 14.4."""
    (seconds,) = evidence.table(COST_OF_STEPS).where(method="boundary elements")["one wheel [s]"]
    return f"{in_seconds(seconds)} a wheel of Fig. 14.4"
