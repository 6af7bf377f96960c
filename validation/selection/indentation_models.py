"""Models of the stiffness of a rough body that is pressed: springs, boundary elements coarse and fine."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

import mdr
from validation.engine.engine import random_generator
from validation.scenes.indentation import IndentationScene
from validation.selection.hierarchy import Answer, ContactModel, mean_error, realisations
from validation.selection.indentation_on_grids import IndentationOnGrid
from validation.simulation.calibrated_range import (
    BALL,
    FACE,
    HEIGHT,
    LOAD,
    SCATTER,
    SPHERE_FLOOR,
    WAVES,
    Ranges,
    beyond_spectrum,
    conditions_of,
    counted,
    outside,
)
from validation.simulation.indentation import FEW, finest_cells, ground_of, side_of
from validation.simulation.model import Cost, ErrorEstimate
from validation.simulation.resolution import too_few

FloatArray = NDArray[np.float64]

PROFILES = 1
"""The spawn key under which profiles draw."""
SPRING = 3.5e-8
"""Seconds that a spring takes in a sort, about."""
SPRINGS_TO_A_WAVE, SPRINGS_TO_A_RADIUS = 8, 100
MOST_SPRINGS, BLOCK = 2**26, 2**22
"""Springs of a profile at the most, which take four gigabytes, and of all that are drawn at once, or one profile."""
PUNCH_SPRINGS = (
    np.array([-3.0, -2.5, -2.0, -1.5, -0.5, -0.2, 0.0, 0.3, 0.5, 0.7, 0.85, 1.0]),
    np.array([0.18, 0.15, 0.12, 0.075, 0.065, 0.075, 0.12, 0.12, 0.08, 0.12, 0.14, 0.16]),
)
"""lg Fbar, and the error of springs there without roll-off, H from 0.4 to 1: beside boundary elements."""
ROLL_OFF = 0.06
"""By which it grows with each more of the longest waves on a side."""
SPHERE_SPRINGS = 0.15
"""Error of a rough sphere, over h/d."""
RANGES: Mapping[str, Ranges] = {"punch": {LOAD: (1e-3, math.inf), **FACE}, "sphere": BALL}


def models(scene: IndentationScene, tolerance: float, seed: int) -> list[ContactModel]:
    """Springs and boundary elements, the cheapest first; measured heights on their own points alone."""
    if scene.ground is None:
        return []
    finest = finest_cells(scene)
    grids = (
        [finest] if scene.ground.is_single else [cells for cells in (finest // 4, finest // 2, finest) if cells >= FEW]
    )
    solved = [IndentationOnGrid(scene, tolerance, seed, cells) for cells in grids]
    return [IndentationOnSprings(scene, tolerance, seed), *solved]


@dataclass(frozen=True)
class IndentationOnSprings:
    """MDR with profiles of Geike's spectrum, L_1D = L; of a measured surface, those of its spectrum."""

    kind: ClassVar = "springs"
    name: ClassVar = kind

    scene: IndentationScene
    tolerance: float
    seed: int

    @property
    def points(self) -> int:
        """Springs of a profile: eight to the shortest wave, and a hundred to the contact radius of a smooth sphere."""
        scene = self.scene
        radii = self.length / scene.contact_radius if scene.shape == "sphere" else 0.0
        waves = self.length * ground_of(scene).q_max / (2 * math.pi)
        return max(256, math.ceil(SPRINGS_TO_A_WAVE * waves), math.ceil(SPRINGS_TO_A_RADIUS * radii))

    @property
    def length(self) -> float:
        """Of a profile [m]."""
        return side_of(self.scene)

    @property
    def count(self) -> int:
        """Profiles: so many that the sample leaves a fifth of the tolerance."""
        return realisations(SCATTER, self.tolerance / 5, least=50)

    def cost(self) -> Cost:
        """A sort a profile."""
        work = self.count * self.points
        return Cost(work=work, unit="springs", seconds=1e-3 + SPRING * work)

    def estimate(self) -> ErrorEstimate:
        """By the load, the height and the waves on a side, as measured beside boundary elements."""
        ranges = RANGES[self.scene.shape]
        if said := beyond_spectrum(ground_of(self.scene)) or outside(conditions_of(self.scene), ranges):
            return ErrorEstimate.out_of_range(said)
        if self.points > MOST_SPRINGS:
            return ErrorEstimate.out_of_range(
                f"a profile needs {self.points:.3g} springs, more than {MOST_SPRINGS:.3g}"
            )
        model, reason = _springs_model(self.scene)
        return ErrorEstimate(error=model + self.tolerance / 5 + self._own_scatter, reason=reason)

    def solve(self) -> Answer:
        """The mean stiffness of all profiles."""
        found = np.concatenate(list(self._stiffness()))
        in_contact = float(np.median(found)) / (self.scene.modulus * self.length / self.points)
        model, reason = _springs_model(self.scene)
        return Answer(
            value=np.array([found.mean()]),
            cost=self.cost(),
            model=model + self._own_scatter,
            sample=mean_error(found[:, np.newaxis] / found.mean()),
            reason=reason,
            failed=too_few(in_contact, "springs"),
        )

    def _stiffness(self) -> Iterator[FloatArray]:
        """Of all profiles, in blocks that fit into memory."""
        scene, ground, length, points = self.scene, ground_of(self.scene), self.length, self.points
        x = (np.arange(points) + 0.5) * length / points - length / 2
        wheel = mdr.sphere_profile(x, radius=scene.size) if scene.shape == "sphere" else np.zeros(points)
        rng, block = random_generator(self.seed, PROFILES), max(1, BLOCK // points)
        for first in range(0, self.count, block):
            profiles = mdr.rough_profiles(
                lambda q: mdr.geike(q, ground.c2d),
                length=length,
                points=points,
                count=min(block, self.count - first),
                rng=rng,
                rms=ground.rms,
            )
            yield mdr.stiffness_under(scene.load, profiles - wheel, length=length, modulus=scene.modulus)

    @property
    def _own_scatter(self) -> float:
        """Of one surface about the mean of all that have its spectrum, which is all that springs know."""
        return 2 * SCATTER if ground_of(self.scene).is_single else 0.0


def _springs_model(scene: IndentationScene) -> tuple[float, str]:
    """Relative error of the mean stiffness, at the most, and what it rests on."""
    if scene.shape == "sphere":
        ratio = scene.roughness_ratio
        return SPHERE_SPRINGS * ratio + SPHERE_FLOOR, counted({HEIGHT: ratio})
    load, waves = (conditions_of(scene)[name] for name in (LOAD, WAVES))
    level = float(np.interp(math.log10(load), *PUNCH_SPRINGS))
    return level + ROLL_OFF * (waves - 1), counted({LOAD: load, WAVES: waves})
