"""The wheel on a rail: published contact and table, filters of the field, and what a strip must give."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.cases.planted import judged
from tests.simulation.power_law_ground import power_law_ground
from validation.analysis.evidence import Verdict
from validation.analysis.spectra import Bands
from validation.analysis.statistics import POWER_DECIBEL
from validation.cases.rail import ellipse, filters, line_convention, rolled_filters
from validation.engine.engine import SERIAL
from validation.simulation import equivalent_displacement as displacement
from validation.simulation.model_names import BEM, LINEAR, LINEAR_ON_LINE, SPRINGS_THAT_READ
from validation.simulation.rail_strip import RailStrip, strip_bands

WHEEL = filters.RailWheel(50, 920)
SMALL = {"length": 0.12, "width": 0.04, "spacing": 1e-3, "realisation": 0, "seed": 3}


def strip_of(across, rms=1e-9):
    ground = power_law_ground(rms, 2 * math.pi / 0.06, 2 * math.pi / 4e-3, across)
    return RailStrip(ground=ground, radii=(0.46, 0.3), force=5e4, modulus=filters.STEEL, **SMALL)


def test_contact_of_the_program_contact_is_reproduced():
    result = ellipse.run(ellipse.Ellipse(cells=(16, 32), crowns=(0.3, 0.46)), SERIAL)
    for quantity in ellipse.CONTACT:
        found = [number.verdict for number in judged(ellipse.STUDY, result, quantity)]
        assert found == [Verdict.AGREE, Verdict.AGREE]


def test_circle_is_right_where_both_radii_are_equal_and_wrong_by_two_decibels_on_a_crown_of_300_mm():
    case = ellipse.Ellipse()
    wave = filters.scene_of(WHEEL).levels.bands.nominal == 0.016
    for crown, excess in ((0.46, 0.0), (0.3, 2.3)):
        mine, circle = ellipse.circle_excess(case, crown, "isotropic")
        assert float((circle - mine)[wave][0]) == pytest.approx(excess, abs=0.1)


def test_published_table_has_five_columns_of_all_bands():
    table, nominal = filters.columns_of_table(), 1000 * filters.scene_of(WHEEL).levels.bands.nominal
    assert len(table) == 5
    for wheel, column in table.items():
        assert np.allclose(list(column), nominal, rtol=1e-12), wheel


def test_linear_theory_of_the_ellipse_over_isotropic_ground_is_the_published_table_within_a_decibel():
    """Where the table follows a linear filter and is no rounded zero, without what may be a misprint at 40 mm."""
    for wheel, column in filters.columns_of_table().items():
        table = np.array(list(column.values()))
        keep = (table >= -13) & (table <= -0.1) & ~((wheel == WHEEL) & (np.array(list(column)) == 40))
        found = filters.linear_filter(filters.scene_of(wheel), LINEAR, "isotropic") - table
        assert np.sqrt(np.mean(found[keep] ** 2)) < 1.0, wheel


def test_a_strip_of_ridges_has_the_filter_of_a_row_of_springs_in_boundary_elements():
    strip = strip_of("ridges")
    rolled = displacement.roll_rail(displacement.RolledRail(strip=strip, models=(BEM,), tolerance=1e-9))
    expected = strip.along_middle(displacement.transfer_of(LINEAR_ON_LINE, strip.contact))
    # six cells to the semi-axis: the error of the grid is a twentieth of the track
    assert np.abs(rolled[BEM] - expected).max() < 0.05 * np.abs(expected).max()


def test_line_of_a_drawn_strip_has_the_rms_of_its_ground():
    for across in ("ridges", "isotropic"):
        strip = strip_of(across, rms=2e-6)
        # waves of a strip of two longest waves, in place of an integral: the first counts whole
        assert strip.surface.std() == pytest.approx(2e-6, rel=0.2)


def test_mean_of_heights_over_ridges_is_one_line_and_over_isotropic_ground_less():
    result = line_convention.run(line_convention.LineConvention(strips=3), SERIAL)
    ridges, isotropic = (
        judged(line_convention.STUDY, result, line_convention.HEIGHTS, across=ground)
        for ground in (line_convention.RIDGES, line_convention.ISOTROPIC)
    )
    assert len(ridges) == 2 and all(number.verdict is Verdict.AGREE for number in ridges)
    assert len(isotropic) == 2 and all(number.value < -3 for number in isotropic)


@pytest.mark.slow
def test_springs_on_few_cells_have_the_filter_near_its_zero_of_many():
    """The shortest band that counts over ridges: to and fro by tenths of a decibel where a spring is a cell."""
    key = filters.RailWheel(50.0, 680.0), 0.0, "ridges"
    case = rolled_filters.RolledFilters(wheels=((50.0, 680.0),), across=("ridges",), strips=3, cells=(8, 12))
    scene = case.scene(key)
    bands, at = Bands(tuple(strip_bands(scene).edges.tolist())), strip_bands(scene).nominal.tolist().index(0.0125)

    def over_twin(cells):
        problems = [replace(one, models=(SPRINGS_THAT_READ,)) for one in case.problems(key, cells)]
        found = [displacement.roll_rail(one) for one in problems]
        return displacement.log_over(SPRINGS_THAT_READ, LINEAR, found, problems[0].strip.spacing, bands)[at].value

    assert POWER_DECIBEL * abs(over_twin(8) - over_twin(12)) < 0.1
