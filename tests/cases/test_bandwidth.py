"""The bands of one punch: common long waves, a plateau, changes from band to band, and claims on planted answers."""

from types import SimpleNamespace

import numpy as np
import pytest

from tests.cases.planted import statuses
from validation.analysis.evidence import ClaimStatus
from validation.analysis.statistics import student
from validation.analysis.study import Outcomes
from validation.cases.punch import bandwidth
from validation.cases.punch.bandwidth import (
    BANDWIDTH,
    MEAN,
    ROLL_OFF,
    STATISTICS,
    STUDY,
    Bandwidth,
    series,
)
from validation.cases.punch.ensembles import change

CASE = Bandwidth(cells=16, surfaces=12, pairs=(4, 3), refined=3, rolled_off=4, profiles=20, points=256)


def modes(height):
    return np.fft.fft2(height, norm="forward")


def test_a_wider_band_has_the_long_waves_of_the_one_before():
    """The same phases; amplitudes are smaller by one factor, since each surface has the same rms height."""
    narrow, wide = (modes(CASE.ground[BANDWIDTH, float(band)].surface(4 * band, 7)) for band in (4, 8))
    waves = np.rint(np.fft.fftfreq(16) * 16).astype(int)
    inside = (np.hypot(waves[:, np.newaxis], waves) < 4.01) & (np.hypot(waves[:, np.newaxis], waves) > 0)
    # half of a cell moves a wave: heights stand in the middle of cells
    half = np.exp(1j * np.pi * (waves[:, np.newaxis] + waves) * (1 / 16 - 1 / 32))
    ratio = (wide[np.ix_(waves, waves)] * half / np.where(inside, narrow, 1.0))[inside]
    np.testing.assert_allclose(ratio, ratio[0].real, rtol=1e-9)
    assert 0.9 < ratio[0].real < 1


def test_the_plateau_is_flat_and_the_band_beyond_is_self_affine():
    """Four waves on a side at the roll-off: equal power in each below, (q_r / q)^(2 H + 2) above, none beyond."""
    power = np.abs(modes(CASE.ground[ROLL_OFF, 4.0].surface(64, 0))) ** 2
    waves = np.rint(np.fft.fftfreq(64) * 64)
    q = np.hypot(waves[:, np.newaxis], waves)
    level = power[0, 1]
    np.testing.assert_allclose(power[(q > 0.99) & (q < 4.01)], level, rtol=1e-9)
    beyond = (q > 4.01) & (q < 15.99)
    np.testing.assert_allclose(power[beyond], level * (4 / q[beyond]) ** 3.4, rtol=1e-9)
    assert power[q > 16.01].max() < 1e-20 * level
    assert power.sum() == pytest.approx(CASE.height**2, rel=1e-12, abs=0)


def test_every_pair_has_realisations_of_its_own_and_finer_cells_the_first_ones():
    """Else the changes would not be independent of the narrowest band."""

    def drawn(solve, groups):
        raise InterruptedError(groups)

    with pytest.raises(InterruptedError) as caught:
        bandwidth.run(CASE, SimpleNamespace(map_groups=drawn))
    (groups,) = caught.value.args
    numbers = {key: [surface.realisation for surface in group] for key, group in groups.items()}
    assert numbers["before 0"] == numbers["wider 0"] and numbers["before 1"] == numbers["wider 1"]
    independent = [number for key in ("narrow", "wider 0", "wider 1") for number in numbers[key]]
    assert len(set(independent)) == len(independent)
    assert numbers["refined"] == numbers["narrow"][:3]
    assert [groups[key][0].cells for key in ("narrow", "refined", "wider 0", "wider 1")] == [16, 32, 32, 64]


def lognormal(rng, count, *, mean, deviation, common=None):
    """Of these statistics at each of the levels of force; common: normal draws that share nine tenths with these."""
    own = rng.standard_normal((count, mean.size))
    drawn = own if common is None else 0.9 * common + np.sqrt(0.19) * own
    s = np.sqrt(np.log1p(deviation**2))
    return mean * np.exp(s * drawn - s**2 / 2), drawn


@pytest.mark.slow
@pytest.mark.parametrize("quantity", STATISTICS)
def test_intervals_of_a_change_hold_it_as_often_as_they_say(quantity):
    """Pairs of twelve with a correlation of 0.9: 95 % of 400 intervals, within four standard errors of that share."""
    rng = np.random.default_rng(2)
    one, held = np.ones(1), []
    truth = {"mean stiffness": np.log(1.1), "relative deviation": np.log(0.8)}[quantity]
    for _ in range(400):
        before, common = lognormal(rng, 12, mean=one, deviation=0.25 * one)
        after, _ = lognormal(rng, 12, mean=1.1 * one, deviation=0.2 * one, common=common)
        (found,) = change(STATISTICS[quantity], before, after)
        assert found.half_width == pytest.approx(student(11) * found.error)
        held.append(abs(found.value - truth) <= found.half_width)
    assert np.mean(held) == pytest.approx(0.95, abs=4 * np.sqrt(0.95 * 0.05 / 400))


def planted(*, wide=1.0, rolled_off=1.0, size=0.5, mdr=1.0, surfaces=16000):
    """Boundary elements with the stiffness of the fit and MDR `mdr` times as stiff; in the widest band MDR `wide` times
    more, with a roll-off `rolled_off` times more, and there with `size` times the deviation."""
    case = Bandwidth(surfaces=surfaces, pairs=(40, 40), refined=surfaces, rolled_off=surfaces, profiles=surfaces)
    rng, mean = np.random.default_rng(3), np.array(bandwidth.fitted(case))

    def outcome(factor=1.0, deviation=0.1, count=surfaces):
        return {"stiffness": lognormal(rng, count, mean=factor * mean, deviation=np.full(mean.size, deviation))[0]}

    narrow, pair, springs = outcome(), outcome(count=40), outcome(mdr)
    rolled = outcome(deviation=0.1 * size)
    wider = {"stiffness": wide * springs["stiffness"]}
    return result_of(case, narrow, pair, pair, rolled, [springs, springs, wider, outcome(mdr * rolled_off, 0.1 * size)])


def result_of(case, narrow, before, wider, rolled_off, springs):
    found = {"narrow": narrow, "refined": narrow, "rolled off": rolled_off}
    found |= {f"before {i}": before for i in range(2)} | {f"wider {i}": wider for i in range(2)}
    return Outcomes(case, found | dict(zip(case.ground, springs, strict=True)))


HOLDS, LIMITED, CONTRADICTED = ClaimStatus.HOLDS, ClaimStatus.LIMITED, ClaimStatus.CONTRADICTED


@pytest.mark.slow
@pytest.mark.parametrize(
    ("planting", "expected"),
    [
        ({"size": 1.0}, [HOLDS, HOLDS, HOLDS, HOLDS, HOLDS]),
        ({}, [HOLDS, HOLDS, CONTRADICTED, HOLDS, HOLDS]),
        ({"wide": 1.2}, [CONTRADICTED, HOLDS, CONTRADICTED, HOLDS, CONTRADICTED]),
        ({"rolled_off": 0.85}, [HOLDS, CONTRADICTED, CONTRADICTED, HOLDS, LIMITED]),
        ({"mdr": 1.2}, [HOLDS, HOLDS, CONTRADICTED, HOLDS, CONTRADICTED]),
    ],
)
def test_claims_follow_a_planted_answer(planting, expected):
    assert statuses(STUDY.evidence(planted(**planting))) == expected


def of_bem(result, quantity):
    return [one.found for one in series(result) if (one.quantity, one.model) == (quantity, "bem3d")]


def test_a_planted_change_of_boundary_elements_adds_up():
    """Pairs that are 10 % stiffer in each wider band: the widest is 1.1^2 times as stiff as the narrowest."""
    one = np.random.default_rng(0).uniform(1, 2, (8, 7))
    stiff = {"stiffness": one}
    bem = of_bem(result_of(CASE, stiff, stiff, {"stiffness": 1.1 * one}, stiff, [stiff] * 4), MEAN)
    for narrow, wide in zip(bem[0], bem[2], strict=True):
        assert wide.value - narrow.value == pytest.approx(2 * np.log(1.1), rel=1e-9)


@pytest.mark.parametrize("wrong", [{"pairs": (4,)}, {"pairs": (4, 2)}, {"refined": 2}, {"surfaces": 1}])
def test_too_few_surfaces_are_refused(wrong):
    with pytest.raises(ValueError, match="three at least"):
        Bandwidth(**wrong)
