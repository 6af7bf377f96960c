"""One file per piece of evidence; this is the list of them."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal

from validation import precision_evidence, precision_scenes, race, race_evidence, race_rolling, race_wheel
from validation.cases import (
    fractal_punch,
    fractal_punch_evidence,
    geike,
    hertz,
    mdr_limits,
    normalisation,
    ridges,
    rolling,
    rolling_evidence,
    rolling_input,
    square_punch,
    westergaard,
    wheel,
    wheel_3d,
    wheel_3d_evidence,
    wheel_distance,
    wheel_distance_evidence,
    wheel_evidence,
    wheel_stability,
    wheel_stability_evidence,
)
from validation.ensemble import Engine
from validation.evidence import Evidence
from validation.precision_rolling import Rolling
from validation.precision_rough import Fractal
from validation.precision_smooth import Punch, Sphere, Wave
from validation.precision_wheel import Wheels
from validation.wheel_scene import WheelScene

Profile = Literal["quick", "full"]


@dataclass(frozen=True)
class Entry:
    """A case in the list: which figure or claim it answers, its two sizes, and how to run and read it."""

    answers: str
    quick: Any
    full: Any
    run: Callable[[Any, Engine], Any]
    evidence: Callable[[Any], Evidence]

    def case(self, profile: Profile, seed: int | None, scene: WheelScene | None = None) -> Any:
        """The case of that size, with the seed where it draws anything, and the scene where it has one."""
        case = self.quick if profile == "quick" else self.full
        if seed is not None and hasattr(case, "seed"):
            case = replace(case, seed=seed)
        return replace(case, scene=scene) if scene is not None and hasattr(case, "scene") else case


PRECISION = Entry(
    "Speed against accuracy: error against cost of every method, who is the cheapest within which error",
    precision_scenes.Precision(),
    precision_scenes.Precision(
        sphere=Sphere(
            cells=(4, 8, 16, 32, 64),
            plain=(4, 8, 16, 32),
            peers=(4, 8, 16, 32),
            springs=(2.4, 4.4, 8.4, 16.4, 32.4, 64.4, 128.4, 256.4),
        ),
        punch=Punch(cells=(8, 16, 32, 64, 128, 256), plain=(8, 16, 32, 64), peers=(8, 16), fixed=64),
        wave=Wave(
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
        rolling=Rolling(length=32, strips=8, tracks=60, cells=(3, 4, 6, 8, 12, 16, 32), plain=(4, 6), fixed=12),
        wheel=Wheels(strips=8, wheels=60, cells=(6, 9, 12, 15, 30), springs=(12, 25, 50, 100), fixed=12),
        slow=1.0,
        enough=0.2,
    ),
    precision_scenes.run,
    precision_evidence.evidence,
)

RACE = Entry(
    "The race: our solver beside the peers that are installed, same problems, same residual",
    race.Race(),
    race.Race(
        cells=(256, 512, 1024),
        scaling=(128, 256, 512, 1024, 2048, 4096),
        errand=race.Errand(cells=256, sampled=(0, 6, 12, 18, 24), paths=5),
        rolling=race_rolling.Rolls(cells=(8, 16, 32), finest=64, positions=1600),
        wheel=race_wheel.Steps(
            springs=(12, 25, 50, 100, 200, 400), heights=(0.01, 0.1, 0.3, 1.0), steps=8000, bem_steps=1600
        ),
    ),
    race.run,
    race_evidence.evidence,
)

TIMED = {"precision": PRECISION, "race": RACE}
"""Run alone, last and in this order; their times differ from run to run, and stay out of the results."""

CASES = {
    "hertz": Entry(
        "Smooth sphere: both methods against Hertz",
        hertz.Hertz(),
        hertz.Hertz(cells_per_radius=(8, 16, 32, 64, 128)),
        hertz.run,
        hertz.evidence,
    ),
    "square_punch": Entry(
        "Flat punches: the stiffness at which every load curve ends, and the length of the 1D model",
        square_punch.SquarePunch(),
        square_punch.SquarePunch(cells=(16, 32, 64, 128, 256)),
        square_punch.run,
        square_punch.evidence,
    ),
    "westergaard": Entry(
        "Periodic wave: the periodic half-space against Westergaard",
        westergaard.Westergaard(),
        westergaard.Westergaard(cells=(64, 128, 256, 512, 1024)),
        westergaard.run,
        westergaard.evidence,
    ),
    "geike": Entry(
        "Geike's rule (10.12): what it keeps, and why it is not the spectrum of a line",
        geike.Geike(),
        geike.Geike(cells=1024, surfaces=12),
        geike.run,
        geike.evidence,
    ),
    "fractal_punch": Entry(
        "Fig. 14.1: mean and fluctuation of the contact stiffness of rough punches",
        fractal_punch.FractalPunch(),
        fractal_punch.FractalPunch(cells=256, surfaces=72, profiles=500, per_decade=6, refined=8, refined_per_decade=2),
        fractal_punch.run,
        fractal_punch_evidence.evidence,
    ),
    "normalisation": Entry(
        "Fixed or Gaussian amplitudes, height of each draw or of the ensemble: what the fluctuations owe to it",
        normalisation.Normalisation(),
        normalisation.Normalisation(cells=128, surfaces=120, profiles=1000, points=2048, per_decade=3),
        normalisation.run,
        normalisation.evidence,
    ),
    "mdr_limits": Entry(
        "Where MDR must fail: true contact area, mean gap, stiffness with a roll-off",
        mdr_limits.MdrLimits(),
        mdr_limits.MdrLimits(
            roll_offs=(1, 8, 16), cells=256, surfaces=40, refined=8, profiles=500, decades=(-3, 1), per_decade=3
        ),
        mdr_limits.run,
        mdr_limits.evidence,
    ),
    "ridges": Entry(
        "Ridges across the track: rolling force where one dimension is exact in three, (14.11)",
        ridges.Ridges(),
        ridges.Ridges(cells=(8, 16, 32), springs=(8.5, 16.5, 32.5, 64.5)),
        ridges.run,
        ridges.evidence,
    ),
    "rolling": Entry(
        "Fig. 14.3: rolling force over isotropic roughness, springs beside boundary elements, where each model holds",
        rolling.Rolling(),
        rolling.Rolling(
            heights=(0.003, 0.01, 0.03, 0.1, 0.3, 1.0),
            last=20.0,
            lowest=0.22,
            length=256.0,
            width=32.0,
            cells=16,
            strips=8,
            rough_strips=12,
            refined=3,
            tracks=400,
        ),
        rolling.run,
        rolling_evidence.evidence,
    ),
    "rolling_input": Entry(
        "What MDR should be fed for rolling, and one-third octaves within 3 dB (Ford and Thompson 2006)",
        rolling_input.RollingInput(),
        rolling_input.RollingInput(
            last=20.0,
            lowest=0.22,
            length=256.0,
            width=32.0,
            cells=16,
            strips=6,
            tracks=400,
            punch_cells=128,
            surfaces=60,
            profiles=500,
        ),
        rolling_input.run,
        rolling_input.evidence,
    ),
    "wheel": Entry(
        "Fig. 14.4: the acceleration of a rolling wheel on springs, its regions, and what moves them",
        wheel.Wheel(),
        wheel.Wheel(realisations=300, varied=100, cells=24, stills=64),
        wheel.run,
        wheel_evidence.evidence,
    ),
    "wheel_distance": Entry(
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
    ),
    "wheel_3d": Entry(
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
    ),
    "wheel_stability": Entry(
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
    ),
}
