"""The rough punch of Fig. 14.1 on the charts: mean stiffness under a force, and how much it scatters."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

import bem3d
import mdr
from validation.benchmarks.timing import Configuration, NamedMethod, along
from validation.benchmarks.work_precision.problem import MDR, ChartProblem, Grids, Quantity, mean_of
from validation.engine.engine import FloatArray
from validation.scenes.indentation import IndentationScene
from validation.simulation.method import Values
from validation.simulation.pressed import press_on_springs
from validation.simulation.rough_punch import PunchRoughness


def log_deviation(values: Values) -> FloatArray:
    """ln of the relative standard deviation; minus infinity of a single value."""
    k = values["stiffness"]
    deviation = k.std(ddof=1) / k.mean() if k.size > 1 else 0.0
    with np.errstate(divide="ignore"):
        return np.asarray(np.log(np.atleast_1d(deviation)))


GRIDS = Grids(cells=(24, 32, 64, 128), polonsky_keer=(32, 64), fixed=64)


@dataclass(frozen=True, kw_only=True)
class RoughPunchProblem(ChartProblem):
    """A square punch of side L = 1, self-affine from q_min = 2 pi / L to q_max, under Fbar = F / (E* h L).

    hurst; waves: on a side, of the shortest; force: Fbar; realisations: of surfaces; profiles: of springs, their own;
    springs: of a profile; seed: zero or positive.
    """

    name: ClassVar = "fractal punch"
    quantities: ClassVar = (
        mean_of("mean stiffness", "stiffness"),
        Quantity(name="relative deviation", log=log_deviation, needs=("stiffness",)),
    )
    fixed_area: ClassVar = True
    hurst: float = 0.7
    waves: int = 15
    force: float = 0.1
    realisations: int = 16
    profiles: int = 120
    grids: Grids = GRIDS
    springs: tuple[int, ...] = (24, 32, 64, 128, 256, 512)
    seed: int = 150

    @property
    def roughness(self) -> PunchRoughness:
        """The same on every grid and in both methods."""
        return PunchRoughness(hurst=self.hurst, waves=(1, self.waves), seed=self.seed)

    @property
    def scene(self) -> IndentationScene:
        """The punch, for models that know no realisation."""
        return self.roughness.scene(self.force)

    def configurations(self) -> tuple[Configuration, ...]:
        own: dict[str, Any] = {"realisations": self.profiles, "paired": False}
        springs = along(NamedMethod(MDR, press_on_springs), self, self.springs, "# springs a side", **own)
        return (*springs, *self.boundary_elements())

    def load(self, cells: int) -> dict[str, float]:
        return {"force": self.force * self.roughness.height}

    def half_space(self, cells: int) -> bem3d.HalfSpace:
        return bem3d.HalfSpace(shape=(cells, cells), spacing=1 / cells, modulus=1.0)

    def gap(self, cells: int, realisation: int) -> FloatArray:
        return -self.roughness.surface(cells, realisation)

    def read(self, contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> Values:
        assert fixed is not None
        return {"stiffness": np.array(fixed.stiffness)}

    def profile(self, springs: float, realisation: int) -> tuple[FloatArray, float]:
        """Of Geike's spectrum, L_1D = L."""
        return self.roughness.profile(round(springs), realisation), 1.0

    def read_springs(self, point: mdr.LoadPoint[float]) -> Values:
        return {"stiffness": np.array(point.stiffness)}
