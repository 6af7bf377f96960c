"""Scene files of a rail: units of the field, levels, lines and heights; everything that is refused, by its key."""

import math
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from tests.scenes import test_scene_files
from tests.seeded import catches
from validation.railway.scenes import rail_file
from validation.railway.scenes.level_files import curve
from validation.railway.scenes.measured_lines import MeasuredLines
from validation.railway.scenes.rail import RailScene
from validation.scenes.description import describe
from validation.scenes.load import load_scene, load_scene_with_track
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.rail_impedance import FreeBeam, RailDashpot

TEXT = """
name = "regional train"
[material]
youngs_modulus = "210 GPa"
poisson_ratio = 0.3
counterface = "same"             # two equal bodies: E* = E / (2 (1 - nu^2))
[wheel]
radius = "460 mm"                # or diameter; transverse_radius = "..." where it is not conical
load = "50 kN"                   # per wheel
speed = "80 km/h"
[rail]
crown_radius = "300 mm"
lateral_structure = "isotropic"             # "ridges", or lateral_ratio = 1.0
[rail.levels]
curve = "iso3095-2013"           # or "cnossos-average", or file = "levels.csv"
"""
"""As it stands in files of other people."""
CURVE = 'curve = "iso3095-2013"'
LEVELS = "[rail.levels]\ncurve"
HEADER = "wavelength [mm],level [dB re 1 um]"


written = partial(test_scene_files.written, text=TEXT)


def loaded(folder, *changes):
    return load_scene(written(folder, *changes))


def with_levels(folder, contents):
    (folder / "levels.csv").write_text(contents, encoding="utf-8")
    return loaded(folder, (CURVE, 'file = "levels.csv"'))


def with_lines(folder, height, *keys):
    np.save(folder / "lines.npy", height)
    return loaded(folder, ("[rail.levels]", "[rail.lines]"), (CURVE, "\n".join(('file = "lines.npy"', *keys))))


# What is read


def test_the_file_of_the_field_is_the_scene_that_it_says(tmp_path):
    scene = loaded(tmp_path)
    assert isinstance(scene, RailScene)
    assert (scene.name, scene.radius, scene.crown_radius, scene.load) == ("regional train", 0.46, 0.3, 5e4)
    assert (scene.lateral_structure, scene.transverse_radius, scene.mass, scene.notes) == ("isotropic", None, None, ())
    assert scene.speed == pytest.approx(80 / 3.6)
    assert scene.modulus == pytest.approx(210e9 / 2 / (1 - 0.09))
    assert scene.levels.levels[0] == 17.1


@pytest.mark.parametrize(
    ("old", "new", "value"),
    [
        ('radius = "460 mm" ', 'diameter = "920 mm"', {"radius": 0.46}),
        ('load = "50 kN" ', 'load = "5 tf"', {"load": 49033.25}),
        ('load = "50 kN" ', 'axle_load = "100 kN"\nwheels_per_axle = 2', {"load": 5e4}),
        ('speed = "80 km/h"', 'mass = "0.5 t"', {"speed": None, "mass": 500.0}),
        ('crown_radius = "300 mm"', "", {"crown_radius": None}),
        ('lateral_structure = "isotropic"', 'lateral_structure = "ridges"', {"lateral_structure": "ridges"}),
        ('lateral_structure = "isotropic"', "lateral_structure = 1.5", {"lateral_structure": 1.5}),
        ('lateral_structure = "isotropic"', "lateral_ratio = 1.0", {"lateral_structure": 1.0}),
        ('lateral_structure = "isotropic"', "", {"lateral_structure": None}),
    ],
)
def test_other_words_for_a_value(tmp_path, old, new, value):
    changes = [(old, new)] if "crown" not in old else [(old, new), ('load = "', 'transverse_radius = "1 m"\nload = "')]
    scene = loaded(tmp_path, *changes)
    assert {key: getattr(scene, key) for key in value} == pytest.approx(value) or value == {
        "lateral_structure": scene.lateral_structure
    }
    assert ("axle" in new) == ("the axle load of 100 kN is shared by 2 wheels: 50 kN each." in scene.diagnose())


@pytest.mark.parametrize("offset", ["10", '"10 dB"'])
def test_an_offset_raises_all_levels(tmp_path, offset):
    raised = loaded(tmp_path, (CURVE, f"{CURVE}\noffset = {offset}")).levels
    np.testing.assert_allclose(np.array(raised.levels) - loaded(tmp_path).levels.levels, 10)


def test_bands_beyond_two_wavelengths_are_left_out(tmp_path):
    whole = loaded(tmp_path).levels
    cut = loaded(tmp_path, (CURVE, CURVE + '\nlongest = "400 mm"\nshortest = "3.15 mm"\noffset = 4')).levels
    assert cut.wavelengths == whole.wavelengths[7:29]
    assert cut.levels == tuple(level + 4 for level in whole.levels[7:29])
    assert loaded(tmp_path, (CURVE, CURVE + '\nlongest = "0.4 m"')).levels.levels == whole.levels[7:]
    with pytest.raises(ValueError, match=r"rail.levels.*no band lies between the wavelengths 3 mm and 10 mm"):
        loaded(tmp_path, (CURVE, CURVE + '\nlongest = "3 mm"\nshortest = "10 mm"'))


def test_wheel_and_rail_add_their_energies(tmp_path):
    (tmp_path / "wheel.csv").write_text(f"{HEADER}\n100,4.9\n80,2.9\n", encoding="utf-8")
    both = loaded(tmp_path, ("[rail]", '[wheel.levels]\nfile = "wheel.csv"\n[rail]'))
    more = np.array(both.levels.levels) - loaded(tmp_path).levels.levels
    at = np.isin(both.levels.bands.nominal, [0.1, 0.08])
    np.testing.assert_allclose(more, np.where(at, 10 * np.log10(2), 0.0), atol=1e-12)
    assert "of the wheel is not known at 2000, " in both.diagnose()[0]


def test_lines_have_the_levels_of_their_mean_energy(tmp_path):
    """Two lines, one of which carries a wave of 40 mm and 3 um: half of its power."""
    x = np.arange(4000)
    lines = 0.01 * np.cumsum(np.random.default_rng(3).standard_normal((4000, 2)), axis=0)
    lines[:, 0] += 3 * np.cos(2 * np.pi * x / 40)
    keys = ('spacing = "1 mm"', 'unit = "um"', 'positions = ["-5 mm", "5 mm"]', 'shortest = "20 mm"')
    scene = with_lines(tmp_path, lines, *keys)
    assert isinstance(scene.roughness, MeasuredLines)
    at = scene.levels.bands.nominal.tolist().index(0.04)
    assert scene.levels.levels[at] == pytest.approx(20 * np.log10(3 / 2), abs=0.05)
    assert scene.levels.bands.nominal[[0, -1]].tolist() == [1.0, 0.02]
    assert dict(describe(scene))["roughness"].endswith("2 measured lines, at -5, 5 mm across")
    missing, scatter, out = scene.diagnose()
    assert "known in bands of 1000 to 20 mm: the others of 2000 to 0.8 mm" in missing
    assert "scatter by" in scatter and "40 mm" in out


def test_lines_and_a_rough_wheel_are_levels_together_and_one_line_needs_no_position(tmp_path):
    line = np.random.default_rng(1).standard_normal(1000) * 1e-6
    alone = with_lines(tmp_path, line, 'spacing = "1 mm"')
    assert alone.levels.bands.nominal[[0, -1]].tolist() == [0.25, 0.0025]
    both = with_lines(tmp_path, line, 'spacing = "1 mm"', "[wheel.levels]", CURVE)
    assert both.roughness == alone.levels + curve("iso3095-2013")


def test_positions_may_descend_with_their_lines(tmp_path):
    up = with_lines(tmp_path, LINE, 'spacing = "1 mm"', PLACES).roughness
    down = with_lines(tmp_path, LINE[:, ::-1], 'spacing = "1 mm"', 'positions = ["5 mm", "0 mm"]').roughness
    assert down.positions == (0.0, 0.005)
    assert (down.height == LINE).all() and up.levels == down.levels


def test_a_band_without_waves_is_named_and_no_unit_is_blamed_for_it(tmp_path):
    """Lines that a filter has cut off at 5 mm have no waves of 2.5 mm."""
    x = 1e-3 * np.arange(2000)
    line = sum(1e-6 * w**0.5 * np.sin(2 * np.pi * x / w + 1e5 * w) for w in 1 / np.arange(2.0, 200.0, 0.5))
    with pytest.raises(ValueError, match=r"lines.levels must lie above -100 .* bands of .*2.5 mm: longest and sho"):
        with_lines(tmp_path, line, 'spacing = "1 mm"')
    assert with_lines(tmp_path, line, 'spacing = "1 mm"', 'shortest = "8 mm"').levels.rms > 1e-7
    with pytest.raises(ValueError, match=r"lines.file must have heights that differ along a line"):
        with_lines(tmp_path, 0 * line + 3e-6, 'spacing = "1 mm"')


def test_heights_have_the_levels_of_their_lines(tmp_path):
    np.save(tmp_path / "h.npy", 1e-6 * np.random.default_rng(1).standard_normal((1000, 40)))
    heights = [("[rail.levels]", "[rail.heights]"), (CURVE, 'file = "h.npy"\nspacing = "1 mm"')]
    scene = loaded(tmp_path, *heights, ('lateral_structure = "isotropic"', ""))
    assert isinstance(scene.roughness, MeasuredHeights)
    assert scene.levels.source == "40 measured lines"
    assert dict(describe(scene))["what lies across"] == "measured"
    with pytest.raises(ValueError, match=r"rail\.lateral_structure must be left out beside rail\.heights"):
        loaded(tmp_path, *heights)
    with pytest.raises(ValueError, match=r"wheel\.levels must be left out beside rail\.heights"):
        loaded(
            tmp_path, *heights, ("[rail]", f"[wheel.levels]\n{CURVE}\n[rail]"), ('lateral_structure = "isotropic"', "")
        )


# What is refused


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('load = "50 kN" ', 'axle_load = "100 kN"', "wheel.wheels_per_axle is missing"),
        ('load = "50 kN" ', 'load = "50 kN"\nwheels_per_axle = 2', "wheel.wheels_per_axle belongs to wheel.axle_load"),
        ('load = "50 kN" ', 'load = "50 kN"\naxle_load = "1 N"', "one of load, axle_load, got load and axle_load"),
        ('load = "50 kN" ', 'load = "5 t"', r"wheel.load must be a force, .* got \"5 t\""),
        (
            'load = "50 kN" ',
            'load = "1 N"\noffset = "3 mm"',
            "wheel.offset must be left out where neither wheel nor rail",
        ),
        ('load = "50 kN" ', "", "wheel must have one of load, axle_load, got none"),
        (
            'lateral_structure = "isotropic"',
            'lateral_structure = "random"',
            'rail.lateral_structure must be "ridges", "isotropic" or a number',
        ),
        ('lateral_structure = "isotropic"', "across = -1.0", "rail.lateral_structure must be positive"),
        (
            'lateral_structure = "isotropic"',
            'lateral_structure = "ridges"\nlateral_ratio = 1.0',
            "got lateral_structure and lateral_ratio",
        ),
        ('crown_radius = "300 mm"', "", "rail.crown_radius or wheel.transverse_radius must be given"),
        (CURVE, 'curve = "iso3095"', "rail.levels.curve must be one of cnossos-average, iso3095-2013, got"),
        (CURVE, f'{CURVE}\nfile = "a.csv"', "rail.levels must have one of curve, file, got curve and file"),
        (CURVE, f'{CURVE}\noffset = "10 um"', "rail.levels.offset must be a level"),
        (CURVE, f"{CURVE}\noffset = 90", "rail.levels.levels must lie between -100 and 50 dB re 1 um, got 107.1 dB"),
        ("[rail.levels]\n", "[rail.heights]\n", "rail.heights.curve is unknown"),
    ],
)
def test_files_are_refused_by_key(tmp_path, old, new, said):
    with pytest.raises(ValueError, match=f"^{test_scene_files.IN_FILE}.*{said}"):
        loaded(tmp_path, (old, new))


@pytest.mark.parametrize(
    ("contents", "said"),
    [
        ("wavelength [mm],level [dB re 1 nm]\n100,60\n", "levels must be in dB re 1 um, got dB re 1 nm"),
        ("wavelength,level [dB]\n100,1\n", 'wavelengths must have a unit, .*: as: unit = "mm"'),
        ("100,1.0\n80,2.0\n", 'columns must be named as .*, got column 1 and column 2: .*unit = "mm"'),
        ("100,1\n80,2\n", 'two columns or one with decimal commas, .*as: decimal = ","'),
        (f"{HEADER}\n100,-110\n80,-115\n", "levels must lie between .* got -110 dB at 100 mm: is the unit another"),
        (f"{HEADER}\n0.1,4.9\n0.08,2.9\n", "from 2000 to 0.8 mm, got 0.1 mm: is it in metres"),
        (f"{HEADER}\n100,1\n125,2\n80,3\n", "sorted, got 125 mm behind 100 mm"),
        (f"{HEADER}\n100,1\n80,2\n80,3\n", "got 80 mm twice"),
        (f"{HEADER}\n100,1\n63,2\n", "no 80 mm behind 100 mm"),
        (f"{HEADER}\n97,1\n", "must be nominal, .* got 97 mm"),
        (f"{HEADER}\n", "must hold rows of numbers, got none in its first 1 lines"),
    ],
)
def test_levels_are_refused_by_what_is_wrong(tmp_path, contents, said):
    with pytest.raises(ValueError, match=rf"rail\.levels\.file \S+levels\.csv: .*{said}"):
        with_levels(tmp_path, contents)


LINE = 1e-6 * np.random.default_rng(2).standard_normal((1000, 2))
PLACES = 'positions = ["0 mm", "5 mm"]'


@pytest.mark.parametrize(
    ("height", "keys", "said"),
    [
        (LINE, (PLACES, 'longest = "500 mm"'), "lines.longest must be a quarter of the lines at the most, 1 m long"),
        (LINE, (PLACES, 'shortest = "1 mm"'), "lines.shortest must be 2.5 points or more, 1 mm apart, got 1 mm"),
        (LINE, (PLACES, 'shortest = "100 mm"', 'longest = "50 mm"'), "lines.spacing must be .*no band lies between"),
        (LINE, (), r"lines.positions is missing: the file has 2 lines.*as: positions = "),
        (LINE.T, (PLACES,), "lines.positions must be one a line, got 2 for 1000 lines, .* in a table of 2 rows"),
        (LINE, ('positions = ["5 mm", "5 mm"]',), "lines.positions must ascend"),
        (LINE, ('positions = "0 mm"',), "lines.positions must be a list of lengths"),
        (np.where(np.arange(1000)[:, None] == 500, np.nan, LINE), (PLACES,), "lines.heights must be known everywhere"),
        (1e6 * LINE, (PLACES,), "lines.levels must lie between .* is the unit another"),
        (0 * LINE, (PLACES,), "lines.file must have heights that differ along a line, got zeros alone"),
    ],
)
def test_lines_are_refused_by_what_is_wrong(tmp_path, height, keys, said):
    with pytest.raises(ValueError, match=rf"rail\.{said}"):
        with_lines(tmp_path, height, 'spacing = "1 mm"', *keys)


def test_masked_lines_are_refused():
    with pytest.raises(ValueError, match=r"heights must be known everywhere, got 1 of 1000 .* masked"):
        MeasuredLines(height=np.ma.masked_less(LINE[:, 0], LINE[:, 0].min() * 0.999), spacing=1e-3)


@pytest.mark.parametrize(
    ("shape", "spacing", "said"),
    [((60, 40), "1 mm", "must be 71.4 mm long"), ((200, 16), "0.5 mm", "12.8 mm wide"), ((40, 40), "5 mm", "no more")],
)
def test_heights_must_hold_the_contact(tmp_path, shape, spacing, said):
    np.save(tmp_path / "h.npy", 1e-6 * np.random.default_rng(1).standard_normal(shape))
    ground = f'file = "h.npy"\nspacing = "{spacing}"'
    with pytest.raises(ValueError, match=said):
        loaded(tmp_path, ("[rail.levels]", "[rail.heights]"), (CURVE, ground), ('lateral_structure = "isotropic"', ""))


def test_a_rail_is_no_dynamic_wheel():
    with pytest.raises(ValueError, match="must be those of a dynamic wheel, got a wheel on a rail"):
        load_scene_with_track("rail")


IMPEDANCES = {
    'impedance = "rigid"': None,
    "impedance = 1.5e5": RailDashpot(dashpot=1.5e5),
    "impedance = { dashpot = 1.5e5, mass = 30 }": RailDashpot(dashpot=1.5e5, mass=30),
    'impedance = "free beam"\nbending_stiffness = 6.38e6\nmass_per_length = 60.2': FreeBeam(
        bending_stiffness=6.38e6, mass_per_length=60.2
    ),
}


def moving(tmp_path, rail):
    text = (Path(rail_file.__file__).with_name("rail.toml")).read_text(encoding="utf-8")
    text = text.replace('# mass = "500 kg"', 'mass = "500 kg"').replace("[rail]\n", f"[rail]\n{rail}\n")
    path = tmp_path / "moving.toml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(("rail", "impedance"), IMPEDANCES.items())
def test_a_rail_has_the_impedance_of_its_file(tmp_path, rail, impedance):
    assert load_scene(moving(tmp_path, rail)).impedance == impedance


@pytest.mark.parametrize(
    ("rail", "named"),
    [
        ('impedance = "soft"', 'rail.impedance must be "rigid", "free beam", a dashpot in N s/m or'),
        ("impedance = { mass = 30 }", "rail.impedance must be"),
        ("impedance = { dashpot = true }", "rail.impedance must be"),
        ("impedance = -1.0", "rail.impedance.dashpot"),
        ('impedance = "free beam"\nmass_per_length = 60', "rail.bending_stiffness must be given with"),
        ("mass_per_length = 60", 'rail.mass_per_length belongs to rail.impedance = "free beam"'),
    ],
)
def test_impedances_of_files_that_are_refused(tmp_path, rail, named):
    with pytest.raises(ValueError, match=named):
        load_scene(moving(tmp_path, rail))


def test_an_impedance_without_a_mass_is_refused():
    with pytest.raises(ValueError, match=r"rail\.impedance needs a mass"):
        replace(load_scene("rail"), impedance=RailDashpot(dashpot=1.5e5))


@catches("the rail forgotten in the force of linear theory").at(
    "validation.scenes.rail_impedance.FreeBeam.impedance", lambda beam, omega: 1e30 + 0j * np.asarray(omega)
)
def test_the_force_in_motion_is_that_of_receptances_in_series():
    """Band by band by a plain sum of narrow waves: r k / abs(1 + k (R_wheel + R_rail)), 2.3 % of the load on a beam."""
    scene = replace(load_scene("rail"), mass=500.0, impedance=list(IMPEDANCES.values())[3])
    total, k = 0.0, scene.contact.stiffness
    edges = scene.levels.bands.edges
    for level, low, high in zip(scene.levels.levels, edges, edges[1:], strict=False):
        for n in range(50):
            q = low * (high / low) ** ((n + 0.5) / 50)
            w, s = q * scene.speed, q * scene.contact.along
            z = 2 * 60.2 * (6.38e6 * w**2 / 60.2) ** 0.25 * (1 + 1j)
            moves = -1 / (500 * w**2) + 1 / (1j * w * z)
            total += 1e-12 * 10 ** (level / 10) / 50 * abs(k * math.sin(s) / s / (1 + k * moves)) ** 2
    assert scene.force_in_motion == pytest.approx(math.sqrt(total) / scene.load, rel=0.01)
    assert 0.01 < scene.force_in_motion < 0.1
    described = dict(scene.describe())
    assert "free beam" in described["impedance of the rail"] and "contact resonance" in described["wheel in motion"]
    rigid = replace(scene, impedance=None)
    assert math.isinf(rigid.force_in_motion) and any("leaves the rail" in note for note in rigid.diagnose())
    damped = replace(rigid, damping=0.02)
    assert damped.force_in_motion > 3 * scene.force_in_motion
    still = load_scene("rail")
    assert math.isnan(still.force_in_motion) and "wheel in motion" not in dict(still.describe())
