"""Region 2 and its neighbours: its oscillation, the second-order force that makes it, and low speeds."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from validation.engine.convergence import NotConvergedError
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.scenes.dynamic_wheel import WheelScene, load_wheel_scene
from validation.simulation.wheel_on_springs import WheelEnsemble, simulate_ensemble

TABLE = load_wheel_scene("table_14_1")
LONG_STEADY, SHORT_STEADY, SHORT_OPEN = "Table 14.1, steady-state", "short waves, steady-state", "short waves, open"


@dataclass(frozen=True, kw_only=True)
class WheelRegions:
    """Wheels on springs over waves as long as those of a scene, over shorter ones, and at lower and lower speeds.

    scene: its rail is rough; distance: of the records of region 2 [m]; springs: to a contact radius there; short:
    longest of the shorter waves [m]; rms: their height [m]; wheels: of each ensemble; groups: of wheels, for errors;
    ratios: q_min v_0 over the eigenfrequency, falling; periods: natural periods of each record at these speeds; coarse:
    shortest wave there [m]; seed: zero or positive.
    """

    scene: WheelScene = TABLE
    distance: float = 0.3
    springs: int = 64
    short: float = 1e-3
    rms: float = 0.18e-6
    wheels: int = 20
    groups: int = 20
    ratios: tuple[float, ...] = (6.0, 3.0, 2.0, 1.6, 1.4, 1.3, 1.2, 1.15, 1.1, 1.05, 1.0)
    periods: int = 30
    coarse: float = 1e-3
    seed: int = 149

    @property
    def q_min_a(self) -> tuple[float, float]:
        """Of the scene, and of the shorter waves [-]."""
        a = self.scene.contact_radius
        return a * self.scene.jump / self.scene.speed, 2 * math.pi * a / self.short

    def plateaus(self) -> dict[str, WheelEnsemble]:
        """Records of region 2: on long waves and on short ones, without leakage and with it."""
        scene = replace(self.scene, distance=self.distance, springs=self.springs)
        assert scene.rail is not None  # as checked
        short = replace(scene, rail=replace(scene.rail, longest=self.short, rms=self.rms))
        one = WheelEnsemble(scene=scene, count=self.wheels, groups=self.groups, track="steady-state", seed=self.seed)
        return {
            LONG_STEADY: one,
            SHORT_STEADY: replace(one, scene=short),
            SHORT_OPEN: replace(one, scene=short, track="open"),
        }

    def speeds(self) -> dict[float, WheelEnsemble]:
        """Open tracks of the same number of natural periods."""
        rail = self.scene.rail
        assert rail is not None  # as checked
        slow = replace(self.scene, springs=24, rail=replace(rail, shortest=self.coarse))
        scenes = {ratio: replace(slow, speed=ratio * slow.eigenfrequency / rail.q_min) for ratio in self.ratios}
        return {
            ratio: WheelEnsemble(
                scene=replace(scene, distance=self.periods * scene.period_length),
                count=self.wheels,
                groups=self.groups,
                seed=self.seed,
            )
            for ratio, scene in scenes.items()
        }


@dataclass(frozen=True)
class RegionsResult:
    """Outcomes by contact and track, and by speed."""

    case: WheelRegions
    plateaus: Mapping[str, Outcome]
    speeds: Mapping[float, Outcome]


def run(case: WheelRegions, engine: Engine = SERIAL) -> RegionsResult:
    """Simulate all wheels. Raises ValueError for a smooth rail, NotConvergedError where a wheel does not converge."""
    if case.scene.rail is None or case.scene.wheel is not None:
        raise ValueError("scene must have a rough rail and a smooth wheel")
    groups: dict[str, dict[Any, WheelEnsemble]] = {"plateaus": case.plateaus(), "speeds": case.speeds()}
    solved = engine.map_groups(simulate_ensemble, {name: list(group.values()) for name, group in groups.items()})
    outcomes = {name: dict(zip(group, solved[name], strict=True)) for name, group in groups.items()}
    failed = [f"{name}, {key}" for name, group in outcomes.items() for key, one in group.items() if one["failed"]]
    if failed:
        raise NotConvergedError("wheels on springs do not repeat their motion, or flew too high", failed)
    return RegionsResult(case, **outcomes)
