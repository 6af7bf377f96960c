"""Where a wheel has no steady level: foretold by theory, and seen in wheels that roll."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from tests.report.test_command_line import SMALL
from tests.seeded import Times, catches, module_with
from validation.__main__ import main
from validation.report.contents import CASES
from validation.scenes.bundled import SCENES
from validation.scenes.load import load_scene, load_scene_with_track
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.rolling import RollingScene
from validation.scenes.wheel_body import force_on_the_way
from validation.simulation.wheel_on_springs import WheelEnsemble, _motion

TABLE = load_scene_with_track("table_14_1")
TOML = (SCENES / "table_14_1.toml").read_text(encoding="utf-8")


def scene(height, *, ratio=None, longest=10e-3, waves=3, springs=10, distance=2.0):
    """Table 14.1 with roughness of some approaches in a band of waves; ratio: of q_min v_0 to the resonance."""
    rail = replace(TABLE.rail, rms=height * TABLE.approach, longest=longest, shortest=longest / waves)
    speed = TABLE.speed if ratio is None else ratio * TABLE.eigenfrequency / rail.q_min
    return replace(TABLE, ground=rail, speed=speed, springs=springs, distance=distance)


def rolled(wheels):
    """Growth of the acceleration from the first quarter of the way to the last, and the share in the air there."""
    motion, _ = _motion(WheelEnsemble(scene=wheels, count=8, seed=1))
    first, *_, last = np.array_split(motion.acceleration, 4)
    gravity = wheels.load / wheels.mass
    return math.sqrt(np.mean(last**2) / np.mean(first**2)), float(np.mean(last <= -gravity))


def test_shipped_wheels_are_steady():
    for name in ("table_14_1", "rough_wheel"):
        assert load_scene_with_track(name).no_steady_answer() == ""
    assert load_scene("table_14_1").no_steady_answer() == load_scene("rolling_wheel").no_steady_answer() == ""
    assert replace(TABLE, ground=None).no_steady_answer() == ""


@pytest.mark.slow
@pytest.mark.parametrize(("ratio", "grows"), [(0.5, True), (0.8, True), (1.2, False), (2.5, False)])
def test_the_level_grows_where_the_resonance_is_among_the_waves(ratio, grows):
    wheels = scene(0.003, ratio=ratio, distance=4.0)
    assert wheels.no_steady_answer().startswith("nothing damps the wheel, and its resonance, 1369 rad/s,") == grows
    growth, air = rolled(wheels)
    assert air == 0
    # a random force feeds a resonance as the root of the way: 2.6 from the mean of one quarter to that of the last
    assert growth > 1.8 if grows else growth == pytest.approx(1.0, abs=0.1)


@catches("a flight that nobody foretells", height=0.33, longest=30e-3, said="by linear theory").at(
    "validation.scenes.wheel_body.MAX_FORCE", math.inf
)
@pytest.mark.parametrize(
    ("height", "longest", "said"),
    [(1.0, 10e-3, "the roughness is"), (0.33, 30e-3, "by linear theory"), (0.15, 10e-3, "")],
)
def test_flight_is_predicted(height, longest, said):
    wheels = scene(height, longest=longest)
    assert wheels.no_steady_answer().startswith(said)
    assert bool(wheels.no_steady_answer()) == bool(said)
    _, air = rolled(wheels)
    assert (air > 1e-3) == bool(said)


@pytest.mark.slow
@pytest.mark.parametrize(("longest", "grows"), [(2e-3, True), (10e-3, False)])
def test_note_of_short_waves_that_excite_the_free_vibration(longest, grows):
    wheels = scene(0.25, longest=longest, springs=20)
    assert wheels.no_steady_answer() == ""
    told = [doubt for doubt in wheels.diagnose() if "excites the free vibration" in doubt]
    assert bool(told) == grows
    assert wheels.for_compare().diagnose() == tuple(told)
    growth, _ = rolled(wheels)
    assert growth > 1.4 if grows else growth < 1.3


def force_by_a_plain_sum(wheels, ground):
    a, zeta, edges = wheels.contact_radius, wheels.damping, np.geomspace(ground.q_min, ground.q_max, 400_001)
    q = np.sqrt(edges[1:] * edges[:-1])
    r = wheels.eigenfrequency / (q * wheels.speed)
    gain = (1 + (2 * zeta * r) ** 2) / ((1 - r**2) ** 2 + (2 * zeta * r) ** 2)
    density = (2 * wheels.modulus * np.sin(q * a) / q) ** 2 * np.pi * q * ground.c2d(q) * gain
    return math.sqrt(2 * np.sum(density * np.diff(edges)))


@catches("half of the force that throws a wheel", ratio=9.0, zeta=0.0).at(
    "validation.scenes.wheel_body.force_spectrum_1d", Times(0.25)
)
@pytest.mark.parametrize(
    ("ratio", "zeta"), [(0.2, 0.0), (1.05, 0.0), (9.0, 0.0), (0.5, 0.01), (0.5, 0.2), (2.0, 0.2), (9.0, 0.2)]
)
def test_the_force_on_the_way_against_a_plain_sum(ratio, zeta):
    """Of a damped wheel also with the resonance among the waves, where it is finite."""
    wheels = replace(scene(0.1, ratio=ratio), damping=zeta)
    rail, expected = wheels.rail, force_by_a_plain_sum(wheels, wheels.rail)
    assert force_on_the_way(wheels.body, wheels.speed, [rail]) == pytest.approx(expected, rel=1e-4)
    # independent roughness adds by squares
    both = force_on_the_way(wheels.body, wheels.speed, [rail, replace(rail, rms=2 * rail.rms)])
    assert both == pytest.approx(math.sqrt(5) * expected, rel=1e-4)


@pytest.mark.parametrize(
    "ground",
    [
        replace(TABLE.rail, longest=1e-4, shortest=2e-5),
        MeasuredHeights(height=np.random.default_rng(2).standard_normal((32, 32)), spacing=(1e-4, 1e-4)),
    ],
    ids=["short waves", "rings of measured heights"],
)
def test_the_force_of_waves_that_are_shorter_than_the_contact(ground):
    """Many zeros of sin(q a), and a spectrum with steps."""
    expected = force_by_a_plain_sum(TABLE, ground)
    assert force_on_the_way(TABLE.body, TABLE.speed, [ground]) == pytest.approx(expected, rel=1e-4)


def test_the_force_on_the_way_is_infinite_at_the_resonance():
    assert force_on_the_way(TABLE.body, 1.0, [TABLE.rail]) == math.inf


def test_the_same_scene_is_as_steady_for_model_selection():
    for wheels in (scene(0.5), scene(0.1, ratio=0.8), scene(0.1)):
        assert wheels.for_compare().no_steady_answer() == wheels.no_steady_answer()
    still = RollingScene(name="it", radius=0.5, load=1.0, modulus=1e9, ground=TABLE.rail)
    assert still.no_steady_answer() == ""


# The report of a scene


@pytest.fixture
def small(monkeypatch, without_figures):
    monkeypatch.setitem(CASES, "wheel", replace(CASES["wheel"], quick=SMALL["wheel"]))


def reported(tmp_path, *changes):
    text = TOML
    for old, new in (*changes, ("springs = 100 ", "springs = 20 "), ('"0.2 mm"', '"1 mm"')):
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / "scene.toml"
    path.write_text(text, encoding="utf-8")
    out = tmp_path / "report"
    code = main(["report", "--scene", str(path), "--out", str(out), "--workers", "1"])
    page = (out / "index.html").read_text(encoding="utf-8")
    return code, page[page.index("<body>") :], json.loads((out / "results.json").read_text(encoding="utf-8"))["scene"]


@pytest.mark.slow
@pytest.mark.parametrize(("old", "new"), [('"0.5 um"', '"8 um"'), ('"20 m/s"', '"1 m/s"')])
def test_a_scene_without_a_steady_answer_is_never_green(tmp_path, capsys, small, old, new):
    code, page, said = reported(tmp_path, (old, new))
    assert code == 3
    lines = capsys.readouterr().out.splitlines()
    assert lines[1] == f"no steady answer: {said['no steady answer']}"
    assert not any("criteria met" in line or "within tolerance" in line for line in lines)
    # and no verdict behind it
    assert "No steady answer" in page and 'class="verdict agree"' not in page and "criteria met" not in page


def test_a_name_of_a_variation_is_no_name_of_a_scene():
    with pytest.raises(ValueError, match=r"^name must be another than those of variations, .* got that$"):
        replace(CASES["wheel"].quick, scene=replace(TABLE, name="H = 0.4")).variations()


@catches("the rougher of wheel and rail for both").at(
    "validation.scenes.wheel_body.math", module_with(math, hypot=lambda *heights: max(heights))
)
def test_rail_and_wheel_are_rough_together():
    """Each alone leaves the wheel on its track; the heights of both, by squares, are more than a third of d."""
    one = scene(0.25)
    both = replace(one, wheel=one.rail)
    assert one.no_steady_answer() == ""
    assert both.no_steady_answer().startswith("the roughness is 0.354 of the approach")
    # a rough wheel may have the waves that excite the resonance, whatever the rail has
    resonance = 2 * math.pi * TABLE.speed / TABLE.eigenfrequency
    long = replace(one.rail, rms=one.rail.rms / 10, longest=1.5 * resonance, shortest=0.5 * resonance)
    assert replace(one, wheel=long).no_steady_answer().startswith("nothing damps the wheel")
