"""Fig. 14.4: the spectrum of the acceleration of a rolling wheel, its regions, and what moves them."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from validation.cases.wheel.contact_snapshot import Snapshot, contact_snapshot
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.scenes.dynamic_wheel import WheelScene, load_wheel_scene
from validation.simulation.wheel_on_springs import WheelEnsemble, simulate_ensemble

TABLE = load_wheel_scene("table_14_1")


@dataclass(frozen=True, kw_only=True)
class WheelSpectrum:
    """An ensemble of wheels of a scene on springs, and the same with one parameter changed at a time.

    scene; realisations: of the scene itself; varied: of each variation; groups: into which both are divided for error
    bars; batch: wheels that are simulated together, at most; parameters: whether to vary any; cells: to a contact
    radius of boundary elements in the snapshot; snapshot_steps: before it; seed: zero or positive.
    """

    scene: WheelScene = TABLE
    realisations: int = 60
    varied: int = 20
    groups: int = 10
    batch: int = 150
    parameters: bool = True
    cells: int = 16
    snapshot_steps: int = 24
    seed: int = 146

    def variations(self) -> Mapping[str, WheelScene]:
        """The scene, and others by the parameter that is changed."""
        varied = _varied(self.scene) if self.parameters else {}
        if self.scene.name in varied:
            raise ValueError(f"name must be another than those of variations, {', '.join(varied)}, got that")
        return {self.scene.name: self.scene, **varied}

    def batches(self) -> dict[str, list[WheelEnsemble]]:
        """Of each variation: of equal size, each of whole groups, with a few wheels more where that is necessary."""
        return {
            name: self._batches(scene, self.realisations if scene is self.scene else self.varied)
            for name, scene in self.variations().items()
        }

    def _batches(self, scene: WheelScene, realisations: int) -> list[WheelEnsemble]:
        batches = math.ceil(realisations / self.batch)
        groups = max(self.groups // batches, 1)
        count = groups * math.ceil(realisations / batches / groups)
        return [
            WheelEnsemble(scene=scene, first=i * count, count=count, groups=groups, seed=self.seed)
            for i in range(batches)
        ]


@dataclass(frozen=True)
class WheelResult:
    """Batches of each variation, and the contact of one wheel in one and in three dimensions."""

    case: WheelSpectrum
    batches: Mapping[str, list[Outcome]]
    snapshot: Outcome


def run(case: WheelSpectrum, engine: Engine = SERIAL) -> WheelResult:
    """Simulate all wheels of all variations."""
    scene = case.scene
    if scene.rail is None and scene.wheel is None:
        raise ValueError("scene must have a rough rail or a rough wheel, got both smooth")
    batches = engine.map_groups(simulate_ensemble, case.batches())
    failed = [name for name, group in batches.items() if any(batch["failed"] for batch in group)]
    if failed:
        raise NotConvergedError("wheels flew higher than sums are exact for", failed)
    snapshot = Snapshot(scene=scene, cells=case.cells, steps=case.snapshot_steps, seed=case.seed)
    return WheelResult(case, batches, engine.map(contact_snapshot, [snapshot])[0])


def _varied(scene: WheelScene) -> dict[str, WheelScene]:
    """One parameter at a time, down and up."""
    varied = {f"v₀ × {factor:g}": replace(scene, speed=factor * scene.speed) for factor in (0.25, 2.0)}
    varied |= {f"F_N × {factor:g}": replace(scene, load=factor * scene.load) for factor in (0.25, 4.0)}
    rail = scene.rail
    if rail is None:
        return varied
    rails = {f"q_min × {factor:g}": replace(rail, longest=rail.longest / factor) for factor in (0.5, 2.0)}
    rails |= {f"q_max × {factor:g}": replace(rail, shortest=rail.shortest / factor) for factor in (0.5, 2.0)}
    rails |= {f"H = {hurst:g}": replace(rail, hurst=hurst) for hurst in (0.4, 1.0)}
    rails |= {f"h₀ × {factor:g}": replace(rail, rms=factor * rail.rms) for factor in (0.25, 4.0)}
    return varied | {name: replace(scene, rail=one) for name, one in rails.items()}
