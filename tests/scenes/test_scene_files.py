"""Scene files: quantities with units, what follows from them, and everything that is refused by name."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.fft import next_fast_len

import mdr
from validation.scenes.dynamic_wheel import WheelScene, bundled_wheels, load_wheel_scene
from validation.scenes.material import Material
from validation.scenes.reader import SCENES, bundled
from validation.scenes.roughness import Roughness
from validation.scenes.units import UNITS, quantity

IN_FILE = r"scene \S+scene\.toml: "
TABLE = (SCENES / "table_14_1.toml").read_text(encoding="utf-8")
WHEELS = ("rough_wheel", "table_14_1")
STEEL = Material(youngs_modulus=210e9, poisson_ratio=1 / 3, counterface="rigid")
ROUGH = Roughness(rms=0.5e-6, hurst=0.7, longest=0.01, shortest=0.2e-3)

# what a unit is in SI, written down here once more
TIMES = {"m": 1, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "nm": 1e-9, "km": 1e3}
TIMES |= {"kg": 1, "g": 1e-3, "t": 1e3, "N": 1, "kN": 1e3, "MN": 1e6, "mN": 1e-3}
TIMES |= {"Pa": 1, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "m/s": 1, "mm/s": 1e-3, "km/h": 1 / 3.6}
EVERY_UNIT = [(dimension, unit) for dimension, units in UNITS.items() for unit in units]


def scene(**changes):
    return replace(load_wheel_scene("table_14_1"), **changes)


def written(tmp_path, *changes, text=TABLE):
    """A scene file with some lines changed, each of which must be there."""
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / "scene.toml"
    path.write_text(text, encoding="utf-8")
    return path


# Quantities


@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("0.5 um", "length", 5e-07),
        ("0.5 µm", "length", 5e-07),
        ("0.5 \N{GREEK SMALL LETTER MU}m", "length", 5e-07),
        ("  +0.5   um ", "length", 5e-07),
        ("500 nm", "length", 5e-07),
        ("5e-4 mm", "length", 5e-07),
        ("0.2 mm", "length", 0.0002),
        ("0.3 mm", "length", 0.0003),
        ("0.65 km", "length", 650.0),
        ("0.1 g", "mass", 0.0001),
        ("0.5 t", "mass", 500.0),
        ("4.9 kN", "force", 4900.0),
        ("3 mN", "force", 0.003),
        ("3 MN", "force", 3e6),
        ("210 GPa", "pressure", 210e9),
        ("0.1 MPa", "pressure", 1e5),
        ("1.1 kPa", "pressure", 1100.0),
        ("72 km/h", "speed", 20.0),
        ("1 km/h", "speed", 1 / 3.6),
        ("7 mm/s", "speed", 0.007),
        ("-2 m/s", "speed", -2.0),
        ("0 m", "length", 0.0),
    ],
)
def test_a_quantity_is_the_nearest_float(text, dimension, value):
    assert quantity("it", text, dimension) == value


def test_every_unit_is_known_here():
    assert {unit for _, unit in EVERY_UNIT} == set(TIMES)


@pytest.mark.parametrize(("dimension", "unit"), EVERY_UNIT)
@given(value=st.floats(1e-200, 1e200))
@example(value=0.1)
@example(value=1e22)
def test_a_quantity_is_the_same_number_in_any_unit(dimension, unit, value):
    # dividing here, the unit here, and the reading each round once: 2^-53 times three, to first order
    assert quantity("it", f"{value / TIMES[unit]!r} {unit}", dimension) == pytest.approx(value, rel=4 * 2**-53, abs=0)


@given(digits=st.integers(-(10**17), 10**17))
def test_metric_prefixes_do_not_round(digits):
    assert quantity("it", f"{digits} um", "length") == float(f"{digits}e-6")
    assert quantity("it", f"{digits} GPa", "pressure") == float(f"{digits}e9")


@pytest.mark.parametrize(
    ("given_text", "shown"),
    [
        (0.5, "0.5"),
        (1, "1"),
        (True, "True"),
        (None, "None"),
        (["0.5 m"], "['0.5 m']"),
        ("0.5", '"0.5"'),
        ("0.5m", '"0.5m"'),
        ("m", '"m"'),
        ("", '""'),
        ("0.5 kg", '"0.5 kg"'),
        ("0.5 inch", '"0.5 inch"'),
        ("0.5 M", '"0.5 M"'),
        ("half m", '"half m"'),
        ("0,5 m", '"0,5 m"'),
        ("0x10 m", '"0x10 m"'),
        ("1 m 2 mm", '"1 m 2 mm"'),
        ("1\n2", r'"1\n2"'),
    ],
)
def test_other_forms_are_refused_in_one_sentence(given_text, shown):
    sentence = f'wheel.radius must be a length, as "0.5 m", in one of m, mm, um, µm, nm, km, got {shown}'
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}$"):
        quantity("wheel.radius", given_text, "length")


@pytest.mark.parametrize(("dimension", "unit"), EVERY_UNIT)
def test_units_of_other_dimensions_are_refused(dimension, unit):
    for other in UNITS:
        if other != dimension:
            with pytest.raises(
                ValueError, match=rf'^it must be a {other}, as "[\d.]+ \S+", in one of .*, got "1 {unit}"$'
            ):
                quantity("it", f"1 {unit}", other)


@pytest.mark.parametrize("dimension", UNITS)
def test_the_example_in_a_refusal_is_accepted(dimension):
    with pytest.raises(ValueError, match="must be") as refusal:
        quantity("it", 1, dimension)
    example_given = re.search('as "(.*?)"', str(refusal.value))
    assert quantity("it", example_given.group(1), dimension) > 0


@pytest.mark.parametrize("number", ["nan", "-nan", "snan", "inf", "-inf", "1e400", "1e999999999", "-1e400"])
def test_quantities_that_are_not_finite_are_refused(number):
    with pytest.raises(ValueError, match=f'^wheel.mass must be finite, got "{number} t"$'):
        quantity("wheel.mass", f"{number} t", "mass")


@pytest.mark.parametrize("number", ["0", "-0.0", "-1", "1e-400", "-1e-999999999"])
def test_quantities_that_are_not_positive_are_refused_where_they_must_be(number):
    assert quantity("wheel.mass", f"{number} kg", "mass") <= 0
    with pytest.raises(ValueError, match=f'^wheel.mass must be positive, got "{number} kg"$'):
        quantity("wheel.mass", f"{number} kg", "mass", positive=True)


# Table 14.1


def test_table_14_1_is_what_the_book_prints_and_we_chose():
    assert load_wheel_scene("table_14_1") == WheelScene(
        name="Table 14.1",
        radius=0.5,
        mass=500.0,
        load=4905.0,
        speed=20.0,
        material=STEEL,
        rail=Roughness(rms=0.5e-6, hurst=0.7, longest=0.01, shortest=0.2e-3),
        wheel=None,
        distance=0.65,
        springs=100,
    )


@pytest.mark.parametrize(
    ("name", "value", "last_digit"),
    [
        ("modulus", 236.25e9, 0.01e9),
        ("contact_radius", 1.982e-3, 1e-6),
        ("approach", 7.856e-6, 1e-9),
        ("eigenfrequency", 1368.6, 0.1),
        ("jump", 12566, 1),
    ],
)
def test_derived_numbers_are_those_of_the_science_page(name, value, last_digit):
    assert abs(getattr(scene(), name) - value) <= last_digit / 2 * (1 + 1e-9)


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
    assert wheel.time_step * wheel.speed == pytest.approx(wheel.spacing, rel=1e-15)


def test_the_circumference_is_a_whole_number_of_springs():
    wheel = scene()
    assert isinstance(wheel.circumference_points, int)
    assert abs(wheel.circumference_points * wheel.spacing - 2 * math.pi * 0.5) <= wheel.spacing / 2 * (1 + 1e-9)


def test_roughness_is_a_spectrum_of_that_height():
    assert ROUGH.spectrum == mdr.SelfAffine(hurst=0.7, q_min=2 * math.pi / 0.01, q_max=2 * math.pi / 0.2e-3, rms=0.5e-6)


def test_jump_and_cutoff_are_of_all_waves_there_are():
    longer = replace(ROUGH, longest=0.02, shortest=0.3e-3)
    for both in ({"rail": ROUGH, "wheel": longer}, {"rail": longer, "wheel": ROUGH}):
        assert scene(**both).jump == pytest.approx(2 * math.pi / 0.02 * 20, rel=1e-15)
        assert scene(**both).cutoff == pytest.approx(2 * math.pi / 0.2e-3 * 20, rel=1e-15)
    assert scene(rail=None, wheel=longer).jump == pytest.approx(2 * math.pi / 0.02 * 20, rel=1e-15)
    assert scene(rail=None, wheel=longer).cutoff == pytest.approx(2 * math.pi / 0.3e-3 * 20, rel=1e-15)


def test_heights_add_by_their_squares():
    assert scene().rms == 0.5e-6
    assert scene(wheel=replace(ROUGH, rms=1.2e-6)).rms == pytest.approx(1.3e-6, rel=1e-15)


@pytest.mark.parametrize("name", ["jump", "cutoff"])
def test_a_smooth_track_is_a_scene_without_waves(name):
    smooth = scene(rail=None)
    assert smooth.rms == 0
    assert smooth.diagnose() == ()
    with pytest.raises(ValueError, match="must have a rough rail or wheel"):
        getattr(smooth, name)


def test_every_valid_scene_can_be_drawn():
    # two springs to the shortest wave are the least that a scene accepts and a profile can carry
    spacing = scene().spacing
    for rail in (replace(ROUGH, shortest=2 * spacing), ROUGH):
        wheel = scene(rail=rail)
        c1d = rail.spectrum.c1d
        profile = mdr.rough_profile(
            c1d, length=wheel.length, points=wheel.points, rng=np.random.default_rng(0), rms=rail.rms
        )
        assert profile.std() == pytest.approx(0.5e-6, rel=1e-9)


# Shipped files


def test_shipped_scenes_are_listed():
    assert bundled() == ("rolling_wheel", "rough_punch", "rough_wheel", "sphere", "table_14_1")
    assert bundled_wheels() == WHEELS


@pytest.mark.parametrize("name", WHEELS)
def test_shipped_scenes_leave_no_doubt(name):
    assert load_wheel_scene(name).diagnose() == ()


def test_the_rough_wheel_is_table_14_1_with_its_roughness_shared():
    shared = load_wheel_scene("rough_wheel")
    assert shared.rail == shared.wheel
    assert shared.rail.rms == pytest.approx(0.5e-6 / math.sqrt(2), rel=1e-15)
    assert shared.rms == pytest.approx(scene().rms, rel=1e-15)
    assert replace(shared, name="Table 14.1", wheel=None, rail=replace(shared.rail, rms=0.5e-6)) == scene()


@pytest.mark.parametrize("name", WHEELS)
def test_shipped_scenes_say_what_the_book_does_not_print(name):
    ours = {"load", "speed", "hurst", "longest", "shortest", "distance", "springs"}
    for line in (SCENES / f"{name}.toml").read_text(encoding="utf-8").splitlines():
        key = line.partition(" =")[0]
        assert ("not printed in the book" in line) == (key in ours), line


def test_a_name_and_a_path_read_the_same(tmp_path, monkeypatch):
    path = written(tmp_path)
    monkeypatch.chdir(tmp_path)
    assert (
        load_wheel_scene(path)
        == load_wheel_scene(str(path))
        == load_wheel_scene("scene.toml")
        == load_wheel_scene("table_14_1")
    )
    path.rename(tmp_path / "bare")
    assert load_wheel_scene("./bare") == load_wheel_scene("table_14_1")


def test_other_units_and_an_editors_mark_make_the_same_scene(tmp_path):
    changes = [("20 m/s", "72 km/h"), ("4905 N", "4.905 kN"), ("500 kg", "0.5 t"), ("210 GPa", "210e3 MPa")]
    path = written(tmp_path, *changes, ('"10 mm"', '"0.01 m"'), ("0.5 um", "500 nm"), text="\ufeff" + TABLE)
    assert load_wheel_scene(path) == load_wheel_scene("table_14_1")


@pytest.mark.parametrize("rail", ["", "[rail]\n"])
def test_without_roughness_the_rail_is_smooth(tmp_path, rail):
    start, _, rest = TABLE.partition("[rail.roughness]")
    path = written(tmp_path, text=f"{start}{rail}[simulation]{rest.partition('[simulation]')[2]}")
    assert load_wheel_scene(path) == scene(rail=None)


# Refusals


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ('radius = "0.5 m"', "", "wheel.radius is missing, wheel must have it"),
        ('mass = "500 kg"', "", "wheel.mass is missing, wheel must have it"),
        ("poisson_ratio = 0.3333333333333333", "", "material.poisson_ratio is missing, material must have it"),
        ("springs = 100", "", "simulation.springs is missing, simulation must have it"),
        ("hurst = 0.7", "", "rail.roughness.hurst is missing, rail.roughness must have it"),
        ('name = "Table 14.1"', "", "name is missing, a scene must have it"),
        ("[material]", "[stuff]", "stuff is unknown, a scene must be made of name, wheel, material, rail, simulation"),
        (
            "radius =",
            "diameter =",
            "wheel.diameter is unknown, wheel must be made of radius, mass, load, speed, roughness",
        ),
        ("[rail.roughness]", "[rail.waves]", "rail.waves is unknown, rail must be made of roughness"),
        (
            "hurst =",
            "Hurst =",
            "rail.roughness.Hurst is unknown, rail.roughness must be made of rms, hurst, longest, shortest",
        ),
        ('name = "Table 14.1"', "name = 14.1", "name must be a text that is not blank, got 14.1"),
        ('name = "Table 14.1"', 'name = " "', "name must be a text that is not blank, got ' '"),
        ("[rail.roughness]", "[rail]\nroughness = 1\n[rail.x]", "rail.x is unknown, rail must be made of roughness"),
        (
            '"0.5 m"',
            "0.5",
            'wheel.radius must be a length, as "0.5 m", in one of m, mm, um, µm, nm, km, got 0.5',
        ),
        (
            '"500 kg"',
            '"4905 N"',
            'wheel.mass must be a mass, as "500 kg", in one of kg, g, t, got "4905 N"',
        ),
        (
            '"20 m/s"',
            '"20 m"',
            'wheel.speed must be a speed, as "20 m/s", in one of m/s, mm/s, km/h, got "20 m"',
        ),
        (
            '"210 GPa"',
            '"210 GN"',
            'material.youngs_modulus must be a pressure, as "210 GPa", in one of Pa, kPa, MPa, GPa, got "210 GN"',
        ),
        ('"4905 N"', '"-1 N"', 'wheel.load must be positive, got "-1 N"'),
        ('"0.5 um"', '"0 um"', 'rail.roughness.rms must be positive, got "0 um"'),
        ('"0.65 m"', '"inf m"', 'simulation.distance must be finite, got "inf m"'),
        ("hurst = 0.7", 'hurst = "0.7"', "rail.roughness.hurst must be a real number, got '0.7'"),
        ("hurst = 0.7", "hurst = true", "rail.roughness.hurst must be a real number, got True"),
        ("hurst = 0.7", "hurst = nan", "rail.roughness.hurst must be finite, got nan"),
        ("hurst = 0.7", "hurst = 1" + 400 * "0", "rail.roughness.hurst must be finite, got a number of 401 digits"),
        ("hurst = 0.7", "hurst = 7", "rail.roughness.hurst must lie in (0, 1.2], got 7.0"),
        ("springs = 100", "springs = 1.5", "simulation.springs must be a whole number, got 1.5"),
        ("springs = 100", "springs = 0", "simulation.springs must be at least 1, got 0"),
        ("0.3333333333333333", "0.6", "material.poisson_ratio must lie in [0, 0.5], got 0.6"),
        (
            "0.3333333333333333",
            "2026-01-01",
            "material.poisson_ratio must be a real number, got datetime.date(2026, 1, 1)",
        ),
    ],
)
def test_files_are_refused_by_the_key(tmp_path, old, new, sentence):
    with pytest.raises(ValueError, match=rf"^{IN_FILE}{re.escape(sentence)}$"):
        load_wheel_scene(written(tmp_path, (old, new)))


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        ("rail = 3", "rail must be a table, got 3"),
        ("rail = [{}]", "rail must be a table, got [{}]"),
        ("rail.roughness = 'none'", "rail.roughness must be a table, got 'none'"),
    ],
)
def test_what_must_be_a_table_is_refused_otherwise(tmp_path, line, sentence):
    start, _, rest = TABLE.partition("[rail.roughness]")
    # keys of the file itself stand before its tables
    path = written(tmp_path, text=f"{line}\n{start}[simulation]{rest.partition('[simulation]')[2]}")
    with pytest.raises(ValueError, match=rf"^{IN_FILE}{re.escape(sentence)}$"):
        load_wheel_scene(path)


def test_broken_files_are_refused_by_name(tmp_path):
    path = written(tmp_path, ("[wheel]", "[wheel"))
    with pytest.raises(ValueError, match=rf"^scene {re.escape(str(path))} must be valid TOML, got: .*line"):
        load_wheel_scene(path)
    path = written(tmp_path, ("springs = 100", "springs = 100\nsprings = 50"))
    with pytest.raises(ValueError, match="must be valid TOML"):
        load_wheel_scene(path)
    path.write_bytes(b'name = "\xff"')
    with pytest.raises(ValueError, match="must be valid TOML, got: 'utf-8'"):
        load_wheel_scene(path)


def test_files_that_cannot_be_read_are_refused_by_name(tmp_path):
    missing = tmp_path / "missing.toml"
    with pytest.raises(FileNotFoundError, match=rf"^scene {re.escape(str(missing))} cannot be read: No such file"):
        load_wheel_scene(missing)
    with pytest.raises(ValueError, match=rf"^scene {re.escape(str(tmp_path))} must be a regular file, got a folder$"):
        load_wheel_scene(tmp_path)


@pytest.mark.parametrize("name", ["table", "", "Table 14.1"])
def test_unknown_names_are_answered_with_the_shipped_ones(name):
    sentence = f'scene must be a file, as "./{name}.toml", or one of {", ".join(bundled())}, got "{name}"'
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}$"):
        load_wheel_scene(name)


@pytest.mark.parametrize(
    ("changes", "error", "sentence"),
    [
        ({"name": ""}, ValueError, "name must be a text that is not blank, got ''"),
        ({"radius": "0.5 m"}, TypeError, "wheel.radius must be a real number, got '0.5 m'"),
        ({"radius": 0.0}, ValueError, "wheel.radius must be positive, got 0.0"),
        ({"mass": -1.0}, ValueError, "wheel.mass must be positive, got -1.0"),
        ({"load": math.nan}, ValueError, "wheel.load must be finite, got nan"),
        ({"speed": math.inf}, ValueError, "wheel.speed must be finite, got inf"),
        ({"material": 210e9}, TypeError, "material must be a Material, got 210000000000.0"),
        ({"distance": 0}, ValueError, "simulation.distance must be positive, got 0.0"),
        ({"springs": 99.0}, TypeError, "simulation.springs must be a whole number, got 99.0"),
        ({"springs": True}, TypeError, "simulation.springs must be a whole number, got True"),
        ({"springs": -3}, ValueError, "simulation.springs must be at least 1, got -3"),
        ({"rail": 1e-6}, TypeError, "rail.roughness must be a Roughness or None, got 1e-06"),
        ({"rail": {"rms": None}}, TypeError, "rail.roughness.rms must be a real number, got None"),
        ({"wheel": {"rms": -1.0}}, ValueError, "wheel.roughness.rms must be positive, got -1.0"),
        ({"wheel": {"hurst": 1.3}}, ValueError, "wheel.roughness.hurst must lie in (0, 1.2], got 1.3"),
        ({"rail": {"longest": 0.0}}, ValueError, "rail.roughness.longest must be positive, got 0.0"),
        ({"rail": {"shortest": math.inf}}, ValueError, "rail.roughness.shortest must be finite, got inf"),
        (
            {"rail": {"shortest": 0.01}},
            ValueError,
            "rail.roughness.shortest must be below the longest wave, 0.01 m, got 0.01 m",
        ),
        (
            {"distance": 0.003, "rail": None},
            ValueError,
            "simulation.distance must be longer than the contact, 0.00396396 m, got 0.003 m",
        ),
        (
            {"distance": 0.01},
            ValueError,
            "simulation.distance must be longer than rail.roughness.longest, 0.01 m, got 0.01 m",
        ),
        (
            {"distance": 0.02, "wheel": {"longest": 0.03}},
            ValueError,
            "simulation.distance must be longer than wheel.roughness.longest, 0.03 m, got 0.02 m",
        ),
        (
            {"springs": 10},
            ValueError,
            "rail.roughness.shortest must hold two springs, 0.000396396 m, got 0.0002 m",
        ),
        (
            {"distance": 0.011, "rail": {"longest": 0.0099, "shortest": 0.0098}},
            ValueError,
            "rail.roughness.shortest must leave a wave that fits a period of 0.0110",
        ),
        (
            {"distance": 10.0, "wheel": {"longest": 5.0, "shortest": 4.0}},
            ValueError,
            "wheel.roughness.shortest must leave a wave that fits a period of 3.141",
        ),
        ({"load": 1e15}, ValueError, "wheel.load must leave a contact smaller than the wheel, 0.5 m, got 11.665 m"),
        ({"springs": 10**400}, ValueError, "simulation.springs must be at most 630884 on such a track, got 1000"),
    ],
)
def test_scenes_are_refused_by_the_key(changes, error, sentence):
    rough = {key: replace(ROUGH, **value) for key, value in changes.items() if isinstance(value, dict)}
    with pytest.raises(error, match=f"^{re.escape(sentence)}"):
        scene(**{**changes, **rough})


# Doubts


@pytest.mark.parametrize(
    ("doubtful", "beyond_doubt", "sentence"),
    [
        (
            {"springs": 39},
            {"springs": 40},
            "rail.roughness.shortest holds 3.94 springs, fewer than 4: its waves are not resolved.",
        ),
        (
            {"wheel": replace(ROUGH, longest=1.6), "distance": 20.0},
            {"wheel": replace(ROUGH, longest=1.5), "distance": 20.0},
            "wheel.roughness.longest is 1.6 m, more than half of the circumference of 3.14 m: "
            "a wheel carries whole waves only.",
        ),
        (
            {"speed": 0.13},
            {"speed": 0.14},
            "a time step is 0.209 over the eigenfrequency, more than 0.2, and 2 is unstable: "
            "roll slower or take more springs.",
        ),
        (
            {"distance": 0.09},
            {"distance": 0.11},
            "simulation.distance holds 9 waves of rail.roughness.longest, fewer than 10: "
            "the low end of a spectrum rests on few waves.",
        ),
        (
            {"load": 1e9, "springs": 10000, "distance": 2.0, "rail": replace(ROUGH, rms=1.1e-4)},
            {"load": 1e9, "springs": 10000, "distance": 2.0, "rail": replace(ROUGH, rms=0.9e-4)},
            "rail.roughness.rms is 0.00011 m, more than 0.0001 m: is its unit right?",
        ),
        (
            {"load": 1e9, "springs": 5000},
            {"load": 5e7, "springs": 5000},
            "the contact radius is 0.233 of wheel.radius, more than a tenth: "
            "no half-space; are the units of wheel.load and material.youngs_modulus right?",
        ),
    ],
)
def test_doubts_come_with_their_numbers_and_go_with_their_cause(doubtful, beyond_doubt, sentence):
    assert sentence in scene(**doubtful).diagnose()
    what = sentence.rpartition(": ")[2]
    assert not [doubt for doubt in scene(**beyond_doubt).diagnose() if doubt.endswith(what)]
