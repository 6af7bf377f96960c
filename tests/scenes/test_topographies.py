"""Topographies of SurfaceTopography: a stand-in with its interface, and the package itself where it is installed."""

import numpy as np
import pytest

from validation.scenes.load import load_scene
from validation.scenes.measured import MeasuredHeights
from validation.scenes.measured_surface import measured

N = 48
HEIGHT = 0.3 * np.random.default_rng(7).standard_normal((N, N))
"""In micrometres, on one millimetre."""


class StandIn:
    """What is asked of a Topography: heights of shape (nx, ny), masked where there are none; sizes; unit."""

    def __init__(self, heights, physical_sizes, unit=None, info=None):
        self._heights, self._sizes, self._unit = heights, physical_sizes, unit
        self.info = info or {}

    @property
    def unit(self):
        return self._unit

    @property
    def physical_sizes(self):
        return self._sizes

    def heights(self):
        return self._heights if np.isfinite(self._heights).all() else np.ma.masked_invalid(self._heights)


def topographies():
    """The package; the test is skipped where it, or what it imports, is not there."""
    try:
        import SurfaceTopography
    except ImportError as reason:
        pytest.skip(f"could not import SurfaceTopography: {reason}")
    return SurfaceTopography


@pytest.fixture(params=["stand-in", "package"])
def topography(request):
    if request.param == "stand-in":
        return StandIn
    return topographies().Topography


@pytest.mark.parametrize(
    ("unit", "metre"), [("m", 1.0), ("mm", 1e3), ("um", 1e6), ("µm", 1e6), ("nm", 1e9), ("Å", 1e10)]
)
def test_heights_and_sizes_have_the_unit_of_a_topography(topography, unit, metre):
    one = topography(1e-6 * metre * HEIGHT, (1e-3 * metre, 1e-3 * metre), unit=unit)
    found = measured(one)
    assert found.spacing == pytest.approx((1e-3 / N, 1e-3 / N), rel=1e-12)
    assert found.height == pytest.approx(
        MeasuredHeights(height=1e-6 * HEIGHT, spacing=(1e-3 / N, 1e-3 / N)).height, rel=1e-9, abs=1e-18
    )
    assert load_scene("rough_punch", heights=one).ground.rms == pytest.approx(found.rms, rel=1e-12)


def test_x_is_the_first_axis_of_a_topography(topography):
    found = measured(topography(HEIGHT[:, :24], (1000.0, 250.0), unit="um"))
    assert found.sides == pytest.approx((1e-3, 0.25e-3))
    assert found.spacing == pytest.approx((1e-3 / N, 0.25e-3 / 24))


def test_undefined_data_of_a_topography(topography):
    holes = HEIGHT.copy()
    holes[10, 20] = np.nan
    one = topography(holes, (1000.0, 1000.0), unit="um")
    with pytest.raises(
        ValueError, match=r"got 1 of 2304 \(0\.0434 %\) without data .* at \[10, 20\]: .*, as: fill=True$"
    ):
        measured(one)
    holes[10, 20] = (HEIGHT[9, 20] + HEIGHT[11, 20] + HEIGHT[10, 19] + HEIGHT[10, 21]) / 4
    filled = MeasuredHeights(height=1e-6 * holes, spacing=(1e-3 / N, 1e-3 / N))
    assert measured(one, fill=True).height == pytest.approx(filled.height, rel=1e-9, abs=1e-18)


def test_a_topography_without_a_size_is_refused(topography):
    with pytest.raises(
        ValueError, match=r"two physical_sizes, got shape \(48, 48\) and None: .*physical_sizes=\(Lx, Ly\)"
    ):
        measured(topography(HEIGHT, None, unit="um"))


def test_a_line_scan_is_refused():
    package = topographies()
    with pytest.raises(
        ValueError, match=r"^heights must be two-dimensional with two physical_sizes, got shape \(48,\)"
    ):
        measured(package.UniformLineScan(HEIGHT[0], 1.0, unit="um"))


def test_units_that_contradict_each_other_are_refused():
    one = StandIn(HEIGHT, (1.0, 1.0), unit="mm", info={"unit": "um"})
    with pytest.raises(ValueError, match=r"^unit of the surface must be one, got unit 'mm' and info 'um'$"):
        measured(one)
    same = StandIn(HEIGHT, (1.0, 1.0), unit="um", info={"unit": "µm"})
    assert measured(same).sides == pytest.approx((1e-6, 1e-6))


def test_a_topography_that_was_converted():
    package = topographies()
    one = package.Topography(HEIGHT, (1000.0, 1000.0), unit="um")
    other = one.to_unit("mm")
    assert measured(other).height == pytest.approx(measured(one).height, rel=1e-12, abs=1e-20)
    assert measured(other).spacing == pytest.approx(measured(one).spacing)
    assert measured(one.detrend("height")).rms == pytest.approx(measured(one).rms, rel=1e-12)
