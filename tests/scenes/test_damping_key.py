"""The damping ratio in scene files: what is read, what is refused, where it is told."""

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from tests.scenes.test_scene_files import TABLE, written
from tests.seeded import catches
from validation.advice.exported import assumed
from validation.scenes import units
from validation.scenes.bundled import path_of
from validation.scenes.description import describe
from validation.scenes.load import load_scene, load_scene_with_track
from validation.scenes.reader import VALUES
from validation.scenes.rolling import RollingQuantity

RAIL, STILL = (path_of(name).read_text(encoding="utf-8") for name in ("rail", "rolling_wheel"))
MASS = '# mass = "500 kg"   # of a wheel that moves'


def dynamic(tmp_path, value):
    return written(tmp_path, ('mass = "500 kg"', f'mass = "500 kg"\ndamping = {value}'), text=TABLE)


def rail(tmp_path, lines):
    return written(tmp_path, (MASS, lines), text=RAIL)


@pytest.mark.parametrize(("given", "found"), [('"2 %"', 0.02), ("0.02", 0.02), ("0", 0)])
def test_a_ratio_is_read_in_per_cent_or_as_a_number(tmp_path, given, found):
    path = dynamic(tmp_path, given)
    assert load_scene_with_track(path).damping == load_scene(path).damping == found
    assert load_scene(path).body.damping == load_scene_with_track(path).body.damping == found
    assert load_scene(rail(tmp_path, f'mass = "500 kg"\ndamping = {given}')).damping == found


@catches("per cent of damping taken for the ratio").at(
    "validation.scenes.units.UNITS", units.UNITS | {"share of critical": {"%": Fraction(1)}}
)
def test_per_cent_is_a_hundredth():
    assert [VALUES["damping"]("wheel.damping", text) for text in ("2 %", "2%", "0.7 %", 0.02)] == [
        0.02,
        0.02,
        0.007,
        0.02,
    ]


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ('"-1 %"', "must be at least 0 and below 1, which is critical, got -0.01"),
        ('"100 %"', "must be at least 0 and below 1, which is critical, got 1"),
        ('"0.02"', 'must be a share of critical, as "2 %", in one of %, got'),
        ('"nan %"', "must be finite"),
        ("inf", "must be finite"),
        ("true", "must be a real number, got True"),
    ],
)
def test_other_values_are_refused_by_key_and_value(tmp_path, given, said):
    for path in (dynamic(tmp_path, given), rail(tmp_path, f'mass = "500 kg"\ndamping = {given}')):
        with pytest.raises(ValueError) as refused:
            load_scene(path)
        assert f": wheel.damping {said}" in str(refused.value)


def test_damping_needs_a_mass(tmp_path):
    still = written(tmp_path, ('load = "4905 N"', 'load = "4905 N"\ndamping = "2 %"'), text=STILL)
    for path in (still, rail(tmp_path, 'damping = "2 %"')):
        with pytest.raises(ValueError, match=r'wheel\.damping needs a mass: .* got 2 % alone, as: mass = "500 kg"'):
            load_scene(path)


def test_it_is_told_in_the_description_and_in_json(tmp_path):
    scene = load_scene(dynamic(tmp_path, '"2 %"'))
    assert dict(describe(scene))["motion"].endswith("resonance at 1369 rad/s, damping 2 % of critical")
    assert assumed(scene)["damping_ratio"] == 0.02 and assumed(load_scene("table_14_1"))["damping_ratio"] == 0
    assert "damping_ratio" not in assumed(load_scene("rolling_wheel"))
    moving = load_scene(rail(tmp_path, 'mass = "500 kg"\ndamping = "1.5 %"'))
    assert dict(describe(moving))["motion"] == "speed 80 km/h, mass 500 kg, damping 1.5 % of critical"


def test_linear_theory_of_compare_has_the_dashpot():
    scene = replace(load_scene("table_14_1"), damping=0.3)
    quantity, q = RollingQuantity(scene, "acceleration"), np.array([200.0, 3000.0])
    omega, body = 20 * q, scene.body
    c = 2 * 0.3 * math.sqrt(body.stiffness * body.mass)
    expected = omega**2 / np.hypot(body.stiffness - body.mass * omega**2, c * omega)
    assert quantity.transfer(q) == pytest.approx(expected, rel=1e-12)


def test_damping_gives_a_steady_answer_where_the_resonance_is_among_the_waves():
    slow = replace(load_scene("table_14_1"), speed=1.0, ground=replace(load_scene("table_14_1").ground, rms=2e-8))
    assert "nothing damps the wheel" in slow.no_steady_answer()
    assert replace(slow, damping=0.02).no_steady_answer() == ""
    thrown = replace(slow, damping=0.02, ground=replace(slow.rail, rms=4e-6))
    assert thrown.no_steady_answer().endswith("leaves the track, where no model was measured")
    assert thrown.for_compare().no_steady_answer() == thrown.no_steady_answer()
