"""Where each method fails: on its side of the predicted threshold, and with the warnings of the software."""

from dataclasses import replace

import numpy as np
import pytest
from scipy import special

import bem3d
import mdr
from tests.oracles import dense_operator
from validation.analysis.evidence import Verdict, numbers_with
from validation.cases.limits import evidence as limits_evidence
from validation.cases.limits import isotropy, spheres, time_stepping
from validation.cases.limits import limits as case
from validation.cases.limits.numbers import EXPECTED_EXPONENTS, threshold_number, warnings_number
from validation.cases.limits.sweep import Limit, Sweep, call_and_record_warnings, swept
from validation.report.figures import limits as figures
from validation.simulation.contact_laws import HertzLaw
from validation.simulation.free_vibration import WHEEL
from validation.simulation.motion import simulate
from validation.simulation.track_spectrum import self_affine
from validation.theory.rolling import force_variance

SMALL = case.Limits(
    cells=32,
    surfaces=2,
    profiles=40,
    length=8.0,
    strip_cells=6,
    track=64.0,
    resolved=1,
    grids=(32, 64, 128),
    judged=32,
    tolerances=(1e-2, 1e-4, 1e-6),
)
NAMES = [limit.name for limit in case.LIMITS]
DERIVED = [limit.name for limit in case.LIMITS if limit.derived]
WARNED = [limit.name for limit in case.LIMITS if limit.warned]
STEEP = Limit(
    name="steep",
    method="none",
    title="x to the second",
    parameter="x",
    error="y",
    reference="nothing",
    condition="x = 2",
    failing_side="above",
    tolerance=4.0,
    factor=1.5,
)


@pytest.fixture(scope="module")
def result():
    return case.run(SMALL)


def found(result, name):
    return next(sweep for sweep in result.sweeps if sweep.limit.name == name)


@pytest.mark.slow
def test_all_criteria_are_met(result):
    evidence = limits_evidence.evidence(result)
    assert [n.sentence for n in evidence.numbers if not n.met] == []
    assert evidence.unconverged == ()


def test_names_are_unique():
    assert len(set(NAMES)) == len(NAMES)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_each_limit_fails_on_its_side(result, name):
    """More past the threshold than before it, and past the tolerance there."""
    sweep = found(result, name)
    assert (np.diff(sweep.values) > 0).all()
    good, failed = sweep.error[sweep.before_threshold], sweep.error[sweep.past_threshold]
    assert good.size and failed.size
    assert np.median(failed) > max(np.median(good), sweep.limit.tolerance)


@pytest.mark.slow
@pytest.mark.parametrize("name", DERIVED)
def test_thresholds_are_where_theory_says(result, name):
    sweep = found(result, name)
    assert sweep.predicted
    number = threshold_number(sweep)
    assert number.verdict is Verdict.AGREE
    assert number in limits_evidence.evidence(result).numbers


@pytest.mark.slow
@pytest.mark.parametrize("name", DERIVED)
def test_a_threshold_elsewhere_is_noticed(result, name):
    sweep = found(result, name)
    for shift in (2 * sweep.limit.factor**2, 0.5 / sweep.limit.factor**2):
        elsewhere = replace(sweep, predicted_threshold=shift * sweep.predicted_threshold)
        assert threshold_number(elsewhere).verdict is Verdict.DIFFER


@pytest.mark.slow
@pytest.mark.parametrize("name", WARNED)
def test_a_user_past_the_threshold_is_warned(result, name):
    sweep = found(result, name)
    assert sweep.verdict == "warned"
    number = warnings_number(sweep)
    assert number.verdict is Verdict.AGREE
    assert number in limits_evidence.evidence(result).numbers


@pytest.mark.slow
@pytest.mark.parametrize("name", WARNED)
def test_silence_and_crying_wolf_are_noticed(result, name):
    sweep = found(result, name)
    silent, wolf = (replace(sweep, messages=(words,) * sweep.values.size) for words in ("", "wolf"))
    assert {warnings_number(wrong).verdict for wrong in (silent, wolf)} == {Verdict.DIFFER}
    assert silent.verdict == "not warned"


@pytest.mark.slow
def test_recorded_messages_are_those_of_the_code(result):
    """The same calls once more."""
    body, gap = spheres.half_space(8, 1 / 1.2), spheres.sphere(8, 1 / 1.2, 0.0625)
    with pytest.warns(bem3d.ResolutionWarning) as caught:
        bem3d.solve(body, gap, approach=1.0)
    assert found(result, "cells").messages[2] == f"ResolutionWarning: {caught[0].message.detail}"
    with pytest.raises(ValueError, match="time_step") as refused:
        simulate(WHEEL, HertzLaw(WHEEL), time_step=3.0 / WHEEL.eigenfrequency, steps=1)
    assert found(result, "step").messages[-1] == f"ValueError: {refused.value}"
    assert any("), which touches alone, carries" in words for words in found(result, "spike").messages)
    assert found(result, "huge force").messages[-1].startswith("ConvergenceError: residual")
    assert found(result, "full contact").messages[-1].startswith("ValueError: approach must stay below the mean gap")
    assert found(result, "edge").messages[0].startswith("EdgeWarning: ")
    assert found(result, "strip").messages[0].startswith("ValueError: height must be wider than the contact")
    assert found(result, "spacing").messages[0].startswith("ValueError: c1d must vanish beyond the Nyquist")
    assert (
        found(result, "spacing")
        .messages[1]
        .startswith("SpringResolutionWarning: the shortest wave of the spectrum has 2.2 s")
    )
    assert found(result, "linear").messages[-1].startswith("LinearityWarning: roughness of h_rms / d = 1 ")


@pytest.mark.slow
def test_figures_are_drawn_from_tables(result):
    evidence = limits_evidence.evidence(result)
    assert len(figures.draw(evidence).axes) == 12
    assert len(figures.draw_bem(evidence).axes) == 8
    assert len(figures.draw_solver(evidence).axes) == 4


@pytest.mark.parametrize("side", ["above", "below"])
def test_crossings_of_a_power_law(side):
    """y = x^2 is past 4 from x = 2 on; mirrored, y = 16 / x^2 up to there."""
    x = np.geomspace(0.1, 30, 12)
    error = x**2 if side == "above" else 16 / x**2
    limit = replace(STEEP, failing_side=side)
    sweep = Sweep(limit, x, error, 2.0, tuple("words" if e > 4 else "" for e in error))
    where, half = sweep.crossing
    assert where == pytest.approx(2.0, rel=1e-9)
    assert half == pytest.approx(np.log2(x[1] / x[0]) / 2)
    assert sweep.predicted
    assert (sweep.share_of_correct_warnings, sweep.verdict, sweep.first_message) == (1.0, "warned", "words")
    far = replace(sweep, predicted_threshold=20.0 if side == "above" else 0.2)
    assert not far.predicted
    assert far.share_of_correct_warnings < 1


def test_sweeps_without_a_crossing():
    x = np.array([1.0, 1.9, 2.1, 9.0])
    assert Sweep(STEEP, x, np.zeros(4), 2.0, ("",) * 4).crossing is None
    assert Sweep(STEEP, x, np.full(4, 9.0), 2.0, ("",) * 4).crossing is None
    refused = Sweep(STEEP, x, np.array([1.0, 1.0, np.inf, np.inf]), 2.0, ("", "", "no", "no"))
    assert refused.crossing[0] == pytest.approx(np.sqrt(1.9 * 2.1))
    assert refused.predicted
    assert refused.verdict == "warned"
    assert replace(refused, messages=("", "", "", "no")).verdict == "warned"
    assert replace(refused, messages=("no", "", "", "no")).verdict == "warned at 1 of 1, too early"


def test_sweeps_are_put_in_order():
    outcome = swept(STEEP, [3.0, 1.0, 2.0], [(9.0, "c"), (1.0, "a"), (4.0, "b")], 2.0)
    sweep = Sweep.of(STEEP, outcome)
    assert sweep.values.tolist() == [1.0, 2.0, 3.0]
    assert sweep.error.tolist() == [1.0, 4.0, 9.0]
    assert sweep.messages == ("a", "b", "c")


def test_warnings_and_refusals_are_recorded():
    band = mdr.SelfAffine(hurst=0.7, q_min=7.0, q_max=50.0, rms=1e-6)
    draw = {"length": 1.0, "rng": np.random.default_rng(0)}
    assert call_and_record_warnings(lambda: mdr.rough_profile(band.c1d, points=64, **draw))[1] == ""
    height, words = call_and_record_warnings(lambda: mdr.rough_profile(band.c1d, points=20, **draw))
    assert height.size == 20
    assert words.startswith("SpringResolutionWarning: the shortest wave")
    nothing, words = call_and_record_warnings(lambda: mdr.rough_profile(band.c1d, points=10, **draw))
    assert nothing is None
    assert words.startswith("ValueError: c1d must vanish")
    with pytest.raises(TypeError):
        call_and_record_warnings(lambda: mdr.rough_profile(None, points=10, **draw))


def test_sum_over_the_lattice_by_ewald():
    """sum' 1 / n less its mean = 2 sum' erfc(sqrt(pi) n) / n - 4 over the square lattice."""
    i = np.arange(-6, 7)
    n = np.hypot(i[:, np.newaxis], i)
    n = n[n > 0]
    assert 2 * np.sum(special.erfc(np.sqrt(np.pi) * n) / n) - 4 == pytest.approx(-spheres.LATTICE, rel=1e-6)


def test_stiffness_of_a_lone_cell():
    body = bem3d.HalfSpace(shape=(1, 1), spacing=0.3, modulus=2.0)
    k = 0.3**2 / dense_operator(body)[0, 0]
    assert k / (2.0 * 0.3) == pytest.approx(spheres.LONE_CELL, rel=1e-9)


def test_images_err_as_the_lattice_sum_says():
    """1.655 a / L, but for (a / L)^3 of the forces of images that are no points, and the kernels of the cells."""
    small = spheres.Spheres(coarse=(), places=1, periods=(6, 12, 24), fine=8, sides=(), finer=1, heights=())
    found = spheres.sweep_period(small)
    expected = spheres.LATTICE * 4 / (3 * np.pi) / found["images values"]
    assert found["images error"] == pytest.approx(expected, rel=0.025)


def test_a_stretched_surface_by_another_quadrature():
    """Isotropic it is force_variance; of short waves the variance does not depend on the ratio."""
    long, short = self_affine(0.7, 0.5, 4.0), self_affine(0.7, 100.0, 400.0)
    exact = force_variance(long.c2d, edges=long.edges, contact_radius=1.0, modulus=1.0)
    assert isotropy.stretched_variance(long, 1.0) == pytest.approx(exact, rel=1e-5)
    one, four = (isotropy.stretched_variance(short, ratio, lines=6000) for ratio in (1.0, 4.0))
    assert four == pytest.approx(one, rel=0.02)
    nothing = isotropy.stretched_variance(self_affine(0.7, 1e-3, 2e-3), 4.0)
    assert nothing == pytest.approx(4.0, rel=1e-4)


def test_theory_of_small_changes_of_energy():
    """Thresholds of explicit Euler and of Runge-Kutta, from the product of their factors over a turn."""
    outcome = time_stepping.TimeSteps(verlet=(1.0,), euler=(0.01, 0.02), kutta=(0.9, 1.1), turns=6).sweep()
    x = float(outcome["Euler threshold"])
    assert (1 + x**2) ** (2 * np.pi / x) - 1 == pytest.approx(time_stepping.EULER.tolerance, rel=2 * x)
    x = float(outcome["Runge-Kutta threshold"])
    assert 1 - (1 - x**6 / 72) ** (2 * np.pi / x) == pytest.approx(time_stepping.KUTTA.tolerance, rel=x**6 / 72)


@pytest.mark.slow
def test_a_residual_that_forgives_is_noticed(result):
    forgiving = [(grid, {**found, "residual": 1e-3 * found["residual"]}) for grid, found in result.judged]
    numbers = limits_evidence.evidence(replace(result, judged=forgiving)).numbers
    assert {n.verdict for n in numbers_with(numbers, "largest ratio of the true error to the residual")} == {
        Verdict.DIFFER
    }


@pytest.mark.slow
def test_iterations_that_grow_are_noticed(result):
    growing = [(g, {**found, "iterations": found["iterations"] * g.cells}) for g, found in result.iterated]
    numbers = limits_evidence.evidence(replace(result, iterated=growing)).numbers
    found = [n for solver in EXPECTED_EXPONENTS for n in numbers_with(numbers, model=solver)]
    assert len(found) == 6 and Verdict.AGREE not in {n.verdict for n in found}


@pytest.mark.slow
def test_input_without_an_answer_is_refused(result):
    answers = {str(row["call"]): str(row["answer"]) for row in result.unanswered}
    assert answers["bem3d.solve, zero force"] == "force 0, stiffness 0"
    assert answers["bem3d.solve, infinite force"] == "ValueError: force must be finite, got inf"
    assert answers["bem3d.solve, one NaN cell"].startswith("ValueError: gap must be finite, got 1 NaN or infinite")
    assert answers["bem3d.solve, one infinite cell"].startswith("ValueError: gap must be finite")
    assert answers["bem3d.solve, periodic, full contact under a force"] == "force 1000, stiffness inf"
    assert answers["mdr.load_curve, one NaN height"].startswith("ValueError: height must be finite")
