"""All scenes of speed against accuracy: one after the other on the clock, alone on the machine."""

from dataclasses import dataclass, field, replace

from validation.benchmarks.peers import CONTESTANTS
from validation.benchmarks.work_precision.dynamic_wheel import WheelProblem
from validation.benchmarks.work_precision.exact_problems import PunchProblem, SphereProblem, WaveProblem
from validation.benchmarks.work_precision.measurement import Scene, TimedScene, measure
from validation.benchmarks.work_precision.rolling import RollingProblem
from validation.benchmarks.work_precision.rough_punch import Fractal
from validation.engine.engine import SERIAL, Engine, Outcome


@dataclass(frozen=True, kw_only=True)
class Precision:
    """Everything that is timed.

    sphere, punch, wave, fractal, rolling, wheel: the scenes; slow: who takes longer on the same problem is timed once
    [s]; enough: after so many seconds five runs are enough; seed: of all roughness, zero or positive.
    """

    sphere: SphereProblem = field(default_factory=SphereProblem)
    punch: PunchProblem = field(default_factory=PunchProblem)
    wave: WaveProblem = field(default_factory=WaveProblem)
    fractal: Fractal = field(default_factory=Fractal)
    rolling: RollingProblem = field(default_factory=RollingProblem)
    wheel: WheelProblem = field(default_factory=WheelProblem)
    slow: float = 0.2
    enough: float = 0.02
    seed: int = 150

    def scenes(self) -> tuple[Scene, ...]:
        """From what is known exactly to what nobody knows."""
        rough = (replace(scene, seed=self.seed) for scene in (self.fractal, self.rolling, self.wheel))
        return (self.sphere, self.punch, self.wave, *rough)


@dataclass(frozen=True)
class PrecisionResult:
    """One outcome a scene."""

    case: Precision
    outcomes: list[Outcome]


def run(case: Precision, engine: Engine = SERIAL) -> PrecisionResult:
    """Time all scenes, one at a time whatever the engine's workers, so that nobody is disturbed."""
    entrants = tuple(f"{contestant.name} {contestant.version}" for contestant in CONTESTANTS)
    trials = [TimedScene(scene, case.slow, case.enough, entrants) for scene in case.scenes()]
    with engine.timed() as alone:
        outcomes = alone.map(measure, trials)
    return PrecisionResult(case, outcomes)
