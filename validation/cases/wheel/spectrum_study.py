"""Fig. 14.4: what is claimed of the regions of the spectrum, and of one parameter changed at a time."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel, by_model
from validation.analysis.claims import Claim, Matrix
from validation.analysis.evidence import Table
from validation.analysis.study import Outcomes, Study
from validation.cases.wheel import features, spectrum
from validation.cases.wheel.features import CONTRAST, DENSITY, LEVEL, OMEGA, PEAK_LAST, PERIOD, QUANTITIES, TABLE, ZERO
from validation.scenes.description import describe
from validation.scenes.dynamic_wheel import WheelScene
from validation.selection import model_needed
from validation.simulation.wheel_on_springs import WAVES_APART

SPRING_COLUMNS = ("x / a", "wheel / d", "track / d", "compression / d")
JUDGED = tuple(QUANTITIES[key] for key in spectrum.SOURCES)
PARAMETERS = Matrix(
    name="one parameter at a time: found ± 95 % beside theory", quantity=JUDGED, rows=("scene",), columns="quantity"
)


def tables(result: Outcomes) -> list[Table]:
    """The scene, each feature of each variation with its verdict, and the contact at one moment."""
    snapshot, pairs = result[spectrum.SNAPSHOT], describe(result.case.scene)
    x, y = np.meshgrid(snapshot["x"], snapshot["y"], indexing="ij")
    pressure = zip(("x / a", "y / a", "p / p0"), (x, y, snapshot["pressure"]), strict=True)
    return [
        Table("the scene", dict(zip(("quantity", "value"), map(list, zip(*pairs, strict=True)), strict=True))),
        PARAMETERS.table(
            [n for scene in spectrum.features_by_scene(result) for one in scene.values() for n in one.numbers]
        ),
        Table("springs", dict(zip(SPRING_COLUMNS, snapshot["springs"].tolist(), strict=True))),
        Table("pressure", {name: values.ravel().tolist() for name, values in pressure}),
    ]


def notes(result: Outcomes) -> Sequence[str]:
    """What is special in the scene, and how far the wheels moved."""
    scene, batches = result.case.scene, result[result.case.scene.name]
    lowest, highest = min(float(b["lowest"].min()) for b in batches), max(float(b["highest"].max()) for b in batches)
    airborne = 100 * float(np.mean(np.concatenate([b["airborne"] for b in batches])))
    book = "Table 14.1 prints E, ν, R, M and h₀; all else is our choice." if is_of_the_book(scene) else ""
    hidden = (
        f"q_min v₀ = {scene.jump:.4g} rad/s is not above ω_eigen = {scene.eigenfrequency:.4g} rad/s by a factor of "
        f"{PEAK_LAST:g}: the roughness excites the resonance itself, and there is no plateau and no jump to find."
    )
    flight = (
        f"Approaches of all wheels lay between {lowest:.3g} and {highest:.3g} d; wheels had no contact for "
        f"{airborne:.2g} % of the time."
    )
    hides = scene.jump <= PEAK_LAST * scene.eigenfrequency
    return [*filter(None, (book, hidden if hides else "", flight, scene.no_steady_answer(), *scene.diagnose()))]


def is_of_the_book(scene: WheelScene) -> bool:
    """Whether it has what Table 14.1 prints: a changed copy of its file has the same name."""
    return all(getattr(scene, key) == getattr(TABLE, key) for key in ("name", "radius", "mass", "material", "rms"))


WHOLE = Panel(OMEGA, DENSITY, log="xy", decades=13.0, legend="upper right").of(
    *by_model(
        spectrum.SPECTRUM,
        {
            spectrum.LINEAR: "thick",
            spectrum.LOWEST: "dotted",
            spectrum.HIGHEST: "dotted",
            spectrum.NO_WINDOW: "mdr line",
            spectrum.HANN: "exact",
            spectrum.PREDICTED_FLOOR: "bem line",
        },
    ),
    Curve(spectrum.MARKS, style="guide", upright=True),
)
STYLES = {spectrum.LINEAR: "thick", spectrum.NO_WINDOW: "mdr line", spectrum.HANN: "exact"}
THIRD = Panel(OMEGA, spectrum.OSCILLATION, log="y", ylim=(0.01, 30.0), legend="upper left").of(
    *by_model(spectrum.OSCILLATION, STYLES)
)
ZEROS = Panel(ZERO, "maxima over zeros [dB]", log="", lines=(0.0,), legend="center right").of(
    *by_model(CONTRAST, {spectrum.LINEAR: "thick", "springs": "mdr"}, bars=True)
)
BASE, ONE_CHANGED = Curve(spectrum.SPECTRUM, spectrum.NO_WINDOW, "thick", "_"), Curve(spectrum.VARIED, by=("scene",))
VARIED = Panel(OMEGA, DENSITY, facet=spectrum.PARAMETER, log="xy", legend="lower left").of(BASE, ONE_CHANGED)


in_the_worst_scene = partial(Claim, where={"scenes": str})
STUDY = Study(
    title="Fig. 14.4: the acceleration of a rolling wheel, on springs",
    method=(
        "{c.realisations} wheels of {c.scene.name}, {c.varied} with one parameter changed, M z'' = F - F_N by velocity "
        "Verlet in steps of dx / v₀, {c.scene.springs} springs to a contact radius, {c.scene.points} steps from static "
        f"equilibrium; the end of a track is {WAVES_APART} longest waves from its beginning. "
        "Nothing damps the wheel. Its initial free vibration stays and sets the level of region 1; the contact sets "
        "the frequency of that region. A is two-sided over the frequency f, <a²> = int A df. It has no window, as in "
        "the book, or Hann's where leakage would hide a feature. The peak is interpolated between lines of Hann's "
        "spectrum. The jump is where that spectrum reaches half of the level above it. Slope and break come from "
        "means over periods of the oscillation; the floor is measured beyond q_max v₀. The period is sought from "
        f"{features.THIRD_FIRST:g} q_min v₀ to {features.OSCILLATION_LAST:g} q_max v₀. Errors: jackknife over groups "
        "of wheels."
    ),
    series=spectrum.series,
    claims=(
        Claim(
            either=(
                {"quantity": tuple(QUANTITIES[k] for k in spectrum.SOURCES if k != PERIOD), "where": {"scene": str}},
                {"quantity": LEVEL},
            )
        ).saying(
            "On springs the peak and the regions of Fig. 14.4 lie where theory has them; region 3 has its level "
            "and slope.",
            short="Peak, regions, level and slope of Fig. 14.4",
        ),
        Claim(quantity=QUANTITIES[PERIOD], along="scene").saying(
            "Region 3 oscillates with the constant period π v₀ / a."
        ),
        Claim(quantity=CONTRAST).saying(
            "Region 3 oscillates as sin²(q a), down to its zeros.", short="maxima of region 3 over its zeros"
        ),
        in_the_worst_scene(quantity=QUANTITIES[features.PEAK]).saying(
            "The frequency of the peak depends on none of q_min, q_max, v₀, H and h₀, only on the contact.",
            short="One parameter changed, the peak in the worst case",
        ),
        in_the_worst_scene(quantity=QUANTITIES[features.JUMP]).saying(
            "Region 3 begins at q_min v₀, whatever the speed and the cut-off.", short="the jump"
        ),
        in_the_worst_scene(quantity=QUANTITIES[features.SLOPE]).saying(
            "The slope of region 3 is -2 H - 3, whatever the parameters.", short="the slope"
        ),
        in_the_worst_scene(quantity=QUANTITIES[features.BREAK + features.PREDICTED]).saying(
            "The break lies where region 3 meets the predicted floor, whatever the parameters.", short="the break"
        ),
    ),
    charts=(
        Chart("wheel-contact", claims=()).of(
            "The wheel in the simulation. (a) As in Fig. 14.2: the profile x²/R over springs at the height of the "
            "track; dark springs are in contact, with their compression below. (b) Boundary elements in the time loop: "
            "pressure over Hertz's largest; circle: Hertz."
        ),
        Chart("wheel", claims=(0, 2), width=13.5, height=4.2).of(
            "Fig. 14.4. (a) Spectrum of the acceleration, (14.17), mean of {c.realisations} wheels, with the tenth and "
            "the ninetieth percentile. Vertical lines: ω_eigen, q_min v₀, predicted break, q_max v₀. (b) Region 3 over "
            "ω^(-2H-3). (c) Contrast of the oscillation at each zero of sin²(q a), Hann's window, 95 %.",
            WHOLE,
            THIRD,
            ZEROS,
        ),
        Chart("wheel-parameters", claims=(3, 4, 5, 6), columns=3, width=11.0, height=6.0).of(
            "One parameter at a time, mean of {c.varied} wheels each, without window; thick grey: {c.scene.name}.",
            VARIED,
        ),
    ),
    tables=tables,
    printed=("the scene", PARAMETERS.name),
    notes=notes,
)
CASE = Case(
    name="wheel",
    chapter=Chapter.WHEEL,
    place=1,
    answers=(
        "Fig. 14.4: the acceleration of a rolling wheel on springs, its regions, and how they depend on the parameters"
    ),
    quick=spectrum.WheelSpectrum(scene=replace(TABLE, distance=0.4), realisations=30, varied=10),
    full=spectrum.WheelSpectrum(realisations=300, varied=100, cells=24, snapshot_steps=64),
    run=spectrum.run,
    study=STUDY,
    needs=model_needed.wheel,
)
