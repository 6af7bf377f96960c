"""Which contact filter is right, and by how many decibels are the others wrong: boundary elements, and the table."""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim, Matrix
from validation.analysis.evidence import Role
from validation.analysis.margins import FIELD
from validation.analysis.series import Estimates, Series, masked, only
from validation.analysis.study import Study
from validation.cases.rail import filters
from validation.cases.rail import rolled_filters as rolled
from validation.cases.rail.filters import ACROSS, COUNTED, REMINGTON, counted, linear_filter, scene_of
from validation.simulation import model_names as named
from validation.simulation.model_names import BEM, LINEAR, twin_of
from validation.simulation.rail_strip import SHORTEST, strip_bands

OVER_LINEAR, OF_WHEELS = "A3 over linear theory of the ellipse", "A3 of five wheels"
OVER_TABLE, SPEED = "A3 over the published table", "speed [km/h]"
WEIGHTED = "A-weighted level over that with linear theory of the ellipse"
TABLE, NOT_COMPARED = "published table", "published table, not compared"
OF_TABLE = replace(FIELD, source=filters.SOURCE, worst=False, rms=(FIELD.tolerance, FIELD.reason))
OF_SPEED = FIELD.beside("linear theory of the ellipse, levels of ISO 3095:2013, IEC 61672 A")


def series(result: rolled.RolledFiltersResult) -> list[Series]:
    """Filters on strips, beside the published table, and in dB(A)."""
    case = result.case
    return [
        *(one for key in case.keys for one in (*result.filters(key), *_of_strips(result, key))),
        *(one for wheel in filters.columns_of_table() for one in _of_table(wheel, case.across)),
        *(_in_decibel_a(result, model, name) for model in rolled.FILTERS[1:] for name in case.across),
    ]


def _of_strips(result: rolled.RolledFiltersResult, key: rolled.Key) -> Iterator[Series]:
    """In the bands that count: what is exact of each model, and what it is over its linear twin on the same strips."""
    case, bem, keep = result.case, result.over_twin(key, BEM), counted(result.linear(key))
    shown, at = rolled.in_bands(case, key), filters.millimetres(strip_bands(case.scene(key)))
    margin = FIELD.beside(f"boundary elements, {case.strips} strips of {case.scene(key).name}")
    by_cells = result.left_by_grid(key, BEM, LINEAR)
    for model in rolled.models_of(key):
        over, grid = result.over_linear(key, model), result.left_by_grid(key, model, twin_of(model))
        yield shown(OVER_LINEAR, model, masked(over, keep), grid=grid)
        if model != BEM:
            yield shown(rolled.OVER_BEM, model, over - bem, grid=by_cells + grid, margin=margin, ranges=only(at, keep))


def _of_table(wheel: filters.RailWheel, across: tuple[str, ...]) -> Iterator[Series]:
    """The published table, linear theory over both grounds, and each filter over the table where it is compared."""
    scene, table, keep = scene_of(wheel), filters.a3_of_table(wheel), filters.compared(wheel)
    in_table = partial(Series, along=rolled.WAVE, at=filters.millimetres(scene.levels.bands), unit="dB")
    for name, ground in ACROSS.items():
        yield in_table(OF_WHEELS, name, linear_filter(scene, LINEAR, ground), where={"wheel": wheel.label})
    for name, shown in ((TABLE, keep), (NOT_COMPARED, ~keep)):
        yield in_table(OF_WHEELS, name, np.where(shown, table, np.nan), where={"wheel": wheel.label})
    judged = partial(in_table, reference=Estimates.exact(table), grid=0.05, margin=OF_TABLE)
    for model in rolled.FILTERS:
        for name in across if model != REMINGTON else ("alpha = 1",):
            found = np.where(keep, linear_filter(scene, model, ACROSS.get(name, 1.0)), np.nan)
            yield judged(OVER_TABLE, model, found, where={"wheel": wheel.label, "across": name})


def _in_decibel_a(result: rolled.RolledFiltersResult, model: str, name: str) -> Series:
    """By speed, over linear theory of the ellipse with the same ground; ridges are the same across the contact."""
    scene = result.case.scene(result.case.keys[0])
    both = linear_filter(scene, model, ACROSS[name]), linear_filter(scene, LINEAR, ACROSS[name])
    sees_no_width = ACROSS[name] == "ridges" and model in (named.LINEAR_ON_LINE, named.LINEAR_ON_MEAN)
    margin = replace(OF_SPEED, role=Role.IDENTITY) if sees_no_width else OF_SPEED
    found, at = filters.over_in_decibel_a(scene, *both), filters.SPEEDS
    return Series(WEIGHTED, model, found, where={"across": name}, along=SPEED, at=at, unit="dB(A)", margin=margin)


def _of(model: str, says: str, short: str = "") -> Claim:
    """Limits reach from ridges, which one line knows whole."""
    return Claim(says=says, short=short, quantity=rolled.OVER_BEM, model=model, along="across")


SHOWN = (named.SPRINGS_THAT_READ, *rolled.FILTERS[1:], named.SPRINGS_ROLLING, named.SPRINGS_GEIKE)
STUDY = Study(
    title="Which contact filter is right for a wheel on a rail",
    method=(
        "Wheels of constant load roll over {c.strips} strips of ridges and of isotropic ground each, whose lines have "
        "the levels of ISO 3095:2013, on a crown of {c.crown:g} m. Boundary elements have {c.cells} cells to the "
        "smaller semi-axis; the finer ones are shown. Each one-sided model is measured over its linear twin on the "
        "same strips; the filter of the twin is an integral. Tracks of the rolling spectrum and of Geike's are made of "
        "the heights across each strip: the heights of one line do not give them. Remington's circle has the area of "
        f"the ellipse. Bands count down to the first in which A3 of linear theory is below {COUNTED:g} dB, since near "
        f"the zeros beyond it one-third octaves move by decibels. Roughness ends at {SHORTEST:g} a_x. The published "
        f"table is compared where it lies between {filters.FOLLOWED:g} and {filters.LEAST:g} dB; its value for 50 kN, "
        "920 mm at 40 mm, -1.3 dB, is masked: its neighbours, -1.1 dB at 50 mm and -3.5 dB at 31.5 mm, suggest about "
        "-2.1 dB. Levels in dB(A) are those of the contact force, k times the equivalent roughness, with no mobility "
        "of wheel or track."
    ),
    series=series,
    claims=(
        _of(
            LINEAR,
            "Linear theory of the ellipse is the contact filter of boundary elements within 1 dB, whatever lies "
            "across.",
            "Linear theory of the ellipse",
        ),
        _of(
            named.SPRINGS_THAT_READ,
            "Springs that read the surface have the contact filter of boundary elements within 1 dB.",
            "springs that read the surface",
        ),
        _of(named.BED, "The bed of springs of the field (DPRS), linear, is within 1 dB of boundary elements."),
        _of(named.LINEAR_ON_LINE, "Springs on the measured line are within 1 dB of boundary elements."),
        _of(REMINGTON, "Remington's closed form, alpha = 1, is within 1 dB of boundary elements.", "Remington"),
        _of(named.SPRINGS_ROLLING, "Springs on a track of the rolling spectrum are within 1 dB of boundary elements."),
        _of(
            named.SPRINGS_GEIKE,
            "Springs on a track of Geike's spectrum are within 1 dB of boundary elements over isotropic ground.",
        ),
        Claim(quantity="rms of " + OVER_TABLE, model=LINEAR, where={"across": "isotropic ground"}).saying(
            "Linear theory of the ellipse over isotropic ground lies within 1 dB rms of the published table."
        ),
    ),
    charts=(
        Chart("contact_filter", claims=(0, 4)).of(
            "(a), (b) A3 of each model over that of linear theory of the ellipse; points: boundary elements, 95 %; "
            "shaded: within 1 dB. (c) Points: the published table, open where masked; lines: linear theory of the "
            "ellipse over ridges, dotted over isotropic ground, a wheel each, shifted by 10 dB.",
            Panel(
                rolled.WAVE,
                "A3 over linear theory of the ellipse [dB]",
                facet="across",
                shade=(-1, 1),
                ylim=(-1.5, 6.5),
                downward=True,
            ).of(
                Curve(OVER_LINEAR, SHOWN, by=("model",), of={"wheel": "first"}),
                Curve(OVER_LINEAR, BEM, "bem", BEM, of={"wheel": "first"}, bars=True),
            ),
            Panel(
                rolled.WAVE,
                "A3, shifted [dB]",
                title="published table",
                xlim=(8, 200),
                ylim=(-68, 4),
                downward=True,
                legend="lower left",
            ).of(
                Curve(OF_WHEELS, "ridges", "lines", "_", by=("wheel",), down=10.0),
                Curve(OF_WHEELS, "isotropic ground", "dotted", "_", by=("wheel",), down=10.0),
                Curve(OF_WHEELS, TABLE, "marks", by=("wheel",), down=10.0),
                Curve(OF_WHEELS, NOT_COMPARED, "open marks", "_", by=("wheel",), down=10.0),
            ),
        ),
    ),
    matrices=(
        Matrix(name="over boundary elements", quantity=rolled.OVER_BEM, rows=("wheel", "across"), columns="model"),
        Matrix(
            name="rms difference from the published table",
            quantity="rms of " + OVER_TABLE,
            rows=("model", "across"),
            columns="wheel",
        ),
        Matrix(name=WEIGHTED, quantity=WEIGHTED, rows=("model",), columns="across"),
    ),
)
CASE = Case(
    name="contact_filter",
    chapter=Chapter.RAIL,
    place=2,
    answers="Which contact filter is right for my wheel, and by how many dB is the one I use wrong",
    quick=rolled.RolledFilters(strips=3, cells=(5, 7)),
    full=rolled.RolledFilters(
        wheels=((50.0, 920.0), (25.0, 920.0), (50.0, 680.0), (50.0, 360.0), (100.0, 920.0)), strips=6, cells=(8, 16)
    ),
    run=rolled.run_filters,
    study=STUDY,
    needs="linear theory of the ellipse at the levels of ISO 3095:2013",
)
