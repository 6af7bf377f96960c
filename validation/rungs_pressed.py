"""Rungs for a body that is pressed: closed form, springs, boundary elements coarse and fine; the stiffness."""

import math
import warnings
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import bem3d
import mdr
from validation.closed_forms import rough_punch_stiffness
from validation.ensemble import generator
from validation.ladder import STUDENT, Answer, Claim, Cost, Rung, counted, mean_error, realisations
from validation.measured import MeasuredHeights
from validation.pressed_scene import PressedScene
from validation.roughness import Roughness

FloatArray = NDArray[np.float64]

PROFILES, SURFACES = 1, 2
"""The spawn keys under which each kind of roughness draws."""
SCATTER = 0.22
"""Relative deviation of the stiffness of one rough punch without roll-off, about: Fig. 14.1."""
SPHERE_SCATTER = 0.3
"""The same of a rough sphere, over h/d."""
FORMULA, SPRING, CELL, PRESS = 2.0e-5, 3.5e-8, 2.0e-8, 3.5e-3
"""Seconds that a formula takes, a spring in a sort, a cell in an application, what else a contact, about."""
APPLICATIONS = 24
"""Of the operator, to a contact and its stiffness."""
FEW, MANY = 16, 512
"""Cells a side of the coarsest grid that is worth a solve, and of the finest that is offered."""
WAVE = 8
"""Cells to the shortest wave on the finest grid."""
SPRINGS_TO_A_WAVE = 8
FEWEST, MOST = 8, 1000
"""Surfaces: of which a deviation is estimated, and that are drawn at the most."""
DEEPEST = 4.0
"""Heights of roughness, in rms, that a rough sphere may carry outside of its smooth contact."""
PUNCH_CLOSED = (
    np.array([-0.7, -0.5, -0.3, -0.15, 0.0, 0.3, 0.5, 0.8, 1.0, 1.5]),
    np.array([0.25, 0.10, 0.07, 0.080, 0.07, 0.055, 0.06, 0.075, 0.06, 0.03]),
)
"""lg Fbar, and the error there of a flat punch in series with its rough face, H from 0.3 to 1, as measured in 3D;
below its range, none; above, it falls like 1 / Fbar."""
CLOSED_ROLL_OFF = 0.015
"""By which that grows with each more of the longest waves on a side."""
PUNCH_SPRINGS = (
    np.array([-3.0, -2.5, -2.0, -1.5, -0.5, -0.2, 0.0, 0.3, 0.5, 0.7, 0.85, 1.0]),
    np.array([0.18, 0.15, 0.12, 0.075, 0.065, 0.075, 0.12, 0.12, 0.08, 0.12, 0.14, 0.16]),
)
"""lg Fbar, and the error of springs there without roll-off, H from 0.4 to 1: beside boundary elements."""
ROLL_OFF = 0.06
"""By which it grows with each more of the longest waves on a side."""
SPHERE_CLOSED, SPHERE_SPRINGS, SPHERE_FLOOR = 0.32, 0.15, 0.01
"""Errors of a rough sphere, over h/d; and what the finest grid leaves."""
RADIUS = 16
"""Cells to the contact radius of a smooth sphere, on the finest grid."""


def rungs(scene: PressedScene, tolerance: float, seed: int) -> list[Rung]:
    """All that a scene can be asked with, the cheapest first."""
    if scene.ground is None:
        return [ClosedForm(scene)]
    finest = _cells(scene)
    grids = [cells for cells in (finest // 4, finest // 2, finest) if cells >= FEW]
    solved = [BoundaryElements(scene, tolerance, seed, cells) for cells in grids]
    return [ClosedForm(scene), Springs(scene, tolerance, seed), *solved]


@dataclass(frozen=True)
class ClosedForm:
    """2 E* a of a smooth sphere, whose roughness is the error; a rough punch is a flat one in series with its face."""

    scene: PressedScene

    @property
    def name(self) -> str:
        """For tables."""
        return "closed form"

    def cost(self) -> Cost:
        """A formula."""
        return Cost(work=1, unit="formula", seconds=FORMULA)

    def claim(self) -> Claim:
        """By the load or the height."""
        if self.scene.ground is None:
            return Claim(error=0.0, because="the body is smooth, the formula exact")
        if said := beyond_spectra(self.scene.ground):
            return Claim(error=math.inf, because=said)
        if self.scene.shape == "punch":
            return self._of_a_punch()
        ratio = self.scene.roughness_ratio
        return Claim(error=SPHERE_CLOSED * ratio + SPHERE_FLOOR, because=counted({"h/d": ratio}))

    def solve(self) -> Answer:
        """Evaluate it."""
        claim = self.claim()
        return Answer(value=np.array([self._stiffness]), cost=self.cost(), model=claim.error, because=claim.because)

    @property
    def _stiffness(self) -> float:
        scene = self.scene
        if scene.shape == "sphere" or scene.ground is None:
            return scene.stiffness
        height = scene.ground.rms
        return rough_punch_stiffness(side=scene.size, modulus=scene.modulus, force=scene.load, height=height)

    def _of_a_punch(self) -> Claim:
        """By the load, as measured; a measured face is one of many that have its spectrum."""
        ground, load = _ground(self.scene), self.scene.reduced_load
        waves = ground.q_min * self.scene.size / (2 * math.pi)
        power, last = math.log10(load), float(PUNCH_CLOSED[0][-1])
        if power < PUNCH_CLOSED[0][0]:
            return Claim(error=math.inf, because=f"{counted({'F / (E* h L)': load})}, too low for a law of interfaces")
        error = float(np.interp(power, *PUNCH_CLOSED)) * 10 ** min(last - power, 0.0)
        own = 2 * SCATTER / max(load, 1.0) ** 2 if isinstance(ground, MeasuredHeights) else 0.0
        because = counted({"F / (E* h L)": load, "longest waves on a side": waves})
        return Claim(error=error + CLOSED_ROLL_OFF * max(waves - 1, 0.0) + own, because=because)


@dataclass(frozen=True)
class Springs:
    """MDR with profiles of Geike's spectrum, L_1D = L; of a measured surface, those of its spectrum."""

    scene: PressedScene
    tolerance: float
    seed: int

    @property
    def name(self) -> str:
        """For tables."""
        return "springs"

    @property
    def points(self) -> int:
        """Springs of a profile: eight to the shortest wave."""
        return max(256, math.ceil(SPRINGS_TO_A_WAVE * self.length * _ground(self.scene).q_max / (2 * math.pi)))

    @property
    def length(self) -> float:
        """Of a profile [m]."""
        return _side(self.scene)

    @property
    def count(self) -> int:
        """Profiles: so many that the sample leaves a fifth of the tolerance."""
        return realisations(SCATTER, self.tolerance / 5, least=50)

    def cost(self) -> Cost:
        """A sort a profile."""
        work = self.count * self.points
        return Cost(work=work, unit="springs", seconds=1e-3 + SPRING * work)

    def claim(self) -> Claim:
        """By the load, the height and the waves on a side, as measured beside boundary elements."""
        if said := beyond_spectra(_ground(self.scene)):
            return Claim(error=math.inf, because=said)
        model, because = _springs_model(self.scene)
        return Claim(error=model + self.tolerance / 5 + self._own_scatter, because=because)

    def solve(self) -> Answer:
        """The mean stiffness of all profiles."""
        scene, ground, length = self.scene, _ground(self.scene), self.length
        x = (np.arange(self.points) + 0.5) * length / self.points - length / 2
        wheel = mdr.sphere_profile(x, radius=scene.size) if scene.shape == "sphere" else np.zeros(self.points)
        profiles = mdr.rough_profiles(
            lambda q: mdr.geike(q, ground.c2d),
            length=length,
            points=self.points,
            count=self.count,
            rng=generator(self.seed, PROFILES),
            rms=ground.rms,
        )
        found = mdr.stiffness_under(scene.load, profiles - wheel, length=length, modulus=scene.modulus)
        model, because = _springs_model(scene)
        return Answer(
            value=np.array([found.mean()]),
            cost=self.cost(),
            model=model + self._own_scatter,
            sample=mean_error(found[:, np.newaxis] / found.mean()),
            because=because,
        )

    @property
    def _own_scatter(self) -> float:
        """Of one surface about the mean of all that have its spectrum, which is all that springs know."""
        return 2 * SCATTER if isinstance(self.scene.ground, MeasuredHeights) else 0.0


@dataclass(frozen=True)
class BoundaryElements:
    """Surfaces on cells x cells, with the waves that those carry: what half as many a side change is the error.

    A measured surface is itself; on a coarser grid, the mean of its points in each cell.
    """

    scene: PressedScene
    tolerance: float
    seed: int
    cells: int

    @property
    def name(self) -> str:
        """For tables."""
        return f"boundary elements {self.cells}²"

    @property
    def measured(self) -> bool:
        """Whether there is a single surface."""
        return isinstance(self.scene.ground, MeasuredHeights)

    @property
    def count(self) -> int:
        """Surfaces that are expected to leave half of the tolerance."""
        return 1 if self.measured else realisations(self._scatter, self.tolerance / 2, least=FEWEST, most=MOST)

    @property
    def _scatter(self) -> float:
        """Of one drawn surface, relative, about."""
        return SCATTER if self.scene.shape == "punch" else SPHERE_SCATTER * self.scene.roughness_ratio

    def cost(self) -> Cost:
        """Operator applications times cells, on this grid and for some surfaces on the next coarser one."""
        return self._cost(self.count, min(self.count, FEWEST))

    def claim(self) -> Claim:
        """The sample's part: only a solve tells what the grid leaves."""
        sample = 0.0 if self.measured else max(self.tolerance / 2, STUDENT * self._scatter / math.sqrt(MOST))
        return Claim(error=sample, because="the grid is judged by the next coarser one, once both are solved")

    def solve(self) -> Answer:
        """The mean stiffness, surface by surface until the sample leaves half of the tolerance."""
        found: list[float] = []
        while not self._enough(found):
            found.append(self._pressed(len(found), self.cells))
        coarse = np.array([self._pressed(i, self.cells // 2) for i in range(min(len(found), FEWEST))])
        fine = np.array(found)
        cost = self._cost(fine.size, coarse.size)
        lost = int(np.count_nonzero(np.isnan(fine)) + np.count_nonzero(np.isnan(coarse)))
        if lost:
            failed = f"{lost} of {fine.size + coarse.size} contacts did not converge"
            return Answer(value=np.array([np.nan]), cost=cost, failed=failed)
        change = np.log(fine[: coarse.size] / coarse)[:, np.newaxis]
        return Answer(
            value=np.array([fine.mean()]),
            cost=cost,
            grid=self._grid_of_one(fine[0], coarse[0]) if self.measured else abs(change.mean()) + mean_error(change),
            sample=0.0 if self.measured else mean_error(fine[:, np.newaxis] / fine.mean()),
            because=f"{self.cells}² cells change {self.cells // 2}² by {math.expm1(float(change.mean())):+.1%}, "
            f"surfaces: {fine.size}",
        )

    def _cost(self, fine: int, coarse: int) -> Cost:
        """Of surfaces on this grid, and on the next coarser one."""
        work = APPLICATIONS * self.cells**2 * (fine + coarse / 4)
        return Cost(work=work, unit="cell applications", seconds=CELL * work + PRESS * (fine + coarse))

    def _grid_of_one(self, fine: float, coarse: float) -> float:
        """The change by the last doubling or half of that before, with half as much again: one face may hide it.

        And as much for each doubling that is left to the finest grid, which has waves that this one has not.
        """
        coarser = self._pressed(0, self.cells // 4) if self.cells >= 4 * FEW else coarse
        change = max(abs(math.log(fine / coarse)), abs(math.log(coarse / coarser)) / 2)
        return 1.5 * change * (1 + math.log2(_cells(self.scene) / self.cells))

    def _enough(self, found: list[float]) -> bool:
        if self.measured or len(found) < FEWEST:
            return self.measured and len(found) == 1
        drawn = np.array(found)
        left = mean_error(drawn[:, np.newaxis] / drawn.mean())
        return not left > self.tolerance / 2 or len(found) >= MOST

    def _pressed(self, realisation: int, cells: int) -> float:
        scene, side = self.scene, _side(self.scene)
        half_space = bem3d.HalfSpace(shape=(cells, cells), spacing=side / cells, modulus=scene.modulus)
        gap = -self._height(realisation, cells)
        if scene.shape == "sphere":
            x = ((np.arange(cells) + 0.5) / cells - 0.5) * side
            gap = gap + (x[:, np.newaxis] ** 2 + x**2) / (2 * scene.size)
        with warnings.catch_warnings():
            # few cells are what grids are compared for, and the punch ends where its grid does
            warnings.simplefilter("ignore", bem3d.ContactWarning)
            contact = bem3d.solve(half_space, gap, force=scene.load, tolerance=1e-4, raise_on_failure=False)
            return float(contact.stiffness()) if contact.converged else math.nan

    def _height(self, realisation: int, cells: int) -> FloatArray:
        ground, side = _ground(self.scene), _side(self.scene)
        if isinstance(ground, MeasuredHeights):
            return _resampled(ground, side, cells)
        shortest = math.pi * cells / side * (1 + 1e-9)
        rng = generator(self.seed, SURFACES, realisation)
        return _kept(ground, shortest, cells, side, rng)


def _springs_model(scene: PressedScene) -> tuple[float, str]:
    """Relative error of the mean stiffness, at the most, and what it rests on."""
    ground = _ground(scene)
    if scene.shape == "sphere":
        ratio = scene.roughness_ratio
        return SPHERE_SPRINGS * ratio + SPHERE_FLOOR, counted({"h/d": ratio})
    load, waves = scene.reduced_load, ground.q_min * scene.size / (2 * math.pi)
    level = float(np.interp(math.log10(load), *PUNCH_SPRINGS))
    return level + ROLL_OFF * (waves - 1), counted({"F / (E* h L)": load, "longest waves on a side": waves})


def beyond_spectra(ground: Roughness | MeasuredHeights) -> str:
    """Why a model that knows a surface by its spectrum alone has nothing to say of this one; empty where it has."""
    beyond = ground.beyond_a_spectrum() if isinstance(ground, MeasuredHeights) else ()
    return f"knows the spectrum alone, and {beyond[0]}" if beyond else ""


def _ground(scene: PressedScene) -> Roughness | MeasuredHeights:
    if scene.ground is None:
        raise ValueError("scene must be rough for this rung")
    return scene.ground


def _side(scene: PressedScene) -> float:
    """Of the model: that of the punch, or what a rough sphere may touch and the longest wave [m]."""
    if scene.shape == "punch":
        return scene.size
    ground = _ground(scene)
    reach = 2 * math.sqrt(2 * scene.size * (scene.approach + DEEPEST * ground.rms))
    if isinstance(ground, MeasuredHeights):
        return min(reach, *ground.sides)
    return max(reach, ground.longest)


def _cells(scene: PressedScene) -> int:
    """A power of two that has eight cells to the shortest wave; of measured heights, no more than their points."""
    ground = _ground(scene)
    if isinstance(ground, MeasuredHeights):
        points = _side(scene) / max(ground.spacing)
        return int(min(MANY, max(FEW, 2 ** math.floor(math.log2(points * (1 + 1e-9))))))
    wanted = WAVE * ground.q_max * _side(scene) / (2 * math.pi)
    if scene.shape == "sphere":
        wanted = max(wanted, RADIUS * _side(scene) / scene.contact_radius)
    return int(min(MANY, max(FEW, 2 ** math.ceil(math.log2(wanted * (1 - 1e-9))))))


def _kept(ground: Roughness, shortest: float, cells: int, side: float, rng: np.random.Generator) -> FloatArray:
    """The waves of a surface up to a wavenumber; the same waves on every grid."""
    with warnings.catch_warnings():
        # few cells to a wave are what grids are compared for
        warnings.simplefilter("ignore", bem3d.ResolutionWarning)
        surface = bem3d.rough_surface(
            lambda q: np.where(np.abs(q) <= shortest, ground.c2d(q), 0.0),
            shape=(cells, cells),
            spacing=side / cells,
            rng=rng,
        )
    # the mean square of the whole band, less what is left out of it
    return np.asarray(surface * _whole(ground, side))


def _whole(ground: Roughness, side: float) -> float:
    """What makes the height of all waves of the square that of the scene."""
    last = math.floor(ground.q_max * side / (2 * math.pi) * (1 + 1e-9))
    i = np.arange(-last, last + 1)
    q = 2 * np.pi / side * np.hypot(i[:, np.newaxis], i)
    drawn = (2 * np.pi / side) ** 2 * float(ground.c2d(q[q > 0]).sum())
    return ground.rms / math.sqrt(drawn)


def _resampled(heights: MeasuredHeights, side: float, cells: int) -> FloatArray:
    """The middle of a measured surface on cells x cells: the mean over each cell."""
    parts = max(1, math.ceil(side / cells / min(heights.spacing)))
    at = ((np.arange(parts * cells) + 0.5) / (parts * cells) - 0.5) * side
    return np.asarray(heights.at(at, at).reshape(cells, parts, cells, parts).mean(axis=(1, 3)))
