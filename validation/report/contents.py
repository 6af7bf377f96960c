"""What a report holds: the cases, chapter by chapter, with their claims and both sizes."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal

from validation.analysis.evidence import Evidence
from validation.benchmarks.peers import peers_installed
from validation.benchmarks.solvers import case as race
from validation.benchmarks.solvers import dynamic_wheel as race_wheel
from validation.benchmarks.solvers import evidence as race_evidence
from validation.benchmarks.solvers import rolling as race_rolling
from validation.benchmarks.work_precision import case as precision_scenes
from validation.benchmarks.work_precision import evidence as precision_evidence
from validation.benchmarks.work_precision.dynamic_wheel import WheelProblem
from validation.benchmarks.work_precision.exact_problems import PunchProblem, SphereProblem, WaveProblem
from validation.benchmarks.work_precision.rolling import RollingProblem
from validation.benchmarks.work_precision.rough_punch import Fractal
from validation.cases.exact import geike, hertz, square_punch, westergaard
from validation.cases.limits import evidence as limits_evidence
from validation.cases.limits import limits
from validation.cases.punch import area_gap_rolloff as mdr_limits
from validation.cases.punch import fractal_punch, fractal_punch_evidence, normalisation
from validation.cases.rolling import force_spectrum as rolling
from validation.cases.rolling import force_spectrum_evidence as rolling_evidence
from validation.cases.rolling import input_spectrum as rolling_input
from validation.cases.rolling import ridges
from validation.cases.selection import model_needed as needs
from validation.cases.selection import model_selection as ladder
from validation.cases.stability import evidence as wheel_stability_evidence
from validation.cases.stability import stability as wheel_stability
from validation.cases.wheel import distance as wheel_distance
from validation.cases.wheel import distance_evidence as wheel_distance_evidence
from validation.cases.wheel import half_space as wheel_3d
from validation.cases.wheel import half_space_evidence as wheel_3d_evidence
from validation.cases.wheel import spectrum as wheel
from validation.cases.wheel import spectrum_evidence as wheel_evidence
from validation.engine.engine import Engine
from validation.scenes.dynamic_wheel import WheelScene

Profile = Literal["quick", "full"]

EXACT = "What is known exactly"
PRESSED = "Rough punches: the stiffness and its fluctuation"
ROLLING = "Rolling: the force along the track"
WHEEL = "The dynamic wheel"
LIMITS = "Where each method fails"
SPEED = "Speed against accuracy"
LADDER = "No more model than a scene needs"
CHAPTERS = (EXACT, PRESSED, ROLLING, WHEEL, LIMITS, SPEED, LADDER)
"""Of the report, in the order of its argument."""


@dataclass(frozen=True)
class Entry:
    """A case in the list: its chapter, the claim under test, which figure it answers, its two sizes, how to run it.

    evidence: read from what the run returned; needs: which rung of the ladder it takes, from its settings.
    """

    chapter: str
    claim: str
    answers: str
    quick: Any
    full: Any
    run: Callable[[Any, Engine], Any]
    evidence: Callable[[Any], Evidence]
    needs: Callable[[Any], str]

    def case(self, profile: Profile, seed: int | None, scene: WheelScene | None = None) -> Any:
        """The case of that size, with the seed where it draws anything, and the scene where it has one."""
        case = self.quick if profile == "quick" else self.full
        if seed is not None and hasattr(case, "seed"):
            case = replace(case, seed=seed)
        return replace(case, scene=scene) if scene is not None and hasattr(case, "scene") else case


PRECISION = Entry(
    SPEED,
    "Springs are the cheapest up to some error, boundary elements beyond; scene by scene the chart says which.",
    "Speed against accuracy: error against cost of every method, who is the cheapest within which error",
    precision_scenes.Precision(),
    precision_scenes.Precision(
        sphere=SphereProblem(
            cells=(4, 8, 16, 32, 64),
            plain=(4, 8, 16, 32),
            peers=(4, 8, 16, 32),
            springs=(2.4, 4.4, 8.4, 16.4, 32.4, 64.4, 128.4, 256.4),
        ),
        punch=PunchProblem(cells=(8, 16, 32, 64, 128, 256), plain=(8, 16, 32, 64), peers=(8, 16), fixed=64),
        wave=WaveProblem(
            cells=(16, 32, 64, 128, 256, 512, 1024),
            plain=(16, 64, 256, 1024),
            peers=(16, 64, 256, 1024),
            fixed=256,
        ),
        fractal=Fractal(
            surfaces=100,
            profiles=500,
            cells=(24, 32, 64, 128, 256),
            plain=(32, 64, 128),
            springs=(24, 32, 64, 128, 256, 512, 1024),
            fixed=128,
        ),
        rolling=RollingProblem(length=32, strips=8, tracks=60, cells=(3, 4, 6, 8, 12, 16, 32), plain=(4, 6), fixed=12),
        wheel=WheelProblem(strips=8, wheels=60, cells=(6, 9, 12, 15, 30), springs=(12, 25, 50, 100), fixed=12),
        slow=1.0,
        enough=0.2,
    ),
    precision_scenes.run,
    precision_evidence.evidence,
    needs.always("scene by scene"),
)

RACE = Entry(
    SPEED,
    "Our solver is the fastest at the same residual.",
    "The race: our solver beside the peers that are installed, same problems, same residual",
    race.Race(),
    race.Race(
        cells=(256, 512, 1024),
        scaling=(128, 256, 512, 1024, 2048, 4096),
        errand=race.Errand(cells=256, sampled=(0, 6, 12, 18, 24), paths=5),
        rolling=race_rolling.RollingThroughput(cells=(8, 16, 32), finest=64, positions=1600),
        wheel=race_wheel.SteppingThroughput(
            springs=(12, 25, 50, 100, 200, 400), heights=(0.01, 0.1, 0.3, 1.0), steps=8000, bem_steps=1600
        ),
    ),
    race.run,
    race_evidence.evidence,
    needs.always("–"),
)

TIMED = {"precision": PRECISION, "race": RACE}
"""Run alone, last and in this order; their times differ from run to run, and stay out of the results."""

CASES = {
    "hertz": Entry(
        EXACT,
        "Both methods give the contact of Hertz.",
        "Smooth sphere: both methods against Hertz",
        hertz.Hertz(),
        hertz.Hertz(cells_per_radius=(8, 16, 32, 64, 128)),
        hertz.run,
        hertz.evidence,
        needs.sphere,
    ),
    "square_punch": Entry(
        EXACT,
        "Every load curve ends at the stiffness of the flat punch.",
        "Flat punches: the stiffness at which every load curve ends, and the length of the 1D model",
        square_punch.SquarePunch(),
        square_punch.SquarePunch(cells=(16, 32, 64, 128, 256)),
        square_punch.run,
        square_punch.evidence,
        needs.square_punch,
    ),
    "westergaard": Entry(
        EXACT,
        "The periodic half-space gives Westergaard's contact.",
        "Periodic wave: the periodic half-space against Westergaard",
        westergaard.Westergaard(),
        westergaard.Westergaard(cells=(64, 128, 256, 512, 1024)),
        westergaard.run,
        westergaard.evidence,
        needs.always("closed form"),
    ),
    "geike": Entry(
        EXACT,
        "Geike's rule keeps height and slope; it is no cut along a line.",
        "Geike's rule (10.12): what it keeps, and why it is not the spectrum of a line",
        geike.Geike(),
        geike.Geike(cells=1024, surfaces=12),
        geike.run,
        geike.evidence,
        needs.always("closed form: spectra alone"),
    ),
    "fractal_punch": Entry(
        PRESSED,
        "One dimension has the mean stiffness of rough punches, and its fluctuation (Fig. 14.1).",
        "Fig. 14.1: mean and fluctuation of the contact stiffness of rough punches",
        fractal_punch.FractalPunch(),
        fractal_punch.FractalPunch(cells=256, surfaces=60, profiles=500, per_decade=6, refined=6, refined_per_decade=2),
        fractal_punch.run,
        fractal_punch_evidence.evidence,
        needs.punches,
    ),
    "normalisation": Entry(
        PRESSED,
        "The fluctuation depends on how heights are normalised.",
        "Fixed or Gaussian amplitudes, height of each draw or of the ensemble: what the fluctuations owe to it",
        normalisation.Normalisation(),
        normalisation.Normalisation(cells=128, surfaces=120, profiles=1000, points=2048, per_decade=3),
        normalisation.run,
        normalisation.evidence,
        needs.punches,
    ),
    "mdr_limits": Entry(
        PRESSED,
        "One dimension has neither the true area nor the gap, nor the stiffness of roughness with a roll-off.",
        "Where MDR must fail: true contact area, mean gap, stiffness with a roll-off",
        mdr_limits.MdrLimits(),
        mdr_limits.MdrLimits(
            roll_offs=(1, 8, 16), cells=256, surfaces=30, refined=8, profiles=500, decades=(-3, 1), per_decade=3
        ),
        mdr_limits.run,
        mdr_limits.evidence,
        needs.rolled_off,
    ),
    "ridges": Entry(
        ROLLING,
        "Over ridges across the track one dimension is exact in three, (14.11).",
        "Ridges across the track: rolling force where one dimension is exact in three, (14.11)",
        ridges.Ridges(),
        ridges.Ridges(cells=(8, 16, 32), springs=(8.5, 16.5, 32.5, 64.5)),
        ridges.run,
        ridges.evidence,
        needs.always("linear filter, 1D"),
    ),
    "rolling": Entry(
        ROLLING,
        "One dimension has the force spectrum of a rolling wheel (Fig. 14.3).",
        "Fig. 14.3: rolling force over isotropic roughness, springs beside boundary elements, where each model holds",
        rolling.ForceSpectrum(),
        rolling.ForceSpectrum(
            heights=(0.003, 0.01, 0.03, 0.1, 0.3, 1.0),
            last=20.0,
            lowest=0.22,
            length=256.0,
            width=32.0,
            cells=16,
            strips=6,
            rough_strips=8,
            refined=3,
            tracks=400,
        ),
        rolling.run,
        rolling_evidence.evidence,
        needs.rolling,
    ),
    "rolling_input": Entry(
        ROLLING,
        "One dimension has it within 3 dB in one-third octaves, if it is fed for it.",
        "What MDR should be fed for rolling, and one-third octaves within 3 dB (Ford and Thompson 2006)",
        rolling_input.RollingInput(),
        rolling_input.RollingInput(
            last=20.0,
            lowest=0.22,
            length=256.0,
            width=32.0,
            cells=16,
            strips=4,
            tracks=250,
            punch_cells=128,
            surfaces=60,
            profiles=500,
        ),
        rolling_input.run,
        rolling_input.evidence,
        needs.always("linear filter, 3D"),
    ),
    "wheel": Entry(
        WHEEL,
        "The acceleration of a wheel has four regions, each of known level and slope (Fig. 14.4).",
        "Fig. 14.4: the acceleration of a rolling wheel on springs, its regions, and what moves them",
        wheel.WheelSpectrum(),
        wheel.WheelSpectrum(realisations=300, varied=100, cells=24, stills=64),
        wheel.run,
        wheel_evidence.evidence,
        needs.wheel,
    ),
    "wheel_distance": Entry(
        WHEEL,
        "The break that moves with the distance is leakage (Fig. 14.5).",
        "Fig. 14.5: the break that moves with the distance, its cause, and what is real in the plateau",
        wheel_distance.WheelDistance(),
        wheel_distance.WheelDistance(
            scene=wheel_distance.TABLE,
            doublings=6,
            wheels=300,
            fewest=40,
            causes=60,
            rough=20,
            heights=(0.125, 0.25, 0.5, 1.0, 2.0, 4.0),
            phases=(0.0, 0.25, 0.5),
            releases=(0.0, 0.1, 0.2, 0.4),
            released=5,
        ),
        wheel_distance.run,
        wheel_distance_evidence.evidence,
        needs.wheel,
    ),
    "wheel_3d": Entry(
        WHEEL,
        "Boundary elements in the time loop confirm Fig. 14.4.",
        "Boundary elements inside the time loop: the wheel in three dimensions, beside everything cheaper",
        wheel_3d.Wheel3D(),
        wheel_3d.Wheel3D(
            scene=wheel_3d.TABLE,
            strips=16,
            turns=4,
            width=4,
            cells=40,
            shared=10,
            coarse=30,
            coarser=3,
            tolerance=1e-4,
            short=1,
            wheels=200,
        ),
        wheel_3d.run,
        wheel_3d_evidence.evidence,
        needs.wheel,
    ),
    "wheel_stability": Entry(
        LIMITS,
        "Time steps fail where theory says, and are refused before.",
        "Where time stepping and springs fail: steps up to and past the limit, long runs, spacing, lift-off",
        wheel_stability.WheelStability(),
        wheel_stability.WheelStability(
            turns=20,
            hertz_turns=6,
            long_steps=1_000_000,
            rounds=20,
            heights=(0.03, 0.1, 0.2, 0.3, 0.45, 0.6, 1.0, 3.0),
            loads=(0.01, 0.02, 0.05, 0.1, 0.2),
            lift_rounds=2,
            spacing_heights=(1e-3, 0.064, 1.0),
            spacing_tracks=4,
        ),
        wheel_stability.run,
        wheel_stability_evidence.evidence,
        needs.always("closed form"),
    ),
    "limits": Entry(
        LIMITS,
        "Each limit of each method is predicted, and the software tells who crosses it.",
        "Where each method fails: every limit swept through, the border predicted, and what the software says",
        limits.Limits(),
        limits.Limits(
            cells=128,
            surfaces=12,
            profiles=400,
            length=64.0,
            strip_cells=12,
            track=1024.0,
            resolved=6,
            grids=(32, 64, 128, 256, 512),
            judged=128,
            wheels=8,
        ),
        limits.run,
        limits_evidence.evidence,
        needs.always("none: all of them at their limits"),
    ),
    "ladder": Entry(
        LADDER,
        "The cheapest model that a scene needs can be chosen beforehand, with an honest error.",
        "Random scenes up the ladder of models: claimed beside true error, and what was saved",
        ladder.Ladder(),
        ladder.Ladder(punches=110, spheres=24, rolling=8, wheels=4, tolerances=(0.1, 0.3)),
        ladder.run,
        ladder.evidence,
        needs.always("chosen scene by scene"),
    ),
}


def timed_here() -> list[str]:
    """What is timed and can be here: other solvers only where some are installed."""
    return [name for name in TIMED if name != "race" or peers_installed()]
