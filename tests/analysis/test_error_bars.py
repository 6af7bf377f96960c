"""Error bars on populations with a known answer: each kind covers the truth in 95 of 100, and says what it is of.

Shares are held to four standard deviations of a binomial count. Seeds are fixed.
"""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy import stats

from tests.cases.test_limits import STEEP
from validation.analysis.evidence import table_of
from validation.analysis.multilevel import Linearised
from validation.analysis.statistics import (
    DECIBEL,
    POWER_DECIBEL,
    Estimate,
    at_level,
    difference_of_halves,
    extrapolated,
    jackknife_error,
    log_mean,
    log_ratio_of_means,
    log_relative_deviation,
    mean_estimate,
    mean_of,
    nearest,
    paired_samples,
    ratio_of_means,
    sample,
    student,
)
from validation.benchmarks.work_precision.errors import MethodValues, error
from validation.benchmarks.work_precision.problem import Quantity, logarithm
from validation.cases.limits.numbers import exponent_number, threshold_number
from validation.cases.limits.sweep import Sweep, swept
from validation.cases.punch import fractal_punch_decades
from validation.cases.punch.area_gap_rolloff_numbers import RollOffSamples
from validation.cases.punch.ensembles import interval_columns
from validation.cases.rolling import force_spectrum as rolling
from validation.cases.rolling import force_spectrum_numbers as rolling_numbers
from validation.cases.rolling import input_spectrum as rolling_input
from validation.cases.rolling.force_spectrum_levels import SPRINGS, LevelsAtHeight, level_3d
from validation.cases.rolling.input_spectrum_numbers import punch_number
from validation.cases.selection.model_selection_evidence import clopper_pearson
from validation.cases.stability import long_runs
from validation.cases.wheel import distance as wheel_distance
from validation.cases.wheel import distance_numbers, spectrum_numbers
from validation.cases.wheel import features as wheel_features
from validation.cases.wheel import half_space as wheel_3d
from validation.cases.wheel import half_space_levels as wheel_3d_levels
from validation.cases.wheel.features import FLOOR, Spectrum, measured
from validation.simulation.rough_punch import BEM, MDR

TRIALS = 600
"""Of which 95 % are known to 0.9 %."""


def binomial(trials, share=0.95):
    """Four standard deviations of a share."""
    return 4 * math.sqrt(share * (1 - share) / trials)


def covered(draw, truth, *, trials=TRIALS):
    """The share of intervals (value, half-width) that hold the truth."""
    return sum(abs(value - truth) <= half for value, half in (draw() for _ in range(trials))) / trials


def holds(share, *, trials=TRIALS, short=0.0, wide=0.0):
    """95 % within the scatter of a count; short, wide: what an approximate interval may lack, or have too much."""
    return 0.95 - binomial(trials) - short <= share <= min(0.95 + binomial(trials) + wide, 1.0)


def ends(estimate):
    return estimate.value, estimate.half_width


def t(samples):
    return stats.t.ppf(0.975, samples - 1)


# --- of a mean, of a ratio, of a difference ---


@pytest.mark.parametrize("size", [2, 3, 5, 30])
def test_the_interval_of_a_mean_is_students(size):
    rng = np.random.default_rng(size)
    assert holds(covered(lambda: ends(mean_estimate(3 + 0.5 * rng.standard_normal(size))), 3.0))


@pytest.mark.parametrize("size", [3, 6, 20])
def test_the_interval_of_a_ratio_of_means_is_students(size):
    """x = 2 y + noise: what they share drops out, and n - 1 degrees of freedom are left. y scatters as forces do."""
    rng = np.random.default_rng(size)

    def drawn():
        y = 5 * rng.lognormal(0, 0.3, size)
        return ends(ratio_of_means(2 * y + rng.standard_normal(size), y))

    assert holds(covered(drawn, 2.0))


def test_lost_realisations_count_neither_in_a_mean_nor_in_a_ratio():
    x, y = np.array([1.0, 2.0, np.nan, 4.5]), np.array([2.0, 3.0, 100.0, 5.0])
    for one, other in (
        (mean_estimate(x), mean_estimate(x[[0, 1, 3]])),
        (ratio_of_means(x, y), ratio_of_means(x[[0, 1, 3]], y[[0, 1, 3]])),
    ):
        assert one == other
        assert one.samples == 3
    assert ratio_of_means(x, y).value == pytest.approx(7.5 / 10)


def test_what_values_share_with_their_references_is_no_error_of_their_ratio():
    y = np.random.default_rng(0).lognormal(0, 0.5, 8)
    assert ratio_of_means(3 * y, y).error < 1e-15


@pytest.mark.parametrize(("sizes", "spreads"), [((4, 30), (1.0, 0.1)), ((5, 6), (1.0, 1.0)), ((3, 40), (0.3, 1.0))])
def test_the_interval_of_a_difference_is_that_of_welch(sizes, spreads):
    rng = np.random.default_rng(sizes[0])

    def drawn():
        one, other = (
            mean_estimate(m + s * rng.standard_normal(n)) for m, s, n in zip((5, 2), spreads, sizes, strict=True)
        )
        return ends(one.minus(other))

    assert holds(covered(drawn, 3.0), short=0.01, wide=0.02)


@pytest.mark.parametrize("spreads", [(1.0, 1.0, 1.0), (1.0, 0.05, 0.05)])
def test_the_interval_of_a_mean_of_estimates(spreads):
    """Where one of them scatters most, its degrees of freedom are all that there are; Welch errs to the safe side."""
    rng = np.random.default_rng(3)

    def drawn():
        return ends(mean_of([mean_estimate(1 + s * rng.standard_normal(4)) for s in spreads]))

    assert holds(covered(drawn, 1.0), wide=0.03)


def test_a_mean_of_equal_estimates_has_their_degrees_of_freedom_together():
    """Seven of n - 1 each, and not 7 n - 1."""
    together = mean_of([Estimate(2.0, 0.1, 4)] * 7)
    assert together.samples == 7 * 3 + 1
    assert together.error == pytest.approx(0.1 / math.sqrt(7))


def test_an_error_that_is_not_known_stays_unknown():
    both = Estimate(1.0, 0.1, 9).minus(Estimate(1.0, math.nan, 4))
    assert math.isnan(both.error) and both.samples == 4


def test_estimates_without_error_have_no_interval():
    assert Estimate(2.0, 0.0, 3).minus(Estimate(1.0, 0.0, 4)).half_width == 0.0


def test_an_interval_is_half_a_width_either_way():
    value, low, high = Estimate(5.0, 0.3, 8).interval
    assert (high - value, value - low) == pytest.approx((Estimate(5.0, 0.3, 8).half_width,) * 2)
    assert high - value == pytest.approx(stats.t.interval(0.95, 7, scale=0.3)[1])


# --- resampled, left out ---


@pytest.mark.parametrize("size", [3, 4, 6, 12])
def test_the_bootstrap_has_the_standard_error_of_a_mean(size):
    """s / sqrt(n), of the sample at hand; 999 resamples know it to 2.2 %, forty samples of them to 0.4 %."""
    rng = np.random.default_rng(size)

    def over_exact():
        draws = 1 + 0.2 * rng.standard_normal((size, 1))
        return sample(draws, rng).estimate(at_level(0, lambda mean, _: mean)).error / (
            draws.std(ddof=1) / math.sqrt(size)
        )

    assert np.mean([over_exact() for _ in range(40)]) == pytest.approx(1, abs=4 * 0.022 / math.sqrt(40))


@pytest.mark.slow
@pytest.mark.parametrize(("size", "short"), [(3, 0.0), (6, 0.02)])
def test_the_bootstrap_covers_in_small_samples(size, short):
    """Of pairs of grids there are few."""
    rng = np.random.default_rng(size)

    def drawn():
        return ends(sample(1 + 0.2 * rng.standard_normal((size, 1)), rng).estimate(at_level(0, log_mean)))

    assert holds(covered(drawn, 0.0, trials=300), trials=300, short=short)


@pytest.mark.slow
@pytest.mark.parametrize(("size", "sigma"), [(12, 0.3), (40, 0.3)])
def test_the_bootstrap_covers_log_normal_populations(size, sigma):
    """Skewed: a few are lacking, more of them of the deviation."""
    rng = np.random.default_rng(size)
    truth = {log_mean: sigma**2 / 2, log_relative_deviation: math.log(math.expm1(sigma**2)) / 2}
    draws = [sample(rng.lognormal(0, sigma, (size, 1)), rng) for _ in range(200)]
    for statistic, short in ((log_mean, 0.0), (log_relative_deviation, 0.06)):
        found_ = iter([ends(one.estimate(at_level(0, statistic))) for one in draws])
        share = covered(lambda found_=found_: next(found_), truth[statistic], trials=200)
        assert holds(share, trials=200, short=short)


@pytest.mark.slow
@pytest.mark.parametrize(("statistic", "size"), [(log_mean, 6), (log_relative_deviation, 30)])
def test_an_interval_shrinks_with_the_root_of_the_sample_and_its_quantile(statistic, size):
    """To four times the sample: half of the standard error, and Student's quantile of either."""
    rng = np.random.default_rng(2)

    def mean_width(size):
        draws = (1 + 0.2 * rng.standard_normal((size, 1)) for _ in range(60))
        return np.mean([sample(one, rng).estimate(at_level(0, statistic)).half_width for one in draws])

    assert mean_width(size) / mean_width(4 * size) == pytest.approx(2 * t(size) / t(4 * size), rel=0.1)


def test_leaving_out_one_is_the_standard_error_of_a_mean():
    x = np.random.default_rng(0).standard_normal((7, 3))
    without = [np.delete(x, i, axis=0).mean(axis=0) for i in range(7)]
    np.testing.assert_allclose(jackknife_error(without), x.std(axis=0, ddof=1) / math.sqrt(7), rtol=1e-12)


@pytest.mark.parametrize(("size", "own"), [(3, 0.1), (6, 0.3)])
def test_the_interval_of_a_logarithm_of_a_ratio_covers_its_truth(size, own):
    """Of strips in pairs, over two bands: what both share drops out, the rest is jackknifed; skew costs a little."""
    rng, weights = np.random.default_rng(size), np.array([0.5, 0.0, 0.5])

    def drawn():
        linear = rng.lognormal(0, 0.5, (size, 3))
        values = 1.3 * linear * rng.lognormal(-(own**2) / 2, own, (size, 3))
        return ends(log_ratio_of_means(values, linear, weights))

    assert holds(covered(drawn, math.log(1.3)), short=0.03)


# --- pairs of grids ---


def test_what_extrapolation_leaves_open_is_half_of_its_way_and_the_interval_of_all_of_it():
    """To cells of no size it is twice the change from one grid to the next."""
    coarse, finer = Estimate(1.0, 0.2, 20), Estimate(-0.1, 0.03, 4)
    value, left = extrapolated(coarse, finer)
    assert value == Estimate(0.8, 0.2, 20)
    assert left == pytest.approx(0.1 + 2 * t(4) * 0.03)
    assert extrapolated(coarse, finer, among=5)[1] == pytest.approx(0.1 + 2 * stats.t.ppf(0.995, 3) * 0.03)


def on_grids(rng, surfaces, slope=0.1, scatter=0.02):
    """Stiffness on cells of size 1 and 1/2 of surfaces whose error is of first order, their own slope each."""
    true = 1 + 0.1 * rng.standard_normal((surfaces, 1))
    own = slope + scatter * rng.standard_normal((surfaces, 1))
    return true * np.exp(own), true * np.exp(own / 2)


@pytest.mark.slow
@pytest.mark.parametrize("refined", [3, 6])
def test_sample_and_grid_together_hold_cells_of_no_size(refined):
    """Few of twelve surfaces on the finer grid: added as if they went the same way, the two hold more than 95 %."""
    rng = np.random.default_rng(refined)

    def drawn():
        coarse, fine = on_grids(rng, 12)
        value, left = extrapolated(
            sample(coarse, rng).estimate(at_level(0, log_mean)),
            paired_samples(coarse[:refined], fine[:refined], rng).estimate(difference_of_halves(at_level(0, log_mean))),
        )
        return value.value, value.half_width + left

    assert covered(drawn, 0.0, trials=200) >= 0.95


@pytest.mark.slow
def test_what_a_grid_leaves_open_shrinks_with_the_cells_and_with_the_surfaces():
    rng = np.random.default_rng(5)

    def left(surfaces, **changes):
        coarse, fine = on_grids(rng, surfaces, **changes)
        finer = paired_samples(coarse, fine, rng).estimate(difference_of_halves(at_level(0, log_mean)))
        return extrapolated(Estimate(0.0, 0.0, 9), finer)[1]

    # cells half as wide, all alike: half of it
    assert left(5, scatter=0.0, slope=0.05) == pytest.approx(left(5, scatter=0.0) / 2)
    # surfaces that differ: the root of their number, and Student's quantile
    few, many = (np.mean([left(n, slope=0.0) - 0.01 / math.sqrt(n) for _ in range(60)]) for n in (4, 16))
    assert few / many == pytest.approx(2 * t(4) / t(16), rel=0.2)


def steps(*values, error=0.01, n=50):
    """A statistic on grids, coarse to fine, from the same realisations; the steps between grids have no error."""
    influence = np.zeros(n)
    influence[:2] = error / math.sqrt(2)
    return {8 * 2**i: Linearised(value, influence) for i, value in enumerate(values)}


def compared(bem, springs, *, name="mean stiffness", among=4):
    resolved = fractal_punch_decades.on_finest(springs), fractal_punch_decades.extrapolated(bem)
    return fractal_punch_decades.PointComparison(name, 0.7, 0.1, *resolved, among=among).number


def test_the_grid_interval_of_fig_14_1():
    """Cells of no size lie f beyond the finest grid by the two finest, and c beyond the middle one by the next two:
    what both differ by, and what doubling the springs changes. Nothing of that is the sample's."""
    number = compared(steps(0.2, 0.25, 0.27), steps(0.504, 0.5))
    assert number.grid == pytest.approx(DECIBEL * (abs(2 * 0.02 - 0.05) + 0.004))
    assert number.value == pytest.approx(DECIBEL * (0.5 - 0.27 - 0.02))
    for worse in (
        compared(steps(0.2, 0.24, 0.27), steps(0.504, 0.5)),
        compared(steps(0.1, 0.25, 0.27), steps(0.504, 0.5)),
        compared(steps(0.2, 0.25, 0.27), steps(0.51, 0.5)),
    ):
        assert worse.grid > number.grid
        assert worse.sample == number.sample
    exponent = compared(steps(0.2, 0.25, 0.27), steps(0.504, 0.5), name="exponent")
    assert (exponent.grid, exponent.value) == pytest.approx((0.014, 0.21))


def test_the_sample_interval_of_fig_14_1():
    """Root of the sum of squares of surfaces and profiles, at once for all forces of the decade."""
    one, four = (compared(steps(0.2, 0.25, 0.27), steps(0.5, 0.5, error=0.02), among=n) for n in (1, 4))
    freedom = Linearised(0.0, np.array([0.02, 0.02, 0.01, 0.01])).freedom
    assert one.sample == pytest.approx(DECIBEL * student(freedom) * math.hypot(0.01, 0.02))
    assert four.sample / one.sample == pytest.approx(student(freedom, 1 - 0.05 / 4) / student(freedom))


def test_intervals_of_where_mdr_must_fail():
    """Area, gap and stiffness in decibels; on the page as ratios about their value, the gap over h."""
    rng = np.random.default_rng(1)
    coarse, fine = on_grids(rng, 12)
    other = 2.0 + 0.2 * rng.standard_normal((40, 1))
    mine = RollOffSamples(
        1,
        {(BEM, "gap"): sample(coarse, rng), (MDR, "gap"): sample(other, rng)},
        {"gap": np.stack([coarse[:4], fine[:4]], axis=1)},
    )
    statistic = at_level(0, log_mean)
    number = mine.over_bem("mean gap", "gap", statistic, 0.1, among=3)
    change = np.log([np.delete(fine[:4], i).mean() / np.delete(coarse[:4], i).mean() for i in range(4)])
    finer = Estimate(float(np.log(fine[:4].mean() / coarse[:4].mean())), float(jackknife_error(change)), 4)
    bem, springs = (mine.by_method[method, "gap"].estimate(statistic) for method in (BEM, MDR))
    assert number.grid == pytest.approx(DECIBEL * (abs(finer.value) + 2 * finer.half_width))
    assert number.sample == pytest.approx(DECIBEL * springs.minus(bem).half_width_among(3))
    assert number.value == pytest.approx(DECIBEL * (springs.value - bem.value - 2 * finer.value))
    row = interval_columns("gap", bem, lambda log: math.exp(log) / 1e-3)
    assert row["gap"] == pytest.approx(1e3 * coarse.mean())
    assert row["gap high"] / row["gap"] == pytest.approx(row["gap"] / row["gap low"])
    assert math.log(row["gap high"] / row["gap"]) == pytest.approx(bem.half_width)


# --- speed against accuracy ---

MEAN = Quantity(name="mean", log=logarithm("k"), needs=("k",))
LEVEL = Quantity(name="level", log=logarithm("k"), needs=("k",), decibel=True)


@pytest.mark.slow
@pytest.mark.parametrize(("size", "short"), [(4, 0.0), (12, 0.0)])
@pytest.mark.parametrize("paired", [True, False])
@pytest.mark.parametrize("quantity", [MEAN, LEVEL])
def test_the_error_of_an_answer_covers_its_truth(size, short, paired, quantity):
    """1.5 times the reference: the distance |ratio - 1| or 10 lg of it. Alone, hypot of two quantiles is wide."""
    rng = np.random.default_rng(size)
    truth = 0.5 if quantity is MEAN else 10 * math.log10(1.5)

    def drawn():
        reference = 1 + 0.1 * rng.standard_normal(size)
        own = reference if paired else 1 + 0.1 * rng.standard_normal(size)
        mine = 1.5 * own * (1 + 0.05 * rng.standard_normal(size))
        one = error(quantity, MethodValues({"k": mine}, paired=paired), MethodValues({"k": reference}))
        return one.value, one.half_width

    assert holds(covered(drawn, truth, trials=400), trials=400, short=short, wide=0.0 if paired else 0.04)


@pytest.mark.parametrize("paired", [True, False])
def test_the_error_of_an_answer_has_the_quantile_of_its_sample(paired):
    """Of a mean of n: t s / sqrt(n) over the mean of the reference, on both sides where they are not paired."""
    x = np.random.default_rng(0).lognormal(0, 0.1, 5)
    exact = {"k": np.full(5, 2.0)}
    one = error(MEAN, MethodValues({"k": x}, paired=paired), MethodValues(exact))
    assert one.half_width == pytest.approx(t(5) * x.std(ddof=1) / math.sqrt(5) / 2)
    # half of it extrapolated the same way leaves the same; twice the change leaves more
    more = error(MEAN, MethodValues({"k": x}, {"k": np.full(5, 1.0)}, 2.0, paired=paired), MethodValues(exact))
    assert more.half_width > 1.5 * one.half_width


def test_two_realisations_have_an_error_bar_and_one_has_none():
    x, exact = np.array([1.0, 1.2]), {"k": np.array([1.0, 1.0])}
    assert error(MEAN, MethodValues({"k": x}), MethodValues(exact)).half_width == pytest.approx(t(2) * 0.1)
    assert error(MEAN, MethodValues({"k": x[:1]}), MethodValues({"k": np.ones(1)})).half_width == 0.0
    alone = error(MEAN, MethodValues({"k": np.ones(1)}, paired=False), MethodValues({"k": x}))
    assert alone.half_width == pytest.approx(t(2) * 0.1 / 1.1**2, rel=0.01)


def test_two_realisations_tell_nothing_of_how_a_deviation_scatters():
    deviation = Quantity(
        name="s", log=lambda a: np.log(np.atleast_1d(a["k"].std(ddof=1) if a["k"].size > 1 else 0.0)), needs=("k",)
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        found_ = error(deviation, MethodValues({"k": np.array([1.0, 1.2])}), MethodValues({"k": np.array([1.0, 1.3])}))
    assert found_.half_width == math.inf


# --- rolling ---

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
    tracks = {name: outcome(springs * np.maximum(exact_3d, 1e-12), 0.1, case.tracks) for name in rolling.INPUT_SPECTRA}
    return rolling.RollingResult(
        case, {0.1: bem}, {0.1: refined}, {(name, 0.1): one for name, one in tracks.items()}, {}, ()
    )


@pytest.mark.slow
def test_levels_of_rolling_are_powers_in_decibels():
    """10 lg of a ratio of powers: 1.2 of springs, 0.98 from one grid to the next, which are 0.98^2 to no cells."""
    rng = np.random.default_rng(0)
    mine = LevelsAtHeight(rolled(rng, scatter=1e-9), 0.1)
    region = 1.0, 4.0
    bands = mine.bands_in(region)
    each = [mine.model_level(SPRINGS, mine.single_bands[band]) for band in bands]
    worst, rms = rolling_numbers.over_bem(mine, SPRINGS, region)
    at = each[list(mine.case.bands.centres[bands]).index(worst.where["worst at"])]
    assert abs(10 * math.log10(1.2) - POWER_DECIBEL * at.value) <= 2 * POWER_DECIBEL * at.half_width
    assert worst.value == pytest.approx(POWER_DECIBEL * (at.value - 2 * math.log(0.98)), abs=1e-6)
    assert worst.grid == pytest.approx(-10 * math.log10(0.98), abs=1e-4)
    assert worst.sample == pytest.approx(POWER_DECIBEL * at.half_width_among(len(bands)), rel=0.01)
    off = [POWER_DECIBEL * (one.value - 2 * math.log(0.98)) for one in each]
    assert rms.value == pytest.approx(math.sqrt(np.mean(np.square(off))), abs=1e-6)
    departure, _ = rolling_numbers.nonlinear(mine, region)
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
    assert holds(covered / TRIALS, short=0.02, wide=0.02)


@pytest.mark.parametrize("strips", [3, 6])
def test_variance_and_mean_of_the_rolling_force_cover_their_truth(strips):
    """Both are of a few strips beside many tracks."""
    rng = np.random.default_rng(strips)
    shares = np.zeros(3)
    for _ in range(TRIALS):
        outcomes = [
            {
                "linear variance": (linear := rng.lognormal(0, 0.2, n)),
                "variance": 1.1 * linear * (1 + 0.05 * rng.standard_normal(n)),
                "mean": 1.0 + 0.01 * rng.standard_normal(n),
            }
            for n in (strips, 40)
        ]
        mine = SimpleNamespace(height=0.1, bem=outcomes[0], springs=outcomes[1])
        numbers = rolling_numbers.moments(mine)
        truths = (1.1, 1.1, numbers[2].reference)
        shares += [abs(n.value - truth) <= n.sample for n, truth in zip(numbers, truths, strict=True)]
    assert all(holds(share, short=0.01, wide=0.01) for share in shares / TRIALS)


def test_an_interval_of_a_ratio_is_that_of_its_logarithm_times_the_ratio():
    """MDR over boundary elements as a part: exp(x) - 1, whose interval is exp(x) times that of x."""
    case = rolling_input.RollingInput(surfaces=20, profiles=30)
    rng = np.random.default_rng(0)
    punches = {"stiffness": 1 + 0.1 * rng.standard_normal((20, len(case.forces)))}
    springs = {"stiffness": 3 + 0.1 * rng.standard_normal((30, len(case.forces)))}
    result = SimpleNamespace(case=case, profiles=dict.fromkeys(rolling_input.INPUT_SPECTRA, springs), punches=punches)
    number = punch_number(result, "geike")
    assert number.value == pytest.approx(2.0, rel=0.1)
    level = nearest(case.forces, 0.1)
    relative = math.hypot(
        *(
            x[:, level].std(ddof=1) / x[:, level].mean() / math.sqrt(len(x))
            for x in (*springs.values(), *punches.values())
        )
    )
    assert number.sample == pytest.approx(t(25) * (1 + number.value) * relative, rel=0.06)


# --- the wheel ---


def grouped(rng, groups, level=1.0, lines=40, spread=0.3):
    """Mean spectra of groups of wheels, flat but for their scatter."""
    return {
        "omega": np.arange(1.0, lines + 1),
        "plain": level * rng.gamma(1 / spread**2, spread**2, (groups, 1)) * np.ones(lines),
        "square": rng.gamma(1 / spread**2, spread**2, groups),
    }


@pytest.mark.parametrize("groups", [4, 10])
def test_levels_of_groups_of_wheels_cover_their_truth(groups):
    """Logarithms of a mean that scatters by a tenth."""
    rng = np.random.default_rng(groups)
    band = (5.0, 20.0)

    def drawn():
        return ends(wheel_features.level(grouped(rng, groups, 2.0, spread=0.1), band))

    assert holds(covered(drawn, math.log(2)), short=0.01, wide=0.01)


@pytest.mark.parametrize("shared", [True, False])
def test_ratios_of_groups_of_wheels_cover_their_truth(shared):
    rng = np.random.default_rng(4)

    def drawn():
        one = grouped(rng, 8, spread=0.1)
        other = {**one, "plain": 3 * one["plain"]} if shared else grouped(rng, 8, 3.0, spread=0.1)
        if shared:
            other["plain"] = other["plain"] * (1 + 0.02 * rng.standard_normal((8, 1)))
        return ends(wheel_features.ratio(other, one, (5.0, 20.0)))

    assert holds(covered(drawn, math.log(3)), short=0.01)


def test_shared_tracks_leave_no_error_of_a_ratio():
    one = grouped(np.random.default_rng(0), 5)
    assert wheel_features.ratio({**one, "plain": 3 * one["plain"]}, one, (5.0, 20.0)).error < 1e-15


def test_the_law_of_the_break_covers_its_truth():
    """Breaks that scatter as their standard errors say, of ten groups each."""
    rng, case = np.random.default_rng(0), wheel_distance.WheelDistance()
    duration = 2.0 ** np.arange(5)

    def drawn():
        own = 0.05 * np.array([1.0, 1.0, 1.0, 2.0, 2.0])
        breaks = 1e4 * duration**0.4 * np.exp(own * rng.standard_normal(5))
        seen = own * breaks * np.sqrt(rng.chisquare(case.groups - 1, 5) / (case.groups - 1))
        columns = {"duration [s]": duration, "break [rad/s]": breaks, "standard error [rad/s]": seen}
        number = distance_numbers.break_law(case, columns)
        return number.value, number.sample

    assert holds(covered(drawn, 0.4), short=0.02, wide=0.03)


def test_the_rms_jump_covers_its_truth():
    """A mean square of Gaussian jumps at one of five distances."""
    rng = np.random.default_rng(1)
    wheels = np.array([60, 40, 20, 20, 20])

    def drawn():
        rms = np.array([math.sqrt(np.mean(rng.standard_normal(n) ** 2)) for n in wheels])
        breaks = {"rms jump [m/s2]": rms, "of linear theory [m/s2]": np.ones(5), "wheels": wheels}
        number, *others = distance_numbers.jumps({**breaks, "distance [m]": np.arange(5.0)})
        # of one distance alone, whose interval holds together with those of the others
        return number.value, number.sample * student(59) / student(59, 1 - 0.05 / (1 + len(others)))

    assert holds(covered(drawn, 1.0), wide=0.01)


def test_the_mean_square_over_that_of_the_steady_state_counts_the_scatter_of_both():
    rng = np.random.default_rng(2)

    def drawn():
        squares = {
            wheel_distance.OPEN: {"square": 1.5 * rng.gamma(50, 1 / 50, 8)},
            wheel_distance.STEADY: {"square": rng.gamma(50, 1 / 50, 8)},
        }
        number = distance_numbers.mean_square(SimpleNamespace(ends=squares))
        return number.value, number.sample

    assert holds(covered(drawn, 1.5), short=0.01)


def test_the_level_over_linear_theory_covers_its_truth():
    """Groups of wheels whose level is that of linear theory but for a factor of their own: 10 lg of the mean."""
    rng, scene = np.random.default_rng(3), wheel_distance.TABLE
    omega = np.arange(1, 400) * 2 * scene.cutoff / 400
    linear = Spectrum(scene, omega, np.ones((1, 399)), np.ones((1, 399)), np.ones(1), 1e-6, 0.05).linear

    def drawn():
        hann = 1.3 * linear * rng.gamma(100, 1 / 100, (6, 1))
        numbers = spectrum_numbers.levels_over_linear(Spectrum(scene, omega, hann, hann, 1e-3 * np.ones(6), 1e-6, 0.05))
        # all bands of a group share its factor
        return numbers[0].value, numbers[0].sample * student(5) / student(5, 1 - 0.05 / len(numbers))

    assert holds(covered(drawn, 10 * math.log10(1.3), trials=300), trials=300, short=0.01)


@pytest.mark.slow
def test_a_feature_covers_its_truth():
    """The floor B / omega^2 of groups that differ by a factor, jackknifed."""
    rng, scene = np.random.default_rng(4), wheel_distance.TABLE
    omega = np.arange(1, 1200) * 3 * scene.cutoff / 1200
    shape = (2 * np.sin(omega * 1e-6 / 2) / 1e-6) ** -2

    def drawn():
        plain = 7.0 * shape * rng.gamma(100, 1 / 100, (8, 1))
        hann = (scene.jump / omega) ** 4 + 1e-3 * shape + 0 * plain
        return ends(measured(Spectrum(scene, omega, plain, hann, rng.standard_normal(8), 1e-6, 0.05))[FLOOR])

    assert holds(covered(drawn, 7.0, trials=60), trials=60)


def strips_of(factor, rng_seed=0, count=3, steps=720):
    """Series of boundary elements `factor` times the linear ones."""
    linear = np.random.default_rng(rng_seed).standard_normal((count, steps))
    return [{"bem": factor * x, "linear": x, "time step": np.array(1e-5), "failed": np.zeros(1)} for x in linear]


def test_what_grid_and_solver_leave_open_in_three_dimensions():
    """To first order in the cells: from 9 to 12 of them to a radius three times the change; the solver, all of it."""
    case = wheel_3d.Wheel3D(strips=3, coarser=2)
    louder = 10 ** (1 / 20)
    result = wheel_3d.Result3D(
        case,
        {
            wheel_3d.FINEST: strips_of(1.0),
            wheel_3d.COARSER: strips_of(louder, count=2),
            wheel_3d.LOOSE: strips_of(1.0, 7, 1),
            wheel_3d.TIGHT: strips_of(louder**0.1, 7, 1),
        },
        {},
        (),
    )
    levels = wheel_3d_levels.WheelLevels(result)
    np.testing.assert_allclose(POWER_DECIBEL * levels.grid, 3.0, rtol=1e-9)
    np.testing.assert_allclose(POWER_DECIBEL * levels.solver, 0.1, rtol=1e-9)
    finer = wheel_3d_levels.WheelLevels(replace(result, case=replace(case, coarse=6)))
    np.testing.assert_allclose(POWER_DECIBEL * finer.grid, 1.0, rtol=1e-9)


def test_a_mean_over_bands_in_three_dimensions_has_all_of_its_errors():
    """Both samples in quadrature, as they are independent; grid and solver added."""
    case = wheel_3d.Wheel3D(strips=3, coarser=2)
    strips = {
        wheel_3d.FINEST: [
            {**one, "bem": f * one["bem"]} for one, f in zip(strips_of(1.0), (0.9, 1.0, 1.2), strict=True)
        ],
        wheel_3d.COARSER: strips_of(1.1, count=2),
        wheel_3d.LOOSE: strips_of(1.0, 7, 1),
        wheel_3d.TIGHT: strips_of(1.05, 7, 1),
    }
    levels = wheel_3d_levels.WheelLevels(wheel_3d.Result3D(case, strips, {}, ()))
    bands = len(levels.centres)
    groups = 0.01 * np.random.default_rng(0).standard_normal((6, bands))
    exact = dict.fromkeys((wheel_3d_levels.LINEAR_3D, wheel_3d_levels.LINEAR_1D), np.zeros(bands))
    levels.__dict__.update(springs={wheel_3d_levels.GEIKE: groups}, exact=exact)
    where = np.arange(bands) < 3
    theory, left = levels.mean_over_bem(wheel_3d_levels.LINEAR_3D, where)
    springs, same = levels.mean_over_bem(wheel_3d_levels.GEIKE, where)
    assert left == same == pytest.approx(levels.grid[where].mean() + levels.solver[where].mean())
    own = groups[:, where].mean(axis=1).std(ddof=1) / math.sqrt(6)
    # of small logarithms, the spread of their means
    assert math.sqrt(springs.error**2 - theory.error**2) == pytest.approx(own, rel=0.02)
    assert theory.error > 0 and theory.samples == springs.samples == 3


# --- straight lines, shares, borders ---


def test_the_exponent_of_iterations_covers_its_truth():
    rng, cells = np.random.default_rng(0), np.array([32, 64, 128, 256])

    def drawn():
        counts = 10 * cells**0.5 * np.exp(0.05 * rng.standard_normal(4))
        rows = [
            {"scene": "s", "solver": "solve", "cells": int(n), "iterations": float(c)}
            for n, c in zip(cells, counts, strict=True)
        ]
        number = exponent_number(table_of("iterations", rows), "s", "solve")
        return number.value, number.sample

    assert holds(covered(drawn, 0.5))


def test_the_drift_of_an_energy_covers_its_truth():
    rng = np.random.default_rng(0)
    place = (np.arange(10) + 0.5) / 10
    assert holds(covered(lambda: long_runs.fit_drift(2 * place + 0.1 * rng.standard_normal(10)), 2.0))


@pytest.mark.parametrize("confidence", [0.95, 0.999])
def test_the_growth_over_laps_covers_its_truth(confidence):
    rng = np.random.default_rng(0)

    def drawn():
        return long_runs.mean_of_logs(np.exp(0.3 + 0.1 * rng.standard_normal(5)), confidence)

    share = covered(drawn, 0.3)
    assert abs(share - confidence) <= binomial(TRIALS, confidence)


@pytest.mark.slow
@pytest.mark.parametrize(("share", "size"), [(0.95, 60), (0.95, 200), (0.5, 20)])
def test_the_interval_of_a_share_is_that_of_clopper_and_pearson(share, size):
    """Summed over all counts: it holds the truth in 95 of 100 at least, and misses it by no more than 2.5 a side."""
    counts = np.arange(size + 1)
    chance = stats.binom.pmf(counts, size, share)
    low, high = np.array([clopper_pearson(np.arange(size) < n) for n in counts]).T
    below, above = chance[share > high].sum(), chance[share < low].sum()
    assert below <= 0.025 and above <= 0.025
    assert below + above >= 0.005


def test_where_a_limit_is_crossed_is_known_to_its_steps():
    """y = x^2 crosses 4 at 2; the interval of the place is in octaves, and grows with the steps of the sweep."""

    def threshold(steps):
        x = np.geomspace(0.25, 8.0, steps)
        outcome = swept(STEEP, x, [(y, "") for y in x**2], 2.0)
        return threshold_number(Sweep.of(STEEP, outcome))

    fine, coarse = threshold(41), threshold(9)
    for number in (fine, coarse):
        assert abs(number.value) <= number.grid + 1e-9
    assert coarse.grid == pytest.approx(5 * fine.grid, rel=0.01)
