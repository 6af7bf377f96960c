"""What is said of the sounds of a rail, on signals that are made up."""

from dataclasses import replace

import numpy as np
import pytest

from tests.cases.planted import statuses
from validation.analysis.evidence import ClaimStatus, number_with
from validation.cases.rail.rail_sound import LONG, LOW, SHORT, WEIGHTED, RailSound, RailSoundResult, shipped_rail
from validation.cases.rail.rail_sound_study import BELOW, IN_BANDS, LEVEL, STUDY
from validation.simulation.model_names import BEM, LINEAR, SPRINGS_THAT_READ
from validation.simulation.rail_sound import GEIKE

CASE = RailSound(rail=shipped_rail(), seconds=0.1, repeats=1)
TIME = np.arange(CASE.samples) / CASE.rate


def tone(frequency, amplitude=1000.0):
    return amplitude * np.sin(2 * np.pi * frequency * TIME)


def result(**of_model):
    """All frequencies by boundary elements; others as told."""
    bem = tone(100) + tone(1000) + tone(4000)
    signals = {BEM: bem, LINEAR: bem, SPRINGS_THAT_READ: bem, GEIKE: bem} | of_model
    return RailSoundResult(CASE, {(model, cells): signals[model] for model in CASE.sounding for cells in CASE.cells})


@pytest.mark.parametrize(("frequency", "weight"), [(100, -19.1), (1000, 0.0), (10000, -2.5)])
def test_a_level_has_the_weight_of_the_standard(frequency, weight):
    """IEC 61672-1, table 3, to its digit; 1000 N of amplitude are 57 dB re 1 N."""
    levels = result(**{BEM: tone(frequency)})
    assert levels.level(BEM) == pytest.approx(60 - 10 * np.log10(2), abs=1e-6)
    assert levels.level(BEM, WEIGHTED) - levels.level(BEM) == pytest.approx(weight, abs=0.06)


def test_each_range_is_compared_alone():
    louder = tone(100) + tone(1000, 2000.0) + tone(4000, 500.0)
    found = STUDY.evidence(result(**{GEIKE: louder})).numbers
    expected = {LOW: 0.0, LONG: 20 * np.log10(2), SHORT: -20 * np.log10(2)}
    for part, value in expected.items():
        number = number_with(found, LEVEL, GEIKE, part=part)
        assert number.value == pytest.approx(value, abs=1e-6)
        assert number.uncertainty < 1e-6


def test_bands_are_levels_of_their_tones():
    table = STUDY.evidence(result()).table(IN_BANDS).where(model="boundary elements")
    f, level = table["f [Hz]"], table["value"]
    assert level[np.abs(f - 1000).argmin()] == pytest.approx(60 - 10 * np.log10(2), abs=0.01)
    assert np.isnan(level[np.abs(f - 2000).argmin()])


def test_claims_change_with_the_levels():
    """10 % louder in one half of the strip, 15 % in the other: 0.8 dB and 1.2 dB, which the sample leaves open."""
    halves = np.repeat([1.1, 1.15], TIME.size // 2)
    for gain, status in ((1.0, ClaimStatus.HOLDS), (2.0, ClaimStatus.CONTRADICTED), (halves, ClaimStatus.OPEN)):
        found = STUDY.evidence(result(**{GEIKE: gain * result().signal(BEM)}))
        assert statuses(found) == [status, ClaimStatus.HOLDS, ClaimStatus.HOLDS]


def test_a_silent_range_is_said_to_be_silent():
    silent = STUDY.evidence(result(**{GEIKE: tone(1000) + tone(4000)}))
    assert number_with(silent.numbers, LEVEL, GEIKE, part=LOW).value == -30
    np.testing.assert_allclose(silent.table(BELOW)["value"], [100 / 3, 100 / 3, 100 / 3, 0.0], atol=1e-9)


@pytest.mark.parametrize("alpha", [1.0, 3.0])
def test_oblique_waves_have_two_cells_on_both_grids(alpha):
    case = replace(CASE, rail=replace(CASE.rail, across=alpha), seconds=0.02)
    coarse, fine = (case.strip(cells) for cells in case.cells)
    assert coarse.ground.highest < np.pi / coarse.spacing
    assert fine.spacing / coarse.spacing == pytest.approx(case.cells[0] / case.cells[1], rel=0.1)


def test_sounds_have_one_full_scale_that_holds_them_all():
    found = STUDY.evidence(result(**{GEIKE: 3 * result().signal(BEM)}))
    largest = max(np.abs(found.table("samples")[name]).max() for name in found.table("samples").columns)
    assert found.sounds.full_scale >= largest
    assert [sound.name for sound in found.sounds.tracks] == ["bem", "linear", "springs", "geike"]
