"""All problems of speed against accuracy: timed one after the other, alone on the machine."""

from dataclasses import dataclass, field, replace

from validation.benchmarks.peers import versions
from validation.benchmarks.timing import RunLimits
from validation.benchmarks.work_precision.dynamic_wheel import WheelProblem
from validation.benchmarks.work_precision.exact_problems import PunchProblem, SphereProblem, WaveProblem
from validation.benchmarks.work_precision.problem import ChartProblem, TimedProblem, measure
from validation.benchmarks.work_precision.rolling import RollingProblem
from validation.benchmarks.work_precision.rough_punch import RoughPunchProblem
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.model import all_models


@dataclass(frozen=True, kw_only=True)
class Precision:
    """Everything that is timed.

    sphere, punch, wave, fractal, rolling, wheel: the problems; slow: a solve of the same problem that takes longer is
    timed once [s]; enough: after so many seconds five runs are enough; seed: of all roughness, zero or positive.
    """

    sphere: SphereProblem = field(default_factory=SphereProblem)
    punch: PunchProblem = field(default_factory=PunchProblem)
    wave: WaveProblem = field(default_factory=WaveProblem)
    fractal: RoughPunchProblem = field(default_factory=RoughPunchProblem)
    rolling: RollingProblem = field(default_factory=RollingProblem)
    wheel: WheelProblem = field(default_factory=WheelProblem)
    slow: float = 0.2
    enough: float = 0.02
    seed: int = 150

    def problems(self) -> tuple[ChartProblem, ...]:
        """First those with a closed form, then those without."""
        rough = (replace(problem, seed=self.seed) for problem in (self.fractal, self.rolling, self.wheel))
        return (self.sphere, self.punch, self.wave, *rough)


@dataclass(frozen=True)
class PrecisionResult:
    """One outcome a problem."""

    case: Precision
    outcomes: list[Outcome]


def run(case: Precision, engine: Engine = SERIAL) -> PrecisionResult:
    """Time all problems, one at a time whatever the engine's workers, so that nothing else disturbs them."""
    methods = (*versions(), *(model.name for model in all_models()))
    limits = RunLimits(slow=case.slow, enough=case.enough)
    timed = [TimedProblem(problem, limits, methods) for problem in case.problems()]
    with engine.timed() as alone:
        outcomes = alone.map(measure, timed)
    return PrecisionResult(case, outcomes)
