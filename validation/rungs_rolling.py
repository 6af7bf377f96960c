"""Rungs for a wheel that rolls: linear filters in one dimension and in three, springs, boundary elements."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from validation.ladder import Answer, Claim, Cost, Rung, counted, distance, mean_error
from validation.measured import MeasuredHeights
from validation.rolled import Rolled, by_linear_theory, on_boundary_elements, on_springs, strip_of
from validation.rolling_question import Question, Want
from validation.rolling_scene import RollingScene
from validation.rolling_theory import contact_lost

FloatArray = NDArray[np.float64]

Rule = tuple[float, float, float]
LINEAR_BANDS: Rule = (2.0, 0.5, 0.015)
LINEAR_RMS: Rule = (1.2, 0.05, 0.002)
GEIKE_BANDS: Rule = (2.0, 0.5, 0.55)
FED_BANDS: Rule = (0.0, 0.6, 0.45)
SPRINGS_RMS: Rule = (1.0, 0.1, 0.002)
"""Errors of linear theory, of that with Geike's spectrum in one dimension, and of springs, in bands and in the rms: a
sum over the contact that linear theory loses, h/d, and one. Envelopes of what was measured beside boundary elements on
random scenes; others hold them to account, see `cases/ladder.py`."""
NODE, SPRING, CELL, POSITION = 3.0e-4, 2.0e-7, 3.0e-8, 1.5e-3
"""Seconds that a node of the quadrature takes, a position on springs, a cell in an application, what else a contact."""
MOST_CELLS = 64
"""To a contact radius, on the finest grid that is offered."""
MEASURED_SCATTER = 0.5
"""Of the levels of one track about those of all that have its spectrum."""
TRACKS = 60
FEWEST_STRIPS, MOST_STRIPS = 4, 10
FINE, COARSE, LEAST = 4.0, 2.5, 8
"""Cells to the shortest wave on both grids, and to a contact radius at least."""


def rungs(scene: RollingScene, want: Want, tolerance: float, seed: int) -> list[Rung]:
    """All that a scene can be asked with, the cheapest first. Raises ValueError for a question without an answer."""
    if want.startswith("acceleration") and scene.mass is None:
        raise ValueError(f"--want {want} needs a wheel with mass and speed, got scene {scene.name!r} without")
    question = Question(scene, want)
    radii = question.q_max * scene.contact_radius / (2 * math.pi)
    coarse = min(max(LEAST, math.ceil(COARSE * radii)), MOST_CELLS * 2 // 3)
    fine = min(max(math.ceil(1.5 * coarse), math.ceil(FINE * radii)), MOST_CELLS)
    linear: list[Rung] = [LinearFilter(question)]
    if want != "force-rms" or isinstance(scene.ground, MeasuredHeights):
        linear.append(LinearSpace(question))
    return [
        *linear,
        Springs(question, tolerance, seed),
        BoundaryElements(question, tolerance, seed, coarse, beside=fine),
        BoundaryElements(question, tolerance, seed, fine, beside=coarse),
    ]


@dataclass(frozen=True)
class LinearFilter:
    """(14.12) with Geike's spectrum: exact over ridges; over isotropic ground in the variance of the force alone."""

    question: Question

    @property
    def name(self) -> str:
        """For tables."""
        return "linear filter, 1D"

    def cost(self) -> Cost:
        """A formula at each node."""
        return Cost(work=self.question.nodes, unit="nodes", seconds=1e-6 * self.question.nodes)

    def claim(self) -> Claim:
        """By the height, and what Geike's spectrum makes of levels along the track."""
        own = MEASURED_SCATTER if isinstance(self.question.scene.ground, MeasuredHeights) else 0.0
        if self.question.want == "force-rms":
            error, because = _claimed(LINEAR_RMS, self.question)
            return Claim(error=error + own, because=f"{because}; Geike's rule keeps the variance of the force")
        error, because = _claimed(GEIKE_BANDS, self.question)
        return Claim(error=error + own, because=f"{because}; Geike's rule does not keep levels along a track")

    def solve(self) -> Answer:
        """By quadrature."""
        claim = self.claim()
        value = self.question.expected(one_dimensional=True)
        return Answer(value=value, model=claim.error, work=self.question.nodes, because=claim.because)


@dataclass(frozen=True)
class LinearSpace:
    """The spectrum of the force on the half-space, for a contact that keeps its radius; of heights, on themselves."""

    question: Question

    @property
    def name(self) -> str:
        """For tables."""
        return "linear filter, 3D"

    def cost(self) -> Cost:
        """A quadrature across the track at each node."""
        return Cost(work=self.question.nodes, unit="quadratures", seconds=NODE * self.question.nodes)

    def claim(self) -> Claim:
        """By the height."""
        error, because = _claimed(LINEAR_RMS if self.question.whole else LINEAR_BANDS, self.question)
        return Claim(error=error, because=because)

    def solve(self) -> Answer:
        """By quadrature, or on the heights themselves."""
        question, claim = self.question, self.claim()
        if isinstance(question.scene.ground, MeasuredHeights):
            spacing = question.scene.contact_radius / LEAST
            value = by_linear_theory(question, strip_of(question, LEAST, 0, 0), spacing)
        else:
            value = question.expected(one_dimensional=False)
        return Answer(value=value, model=claim.error, work=question.nodes, because=claim.because)


@dataclass(frozen=True)
class Springs:
    """One-sided springs, over what the linear filter has on the same tracks, times what linear theory expects."""

    question: Question
    tolerance: float
    seed: int

    @property
    def name(self) -> str:
        """For tables."""
        return "springs"

    def cost(self) -> Cost:
        """Positions of all tracks."""
        work = TRACKS * Rolled.of(self.question, LEAST).along * 4
        return Cost(work=work, unit="positions", seconds=SPRING * work)

    def claim(self) -> Claim:
        """By the height."""
        own = self._own_scatter + self.tolerance / 10
        if self.question.want == "force-rms":
            error, because = _claimed(SPRINGS_RMS, self.question)
            return Claim(error=error + own, because=because)
        error, because = _claimed(FED_BANDS, self.question)
        return Claim(error=error + own, because=f"{because}; springs have the right level only in the mean over bands")

    def solve(self) -> Answer:
        """The mean of logarithms over all tracks."""
        claim = self.claim()
        change = on_springs(self.question, TRACKS, self.seed)
        if not np.isfinite(change).all():
            return Answer(value=np.array([np.nan]), failed="a wheel was thrown farther than sums are exact for")
        return Answer(
            value=self.question.expected(one_dimensional=self.question.want == "force-rms")
            * np.exp(change.mean(axis=0)),
            model=claim.error,
            sample=mean_error(change),
            work=self.cost().work,
            because=claim.because,
        )

    @property
    def _own_scatter(self) -> float:
        return MEASURED_SCATTER if isinstance(self.question.scene.ground, MeasuredHeights) else 0.0


@dataclass(frozen=True)
class BoundaryElements:
    """A contact a cell, over linear theory on the same strips, times what that expects; heights are rolled themselves.

    beside: the grid that is asked, on one strip, what the cells leave open.
    """

    question: Question
    tolerance: float
    seed: int
    cells: int
    beside: int

    @property
    def name(self) -> str:
        """For tables."""
        return f"boundary elements, a = {self.cells} cells"

    def cost(self) -> Cost:
        """Cells of the window times applications times positions, of all strips and the one beside."""
        work = sum(n * Rolled.of(self.question, c).work for n, c in ((FEWEST_STRIPS, self.cells), (1, self.beside)))
        return Cost(work=work, unit="cell applications", seconds=CELL * work + POSITION * self._positions)

    def claim(self) -> Claim:
        """Only a solve tells what grid and sample leave."""
        return Claim(error=0.0, because="grid and sample are judged once they are solved")

    def solve(self) -> Answer:
        """Strip by strip, until the sample leaves half of the tolerance."""
        change: list[FloatArray] = []
        measured = isinstance(self.question.scene.ground, MeasuredHeights)
        while len(change) < (1 if measured else MOST_STRIPS):
            found = self._rolled(len(change), self.cells)
            if not np.isfinite(found).all():
                return Answer(value=np.array([np.nan]), failed=f"strip {len(change)} did not converge")
            change.append(found)
            if len(change) >= FEWEST_STRIPS and mean_error(np.array(change)) <= self.tolerance / 2:
                break
        other = self._rolled(0, self.beside)
        if not np.isfinite(other).all():
            return Answer(value=np.array([np.nan]), failed=f"strip 0 did not converge on {self.beside} cells")
        mean = np.mean(change, axis=0)
        return Answer(
            value=np.exp(mean) * (1.0 if measured else self.question.expected(one_dimensional=False)),
            grid=distance(np.exp(change[0]), np.exp(other)) * (1.0 if self.beside > self.cells else 0.5),
            sample=0.0 if measured else mean_error(np.array(change)),
            work=self.cost().work * len(change) / FEWEST_STRIPS,
            because=f"{self._waves:.2g} cells to the shortest wave; a = {self.beside} cells change it by "
            f"{distance(np.exp(change[0]), np.exp(other)):.1%}; strips: {len(change)}",
        )

    @property
    def _waves(self) -> float:
        """Cells to the shortest wave."""
        return 2 * math.pi * self.cells / (self.question.q_max * self.question.scene.contact_radius)

    @property
    def _positions(self) -> int:
        """Contacts of all strips and the one beside."""
        return sum(n * Rolled.of(self.question, c).along for n, c in ((FEWEST_STRIPS, self.cells), (1, self.beside)))

    def _rolled(self, realisation: int, cells: int) -> FloatArray:
        """ln of levels over those of linear theory on the same strip; of heights, of the levels themselves."""
        return on_boundary_elements(self.question, cells, realisation, self.seed)


def _claimed(rule: Rule, question: Question) -> tuple[float, str]:
    """The error by a rule, and what it rests on."""
    scene, ratio = question.scene, question.scene.roughness_ratio
    lost = contact_lost(
        scene.ground.c2d, edges=scene.ground.edges, contact_radius=scene.contact_radius, radius=scene.radius
    )
    error = float(np.dot(rule, (lost, ratio, 1.0)))
    return error, counted({"contact that linear theory loses": lost, "h/d": ratio})
