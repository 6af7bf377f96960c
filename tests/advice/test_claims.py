"""No claim outside of what was measured, no answer that stands on a handful of cells, no error bar without a limit."""

import dataclasses
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

import bem3d
from tests.advice.by_kind import OURS, estimates_by_kind, grid_of, grids_of, model_of_kind
from tests.advice.planted_answers import ROUGH, ball, punch, waves, wheel
from tests.seeded import catches, module_with
from validation.advice.calibration import calibrated
from validation.advice.compare import compare
from validation.advice.hierarchy import select_model
from validation.advice.models import boundary_elements_pressed, boundary_elements_rolling, pressed
from validation.advice.models import rolling as rolling_models
from validation.advice.models_of_scene import models_of, quantities_of
from validation.engine.realisations import random_generator
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.rolling import RollingQuantity
from validation.scenes.roughness import Roughness
from validation.simulation import indentation as pressed_heights
from validation.simulation import method, surface
from validation.simulation import rolling_levels as rolled
from validation.simulation.method import grid_error, mean_error
from validation.simulation.model import Target
from validation.theory.closed_forms import SQUARE_PUNCH
from validation.theory.rolling import contact_lost


def statuses(comparison):
    """By name, of the models that these tests are about."""
    candidates = comparison.selection.candidates
    return {candidate.name: candidate.status for candidate in candidates if candidate.model.kind in OURS}


# Grids


@pytest.mark.slow
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


def the_last_change_alone(earlier, last):
    return abs(float(last.mean())) + method.mean_error(last[:, np.newaxis])


@catches("grids that do not converge with the error bar of those that do").at(
    f"{__name__}.grid_error", the_last_change_alone
)
@catches("the error of a grid without that of its sample").at("validation.simulation.method.mean_error", lambda _: 0.0)
def test_grids_that_do_not_converge_have_no_error_bar():
    # one cell in contact: each refinement makes it half as stiff
    assert grid_error(np.full(8, -math.log(2)), np.full(8, -math.log(2))) == math.inf
    noise = 0.01 * np.random.default_rng(3).standard_normal(8)
    assert grid_error(0.1 + noise, 0.2 + noise) == math.inf
    # what cannot be told from zero is covered by its sample
    student = stats.t(7).ppf(0.975) * noise.std(ddof=1) / math.sqrt(8)
    assert grid_error(noise, noise[::-1]) == pytest.approx(abs(noise.mean()) + student)


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


@catches("a punch without the error at its edge", cells=32).at(
    "validation.advice.models.boundary_elements_pressed.edge_error", lambda scene, cells: 0.0
)
@pytest.mark.parametrize("cells", [32, 64])
def test_a_pressed_face_claims_no_less_than_the_edge_of_the_flat_punch(cells):
    """In nearly full contact, where the waves that a grid leaves out may hide it in the change of the grid."""
    half_space = bem3d.HalfSpace(shape=(cells, cells), spacing=1 / cells, modulus=1.0)
    flat = 1 - bem3d.solve(half_space, np.zeros(half_space.shape), approach=1e-3).stiffness() / SQUARE_PUNCH
    with pytest.MonkeyPatch.context() as hidden:
        hidden.setattr(boundary_elements_pressed, "grid_error", lambda *changes: 0.0)
        assert grid_of(punch(load=43.0, ground=waves(last=cells // 4)), 0.3, 0, cells).solve().grid >= 0.95 * flat


@pytest.mark.slow
@pytest.mark.parametrize("load", [1e-6, 1e-5, 1e-4])
@pytest.mark.parametrize("last", [4, 8])
def test_light_loads_have_no_answer_unless_it_is_that_of_the_summits(load, last):
    scene = punch(load=load, ground=waves(last=last))
    found = compare(scene, tolerance=1.0)
    best = found.selection.best
    if best is not None:
        truth = np.mean([summit_stiffness(scene, i) for i in range(16)])
        # of sixteen summits; an ellipse taken for a circle
        assert abs(math.log(best.answer.value[0] / truth)) <= best.answer.error + 0.3
    assert statuses(found)["springs"] == "out of range"
    assert statuses(found)["fit"] == "out of range"


@catches("an answer that stands on one cell").at("validation.advice.scene_model.too_few", lambda *_: "")
@pytest.mark.slow
def test_few_springs_and_few_cells_are_no_answer():
    scene = punch(load=1e-3, ground=waves(last=32))
    assert "springs or fewer" in model_of_kind("springs", scene, "stiffness", 0.5).solve().failed
    assert "cells or fewer" in grid_of(scene, 0.5, 0, 64).solve().failed
    assert set(statuses(compare(punch(load=1e-6), tolerance=0.5)).values()) == {"out of range", "failed"}


def test_a_sphere_that_reaches_the_edge_of_its_grid_is_no_answer(monkeypatch):
    # a = 1
    for module in (pressed_heights, boundary_elements_pressed):
        monkeypatch.setattr(module, "side_of", lambda scene: 1.5)
    assert grid_of(ball(0.1, 4.5, 9), 0.5, 0, 32).solve().failed.endswith("the contact reached the edge of the grid")


def test_a_contact_that_is_cut_short_is_no_answer(monkeypatch):
    solve = bem3d.solve
    monkeypatch.setattr(bem3d, "solve", lambda *a, **k: solve(*a, **{**k, "max_iterations": 1}))
    answer = grid_of(punch(), 0.5, 0, 32).solve()
    assert answer.failed.endswith("did not converge")
    assert answer.error == math.inf


# Ranges


INSIDE_AND_OUTSIDE = [
    ("h/d", wheel(height=0.99), wheel(height=1.5)),
    ("q a of the longest wave", wheel(first=1.99, last=8), wheel(first=3.0, last=12)),
    ("q a of the shortest wave", wheel(first=1.9, last=39), wheel(first=1.9, last=41)),
    ("longest over shortest wave", wheel(first=0.1, last=6.3), wheel(first=0.1, last=6.5)),
    ("Hurst exponent", wheel(hurst=0.21), wheel(hurst=0.04)),
]


def formula_of(scene):
    """The kind of the model that is a formula."""
    return "fit" if scene.shape == "punch" else "closed form"


@pytest.mark.parametrize(("name", "inside", "outside"), INSIDE_AND_OUTSIDE)
def test_beyond_what_was_measured_springs_and_filters_claim_nothing(name, inside, outside):
    for quantity in quantities_of(inside):
        within, beyond = (estimates_by_kind(scene, quantity, 0.1) for scene in (inside, outside))
        for model in within.keys() - {"boundary elements", "closed form", "fit"}:
            assert within[model].in_range
            assert not beyond[model].in_range
            assert beyond[model].reason.startswith(f"{name} = ")


@catches("a linear filter for waves shorter than the contact", quantity="force-rms", tolerance=0.15).at(
    "validation.advice.calibration.outside", lambda *_: ""
)
@pytest.mark.parametrize(("quantity", "tolerance"), [("force-spectrum", 10 ** (4 / 20) - 1), ("force-rms", 0.15)])
def test_waves_shorter_than_the_contact_are_left_to_boundary_elements(quantity, tolerance):
    scene = wheel(ground=Roughness(rms=0.05, hurst=0.9, longest=0.6, shortest=0.2))
    for kind, estimate in estimates_by_kind(scene, quantity, tolerance).items():
        assert estimate.in_range == (kind == "boundary elements")


# What cannot serve a scene is a row


def test_a_band_without_a_wave_that_fits_is_a_row_with_its_reason():
    assert compare(punch(ground=waves(first=8, last=9)), tolerance=0.5).selection.met
    scene = punch(ground=waves(first=1.05, last=1.2))
    models = [model for model in models_of(scene, "stiffness", 0.5, 0) if model.kind in OURS]
    found = select_model(models, 0.5)
    assert not found.met and not found.solved
    assert all(candidate.reason for candidate in found.candidates)


# Memory and cost


def test_short_waves_are_counted_as_one_by_one(monkeypatch):
    ground = waves(last=90, hurst=0.4)
    whole = pressed_heights._rms_factor.__wrapped__
    one_by_one = whole(ground, 1.0)
    monkeypatch.setattr(pressed_heights, "LATTICE", 30)
    # waves near a circle are counted with an error of the order of its radius to the power of two thirds
    assert whole(ground, 1.0) == pytest.approx(one_by_one, rel=1e-3)
    assert whole(ground, 1.0) != one_by_one


def test_the_shortest_waves_cost_no_memory():
    for power in (3, 5, 9):
        scene = punch(ground=waves(last=10.0**power))
        assert pressed_heights.height_of(scene, 64, 0, 0).std() < 1e-3
        assert not model_of_kind("springs", scene, "stiffness", 0.2).estimate().in_range


def test_profiles_in_blocks_are_those_drawn_at_once(monkeypatch):
    model = model_of_kind("springs", punch(), "stiffness", 0.2, seed=3)
    whole = model.solve()
    monkeypatch.setattr(pressed, "BLOCK", 7 * round(model.resolution.size))
    assert model.solve().value == whole.value
    assert model.solve().sample == whole.sample


def test_what_does_not_fit_into_memory_is_said_before_it_is_begun():
    far = ball(0.03, 1e-7, 1e-6)
    assert "springs, more than" in model_of_kind("springs", far, "stiffness", 0.1).estimate().reason
    wide = wheel(first=1e-4, last=1e-3)
    estimates = estimates_by_kind(wide, "force-rms", 0.1)
    assert estimates["linear filter, 1D"].in_range
    assert "springs, more than" in estimates["springs"].reason
    grids = grids_of(wide, "force-rms", 0.1)
    assert len(grids) == 2 and all("cells, more than" in model.estimate().reason for model in grids)
    fine = wheel(first=1.0, last=200.0)
    assert "cells on the finest grids" in grids_of(fine, "force-rms", 0.1)[-1].estimate().reason


# Error bars of grids and samples, by hand


def without_the_noise_of_its_series(earlier, last):
    before, after = (abs(float(change.mean())) for change in (earlier, last))
    ratio = min(after / before, method.SLOWEST)
    return after * max(1.0, ratio / (1 - ratio)) + method.mean_error(last[:, np.newaxis])


@catches("a series of grids without the noise of its last change", ratio=0.75, factor=3.0).at(
    f"{__name__}.grid_error", without_the_noise_of_its_series
)
@pytest.mark.parametrize(
    ("ratio", "factor"), [(0.25, 1.0), (0.5, 1.0), (0.75, 3.0), (0.82, 4.0), (0.9, 9.0), (1.01, math.inf)]
)
def test_what_a_grid_leaves_is_the_rest_of_its_series_and_of_its_sample(ratio, factor):
    """The noise of the last change is extended with it; a ratio of 0.8 within its noise is taken for that."""
    scatter = 0.01 * np.array([1.0, -1.0] * 4)
    noise = stats.t(7).ppf(0.975) * 0.01 * math.sqrt(8 / 7) / math.sqrt(8)
    last = ratio * 0.3
    assert grid_error(0.3 + scatter, last + scatter) == pytest.approx(factor * (last + noise), rel=1e-12)
    assert grid_error(-0.3 + scatter, -last + scatter) == pytest.approx(factor * (last + noise), rel=1e-12)


def mean_over_bands(ratios):
    return float(np.mean([method.mean_error(band[:, np.newaxis]) for band in ratios.T]))


@catches("quiet bands in the error of loud ones").at(f"{__name__}.mean_error", mean_over_bands)
def test_the_error_over_bands_is_their_root_mean_square():
    """The loudest band decides, as it does in the distance between two answers."""
    one, other = 0.1 * np.array([1.0, -1.0] * 3), 0.4 * np.array([1.0, -1.0] * 3)
    together = mean_error(np.stack([one, other], axis=1))
    alone = [mean_error(column[:, np.newaxis]) for column in (one, other)]
    assert together == pytest.approx(math.hypot(*alone) / math.sqrt(2), rel=1e-12)


@pytest.mark.parametrize(
    ("cells", "changes", "split", "error"),
    [
        (64, (0.1, 0.15, 0.2), (), 0.15),
        (32, (0.1, 0.15, 0.2), (), 0.3),
        (16, (0.1, 0.15, 0.2), (), 0.45),
        (64, (-0.01, 0.1, 0.2), (), 0.075),
        # changes that cancel leave no less than those before
        (64, (1e-4, 1e-4, 0.4), (), 1.5 * 0.1),
        (64, (1e-5, 1e-5, 1e-4), (), 1.5 * 0.35 / 64),
        (64, (0.2, 0.15, 0.1), (), math.inf),
        # points that are split leave twice what that changes, and some of the coarser grids
        (64, (0.1, 0.1, 0.1), (-0.05,), 0.1),
        # a change that passes through zero
        (64, (0.15, 0.1, 0.1), (0.0,), 0.1),
        (64, (0.1, 0.3, 0.1), (0.0,), 0.1),
        (64, (0.1, 0.1, 0.6), (0.0,), 0.1),
        (64, (0.0, 0.0, 0.0), (0.0,), 2 * 0.35 / 64),
    ],
)
def test_a_single_face_leaves_its_change_and_as_much_for_each_doubling_to_come(cells, changes, split, error):
    """Half as much again of the last change, of half of that before, or of the edge of a punch, whichever is more."""
    height = 1e-3 * np.random.default_rng(4).standard_normal((64, 64))
    scene = replace(punch(), ground=MeasuredHeights(height=height, spacing=(1 / 64, 1 / 64)))
    left = boundary_elements_pressed.grid_error_of_one(scene, cells, np.array(changes), np.array(split))
    assert left == pytest.approx(error)


surfaces = boundary_elements_pressed.MODEL


def another_surface_on_coarser_grids(target, resolution):
    solve = surfaces.prepare(target, resolution)
    return (lambda surface: solve(surface + 1)) if resolution.size < 32 else solve


@catches("coarser grids on other surfaces").at(
    "validation.advice.models.boundary_elements_pressed.MODEL",
    dataclasses.replace(surfaces, prepare=another_surface_on_coarser_grids),
)
def test_grids_are_compared_on_the_same_surfaces():
    seen = []

    def recorded(scene, cells, realisation, seed):
        seen.append((cells, realisation, seed))
        return height_of(scene, cells, realisation, seed)

    height_of = pressed_heights.height_of
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(boundary_elements_pressed, "height_of", recorded)
        grid_of(punch(), 0.8, 3, 32).solve()
    fine = [(32, i, 3) for i in range(len(seen) - 16)]
    assert sorted(seen) == sorted([*fine, *((cells, i, 3) for cells in (8, 16) for i in range(8))])


def the_same_every_time(entropy, *key):
    return random_generator(entropy, *key[:-1], 0)


@catches("one surface for all").at("validation.simulation.indentation.random_generator", the_same_every_time)
@catches("one strip and one track for all").at(
    "validation.simulation.rolling_levels.random_generator", the_same_every_time
)
def test_realisations_are_others():
    def heights(realisation, seed):
        return pressed_heights.height_of(punch(), 32, realisation, seed).ravel()

    def strips(realisation, seed):
        return rolled.strip_of(RollingQuantity(wheel(), "force-rms"), 4, realisation, seed).ravel()

    for draw in (heights, strips):
        assert (draw(1, 3) == draw(1, 3)).all()
        for realisation, seed in ((0, 3), (1, 4)):
            # of some hundred waves
            assert abs(np.corrcoef(draw(1, 3), draw(realisation, seed))[0, 1]) < 0.5
    tracks, _ = rolled._draw_tracks(RollingQuantity(wheel(), "force-rms"), 3, 3)
    assert (abs(np.corrcoef(tracks.T) - np.eye(3)) < 0.5).all()


# What models claim, by hand


def claims(scene, quantity="stiffness", tolerance=0.1):
    return {kind: estimate.error for kind, estimate in estimates_by_kind(scene, quantity, tolerance).items()}


@catches("one measured face for the mean of all").at("validation.advice.models.pressed.SCATTER", 0.0)
def test_one_measured_face_is_not_the_mean_of_all():
    """A surface scatters by 0.22 about the mean of those that have its spectrum: two such deviations are claimed."""
    height = bem3d.rough_surface(ROUGH.c2d, shape=(32, 32), spacing=1 / 32, rng=np.random.default_rng(2), rms=1e-3)
    scene = replace(punch(load=1.0), ground=MeasuredHeights(height=height, spacing=(1 / 32, 1 / 32)))
    assert scene.ground.beyond_a_spectrum() == ()
    models = [model_of_kind(kind, scene, "stiffness", 0.1).model for kind in ("fit", "springs")]
    one, of_all = claims(scene), {model.name: calibrated(model, Target(scene)).error for model in models}
    # the fit is in series with the interface, which yields as one over the load
    assert one["fit"] - of_all["fit"] == pytest.approx(2 * 0.22 / scene.reduced_load**2)
    assert one["springs"] - of_all["springs"] == pytest.approx(0.02 + 2 * 0.22)


@pytest.mark.parametrize(
    ("scene", "tolerance", "count", "claimed"),
    [
        # (2 s / 0.9 e)^2 surfaces, s = 0.22 of a punch and 0.3 h/d of a sphere
        (punch(), 0.1, 24, 0.05),
        (ball(0.1, 1, 4), 0.021, 11, 0.0105),
        # eight at the least, and no more than a thousand, which are not begun where they would leave more
        (punch(), 0.9, 8, 0.45),
        (punch(), 0.01, 8, 2 * 0.22 / math.sqrt(1000)),
    ],
)
def test_boundary_elements_claim_what_their_sample_leaves(scene, tolerance, count, claimed):
    model = grids_of(scene, "stiffness", tolerance)[-1]
    assert model.solves == count
    assert model.estimate().error == pytest.approx(claimed)


RULES = [
    ("force-rms", {"linear filter, 1D": (1.2, 0.05, 0.002), "springs": (1.0, 0.1, 0.012)}),
    (
        "force-spectrum",
        {
            "linear filter, 1D": (2.0, 0.5, 0.55),
            "linear filter, 3D": (2.0, 0.5, 0.015),
            "springs": (0.0, 0.6, 0.46),
        },
    ),
]


@catches("the rule of the rms for levels in bands", *RULES[1]).at(
    "validation.advice.models.rolling.ON_HALF_SPACE",
    dataclasses.replace(rolling_models.ON_HALF_SPACE, bands=rolling_models.LINEAR_RMS),
)
@pytest.mark.parametrize(("quantity", "rules"), RULES)
def test_claims_of_cheap_models_of_rolling(quantity, rules):
    """Of the contact that linear theory loses, of h/d, and of neither; springs beside a tenth of the tolerance."""
    # of a wider band than those that were calibrated
    scene = wheel(height=0.3, first=0.9, last=36.0)
    ground = scene.ground
    lost = contact_lost(ground.c2d, edges=ground.edges, contact_radius=scene.contact_radius, radius=scene.radius)
    assert lost != pytest.approx(0.3, rel=0.1)
    found = claims(scene, quantity)
    for model, rule in rules.items():
        assert found[model] == pytest.approx(np.dot(rule, (lost, 0.3, 1.0)))


# Rolling, grid beside grid


strips = boundary_elements_rolling.MODEL


def another_strip_on_the_coarse_grid(target, resolution):
    solve = strips.prepare(target, resolution)
    coarse, _ = strips.resolutions(target)
    return (lambda strip: solve(strip + 1)) if resolution == coarse else solve


@catches("what the finer of two grids leaves, for the coarser", finest=False).at(
    "validation.advice.models.boundary_elements_rolling.OF_FINE", boundary_elements_rolling.OF_FINE - 1
)
@catches("a grid beside another on another strip", finest=True).at(
    "validation.advice.models.boundary_elements_rolling.MODEL",
    dataclasses.replace(strips, prepare=another_strip_on_the_coarse_grid),
)
@pytest.mark.parametrize("finest", [False, True])
def test_two_grids_of_second_order_leave_what_they_miss(finest):
    """ln of a level is c / cells^2 beside its limit, and strips scatter by far more: they are compared one by one."""

    def levels(quantity, cells, realisation, seed):
        return np.array([realisation % 2 - 0.5 - 20 / cells**2])

    coarse, fine = grids_of(wheel(), "force-rms", 0.1)
    assert fine.resolution.size == 1.5 * coarse.resolution.size
    model = fine if finest else coarse
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(boundary_elements_rolling, "on_boundary_elements", levels)
        found = model.solve()
    assert found.grid == pytest.approx(20 / model.resolution.size**2, rel=0.01)
    # no more strips than the fewest: the grid alone leaves more than the tolerance
    assert found.sample == pytest.approx(stats.t(7).ppf(0.975) * 0.5 / math.sqrt(7), rel=1e-9)
    level = model.target.rolling.expected(one_dimensional=False)
    assert found.value == pytest.approx(level * math.exp(-20 / model.resolution.size**2), rel=1e-9)


def test_springs_leave_what_their_tracks_scatter(monkeypatch):
    springs = model_of_kind("springs", wheel(), "force-spectrum", 0.1)
    change = np.random.default_rng(1).standard_normal((60, springs.target.rolling.bands.centres.size))
    monkeypatch.setattr(rolling_models, "on_springs", lambda *_: change)
    found = springs.solve()
    assert found.sample == pytest.approx(mean_error(change))
    assert found.model == springs.estimate().model


@catches("Geike's spectrum for springs that roll", quantity="force-spectrum").at(
    "validation.simulation.rolling_levels.draw_track",
    lambda ground, rule, **settings: surface.draw_track(ground, "geike", **settings),
)
@pytest.mark.slow
@pytest.mark.parametrize("quantity", ["force-rms", "force-spectrum", "acceleration", "acceleration-rms"])
def test_springs_on_low_roughness_are_linear_theory_in_the_mean_over_bands(quantity):
    moving = {"mass": 3.0, "speed": 40.0} if quantity.startswith("acceleration") else {}
    scene = replace(wheel(height=1e-4), **moving)
    change = rolled.on_springs(RollingQuantity(scene, quantity), 24, 5)
    # tracks that are fed have the level of half-spaces in the mean alone
    assert abs(change.mean()) <= mean_error(change) + (0.0 if quantity == "force-rms" else 0.1)


def test_bands_of_measured_heights_are_those_that_they_resolve():
    """Four of the longest band on the length that was measured, four points to the shortest wave."""
    height = 1e-4 * np.random.default_rng(6).standard_normal((512, 128))
    ground = MeasuredHeights(height=height, spacing=(1 / 16, 1 / 16))
    bands = RollingQuantity(wheel(ground=ground), "force-spectrum").bands
    candidate = 10**0.1
    assert bands.edges[0] >= 4 * 2 * math.pi / 32 > bands.edges[0] / candidate
    assert bands.edges[-1] <= math.pi * 16 / 2 * (1 + 1e-9) < bands.edges[-1] * candidate * (1 + 1e-9)


# Units


def in_other_units(scene, modulus=2e11, length=1e-6):
    """The same scene in pascals and metres, E* and lengths of one being those of a steel of micrometres."""
    lengths = {name: length * getattr(scene.ground, name) for name in ("rms", "longest", "shortest")}
    load = modulus * length**2 * scene.load
    return replace(scene, size=length * scene.size, load=load, modulus=modulus, ground=replace(scene.ground, **lengths))


ROUGH_BODIES = [punch(load=0.01, ground=waves(last=16)), ball(0.1, 1, 4)]


def of_unit_modulus(**settings):
    return bem3d.HalfSpace(**{**settings, "modulus": 1.0})


@catches("a half-space of unit modulus", scene=ROUGH_BODIES[1]).at(
    "validation.advice.models.boundary_elements_pressed.bem3d", module_with(bem3d, HalfSpace=of_unit_modulus)
)
@pytest.mark.parametrize("scene", ROUGH_BODIES)
def test_no_stiffness_depends_on_units(scene):
    """Every model counts as many springs and cells, and answers E* times length more."""
    ladders = [
        (*(model_of_kind(kind, one, "stiffness", 0.9) for kind in (formula_of(scene), "springs")), grids[0])
        for one in (scene, in_other_units(scene))
        if (grids := grids_of(one, "stiffness", 0.9))
    ]
    for one, two in zip(*ladders, strict=True):
        here, there = one.solve(), two.solve()
        assert there.value == pytest.approx(2e11 * 1e-6 * here.value, rel=1e-3)
        assert there.error == pytest.approx(here.error, rel=1e-2)
        assert (there.failed, there.cost) == (here.failed, here.cost)


@catches("one cell in contact of a light punch").at("validation.simulation.indentation.CONTACT", 1)
def test_grids_are_as_fine_in_any_unit():
    """Sixteen cells in contact of a light punch, 2 F / (E* h' L^2) of all, h' the rms slope of the gradient."""
    for scene in (*ROUGH_BODIES, light := punch(load=0.001, ground=waves(last=4))):
        assert pressed_heights.sufficient_cells(scene) == pressed_heights.sufficient_cells(in_other_units(scene))
    share = 2 * light.load / (math.sqrt(2) * light.ground.slope_along)
    cells = pressed_heights.sufficient_cells(light)
    assert cells > 8 * 4
    assert 16 <= share * cells**2 < 4 * 16


def test_a_sphere_of_low_roughness_is_that_of_hertz():
    scene = ball(0.01, 1.9, 4)
    found = grid_of(scene, 0.1, 0, 32).solve()
    assert found.error < 0.1
    assert abs(math.log(found.value[0] / scene.stiffness)) <= found.error + 0.32 * 0.01 + 0.01


@catches("a sphere cut off at its smooth approach").at("validation.simulation.indentation.DEEPEST", 0.0)
def test_the_side_of_a_sphere_holds_what_it_may_touch():
    """Four heights above the smooth approach: r^2 = 2 R (d + 4 h)."""
    scene = ball(0.1, 4.5, 9)
    assert pressed_heights.side_of(scene) == pytest.approx(2 * math.sqrt(2 * 10 * (0.1 + 4 * 0.01)))
