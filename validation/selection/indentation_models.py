"""Models for a body that is pressed: closed form, springs, boundary elements coarse and fine; the stiffness."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

import mdr
from validation.engine.engine import random_generator
from validation.scenes.indentation import IndentationScene
from validation.scenes.measured import MeasuredHeights
from validation.scenes.roughness import Roughness
from validation.selection.calibrated import Ranges, outside
from validation.selection.hierarchy import Answer, ContactModel, Cost, ErrorEstimate, counted, mean_error, realisations
from validation.selection.indentation_on_grids import SCATTER, IndentationOnGrid
from validation.simulation.indentation import FEW, finest_cells, ground_of, side_of
from validation.simulation.resolution import too_few
from validation.theory.closed_forms import rough_punch_stiffness

FloatArray = NDArray[np.float64]

PROFILES = 1
"""The spawn key under which profiles draw."""
FORMULA, SPRING = 2.0e-5, 3.5e-8
"""Seconds that a formula takes, and a spring in a sort, about."""
SPRINGS_TO_A_WAVE, SPRINGS_TO_A_RADIUS = 8, 100
MOST_SPRINGS, BLOCK = 2**26, 2**22
"""Springs of a profile at the most, which take four gigabytes, and of all that are drawn at once, or one profile."""
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
LOAD, HEIGHT, WAVES, HURST = "F / (E* h L)", "h/d", "longest waves on a side", "Hurst exponent"
LONG, SHORT, RATIO = "q a of the longest wave", "q a of the shortest wave", "longest over shortest wave"
"""What decides how far cheap models are off, in words."""
FACE: Ranges = {WAVES: (1, 5), RATIO: (3, 64), HURST: (0.2, 1.2)}
BALL: Ranges = {HEIGHT: (0, 1), LONG: (0, 2), SHORT: (0, 20), RATIO: (2, 20), HURST: (0.2, 1.2)}
CLOSED_RANGES: Mapping[str, Ranges] = {"punch": {LOAD: (0.2, math.inf), **FACE}, "sphere": BALL}
SPRINGS_RANGES: Mapping[str, Ranges] = {"punch": {LOAD: (1e-3, math.inf), **FACE}, "sphere": BALL}
"""Scenes for which the errors above hold: drawn ones were pressed with bands up to a factor 32 wide, those of Fig.
14.1 up to 64, and spheres with h/d from 0.003 and q a of the longest wave from 0.1. Under the highest loads both
bodies are flat punches, whose stiffness is known; waves much longer than the contact of a sphere only move it."""


def models(scene: IndentationScene, tolerance: float, seed: int) -> list[ContactModel]:
    """All that a scene can be asked with, the cheapest first; measured heights on their own points alone."""
    if scene.ground is None:
        return [IndentationClosedForm(scene)]
    finest = finest_cells(scene)
    measured = isinstance(scene.ground, MeasuredHeights)
    grids = [finest] if measured else [cells for cells in (finest // 4, finest // 2, finest) if cells >= FEW]
    solved = [IndentationOnGrid(scene, tolerance, seed, cells) for cells in grids]
    return [IndentationClosedForm(scene), IndentationOnSprings(scene, tolerance, seed), *solved]


@dataclass(frozen=True)
class IndentationClosedForm:
    """2 E* a of a smooth sphere, whose roughness is the error; a rough punch is a flat one in series with its face."""

    kind: ClassVar = "closed form"
    name: ClassVar = kind

    scene: IndentationScene

    def cost(self) -> Cost:
        """A formula."""
        return Cost(work=1, unit="formula", seconds=FORMULA)

    def estimate(self) -> ErrorEstimate:
        """By the load or the height."""
        if self.scene.ground is None:
            return ErrorEstimate(error=0.0, reason="the body is smooth, the formula exact")
        if said := beyond_spectra(self.scene.ground) or _outside(self.scene, CLOSED_RANGES):
            return ErrorEstimate.out_of_range(said)
        if self.scene.shape == "punch":
            return self._of_a_punch()
        ratio = self.scene.roughness_ratio
        return ErrorEstimate(error=SPHERE_CLOSED * ratio + SPHERE_FLOOR, reason=counted({HEIGHT: ratio}))

    def solve(self) -> Answer:
        """Evaluate it."""
        expected = self.estimate()
        return Answer(value=np.array([self._stiffness]), cost=self.cost(), model=expected.error, reason=expected.reason)

    @property
    def _stiffness(self) -> float:
        scene = self.scene
        if scene.shape == "sphere" or scene.ground is None:
            return scene.stiffness
        height = scene.ground.rms
        return rough_punch_stiffness(side=scene.size, modulus=scene.modulus, force=scene.load, height=height)

    def _of_a_punch(self) -> ErrorEstimate:
        """By the load, as measured; a measured face is one of many that have its spectrum."""
        ground, load, waves = ground_of(self.scene), self.scene.reduced_load, _waves_on_a_side(self.scene)
        power, last = math.log10(load), float(PUNCH_CLOSED[0][-1])
        error = float(np.interp(power, *PUNCH_CLOSED)) * 10 ** min(last - power, 0.0)
        own = 2 * SCATTER / max(load, 1.0) ** 2 if isinstance(ground, MeasuredHeights) else 0.0
        reason = counted({LOAD: load, WAVES: waves})
        return ErrorEstimate(error=error + CLOSED_ROLL_OFF * max(waves - 1, 0.0) + own, reason=reason)


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
        if said := beyond_spectra(ground_of(self.scene)) or _outside(self.scene, SPRINGS_RANGES):
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
        return 2 * SCATTER if isinstance(self.scene.ground, MeasuredHeights) else 0.0


def _conditions(scene: IndentationScene) -> dict[str, float]:
    """What decides how far cheap models are off."""
    ground = ground_of(scene)
    band = {RATIO: ground.q_max / ground.q_min}
    if isinstance(ground, Roughness):
        band[HURST] = ground.hurst
    if scene.shape == "punch":
        return {LOAD: scene.reduced_load, WAVES: _waves_on_a_side(scene), **band}
    radius = scene.contact_radius
    return {HEIGHT: scene.roughness_ratio, LONG: ground.q_min * radius, SHORT: ground.q_max * radius, **band}


def _outside(scene: IndentationScene, ranges: Mapping[str, Ranges]) -> str:
    """Why the error of a model is not known for a scene; empty where it is."""
    return outside(_conditions(scene), ranges[scene.shape])


def _waves_on_a_side(scene: IndentationScene) -> float:
    return ground_of(scene).q_min * scene.size / (2 * math.pi)


def _springs_model(scene: IndentationScene) -> tuple[float, str]:
    """Relative error of the mean stiffness, at the most, and what it rests on."""
    if scene.shape == "sphere":
        ratio = scene.roughness_ratio
        return SPHERE_SPRINGS * ratio + SPHERE_FLOOR, counted({HEIGHT: ratio})
    load, waves = scene.reduced_load, _waves_on_a_side(scene)
    level = float(np.interp(math.log10(load), *PUNCH_SPRINGS))
    return level + ROLL_OFF * (waves - 1), counted({LOAD: load, WAVES: waves})


def beyond_spectra(ground: Roughness | MeasuredHeights) -> str:
    """Why a model that knows a surface by its spectrum alone has nothing to say of this one; empty where it has."""
    beyond = ground.beyond_a_spectrum() if isinstance(ground, MeasuredHeights) else ()
    return f"knows the spectrum alone, and {beyond[0]}" if beyond else ""


CHEAP = (IndentationClosedForm.kind, IndentationOnSprings.kind)
"""The models below boundary elements, by their names."""
