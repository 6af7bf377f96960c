"""What lies across a rail: filters by double sums, strips drawn wide and rolled both ways, what becomes of both."""

import math
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy import special

import bem3d
import validation
from tests.seeded import catches
from validation.analysis.evidence import number_with, numbers_with
from validation.analysis.series import numbers_of
from validation.analysis.statistics import POWER_DECIBEL
from validation.railway.cases import across, across_study, filters, rolled_filters
from validation.railway.cases.filters import GROUNDS, RailWheel, scene_of
from validation.railway.cases.rolled_filters import A3, OVER_BEM
from validation.railway.problems import rail_across
from validation.railway.problems.equivalent_displacement import transfer_of
from validation.railway.problems.rail_across import roll_both_ways, wide_rail
from validation.railway.problems.rail_strip import line_of, strip_bands
from validation.report.figures import drawing
from validation.simulation.model_names import BED, BEM, LINEAR, LINEAR_ON_LINE

FOLDER = Path(validation.__file__).parent
WHEEL = RailWheel(50, 360)
"""The contact is wider than long: filters differ the most."""
A_X, A_Y = scene_of(WHEEL).contact.semi_axes


def jinc(s):
    return 2 * special.j1(s) / s


RESPONSES = {
    LINEAR: lambda x, y: np.sinc(np.hypot(x * A_X, y * A_Y) / math.pi),
    LINEAR_ON_LINE: lambda x, y: np.sinc(x * A_X / math.pi) + 0 * y,
    filters.LINES_APART: lambda x, y: np.sinc(x * A_X / math.pi) * (1 + 2 * np.cos(0.005 * y)) / 3,
    filters.LINES_NEAR: lambda x, y: np.sinc(x * A_X / math.pi) * (1 + 2 * np.cos(A_Y / math.sqrt(2) * y)) / 3,
    BED: lambda x, y: jinc(np.hypot(x * A_X, y * A_Y)),
    filters.BED_WIDER: lambda x, y: jinc(1.1547005384 * np.hypot(x * A_X, y * A_Y)),
    filters.REMINGTON_THERE: lambda x, y: jinc(math.sqrt(A_X * A_Y) * np.hypot(x, y)),
}


SOME_BANDS = replace(scene_of(WHEEL), roughness=scene_of(WHEEL).levels.within(0.05, 0.0125))


@cache
def waves_of_band(ground, wavelength):
    """k_x, k_y and their weights, by midpoints."""
    line = line_of(SOME_BANDS)
    x = np.linspace(2 * math.pi / wavelength * 10**-0.05, 2 * math.pi / wavelength * 10**0.05, 41)
    x = ((x[1:] + x[:-1]) / 2)[:, np.newaxis]
    if ground == "isotropic":
        edge = np.concatenate([np.linspace(0, 2e4, 8001), np.geomspace(2e4, 4e6, 1000)[1:]])
        y, dy = (edge[1:] + edge[:-1]) / 2, np.diff(edge)
        weight = line.isotropic(np.hypot(x, y).ravel()).reshape(x.size, y.size) * dy
    else:
        slope = (np.arange(2000) + 0.5) / 2000
        y, weight = ground * x * slope, line(x) + 0 * slope
    return x, y, weight


def by_double_sum(response, ground, wavelength):
    """10 lg of int int H^2 C dk_y dk_x over int int C dk_y dk_x in one band."""
    x, y, weight = waves_of_band(ground, wavelength)
    return 10 * math.log10(float((response(x, y) ** 2 * weight).sum() / weight.sum()))


filter_of = filters.filter_of


@catches("Remington's circle as long as the ellipse", model=filters.REMINGTON_THERE).at(
    "validation.railway.cases.filters.filter_of",
    lambda model, contact: filter_of(model, replace(contact, across=contact.along)),
)
@pytest.mark.slow
@pytest.mark.parametrize("model", [*RESPONSES, filters.REMINGTON])
def test_linear_filters_are_double_sums_over_the_waves_of_a_band(model):
    """To 0.01 dB, over isotropic ground 0.05: one wave stands for the steepest, which lines let pass."""
    bands = SOME_BANDS.levels.bands
    for ground, within in ((0.25, 0.01), (8.0, 0.01), ("isotropic", 0.05)):
        a3 = filters.linear_filter(SOME_BANDS, model, ground)
        for wavelength in (0.05, 0.0125):
            band = int(np.argmin(np.abs(bands.nominal - wavelength)))
            response, sees = RESPONSES.get(model), ground
            if model == filters.REMINGTON:
                response, sees = RESPONSES[filters.REMINGTON_THERE], 1.0
            expected = by_double_sum(response, sees, bands.wavelengths[band])
            assert a3[band] == pytest.approx(expected, abs=within), (ground, wavelength)


def over_all_lines(model, contact):
    """Springs read each line, and the mean of three lines is one."""
    return filter_of("linear, on the line" if model.startswith("mean of") else model, contact)


@catches("a bed that is narrower by 2/√3").at("validation.railway.cases.filters.WIDER", 3**0.5 / 2)
@catches("three lines at the edges of the contact").at("validation.railway.cases.filters.NEAR", 1.0)
@catches("one line for the mean of three").at("validation.railway.cases.filters.filter_of", over_all_lines)
def test_a_wider_bed_and_three_lines_are_the_half_space_to_second_order():
    contact = scene_of(WHEEL).contact
    x, y = 0.02 / A_X, 0.03 / A_Y
    half_space = 1 - transfer_of(LINEAR, contact)(x, y)
    for model in (filters.BED_WIDER, filters.LINES_NEAR):
        transfer, _ = filters.filter_of(model, contact)
        assert 1 - float(transfer(np.array(x), np.array(y))) == pytest.approx(half_space, rel=1e-3)


@catches("strips too narrow for oblique long waves", ground="alpha = 0.25").at(
    "validation.railway.problems.rail_across.LINES", 0.05
)
@pytest.mark.parametrize("ground", ["alpha = 0.25", "alpha = 8", "isotropic ground"])
def test_strips_are_so_wide_that_their_line_has_the_power_of_the_ground(ground):
    """Of each wave along, as over ridges: within 16 %, a half of a step across where waves are long."""
    scene = scene_of(RailWheel(50, 920))

    def power(ground):
        rail = wide_rail(scene, ground, 4, 0, 1)
        assert rail.strip.shape[1] % 2 == round(rail.width / rail.strip.spacing) % 2
        along = 2 * math.pi / rail.strip.length * np.arange(rail.strip.shape[0])
        inside = (along >= rail.strip.ground.first) & (along < 2 * rail.strip.ground.first)
        return rail.strip.variance.sum(axis=1)[inside]

    ratio = power(GROUNDS[ground]) / power("ridges")
    assert ratio.size > 5 and ratio == pytest.approx(np.ones(ratio.size), abs=0.16)


@pytest.mark.slow
@pytest.mark.parametrize("ground", ["ridges", "alpha = 0.25", "alpha = 8", "isotropic ground"])
def test_boundary_elements_both_ways_are_linear_theory_at_the_limit_of_the_standard(ground):
    """One strip on six cells: 0.05 dB where waves are long, as no single way is; 0.5 dB in the bands that count."""
    scene = scene_of(RailWheel(50, 920))
    powers = roll_both_ways(wide_rail(scene, GROUNDS[ground], 6, 0, 34))
    over = 10 * np.log10(powers[BEM] / powers[LINEAR])
    keep = filters.counted(filters.on_strips(scene, filters.linear_filter(scene, LINEAR, GROUNDS[ground])))
    assert not powers["failed"]
    assert np.abs(over[:2]).max() < 0.05 and np.abs(over[keep]).max() < 0.5


# --- what is made of band powers ---


@cache
def rolled(beyond=0.0, wheels=(WHEEL,), grounds=("ridges", "alpha = 0.25", "alpha = 0.5", "alpha = 8")):
    """Boundary elements over linear theory by so many dB, of other power on each strip; 0.2 dB more on few cells."""
    case = across.Across(wheels=wheels, across=grounds, strips=3)
    outcomes = {}
    for key in case.keys:
        for cells, more in zip(case.cells, (0.2, 0.0), strict=True):
            linear = np.ones(len(strip_bands(case.scene(key))))
            gains = [10 ** ((beyond + more + scatter) / 10) for scatter in (-0.03, 0.0, 0.03)]
            outcomes[key, cells] = [{LINEAR: linear, BEM: gain * linear, "failed": np.array(0.0)} for gain in gains]
    return across.AcrossResult(case, outcomes)


left_by_grid = rolled_filters.RolledFiltersResult.left_by_grid


def of_the_fine_cells(result, key, model, other):
    """The change from coarse cells to fine ones for what is left behind them."""
    coarse, fine = result.case.cells
    return left_by_grid(result, key, model, other) * (fine - coarse) / coarse


@catches("a change of the cells for what they leave, in contact filters").at(
    "validation.railway.cases.rolled_filters.RolledFiltersResult.left_by_grid", of_the_fine_cells
)
@catches("bands that do not count, in contact filters").at(
    "validation.railway.cases.across.counted", lambda a3: a3 < 1.0
)
def test_a_filter_over_boundary_elements_has_their_errors_in_the_bands_that_count():
    result = rolled(0.5)
    key = result.case.keys[2]
    coarse, fine = result.case.cells
    counts = np.arange(np.argmax(result.linear(key) <= filters.COUNTED))
    numbers = numbers_of(across._over_bem(result, key))
    scene = result.case.scene(key)
    for model in (LINEAR, LINEAR_ON_LINE):
        number = number_with(numbers, OVER_BEM, model)
        off = filters.linear_filter(scene, model, 0.5) - filters.linear_filter(scene, LINEAR, 0.5)
        off = filters.on_strips(scene, off)[counts] - 0.5
        each = POWER_DECIBEL * result.over_twin(key, BEM)[0].half_width_among(counts.size)
        assert number.value == pytest.approx(off[np.argmax(np.abs(off))], abs=1e-3)
        assert number.sample == pytest.approx(each) and number.tolerance == 1.0
        assert number.grid == pytest.approx(0.2 * coarse / (fine - coarse))
    (three,) = numbers_with(numbers, across.ONE_LINE)
    assert (three.tolerance, three.value) == (3.0, number.value)


beyond_linear = across.AcrossResult.beyond_linear


@catches("contact that adds to one line and not to boundary elements").at(
    "validation.railway.cases.across.AcrossResult.beyond_linear",
    lambda result, key, sign=0: -beyond_linear(result, key, sign),
)
def test_the_border_of_one_line_is_where_linear_theory_passes_the_tolerance_less_what_contact_adds():
    """By bisection of its worst band; with boundary elements 0.5 dB louder it holds farther."""
    scene = scene_of(WHEEL)
    line = filters.linear_filter(scene, LINEAR_ON_LINE, "ridges")

    def off(alpha):
        linear = filters.linear_filter(scene, LINEAR, alpha)
        return float((line - linear)[filters.counted(linear)].max())

    for beyond in (0.0, 0.5):
        low, high = 0.1, 1.0
        while high - low > 1e-4:
            middle = (low + high) / 2
            low, high = (middle, high) if off(middle) < 1.0 + beyond else (low, middle)
        borders = {
            series.model: series
            for series in across._of_wheel(rolled(beyond), WHEEL)
            if series.quantity == across.BORDER
        }
        (alpha, *_) = borders[across.WAYS[0]].values
        assert alpha.value == pytest.approx(low, rel=0.01)
        # 0.4 dB of the grid and 0.07 of the sample
        assert 0.05 < alpha.half_width < 0.2


def test_the_nearest_alpha_and_factor_are_those_by_which_the_reference_was_made():
    scene, contact = scene_of(WHEEL), scene_of(WHEEL).contact
    keep = filters.counted(filters.linear_filter(scene, LINEAR, 0.5))
    larger = replace(contact, along=1.3 * contact.along, across=1.3 * contact.across)

    def wider(factor):
        same = replace(contact, along=factor * contact.along, across=factor * contact.across)
        return across.a3_in_assessed_bands(scene, BED, 0.5, keep, same)

    def remington(alpha):
        return across.a3_in_assessed_bands(scene, filters.REMINGTON_THERE, alpha, keep)

    assert across._least_off(wider, wider(1.3))[0] == pytest.approx(1.3, rel=5e-3)
    assert across._least_off(remington, remington(1.7))[0] == pytest.approx(1.7, rel=5e-3)
    assert np.allclose(across.a3_in_assessed_bands(scene, BED, 0.5, keep, larger), wider(1.3))


G_3 = FOLDER / "railway" / "tables" / "cnossos_g3_2021.csv"


@catches("sound power of the track alone").at(
    "validation.railway.theory.sound_power.SoundTransfer.of_both",
    property(lambda transfer: transfer.of_track),
)
@catches("sound power that is not A-weighted").at(
    "validation.railway.theory.sound_power.weighting", lambda: np.zeros(24)
)
def test_sound_power_is_beside_that_by_the_filter_of_boundary_elements():
    """0.5 dB louder in bands that strips have; columns M/M and 680 mm, nearest to 360; IEC 61672 by its formula."""
    result = rolled(0.5)
    key = result.case.keys[0]
    scene = result.case.scene(key)
    bands, a3 = scene.levels.bands, filters.linear_filter(scene, LINEAR, "ridges")
    louder = 0.5 * np.isin(bands.numbers, strip_bands(scene).numbers)
    rows = [line.split(",") for line in G_3.read_text(encoding="utf-8").splitlines()[2:]]
    table = {name: np.array(column, dtype=float) for name, *column in zip(*rows, strict=True)}
    f = table["frequency [Hz]"]
    gain = 12194**2 * f**4 / ((f**2 + 20.6**2) * (f**2 + 12194**2))
    gain /= np.sqrt((f**2 + 107.7**2) * (f**2 + 737.9**2))
    weight = gain**2 * (10 ** (table["M/M"] / 10) + 10 ** (table["wheel 680"] / 10))
    (linear,) = (series for series in across._weighted(result, key) if series.model == LINEAR)
    assert tuple(linear.at) == (60, 80, 120, 160, 250)
    for speed, interval in zip(linear.at, linear.values, strict=True):
        sums = []
        for filtered in (a3, a3 + louder):
            squares = 10 ** ((np.array(scene.levels.levels) + filtered) / 10)
            at = np.log(speed / 3.6 / f)
            sums.append(weight @ np.interp(at, np.log(bands.nominal[::-1]), squares[::-1]))
        assert interval.value == pytest.approx(10 * np.log10(sums[0] / sums[1]), abs=2e-3)
        assert interval.half_width > 0


def test_borders_of_sound_power_are_where_one_line_passes_the_tolerance():
    """By bisection of the sum at 80 km/h, with boundary elements as linear theory."""
    scene, way = scene_of(WHEEL), across.AT_SPEEDS[80.0]
    line = filters.linear_filter(scene, LINEAR_ON_LINE, "ridges")

    def off(alpha):
        (over,) = filters.over_in_decibel_a(scene, line, filters.linear_filter(scene, LINEAR, alpha), (80.0,))
        return over

    low, high = 0.1, 8.0
    while high - low > 1e-3:
        middle = (low + high) / 2
        low, high = (middle, high) if off(middle) < 1.0 else (low, middle)
    (border,) = (
        series
        for series in across._of_wheel(rolled(0.0), WHEEL)
        if (series.quantity, series.model) == (across.BORDER, way)
    )
    assert border.values[0].value == pytest.approx(low, rel=0.01)
    (table,) = across_study._borders(rolled(0.0))
    assert table.columns["within [dB]"] == [1.0, 2.0] and set(table.columns) >= {"worst band", "60 km/h", "250 km/h"}


roll_one_way = rail_across._roll


@catches("strips rolled over one way alone").at(
    "validation.railway.problems.rail_across._roll", lambda rail, sign: roll_one_way(rail, 1)
)
def test_both_ways_are_the_heights_and_the_opposite_ones():
    rail, seen = wide_rail(scene_of(WHEEL), "ridges", 6, 0, 1), []
    names = ("force", "approach", "area", "residual", "operator_applications", "converged")
    rolling = bem3d.Rolling(**dict.fromkeys(names, np.ones(rail.strip.shape[0], dtype=bool)))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(bem3d, "roll", lambda surface, **_: seen.append(surface) or rolling)
        roll_both_ways(rail)
    assert np.array_equal(seen[0], -seen[1]) and seen[0].shape[1] == round(rail.width / rail.strip.spacing)


HEAVY = (150.0, 1840.0)
"""A wheel that the published table has not."""


@pytest.mark.parametrize("wheels", [(WHEEL,), (HEAVY,), (HEAVY, WHEEL), (WHEEL, HEAVY)])
def test_the_published_table_is_drawn_where_it_has_the_first_wheel(wheels):
    """A table of another wheel is no overlay of the first; all wheels of the table stay in the data."""
    evidence = across_study.CASE.evidence(rolled(0.0, wheels, ("ridges",)))
    a3, *_ = drawing("across")(evidence).axes
    crosses = [line for line in a3.lines if line.get_marker() == "x"]
    assert len(crosses) == (wheels[0] == WHEEL)
    in_data = set(evidence.table(A3).where(model=across.TABLE)["wheel"]) if WHEEL in wheels else set()
    assert in_data == {WHEEL.label} & {RailWheel(*wheel).label for wheel in wheels}
    if crosses:
        published = filters.columns_of_table()[WHEEL]
        assert dict(zip(*crosses[0].get_data(), strict=True)) == pytest.approx(published)
