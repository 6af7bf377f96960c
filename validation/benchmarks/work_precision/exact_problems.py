"""Problems of the charts where the answer is known: a sphere, a square punch, a periodic wave.

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
from validation.benchmarks import peers
from validation.benchmarks.peers import DiscreteProblem, solvers_on_grids
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
    """A pressed body whose answer is known: `PressedScene` for our methods, plain values for other solvers.

    peers: cells of other solvers; springs: on a length; shape: of the body, for models, none where they have none.
    """

    periodic: ClassVar[bool] = False
    shape: ClassVar[Literal["sphere", "punch"] | None] = None
    peers: tuple[int, ...]
    springs: tuple[float, ...]

    @abstractmethod
    def exact(self) -> Values:
        """By closed forms."""

    def half_space(self, cells: int) -> bem3d.HalfSpace:
        nx, ny = self.gap(cells).shape
        return bem3d.HalfSpace(shape=(nx, ny), spacing=1 / cells, modulus=1.0, periodic=self.periodic)

    @abstractmethod
    def gap(self, cells: int, realisation: int = 0) -> FloatArray: ...

    @abstractmethod
    def peer_force(self, cells: int) -> float:
        """What other solvers are pressed with."""

    @abstractmethod
    def carried_over(self, cells: int, force: float, approach: float, area: float) -> Values:
        """Values of a contact under another load than that of the problem, along the closed form."""

    @property
    def scene(self) -> IndentationScene | None:
        """Under the force of other solvers."""
        if self.shape is None:
            return None
        return IndentationScene(name=self.name, shape=self.shape, size=1.0, load=self.peer_force(1), modulus=1.0)

    def load(self, cells: int) -> dict[str, float]:
        return {"approach": 1.0}

    def read(self, contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> Values:
        cells = round(1 / contact.problem.half_space.steps[0])
        return self.carried_over(cells, contact.force, contact.approach, contact.area)

    def reference(self) -> Values:
        return {name: value[np.newaxis] for name, value in self.exact().items()}

    def configurations(self) -> tuple[Configuration, ...]:
        """The closed form, springs, boundary elements, and other solvers where they are installed."""
        grids = self.grids
        return (
            *along(NamedMethod(CLOSED, closed_form), self, (1.0,), "exact", is_reference=True),
            *along(NamedMethod(MDR, press_on_springs), self, self.springs, f"# springs {grids.per}"),
            *self.boundary_elements(),
            *solvers_on_grids(peers.of_others(), self, self.peers, grids.per, grids.tight),
        )

    def discrete(self, cells: int) -> DiscreteProblem:
        """By a force, or by the approach of the closed form."""
        return DiscreteProblem(
            height=-self.gap(cells),
            spacing=1 / cells,
            modulus=1.0,
            periodic=self.periodic,
            force=self.peer_force(cells),
            approach=float(self.exact().get("approach", 1.0)),
        )

    def read_pressure(self, discrete: DiscreteProblem, pressure: FloatArray) -> Values:
        """Force, approach and area of a pressure, carried over to the load of the problem."""
        cells = round(1 / discrete.spacing)
        separation = discrete.gap + discrete.half_space().displacement(pressure)
        area = np.count_nonzero(pressure > 1e-9 * pressure.max()) / cells**2
        approach = float((pressure * separation).sum() / pressure.sum())
        return self.carried_over(cells, float(pressure.sum()) / cells**2, approach, area)


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
    peers: tuple[int, ...] = (8, 16)
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

    def peer_force(self, cells: int) -> float:
        return float(self.exact()["force"])

    def read(self, contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> Values:
        assert fixed is not None
        return {**super().read(contact, fixed), **scalars(stiffness=fixed.stiffness)}

    def carried_over(self, cells: int, force: float, approach: float, area: float) -> Values:
        """F ~ d^(3/2) and a ~ d^(1/2), the radius of a circle of the contact area."""
        return scalars(force=force * approach**-1.5, radius=math.sqrt(area / math.pi / approach))

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
    peers: tuple[int, ...] = ()
    springs: tuple[float, ...] = (4, 16, 64)

    def exact(self) -> Values:
        """1.1523 E* L."""
        return scalars(stiffness=closed_forms.square_punch_stiffness(side=1.0, modulus=1.0))

    def gap(self, cells: int, realisation: int = 0) -> FloatArray:
        return np.zeros((cells, cells))

    def peer_force(self, cells: int) -> float:
        """At about a unit approach."""
        return closed_forms.SQUARE_PUNCH

    def carried_over(self, cells: int, force: float, approach: float, area: float) -> Values:
        return scalars(stiffness=force / approach)

    def profile(self, springs: float, realisation: int = 0) -> tuple[FloatArray, float]:
        return np.zeros(round(springs)), 1.0

    def read_springs(self, point: mdr.LoadPoint[float]) -> Values:
        return scalars(stiffness=point.stiffness)


WAVE_GRIDS = ExactGrids(cells=(16, 32, 64, 128, 256), polonsky_keer=(16, 64, 256), fixed=128, per="to a wavelength")


@dataclass(frozen=True, kw_only=True)
class WaveProblem(ExactProblem):
    """A rigid wave cos(2 pi x) in line contact, amplitude and wavelength one, at a mean pressure, on one row of cells.

    pressure: mean, over that of full contact.
    """

    name: ClassVar = "Westergaard's wave"
    quantities: ClassVar = (mean_of("contact width", "width"), mean_of("approach", order=2.0))
    periodic: ClassVar = True
    grids: Grids = WAVE_GRIDS
    peers: tuple[int, ...] = ()
    springs: tuple[float, ...] = (64,)
    pressure: float = 0.3

    def exact(self) -> Values:
        """Westergaard; the approach from the first touch."""
        wave = {"amplitude": 1.0, "wavelength": 1.0, "modulus": 1.0, "mean_pressure": self.pressure * math.pi}
        return scalars(
            width=2 * closed_forms.westergaard_half_width(**wave), approach=closed_forms.westergaard_approach(**wave)
        )

    def gap(self, cells: int, realisation: int = 0) -> FloatArray:
        """2 sin^2(pi x)."""
        x = (np.arange(cells) + 0.5) / cells - 0.5
        return np.asarray(2 * np.sin(np.pi * x) ** 2)[:, np.newaxis]

    def load(self, cells: int) -> dict[str, float]:
        return {"force": self.peer_force(cells)}

    def peer_force(self, cells: int) -> float:
        """Mean pressure times a row of cells."""
        return self.pressure * math.pi / cells

    def read(self, contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> Values:
        """Area over the length of the row's side; the approach of the mean plane."""
        return scalars(width=contact.area / contact.problem.half_space.steps[1], approach=contact.approach)

    def carried_over(self, cells: int, force: float, approach: float, area: float) -> Values:
        """Of a row as wide as a cell; dd = -ln(s) ds, s the mean pressure over that of full contact."""
        missing = self.pressure - force * cells / math.pi
        return scalars(width=area * cells, approach=approach - math.log(self.pressure) * missing)

    def profile(self, springs: float, realisation: int = 0) -> tuple[FloatArray, float]:
        raise ValueError("a line contact that repeats itself has no one-dimensional image of independent springs")
