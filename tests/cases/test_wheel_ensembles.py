"""Wheels on springs: tracks that are drawn, equal bits in batches of any size, linear theory."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.cases.planted import BOTH, LITTLE, ROUNDING, SMALL, TRACKS, power, rides
from tests.seeded import Times, catches
from validation.cases.wheel import ensembles
from validation.cases.wheel.ensembles import FLOOR, Spectrum
from validation.simulation import wheel_on_springs as wheel_ensemble
from validation.simulation.motion import natural_periods, simulate
from validation.simulation.wheel_on_springs import simulate_ensemble


@pytest.mark.parametrize("track", TRACKS)
def test_tracks_have_their_rms(track):
    """Amplitudes are fixed: of each wheel, to rounding."""
    height = rides(count=3, track=track).heights()
    assert height.std(axis=0) == pytest.approx(np.full(3, SMALL.rail.rms), rel=ROUNDING, abs=0)
    assert np.abs(height.mean(axis=0)).max() <= ROUNDING * SMALL.rail.rms


@pytest.mark.parametrize("scene", [SMALL, BOTH, LITTLE], ids=["rail", "both", "wheel"])
def test_a_number_is_one_track_in_every_ensemble(scene):
    some, alone = rides(scene, count=4).heights(), rides(scene, first=2).heights()
    np.testing.assert_array_equal(some[:, [2]], alone)
    assert np.abs(np.corrcoef(some.T) - np.eye(4)).max() < 0.9
    assert not np.allclose(rides(scene, first=2, seed=6).heights(), alone)


@pytest.mark.parametrize("distance", [0.03, 0.16, 0.1851])
def test_open_tracks_are_longer_than_what_is_rolled(distance):
    """By four longest waves, of rail or wheel: their end has nothing to do with their beginning."""
    ride = rides(replace(BOTH, distance=distance))
    assert ride.steps == ride.scene.points >= distance / ride.scene.spacing
    assert ride.heights().shape == (ride.places, 1)
    assert (ride.places - ride.steps) * ride.scene.spacing >= 4 * 10e-3


STEADY = {"track": "steady-state"}


places_of = wheel_ensemble.WheelEnsemble.places.fget


@catches("a periodic track taken as open", track="steady-state", rounds=1, distance=0.16).at(
    "validation.simulation.wheel_on_springs.WheelEnsemble.places",
    property(lambda rides: places_of(replace(rides, track="open"))),
)
@catches("a part of a motion that repeats itself after the part", track="part", rounds=2, distance=0.16).at(
    "validation.simulation.wheel_on_springs.WheelEnsemble.places",
    property(lambda rides: places_of(replace(rides, **STEADY))),
)
@pytest.mark.parametrize("distance", [0.03, 0.16, 0.1851])
@pytest.mark.parametrize(("track", "rounds"), [("steady-state", 1), ("part", 2)])
def test_periodic_tracks_take_whole_natural_periods_and_a_half(track, rounds, distance):
    """To half a cell, and as long as asked for to half a period, or twice; of a part about a half is recorded."""
    ride = rides(replace(SMALL, distance=distance), track=track)
    assert ride.places == len(ride.heights()) and ride.steps == (ride.places if rounds == 1 else ride.scene.points)
    wheel, cell = SMALL.body, SMALL.spacing
    found = natural_periods(wheel, ride.places * cell, SMALL.speed)
    assert found - 0.5 == pytest.approx(round(found - 0.5), abs=0.5 * natural_periods(wheel, cell, SMALL.speed) + 1e-9)
    assert found == pytest.approx(max(natural_periods(wheel, rounds * ride.scene.length, SMALL.speed), 0.5), abs=0.55)


@pytest.mark.parametrize("linear", [False, True], ids=["springs", "linear"])
def test_a_part_is_the_beginning_of_the_motion_that_repeats_itself(linear):
    """Of a track of the same places: the first of its steps, to the bit, and ends that do not meet."""
    scene = replace(SMALL, distance=replace(SMALL, distance=0.06).length * (1 - ROUNDING), damping=0.02)
    part = rides(scene, count=2, groups=2, track="part", linear=linear)
    steady = replace(part, scene=replace(scene, distance=2 * scene.length), track="steady-state")
    assert steady.places == part.places == steady.steps > part.steps
    some, all_of_it = (wheel_ensemble._motion(ride)[0] for ride in (part, steady))
    np.testing.assert_array_equal(some.acceleration, all_of_it.acceleration[: part.steps])
    assert np.abs(all_of_it.jump).max() < 1e-3 * np.abs(some.jump).min()


@catches("a wheel of half of its circumference").at(
    "validation.scenes.wheel_body.OnTrack.circumference_points",
    property(lambda one: round(np.pi * one.radius / one.spacing)),
)
def test_the_roughness_of_a_wheel_repeats_after_its_circumference():
    """Two pi R, to half a cell; not after half of it, and its rms is that of one turn."""
    around = round(2 * math.pi * LITTLE.radius / LITTLE.spacing)
    ride = rides(LITTLE)
    height = ride.heights()[: ride.steps, 0]
    assert height.size > 2 * around
    np.testing.assert_array_equal(height[around:], height[:-around])
    assert height[:around].std() == pytest.approx(LITTLE.wheel.rms, rel=ROUNDING, abs=0)
    half = around // 2
    assert np.std(height[half:] - height[:-half]) > LITTLE.wheel.rms


@pytest.mark.slow
def test_rail_and_wheel_add_as_spectra():
    """Heights add to the last bit; where they are independent the cross terms of 40 pairs are below four standard
    errors of a mean of products of independent waves."""
    count, steps = 40, rides(BOTH).steps
    alone = rides(replace(BOTH, ground=None))
    turns = [alone._draw_track(BOTH.wheel, BOTH.circumference_points, wheel_ensemble.WHEEL, i) for i in range(count)]
    both, rail = (rides(one, count=count).heights()[:steps] for one in (BOTH, replace(BOTH, wheel=None)))
    of_wheel = np.stack([np.resize(one, steps) for one in turns], axis=1)
    assert both == pytest.approx(rail + of_wheel, abs=1e-18)
    found = power(both).sum(axis=0) - power(rail).sum(axis=0) - power(of_wheel).sum(axis=0)
    assert abs(found.mean()) <= 4 * found.std() / math.sqrt(count)
    q = np.linspace(0.5 * BOTH.rail.q_min, 1.5 * BOTH.rail.q_max, 999)
    total = ensembles.roughness(BOTH)(q)
    np.testing.assert_array_equal(total, BOTH.rail.spectrum.c1d(q) + BOTH.wheel.spectrum.c1d(q))
    assert ensembles.roughness(SMALL)(q) == pytest.approx(SMALL.rail.spectrum.c1d(q), rel=ROUNDING)


heights_of = wheel_ensemble.WheelEnsemble.heights


@catches("Geike's spectrum for the rolling-equivalent one").at(
    "validation.simulation.wheel_on_springs.WheelEnsemble.heights",
    lambda rides: heights_of(replace(rides, input_spectrum="geike")),
)
def test_the_rolling_spectrum_has_long_waves_and_geikes_has_none():
    """Below q_min, what crosses the track aslant; above, Geike's has more in every wave."""
    tracks = [rides(track="steady-state", input_spectrum=feed) for feed in ("geike", "rolling")]
    geike, rolling = (power(track.heights())[:, 0] for track in tracks)
    steps = tracks[0].places
    q = 2 * np.pi * np.arange(1, steps // 2 + 1) / (steps * SMALL.spacing)
    below, beyond = q < SMALL.rail.q_min, q > SMALL.rail.q_max
    inside = ~below & ~beyond
    assert below.sum() >= 10
    assert geike[below].sum() <= 1e-24 * geike.sum()
    assert (rolling[below] > 1e-6 * rolling.sum()).all() and (rolling[inside] < geike[inside]).all()
    assert rolling[beyond].sum() <= 1e-24 * rolling.sum()


@pytest.mark.parametrize("linear", [False, True], ids=["springs", "linear"])
@pytest.mark.parametrize("track", TRACKS)
def test_batches_of_any_size_give_equal_bits(track, linear):
    settings = {"track": track, "linear": linear}
    short = replace(SMALL, distance=0.06)
    together = simulate_ensemble(rides(short, count=6, groups=6, **settings))
    for first, count in ((0, 1), (1, 2), (3, 3)):
        part = simulate_ensemble(rides(short, first=first, count=count, groups=count, **settings))
        own = slice(first, first + count)
        for name in ("jump", "lowest", "highest", "airborne", "plain", "hann"):
            np.testing.assert_array_equal(part[name], together[name][own], err_msg=name)
        np.testing.assert_array_equal(part["levels"], together["levels"][:, own])
        # sums over a record in another order
        rms = np.sqrt(together["square"][own])
        assert part["square"] == pytest.approx(together["square"][own], rel=ROUNDING)
        assert np.abs(part["mean"] - together["mean"][own]).max() <= ROUNDING * rms.max()


def test_groups_are_means_of_their_wheels():
    apart, groups = (simulate_ensemble(rides(count=6, groups=groups)) for groups in (6, 2))
    for name in ("plain", "hann"):
        means = apart[name].reshape(2, 3, -1).mean(axis=1)
        assert groups[name] == pytest.approx(means, rel=1e-9, abs=0), name
    with pytest.raises(ValueError, match="count must be a multiple of groups, got 5 and 2"):
        rides(count=5, groups=2)


@pytest.mark.parametrize("linear", [False, True], ids=["springs", "linear"])
@pytest.mark.parametrize("track", TRACKS)
def test_the_balance_of_forces_holds_to_rounding(track, linear):
    """Of a sum of N values in their rms: N^(1/2) roundings, of the load beside which the acceleration may be small."""
    ride = rides(count=3, groups=1, track=track, linear=linear)
    outcome = simulate_ensemble(ride)
    gravity = SMALL.load / SMALL.mass
    room = 8 * 2.0**-53 * max(gravity / float(np.sqrt(outcome["square"].min())), 1.0) * math.sqrt(ride.steps)
    assert np.abs(outcome["balance"]).max() <= room < 1e-11
    # a velocity that is a thousandth off is out of balance
    law = wheel_ensemble.SpringsLaw(SMALL.body, ride.heights(), SMALL.spacing)
    motion = simulate(SMALL.body, law, time_step=SMALL.time_step, steps=300)
    assert np.abs(wheel_ensemble.balance(replace(motion, velocity=1.001 * motion.velocity))).min() > 1e-8


def closed_form(scene, omega, length):
    """A of (14.17) at waves of a track: that of each wave alone, whose amplitude is scaled to the rms of the sum."""
    q = omega / scene.speed
    c1d = scene.rail.spectrum.c1d(q)
    waves = 2 * np.pi * np.arange(1, 1 + int(scene.rail.q_max * length / (2 * np.pi) + 2)) / length
    scale = scene.rail.rms**2 / (2 * np.sum(2 * np.pi / length * scene.rail.spectrum.c1d(waves)))
    a, modulus = scene.contact_radius, scene.modulus
    force = scale * c1d * (2 * modulus * np.sin(q * a) / q) ** 2
    with np.errstate(divide="ignore"):
        resonator = 1 / (scene.mass * (1 - (scene.eigenfrequency / omega) ** 2)) ** 2
    return force * 2 * np.pi / scene.speed * resonator


def inverted(omega, *, eigenfrequency, mass, damping):
    """omega / omega_0 for omega_0 / omega."""
    return 1 / (mass * (1 - (np.asarray(omega) / eigenfrequency) ** 2)) ** 2


@catches("omega / omega_0 for omega_0 / omega").at("validation.theory.rolling.acceleration_over_force", inverted)
@catches("factor 2 pi lost over frequency").at("validation.theory.rolling.over_frequency", Times(1 / (2 * np.pi)))
def test_the_linear_contact_has_its_closed_form_wave_by_wave():
    """A steady record is one period of its track, so waves are lines. Leapfrog sees 2 sin(omega dt / 2) / dt for omega,
    by which the resonator is known to be off; where a wave is too weak for its rounding, to that."""
    ride = rides(count=2, groups=2, track="steady-state", linear=True)
    outcome = simulate_ensemble(ride)
    omega, length = outcome["omega"], ride.places * SMALL.spacing
    stepped = 2 * np.sin(omega * SMALL.time_step / 2) / SMALL.time_step
    leapfrog = ((1 - (SMALL.eigenfrequency / omega) ** 2) / (1 - (SMALL.eigenfrequency / stepped) ** 2)) ** 2
    exact = closed_form(SMALL, omega, length) * leapfrog
    for one in outcome["plain"]:
        assert one == pytest.approx(exact, rel=1e-6, abs=1e-15 * exact.max())
    # and the closed form of the case, but for the sum over waves in place of the integral
    spectrum = Spectrum.of(SMALL, [outcome])
    inside = exact > 1e-9 * exact.max()
    ratio = outcome["plain"].mean(axis=0)[inside] / (spectrum.linear * leapfrog)[inside]
    assert np.ptp(ratio) <= 1e-6
    assert ratio.mean() == pytest.approx(1, rel=2 * np.pi / (SMALL.rail.q_min * length))


def test_the_floor_of_an_open_record_is_its_jump():
    """J^2 / (omega^2 T) of the linear contact, wheel by wheel. A jump J' of the slope adds J'^2 / omega^4: in the mean
    of spectra ~ omega^-p from omega_1 on (p - 1) / (p - 3) (omega_1 / omega)^2 of it, three times which is room; and a
    wave near the end of the band, at 1 / 1.3 of where the floor begins, has 1 / (1 - 1 / 1.3)^2 = 19 shares."""
    ride = rides(count=40, groups=10, linear=True)
    spectrum = Spectrum.of(SMALL, [simulate_ensemble(ride)])
    predicted = ensembles.expected(spectrum)[FLOOR]
    slopes = 3 * 3.4 / 1.4 * (SMALL.jump / (1.3 * SMALL.cutoff)) ** 2
    near = 19 * (SMALL.jump / SMALL.cutoff) ** 3.4
    assert ensembles.measured(spectrum)[FLOOR].value / predicted == pytest.approx(1, abs=slopes + near)
    assert slopes + near < 0.02
    # and not that of Hann's window, which has no jump
    of_hann = Spectrum(**{**vars(spectrum), "plain": spectrum.hann})
    assert ensembles.measured(of_hann)[FLOOR].value < 0.01 * predicted
