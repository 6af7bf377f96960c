"""Error bars of levels along a rolling track, on populations with a known answer."""

import math

import numpy as np
import pytest

from tests.analysis.intervals import TRIALS, holds, t
from validation.analysis.evidence import number_with, numbers_with
from validation.analysis.series import Estimates, numbers_of
from validation.analysis.statistics import POWER_DECIBEL, log_ratio_of_means, nearest
from validation.analysis.study import Outcomes
from validation.cases.rolling import force_spectrum as rolling
from validation.cases.rolling import input_spectrum as rolling_input
from validation.cases.rolling.force_spectrum import LEVEL, MEAN, NONLINEAR, OVER, SPRINGS, VARIANCE
from validation.simulation.rolling_strip import level_3d

ROLLING = rolling.ForceSpectrum(heights=(0.1,), last=4.0, lowest=0.5, length=32.0, strips=4, refined=3, tracks=30)


def rolled(rng, *, springs=1.2, finer=0.98, scatter=0.03, case=ROLLING):
    """A result with known levels: boundary elements at linear theory, springs at `springs` times its power."""
    exact_3d = 0.01 * level_3d(case.spectrum, case.bands)
    bands = exact_3d.size

    def outcome(level, own, size):
        common = rng.lognormal(0, 0.3, (size, bands))
        mine = level * common * (1 + own * rng.standard_normal((size, bands)))
        moments = {"mean": 1 + 0.01 * rng.standard_normal(size), "linear variance": common.mean(axis=1)}
        moments["variance"] = moments["linear variance"] * (1 + 0.05 * rng.standard_normal(size))
        cross = np.stack([common * level, 0 * common])
        return {"level": mine, "linear level": level * common, "cross": cross, **moments}

    bem = outcome(exact_3d, scatter, case.strips)
    refined = {name: values[..., : case.refined, :] if values.ndim > 1 else values for name, values in bem.items()}
    refined["level"] = finer * refined["level"]
    tracks = {(n, 0.1): outcome(springs * np.maximum(exact_3d, 1e-12), 0.1, case.tracks) for n in rolling.RULES}
    return Outcomes(case, {("bem3d", 0.1): bem, ("refined", 0.1): refined, **tracks})


@pytest.mark.slow
def test_levels_of_rolling_are_powers_in_decibels():
    """10 lg of a ratio of powers: 1.2 of springs, 0.98 from one grid to the next, which are 0.98^2 to no cells."""
    rng = np.random.default_rng(0)
    result = rolled(rng, scatter=1e-9)
    region = 1.0, 4.0
    bands = np.flatnonzero(ROLLING.bands_in(*region))
    exact = 0.01 * level_3d(ROLLING.spectrum, ROLLING.bands)
    each = Estimates.ratios(result[SPRINGS, 0.1]["level"][:, bands], exact[bands])
    numbers = numbers_of(rolling.levels_at(result, 0.1))
    worst, rms = (number_with(numbers, name, SPRINGS + OVER, **{"q a": region}) for name in (LEVEL, "rms of " + LEVEL))
    at = each[list(ROLLING.bands.centres[bands]).index(worst.where["worst at"])]
    assert abs(10 * math.log10(1.2) - POWER_DECIBEL * at.value) <= 2 * POWER_DECIBEL * at.half_width
    assert worst.value == pytest.approx(POWER_DECIBEL * (at.value - 2 * math.log(0.98)), abs=1e-6)
    assert worst.grid == pytest.approx(-10 * math.log10(0.98), abs=1e-4)
    # of ratios to springs and from grid to grid, in two regions
    assert worst.sample == pytest.approx(POWER_DECIBEL * at.half_width_among(2 * 2 * len(bands)), rel=0.01)
    off = [POWER_DECIBEL * (one.value - 2 * math.log(0.98)) for one in each]
    assert rms.value == pytest.approx(math.sqrt(np.mean(np.square(off))), abs=1e-6)
    departure = number_with(numbers, NONLINEAR)
    assert departure.reference == pytest.approx(POWER_DECIBEL * 2 * math.log(0.98), abs=1e-6)
    assert departure.grid == pytest.approx(worst.grid)


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


@pytest.mark.parametrize("strips", [3, 6])
def test_variance_and_mean_of_the_rolling_force_cover_their_truth(strips):
    """Both are of a few strips beside many tracks; the intervals of both variances hold at once."""
    rng = np.random.default_rng(strips)
    shares = np.zeros(2)
    for _ in range(TRIALS):
        outcomes = [
            {
                "linear variance": (linear := rng.lognormal(0, 0.2, n)),
                "variance": 1.1 * linear * (1 + 0.05 * rng.standard_normal(n)),
                "mean": 1.0 + 0.01 * rng.standard_normal(n),
            }
            for n in (strips, 40)
        ]
        found = {("bem3d", 0.1): outcomes[0], (SPRINGS, 0.1): outcomes[1]}
        single = numbers_of(rolling.moments_at(Outcomes(ROLLING, found), 0.1))
        numbers = [*numbers_with(single, VARIANCE), number_with(single, MEAN)]
        truths = (1.1, 1.1, numbers[2].reference)
        bem, springs, mean = (abs(n.value - truth) <= n.sample for n, truth in zip(numbers, truths, strict=True))
        shares += [bem and springs, mean]
    assert all(holds(share, short=0.01, wide=0.01) for share in shares / TRIALS)


def test_an_interval_of_a_ratio_is_that_of_its_logarithm_times_the_ratio():
    """MDR over boundary elements as a part: exp(x) - 1, whose interval is exp(x) times that of x."""
    case = rolling_input.RollingInput(surfaces=20, profiles=30)
    rng = np.random.default_rng(0)
    punches = {"stiffness": 1 + 0.1 * rng.standard_normal((20, len(case.forces)))}
    springs = {"stiffness": 3 + 0.1 * rng.standard_normal((30, len(case.forces)))}
    profiles = dict.fromkeys(rolling_input.INPUT_SPECTRA, springs | {"height": np.array(1.0)})
    numbers = numbers_of(rolling_input.punches_of(Outcomes(case, {**profiles, "punches": punches})))
    number = numbers[0]
    assert number.value == pytest.approx(2.0, rel=0.1)
    level = nearest(case.forces, 0.1)
    relative = math.hypot(
        *(
            x[:, level].std(ddof=1) / x[:, level].mean() / math.sqrt(len(x))
            for x in (*springs.values(), *punches.values())
        )
    )
    assert number.sample == pytest.approx(t(25) * (1 + number.value) * relative, rel=0.06)
