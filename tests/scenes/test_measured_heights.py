"""Measured heights: their spectrum and size, what is warned of, what is refused by name."""

import math
import re
from types import SimpleNamespace

import numpy as np
import pytest
from scipy import stats

import bem3d
import mdr
from tests.seeded import catches
from validation.advice.models_of_scene import models_of
from validation.scenes import measured_heights
from validation.scenes.indentation import IndentationScene
from validation.scenes.measured_heights import MeasuredHeights, without_unknown_ends
from validation.scenes.measured_surface import measured

N, DX = 256, 1e-6
BAND = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi * 4 / (N * DX), q_max=2 * np.pi * 32 / (N * DX), rms=1e-7)


def drawn(seed=1, c2d=BAND.c2d):
    return bem3d.rough_surface(c2d, shape=(N, N), spacing=DX, rng=np.random.default_rng(seed), rms=1e-7)


def heights(height, spacing=(DX, DX)):
    return MeasuredHeights(height=height, spacing=spacing)


def surface(height, sizes=(N * DX, N * DX), unit="m", **more):
    return SimpleNamespace(heights=height, physical_sizes=sizes, unit=unit, **more)


def test_the_spectrum_is_found_in_the_heights():
    ratios = []
    for seed in range(4):
        found = heights(drawn(seed))
        edges = np.array(found.edges)
        middle = np.sqrt(edges[1:] * edges[:-1])
        # a ring next to the ends of the band is half empty, and a window smears over two waves
        inside = (edges[:-1] > 1.3 * BAND.q_min) & (edges[1:] < BAND.q_max / 1.3)
        # over a ring, q^-3.4 has a mean above its middle
        width = edges[1:][inside] / edges[:-1][inside]
        mean = 2 * (width**-1.4 - 1) / (-1.4 * (width**2 - 1)) * (edges[:-1][inside] ** -3.4)
        exact = BAND.c2d(edges[:-1][inside]) * mean / edges[:-1][inside] ** -3.4
        ratios.append(found.c2d(middle[inside]) / exact)
    # rings of tens of waves, four surfaces
    assert np.mean(ratios, axis=0) == pytest.approx(np.ones(inside.sum()), abs=0.35)
    assert np.mean(ratios) == pytest.approx(1.0, abs=0.08)


real_spectrum = measured_heights._spectrum


def half_of_the_level(height, spacing):
    edges, level = real_spectrum(height, spacing)
    return edges, tuple(value / 2 for value in level)


@catches("measured heights over half of their mean square").at(
    "validation.scenes.measured_heights._spectrum", half_of_the_level
)
def test_the_spectrum_has_the_height():
    found = heights(drawn())
    edges = np.array(found.edges)
    level = found.c2d(np.sqrt(edges[1:] * edges[:-1]))
    assert np.pi * np.sum(level * np.diff(edges**2)) / found.rms**2 == pytest.approx(1.0, rel=1e-12)
    assert (found.c2d(np.array([0.0, 0.9 * edges[0], 1.1 * edges[-1]])) == 0).all()


@pytest.mark.parametrize("times", [0.5, 2.0])
def test_a_tilt_is_taken_off_and_noted_where_it_is_larger_than_the_roughness(times):
    ramp = np.add.outer(3 * np.arange(N), -2 * np.arange(N)) - (N - 1) / 2
    level = heights(drawn()).height
    found = heights(level + 3e-6 + times * level.std() / ramp.std() * ramp)
    assert np.abs(found.height - level).max() < 1e-9 * 1e-7 * N
    assert found.tilt == pytest.approx(times, rel=1e-9)
    assert [f"{times:.2g} times as rough" in doubt for doubt in found.notes()] == [True] * (times > 1)


def test_note_of_ridges():
    x = np.arange(N) * DX
    ridges = 1e-7 * np.cos(2 * np.pi * 16 * x / (N * DX))[:, np.newaxis] + 0.1 * drawn()
    (doubt,) = (d for d in heights(ridges).notes() if "anisotropic" in d)
    assert "boundary elements do" in doubt
    # slopes of a stretched surface are as many times steeper across
    stretched = heights(drawn(), spacing=(DX, 3 * DX))
    assert stretched.texture == pytest.approx(3.0, rel=0.1)
    assert "times those along the other" in stretched.notes()[0]


def test_note_of_heights_that_are_not_gaussian():
    worn = np.minimum(drawn(), 0.3e-7)
    (doubt,) = heights(worn).notes()
    assert re.match(r"heights are not Gaussian, skewness -\d", doubt)


@catches("plateaus taken for Gaussian heights").at("validation.scenes.measured_heights.FLAT", 0.0)
def test_note_of_plateaus_that_neither_skewness_nor_kurtosis_shows():
    """Ground on top and pitted as deep below: of honed faces at a light load springs were a factor of six too soft."""
    plateaus = np.clip(drawn(), -1.6e-7, 1.6e-7)
    assert abs(stats.skew(plateaus, axis=None)) < 0.5 and abs(stats.kurtosis(plateaus, axis=None)) < 1
    assert ["highest hundredth from 1." in doubt for doubt in heights(plateaus).notes()] == [True]


@pytest.mark.parametrize("call", [True, False])
def test_any_object_with_heights_and_sizes_will_do(call):
    height = drawn()[:, : N // 2]
    found = measured(surface((lambda: height) if call else height, (N * DX, N * DX)))
    assert found.spacing == pytest.approx((DX, 2 * DX))
    assert found.sides == pytest.approx((N * DX, N * DX))
    assert found.height == pytest.approx(heights(height, (DX, 2 * DX)).height, rel=1e-12, abs=0)


def refusal(question):
    """What is said of what is refused; nothing where it is not."""
    try:
        question()
    except ValueError as problem:
        return str(problem)
    return ""


@catches("heights behind a mask").at(
    "validation.scenes.measured_surface.real_numbers", lambda height: np.asarray(height, dtype=np.float64)
)
def test_points_without_data_are_refused():
    """A masked point is no height: what stands behind the mask entered as one, and gave a stiffness 8 % off."""
    height, gone = drawn(), np.zeros((N, N), dtype=bool)
    gone[3, 5:40] = gone[200:, 7] = True
    masked, unknown = np.ma.masked_array(height, gone), np.where(gone, np.nan, height)
    said = f"heights must be known everywhere, got {gone.sum()} of 65536 (0.139 %) without data (NaN or masked), the f"
    for refused in (surface(masked), surface(lambda: masked), surface(masked, unit="um"), surface(unknown)):
        sentence = refusal(lambda given=refused: measured(given))
        assert sentence.startswith(said) and sentence.endswith("fill=True")
    assert refusal(lambda: heights(masked)).startswith(said)
    # an array that could have a mask and has none is as good as any
    assert (measured(surface(np.ma.masked_array(height))).height == heights(height).height).all()


@catches("a surface in micrometres taken for one in metres", more={"unit": "um"}).at(
    "validation.scenes.measured_surface._metres", lambda surface, given: 1.0
)
@pytest.mark.parametrize(
    "more", [{"unit": "um"}, {"unit": None, "info": {"unit": "µm"}}, {"unit": "um", "info": {"unit": "µm"}}]
)
def test_the_unit_that_a_surface_names_is_that_of_heights_and_sizes(more):
    found = measured(surface(1e6 * drawn(), (1e6 * N * DX, 1e6 * N * DX), **more))
    assert found.rms == pytest.approx(heights(drawn()).rms, rel=1e-12)
    assert found.spacing == pytest.approx((DX, DX), rel=1e-12)
    assert found.notes() == ()


@pytest.mark.parametrize("more", [{}, {"info": {}}, {"info": {"unit": ""}}])
def test_an_object_that_names_no_unit_is_asked_for_it(more):
    one = surface(1e6 * drawn(), (1e6 * N * DX, 1e6 * N * DX), unit=None, **more)
    said = refusal(lambda: measured(one))
    assert said.startswith("unit of the surface must be known") and said.endswith('measured(surface, unit="m") says it')
    assert measured(one, unit="um").rms == pytest.approx(heights(drawn()).rms, rel=1e-12)
    with pytest.raises(ValueError, match=r"^unit of the surface must be one, got unit 'um' and unit= 'mm'$"):
        measured(surface(drawn(), unit="um"), unit="mm")


TWO = "heights must be two-dimensional with two"
PLANE = np.add.outer(np.arange(64.0), np.arange(64.0))
REFUSED = [
    ([1.0], "surface must have heights and physical_sizes, got list$"),
    (surface(np.ones(8), (1.0,)), TWO),
    *((surface(drawn().astype(kind)), "heights must be real numbers, got dtype ") for kind in (complex, str, bool)),
    (surface([[1.0, 2.0], [3.0]]), "heights must be a regular array of numbers, got rows of different length$"),
    (surface(drawn(), unit="parsec"), "unit of the surface must be one of m, cm, mm, .*, Å, A, pm, got 'parsec'$"),
    *((surface(drawn(), sizes), TWO) for sizes in ((1.0,), (1.0, 1.0, 1.0), None, 3.0)),
    (surface(drawn(), "mm"), r"physical_sizes\[0\] must be a real"),
    *((surface(drawn(), (1.0, side)), r"physical_sizes\[1\] must be positive, got ") for side in (0.0, -1.0)),
    *((surface(drawn(), (1.0, side)), r"physical_sizes\[1\] must be finite, got ") for side in (math.nan, math.inf)),
    (surface(np.ones((4, 64))), r"heights must be 16 points or more .* \(4, 64\)"),
    (surface(np.full((64, 64), np.nan)), r"heights must be known everywhere, got 4096 of 4096 \(100 %\) .* \[0, 0\]"),
    (surface(PLANE), "heights must be rough, got a plane"),
]


@pytest.mark.parametrize(("given", "said"), REFUSED)
def test_what_are_no_measured_heights_is_refused(given, said):
    with pytest.raises((TypeError, ValueError), match=f"^{said}"):
        measured(given)


def test_spacings_that_are_none_are_refused():
    with pytest.raises(ValueError, match=r"^spacing\[1\] must be positive, got -1.0$"):
        heights(drawn(), spacing=(1.0, -1.0))


def test_note_of_sizes_in_the_other_order():
    half, (long, short) = drawn()[:, : N // 2], (N * DX, N // 2 * DX)
    assert not any("order of the axes" in note for note in measured(surface(half, (long, short))).notes())
    (note,) = (n for n in measured(surface(half, (short, long))).notes() if "order of the axes" in n)
    assert "points are 4 times as far apart along one side as along the other" in note
    # three times as far apart, and no square points either way
    assert not any("order of the axes" in note for note in measured(surface(half, (3 * long, short))).notes())


def test_a_tilt_and_steepness_are_notes_and_texture_and_skewness_are_reasons():
    ramp = 1e-4 * (np.arange(N)[:, np.newaxis] + np.zeros(N))
    tilted, steep = heights(drawn() + ramp), heights(1e4 * drawn())
    assert len(tilted.notes()) == len(steep.notes()) == 1
    scene = {"name": "it", "shape": "punch", "size": N * DX, "load": 0.1, "modulus": 1e9}
    for ground in (tilted, steep):
        assert ground.beyond_a_spectrum() == ()
        claims = [
            model.estimate() for model in models_of(IndentationScene(**scene, ground=ground), "stiffness", 0.1, 0)
        ]
        assert not any("knows the spectrum alone" in claim.reason for claim in claims)
        assert IndentationScene(**scene, ground=ground).diagnose() == ground.notes()
    for ground in (heights(drawn(), spacing=(DX, 3 * DX)), heights(np.minimum(drawn(), 0.3e-7))):
        assert ground.beyond_a_spectrum() == ground.notes() != ()
    worn = IndentationScene(**scene, ground=heights(np.minimum(drawn(), 0.3e-7)))
    assert "knows the spectrum alone" in models_of(worn, "stiffness", 0.1, 0)[0].estimate().reason


def test_heights_in_the_wrong_unit_are_steep():
    ground = heights(drawn())
    assert not any("steep" in doubt for doubt in ground.notes())
    metres = MeasuredHeights(height=1e6 * ground.height, spacing=ground.spacing)
    assert "rms gradient" in metres.notes()[0]
    ramp = np.add.outer(np.abs(np.arange(32) - 15.5), np.zeros(32))
    assert MeasuredHeights(height=ramp, spacing=(2.0, 1.0)).gradient == pytest.approx(0.5 * math.sqrt(30 / 31))


def test_slopes_along_the_track_are_those_of_the_first_axis():
    ridges = 1e-7 * np.sin(2 * np.pi * 8 * np.arange(N) / N)[:, np.newaxis] + 1e-3 * drawn()
    assert heights(ridges).slope_along == pytest.approx(heights(ridges).gradient, rel=1e-3)
    assert heights(ridges.T).slope_along < 0.1 * heights(ridges.T).gradient


def test_heights_are_linear_between_points():
    """Of x^2 on points one apart, 1/4 above it in the middle between two."""
    n = 16
    heights = np.add.outer((np.arange(n) - (n - 1) / 2) ** 2, np.zeros(n))
    ground = MeasuredHeights(height=heights, spacing=(1.0, 1.0), detrend="none")
    x = np.arange(3.0)
    np.testing.assert_allclose(ground.at(x, x), np.add.outer(x**2 + 0.25, 0 * x), rtol=1e-12)


def test_measured_heights_are_one_surface_whose_longest_wave_is_that_of_its_first_wavenumber():
    ground = MeasuredHeights(height=np.random.default_rng(1).standard_normal((16, 16)), spacing=(1.0, 1.0))
    assert ground.is_single and ground.q_max == ground.edges[-1] > ground.edges[1]
    assert ground.longest == pytest.approx(2 * math.pi / ground.q_min)


def test_rows_are_left_out_at_both_ends_unless_most_would_be():
    line = np.ones((10, 2))
    line[:1, 0] = line[8:, 1] = np.nan
    complete, notes = without_unknown_ends(line)
    assert len(complete) == 7 and notes == ("rows without data are left out, 1 at its beginning and 2 at its end",)
    line[:5, 0] = np.nan
    assert without_unknown_ends(line) == (line, ())
