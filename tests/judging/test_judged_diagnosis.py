"""What is wrong with a model as a whole is named: a factor, a table, equal draws, answers that change."""

import math

import numpy as np
import pytest

import mdr
from tests.judging.judged_points import INCONCLUSIVE
from tests.judging.test_judged_stiffness import as_known, series
from tests.seeded import catches
from validation import judge, stiffness_model
from validation.judging.judgement import AGAIN, UNTRUSTED, trusted_numbers
from validation.judging.kinds import judge as repeats
from validation.judging.kinds import profiles, rolling, stiffness
from validation.judging.kinds.diagnosis import remarks
from validation.judging.kinds.judge import Recorded, points_of, repeated
from validation.judging.kinds.own import OWN, ellipse, geike, half_space, in_3d, springs
from validation.judging.kinds.references import reference_rows
from validation.judging.registry import offer
from validation.judging.worker import Called
from validation.theory.rolling import linear_force

MODULUS = 0.91
"""E for E* at nu = 0.3."""


@pytest.fixture
def few(monkeypatch):
    """Fewer profiles and draws."""
    monkeypatch.setattr(profiles, "PROFILES", 40)
    monkeypatch.setattr(stiffness, "REALISATIONS", {stiffness.FAST: 8, math.inf: 8})


def points(kind, function, tolerance=0.1):
    return list(points_of(Called(offer(kind, "mine", {}, getattr(function, "function", function))), tolerance))


def causes(kind, function):
    return {remark.cause: remark.sentence for remark in remarks(points(kind, function))}


# --- answers that change ---


def noisy(size, rng, load, side, modulus, roughness):
    return series(load, side, modulus, roughness) * (1 + size * rng.standard_normal())


def again(function):
    """Of the kind of stiffness: asked for several punches, and then again."""
    model = Recorded(Called(offer("stiffness_model", "mine", {}, function)))
    for hurst in (0.4, 0.7, 1.0):
        for force in (0.01, 0.1, 1.0):
            if "rng" in model.asks:
                stiffness.draws(model, stiffness.JudgedPunch(hurst, force).arguments, 4)
            else:
                model.call(**stiffness.JudgedPunch(hurst, force).arguments)
    return repeated(model)


@catches("noise of ten per cent that is the same", size=0.05).at("validation.judging.kinds.judge.SAME", 0.5)
@pytest.mark.parametrize("size", [0.05, 2e-3])
def test_noise_is_random_without_rng(size):
    found = again(partial_of(noisy, size, np.random.default_rng(1)))
    assert found.change > size / 3 and found.reason.startswith(repeats.RANDOM)


def partial_of(function, *first):
    """With a signature of its own."""

    def own(load, side, modulus, roughness):
        return function(*first, load, side, modulus, roughness)

    return own


def test_draws_of_another_generator_are_random_beside_rng():
    other = np.random.default_rng(1)
    found = again(lambda load, side, modulus, roughness, rng: side * modulus * (1 + 0.1 * other.random()))
    assert found.reason.startswith("random beside rng")


@pytest.mark.parametrize("step", [1e-3, -1e-2])
def test_a_counter_drifts(step):
    calls = []

    def drifting(load, side, modulus, roughness):
        calls.append(load)
        return series(load, side, modulus, roughness) * (1 + step * len(calls))

    assert again(drifting).reason.startswith(repeats.DRIFTING)


def test_what_is_kept_by_the_identity_of_an_argument_has_the_answer_of_another_problem():
    """An address is given to the next object as soon as one is gone: here to every other one."""
    kept, turns = {}, iter(range(10**6))

    def cached(load, side, modulus, roughness):
        return kept.setdefault(next(turns) % 2, series(load, side, modulus, roughness))

    assert again(cached).reason.startswith(repeats.CACHED)


@pytest.mark.parametrize("function", [series, springs.function, lambda load: 1e3 * load**0.5])
def test_what_has_one_answer_to_each_problem_is_not_named(function):
    found = again(function)
    assert found.change == 0 and not found.reason


def test_a_problem_that_has_the_answer_of_another_one_when_it_is_asked_twice_is_found():
    """In one call alone, which is not asked again at the end."""
    answers = []

    def mixed(load, side, modulus, roughness):
        answers.append(series(load, side, modulus, roughness))
        return answers[2] if len(answers) == 6 else answers[-1]

    model = Recorded(Called(offer("stiffness_model", "mine", {}, mixed)))
    for force in (0.01, 0.02, 0.04, 0.1, 0.2, 0.2, 0.2):
        model.call(**stiffness.JudgedPunch(0.7, force).arguments)
    found = repeated(model)
    assert found.change > 0.1 and found.reason.startswith(repeats.CACHED)


def test_what_a_solver_leaves_from_another_initial_guess_is_no_drift():
    calls = []

    def warm(load, side, modulus, roughness):
        calls.append(load)
        return series(load, side, modulus, roughness) * (1 + 3e-5 * math.sin(len(calls)))

    assert again(warm).change < repeats.SAME and not again(warm).reason


def test_a_model_that_fails_the_second_time_is_a_row():
    calls = []

    def once(load, side, modulus, roughness):
        calls.append(load)
        return series(load, side, modulus, roughness) if len(calls) < 10 else math.nan

    assert again(once).change.reason.startswith("answered the first time, and then: returned NaN")


def test_arguments_are_new_objects_in_each_call():
    seen = []

    def keeps(load, side, modulus, roughness):
        assert roughness.rms == 1e-5
        seen.append(roughness)
        return 1e6

    assert again(keeps).change == 0
    assert len({id(one) for one in seen}) == len(seen) > 10


def test_verdicts_of_answers_that_change_are_undecided_in_summary_paragraph_and_json():
    rng = np.random.default_rng(2)

    @stiffness_model("noisy")
    def model(load, side, modulus, roughness):
        return noisy(0.05, rng, load, side, modulus, roughness)

    found = judge(model)
    assert {p.verdict for p in found.numbers if p.quantity != AGAIN} == {INCONCLUSIVE}
    assert UNTRUSTED in {p.reason for p in found.numbers if p.quantity == "mean stiffness"}
    first = found.summary().splitlines()[1]
    assert first.startswith("! No verdict can be trusted") and "random without rng" in found.summary()
    assert "No verdict can be trusted" in found.summary().partition("For a paper:")[2]
    assert found.as_dict()["remarks"][0]["cause"] == "random without rng" and found.remarks[0].decides


def test_numbers_of_answers_that_change_stay_as_they_are():
    rng = np.random.default_rng(2)
    some = points("stiffness_model", partial_of(noisy, 0.05, rng))
    assert [(p.value, p.difference, p.error) for p in trusted_numbers(some)] == [
        (p.value, p.difference, p.error) for p in some
    ]
    right = points("stiffness_model", series)
    assert trusted_numbers(right) == right


# --- draws ---


def drawn_from(count, rounding=0.0):
    """Springs on one of so many profiles."""

    def model(load, side, modulus, roughness, rng):
        number = np.random.default_rng(int(rng.integers(count)))
        height = mdr.rough_profile(roughness.c1d, length=side, points=256, rng=number, rms=roughness.rms)
        value = mdr.stiffness_under(load, height[None], length=side, modulus=modulus)[0]
        return value * (1 + rounding * rng.standard_normal())

    return model


@pytest.mark.parametrize("rounding", [0.0, 1e-9])
def test_a_generator_that_is_not_used_leaves_the_mean_inconclusive(few, rounding):
    some = [p for p in points("stiffness_model", drawn_from(1, rounding)) if p.quantity.startswith("mean stiffness")]
    assert {p.verdict for p in some} == {INCONCLUSIVE} and all(math.isinf(p.error) for p in some)
    assert all("rng is asked for and not used" in p.shown for p in some)
    assert "equal draws" in causes("stiffness_model", drawn_from(1, rounding))


@pytest.mark.parametrize("count", [2, 3])
def test_draws_of_a_small_pool_count_as_few(few, monkeypatch, count):
    """Student's quantile of one or two degrees of freedom, and no more than that many records."""
    monkeypatch.setattr(stiffness, "REALISATIONS", {stiffness.FAST: 60, math.inf: 60})
    punches = [stiffness.JudgedPunch(0.7, force) for force in (0.01, 0.1)]
    model = Called(offer("stiffness_model", "mine", {}, drawn_from(count)))
    for punch, found in stiffness.answers_of(model, punches).items():
        values = stiffness.draws(model, punch.arguments, 60) / stiffness.UNIT
        pool = np.unique(np.round(values, 12))
        exact = {2: 12.706, 3: 4.303}[count] * pool.std(ddof=1) / math.sqrt(count) / pool.mean()
        assert found.mean.half == pytest.approx(exact, rel=0.25) and f"{count} are different" in found.mean.reason
        assert found.mean.value == pytest.approx(values.mean())


@pytest.mark.parametrize("count", [2, 3, 5])
def test_few_draws_leave_their_deviation_open(count):
    """Of two the scatter of the squares is zero."""
    pool = np.random.default_rng(count).normal(1.0, 0.1, count)
    apart = np.arange(60) % count
    found = stiffness.sampled(pool[apart], first_equal=apart)
    assert math.isinf(found.deviation.half) and f"{count} are different" in found.deviation.reason
    assert found.deviation.value == pytest.approx(pool.std(ddof=1) / pool.mean(), rel=0.2)
    all_different = stiffness.sampled(np.random.default_rng(count).normal(1.0, 0.1, 60))
    assert 0 < all_different.deviation.half < 0.5


@pytest.mark.parametrize("times", [(10, 1, 1), (6, 3, 3), (1, 1, 10)])
def test_draws_that_are_drawn_unequally_often_have_the_error_of_fewer(times):
    """sum n_i x_i / n has the variance of x times sum n_i^2 / n^2, which for equal numbers is that over three."""
    pool = np.array([0.96, 1.0, 1.05])
    n = sum(times)
    alike = stiffness.sampled(np.repeat(pool, 4), "", np.repeat([0, 4, 8], 4))
    apart = np.repeat(np.cumsum((0, *times[:-1])), times)
    found = stiffness.sampled(np.repeat(pool, times), "", apart)
    exact = math.sqrt(3 * sum(one**2 for one in times)) / n
    assert found.mean.half / alike.mean.half == pytest.approx(exact)
    assert found.mean.value == pytest.approx(np.dot(pool, times) / n)


@catches("draws that are equal under one load").at("validation.judging.kinds.stiffness.EQUAL", 10.0)
def test_draws_that_differ_under_any_load_are_draws():
    """Springs that are pressed flat are all as stiff."""
    model = Called(springs)
    punches = [stiffness.JudgedPunch(0.7, force) for force in (0.1, 1e4)]
    light, heavy = stiffness.answers_of(model, punches, 8).values()
    assert 0 < light.mean.half < 1 and heavy.mean.half == 0 and "equal realisations" in heavy.mean.reason


# --- a table ---


def interpolated(load, side, modulus, roughness):
    """The table of the nearest H, between its loads."""
    rows = reference_rows("mean stiffness")
    nearest = min((row["H"] for row in rows), key=lambda hurst: abs(hurst - roughness.hurst))
    force, mean = np.log([(row["Fbar"], row.value) for row in rows if row["H"] == nearest]).T
    return modulus * side * math.exp(np.interp(math.log(load / (modulus * roughness.rms * side)), force, mean))


def refused(load, side, modulus, roughness):
    if roughness.hurst not in (0.4, 0.55, 0.7, 0.85, 1.0):
        raise ValueError("an H that is in no table")
    return interpolated(load, side, modulus, roughness)


def of_a_wheel(q, contact_radius, modulus, roughness):
    """Whose roughness is always the same."""
    ground = mdr.SelfAffine(hurst=0.7, q_min=1 / contact_radius, q_max=20 / contact_radius, rms=roughness.rms)
    return in_3d(q, contact_radius, modulus, ground)


def of_an_ellipse(k_x, k_y, a_x, a_y):
    table = {(row[rolling.LOAD], row[rolling.DIAMETER]) for row in reference_rows(rolling.FILTER)}
    contacts = [rolling.scene_of(*wheel).contact for wheel in table]
    if all(abs(one.across / a_y - 1) + abs(one.along / a_x - 1) > 1e-6 for one in contacts):
        raise LookupError("an ellipse that is in no table")
    return ellipse(k_x, k_y, a_x, a_y)


def on_square_cells(height, spacing, radius, modulus, approach):
    return linear_force(height, spacing=spacing[0], radius=radius, modulus=modulus, approach=approach)


def of_one_wheel(height, spacing, radius, modulus, approach):
    return half_space(height, spacing, 0.5, modulus, approach)


def of_known_h(q, roughness):
    if roughness.hurst not in (0.4, 0.55, 0.7, 0.85, 1.0):
        raise LookupError("an H that is in no table")
    return geike(q, roughness)


def of_known_surfaces(height, modulus, spacing, load):
    if len(height) != 256:
        raise ValueError("256 cells on a side, please")
    return modulus * spacing * len(height)


def of_one_bandwidth(load, side, modulus, roughness):
    """A model that is within the tolerance at one held-out load alone."""
    factor = 1.0 if round(roughness.q_max / roughness.q_min) == 64 else 1.5
    return factor / (1 / (1.1523 * modulus * side) + 0.48 * roughness.rms / load)


ON_THE_TABLE = [
    ("stiffness_model", of_one_bandwidth),
    ("stiffness_model", interpolated),
    ("stiffness_model", refused),
    ("stiffness_model", as_known),
    ("force_spectrum", of_a_wheel),
    ("contact_filter", of_an_ellipse),
    ("rolling_model", on_square_cells),
    ("rolling_model", of_one_wheel),
    ("profile_spectrum", of_known_h),
]


@pytest.mark.parametrize(("kind", "function"), ON_THE_TABLE)
def test_what_is_right_on_the_table_alone_is_named(kind, function):
    found = causes(kind, function)
    assert found.keys() & {"right on the table alone", "wrong beside the table"}
    assert any(sentence.startswith("Right at the points of the table alone?") for sentence in found.values())


# --- a factor, or a shift ---

EVERYWHERE = [
    (
        "stiffness_model",
        lambda load, side, modulus, roughness: 2 * as_known(load, side, modulus, roughness)[0],
        "2: a d",
    ),
    (
        "stiffness_model",
        lambda load, side, modulus, roughness: MODULUS * as_known(load, side, modulus, roughness)[0],
        "E for E*, at nu = 0.3?",
    ),
    ("contact_filter", lambda k_x, k_y, a_x, a_y: 2 * ellipse(k_x, k_y, a_x, a_y), "of the amplitude?"),
    ("contact_filter", lambda k_x, k_y, a_x, a_y: ellipse(k_x, k_y, a_x, a_y) ** 2, "20 lg for 10 lg?"),
    ("contact_filter", lambda k_x, k_y, a_x, a_y: np.abs(ellipse(k_x, k_y, a_x, a_y)) ** 0.5, "root of the amplitude?"),
    (
        "force_spectrum",
        lambda q, contact_radius, modulus, roughness: 2 * in_3d(q, contact_radius, modulus, roughness),
        "dB above the reference: one-sided for two-sided?",
    ),
    (
        "force_spectrum",
        lambda q, contact_radius, modulus, roughness: in_3d(q, contact_radius, MODULUS * modulus, roughness),
        "E for E*, at nu = 0.3?",
    ),
    ("profile_spectrum", lambda q, roughness: 2 * geike(q, roughness), "one-sided for two-sided?"),
    ("profile_spectrum", lambda q, roughness: geike(q, roughness) / (2 * math.pi), "per cycle for per radian?"),
]


@pytest.mark.parametrize(("kind", "function", "words"), EVERYWHERE)
def test_a_factor_that_is_one_everywhere_is_named(kind, function, words, few):
    assert any(words in sentence for sentence in causes(kind, function).values())


RIGHT = [(one.kind, one.function) for one in OWN if one is not springs]


def without_a_table(load, side, modulus, roughness):
    return 1 / (1 / (1.1523 * modulus * side) + 0.48 * roughness.rms / load)


@pytest.mark.parametrize(
    ("kind", "function"), [*RIGHT, ("stiffness_model", series), ("stiffness_model", without_a_table)]
)
def test_nothing_is_said_of_models_of_the_suite(kind, function, few):
    assert not causes(kind, function)


def test_springs_are_right_on_the_table_and_their_draws_are_draws(few):
    found = causes("stiffness_model", springs)
    assert not found.keys() & {"equal draws", "few draws", "random without rng", "random beside rng"}
    assert not any("everywhere" in cause for cause in found)
