"""Many wheels on springs in step: against the sum over all springs, and the same bits whoever rolls beside."""

import itertools
import math
from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import mdr
from mdr.rolling_ensemble import BLOCK
from tests.oracles import wheel_on_springs
from tests.seeded import E_FOR_E_STAR, Times, catches, module_with

HERTZ = 4 / 3
"""Of a wheel of radius 1 at an approach of 1 with E* = 1, whose contact has the radius 1."""
HEADROOM = 5
ULP = 2.0**-53
KINDS = ("rough", "spikes", "plateaus", "zero", "negative")


def heights(kind, points, wheels, rms, seed):
    """Tracks of every kind, over the approach of the smooth wheel."""
    rng = np.random.default_rng(seed)
    noise = rng.normal(size=(points, wheels))
    return (
        rms
        * {
            "rough": noise,
            "spikes": np.where(rng.random((points, wheels)) < 0.05, 3.0, -0.1),
            "plateaus": np.rint(noise) / 2,
            "zero": 0 * noise,
            "negative": -np.abs(noise) - 0.1,
        }[kind]
    )


@dataclass(frozen=True)
class Tracks:
    """Some tracks of shape (points, wheels), with so many springs to a contact radius of 1."""

    height: np.ndarray
    springs: float

    @property
    def quantum(self):
        """5 (1 + s)^(3/2) (2 a / dx + 512) 2^-53 of the smooth approach, of each wheel."""
        return HEADROOM * (1 + np.ptp(self.height, axis=0)) ** 1.5 * (2 * self.springs + BLOCK) * ULP

    def wheels(self, which=slice(None)):
        return mdr.RollingEnsemble(
            self.height[:, which], spacing=1 / self.springs, radius=1.0, modulus=1.0, force=HERTZ
        )

    def sum_of(self, wheel, place, approach):
        """The force spring by spring, and how far rounded heights, profile and approach may be off it.

        Half a quantum each, in every spring that may touch; the sum of the oracle rounds in its terms.
        """
        wheel_at = {"spacing": 1 / self.springs, "radius": 1.0, "approach": float(approach), "places": [place]}
        (total,), _, (near,) = wheel_on_springs(self.height[:, wheel], **wheel_at, rounding=1e-9)
        each = 1.5 * float(self.quantum[wheel]) + 8 * ULP * (abs(float(approach)) + float(np.abs(self.height).max()))
        return total / self.springs, (near * each + 8 * ULP * total) / self.springs

    def fits(self, approach):
        """Whether no sum can come near to 2^53 quanta, however it is taken: then nothing may be refused."""
        highest, span = float(self.height.max()), float(np.ptp(self.height, axis=0).max())
        deepest = max(float(np.max(approach)) + 0.05 + highest, 0.0)
        rows = 2 * self.springs * math.sqrt(deepest + span) + 2
        return rows * (deepest + span) < 0.99 * float(self.quantum.min()) / ULP

    def overflows(self, approach):
        """Whether the sum of compressions of some wheel is so large that it rounds, wherever the wheel stands."""
        overlap = max(float(np.max(approach)) + float(self.height.min()), 0.0)
        least = (2 * self.springs * math.sqrt(overlap) - 1) * 2 / 3 * overlap
        return least > 1.1 * float(self.quantum.max()) / ULP


def rough(rms, *, springs=20.0, points=300, wheels=3, seed=0):
    return Tracks(rms * np.random.default_rng(seed).normal(size=(points, wheels)), springs)


@st.composite
def tracks(draw, *, fewest=1.0, roughest=3.0, wheels=None):
    springs = draw(st.sampled_from([fewest, 10.0, 12.3, 50.5]) | st.floats(fewest, 200.0))
    points = math.floor(2 * springs) + 1 + draw(st.integers(0, 3) | st.integers(0, 700))
    count = draw(st.integers(1, 4)) if wheels is None else wheels
    rms = draw(st.sampled_from([0.0, 1e-9, 0.01, roughest]) | st.floats(0, roughest))
    height = heights(draw(st.sampled_from(KINDS)), points, count, rms, draw(st.integers(0, 10**6)))
    return Tracks(height, springs)


places = st.sampled_from([0, 1, BLOCK - 1, BLOCK, BLOCK + 1, 2 * BLOCK, 10**6]) | st.integers(0, 3000)
depths = st.sampled_from([1.0, 1.001, 1.1, 0.0, 2.5, 5.0, -1e6, -1e200, 40.0, 500.0]) | st.floats(-3, 3)


@st.composite
def calls(draw, tracks):
    """A place and an approach a wheel: as deep as that for all, or about first touch over the place, wheel by wheel."""
    place, depth = draw(places), draw(depths)
    if draw(st.booleans()):
        return place, depth + draw(st.sampled_from([0.0, 0.01, 1.0])) * np.arange(tracks.height.shape[1])
    touch = np.array([-first_touch(tracks.height[:, i], place, tracks.springs) for i in range(tracks.height.shape[1])])
    return place, touch + draw(st.sampled_from([0.0, 1e-14, -1e-14, 1e-6, -1e-6, 0.3]))


def first_touch(height, place, springs):
    """The largest of h_j - x_j^2 / R."""
    reach = math.ceil(springs * math.sqrt(float(np.ptp(height)))) + 1
    j = np.arange(-reach, reach + 1)
    return float(np.max(height[(place + j) % height.size] - (j / springs) ** 2))


@pytest.mark.slow
@given(data=st.data(), track=tracks())
def test_force_is_the_sum_over_all_springs(data, track):
    """Whatever was asked before, however deep, lifted or refused: right, or an ArithmeticError."""
    wheels = track.wheels()
    for _ in range(data.draw(st.integers(1, 6))):
        place, approach = data.draw(calls(track))
        try:
            found = wheels.force(place, approach)
        except ArithmeticError:
            assert not track.fits(approach)
            continue
        assert not track.overflows(approach)
        assert found.shape == approach.shape
        for i, d in enumerate(approach):
            expected, error = track.sum_of(i, place, d)
            assert abs(found[i] - expected) <= error
            assert found[i] >= 0


def profile_half_a_cell_ahead(wheels, springs):
    x = (np.arange(springs.start, springs.stop) + 0.5) * wheels.spacing
    return np.rint((x**2 / wheels.radius)[:, np.newaxis] / wheels.quantum)


@catches("x^2 / 2R under many wheels", springs=7.3, rms=0.1).at("mdr.RollingEnsemble._profile", Times(0.5))
@catches("many wheels half a cell ahead", springs=7.3, rms=0.1).at(
    "mdr.RollingEnsemble._profile", profile_half_a_cell_ahead
)
@catches("E for E* under many wheels", springs=7.3, rms=0.1).at("mdr.RollingEnsemble.force", Times(E_FOR_E_STAR))
@catches("springs that pull under many wheels", springs=30.0, rms=0.1).at(
    "mdr.rolling_ensemble.np", module_with(np, maximum=lambda values, least, out=None: values)
)
@pytest.mark.parametrize("springs", [1.0, 7.3, 30.0, 100.0])
@pytest.mark.parametrize("rms", [0.0, 1e-3, 0.1])
def test_force_to_1e_12_of_the_smooth_wheel(springs, rms):
    """3/4 of a quantum over d at most for the approach, 5e-13 at a / dx = 100; heights and profile average out."""
    track = rough(rms, springs=springs, points=1200, wheels=2)
    wheels = track.wheels()
    for place in (0, 3, 600, 1100, 1250):
        approach = np.array([1.0, 1.0 + 1e-3 * math.pi])
        found = wheels.force(place, approach)
        for i, d in enumerate(approach):
            assert abs(found[i] - track.sum_of(i, place, d)[0]) <= 1e-12 * HERTZ


def ways():
    """An order of five wheels, and where to part it into groups."""
    return st.tuples(st.permutations(range(5)), st.lists(st.integers(1, 4), max_size=4))


def groups(order, cuts):
    edges = [0, *sorted(set(cuts)), 5]
    return [list(order[first:last]) for first, last in itertools.pairwise(edges)]


@catches("sums that round").at(
    "mdr.rolling_ensemble.np", module_with(np, rint=lambda values: np.asarray(values, dtype=np.float64))
)
@pytest.mark.slow
@given(data=st.data(), track=tracks(fewest=10.0, roughest=0.15, wheels=5), way=ways())
def test_forces_are_independent_of_the_batch_to_the_last_bit(data, track, way):
    asked = [data.draw(calls(track)) for _ in range(4)]
    asked = [(place, approach) for place, approach in asked if track.fits(approach)]
    together = track.wheels()
    expected = [together.force(place, approach) for place, approach in asked]
    for group in groups(*way):
        alone = track.wheels(group)
        # in another order of places
        for (place, approach), force in reversed(list(zip(asked, expected, strict=True))):
            assert np.array_equal(alone.force(place, approach[group]), force[group])


@pytest.mark.slow
@given(track=tracks(fewest=10.0, roughest=1.0, wheels=5), way=ways(), place=places, share=st.floats(0.3, 2))
@example(
    track=Tracks(np.arange(5.0) * np.random.default_rng(0).normal(size=(60, 5)), 20.0),
    way=(range(5), [1, 3]),
    place=0,
    share=1.0,
)
def test_the_approach_under_a_force_has_the_same_bits_too(track, way, place, share):
    expected = track.wheels().approach(place, share * HERTZ)
    for group in groups(*way):
        assert np.array_equal(track.wheels(group).approach(place, share * HERTZ), expected[group])


@pytest.mark.slow
@given(track=tracks(), place=places, share=st.floats(0.05, 3))
@example(track=Tracks(np.zeros((300, 1)), 10.0), place=0, share=1.0)
@example(track=Tracks(np.zeros((300, 1)), 1.0), place=0, share=1.0)
def test_a_prescribed_force_is_borne(track, place, share):
    """Heights and profile are rounded to half a quantum, so the approach is off by a quantum at most."""
    force = share * HERTZ
    wheels = track.wheels()
    approach = wheels.approach(place, force)
    for i, d in enumerate(approach):
        found, error = track.sum_of(i, place, d)
        assert abs(found - force) <= error + 16 * ULP * force


@given(track=tracks(fewest=4.0, roughest=0.1), unit=st.integers(-40, 40))
def test_units_of_force_that_are_powers_of_two_change_no_bit(track, unit):
    approach = np.linspace(0.5, 1.2, track.height.shape[1])
    if not track.fits(approach):
        return
    newton = 2.0**unit
    there = mdr.RollingEnsemble(
        track.height, spacing=1 / track.springs, radius=1.0, modulus=newton, force=newton * HERTZ
    )
    assert np.array_equal(there.force(7, approach) / newton, track.wheels().force(7, approach))
    assert np.array_equal(there.approach(7, newton), track.wheels().approach(7, 1.0))


@given(track=tracks())
def test_the_quantum_is_that_of_its_formula(track):
    assert track.wheels().quantum == pytest.approx(track.quantum, rel=1e-12, abs=0)


def test_a_force_is_refused_where_the_sums_of_a_single_wheel_round():
    """That over the smoother track rounds first, by its finer quantum; the other alone bears more."""
    track = Tracks(np.array([0.0, 1.0]) * np.random.default_rng(0).normal(size=(300, 2)), 20.0)

    def refused(which, force):
        try:
            track.wheels(which).approach(0, force)
        except ArithmeticError:
            return True
        return False

    forces = HERTZ * 2.0 ** np.arange(3, 20)
    smooth, rougher, both = ([refused(which, force) for force in forces] for which in ([0], [1], [0, 1]))
    assert both == smooth
    assert sum(smooth) > sum(rougher) > 0


def test_the_plane_from_which_heights_count_does_not_matter():
    """They are taken from the middle of each track: an offset costs what it rounds, and no more."""
    track = rough(0.1)
    high = Tracks(1024.0 + track.height, track.springs)
    found = high.wheels().force(5, np.full(3, -1023.0))
    for i, force in enumerate(found):
        assert force == pytest.approx(track.wheels().force(5, np.ones(3))[i], rel=1e3 * 64 * ULP)


@pytest.mark.parametrize("overlap", [1.0, 2.0, 3.0, 4.0])
def test_sums_beyond_2_53_are_refused_or_not_seen(overlap):
    """Springs far above the plane of height zero, the wheel lifted as far: each sum is nearly as large as it may be."""
    springs, lowest, highest = 1000.0, 12.5, 26.0
    height = np.where(np.random.default_rng(0).random((9000, 1)) < 0.003, highest, lowest)
    height += 1e-3 * np.random.default_rng(1).random(height.shape)
    height[4500] = highest
    alone, several = (Tracks(np.repeat(height, n, axis=1), springs).wheels() for n in (1, 3))
    d = overlap - highest + 1e-3 * math.pi
    try:
        expected = alone.force(4500, [d])
    except ArithmeticError:
        return
    assert (several.force(4500, [d] * 3) == expected).all()


@pytest.mark.slow
@pytest.mark.parametrize("springs", [3.3, 7.7, 20.5])
def test_newtons_method_ends_where_a_spring_just_touches(springs):
    """Forces within a few roundings of one at which the next spring comes into contact."""
    height = np.random.default_rng(0).normal(size=(80, 20))
    j = np.arange(-40, 41)
    for i in range(20):
        wheels = Tracks(height[:, [i]], springs).wheels()
        quantum = float(wheels.quantum[0])
        # heights count from the middle between the lowest and the highest
        middle = (height[:, i].min() + height[:, i].max()) / 2
        level = np.rint((height[(10 + j) % 80, i] - middle) / quantum) - np.rint((j / springs) ** 2 / quantum)
        level = np.sort(level)[::-1]
        for touching in range(1, 8):
            force = float(np.sum(level[:touching] - level[touching])) * quantum / springs
            for roundings in range(-6, 7):
                approach = float(wheels.approach(10, force * (1 + 2 * roundings * ULP))[0])
                assert approach == pytest.approx(-level[touching] * quantum - middle, abs=2 * quantum)


def test_a_search_that_does_not_end_says_so(monkeypatch):
    """One step from where all springs touch is not enough on a rough track."""
    monkeypatch.setattr("mdr.rolling_ensemble.MOST_STEPS", 1)
    with pytest.raises(ArithmeticError, match="did not end within 1 steps"):
        rough(0.1).wheels().approach(0, HERTZ)


@pytest.mark.parametrize("wrong", [(-1, 4.0), (5, np.nan), (5, 400.0), (0.5, 4.0)])
def test_a_refused_call_leaves_nothing_behind(wrong):
    track = rough(1.0)
    wheels, untouched = track.wheels(), track.wheels()
    wheels.force(5, np.ones(3))
    with pytest.raises((ValueError, TypeError, ArithmeticError)):
        wheels.force(wrong[0], np.full(3, wrong[1]))
    assert np.array_equal(wheels.force(5, np.full(3, 4.0)), untouched.force(5, np.full(3, 4.0)))


def test_a_smooth_wheel_examines_few_springs():
    """Those within the slack of the approach to both sides, 2 % of d: 1 % of the radius inwards and outwards."""
    track = rough(0.0, springs=100.5)
    wheels = track.wheels()
    wheels.force(0, np.ones(3))
    assert 0 < wheels.examined <= 2 * (math.ceil(0.021 * 100.5) + 1)
