"""Fig. 14.5: distances, the break, and what is real in the plateau; the peak at large amplitudes."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from validation.engine.convergence import NotConvergedError
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.scenes.dynamic_wheel import WheelScene, load_wheel_scene
from validation.scenes.roughness import Roughness
from validation.simulation.wheel_on_springs import TrackKind, WheelEnsemble, simulate_ensemble

TABLE = load_wheel_scene("table_14_1")
SHORT = replace(TABLE, distance=0.16)
MIN_JUMP, MIN_PERIODS = 4.0, 5.0
"""q_min v0 over the eigenfrequency, and periods of the oscillation behind it: with less, regions cannot be separated.
"""
OPEN, PERIODIC, STEADY = "springs, open", "springs, periodic", "springs, steady-state"
LINEAR_OPEN, LINEAR_STEADY = "linear, open", "linear, steady-state"
KINDS: dict[str, tuple[bool, TrackKind]] = {
    OPEN: (False, "open"),
    PERIODIC: (False, "periodic"),
    STEADY: (False, "steady-state"),
    LINEAR_OPEN: (True, "open"),
    LINEAR_STEADY: (True, "steady-state"),
}
"""Of contact and track: whether the contact is linear, and the track."""


@dataclass(frozen=True, kw_only=True)
class WheelDistance:
    """Wheels of one scene on springs over several distances, contacts and tracks, heights and amplitudes.

    scene; periods: natural periods in the shortest distance, whole; doublings: of it; wheels: to a distance up to the
    middle one, half as many for each doubling beyond, fewest at least; causes: wheels for each contact and track;
    rough: wheels for each height; heights: factors on h_0, ascending, with a quarter and one among them; phases:
    natural periods beyond a whole number after which records end, of `rough` wheels each; releases: amplitudes of free
    vibration over d, of `released` wheels each; groups: of wheels, for errors; seed: zero or more.
    """

    scene: WheelScene = SHORT
    periods: int = 1
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
        """Open tracks, each twice as long as the one before: all end in the same phase of free vibration, so that the
        jump at their end is equally large.
        """
        counts = [round(self.wheels * 2 ** (self.doublings / 2 - i)) for i in range(self.doublings + 1)]
        counts = [max(self.fewest, min(self.wheels, count)) // self.groups * self.groups for count in counts]
        return [
            WheelEnsemble(
                scene=replace(self.scene, distance=self.periods * self.scene.period_length * 2**i),
                count=count,
                groups=self.groups,
                seed=self.seed,
            )
            for i, count in enumerate(counts)
        ]

    def ensemble(self, kind: str, count: int, height: float = 1.0) -> WheelEnsemble:
        """Wheels of a contact and a track, at a height."""
        linear, track = KINDS[kind]
        scene = scaled(self.scene, height)
        return WheelEnsemble(scene=scene, count=count, groups=self.groups, track=track, linear=linear, seed=self.seed)

    def ends(self) -> dict[str, WheelEnsemble]:
        return {kind: self.ensemble(kind, self.causes) for kind in KINDS}

    def sweep(self) -> dict[tuple[str, float], WheelEnsemble]:
        """What makes region 2, at each height."""
        kinds = (OPEN, STEADY, LINEAR_OPEN)
        return {(kind, height): self.ensemble(kind, self.rough, height) for kind in kinds for height in self.heights}

    def ended(self) -> dict[tuple[str, float], WheelEnsemble]:
        """Open tracks that end in several phases of the natural period."""
        period = self.scene.period_length
        whole = max(round(self.scene.length / period), 1)
        return {
            (kind, phase): replace(
                self.ensemble(kind, self.rough), scene=replace(self.scene, distance=(whole + phase) * period)
            )
            for kind in (OPEN, LINEAR_OPEN)
            for phase in self.phases
        }

    def vibrations(self) -> dict[float, WheelEnsemble]:
        """Wheels that begin so much deeper than in equilibrium."""
        scene = replace(self.scene, distance=2 * self.scene.distance)
        count = self.released
        return {
            release: WheelEnsemble(scene=scene, count=count, groups=count, release=release, seed=self.seed)
            for release in self.releases
        }


@dataclass(frozen=True)
class DistanceResult:
    """One outcome for each distance, each contact and track, each height, each phase and each release."""

    case: WheelDistance
    distances: Mapping[int, Outcome]
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
    """Simulate all wheels.

    Raises ValueError for a scene without plateau or without region 3, NotConvergedError where most wheels of an
    ensemble do not converge.
    """
    _check_regions(case.scene)
    groups: dict[str, dict[Any, WheelEnsemble]] = {
        # the longest first, so that no worker is left alone with it
        "distances": dict(reversed(list(enumerate(case.distances())))),
        "ends": case.ends(),
        "sweep": case.sweep(),
        "ended": case.ended(),
        "vibrations": case.vibrations(),
    }
    solved = engine.map_groups(simulate_ensemble, {name: list(group.values()) for name, group in groups.items()})
    outcomes = {name: dict(zip(group, solved[name], strict=True)) for name, group in groups.items()}
    pairs = [(one, int(outcomes[name][key]["failed"])) for name in groups for key, one in groups[name].items()]
    failed = [(ensemble, count) for ensemble, count in pairs if count]
    unconverged = tuple(
        f"{count} of {one.count} wheels do not repeat their motion, h₀ = {one.scene.rms:.3g} m" for one, count in failed
    )
    if any(count > one.count / 2 for one, count in failed):
        raise NotConvergedError("most wheels of an ensemble do not repeat their motion", unconverged)
    return DistanceResult(case, unconverged=unconverged, **outcomes)


def _check_regions(scene: WheelScene) -> None:
    """Refuse a scene without a plateau, or with too few periods of the oscillation behind it."""
    if scene.rail is None and scene.wheel is None:
        raise ValueError("scene must have a rough rail or a rough wheel, got both smooth")
    if scene.jump < MIN_JUMP * scene.eigenfrequency:
        raise ValueError(
            f"scene must have q_min v0 of at least {MIN_JUMP:g} omega_eigen, {MIN_JUMP * scene.eigenfrequency:.4g} "
            f"rad/s, for a plateau between, got {scene.jump:.4g} rad/s"
        )
    least = scene.jump + MIN_PERIODS * scene.oscillation_period
    if scene.cutoff < least:
        raise ValueError(
            f"scene must have q_max v0 of at least {least:.4g} rad/s, {MIN_PERIODS:g} periods pi v0 / a behind "
            f"q_min v0, got {scene.cutoff:.4g} rad/s"
        )
