"""Error bars of levels along a rolling track, on populations with a known answer."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.analysis.intervals import TRIALS, holds
from tests.seeded import catches
from validation.analysis import statistics
from validation.analysis.case import Outcomes
from validation.analysis.evidence import number_with
from validation.analysis.series import Estimates, numbers_of
from validation.analysis.statistics import POWER_DECIBEL, log_ratio_of_means
from validation.cases.rolling import force_spectrum as rolling
from validation.cases.rolling.force_spectrum import OVER, RMS_LEVEL, SPRINGS, octaves_of
from validation.simulation.model_names import SPRINGS_ROLLING
from validation.simulation.rolling_strip import level_3d

ROLLING = rolling.ForceSpectrum(heights=(0.1,), last=4.5, lowest=0.5, length=32.0, strips=4, refined=3, tracks=30)


def rolled(rng, *, springs=1.2, finer=0.98, case=ROLLING):
    """Levels of boundary elements that are those of linear theory, springs at `springs` times their power."""
    exact = 0.01 * level_3d(case.spectrum, case.bands)

    def outcome(level, own, size):
        common = rng.lognormal(0, 0.3, (size, exact.size))
        mine = level * common * (1 + own * rng.standard_normal((size, exact.size)))
        return {"level": mine, "linear level": level * common}

    bem = outcome(exact, 1e-9, case.strips)
    refined = {"level": finer * bem["level"][: case.refined]}
    tracks = outcome(springs * exact, 0.1, case.tracks)
    of_springs = {(model, 0.1): tracks for model in (SPRINGS, SPRINGS_ROLLING)}
    return Outcomes(case, {(rolling.BEM, 0.1): bem, (rolling.REFINED, 0.1): refined, **of_springs})


@catches("decibels of an amplitude for those of a power, in rolling").at(
    "validation.cases.rolling.force_spectrum.POWER_DECIBEL", statistics.DECIBEL
)
def test_levels_of_rolling_are_powers_in_decibels():
    """10 lg of a ratio of powers: 1.2 of springs, 0.98 from one grid to the next, which are 0.98^2 to no cells."""
    result = rolled(np.random.default_rng(0))
    octaves = octaves_of(ROLLING.bands, ROLLING.spectrum)
    assert octaves.shape == (2, 3) and (np.diff(octaves.ravel()) == 1).all()
    springs, exact = result[SPRINGS, 0.1]["level"], 0.01 * level_3d(ROLLING.spectrum, ROLLING.bands)
    each = Estimates.ratios(springs[:, octaves].sum(axis=2), exact[octaves].sum(axis=1))
    number = number_with(numbers_of(rolling._levels(result, 0.1)), RMS_LEVEL, SPRINGS + OVER)
    off = [POWER_DECIBEL * (one.value - 2 * math.log(0.98)) for one in each]
    assert number.value == pytest.approx(math.sqrt(np.mean(np.square(off))), abs=1e-6)
    assert abs(10 * math.log10(1.2 / 0.98**2) - number.value) <= 2 * number.sample
    assert number.grid == pytest.approx(-10 * math.log10(0.98), abs=1e-4)
    halves = [POWER_DECIBEL * one.half_width for one in each]
    assert number.sample == pytest.approx(math.sqrt(np.mean(np.square(halves))), rel=0.01)


def unpaired(values, references, weights):
    """The ratio of two means as if each were of realisations of its own."""
    mine, other = (statistics.log_ratio_of_means(x, np.ones(x.shape[1]), weights) for x in (values, references))
    return replace(mine.minus(other), samples=mine.samples)


@catches("two standard errors of a sample of four", strips=4).at(
    "validation.analysis.statistics.Estimate.half_width", property(lambda estimate: 2 * estimate.error)
)
@catches("pairs of strips taken for independent ones", strips=4).at(f"{__name__}.log_ratio_of_means", unpaired)
@pytest.mark.parametrize("strips", [4, 6])
def test_ratios_of_levels_cover_their_truth(strips):
    """ln of 1.5, in the mean over bands of unequal scatter that share their surfaces; a row that is lost counts not."""
    rng, weights, covered = np.random.default_rng(strips), np.array([0.5, 0.5, 0.0]), 0
    for _ in range(TRIALS):
        linear = rng.lognormal(0, 0.3, (strips + 1, 3)) * [1.0, 10.0, 0.0]
        levels = 1.5 * linear * (1 + [0.1, 0.02, 0.1] * rng.standard_normal(linear.shape))
        levels[-1] = np.nan
        estimate = log_ratio_of_means(levels, linear, weights)
        assert estimate.samples == strips
        covered += abs(estimate.value - math.log(1.5)) <= estimate.half_width
    assert holds(covered / TRIALS, short=0.02)
