"""Scene files: what follows from them, and everything that is refused by its key and value."""

import math
import re
from dataclasses import replace
from functools import partial

import pytest
from scipy.fft import next_fast_len

import mdr
from tests.scenes.test_measured_heights import refusal
from tests.seeded import Times, catches
from validation.scenes.bundled import SCENES, bundled
from validation.scenes.load import load_scene_with_track
from validation.scenes.material import Material
from validation.scenes.rolling import RollingScene
from validation.scenes.roughness import Roughness

IN_FILE = r"scene \S+scene\.toml: "
TABLE = (SCENES / "table_14_1.toml").read_text(encoding="utf-8")
STEEL = Material(youngs_modulus=210e9, poisson_ratio=1 / 3, counterface="rigid")
ROUGH = Roughness(rms=0.5e-6, hurst=0.7, longest=0.01, shortest=0.2e-3)


def scene(**changes):
    return replace(load_scene_with_track("table_14_1"), **changes)


def written(tmp_path, *changes, text=TABLE):
    """A scene file with some lines changed, each of which must be there."""
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / "scene.toml"
    path.write_text(text, encoding="utf-8")
    return path


# Table 14.1


def test_table_14_1_is_what_the_book_prints_and_we_chose():
    wheel = {"radius": 0.5, "mass": 500.0, "load": 4905.0, "speed": 20.0, "material": STEEL}
    assert scene() == RollingScene(name="Table 14.1", **wheel, ground=ROUGH, wheel=None, distance=0.65, springs=100)


def test_derived_numbers_agree_with_springs():
    wheel = scene()
    found = mdr.press_sphere(radius=wheel.radius, modulus=wheel.modulus, approach=wheel.approach)
    assert found.force == pytest.approx(wheel.load, rel=1e-14)
    assert found.contact_radius == pytest.approx(wheel.contact_radius, rel=1e-14)
    assert found.stiffness == pytest.approx(wheel.stiffness, rel=1e-14)
    assert wheel.mass * wheel.eigenfrequency**2 == pytest.approx(wheel.stiffness, rel=1e-14)


@pytest.mark.parametrize(("distance", "springs"), [(0.65, 100), (0.65, 101), (0.2, 37), (0.0203054, 100)])
def test_the_track_is_no_shorter_than_the_distance_and_fast(distance, springs):
    wheel = scene(distance=distance, springs=springs)
    assert wheel.spacing * springs == pytest.approx(wheel.contact_radius, rel=1e-15)
    fewest = math.ceil(distance / wheel.spacing)
    assert wheel.points == next_fast_len(fewest)
    assert (fewest - 1) * wheel.spacing < distance <= wheel.length == wheel.points * wheel.spacing
    assert wheel.circumference_points * wheel.spacing == pytest.approx(math.pi, abs=wheel.spacing / 2)
    assert wheel.time_step * wheel.speed == pytest.approx(wheel.spacing, rel=1e-15)


def test_jump_and_cutoff_are_of_all_waves_there_are():
    longer = replace(ROUGH, longest=0.02, shortest=0.3e-3)
    for rail, wheel, shortest in ((ROUGH, longer, 0.2e-3), (longer, ROUGH, 0.2e-3), (None, longer, 0.3e-3)):
        found = scene(ground=rail, wheel=wheel)
        assert found.jump == pytest.approx(2 * math.pi / 0.02 * 20, rel=1e-15)
        assert found.cutoff == pytest.approx(2 * math.pi / shortest * 20, rel=1e-15)


def test_heights_add_by_their_squares():
    smooth = scene(ground=None)
    assert (scene().rms, smooth.rms, smooth.diagnose()) == (0.5e-6, 0, ())
    for waves in ("jump", "cutoff"):
        with pytest.raises(ValueError, match="must have a rough rail or wheel"):
            getattr(smooth, waves)
    assert scene(wheel=replace(ROUGH, rms=1.2e-6)).rms == pytest.approx(1.3e-6, rel=1e-15)


# Shipped files


def test_the_rough_wheel_is_table_14_1_with_its_roughness_shared():
    shared = load_scene_with_track("rough_wheel")
    assert shared.rail == shared.wheel
    assert shared.rail.rms == pytest.approx(0.5e-6 / math.sqrt(2), rel=1e-15)
    assert shared.rms == pytest.approx(scene().rms, rel=1e-15)
    assert shared.diagnose() == scene().diagnose() == ()
    assert replace(shared, name="Table 14.1", wheel=None, ground=replace(shared.rail, rms=0.5e-6)) == scene()


def test_a_name_and_a_path_read_the_same(tmp_path, monkeypatch):
    path = written(tmp_path)
    monkeypatch.chdir(tmp_path)
    for same in (path, str(path), "scene.toml"):
        assert load_scene_with_track(same) == scene()
    path.rename(tmp_path / "bare")
    assert load_scene_with_track("./bare") == scene()


def test_other_units_and_an_editors_mark_make_the_same_scene(tmp_path):
    changes = [("20 m/s", "72 km/h"), ("4905 N", "4.905 kN"), ("500 kg", "0.5 t"), ("210 GPa", "210e3 MPa")]
    path = written(tmp_path, *changes, ('"10 mm"', '"0.01 m"'), ("0.5 um", "500 nm"), text="\ufeff" + TABLE)
    assert load_scene_with_track(path) == load_scene_with_track("table_14_1")


@pytest.mark.parametrize("rail", ["", "[rail]\n"])
def test_without_roughness_the_rail_is_smooth(tmp_path, rail):
    start, _, rest = TABLE.partition("[rail.roughness]")
    path = written(tmp_path, text=f"{start}{rail}[simulation]{rest.partition('[simulation]')[2]}")
    assert load_scene_with_track(path) == scene(ground=None)


# Refusals


MADE = "must be made of"


@pytest.mark.parametrize(
    ("key", "old", "new", "said"),
    [
        ("wheel.radius", 'radius = "0.5 m"', "", "is missing"),
        ("rail.roughness.hurst", "hurst = 0.7", "", "is missing"),
        ("name", 'name = "Table 14.1"', "", "is missing"),
        ("stuff", "[material]", "[stuff]", f"is unknown, a scene {MADE} name, wheel"),
        ("rail.roughness.Hurst", "hurst =", "Hurst =", f"is unknown, rail.roughness {MADE} rms"),
        ("rail.x", "[rail.roughness]", "[rail]\nroughness = 1\n[rail.x]", f"is unknown, rail {MADE} roughness"),
        ("name", '"Table 14.1"', '" "', "must be a text that is not blank, got ' '"),
        ("wheel.radius", '"0.5 m"', "0.5", 'must be a length, as "0.5 m", in one of m, cm, mm, '),
        (
            "wheel.speed",
            '"20 m/s"',
            '"20 m"',
            'must be a speed, as "20 m/s", in one of m/s, cm/s, mm/s, um/s, µm/s, km/h, got "20 m"',
        ),
        ("wheel.load", '"4905 N"', '"-1 N"', 'must be positive, got "-1 N"'),
        ("simulation.distance", '"0.65 m"', '"inf m"', 'must be finite, got "inf m"'),
        ("rail.roughness.hurst", "0.7", "true", "must be a real number, got True"),
        ("rail.roughness.hurst", "0.7", "1" + 400 * "0", "must be finite, got a number of 401 digits"),
        ("simulation.springs", "springs = 100", "springs = 1.5", "must be a whole number, got 1.5"),
        ("material.poisson_ratio", "0.3333333333333333", "2026-01-01", "must be a real number, got datetime"),
    ],
)
def test_files_are_refused_by_key_and_value(tmp_path, key, old, new, said):
    with pytest.raises(ValueError, match=f"^{IN_FILE}{key} {re.escape(said)}"):
        load_scene_with_track(written(tmp_path, (old, new)))


def test_broken_files_are_refused_by_name(tmp_path):
    path = written(tmp_path, ("[wheel]", "[wheel"))
    with pytest.raises(ValueError, match=rf"^scene {re.escape(str(path))} must be valid TOML, got: .*line"):
        load_scene_with_track(path)
    path.write_bytes(b'name = "\xff"')
    with pytest.raises(ValueError, match="must be valid TOML, got: no text in UTF-8"):
        load_scene_with_track(path)


def test_files_that_cannot_be_read_are_refused_by_name(tmp_path):
    missing = tmp_path / "missing.toml"
    with pytest.raises(FileNotFoundError, match=rf"^scene {re.escape(str(missing))} cannot be read: No such file"):
        load_scene_with_track(missing)


@pytest.mark.parametrize("name", ["table", "", "Table 14.1"])
def test_unknown_names_are_answered_with_the_shipped_ones(name):
    sentence = f'scene must be a file, as "./{name}.toml", or one of {", ".join(bundled())}, got "{name}"'
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}$"):
        load_scene_with_track(name)


NARROW, LONG = {"longest": 0.0099, "shortest": 0.0098}, {"longest": 5.0, "shortest": 4.0}


@pytest.mark.parametrize(
    ("key", "changes", "numbers"),
    [
        ("name", {"name": ""}, ["''"]),
        ("wheel.radius", {"radius": "0.5 m"}, ["'0.5 m'"]),
        ("wheel.radius", {"radius": 0.0}, ["0.0"]),
        ("wheel.load", {"load": math.nan}, ["nan"]),
        ("wheel.speed", {"speed": math.inf}, ["inf"]),
        ("material", {"material": 210e9}, ["210000000000.0"]),
        ("simulation.distance", {"distance": 0}, ["0.0"]),
        ("simulation.springs", {"springs": 99.0}, ["99.0"]),
        ("simulation.springs", {"springs": -3}, ["-3"]),
        ("rail.roughness", {"ground": 1e-6}, ["1e-06"]),
        ("wheel.roughness.rms", {"wheel": {"rms": -1.0}}, ["-1.0"]),
        ("wheel.roughness.hurst", {"wheel": {"hurst": 1.3}}, ["1.3"]),
        ("rail.roughness.shortest", {"ground": {"shortest": math.inf}}, ["inf"]),
        # the limit that a value breaks stands before it
        ("rail.roughness.shortest", {"ground": {"shortest": 0.01}}, ["0.01 m", "0.01 m"]),
        ("simulation.distance", {"distance": 0.003, "ground": None}, ["0.00396396 m", "0.003 m"]),
        ("simulation.distance", {"distance": 0.01}, ["rail.roughness.longest, 0.01 m", "0.01 m"]),
        ("simulation.distance", {"distance": 0.02, "wheel": {"longest": 0.03}}, ["wheel.", "longest, 0.03 m", "0.02"]),
        ("rail.roughness.shortest", {"springs": 10}, ["two springs, 0.000396396 m", "0.0002 m"]),
        ("rail.roughness.shortest", {"distance": 0.011, "ground": NARROW}, ["a period of 0.0110", "0.0098 m"]),
        ("wheel.roughness.shortest", {"distance": 10.0, "wheel": LONG}, ["a period of 3.141", "4 m"]),
        ("wheel.load", {"load": 1e15}, ["0.5 m", "11.665 m"]),
        ("simulation.springs", {"springs": 10**400}, ["6309", "1000"]),
    ],
)
def test_scenes_are_refused_by_key_and_value(key, changes, numbers):
    rough = {name: replace(ROUGH, **value) for name, value in changes.items() if isinstance(value, dict)}
    with pytest.raises((ValueError, TypeError), match=f"^{key} must .*{'.*'.join(map(re.escape, numbers))}"):
        scene(**{**changes, **rough})


# Limits of a track, which is 2 a long at the least, and has a place at both ends of half a wave


A = math.sqrt(0.5) * (3 * 4905 / (4 * 210e9 / (1 - 1 / 9) * math.sqrt(0.5))) ** (1 / 3)
"""a^2 = R d and F = 4/3 E* sqrt(R) d^(3/2) [m]."""
LARGEST = 4 / 3 * 210e9 / (1 - 1 / 9) * 0.5**2
SHORTEST = {"distance": 2.001 * A}, {"distance": 2 * scene().contact_radius}, "distance must be longer than the contact"


def waves(longest, shortest):
    """Roughness with waves of so many contact radii."""
    return replace(ROUGH, longest=longest * A, shortest=shortest * A)


@pytest.mark.parametrize(
    ("taken", "beyond", "said"),
    [
        SHORTEST,
        # a contact, R d = a^2, as large as the wheel at F = 4/3 E* R^2
        ({"load": 0.999 * LARGEST, "distance": 2.0}, {"load": 1.001 * LARGEST, "distance": 2.0}, "wheel.load must"),
        # 10^7 springs around the wheel, or along a track that is longer
        ({"springs": int(1e7 * A / math.pi)}, {"springs": int(1e7 * A / math.pi) + 1}, "springs must be at most"),
        (*({"springs": int(2e6 * A) + more, "distance": 5.0} for more in (0, 1)), "springs must be at most"),
        (
            {"springs": 10, "ground": waves(9, 0.2)},
            {"springs": 10, "ground": waves(9, 0.1999)},
            "must hold two springs",
        ),
        # 1029 springs, of which the distance needs 1025: two waves on all of them
        (
            {"distance": 10.25 * A, "ground": waves(5.146, 5.144)},
            {"distance": 10.25 * A, "ground": waves(5.126, 5.124)},
            "must leave a wave that fits",
        ),
    ],
)
@catches("a contact as wide as the wheel overlaps", *SHORTEST).at(
    "validation.scenes.rolling.RollingScene.contact_radius", Times(math.sqrt(2))
)
def test_a_track_is_taken_up_to_its_limits(taken, beyond, said):
    said_of_both = [refusal(partial(scene, **{"ground": None, **changes})) for changes in (taken, beyond)]
    assert said_of_both[0] == ""
    assert said in said_of_both[1]


# Doubts


HEAVY = {"load": 1e9, "springs": 10000, "distance": 2.0}
HIGH, LOWER = replace(ROUGH, rms=1.1e-4), replace(ROUGH, rms=0.9e-4)
LONG_WAVE = {"wheel": replace(ROUGH, longest=1.6), "distance": 20.0}
SHORTER_WAVE = {"wheel": replace(ROUGH, longest=1.5), "distance": 20.0}
DOUBTS = [
    ({"springs": 39}, {"springs": 40}, ["rail.roughness.shortest", "3.94 springs", "4"]),
    (LONG_WAVE, SHORTER_WAVE, ["wheel.roughness.longest", "1.6 m", "circumference of 3.14 m"]),
    ({"speed": 0.13}, {"speed": 0.14}, ["time step", "0.209", "0.2"]),
    ({"distance": 0.09}, {"distance": 0.11}, ["simulation.distance", "9 waves of rail.roughness.longest", "10"]),
    ({**HEAVY, "ground": HIGH}, {**HEAVY, "ground": LOWER}, ["rail.roughness.rms", "0.00011 m", "0.0001 m", "unit"]),
    ({"load": 1e9, "springs": 5000}, {"load": 5e7, "springs": 5000}, ["contact radius", "0.233", "a tenth", "units"]),
]


@pytest.mark.parametrize(("doubtful", "beyond_doubt", "words"), DOUBTS)
def test_doubts_come_with_their_numbers_and_go_with_their_cause(doubtful, beyond_doubt, words):
    pattern = re.compile(".*".join(map(re.escape, words)))
    assert any(pattern.search(doubt) for doubt in scene(**doubtful).diagnose())
    cause = re.compile(f"{re.escape(words[0])}.*{re.escape(words[-1])}")
    assert not any(cause.search(doubt) for doubt in scene(**beyond_doubt).diagnose())
