"""Contact filters of a wheel on a rail: long waves, ridges, scaling with the load, and the errors that they claim."""

import math
from dataclasses import replace

import numpy as np
import pytest

import mdr
from tests.seeded import Times, catches
from validation import compare, load_scene
from validation.advice.models_of_scene import all_quantities
from validation.advice.scene_model import SceneModel
from validation.railway.problems import equivalent_displacement, rail_models
from validation.railway.problems.equivalent_displacement import (
    ONE_SIDED,
    Corrugation,
    RolledRail,
    linear_displacement,
    roll_corrugation,
    roll_rail,
)
from validation.railway.problems.rail_models import COARSE, FINE, RailModel
from validation.railway.problems.rail_quantity import RAIL_QUANTITIES, RailQuantity
from validation.railway.problems.rail_strip import strip_of
from validation.railway.scenes.level_files import RoughnessLevels, curve
from validation.railway.scenes.measured_lines import MeasuredLines
from validation.railway.theory.contact_filters import corrugation_harmonic, corrugation_harmonic_of_springs
from validation.railway.theory.transverse_structure import IsotropicGround
from validation.simulation.model import Target, models_serving
from validation.simulation.model_names import (
    BED,
    LINEAR,
    LINEAR_ON_LINE,
    ONE_SIDED_BED,
    SPRINGS_GEIKE,
    SPRINGS_ROLLING,
    twin_of,
)
from validation.theory.half_space import elliptic_contact

RAIL = load_scene("rail")
LINES = (SPRINGS_ROLLING, LINEAR_ON_LINE, LINEAR)
EXACT_OVER_RIDGES = (LINEAR, LINEAR_ON_LINE, "springs on the line", "springs that read the surface", SPRINGS_ROLLING)


def closed(scene, across, *names):
    """A3 of the linear filter, or twin, of each model, or of those with these names."""
    quantity = RailQuantity(replace(scene, lateral_structure=across), "contact-filter")
    models = models_serving(quantity.scene, "contact-filter")
    return quantity, {
        model.name: model.filter.closed(quantity)[0] for model in models if model.name in names or not names
    }


@catches("long waves that do not pass under springs on the rolling spectrum", across="isotropic").at(
    "validation.railway.problems.equivalent_displacement.rolling_input_filter", Times(1.1)
)
@pytest.mark.parametrize("across", ["ridges", "isotropic", 0.5, None])
def test_long_waves_pass_under_every_model_but_springs_on_geikes_spectrum(across):
    quantity, filters = closed(RAIL, across)
    long = quantity.wave < 0.05
    assert long.sum() >= 5 and SPRINGS_ROLLING in filters
    assert (filters.pop(SPRINGS_GEIKE, None) is None) == (across in ("ridges", 0.5))
    for name, a3 in filters.items():
        np.testing.assert_allclose(a3[long], 0.0, atol=0.03, err_msg=name)


def falling(exponent):
    """The rail with C_line ~ q^-p in all bands."""
    q, n = RAIL.levels.bands.edges, exponent - 1
    powers = 2e-9 * np.diff(np.log(q) if n == 0 else -(q**-n) / n)
    return replace(RAIL, roughness=RoughnessLevels.of_powers(RAIL.levels.bands, powers, source="a power law"))


@catches("the line trace taken for Geike's spectrum under springs on a rail", exponent=2.0).at(
    "validation.railway.problems.equivalent_displacement.geike_over_line",
    lambda wavenumber, ground: np.ones_like(wavenumber),
)
@pytest.mark.parametrize("exponent", [1.0, 2.0, 2.5])
def test_long_waves_under_springs_on_geikes_spectrum_are_off_by_his_rule_over_the_line(exponent):
    """10 lg(pi q C_2D / C_line) of a power law: 0, 2.0 and 2.5 dB, however long the wave; others have 0 dB."""
    quantity, filters = closed(falling(exponent), "isotropic", SPRINGS_GEIKE, LINEAR)
    long = quantity.wave < 0.05
    off = 10 * math.log10(math.sqrt(math.pi) * math.gamma((exponent + 1) / 2) / math.gamma(exponent / 2))
    np.testing.assert_allclose(filters[SPRINGS_GEIKE][long], off, atol=0.03)
    assert (np.abs(filters[LINEAR][long] - off) > 1).all() == (exponent > 1)


def surface_itself(along, across, *, semi_axes):
    """The line, whose level is too high for short waves."""
    return np.ones_like(along + across)


@catches("the line taken for the rolling spectrum of a rail").at(
    "validation.railway.problems.equivalent_displacement.rolling_input_filter", surface_itself
)
def test_short_waves_under_springs_on_the_rolling_spectrum_have_the_level_of_the_half_space():
    """On a circle, in the mean over bands, since zeros of springs do not fill; the line is (p + 1) / p too loud."""
    quantity, filters = closed(replace(falling(2.0), crown_radius=0.46), "isotropic", *LINES)
    short = quantity.wave > 10
    over = {name: float((filters[name] - filters[LINEAR])[short].mean()) for name in LINES}
    assert over[SPRINGS_ROLLING] == pytest.approx(0.0, abs=0.3)
    assert over[LINEAR_ON_LINE] - over[SPRINGS_ROLLING] == pytest.approx(10 * math.log10(1.5), abs=0.05)


@pytest.mark.parametrize("across", ["ridges", "isotropic", 0.7])
def test_lines_along_a_strip_have_the_spectrum_of_the_levels(across):
    """Two-sided, on any grid: of each wave along the sum over all waves across, over the cell of its wavenumber."""
    for cells, q in ((6, 150.0), (10, 400.0)):
        strip = strip_of(RAIL, across, cells, 0, 3)
        k = 2 * np.pi * np.fft.fftfreq(strip.shape[0], strip.spacing)
        near = np.abs(k - q) < 30
        found = strip.variance[near].sum(axis=1) * strip.length / (2 * np.pi) / RAIL.levels.c_line(k[near])
        assert found.mean() == pytest.approx(1.0, rel=0.1), (cells, q)


@pytest.mark.parametrize("across", ["isotropic", None])
@pytest.mark.parametrize("band", [0, 20, 34])
def test_a_level_that_stands_for_nothing_costs_its_own_band_alone(band, across):
    """-99 dB, as files have it where nothing was measured: the spectrum falls by a hundred decibels in a band."""
    levels = list(RAIL.levels.levels)
    levels[band] = -99.0
    empty = replace(RAIL, lateral_structure=across, roughness=replace(RAIL.levels, levels=tuple(levels)))
    found, own = (RailQuantity(one, "contact-filter") for one in (empty, replace(RAIL, lateral_structure=across)))
    others = (np.abs(np.arange(35) - band) > 1) & own.counted(own.linear.mean(axis=0))
    # what falls steeply beyond the last wave is a spectrum that isotropic ground can have
    assert found.no_answer == "" and found.stands_out[band] == (band < 34)
    off = np.abs(found.linear.mean(axis=0) - own.linear.mean(axis=0))
    assert (off <= found.left_by_ground + 0.1)[others].all()


@pytest.mark.parametrize("name", ["sphere", "rough_punch", "rolling_wheel", "table_14_1", "rail"])
def test_contact_filters_are_models_of_a_rail_and_of_its_quantities_alone(name):
    for quantity in all_quantities():
        found = [model for model in models_serving(load_scene(name), quantity) if isinstance(model, RailModel)]
        assert len(found) == (11 if name == "rail" and quantity in RAIL_QUANTITIES else 0), quantity


borne_by = equivalent_displacement.borne_by


@catches("a bed of springs under another load", model=ONE_SIDED_BED).at(
    "validation.railway.problems.equivalent_displacement.borne_by",
    lambda levels, wanted: borne_by(levels, 1.5 * wanted),
)
@pytest.mark.slow
@pytest.mark.parametrize("model", ONE_SIDED)
def test_one_sided_models_follow_their_linear_twin_on_a_smoother_rail(model):
    """Where no spring lets go, springs that do not pull are those that do, of first order in the cells and more."""
    smoother = replace(RAIL, roughness=RAIL.levels.raised(-60.0))
    of_first = 0.02 if model == ONE_SIDED_BED else 0.1
    for cells, error in ((6, of_first), (12, of_first / 2)):
        strip = strip_of(smoother, "isotropic", cells, 0, 3)
        found = roll_rail(RolledRail(strip=strip, models=(model,)))
        twin = found[twin_of(model)]
        assert np.abs(found[model] - twin).max() < error * np.abs(twin).max() and found["failed"] == 0
    # tracks of input spectra are others than the line itself
    if model in (SPRINGS_ROLLING, SPRINGS_GEIKE):
        assert np.abs(linear_displacement(strip, LINEAR_ON_LINE) - twin).max() > 0.05 * np.abs(twin).max()


def share_of_oblique_waves(along, across, *, semi_axes):
    """sqrt(e(S)), which is not over e(k_x a_x): waves along the track are filtered twice."""
    return 1 / np.sqrt(1 + (along * semi_axes[0]) ** 2 + (across * semi_axes[1]) ** 2)


@catches("the rolling spectrum of a rail that filters ridges").at(
    "validation.railway.problems.equivalent_displacement.rolling_input_filter", share_of_oblique_waves
)
@catches("20 lg of a ratio of powers").at("validation.railway.problems.rail_quantity.RailQuantity.filtered", Times(2.0))
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


@catches("a ground that is not given taken for known").at(
    "validation.railway.problems.rail_quantity.RailQuantity.half_width", property(lambda quantity: 0 * quantity.wave)
)
def test_ground_that_is_not_given_is_a_band_between_ridges_and_isotropic_ground():
    both = compare(replace(RAIL, lateral_structure=None), quantity="contact-filter", tolerance="3 dB")
    ends = [closed(RAIL, across)[1][LINEAR] for across in ("ridges", "isotropic")]
    quantity = RailQuantity(replace(RAIL, lateral_structure=None), "contact-filter")
    np.testing.assert_allclose(quantity.half_width, np.abs(ends[0] - ends[1]) / 2)
    linear = next(one for one in both.models if one.name == LINEAR)
    assert linear.predicted_error > rail_models.relative(float(quantity.half_width[quantity.counted(ends[1])].max()))
    assert "lateral_structure is not given" in linear.reason


@catches("errors of contact filters claimed beyond where they were measured").at(
    "validation.railway.problems.rail_models.MOST_LOST", 10.0
)
def test_beyond_what_was_measured_no_error_is_claimed():
    rough = replace(RAIL, roughness=RAIL.levels.raised(25.0))
    narrow = replace(RAIL, crown_radius=0.05)
    for scene, word in ((rough, "h' a_x / d"), (narrow, "a_y / a_x")):
        for model in models_serving(scene, "contact-filter"):
            claimed = model.estimate(Target(scene, "contact-filter"), model.resolutions(Target(scene))[0])
            assert claimed.in_range == (model.name == "boundary elements"), model.name
            assert claimed.in_range or word in claimed.reason


@catches("the error of linear theory claimed by every contact filter").at(
    "validation.railway.problems.rail_models.ContactFilter.model_error",
    lambda model, quantity, a3: rail_models.linear_error(quantity),
)
def test_a_model_that_differs_from_linear_theory_says_by_how_much():
    quantity, filters = closed(RAIL, "isotropic")
    for name in (BED, LINEAR_ON_LINE, "Remington"):
        apart = np.abs(filters[name] - filters[LINEAR])
        model = next(one for one in models_serving(RAIL, "contact-filter") if one.name == name)
        error = model.filter.model_error(quantity, filters[name])
        assert (error >= apart).all() and apart.max() > 1


@pytest.mark.parametrize("across", ["isotropic", None])
@pytest.mark.parametrize("lines", [1, 3])
def test_measured_lines_of_isotropic_ground_have_its_filter(lines, across):
    """Bands of lines scatter: no isotropic surface has them as they are, one has them smoothed."""
    bands, rng = RAIL.levels.bands.within(1.0, 2.5e-3), np.random.default_rng(0)
    q, weight = bands.quadrature()
    sigma, x = np.sqrt(2 * 2 * weight * RAIL.levels.c_line(q)), 1e-3 * np.arange(4000)
    height = np.zeros((x.size, lines))
    for k, s in zip(q.ravel(), sigma.ravel(), strict=True):
        a, b = s * rng.standard_normal((2, lines)) / math.sqrt(2)
        height += np.outer(np.cos(k * x), a) + np.outer(np.sin(k * x), b)
    measured = MeasuredLines(height=height, spacing=1e-3, positions=tuple(range(lines)))
    found = RailQuantity(replace(RAIL, roughness=measured, lateral_structure=across), "contact-filter")
    # three lines a metre apart are alike in nothing: alpha is anything, and isotropic ground is no end
    assert found.no_answer == "" and (found.smoothing_error > 0).all() == (found.scene.measured_structure is None)
    with pytest.raises(ValueError, match="no isotropic surface has this line"):
        IsotropicGround(measured.levels.c_line)
    own = RailQuantity(replace(RAIL, lateral_structure=across), "contact-filter").linear.mean(axis=0)
    own = own[np.isin(RAIL.levels.bands.numbers, found.bands.numbers)]
    off, claimed = np.abs(found.linear.mean(axis=0) - own), found.left_by_ground + rail_models.linear_error(found)
    assert (off <= claimed)[own > -15].all()
    assert (found.left_by_ground >= found.smoothing_error).all()


def test_levels_without_a_wave_of_the_length_of_the_contact_are_rejected():
    long = replace(RAIL.levels, wavelengths=RAIL.levels.wavelengths[:15], levels=RAIL.levels.levels[:15])
    with pytest.raises(ValueError, match=r"a wavelength of the roughness, 2 m to 80 mm, got .* shorter waves"):
        replace(RAIL, roughness=long)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "across"), [("springs that read the surface", "ridges"), ("boundary elements", "isotropic")]
)
def test_springs_and_boundary_elements_agree_with_linear_theory_within_their_claims(name, across, monkeypatch):
    # coarser than those of an answer, in the same ratio: what the grid leaves is claimed with it
    monkeypatch.setattr(rail_models, "COARSE", COARSE * 3 // 4)
    monkeypatch.setattr(rail_models, "FINE", FINE * 3 // 4)
    monkeypatch.setattr(rail_models, "STRIPS", 3)
    scene = replace(RAIL, lateral_structure=across, roughness=curve("iso3095-2013"))
    quantity = RailQuantity(scene, "contact-filter")
    expected, counted = quantity.linear[0], quantity.counted(quantity.linear[0])
    model = next(one for one in models_serving(scene, "contact-filter") if one.name == name)
    target = Target(scene, "contact-filter", 0.1)
    answer = SceneModel(model, target, model.resolutions(target)[0]).solve()
    assert not answer.failed
    claim = rail_models.linear_error(quantity) + answer.band_errors["grid"] + answer.band_errors["sample"]
    assert (np.abs(20 * np.log10(answer.value) - expected) <= claim)[counted].all()


def test_the_cost_of_a_closed_filter_goes_with_its_evaluations():
    """Of a soft wheel, whose contact is hundreds of waves wide."""
    target = Target(replace(RAIL, modulus=1e6, material=None, lateral_structure=None), "contact-filter")
    model = next(one for one in models_serving(target.scene, "contact-filter") if one.name == LINEAR)
    evaluations = RailQuantity(target.scene, "contact-filter").evaluations
    assert 1e6 < evaluations < 4e6
    assert model.cost(target, model.resolutions(target)[0]).seconds >= rail_models.EVALUATION * evaluations


@catches("the edge at two points in place of a circle", phase=2.4).at(
    f"{__name__}.corrugation_harmonic", corrugation_harmonic_of_springs
)
@pytest.mark.parametrize("phase", [0.8, 2.4])
def test_the_half_wavelength_of_a_corrugation_is_that_of_boundary_elements(phase):
    """At A/d = 0.1 on a circle, beside a closed second order without a parameter; the fourth order is a per cent."""
    rolled = roll_corrugation(Corrugation(phase=phase, height=0.1, cells=12))
    assert rolled["failed"] == 0
    assert rolled["second"] == pytest.approx(float(corrugation_harmonic(phase)), abs=0.012)
    assert rolled["first"] == pytest.approx(math.sin(phase) / phase, abs=0.01)


def test_the_half_wavelength_of_a_corrugation_on_springs_is_that_of_rolled_springs():
    """On fine springs at A/d = 0.02; and long waves, which lift the wheel as a whole, make none."""
    phase, a = 1.2, 1.0
    points, waves_along = 4000, 1
    height = 0.02 * np.cos(2 * np.pi * np.arange(points) / points)
    track = mdr.roll(height, spacing=2 * np.pi * a / phase / points, radius=1.0, modulus=1.0, force=4 / 3)
    second = 2 * np.fft.rfft(track.approach.mean() - track.approach, norm="forward").real[2 * waves_along] / 0.02**2
    assert second == pytest.approx(float(corrugation_harmonic_of_springs(phase)), abs=0.003)
    for harmonic in (corrugation_harmonic, corrugation_harmonic_of_springs):
        assert abs(float(harmonic(1e-3))) < 1e-5
