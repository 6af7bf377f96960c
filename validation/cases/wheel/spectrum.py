"""Fig. 14.4: the spectrum of the acceleration of a rolling wheel, its regions, and what moves them."""

import math
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

import bem3d
from mdr import SelfAffine
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import SERIAL, Engine, Outcome, random_generator
from validation.scenes.dynamic_wheel import WheelScene, load_wheel_scene
from validation.simulation.contact_laws import BoundaryElementsLaw, SpringsLaw
from validation.simulation.motion import simulate
from validation.simulation.wheel_on_springs import WheelEnsemble, simulate_ensemble

FloatArray = NDArray[np.float64]

TABLE = load_wheel_scene("table_14_1")
STRIP = 3
"""The spawn key of the strip in the picture."""


@dataclass(frozen=True, kw_only=True)
class WheelSpectrum:
    """An ensemble of wheels of a scene on springs, and the same with one parameter changed at a time.

    scene; realisations: of the scene itself; varied: of each variation; groups: into which both are divided for error
    bars; batch: wheels in step at most; parameters: whether to vary any; cells: to a contact radius of
    boundary elements in the picture; stills: steps before the picture is taken; seed: zero or positive.
    """

    scene: WheelScene = TABLE
    realisations: int = 60
    varied: int = 20
    groups: int = 10
    batch: int = 150
    parameters: bool = True
    cells: int = 16
    stills: int = 24
    seed: int = 146

    def variations(self) -> Mapping[str, WheelScene]:
        """Scenes by what is other than in the first."""
        varied = _varied(self.scene) if self.parameters else {}
        if self.scene.name in varied:
            raise ValueError(f"name must be another than those of variations, {', '.join(varied)}, got that")
        return {self.scene.name: self.scene, **varied}

    def rides(self, scene: WheelScene, realisations: int) -> list[WheelEnsemble]:
        """Batches of equal size, each of whole groups: a few wheels more where that asks for them."""
        batches = math.ceil(realisations / self.batch)
        groups = max(self.groups // batches, 1)
        count = groups * math.ceil(realisations / batches / groups)
        return [
            WheelEnsemble(scene=scene, first=i * count, count=count, groups=groups, seed=self.seed)
            for i in range(batches)
        ]

    def of(self, name: str) -> int:
        """Realisations of a variation."""
        return self.realisations if name == next(iter(self.variations())) else self.varied


@dataclass(frozen=True, kw_only=True)
class Still:
    """A picture of one wheel after some steps."""

    scene: WheelScene
    cells: int
    steps: int
    seed: int


@dataclass(frozen=True)
class WheelResult:
    """Batches of each variation, and the contact of one wheel in one and in three dimensions."""

    case: WheelSpectrum
    batches: Mapping[str, list[Outcome]]
    still: Outcome


def run(case: WheelSpectrum, engine: Engine = SERIAL) -> WheelResult:
    """Roll all wheels of all variations."""
    if case.scene.rail is None and case.scene.wheel is None:
        raise ValueError("scene must have a rough rail or a rough wheel, got both smooth")
    rides = {name: case.rides(scene, case.of(name)) for name, scene in case.variations().items()}
    outcomes = iter(engine.map(simulate_ensemble, [ride for batches in rides.values() for ride in batches]))
    found = {name: [next(outcomes) for _ in batches] for name, batches in rides.items()}
    lost = [name for name, batches in found.items() if any(batch["failed"] for batch in batches)]
    if lost:
        raise NotConvergedError("wheels were thrown farther than sums are exact for", lost)
    scene = case.scene
    still = Still(scene=scene, cells=case.cells, steps=case.stills, seed=case.seed)
    return WheelResult(case, found, engine.map(contact_snapshot, [still])[0])


def _varied(scene: WheelScene) -> dict[str, WheelScene]:
    """One parameter at a time, down and up."""
    found: dict[str, WheelScene] = {}
    for factor in (0.25, 2.0):
        found[f"v₀ × {factor:g}"] = replace(scene, speed=factor * scene.speed)
    for factor in (0.25, 4.0):
        found[f"F_N × {factor:g}"] = replace(scene, load=factor * scene.load)
    rail = scene.rail
    if rail is None:
        return found
    for factor in (0.5, 2.0):
        found[f"q_min × {factor:g}"] = replace(scene, rail=replace(rail, longest=rail.longest / factor))
    for factor in (0.5, 2.0):
        found[f"q_max × {factor:g}"] = replace(scene, rail=replace(rail, shortest=rail.shortest / factor))
    for hurst in (0.4, 1.0):
        found[f"H = {hurst:g}"] = replace(scene, rail=replace(rail, hurst=hurst))
    for factor in (0.25, 4.0):
        found[f"h₀ × {factor:g}"] = replace(scene, rail=replace(rail, rms=factor * rail.rms))
    return found


def contact_snapshot(still: Still) -> Outcome:
    """The contact of a wheel as the simulation has it, on springs and on the half-space.

    springs: x from the middle, profile of the wheel at its approach, height of the track, compression, over a and d;
    x, y: over a; pressure: over the largest of Hertz, in the frame that moves along, (x, y).
    """
    scene, wheel = still.scene, still.scene.body
    a, d = scene.contact_radius, scene.approach
    rides = WheelEnsemble(scene=scene, seed=still.seed)
    heights = rides.heights()
    motion = simulate(
        wheel, SpringsLaw(wheel, heights, scene.spacing), time_step=scene.time_step, steps=still.steps * 4
    )
    j = np.arange(-round(1.4 * scene.springs), round(1.4 * scene.springs) + 1)
    profile = (j * scene.spacing) ** 2 / scene.radius - motion.approach[0]
    height = heights[:, 0].take(j + 4 * still.steps, mode="wrap")
    contact = _strip_contact(still)
    x, y, pressure = contact.pressure()
    greatest = 2 * scene.modulus / math.pi * math.sqrt(d / scene.radius)
    return {
        "springs": np.stack([j * scene.spacing / a, profile / d, height / d, np.maximum(height - profile, 0) / d]),
        "x": x / a,
        "y": y / a,
        "pressure": pressure / greatest,
    }


def _carried(spectrum: SelfAffine, last: float, q: FloatArray) -> FloatArray:
    """C_2D up to a wavenumber."""
    return np.where(q <= last, spectrum.c2d(q), 0.0)


def _strip_contact(still: Still) -> bem3d.RollingContact:
    """Rolled by boundary elements over a strip with the isotropic spectrum of the scene, as far as it has waves."""
    scene, wheel = still.scene, still.scene.body
    spacing = scene.contact_radius / still.cells
    strip = np.zeros((12 * still.cells, 6 * still.cells))
    with warnings.catch_warnings():
        # a picture of one place: the waves that the cells carry
        warnings.simplefilter("ignore", bem3d.ResolutionWarning)
        for i, rough in enumerate((scene.rail, scene.wheel)):
            if rough is not None:
                carried = partial(_carried, rough.spectrum, math.pi / (2 * spacing))
                strip += bem3d.rough_surface(
                    carried, shape=strip.shape, spacing=spacing, rng=random_generator(still.seed, STRIP, i)
                )
    law = BoundaryElementsLaw(wheel, [strip], spacing)
    simulate(wheel, law, time_step=spacing / scene.speed, steps=still.steps)
    return law.contacts[0]
