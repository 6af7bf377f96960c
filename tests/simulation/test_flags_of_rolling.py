"""A position that does not converge, in all that rolls on boundary elements: a flag and no number, or an exception."""

import ast
import types
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

import bem3d
from tests.advice.planted_answers import wheel
from tests.railway.power_law_ground import isotropic_strip
from tests.seeded import catches
from validation.advice.models.boundary_elements_rolling import MODEL as ROLLING
from validation.analysis.spectra import Bands
from validation.benchmarks.work_precision import problem as rolling_chart
from validation.cases.rolling.ridges import RollingOverRidges
from validation.engine.realisations import NotConvergedError, as_not_converged
from validation.judging.kinds import from_report
from validation.judging.kinds.held_out_points import THIRD, OblongStrip, roll_oblong
from validation.railway.models.rail import BOUNDARY_ELEMENTS
from validation.railway.problems import rail_models, wheel_on_rail
from validation.railway.problems.equivalent_displacement import Corrugation, RolledRail, roll_corrugation, roll_rail
from validation.railway.problems.rail_across import WideRail, roll_both_ways
from validation.railway.problems.rail_sound import HeldWheel, roll_held_wheel
from validation.railway.problems.wheel_on_rail import WheelOnRail, roll_and_move
from validation.railway.scenes.transverse_profile import TransverseProfile
from validation.scenes.load import load_scene
from validation.scenes.wheel_body import Wheel
from validation.simulation import rolling_strip
from validation.simulation.contact_laws import BoundaryElementsLaw
from validation.simulation.exact_contacts import PublishedContact, press_ellipse
from validation.simulation.limits import strip_widths
from validation.simulation.model import Resolution, Target
from validation.simulation.model_names import BEM
from validation.simulation.reduced_models import roll_by_all
from validation.simulation.rolling_strip import RoughStrip, roll_strip
from validation.simulation.track_spectrum import self_affine

ROOT = Path(bem3d.__file__).parents[1]

(STRIP,) = RoughStrip(spectrum=self_affine(0.7, 1.0, 4.0), height=0.2, length=8.0, width=6.0, seed=1).strips(6, 1e-6, 1)
RAIL = isotropic_strip(3e-6, 0.06, 1.5e-3)
ON_A_RAIL = "validation.railway.problems.equivalent_displacement:roll_boundary_elements"
RIDGES = rolling_strip.RidgesTrack(ridges=RollingOverRidges(length=8, shortest=4.0).ridges, method="bem3d", cells=4)
MOVING = WheelOnRail(strip=RAIL, mass=500.0, speed=22.0, model=BEM, tolerance=1e-6)
BOTH_WAYS = WideRail(strip=RAIL, width=RAIL.width, bands=Bands((120.0, 400.0, 1200.0)))
OBLONG = OblongStrip(scene=THIRD, height=0.2, cells=6, by_load=False)
HELD = HeldWheel(strip=RAIL, model=BEM, first=0, last=4, tolerance=1e-6)
ROLLERS = ("bem3d.roll", "bem3d.rolling_force", "bem3d.RollingContact")
ONE_POSITION = ("validation.simulation.exact_contacts:press_ellipse",)
Y = np.linspace(-0.03, 0.03, 61)
PROFILE = TransverseProfile(y=tuple(Y.tolist()), height=tuple((-(Y**2) / 0.6).tolist()), source="head.csv")


def without_a_flag(**found):
    """Of what raises, or has NaN alone."""
    return {**found, "failed": np.zeros(1)}


def in_time():
    law = BoundaryElementsLaw(Wheel(radius=1.0, mass=1.0, modulus=1.0, load=4 / 3), [STRIP.surface()], 1 / 6)
    return without_a_flag(force=np.array([law.force(i, np.ones(1)) for i in range(4)]))


def by_a_model(target):
    result = ROLLING.prepare(target, Resolution(size=4))(0)()
    return {**result.values, "failed": np.array(float(bool(result.failed)))}


PATHS = {
    "validation.simulation.rolling_strip:roll_strip": lambda: roll_strip(STRIP),
    "validation.simulation.rolling_strip:_roll": lambda: rolling_strip.roll_over(RIDGES),
    "validation.simulation.rolling_strip:roll_loaded_strip": lambda: rolling_strip.roll_loaded_strip(STRIP),
    "validation.simulation.reduced_models:boundary_elements": lambda: roll_by_all(STRIP),
    "validation.simulation.rolling_levels:by_boundary_elements": lambda: by_a_model(Target(wheel(), "force-rms")),
    "validation.simulation.contact_laws:BoundaryElementsLaw": in_time,
    ON_A_RAIL: lambda: roll_rail(RolledRail(strip=RAIL, models=(BEM,))),
    "validation.railway.problems.rail_across:_roll": lambda: roll_both_ways(BOTH_WAYS),
    f"{ON_A_RAIL}, on a profile": lambda: roll_rail(RolledRail(strip=RAIL, models=(BEM,), profile=PROFILE)),
    f"{ON_A_RAIL}, at a constant height": lambda: roll_held_wheel(HELD),
    f"{ON_A_RAIL}, before it moves": lambda: roll_and_move(MOVING),
    "validation.railway.problems.wheel_on_rail:EllipseLaw": lambda: without_a_flag(
        **dict(zip(("approach", "force"), wheel_on_rail.in_motion(MOVING, MOVING.law()), strict=True))
    ),
    "validation.benchmarks.work_precision.problem:_roll": lambda: without_a_flag(
        force=rolling_chart._roll(STRIP.surface(), 6, 1e-6)()
    ),
    "validation.railway.problems.equivalent_displacement:roll_corrugation": lambda: roll_corrugation(
        Corrugation(phase=2.0, height=0.1, cells=6)
    ),
    "validation.simulation.exact_contacts:press_ellipse": lambda: press_ellipse(
        PublishedContact(cells=6, tolerance=1e-6)
    ),
    "validation.simulation.limits:strip_widths": lambda: strip_widths((13, 18), finer=6),
    "validation.judging.kinds.from_report:roll_under_load": lambda: from_report.roll_under_load(STRIP),
    "validation.judging.kinds.held_out_points:roll_oblong": lambda: roll_oblong(OBLONG),
}


@contextmanager
def one_iteration_at(positions):
    """Boundary elements that roll stop after one iteration over these cells of the track, without a solution."""

    def cut(method):
        def solve(self, position, prescribed):
            whole, self.max_iterations = self.max_iterations, 1 if position in positions else self.max_iterations
            found = method(self, position, prescribed)
            self.max_iterations = whole
            return found

        return solve

    with pytest.MonkeyPatch.context() as patch:
        for name in ("press", "carry"):
            patch.setattr(bem3d.RollingContact, name, cut(getattr(bem3d.RollingContact, name)))
        yield


def without_flag(solve):
    """The outcome of a solve, without its flag."""
    return lambda *given, **settings: {**solve(*given, **settings), "failed": np.array(0.0)}


@catches("roll_strip without its flag", path="validation.simulation.rolling_strip:roll_strip").at(
    f"{__name__}.roll_strip", without_flag(roll_strip)
)
@catches("roll_rail without its flag", path=ON_A_RAIL).at(f"{__name__}.roll_rail", without_flag(roll_rail))
@catches("roll_held_wheel without its flag", path=ON_A_RAIL + ", at a constant height").at(
    f"{__name__}.roll_held_wheel", without_flag(roll_held_wheel)
)
@catches("roll_and_move without its flag", path=ON_A_RAIL + ", before it moves").at(
    f"{__name__}.roll_and_move", without_flag(roll_and_move)
)
@catches("roll_by_all without its flag", path="validation.simulation.reduced_models:boundary_elements").at(
    f"{__name__}.roll_by_all", without_flag(roll_by_all)
)
@catches("roll_over without its flag", path="validation.simulation.rolling_strip:_roll").at(
    "validation.simulation.rolling_strip.roll_over", without_flag(rolling_strip.roll_over)
)
@catches("roll_loaded_strip without its flag", path="validation.simulation.rolling_strip:roll_loaded_strip").at(
    "validation.simulation.rolling_strip.roll_loaded_strip", without_flag(rolling_strip.roll_loaded_strip)
)
@pytest.mark.parametrize("path", PATHS)
def test_a_position_without_a_solution_is_flagged_and_is_no_number(path):
    """All that it changes is NaN. Where nothing can do without it, there is no outcome at all."""
    whole = PATHS[path]()
    assert not whole.get("failed", False)
    with one_iteration_at((0,) if path in ONE_POSITION else (1,)):
        try:
            with as_not_converged():
                found = PATHS[path]()
        except NotConvergedError:
            return
    assert found["failed"] >= 1
    changed = {
        name: found[name][far(found[name], values)]
        for name, values in whole.items()
        if name not in ("failed", "applications", "work", "operator applications")
    }
    assert any(values.size for values in changed.values())
    for name, values in changed.items():
        assert np.isnan(values).all(), name


def far(values, others):
    """Where they are farther apart than positions that begin from nothing."""
    return ~(np.abs(values - others) <= 1e-3 * np.nanmax(np.abs(others), initial=0.0))


def test_all_that_rolls_is_looked_at():
    """Whoever calls boundary elements that roll, by function or class."""
    found = set()
    for file in (ROOT / "validation").rglob("*.py"):
        module, text = ".".join(file.relative_to(ROOT).with_suffix("").parts), file.read_text(encoding="utf-8")
        for top in ast.parse(text).body if any(roller in text for roller in ROLLERS) else ():
            calls = (node.func for node in ast.walk(top) if isinstance(node, ast.Call))
            if any(ast.unparse(call) in ROLLERS for call in calls):
                found.add(f"{module}:{top.name}")
    assert {path for path in found if ".examples." not in path} == {path.partition(",")[0] for path in PATHS}


@catches("a rolling contact that always says it has converged").at(
    "bem3d.WheelContact.converged", property(lambda contact: True)
)
@catches("numbers of a rolling contact that has not converged").at(
    "bem3d.rolling_contact.math", types.SimpleNamespace(nan=1.0)
)
def test_a_position_without_a_solution_has_no_number():
    """Of force, approach and area; residual and work are known."""
    track = bem3d.Track(height=STRIP.surface(), spacing=1 / 6, radius=1.0, modulus=1.0)
    with one_iteration_at((1,)):
        wheel = bem3d.RollingContact(track)
        along = [wheel.carry(i, 4 / 3) for i in range(3)]
    assert [one.converged for one in along] == [True, False, True]
    for name in ("force", "approach", "area"):
        assert np.isnan([getattr(one, name) for one in along]).tolist() == [False, True, False]


def test_strips_of_a_rail_that_are_lost_leave_no_filter(monkeypatch):
    monkeypatch.setattr(rail_models, "STRIPS", 2)
    failed = iter((0.0, 1.0))
    monkeypatch.setattr(rail_models.ContactFilter, "roll", lambda *_: {"failed": np.array(next(failed))})
    found = BOUNDARY_ELEMENTS.filter.over_twin(load_scene("rail"), "ridges", 3, 1)
    assert np.isnan(found).all()
