"""What Fig. 14.4 costs by springs and with boundary elements in the time loop: a step, a metre, the whole figure."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from validation.analysis.evidence import Table, table_of
from validation.analysis.quantity import Quantity
from validation.benchmarks.timing import alone, interval_of_median, timed
from validation.engine.engine import Engine, FloatArray, Outcome
from validation.scenes.load import load_scene_with_track
from validation.scenes.rolling import RollingScene
from validation.simulation.contact_laws import BoundaryElementsLaw, SpringsLaw
from validation.simulation.motion import simulate, simulate_from_linear_motion
from validation.simulation.wheel_on_half_space import WheelStrip, crop_to_reach, linear_law_3d
from validation.simulation.wheel_on_springs import WheelEnsemble

RUNS = 5
TABLE = load_scene_with_track("table_14_1")
HOUR = 3600.0
COST_OF_STEPS = Quantity(
    "the_dynamic_wheel_of_Fig._14.4_seconds_on_one_core", "the dynamic wheel of Fig. 14.4, seconds on one core"
)


@dataclass(frozen=True, kw_only=True)
class FigureCost:
    """All wheels of Fig. 14.4, each over the distance of the scene, on one core.

    wheels; steps: timed, of a wheel on boundary elements and of all wheels on springs; cells: to a contact radius;
    tolerance: residual of contacts; scene: with springs to a contact radius, and only its rail rough.
    """

    wheels: int = 300
    steps: int = 100
    cells: int = 40
    tolerance: float = 1e-4
    scene: RollingScene = TABLE
    seed: int = 149


def on_springs(cost: FigureCost) -> Outcome:
    """Seconds of a step of one wheel, several times; wheels in a batch, each on a track of its own."""
    return {"seconds": alone(_seconds_of_runs, _batch_on_springs, cost) / (cost.steps * cost.wheels)}


def on_half_space(cost: FigureCost) -> Outcome:
    """Seconds of a step, several times; one wheel over the beginning of a strip."""
    return {"seconds": alone(_seconds_of_runs, _wheel_on_half_space, cost) / cost.steps}


def _seconds_of_runs(prepare: Callable[[FigureCost], Callable[[], object]], cost: FigureCost) -> FloatArray:
    """Return the seconds of each run; a run before them makes the plans."""
    ride = prepare(cost)
    return np.array([timed(ride)[1] for _ in range(1 + RUNS)][1:])


def _batch_on_springs(cost: FigureCost) -> Callable[[], object]:
    """Return a ride of all wheels at once, each on a track of its own, which the clock times."""
    scene = cost.scene
    heights = WheelEnsemble(scene=scene, count=cost.wheels, seed=cost.seed).heights()
    law = SpringsLaw(scene.body, heights, scene.spacing)
    return partial(simulate, scene.body, law, time_step=scene.time_step, steps=cost.steps)


def _wheel_on_half_space(cost: FigureCost) -> Callable[[], object]:
    """Return a ride of one wheel over the beginning of a strip, which the clock times."""
    scene, own = cost.scene, {"realisation": 0, "natural_periods": 0, "width": 2, "seed": cost.seed}
    strip = WheelStrip(scene=scene, cells=cost.cells, shared=cost.cells, tolerance=cost.tolerance, **own)
    surface, spacing = strip.surface(), strip.spacing
    height = crop_to_reach(surface, spacing, scene.body)
    law = BoundaryElementsLaw(scene.body, [height], spacing, tolerance=cost.tolerance)
    linear = linear_law_3d(scene.body, surface, spacing)
    return partial(simulate_from_linear_motion, law, linear, spacing / scene.rolling_speed, cost.steps)


def figure_cost(cost: FigureCost, engine: Engine) -> Table:
    """A row a method: median seconds of a step, of a metre, of a wheel; hours of the figure, with their interval."""
    (springs,), (elements,) = engine.map(on_springs, [cost]), engine.map(on_half_space, [cost])
    rows = ("springs", cost.scene.track.springs, springs), ("boundary elements", cost.cells, elements)
    return table_of(
        COST_OF_STEPS, [_cost_row(cost, method, n, outcome["seconds"].tolist()) for method, n, outcome in rows]
    )


def _cost_row(cost: FigureCost, method: str, elements: int, seconds: list[float]) -> dict[str, object]:
    """Return the row of a method: seconds of a step, a metre and a wheel, hours of the figure with their interval."""
    metre = elements / cost.scene.contact_radius
    wheel = metre * cost.scene.track.distance
    step, (low, high) = float(np.median(seconds)), interval_of_median(seconds)
    return {
        "method": method,
        "a/dx": elements,
        "one step [s]": step,
        "one metre [s]": step * metre,
        "one wheel [s]": step * wheel,
        **{name: cost.wheels * wheel * x / HOUR for name, x in zip(HOURS, (step, low, high), strict=True)},
    }


HOURS = ("Fig. 14.4 [h]", "from [h]", "to [h]")
