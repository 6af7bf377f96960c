"""One h' everywhere: the rms slope along the track, in one direction; and g, the rms gradient, where formulas need it.

Expected values are integrals over the spectrum written out here, or derivatives of heights as they were drawn.
"""

import math
from dataclasses import replace
from itertools import product
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np
import pytest
from scipy import integrate, special

import validation
from tests.seeded import Times, catches, catches_root_of_two
from validation.advice.compare import models_of
from validation.advice.models.rolling import RollingClaim, linear_filter_3d
from validation.advice.summary import facts
from validation.analysis.case import Outcomes
from validation.cases.limits.sweeps import LIMITS, Sweep
from validation.cases.punch.interface import Interface
from validation.cases.rolling import reduced_models as reduced_case
from validation.cases.wheel import half_space_study
from validation.railway.cases import rough_rail
from validation.railway.problems import rail_strip
from validation.railway.problems.rail_models import linear_error
from validation.railway.problems.rail_quantity import RailQuantity
from validation.railway.scenes.level_files import RoughnessLevels
from validation.report.answers.questions import QUESTIONS
from validation.scenes.description import describe
from validation.simulation import indentation, limits
from validation.simulation.model import ErrorEstimate
from validation.simulation.reduced_models import MODELS, bands_of
from validation.simulation.rough_punch import PunchRoughness
from validation.simulation.track_spectrum import self_affine

WHEEL = validation.load_scene("table_14_1")
RNG = np.random.default_rng(0)


def power_law_slope(hurst, first, last, rms=1.0):
    """h' of C_2D ~ q^(-2H-2): half of <q^2>, the mean over the spectrum, is its mean square in one direction."""
    square, whole = (integrate.quad(lambda q, p: q**p, first, last, args=n - 2 * hurst - 2)[0] for n in (3, 1))
    return rms * math.sqrt(square / whole / 2)


def slope_of_table_14_1():
    """h' a/d of what Table 14.1 and the choices beside it say: R, E and nu, M g, h, H, 10 to 0.2 mm."""
    radius, modulus, load = 0.5, 210e9 / (1 - 1 / 9), 500 * 9.81
    approach = (9 * load**2 / (16 * radius * modulus**2)) ** (1 / 3)
    slope = power_law_slope(0.7, 2 * math.pi / 10e-3, 2 * math.pi / 0.2e-3, 0.5e-6)
    return slope * math.sqrt(radius * approach) / approach


def of_wheel(scene=WHEEL):
    return half_space_study.of_wheel(SimpleNamespace(scene=scene, cells=8), 1.0)


def models_evidence(case):
    """Of what is found, the same for all strips."""
    found = {}
    for key in product(case.slopes, case.spectra):
        octaves = len(bands_of(self_affine(*key[1])).centres)
        one = {"level": RNG.lognormal(0, 0.1, (len(MODELS), octaves)), "work": np.ones(len(MODELS))}
        found[key] = [one | {"kept": np.array(1.0)}] * 3
    return reduced_case.STUDY.evidence(Outcomes(case, found))


# --- one number for one wheel ---


@catches_root_of_two("h' of a drawn surface", "validation.scenes.roughness.slope_in_one_direction")
@catches_root_of_two("h' a/d of the wheel on the page", "validation.cases.wheel.half_space_study.slope_ratio")
@catches_root_of_two("h' a/d of Table 14.1 beside spectra", "validation.cases.rolling.reduced_models.slope_ratio")
@catches_root_of_two("h' a/d of a description", "validation.scenes.description.slope_ratio")
def test_table_14_1_has_one_slope_everywhere():
    """On the page, in `compare`, under the question of the first screen, and in the units of the cases."""
    expected = slope_of_table_14_1()
    assert of_wheel()["h' a/d"] == pytest.approx(expected, rel=1e-9)
    said = f"h' a/d = {expected:.3g}"
    assert said in dict(describe(WHEEL))["rms slope h'"]
    assert f"{said}\n" in facts(validation.load_scene("table_14_1"), ["acceleration-rms"])
    of_book = models_evidence(reduced_case.CASE.quick).table(reduced_case.TABLE_14_1).where(model="h' a/d")
    assert of_book["value"] == pytest.approx([expected], rel=1e-9)
    (question,) = (one for one in QUESTIONS if one.name == "dynamic-wheel")
    assert question.of_scene == (half_space_study.WHEEL, "h' a/d")
    a, d = WHEEL.contact_radius, WHEEL.approach
    spectrum = self_affine(0.7, a * WHEEL.rail.q_min, a * WHEEL.rail.q_max)
    assert WHEEL.rms / d * spectrum.slope_along == pytest.approx(expected, rel=1e-9)


@catches_root_of_two("h' of rail and wheel", "validation.scenes.rolling.RollingScene.slope_along")
def test_slopes_of_rail_and_wheel_add_by_squares():
    both = replace(WHEEL, wheel=replace(WHEEL.rail, rms=3 * WHEEL.rail.rms))
    assert of_wheel(both)["h' a/d"] == pytest.approx(math.sqrt(10) * slope_of_table_14_1(), rel=1e-9)


# --- one number for one rail ---


RAIL, EXPONENT, LEVEL = validation.load_scene("rail"), 2.5, 2e-7


def falling_rail():
    """C_line = c q^-p in all bands."""
    bands = RAIL.levels.bands
    powers = 2 * LEVEL * -np.diff(bands.edges ** (1 - EXPONENT)) / (EXPONENT - 1)
    return replace(
        RAIL, lateral_structure="isotropic", roughness=RoughnessLevels.of_powers(bands, powers, source="a power law")
    )


def line_slope(first, last):
    """h'^2 = 2 int q^2 c q^-p dq."""
    power = 3 - EXPONENT
    return math.sqrt(2 * LEVEL * (last**power - first**power) / power)


def band_edges(longest, shortest):
    """Outer edges of nominal bands [m], factor 10^0.05 beyond their centres, as wavenumbers."""
    return 2 * math.pi / longest / 10**0.05, 2 * math.pi / shortest * 10**0.05


@catches_root_of_two("h' of a line", "validation.analysis.spectra.NominalBands.slope_of_spectrum")
@catches_root_of_two("h' of levels", "validation.railway.scenes.level_files.RoughnessLevels.slope_along")
@catches_root_of_two("the loss-of-contact number of a case", "validation.railway.cases.rough_rail.lost_contact_number")
def test_a_rail_has_one_slope_of_its_strips_and_one_of_all_bands():
    """In the description, the claims of models, and the case; of 50 to 3.15 mm, and of 2000 to 0.8 mm."""
    scene = falling_rail()
    over = scene.contact.along / scene.contact.approach
    every, strips = line_slope(*band_edges(2.0, 10**-3.1)), line_slope(*band_edges(10**-1.3, 10**-2.5))
    assert dict(describe(scene))["rms slope h'"] == (
        f"{every:.3g} along the track, of all bands, h' a_x/d = {every * over:.3g}"
    )
    assert rail_strip.strip_bands(scene).span == "50 to 3.15 mm"
    assert rail_strip.lost_contact_number(scene) == pytest.approx(strips * over, rel=1e-3)
    assert RailQuantity(scene, "contact-filter").lost == pytest.approx(strips * over, rel=1e-3)
    reasons = [model.estimate().reason for model in models_of(scene, "contact-filter", 0.1, 0)]
    assert any(f"h' a_x / d = {strips * over:.2g} of waves of 50 to 3.15 mm" in reason for reason in reasons)
    table = rough_rail.roughness(SimpleNamespace(keys=[("", 0.0, "")], scene=lambda key: scene))
    assert table["h' a_x / d"][0] == pytest.approx(strips * over, rel=1e-3)
    assert table[rough_rail.WAVES][0] == "50 to 3.15 mm"


@catches_root_of_two(
    "the loss-of-contact number of models", "validation.railway.problems.rail_quantity.lost_contact_number"
)
def test_the_error_of_linear_theory_on_a_rail_goes_with_the_slope_along():
    """0.2 min(1, q a_x) + 1.1 q a_x h' a_x / d [dB]."""
    scene = falling_rail()
    slope = line_slope(*band_edges(10**-1.3, 10**-2.5))
    waves = RAIL.levels.bands.centres * scene.contact.along
    expected = 0.2 * np.minimum(1, waves) + 1.1 * waves * slope * scene.contact.along / scene.contact.approach
    found = linear_error(RailQuantity(scene, "contact-filter"))
    assert found[waves < 9] == pytest.approx(expected[waves < 9], rel=1e-3)


# --- cases in units of a, d and E* ---


def periodic_slopes(height, spacing):
    """Rms of the derivatives along both axes."""
    waves = np.abs(np.fft.fft2(height, norm="forward")) ** 2
    q = [2 * np.pi * np.fft.fftfreq(n, spacing) for n in height.shape]
    return tuple(math.sqrt((waves * one**2).sum()) for one in (q[0][:, np.newaxis], q[1]))


@catches_root_of_two("heights at an h' a/d", "validation.cases.rolling.reduced_models.height_at", gradient=0.3)
@pytest.mark.parametrize("gradient", [0.1, 0.3, 1.0])
def test_strips_at_equal_slopes_have_them(gradient):
    """Each spectrum has the rms gradient that is sqrt 2 times h' a/d, and its h/d stands beside it."""
    case = replace(reduced_case.CASE.full, slopes=(gradient / math.sqrt(2),))
    kept = models_evidence(case).table(reduced_case.OWN_KEPT)
    assert np.unique(kept["h' a/d"]) == pytest.approx(gradient / math.sqrt(2), rel=1e-9)
    for spectrum, height in zip(case.spectra, kept["h/d"], strict=True):
        strip = case.strips_of(case.slopes[0], spectrum)[0].scene
        assert math.sqrt(2) * power_law_slope(*spectrum) * strip.height == pytest.approx(gradient, rel=1e-6)
        assert height == pytest.approx(strip.height, rel=5e-3)


# --- g, where formulas need it ---


def threshold_of(title, probe, *values, **settings):
    limit = next(limit for limit in LIMITS if limit.named.title == title)
    return Sweep.of(limit, probe(*values, **settings)).predicted_threshold


ROLLED = {"force": np.arange(4.0), "linear": np.arange(4.0), "failed": np.array(0.0)}


@catches_root_of_two(
    "the gradient of the linear filter's limit", "validation.simulation.track_spectrum.PiecewisePowerLaw.gradient"
)
@patch.object(limits, "roll_strip", lambda strip: ROLLED)
def test_the_linear_filter_in_3d_ends_where_persson_loses_a_fifth():
    """sqrt(pi / 8) g a / d = 0.2, whatever the force."""
    gradient = math.sqrt(2) * power_law_slope(limits.HURST, 1.0, 8.0)
    found = threshold_of("rough strip", limits.rough_strips, (0.1,), seed=1, length=7, strip_cells=4)
    assert found == pytest.approx(0.2 / (math.sqrt(math.pi / 8) * gradient), rel=1e-6)


@catches_root_of_two(
    "p over E* g of nine tenths in contact", "validation.cases.limits.sweeps.FULL", title="true contact area", share=0.9
)
@catches_root_of_two(
    "p over E* g of one half in contact", "validation.cases.limits.sweeps.HALF", title="mean gap", share=0.5
)
@pytest.mark.parametrize(("title", "share"), [("true contact area", 0.9), ("mean gap", 0.5)])
def test_springs_are_right_where_persson_has_a_share_in_contact(title, share):
    """erf(sqrt(2) p / (E* g)) at the threshold, g of the surface as it was drawn; p = F / L^2."""
    rough = PunchRoughness(hurst=0.7, waves=(1, 4), seed=1)
    sizes = {"cells": 16, "surfaces": 1, "profiles": 1, "seed": 1, "points": 64}
    pressure = rough.height * threshold_of(title, limits.rough_punches, (1.0,), **sizes)
    gradient = math.hypot(*periodic_slopes(rough.surface(16, 0), 1 / 16))
    assert special.erf(math.sqrt(2) * pressure / gradient) == pytest.approx(share, abs=1e-4)


@catches_root_of_two("loads of an interface by their contact", "validation.cases.punch.interface.Interface.pressures")
def test_loads_of_an_interface_have_the_contact_of_their_name():
    """erf(sqrt(2) p / (E* g)), g of a surface as it is drawn, whose waves are whole numbers a period: some per cent."""
    case = Interface()
    gradient = math.hypot(*periodic_slopes(case.roughness((8, 0.7)).surface(128, 0), 1 / 128))
    found = special.erf(math.sqrt(2) * case.height * case.pressures((8, 0.7)) / gradient)
    np.testing.assert_allclose(found, case.contacts, rtol=0.03)


@catches("a root of two lost in the gradient of a light punch", more=1.04, cells=256).at(
    "validation.simulation.indentation.rms_gradient", Times(math.sqrt(0.5))
)
@catches("a root of two gained in the gradient of a light punch", more=0.96, cells=128).at(
    "validation.simulation.indentation.rms_gradient", Times(math.sqrt(2))
)
@pytest.mark.parametrize(("more", "cells"), [(1.04, 256), (0.96, 128)])
def test_cells_of_a_light_punch_are_those_of_the_gradient(more, cells):
    """Sixteen in contact, 2 F / (E* g L^2) of all, just below and above 128 cells a side."""
    gradient = math.sqrt(2) * power_law_slope(0.7, 2 * math.pi, 8 * math.pi, 1e-3)
    ground = validation.Roughness(rms=1e-3, hurst=0.7, longest=1.0, shortest=0.25)
    load = 16 * gradient / (2 * (more * 128) ** 2)
    light = validation.IndentationScene(name="light", shape="punch", size=1.0, load=load, modulus=1.0, ground=ground)
    assert indentation.sufficient_cells(light) == cells


@catches_root_of_two("the gradient of a claim on ridges", "validation.scenes.measured_heights.MeasuredHeights.gradient")
@patch.object(RollingClaim, "estimate", lambda *_: ErrorEstimate(model=0.1, reason=""))
def test_anisotropic_heights_leave_their_gradient_open():
    """Ridges along the track, which h' does not see, are as rough as any for a filter in all directions."""
    wave = 2 * np.pi * 9 * (np.arange(64) + 0.5) / 64
    height = 1e-8 * (np.sin(wave) + 1e-3 * np.sin(wave)[:, np.newaxis])
    side = 16 * WHEEL.contact_radius
    ground = validation.MeasuredHeights(height=height, spacing=(side / 64, side / 64))
    scene = replace(validation.load_scene("table_14_1").for_compare(), ground=ground)
    found = linear_filter_3d.estimate(SimpleNamespace(scene=scene), None)
    gradient = math.sqrt(np.mean(np.diff(height, axis=1) ** 2)) / (side / 64)
    expected = gradient * WHEEL.contact_radius / WHEEL.approach
    assert found.model - 0.1 == pytest.approx(expected, rel=1e-3)
    assert f"rms gradient g a/d = {expected:.2g}" in found.reason
