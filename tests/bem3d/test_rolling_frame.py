"""The frame of cells around a rolling contact: its cells, its sides, and proofs that no cell outside touches."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import bem3d
from bem3d.rolling_frame import Frame
from tests.seeded import catches
from tests.strategies import half_spaces


@given(half_space=half_spaces(most=8, periodic=False), data=st.data())
def test_a_force_lowers_the_surface_by_no_less_than_the_bound(half_space, data):
    """u >= F / (pi E* sqrt(|r - c|^2 + s^2)) for any pressure, at any cell: what makes the frame a proof."""
    pressure = data.draw(arrays(np.float64, half_space.shape, elements=st.floats(0, 1, width=16)))
    force = float(pressure.sum()) * half_space.cell_area
    if force == 0:
        return
    (nx, ny), (dx, dy) = half_space.shape, half_space.steps
    x, y = np.meshgrid(np.arange(nx) * dx, np.arange(ny) * dy, indexing="ij")
    share = pressure / pressure.sum()
    centre = float((share * x).sum()), float((share * y).sum())
    variance = float((share * ((x - centre[0]) ** 2 + (y - centre[1]) ** 2)).sum()) + (dx**2 + dy**2) / 12
    distance = np.sqrt((x - centre[0]) ** 2 + (y - centre[1]) ** 2 + variance)
    least = force / (np.pi * half_space.modulus * distance)
    assert (half_space.displacement(pressure) >= least * (1 - 1e-10)).all()


def framed(height, spans):
    return Frame(bem3d.Track(height=height, spacing=1.0, radius=15.0, modulus=1.0), spans)


moments = Frame._moments


@catches("a bound four times as large").at(
    "bem3d.rolling_frame.Frame._moments", lambda *given: (4 * moments(*given)[0], *moments(*given)[1:])
)
@pytest.mark.slow
@given(
    pressure=arrays(np.float64, (6, 5), elements=st.floats(0, 1, width=16)),
    seed=st.integers(0, 1000),
    position=st.integers(0, 40),
    approach=st.floats(0.1, 4),
)
def test_cells_that_a_frame_rules_out_are_open(pressure, seed, position, approach):
    """Either spans that hold all cells which overlap after the displacement; or there are none of them."""
    nx, ny = 40, 24
    height = np.random.default_rng(seed).normal(size=(nx, ny))
    frame = framed(height, ((-3, 3), (10, 15)))
    found = frame.outside(position, approach, pressure)
    whole = framed(height, ((-(nx // 2), nx - nx // 2), (0, ny)))
    u = whole.half_space.displacement(whole.take(pressure, frame))
    ahead, across = np.nonzero(whole.gap(position) + u < approach * (1 - 1e-12))
    rows, columns = found if found is not None else frame.spans
    inside = (ahead - nx // 2 >= rows[0]) & (ahead - nx // 2 < rows[1]) & (across >= columns[0]) & (across < columns[1])
    assert inside.all()


@pytest.mark.parametrize("share", [0.5, 0.97, 0.999])
@pytest.mark.parametrize("place", [(9, 12), (0, 20), (-7, 3)])
def test_a_cell_that_just_overlaps_outside_of_a_frame_is_found(place, share):
    """Its gap is so large a part of the approach, and nothing displaces it."""
    row, column = place
    height = np.zeros((40, 24))
    frame, d = framed(height, ((-3, 3), (10, 15))), 2.0
    height[row, column] = frame.track.wheel(np.array(row), np.array(column)) - share * d
    rows, columns = framed(height, frame.spans).outside(0, d, np.zeros(frame.shape))
    assert rows[0] <= row < rows[1]
    assert columns[0] <= column < columns[1]


def test_moments_of_a_pressure():
    """Two cells of 2 x 1/2, at rows 0 and 3 ahead and columns 11 and 14 of 24, one pressed three times as hard."""
    track = bem3d.Track(height=np.zeros((40, 24)), spacing=(2.0, 0.5), radius=15.0, modulus=1.0)
    frame = Frame(track, ((-1, 5), (10, 15)))
    pressure = np.zeros((6, 5))
    pressure[1, 1], pressure[4, 4] = 1.0, 3.0
    force, centre, variance = frame._moments(pressure)
    assert force == pytest.approx(4.0)
    assert centre == pytest.approx((0.75 * 6.0, 0.25 * -0.25 + 0.75 * 1.25))
    # a quarter times three quarters of the distance squared, and that of a cell
    assert variance == pytest.approx(3 / 16 * (6.0**2 + 1.5**2) + (2.0**2 + 0.5**2) / 12)
    assert frame._moments(0 * pressure)[0] == 0


def some_spans():
    """Rows from -6 to 6, columns from 0 to 24."""
    rows, columns = (
        st.lists(st.integers(low, high), min_size=2, max_size=2, unique=True).map(sorted).map(tuple)
        for low, high in ((-6, 6), (0, 24))
    )
    return st.tuples(rows, columns)


@given(spans=some_spans(), margin=st.integers(0, 12))
def test_a_wider_frame_holds_the_narrower_with_its_margin(spans, margin):
    """On both sides, evenly; where the strip ends, as far as it has cells."""
    track = bem3d.Track(height=np.zeros((40, 24)), spacing=1.0, radius=15.0, modulus=1.0)
    (first, last), (left, right) = track.widened(spans, margin)
    assert spans[0][0] - first >= margin and last - spans[0][1] >= margin
    assert abs((spans[0][0] - first) - (last - spans[0][1])) <= 1
    assert 0 <= left <= max(spans[1][0] - margin, 0) and min(spans[1][1] + margin, 24) <= right <= 24
    # no longer than the next side that transforms fast
    assert last - first <= 1.25 * (spans[0][1] - spans[0][0] + 2 * margin) + 1
