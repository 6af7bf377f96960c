"""What lies across a rail decides its contact filter: what the case says, and tables that can be used without us."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from validation.analysis.claims import Matrix
from validation.analysis.evidence import Table, Whose, table_of
from validation.analysis.number_text import decibels
from validation.analysis.statistics import Interval
from validation.case import Case, Chapter, Chart, Claim, Curve, Panel, Quantity, Series, Study
from validation.railway.cases import across, filters
from validation.railway.cases.across import GROUND, WHEEL, AcrossResult
from validation.railway.cases.filters import COUNTED, GROUNDS, OFFSET, counted, linear_filter
from validation.railway.cases.rolled_filters import A3, OVER_BEM, WAVE
from validation.railway.problems.rail_strip import SHORTEST
from validation.simulation.model_names import BED, BEM, LINEAR, LINEAR_ON_LINE

ByModelAndGround = dict[tuple[str, str], list[float]]
LACKING = Quantity("what_to_add_to_A3_of_one_line_dB", "what to add to A3 of one line [dB]")
STANDS = Quantity("what_stands_for_what_lies_across")
BORDERS = Quantity("up_to_which_alpha_one_line_is_enough")
LOUDER = Quantity(
    "sound_power_re_boundary_elements_dB_A_two_speeds",
    "sound power relative to boundary elements [dB(A)], two speeds",
)
SHOWN_SPEEDS = (80.0, 250.0)
"""Of a table of sums [km/h]."""
SHOWN_TOLERANCES = (1.0, 2.0)
"""Of a table of borders [dB]."""


def tables(result: AcrossResult) -> tuple[Table, ...]:
    """For the first wheel sound power, and what one line lacks; for all wheels borders, and what mends springs."""
    wheel = result.case.smooth[0][0].label
    rows: dict[str, dict[str, object]] = {}
    for series in _smooth(result, across.WEIGHTED):
        if series.where[WHEEL] == wheel:
            rows.setdefault(series.model, {"model": series.model})[str(series.where[GROUND])] = " / ".join(
                f"{round(_central(value), 1) + 0.0:+.1f}"
                for speed, value in zip(series.at, series.values, strict=True)
                if speed in SHOWN_SPEEDS
            )
    return table_of(LOUDER, list(rows.values())), *_borders(result), _stands(result), _lacking(result)


def _smooth(result: AcrossResult, quantity: str) -> Iterator[Series]:
    return (series for series in result.series if series.quantity == quantity and series.where.get(OFFSET, 0.0) == 0.0)


def _central(value: object) -> float:
    return value.value if isinstance(value, Interval) else float(value)  # type: ignore[arg-type]


def _borders(result: AcrossResult) -> Iterator[Table]:
    """A row a wheel and tolerance: the largest alpha in the worst band, and in sound power at each speed."""
    rows: dict[object, dict[str, object]] = {}
    heads = {across.WORST_BAND: "worst band"} | {way: f"{speed:g} km/h" for speed, way in across.AT_SPEEDS.items()}
    for series in _smooth(result, across.BORDER):
        for tolerance, alpha in zip(series.at, series.values, strict=True):
            if tolerance in SHOWN_TOLERANCES:
                wheel = series.where[WHEEL]
                row = rows.setdefault((wheel, tolerance), {WHEEL: wheel, across.WITHIN: tolerance})
                row[heads[series.model]] = _border(alpha)
    if rows:
        yield table_of(BORDERS, list(rows.values()))


def _border(alpha: object) -> str:
    assert isinstance(alpha, Interval)
    first, last = across.FINE_ALPHAS[[0, -1]]
    if not first < alpha.value < last:
        return f"{last:g} and more" if alpha.value >= last else f"{first:g} and less"
    # rounded up
    return f"{alpha.value:.2f} ± {math.ceil(100 * alpha.half_width) / 100:.2f}"


def _stands(result: AcrossResult) -> Table:
    """Over all wheels: the wave down to which a bed is within 1 dB, its nearest factor, Remington's nearest alpha."""
    reach, nearest, left = (_of_wheels(result, name) for name in (across.REACH, across.NEAREST, across.LEFT))
    return table_of(
        STANDS,
        [
            {
                GROUND: ground,
                "DPRS, 1 dB down to [mm]": float(np.max(reach[BED, ground])),
                "wider by 2/√3, 1 dB down to [mm]": float(np.max(reach[filters.BED_WIDER, ground])),
                "nearest factor": _printed_range(nearest[across.FACTOR_OF, ground], ".2f"),
                "nearest alpha of Remington": _printed_range(nearest[across.ALPHA_OF, ground], ".1f"),
                "which leaves [dB]": _printed_range(left[across.ALPHA_OF, ground], ".1f"),
            }
            for ground in result.case.across
        ],
    )


def _of_wheels(result: AcrossResult, quantity: str) -> ByModelAndGround:
    values: ByModelAndGround = {}
    for series in _smooth(result, quantity):
        values.setdefault((series.model, str(series.where[GROUND])), []).append(_central(series.values[0]))
    return values


def _printed_range(values: Sequence[float], digits: str) -> str:
    return f"{min(values):{digits}} to {max(values):{digits}}"


def _lacking(result: AcrossResult) -> Table:
    """A3 of the ellipse over that of one line, in the bands that count over each ground."""
    scene = result.case.scene(result.case.smooth[0])
    line, waves = linear_filter(scene, LINEAR_ON_LINE, "ridges"), filters.millimetres(scene.levels.bands)
    shown = np.flatnonzero(counted(line) & (line < -0.05))
    columns = {WAVE: waves[shown], "one line": line[shown].round(1)}
    for name in result.case.across:
        a3 = linear_filter(scene, LINEAR, GROUNDS[name])
        columns[name] = np.where(counted(a3), a3 - line, np.nan)[shown].round(1) + 0.0
    return Table(LACKING, {name: column.tolist() for name, column in columns.items()})


def notes(result: AcrossResult) -> list[str]:
    """Borders over all wheels, and what isotropic ground is alike."""
    sentences = []
    for way in across.WAYS:
        if borders := [series for series in _smooth(result, across.BORDER) if series.model == way]:
            near, far = (_by_wheel([series.values[i] for series in borders]) for i in (0, 1))
            sentences.append(f"One line is within 1 dB {way} up to alpha = {near}; within 2 dB up to {far}.")
    if alike := [series.values[0] for series in _smooth(result, across.NEAREST) if series.model == across.ALIKE]:
        sentences.append(
            f"The alpha whose contact filter is nearest to that of isotropic ground is {_by_wheel(alike)}."
        )
    return sentences


def _by_wheel(alphas: Sequence[object]) -> str:
    least, most = (of(alphas, key=_central) for of in (min, max))
    return _border(least) if least is most else f"{_border(least)} to {_border(most)}, by wheel"


OF_FIRST = {WHEEL: "first", OFFSET: 0.0}
from_ridges = Claim(quantity=OVER_BEM, model=LINEAR_ON_LINE, along=GROUND, printed=decibels)
STUDY = Study(
    title="What lies across a rail decides its contact filter",
    method=(
        "Lines have the levels of ISO 3095:2013; their waves cross the rail as ridges, with |k_y| < alpha k_x "
        "uniformly, or as on isotropic ground. Wheels ({c.labels}) roll under constant load on a crown of {c.crown:g} "
        "m, {c.rougher[1]} of them also on rails {c.rougher[0]:g} dB rougher, {c.rougher[2]} strips. Boundary elements "
        "have {c.cells} cells to the smaller semi-axis, on {c.strips} strips a ground, each upside down too. "
        "Strips are drawn as wide as oblique long waves need, and rolled over along their middle; roughness ends at "
        f"{SHORTEST:g} a_x. Linear filters are integrals; A3 of boundary elements is that of linear theory of the "
        "ellipse and what they are over it on the same strips. One line: springs with R_1 = a_x²/d, "
        "E_1 = 3F / (4 a_x d). DPRS: a bed of springs, 2 J_1(S) / S. Remington: the same on the circle of equal area. "
        f"Bands count down to the first in which A3 of linear theory is below {COUNTED:g} dB: near the zeros beyond it "
        "one-third octaves move by decibels. 1 dB is our choice. Sound power per axle: L_eq + G-3a (track M/M) and "
        "L_eq + G-3b (wheel of the nearest diameter), energies added, A-weighted, 50 Hz to 10 kHz; a band of frequency "
        "takes the energies of the two wavelengths about v / f in proportion (Directive 2002/49/EC, Annex II, tables "
        "of (EU) 2021/1226). Longer waves than 400 mm and shorter ones than 3.15 mm have the levels of CNOSSOS class "
        "E. The table of the contact filter of CNOSSOS-EU, in the edition of (EU) 2021/1226, is an overlay: it states "
        "no lateral structure. As far as we recall it came from runs of DPRS. Its -1.3 dB at 40 mm, between -1.1 and "
        "-3.5 dB, may be a misprint."
    ),
    series=lambda result: result.series,
    claims=(
        Claim(quantity=OVER_BEM, model=LINEAR, printed=decibels).saying(
            "Linear theory of the ellipse gives the contact filter of boundary elements, whatever lies across.",
            short="Linear theory of the ellipse agrees with boundary elements",
            key="linear-theory",
        ),
        replace(from_ridges, quantity=across.ONE_LINE, whose=Whose.LITERATURE).saying(
            "Springs on one line agree with a three-dimensional elastic analysis within 3 dB in one-third octaves "
            "(Ford and Thompson 2006).",
            short="Springs on one line agree with boundary elements",
            key="one-line",
        ),
        replace(from_ridges, model=filters.BED_WIDER).saying(
            "A bed of springs (DPRS) on a patch wider by 2/√3 gives the contact filter of boundary elements.",
            short="DPRS on a wider patch agrees with boundary elements",
            key="wide-bed",
        ),
    ),
    charts=(
        Chart("across", claims=(1, 2)).of(
            "First wheel, at the level of ISO 3095:2013. A3: lines are linear theory of the ellipse from ridges, dark, "
            "to isotropic ground, light; points are boundary elements, 95 %; crosses are the table of CNOSSOS-EU, an "
            "overlay. One line by alpha: over boundary elements, 95 %. Others: A3 of a filter over that of boundary "
            "elements in the bands that count, by what lies across. Shaded: within 1 dB.",
            Panel(
                *(WAVE, "A3 [dB]", (), "boundary elements"),
                xlim=(8, 130),
                ylim=(-22, 1),
                downward=True,
            ).of(
                Curve(A3, LINEAR, "lines", "_", by=(GROUND,), of=OF_FIRST),
                Curve(A3, BEM, "marks", "_", by=(GROUND,), of=OF_FIRST, bars=True, x_factor=1.0),
                Curve(A3, across.TABLE, "crosses", "CNOSSOS-EU", of={WHEEL: "first of all"}),
            ),
            Panel("alpha", across.OFF, title="one line", shade=(-1, 1), ylim=(-1.2, 9)).of(
                Curve(across.OFF, across.WAYS, "lines", by=("model",), of={WHEEL: "first"}, band=True),
            ),
            Panel(
                WAVE,
                "over boundary elements [dB]",
                facet="model",
                shade=(-1, 1),
                ylim=(-4, 10),
                downward=True,
            ).of(
                Curve(OVER_BEM, across.SHOWN, by=(GROUND,), of=OF_FIRST),
            ),
        ),
    ),
    matrices=(
        Matrix(
            name="A3 over that of boundary elements, 50 kN, 920 mm",
            quantity=OVER_BEM,
            where={WHEEL: "50 kN, 920 mm", OFFSET: 0.0},
            rows=("model",),
            columns=GROUND,
            printed=decibels,
        ),
    ),
    printed=(LOUDER, BORDERS, STANDS, LACKING),
    tables=tables,
    notes=notes,
)
CASE = Case(
    name="across",
    chapter=Chapter.RAIL,
    place=2,
    answers="What lies across a rail: up to where one line is enough, and by how many dB each contact filter is wrong",
    quick=across.Across(across=("ridges", "alpha = 0.5", "alpha = 2", "isotropic ground")),
    full=across.Across(
        wheels=((50.0, 920.0), (50.0, 360.0), (25.0, 920.0), (50.0, 680.0), (100.0, 920.0)),
        rougher=(10.0, 2, 8),
        strips=6,
        cells=(6, 9),
    ),
    run=across.run,
    study=STUDY,
    needs="linear theory of the ellipse at the levels of ISO 3095:2013",
)
