"""Wheel cases: generated tracks, bitwise reproducibility, spectral leakage, verdicts after injected errors."""

import functools
import math
import re
from dataclasses import replace

import numpy as np
import pytest

from validation.analysis import spectra
from validation.analysis.evidence import ClaimStatus, Verdict, number_with
from validation.cases.wheel import contrast, distance_numbers, half_space_numbers, spectrum_numbers
from validation.cases.wheel import distance as wheel_distance
from validation.cases.wheel import distance_evidence as wheel_distance_evidence
from validation.cases.wheel import features as wheel_features
from validation.cases.wheel import half_space as wheel_3d
from validation.cases.wheel import half_space_evidence as wheel_3d_evidence
from validation.cases.wheel import half_space_levels as wheel_3d_levels
from validation.cases.wheel import spectrum as wheel
from validation.cases.wheel import spectrum_evidence as wheel_evidence
from validation.cases.wheel.features import BREAK, FLOOR, JUMP, PEAK, PERIOD, PREDICTED, SLOPE, Spectrum
from validation.cases.wheel.spectrum_numbers import FEATURES
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import Engine
from validation.scenes.dynamic_wheel import load_wheel_scene
from validation.simulation import wheel_on_springs as wheel_ensemble
from validation.simulation.motion import natural_periods, simulate
from validation.simulation.wheel_on_half_space import WheelStrip, simulate_strip
from validation.simulation.wheel_on_springs import WheelEnsemble, simulate_ensemble
from validation.theory import wheel as wheel_theory

TABLE = load_wheel_scene("table_14_1")
ROUNDING = 1e-12
DECIBEL = 10 / math.log(10)
SMALL = replace(TABLE, distance=0.16, springs=24, rail=replace(TABLE.rail, shortest=0.5e-3))
"""Seven natural periods in two thousand steps."""
BOTH = replace(SMALL, wheel=replace(SMALL.rail, rms=0.3e-6, longest=5e-3, hurst=0.5))
LITTLE = replace(SMALL, radius=0.02, rail=None, wheel=replace(SMALL.rail, shortest=0.4e-3), distance=0.3)
"""A wheel that turns more than twice."""
TRACKS = ("open", "periodic", "steady-state")


def rides(scene=SMALL, **settings):
    return WheelEnsemble(scene=scene, **{"seed": 5, **settings})


def power(height):
    """Mean square of each wave of a track, two-sided, shape (waves, wheels), without the mean."""
    return np.abs(np.fft.rfft(height, axis=0, norm="forward")[1:]) ** 2


# --- tracks -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("track", TRACKS)
def test_tracks_have_their_rms(track):
    """Amplitudes are fixed: of each wheel, to rounding."""
    height = rides(count=3, track=track).heights()
    assert height.std(axis=0) == pytest.approx(np.full(3, SMALL.rail.rms), rel=ROUNDING)
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


@pytest.mark.parametrize("distance", [0.03, 0.16, 0.1851])
@pytest.mark.parametrize(("track", "half"), [("periodic", 0.0), ("steady-state", 0.5)])
def test_periodic_tracks_take_whole_natural_periods(track, half, distance):
    """To half a cell, and as long as asked for to half a period, one where that would be none."""
    ride = rides(replace(SMALL, distance=distance), track=track)
    assert ride.places == ride.steps == len(ride.heights())
    wheel, cell = SMALL.body, SMALL.spacing
    found = natural_periods(wheel, ride.steps * cell, SMALL.speed)
    assert (found - half) == pytest.approx(
        round(found - half), abs=0.5 * natural_periods(wheel, cell, SMALL.speed) + 1e-9
    )
    assert found == pytest.approx(max(natural_periods(wheel, distance, SMALL.speed), 1.0 - half), abs=0.55)


def test_the_roughness_of_a_wheel_repeats_after_its_circumference():
    """Two pi R, to half a cell; not after half of it, and its rms is that of one turn."""
    around = round(2 * math.pi * LITTLE.radius / LITTLE.spacing)
    ride = rides(LITTLE)
    height = ride.heights()[: ride.steps, 0]
    assert height.size > 2 * around
    np.testing.assert_array_equal(height[around:], height[:-around])
    assert height[:around].std() == pytest.approx(LITTLE.wheel.rms, rel=ROUNDING)
    half = around // 2
    assert np.std(height[half:] - height[:-half]) > LITTLE.wheel.rms


@pytest.mark.slow
def test_rail_and_wheel_add_as_spectra():
    """Heights add to the last bit; where they are independent the cross terms of 40 pairs are below four standard
    errors of a mean of products of independent waves."""
    count = 40
    steps = rides(BOTH).steps
    both = rides(BOTH, count=count).heights()[:steps]
    rail = rides(replace(BOTH, wheel=None), count=count).heights()[:steps]
    wheel_alone = replace(BOTH, rail=None)
    around = wheel_ensemble.WheelEnsemble._drawn
    of_wheel = np.stack(
        [
            np.resize(
                around(rides(wheel_alone), BOTH.wheel, BOTH.circumference_points, wheel_ensemble.WHEEL, i), len(rail)
            )
            for i in range(count)
        ],
        axis=1,
    )
    assert both == pytest.approx(rail + of_wheel, abs=1e-18)
    found = power(both).sum(axis=0) - power(rail).sum(axis=0) - power(of_wheel).sum(axis=0)
    assert abs(found.mean()) <= 4 * found.std() / math.sqrt(count)
    q = np.linspace(0.5 * BOTH.rail.q_min, 1.5 * BOTH.rail.q_max, 999)
    total = wheel_features.roughness(BOTH)(q)
    np.testing.assert_array_equal(total, BOTH.rail.spectrum.c1d(q) + BOTH.wheel.spectrum.c1d(q))
    assert wheel_features.roughness(SMALL)(q) == pytest.approx(SMALL.rail.spectrum.c1d(q), rel=ROUNDING)


def test_the_rolling_spectrum_has_long_waves_and_geikes_has_none():
    """Below q_min, what crosses the track aslant; above, Geike's has more in every wave."""
    tracks = {feed: rides(track="steady-state", input_spectrum=feed) for feed in ("geike", "rolling")}
    found = {feed: power(ride.heights())[:, 0] for feed, ride in tracks.items()}
    steps = tracks["geike"].places
    q = 2 * np.pi * np.arange(1, steps // 2 + 1) / (steps * SMALL.spacing)
    below, inside = q < SMALL.rail.q_min, (q > SMALL.rail.q_min) & (q < SMALL.rail.q_max)
    assert below.sum() >= 10
    assert found["geike"][below].sum() <= 1e-24 * found["geike"].sum()
    assert (found["rolling"][below] > 1e-6 * found["rolling"].sum()).all()
    assert (found["rolling"][inside] < found["geike"][inside]).all()
    beyond = q > SMALL.rail.q_max
    assert found["rolling"][beyond].sum() <= 1e-24 * found["rolling"].sum()


# --- ensembles --------------------------------------------------------------------------------------------------------


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
    apart = simulate_ensemble(rides(count=6, groups=6))
    groups = simulate_ensemble(rides(count=6, groups=2))
    for name in ("plain", "hann"):
        means = np.stack([apart[name][:3].mean(axis=0), apart[name][3:].mean(axis=0)])
        assert groups[name] == pytest.approx(means, rel=1e-9), name
    with pytest.raises(ValueError, match="count must be a multiple of groups, got 5 and 2"):
        rides(count=5, groups=2)


@pytest.mark.parametrize("linear", [False, True], ids=["springs", "linear"])
@pytest.mark.parametrize(("track", "release"), [("open", 0.0), ("periodic", 0.0), ("steady-state", 0.0), ("open", 0.4)])
def test_the_balance_of_forces_holds_to_rounding(track, release, linear):
    """Of a sum of N values in their rms: N^(1/2) roundings, of the load beside which the acceleration may be small."""
    ride = rides(count=3, groups=1, track=track, release=release, linear=linear)
    outcome = simulate_ensemble(ride)
    gravity = SMALL.load / SMALL.mass
    room = 8 * 2.0**-53 * max(gravity / float(np.sqrt(outcome["square"].min())), 1.0) * math.sqrt(ride.steps)
    assert np.abs(outcome["balance"]).max() <= room < 1e-11


def test_a_force_of_another_load_is_out_of_balance():
    """Negative control: a velocity that is a thousandth off."""
    heights = rides(count=2).heights()
    law = wheel_ensemble.SpringsLaw(SMALL.body, heights, SMALL.spacing)
    motion = simulate(SMALL.body, law, time_step=SMALL.time_step, steps=300)
    assert np.abs(wheel_ensemble.balance(motion)).max() < 1e-13
    assert np.abs(wheel_ensemble.balance(replace(motion, velocity=1.001 * motion.velocity))).min() > 1e-8


# --- linear theory ----------------------------------------------------------------------------------------------------


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


def test_the_linear_contact_on_open_tracks_has_its_closed_form_band_by_band():
    """Within four standard errors over wheels, and a band's part of the sum over waves in place of the integral."""
    ride = rides(count=40, groups=40, linear=True)
    outcome = simulate_ensemble(ride)
    spectrum = Spectrum.of(SMALL, [outcome])
    edges = spectra.one_third_octaves(1.1 * SMALL.jump, 0.9 * SMALL.cutoff)
    found = spectra.band_levels(spectrum.omega, spectrum.hann.T, edges)
    exact = spectra.band_levels(spectrum.omega, spectrum.linear, edges)
    error = found.std(axis=1, ddof=1) / math.sqrt(40)
    whole = 2 * np.pi / (SMALL.rail.q_min * ride.places * SMALL.spacing)
    assert exact.size >= 10
    assert (np.abs(found.mean(axis=1) - exact) <= 4 * error + whole * exact).all()


def test_a_steady_linear_contact_has_nothing_outside_of_its_waves():
    """Rounding: 1e-16 of its size in each step, squared; open tracks leak there."""
    for track, most in (("steady-state", 1e-24), ("open", 1.0)):
        outcome = simulate_ensemble(rides(count=2, track=track, linear=True))
        omega, density = outcome["omega"], outcome["plain"][0]
        outside = (omega < 0.99 * SMALL.jump) | (omega > 1.01 * SMALL.cutoff)
        share = density[outside].max() / density.max()
        assert share <= most
        assert track == "steady-state" or share > 1e-4


def test_the_floor_of_an_open_record_is_its_jump():
    """J^2 / (omega^2 T) of the linear contact, wheel by wheel. A jump J' of the slope adds J'^2 / omega^4: in the mean
    of spectra ~ omega^-p from omega_1 on (p - 1) / (p - 3) (omega_1 / omega)^2 of it, three times which is room; and a
    wave near the end of the band, at 1 / 1.3 of where the floor begins, has 1 / (1 - 1 / 1.3)^2 = 19 shares."""
    ride = rides(count=40, groups=10, linear=True)
    spectrum = Spectrum.of(SMALL, [simulate_ensemble(ride)])
    value = wheel_features.measured(spectrum)[FLOOR + PREDICTED]
    slopes = 3 * 3.4 / 1.4 * (SMALL.jump / (1.3 * SMALL.cutoff)) ** 2
    near = 19 * (SMALL.jump / SMALL.cutoff) ** 3.4
    assert value.value == pytest.approx(1, abs=slopes + near)
    assert slopes + near < 0.02
    # and not that of Hann's window, which has no jump
    of_hann = Spectrum(**{**vars(spectrum), "plain": spectrum.hann})
    assert wheel_features.measured(of_hann)[FLOOR + PREDICTED].value < 0.01


def jump_of_waves(scene, ride):
    """<J^2> of the linear contact from rest, over the phases of the waves of the track; forced <a^2>.

    a(T) = sum of a_j (exp(i omega_j T) - cos(omega_0 T) + omega_0 / (i omega_j) sin(omega_0 T)), since free vibration
    takes away the acceleration and the velocity with which the forced motion begins; a(0) = 0.
    """
    length, duration = ride.places * scene.spacing, ride.steps * scene.time_step
    waves = 2 * np.pi / length * np.arange(1, math.ceil(scene.rail.q_max * length / (2 * np.pi)))
    omega = waves[waves > scene.rail.q_min * (1 - 1e-9)] * scene.speed
    squares = 2 * closed_form(scene, omega, length) / (length / scene.speed)
    turn = scene.eigenfrequency * duration
    factor = np.exp(1j * omega * duration) - math.cos(turn)
    factor = factor + scene.eigenfrequency / (1j * omega) * math.sin(turn)
    return float(squares @ np.abs(factor) ** 2), float(squares.sum()), turn


@pytest.mark.slow
@pytest.mark.parametrize(("quarters", "theory"), [(1, 1.0), (2, 2.0), (3, 1.0), (4, 2.0)])
def test_the_mean_square_jump_is_that_of_linear_theory(quarters, theory):
    """Of 400 wheels from rest on the linear contact, within three standard errors of the sum over waves. The theorem
    leaves out the velocity, (omega_0 / omega_1)^2 of it at quarters of a period, and what a band that begins sharply
    still knows of itself x further, 3.4 / (q_min x), twice, x being the thirty longest waves that are left."""
    distance = quarters / 4 * 2 * math.pi * SMALL.speed / SMALL.eigenfrequency
    scene = replace(SMALL, springs=12, distance=distance, rail=replace(SMALL.rail, shortest=1e-3))
    ride = rides(scene, count=400, groups=1, linear=True)
    outcome = simulate_ensemble(ride)
    squares = outcome["jump"] ** 2
    exact, forced, turn = jump_of_waves(scene, ride)
    error = 3 * float(squares.std(ddof=1)) / math.sqrt(400)
    assert squares.mean() == pytest.approx(exact, abs=error)
    said = wheel_theory.mean_square_jump(
        forced, eigenfrequency=scene.eigenfrequency, duration=ride.steps * scene.time_step
    )
    # a record ends on a cell, and is as long as an FFT is fast at
    assert said / forced == pytest.approx(1 + math.cos(turn) ** 2, rel=ROUNDING)
    assert said / forced == pytest.approx(theory, abs=0.05)
    left_out = (scene.eigenfrequency / scene.jump) ** 2 + 2 * 3.4 / (60 * math.pi)
    assert squares.mean() == pytest.approx(said, abs=error + left_out * forced)
    # which tells whole periods from quarters
    assert error + left_out * forced < 0.8 * forced


# --- boundary elements in the time loop -------------------------------------------------------------------------------

COARSE = replace(TABLE, springs=8, distance=0.16, rail=replace(TABLE.rail, longest=8e-3, shortest=2e-3))
LOW = replace(COARSE, rail=replace(COARSE.rail, shortest=4e-3, rms=1e-3 * COARSE.approach))


def strip(scene=LOW, **settings):
    given = {"realisation": 0, "natural_periods": 0, "width": 2, "cells": 4, "shared": 2, "tolerance": 1e-8, "seed": 1}
    return WheelStrip(scene=scene, **{**given, **settings})


def test_strips_are_the_same_surface_on_grids_with_a_divisor():
    """Cells of a third: the coarse centres are among the fine ones; as long, and as wide."""
    coarse, fine = strip(cells=4, shared=4), strip(cells=12, shared=4)
    assert fine.surface()[1::3, 1::3] == pytest.approx(coarse.surface(), abs=1e-10 * LOW.rail.rms)
    assert fine.shape[0] * fine.spacing == pytest.approx(coarse.shape[0] * coarse.spacing, rel=ROUNDING)
    assert coarse.surface().std() == pytest.approx(LOW.rail.rms, rel=ROUNDING)
    turn = natural_periods(LOW.body, coarse.shape[0] * coarse.spacing, LOW.speed)
    assert turn == pytest.approx(0.5, abs=0.5 * natural_periods(LOW.body, LOW.contact_radius / 4, LOW.speed))
    with pytest.raises(ValueError, match="cells must be a multiple of shared, got 5 and 2"):
        strip(cells=5)


@pytest.mark.parametrize("scene", [replace(LOW, rail=None), BOTH], ids=["smooth", "rough wheel"])
def test_a_strip_is_that_of_a_rough_rail_alone(scene):
    with pytest.raises(ValueError, match="scene must have a rough rail and a smooth wheel"):
        strip(scene)


@pytest.mark.slow
def test_a_low_strip_is_the_linear_contact():
    """At h / d = 1e-3, step by step: what is left is of the grid, first order in the cells: a circle whose radius is
    known to half a cell answers the force of a wave with as much error, 1 / (2 cells)."""
    worst = {}
    for cells in (4, 8):
        outcome = simulate_strip(strip(cells=cells))
        assert outcome["failed"] == 0
        worst[cells] = np.abs(outcome["bem"] - outcome["linear"]).max() / outcome["linear"].std()
        assert worst[cells] <= 0.5 / cells
    assert worst[8] < 0.6 * worst[4]


QUICK_3D = wheel_3d.Wheel3D(
    scene=COARSE, strips=3, coarser=1, cells=4, coarse=3, shared=1, wheels=20, groups=5, tolerance=1e-4
)


def losing(*realisations):
    """Rolls, with a residual that nothing reaches for some."""

    @functools.wraps(simulate_strip)
    def roll(one):
        return simulate_strip(replace(one, tolerance=1e-18) if one.realisation in realisations else one)

    return roll


@pytest.mark.slow
@pytest.mark.filterwarnings("default")
def test_a_strip_that_does_not_converge_is_lost_and_the_case_goes_on(monkeypatch):
    monkeypatch.setattr(wheel_3d, "simulate_strip", losing(3))
    case = replace(QUICK_3D, strips=4)
    result = wheel_3d.run(case)
    lost = result.strips[wheel_3d.FINEST][3]
    assert lost["failed"] == 1
    assert np.isnan(lost["bem"]).all()
    assert np.isfinite(lost["linear"]).all()
    assert result.unconverged == ("strip 3, 4 cells to a radius, residual 0.0001",)
    found = wheel_3d_evidence.evidence(result)
    assert found.unconverged == result.unconverged
    assert all(math.isfinite(number.value) and number.met for number in found.numbers)


@pytest.mark.slow
@pytest.mark.filterwarnings("default")
def test_too_few_strips_are_no_evidence(monkeypatch):
    monkeypatch.setattr(wheel_3d, "simulate_strip", losing(1))
    with pytest.raises(NotConvergedError, match="2 strips converged on 4 cells to a radius, 3 are needed") as caught:
        wheel_3d.run(QUICK_3D)
    assert caught.value.unconverged == ("strip 1, 4 cells to a radius, residual 0.0001",)


# --- evidence ---------------------------------------------------------------------------------------------------------


def feature(evidence, name):
    return number_with(evidence.numbers, FEATURES[name].quantity)


def whole(evidence):
    """All criteria met, all there, something follows; only lines that a band does not have are NaN."""
    assert all(number.met for number in evidence.numbers)
    assert all(math.isfinite(number.value) and math.isfinite(number.uncertainty) for number in evidence.numbers)
    assert evidence.conclusions
    assert evidence.captions
    for sentence in (evidence.method, *evidence.conclusions, *evidence.captions.values()):
        assert not re.search(r"\b(nan|inf)\b", sentence)
    assert len({table.name for table in evidence.tables}) == len(evidence.tables)
    for table in (*evidence.tables, *evidence.page_tables):
        assert all(len(column) for column in table.columns.values())


LONG = wheel.WheelSpectrum(
    scene=replace(SMALL, distance=3.0),
    realisations=20,
    varied=6,
    groups=5,
    batch=10,
    parameters=False,
    cells=6,
    snapshot_steps=4,
)


@pytest.fixture(scope="module")
def long_wheel():
    return wheel.run(LONG)


def spectrum_of(result):
    """Of the scene itself."""
    return Spectrum.of(result.case.scene, result.batches[result.case.scene.name])


def changed(result, change):
    """Every batch of the base with some arrays changed."""
    return replace(result, batches={n: [{**o, **change(o)} for o in some] for n, some in result.batches.items()})


@pytest.mark.slow
def test_wheel_evidence_is_whole(long_wheel):
    found = wheel_evidence.evidence(long_wheel)
    whole(found)
    # an estimate lies within three half-widths of theory, which is 95 % wide, or what is tolerated
    for name in (name for name in FEATURES if name not in spectrum_numbers.IDENTITIES):
        number = feature(found, name)
        assert abs(number.difference) <= number.tolerance + 2 * number.uncertainty, number.sentence


@pytest.mark.slow
def test_a_fifth_more_acceleration_is_another_level(long_wheel):
    def louder(o):
        return {name: 1.44 * o[name] for name in ("plain", "hann", "levels", "square")} | {
            name: 1.2 * o[name] for name in ("jump", "mean")
        }

    both = long_wheel, changed(long_wheel, louder)
    before, after = (wheel_evidence.evidence(result) for result in both)
    levels = [spectrum_numbers.levels_over_linear(spectrum_of(result)) for result in both]
    # bands end below the break, which moves with the floor: not at all where it is the cutoff
    assert 3 <= len(levels[1]) <= len(levels[0])
    for one, other in zip(*levels, strict=False):
        assert other.value - one.value == pytest.approx(DECIBEL * math.log(1.44), abs=1e-9)
    assert number_with(after.numbers, "level").verdict is Verdict.DIFFER
    assert after.claims[0].status is ClaimStatus.CONTRADICTED and after.claims[0].answer.startswith("No: ")
    assert any(s.startswith("Contradicted by this run: Its level") for s in after.conclusions)
    for name in (PEAK, JUMP, SLOPE, PERIOD):
        assert feature(after, name).value == pytest.approx(feature(before, name).value, rel=1e-9)
    assert all(number.met for number in after.numbers)


@pytest.mark.slow
def test_a_shifted_axis_is_another_peak_jump_and_period(long_wheel):
    before = wheel_evidence.evidence(long_wheel)
    after = wheel_evidence.evidence(changed(long_wheel, lambda o: {"omega": 1.04 * o["omega"]}))
    for name in (PEAK, JUMP, PERIOD):
        one, other = feature(before, name), feature(after, name)
        # ranges stay, so that a line or two at their ends are others
        assert other.value / one.value == pytest.approx(1.04, rel=0.005), name
        assert other.verdict is Verdict.DIFFER, other.sentence


@pytest.mark.slow
def test_a_floor_without_its_leak_is_not_predicted(long_wheel):
    leakless = changed(long_wheel, lambda o: {"plain": o["hann"]})
    floor = wheel_features.measured(spectrum_of(leakless))[FLOOR + PREDICTED]
    assert floor.value + floor.half_width < 0.9
    # Hann's window keeps no mean square
    assert not all(number.met for number in wheel_evidence.evidence(leakless).numbers)


@pytest.mark.slow
def test_a_lost_force_is_a_missed_criterion(long_wheel):
    after = wheel_evidence.evidence(changed(long_wheel, lambda o: {"balance": o["balance"] + 1e-9}))
    (missed,) = (number for number in after.numbers if not number.met)
    assert "velocity change" in missed.quantity


def test_what_does_not_stand_out_is_said_so():
    """Waves of less than three periods of the oscillation: no slope, no period, no break."""
    scene = replace(SMALL, rail=replace(SMALL.rail, shortest=2e-3))
    case = replace(LONG, scene=scene, realisations=10, batch=10)
    found = wheel_evidence.evidence(wheel.run(case))
    whole(found)
    shown = found.page_tables[1]
    missing = [row for row, text in enumerate(shown.columns["found"]) if text == "none stands out"]
    assert [shown.columns["feature"][row] for row in missing] == [
        FEATURES[name].name for name in (SLOPE, PERIOD, BREAK + PREDICTED)
    ]
    assert "None stands out in this run: the period of its oscillation is that of sin²(q a)." in found.conclusions
    assert not any("Its slope" in sentence for sentence in found.conclusions)


@pytest.mark.slow
def test_one_parameter_at_a_time():
    case = replace(LONG, scene=SMALL, realisations=10, batch=10, varied=6, groups=2, parameters=True)
    names = list(case.variations())
    assert len(names) == len(set(names)) == 13
    found = wheel_evidence.evidence(wheel.run(case))
    whole(found)
    table = found.page_tables[-1]
    assert list(table.columns["scene"]) == names
    jumps = dict(zip(names, table.columns[FEATURES[JUMP].name], strict=True))
    base = SMALL.jump
    for name, factor in (
        ("v₀ × 0.25", 0.25),
        ("v₀ × 2", 2.0),
        ("q_min × 0.5", 0.5),
        ("q_min × 2", 2.0),
        ("H = 1", 1.0),
    ):
        assert f"({factor * base:.5g})" in str(jumps[name])
    assert any(sentence.startswith("One parameter at a time") for sentence in found.conclusions)


def test_a_smooth_scene_has_no_spectrum():
    case = replace(LONG, scene=replace(SMALL, name="Glass", rail=None), realisations=5)
    with pytest.raises(ValueError, match="scene must have a rough rail or a rough wheel, got both smooth"):
        wheel_evidence.evidence(wheel.run(case))
    smooth = replace(QUICK_3D, scene=replace(COARSE, rail=None))
    with pytest.raises(ValueError, match="scene must have a rough rail and a smooth wheel"):
        wheel_3d.run(smooth)


def test_a_rough_wheel_on_a_smooth_rail_is_a_scene_too():
    case = replace(LONG, scene=replace(SMALL, rail=None, wheel=SMALL.rail), realisations=10, batch=10, parameters=True)
    assert [name for name in case.variations() if "q_" in name] == []
    whole(wheel_evidence.evidence(wheel.run(replace(case, parameters=False))))


DISTANCE = wheel_distance.WheelDistance(
    scene=SMALL, doublings=3, wheels=24, fewest=12, causes=8, rough=8, groups=4, released=2
)


@pytest.fixture(scope="module")
def distances():
    return wheel_distance.run(DISTANCE)


def hann(evidence):
    """Region 4 with Hann's window over that without."""
    model = f"{distance_numbers.HANN}, over {wheel_distance.OPEN}"
    return number_with(evidence.numbers, distance_numbers.LEVEL, model)


@pytest.mark.slow
def test_distance_evidence_is_whole(distances):
    found = wheel_distance_evidence.evidence(distances)
    whole(found)
    number = hann(found)
    assert number.verdict is Verdict.DIFFER and number.value < -6
    law = number_with(found.numbers, distance_numbers.BREAK_LAW)
    assert law.reference == pytest.approx(1 / 2.4, rel=ROUNDING)
    np.testing.assert_array_equal(found.table("law")["exponent"], law.reference)
    # the line has the slope of the law and goes through the middle of the breaks
    line, breaks = found.table("law"), found.table("breaks")
    slope = np.diff(np.log(line["break [rad/s]"])) / np.diff(np.log(line["duration [s]"]))
    assert slope == pytest.approx(np.full(slope.size, 1 / 2.4), rel=1e-9)
    middle = (np.mean(np.log(table["break [rad/s]"])) for table in (line, breaks))
    assert next(middle) == pytest.approx(next(middle), rel=1e-12)
    # to second order in the amplitude
    hertz = found.table("hertz")
    assert hertz["peak over omega_eigen"][0] == pytest.approx(1 - hertz["release / d"][0] ** 2 / 24, abs=1e-6)


def test_distances_take_whole_natural_periods_and_double():
    length = [ride.steps * ride.scene.spacing for ride in DISTANCE.distances()]
    for i, one in enumerate(length):
        # to the next length that an FFT is fast at: a part in a hundred
        assert natural_periods(SMALL.body, one, SMALL.speed) == pytest.approx(2**i, rel=0.02)
        assert natural_periods(SMALL.body, one, SMALL.speed) >= 2**i * (1 - ROUNDING)


@pytest.mark.slow
def test_a_rectangular_window_in_place_of_hann_drops_nothing(distances):
    ends = {name: {**o, "hann": o["plain"]} for name, o in distances.ends.items()}
    found = wheel_distance_evidence.evidence(replace(distances, ends=ends))
    assert hann(found).value == pytest.approx(0, abs=1e-9)


@pytest.mark.slow
def test_floors_without_their_leak_are_not_predicted(distances):
    """Half of the floor, as if its jumps were lower by the root of two, at every distance."""
    halved = {i: {**o, "jump": math.sqrt(2) * o["jump"]} for i, o in distances.distances.items()}
    before, after = (
        wheel_distance_evidence.evidence(replace(distances, distances=d)) for d in (distances.distances, halved)
    )
    floors = [evidence.table("breaks")["floor over predicted"] for evidence in (before, after)]
    assert floors[0] == pytest.approx(np.ones(4), abs=0.1)
    assert floors[1] == pytest.approx(floors[0] / 2, rel=1e-9)


@pytest.mark.slow
def test_a_linear_contact_with_a_floor_misses_its_identity(distances):
    leaking = {**distances.ends[wheel_distance.LINEAR_STEADY]}
    leaking["plain"] = leaking["plain"] + 1e-12 * leaking["plain"].max()
    ends = {**distances.ends, wheel_distance.LINEAR_STEADY: leaking}
    found = wheel_distance_evidence.evidence(replace(distances, ends=ends))
    assert len([number for number in found.numbers if not number.met]) == 2


@pytest.mark.slow
def test_wheels_that_do_not_repeat_themselves_are_no_evidence(monkeypatch):
    monkeypatch.setattr(wheel_ensemble, "STEADY_TOLERANCE", -1.0)
    with pytest.raises(NotConvergedError, match="most wheels of an ensemble do not repeat their motion") as caught:
        wheel_distance.run(replace(DISTANCE, doublings=0, scene=replace(SMALL, distance=0.05)))
    assert caught.value.unconverged[0].startswith("24 of 24 wheels do not repeat their motion, h₀ = 5e-07 m")
    with pytest.raises(NotConvergedError, match="wheels on springs do not repeat their motion") as caught:
        wheel_3d.run(QUICK_3D)
    assert caught.value.unconverged == ("geike", "rolling")


@pytest.fixture(scope="module")
def in_3d():
    return wheel_3d.run(QUICK_3D)


@pytest.mark.slow
def test_evidence_in_three_dimensions_is_whole(in_3d):
    found = wheel_3d_evidence.evidence(in_3d)
    whole(found)
    geike, theory = (
        number_with(found.numbers, half_space_numbers.LEVEL, half_space_numbers.OVER_BEM[model], range="region 2")
        for model in (wheel_3d_levels.GEIKE, wheel_3d_levels.LINEAR_3D)
    )
    assert geike.verdict is Verdict.DIFFER and geike.value < -10
    assert abs(theory.difference) <= theory.tolerance + theory.uncertainty
    assert found.claims[0].status is ClaimStatus.CONTRADICTED
    table = found.table("levels")
    assert np.isfinite(table["bem3d [dB]"]).all()


@pytest.mark.slow
def test_a_fifth_more_acceleration_in_three_dimensions(in_3d):
    strips = {name: [{**o, "bem": 1.2 * o["bem"]} for o in some] for name, some in in_3d.strips.items()}
    both = in_3d.strips, strips
    bands = [half_space_numbers.levels_over_bem(wheel_3d_levels.WheelLevels(replace(in_3d, strips=s))) for s in both]
    assert len(bands[0]) >= 12
    for one, other in zip(*bands, strict=True):
        assert one.value - other.value == pytest.approx(DECIBEL * math.log(1.44), abs=1e-9)
        assert other.uncertainty == pytest.approx(one.uncertainty, rel=1e-6)


@pytest.mark.slow
def test_grids_that_differ_leave_the_level_open(in_3d):
    """A coarse grid 1 dB louder, with a quarter more cells on the fine one: three times as much is left open."""
    louder = [{**o, "bem": 10 ** (1 / 20) * o["bem"]} for o in in_3d.strips["coarser"]]
    found = wheel_3d_levels.WheelLevels(replace(in_3d, strips={**in_3d.strips, "coarser": louder}))
    before = wheel_3d_levels.WheelLevels(in_3d)
    change = DECIBEL * np.maximum(found.grid, before.grid)
    assert (change >= 1.5 - 1e-9).all()


# --- the contrast of the oscillation ----------------------------------------------------------------------------------


def with_filled_zeros(scene, share, lines=60):
    """A of region 3 as sin²(q a), a share of it replaced by its mean; lines to a period."""
    omega = (
        scene.oscillation_period
        / lines
        * np.arange(1, math.ceil(1.2 * scene.cutoff / scene.oscillation_period * lines))
    )
    wave = np.sin(np.pi * omega / scene.oscillation_period) ** 2
    return omega, ((1 - share) * wave + share / 2) * omega ** (-2 * scene.rail.hurst - 3)


@pytest.mark.parametrize("share", [0.01, 0.1, 0.5, 1.0])
def test_the_contrast_is_that_of_filled_zeros(share):
    """(1 + e c) / (1 - e c), e = 1 - share; c = sin(pi / 12) / (pi / 12): the band is a twelfth of a period."""
    omega, density = with_filled_zeros(TABLE, share)
    e = (1 - share) * math.sin(math.pi / 12) / (math.pi / 12)
    found = contrast.contrasts(omega, density, TABLE)
    # five lines to a band in place of its integral
    assert found == pytest.approx(np.full(19, (1 + e) / (1 - e)), rel=0.1)


def test_zeros_have_both_of_their_maxima_in_region_3():
    period = TABLE.oscillation_period
    zeros = contrast.zeros_of(TABLE)
    assert TABLE.jump < (zeros[0] - 0.5) * period and TABLE.cutoff > (zeros[-1] + 0.5) * period
    narrow = replace(TABLE, rail=replace(TABLE.rail, longest=2e-3, shortest=1.5e-3))
    assert contrast.zeros_of(narrow).size == 0


def test_an_oscillation_that_dies_is_noticed():
    """Zeros that fill from the first to the last: the worst is the last, and differs; the first alone agrees."""
    omega, wave = with_filled_zeros(TABLE, 0.0)
    _, mean = with_filled_zeros(TABLE, 1.0)
    zeros = contrast.zeros_of(TABLE)
    share = np.interp(omega / TABLE.oscillation_period, zeros[[0, -1]], [0.0, 1.0])
    rng = np.random.default_rng(0)
    groups = ((1 - share) * wave + share * mean) * rng.gamma(400, 1 / 400, (6, 1))
    reference = contrast.contrasts(omega, wave, TABLE)
    numbers = contrast.contrast_numbers("springs", contrast.log_contrasts(omega, groups, TABLE), reference, TABLE)
    assert numbers[0].verdict is Verdict.AGREE
    worst = contrast.worst_contrast(numbers)
    assert worst.verdict is Verdict.DIFFER and worst.where["worst at"] == zeros[-1]


# --- interrupted ensembles --------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_an_interrupted_ensemble_goes_on_where_it_was(tmp_path):
    """Four files; one is lost: it alone is written anew, and all is as before to the bit."""
    case = replace(LONG, scene=SMALL, realisations=12, groups=3, batch=4)
    engine = Engine(store=tmp_path)
    first = wheel.run(case, engine)
    files = sorted(tmp_path.glob("*.npz"))
    assert len(files) == 4
    lost = next(file for file in files if "simulate_ensemble" in file.name)
    kept = {file: file.stat().st_ino for file in files if file != lost}
    lost.unlink()
    again = wheel.run(case, engine)
    assert sorted(tmp_path.glob("*.npz")) == files
    assert {file: file.stat().st_ino for file in kept} == kept
    outcomes = [
        [o for some in r.batches.values() for o in some] + [r.snapshot] for r in (first, again, wheel.run(case))
    ]
    for one, *others in zip(*outcomes, strict=True):
        for other in others:
            assert one.keys() == other.keys()
            for name, values in one.items():
                np.testing.assert_array_equal(other[name], values, err_msg=name)
    assert wheel_evidence.evidence(first) == wheel_evidence.evidence(again)
