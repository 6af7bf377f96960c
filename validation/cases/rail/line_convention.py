"""One measured line, the energy mean of parallel lines, and the mean of their heights: what each says of a rail."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim, decibels
from validation.analysis.evidence import Role
from validation.analysis.margins import FIELD
from validation.analysis.series import Margin, Series, Where
from validation.analysis.spectra import Bands
from validation.analysis.statistics import POWER_DECIBEL, Estimate, FloatArray, jackknifed
from validation.analysis.study import Outcomes, Study
from validation.cases.rail import filters
from validation.cases.rail.filters import RailWheel, decibel, scene_of
from validation.engine.engine import SERIAL, Engine
from validation.scenes.rail import RailScene
from validation.simulation import rail_strip
from validation.simulation.equivalent_displacement import transfer_of
from validation.simulation.model_names import LINE, LINEAR, LINEAR_ON_LINE
from validation.simulation.rail_strip import ParallelLines, RailStrip, StatedAcross, mean_of_lines, strip_bands

RIDGES, ISOTROPIC = "ridges", "isotropic ground"
GROUNDS: dict[str, StatedAcross] = {RIDGES: "ridges", "alpha = 0.5": 0.5, "alpha = 1": 1.0, ISOTROPIC: "isotropic"}
WIDER = 2
CELLS = 5
"""To the smaller semi-axis: the bands that count have waves three times as long as it."""


@dataclass(frozen=True, kw_only=True)
class LineConvention:
    """lines: parallel ones; spacings: of them [m]; strips: realisations of each ground; load of one wheel [kN],
    diameter [mm]; seed."""

    lines: int = 3
    spacings: tuple[float, ...] = (0.005, 0.010)
    strips: int = 60
    load: float = 50.0
    diameter: float = 920.0
    seed: int = 22

    @property
    def scene(self) -> RailScene:
        return scene_of(RailWheel(self.load, self.diameter))

    @property
    def bands(self) -> Bands:
        return Bands(tuple(strip_bands(self.scene).edges.tolist()))

    def strip(self, ground: str, realisation: int = 0) -> RailStrip:
        """As of the contact filter, and wider: its oblique waves have k_y = 2 pi / width and multiples."""
        strip = rail_strip.strip_of(self.scene, GROUNDS[ground], CELLS, realisation, self.seed)
        return replace(strip, width=WIDER * strip.width)

    def problems(self, ground: str) -> list[ParallelLines]:
        across = partial(ParallelLines, lines=self.lines, spacings=self.spacings, bands=self.bands)
        return [across(strip=self.strip(ground, i)) for i in range(self.strips)]


def run(case: LineConvention, engine: Engine = SERIAL) -> Outcomes:
    """Measure the lines of all strips: band powers by ground, (strips, bands) of one line and of energy means."""
    outcomes = engine.map_groups(rail_strip.measure_lines, {ground: case.problems(ground) for ground in GROUNDS})
    rows = {g: {name: np.array([one[name] for one in some]) for name in some[0]} for g, some in outcomes.items()}
    return Outcomes(case, rows)


ENERGY, HEIGHTS, SCATTER = "energy mean of lines over one line", "mean of heights over one line", "scatter of a level"
SPREAD, ELLIPSE = "deviation of a level from strip to strip", "A3 of the ellipse over that of a line"
GROUND, SPACING, WAVE = "across", "spacing [mm]", "wavelength [mm]"
NEAR = FIELD.beside("one line, mean of all realisations")
AS_ONE = Margin(
    0.15,
    "15 %: a third less would be that of three independent lines, 1 / sqrt(3) = 0.58",
    source="one line on the same strips",
)


def series(result: Outcomes) -> list[Series]:
    """In the bands that count, ground by ground; the filter of the ellipse beside them."""
    case = result.case
    keep, over_line = _counted(case)
    at = filters.millimetres(strip_bands(case.scene))[keep]
    in_bands = partial(Series, along=WAVE, at=at, unit="dB")
    grounds = [one for ground in GROUNDS for one in _of_ground(result, ground, keep, in_bands)]
    return [in_bands(ELLIPSE, "", over_line), *grounds]


def _of_ground(result: Outcomes, ground: str, keep: NDArray[np.int64], in_bands: partial[Series]) -> Iterator[Series]:
    """Both means over one line, and how the levels scatter; over ridges all lines are alike, and so are their means."""
    case, found = result.case, result[ground]
    role = Role.IDENTITY if ground == RIDGES else Role.FINDING
    line = found["line"][:, keep]
    yield in_bands(SPREAD, "one line", decibel(line).std(axis=0, ddof=1), where={GROUND: ground})
    for spacing in case.spacings:
        where: Where = {GROUND: ground, SPACING: 1000 * spacing}
        near, powers = replace(NEAR, role=role), found[f"{spacing:g}"][:, keep]
        energy = energy_mean(case, ground, found[f"{spacing:g}"])
        yield in_bands(HEIGHTS, "", mean_of_heights(case, ground, spacing)[keep], where=where, margin=near)
        yield in_bands(ENERGY, "", [energy[i] for i in keep], where=where, margin=near, scale=POWER_DECIBEL)
        name = f"energy mean, {1000 * spacing:g} mm apart"
        yield in_bands(SPREAD, name, decibel(powers).std(axis=0, ddof=1), where={GROUND: ground})
        ratio = jackknifed(scatter, np.stack([powers, line], axis=1))
        margin = replace(AS_ONE, role=role)
        yield Series(SCATTER, "energy mean over one line", ratio, where=where, reference=1.0, margin=margin)


def mean_of_heights(case: LineConvention, ground: str, spacing: float) -> FloatArray:
    """Its levels over those of one line: an integral over what lies across [dB]."""
    line, places = rail_strip.line_of(case.scene), rail_strip.lines_across(case.lines, spacing)
    structure = rail_strip.structure_of(GROUNDS[ground], line)
    reach = (case.scene.contact.along, places[-1] - places[0])
    return decibel(structure.band_power(line, mean_of_lines(places), edges=case.bands.edges, semi_axes=reach))


def energy_mean(case: LineConvention, ground: str, powers: FloatArray) -> list[Estimate]:
    """ln of the energy mean over one line in the mean of all realisations."""
    strip = case.strip(ground)
    one = strip.expected_power(transfer_of(LINE, strip.contact), case.bands)
    return jackknifed(lambda rows: np.log(rows.mean(axis=0) / one), powers)


def scatter(powers: FloatArray) -> FloatArray:
    """rms over bands of the deviation of a level from strip to strip, over one line: powers (strips, 2, bands)."""
    deviation = np.sqrt(np.mean(np.var(decibel(powers), axis=0, ddof=1), axis=-1))
    return np.asarray(deviation[0] / deviation[1] if deviation[1] > 1e-6 else 1.0)


def _counted(case: LineConvention) -> tuple[NDArray[np.int64], FloatArray]:
    """Bands of the strips that count over isotropic ground; A3 of the ellipse over that of a line there [dB]."""
    ellipse, line = (filters.linear_filter(case.scene, model, "isotropic") for model in (LINEAR, LINEAR_ON_LINE))
    keep = np.flatnonzero(filters.on_strips(case.scene, filters.counted(ellipse)))
    return keep, filters.on_strips(case.scene, ellipse - line)[keep]


STUDY = Study(
    title="Which line: one, the energy mean of parallel lines, or the mean of their heights",
    method=(
        "{c.strips} strips of each ground, whose lines have the levels of ISO 3095:2013, are measured along {c.lines} "
        "parallel lines, {c.spacings:g} m apart. The levels of the energy mean of their spectra and of the mean of "
        "their heights are compared with those of one line in the mean of all realisations. The mean of heights is an "
        "integral over what lies across; the energy mean is found on strips. Bands are those in which the filter of "
        "{c.scene.name} counts. Waves with |k_y| < alpha k_x lie between ridges and isotropic ground. The mean of "
        "heights is itself a filter: a filter of the ellipse that is applied to it counts this twice."
    ),
    series=series,
    claims=(
        Claim(quantity=HEIGHTS, along=GROUND, printed=decibels).saying(
            "The mean of the heights of parallel lines has the levels of one line within 1 dB.",
            short="Mean of heights over one line",
        ),
        Claim(quantity=ENERGY, along=GROUND, printed=decibels).saying(
            "The energy mean of the spectra of parallel lines has the levels of one line within 1 dB.",
            short="energy mean over one line",
        ),
        Claim(says="Levels from the energy mean of three lines scatter as those of one line do.", quantity=SCATTER),
    ),
    charts=(
        Chart("line_convention", claims=(0, 1)).of(
            "(a), (b) Levels of the mean of heights over one line, by what lies across; dotted: A3 of the ellipse over "
            "that of a line; points: energy mean, 95 %; shaded: within 1 dB. (c) Deviation of a level from strip to "
            "strip. Dotted, points and (c): isotropic ground.",
            Panel(
                WAVE,
                "over the level of one line [dB]",
                facet=SPACING,
                shade=(-1, 1),
                ylim=(-8, 2),
                downward=True,
                ticked=True,
            ).of(
                Curve(HEIGHTS, by=(GROUND,)),
                Curve(ELLIPSE, style="guide", label="ellipse over row of springs"),
                Curve(ENERGY, style="bem", label="energy mean", of={GROUND: ISOTROPIC}, bars=True),
            ),
            Panel(
                WAVE,
                "deviation from strip to strip [dB]",
                title=ISOTROPIC,
                ylim=(0, None),
                downward=True,
                ticked=True,
                legend="upper right",
            ).of(Curve(SPREAD, of={GROUND: ISOTROPIC}, by=("model",))),
        ),
    ),
)
CASE = Case(
    name="line_convention",
    chapter=Chapter.RAIL,
    place=4,
    answers="Whether lines are averaged as energies or as heights, and what lies across a rail",
    quick=LineConvention(strips=40),
    full=LineConvention(strips=400),
    run=run,
    study=STUDY,
    needs="linear theory of the ellipse, with what lies across the track",
)
