"""Problems of the charts where the answer is known: a sphere, a square punch.

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
from validation.benchmarks.work_precision.problem import CLOSED, MDR, ChartProblem, Grids, mean_of
from validation.engine.engine import FloatArray
from validation.scenes.indentation import IndentationScene
from validation.simulation.method import Prepared, Resolution, Result, Solve, Values
from validation.simulation.pressed import press_on_springs
from validation.theory import closed_forms

RESIDUALS = (0.1, 1e-2, 1e-3, 1e-4)
"""Looser than those of all other solves."""
UNIT_SPHERE = {"radius": 1.0, "modulus": 1.0}


def scalars(**numbers: float) -> Values:
    return {name: np.array(number) for name, number in numbers.items()}


def closed_form(scene: "ExactProblem", resolution: Resolution) -> Prepared:
    """What is exact."""
    return lambda _: Solve(scene.exact, lambda found: Result(found, 1.0))


class ExactProblem(ChartProblem):
    """A body whose answer is known, pressed by a unit approach. springs: on a length; shape: for models."""

    shape: ClassVar[Literal["sphere", "punch"]]
    springs: tuple[float, ...]

    @abstractmethod
    def exact(self) -> Values:
        """By closed forms."""

    def half_space(self, cells: int) -> bem3d.HalfSpace:
        nx, ny = self.gap(cells).shape
        return bem3d.HalfSpace(shape=(nx, ny), spacing=1 / cells, modulus=1.0)

    @abstractmethod
    def gap(self, cells: int, realisation: int = 0) -> FloatArray: ...

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
        grids = self.grids
        return (
            *along(NamedMethod(CLOSED, closed_form), self, (1.0,), "exact", is_reference=True),
            *along(NamedMethod(MDR, press_on_springs), self, self.springs, f"# springs {grids.per}"),
            *self.boundary_elements(),
        )


ExactGrids = partial(Grids, tight=1e-8, tolerances=RESIDUALS)
SPHERE_GRIDS = ExactGrids(cells=(4, 8, 16, 32), polonsky_keer=(4, 8, 16), fixed=16, per="to a radius")


@dataclass(frozen=True, kw_only=True)
class SphereProblem(ExactProblem):
    """A rigid sphere, R = a = d = 1, on a grid of 4 a."""

    name: ClassVar = "sphere"
    shape: ClassVar = "sphere"
    quantities: ClassVar = (mean_of("force", order=2.0), mean_of("contact radius", "radius"), mean_of("stiffness"))
    fixed_area: ClassVar = True
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


PUNCH_GRIDS = ExactGrids(cells=(8, 16, 32, 64), polonsky_keer=(8, 16, 32), fixed=32)


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

    def read(self, contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> Values:
        return scalars(stiffness=contact.force / contact.approach)

    def profile(self, springs: float, realisation: int = 0) -> tuple[FloatArray, float]:
        return np.zeros(round(springs)), 1.0

    def read_springs(self, point: mdr.LoadPoint[float]) -> Values:
        return scalars(stiffness=point.stiffness)
