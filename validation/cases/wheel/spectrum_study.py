"""Fig. 14.4: what is claimed of the regions of the spectrum, and of one parameter changed at a time."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from validation.analysis.chart import by_model
from validation.analysis.claim_text import NOT_THIS_CURVE
from validation.analysis.claims import Matrix
from validation.analysis.evidence import Table, Whose
from validation.case import Case, Chapter, Chart, Claim, Curve, Outcomes, Panel, Study
from validation.cases.wheel import ensembles, spectrum
from validation.cases.wheel.ensembles import DENSITY, OMEGA, QUANTITIES, TABLE
from validation.scenes.description import describe
from validation.scenes.rolling import RollingScene
from validation.simulation import model_needed, wheel_features
from validation.simulation.wheel_on_springs import WAVES_APART

PARAMETERS = Matrix(
    name="one parameter at a time: found ± 95 % beside theory",
    quantity=tuple(QUANTITIES.values()),
    rows=(spectrum.CHANGED,),
    columns="quantity",
)


def tables(result: Outcomes) -> list[Table]:
    pairs = zip(*describe(result.case.scene), strict=True)
    return [Table("the scene", dict(zip(("quantity", "value"), map(list, pairs), strict=True)))]


def notes(result: Outcomes) -> Sequence[str]:
    """What is special in the scene, and how far the wheels moved."""
    scene, batches = result.case.scene, result[result.case.scene.name]
    lowest, highest = min(float(b["lowest"].min()) for b in batches), max(float(b["highest"].max()) for b in batches)
    airborne = 100 * float(np.mean(np.concatenate([b["airborne"] for b in batches])))
    book = "Table 14.1 prints E, ν, R, M and h₀; all else is our choice." if is_of_the_book(scene) else ""
    hidden = (
        f"q_min v₀ = {scene.jump:.4g} rad/s is not above ω_eigen = {scene.eigenfrequency:.4g} rad/s by a factor of "
        f"{wheel_features.PEAK_LAST:g}: the roughness excites the resonance itself, and there is no plateau and no "
        "jump to find."
    )
    flight = (
        f"Approaches of all wheels lay between {lowest:.3g} and {highest:.3g} d; wheels had no contact for "
        f"{airborne:.2g} % of the time."
    )
    hides = scene.jump <= wheel_features.PEAK_LAST * scene.eigenfrequency
    return [*filter(None, (book, hidden if hides else "", flight, scene.no_steady_answer(), *scene.diagnose()))]


def is_of_the_book(scene: RollingScene) -> bool:
    """Whether it has what Table 14.1 prints: a changed copy of its file has the same name."""
    return all(getattr(scene, key) == getattr(TABLE, key) for key in ("name", "radius", "mass", "material", "rms"))


WHOLE = Panel(OMEGA, DENSITY, log="xy", decades=13.0).of(
    *by_model(
        spectrum.SPECTRUM,
        {
            spectrum.LINEAR: "lines",
            spectrum.LOWEST: "guide",
            spectrum.HIGHEST: "guide",
            spectrum.NO_WINDOW: "lines",
            spectrum.HANN: "lines",
            spectrum.PREDICTED_FLOOR: "dashed",
        },
    ),
    Curve(spectrum.MARKS, style="guide", upright=True),
)
STYLES = {spectrum.LINEAR: "lines", spectrum.NO_WINDOW: "lines", spectrum.HANN: "lines"}
THIRD = Panel(OMEGA, spectrum.OSCILLATION, log="y", ylim=(0.01, 30.0)).of(*by_model(spectrum.OSCILLATION, STYLES))
BASE, ONE_CHANGED = Curve(spectrum.SPECTRUM, spectrum.NO_WINDOW, "lines", "_"), Curve(spectrum.VARIED, by=("scene",))
VARIED = Panel(OMEGA, DENSITY, facet=spectrum.PARAMETER, log="xy").of(BASE, ONE_CHANGED)


def named_by_the_book(changed: object) -> bool:
    """The book names q_min, q_max, v0 and H; the height is ours."""
    return not str(changed).startswith("h₀")


STUDY = Study(
    title="Fig. 14.4: the acceleration of a rolling wheel, on springs",
    method=(
        "{c.realisations} wheels of {c.scene.name}, {c.varied} with one parameter changed, M z'' = F - F_N by velocity "
        "Verlet in steps of dx / v₀, {c.scene.springs} springs to a contact radius, {c.scene.points} steps from static "
        f"equilibrium; the end of a track is {WAVES_APART} longest waves from its beginning. "
        "As in the book nothing damps the wheel unless its scene says so: its initial free vibration stays and sets "
        "the level of region 1. The contact sets the frequency of that region. A is two-sided over the frequency f, "
        "<a²> = int A df. It has no window, as in the book, or Hann's where leakage would hide a feature. The peak is "
        "interpolated between lines of Hann's spectrum. The jump is where that spectrum reaches half of the level "
        "above it. The slope comes from means over periods of the oscillation. The period is sought from "
        f"{wheel_features.THIRD_FIRST:g} q_min v₀ to {wheel_features.OSCILLATION_LAST:g} q_max v₀. The book varies "
        "q_min, q_max, v₀ and H; the height h₀ is varied by us, and no claim takes it in. Errors: jackknife over "
        "groups of wheels."
    ),
    series=spectrum.series,
    claims=(
        Claim(
            whose=Whose.BOOK,
            no=NOT_THIS_CURVE,
            quantity=tuple(QUANTITIES[key] for key in spectrum.OF_PARAMETERS),
            where={spectrum.CHANGED: named_by_the_book},
        ).saying(
            "The peak of Fig. 14.4 lies at ω_eigen and its jump at q_min v₀, whatever q_min, q_max, v₀ and H.",
            short="Peak and jump of Fig. 14.4 agree with ω_eigen and q_min v₀",
            key="peak-and-jump",
        ),
        Claim(
            whose=Whose.BOOK,
            no=NOT_THIS_CURVE,
            quantity=tuple(QUANTITIES[key] for key in (ensembles.SLOPE, ensembles.PERIOD)),
            where={spectrum.CHANGED: spectrum.NOTHING},
        ).saying(
            "Region 3 of Fig. 14.4 follows ω^(-2H-3) sin²(ω a / v₀).",
            short="Region 3 agrees with ω^(-2H-3) sin²(ω a / v₀)",
            key="region-3",
        ),
    ),
    charts=(
        Chart("wheel", claims=(0, 1)).of(
            "Fig. 14.4. (a) Spectrum of the acceleration, (14.17), mean of {c.realisations} wheels, with the tenth and "
            "the ninetieth percentile. Vertical lines: ω_eigen, q_min v₀, predicted break, q_max v₀. (b) Region 3 over "
            "ω^(-2H-3).",
            WHOLE,
            THIRD,
        ),
        Chart("wheel-parameters").of(
            "One parameter at a time, mean of {c.varied} wheels each, without window; thick: {c.scene.name}.",
            VARIED,
        ),
    ),
    matrices=(PARAMETERS,),
    tables=tables,
    printed=("the scene",),
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
    full=spectrum.WheelSpectrum(realisations=300, varied=100),
    run=spectrum.run,
    study=STUDY,
    needs=model_needed.wheel,
)
