"""What Fig. 14.4 costs by springs and with boundary elements in the time loop: a step, a metre, the whole figure."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from validation.analysis.evidence import Number, Role, Table, table_of
from validation.benchmarks.isolation import measure_alone, timed
from validation.benchmarks.timing import interval_of_median
from validation.engine.engine import Engine, Outcome
from validation.scenes.dynamic_wheel import WheelScene, load_wheel_scene
from validation.simulation.contact_laws import BoundaryElementsLaw, SpringsLaw
from validation.simulation.motion import simulate, simulate_from_linear_motion
from validation.simulation.wheel_on_half_space import (
    WheelStrip,
    crop_to_reach,
    linear_law_3d,
)
from validation.simulation.wheel_on_springs import WheelEnsemble

RUNS = 5
TABLE = load_wheel_scene("table_14_1")
A_DAY = 24.0
HOUR = 3600.0
COLUMNS = ("one step [s]", "one metre [s]", "one wheel [s]", "Fig. 14.4 [h]")


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
    scene: WheelScene = TABLE
    seed: int = 149


@dataclass(frozen=True)
class OnSprings:
    """Wheels in a batch, each on a track of its own."""

    method: ClassVar = "springs"
    cost: FigureCost

    @property
    def elements(self) -> int:
        return self.cost.scene.springs

    def measure(self) -> Outcome:
        """Seconds of a step of one wheel, several times."""
        cost, scene = self.cost, self.cost.scene
        heights = WheelEnsemble(scene=scene, count=cost.wheels, seed=cost.seed).heights()
        law = SpringsLaw(scene.body, heights, scene.spacing)
        found = [
            timed(lambda: simulate(scene.body, law, time_step=scene.time_step, steps=cost.steps))[1]
            for _ in range(RUNS)
        ]
        return {"seconds": np.array(found) / (cost.steps * cost.wheels)}


@dataclass(frozen=True)
class OnHalfSpace:
    """One wheel over the beginning of a strip."""

    method: ClassVar = "boundary elements"
    cost: FigureCost

    @property
    def elements(self) -> int:
        return self.cost.cells

    def measure(self) -> Outcome:
        """Seconds of a step, several times; plans are made before."""
        cost, scene = self.cost, self.cost.scene
        strip = WheelStrip(
            scene=scene,
            realisation=0,
            natural_periods=0,
            width=2,
            cells=cost.cells,
            shared=cost.cells,
            tolerance=cost.tolerance,
            seed=cost.seed,
        )
        surface, time_step = strip.surface(), strip.spacing / scene.speed
        linear, height = linear_law_3d(strip, surface), crop_to_reach(surface, strip.spacing, scene.body)
        law = BoundaryElementsLaw(scene.body, [height], strip.spacing, tolerance=cost.tolerance)
        found = [
            timed(lambda: simulate_from_linear_motion(law, linear, time_step, cost.steps))[1] for _ in range(1 + RUNS)
        ]
        return {"seconds": np.array(found[1:]) / cost.steps}


def figure_cost(cost: FigureCost, engine: Engine) -> Table:
    """A row a method: median seconds of a step, of a metre, of a wheel; hours of the figure, with their interval."""
    problems: tuple[OnSprings | OnHalfSpace, ...] = (OnSprings(cost), OnHalfSpace(cost))
    outcomes = engine.map(measure_alone, problems)
    return table_of("cost", [_row(p, o["seconds"].tolist()) for p, o in zip(problems, outcomes, strict=True)])


def _row(problem: OnSprings | OnHalfSpace, seconds: list[float]) -> dict[str, object]:
    cost, scene = problem.cost, problem.cost.scene
    metre = problem.elements / scene.contact_radius
    step = float(np.median(seconds))
    low, high = interval_of_median(seconds)
    hours = cost.wheels * scene.distance * metre / HOUR
    return {
        "method": problem.method,
        "a/dx": problem.elements,
        "one step [s]": step,
        "one metre [s]": step * metre,
        "one wheel [s]": step * metre * scene.distance,
        "Fig. 14.4 [h]": hours * step,
        "from [h]": hours * low,
        "to [h]": hours * high,
    }


def cost_number(table: Table) -> Number:
    """Hours of the figure with boundary elements; none is zero, and more than a day is too costly."""
    hours, low, high = (float(table[name][1]) for name in ("Fig. 14.4 [h]", "from [h]", "to [h]"))
    return Number(
        quantity="time of Fig. 14.4 on one core",
        model=OnHalfSpace.method,
        where={"a/dx": float(table["a/dx"][1])},
        value=hours,
        reference=0.0,
        source="no cost",
        tolerance=A_DAY,
        reason="a day on one core is not too costly",
        unit="h",
        sample=max(high - hours, hours - low),
        role=Role.FINDING,
    )


def cost_answer(table: Table, cost: FigureCost) -> str:
    """A step, a metre and the figure, by both."""
    springs, elements = (
        dict(zip(("step", "metre", "wheel", "hours"), values, strict=True))
        for values in zip(*(table[name].tolist() for name in COLUMNS), strict=True)
    )
    cells = cost.scene.rail.shortest / cost.scene.contact_radius * cost.cells if cost.scene.rail else 0.0
    return (
        f"a step takes {1e3 * elements['step']:.2g} ms with boundary elements ({cost.cells} cells to a contact radius, "
        f"{cells:.0f} to the shortest wave) and {1e6 * springs['step']:.2g} µs on springs ({cost.scene.springs}); a "
        f"simulated metre takes {elements['metre']:.0f} s and {springs['metre']:.2g} s, a wheel of Fig. 14.4 over "
        f"{cost.scene.distance:g} m {elements['wheel']:.0f} s and {springs['wheel']:.2g} s, its {cost.wheels} wheels "
        f"{elements['hours']:.1f} h and {HOUR * springs['hours']:.0f} s on one core, "
        f"{elements['hours'] / springs['hours']:.0f} times as much."
    )
