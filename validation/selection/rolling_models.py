"""Models for a wheel that rolls: linear filters in one dimension and in three, springs, boundary elements."""

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from validation.scenes.rolling import RollingScene
from validation.selection.hierarchy import (
    BOUNDARY_ELEMENTS,
    Answer,
    ContactModel,
    distance,
    mean_error,
    realisations,
)
from validation.simulation.calibrated_range import (
    HEIGHT,
    HURST,
    LONG,
    RATIO,
    SHORT,
    Ranges,
    beyond_spectrum,
    counted,
    outside,
)
from validation.simulation.model import Cost, ErrorEstimate
from validation.simulation.rolling_levels import (
    RollingGrid,
    by_linear_theory,
    on_boundary_elements,
    on_springs,
    springs_to_a_radius,
    strip_of,
)
from validation.simulation.rolling_quantity import QuantityName, RollingQuantity
from validation.theory.rolling import contact_lost

FloatArray = NDArray[np.float64]

Rule = tuple[float, float, float]
LINEAR_BANDS: Rule = (2.0, 0.5, 0.015)
LINEAR_RMS: Rule = (1.2, 0.05, 0.002)
GEIKE_BANDS: Rule = (2.0, 0.5, 0.55)
FED_BANDS: Rule = (0.0, 0.6, 0.45)
SPRINGS_RMS: Rule = (1.0, 0.1, 0.002)
"""Errors of linear theory, of that with Geike's spectrum in one dimension, and of springs, in bands and in the rms: a
sum over the contact that linear theory loses, h/d, and one. Envelopes of what was measured beside boundary elements on
random scenes; others hold them to account, see `cases/selection/model_selection.py`."""
FORMULA, NODE, SPRING, CELL, POSITION = 1.0e-4, 4.5e-4, 6.0e-7, 2.0e-8, 1.0e-3
"""Seconds that a formula at a node takes, a quadrature across the track there, a position on springs, a cell in an
application, what else a contact, about."""
STRIP_RMS, STRIP_BANDS = 0.35, 0.7
"""Scatter of one strip over linear theory on itself, over h/d: how many strips are expected."""
MOST_CELLS = 64
"""To a contact radius, on the finest grid that is offered."""
MEASURED_SCATTER = 0.5
"""Of the levels of one track about those of all that have its spectrum."""
TRACKS = 60
OF_COARSE, OF_FINE = 1.8, 0.8
"""Error over the change between two grids in the ratio 1.5, of second order: of the coarse one, of the fine one."""
FEWEST_STRIPS, MOST_STRIPS = 4, 10
MOST_ON_A_STRIP, MOST_ON_TRACKS = 2**26, 2**27
"""Cells and springs that are drawn at once at the most; they take up to four gigabytes."""
FINE, COARSE, LEAST = 4.0, 2.5, 8
"""Cells to the shortest wave on both grids, and to a contact radius at least."""
RANGES: Ranges = {HEIGHT: (0, 1), LONG: (0, 2), SHORT: (0, 40), RATIO: (2, 64), HURST: (0.2, 1.2)}
"""Scenes for which the errors above hold: drawn ones were rolled with h/d from 0.003, q a of the longest wave from
0.2 and bands up to a factor 20 wide. Longer waves only move the contact, which linear theory knows; that it holds
in wider bands is taken from Table 14.1 alone."""


def models(scene: RollingScene, quantity: QuantityName, tolerance: float, seed: int) -> list[ContactModel]:
    """All that a scene can be asked with, the cheapest first. Raises ValueError for a quantity without an answer."""
    asked = RollingQuantity(scene, quantity)
    radii = asked.q_max * scene.contact_radius / (2 * math.pi)
    coarse = min(max(LEAST, math.ceil(COARSE * radii)), MOST_CELLS * 2 // 3)
    fine = min(max(math.ceil(1.5 * coarse), math.ceil(FINE * radii)), MOST_CELLS)
    linear: list[ContactModel] = [LinearFilter(asked)]
    if quantity != "force-rms" or scene.ground.is_single:
        linear.append(LinearSpace(asked))
    return [
        *linear,
        RollingOnSprings(asked, tolerance, seed),
        RollingOnGrid(asked, tolerance, seed, coarse, beside=fine),
        RollingOnGrid(asked, tolerance, seed, fine, beside=coarse),
    ]


@dataclass(frozen=True)
class LinearFilter:
    """(14.12) with Geike's spectrum: exact over ridges; over isotropic ground in the variance of the force alone."""

    kind: ClassVar = "linear filter, 1D"
    name: ClassVar = kind

    quantity: RollingQuantity

    def cost(self) -> Cost:
        """A formula at each node."""
        return Cost(work=self.quantity.nodes, unit="nodes", seconds=FORMULA * self.quantity.nodes)

    def estimate(self) -> ErrorEstimate:
        """By the height, and what Geike's spectrum makes of levels along the track."""
        if said := beyond_spectrum(self.quantity.scene.ground) or _outside(self.quantity):
            return ErrorEstimate.out_of_range(said)
        own = _own_scatter(self.quantity)
        if self.quantity.name == "force-rms":
            error, reason = _claimed(LINEAR_RMS, self.quantity)
            return ErrorEstimate(error=error + own, reason=f"{reason}; Geike's rule keeps the variance of the force")
        error, reason = _claimed(GEIKE_BANDS, self.quantity)
        return ErrorEstimate(error=error + own, reason=f"{reason}; Geike's rule does not keep levels along a track")

    def solve(self) -> Answer:
        """By quadrature."""
        expected = self.estimate()
        value = self.quantity.expected(one_dimensional=True)
        model = expected.error + _left_out(self.quantity, value)
        return Answer(value=value, cost=self.cost(), model=model, reason=expected.reason)


@dataclass(frozen=True)
class LinearSpace:
    """The spectrum of the force on the half-space, for a contact that keeps its radius; of heights, on themselves."""

    kind: ClassVar = "linear filter, 3D"
    name: ClassVar = kind

    quantity: RollingQuantity

    def cost(self) -> Cost:
        """A quadrature across the track at each node."""
        return Cost(work=self.quantity.nodes, unit="quadratures", seconds=NODE * self.quantity.nodes)

    def estimate(self) -> ErrorEstimate:
        """By the height."""
        if said := self.quantity.scene.ground.not_gaussian() or _outside(self.quantity):
            return ErrorEstimate.out_of_range(said)
        error, reason = _claimed(LINEAR_RMS if self.quantity.name == "force-rms" else LINEAR_BANDS, self.quantity)
        return ErrorEstimate(error=error, reason=reason)

    def solve(self) -> Answer:
        """By quadrature, or on the heights themselves."""
        quantity, expected = self.quantity, self.estimate()
        if quantity.scene.ground.is_single:
            cells = max(LEAST, math.ceil(FINE * quantity.q_max * quantity.scene.contact_radius / (2 * math.pi)))
            spacing = quantity.scene.contact_radius / cells
            value = by_linear_theory(quantity, strip_of(quantity, cells, 0, 0), spacing)
        else:
            value = quantity.expected(one_dimensional=False)
        if not (value > 0).all():
            return Answer(value=value, cost=self.cost(), failed="the heights have no waves in some band")
        model = expected.error + _left_out(quantity, value)
        return Answer(value=value, cost=self.cost(), model=model, reason=expected.reason)


@dataclass(frozen=True)
class RollingOnSprings:
    """One-sided springs, over what the linear filter has on the same tracks, times what linear theory expects."""

    kind: ClassVar = "springs"
    name: ClassVar = kind

    quantity: RollingQuantity
    tolerance: float
    seed: int

    def cost(self) -> Cost:
        """Positions of all tracks, and what linear theory expects."""
        work = TRACKS * RollingGrid.of(self.quantity, 1).along * springs_to_a_radius(self.quantity)
        nodes = 0 if self.quantity.name == "force-rms" else self.quantity.nodes
        return Cost(work=work, unit="positions", seconds=SPRING * work + NODE * nodes)

    def estimate(self) -> ErrorEstimate:
        """By the height."""
        if said := beyond_spectrum(self.quantity.scene.ground) or _outside(self.quantity):
            return ErrorEstimate.out_of_range(said)
        springs = self.cost().work
        if springs > MOST_ON_TRACKS:
            return ErrorEstimate.out_of_range(
                f"{TRACKS} tracks need {springs:.2g} springs, more than {MOST_ON_TRACKS:.2g}"
            )
        own = _own_scatter(self.quantity) + self.tolerance / 10
        if self.quantity.name == "force-rms":
            error, reason = _claimed(SPRINGS_RMS, self.quantity)
            return ErrorEstimate(error=error + own, reason=reason)
        error, reason = _claimed(FED_BANDS, self.quantity)
        return ErrorEstimate(
            error=error + own, reason=f"{reason}; springs have the right level only in the mean over bands"
        )

    def solve(self) -> Answer:
        """The mean of logarithms over all tracks."""
        expected = self.estimate()
        change = on_springs(self.quantity, TRACKS, self.seed)
        if not np.isfinite(change).all():
            failed = "a wheel lifted off farther than the sums are exact for"
            return Answer(value=np.array([np.nan]), cost=self.cost(), failed=failed)
        value = self.quantity.expected(one_dimensional=self.quantity.name == "force-rms") * np.exp(change.mean(axis=0))
        return Answer(
            value=value,
            cost=self.cost(),
            model=expected.error + _left_out(self.quantity, value),
            sample=mean_error(change),
            reason=expected.reason,
        )


@dataclass(frozen=True)
class RollingOnGrid:
    """A contact a cell, over linear theory on the same strips, times what that expects; heights are rolled themselves.

    beside: the grid that is asked, on one strip, what the cells leave open.
    """

    kind: ClassVar = BOUNDARY_ELEMENTS

    quantity: RollingQuantity
    tolerance: float
    seed: int
    cells: int
    beside: int

    @property
    def name(self) -> str:
        """With the cells of its grid."""
        return f"{self.kind}, a = {self.cells} cells"

    def cost(self) -> Cost:
        """Cells of the window times applications times positions, of all strips and the one beside."""
        strips = realisations(self._scatter, self.tolerance / 2, least=FEWEST_STRIPS, most=MOST_STRIPS)
        return self._cost(1 if self.quantity.scene.ground.is_single else strips, 1)

    def estimate(self) -> ErrorEstimate:
        """Of the sample what as many strips as there may be leave at the least; only a solve tells of the grid."""
        if said := self.quantity.unsteady or self._too_large():
            return ErrorEstimate.out_of_range(said)
        sample = 0.0 if self.quantity.scene.ground.is_single else self._scatter / math.sqrt(MOST_STRIPS)
        return ErrorEstimate(error=sample, reason=f"sampling error of {MOST_STRIPS} strips, without the grid error")

    @property
    def _scatter(self) -> float:
        """Of one strip over linear theory on itself, about."""
        return (STRIP_RMS if self.quantity.whole else STRIP_BANDS) * self.quantity.scene.roughness_ratio

    def solve(self) -> Answer:
        """Strip by strip, until the sample leaves half of the tolerance."""
        change: list[FloatArray] = []
        while not self._enough(change):
            change.append(self._rolled(len(change), self.cells))
        other = self._rolled(0, self.beside)
        cost = self._cost(len(change), 1)
        if not (np.isfinite(change).all() and np.isfinite(other).all()):
            return Answer(value=np.array([np.nan]), cost=cost, failed="a contact along a strip did not converge")
        mean, apart = np.mean(change, axis=0), distance(np.exp(change[0]), np.exp(other))
        return Answer(
            value=np.exp(mean)
            * (1.0 if self.quantity.scene.ground.is_single else self.quantity.expected(one_dimensional=False)),
            cost=cost,
            grid=apart * (OF_COARSE if self.beside > self.cells else OF_FINE),
            sample=0.0 if self.quantity.scene.ground.is_single else mean_error(np.array(change)),
            reason=f"{self._waves:.2g} cells to the shortest wave; a = {self.beside} cells change the result by "
            f"{apart:.1%}; strips: {len(change)}",
        )

    def _enough(self, change: list[FloatArray]) -> bool:
        """Whether the sample leaves half of the tolerance, or there is no more of it, or no use in more."""
        if self.quantity.scene.ground.is_single or not np.isfinite(change).all():
            return len(change) > 0
        if len(change) < FEWEST_STRIPS:
            return False
        return len(change) >= MOST_STRIPS or mean_error(np.array(change)) <= self.tolerance / 2

    def _cost(self, strips: int, beside: int) -> Cost:
        """Cells of the window times applications times positions, of strips on this grid and on the other."""
        rolled = (
            (strips, RollingGrid.of(self.quantity, self.cells)),
            (beside, RollingGrid.of(self.quantity, self.beside)),
        )
        work, positions = sum(n * grid.work for n, grid in rolled), sum(n * grid.along for n, grid in rolled)
        return Cost(work=work, unit="cell applications", seconds=CELL * work + POSITION * positions)

    def _too_large(self) -> str:
        """Why no grid that fits into memory holds the waves; empty where one does."""
        waves = min(self.cells, self.beside) / self.cells * self._waves
        if waves < 2:
            return f"the shortest wave has {waves:.2g} cells on the finest grids that are offered, fewer than 2"
        grid = RollingGrid.of(self.quantity, max(self.cells, self.beside))
        if grid.along * grid.across > MOST_ON_A_STRIP:
            return f"a strip needs {grid.along} x {grid.across} cells, more than {MOST_ON_A_STRIP:.2g}"
        return ""

    @property
    def _waves(self) -> float:
        """Cells to the shortest wave."""
        return 2 * math.pi * self.cells / (self.quantity.q_max * self.quantity.scene.contact_radius)

    def _rolled(self, realisation: int, cells: int) -> FloatArray:
        """ln of levels over those of linear theory on the same strip; of heights, of the levels themselves."""
        return on_boundary_elements(self.quantity, cells, realisation, self.seed)


def _outside(quantity: RollingQuantity) -> str:
    """Why the errors of cheap models are not known for a scene; empty where they are."""
    if said := quantity.unsteady:
        return said
    scene, ground = quantity.scene, quantity.scene.ground
    first, last = (q * scene.contact_radius for q in (ground.q_min, quantity.q_max))
    conditions = {HEIGHT: scene.roughness_ratio, LONG: first, SHORT: last, RATIO: last / first}
    if ground.hurst is not None:
        conditions[HURST] = ground.hurst
    return outside(conditions, RANGES)


def _own_scatter(quantity: RollingQuantity) -> float:
    """Of one measured track about all that have its spectrum."""
    return MEASURED_SCATTER if quantity.scene.ground.is_single else 0.0


def _left_out(quantity: RollingQuantity, value: FloatArray) -> float:
    """Error of bands in which measured heights have next to no waves: what linear theory leaves out fills them.

    That is h/d of the level of all bands, in each of them; a drawn band has waves of its own throughout.
    """
    if not quantity.scene.ground.is_single or value.size == 1:
        return 0.0
    other = quantity.scene.roughness_ratio * float(np.linalg.norm(value))
    return distance(np.hypot(value, other), value)


def _claimed(rule: Rule, quantity: RollingQuantity) -> tuple[float, str]:
    """The error by a rule, and what it rests on."""
    scene, ratio = quantity.scene, quantity.scene.roughness_ratio * quantity.amplification
    lost = contact_lost(
        scene.ground.c2d, edges=scene.ground.edges, contact_radius=scene.contact_radius, radius=scene.radius
    )
    error = float(np.dot(rule, (lost, ratio, 1.0)))
    height = "h/d, by the resonance" if quantity.amplification > 1 else "h/d"
    return error, counted({"loss of contact by linear theory": lost, height: ratio})


CHEAP = (LinearFilter.kind, LinearSpace.kind, RollingOnSprings.kind)
"""The models below boundary elements, by their names."""
