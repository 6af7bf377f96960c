"""The line of isotropic ground nearest to levels: smooth levels stay, what stands out or rises too steeply is named."""

from dataclasses import replace

import numpy as np
import pytest

from tests.seeded import catches
from validation.railway.scenes import isotropic_line as graduation
from validation.railway.scenes.isotropic_line import isotropic_line
from validation.railway.scenes.level_files import RoughnessLevels, curve
from validation.railway.theory.transverse_structure import has_isotropic_surface

ISO = curve("iso3095-2013")
NOMINAL, EVEN = 1000 * ISO.bands.nominal, np.ones(35)


def levels(values):
    return RoughnessLevels(wavelengths=ISO.wavelengths, levels=tuple(np.asarray(values, dtype=float).tolist()))


STRAIGHT = levels(7 * np.log10(1000 * ISO.bands.wavelengths) - 10)


def level_of(line):
    return 10 * np.log10(ISO.bands.powers_of_spectrum(line) / 1e-12)


@catches("smooth levels that are smoothed", name="iso3095-2013").at(
    "validation.railway.scenes.isotropic_line.WHOLE_DECIBELS", -1.0
)
@pytest.mark.parametrize("name", ["iso3095-2013", "cnossos-average"])
def test_smooth_levels_stay_as_they_are_to_the_bit(name):
    smooth = curve(name)
    isotropic = isotropic_line(smooth, EVEN)
    assert isotropic.as_it_is and isotropic.line is smooth.c_line
    assert not isotropic.stands_out.any() and not isotropic.slope_error.any()


@pytest.mark.parametrize("waves", [(31.5,), (63,), (25, 20, 16), (50, 40, 31.5, 25)])
def test_a_corrugation_stands_out_alone(waves):
    peaked = levels(np.array(STRAIGHT.levels) + 6.0 * np.isin(NOMINAL, waves))
    assert not has_isotropic_surface(isotropic_line(peaked, EVEN).with_peaks)
    isotropic = isotropic_line(peaked, EVEN)
    assert NOMINAL[isotropic.stands_out].tolist() == list(waves)
    np.testing.assert_allclose(level_of(isotropic.line), STRAIGHT.levels, atol=0.02)
    np.testing.assert_allclose(level_of(isotropic.with_peaks), peaked.levels, atol=0.02)
    np.testing.assert_allclose(isotropic.deviation, 6.0 * isotropic.stands_out, atol=0.02)


graduated = graduation.graduated


def of_equal_weights(smooth):
    return replace(smooth, of_values=np.ones(len(smooth.values)))


@catches("levels of few waves that stand out as those of many").at(
    "validation.railway.scenes.isotropic_line.graduated",
    lambda *args, least: of_equal_weights(graduated(*args, least=least)),
)
def test_a_level_of_few_waves_may_be_off_by_as_much_as_few_waves_scatter():
    """8 dB are eight deviations of a level of weight one, and less than two of one of weight 1/25."""
    off = levels(np.array(STRAIGHT.levels) + 8.0 * np.isin(NOMINAL, [31.5, 200]))
    isotropic = isotropic_line(off, np.where(NOMINAL == 200, 1 / 25, 1.0))
    assert NOMINAL[isotropic.stands_out].tolist() == [31.5]


def test_a_level_below_its_neighbours_is_named_and_the_ground_keeps_theirs():
    """Ground without these waves would be smoother than its neighbours say; with a level above it has them."""
    isotropic = isotropic_line(levels(np.array(STRAIGHT.levels) - 9.0 * (NOMINAL == 31.5)), EVEN)
    assert NOMINAL[isotropic.stands_out].tolist() == [31.5]
    np.testing.assert_allclose(level_of(isotropic.with_peaks), STRAIGHT.levels, atol=0.02)


def test_lines_that_roll_off_cost_their_long_waves_alone():
    off = levels(np.array(ISO.levels) - 2.5 * np.clip(8 - np.arange(35), 0, None))
    isotropic = isotropic_line(off, EVEN)
    assert NOMINAL[isotropic.stands_out].min() >= 315 and isotropic.stands_out[:4].all()
    assert has_isotropic_surface(isotropic.line)


def test_levels_that_rise_too_steeply_are_named_and_the_ground_falls():
    steep = levels([-40.0 + 4 * i for i in range(20)] + [36.0] * 15)
    isotropic = isotropic_line(steep, EVEN)
    assert has_isotropic_surface(isotropic.line) and has_isotropic_surface(isotropic.smoother)
    assert (np.diff(isotropic.line.densities) <= 0).all()
    assert isotropic.stands_out[NOMINAL > 40].all() and not isotropic.stands_out[NOMINAL < 16].any()


@catches("few waves that weigh as much as many").at(
    "validation.railway.scenes.isotropic_line.graduated",
    lambda series, weights, *, least: graduated(series, np.ones(len(series)), least=least),
)
def test_levels_that_scatter_leave_their_scatter_and_waves_that_are_many_weigh_more():
    rng = np.random.default_rng(8)
    noise = rng.standard_normal(35)
    isotropic = isotropic_line(levels(np.array(ISO.levels) + noise), EVEN)
    assert not isotropic.as_it_is and isotropic.scatter == pytest.approx(1.0, abs=0.3)
    # the same, but the first ten bands are of few waves
    few = np.where(np.arange(35) < 10, 0.01, 1.0)
    wild = levels(np.array(ISO.levels) + noise * np.where(np.arange(35) < 10, 4.0, 1.0))
    off = [np.abs(level_of(isotropic_line(wild, w).line) - ISO.levels)[10:13].max() for w in (few, EVEN)]
    assert off[0] < off[1]


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_few_bands_have_a_line(count):
    few_levels = RoughnessLevels(wavelengths=ISO.wavelengths[15 : 15 + count], levels=(3.0, 9.0, 2.0, 1.0)[:count])
    assert has_isotropic_surface(isotropic_line(few_levels, np.ones(count)).line)
