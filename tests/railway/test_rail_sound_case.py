"""What is said of the sounds of a rail, on signals that are made up."""

from dataclasses import replace

import numpy as np
import pytest

from tests.seeded import catches
from validation.analysis import spectra
from validation.railway.cases.rail_sound import RailSound, RailSoundResult, shipped_rail
from validation.railway.cases.rail_sound_study import IN_BANDS, STUDY
from validation.railway.problems.rail_sound import GEIKE
from validation.simulation.model_names import BEM, LINEAR, SPRINGS_THAT_READ

CASE = RailSound(rail=shipped_rail(), seconds=0.1, repeats=1)
TIME = np.arange(CASE.samples) / CASE.rate


def tone(frequency, amplitude=1000.0):
    return amplitude * np.sin(2 * np.pi * frequency * TIME)


def result(**of_model):
    """All frequencies by boundary elements; others as told."""
    bem = tone(100) + tone(1000) + tone(4000)
    signals = {BEM: bem, LINEAR: bem, SPRINGS_THAT_READ: bem, GEIKE: bem} | of_model
    return RailSoundResult(CASE, {(model, cells): signals[model] for model in CASE.sounding for cells in CASE.cells})


REAL_WEIGHTING = spectra.a_weighting


@catches("a weighting of amplitudes taken twice", frequency=100, weight=-19.1).at(
    "validation.railway.cases.rail_sound.a_weighting", lambda f: 2 * REAL_WEIGHTING(f)
)
@pytest.mark.parametrize(("frequency", "weight"), [(100, -19.1), (1000, 0.0), (10000, -2.5)])
def test_a_level_has_the_weight_of_the_standard(frequency, weight):
    """IEC 61672-1, table 3, to its digit; 1000 N of amplitude are 57 dB re 1 N."""
    levels = result(**{BEM: tone(frequency)})
    assert levels.level(BEM) == pytest.approx(60 - 10 * np.log10(2), abs=1e-6)
    assert levels.weighted(BEM) - levels.level(BEM) == pytest.approx(weight, abs=0.06)


@pytest.mark.parametrize(("model", "gain"), [(GEIKE, 2.0), (LINEAR, 0.9)])
def test_a_level_stands_over_that_of_boundary_elements(model, gain):
    """On pieces of equal power nothing scatters, and both grids have the same."""
    found, grid = result(**{model: gain * result().signal(BEM)}).over(model)
    assert found.value == pytest.approx(20 * np.log10(gain), abs=1e-6)
    assert found.half_width < 1e-6 and grid < 1e-6


def test_bands_are_levels_of_their_tones():
    table = STUDY.evidence(result()).table(IN_BANDS).where(model="boundary elements")
    f, level = table["f [Hz]"], table["value"]
    assert level[np.abs(f - 1000).argmin()] == pytest.approx(60 - 10 * np.log10(2), abs=0.01)
    assert np.isnan(level[np.abs(f - 2000).argmin()])


@pytest.mark.parametrize("alpha", [1.0, 3.0])
def test_oblique_waves_have_two_cells_on_both_grids(alpha):
    case = replace(CASE, rail=replace(CASE.rail, lateral_structure=alpha), seconds=0.02)
    coarse, fine = (case.strip(cells) for cells in case.cells)
    assert coarse.ground.highest < np.pi / coarse.spacing
    assert fine.spacing / coarse.spacing == pytest.approx(case.cells[0] / case.cells[1], rel=0.1)


def test_sounds_have_one_full_scale_that_holds_them_all():
    found = STUDY.evidence(result(**{GEIKE: 3 * result().signal(BEM)}))
    largest = max(np.abs(found.table("samples")[name]).max() for name in found.table("samples").columns)
    assert found.sounds.full_scale >= largest
    assert [sound.name for sound in found.sounds.tracks] == ["bem", "linear", "springs", "geike"]


def test_a_weight_of_the_force_is_in_the_file_alone():
    """A force has another weight than sound power: no text compares A-weighted forces."""
    found = result(**{GEIKE: 2 * result().signal(BEM)})
    texts = [sound.says for sound in STUDY.evidence(found).sounds.tracks] + list(found.sounds_table().columns)
    assert not any("dB(A)" in text or "A-weighted" in text or "over" in text for text in texts)
    assert found.former_levels(GEIKE)["A-weighted over boundary elements [dB]"] == pytest.approx(6.02)
