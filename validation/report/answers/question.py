"""A question of the first screen: which numbers answer it, what else to take, and what that costs in seconds.

Seconds are those that `precision` has timed; they stand behind the name of a model on the front page.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from validation.analysis.evidence import Evidence
from validation.analysis.number_text import in_seconds
from validation.benchmarks.timing import FINISHED
from validation.benchmarks.work_precision.case import POINTS
from validation.benchmarks.work_precision.figure_cost import COST_OF_STEPS
from validation.benchmarks.work_precision.problem import BEM as FINER_CELLS
from validation.benchmarks.work_precision.problem import FILTER_3D, RollingProblem, RoughPunchProblem
from validation.report.answers.strip import Source

TIMES = "precision"
"""The case that times all methods."""
ENOUGH = {"%": 10.0, "dB": 1.0}
"""Tolerances of `precision`, the loosest in per cent."""
Timed = Callable[[Evidence], str]


def timed_at(
    evidence: Evidence, scene: str, method: str, quantity: str = "", most: float = math.inf
) -> tuple[str, str] | None:
    """Median seconds and the setting of a method on a scene, None without one.

    On the coarsest grid whose error, and that of all finer ones, is within 10 %; without a quantity on the finest up
    to some cells.
    """
    points = evidence.table(POINTS).where(scene=scene, method=method, status=FINISHED)
    if quantity:
        points = points.where(quantity=quantity)
        # the coarsest from which on no finer one has a larger error
        largest = np.maximum.accumulate(points["error"][::-1])[::-1]
        close, at = points.rows(largest <= ENOUGH["%"] / 100), 0
    else:
        close, at = points.rows(points["value"] <= most), -1
    return (in_seconds(close["median [s]"][at]), close["setting"][at]) if len(close["value"]) else None


def a_surface(quantity: str = "") -> Timed:
    """Boundary elements press a rough punch."""

    def timed(evidence: Evidence) -> str:
        timing = timed_at(evidence, RoughPunchProblem.name, FINER_CELLS, quantity)
        return f"{timing[0]} a surface and load, {timing[1]}" if timing else ""

    return timed


def a_track(cells: float) -> Timed:
    """Boundary elements roll along a strip, with so many cells to a contact radius."""

    def timed(evidence: Evidence) -> str:
        timing = timed_at(evidence, RollingProblem.name, FINER_CELLS, most=cells)
        return f"{timing[0]} a strip, {timing[1]}" if timing else ""

    return timed


def an_integral(evidence: Evidence) -> str:
    timing = timed_at(evidence, RollingProblem.name, FILTER_3D)
    return timing[0] if timing else ""


def a_wheel(evidence: Evidence) -> str:
    """Boundary elements in each time step of one wheel of Fig. 14.4."""
    (seconds,) = evidence.table(COST_OF_STEPS).where(method="boundary elements")["one wheel [s]"]
    return f"{in_seconds(seconds)} a wheel of Fig. 14.4"


INTEGRAL = "an integral over the spectrum"
"""What linear models cost, in words."""
CONTACT, SPRINGS, BEM = "roughness and contact", "springs, Geike's rule", "boundary elements"
Printed = Callable[[float], str]
"""From the difference of a number in decibels to a text with its unit."""


@dataclass(frozen=True)
class Alternative:
    """What could be taken in the place of MDR; without a source it is what the others are judged by.

    cost: in words; timed: its seconds, of the evidence of `precision`; by: what its margin is of, where that is not the
    quantity of the question.
    """

    name: str
    source: Source | None = None
    cost: str = ""
    timed: Timed | None = None
    by: str = ""


@dataclass(frozen=True)
class Question:
    """A row of the first screen.

    asks: without "is MDR enough?"; source: its numbers; printed: their differences; instead: the cheapest first; model:
    what stands for MDR; of_scene: a table and the column of it that says what else the numbers were measured for.
    """

    name: str
    asks: str
    source: Source
    printed: Printed
    instead: tuple[Alternative, ...]
    model: str = SPRINGS
    of_scene: tuple[str, str] | None = None
