"""The scene of a rail: levels, the contact that it assumes, what is told and what is refused."""

import math
import re

import numpy as np
import pytest

from tests.seeded import catches
from validation.railway.scenes import rail
from validation.railway.scenes.level_files import RoughnessLevels, curve
from validation.railway.scenes.rail import RailScene

STEEL = 210e9 / (2 * (1 - 0.3**2))
WHEEL = {"name": "wheel", "radius": 0.46, "crown_radius": 0.3, "load": 5e4, "modulus": STEEL}


def scene(**other):
    return RailScene(**{**WHEEL, "roughness": curve("iso3095-2013"), **other})


radii_of_rail = rail.RailScene.radii.fget


@catches("radii across and along that changed places").at(
    "validation.railway.scenes.rail.RailScene.radii", property(lambda scene: radii_of_rail(scene)[::-1])
)
def test_the_contact_of_the_field():
    """50 kN, 920 mm, crown 300 mm, steel: a_x = 5.68 mm along, a_y = 4.28 mm across, d = 65.6 um."""
    contact = scene().contact
    assert contact.along == pytest.approx(5.68e-3, abs=5e-6)
    assert contact.across == pytest.approx(4.28e-3, abs=5e-6)
    assert contact.approach == pytest.approx(65.6e-6, abs=5e-8)


@catches("the mean of both curvatures across for their sum").at(
    "validation.railway.scenes.rail.RailScene.radii",
    property(lambda scene: (scene.radius, 2 * radii_of_rail(scene)[1])),
)
def test_curvatures_across_add():
    assert scene(transverse_radius=0.6).radii == (0.46, pytest.approx(0.2))
    assert scene(transverse_radius=0.6, crown_radius=None).radii == (0.46, pytest.approx(0.6))
    hollow_both = {"transverse_radius": None, "crown_radius": None}
    with pytest.raises(ValueError, match="got none"):
        scene(**hollow_both)


def test_frequency_is_that_of_the_speed():
    assert scene(speed=20.0).frequency(0.02) == pytest.approx(1000.0)
    assert math.isnan(scene().frequency(0.02))


@pytest.mark.parametrize(
    ("other", "said"),
    [
        ({"load": 5e6}, "largest pressure is .* more than 4 GPa"),
        ({"load": 4e7}, "wider than the crown of the bodies: 0.115 of the radius along"),
        ({"crown_radius": 6.0, "load": 6e5}, "79.5 mm across, the head of a rail has 72 mm"),
    ],
)
def test_doubts_are_told(other, said):
    assert any(re.search(said, doubt) for doubt in scene(**other).diagnose())
    assert scene().diagnose() == ()


def test_bundled_curves_are_those_of_the_standards():
    iso, average = curve("iso3095-2013"), curve("cnossos-average")
    of = [dict(zip(levels.wavelengths, levels.levels, strict=True)) for levels in (iso, average)]
    assert (of[0][0.1], of[0][0.0315], of[0][0.0008]) == (4.9, -5.0, -14.0)
    assert (of[1][2.0], of[1][0.1], of[1][0.0008]) == (35.0, 3.5, -19.0)
    assert len(iso.levels) == len(average.levels) == 35


@catches("a level as 10 lg of the height", name="iso3095-2013").at(
    "validation.railway.scenes.level_files.RoughnessLevels.powers",
    property(lambda of: 1e-12 * 10 ** (np.array(of.levels) / 20)),
)
@catches("a spectrum of the powers of its bands, without what their slopes take", name="cnossos-average").at(
    "validation.railway.scenes.level_files.STEPS", 1
)
@pytest.mark.parametrize("name", ["iso3095-2013", "cnossos-average"])
def test_the_spectrum_has_the_power_of_each_band(name):
    levels = curve(name)
    powers = 1e-12 * 10 ** (np.array(levels.levels) / 10)
    q = np.geomspace(levels.bands.edges[0], levels.bands.edges[-1], 35 * 400 + 1)
    density = 2 * levels.c_line(q)
    steps = (density[1:] + density[:-1]) / 2 * np.diff(q)
    np.testing.assert_allclose(steps.reshape(35, 400).sum(axis=1), powers, rtol=1e-5)
    assert levels.rms == pytest.approx(math.sqrt(powers.sum()))


def test_levels_of_a_power_law_are_its_power_law():
    """C ~ q^-3: the iteration finds the law between all centres."""
    q = curve("iso3095-2013").bands.edges
    powers = 1e-9 * (q[:-1] ** -2 - q[1:] ** -2)
    levels = RoughnessLevels.of_powers(curve("iso3095-2013").bands, powers, source="law")
    places = np.array(levels.c_line.wavenumbers)
    np.testing.assert_allclose(levels.c_line.densities, 1e-9 * places**-3, rtol=1e-9)


within = RoughnessLevels.within


@catches("levels of exact centres without their end bands").at(
    "validation.railway.scenes.level_files.RoughnessLevels.within",
    lambda of, *ends: within(of, ends[0] or of.wavelengths[0], ends[1] or of.wavelengths[-1]),
)
def test_exact_centres_keep_their_bands():
    """Both ends lie off their nominal wavelengths, 10^-0.4 m below 400 mm and 10^-2.5 m above 3.15 mm."""
    exact = tuple(10 ** (-n / 10) for n in range(4, 26))
    levels = RoughnessLevels(wavelengths=exact, levels=tuple(map(float, range(4, 26))))
    assert levels.within(None, None).levels == levels.levels


def test_energies_add():
    both = curve("iso3095-2013") + curve("iso3095-2013")
    np.testing.assert_allclose(np.array(both.levels) - curve("iso3095-2013").levels, 10 * math.log10(2))
    alone = RoughnessLevels(wavelengths=(0.1, 0.08), levels=(0.0, 0.0))
    assert (alone + RoughnessLevels(wavelengths=(0.08, 0.063), levels=(0.0, 3.0))).levels == (0.0, 10 * math.log10(2))
    assert curve("iso3095-2013").raised(10.0).rms == pytest.approx(math.sqrt(10) * curve("iso3095-2013").rms)
