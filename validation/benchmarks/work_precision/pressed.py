"""What is pressed, on the charts: a sphere and a square punch, whose answers are known, and the punch of Fig. 14.1.

Units: E* = 1 and a length of each scene.
"""

import math
from abc import abstractmethod
from dataclasses import dataclass
from functools import partial
from typing import ClassVar, Literal

import numpy as np

import bem3d
import mdr
from validation.benchmarks.timing import Configuration, NamedMethod, along
from validation.benchmarks.work_precision.problem import CLOSED, MDR, ChartProblem, ChartQuantity, Grids, mean_of
from validation.engine.engine import FloatArray
from validation.scenes.indentation import IndentationScene
from validation.simulation.method import Prepared, Resolution, Result, Solve, Values
from validation.simulation.pressed import FIXED_AREA_RESIDUAL, press_on_grid, press_on_springs
from validation.simulation.quantities import MEAN_STIFFNESS, RELATIVE_DEVIATION
from validation.simulation.rough_punch import PunchRoughness
from validation.theory import closed_forms

RESIDUALS = (0.1, 1e-2, 1e-3, 1e-4)
"""Looser than those of all other solves."""
UNIT_SPHERE = {"radius": 1.0, "modulus": 1.0}


def scalars(**numbers: float) -> Values:
    return {name: np.array(number) for name, number in numbers.items()}


class PressedProblem(ChartProblem):
    """A `PressedScene`. springs: on a length; profiles: of springs, their own, none of a smooth body; across: lengths
    on a side of the grid."""

    springs: tuple[float, ...]
    profiles: int = 0
    across: ClassVar[int] = 1

    @property
    def method(self) -> NamedMethod:
        return NamedMethod("BEM", press_on_grid)

    def configurations(self) -> tuple[Configuration, ...]:
        springs, parameter = NamedMethod(MDR, press_on_springs), f"# springs {self.grids.per}"
        own = along(springs, self, self.springs, parameter, realisations=self.profiles, paired=not self.profiles)
        return (*own, *self.boundary_elements())

    def half_space(self, cells: int) -> bem3d.HalfSpace:
        n = self.across * cells
        return bem3d.HalfSpace(shape=(n, n), spacing=1 / cells, modulus=1.0)

    def finish(self, contact: bem3d.Contact) -> bem3d.FixedContactArea | None:
        """Its contact area is solved for its stiffness, on the clock."""
        return bem3d.solve_fixed_area(contact.problem.half_space, contact.pressure > 0, tolerance=FIXED_AREA_RESIDUAL)


def closed_form(scene: "ExactProblem", resolution: Resolution) -> Prepared:
    """What is exact."""
    return lambda _: Solve(scene.exact, lambda values: Result(values))


class ExactProblem(PressedProblem):
    """A body whose answer is known, pressed by a unit approach. shape: for models."""

    shape: ClassVar[Literal["sphere", "punch"]]

    @abstractmethod
    def exact(self) -> Values:
        """By closed forms."""

    @property
    def scene(self) -> IndentationScene:
        """At about a unit approach; no model of a smooth body depends on its load but by that."""
        load = float(self.exact().get("force", self.exact()["stiffness"]))
        return IndentationScene(name=self.name, shape=self.shape, size=1.0, load=load, modulus=1.0)

    def load(self, cells: int) -> dict[str, float]:
        return {"approach": 1.0}

    def reference(self) -> Values:
        return {name: value[np.newaxis] for name, value in self.exact().items()}

    def configurations(self) -> tuple[Configuration, ...]:
        """The closed form, springs, boundary elements."""
        exact = along(NamedMethod(CLOSED, closed_form), self, (1.0,), "exact", is_reference=True)
        return (*exact, *super().configurations())


ExactGrids = partial(Grids, tight=1e-8, tolerances=RESIDUALS)
SPHERE_GRIDS = ExactGrids(cells=(4, 8, 16, 32), fixed=16, per="to a radius")


@dataclass(frozen=True, kw_only=True)
class SphereProblem(ExactProblem):
    """A rigid sphere, R = a = d = 1, on a grid of 4 a."""

    name: ClassVar = "sphere"
    shape: ClassVar = "sphere"
    quantities: ClassVar = (mean_of("force", order=2.0), mean_of("contact radius", "radius"), mean_of("stiffness"))
    across: ClassVar = 4
    grids: Grids = SPHERE_GRIDS
    springs: tuple[float, ...] = (2.4, 4.4, 8.4, 16.4, 32.4, 64.4)

    def exact(self) -> Values:
        """Hertz and Boussinesq."""
        return scalars(
            force=closed_forms.hertz_force(**UNIT_SPHERE, approach=1.0),
            radius=closed_forms.hertz_contact_radius(radius=1.0, approach=1.0),
            stiffness=closed_forms.circular_punch_stiffness(**UNIT_SPHERE),
        )

    def gap(self, cells: int, realisation: int = 0) -> FloatArray:
        """r^2 / 2R."""
        x = (np.arange(4 * cells) + 0.5) / cells - 2
        return np.asarray((x[:, np.newaxis] ** 2 + x**2) / 2)

    def read(self, contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> Values:
        assert fixed is not None
        return scalars(force=contact.force, radius=math.sqrt(contact.area / math.pi), stiffness=fixed.stiffness)

    def profile(self, springs: float, realisation: int = 0) -> tuple[FloatArray, float]:
        """x^2 / R, about 4 a long; the contact ends between springs unless a whole number of them makes a radius."""
        half = round(2 * springs)
        x = (np.arange(-half, half) + 0.5) / springs
        return -mdr.sphere_profile(x, radius=1.0), 2 * half / springs

    def read_springs(self, point: mdr.LoadPoint[float]) -> Values:
        """The radius is half the length of the springs in contact."""
        return scalars(force=point.force, radius=point.stiffness / 2, stiffness=point.stiffness)


PUNCH_GRIDS = ExactGrids(cells=(8, 16, 32, 64), fixed=32)


@dataclass(frozen=True, kw_only=True)
class PunchProblem(ExactProblem):
    """A rigid flat square punch of side L = 1 on a grid that just holds it."""

    name: ClassVar = "square punch"
    shape: ClassVar = "punch"
    # the reference is known to five digits: half a unit of the last is open
    quantities: ClassVar = (mean_of("stiffness", band=5e-5 / closed_forms.SQUARE_PUNCH),)
    grids: Grids = PUNCH_GRIDS
    springs: tuple[float, ...] = (4, 16, 64)

    def exact(self) -> Values:
        """1.1523 E* L."""
        return scalars(stiffness=closed_forms.square_punch_stiffness(side=1.0, modulus=1.0))

    def gap(self, cells: int, realisation: int = 0) -> FloatArray:
        return np.zeros((cells, cells))

    def finish(self, contact: bem3d.Contact) -> None:
        """All of it is in contact: its force has its stiffness."""

    def read(self, contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> Values:
        return scalars(stiffness=contact.force / contact.approach)

    def profile(self, springs: float, realisation: int = 0) -> tuple[FloatArray, float]:
        return np.zeros(round(springs)), 1.0

    def read_springs(self, point: mdr.LoadPoint[float]) -> Values:
        return scalars(stiffness=point.stiffness)


ROUGH_GRIDS = Grids(cells=(24, 32, 64, 128), fixed=64)


def log_deviation(values: Values) -> FloatArray:
    """ln of the relative standard deviation; minus infinity of a single value."""
    k = values["stiffness"]
    deviation = k.std(ddof=1) / k.mean() if k.size > 1 else 0.0
    with np.errstate(divide="ignore"):
        return np.asarray(np.log(np.atleast_1d(deviation)))


@dataclass(frozen=True, kw_only=True)
class RoughPunchProblem(PressedProblem):
    """A square punch of side L = 1, self-affine from q_min = 2 pi / L to q_max, under Fbar = F / (E* h L).

    hurst; waves: on a side, of the shortest; force: Fbar; realisations: of surfaces; seed: zero or positive.
    """

    name: ClassVar = "fractal punch"
    quantities: ClassVar = (
        mean_of(MEAN_STIFFNESS, "stiffness"),
        ChartQuantity(name=RELATIVE_DEVIATION, log=log_deviation, needs=("stiffness",)),
    )
    hurst: float = 0.7
    waves: int = 15
    force: float = 0.1
    realisations: int = 16
    profiles: int = 120
    grids: Grids = ROUGH_GRIDS
    springs: tuple[float, ...] = (24, 32, 64, 128, 256, 512)
    seed: int = 150

    @property
    def roughness(self) -> PunchRoughness:
        """The same on every grid and in both methods."""
        return PunchRoughness(hurst=self.hurst, waves=(1, self.waves), seed=self.seed)

    @property
    def scene(self) -> IndentationScene:
        """The punch, for models that know no realisation."""
        return self.roughness.scene(self.force)

    def load(self, cells: int) -> dict[str, float]:
        return {"force": self.force * self.roughness.height}

    def gap(self, cells: int, realisation: int) -> FloatArray:
        return -self.roughness.surface(cells, realisation)

    def read(self, contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> Values:
        assert fixed is not None
        return scalars(stiffness=fixed.stiffness)

    def profile(self, springs: float, realisation: int) -> tuple[FloatArray, float]:
        """Of Geike's spectrum, L_1D = L."""
        return self.roughness.profile(round(springs), realisation), 1.0

    def read_springs(self, point: mdr.LoadPoint[float]) -> Values:
        return scalars(stiffness=point.stiffness)
