"""Heights that are cropped and filled in where it is asked for: against loops of their own, told, or refused."""

import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from tests.seeded import catches
from validation.scenes import measured_heights as height_edits
from validation.scenes.indentation import IndentationScene
from validation.scenes.load import load_scene
from validation.scenes.measured_heights import MeasuredHeights, central_square, filled_in
from validation.scenes.measured_surface import measured

ROUGH = np.random.default_rng(5).standard_normal((40, 32))


def surface(height, sizes=None, unit="m", **more):
    sizes = sizes or tuple(map(float, np.shape(height)))
    return SimpleNamespace(heights=height, physical_sizes=sizes, unit=unit, **more)


def with_holes(height, *places):
    found = np.array(height, dtype=float)
    for place in places:
        found[place] = np.nan
    return found


# Points without data


def test_a_hole_in_a_harmonic_surface_is_found_again():
    """x^2 - y^2 has no Laplacian, on points of any distance: differences of second order are exact."""
    x, y = 0.5 * (np.arange(40)[:, np.newaxis] - 17), 0.2 * (np.arange(32) - 11)
    saddle = x**2 - y**2
    found = filled_in(with_holes(saddle, (slice(8, 20), slice(12, 19))), (0.5, 0.2))
    # the plane of the others is no part of it, and harmonic, too
    assert found == pytest.approx(saddle, abs=1e-10)


right_filled_in = height_edits.filled_in


@catches("cells taken for squares where points without data are filled in").at(
    f"{__name__}.filled_in", lambda height, spacing: right_filled_in(height, (1.0, 1.0))
)
def test_holes_at_an_edge_against_repeated_means():
    """Of the neighbours that there are, about the plane of least squares through what is known."""
    holes = with_holes(ROUGH, (slice(0, 3), slice(4, 6)), (39, 0), (12, 31))
    unknown = np.isnan(holes)
    i, j = np.nonzero(~unknown)
    plane, *_ = np.linalg.lstsq(np.column_stack([np.ones(i.size), i, j]), holes[~unknown], rcond=None)
    level = plane[0] + plane[1] * np.arange(40)[:, np.newaxis] + plane[2] * np.arange(32)
    rest = np.where(unknown, 0.0, holes - level)
    weights = {(1, 0): 1 / 9, (-1, 0): 1 / 9, (0, 1): 1.0, (0, -1): 1.0}
    for _ in range(300):
        for i, j in np.argwhere(unknown):
            inside = {d: (i + d[0], j + d[1]) for d in weights if 0 <= i + d[0] < 40 and 0 <= j + d[1] < 32}
            rest[i, j] = sum(weights[d] * rest[at] for d, at in inside.items()) / sum(weights[d] for d in inside)
    assert filled_in(holes, (3.0, 1.0)) == pytest.approx(rest + level, abs=1e-12)


@catches("the mean of all heights for points without data", hidden="nan").at(
    "validation.scenes.measured_surface.filled_in",
    lambda height, spacing: np.where(np.isnan(height), np.nanmean(height), height),
)
@pytest.mark.parametrize("hidden", ["nan", "mask"])
def test_few_points_are_filled_in_where_it_is_asked_for_and_told(hidden):
    holes = with_holes(ROUGH, (3, slice(5, 9)), (30, 2))
    given = holes if hidden == "nan" else np.ma.masked_array(np.where(np.isnan(holes), 1e9, holes), np.isnan(holes))
    found = measured(surface(given, unit="um"), fill=True)
    whole = MeasuredHeights(height=1e-6 * filled_in(holes, (1.0, 1.0)), spacing=(1e-6, 1e-6))
    assert found.height == pytest.approx(whole.height, rel=1e-9, abs=1e-20)
    assert found.edits.filled == 5
    assert found.waves.endswith(", 5 points (0.391 %) filled in")
    assert found.notes()[0].startswith("heights had no data at 5 points (0.391 %), which were filled in from their ")
    # nothing to do, nothing said
    same = measured(surface(ROUGH), fill=True)
    assert (same.height == measured(surface(ROUGH)).height).all()
    assert (same.edits, same.notes()) == (measured(surface(ROUGH)).edits, measured(surface(ROUGH)).notes())


@pytest.mark.parametrize(
    ("count", "fill", "got", "advice"),
    [
        (1, False, "1 of 1200 (0.0833 %)", "fewer than 1 % can be filled"),
        (11, False, "11 of 1200 (0.917 %)", "fewer than 1 % can be filled"),
        (12, False, "12 of 1200 (1 %)", "cut out a part that is"),
        (12, True, "12 of 1200 (1 %)", "cut out a part that is"),
        (1200, True, "1200 of 1200 (100 %)", "cut out a part that is"),
    ],
)
def test_points_that_are_not_filled_in_are_refused(count, fill, got, advice):
    height = ROUGH[:, :30].copy()
    height.flat[:count] = np.nan
    said = f"{re.escape(got)} without data .*, the first at .0, 0.: {advice}.*, as: fill=True$"
    with pytest.raises(ValueError, match=f"^heights must be known everywhere, got {said}"):
        measured(surface(height), fill=fill)
    if count == 11:
        assert measured(surface(height), fill=True).edits.filled == 11


@pytest.mark.parametrize("fill", [True, False])
def test_infinite_heights_are_never_filled_in(fill):
    height = with_holes(ROUGH, (3, 4))
    height[2, 1] = -np.inf
    said = r"^heights must be finite, got 1 of 1280 \(0\.0781 %\) infinite, the first at \[2, 1\]: a point without "
    with pytest.raises(ValueError, match=said):
        measured(surface(height), fill=fill)


@pytest.mark.parametrize("wish", [{"fill": "yes"}, {"fill": 1}, {"crop": None}])
def test_wishes_are_true_or_false(wish):
    (name,) = wish
    with pytest.raises(TypeError, match=f"^{name} must be True or False, got "):
        measured(surface(ROUGH), **wish)


# The central square


@pytest.mark.parametrize(
    ("shape", "spacing", "part"),
    [
        ((40, 32), (1.0, 1.0), np.s_[4:36, :]),
        ((32, 40), (0.1, 0.1), np.s_[:, 4:36]),
        ((41, 32), (1.0, 1.0), np.s_[4:36, :]),
        ((32, 32), (1e-6, 1e-6), np.s_[:, :]),
        # twice as far apart along y: 40 points of x are as long as 20 of y
        ((40, 32), (1.0, 2.0), np.s_[:, 6:26]),
        # 1.1 to 1: ten of one are eleven of the other
        ((40, 32), (1.1, 1.0), np.s_[10:30, 5:27]),
    ],
)
def test_the_central_square_is_cut_out(shape, spacing, part):
    height = np.random.default_rng(2).standard_normal(shape)
    found = central_square(height, spacing)
    assert (found == height[part]).all()
    assert found.shape[0] * spacing[0] == pytest.approx(found.shape[1] * spacing[1], rel=1e-12)


@catches("the first square for the central one").at(
    "validation.scenes.measured_surface.central_square", lambda height, spacing: height[-32:, -32:]
)
def test_a_crop_is_told_and_its_points_alone_count():
    height = with_holes(ROUGH, (slice(0, 4), slice(0, 32)), (20, 20))
    found = measured(surface(height), crop=True, fill=True)
    assert found.height.shape == (32, 32)
    assert found.edits.filled == 1
    assert "32 x 32 points on 32 m x 32 m, the central square of 40 x 32, 1 point (0.0977 %) filled in" in found.waves
    assert found.notes()[0] == "heights are the central square of 40 x 32 points, as asked by crop."
    level = MeasuredHeights(height=filled_in(height[4:36], (1.0, 1.0)), spacing=(1.0, 1.0))
    assert found.height == pytest.approx(level.height, rel=1e-12)


def test_there_is_not_always_a_square():
    said = r"^crop must find a square of whole points, got 40 x 32 points, 1 x 1\.2347 m apart: resample the heights"
    with pytest.raises(ValueError, match=said):
        measured(surface(ROUGH, (40.0, 32 * 1.2346789)), crop=True)


def test_a_rectangular_face_is_refused_by_what_would_help():
    punch = {"name": "it", "shape": "punch", "size": 32e-6, "load": 1e-3, "modulus": 1e9}
    face = surface(0.01 * ROUGH, unit="um")
    with pytest.raises(ValueError, match=r"^heights must be as large as the punch, a square, .* as: crop = true \("):
        IndentationScene(**punch, ground=measured(face))
    scene = IndentationScene(**punch, ground=measured(face, crop=True))
    assert scene.ground.sides == pytest.approx((32e-6, 32e-6))
    assert "heights are the central square of 40 x 32 points, as asked by crop." in scene.diagnose()
    with pytest.raises(ValueError, match=r'got \(.*\) m: see heights.spacing, or as: side = "32 µm"$'):
        IndentationScene(**{**punch, "size": 40e-6}, ground=measured(face, crop=True))


# Points that are not equally far apart


def test_square_cells_read_heights_linearly_between_points_that_are_farther_apart_along_one_side():
    """A height that is linear between the points in each direction, read at the middle of cells by hand."""
    height = np.random.default_rng(3).standard_normal((32, 16))
    found = measured(surface(height, (32.0, 32.0)))
    assert found.spacing == (1.0, 2.0)
    assert ", 1 m x 2 m apart" in found.waves
    cells = found.mean_over_cells((32, 32), 1.0)
    by_hand = np.empty((32, 32))
    for j in range(32):
        # points of y lie at 1, 3, 5 ... from the edge, the middles of cells at 0.5, 1.5 ...
        place = min(max((j + 0.5 - 1.0) / 2.0, 0.0), 15.0)
        below = min(int(place), 14)
        by_hand[:, j] = (1 - place + below) * found.height[:, below] + (place - below) * found.height[:, below + 1]
    assert cells == pytest.approx(by_hand, abs=1e-12)


# The object in place of the roughness of a scene


def test_a_scene_file_with_heights_of_python():
    height = 1e-6 * np.random.default_rng(4).standard_normal((64, 64))
    face = surface(1e6 * height, (1000.0, 1000.0), unit="µm")
    scene = load_scene("rough_punch", heights=face)
    assert scene.ground.height == pytest.approx(MeasuredHeights(height=height, spacing=(1, 1)).height, rel=1e-9)
    assert (scene.size, scene.load) == (load_scene("rough_punch").size, load_scene("rough_punch").load)
    strip = measured(surface(height, (0.08, 0.08)))
    assert load_scene("rolling_wheel", heights=strip).ground is strip
    assert load_scene("table_14_1", heights=strip).ground is strip
    assert load_scene("rail", heights=strip).roughness is strip
    assert load_scene("sphere", heights=strip).ground is strip
    with pytest.raises(TypeError, match=r"^surface must have heights and physical_sizes, got ndarray$"):
        load_scene("rough_punch", heights=height)
    with pytest.raises(ValueError, match=r"rough_punch\.toml: heights must be as large as .*, punch\.side = 0\.001"):
        load_scene("rough_punch", heights=strip)
    with pytest.raises(TypeError, match=r"^ground must be Roughness, .*: validation\.measured\(it\) makes them$"):
        replace(load_scene("rough_punch"), ground=face)
