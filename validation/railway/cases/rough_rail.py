"""How rough a rail may be before its contact filter depends on the roughness, and which lines of it to average."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from validation.analysis.chart import by_model
from validation.analysis.claims import Matrix
from validation.analysis.evidence import Role, Table
from validation.analysis.number_text import decibels
from validation.analysis.series import FIELD, Estimates, Margin, masked, only
from validation.case import SERIAL, Case, Chapter, Chart, Claim, Curve, Engine, Panel, Quantity, Series, Study
from validation.engine.realisations import NotConvergedError
from validation.railway.cases import filters
from validation.railway.cases import rolled_filters as rolled
from validation.railway.cases.filters import COUNTED, OFFSET, counted, millimetres
from validation.railway.problems.equivalent_displacement import Corrugation, roll_corrugation
from validation.railway.problems.rail_strip import (
    SHORTEST,
    line_of,
    lines_across,
    lost_contact_number,
    mean_of_lines,
    strip_bands,
    structure_of,
)
from validation.railway.theory.contact_filters import corrugation_harmonic, corrugation_harmonic_of_springs
from validation.simulation import model_names as named
from validation.simulation.model_names import BEM, LINEAR, LINEAR_ON_LINE, twin_of

SHOWN = (LINEAR, named.SPRINGS_THAT_READ, named.ONE_SIDED_BED)
MODELS = (*SHOWN, named.SPRINGS_ON_LINE)
WAVES, GROUND, RIDGES = "waves of h'", "isotropic ground", "ridges"
OF_BEM = Quantity("interval_of_A3_of_boundary_elements")
HEIGHTS = Quantity("mean_of_heights_over_energy_mean_of_lines")
ELLIPSE = Quantity("A3_of_the_ellipse_over_that_of_a_line")
SPACING, ACROSS = "spacing [mm]", "across"
HARMONIC, PHASE = Quantity("half_wavelength_of_a_corrugation", "half wavelength of a corrugation, times d/A²"), "k a"
SECOND_ORDER = "second order, half-space"
OF_HARMONIC = Margin(0.02, "0.02: a tenth of its largest values", source="the closed second order of a circle")
GROUNDS = {name: filters.GROUNDS[name] for name in (RIDGES, "alpha = 0.5", "alpha = 1", GROUND)}


@dataclass(frozen=True, kw_only=True)
class RoughRail(rolled.RolledFilters):
    """lines: parallel ones; spacings: of them [m].

    phases: k a of corrugations, of the height A / d; corrugated: cells of both grids to the semi-axis, for these.
    """

    across: tuple[str, ...] = (GROUND,)
    lines: int = 3
    spacings: tuple[float, ...] = (0.005, 0.010)
    phases: tuple[float, ...] = (0.8, 1.2, 1.6, 2.0, 2.4, 2.8)
    height: float = 0.1
    corrugated: tuple[int, int] = (12, 24)
    seed: int = 21


def run(case: RoughRail, engine: Engine = SERIAL) -> rolled.RolledFiltersResult:
    """Strips as of all filters, and corrugations on both grids. Raises NotConvergedError where one is lost."""
    result = rolled.run_filters(case, engine)
    problems = {
        (HARMONIC, cells): [Corrugation(phase=s, height=case.height, cells=cells) for s in case.phases]
        for cells in case.corrugated
    }
    corrugations = engine.map_groups(roll_corrugation, problems)
    if lost := [
        f"k a = {s:g}, {cells} cells to an axis"
        for (_, cells), outcomes in corrugations.items()
        for s, outcome in zip(case.phases, outcomes, strict=True)
        if outcome["failed"]
    ]:
        raise NotConvergedError("the half wavelength of a corrugation needs all of its positions", lost)
    return replace(result, by_key={**result.by_key, **corrugations})


def series(result: rolled.RolledFiltersResult) -> list[Series]:
    """Filters and models over boundary elements, roughness by roughness; mean of heights over energy mean of lines."""
    parts = ((*result.filters(key), *_over_bem(result, key)) for key in result.case.keys)
    return [*(series for part in parts for series in part), *means_of_lines(result.case), *_corrugations(result)]


def _corrugations(result: rolled.RolledFiltersResult) -> Iterator[Series]:
    """The half wavelength that a corrugation makes, on boundary elements, in closed form, and on springs."""
    case = result.case
    assert isinstance(case, RoughRail)
    coarse, fine = (
        np.array([float(outcome["second"]) for outcome in result[HARMONIC, cells]]) for cells in case.corrugated
    )
    exact = corrugation_harmonic(case.phases)
    along = partial(Series, HARMONIC, along=PHASE, at=case.phases, unit="-")
    grid = np.abs(fine - coarse) / (case.corrugated[1] / case.corrugated[0] - 1)
    yield along(BEM, fine, reference=Estimates.exact(exact), grid=grid, margin=OF_HARMONIC)
    yield along(SECOND_ORDER, exact)
    yield along(named.SPRINGS_ON_LINE, corrugation_harmonic_of_springs(case.phases))


def _over_bem(result: rolled.RolledFiltersResult, key: rolled.Key) -> Iterator[Series]:
    """On the same strips where both have one linear twin, else each over its own.

    The two bands of the shortest waves are left out, where oblique waves are missing.
    """
    case, bem, keep = result.case, result.over_twin(key, BEM), counted(result.linear(key))
    shown, at = rolled.in_bands(case, key), millimetres(strip_bands(case.scene(key)))
    complete = np.arange(at.size) < at.size - 2
    margin = FIELD.with_source(f"boundary elements on the same {case.strips} strips")
    scatter = Estimates(replace(estimate, value=0.0) for estimate in bem)
    yield shown(OF_BEM, BEM, masked(scatter, complete), grid=result.left_by_grid(key, BEM, LINEAR))
    for model in MODELS:
        twin = twin_of(model)
        over = result.over(key, model, BEM) if twin == LINEAR else result.over_linear(key, model) - bem
        judged = partial(shown, rolled.OVER_BEM, model, grid=result.left_by_grid(key, BEM, twin), margin=margin)
        yield judged(masked(over, complete), where={OFFSET: key[1]}, ranges=only(at, keep & complete))


def means_of_lines(case: Any) -> Iterator[Series]:
    """In the bands that count over isotropic ground; integrals over what lies across.

    The energy mean of the spectra of parallel lines has, in the mean of all realisations, the levels of one line.
    """
    scene = case.scene(case.keys[0])
    line, bands = line_of(scene), strip_bands(scene)
    a3 = [filters.linear_filter(scene, model, "isotropic") for model in (LINEAR, LINEAR_ON_LINE)]
    ellipse, on_line = (filters.on_strips(scene, values) for values in a3)
    keep = counted(ellipse)
    in_bands = partial(Series, along=rolled.WAVE, at=millimetres(bands)[keep], unit="dB")
    yield in_bands(ELLIPSE, "", (ellipse - on_line)[keep])
    near = FIELD.with_source("energy mean of the spectra of the same lines")
    for ground, stated in GROUNDS.items():
        for spacing in case.spacings:
            places, where = lines_across(case.lines, spacing), {ACROSS: ground, SPACING: 1000 * spacing}
            reach = scene.contact.along, places[-1] - places[0]
            of_mean = partial(structure_of(stated, line).band_power, line, edges=bands.edges, semi_axes=reach)
            levels = filters.decibel(of_mean(mean_of_lines(places)))[keep]
            margin = replace(near, role=Role.IDENTITY if ground == RIDGES else Role.FINDING)
            yield in_bands(HEIGHTS, "", levels, where=where, margin=margin)


def notes(result: rolled.RolledFiltersResult) -> list[str]:
    """Which mean of parallel lines to take."""
    case = result.case
    assert isinstance(case, RoughRail)
    numbers = [n for series in means_of_lines(case) for n in series.numbers if n.role is Role.FINDING]
    low = min(numbers, key=lambda number: number.value)
    contact = case.scene(case.keys[0]).contact
    phase, height = 1.2, 20e-6
    wave, made = (
        2 * math.pi * contact.along / phase,
        abs(float(corrugation_harmonic(phase))) * height / contact.approach,
    )
    passed = float(np.sinc(phase / math.pi))
    return [
        f"A corrugation makes its half wavelength: of {1000 * wave:.0f} mm and an amplitude of {1e6 * height:g} µm "
        f"under a contact of semi-axis {1000 * contact.along:.3g} mm, {1000 * wave / 2:.0f} mm with "
        f"{1e6 * made * height:.2g} µm at constant load, {20 * math.log10(made / passed):.0f} dB relative to the "
        "corrugation behind the filter, by second order. No linear filter has it; it goes as the square of the "
        "amplitude.",
        f"The mean of the heights of {case.lines} parallel lines {low.where[SPACING]:g} mm apart is off by "
        f"{low.value:+.1f} dB over {low.where[ACROSS]}, at a wave of {low.where['worst at']:g} mm. "
        "For a level, average their spectra; a mean of heights is a filter of its own.",
    ]


def roughness(case: rolled.RolledFilters) -> Table:
    scenes = {key[1]: case.scene(key) for key in case.keys}
    return Table(
        "roughness and contact",
        {
            OFFSET: list(scenes),
            WAVES: [strip_bands(scene).span for scene in scenes.values()],
            "h' a_x / d": [round(lost_contact_number(scene), 4) for scene in scenes.values()],
        },
    )


STUDY = Study(
    title="A rougher rail: where linear theory leaves boundary elements, and which lines to measure",
    method=(
        "{c.strips} strips of isotropic ground with the levels of ISO 3095:2013, and with more, under a wheel of "
        "{c.keys[0][0].label} on a crown of {c.crown:g} m; boundary elements have {c.cells} cells to the smaller "
        "semi-axis. All models roll over the same strips, so each is divided by boundary elements strip by strip. "
        f"Bands count down to the first with A3 below {COUNTED:g} dB; shorter waves are drawn and not judged. h' is "
        "the rms slope along the track, in one direction, of the waves of the strips. They end at "
        f"{SHORTEST:g} a_x: shorter waves, of which nothing is known from measurements at 1 mm, would make the slope "
        "h' larger. Lines: {c.lines} parallel ones, {c.spacings:g} m apart. The mean of their heights is an integral "
        "over what lies across; waves with |k_y| < alpha k_x lie between ridges and isotropic ground. The energy mean "
        "of their spectra has the levels of one line in the mean of all realisations, and scatters less. The mean of "
        "heights is itself a filter: of lines 0.71 a_y apart it stands for the filter of the ellipse across the track "
        "(case across), and a filter of the ellipse that is applied to it counts this twice. No level is "
        "taken from a mean of heights. Corrugations are ridges A cos(k x), A/d = {c.height:g}, under a circular "
        "contact at constant load, {c.corrugated[1]} cells to its radius, and {c.corrugated[0]} for the error of the "
        "grid."
    ),
    series=series,
    claims=(
        Claim(quantity=rolled.OVER_BEM, along=OFFSET, model=LINEAR, printed=decibels).saying(
            "On a rail that is rougher than the limit of ISO 3095, linear theory of the ellipse gives the contact "
            "filter of boundary elements.",
            short="Linear theory of the ellipse agrees with boundary elements on rougher rails",
            key="linear-theory",
        ),
        Claim(quantity=HARMONIC, model=BEM).saying(
            "A corrugation makes its half wavelength, with the amplitude of a closed second order.",
            short="The half wavelength that a corrugation makes on BEM agrees with a closed second order",
            key="half-wavelength",
        ),
    ),
    charts=(
        Chart("rough_rail").of(
            "A3 of models over that of boundary elements on the same strips, by dB over ISO 3095:2013. Shaded: within "
            "1 dB. Band: 95 % of boundary elements, sample and grid.",
            Panel(
                rolled.WAVE,
                "A3 over that of boundary elements [dB]",
                facet=OFFSET,
                shade=(-1, 1),
                ylim=(-6, 9),
                downward=True,
            ).of(
                Curve(OF_BEM, style="interval", label="95 %, boundary elements", band=True),
                Curve(rolled.OVER_BEM, SHOWN, by=("model",)),
            ),
        ),
        Chart("rough_rail-corrugation", claims=(1,)).of(
            "Amplitude of half the wavelength that a corrugation A cos(k x) makes at constant load, times d/A², over "
            "k a: boundary elements, 95 % of the grid, the closed second order of the half-space, and that of springs.",
            Panel(PHASE, str(HARMONIC), log="", lines=(0.0,)).of(
                *by_model(HARMONIC, {SECOND_ORDER: "lines", named.SPRINGS_ON_LINE: "lines", BEM: "marks"}, bars=True)
            ),
        ),
        Chart("rough_rail-lines", claims=()).of(
            "Level of the mean of the heights of {c.lines} parallel lines over the energy mean of their spectra, by "
            "what lies across. Dotted: A3 of the ellipse over that of a line, isotropic ground. Shaded: within 1 dB.",
            Panel(
                rolled.WAVE,
                "mean of heights [dB]",
                facet=SPACING,
                shade=(-1, 1),
                ylim=(-8, 2),
                downward=True,
                ticked=True,
            ).of(Curve(HEIGHTS, by=(ACROSS,)), Curve(ELLIPSE, style="guide", label="ellipse over a row of springs")),
        ),
    ),
    matrices=(Matrix(name="over boundary elements", quantity=rolled.OVER_BEM, rows=("model",), columns=OFFSET),),
    printed=("roughness and contact",),
    tables=lambda result: (roughness(result.case),),
    notes=notes,
)
CASE = Case(
    name="rough_rail",
    chapter=Chapter.RAIL,
    place=3,
    answers="How rough a rail may be before its contact filter depends on the roughness; which lines to average",
    quick=RoughRail(offsets=(0.0, 20.0), strips=3, cells=(5, 7)),
    full=RoughRail(offsets=(0.0, 5.0, 10.0, 15.0, 20.0), strips=10, cells=(8, 16), corrugated=(16, 32)),
    run=run,
    study=STUDY,
    needs="linear theory of the ellipse; boundary elements for short waves on rougher rails",
)
