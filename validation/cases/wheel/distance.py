"""Fig. 14.5: distances, the break, and what is real in the plateau; the peak at large amplitudes."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from validation.engine.convergence import NotConvergedError
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.scenes.dynamic_wheel import WheelScene, load_wheel_scene
from validation.scenes.roughness import Roughness
from validation.simulation.wheel_on_springs import TrackKind, WheelEnsemble, simulate_ensemble

TABLE = load_wheel_scene("table_14_1")
SHORT = replace(TABLE, distance=0.16)
LEAST_JUMP, LEAST_PERIODS = 4.0, 5.0
"""Over the eigenfrequency, and behind the jump, for regions that can be told apart."""
SPRINGS, LINEAR = "springs", "linear"


@dataclass(frozen=True, kw_only=True)
class WheelDistance:
    """Wheels of one scene on springs, which roll more or less far, on open and closed tracks, over more or less height.

    scene; turns: of the resonance on the shortest distance, whole; doublings: of it; wheels: to a distance up to the
    middle one, half as many for each doubling beyond, fewest at least; causes: wheels for each way to end a track;
    rough: wheels for each height; heights: factors on h_0, ascending, with a quarter and one among them;
    phases: turns over whole ones at which records end, of `rough` wheels; releases: amplitudes of free vibration over
    d, of `released` wheels each; groups: of wheels, for errors; seed: zero or more.
    """

    scene: WheelScene = SHORT
    turns: int = 1
    doublings: int = 4
    wheels: int = 60
    fewest: int = 20
    causes: int = 20
    rough: int = 10
    heights: tuple[float, ...] = (0.25, 1.0, 4.0)
    phases: tuple[float, ...] = (0.0, 0.5)
    releases: tuple[float, ...] = (0.0, 0.4)
    released: int = 4
    groups: int = 10
    seed: int = 147

    def distances(self) -> list[WheelEnsemble]:
        """Open tracks, each twice as long as the one before."""
        rides = []
        for i in range(self.doublings + 1):
            # all end in the same phase of free vibration: the jump at their end is as large
            turn = 2 * math.pi * self.scene.speed / self.scene.eigenfrequency
            scene = replace(self.scene, distance=self.turns * turn * 2**i)
            count = max(self.fewest, min(self.wheels, round(self.wheels * 2 ** (self.doublings / 2 - i))))
            count -= count % self.groups
            rides.append(WheelEnsemble(scene=scene, count=count, groups=self.groups, seed=self.seed))
        return rides

    def ends(self) -> dict[str, WheelEnsemble]:
        """Every way to end a track."""
        return {
            "springs, open": self.ending(SPRINGS, "open", self.causes),
            "springs, whole turns": self.ending(SPRINGS, "periodic", self.causes),
            "springs, repeating": self.ending(SPRINGS, "steady-state", self.causes),
            "linear, open": self.ending(LINEAR, "open", self.causes),
            "linear, repeating": self.ending(LINEAR, "steady-state", self.causes),
        }

    def ending(self, law: str, track: TrackKind, count: int, height: float = 1.0) -> WheelEnsemble:
        """One of these, at a height."""
        return WheelEnsemble(
            scene=scaled(self.scene, height),
            count=count,
            groups=self.groups,
            track=track,
            linear=law == LINEAR,
            seed=self.seed,
        )

    def sweep(self) -> dict[tuple[str, float], WheelEnsemble]:
        """Open springs, repeating springs and the open linear contact at each height."""
        kinds: tuple[tuple[str, TrackKind], ...] = ((SPRINGS, "open"), (SPRINGS, "steady-state"), (LINEAR, "open"))
        return {
            (f"{law}, {track}", height): self.ending(law, track, self.rough, height)
            for law, track in kinds
            for height in self.heights
        }

    def ended(self) -> dict[tuple[str, float], WheelEnsemble]:
        """Open tracks of springs and of the linear contact that end in several phases of the resonance."""
        turn = 2 * math.pi * self.scene.speed / self.scene.eigenfrequency
        whole = max(round(self.scene.length / turn), 1)
        return {
            (law, phase): replace(
                self.ending(law, "open", self.rough), scene=replace(self.scene, distance=(whole + phase) * turn)
            )
            for law in (SPRINGS, LINEAR)
            for phase in self.phases
        }

    def vibrations(self) -> dict[float, WheelEnsemble]:
        """Wheels that begin so much deeper than in equilibrium."""
        scene = replace(self.scene, distance=2 * self.scene.distance)
        return {
            release: WheelEnsemble(
                scene=scene, count=self.released, groups=self.released, release=release, seed=self.seed
            )
            for release in self.releases
        }


@dataclass(frozen=True)
class DistanceResult:
    """One outcome for each distance, each ending, each height and each release."""

    case: WheelDistance
    distances: list[Outcome]
    ends: Mapping[str, Outcome]
    sweep: Mapping[tuple[str, float], Outcome]
    ended: Mapping[tuple[str, float], Outcome]
    vibrations: Mapping[float, Outcome]
    unconverged: tuple[str, ...]


def scaled(scene: WheelScene, factor: float) -> WheelScene:
    """The scene with all heights times a factor."""

    def times(rough: Roughness | None) -> Roughness | None:
        return replace(rough, rms=factor * rough.rms) if rough else None

    return replace(scene, rail=times(scene.rail), wheel=times(scene.wheel))


def run(case: WheelDistance, engine: Engine = SERIAL) -> DistanceResult:
    """Roll all wheels.

    Raises ValueError for a scene without plateau or without region 3, NotConvergedError where nothing repeats itself.
    """
    _has_regions(case.scene)
    ends, sweep, ended, vibrations = case.ends(), case.sweep(), case.ended(), case.vibrations()
    distances = case.distances()
    # the longest first, so that no worker is left with it alone
    rides = [*distances[::-1], *ends.values(), *sweep.values(), *ended.values(), *vibrations.values()]
    outcomes = engine.map(simulate_ensemble, rides)
    lost = tuple(
        f"{int(o['failed'])} of {r.count} wheels do not repeat themselves, h₀ = {r.scene.rms:.3g} m"
        for r, o in zip(rides, outcomes, strict=True)
        if o["failed"]
    )
    if any(o["failed"] > r.count / 2 for r, o in zip(rides, outcomes, strict=True)):
        raise NotConvergedError("most wheels of an ensemble do not repeat themselves", lost)
    left = iter(outcomes)
    found = [next(left) for _ in distances][::-1]
    return DistanceResult(
        case,
        found,
        {name: next(left) for name in ends},
        {key: next(left) for key in sweep},
        {key: next(left) for key in ended},
        {release: next(left) for release in vibrations},
        lost,
    )


def _has_regions(scene: WheelScene) -> None:
    """Refuse what has no plateau to take apart, or too little behind it."""
    if scene.rail is None and scene.wheel is None:
        raise ValueError("scene must have a rough rail or a rough wheel, got both smooth")
    if scene.jump < LEAST_JUMP * scene.eigenfrequency:
        raise ValueError(
            f"scene must have q_min v0 of at least {LEAST_JUMP:g} omega_eigen, {LEAST_JUMP * scene.eigenfrequency:.4g} "
            f"rad/s, for a plateau between, got {scene.jump:.4g} rad/s"
        )
    period = math.pi * scene.speed / scene.contact_radius
    if scene.cutoff < scene.jump + LEAST_PERIODS * period:
        raise ValueError(
            f"scene must have q_max v0 of at least {scene.jump + LEAST_PERIODS * period:.4g} rad/s, {LEAST_PERIODS:g} "
            f"periods pi v0 / a behind q_min v0, got {scene.cutoff:.4g} rad/s"
        )
