"""What the calibration test shows: how often the true error is within the estimated one, and what selection saves."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np
from scipy import stats

from validation.advice.cases import edge_scenes, random_scenes
from validation.advice.cases.model_selection import (
    CHEAP_EDGES,
    DRAWN,
    EDGE_SCENES,
    MODELS,
    CalibrationTest,
    EdgeTrial,
    run,
)
from validation.analysis.evidence import Columns, Table, grouped, table_of
from validation.analysis.number_text import plus_minus
from validation.analysis.series import Margin
from validation.analysis.statistics import Interval
from validation.case import Case, Chapter, Chart, Claim, Curve, Outcomes, Panel, Quantity, Series, Study
from validation.engine.engine import Outcome
from validation.engine.realisations import random_generator

COVERAGE = Quantity("share_of_scenes_whose_true_error_is_within_the_estimated_one")
SPENT = Quantity(
    "time_of_selection_over_that_of_fine_boundary_elements_all_scenes_together",
    "time of selection over that of fine boundary elements, all scenes together",
)
HELD = Quantity("share_of_answers_at_the_edges_whose_true_error_is_within_the_estimated_one")
REFUSED = Quantity(
    "share_of_questions_at_the_edges_that_are_refused_though_fine_boundary_elements_meet_the_tolerance",
    "share of questions at the edges that are refused, though fine boundary elements meet the tolerance",
)
FAR_OFF = Quantity(
    "true_error_at_the_edges_above_the_estimated_one_where_the_tolerance_is_met_worst",
    "true error at the edges above the estimated one where the tolerance is met, worst",
)
UPPER = "an upper bound of the error"
MARGINS: Mapping[str, Margin] = {
    quantity: Margin(tolerance=tolerance, reason=reason, source=source)
    for quantity, (tolerance, reason, source) in {
        COVERAGE: (6.0, "94 %: a 95 % interval; what is too wide is not tight", UPPER),
        SPENT: (100.0, "the time of fine boundary elements", "no time"),
        HELD: (3.0, "97 %: what 95 % intervals reach where many are wide", UPPER),
        REFUSED: (10.0, "one in ten", "no refusal where a model has an answer"),
        FAR_OFF: (100.0, "a factor 2", UPPER),
    }.items()
}
RESAMPLED, NONE = 400, "none"
"""Bootstrap samples of scenes; no model."""
Rows = slice | np.ndarray
ESTIMATED, TRUE, OF_REFERENCE = "estimated error", Quantity("true_error"), "error of the reference"
SAVED = Quantity("fine_boundary_elements_over_the_selection")
OF_FINE, SMALLEST = "error of fine boundary elements", 1e-4
"""Smaller errors are drawn there."""


def in_four_digits(table: Table) -> Table:
    """Of many points, which are drawn and read, and not computed with."""
    columns = {name: table[name].tolist() for name in table.columns}
    rounded = {n: [float(f"{x:.4g}") if isinstance(x, float) else x for x in cells] for n, cells in columns.items()}
    return Table(table.name, rounded)


def scenes_of(result: Outcomes) -> Table:
    """A row a scene drawn from the ranges, and tolerance."""
    return table_of(
        "scenes",
        [
            {
                **{"kind": trial.kind, "number": trial.number, "quantity": trial.quantity, "tolerance": tolerance},
                **{"model": (*MODELS, NONE)[int(outcome["model"][i])], "met": int(outcome["met"][i])},
                **{ESTIMATED: float(outcome["estimated"][i]), TRUE: float(outcome["true"][i])},
                OF_REFERENCE: float(outcome["reference"]),
                **{"selection [s]": float(outcome["spent"][i]), "fine [s]": float(outcome["fine"][i])},
            }
            for trial, outcome in zip(result.case.trials, result["random"], strict=True)
            for i, tolerance in enumerate(result.case.tolerances)
        ],
    )


def edges_of(trials: Sequence[EdgeTrial], outcomes: Sequence[Outcome]) -> Table:
    """A row a scene at the edges, and tolerance."""
    rows: list[dict[str, object]] = [
        {
            **{"kind": trial.kind, "number": trial.number, "quantity": quantity, "tolerance": tolerance},
            "met": int(outcome["met"][i]),
            **{ESTIMATED: float(outcome["estimated"][i]), TRUE: float(outcome["true"][i])},
            **{OF_REFERENCE: float(outcome["reference"]), OF_FINE: float(outcome["offered"])},
        }
        for trial, outcome in zip(trials, outcomes, strict=True)
        for quantity in [trial.quantity]
        for i, tolerance in enumerate(trial.tolerances)
    ]
    names = ("kind", "number", "quantity", "tolerance", "met", ESTIMATED, TRUE, OF_REFERENCE, OF_FINE)
    return Table("edges", {name: [row[name] for row in rows] for name in names})


def tested(table: Table) -> Table:
    """Rows with an answer and a reference."""
    kept = np.isfinite(table[TRUE].astype(float))
    return Table(table.name, {name: table[name][kept].tolist() for name in table.columns})


def over_estimate(table: Table) -> np.ndarray:
    """True over estimated error, beside a reference that has an error of its own, independent of that."""
    return np.asarray(table[TRUE] / np.hypot(table[ESTIMATED], table[OF_REFERENCE]))


def answerable(table: Table) -> np.ndarray:
    """Whether fine boundary elements meet the tolerance."""
    return np.asarray(table[OF_FINE] <= table["tolerance"])


def part_of_time(table: Table, rows: Rows = slice(None)) -> float:
    return float(table["selection [s]"][rows].sum() / table["fine [s]"][rows].sum())


def clopper_pearson(inside: np.ndarray) -> tuple[float, float]:
    """95 % interval of a share."""
    interval = stats.binomtest(int(np.count_nonzero(inside)), inside.size).proportion_ci()
    return float(interval.low), float(interval.high)


def share(inside: np.ndarray) -> Interval:
    (low, high), value = clopper_pearson(inside), float(inside.mean())
    return Interval(value, max(value - low, high - value))


def resampled(table: Table, statistic: Callable[[Table, Rows], float]) -> tuple[float, float]:
    """95 % interval, by scenes drawn again: of the numbers of the scenes drawn."""
    size = len(table["kind"])
    rng = random_generator(0, size)
    low, high = np.quantile([statistic(table, rng.integers(0, size, size)) for _ in range(RESAMPLED)], (0.025, 0.975))
    return float(low), float(high)


def series(result: Outcomes) -> list[Series]:
    """Single numbers at each tolerance that has answers, of random scenes and at the edges; points of the figure."""
    scenes = tested(scenes_of(result))
    return [
        *(
            curve
            for tolerance in np.unique(scenes["tolerance"]).tolist()
            for curve in _series_of_selection(tolerance, scenes.where(tolerance=tolerance))
        ),
        *at_edges(edges_of(result.case.edge_trials, result["edges"])),
    ]


def judged(quantity: str, value: Interval | float, tolerance: float, reference: float = 0.0) -> Series:
    where, margin = {"tolerance": tolerance}, MARGINS[quantity]
    return Series(quantity, "", (value,), where=where, reference=reference, margin=margin, scale=100.0, unit="%")


def _series_of_selection(tolerance: float, answers: Table) -> Iterator[Series]:
    """Of selected models: how many estimates hold, what they take, and each scene as a point."""
    part, (_, high) = part_of_time(answers), resampled(answers, part_of_time)
    yield judged(COVERAGE, share(over_estimate(answers) <= 1), tolerance, reference=1.0)
    yield judged(SPENT, Interval(part, high - part), tolerance)
    ends = np.array([SMALLEST, 1.0])
    yield Series(TRUE, "true = estimated", ends, where={"tolerance": tolerance}, along=ESTIMATED, at=ends)
    met = answers.rows(answers["met"] == 1)
    for model in [model for model in MODELS if model in met["model"]]:
        points = met.where(model=model)
        for quantity, values in ((TRUE, points[TRUE]), (SAVED, points["fine [s]"] / points["selection [s]"])):
            yield Series(quantity, model, values, where={"tolerance": tolerance}, along=ESTIMATED, at=points[ESTIMATED])


def at_edges(edges: Table) -> Iterator[Series]:
    """Where an answer was tested: those that hold, that are far off, and questions that are refused."""
    for tolerance in np.unique(tested(edges)["tolerance"]).tolist():
        rows = edges.where(tolerance=tolerance)
        answers, possible = tested(rows), answerable(rows)
        yield judged(HELD, share(over_estimate(answers) <= 1), tolerance, reference=1.0)
        if (met := over_estimate(answers)[answers["met"] == 1]).size:
            yield judged(FAR_OFF, max(float(met.max()) - 1, 0.0), tolerance)
        if possible.any():
            yield judged(REFUSED, share(rows["met"][possible] == 0), tolerance)


def _model_counts(table: Table) -> str:
    """Selected models, each with the number of its rows."""
    counts = {name: int(np.count_nonzero(table["model"] == name)) for name in (*MODELS, NONE)}
    return ", ".join(f"{name} ({count})" for name, count in counts.items() if count)


def _share_text(inside: np.ndarray) -> str:
    """A share with its 95 % interval, in per cent; a dash without rows."""
    if not inside.size:
        return "–"
    low, high = clopper_pearson(inside)
    return f"{inside.mean():.0%} ({low:.0%} to {high:.0%})"


def _speed_up_text(table: Table) -> str:
    """Time of fine BEM over that of the selection, with its 95 % interval; a dash without answers."""
    answers = tested(table)
    if not answers["kind"].size:
        return "–"
    high, low = (1 / part for part in resampled(answers, part_of_time))
    return f"{1 / part_of_time(answers):.3g} ({low:.2g} to {high:.2g})"


BY_KIND = Quantity(
    "Estimated_errors_of_selected_models_fine_boundary_elements_on_every_scene_over_the_selection_95_interval",
    "Estimated errors of selected models; fine boundary elements on every scene over the selection (95 % interval)",
)
AT_EDGES = Quantity("Answers_at_the_edges_of_the_ranges")
UNTESTED = "Scenes at the edges that test nothing, since their reference refuses them"
OF_EDGES: Columns = {
    "scenes times tolerances": lambda t: len(t["kind"]),
    "answers": lambda t: int(np.isfinite(t[ESTIMATED]).sum()),
    "tolerance met": lambda t: int(t["met"].sum()),
    "refused, but within the tolerance of fine boundary elements": lambda t: int((t["met"][answerable(t)] == 0).sum()),
    "tested": lambda t: len(tested(t)["kind"]),
    "held": lambda t: int((over_estimate(tested(t)) <= 1).sum()),
    "true over estimated error, worst": lambda t: max(over_estimate(tested(t)), default=math.nan),
}


def tables(result: Outcomes) -> tuple[Table, ...]:
    """Scenes one by one, and how they come out by kind and by tolerance."""
    scenes, edges = scenes_of(result), edges_of(result.case.edge_trials, result["edges"])
    columns = {name: [*cells, *cells] for name, cells in scenes.columns.items()}
    columns["kind"] = [*scenes.columns["kind"], *("all" for _ in scenes.columns["kind"])]
    of_kinds: Columns = {
        "scenes": lambda t: len(t["kind"]),
        "answers": lambda t: len(tested(t)["kind"]),
        "tolerance met": lambda t: int(t["met"].sum()),
        "true error within the estimate": lambda t: _share_text(over_estimate(tested(t)) <= 1),
        "within the tolerance": lambda t: _share_text(tested(t)[TRUE] <= tested(t)["tolerance"]),
        "saved": _speed_up_text,
        "selected models": _model_counts,
    }
    refused = [
        {"kind": trial.kind, "number": trial.number, "reason": str(outcome["refused"])}
        for trial, outcome in zip(result.case.edge_trials, result["edges"], strict=True)
        if str(outcome["refused"])
    ]
    return (
        *map(in_four_digits, (scenes, edges)),
        grouped(BY_KIND, Table("scenes", columns), ("kind", "tolerance"), of_kinds),
        grouped(AT_EDGES, edges, ("kind",), OF_EDGES),
        *([table_of(UNTESTED, refused)] if refused else []),
    )


STUDY = Study(
    title="Calibration test of model selection",
    method=(
        "Scenes drawn at random ({c.punches} rough punches, {c.spheres} rough spheres, {c.rolling} rolling and "
        f"{{c.wheels}} dynamic wheels): {random_scenes.RANGES}. For each scene the cheapest model is selected whose "
        "error is within the tolerance. The reference is boundary elements on the finest grid with surfaces of its "
        "own; its error is added at a right angle to the estimated one. The test is blind to what both share: the "
        "finest grid, its shortest wave, the quadratures of linear theory. Costs are counts of operations times the "
        "time of one, so that they are the same on every machine. The cost of a selection includes all models that "
        "were solved. {c.edge_scenes} scenes more lie at the edges of all ranges and beyond: "
        f"{edge_scenes.RANGES}; of {DRAWN} times as many those whose reference costs least. There the reference of a "
        "measured face has its points split; a measured track is its own reference, and an answer on the grid of the "
        "reference is not tested, and a scene that the reference itself refuses tests nothing."
    ),
    series=series,
    tables=tables,
    claims=(
        Claim(quantity=(COVERAGE, HELD, REFUSED, FAR_OFF)).saying(
            "The true error of the model that is selected lies within the estimated one, at the edges of all ranges "
            "too.",
            short="The true error of the selected model lies within the estimated one",
            key="errors",
        ),
        Claim(quantity=SPENT, printed=lambda n: f"{plus_minus(n.value, n.uncertainty)} % of the time").saying(
            "Over all scenes together selection takes less time than fine boundary elements.",
            short="Selection takes less time than fine boundary elements",
            key="time",
        ),
    ),
    charts=(
        Chart("ladder", claims=(0, 1)).of(
            "Selected models that meet the tolerance. True error, beside fine boundary elements, against the estimated "
            "one, a panel a tolerance; below the line the estimate holds. Last panel: cost of fine boundary elements "
            "over that of the selection, at all tolerances; above the line selection saves time. Errors below "
            f"{SMALLEST:g} are drawn there.",
            Panel(ESTIMATED, TRUE, log="xy", facet="tolerance", least=(SMALLEST, SMALLEST)).of(
                Curve(TRUE, "true = estimated", "guide", "_"), Curve(TRUE, MODELS, "marks", by=("model",))
            ),
            Panel(ESTIMATED, SAVED, log="xy", lines=(1.0,), least=(SMALLEST, 0.0)).of(
                Curve(SAVED, MODELS, "marks", by=("model",))
            ),
        ),
    ),
    printed=(BY_KIND, AT_EDGES, UNTESTED),
)
CASE = Case(
    name="ladder",
    chapter=Chapter.SELECTION,
    place=1,
    answers="Calibration test of model selection on random scenes: estimated and true error, and the time saved",
    quick=CalibrationTest(punches=4, edges=CHEAP_EDGES),
    full=CalibrationTest(
        punches=60, spheres=60, rolling=16, wheels=10, edges=EDGE_SCENES, tolerances=(0.03, 0.1, 0.3), seed=23
    ),
    run=run,
    study=STUDY,
    needs="chosen scene by scene",
)
