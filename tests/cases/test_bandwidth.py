"""Bands of one punch: common long waves, a plateau, deviations that add up over bands, and springs without coupling."""

from dataclasses import replace

import numpy as np
import pytest

import mdr
from tests.cases.planted import statuses
from tests.oracles import spring_sum
from tests.seeded import catches
from validation.analysis import statistics
from validation.analysis.case import Outcomes
from validation.analysis.evidence import ClaimStatus, numbers_with
from validation.analysis.statistics import nearest
from validation.cases.punch import bandwidth, fractal_punch_study
from validation.cases.punch.bandwidth import AREA, DOUBLED, FINER, LOADS, ROLL_OFF, Band, Bandwidth, Deviations
from validation.cases.punch.bandwidth_study import CASE, DRIFT, ROLLED, STUDY
from validation.simulation import spring_tracks
from validation.simulation.model_names import BEM
from validation.simulation.model_names import SPRINGS as MDR
from validation.simulation.rough_punch import PunchRoughness
from validation.simulation.spring_tracks import RoughAreas, press_areas

MANY = 4000
WIDE = Bandwidth(
    hursts=(0.7,), bands=(Band(8, 32, MANY, MANY, (MANY, MANY), MANY), Band(80, 320, 400, 400)), profiles=MANY
)


def modes(height):
    return np.fft.fft2(height, norm="forward")


def test_a_wider_band_has_the_long_waves_of_the_one_before():
    """The same phases; amplitudes are smaller by one factor, since each surface has the same rms height."""
    narrow, wide = (modes(WIDE.roughness(0.7, band).surface(4 * band, 7)) for band in (4, 8))
    waves = np.rint(np.fft.fftfreq(16) * 16).astype(int)
    inside = (np.hypot(waves[:, np.newaxis], waves) < 4.01) & (np.hypot(waves[:, np.newaxis], waves) > 0)
    # half of a cell moves a wave: heights stand in the middle of cells
    half = np.exp(1j * np.pi * (waves[:, np.newaxis] + waves) * (1 / 16 - 1 / 32))
    ratio = (wide[np.ix_(waves, waves)] * half / np.where(inside, narrow, 1.0))[inside]
    np.testing.assert_allclose(ratio, ratio[0].real, rtol=1e-9)
    assert 0.9 < ratio[0].real < 1


@catches("no plateau below the roll-off").at(
    "validation.simulation.rough_punch.PlateauSpectrum._density", mdr.SelfAffine._density
)
def test_the_plateau_is_flat_and_the_band_beyond_is_self_affine():
    """Four waves on a side at the roll-off: equal power in each below, (q_r / q)^(2 H + 2) above, none beyond."""
    case = replace(WIDE, bands=(Band(16, 64, 3, 3), Band(32, 128, 3, 3)), roll_off=(4, 0))
    power = np.abs(modes(case.rolled.surface(64, 0))) ** 2
    waves = np.rint(np.fft.fftfreq(64) * 64)
    q = np.hypot(waves[:, np.newaxis], waves)
    level = power[0, 1]
    np.testing.assert_allclose(power[(q > 0.99) & (q < 4.01)], level, rtol=1e-9)
    beyond = (q > 4.01) & (q < 15.99)
    np.testing.assert_allclose(power[beyond], level * (4 / q[beyond]) ** 3.4, rtol=1e-9)
    assert power[q > 16.01].max() < 1e-20 * level
    assert power.sum() == pytest.approx(case.height**2, rel=1e-12, abs=0)


def test_surfaces_are_those_of_fig_14_1():
    """So a report that has both cases solves them once; the band has 64 waves on 256 cells."""
    case, figure = CASE.full, fractal_punch_study.CASE.full
    (band,) = (band for band in case.bands if band.waves == 64)
    mine = case.pressed(case.roughness(0.7, 64), band.cells, case.light(1)[1], band.heavy)
    both = [one == figure.surface(0.7, one.realisation, band.cells) for one in mine]
    assert band.waves == figure.roughness(0.7).waves[1] and sum(both) >= band.heavy


FRACTION = spring_tracks._fraction


@catches("overlap of springs over an area without their own height", overlap=0.1).at(
    "validation.simulation.spring_tracks._fraction", lambda height, load: FRACTION(height, 2 * load)
)
@pytest.mark.parametrize("overlap", [1e-3, 0.1])
def test_springs_over_an_area_carry_the_load(overlap):
    """Spring by spring at the height where as many touch: their force is the load, to one spring."""
    rough = PunchRoughness(hurst=0.7, waves=(1, 8), seed=3)
    areas = RoughAreas(roughness=rough, first=2, realisations=2, cells=32, loads=(overlap,))
    for i, (stiffness,) in enumerate(press_areas(areas)["stiffness"]):
        height = np.sort(rough.surface(32, 2 + i).ravel())[::-1]
        touching = stiffness * height.size
        around = [spring_sum(height, 1.0, 1.0, -height[n])[0] for n in (int(touching) - 1, int(touching))]
        assert around[0] <= overlap * rough.height <= around[1]
        np.testing.assert_allclose(np.interp(touching, [int(touching), int(touching) + 1], around), overlap * 1e-3)


def planted(*, wide=0.1, springs=(0.12, 0.12), finer=0.1, rolled=1.0, pairs=400):
    """Stiffnesses around one. Boundary elements: deviation 0.1 in the narrow band, `wide` in the wide one on the same
    draws, of which few are pressed; springs: of their own, in both; finer: on half as long cells; rolled: a factor of
    the springs' deviation with a roll-off."""
    rng, columns = np.random.default_rng(3), len(WIDE.forces)
    one, own = rng.standard_normal((2, MANY, 1))

    def of(draws, deviation, count=MANY):
        return np.repeat(1 + deviation * draws[:count], columns, axis=1)

    narrow, broad = springs
    found = {(BEM, 0.7, 0): of(one, 0.1), (FINER, 0.7, 0): of(one, finer), (BEM, 0.7, 1): of(one, wide, pairs)}
    found |= {(MDR, 0.7, 0): of(own, narrow), (MDR, 0.7, 1): of(own, broad)}
    found |= {(DOUBLED, 0.7, i): of(own, springs[i]) for i in range(2)}
    found |= {(BEM, ROLL_OFF, 1): of(one, wide), (MDR, ROLL_OFF, 1): of(own, broad * rolled)}
    loads = np.array(LOADS) / max(LOADS)
    scatter = np.where(loads == 1, 0.05, 0.1)
    found[AREA, 0.7, 1] = loads * (1 + scatter * rng.standard_normal((MANY, 1)))
    return Outcomes(WIDE, found)


@catches("a wide band without the change from the narrow one").at(
    "validation.cases.punch.bandwidth.multilevel_moments",
    lambda columns: statistics.multilevel_moments(columns[:1]) * len(columns),
)
def test_deviations_add_up_over_bands():
    """A tenth of the surfaces tells the change of the deviation, whose level all of them tell: half of the error."""
    found = Deviations(planted(wide=0.11))
    all_of_them, few = found.resolved(BEM, 0.7, 2)[1].value, found.column(BEM, 0.7, 1, 2)
    assert all_of_them.value == pytest.approx(np.log(0.11), abs=0.03)
    assert all_of_them.value - found.resolved(BEM, 0.7, 2)[0].value.value == pytest.approx(np.log(1.1), abs=0.01)
    assert all_of_them.half_width < 0.5 * 1.96 / np.sqrt(2 * np.isfinite(few).sum())


STEPS = bandwidth.Deviations.steps


@catches("a change to finer cells that is taken once").at(
    "validation.cases.punch.bandwidth.Deviations.steps",
    lambda found, *key: {i: 0.5 * one for i, one in STEPS(found, *key).items()},
)
def test_a_change_to_finer_cells_is_doubled_and_left_open_also_in_wider_bands():
    found = Deviations(planted(finer=0.105)).resolved(BEM, 0.7, 0)
    for value in found.values():
        assert value.value.value == pytest.approx(np.log(0.1 * 1.05**2), abs=0.015)
        assert value.grid == pytest.approx(np.log(1.05), rel=0.05)


@catches("a change by factor e of bandwidth for that by decade").at("numpy.log10", np.log)
def test_a_change_by_decade_is_that_of_the_ratio():
    """A decade of bandwidth: springs 20 % more, boundary elements 5 %; with a roll-off springs 30 % more."""
    evidence = STUDY.evidence(planted(wide=0.105, springs=(0.1, 0.12), rolled=1.3))
    for quantity, change, count in ((DRIFT, 1.2 / 1.05, 1), (ROLLED, 1.3, 2)):
        values = [n.value for n in numbers_with(evidence.numbers, quantity)]
        assert values == pytest.approx([20 * np.log10(change)] * count, abs=0.05)


@catches("as many springs over an area as boundary elements have cells in contact").at(
    "validation.cases.punch.bandwidth.nearest", lambda fractions, wide: nearest(fractions, 0.01 * wide)
)
def test_springs_without_coupling_stand_beside():
    """Deviation 0.12 along a line, 0.05 over an area at equal load; under a light force the band is too narrow."""
    (alone,) = Deviations(planted()).without_coupling(0.7, 6).values()
    assert Deviations(planted()).without_coupling(0.7, 0) == {}
    assert alone.value == pytest.approx(np.log(0.12 / 0.05), abs=0.03)


@pytest.mark.parametrize(
    ("planting", "status"),
    [
        ({}, ClaimStatus.SUPPORTED),
        ({"springs": (0.12, 0.15)}, ClaimStatus.REFUTED),
        ({"wide": 0.12}, ClaimStatus.REFUTED),
        ({"rolled": 2.0}, ClaimStatus.SUPPORTED),
        ({"finer": 0.12}, ClaimStatus.SUPPORTED),
        ({"wide": 0.11}, ClaimStatus.INCONCLUSIVE),
    ],
)
def test_the_claim_follows_a_planted_answer(planting, status):
    assert statuses(STUDY.evidence(planted(**planting))) == [status]


@pytest.mark.parametrize("surfaces", [((9, 5),), ((9, 5), (10, 5)), ((4, 5), (4, 4))])
def test_bands_that_are_not_nested_are_refused(surfaces):
    """One alone; more surfaces in the wider one; more under all forces than there are."""
    with pytest.raises(ValueError, match="bands"):
        Bandwidth(bands=tuple(Band(8 * 2**i, 32 * 2**i, *counts) for i, counts in enumerate(surfaces)))
