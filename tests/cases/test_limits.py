"""Where each method fails: on its side of the predicted threshold, and with the warnings of the software."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy import special

import bem3d
import mdr
from tests.cases.planted import changed, whole
from tests.oracles import dense_operator
from tests.seeded import Times, catches
from validation.analysis.evidence import Role, Verdict
from validation.cases.limits import limits as case
from validation.cases.limits import sweeps
from validation.cases.limits.sweeps import LIMITS, Failing, Judged, Limit, LimitName, Probe, Sweep
from validation.simulation import limits
from validation.simulation.limits import recorded, swept
from validation.simulation.track_spectrum import self_affine
from validation.theory.rolling import force_variance

SMALL = case.Limits(cells=32, surfaces=2, profiles=40, length=8.0, strip_cells=6, track=64.0, resolved=1)
TITLES = [limit.named.title for limit in LIMITS]
STEEP = Limit(
    LimitName("none", "x to the second", "x"),
    Probe(swept, (1.0, 2.0)),
    Failing("above", "y", "nothing", 4.0),
    "x = 2",
    2.0,
    Judged(1.5),
)


@pytest.fixture(scope="module")
def result():
    return case.run(SMALL)


def found(result, title):
    return next(sweep for sweep in result["sweeps"] if sweep.limit.named.title == title)


def verdict(series):
    (number,) = series.numbers
    return number.verdict


@pytest.mark.slow
def test_all_criteria_are_met(result):
    whole(case.CASE.evidence(result))
    assert len(set(TITLES)) == len(TITLES)


@pytest.mark.slow
@pytest.mark.parametrize("title", TITLES)
def test_each_limit_fails_on_its_side(result, title):
    """More past the threshold than before it, and past the tolerance there; one elsewhere is noticed where theory has
    it, and so are silence and crying wolf where a user is warned."""
    sweep = found(result, title)
    assert (np.diff(sweep.values) > 0).all()
    good, failed = sweep.error[sweep.before_threshold], sweep.error[sweep.past_threshold]
    assert good.size and failed.size
    assert np.median(failed) > max(np.median(good), sweep.limit.fails.tolerance)
    if sweep.limit.judged.derived:
        assert sweep.predicted and verdict(case.threshold(sweep)) is Verdict.WITHIN
        for shift in (2 * sweep.limit.judged.factor**2, 0.5 / sweep.limit.judged.factor**2):
            elsewhere = replace(sweep, predicted_threshold=shift * sweep.predicted_threshold)
            assert verdict(case.threshold(elsewhere)) is Verdict.OUTSIDE
    if sweep.limit.judged.warned:
        assert verdict(case.warnings(sweep)) is Verdict.WITHIN
        for words in ("", "wolf"):
            wrong = replace(sweep, messages=(words,) * sweep.values.size)
            assert verdict(case.warnings(wrong)) is Verdict.OUTSIDE


@pytest.mark.slow
def test_an_outcome_elsewhere_changes_the_claims(result):
    elsewhere = [replace(sweep, predicted_threshold=100 * sweep.predicted_threshold) for sweep in result["sweeps"]]
    predicted, _ = case.CASE.evidence(changed(result, sweeps=elsewhere)).claims
    assert (predicted.count(Verdict.WITHIN), len(predicted.numbers)) == (0, 20)


@catches("a limit read on its good side", side="above").at(
    "validation.cases.limits.sweeps.Sweep.past_threshold", sweeps.Sweep.before_threshold
)
@pytest.mark.parametrize("side", ["above", "below"])
def test_crossings_of_a_power_law(side):
    """y = x^2 is past 4 from x = 2 on; mirrored, y = 16 / x^2 up to there."""
    x = np.geomspace(0.1, 30, 12)
    error = x**2 if side == "above" else 16 / x**2
    limit = replace(STEEP, fails=STEEP.fails._replace(side=side))
    sweep = Sweep(limit, x, error, 2.0, tuple("words" if e > 4 else "" for e in error))
    where, half = sweep.crossing
    assert where == pytest.approx(2.0, rel=1e-9)
    assert half == pytest.approx(np.log2(x[1] / x[0]) / 2)
    assert sweep.predicted
    assert (sweep.share_of_correct_warnings, sweep.first_message) == (1.0, "words")
    far = replace(sweep, predicted_threshold=20.0 if side == "above" else 0.2)
    assert not far.predicted
    assert far.share_of_correct_warnings < 1


# --- planted sweeps: on which side, by how much, and what is known where none is crossed ---

X = np.array([1.0, 2.0, 4.0, 8.0])


def planted(error, side="above", messages=("", "", "no", "no"), derived=False):
    """Past 2 the error must exceed 4, within a factor 1.5; they are told where they do."""
    judged = STEEP.judged._replace(derived=derived, warned=derived)
    limit = replace(STEEP, fails=STEEP.fails._replace(side=side), judged=judged)
    return Sweep(limit, X, np.array(error), 2.0, messages)


@pytest.mark.parametrize(
    ("error", "side", "octaves"),
    [([1.0, 2.0, 8.0, 9.0], "above", 0.5), ([8.0, 2.0, 1.0, 1.0], "below", 0.5), ([9.0, 9.0, 8.0, 2.0], "below", -1.5)],
)
def test_a_threshold_is_positive_where_it_fails_later(error, side, octaves):
    (number,) = case.threshold(planted(error, side)).numbers
    assert (number.value, number.grid) == pytest.approx((octaves, 0.5))
    assert number.tolerance == pytest.approx(math.log2(1.5)) and number.role is Role.FINDING


REAL_CROSSING = sweeps.Sweep.crossing.fget


@catches("a sweep that passes no threshold agrees at its end", error=[1.0] * 4, side="above", at=1.0).at(
    "validation.cases.limits.sweeps.Sweep.crossing",
    property(lambda sweep: REAL_CROSSING(sweep) or (sweep.values[:: sweep.sign][-1], 0.0)),
)
@pytest.mark.parametrize("at", [0.5, 1.0, 2.0, 20.0])
@pytest.mark.parametrize(
    ("error", "side"),
    [
        # it fails nowhere, or everywhere
        *(([error] * 4, side) for error in (1.0, 9.0) for side in ("above", "below")),
        # it fails where it should not, and not where it should
        ([9.0, 1.0, 1.0, 1.0], "above"),
        ([1.0, 1.0, 1.0, 9.0], "below"),
    ],
)
def test_a_sweep_that_passes_no_threshold_decides_nothing(error, side, at):
    """Wherever it is predicted: it ended within the factor, and agreed without an error bar."""
    sweep = replace(planted(error, side), predicted_threshold=at * X[-1 if side == "above" else 0])
    (number,) = case.threshold(sweep).numbers
    assert number.verdict is Verdict.INCONCLUSIVE
    assert case.in_words(number) == "no threshold in the sweep"


def test_what_follows_from_theory_alone_must_hold_and_all_warnings_count():
    right = planted([1.0, 2.0, 8.0, 9.0], derived=True)
    assert case.threshold(right).numbers[0].role is Role.CRITERION
    (warned,) = case.warnings(right).numbers
    assert (warned.value, warned.reference, warned.verdict) == (0.0, 0.0, Verdict.WITHIN)
    assert warned.role is Role.CRITERION and warned.tolerance < 100 / max(len(one.probe.values) for one in LIMITS)
    (silent,) = case.warnings(replace(right, messages=("", "", "", "no"))).numbers
    assert silent.value == pytest.approx(100 / 3) and silent.verdict is Verdict.OUTSIDE
    assert case.warnings(planted([1.0, 2.0, 8.0, 9.0])).numbers[0].role is Role.FINDING


def test_a_limit_is_where_predicted_only_if_all_past_it_fail_and_its_message_is_the_nearest():
    assert planted([1.0, 2.0, 8.0, 9.0]).predicted and not planted([1.0, 2.0, 8.0, 1.0]).predicted
    assert planted([1.0, 2.0, 8.0, 9.0], messages=("early", "", "near", "far")).first_message == "near"
    assert planted([9.0, 2.0, 1.0, 1.0], "below", ("only", "", "", "far")).first_message == "only"


def test_a_refusal_is_a_crossing_in_the_middle_of_its_step_and_warnings_near_the_threshold_are_free():
    x = np.array([1.0, 1.9, 2.1, 9.0])
    refused = Sweep(STEEP, x, np.array([1.0, 1.0, np.inf, np.inf]), 2.0, ("", "", "no", "no"))
    assert refused.crossing[0] == pytest.approx(np.sqrt(1.9 * 2.1)) and refused.predicted
    for words, share in ((("", "", "no", "no"), 1.0), (("", "", "", "no"), 1.0), (("no", "", "", "no"), 0.5)):
        assert replace(refused, messages=words).share_of_correct_warnings == share


def test_sweeps_are_put_in_order_and_limits_with_one_problem_have_errors_and_thresholds_of_their_own():
    outcome = swept([2.0, 1.0], [[2.0, 1.0], [4.0, 3.0]], ["b", "a"], measured=[5.0, 6.0])
    for part, errors, threshold in ((0, [1.0, 2.0], 50.0), (1, [3.0, 4.0], 60.0)):
        limit = replace(STEEP, probe=replace(STEEP.probe, part=part), threshold=lambda _, x: 10 * x)
        sweep = Sweep.of(limit, outcome)
        assert (sweep.values.tolist(), sweep.messages) == ([1.0, 2.0], ("a", "b"))
        assert (sweep.error.tolist(), sweep.predicted_threshold) == (errors, threshold)


def test_warnings_and_refusals_are_recorded():
    band = mdr.SelfAffine(hurst=0.7, q_min=7.0, q_max=50.0, rms=1e-6)
    draw = {"length": 1.0, "rng": np.random.default_rng(0)}
    for points, said in ((64, ""), (20, "SpringResolutionWarning: the shortest"), (10, "ValueError: c1d must vanish")):
        height, words = recorded(lambda points=points: mdr.rough_profile(band.c1d, points=points, **draw))
        assert (words == "") is (said == "") and words.startswith(said)
        assert height is None if points == 10 else height.size == points
    with pytest.raises(TypeError):
        recorded(lambda: mdr.rough_profile(None, points=10, **draw))


def test_sum_over_the_lattice_by_ewald():
    """sum' 1 / n less its mean = 2 sum' erfc(sqrt(pi) n) / n - 4 over the square lattice."""
    i = np.arange(-6, 7)
    n = np.hypot(i[:, np.newaxis], i)
    n = n[n > 0]
    assert 2 * np.sum(special.erfc(np.sqrt(np.pi) * n) / n) - 4 == pytest.approx(-limits.LATTICE, rel=1e-6)


def test_stiffness_of_a_lone_cell():
    body = bem3d.HalfSpace(shape=(1, 1), spacing=0.3, modulus=2.0)
    k = 0.3**2 / dense_operator(body)[0, 0]
    assert k / (2.0 * 0.3) == pytest.approx(limits.LONE_CELL, rel=1e-9)


@catches("factor 2 lost in the periodic symbol, seen by images").at("bem3d.kernel.periodic_symbol", Times(0.5))
def test_images_err_as_the_lattice_sum_says():
    """1.655 a / L, but for (a / L)^3 of the forces of images that are no points, and the kernels of the cells."""
    found = limits.images((6, 12, 24), fine=8)
    expected = limits.LATTICE * 4 / (3 * np.pi) / found["values"]
    assert found["error"][0] == pytest.approx(expected, rel=0.025)


@catches("factor 4 lost over a stretched surface").at("validation.simulation.limits.response", Times(0.5))
def test_a_stretched_surface_by_another_quadrature():
    """Isotropic it is force_variance; of short waves the variance does not depend on the ratio."""
    long, short = self_affine(0.7, 0.5, 4.0), self_affine(0.7, 100.0, 400.0)
    exact = force_variance(long.c2d, edges=long.edges, contact_radius=1.0, modulus=1.0)
    assert limits.stretched_variance(long, 1.0) == pytest.approx(exact, rel=1e-5)
    one, four = (limits.stretched_variance(short, ratio, lines=6000) for ratio in (1.0, 4.0))
    assert four == pytest.approx(one, rel=0.02)
    nothing = limits.stretched_variance(self_affine(0.7, 1e-3, 2e-3), 4.0)
    assert nothing == pytest.approx(4.0, rel=1e-4)


def test_theory_of_small_changes_of_energy():
    """Thresholds of explicit Euler and of Runge-Kutta, from the product of their factors over a turn."""
    euler, kutta = (next(one for one in LIMITS if one.named.title == t) for t in ("energy gained", "energy lost"))
    x = euler.threshold(euler.fails.tolerance, 1.0)
    assert (1 + x**2) ** (2 * np.pi / x) - 1 == pytest.approx(euler.fails.tolerance, rel=2 * x)
    x = kutta.threshold(kutta.fails.tolerance, 1.0)
    assert 1 - (1 - x**6 / 72) ** (2 * np.pi / x) == pytest.approx(kutta.fails.tolerance, rel=x**6 / 72)
