"""A rail at the limit of ISO 3095 and rougher: where linear theory and springs leave boundary elements."""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim, Matrix
from validation.analysis.evidence import Table
from validation.analysis.margins import FIELD
from validation.analysis.series import Estimates, Margin, Series, masked, only
from validation.analysis.statistics import mean_estimate
from validation.analysis.study import Study
from validation.cases.rail import rolled_filters as rolled
from validation.cases.rail.filters import COUNTED, counted, millimetres
from validation.simulation import model_names as named
from validation.simulation.equivalent_displacement import AREA
from validation.simulation.model_names import BEM, LINEAR, twin_of
from validation.simulation.rail_strip import SHORTEST, lost_contact_number, strip_bands

SHOWN = (LINEAR, named.SPRINGS_THAT_READ, named.ONE_SIDED_BED)
MODELS = (*SHOWN, named.SPRINGS_ON_LINE, named.SPRINGS_ROLLING, named.SPRINGS_GEIKE)
OFFSET, WAVES, GROUND = "offset [dB]", "waves of h'", "isotropic ground"
SHORT, LONG = "waves beyond the first zero", "bands that count"
OF_BEM, LOST = "interval of A3 of boundary elements", "area in contact over that of the smooth wheel"
FULL_CONTACT = Margin(
    0.05,
    "5 %: hardly any contact is lost; cells at the edge count whole, which is 2 % on these grids",
    source="the ellipse of Hertz",
)


def series(result: rolled.RolledFiltersResult) -> list[Series]:
    """Filters, models over boundary elements, and the area in contact, roughness by roughness."""
    parts = ((*result.filters(key), *_over_bem(result, key), _area(result, key)) for key in result.case.keys)
    return [one for part in parts for one in part]


def _over_bem(result: rolled.RolledFiltersResult, key: rolled.Key) -> Iterator[Series]:
    """On the same strips where both have one linear twin, else each over its own.

    The two bands of the shortest waves are left out, where oblique waves are missing.
    """
    case, bem, keep = result.case, result.over_twin(key, BEM), counted(result.linear(key))
    shown, at = rolled.in_bands(case, key), millimetres(strip_bands(case.scene(key)))
    whole = np.arange(at.size) < at.size - 2
    margin = FIELD.beside(f"boundary elements on the same {case.strips} strips")
    scatter = Estimates(replace(one, value=0.0) for one in bem)
    yield shown(OF_BEM, BEM, masked(scatter, whole), grid=result.left_by_grid(key, BEM, LINEAR))
    for model in MODELS:
        twin = twin_of(model)
        over = result.over(key, model, BEM) if twin == LINEAR else result.over_linear(key, model) - bem
        judged = partial(shown, rolled.OVER_BEM, model, grid=result.left_by_grid(key, BEM, twin), margin=margin)
        for waves, inside in ((LONG, keep & whole), (SHORT, ~keep & whole)):
            where = {OFFSET: key[1], "waves": waves}
            yield judged(masked(over, inside), where=where, ranges=only(at, inside))


def _area(result: rolled.RolledFiltersResult, key: rolled.Key) -> Series:
    """Mean along all strips, on the finer grid, beside that of the coarser one."""
    cells = result.case.cells
    coarse, fine = (mean_estimate(np.array([float(one[AREA].mean()) for one in result[key, n]])) for n in cells)
    left = abs(fine.value - coarse.value) * cells[0] / (cells[1] - cells[0])
    return Series(LOST, BEM, (fine,), where={OFFSET: key[1]}, reference=1.0, grid=(left,), margin=FULL_CONTACT)


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


follow = partial(Claim, quantity=rolled.OVER_BEM, along=OFFSET)
STUDY = Study(
    title="A rougher rail: where linear theory leaves boundary elements, and where springs do",
    method=(
        "{c.strips} strips of isotropic ground with the levels of ISO 3095:2013, and with more, under a wheel of "
        "{c.keys[0][0].label} on a crown of {c.crown:g} m; boundary elements have {c.cells} cells to the smaller "
        "semi-axis. All models roll over the same strips, so each is divided by boundary elements strip by strip. "
        f"Bands count down to the first with A3 below {COUNTED:g} dB; shorter waves are judged apart. h' is the rms "
        f"slope along the track, in one direction, of the waves of the strips. They end at {SHORTEST:g} a_x: shorter "
        "waves, of which nothing is known from measurements at 1 mm, would make the slope h' larger."
    ),
    series=series,
    claims=(
        follow(model=LINEAR, where={"waves": LONG}).saying(
            "Linear theory of the ellipse follows boundary elements within 1 dB up to 20 dB over the limit of "
            "ISO 3095.",
            short="Linear theory of the ellipse",
        ),
        follow(model=LINEAR, where={"waves": SHORT}).saying(
            "It follows them within 1 dB at the waves beyond its first zero too.",
            short="linear theory beyond its first zero",
        ),
        follow(model=named.SPRINGS_THAT_READ).saying(
            "Springs that read the surface follow boundary elements within 1 dB at all of these waves.",
            short="springs that read the surface",
        ),
        Claim(quantity=LOST, where={OFFSET: 0.0}).saying(
            "At the limit of ISO 3095 the wheel keeps 95 % of the area of the smooth contact."
        ),
    ),
    charts=(
        Chart("rough_rail").of(
            "A3 of models over that of boundary elements on the same strips, by dB over ISO 3095:2013. Filled: bands "
            "that count; open: waves beyond the first zero. Shaded: within 1 dB. Grey: 95 % of boundary elements, "
            "sample and grid.",
            Panel(
                rolled.WAVE,
                "A3 over that of boundary elements [dB]",
                facet=OFFSET,
                shade=(-1, 1),
                ylim=(-6, 9),
                downward=True,
            ).of(
                Curve(OF_BEM, style="interval", label="95 %, boundary elements", band=True),
                Curve(rolled.OVER_BEM, SHOWN, by=("model",), of={"waves": LONG}),
                Curve(rolled.OVER_BEM, SHOWN, "open", "_", by=("model",), of={"waves": SHORT}),
            ),
        ),
    ),
    matrices=(
        Matrix(name="over boundary elements", quantity=rolled.OVER_BEM, rows=("model", "waves"), columns=OFFSET),
        Matrix(name=LOST, quantity=LOST, rows=("model",), columns=OFFSET),
    ),
    printed=("roughness and contact",),
    tables=lambda result: (roughness(result.case),),
)
CASE = Case(
    name="rough_rail",
    chapter=Chapter.RAIL,
    place=3,
    answers="How rough a rail may be before its contact filter depends on the roughness",
    quick=rolled.RolledFilters(offsets=(0.0, 20.0), across=(GROUND,), strips=3, cells=(5, 7), seed=21),
    full=rolled.RolledFilters(
        offsets=(0.0, 5.0, 10.0, 15.0, 20.0), across=(GROUND,), strips=10, cells=(8, 16), seed=21
    ),
    run=rolled.run_filters,
    study=STUDY,
    needs="linear theory of the ellipse; boundary elements for short waves on rougher rails",
)
