"""Records that are pieces of one are counted as one, and errors are as wide as those of as many independent ones."""

import math

import numpy as np
import pytest

from tests.seeded import catches
from validation.analysis.statistics import Estimate, half_width, independent_records, student

POINTS = 4096


def track(points, seed):
    """Red noise, periodic, of the waves that rails have."""
    q = np.arange(points // 2 + 1)
    amplitude = np.where((q > points // 400) & (q < points // 5), np.maximum(q, 1.0) ** -1.2, 0.0)
    phases = np.random.default_rng(seed).random(q.size)
    return np.fft.irfft(amplitude * np.exp(2j * np.pi * phases), points)


def pieces(period, starts, seed=1):
    """Of a track of so many places, from these on."""
    return np.array([np.take(track(period, seed), np.arange(start, start + POINTS), mode="wrap") for start in starts])


def test_independent_records_are_as_many_as_there_are():
    records = np.array([track(POINTS, seed) for seed in range(12)])
    assert independent_records(records) == 12


@pytest.mark.parametrize(
    "same", [lambda x: x, lambda x: -3 * x, lambda x: x[:, ::-1], lambda x: np.roll(x, 700, axis=1)]
)
def test_equal_records_are_one_whatever_their_scale_sign_direction_and_shift(same):
    record = track(POINTS, 3)[np.newaxis]
    # a shift tapers other parts of the record
    assert independent_records(np.vstack([record, same(record)])) == pytest.approx(1.0, abs=0.25)
    others = np.array([track(POINTS, seed) for seed in range(4)])
    assert independent_records(np.vstack([others, others])) == pytest.approx(4.0, rel=1e-6)


@catches("records of which none is alike").at("validation.analysis.statistics.CHANCE", 1.0)
def test_overlapping_pieces_are_between():
    """Two records that share a half of themselves correlate by about that: 2^2 / (2 + 2 / 4)."""
    found = independent_records(pieces(40 * POINTS, [0, POINTS // 2]))
    assert found == pytest.approx(4 / 2.5, abs=0.15)


@catches("red noise that is not whitened").at("validation.analysis.statistics.NEIGHBOURS", 4001)
def test_pieces_of_a_short_track_are_about_as_many_as_it_has_room_for():
    starts = np.random.default_rng(2).integers(0, 10**6, 20)
    assert independent_records(pieces(POINTS // 3, starts)) < 2.5
    assert 8 < independent_records(pieces(16 * POINTS, starts)) < 15
    assert independent_records(pieces(400 * POINTS, starts)) > 18


def test_the_interval_of_a_mean_of_repeated_values_is_that_of_the_values_without_repetition():
    """Four values, each five times: their own mean has Student's interval of four."""
    values = np.array([1.0, 2.0, 4.0, 7.0])
    repeated = np.repeat(values, 5)
    plain = Estimate(4.0, float(repeated.std(ddof=1)) / math.sqrt(20), 20)
    exact = student(3) * values.std(ddof=1) / 2
    assert half_width(plain, 4.0) == pytest.approx(exact)
    assert half_width(plain, 20.0) == plain.half_width and math.isinf(half_width(plain, 1.0))
    assert half_width(plain, 4.0, among=8) / exact == pytest.approx(student(3, 1 - 0.05 / 8) / student(3))
