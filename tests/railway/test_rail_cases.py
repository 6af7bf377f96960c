"""The wheel on a rail: published contact and table, filters of the field, and what a strip must give."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.railway.power_law_ground import power_law_ground
from tests.seeded import Times, catches
from validation.analysis.spectra import Bands
from validation.analysis.statistics import POWER_DECIBEL
from validation.railway.cases import filters, rolled_filters, rough_rail
from validation.railway.problems import equivalent_displacement as displacement
from validation.railway.problems.rail_strip import RailStrip, line_of, strip_bands
from validation.railway.theory.transverse_structure import IsotropicGround
from validation.simulation.model_names import BEM, LINEAR, LINEAR_ON_LINE, SPRINGS_THAT_READ

WHEEL = filters.RailWheel(50, 920)
SMALL = {"length": 0.12, "width": 0.04, "spacing": 1e-3, "realisation": 0, "seed": 3}


def strip_of(across, rms=1e-9):
    ground = power_law_ground(rms, 2 * math.pi / 0.06, 2 * math.pi / 4e-3, across)
    return RailStrip(ground=ground, radii=(0.46, 0.3), force=5e4, modulus=filters.STEEL, **SMALL)


def test_published_table_has_five_columns_of_all_bands():
    table, nominal = filters.columns_of_table(), 1000 * filters.scene_of(WHEEL).levels.bands.nominal
    assert len(table) == 5
    for wheel, column in table.items():
        assert np.allclose(list(column), nominal, rtol=1e-12), wheel


REAL_SCENE = filters.scene_of


@catches("the load of an axle for that of a wheel").at(
    "validation.railway.cases.filters.scene_of", lambda wheel: REAL_SCENE(wheel._replace(load=2 * wheel.load))
)
def test_linear_theory_of_the_ellipse_over_isotropic_ground_is_the_published_table_within_a_decibel():
    """Where the table follows a linear filter and is no rounded zero, without what may be a misprint at 40 mm."""
    for wheel, column in filters.columns_of_table().items():
        table = np.array(list(column.values()))
        keep = (table >= -13) & (table <= -0.1) & ~((wheel == WHEEL) & (np.array(list(column)) == 40))
        deviation = filters.linear_filter(filters.scene_of(wheel), LINEAR, "isotropic") - table
        assert np.sqrt(np.mean(deviation[keep] ** 2)) < 1.0, wheel


@catches("a wheel that bumps let down").at(
    "validation.railway.problems.equivalent_displacement.lifted", lambda approach: approach - np.mean(approach)
)
def test_a_strip_of_ridges_has_the_filter_of_a_row_of_springs_in_boundary_elements():
    strip = strip_of("ridges")
    rolled = displacement.roll_rail(displacement.RolledRail(strip=strip, models=(BEM,), tolerance=1e-9))
    expected = strip.along_middle(displacement.transfer_of(LINEAR_ON_LINE, strip.contact))
    # six cells to the semi-axis: the error of the grid is a twentieth of the track
    assert np.abs(rolled[BEM] - expected).max() < 0.05 * np.abs(expected).max()


@catches("a strip with half of its power").at("validation.railway.problems.rail_strip.RailStrip.variance", Times(0.5))
def test_line_of_a_drawn_strip_has_the_rms_of_its_ground():
    for across in ("ridges", "isotropic"):
        strip = strip_of(across, rms=2e-6)
        # waves of a strip of two longest waves, in place of an integral: the first counts whole
        assert strip.surface.std() == pytest.approx(2e-6, rel=0.2)


@catches("one line for the mean of heights").at(
    "validation.railway.cases.rough_rail.mean_of_lines",
    lambda places: lambda along, across: np.ones_like(along + across),
)
def test_mean_of_heights_over_ridges_is_one_line_and_over_isotropic_ground_less():
    """Of three lines 10 mm apart, at 16 mm, by the mean of cos(k_y y) over isotropic waves: a plain sum over k_y."""
    case = rough_rail.RoughRail()
    by_place = {tuple(series.where.values()): series for series in rough_rail.means_of_lines(case) if series.where}
    np.testing.assert_allclose(by_place[rough_rail.RIDGES, 10.0].values, 0.0, atol=1e-9)
    over_isotropic, scene = by_place[rough_rail.GROUND, 10.0], case.scene(case.keys[0])
    c2d = IsotropicGround(line_of(scene)).c2d
    at = over_isotropic.at.tolist().index(16.0)
    edges = 2 * math.pi / 0.016 * 10 ** np.array([-0.05, 0.05])
    k_x = np.linspace(*edges, 40)[:, np.newaxis]
    k_y = np.linspace(0, 40, 8001)[1:] * k_x
    density = c2d(np.hypot(k_x, k_y)) * k_x
    mean = (1 + 2 * np.cos(0.01 * k_y)) / 3
    expected = 10 * np.log10(np.sum(density * mean**2) / np.sum(density))
    assert over_isotropic.values[at] == pytest.approx(expected, abs=0.1)
    assert expected < -3


@pytest.mark.slow
def test_springs_on_few_cells_have_the_filter_near_its_zero_of_many():
    """The shortest band that counts over ridges: to and fro by tenths of a decibel where a spring is a cell."""
    key = filters.RailWheel(50.0, 680.0), 0.0, "ridges"
    case = rolled_filters.RolledFilters(wheels=((50.0, 680.0),), across=("ridges",), strips=3, cells=(8, 12))
    scene = case.scene(key)
    bands, at = Bands(tuple(strip_bands(scene).edges.tolist())), strip_bands(scene).nominal.tolist().index(0.0125)

    def over_twin(cells):
        problems = [replace(problem, models=(SPRINGS_THAT_READ,)) for problem in case.problems(key, cells)]
        outcomes = [displacement.roll_rail(problem) for problem in problems]
        return displacement.log_over(SPRINGS_THAT_READ, LINEAR, outcomes, problems[0].strip.spacing, bands)[at].value

    assert POWER_DECIBEL * abs(over_twin(8) - over_twin(12)) < 0.1
