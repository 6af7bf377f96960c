"""The ladder: it climbs as far as a tolerance asks and no farther, says why, and its claims are honest."""

import dataclasses
import functools
import math
import warnings
from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import integrate

import bem3d
import mdr
from tests.advice.by_kind import CHEAP, estimates_by_kind, grid_of, grids_of, model_of_kind
from tests.advice.planted_answers import PARTS, ROUGH, Fake, Finding, compared, punch, wheel
from tests.seeded import Times, catches, module_with
from validation.advice import calibration_scenes
from validation.advice.cases.random_scenes import KINDS, random_scene
from validation.advice.compare import compare
from validation.advice.hierarchy import needed, select_model
from validation.advice.models import boundary_elements_pressed
from validation.advice.models_of_scene import all_quantities, models_of, quantities_of
from validation.advice.summary import bands_of, summary
from validation.railway.problems.rail_quantity import RAIL_QUANTITIES
from validation.report.contents import CASES
from validation.scenes.indentation import IndentationScene
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.rolling import RollingQuantity
from validation.simulation import indentation as pressed_heights
from validation.simulation import rolling_levels as rolled
from validation.simulation.method import distance, mean_error
from validation.simulation.rough_punch import STIFFNESS_ERROR
from validation.theory import rolling


def rough(shape, spacing, *, first=1.0, last=8.0, hurst=0.7, rms=1e-3, seed=2):
    """Heights of a self-affine surface, from the longest wave to the shortest: so many on a length of one."""
    waves = mdr.SelfAffine(hurst=hurst, q_min=2 * np.pi * first, q_max=2 * np.pi * last, rms=rms)
    return bem3d.rough_surface(waves.c2d, shape=shape, spacing=spacing, rng=np.random.default_rng(seed), rms=rms)


def measured(height, spacing):
    return MeasuredHeights(height=height, spacing=(spacing, spacing))


def pressed_stiffness(height, spacing, load):
    """Of boundary elements on these points."""
    half_space = bem3d.HalfSpace(shape=height.shape, spacing=spacing, modulus=1.0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bem3d.ContactWarning)
        return bem3d.solve(half_space, -height, force=load, tolerance=1e-4).stiffness()


# The climb


CLIMB = ["skipped", "not accurate enough", "failed"]


@pytest.mark.parametrize(
    ("claims", "errors", "expected", "best"),
    [
        ((0.2, 0.1), (0.1, 0.05), ["skipped", "accepted"], 1),
        ((0.5, 0, 0, 0, 0), (0, 0.2, None, 0, 0), [*CLIMB, "accepted", "not needed"], 3),
        # an error of just the tolerance meets it
        ((0.1, 0.1), (0.11, 0.1), ["not accurate enough", "accepted"], 1),
        ((0.1, 0.1, 0.1), (0.1, 0.0, 0.0), ["accepted", "not needed", "not needed"], 0),
        # where none meets it, the one that leaves least, though it was skipped at first, or is not the last
        ((0.2, 0.15, 0.0), (0.15, 0.12, 0.3), ["skipped", "not accurate enough", "not accurate enough"], 1),
        ((0.5, 0.0), (0.0, 0.3), ["skipped", "not accurate enough"], 1),
        ((0.1, 0.5), (0.2, 0.01), ["not accurate enough", "skipped"], 0),
        ((0.0, 0.0), (0.2, 0.3), ["not accurate enough"] * 2, 0),
        # what the first of them finds may be more than another claims
        ((0.2, 0.11), (0.2, 0.3), ["not accurate enough"] * 2, 0),
        # of equal claims the finest grid is asked
        ((0.5, 0.5), (0.4, 0.2), ["skipped", "not accurate enough"], 1),
        ((0.0, 0.0, 0.0), (0.3, 0.2, None), ["not accurate enough", "not accurate enough", "failed"], 1),
        ((0.01, 0.05), (None, 0.04), ["failed", "accepted"], 1),
        # no answer at all
        ((0.0,), (None,), ["failed"], None),
        ((math.inf,), (0.0,), ["out of range"], None),
    ],
)
def test_what_becomes_of_models(claims, errors, expected, best):
    """Of a tolerance of 0.1; an error of None fails, however small its claim."""
    models = [
        Fake(claimed=c, left=e or 0.0, failed="lost" if e is None else "") for c, e in zip(claims, errors, strict=True)
    ]
    found = select_model(models, 0.1)
    assert [candidate.status for candidate in found.candidates] == expected
    assert found.met == ("accepted" in expected)
    assert (found.best and found.best.model) is (None if best is None else models[best])


@dataclass(frozen=True)
class Raising(Fake):
    problem: Exception | None = None

    def solve(self):
        raise self.problem


@pytest.mark.parametrize(
    "problem",
    [ValueError("no wave"), ZeroDivisionError("by zero"), MemoryError(), bem3d.ConvergenceError("residual", (), None)],
)
def test_a_solve_that_raises_is_a_row_and_the_others_go_on(problem):
    found = select_model([Raising(problem=problem), Fake()], 0.1)
    assert [one.status for one in found.candidates] == ["failed", "accepted"]
    assert found.candidates[0].reason == (str(problem) or "MemoryError")
    assert found.candidates[0].answer.error == math.inf and np.isnan(found.candidates[0].answer.value).all()


def test_a_grid_that_was_solved_as_a_reference_is_not_solved_again():
    """A climb over three grids costs what the finest and its references do, but for the coarsest reference of all."""
    models = grids_of(punch(), "stiffness", 1e-3, seed=3)
    first, *_, last = [model.solve() for model in models]
    alone = grid_of(punch(), 1e-3, 3, round(models[-1].resolution.size)).solve()
    assert last.value == alone.value and last.error == alone.error
    finer = models[-1].resolution.size ** 2 / models[0].resolution.size ** 2
    assert last.cost.work == pytest.approx(8 * 19 * models[-1].resolution.size ** 2)
    assert alone.cost.work == pytest.approx(last.cost.work * (1 + 1 / 4 + 1 / 16))
    assert first.cost.work * finer == pytest.approx(alone.cost.work)


def test_a_distance_is_over_all_numbers():
    assert distance(np.array([2.0, 1.0]), np.array([1.0, 1.0])) == pytest.approx(math.log(2) / math.sqrt(2))
    assert distance(np.array([1.1]), np.array([1.0])) == pytest.approx(distance(np.array([1.0]), np.array([1.1])))


@catches("one standard error for a 95 % interval").at(
    f"{__name__}.mean_error", lambda ratios: float(np.sqrt(np.mean(ratios.var(axis=0, ddof=1) / len(ratios))))
)
@pytest.mark.slow
def test_the_error_of_a_mean_covers_it_in_95_of_100():
    rng = np.random.default_rng(5)
    draws = rng.standard_normal((4000, 6))
    inside = np.array([abs(row.mean()) <= mean_error(row[:, np.newaxis]) for row in draws])
    # two standard errors of a share of 4000
    assert inside.mean() == pytest.approx(0.95, abs=2 * math.sqrt(0.95 * 0.05 / 4000))


# Models of a pressed body


def test_smooth_bodies_need_a_formula():
    smooth = punch(ground=None, load=1.0)
    found = compare(smooth, tolerance=1e-9)
    assert found.selection.best.model.name == "closed form"
    assert found.selection.best.answer.value[0] == pytest.approx(1.1523, rel=1e-12)
    sphere = replace(smooth, shape="sphere", size=0.5, load=4 / 3 * math.sqrt(0.5) * 1e-3**1.5)
    assert compare(sphere, tolerance=1e-9).selection.best.answer.value[0] == pytest.approx(2 * math.sqrt(0.5 * 1e-3))


def test_a_heavily_loaded_punch_is_a_flat_one_on_its_rough_face():
    for load, model in ((30.0, "fit"), (1.0, "fit"), (0.003, "boundary elements 64²")):
        assert needed(models_of(punch(load=load), "stiffness", 0.1, 0), 0.1).name == model
    # the lower the load, the less the face is an interface; and one face is not the mean of all
    fits = [model_of_kind("fit", punch(load=load), "stiffness", 0.1) for load in (0.01, 0.1, 1.0, 100.0)]
    errors = [model.estimate().error for model in fits]
    assert errors == sorted(errors, reverse=True)


@catches("twice the separation of a rough face", load=1.0).at("validation.theory.closed_forms.INTERFACE", 0.96)
@pytest.mark.parametrize("load", [0.3, 1.0, 3.0])
def test_the_law_of_interfaces_holds_as_it_claims(load):
    fit = model_of_kind("fit", punch(load=load), "stiffness", 0.2, seed=8)
    found = grids_of(punch(load=load), "stiffness", 0.2, seed=8)[-2].solve()
    assert distance(fit.solve().value, found.value) <= fit.estimate().error + found.error


def test_springs_are_the_mean_of_load_curves():
    model, another = (model_of_kind("springs", punch(), "stiffness", 0.2, seed) for seed in (3, 4))
    answer = model.solve()
    assert answer.sample <= 1.5 * model.target.tolerance / 5
    other = another.solve()
    # both have two standard errors: half as much again is one in a thousand
    assert 0 < distance(answer.value, other.value) <= 1.5 * math.hypot(answer.sample, other.sample)
    rng, drawn = np.random.default_rng(9), []
    for _ in range(200):
        profile = mdr.rough_profile(ROUGH.spectrum.c1d, length=1.0, points=512, rng=rng, rms=ROUGH.rms)
        drawn.append(mdr.load_curve(profile, length=1.0, modulus=1.0).at_force(1e-4).stiffness)
    error = 2 * np.std(drawn) / np.mean(drawn) / math.sqrt(len(drawn))
    assert distance(answer.value, np.mean(drawn)) <= 1.5 * math.hypot(answer.sample, error)


def test_boundary_elements_are_those_of_the_solver():
    model = grid_of(punch(), 0.15, 3, 32)
    answer = model.solve()
    surfaces = int(answer.reason.rsplit(" ", 1)[1])
    assert surfaces > 8 and answer.error <= 0.15
    heights = (pressed_heights.height_of(punch(), 32, i, seed=3) for i in range(surfaces))
    drawn = [pressed_stiffness(height, 1 / 32, punch().load) for height in heights]
    assert answer.value[0] == pytest.approx(np.mean(drawn), rel=STIFFNESS_ERROR)
    assert answer.sample == pytest.approx(mean_error(np.array(drawn)[:, np.newaxis] / np.mean(drawn)), rel=1e-3)


drawn_on_a_grid = pressed_heights._drawn


def other_waves_on_every_grid(ground, shortest, cells, side, rng):
    return drawn_on_a_grid(ground, shortest, cells, side, np.random.default_rng(cells))


@catches("other waves on every grid of the ladder").at(
    "validation.simulation.indentation._drawn", other_waves_on_every_grid
)
def test_waves_that_a_grid_cannot_carry_are_left_out_and_no_others_changed():
    fine, coarse, coarser = (pressed_heights.height_of(punch(), cells, 0, seed=3) for cells in (32, 16, 8))
    waves, fewer = np.fft.fft2(fine, norm="forward"), np.fft.fft2(coarse, norm="forward")
    assert fine.std() == pytest.approx(ROUGH.rms, rel=1e-9)
    for i, j in ((0, 1), (1, 2), (3, 1), (0, 4), (5, 5)):
        # cell centres of both grids lie half a cell apart
        turn = [np.exp(1j * np.pi * (i + j) / n) for n in (32, 16)]
        assert waves[i, j] / turn[0] == pytest.approx(fewer[i, j] / turn[1], rel=1e-9)
    # at two cells to a wave some of it has no phase; what is shorter is left out
    assert coarse.std() == pytest.approx(fine.std(), rel=1e-3)
    assert coarser.std() < 0.99 * coarse.std()


surfaces = boundary_elements_pressed.MODEL


@catches("a grid that leaves too much solved to the end of its sample").at(
    "validation.advice.models.boundary_elements_pressed.MODEL",
    dataclasses.replace(surfaces, grid_error=lambda *_: (0.0, "")),
)
def test_a_coarse_grid_knows_how_far_it_is_from_a_fine_one():
    tolerance = 0.4
    coarse, fine = (grid_of(punch(), tolerance, 3, n).solve() for n in (32, 64))
    assert distance(coarse.value, fine.value) <= coarse.grid


# Models of a wheel


def by_the_filter_of_one_dimension(q, c2d, *, edges, contact_radius, modulus):
    geike = functools.partial(mdr.geike, c2d=c2d)
    return rolling.force_spectrum_1d(q, geike, contact_radius=contact_radius, modulus=modulus)


@catches("Geike for the half-space under a wheel").at(
    "validation.scenes.rolling.force_spectrum_3d", by_the_filter_of_one_dimension
)
def test_the_expected_levels_are_integrals_of_the_spectrum():
    quantity = RollingQuantity(wheel(), "force-spectrum")
    found = quantity.expected(one_dimensional=False)
    ground = quantity.scene.ground

    def density(q):
        # by reciprocity with the flat punch, across the track
        def filtered(k):
            s = math.hypot(q, k)
            return (2 * math.sin(s) / s) ** 2 * float(ground.c2d(s))

        low, high = math.sqrt(max(ground.q_min**2 - q**2, 0.0)), math.sqrt(max(ground.q_max**2 - q**2, 0.0))
        return 2 * integrate.quad(filtered, low, high, epsabs=0, epsrel=1e-8)[0]

    for level, low, high in zip(found, quantity.bands.edges, quantity.bands.edges[1:], strict=False):
        assert level**2 == pytest.approx(2 * integrate.quad(density, low, high, epsrel=1e-5)[0], rel=1e-4)


@catches("a factor 2 lost in the variance of the force").at("validation.scenes.rolling.force_variance", Times(0.5))
def test_one_dimension_has_the_variance_of_the_force_and_not_its_levels():
    rms = RollingQuantity(wheel(), "force-rms")
    c2d = rms.scene.ground.c2d
    variance = 2 * math.pi * integrate.quad(lambda s: (2 * math.sin(s) / s) ** 2 * float(c2d(s)) * s, 1.0, 4.0)[0]
    assert rms.expected(one_dimensional=True)[0] ** 2 == pytest.approx(variance, rel=1e-8)
    levels = RollingQuantity(wheel(last=16.0), "force-spectrum")
    ratio = levels.expected(one_dimensional=True) / levels.expected(one_dimensional=False)
    # 4 dB at the most, but for the zeros of sin(q a), where it has nothing
    assert np.sqrt(np.mean(ratio[levels.bands.centres > 4] ** 2)) == pytest.approx(10 ** (4 / 20), rel=0.15)


@catches("one panel of a quadrature over decades", one_dimensional=False).at("validation.scenes.rolling.PANEL", 1e9)
@pytest.mark.parametrize("one_dimensional", [True, False])
def test_the_whole_is_the_root_of_the_sum_of_its_bands(one_dimensional):
    moving = wheel(first=1 / 100, last=4.0, mass=2.0, speed=400.0)
    bands = RollingQuantity(moving, "acceleration").expected(one_dimensional)
    whole = RollingQuantity(moving, "acceleration-rms").expected(one_dimensional)
    assert whole[0] ** 2 == pytest.approx(np.sum(bands**2), rel=1e-3)


@catches("no resonator between force and acceleration").at(
    "validation.scenes.rolling.RollingQuantity.transfer",
    lambda quantity, q: np.ones_like(q) / quantity.scene.body.mass,
)
def test_the_transfer_of_a_wheel_is_that_of_its_resonator():
    quantity = RollingQuantity(wheel(mass=2.0, speed=3.0), "acceleration")
    q = np.array([0.5, 2.0, 7.0])
    k, omega = 2.0, 3.0 * q
    assert quantity.transfer(q) == pytest.approx(omega**2 / np.abs(k - 2.0 * omega**2))
    assert quantity.transfer(np.array([1e6]))[0] == pytest.approx(1 / 2.0)
    assert quantity.bands.edges[0] >= 2 * math.sqrt(k / 2.0) / 3.0 * (1 - 1e-9)


TURN = 2 * np.pi
TRACK = measured(rough((104, 96), 1 / 8, first=1 / TURN, last=3 / TURN, rms=2e-3, seed=3), 1 / 8)
LOW_WHEELS = {
    "force-spectrum": wheel(height=1e-3, first=2.0),
    "acceleration-rms": wheel(height=1e-3, first=2.0, mass=1.0, speed=2.0),
    "force-rms": wheel(ground=TRACK),
}


@pytest.mark.slow
@pytest.mark.parametrize("quantity", LOW_WHEELS)
def test_boundary_elements_tend_to_linear_theory(quantity):
    """On drawn ground and on a measured track, which is rolled itself."""
    scene = LOW_WHEELS[quantity]
    found = grids_of(scene, quantity, 0.1, seed=1)[0].solve()
    linear = model_of_kind("linear filter, 3D", scene, quantity, 0.1, seed=1).solve()
    assert found.error < 0.2
    assert distance(found.value, linear.value) <= found.error + 0.01


def test_force_of_low_roughness_needs_a_filter_and_of_high_boundary_elements():
    assert compare(wheel(height=0.01), quantity="force-rms").selection.best.model.name == "linear filter, 1D"
    assert compare(wheel(height=0.01), quantity="force-spectrum").selection.best.model.name == "linear filter, 3D"
    high = needed(models_of(wheel(height=0.3), "force-spectrum", 0.1, 0), 0.1)
    assert high.name.startswith("boundary elements")


# All of them


@given(kind=st.sampled_from(KINDS), number=st.integers(0, 10**6), tolerance=st.floats(0.01, 1.0))
def test_models_are_asked_in_the_order_of_their_cost(kind, number, tolerance):
    scene = random_scene(kind, number, 0)
    for quantity in calibration_scenes.QUANTITIES[kind]:
        costs = [model.cost().seconds for model in models_of(scene, quantity, tolerance, 0)]
        solved = costs[-3 if kind in ("punch", "sphere") else -2 :]
        assert solved == sorted(solved)
        assert costs[-1] == max(costs)
        assert costs[0] == min(costs)


@pytest.mark.slow
@given(power=st.floats(-6, 6), length=st.floats(-6, 6))
def test_no_claim_depends_on_units(power, length):
    scene, other = wheel(height=0.1), wheel(height=0.1)
    e, m = 10**power, 10**length
    ground = replace(other.ground, rms=0.1 * m, longest=other.ground.longest * m, shortest=other.ground.shortest * m)
    other = replace(other, radius=m, load=4 / 3 * e * m**2, modulus=e, ground=ground)
    for one, two in zip(
        models_of(scene, "force-spectrum", 0.1, 0), models_of(other, "force-spectrum", 0.1, 0), strict=True
    ):
        assert one.estimate().error == pytest.approx(two.estimate().error, rel=1e-9)


def test_scenes_are_asked_for_what_they_have():
    of_punches = ("stiffness", "contact-area", "mean-gap")
    assert quantities_of(punch()) == of_punches
    assert quantities_of(wheel()) == ("force-rms", "force-spectrum")
    assert set(quantities_of(wheel(mass=1.0, speed=1.0))) == set(all_quantities()) - {*of_punches, *RAIL_QUANTITIES}
    with pytest.raises(ValueError, match=r"^quantity must be one of force-rms, force-spectrum for scene 'wheel'"):
        compare(wheel(), quantity="acceleration")


def test_every_case_states_which_model_it_needed():
    """What is enough for one quantity is not for another."""
    needs = {name: entry.model_needed(entry.quick) for name, entry in CASES.items()}
    assert all(needs.values())
    assert needs["hertz"] == "stiffness: closed form"
    rms, spectrum = needs["rolling"].split(". ")
    assert rms.removeprefix("force-rms: ") != spectrum.removeprefix("force-spectrum: ") != spectrum


def test_what_was_not_solved_has_cost_nothing():
    models = Fake(claimed=9.0, seconds=2.0), Fake(failed="lost", seconds=4.0), Finding(value=(2e7,)), Fake(seconds=8.0)
    told = " ".join(summary(compared(*models)).split())
    assert "solves: about 5 s, " in told and "that were not solved would have cost 10 s" in told


def test_measured_heights_are_pressed_themselves():
    scene = punch(ground=measured(rough((64, 64), 1 / 64), 1 / 64), load=0.1)
    found = grids_of(scene, "stiffness", 0.05)[-1].solve()
    assert found.value[0] == pytest.approx(
        pressed_stiffness(scene.ground.height, 1 / 64, scene.load), rel=5 * STIFFNESS_ERROR
    )
    assert found.sample == 0


def test_a_face_that_a_spectrum_does_not_tell_is_left_to_boundary_elements():
    height = np.zeros((64, 64))
    height[20:26, 20:26] = 1e-3
    scene = punch(ground=measured(height, 1 / 64), load=1.0)
    estimates = estimates_by_kind(scene, "stiffness", 0.3)
    assert estimates["fit"].error == estimates["springs"].error == math.inf
    assert "not Gaussian" in estimates["fit"].reason
    assert all(model.estimate().error < 0.3 for model in grids_of(scene, "stiffness", 0.3))


def test_faces_of_more_points_than_any_grid_answer_for_the_summits_that_a_mean_hides(monkeypatch):
    scene = punch(ground=measured(rough((128, 128), 1 / 128, last=32, seed=5), 1 / 128), load=0.1)
    (fine,) = (model.solve() for model in grids_of(scene, "stiffness", 0.2))
    monkeypatch.setattr(pressed_heights, "MANY_POINTS", 32)
    (coarse,) = (model.solve() for model in grids_of(scene, "stiffness", 0.2))
    assert distance(coarse.value, fine.value) <= coarse.error
    monkeypatch.setattr(boundary_elements_pressed, "hidden", lambda *_: 0.0)
    (blind,) = (model.solve() for model in grids_of(scene, "stiffness", 0.2))
    assert blind.error < coarse.error


def test_a_summit_beyond_four_times_the_roughness_is_under_the_sphere():
    # on the square of points up to 4 h the summit at 2.3 a is none: the stiffness is 2 % less
    radius, approach, spacing = 100.0, 0.01, 1 / 16
    height = rough((128, 128), spacing, first=1 / 4, last=2, hurst=0.8, rms=0.3 * approach)
    height[101:104, 63:66] += 3 * approach
    load, ground = 4 / 3 * math.sqrt(radius) * approach**1.5, measured(height, spacing)
    scene = IndentationScene(name="s", shape="sphere", size=radius, load=load, modulus=1.0, ground=ground)
    assert pressed_heights.side_of(scene) / 2 >= (103 - 64) * spacing
    x = (np.arange(128) - 63.5) * spacing
    whole = pressed_stiffness(ground.height - np.add.outer(x**2, x**2) / (2 * radius), spacing, load)
    (found,) = (model.solve() for model in grids_of(scene, "stiffness", 0.1))
    # both are solved to a residual of 1e-4, which leaves some 1e-3 of a single stiffness
    assert found.value[0] == pytest.approx(whole, rel=3e-3)


def at_points(heights, shape, cell):
    return heights.at(*((np.arange(n) - (n - 1) / 2) * cell for n in shape))


@catches("measured heights at points, not over cells").at(
    "validation.scenes.measured_heights.MeasuredHeights.mean_over_cells", at_points
)
def test_short_waves_of_a_measured_track_are_no_longer_ones():
    # cells of a / 8, and a wave of a / 7 along the track: at the centres alone one of a, of the same height
    x = (np.arange(1024) + 0.5) / 32
    height = 1e-3 * np.add.outer(np.cos(2 * np.pi * 7 * x), np.zeros(128))
    quantity = RollingQuantity(wheel(ground=measured(height, 1 / 32)), "force-rms")
    assert np.ptp(rolled.strip_of(quantity, 8, 0, 0)) < 0.25 * np.ptp(height)


def track(height, summit=0.0):
    """A wheel on a track 32 a long, heights over its approach, smooth below 2 a; a summit or a pit of 1.25 a by 2 a."""
    found = rough((128, 128), 1 / 4, first=1 / 8, last=1 / 2, rms=1.0, seed=1)[:, :24]
    found[62:67, 8:16] += summit
    return wheel(ground=measured(height * wheel().approach * found, 1 / 4))


@pytest.mark.parametrize("summit", [20.0, -20.0])
@pytest.mark.parametrize("quantity", ["force-rms", "force-spectrum"])
def test_linear_theory_says_nothing_of_single_summits_and_pits(summit, quantity):
    models = models_of(track(1e-3, summit), quantity, 0.3, 0)
    claims = [model.estimate() for model in models if model.kind in CHEAP]
    assert len(claims) == 3
    assert all(claim.error == math.inf and "not Gaussian" in claim.reason for claim in claims)


@pytest.mark.slow
def test_linear_theory_answers_for_bands_in_which_a_track_has_no_waves():
    scene = track(0.05)
    quantity = RollingQuantity(scene, "force-spectrum")
    linear = model_of_kind("linear filter, 3D", scene, "force-spectrum", 0.1)
    found = linear.solve()
    rolled_over = np.exp(rolled.on_boundary_elements(quantity, 12, 0, 0))
    # levels by linear theory where nothing excites the force are too low by more than was measured on drawn waves
    assert linear.estimate().error < distance(found.value, rolled_over) <= found.error


@catches("decibels of a power for those of a level", quantity="force-spectrum", unit="N").at(
    "validation.advice.tolerance.math", module_with(math, log10=lambda value: math.log10(value) / 2)
)
@catches("radians in a second told as hertz", quantity="acceleration", unit="m/s²").at(
    "validation.advice.compare.math", module_with(math, pi=0.5)
)
@pytest.mark.parametrize(("quantity", "unit"), [("force-spectrum", "N"), ("acceleration", "m/s²")])
def test_bands_are_told_with_wavenumber_frequency_and_level(quantity, unit):
    scene = wheel(first=1 / 20, mass=2.0, speed=400.0, radius=4.0, load=4 / 3 * 16)
    centres = RollingQuantity(scene, quantity).bands.centres
    levels = np.arange(1.0, centres.size + 1)
    found = compared(Finding(value=tuple(levels), parts=PARTS), scene=scene, quantity=quantity)
    # 20 lg 1.1202 = 0.99 dB
    assert (
        "± 12 % (0.99 dB) over all bands (95 %), of which model 10 %, discretisation 2 %, sampling 0.3 %; "
        in " ".join(summary(found).split())
    )
    columns = bands_of(found, found.model)
    assert list(columns)[-2:] == [f"level [dB re 1 {unit}]", "± [dB]"]
    wave, frequency, nominal, turns, rms, decibels, half = (np.array(cells, dtype=float) for cells in columns.values())
    assert wave == pytest.approx(2e3 * math.pi / centres, rel=1e-3)
    assert frequency == pytest.approx(400.0 * centres / (2 * math.pi), rel=1e-3)
    assert nominal == pytest.approx(frequency, rel=0.14)
    assert turns == pytest.approx(centres * scene.contact_radius, abs=0.006)
    assert rms == pytest.approx(levels, rel=1e-3)
    assert decibels == pytest.approx(20 * np.log10(levels), abs=0.051)
    assert set(half) == {0.99}
