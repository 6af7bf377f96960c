"""Contact filters of a wheel on a rail: long waves, ridges, scaling with the load, and the errors that they claim."""

import math
from dataclasses import replace

import numpy as np
import pytest

from validation import compare, load_scene
from validation.scenes.level_files import curve
from validation.scenes.rail import RailScene
from validation.selection.rail_model import RailSceneModel
from validation.simulation import rail_models
from validation.simulation.equivalent_displacement import BED, LINEAR, LINEAR_ON_LINE, ONE_SIDED
from validation.simulation.model import Target, models_serving
from validation.simulation.rail_quantity import RailQuantity
from validation.theory.elliptic_contact import elliptic_contact

RAIL = load_scene("rail")
assert isinstance(RAIL, RailScene)
EXACT_OVER_RIDGES = (LINEAR, LINEAR_ON_LINE, "springs on the line", "springs that read the surface")


def closed(scene, across):
    """A3 of the linear filter, or twin, of each model."""
    quantity = RailQuantity(replace(scene, across=across), "contact-filter")
    return quantity, {model.name: model.closed(quantity)[0] for model in models_serving(scene, "contact-filter")}


@pytest.mark.parametrize("across", ["ridges", "isotropic", 0.5])
def test_long_waves_pass(across):
    quantity, filters = closed(RAIL, across)
    long = quantity.wave < 0.05
    assert long.sum() >= 5
    for name, a3 in filters.items():
        np.testing.assert_allclose(a3[long], 0.0, atol=0.03, err_msg=name)


def test_over_ridges_models_are_sinc_squared_above_the_first_zero():
    """The band mean of (sin(k a_x) / (k a_x))^2 by a sum over many wavenumbers of the line's own power."""
    quantity, filters = closed(RAIL, "ridges")
    axis = elliptic_contact(RAIL.radii, modulus=RAIL.modulus, force=RAIL.load).along
    edges = quantity.bands.edges
    for i in np.flatnonzero(edges[1:] * axis < math.pi):
        q = np.linspace(edges[i], edges[i + 1], 20001)
        power = RAIL.levels.c_line(q)
        expected = 10 * math.log10(np.sum(power * (np.sin(q * axis) / (q * axis)) ** 2) / np.sum(power))
        for name in (*EXACT_OVER_RIDGES, "springs on the mean across", "boundary elements"):
            assert filters[name][i] == pytest.approx(expected, abs=0.1), (name, quantity.bands.nominal[i])
    near_zero = int(np.argmin(np.abs(quantity.wave - 2.2)))
    assert filters[BED][near_zero] > filters[LINEAR][near_zero] + 1


def test_at_fixed_aspect_the_filter_over_wavelength_and_contact_does_not_depend_on_the_load():
    """Loads in the ratio 10^(3 n / 10) move a_x by n whole bands: the same numbers, n bands later, level for level."""
    bands, flat = 3, replace(RAIL.levels, levels=(0.0,) * len(RAIL.levels.levels))
    light = replace(RAIL, roughness=flat)
    heavy = replace(light, load=RAIL.load * 10 ** (0.3 * bands))
    assert heavy.contact.along == pytest.approx(light.contact.along * 10 ** (bands / 10))
    for across in ("ridges", "isotropic", 1.0):
        one, other = closed(light, across)[1], closed(heavy, across)[1]
        for name, a3 in one.items():
            np.testing.assert_allclose(other[name][2:-bands], a3[2 + bands :], atol=0.02, err_msg=f"{name}, {across}")


def test_ground_that_is_not_given_is_a_band_between_ridges_and_isotropic_ground():
    both = compare(replace(RAIL, across=None), "contact-filter", "3 dB")
    ends = [closed(RAIL, across)[1][LINEAR] for across in ("ridges", "isotropic")]
    quantity = RailQuantity(replace(RAIL, across=None), "contact-filter")
    np.testing.assert_allclose(quantity.half_width, np.abs(ends[0] - ends[1]) / 2)
    linear = next(one for one in both.models if one.name == LINEAR)
    assert linear.claimed > rail_models.relative(float(quantity.half_width[quantity.counted(ends[1])].max()))
    assert "across is not given" in linear.reason


def test_the_limit_of_iso_3095_needs_no_boundary_elements():
    found = compare(RAIL, "contact-filter", "1 dB")
    assert found.met and found.model == LINEAR and found.unit == "dB"
    assert found.value.shape == found.wavelength_mm.shape == found.frequency_hz.shape
    np.testing.assert_allclose(found.wavelength_mm, 1e3 * np.array(RAIL.levels.wavelengths))
    np.testing.assert_allclose(found.frequency_hz, [RAIL.frequency(wave) for wave in RAIL.levels.wavelengths])
    rough = compare(RAIL, "equivalent-roughness", "1 dB")
    np.testing.assert_allclose(rough.value, found.value + RAIL.levels.levels, atol=1e-9)
    assert rough.unit == "dB re 1 µm"
    best = found.selection.best
    assert best is not None and best.answer is not None
    assert "2000 to 16 mm" in best.answer.counted
    counted = found.value > -15
    assert 20 * math.log10(1 + best.error) == pytest.approx(float(found.errors_of(best)[counted].max()))


def test_beyond_what_was_measured_no_error_is_claimed():
    rough = replace(RAIL, roughness=RAIL.levels.raised(25.0))
    narrow = replace(RAIL, crown_radius=0.05)
    for scene, word in ((rough, "h' a_x / d"), (narrow, "a_y / a_x")):
        for model in models_serving(scene, "contact-filter"):
            claimed = model.estimate(Target(scene, "contact-filter"), model.resolutions(Target(scene))[0])
            assert claimed.in_range == (model.name == "boundary elements"), model.name
            assert claimed.in_range or word in claimed.reason


def test_a_model_that_differs_from_linear_theory_says_by_how_much():
    quantity, filters = closed(RAIL, "isotropic")
    for name in (BED, LINEAR_ON_LINE, "Remington"):
        apart = np.abs(filters[name] - filters[LINEAR])
        model = next(one for one in models_serving(RAIL, "contact-filter") if one.name == name)
        error = model.model_error(quantity, filters[name])
        assert (error >= apart).all() and apart.max() > 1


def test_steep_levels_are_no_isotropic_ground():
    levels = replace(RAIL.levels, levels=tuple(-40.0 + 4 * i for i in range(20)) + (36.0,) * 15)
    model = models_serving(RAIL, "contact-filter")[0]
    target = Target(replace(RAIL, roughness=levels), "contact-filter")
    assert "no isotropic surface has this line" in model.estimate(target, model.resolutions(target)[0]).reason


@pytest.mark.slow
@pytest.mark.parametrize("across", ["ridges", "isotropic"])
def test_springs_and_boundary_elements_agree_with_linear_theory_within_their_claims(across):
    scene = replace(RAIL, across=across, roughness=curve("iso3095-2013"))
    quantity = RailQuantity(scene, "contact-filter")
    expected, counted = quantity.linear[0], quantity.counted(quantity.linear[0])
    for name in ("boundary elements", "springs that read the surface"):
        model = next(one for one in models_serving(scene, "contact-filter") if one.name == name)
        target = Target(scene, "contact-filter", 0.1)
        answer = RailSceneModel(model, target, model.resolutions(target)[0]).solve()
        assert not answer.failed
        claim = rail_models.linear_error(quantity) + answer.band_errors["grid"] + answer.band_errors["sample"]
        assert (np.abs(20 * np.log10(answer.value) - expected) <= claim)[counted].all()
        assert name in ONE_SIDED
