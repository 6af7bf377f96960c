"""No claim outside of what was measured, no answer that stands on a handful of cells, no error bar without a limit."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

import bem3d
from validation import ladder as ladder_of_models
from validation import pressed_heights, rungs_pressed, rungs_pressed_grids
from validation.calibrated import outside
from validation.cases import ladder
from validation.compare import compare, rungs_of, told, wants_of
from validation.ladder import Answer, Cost, climb, grid_error
from validation.pressed_scene import PressedScene
from validation.random_scenes import KINDS, WANTED, random_scene
from validation.resolution import too_few
from validation.rolling_scene import RollingScene
from validation.roughness import Roughness


def punch(load=0.1, first=1, last=8, hurst=0.7, height=1e-3):
    ground = Roughness(rms=height, hurst=hurst, longest=1 / first, shortest=1 / last)
    return PressedScene(name="punch", shape="punch", size=1.0, load=load * height, modulus=1.0, ground=ground)


def rolling(height=0.03, first=1.0, last=4.0, hurst=0.7, shape="wheel"):
    # R = 10, d = 0.1, a = 1, E* = 1
    ground = Roughness(rms=0.1 * height, hurst=hurst, longest=2 * math.pi / first, shortest=2 * math.pi / last)
    given = {"load": 4 / 3 * 0.1, "modulus": 1.0, "ground": ground}
    if shape == "sphere":
        return PressedScene(name="sphere", shape="sphere", size=10.0, **given)
    return RollingScene(name="wheel", radius=10.0, **given)


def fates(comparison):
    return {step.rung.name: step.fate for step in comparison.climb.steps}


# Grids


def test_the_error_of_a_grid_covers_the_limit_of_a_series():
    rng = np.random.default_rng(11)
    inside = []
    for _ in range(4000):
        ratio, scatter = rng.uniform(0.1, 0.5), rng.uniform(0.0, 0.3)
        # what three grids leave of the limit, of eight realisations
        rest = [ratio**i * (1 + scatter * rng.standard_normal(8)) for i in range(3)]
        error = grid_error(rest[1] - rest[0], rest[2] - rest[1])
        inside.append(abs(float(rest[2].mean())) <= error)
    assert np.mean(inside) >= 0.95 - 2 * math.sqrt(0.95 * 0.05 / 4000)


def test_grids_that_do_not_converge_have_no_error_bar():
    # one cell in contact: each refinement makes it half as stiff
    assert grid_error(np.full(8, -math.log(2)), np.full(8, -math.log(2))) == math.inf
    noise = 0.01 * np.random.default_rng(3).standard_normal(8)
    assert grid_error(0.1 + noise, 0.2 + noise) == math.inf
    # what cannot be told from zero is covered by its sample
    student = stats.t(7).ppf(0.975) * noise.std(ddof=1) / math.sqrt(8)
    assert grid_error(noise, noise[::-1]) == pytest.approx(abs(noise.mean()) + student)
    for ratio in (0.5, 0.6, 0.75):
        rest = ratio**2 * 0.3
        assert grid_error(np.full(8, 0.3 * (1 - ratio)), np.full(8, 0.3 * ratio * (1 - ratio))) == pytest.approx(rest)


def test_an_answer_on_less_than_six_is_none():
    assert too_few(6, "cells") == ""
    assert too_few(5.5, "cells") == "half of the contacts have 5.5 cells or fewer: the answer would be that of the grid"


# Light loads


def summit_stiffness(scene, realisation, cells=64):
    """Hertz on the highest summit, its curvatures those of the Fourier series there: the limit of light loads."""
    surface = pressed_heights.height_of(scene, cells, realisation, seed=99)
    waves, q = np.fft.fft2(surface) / cells**2, 2 * np.pi * np.fft.fftfreq(cells)
    at = np.array(np.unravel_index(surface.argmax(), surface.shape), dtype=float)
    for _ in range(8):
        wave = waves * np.exp(1j * (q[:, np.newaxis] * at[0] + q * at[1]))
        slope = np.array([(1j * q[:, np.newaxis] * wave).sum().real, (1j * q * wave).sum().real])
        mixed = -(q[:, np.newaxis] * q * wave).sum().real
        bend = np.array([[-(q[:, np.newaxis] ** 2 * wave).sum().real, mixed], [mixed, -(q**2 * wave).sum().real]])
        at = at - np.linalg.solve(bend, slope)
    radius = 1 / (math.sqrt(np.linalg.det(bend)) * cells**2)
    return 2 * (0.75 * scene.load * radius) ** (1 / 3)


@pytest.mark.parametrize("load", [1e-6, 1e-5, 1e-4])
@pytest.mark.parametrize("last", [4, 8])
def test_light_loads_have_no_answer_unless_it_is_that_of_the_summits(load, last):
    scene = punch(load=load, last=last)
    found = compare(scene, tolerance=1.0)
    best = found.climb.best
    if best is not None:
        truth = np.mean([summit_stiffness(scene, i) for i in range(16)])
        # of sixteen summits; an ellipse taken for a circle
        assert abs(math.log(best.answer.value[0] / truth)) <= best.answer.error + 0.3
    assert fates(found)["springs"] == "out of range"
    assert fates(found)["closed form"] == "out of range"


def test_few_springs_and_few_cells_are_no_answer():
    scene = punch(load=1e-3, last=32)
    assert "springs or fewer" in rungs_of(scene, "stiffness", 0.5, 0)[1].solve().failed
    assert "cells or fewer" in rungs_pressed_grids.BoundaryElements(scene, 0.5, 0, 64).solve().failed
    assert set(fates(compare(punch(load=1e-6), tolerance=0.5)).values()) == {"out of range", "failed"}


def test_a_sphere_that_reaches_the_edge_of_its_grid_is_no_answer(monkeypatch):
    # a = 1
    for module in (pressed_heights, rungs_pressed_grids):
        monkeypatch.setattr(module, "side_of", lambda scene: 1.5)
    ball = rolling(height=0.1, first=4.5, last=9, shape="sphere")
    assert (
        rungs_pressed_grids.BoundaryElements(ball, 0.5, 0, 32).solve().failed.endswith("reached the edge of the grid")
    )


def test_a_contact_that_is_cut_short_is_no_answer(monkeypatch):
    solve = bem3d.solve
    monkeypatch.setattr(bem3d, "solve", lambda *a, **k: solve(*a, **{**k, "max_iterations": 1}))
    answer = rungs_pressed_grids.BoundaryElements(punch(), 0.5, 0, 32).solve()
    assert answer.failed.endswith("did not converge")
    assert answer.error == math.inf


# Ranges


INSIDE_AND_OUTSIDE = [
    ("h/d", rolling(height=0.99), rolling(height=1.01)),
    ("q a of the longest wave", rolling(first=1.99, last=8), rolling(first=2.01, last=8)),
    ("q a of the shortest wave", rolling(first=1.9, last=39), rolling(first=1.9, last=41)),
    ("longest over shortest wave", rolling(first=1, last=2.01), rolling(first=1, last=1.99)),
    ("longest over shortest wave", rolling(first=0.1, last=6.3), rolling(first=0.1, last=6.5)),
    ("Hurst exponent", rolling(hurst=0.21), rolling(hurst=0.19)),
    ("h/d", rolling(height=0.99, shape="sphere"), rolling(height=1.01, shape="sphere")),
    ("q a of the longest wave", rolling(first=1.99, shape="sphere"), rolling(first=2.01, last=8, shape="sphere")),
    ("q a of the shortest wave", rolling(last=19, shape="sphere"), rolling(first=1.5, last=21, shape="sphere")),
    ("longest over shortest wave", rolling(last=2.01, shape="sphere"), rolling(last=1.99, shape="sphere")),
    ("Hurst exponent", rolling(hurst=0.21, shape="sphere"), rolling(hurst=0.19, shape="sphere")),
    ("F / (E* h L)", punch(load=1.01e-3), punch(load=0.99e-3)),
    ("longest waves on a side", punch(first=5, last=20), punch(first=6, last=24)),
    ("longest over shortest wave", punch(last=3), punch(last=2.9)),
    ("longest over shortest wave", punch(last=64), punch(last=65)),
    ("Hurst exponent", punch(hurst=0.21), punch(hurst=0.19)),
]


@pytest.mark.parametrize(("name", "inside", "outside"), INSIDE_AND_OUTSIDE)
def test_beyond_what_was_measured_springs_and_filters_claim_nothing(name, inside, outside):
    for want in wants_of(inside):
        within, beyond = (
            {rung.model: rung.claim() for rung in rungs_of(scene, want, 0.1, 0)} for scene in (inside, outside)
        )
        for model in within.keys() - {"boundary elements", "closed form"}:
            assert within[model].in_range
            assert not beyond[model].in_range
            assert beyond[model].because.startswith(f"{name} = ")


@pytest.mark.parametrize(
    "scene", [punch(load=0.19), punch(load=1.0, first=6, last=24), rolling(height=1.1, shape="sphere")]
)
def test_beyond_what_was_measured_closed_forms_claim_nothing(scene):
    assert "its error was measured from" in rungs_of(scene, "stiffness", 0.1, 0)[0].claim().because


def test_what_is_outside_is_said_with_its_numbers():
    ranges = {"h/d": (0, 1), "F": (2, math.inf)}
    assert outside({"h/d": 1.0 + 1e-12, "F": 2.0}, ranges) == ""
    assert outside({"h/d": 1.5, "F": 2.0}, ranges) == "h/d = 1.5, its error was measured from 0 to 1 alone"
    assert outside({"h/d": 0.5, "F": 1.0}, ranges) == "F = 1, its error was measured from 2 on alone"
    assert outside({"F": math.nan}, ranges)
    assert outside({}, ranges) == ""


@pytest.mark.parametrize(("want", "tolerance"), [("force-spectrum", 10 ** (4 / 20) - 1), ("force-rms", 0.15)])
def test_waves_shorter_than_the_contact_are_left_to_boundary_elements(want, tolerance):
    a = 1.0
    ground = Roughness(rms=0.05 * 0.1, hurst=0.9, longest=0.6 * a, shortest=0.2 * a)
    scene = replace(rolling(), ground=ground)
    for rung in rungs_of(scene, want, tolerance, 0):
        assert rung.claim().in_range == (rung.model == "boundary elements")


def test_a_model_out_of_range_is_never_asked():
    class Refusing:
        model = name = "refusing"

        def cost(self):
            return Cost(work=1, unit="steps", seconds=1.0)

        def claim(self):
            return ladder_of_models.Claim.out_of_range("never measured")

        def solve(self):
            raise AssertionError("asked all the same")

    climbed = climb([Refusing()], 0.1)
    assert [step.fate for step in climbed.steps] == ["out of range"]
    assert climbed.best is None
    assert ladder_of_models.needed([Refusing()], 1e300) is None


# What cannot serve a scene is a row


@pytest.mark.parametrize(("first", "last"), [(1, 1.5), (4, 5), (8, 9)])
def test_narrow_bands_have_an_answer(first, last):
    found = compare(punch(first=first, last=last), tolerance=0.5)
    assert found.climb.met
    assert found.climb.best.rung.model == "boundary elements"


def test_a_band_without_a_wave_that_fits_is_a_row_with_its_reason():
    found = compare(punch(first=1.05, last=1.2), tolerance=0.5)
    assert not found.climb.met
    assert "no rung has an answer" in told(found)
    assert all(step.because for step in found.climb.steps)


@pytest.mark.parametrize("problem", [ValueError("no wave"), ZeroDivisionError("division by zero"), MemoryError()])
def test_a_solve_that_raises_is_a_row_and_the_others_go_on(problem, monkeypatch):
    def raising(self):
        raise problem

    monkeypatch.setattr(rungs_pressed.Springs, "solve", raising)
    found = compare(punch(load=0.1), tolerance=0.3)
    assert fates(found)["springs"] == "failed"
    assert found.climb.met
    step = found.climb.steps[1]
    assert step.because == (str(problem) or "MemoryError")
    assert step.answer.error == math.inf


# Memory and cost


def test_short_waves_are_counted_as_one_by_one(monkeypatch):
    ground = Roughness(rms=1e-3, hurst=0.4, longest=1.0, shortest=1 / 90)
    whole = pressed_heights._whole.__wrapped__
    one_by_one = whole(ground, 1.0)
    monkeypatch.setattr(pressed_heights, "LATTICE", 30)
    # waves near a circle are counted with an error of the order of its radius to the power of two thirds
    assert whole(ground, 1.0) == pytest.approx(one_by_one, rel=1e-3)
    assert whole(ground, 1.0) != one_by_one


def test_the_shortest_waves_cost_no_memory():
    for power in (3, 5, 9):
        ground = Roughness(rms=1e-3, hurst=0.7, longest=1.0, shortest=10.0**-power)
        scene = replace(punch(), ground=ground)
        assert pressed_heights.height_of(scene, 64, 0, 0).std() < 1e-3
        assert not rungs_of(scene, "stiffness", 0.2, 0)[1].claim().in_range


def test_profiles_in_blocks_are_those_drawn_at_once(monkeypatch):
    rung = rungs_pressed.Springs(punch(), 0.2, seed=3)
    whole = rung.solve()
    monkeypatch.setattr(rungs_pressed, "BLOCK", 7 * rung.points)
    assert rung.solve().value == whole.value
    assert rung.solve().sample == whole.sample


def test_what_does_not_fit_into_memory_is_said_before_it_is_begun():
    far = rolling(first=1e-7, last=1e-6, shape="sphere")
    assert "springs, more than" in rungs_of(far, "stiffness", 0.1, 0)[1].claim().because
    wide = rolling(first=1e-4, last=1e-3)
    claims = [rung.claim() for rung in rungs_of(wide, "force-rms", 0.1, 0)]
    assert claims[0].in_range
    assert "springs, more than" in claims[1].because
    assert all("cells, more than" in claim.because for claim in claims[2:])
    fine = rolling(first=1.0, last=200.0)
    assert "cells on the finest grids" in rungs_of(fine, "force-rms", 0.1, 0)[-1].claim().because


# Models by their own names


@pytest.mark.parametrize("kind", KINDS)
def test_every_model_has_its_claims_tested(kind):
    for number in range(12):
        scene = random_scene(kind, number, 0)
        for want in WANTED[kind]:
            rungs = rungs_of(scene, want, 0.1, 0)
            assert {ladder._rung_of(rung, rungs) for rung in rungs} <= set(ladder.RUNGS)


def test_a_model_that_the_case_does_not_know_is_an_error():
    class New(rungs_pressed.ClosedForm):
        model = name = "a new closed form"

    rungs = [New(punch()), *rungs_of(punch(), "stiffness", 0.1, 0)]
    with pytest.raises(
        ValueError, match=r"^the model of a rung must be one of closed form, .*, got a new closed form$"
    ):
        ladder._asked(rungs, "closed form", np.array([1.0]))


def test_a_model_out_of_range_is_not_counted_as_covered():
    scene = punch(load=1e-4)
    rungs = rungs_of(scene, "stiffness", 0.1, 0)
    assert np.isnan(ladder._asked(rungs, "springs", np.array([1.0]))).all()
    assert np.isnan(ladder._asked(rungs, ladder.COARSE, np.array([1.0]))).all()


def test_what_has_failed_leaves_everything_open():
    assert Answer(value=np.ones(1), cost=Cost(work=1, unit="", seconds=0), grid=math.inf).error == math.inf
