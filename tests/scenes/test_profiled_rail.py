"""A rail or a wheel whose shape across was measured: files, the radius that is fitted, and what is refused."""

import math
import re

import numpy as np
import pytest

from tests.scenes.test_rail_files import written
from validation.scenes.description import describe
from validation.scenes.load import load_scene
from validation.scenes.profiled_rail import ProfiledRail
from validation.scenes.transverse_profile import TransverseProfile, both_together, fitted_radius

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
    assert dict(describe(scene))["wheel and rail"] == (
        "profile of head.csv across, radius 300 mm fitted over the contact"
    )
    assert scene.diagnose() == (
        "the transverse profile of head.csv has a radius of 300 mm, fitted over the contact, 4.28 mm to both sides: "
        "boundary elements of compare take the profile, all other models that radius.",
    )


@pytest.mark.parametrize("unit", [1.0, 1e3])
def test_units_order_and_place_of_a_file_do_not_matter(tmp_path, unit):
    header = "y_m;height_m" if unit == 1e3 else "y [mm];height [mm]"
    text = table(parabola(300.0, top=7.3)[::-1] / unit, Y[::-1] / unit, header).replace(",", ";")
    assert with_profile(tmp_path, text).radii[1] == pytest.approx(0.3, rel=1e-4)


def profile_of(height, y=Y):
    return TransverseProfile(y=tuple(y / 1e3), height=tuple(height / 1e3))


@pytest.mark.parametrize("load", [5e3, 5e4, 2e5])
def test_a_parabola_has_its_radius_under_any_load(load):
    assert fitted_radius(profile_of(parabola(300.0)), along=0.46, modulus=STEEL, load=load) == pytest.approx(0.3)


def test_a_hollow_wheel_and_a_crown_are_one_profile():
    """1 / 200 - 1 / 600 = 1 / 300 mm, of two profiles and of a profile and a radius."""
    crown, hollow = profile_of(parabola(200.0)), profile_of(-parabola(600.0) - 1e-6 * Y**4)
    bodies = both_together([crown], -1 / 0.6), both_together([profile_of(parabola(200.0) - parabola(600.0))], 0.0)
    for together in bodies:
        assert fitted_radius(together, along=0.46, modulus=STEEL, load=5e4) == pytest.approx(0.3)
    with pytest.raises(ValueError, match="must have places in common"):
        both_together([crown, profile_of(parabola(300.0), Y + 1000)], 0.0)
    assert hollow.radius_within(5e-3) == math.inf


def test_a_radius_is_fitted_over_the_contact_and_not_over_the_whole_head():
    light, heavy = (fitted_radius(profile_of(worn(Y)), along=0.46, modulus=STEEL, load=load) for load in (1e3, 5e4))
    assert light == pytest.approx(0.3, rel=0.01)
    assert 0.15 < heavy < 0.2


def test_curvatures_of_wheel_and_rail_add(tmp_path):
    scene = with_profile(tmp_path, table(parabola(300.0)), ('load = "', 'transverse_radius = "600 mm"\nload = "'))
    assert scene.radii[1] == pytest.approx(0.2, rel=1e-6)
    (tmp_path / "tread.csv").write_text(table(parabola(600.0)))
    scene = with_profile(tmp_path, table(parabola(300.0)), ('load = "', 'profile = "tread.csv"\nload = "'))
    assert scene.radii[1] == pytest.approx(0.2, rel=1e-6)
    assert scene.profile.source == "head.csv and tread.csv"
    (tmp_path / "wheel.toml").write_text(
        written(tmp_path, (CROWN, ""), ('load = "', 'profile = "tread.csv"\nload = "')).read_text()
    )
    assert load_scene(tmp_path / "wheel.toml").radii[1] == pytest.approx(0.6, rel=1e-6)


@pytest.mark.parametrize(
    ("contents", "said"),
    [
        ("", "must hold rows of numbers, got an empty file"),
        (table(parabola(300.0), header="y,height"), "columns must be named as 'y [mm],height [mm]', with their units"),
        (table(parabola(300.0), header="height [mm],y [mm]"), "y must ascend"),
        (table(parabola(300.0), header="y [N],height [mm]"), "columns must be lengths, got y [N]"),
        (table(parabola(300.0)).replace("-30,", "-30;1,"), "rows must be numbers, got '-30;1' in column 1 of line 3"),
        (table(parabola(300.0)) + "\n31,2,3", "rows must be of one length, got 3 cells in line 124 of a table of 2"),
        (table(parabola(300.0)[:5], Y[:5]), "profile must have 7 to 100000 points"),
        (table(parabola(300.0)) + "\n29,1", "y must ascend, got 0.029 m behind 0.03 m"),
        (table(-parabola(300.0)), "must be highest between its ends, -30 and 30 mm, got its highest point at -30 mm"),
        (table(parabola(300.0)[40:80:8], Y[40:80:8]), "profile must have 7 to 100000 points"),
        (
            table(parabola(300.0)[::5], Y[::5]),
            "profile must have 5 points in the contact at the least, got so many within 5 mm",
        ),
        (table(parabola(1e9)), "profile must reach to twice the contact"),
        (
            table(parabola(300.0)[50:71], Y[50:71]),
            "profile must reach to twice the contact and have 5 points in it at the least, got 5 mm",
        ),
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
