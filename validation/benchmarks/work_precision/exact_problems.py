"""Problems of the charts where the answer is known: a sphere, a square punch, a periodic wave.

Units: E* = 1 and a length of each scene.
"""

import math
from dataclasses import dataclass

import numpy as np

import bem3d
import mdr
from validation.benchmarks.timing import Configuration
from validation.benchmarks.work_precision.exact_problem import (
    ExactProblem,
    exact_configurations,
    grid_series,
    logarithm,
)
from validation.benchmarks.work_precision.grids import Grids
from validation.benchmarks.work_precision.problem import Quantity
from validation.scenes.indentation import IndentationScene
from validation.simulation.method import FloatArray, Values
from validation.simulation.pressed import FIXED_AREA_RESIDUAL
from validation.theory import closed_forms

RESIDUALS = (0.1, 1e-2, 1e-3, 1e-4)
"""Looser than those of all other solves."""


class OnExactProblem:
    """What all of these share."""

    def configurations(self: ExactProblem) -> tuple[Configuration, ...]:
        """See `exact_configurations`."""
        return exact_configurations(self)

    def reference(self: ExactProblem) -> Values:
        """What is exact."""
        return self.exact()

    def pairs(self: ExactProblem) -> tuple[tuple[Configuration, Configuration], ...]:
        """Grids of which one has twice the cells of the other."""
        return grid_series(self).pairs()

    def load(self, cells: int) -> dict[str, float]:
        """A unit approach."""
        return {"approach": 1.0}

    def finish(self, contact: bem3d.Contact) -> bem3d.FixedContactArea | None:
        """Nothing beside the contact."""
        return None

    @property
    def scene(self) -> IndentationScene | None:
        """The scene of which models are found."""
        return None


SPHERE_GRIDS = Grids(
    cells=(4, 8, 16, 32), polonsky_keer=(4, 8, 16), fixed=16, per="to a radius", tight=1e-8, tolerances=RESIDUALS
)


@dataclass(frozen=True, kw_only=True)
class SphereProblem(OnExactProblem):
    """A rigid sphere, R = a = d = 1, on a grid of 4 a."""

    grids: Grids = SPHERE_GRIDS
    peers: tuple[int, ...] = (8, 16)
    springs: tuple[float, ...] = (2.4, 4.4, 8.4, 16.4, 32.4, 64.4)

    @property
    def name(self) -> str:
        """For tables and figures."""
        return "sphere"

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        """At a given approach."""
        return (
            Quantity(name="force", log=logarithm("force"), needs=("force",), order=2.0),
            Quantity(name="contact radius", log=logarithm("radius"), needs=("radius",)),
            Quantity(name="stiffness", log=logarithm("stiffness"), needs=("stiffness",)),
        )

    @property
    def scene(self) -> IndentationScene:
        """Under the force of Hertz."""
        return IndentationScene(name=self.name, shape="sphere", size=1.0, load=self.peer_force(0), modulus=1.0)

    def exact(self) -> Values:
        """Hertz and Boussinesq."""
        return {
            "force": np.array([closed_forms.hertz_force(radius=1.0, modulus=1.0, approach=1.0)]),
            "radius": np.array([closed_forms.hertz_contact_radius(radius=1.0, approach=1.0)]),
            "stiffness": np.array([closed_forms.circular_punch_stiffness(radius=1.0, modulus=1.0)]),
        }

    def half_space(self, cells: int) -> bem3d.HalfSpace:
        """4 a wide."""
        return bem3d.HalfSpace(shape=(4 * cells, 4 * cells), spacing=1 / cells, modulus=1.0)

    def gap(self, cells: int, realisation: int = 0) -> FloatArray:
        """r^2 / 2R."""
        x = (np.arange(4 * cells) + 0.5) / cells - 2
        return np.asarray((x[:, np.newaxis] ** 2 + x**2) / 2)

    def peer_force(self, cells: int) -> float:
        """Of Hertz."""
        return float(self.exact()["force"][0])

    def finish(self, contact: bem3d.Contact) -> bem3d.FixedContactArea:
        """The stiffness."""
        return bem3d.solve_fixed_area(contact.problem.half_space, contact.pressure > 0, tolerance=FIXED_AREA_RESIDUAL)

    def read(self, contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> Values:
        """Force, radius of a circle of that area, stiffness."""
        assert fixed is not None
        return {
            "force": np.array(contact.force),
            "radius": np.array(math.sqrt(contact.area / math.pi)),
            "stiffness": np.array(fixed.stiffness),
        }

    def read_peer(self, cells: int, force: float, approach: float, area: float) -> Values:
        """F ~ d^(3/2) and a ~ d^(1/2)."""
        return {
            "force": np.array(force * approach**-1.5),
            "radius": np.array(math.sqrt(area / math.pi / approach)),
        }

    def profile(self, springs: float, realisation: int = 0) -> tuple[FloatArray, float]:
        """x^2 / R, about 4 a long; the contact ends between springs unless a whole number of them makes a radius."""
        half = round(2 * springs)
        x = (np.arange(-half, half) + 0.5) / springs
        return -mdr.sphere_profile(x, radius=1.0), 2 * half / springs

    def read_springs(self, point: mdr.LoadPoint[float]) -> Values:
        """The radius is half the length of the springs in contact."""
        return {
            "force": np.array(point.force),
            "radius": np.array(point.stiffness / 2),
            "stiffness": np.array(point.stiffness),
        }


PUNCH_GRIDS = Grids(cells=(8, 16, 32, 64), polonsky_keer=(8, 16, 32), fixed=32, tight=1e-8, tolerances=RESIDUALS)


@dataclass(frozen=True, kw_only=True)
class PunchProblem(OnExactProblem):
    """A rigid flat square punch of side L = 1 on a grid that just holds it."""

    grids: Grids = PUNCH_GRIDS
    peers: tuple[int, ...] = ()
    springs: tuple[float, ...] = (4, 16, 64)

    @property
    def name(self) -> str:
        """For tables and figures."""
        return "square punch"

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        """The reference is known to five digits: half a unit of the last is open."""
        band = 5e-5 / closed_forms.SQUARE_PUNCH
        return (Quantity(name="stiffness", log=logarithm("stiffness"), needs=("stiffness",), band=band),)

    @property
    def scene(self) -> IndentationScene:
        """At about a unit approach."""
        return IndentationScene(name=self.name, shape="punch", size=1.0, load=self.peer_force(0), modulus=1.0)

    def exact(self) -> Values:
        """1.1523 E* L."""
        return {"stiffness": np.array([closed_forms.square_punch_stiffness(side=1.0, modulus=1.0)])}

    def half_space(self, cells: int) -> bem3d.HalfSpace:
        """As wide as the punch."""
        return bem3d.HalfSpace(shape=(cells, cells), spacing=1 / cells, modulus=1.0)

    def gap(self, cells: int, realisation: int = 0) -> FloatArray:
        """Flat."""
        return np.zeros((cells, cells))

    def peer_force(self, cells: int) -> float:
        """At about a unit approach."""
        return closed_forms.SQUARE_PUNCH

    def read(self, contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> Values:
        """F / d."""
        return {"stiffness": np.array(contact.force / contact.approach)}

    def read_peer(self, cells: int, force: float, approach: float, area: float) -> Values:
        """F / d."""
        return {"stiffness": np.array(force / approach)}

    def profile(self, springs: float, realisation: int = 0) -> tuple[FloatArray, float]:
        """Flat, L long."""
        return np.zeros(round(springs)), 1.0

    def read_springs(self, point: mdr.LoadPoint[float]) -> Values:
        """All springs."""
        return {"stiffness": np.array(point.stiffness)}


WAVE_GRIDS = Grids(
    cells=(16, 32, 64, 128, 256),
    polonsky_keer=(16, 64, 256),
    fixed=128,
    per="to a wavelength",
    tight=1e-8,
    tolerances=RESIDUALS,
)


@dataclass(frozen=True, kw_only=True)
class WaveProblem(OnExactProblem):
    """A rigid wave cos(2 pi x) in line contact, amplitude and wavelength one, at a mean pressure, on one row of cells.

    pressure: mean, over that of full contact.
    """

    grids: Grids = WAVE_GRIDS
    peers: tuple[int, ...] = ()
    springs: tuple[float, ...] = (64,)
    pressure: float = 0.3

    @property
    def name(self) -> str:
        """For tables and figures."""
        return "Westergaard's wave"

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        """At a given mean pressure."""
        return (
            Quantity(name="contact width", log=logarithm("width"), needs=("width",)),
            Quantity(name="approach", log=logarithm("approach"), needs=("approach",), order=2.0),
        )

    def exact(self) -> Values:
        """Westergaard; the approach from the first touch."""
        unit = {"amplitude": 1.0, "wavelength": 1.0, "modulus": 1.0}
        mean = self.pressure * math.pi
        return {
            "width": np.array([2 * closed_forms.westergaard_half_width(mean_pressure=mean, **unit)]),
            "approach": np.array([closed_forms.westergaard_approach(mean_pressure=mean, **unit)]),
        }

    def half_space(self, cells: int) -> bem3d.HalfSpace:
        """One row, periodic."""
        return bem3d.HalfSpace(shape=(cells, 1), spacing=1 / cells, modulus=1.0, periodic=True)

    def gap(self, cells: int, realisation: int = 0) -> FloatArray:
        """2 sin^2(pi x)."""
        x = (np.arange(cells) + 0.5) / cells - 0.5
        return np.asarray(2 * np.sin(np.pi * x) ** 2)[:, np.newaxis]

    def load(self, cells: int) -> dict[str, float]:
        """A force."""
        return {"force": self.peer_force(cells)}

    def peer_force(self, cells: int) -> float:
        """Mean pressure times a row of cells."""
        return self.pressure * math.pi / cells

    def read(self, contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> Values:
        """Area over the length of the row's side; the approach of the mean plane."""
        return {
            "width": np.array(contact.area / contact.problem.half_space.steps[1]),
            "approach": np.array(contact.approach),
        }

    def read_peer(self, cells: int, force: float, approach: float, area: float) -> Values:
        """Of a row as wide as a cell; dd = -ln(s) ds, s the mean pressure over that of full contact."""
        missing = self.pressure - force * cells / math.pi
        return {
            "width": np.array(area * cells),
            "approach": np.array(approach - math.log(self.pressure) * missing),
        }

    def profile(self, springs: float, realisation: int = 0) -> tuple[FloatArray, float]:
        """None."""
        raise ValueError("a line contact that repeats itself has no one-dimensional image of independent springs")
