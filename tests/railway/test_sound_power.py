"""Sound power of a rail: sums over the tables of the directive by hand, and the errors that a filter leaves of it."""

import csv
import io
import json
import math
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import validation
from tests.advice.planted_answers import planted
from tests.seeded import catches
from validation.advice.compare import Comparison
from validation.advice.summary import bands_of, summary
from validation.advice.tolerance import decibels
from validation.railway import rail_columns
from validation.railway.cases.filters import RailWheel, columns_of_table, scene_of
from validation.railway.problems import rail_power
from validation.railway.problems.rail_power import RailPower
from validation.railway.scenes.rail_file import rail_of
from validation.railway.theory import sound_power
from validation.railway.theory.sound_power import SoundTransfer, in_frequency
from validation.scenes.bundled import contents_of

RAIL = replace(validation.load_scene("rail"), track="M/S", transfer=840)
FOLDER = Path(validation.__file__).parent
TABLE = {
    50: (53.3, 75.4, 44.0),
    1000: (107.1, 93.0, 105.4),
    2500: (110.0, 111.9, 108.1),
    10000: (110.6, 116.2, 110.2),
}
"""Some rows of the directive: M/S, wheel of 840 mm, W."""
A_WEIGHTING = [-30.2, -26.2, -22.5, -19.1, -16.1, -13.4, -10.9, -8.6, -6.6, -4.8, -3.2, -1.9, -0.8, 0.0, 0.6, 1.0]
A_WEIGHTING += [1.2, 1.3, 1.2, 1.0, 0.5, -0.1, -1.1, -2.5]
"""IEC 61672-1, dB, to a tenth, 50 Hz to 10 kHz."""
NOMINAL = [50, 63, 80, 100, 125, 160, 200, 250, 315, 400, 500, 630, 800, 1000, 1250, 1600, 2000, 2500, 3150, 4000]
NOMINAL += [5000, 6300, 8000, 10000]


AT_80, AT_250 = (80, "M/S", 840, 1), (250, "W", 1200, 4)
"""km/h, track, wheel and axles."""


def by_hand(scene, a3):
    """L_W in each band, sums written out; the tables from the file, by their columns."""
    with (FOLDER / "railway" / "tables" / "cnossos_g3_2021.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    waves, levels = [1000 * w for w in scene.levels.wavelengths], scene.levels.levels
    powers = []
    for row in rows:
        wave = 1000 * scene.speed / float(row["frequency [Hz]"])
        i = next(i for i in range(len(waves) - 1) if waves[i] >= wave >= waves[i + 1])
        share = math.log(waves[i] / wave) / math.log(waves[i] / waves[i + 1])
        squares = [10 ** ((levels[j] + a3[j]) / 10) for j in (i, i + 1)]
        effective = (1 - share) * squares[0] + share * squares[1]
        of_track, of_wheel = (10 ** (float(row[name]) / 10) for name in (scene.track, f"wheel {scene.transfer}"))
        powers.append(effective * (of_track + of_wheel) * (scene.axles or 1))
    return 10 * np.log10(powers)


def summed(levels):
    return 10 * math.log10(sum(10 ** ((level + a) / 10) for level, a in zip(levels, A_WEIGHTING, strict=True)))


def of_transfer(transfer):
    """As `SoundTransfer.of_both` with decibels added."""
    return 10 * np.log10(transfer.of_track + transfer.of_wheel)


@catches("tables whose columns are shifted by one", 50, TABLE[50]).at(
    "validation.railway.theory.sound_power.SoundTransfer.of_track",
    property(lambda transfer: SoundTransfer("M/M", transfer.wheel).of_wheel),
)
@pytest.mark.parametrize(("frequency", "row"), TABLE.items())
def test_transfer_functions_are_those_of_the_directive(frequency, row):
    band = NOMINAL.index(frequency)
    assert sound_power.frequencies().tolist() == NOMINAL
    assert SoundTransfer("M/S", 840).of_track[band] == pytest.approx(row[0])
    assert SoundTransfer("M/S", 840).of_wheel[band] == pytest.approx(row[1])
    assert SoundTransfer("W", 840).of_track[band] == pytest.approx(row[2])


@catches("an A-weighting of the wrong sign", *AT_80).at(
    "validation.railway.theory.sound_power.a_weighting", lambda f: -rail_columns.a_weighting(f)
)
@catches("energies of track and wheel added as decibels", *AT_80).at(
    "validation.railway.theory.sound_power.SoundTransfer.of_both", property(of_transfer)
)
@catches("axles counted on the wheels alone", *AT_250).at(
    "validation.railway.theory.sound_power.SoundTransfer.of_track",
    property(lambda transfer: sound_power._columns()[transfer.track]),
)
@catches("levels interpolated in place of energies", *AT_80).at(
    "validation.railway.problems.rail_power.in_frequency",
    lambda levels, waves, speed: np.interp(
        np.log(speed / sound_power.frequencies()), np.log(waves[::-1]), np.asarray(levels)[::-1]
    ),
)
@pytest.mark.parametrize(("speed", "track", "wheel", "axles"), [AT_80, AT_250])
def test_sound_power_is_a_sum_by_hand_over_the_tables(speed, track, wheel, axles):
    """Of a filter that falls by a third of a decibel a band, so that neighbours are no line; to rounding."""
    scene = replace(RAIL, speed=speed / 3.6, track=track, transfer=wheel, axles=axles)
    a3 = -(np.arange(35) ** 2) / 40
    power = RailPower(scene, a3)
    np.testing.assert_allclose(power.level, by_hand(scene, a3), atol=1e-9)
    # the table of the standard is rounded to 0.05 dB
    assert power.total == pytest.approx(summed(by_hand(scene, a3)), abs=0.03)


def test_a_filter_of_zero_decibels_gives_the_level_of_the_directive_without_a_filter():
    """Roughness, interpolated, plus transfer; at 1 m/s a mm is 1 kHz, so that each band has a wavelength of its own."""
    scene = replace(RAIL, speed=10.0**-0.7)
    levels = in_frequency(np.arange(35.0), scene.levels.bands.wavelengths, 10.0)
    assert levels[~np.isnan(levels)].size == 24
    bare = RailPower(replace(RAIL, speed=20.0), np.zeros(35))
    at_1_khz = NOMINAL.index(1000)
    # 20 m/s over 1 kHz is 20 mm, a band of the roughness
    of_both = 10 * math.log10(10 ** (107.1 / 10) + 10 ** (93.0 / 10))
    assert bare.level[at_1_khz] == pytest.approx(RAIL.levels.levels[20] + of_both, abs=1e-9)


@pytest.mark.parametrize("wheel", [(50, 920), (50, 360), (25, 920), (50, 680), (100, 920)])
def test_the_filter_of_cnossos_gives_its_own_level(wheel):
    """Its A3 by the average network at 80 km/h, summed by hand with the column of the nearest wheel."""
    column = columns_of_table()[RailWheel(*wheel)]
    scene = replace(scene_of(RailWheel(*wheel), levels="cnossos-average"), speed=80 / 3.6, track="B/H")
    a3 = np.array([column[round(1000 * wave, 2)] for wave in scene.levels.wavelengths])
    nearest = {920: 920, 360: 680, 680: 680}[wheel[1]]
    expected = by_hand(replace(scene, transfer=nearest), a3)
    np.testing.assert_allclose(RailPower(scene, a3).level, expected, atol=1e-9)
    assert scene.sound_transfer == SoundTransfer("B/H", nearest)


def test_bands_beyond_the_roughness_have_no_sound_power():
    """At 20 km/h 0.8 mm are 6.9 kHz: two bands lack; their count is said."""
    scene = replace(RAIL, speed=20 / 3.6)
    level = RailPower(scene, np.zeros(35)).level
    assert np.flatnonzero(np.isnan(level)).tolist() == [22, 23]
    found = validation.compare(scene, quantity="sound-power", tolerance="1 dB", models=["linear, ellipse"])
    assert found.value.size == 24 and "but for 8000, 10000 Hz without roughness" in found.power.sentences[1]
    one = in_frequency([1.0], [0.02], 20.0)
    assert one[NOMINAL.index(1000)] == pytest.approx(1.0) and np.isnan(one).sum() == 23


# --- errors ---


def test_errors_are_carried_band_by_band_and_add_in_the_sum():
    """All bands louder by their errors; a single loud band counts by its share."""
    power, shifted = RailPower(RAIL, -np.arange(35) / 3), np.full(35, 0.7)
    np.testing.assert_allclose(power.half_widths(shifted), 0.7)
    assert power.error_of_total(shifted) == pytest.approx(0.7)
    assert power.shares.sum() == pytest.approx(1.0)
    loud = int(np.argmax(power.shares))
    alone = np.where(np.arange(35) == loud, 0.1, 0.0)
    assert power.error_of_total(alone) == pytest.approx(0.1 * power.shares[loud], rel=0.03)


@catches("bands of unknown error left out of the error of a sum").at(
    "validation.railway.problems.rail_power.RailPower.error_of_total",
    lambda power, error: RailPower(power.scene, power.a3).half_widths(np.nan_to_num(error, posinf=0.0)).mean(),
)
def test_short_waves_of_unknown_error_pass_between_nothing_and_the_last_known_one():
    error, a3 = np.zeros(35), np.full(35, -5.0)
    error[20:] = np.inf
    power = RailPower(RAIL, a3)
    without = np.where(np.arange(35) < 20, a3, -np.inf)
    lost = power.total - RailPower(RAIL, without).total
    assert power.error_of_total(error) == pytest.approx(lost) and lost > 1
    assert math.isinf(power.error_of_total(np.roll(error, 15)))
    assert math.isinf(power.error_of_total(np.full(35, np.inf)))


def test_the_tolerance_is_that_of_the_sum():
    found = validation.compare(RAIL, quantity="sound-power", tolerance="0.6 dB")
    assert found.met and found.model == "linear, ellipse" and found.unit == "dB re 1 pW"
    (solved,) = found.selection.solved
    power = RailPower(RAIL, validation.compare(RAIL, quantity="contact-filter", tolerance="1 dB").value)
    np.testing.assert_allclose(found.value, power.level, atol=1e-9)
    assert found.error == pytest.approx(found.power.error)
    assert found.power.total(found.model) == pytest.approx(power.total)
    # as large as in the bands that carry the sum, not as in the worst one
    errors = found.errors_of(solved)
    assert errors[np.isfinite(errors)].max() > found.error > 0.2
    assert not validation.compare(RAIL, quantity="sound-power", tolerance="0.1 dB", models=["linear, ellipse"]).met


def test_what_lies_across_is_in_the_error_of_the_sum():
    """Half of the difference between ridges and isotropic ground, and linear theory's own."""
    ends = [
        validation.compare(
            replace(RAIL, lateral_structure=across),
            quantity="sound-power",
            tolerance="1 dB",
            models=["linear, ellipse"],
        )
        for across in ("ridges", "isotropic")
    ]
    apart = abs(np.subtract(*(end.power.total(end.model) for end in ends)))
    open_ = validation.compare(
        replace(RAIL, lateral_structure=None), quantity="sound-power", tolerance="3 dB", models=["linear, ellipse"]
    )
    assert apart / 2 < open_.error < apart / 2 + 1.0
    assert "lateral_structure is not given" in open_.models[0].reason


def filter_as_asked(comparison, candidate):
    return comparison.value_of(candidate)


@catches("the contact filter added twice").at("validation.advice.compare.Comparison.a3_of", filter_as_asked)
def test_each_quantity_of_a_rail_has_the_same_sound_power_by_each_filter():
    sums, models = [], ["linear, ellipse", "Remington"]
    for quantity in ("contact-filter", "equivalent-roughness", "sound-power"):
        found = validation.compare(RAIL, quantity=quantity, tolerance="1 dB", models=models)
        written = json.loads(validation.to_json(found))
        sums.append([row["sound_power_dBA"] for row in written["models"] if row["sound_power_dBA"] is not None])
        assert len(written["a3_dB"]) == len(written["value"]) == found.value.size
        np.testing.assert_allclose(np.add(written["roughness_dB"], written["a3_dB"]), written["equivalent_dB"])
        rows = list(csv.DictReader(io.StringIO(validation.to_csv(found))))
        chosen = [row for row in rows if row["selected"] == "True"]
        assert {float(row["sound_power_over_selected_dB"]) for row in chosen} == {0.0}
        assert ("force_sum_dBA" in rows[0]) == (quantity != "sound-power")
        text = summary(found)
        assert "dB(A) re 1 pW" in text and "L_FA" not in text and "re 1 N" not in text
    for other in sums[1:]:
        assert other == pytest.approx(sums[0])
    assert len(sums[0]) == len(set(sums[0])) == 4


def test_a_filter_that_is_louder_everywhere_is_louder_by_as_much():
    found = planted("rail", "sound-power")
    assert isinstance(found, Comparison) and len(bands_of(found, found.model)["L_r"]) == 24
    first, *others = found.power.levels
    assert first == found.model
    step = 20 * math.log10(1.1)
    assert found.power.over_chosen(others[0]) == pytest.approx(-step)
    assert f"{-step:.1f}" in found.power.change


def test_former_levels_of_the_force_stay_in_files():
    """k times the equivalent displacement, k = 3 F / (2 d) with 50 kN and 65.6 um, A-weighted: 0 dB at 1 kHz."""
    scene = replace(RAIL, speed=1e3 * 10**-1.7)
    found = validation.compare(scene, quantity="contact-filter", tolerance="1 dB")
    written = json.loads(validation.to_json(found))
    newton = 1.5 * 50e3 / 65.6e-6 * 1e-6 * 10 ** (written["equivalent_dB"][20] / 20)
    assert written["force_dBA"][20] == pytest.approx(20 * math.log10(newton), abs=0.02)
    sums = {row["model"]: row["force_sum_dBA"] for row in written["models"]}
    total = 10 * math.log10(sum(10 ** (level / 10) for level in written["force_dBA"]))
    assert sums[found.model] == pytest.approx(total) and sums["boundary elements"] is None


# --- keys of a scene ---


def scene_with(**keys):
    """The bundled scene with other keys of its wheel and rail."""
    tables = tomllib.loads(contents_of("scene", FOLDER / "railway" / "scenes" / "rail.toml", most=10**5).decode())
    for name, value in keys.items():
        table, _, key = name.partition("_")
        tables[table][key] = value
    return rail_of(tables, FOLDER)


def test_keys_of_track_wheel_and_axles_are_read():
    scene = scene_with(rail_track="B/S", wheel_transfer=1200, wheel_axles=4)
    assert scene.sound_transfer == SoundTransfer("B/S", 1200, 4)
    assert scene_with(wheel_transfer="680 mm").sound_transfer == SoundTransfer("M/M", 680, 1)
    (shown,) = (text for name, text in scene.describe() if name == "sound power")
    assert shown == "track B/S (bi-block sleepers, soft pads), wheel of 1200 mm, 4 axles"
    (assumed,) = (text for name, text in scene_with().describe() if name == "sound power")
    assert assumed.endswith("wheel of 920 mm, per axle; wheel.transfer left out")


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"rail_track": "M/X"}, ("rail.track", '"M/S"', "M/X", "left out")),
        ({"rail_track": 3}, ("rail.track", "text")),
        ({"wheel_transfer": 900}, ("wheel.transfer", "680, 840, 920, 1200", "900", "left out")),
        ({"wheel_transfer": "0.9 m"}, ("wheel.transfer", "840", "900")),
        ({"wheel_axles": 0}, ("wheel.axles", "0")),
        ({"wheel_axles": 2.5}, ("wheel.axles", "2.5")),
        ({"wheel_axles": 10**6}, ("wheel.axles", "1000000", "1000")),
    ],
)
def test_other_values_are_rejected_with_the_key_and_what_is_accepted(keys, words):
    with pytest.raises(ValueError) as rejected:
        scene_with(**keys)
    assert all(word in str(rejected.value) for word in words), rejected.value


def test_without_a_speed_there_is_no_sound_power_and_the_key_is_named():
    still = replace(RAIL, speed=None)
    found = validation.compare(still, quantity="sound-power", tolerance="1 dB")
    assert not found.met and found.power is None and found.force is None
    assert "wheel.speed is missing" in summary(found)
    assert validation.compare(still, quantity="contact-filter", tolerance="1 dB").power is None
    crawling = validation.compare(replace(RAIL, speed=0.01), quantity="sound-power", tolerance="1 dB")
    assert "50 Hz to 10 kHz" in summary(crawling)
    failed = planted("rail", "contact-filter", statuses=("failed", "out of range"), error=math.inf)
    assert failed.power is None and decibels(0.0) == 0.0
    assert validation.compare(validation.load_scene("sphere"), tolerance="1 dB").power is None


def test_parts_of_an_error_of_strips_are_carried_apart():
    """Model, grid and sample of a contact filter each by the bands, then together as of an answer."""
    found = planted("rail", "contact-filter", error=0.05)
    power = rail_columns.sound_power(found.scene, found)
    best = found.selection.best
    parts = found.error_parts_of(best)
    of_sum = [rail_power.RailPower(found.scene, found.a3_of(best)).error_of_total(part) for part in parts.values()]
    model, grid, sample = (10 ** (part / 20) - 1 for part in of_sum)
    assert power.error == pytest.approx(decibels(model + math.hypot(grid, sample)))
