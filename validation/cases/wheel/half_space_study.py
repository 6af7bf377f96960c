"""The wheel in three dimensions: linear theory and springs beside boundary elements in the time loop."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from validation.analysis import spectra as spectral_features
from validation.analysis.chart import by_model
from validation.analysis.claim_text import THREE_D_DIFFER
from validation.analysis.evidence import Table, Whose
from validation.analysis.series import MARGINS, Estimates
from validation.analysis.statistics import POWER_DECIBEL, FloatArray, jackknifed
from validation.case import Case, Chapter, Chart, Claim, Curve, Outcomes, Panel, Quantity, Series, Study
from validation.cases.wheel import ensembles
from validation.cases.wheel import half_space as wheel
from validation.cases.wheel.ensembles import LEVEL, OMEGA, QUANTITIES, SLOPE, decibels
from validation.scenes.description import slope_ratio
from validation.scenes.rolling import RollingScene
from validation.simulation import model_needed

LEVELS = Quantity("one-third_octave_level_dB_over_m_s²_²", "one-third octave level [dB over (m/s²)²]")
OVER = Quantity("level_over_boundary_elements")
MARKS = Quantity("marks_rad_s", "marks [rad/s]")
CONTRAST, ZERO = Quantity("contrast_of_the_oscillation"), "zero of sin²(q a)"
WHEEL, APPLICATIONS = "wheel", "applications a time step"
OF_FIGURE = 5
"""Numbers of the claim of Fig. 14.4, whose intervals hold at once: levels of three ranges, slope, contrast."""


def series(result: Outcomes) -> list[Series]:
    """Levels over boundary elements, the worst in the plateau and parts of region 3; slope, contrast."""
    levels = wheel.WheelLevels(result)
    return [*_of_bands(levels), *_slopes(levels), *_contrasts(levels)]


def _of_bands(levels: wheel.WheelLevels) -> Iterator[Series]:
    """Each one-third octave, and those of each range."""
    bands = partial(decibels, along=OMEGA, at=levels.centres, grid=levels.left)
    bem = Estimates(replace(ratio, value=value) for ratio, value in zip(levels.ratio, levels.bem.tolist(), strict=True))
    yield bands(LEVELS, wheel.BEM, bem)
    yield bands(OVER, wheel.BEM, Estimates(replace(ratio, value=0.0) for ratio in levels.ratio))
    margin = MARGINS["level"].with_source("boundary elements in the time loop")
    for model in wheel.MODELS:
        over = levels.over_bem(model)
        yield decibels(LEVELS, model, over.values + levels.bem, along=OMEGA, at=levels.centres)
        yield bands(OVER, model, over)
        for name, inside in levels.ranges.items():
            indices = np.flatnonzero(inside)
            yield decibels(
                LEVEL,
                wheel.OVER_BEM[model],
                [over[i] for i in indices],
                where={"range": name},
                along=OMEGA,
                at=levels.centres[inside],
                grid=[levels.left[i] for i in indices],
                margin=margin,
                fewest=max(indices.size, 1),
                family=OF_FIGURE if model == wheel.GEIKE else len(levels.ranges),
            )
    yield Series(MARKS, "q_min v₀", (levels.result.case.scene.jump,))


def _slopes(levels: wheel.WheelLevels) -> Iterator[Series]:
    """The power law of region 3, where it has four periods of the oscillation, on the same strips for both."""
    scene = levels.result.case.scene
    first, last, period = 1.1 * scene.jump, 0.7 * scene.cutoff, scene.oscillation_period
    if last - first < 4 * period:
        return
    for model, contact in wheel.CONTACTS.items():
        omega, density = levels.spectra(contact)

        def of(rows: FloatArray, omega: FloatArray = omega) -> FloatArray:
            return np.array(spectral_features.slope(omega, rows.mean(axis=0), first, last, period))

        coarse, fine = (float(of(rows, lines)) for lines, rows in levels.on_grids(contact))
        yield Series(
            QUANTITIES[SLOPE],
            model,
            jackknifed(of, density),
            where={"region": "region 3"},
            reference=-2 * ensembles.hurst(scene) - 3,
            grid=2 * abs(fine - coarse),
            family=OF_FIGURE,
            margin=MARGINS[SLOPE].with_source("-2 H - 3, (14.13); the same in linear theory in 3D"),
        )


# --- the contrast of the oscillation: how far its zeros are filled, one after the other ---


def _spectra(levels: wheel.WheelLevels) -> dict[str, tuple[FloatArray, FloatArray]]:
    """omega and A, (strips or groups, frequencies), of boundary elements, the linear contact and springs."""
    return {
        **{model: levels.spectra(contact) for model, contact in wheel.CONTACTS.items()},
        **{model: levels.on_springs(model) for model in wheel.INPUT_SPECTRA},
    }


def zeros_of(scene: RollingScene) -> FloatArray:
    """The numbers n of the zeros q a = n pi that have both of their maxima in region 3."""
    first, last = scene.jump / scene.oscillation_period, scene.cutoff / scene.oscillation_period
    return np.arange(np.ceil(first + 0.5 + ensembles.HALF_BAND), np.floor(last - 0.5 - ensembles.HALF_BAND) + 1)


def log_contrasts(omega: FloatArray, density: FloatArray, scene: RollingScene) -> FloatArray:
    """ln of the mean of A omega^(2 H + 3) about the two maxima beside each zero, over that about the zero."""
    flat = density * omega ** (2 * ensembles.hurst(scene) + 3)
    return ensembles.log_beside_over_at(omega / scene.oscillation_period, flat, zeros_of(scene))


def _contrasts(levels: wheel.WheelLevels) -> Iterator[Series]:
    """Of boundary elements beside (14.12) in the same bands; of the linear contact on their strips, and of springs."""
    scene = levels.result.case.scene
    for model, (omega, density) in _spectra(levels).items():

        def of(rows: FloatArray, omega: FloatArray = omega) -> FloatArray:
            return log_contrasts(omega, rows.mean(axis=0), scene)

        by_zero = partial(decibels, CONTRAST, along=ZERO, at=zeros_of(scene))
        linear = log_contrasts(omega, ensembles.linear_spectrum(scene, omega), scene)
        margin = MARGINS["contrast"].with_source("linear theory in one dimension in the same bands")
        compared = {"reference": Estimates.exact(linear), "family": OF_FIGURE, "margin": margin}
        yield by_zero(model, jackknifed(of, density), **compared if model == wheel.BEM else {})
        if model == wheel.BEM:
            yield by_zero(wheel.LINEAR_1D, linear)


def of_wheel(case: wheel.Wheel3D, applications: float) -> dict[str, float]:
    """Its roughness over the approach, the slope of that along the track, of all waves, and what a time step takes."""
    scene = case.scene
    return {
        "h/d": scene.rms / scene.approach,
        "h' a/d": slope_ratio(scene.slope_along, scene),
        "cells to a contact radius": case.cells,
        APPLICATIONS: applications,
    }


def tables(result: Outcomes) -> list[Table]:
    levels = wheel.WheelLevels(result)
    applications = float(np.mean([strip["applications"] for strip in levels.converged]))
    values = of_wheel(result.case, applications)
    return [Table(WHEEL, {name: [value] for name, value in values.items()})]


def notes(result: Outcomes) -> Sequence[str]:
    """What lies below q_min v0 in three dimensions, and what the grid leaves."""
    levels = wheel.WheelLevels(result)
    plateau, changes = levels.ranges["region 2"], POWER_DECIBEL * np.abs(levels.change.values)
    below = -POWER_DECIBEL * levels.over_bem(wheel.GEIKE).values[plateau]
    change = f"From {result.case.cells} to {2 * result.case.cells} cells to a radius a level changes by "
    return (
        *(
            f"In three dimensions region 2 is no second order: boundary elements have {low:.0f} to {high:.0f} dB more "
            "than springs there. Waves aslant to the track are longer along it than 2π / q_min, and linear theory in "
            "three dimensions has them."
            for low, high in ([(below.min(), below.max())] if plateau.any() else [])
        ),
        _on_rolling_spectrum(levels),
        f"{change}{np.median(changes):.2g} dB in the median band and {changes.max():.2g} dB at most; levels are those "
        "of no size, to first order.",
    )


def _on_rolling_spectrum(levels: wheel.WheelLevels) -> str:
    """What linear theory leaves of springs on the rolling-equivalent spectrum."""
    over, whole = POWER_DECIBEL * np.abs(levels.rolling_over_exact), levels.without_zero
    plateau = levels.ranges["region 2"]
    region_3 = np.any([inside for name, inside in levels.ranges.items() if name != "region 2"], axis=0)
    parts = {"region 2": plateau, "region 3, in bands without a zero of sin(q a)": region_3 & whole}
    worst = [f"within {over[inside].max():.2g} dB in {name}" for name, inside in parts.items() if inside.any()]
    at_zeros = over[region_3 & ~whole]
    last = [f"up to {at_zeros.max():.2g} dB off in bands with one"] if at_zeros.size else []
    return (
        "By linear theory springs on the rolling-equivalent spectrum are "
        f"{', '.join([*worst, *last])}: one dimension has zeros that three dimensions fill."
    )


MODEL_STYLES = {wheel.LINEAR_3D: "lines", wheel.GEIKE: "marks", wheel.ROLLING: "marks"}
MARKED = Curve(MARKS, style="guide", upright=True)
BANDS = Panel(OMEGA, LEVELS, decades=75.0).of(
    *by_model(LEVELS, {**MODEL_STYLES, wheel.BEM: "marks"}, bars=True), MARKED
)
DIFFERENCES = Panel(OMEGA, "over boundary elements [dB]", ylim=(-12.0, 12.0), lines=(-3.0, -1.0, 1.0, 3.0)).of(
    Curve(OVER, wheel.BEM, "guide", "_", band=True), *by_model(OVER, MODEL_STYLES), MARKED
)
ZEROS = Panel(ZERO, "maxima over zeros [dB]", log="", lines=(0.0,)).of(
    *by_model(CONTRAST, {wheel.LINEAR_1D: "lines", wheel.GEIKE: "marks", wheel.BEM: "marks"}, bars=True),
    Curve(CONTRAST, wheel.LINEAR_3D, "marks", bars=True),
)
STUDY = Study(
    title="The wheel in three dimensions: boundary elements inside the time loop",
    method=(
        "{c.strips} wheels of {c.scene.name} over isotropic surfaces, waves of {c.scene.rail.longest:g} to "
        "{c.scene.rail.shortest:g} m, H = {c.scene.rail.hurst:g}; contact by boundary elements in each of "
        "{c.strip.shape[0]} time steps, {c.cells} cells to a contact radius, residual {c.tolerance:g}; surfaces "
        "periodic, {c.strip.shape[1]} cells wide, half a natural period longer than {c.periods}. The linear contact of "
        "fixed radius rolls on the same surfaces; boundary elements begin in its steady state. "
        "{c.wheels} wheels on springs move in their steady state, on tracks of Geike's spectrum of these surfaces, and "
        "as many on their rolling-equivalent spectrum, which has waves below q_min as a line of the surface has. All "
        "use Hann's window. Levels of boundary elements are over the linear contact on the same surfaces, times linear "
        "theory; grid: {c.finer} of the strips on half as long cells, to first order; solver: from a residual "
        f"{wheel.TIGHTER} times smaller. Nothing damps the wheel, and in 3D roughness excites its resonance, so that "
        "bands begin at twice the eigenfrequency. Isotropic ground has waves of any length along the track, so that "
        "region 2 is linear here."
    ),
    series=series,
    claims=(
        Claim(
            whose=Whose.BOOK,
            no=THREE_D_DIFFER,
            either=(
                {"quantity": LEVEL, "model": wheel.OVER_BEM[wheel.GEIKE]},
                {"quantity": QUANTITIES[SLOPE], "model": wheel.BEM},
                {"quantity": CONTRAST},
            ),
        ).saying(
            "The one-dimensional model describes the dynamics of the wheel: boundary elements in the time loop have "
            "the regions of Fig. 14.4.",
            short="Springs of Fig. 14.4 agree with boundary elements in the time loop",
            key="regions",
        ),
        Claim(quantity=LEVEL, model=wheel.OVER_BEM[wheel.ROLLING], along="range").saying(
            "Springs on the rolling-equivalent spectrum have the acceleration of boundary elements in the time loop.",
            short="Springs on the rolling-equivalent spectrum agree with boundary elements in the time loop",
            key="rolling-equivalent",
        ),
        Claim(quantity=LEVEL, model=wheel.OVER_BEM[wheel.LINEAR_3D], along="range").saying(
            "Linear theory in three dimensions gives the acceleration of the wheel.",
            short="Linear theory in 3D agrees with boundary elements in the time loop",
            key="linear-theory",
        ),
    ),
    charts=(
        Chart("wheel_3d", claims=(0, 1)).of(
            "(a) Acceleration of the wheel in one-third octaves, 95 % of sample, grid and solver. (b) The same over "
            "boundary elements, their interval shaded; lines: ± 1 and ± 3 dB. Region 2 ends at q_min v₀. (c) The "
            "maxima of region 3 over each zero of sin²(q a), 95 %.",
            BANDS,
            DIFFERENCES,
            ZEROS,
        ),
    ),
    tables=tables,
    printed=(WHEEL,),
    notes=notes,
)
CASE = Case(
    name="wheel_3d",
    chapter=Chapter.WHEEL,
    place=3,
    answers="Boundary elements inside the time loop: the wheel in three dimensions, against every cheaper model",
    quick=wheel.Wheel3D(strips=3, wheels=30),
    full=wheel.Wheel3D(
        scene=ensembles.TABLE,
        strips=24,
        periods=2,
        width=4,
        cells=40,
        shared=10,
        finer=8,
        tolerance=0.0001,
        short=1,
        wheels=200,
    ),
    run=wheel.run,
    study=STUDY,
    needs=model_needed.wheel,
)
