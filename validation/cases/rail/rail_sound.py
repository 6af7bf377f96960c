"""The contact force of a wheel on a rail as a sound, by four models on the same surface, and its levels."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from validation.analysis.sound import common_full_scale
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.scenes.load import load_scene
from validation.scenes.rail import RailScene
from validation.simulation.equivalent_displacement import BEM, LINEAR, SPRINGS_THAT_READ
from validation.simulation.rail_ground import StatedAcross, strip_bands, strip_of
from validation.simulation.rail_sound import (
    GEIKE,
    ISOTROPIC,
    HeldWheel,
    roll_held_wheel,
    samples_of,
    sounding_strip,
)
from validation.simulation.rail_strip import RailStrip

FloatArray = NDArray[np.float64]

SOUNDING = {"bem": BEM, "linear": LINEAR, "springs": SPRINGS_THAT_READ, "geike": GEIKE}
"""Models by the names of their files."""
SHORTEST = 0.9
"""Largest wavenumber over that of two cells a wave."""
LABELS = {
    BEM: "boundary elements",
    LINEAR: "linear theory in 3D",
    SPRINGS_THAT_READ: SPRINGS_THAT_READ,
    GEIKE: GEIKE,
}


def shipped_rail() -> RailScene:
    scene = load_scene("rail")
    assert isinstance(scene, RailScene)
    return scene


@dataclass(frozen=True, kw_only=True)
class RailSound:
    """A wheel that rolls over one rough strip at a constant height.

    rail: the scene, with a speed; seconds: to roll over the strip, which is a period; repeats: of it in a file; rate:
    samples a second; models: names of `SOUNDING`; cells: to the smaller semi-axis, two grids; parts: of the strip,
    which boundary elements solve one by one; tolerance: residual of boundary elements; blocks: pieces of the strip, of
    which error bars are made; seed.
    """

    rail: RailScene
    seconds: float
    repeats: int
    rate: int = 24000
    models: tuple[str, ...] = tuple(SOUNDING)
    cells: tuple[int, int] = (4, 6)
    parts: int = 4
    tolerance: float = 1e-4
    blocks: int = 10
    seed: int = 22

    def __post_init__(self) -> None:
        if unknown := [name for name in self.models if name not in SOUNDING]:
            raise ValueError(f"models must be of {', '.join(SOUNDING)}, got {', '.join(unknown)}")
        if not self.models:
            raise ValueError(f"models must be one of {', '.join(SOUNDING)} at least, got none")
        if self.across != ISOTROPIC and set(self.models) == {"geike"}:
            raise ValueError(
                "Geike's rule is for isotropic ground: rail.across must be isotropic, or another model given"
            )

    @property
    def across(self) -> StatedAcross:
        """Isotropic where the scene leaves it out."""
        return ISOTROPIC if self.rail.across is None else self.rail.across

    @property
    def sounding(self) -> tuple[str, ...]:
        """Models in the order of `SOUNDING`, without Geike's rule where the ground is not isotropic."""
        some = [model for name, model in SOUNDING.items() if name in self.models]
        return tuple(model for model in some if model != GEIKE or self.across == ISOTROPIC)

    @property
    def samples(self) -> int:
        """Of one period."""
        return round(self.seconds * self.rate)

    @property
    def speed(self) -> float:
        """v [m/s]."""
        assert self.rail.speed is not None  # or there is no strip
        return self.rail.speed

    @property
    def band(self) -> tuple[float, float]:
        """Frequencies between which the strip is rough along the track [Hz]."""
        edges = strip_bands(self.rail).edges
        return float(edges[0]) * self.speed / (2 * math.pi), float(edges[-1]) * self.speed / (2 * math.pi)

    @property
    def of_contact(self) -> float:
        """v / (2 a_x): of the wave as long as the contact [Hz]."""
        return self.speed / (2 * self.rail.contact.along)

    @cached_property
    def finer(self) -> float:
        """1, or more where oblique waves are too short for the coarse grid."""
        short = strip_of(self.rail, self.across, self.cells[0], 0, self.seed)
        return max(1.0, short.ground.highest * short.spacing / (SHORTEST * math.pi))

    def strip(self, cells: int) -> RailStrip:
        return sounding_strip(
            self.rail,
            across=self.across,
            samples=self.samples,
            rate=self.rate,
            cells=math.ceil(cells * self.finer),
            seed=self.seed,
        )

    def problems(self, model: str, cells: int) -> list[HeldWheel]:
        """Along the whole strip, in parts."""
        strip = self.strip(cells)
        ends = np.linspace(0, strip.shape[0], 1 + (self.parts if model == BEM else 1)).astype(int).tolist()
        return [
            HeldWheel(strip=strip, model=model, first=first, last=last, tolerance=self.tolerance)
            for first, last in pairwise(ends)
        ]


@dataclass(frozen=True)
class RailSoundResult:
    """Samples of one period of each model on both grids: the force less its mean [N]."""

    case: RailSound
    signals: dict[tuple[str, int], FloatArray]

    def signal(self, model: str) -> FloatArray:
        """On the finer grid."""
        return self.signals[model, self.case.cells[1]]

    @cached_property
    def full_scale(self) -> float:
        """Force that the largest number of a file stands for, one for all models [N]."""
        return common_full_scale(self.signal(model) for model in self.case.sounding)


def run(case: RailSound, engine: Engine = SERIAL) -> RailSoundResult:
    """Roll each model on both grids. Raises NotConvergedError where boundary elements fail anywhere."""
    groups = {(model, cells): case.problems(model, cells) for cells in case.cells for model in case.sounding}
    outcomes = engine.map_groups(roll_held_wheel, groups)
    lost = tuple(
        f"{model}, {cells} cells to an axis: {count} positions"
        for (model, cells), some in outcomes.items()
        if (count := int(sum(float(one["failed"]) for one in some)))
    )
    if lost:
        raise NotConvergedError("a sound has no gaps: some positions did not converge", lost)
    return RailSoundResult(case, {key: _joined(case, some) for key, some in outcomes.items()})


def _joined(case: RailSound, parts: Sequence[Outcome]) -> FloatArray:
    return samples_of(np.concatenate([part["force"] for part in parts]), case.samples)
