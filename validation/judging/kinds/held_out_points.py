"""Scenes between and beside those of the tables: what boundary elements have there, held-out references, and a model.

The solves take some minutes of one core. A second wheel rolls over a second roughness, and a third one over a third on
cells of two lengths; punches have another H, bandwidth and longest wave; surfaces are isotropic and elongated.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, replace
from functools import partial
from itertools import groupby, product
from typing import Any, NamedTuple

import numpy as np

import bem3d
import mdr
from validation.analysis.series import Estimates
from validation.analysis.spectra import Bands, levels, waves
from validation.analysis.statistics import POWER_DECIBEL, Estimate, FloatArray, extrapolated
from validation.engine.engine import Engine, Outcome
from validation.engine.realisations import NotConvergedError, random_generator
from validation.judging.judgement import LEVEL as DECIBELS
from validation.judging.judgement import RATIO, Conditions
from validation.judging.kinds import profiles, rolling, stiffness
from validation.judging.kinds.judge import Finding, answer_of, attempted, compared
from validation.judging.kinds.references import Reference, reference_rows
from validation.judging.kinds.rolling import GRIDS, HEIGHT, SLOPE, Density, Q, WheelAtApproach, octave, variance_of
from validation.judging.kinds.stiffness import BAND, FIRST, FORCE, MEAN, H
from validation.judging.registry import Caller, Failed
from validation.simulation.rolling_strip import HERTZ, SMOOTH, RoughStrip, crop_to_reach, level_3d, roll_strip
from validation.simulation.rough_punch import PunchRoughness, Surface, left_by_solver, press_lightly
from validation.simulation.surface import draw_surface
from validation.simulation.track_spectrum import PiecewisePowerLaw, self_affine

SUFFIX = ", held out"
"""Behind the name of a quantity, that of its held-out points."""
ROUGHNESS, WHEEL, SURFACE = "roughness", "wheel", "surface"
SEED, TOLERANCE = 4801, 1e-4


def held_out(quantity: str) -> str:
    """Name of the held-out points of a quantity."""
    return quantity + SUFFIX


@dataclass(frozen=True, kw_only=True)
class HeldOutScene:
    """A wheel over isotropic roughness. hurst: H; first, last: q a of the band; lateral: cells across to one along."""

    wheel: WheelAtApproach
    hurst: float
    first: float
    last: float
    lateral: int

    @property
    def spectrum(self) -> PiecewisePowerLaw:
        """Of unit height and contact radius."""
        return self_affine(self.hurst, self.first, self.last)

    @property
    def where(self) -> dict[str, str]:
        """Its roughness and its wheel, as conditions."""
        return {ROUGHNESS: f"H = {self.hurst:g}, q a = {self.first:g} to {self.last:g}", WHEEL: str(self.wheel)}

    @property
    def settings(self) -> dict[str, float]:
        """As those of the case rolling, on shorter strips."""
        return {"hurst": self.hurst, "first": self.first, "last": self.last, "lowest": LOWEST, "length": LENGTH}

    def ground(self, height: float) -> mdr.SelfAffine:
        """In metres, of rms height h/d."""
        first, last = self.first / self.wheel.contact, self.last / self.wheel.contact
        return mdr.SelfAffine(hurst=self.hurst, q_min=first, q_max=last, rms=height * self.wheel.approach)

    def strip(self, height: float, length: float) -> RoughStrip:
        """Of rms height h/d."""
        return RoughStrip(spectrum=self.spectrum, height=height, length=length, width=WIDTH, seed=SEED)

    def surface(self, height: float, cells: int) -> FloatArray:
        """Heights over d of the strip for each position, so many cells to a contact radius along it."""
        shape = round(SHORT * cells), round(WIDTH * self.lateral * cells)
        spacing, rng = (1 / cells, 1 / (self.lateral * cells)), random_generator(SEED, round(1000 * self.hurst))
        return np.asarray(height * draw_surface(self.spectrum.c2d, shape=shape, spacing=spacing, rng=rng, rms=1.0))


SECOND = HeldOutScene(
    wheel=WheelAtApproach(radius=0.35, contact=3e-3, modulus=9e10), hurst=0.4, first=0.5, last=8.0, lateral=1
)
THIRD = HeldOutScene(
    wheel=WheelAtApproach(radius=0.2, contact=1.2e-3, modulus=2.1e11), hurst=0.55, first=0.8, last=13.0, lateral=2
)
SCENES = SECOND, THIRD
HEIGHTS, OCTAVES, STRIPS, CELLS = (0.03, 0.3), tuple(math.pi / 2 ** (k / 3) for k in (4, 1, -2)), 8, (8, 16)
"""h/d; q a of the middle of octaves; strips for levels, and cells to a contact radius on two grids."""
LENGTH, SHORT, WIDTH, LOWEST = 64.0, 32.0, 16.0, 0.55
"""Sides of the strips for levels, and for each position, over a; the lowest q a of their bands."""


# --- rolling ---


def levels_of_scenes(engine: Engine) -> Iterator[tuple[HeldOutScene, float, list[tuple[Estimate, float]]]]:
    """Octaves and variance of each scene and height: ln of it, and what the grids leave of that."""
    groups = {
        (scene, height, cells): scene.strip(height, LENGTH).strips(cells, 1e-3 * height, STRIPS)
        for scene in SCENES
        for height in HEIGHTS
        for cells in CELLS
    }
    outcomes = engine.map_groups(roll_strip, groups)
    for scene in SCENES:
        bands = Bands.around(math.pi, LOWEST, scene.last).on(LENGTH)
        linear = level_3d(scene.spectrum, bands)
        exact = [*(float(octave(linear, bands, q)) for q in OCTAVES), variance_of(scene.spectrum)]
        for height in HEIGHTS:
            coarse, fine = (_powers(outcomes[scene, height, n], bands, 1 / n) for n in CELLS)
            over = Estimates.ratios(coarse[:, 0], coarse[:, 1]) + Estimates.exact(np.log(exact))
            finer = Estimates.ratios(fine[:, 0], coarse[:, 0])
            yield scene, height, [extrapolated(*pair) for pair in zip(over, finer, strict=True)]


def _powers(strips: list[Outcome], bands: Bands, spacing: float) -> FloatArray:
    """Octaves and variance of boundary elements, and of linear theory on the same strips."""
    both = np.array([[strip["force"], strip["linear"]] for strip in strips])
    thirds = levels(waves(both, spacing=spacing), bands)
    octaves = [octave(thirds, bands, q) for q in OCTAVES]
    return np.stack([*octaves, both.var(axis=-1)], axis=-1)


def of_octaves(engine: Engine) -> Iterator[Reference]:
    """Levels of octaves [dB over F_Hertz^2 (h/d)^2]."""
    for scene, height, estimates in levels_of_scenes(engine):
        for q, pair in zip(OCTAVES, estimates, strict=False):
            yield _level(scene, height, pair, {Q: q})


def of_variance(engine: Engine) -> Iterator[Reference]:
    """Level of the variance [dB over F_Hertz^2 (h/d)^2]."""
    for scene, height, estimates in levels_of_scenes(engine):
        yield _level(scene, height, estimates[-1], {})


def _level(scene: HeldOutScene, height: float, pair: tuple[Estimate, float], at: Conditions) -> Reference:
    value, left = (pair[0], POWER_DECIBEL * pair[1])
    where = {**scene.where, HEIGHT: height, SLOPE: round(height * scene.spectrum.slope_along, 4), **at}
    return Reference(where, POWER_DECIBEL * value.value, POWER_DECIBEL * value.half_width, left)


@dataclass(frozen=True)
class OblongStrip:
    """The strip of a scene for each position. cells: to a contact radius along it; by_load: or by approach."""

    scene: HeldOutScene
    height: float
    cells: int
    by_load: bool


def roll_oblong(strip: OblongStrip) -> Outcome:
    """Force over that of Hertz, or the approach over d, at each position; failed: positions that did not converge."""
    across = 1 / (strip.scene.lateral * strip.cells)
    seen = np.ascontiguousarray(crop_to_reach(strip.scene.surface(strip.height, strip.cells), across))
    wheel: dict[str, Any] = {"radius": 1.0, "modulus": 1.0, "force": HERTZ} if strip.by_load else SMOOTH
    rolled = bem3d.roll(
        seen, spacing=(1 / strip.cells, across), tolerance=1e-4 * strip.height, raise_on_failure=False, **wheel
    )
    value = rolled.approach if strip.by_load else rolled.force / HERTZ
    return {"value": value, "failed": np.array(float(np.count_nonzero(~rolled.converged)))}


def at_positions(by_load: bool) -> Callable[[Engine], Iterator[Reference]]:
    """See `rolling.at_positions`."""

    def solved(engine: Engine) -> Iterator[Reference]:
        keys = list(product(SCENES, HEIGHTS, GRIDS))
        outcomes = engine.map(roll_oblong, [OblongStrip(*key, by_load) for key in keys])
        if lost := sum(float(outcome["failed"]) for outcome in outcomes):
            raise NotConvergedError(f"{lost:.0f} positions did not converge", ())
        on = {key: outcome["value"] for key, outcome in zip(keys, outcomes, strict=True)}
        for scene, height in product(SCENES, HEIGHTS):
            where: Conditions = {**scene.where, HEIGHT: height}
            yield from rolling.at_positions(where, *(on[scene, height, cells] for cells in GRIDS))

    return solved


OF_STRIPS: dict[str, Any] = {
    "scenes": [asdict(scene) for scene in SCENES],
    "heights": HEIGHTS,
    "strips": STRIPS,
    "cells": CELLS,
    "length": LENGTH,
    "width": WIDTH,
    "lowest": LOWEST,
    "seed": SEED,
}
OF_POSITIONS = {**OF_STRIPS, "strips": 1, "cells": GRIDS, "length": SHORT}


# --- punches ---


class Punch(NamedTuple):
    """hurst: H; first: longest waves on a side; ratio: q_max / q_min; cells: to the shortest wave; surfaces: on these
    cells; refined: of those, as many on half as long cells."""

    hurst: float
    first: int
    ratio: int
    cells: int
    surfaces: int
    refined: int


PUNCHES = Punch(0.6, 1, 32, 4, 240, 40), Punch(0.45, 1, 8, 8, 300, 60), Punch(0.8, 8, 8, 4, 40, 10)
LOADS = tuple(10.0 ** (-i / 6) for i in (13, 9, 5, 1))
"""Fbar, midway between loads of the table."""


def pressed(engine: Engine) -> Iterator[Reference]:
    """Mean of k / (E* L) over the surfaces, to first order at zero cell size, by the surfaces of both grids."""
    groups = {
        (punch, times): [
            Surface(
                roughness=PunchRoughness(hurst=punch.hurst, waves=(punch.first, last), seed=SEED),
                realisation=i,
                cells=times * punch.cells * last,
                forces=LOADS,
                tolerance=TOLERANCE,
            )
            for i in range(punch.surfaces if times == 1 else punch.refined)
        ]
        for punch in PUNCHES
        for last in [punch.first * punch.ratio]
        for times in (1, 2)
    }
    outcomes = engine.map_groups(press_lightly, groups)
    for punch in PUNCHES:
        coarse, fine = (np.array([outcome["stiffness"] for outcome in outcomes[punch, n]]) for n in (1, 2))
        mean, finer = Estimates.ratios(coarse, np.ones_like(coarse)), Estimates.ratios(fine, coarse[: punch.refined])
        for force, pair in zip(LOADS, zip(mean, finer, strict=True), strict=True):
            value, left = extrapolated(*pair)
            where = {H: punch.hurst, FIRST: float(punch.first), BAND: float(punch.ratio), FORCE: force}
            yield Reference(where, math.exp(value.value), value.half_width, math.hypot(left, left_by_solver()))


OF_PUNCHES: dict[str, Any] = {
    "punches": [punch._asdict() for punch in PUNCHES],
    "forces": LOADS,
    "seed": SEED,
    "tolerance": TOLERANCE,
}


@dataclass(frozen=True)
class HeldOutSurface:
    """A square face. hurst; elongated: sides of its waves, along axis 0 over axis 1; realisation."""

    hurst: float
    elongated: int
    realisation: int

    def __str__(self) -> str:
        shape = f"waves {self.elongated}:1" if self.elongated > 1 else "isotropic"
        return f"H = {self.hurst:g}, {shape}, {self.realisation}"

    def height(self, cells: int) -> FloatArray:
        """Over h, of so many cells on a side: waves 1 to 24 on the side, of which more lie along a shortened axis."""
        q = 2 * math.pi
        spectrum = PiecewisePowerLaw(edges=(q, FACE_WAVES * q), exponents=(2 * self.hurst + 2,))
        spacing = 1 / cells, self.elongated / cells
        rng = random_generator(SEED, round(1000 * self.hurst), self.elongated, self.realisation)
        return draw_surface(spectrum.c2d, shape=(cells, cells), spacing=spacing, rng=rng, rms=1.0)


FACE_WAVES, FACE_CELLS, FACE_HEIGHT, FACE_LOADS = 24, 192, 1e-3, (0.01, 0.1, 1.0)
FACES = tuple(HeldOutSurface(0.6, elongated, i) for elongated in (1, 2) for i in range(2))
"""Waves on a side; cells on a side of what a model is given; h / L; Fbar; the faces."""


@dataclass(frozen=True)
class PressedFace:
    """One face on one grid."""

    face: HeldOutSurface
    cells: int


def press_face(problem: PressedFace) -> Outcome:
    """k / (E* L) under each load."""
    n = problem.cells
    body = bem3d.HalfSpace(shape=(n, n), spacing=1 / n, modulus=1.0)
    forces = FACE_HEIGHT * np.array(FACE_LOADS)
    gap = -FACE_HEIGHT * problem.face.height(n)
    path = bem3d.indent(body, gap, forces=forces, stiffness=True, tolerance=TOLERANCE, indenter_ends_at_edge=True)
    return {"stiffness": np.array([contact.stiffness() for contact in path])}


def faces(engine: Engine) -> Iterator[Reference]:
    """On the finer of two grids."""
    grids = FACE_CELLS, 2 * FACE_CELLS
    outcomes = engine.map_groups(press_face, {n: [PressedFace(face, n) for face in FACES] for n in grids})
    return stiffness.on_finer_grid([{SURFACE: str(face)} for face in FACES], FACE_LOADS, *(outcomes[n] for n in grids))


OF_FACES: dict[str, Any] = {
    "faces": [str(face) for face in FACES],
    "waves": FACE_WAVES,
    "cells": FACE_CELLS,
    "forces": FACE_LOADS,
    "seed": SEED,
    "tolerance": TOLERANCE,
}
Solve = Callable[[Engine], Iterable[Reference]]

# --- a model beside these scenes ---

BAND_OF_RULE = (0.62, 700.0, 23.0, 3e-7)
"""H, first wavenumber [rad/m], the last over the first, and rms height [m] of the roughness of which a rule must have
the properties."""
WHEELS, ALPHAS, OF_LINEAR = ((35.0, 540.0, 0.12), (70.0, 800.0, 1.0)), (0.0, 0.7, 3.0, math.inf), 0.12
"""Load [kN], diameter [mm] and radius of the crown [m]; alpha; and how far boundary elements are from linear theory of
the ellipse at most, in the bands that count, on rails of the roughness of ISO 3095 [dB]."""


def judged(model: Caller) -> Iterator[Finding]:
    """By the kind; a contact law has no scene of its own: its wheels start where no table of them is."""
    if model.kind in JUDGES:
        yield from JUDGES[model.kind](model)


# --- punches ---


def _stiffness(model: Caller) -> Iterator[Finding]:
    """Mean at another H, bandwidth and longest wave."""
    rows = reference_rows(held_out(MEAN))
    yield from stiffness.beside_punches(
        rows, stiffness.answers_of(model, [stiffness.JudgedPunch.at(row.where) for row in rows])
    )


def _surfaces(model: Caller) -> Iterator[Finding]:
    """Of isotropic and elongated faces."""
    height = {str(face): face for face in FACES}
    for name, rows in groupby(reference_rows(held_out(stiffness.OF_SURFACE)), lambda row: str(row.where[SURFACE])):
        face = FACE_HEIGHT * stiffness.SIDE * height[name].height(FACE_CELLS)
        for row in rows:
            load = stiffness.load_of(row[stiffness.FORCE])
            value = model.call(height=face, spacing=stiffness.SIDE / FACE_CELLS, modulus=stiffness.MODULUS, load=load)
            yield Finding(row, stiffness.over_unit(value))


# --- wheels ---


def _spectrum(model: Caller) -> Iterator[Finding]:
    return levels_beside(lambda q, wheel, ground: answer_of(model, **rolling.over(q, ground, wheel)))


def levels_beside(density: Density) -> Iterator[Finding]:
    """Octaves and variance of a second and a third wheel over other roughness."""
    for scene in SCENES:
        rows = reference_rows(*map(held_out, (rolling.LEVEL, rolling.RMS)), where=scene.where)
        for height in dict.fromkeys(row[HEIGHT] for row in rows):
            at_height = [row for row in rows if row[HEIGHT] == height]
            yield from compared(at_height, attempted(_levels_of_scene, density, scene, height))


def _levels_of_scene(density: Density, scene: HeldOutScene, height: float) -> FloatArray:
    wheel, ground = scene.wheel, scene.ground(height)
    return rolling.levels_of_density(lambda q: density(q, wheel, ground), wheel, height, scene.settings, OCTAVES)


def _rolling(model: Caller) -> Iterator[Finding]:
    """Position by position along one strip of each, and the mean over it; the third has cells of two lengths."""
    by_load = "approach" not in model.asks
    quantity, mean, unit = (
        (rolling.LIFT, "mean approach", "approach") if by_load else (rolling.EACH, rolling.MEAN, "force")
    )
    for scene in SCENES:
        rows = reference_rows(held_out(quantity), where=scene.where)
        for height in dict.fromkeys(row[HEIGHT] for row in rows):
            at_height = [row for row in rows if row[HEIGHT] == height]
            answer = attempted(_rolled_over_scene, model, scene, height)
            where: Conditions = {**scene.where, HEIGHT: height}
            yield rolling.position_by_position(model, at_height, answer, scene.wheel, where, held_out(""))
            grid = float(np.mean([row.value * row.grid for row in at_height]))
            value = float(np.mean([row.value for row in at_height]))
            row = Reference(where, value, grid=grid / value, unit=RATIO, quantity=held_out(mean))
            if not isinstance(answer, Failed):
                answer = float(rolling.at_centres(answer).mean()) / getattr(scene.wheel, unit)
            yield Finding(row, answer)


def _rolled_over_scene(model: Caller, scene: HeldOutScene, height: float) -> FloatArray:
    surface = scene.surface(height, GRIDS[1])
    return answer_of(model, **rolling.on(surface, GRIDS[1], scene.wheel, scene.lateral))


# --- a rail ---


def _filter(model: Caller) -> Iterator[Finding]:
    """Beside linear theory of the ellipse, which boundary elements have at that roughness up to `OF_LINEAR`."""
    for wheel in WHEELS:
        scene = rolling.scene_of(*wheel)
        for alpha in ALPHAS:
            if math.isfinite(alpha) or rolling.answers_isotropic(model):
                bands = rolling.counted_bands(scene, alpha)
                where, quantity = rolling.conditions_of(scene.name, alpha), held_out(rolling.FILTER)
                rows = [
                    Reference({**where, rolling.WAVE: wave}, level, 0.0, OF_LINEAR, DECIBELS, quantity)
                    for _, wave, level in bands
                ]
                yield from compared(rows, attempted(rolling.in_bands, model, scene, alpha, [i for i, *_ in bands]))


# --- rules ---


def _rule(model: Caller) -> Iterator[Finding]:
    """Properties of another roughness; springs and levels with it."""
    hurst, first, ratio, height = BAND_OF_RULE
    for finding in profiles.properties_of_rule(model, hurst, first, first * ratio, height):
        reference = replace(finding.reference, quantity=held_out(finding.reference.quantity))
        yield finding._replace(reference=reference)
    yield from profiles.springs_beside(model, reference_rows(held_out(MEAN)))
    yield from levels_beside(partial(profiles.density_of_rule, model))


JUDGES: Mapping[str, Callable[[Caller], Iterator[Finding]]] = {
    "stiffness_model": _stiffness,
    "stiffness_of_surface": _surfaces,
    "force_spectrum": _spectrum,
    "rolling_model": _rolling,
    "contact_filter": _filter,
    "profile_spectrum": _rule,
}
