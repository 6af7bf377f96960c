"""A wheel on springs: against the sum over all springs, and against what linear theory says of waves."""

import math

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

import mdr
from mdr import rolling
from mdr.approach_by_sorting import Borne, by_sorting
from mdr.spring_track import SpringTrack
from tests.oracles import approach_by_fractions, wheel_on_springs
from tests.seeded import Times, catches, module_with
from tests.strategies import OnSprings, on_springs
from validation.analysis.spectra import waves
from validation.theory.rolling import force_spectrum_1d

KINDS = ("one-sided", "full", "linear")


def rough(points, rms, *, springs, offset=0.0, seed=0):
    """Radius of contact 1, approach 1, E* = 1."""
    noise = np.random.default_rng(seed).normal(size=points)
    return OnSprings(offset + rms * noise, 1 / springs, 1.0, 1.0, 1.0)


def assert_is_the_sum(track, found, approach):
    """Force to the rounding of the sum; stiffness by the springs in contact, but for those that just touch."""
    total, least, most = wheel_on_springs(track.height, spacing=track.spacing, radius=track.radius, approach=approach)
    spring = track.modulus * track.spacing
    assert np.abs(found.force - spring * total).max() <= 1e-12 * spring * total.max() + track.rounding
    in_contact = found.stiffness / spring
    assert np.abs(in_contact - np.rint(in_contact)).max() <= 1e-12 * most.max()
    assert (least <= np.rint(in_contact)).all()
    assert (np.rint(in_contact) <= most).all()


@catches("x^2 / 2R under the wheel").at("mdr.spring_track.SpringTrack.wheel", Times(0.5))
@catches("springs that pull wherever they are in doubt").at(
    "mdr.rolling.np", module_with(np, maximum=lambda values, least: values)
)
@given(track=on_springs(), seed=st.integers(0, 1000))
def test_force_is_the_sum_over_all_springs(track, seed):
    """At one approach, and at one for each point, of any sign: at some of them the wheel is lifted off."""
    each = track.approach * np.random.default_rng(seed).uniform(-2, 1, track.height.size)
    for approach in (track.approach, each):
        found = track.roll(approach=approach)
        assert_is_the_sum(track, found, approach)
        assert np.array_equal(found.approach, np.broadcast_to(approach, track.height.size))
    one = mdr.rolling_force(track.height, **track.wheel, approach=track.approach)
    assert np.array_equal(track.roll().force, one)


@given(springs=st.integers(0, 3000), spacing=st.floats(1e-3, 10), radius=st.floats(0.1, 100), ulps=st.integers(-2, 2))
@example(springs=121, spacing=0.701370178925973, radius=5.094218430888326, ulps=1)
def test_the_reach_of_the_wheel_by_its_profile_as_it_is_rounded(springs, spacing, radius, ulps):
    """x^2 / R < level for so many springs and for no more, also where the level is that of a spring, or next to it."""
    wheel = SpringTrack(np.zeros(3), spacing, radius, 1.0)
    level = wheel.wheel(springs)
    level += ulps * np.spacing(level)
    found = wheel.reach(level)
    assert wheel.wheel(found + 1) >= level
    assert wheel.wheel(found) < level if level > 0 else found == -1


@pytest.mark.parametrize("rms", [0.0, 1e-3, 0.1, 1.0, 10.0])
@pytest.mark.parametrize("points", [1023, 1024, 1025, 2500])
def test_tracks_of_many_blocks(rms, points):
    track = rough(points, rms, springs=12.3, offset=-0.2)
    assert_is_the_sum(track, track.roll(), 1.0)


@given(track=on_springs(longest=60), share=st.floats(-0.2, 0))
def test_a_prescribed_force_is_borne_at_every_position(track, share):
    """Recomputed spring by spring. The approach is rounded, which is worth as much force as the springs are stiff."""
    hertz = 4 / 3 * track.modulus * math.sqrt(track.radius * track.approach) * track.approach
    force = 10**share * hertz
    found = track.roll(force=force)
    total, least, most = wheel_on_springs(
        track.height, spacing=track.spacing, radius=track.radius, approach=found.approach
    )
    spring = track.modulus * track.spacing
    assert (found.force == force).all()
    assert (found.examined >= 0).all()
    rounding = 1e-15 * spring * most * (np.abs(found.approach) + np.abs(track.height).max())
    assert (np.abs(spring * total - force) <= 1e-12 * force + rounding).all()
    assert (least <= np.rint(found.stiffness / spring)).all()
    assert (np.rint(found.stiffness / spring) <= most).all()


@pytest.mark.parametrize(
    ("rms", "offset"), [(0.1, 0.0), (1.0, 5.0), (10.0, 0.0), (100.0, 0.0), (0.1, 100.0), (0.0, 1000.0)]
)
def test_newtons_method_ends_on_wild_tracks(rms, offset):
    """Heights far beyond the approach of the smooth wheel, or counted from a plane far away."""
    track = rough(1500, rms, springs=12.3, offset=offset)
    found = track.roll(force=4 / 3)
    total, _, _ = wheel_on_springs(track.height, spacing=track.spacing, radius=1.0, approach=found.approach)
    assert np.abs(track.spacing * total / found.force - 1).max() <= 1e-12 * (1 + rms + offset)


def spiky(points=400, spike=1.0, rms=1e-4, seed=0):
    """Light and spiky: a rough track with one spring that stands out, or lies low."""
    height = rms * np.random.default_rng(seed).normal(size=points)
    height[points // 3] += spike
    return height


LIGHT = {"spacing": 0.005, "radius": 1.0, "modulus": 1.0, "force": 1e-6}


def assert_is_borne(found, height, *, spacing, radius, modulus, force, positions):
    """Approach and springs in contact of exact arithmetic, but for the rounding of heights, profile and force."""
    wanted = force / (modulus * spacing)
    for i in positions:
        approach, pressed, deepest = approach_by_fractions(height, i, spacing=spacing, radius=radius, wanted=wanted)
        assert abs(found.approach[i] - approach) <= 2e-14 * max(abs(approach), deepest)
        assert round(found.stiffness[i] / (modulus * spacing)) == pressed


def on_the_highest_spring_alone(track, block, wanted, d):
    """Only the approach is wrong where more than one touches."""
    borne = by_sorting(track, block, wanted, d)
    return Borne(borne.approach + wanted * (1 - 1 / borne.pressed), borne.pressed, borne.looked)


@catches("a light wheel on its highest spring alone", spike=0.1).at(
    "mdr.rolling.by_sorting", on_the_highest_spring_alone
)
@pytest.mark.parametrize("spike", [0.1, 10.0, -10.0, 1e8, -1e8])
def test_a_light_wheel_over_a_spike(spike):
    """Where the steps of Newton's method are lost in the rounding of the profile, for ever."""
    height = spiky(spike=spike)
    found = mdr.roll(height, **LIGHT)
    assert_is_borne(found, height, **LIGHT, positions=[0, 71, 132, 133, 134, 140, 210, 399])


@catches("a spike that nobody rolls over").at(
    "mdr.spring_track.Near.beyond", lambda _, offsets: np.zeros(offsets.shape, dtype=bool)
)
def test_a_light_wheel_over_a_spike_of_a_thousand_times_the_roughness():
    """Four thousand positions, and no more springs looked at than a few times those of a track without it."""
    plain, height = spiky(4000, spike=0.0), spiky(4000, spike=0.1)
    found = mdr.roll(height, **LIGHT)
    assert_is_borne(found, height, **LIGHT, positions=[0, 1270, 1300, 1333, 1340, 1396, 3000])
    approach = np.full(4000, mdr.roll(plain, **LIGHT).approach.max())
    wheel = {name: LIGHT[name] for name in ("spacing", "radius", "modulus")}
    with_spike, without = (mdr.roll(h, **wheel, approach=approach).examined for h in (height, plain))
    assert with_spike.max() <= without.max() + 1


@pytest.mark.parametrize(
    ("limit", "value", "sorts"), [("FARTHEST", 1, True), ("MOST_STEPS", 1, True), ("FARTHEST", 10**9, False)]
)
def test_a_wheel_for_which_steps_do_not_end_or_do_not_pay_is_sorted(limit, value, sorts, monkeypatch):
    """One step is not enough; pressed to the lowest of springs, it would look at all of them in every step."""
    track = rough(100, 0.1, springs=12.3)
    by_steps = track.roll(force=4 / 3)
    sorted_blocks = []
    monkeypatch.setattr(f"mdr.rolling.{limit}", value)
    monkeypatch.setattr("mdr.rolling.by_sorting", lambda *args: sorted_blocks.append(args) or by_sorting(*args))
    found = track.roll(force=4 / 3)
    assert bool(sorted_blocks) == sorts
    assert found.approach == pytest.approx(by_steps.approach, rel=1e-14)
    assert np.array_equal(found.stiffness, by_steps.stiffness)


@pytest.mark.parametrize("force", [5e-324, 1e-300, 1e-12, 1.0])
def test_forces_of_any_size_end(force):
    track = {**LIGHT, "force": force, "radius": 1e-3}
    height = spiky(1100, spike=0.3)
    assert_is_borne(mdr.roll(height, **track), height, **track, positions=[0, 360, 366, 900])


@pytest.mark.slow
@given(track=on_springs(longest=40), share=st.floats(-9, 0), spikes=st.integers(0, 3), ties=st.booleans())
def test_sorting_agrees_with_exact_arithmetic(track, share, spikes, ties):
    """On any track, with spikes up to a million times the approach, and heights on a ladder, with many ties."""
    rng = np.random.default_rng(spikes)
    height = np.rint(track.height / track.approach * 4) / 4 * track.approach if ties else track.height.copy()
    places = rng.integers(0, height.size, spikes)
    height[places] += track.approach * 10.0 ** rng.uniform(0, 6, spikes)
    laid = SpringTrack(height, **track.wheel)
    wanted = 10**share * 4 / 3 * math.sqrt(track.radius * track.approach) * track.approach / track.spacing
    smooth = track.approach * 10 ** (share * 2 / 3)
    found = by_sorting(laid, slice(0, height.size), wanted, smooth)
    for i in {0, height.size // 2, *places.tolist()}:
        approach, pressed, deepest = approach_by_fractions(
            height, i, spacing=track.spacing, radius=track.radius, wanted=wanted
        )
        assert abs(found.approach[i] - approach) <= 1e-13 * max(abs(approach), deepest)
        assert ties or found.pressed[i] == pressed


def test_a_spring_that_just_touches_is_not_in_contact():
    """Under a force that brings the wheel down to its neighbours and no farther."""
    found = by_sorting(SpringTrack(np.zeros(7), 1.0, 1.0, 1.0), slice(0, 7), 1.0, 0.5)
    assert np.array_equal(found.approach, np.ones(7))
    assert np.array_equal(found.pressed, np.ones(7))


def test_blocks_that_are_too_large_are_sorted_in_parts(monkeypatch):
    height = spiky(60, spike=0.1)
    track, wheel = SpringTrack(height, 0.005, 1.0, 1.0), slice(0, 60)
    whole = by_sorting(track, wheel, 2e-4, 8e-5)
    monkeypatch.setattr("mdr.approach_by_sorting.MOST_NUMBERS", 100)
    parts = by_sorting(track, wheel, 2e-4, 8e-5)
    assert np.array_equal(parts.approach, whole.approach)
    assert np.array_equal(parts.pressed, whole.pressed)


def spikes_apart(low):
    """Some far out of a rough track, two of them equally far from the wheel; under an approach and a force."""
    height = 0.02 * np.random.default_rng(low).normal(size=900)
    height[[300, 300 + low, 300 + 2 * low, 700]] += [73.1, 21.7, 89.3, 50.9]
    wheel = {"height": height, "spacing": 1 / 20, "radius": 1.0, "modulus": 1.0}
    return [{**wheel, "approach": 1.0}, {**wheel, "force": 4 / 3}]


def spikes_on_a_plane():
    """Which just touches in rounded numbers."""
    height = np.full(200, 0.0018639820557123812)
    height[[40, 95]] += 0.5
    return [{"height": height, "spacing": 0.005, "radius": 1.0, "modulus": 1.0, "approach": 0.0017360179442876189}]


@pytest.mark.parametrize("rolled", [*spikes_apart(25), *spikes_apart(26), *spikes_apart(36), *spikes_on_a_plane()])
def test_springs_that_stand_out_are_added_as_neighbours_are(rolled, monkeypatch):
    """The same bits as by a loop over all neighbours, of which it looks at more."""
    one = mdr.roll(**rolled)
    monkeypatch.setattr("mdr.spring_track.MAX_WORK_SHARE", 0.0)
    other = mdr.roll(**rolled)
    for numbers in ("force", "approach", "stiffness"):
        assert np.array_equal(getattr(one, numbers), getattr(other, numbers))
    assert one.examined.sum() < 0.6 * other.examined.sum()


@pytest.mark.parametrize("kind", ["full", "linear"])
@given(track=on_springs(), share=st.floats(-3, 0))
def test_contacts_that_keep_their_springs_yield_by_their_stiffness(kind, track, share):
    """Under a force the approach differs from that of the smooth wheel by what is missing over the stiffness."""
    force = 10**share * 4 / 3 * track.modulus * math.sqrt(track.radius * track.approach) * track.approach
    d = (9 / 16 / track.radius * (force / track.modulus) ** 2) ** (1 / 3)
    springs = math.sqrt(track.radius * d) / track.spacing
    assume(abs(springs - round(springs)) > 1e-9)
    at_d, found = track.roll(approach=d, contact=kind), track.roll(force=force, contact=kind)
    again = at_d.force + at_d.stiffness * (found.approach - d)
    assert np.abs(again - force).max() <= 1e-12 * (force + np.abs(at_d.force).max())
    assert found.stiffness == pytest.approx(at_d.stiffness, rel=1e-14)


@pytest.mark.parametrize("kind", KINDS)
@given(track=on_springs(), force=st.floats(-6, 6), length=st.floats(-6, 6))
def test_units_do_not_matter(kind, track, force, length):
    """F ~ E* l^2. By powers of two, so that no spring that just touches is lost to rounding."""
    unit, metre = 2.0 ** int(force), 2.0 ** int(length)
    other = OnSprings(
        metre * track.height, metre * track.spacing, metre * track.radius, unit * track.modulus, metre * track.approach
    )
    expected = track.roll(contact=kind).force
    found = other.roll(contact=kind).force / (unit * metre**2)
    assert np.abs(found - expected).max() <= track.rounding


@catches("factor 4 lost in (14.12)").at("validation.theory.rolling.response", Times(0.5))
@given(track=on_springs())
def test_spectrum_of_the_linear_force_is_14_12(track):
    """C_F = 4 E*^2 sin^2(q a) / q^2 C_1D, wave by wave."""
    if track.height.size < 3:
        return
    a = math.sqrt(track.radius * track.approach)
    height = waves(track.height, spacing=track.spacing)
    force = waves(track.roll(contact="linear").force, spacing=track.spacing)
    expected = force_spectrum_1d(height.q, lambda q: height.spectrum, contact_radius=a, modulus=track.modulus)
    unit = (2 * track.modulus * a * (np.abs(track.height).max() + track.approach)) ** 2 / height.q[0]
    assert np.abs(force.spectrum - expected).max() <= 1e-13 * unit


def wave(springs, *, half=0.5):
    """A wave three to a track of 8 contact radii, with a radius of so many springs and a half."""
    spacing = 1 / (springs + half)
    points = round(8 / spacing)
    return spacing, np.cos(2 * np.pi * 3 * np.arange(points) / points + 0.3)


reach = rolling.SpringTrack.reach


@catches("a for 2a under the wheel").at(
    "mdr.spring_track.SpringTrack.reach", lambda track, level: reach(track, level) // 2
)
def test_full_contact_tends_to_the_filter_at_second_order():
    """A spring to each cell of a contact of 2m + 1 of them, the midpoint rule: error (dx^2 / 24) (F'(a) - F'(-a))."""
    errors, spacings = [], []
    for springs in (8, 16, 32, 64):
        spacing, h = wave(springs)
        track = OnSprings(0.1 * h, spacing, 1.0, 1.0, 1.0)
        errors.append(np.abs(track.roll(contact="full").force - track.roll(contact="linear").force).max())
        spacings.append(spacing)
    orders = np.diff(np.log(errors)) / np.diff(np.log(spacings))
    assert orders == pytest.approx(2, abs=0.05)


@catches("springs that pull under the smooth wheel").at(
    "mdr.rolling._one_sided", lambda track, d: rolling._full(track, float(d[0]), None)
)
def test_one_sided_force_leaves_the_linear_one_at_second_order():
    """F - F(0) = linear part + E* R / (4 a) (h(x + a)^2 + h(x - a)^2): springs lost and gained at both edges.

    The linear part is that of the same springs, full contact, so that the grid has no part in it, but for one of
    d / 1000 in the place of the edge. The next order is 1 / d relatively, times a factor of order (q a)^2.
    """
    spacing, h = wave(2000)
    flat = OnSprings(0 * h, spacing, 1.0, 1.0, 1.0)
    second = []
    reach = round(1 / spacing)
    edges = (np.roll(h, reach) ** 2 + np.roll(h, -reach) ** 2) / 4
    heights = np.array([0.08, 0.04, 0.02])
    for height in heights:
        track = OnSprings(height * h, spacing, 1.0, 1.0, 1.0)
        linear = track.roll(contact="full").force - flat.roll(contact="full").force
        beyond = track.roll().force - flat.roll().force - linear
        assert np.abs(beyond / height**2 - edges).max() <= 10 * height * edges.max()
        second.append(math.sqrt(np.mean(beyond**2)))
    assert np.diff(np.log(second)) / np.diff(np.log(heights)) == pytest.approx(2, abs=0.1)


@given(track=on_springs())
def test_springs_whose_contact_is_certain_are_not_examined(track):
    """Springs that all heights of the track let touch, and springs that none does."""
    found = track.roll()
    far = math.sqrt(track.radius * max(track.approach + track.height.max(), 0.0)) / track.spacing + 1
    profile = (np.arange(-math.ceil(far), math.ceil(far) + 1) * track.spacing) ** 2 / track.radius
    rounding = 1e-12 * (track.approach + np.abs(track.height).max())
    doubtful = (profile > track.approach + track.height.min() - rounding) & (
        profile < track.approach + track.height.max() + rounding
    )
    assert (found.examined <= np.count_nonzero(doubtful)).all()
    assert not track.roll(contact="full").examined.any()


@pytest.mark.parametrize("d", [0.37, 1.1])
def test_a_full_contact_is_the_sum_over_springs_nearer_than_its_radius(d):
    """One by one, whether they are compressed or pull; and their stiffness, by an approach and under a force."""
    height = 0.3 * np.random.default_rng(1).normal(size=40)
    near = [j for j in range(-40, 41) if (0.1 * j) ** 2 < 0.8 * d]
    springs = 6.0 * 0.1
    expected = [springs * sum(d - (0.1 * j) ** 2 / 0.8 + height[(i + j) % 40] for j in near) for i in range(40)]
    wheel = {"spacing": 0.1, "radius": 0.8, "modulus": 6.0, "contact": "full"}
    found = mdr.roll(height, **wheel, approach=d)
    assert found.force == pytest.approx(expected)
    assert found.stiffness == pytest.approx(np.full(40, springs * len(near)))
    assert not found.examined.any()
    force = 4 / 3 * 6.0 * math.sqrt(0.8) * d**1.5
    under = mdr.roll(height, **wheel, force=force)
    assert under.approach == pytest.approx(d + (force - np.array(expected)) / (springs * len(near)))
    assert under.stiffness == pytest.approx(found.stiffness)
    assert under.force == pytest.approx(np.full(40, force))
    assert not under.examined.any()
