"""A rail or a wheel whose shape across was measured: files, where both touch, the radius fitted, refusals."""

import math
import re
from contextlib import nullcontext
from functools import partial

import numpy as np
import pytest

from tests.railway.test_rail_files import written
from tests.scenes.test_measured_heights import refusal
from tests.seeded import Times, catches, module_with
from validation.railway.scenes import transverse_profile
from validation.railway.scenes.rail import ProfiledRail
from validation.railway.scenes.transverse_profile import TransverseProfile, both_together, fitted_radius
from validation.scenes.description import describe
from validation.scenes.load import load_scene

CROWN = 'crown_radius = "300 mm"'
PROFILE = 'profile = "head.csv"'
STEEL = 210e9 / (2 * (1 - 0.3**2))
Y = np.arange(-30, 30.25, 0.5)


def parabola(radius, top=0.0):
    """Heights [mm] over `Y` [mm]."""
    return -((Y - top) ** 2) / (2 * radius)


def worn(y):
    """A crown of 300 mm that turns into one of 40 mm, 2 mm from the middle, without an edge [mm]."""
    return -(y**2) / 600 - np.maximum(np.abs(y) - 2, 0.0) ** 2 * (1 / 80 - 1 / 600)


def table(height, y=Y, header="y [mm],height [mm]"):
    rows = [f"{one:.10g},{other:.10g}" for one, other in zip(y, height, strict=True)]
    return "\n".join(["# of a trolley", header, *rows])


def with_profile(folder, contents, *changes):
    (folder / "head.csv").write_text(contents, encoding="utf-8")
    return load_scene(written(folder, (CROWN, PROFILE), *changes))


def test_a_parabola_is_the_rail_of_its_radius(tmp_path):
    scene, crowned = with_profile(tmp_path, table(parabola(300.0))), load_scene(written(tmp_path))
    assert isinstance(scene, ProfiledRail) and scene.transverse_radius is None
    assert scene.radii == pytest.approx(crowned.radii, rel=1e-6)
    assert scene.contact.across == pytest.approx(crowned.contact.across, rel=1e-6)
    assert dict(describe(scene))["wheel and rail"].startswith("profile of head.csv across, radius 300 mm fitted")
    assert "radius of 300 mm, fitted over the contact, 4.28 mm to both sides: boundary" in scene.diagnose()[0]


@pytest.mark.parametrize("order", [1, -1])
def test_a_file_in_either_order_has_its_side_across(tmp_path, order):
    """A crown of 300 mm with a tilt of 1/100: highest 3 mm to the side to which it rises, whichever row is first."""
    scene = with_profile(tmp_path, table((parabola(300.0) + Y / 100)[::order], Y[::order]))
    assert scene.profile.at == pytest.approx(3e-3, abs=2e-6)


def profile_of(height, y=Y):
    return TransverseProfile(y=tuple(y / 1e3), height=tuple(height / 1e3))


def radius_of(profile, load=5e4):
    return fitted_radius(profile, along=0.46, modulus=STEEL, load=load)


@catches("y^2 / R for y^2 / (2 R) in the radius of a transverse profile", load=5e4).at(
    "validation.railway.scenes.transverse_profile.TransverseProfile.radius_within", Times(2.0)
)
@pytest.mark.parametrize("load", [5e3, 5e4, 2e5])
def test_a_parabola_has_its_radius_under_any_load(load):
    assert radius_of(profile_of(parabola(300.0)), load) == pytest.approx(0.3)


right_both_together = transverse_profile.both_together


@catches("the curvature of the other body taken off that of a profile").at(
    f"{__name__}.both_together", lambda bodies, curvature: right_both_together(bodies, 0.0)
)
def test_a_hollow_wheel_and_a_crown_are_one_profile():
    """1 / 200 - 1 / 600 = 1 / 300 mm, of two profiles and of a profile and a radius."""
    crown, hollow = profile_of(parabola(200.0)), profile_of(-parabola(600.0) - 1e-6 * Y**4)
    bodies = both_together([crown], -1 / 0.6), both_together([profile_of(parabola(200.0) - parabola(600.0))], 0.0)
    for together in bodies:
        assert radius_of(together) == pytest.approx(0.3)
    for offset in (1000, 60):
        with pytest.raises(ValueError, match=r"must have places in common.*wheel.offset"):
            both_together([crown, profile_of(parabola(300.0), Y + offset)], 0.0)
    assert hollow.radius_within(5e-3) == math.inf


radius_of_parabola = TransverseProfile.radius_within


@catches("a radius of more than the contact").at(
    "validation.railway.scenes.transverse_profile.TransverseProfile.radius_within",
    lambda profile, half: radius_of_parabola(profile, 2 * half),
)
def test_a_radius_is_fitted_over_the_contact_and_not_over_the_whole_head():
    light, heavy = (radius_of(profile_of(worn(Y)), load) for load in (1e3, 5e4))
    assert light == pytest.approx(0.3, rel=0.01)
    assert 0.15 < heavy < 0.2


def test_curvatures_of_wheel_and_rail_add(tmp_path):
    scene = with_profile(tmp_path, table(parabola(300.0)), ('load = "', 'transverse_radius = "600 mm"\nload = "'))
    assert scene.radii[1] == pytest.approx(0.2, rel=1e-6)
    (tmp_path / "tread.csv").write_text(table(parabola(600.0)), encoding="utf-8")
    scene = with_profile(tmp_path, table(parabola(300.0)), ('load = "', 'profile = "tread.csv"\nload = "'))
    assert scene.radii[1] == pytest.approx(0.2, rel=1e-6)
    assert scene.profile.source == "head.csv and tread.csv"
    scene = load_scene(written(tmp_path, (CROWN, ""), ('load = "', 'profile = "tread.csv"\nload = "')))
    assert scene.radii[1] == pytest.approx(0.6, rel=1e-6)


@pytest.mark.parametrize(
    ("contents", "said"),
    [
        (table(parabola(300.0), header="y,height"), "columns must be named as 'y [mm],height [mm]', with their units"),
        (table(parabola(300.0), header="y [N],height [mm]"), "columns must be lengths, got y [N]"),
        (table(parabola(300.0)[:5], Y[:5]), "profile must have 7 to 100000 points"),
        (table(parabola(300.0)) + "\n29,1", "y must ascend, got 0.0295 m behind 0.03 m"),
        (table(-parabola(300.0)), "must be highest between its ends, -30 and 30 mm, got its highest point at -30 mm"),
        (table(parabola(300.0)[::5], Y[::5]), "profile must have 5 points in the contact at the least, got so"),
        (table(parabola(1e9)), "profile must reach to twice the contact"),
        (table(parabola(300.0)[50:71], Y[50:71]), "must reach to twice the contact and have 5 points in it"),
    ],
)
def test_files_that_are_no_profile_are_refused(tmp_path, contents, said):
    with pytest.raises(ValueError, match=re.escape(said)) as refused:
        with_profile(tmp_path, contents)
    assert "rail.profile" in str(refused.value) and "\n" not in str(refused.value)


def test_a_radius_beside_a_profile_and_a_file_that_is_missing_are_refused(tmp_path):
    with pytest.raises(OSError, match=r"rail\.profile .*head\.csv cannot be read"):
        load_scene(written(tmp_path, (CROWN, PROFILE)))
    (tmp_path / "head.csv").write_text(table(parabola(300.0)), encoding="utf-8")
    with pytest.raises(ValueError, match="rail must have one of crown_radius, profile, got crown_radius and profile"):
        load_scene(written(tmp_path, (CROWN, f"{CROWN}\n{PROFILE}")))
    with pytest.raises(ValueError, match=r"rail\.profile must be a table, got 3"):
        load_scene(written(tmp_path, (CROWN, "profile = 3")))
    beside = profile_of(parabola(30.0), Y + 50)
    with pytest.raises(ValueError, match="must be highest between its ends, 20 and 30 mm, got its highest point at 30"):
        both_together([profile_of(parabola(300.0)), beside], 0.0)


# A wheel with cone and flange on a rail with its corners


WHEEL_Y, RAIL_Y = np.arange(-69, 60.1, 0.25), np.arange(-35, 35.1, 0.25)


def arc(y, radius, until):
    """A circular arc from y = 0 on, and straight on from a place where it ends."""
    at = np.minimum(y, until)
    slope = until / np.sqrt(radius**2 - until**2)
    return radius - np.sqrt(radius**2 - at**2) + slope * (y - at)


def head(y):
    """A head like that of 60E1: radii of 300, 80 and 13 mm, which meet in tangents at 10.3 and 26 mm [mm]."""
    z, sine = np.zeros_like(y), 0.0
    for start, end, radius in ((0.0, 10.3, 300.0), (10.3, 26.0, 80.0), (26.0, 35.2, 13.0)):
        inclined = sine + np.clip(np.abs(y) - start, 0, end - start) / radius
        z = z - radius * (np.sqrt(1 - sine**2) - np.sqrt(1 - inclined**2))
        sine += (end - start) / radius
    return z


def tread(y, cone):
    """A tread of one cone, a root of 14 mm from y = -32 mm on, a flank of 70 degrees and a flange of 28 mm [mm]."""
    root = arc(np.maximum(-32 - y, 0), 14.0, 14 * np.sin(np.radians(70)))
    return -cone * y + np.where(y < -42, np.minimum(root, 28 - 0.05 * (y + 55) ** 2), root)


def rolling(folder, *changes, cone=1 / 40, rail=True, flip=1, shift=0):
    """The scene of a wheel with a flange."""
    (folder / "tread.csv").write_text(table(flip * tread(WHEEL_Y, cone), WHEEL_Y + shift), encoding="utf-8")
    (folder / "head.csv").write_text(table(head(RAIL_Y), RAIL_Y), encoding="utf-8")
    profile = [(CROWN, PROFILE)] if rail else []
    return load_scene(written(folder, *profile, ('load = "', 'profile = "tread.csv"\nload = "'), *changes))


def test_a_cone_shifts_the_contact_along_a_crown_and_keeps_its_curvature(tmp_path):
    """Where the crown is as steep as the cone, y = -R sin(atan(cone)); a cone adds no curvature."""
    flat, cone = rolling(tmp_path, cone=0.0), rolling(tmp_path, cone=0.01)
    assert flat.profile.at == pytest.approx(0.0, abs=1e-5)
    assert cone.profile.at == pytest.approx(-3e-3, abs=2e-5)
    assert cone.profile.inclination == pytest.approx(0.01, rel=0.01)
    for scene in (flat, cone):
        assert scene.radii[1] == pytest.approx(0.3, rel=2e-3)
        assert (scene.contact.along, scene.contact.across) == pytest.approx((5.684e-3, 4.276e-3), rel=2e-3)
    assert cone.contact_place == "y = -3 mm on the rail, -3 mm on the wheel, inclined by 0.57 degrees"
    # on the radius of 80 mm, where this is as steep as 1 in 20: y = 10.3 + 80 (sin atan 0.05 - 10.3 / 300)
    scene = rolling(tmp_path, cone=0.05)
    assert scene.profile.at == pytest.approx(-11.547e-3, abs=3e-5) and 0.08 < scene.radii[1] < 0.09


def test_a_wheel_in_coordinates_of_its_own_is_asked_for_its_offset(tmp_path):
    for shift, offset in ((745.0, "-740 mm"), (-745.0, "750 mm")):
        (tmp_path / "far.csv").write_text(table(tread(WHEEL_Y, 1 / 40), WHEEL_Y + shift), encoding="utf-8")
        with pytest.raises(ValueError, match=rf'wheel.profile must have points within 26 mm .*as: offset = "{offset}"'):
            load_scene(written(tmp_path, ('load = "', 'profile = "far.csv"\nload = "')))
    asked = ('load = "', 'profile = "far.csv"\noffset = "745 mm"\nload = "')
    assert load_scene(written(tmp_path, asked)).profile.at == pytest.approx(-7.498e-3, abs=1e-5)


@pytest.mark.parametrize("offset", [-8, 3, 8])
def test_an_offset_moves_the_wheel_across_the_rail(tmp_path, offset):
    """The wheel's y = 0 stands at the offset; on one cone the contact stays on the rail."""
    scene = rolling(tmp_path, ('load = "', f'offset = "{offset} mm"\nload = "'))
    place = rolling(tmp_path).profile.at
    assert scene.profile.at == pytest.approx(place, abs=1e-5)
    said = f"y = {1e3 * scene.profile.at:.3f} mm on the rail, {1e3 * scene.profile.at - offset:.3f} mm on the wheel"
    assert scene.contact_place.startswith(said)
    assert scene.offset == pytest.approx(1e-3 * offset)


@pytest.mark.parametrize(
    ("settings", "changes", "said"),
    [
        ({}, [('load = "', 'offset = "11 mm"\nload = "')], "must be highest between its ends, .* (wheel.offset)"),
        ({"flip": -1}, [], "wheel.profile must have heights positive towards the rail, .*: flip = true turns it"),
        ({"rail": False}, [('load = "', 'offset = "-60 mm"\nload = "')], "must reach to twice the contact"),
        ({}, [('load = "', 'offset = "3"\nload = "')], "wheel.offset must be a length"),
    ],
)
def test_a_flange_in_contact_is_refused(tmp_path, settings, changes, said):
    with pytest.raises(ValueError, match=re.escape(said).replace(r"\.\*", ".*")):
        rolling(tmp_path, *changes, **settings)


@pytest.mark.parametrize("flip", [1, -1])
def test_a_wheel_upside_down_is_told_where_its_places_count_from_the_middle_of_the_track(tmp_path, flip):
    """y = 750 mm on the wheel stands above the middle of the head: the flange is judged beside the contact there."""
    offset = ('load = "', 'offset = "-750 mm"\nload = "')
    with nullcontext() if flip == 1 else pytest.raises(ValueError, match="flip = true turns it"):
        assert rolling(tmp_path, offset, flip=flip, shift=750).profile.at < 0


def two_tops(gap, side=1):
    """Two crowns of 300 mm side by side, 30 mm apart, the second to a side and lower by a gap [mm]."""
    y = np.arange(-55, 55.1, 0.5)
    y = y[side * y > -25.1]
    return profile_of(np.maximum(-(y**2) / 600, -((y - side * 30) ** 2) / 600 - gap), y)


def second_contact(gap, load, side=1):
    """What is said of two crowns under a load; nothing where only one touches."""
    try:
        assert radius_of(two_tops(gap, side), load) == pytest.approx(0.3, rel=1e-3)
    except ValueError as problem:
        return str(problem)
    return ""


check_alone = transverse_profile._check_alone


@catches("a second contact that is not seen", side=1).at(
    "validation.railway.scenes.transverse_profile._check_alone", lambda *arguments: None
)
@catches("surfaces that do not give way beside the contact", side=1).at(
    "validation.railway.scenes.transverse_profile._check_alone", lambda *of: check_alone(*of[:3], 0.0)
)
@pytest.mark.parametrize("side", [1, -1])
def test_a_second_contact_is_refused_and_a_second_top_that_does_not_touch_is_none(side):
    """The approach is 65.6 um; 30 mm beside the contact the surfaces give way by F / (pi E* r) = 4.6 um."""
    assert second_contact(0.0614, 5e4, side) == second_contact(0.058, 3e4, side) == ""
    said = rf"one contact under the load, got a second one {re.escape(f'{30 * side:+}')} mm beside .* overlap by 0\.39"
    assert re.search(said, second_contact(0.0606, 5e4, side))


moved = TransverseProfile.moved


@catches("a wheel moved to the other side").at(
    "validation.railway.scenes.transverse_profile.TransverseProfile.moved",
    lambda profile, offset: moved(profile, -offset),
)
@catches("contact where the rail alone is highest").at(
    f"{__name__}.both_together", lambda bodies, *other: right_both_together(bodies[:1], *other)
)
def test_two_bodies_touch_where_both_together_are_highest():
    """-(y^2 / 600 + (y - 6)^2 / 1200) at y = 2 mm; a crown of 300 mm is as steep as a cone of 1 in 100 at 3 mm."""
    rail, cone = profile_of(parabola(300.0)), profile_of(-Y / 100)
    assert both_together([rail, profile_of(parabola(600.0)).moved(6e-3)], 0.0).at == pytest.approx(2e-3, abs=3e-6)
    assert both_together([rail], 1 / 0.6, 6e-3).at == pytest.approx(2e-3, abs=3e-6)
    for offset in (0.0, 5e-3, -5e-3):
        assert both_together([rail, cone.moved(offset)], 0.0).at == pytest.approx(-3e-3, abs=3e-6)


@pytest.mark.parametrize(("shift", "count"), [(3e-4, 101), (5e-2, 200)])
def test_both_together_reach_as_far_as_both_do_and_have_their_places_once(shift, count):
    """From -20 mm on the wheel to 30 mm on the rail. Places that differ by rounding are one, others are two [mm]."""
    y = np.arange(-20, 40.25, 0.5) + shift
    together = both_together([profile_of(parabola(300.0)), profile_of(-(y**2) / 1200, y)], 0.0)
    places = 1e3 * (np.array(together.y) + together.at)
    assert (places[0], places[-1]) == pytest.approx((-20 + shift, 30), abs=1e-9)
    assert places.size == count
    assert np.array(together.height) == pytest.approx(-(places**2) / 400 / 1e3, abs=1e-9)


@pytest.mark.parametrize("degrees", [14.0, 14.9, -14.9, 15.1, -15.1])
@catches("the tangent of an inclination for the angle", degrees=14.0).at(
    "validation.railway.scenes.transverse_profile.math", module_with(math, atan=abs)
)
def test_a_contact_on_a_flank_is_refused(degrees):
    """A ball touches a plane at its top, from where both are inclined by so much, to either side."""
    slope = math.tan(math.radians(degrees))
    bodies = profile_of(parabola(100.0) + slope * Y), profile_of(-slope * Y)
    said = r".* must touch where both are level, to 15 degrees, .* on a flank of 15\.1 degrees"
    assert re.match(said if abs(degrees) > 15 else "$", refusal(partial(both_together, bodies, 0.0)))
    if abs(degrees) < 15:
        assert both_together(bodies, 0.0).inclination == pytest.approx(math.radians(abs(degrees)), abs=1e-4)


def test_flanks_that_turn_back_are_left_out_and_told(tmp_path):
    """The back of a flange and the side of a head are vertical: no heights over y."""
    back = "".join(f"-69,{height}\n" for height in (3, 9))
    (tmp_path / "head.csv").write_text(table(head(RAIL_Y), RAIL_Y) + "\n35,-14\n34.95,-20\n20,-34\n", encoding="utf-8")
    (tmp_path / "tread.csv").write_text(
        "y [mm],z [mm]\n" + back + table(tread(WHEEL_Y, 0.01), WHEEL_Y).partition("]\n")[2], encoding="utf-8"
    )
    scene = load_scene(written(tmp_path, (CROWN, PROFILE), ('load = "', 'profile = "tread.csv"\nload = "')))
    assert scene.profile.at == pytest.approx(-3e-3, abs=2e-5)
    assert "tread.csv: it goes from -69 mm to 60 mm across: 2 points that turn back are left out." in scene.notes
    assert "head.csv: it goes from -35 mm to 35 mm across: 3 points that turn back are left out." in scene.notes


NUMBERED = "no,y [mm],z [mm]\n" + "\n".join(f"7,{y},{z:.9g}" for y, z in zip(Y, parabola(300.0), strict=True))


@pytest.mark.parametrize(
    ("contents", "keys"),
    [
        (NUMBERED, 'columns = ["y", "z"]'),
        (NUMBERED, ""),
        (table(Y, parabola(300.0), "height [mm],y [mm]"), ""),
        (table(-parabola(300.0)), "flip = true"),
        (table(parabola(300.0), header="lateral,vertical"), 'unit = "mm"'),
        (table(parabola(300.0, 7.3)[::-1] / 1e3, Y[::-1] / 1e3, "y_m;height_m").replace(",", ";"), ""),
        (table(parabola(300.0) / 10, Y / 10, "y [cm];z [cm]").replace(",", ";").replace(".", ","), 'decimal = ","'),
        ("a;b\nno numbers;x\n" + table(parabola(300.0), header="").replace(",", "\t"), 'unit = "mm"\nskip = 2'),
    ],
)
def test_a_profile_is_a_table_of_keys(tmp_path, contents, keys):
    (tmp_path / "head.csv").write_text(contents, encoding="utf-8")
    text = f'[rail.profile]\nfile = "head.csv"\n{keys}\n[rail.levels]'
    scene = load_scene(written(tmp_path, (CROWN, ""), ("[rail.levels]", text)))
    assert scene.radii[1] == pytest.approx(0.3, rel=1e-4)


def test_columns_beside_two_lengths_are_asked_for(tmp_path):
    with pytest.raises(ValueError, match=r"two columns, .* got no and y and z: .*columns = \[2, 3\]"):
        with_profile(tmp_path, NUMBERED.replace(" [mm]", ""))


def test_noise_of_a_scan_is_smoothed_and_told(tmp_path):
    """3 um on points every 0.1 mm, as a laser has: over a contact of 8 mm they leave the radius to a few per cent."""
    y = np.arange(-30, 30.01, 0.1)
    scan = -(y**2) / 600 + 0.003 * np.random.default_rng(4).standard_normal(y.size)
    scene = with_profile(tmp_path, table(scan, np.round(y + 0.02 * np.sin(7e3 * y), 3)))
    assert scene.radii[1] == pytest.approx(0.3, rel=0.06)
    assert abs(scene.profile.at) < 1e-3
    (note,) = scene.notes
    off = re.search(r"head\.csv: .*a spline with a knot every 1 mm smooths its points, which are (\S+) µm rms", note)
    # the spline takes a tenth of the freedom of the points; they are printed to two digits
    assert off is not None and float(off[1]) == pytest.approx(3 * math.sqrt(0.9), rel=0.08)


def test_a_radius_is_that_of_the_contact_where_noise_has_smaller_ones():
    """Five points of a noisy top have any radius, in which a tiny contact would fit, too."""
    y = np.arange(-30, 30.01, 0.05)
    noisy = -(y**2) / 600 + 0.006 * np.random.default_rng(3).standard_normal(y.size)
    assert radius_of(profile_of(noisy, y - y[noisy.argmax()])) == pytest.approx(0.3, rel=0.05)
