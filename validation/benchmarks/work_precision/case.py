"""All problems of speed against accuracy: timed one after the other, alone on the machine."""

from dataclasses import dataclass, field, replace

from validation.analysis.evidence import Table
from validation.benchmarks.found_models import TimedProblem, all_methods
from validation.benchmarks.timing import RunLimits
from validation.benchmarks.work_precision.dynamic_wheel import WheelProblem
from validation.benchmarks.work_precision.exact_problems import (
    PUNCH_GRIDS,
    SPHERE_GRIDS,
    WAVE_GRIDS,
    PunchProblem,
    SphereProblem,
    WaveProblem,
)
from validation.benchmarks.work_precision.figure_cost import FigureCost, figure_cost
from validation.benchmarks.work_precision.problem import ChartProblem, Grids, measure
from validation.benchmarks.work_precision.rolling import RollingProblem
from validation.benchmarks.work_precision.rough_punch import RoughPunchProblem
from validation.engine.engine import SERIAL, Engine, Outcome


@dataclass(frozen=True, kw_only=True)
class Precision:
    """Everything that is timed.

    sphere, punch, wave, fractal, rolling, wheel: the problems; cost: of Fig. 14.4; slow: a solve of the same problem
    that takes longer is timed once [s]; enough: after so many seconds five runs are enough; seed: of all roughness,
    zero or positive.
    """

    sphere: SphereProblem = field(default_factory=SphereProblem)
    punch: PunchProblem = field(default_factory=PunchProblem)
    wave: WaveProblem = field(default_factory=WaveProblem)
    fractal: RoughPunchProblem = field(default_factory=RoughPunchProblem)
    rolling: RollingProblem = field(default_factory=RollingProblem)
    wheel: WheelProblem = field(default_factory=WheelProblem)
    cost: FigureCost = field(default_factory=FigureCost)
    slow: float = 0.2
    enough: float = 0.02
    seed: int = 150

    def problems(self) -> tuple[ChartProblem, ...]:
        """First those with a closed form, then those without."""
        rough = (replace(problem, seed=self.seed) for problem in (self.fractal, self.rolling, self.wheel))
        return (self.sphere, self.punch, self.wave, *rough)


QUICK = Precision(
    fractal=RoughPunchProblem(realisations=8, profiles=60),
    rolling=RollingProblem(
        length=16,
        tracks=10,
        grids=Grids(cells=(3, 4, 8), polonsky_keer=(4,), fixed=4, tolerances=(1e-2,), per="to a radius"),
    ),
    wheel=WheelProblem(wheels=10, grids=Grids(cells=(6, 9), fixed=6, tolerances=(1e-2,), per="to a radius")),
    cost=FigureCost(steps=20),
)

FULL = Precision(
    sphere=SphereProblem(
        grids=replace(SPHERE_GRIDS, cells=(4, 8, 16, 32, 64), polonsky_keer=(4, 8, 16, 32)),
        peers=(4, 8, 16, 32),
        springs=(2.4, 4.4, 8.4, 16.4, 32.4, 64.4, 128.4, 256.4),
    ),
    punch=PunchProblem(
        grids=replace(PUNCH_GRIDS, cells=(8, 16, 32, 64, 128, 256), polonsky_keer=(8, 16, 32, 64), fixed=64),
        peers=(8, 16),
    ),
    wave=WaveProblem(
        grids=replace(
            WAVE_GRIDS, cells=(16, 32, 64, 128, 256, 512, 1024), polonsky_keer=(16, 64, 256, 1024), fixed=256
        ),
        peers=(16, 64, 256, 1024),
    ),
    fractal=RoughPunchProblem(
        realisations=100,
        profiles=500,
        grids=Grids(cells=(24, 32, 64, 128, 256), polonsky_keer=(32, 64, 128), fixed=128),
        springs=(24, 32, 64, 128, 256, 512, 1024),
    ),
    rolling=RollingProblem(
        length=32,
        realisations=8,
        tracks=60,
        grids=Grids(cells=(3, 4, 6, 8, 12, 16, 32), polonsky_keer=(4, 6), fixed=12, per="to a radius"),
    ),
    wheel=WheelProblem(
        realisations=8,
        wheels=60,
        grids=Grids(cells=(6, 9, 12, 15, 30), fixed=12, tolerances=(1e-2, 1e-3), per="to a radius"),
        springs=(12, 25, 50, 100),
    ),
    cost=FigureCost(steps=900),
    slow=1.0,
    enough=0.2,
)


@dataclass(frozen=True)
class PrecisionResult:
    """One outcome a problem; what Fig. 14.4 costs."""

    case: Precision
    outcomes: list[Outcome]
    cost: Table


def run(case: Precision, engine: Engine = SERIAL) -> PrecisionResult:
    """Time all problems, one at a time whatever the engine's workers, so that nothing else disturbs them."""
    limits = RunLimits(slow=case.slow, enough=case.enough)
    timed = [TimedProblem(problem, limits, all_methods()) for problem in case.problems()]
    with engine.timed() as alone:
        return PrecisionResult(case, alone.map(measure, timed), figure_cost(case.cost, alone))
