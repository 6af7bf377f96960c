"""What the calibration test shows: how often the true error is within the estimated one, and what selection saves."""

import math
from collections.abc import Callable, Iterator, Sequence

import numpy as np
from scipy import stats

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart
from validation.analysis.claims import Claim
from validation.analysis.evidence import Columns, Table, grouped, table_of
from validation.analysis.series import Margin, Series
from validation.analysis.statistics import Interval
from validation.analysis.study import Outcomes, Study
from validation.cases.selection import edge_scenes, random_scenes
from validation.cases.selection.model_selection import (
    CHEAP,
    CHEAP_EDGES,
    DRAWN,
    EDGE_SCENES,
    MODELS,
    CalibrationTest,
    EdgeTrial,
    run,
)
from validation.engine.engine import Outcome
from validation.engine.random_numbers import random_generator

COVERAGE = "share of scenes whose true error is within the estimated one"
CALIBRATED = "share of errors of cheap models, selected or not, that are within what was calibrated"
TIGHTNESS = "estimated over true error, in the median"
SAVING = "shortfall of the total saving below a factor 2, in decades"
HELD = "share of answers at the edges whose true error is within the estimated one"
REFUSED = "share of questions at the edges that are refused, though fine boundary elements meet the tolerance"
FAR_OFF = "true error at the edges above twice the estimated one where the tolerance is met, worst, in decades"
KIND_HELD = "share of scenes of a kind at the edges, all of whose answers are within their estimated errors"
UPPER = "an upper bound of the error"
HOLDS = 0.03, "0.97: what 95 % intervals reach where many are wide", UPPER
MARGINS = {
    quantity: Margin(tolerance=tolerance, reason=reason, source=source)
    for quantity, (tolerance, reason, source) in {
        COVERAGE: (0.06, "0.94: a 95 % interval; what is too wide is not tight", UPPER),
        CALIBRATED: (0.02, "0.94 to 0.98: less is too narrow, more is too wide", "coverage of a 95 % interval"),
        TIGHTNESS: (1.0, "1 to 3", "1.96 / 0.67 of a Gaussian error, less where it is no surprise"),
        SAVING: (0.05, "0.05 decades: 12 % of the factor", "a factor 2"),
        HELD: HOLDS,
        KIND_HELD: HOLDS,
        REFUSED: (0.1, "one in ten", "no refusal where a model has an answer"),
        FAR_OFF: (0.02, "0.02 decades: 5 % of the factor", "no error above 2 times the estimated one"),
    }.items()
}
SAVED, MOST, RESAMPLED, NONE = 2.0, 2.0, 400, "none"
"""What selection should save; true over estimated error of an answer; bootstrap samples of scenes; no model."""
Some = slice | np.ndarray
ESTIMATED, TRUE, OF_REFERENCE = "estimated error", "true error", "error of the reference"
OF_FINE = "error of fine boundary elements"


def in_four_digits(table: Table) -> Table:
    """Of many points, which are drawn and read, and not computed with."""
    columns = {name: table[name].tolist() for name in table.columns}
    rounded = {n: [float(f"{x:.4g}") if isinstance(x, float) else x for x in mine] for n, mine in columns.items()}
    return Table(table.name, rounded)


def scenes_of(result: Outcomes) -> Table:
    """A row a scene drawn from the ranges, and tolerance."""
    rows: list[dict[str, object]] = []
    for trial, outcome in zip(result.case.trials, result["random"], strict=True):
        for i, tolerance in enumerate(result.case.tolerances):
            spent, fine = float(outcome["spent"][i]), float(outcome["fine"][i])
            rows.append(
                {
                    **{"kind": trial.kind, "number": trial.number, "quantity": trial.quantity, "tolerance": tolerance},
                    **{"h/d": float(outcome["height"]), "F / (E* h L)": float(outcome["load"])},
                    **{"model": (*MODELS, NONE)[int(outcome["model"][i])], "met": int(outcome["met"][i])},
                    **{ESTIMATED: float(outcome["estimated"][i]), TRUE: float(outcome["true"][i])},
                    OF_REFERENCE: float(outcome["reference"]),
                    **{"selection [s]": spent, "fine [s]": fine, "saved": fine / spent if spent > 0 else math.nan},
                }
            )
    return table_of("scenes", rows)


def estimates_of(result: Outcomes) -> Table:
    """A row a scene and model below boundary elements, selected or not."""
    rows: list[dict[str, object]] = [
        {
            **{"kind": trial.kind, "number": trial.number, "quantity": trial.quantity},
            **{"h/d": float(outcome["height"]), "F / (E* h L)": float(outcome["load"])},
            **{"model": name, ESTIMATED: float(estimated), TRUE: float(true)},
        }
        for trial, outcome in zip(result.case.trials, result["random"], strict=True)
        for name, estimated, true in zip(CHEAP, outcome["every estimated"], outcome["every true"], strict=True)
        if np.isfinite(true)
    ]
    return table_of("claims", rows)


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


def within_claims(estimates: Table) -> np.ndarray:
    """Of each model on each scene; the error of the reference is not allowed for."""
    return np.asarray(estimates[TRUE] <= estimates[ESTIMATED])


def answerable(table: Table) -> np.ndarray:
    """Whether fine boundary elements meet the tolerance."""
    return np.asarray(table[OF_FINE] <= table["tolerance"])


def scenes_held(edges: Table) -> np.ndarray:
    """Whether all tested answers of a scene hold, at whatever tolerance: these are not independent."""
    known = tested(edges)
    held = over_estimate(known) <= 1
    return np.array([held[known["number"] == number].all() for number in np.unique(known["number"])])


def total_saving(table: Table, some: Some = slice(None)) -> float:
    return float(table["fine [s]"][some].sum() / table["selection [s]"][some].sum())


def median_saving(table: Table, some: Some = slice(None)) -> float:
    return float(np.median(table["saved"][some]))


def tightness(table: Table, some: Some = slice(None)) -> float:
    return float(np.median((table[ESTIMATED] / table[TRUE])[some]))


def clopper_pearson(inside: np.ndarray, confidence: float = 0.95) -> tuple[float, float]:
    """Interval of a share."""
    found = stats.binomtest(int(np.count_nonzero(inside)), inside.size).proportion_ci(confidence)
    return float(found.low), float(found.high)


def share(inside: np.ndarray, confidence: float = 0.95) -> Interval:
    """With 0.9 the lower end alone is that of 95 %."""
    (low, high), value = clopper_pearson(inside, confidence), float(inside.mean())
    return Interval(value, max(value - low, high - value))


def resampled(table: Table, statistic: Callable[[Table, Some], float]) -> tuple[float, float]:
    """95 % interval, by scenes drawn again: of the numbers of the scenes drawn."""
    size = len(table["kind"])
    rng = random_generator(0, size)
    low, high = np.quantile([statistic(table, rng.integers(0, size, size)) for _ in range(RESAMPLED)], (0.025, 0.975))
    return float(low), float(high)


def shortfall(saving: float) -> float:
    """Below a factor 2, in decades."""
    return max(math.log10(SAVED / saving), 0.0)


def series(result: Outcomes) -> list[Series]:
    """Single numbers, at each tolerance that has answers, of all cheap models, and of each kind at the edges."""
    scenes, inside = tested(scenes_of(result)), within_claims(estimates_of(result))
    return [
        *(one for at in np.unique(scenes["tolerance"]).tolist() for one in _at(at, scenes.where(tolerance=at))),
        judged(CALIBRATED, share(inside), reference=0.96),
        *at_edges(edges_of(result.case.edge_trials, result["edges"])),
    ]


def judged(quantity: str, found: Interval | float, reference: float = 0.0, **where: str | float) -> Series:
    return Series(quantity, "", (found,), where=where, reference=reference, margin=MARGINS[quantity])


def _at(tolerance: float, known: Table) -> Iterator[Series]:
    """Of selected models: coverage, tightness, saving."""
    total = shortfall(total_saving(known))
    (low, high), (slow, _) = resampled(known, tightness), resampled(known, total_saving)
    yield judged(COVERAGE, share(over_estimate(known) <= 1), reference=1.0, tolerance=tolerance)
    yield judged(TIGHTNESS, Interval(tightness(known), (high - low) / 2), reference=2.0, tolerance=tolerance)
    yield judged(SAVING, Interval(total, shortfall(slow) - total), tolerance=tolerance)


def at_edges(edges: Table) -> Iterator[Series]:
    """Where an answer was tested: those that hold, that are far off, and questions that are refused; kind by kind."""
    for tolerance in np.unique(tested(edges)["tolerance"]).tolist():
        mine = edges.where(tolerance=tolerance)
        known, asked = tested(mine), answerable(mine)
        worst = max(over_estimate(known)[known["met"] == 1], default=1.0)
        yield judged(HELD, share(over_estimate(known) <= 1), reference=1.0, tolerance=tolerance)
        yield judged(FAR_OFF, math.log10(max(worst / MOST, 1.0)), tolerance=tolerance)
        if asked.any():
            yield judged(REFUSED, share(mine["met"][asked] == 0), tolerance=tolerance)
    for kind in dict.fromkeys(edges["kind"].tolist()):
        if (held := scenes_held(edges.where(kind=kind))).size:
            yield judged(KIND_HELD, share(held, confidence=0.9), reference=1.0, scene=kind)


def _chosen(table: Table) -> str:
    counts = {name: int(np.count_nonzero(table["model"] == name)) for name in (*MODELS, NONE)}
    return ", ".join(f"{name} ({count})" for name, count in counts.items() if count)


def _share(inside: np.ndarray) -> str:
    if not inside.size:
        return "–"
    low, high = clopper_pearson(inside)
    return f"{inside.mean():.0%} ({low:.0%} to {high:.0%})"


def _drawn_again(table: Table, statistic: Callable[..., float]) -> str:
    known = tested(table)
    if not known["kind"].size:
        return "–"
    low, high = resampled(known, statistic)
    return f"{statistic(known):.3g} ({low:.2g} to {high:.2g})"


BY_KIND, BY_MODEL, AT_EDGES = (
    "Estimated errors of selected models; fine boundary elements on every scene over the selection (95 % interval)",
    "Estimated error of each model, selected or not",
    "Answers at the edges of the ranges",
)
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
    """Scenes and estimates one by one, and how they come out by kind, by tolerance and by model."""
    scenes, estimates = scenes_of(result), estimates_of(result)
    edges = edges_of(result.case.edge_trials, result["edges"])
    every = {name: [*mine, *mine] for name, mine in scenes.columns.items()}
    every["kind"] = [*scenes.columns["kind"], *("all" for _ in scenes.columns["kind"])]
    of_kinds: Columns = {
        "scenes": lambda t: len(t["kind"]),
        "answers": lambda t: len(tested(t)["kind"]),
        "tolerance met": lambda t: int(t["met"].sum()),
        "true error within the estimate": lambda t: _share(over_estimate(tested(t)) <= 1),
        "within the tolerance": lambda t: _share(tested(t)[TRUE] <= tested(t)["tolerance"]),
        "saved, median": lambda t: _drawn_again(t, median_saving),
        "saved, in all": lambda t: _drawn_again(t, total_saving),
        "selected models": _chosen,
    }
    of_models: Columns = {
        "scenes": lambda t: len(t["kind"]),
        "true error within the estimate": lambda t: _share(within_claims(t)),
        "estimated over true error, median": tightness,
        "true over estimated error, largest": lambda t: max(t[TRUE] / t[ESTIMATED]),
    }
    return (
        *map(in_four_digits, (scenes, estimates, edges)),
        grouped(BY_KIND, Table("scenes", every), ("kind", "tolerance"), of_kinds),
        grouped(BY_MODEL, estimates, ("model",), of_models),
        grouped(AT_EDGES, edges, ("kind",), OF_EDGES),
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
        "reference is not tested."
    ),
    series=series,
    tables=tables,
    claims=(
        Claim(quantity=COVERAGE, printed=lambda n: f"{n.value:.1%} ± {n.uncertainty:.1%}").saying(
            "The cheapest model that a scene needs can be chosen beforehand, with an error estimate that holds.",
            short="Share of true errors within their estimates, beside one",
        ),
        Claim(says="Estimated errors are no more than three times the true ones, in the median.", quantity=TIGHTNESS),
        Claim(
            quantity=SAVING, printed=lambda n: f"{SAVED / 10**n.value:.3g} times{' or more' if n.value == 0 else ''}"
        ).saying(
            "Selection takes less than half of the time of fine boundary elements on every scene, in all scenes "
            "together.",
            short="saving in all scenes together, beside a factor 2",
        ),
        Claim(quantity=CALIBRATED).saying(
            "Errors of cheap models that were calibrated cover 94 to 98 % of scenes that were not."
        ),
        Claim(quantity=(HELD, REFUSED, FAR_OFF)).saying(
            "At the edges of the ranges, too, an answer holds or is refused."
        ),
        Claim(says="There, on each kind of scene all answers hold on 97 % of the scenes and more.", quantity=KIND_HELD),
    ),
    charts=(
        Chart("ladder").of(
            "(a) True error, beside fine boundary elements, against the error that the selected model estimates; "
            "below the line the estimate holds. (b) Cost of fine boundary elements over that of the selection. (c) "
            "Estimates of every model below boundary elements on every scene, selected or not. Filled: the first "
            "tolerance; open: others."
        ),
    ),
    printed=(BY_KIND, BY_MODEL, AT_EDGES),
)
CASE = Case(
    name="ladder",
    chapter=Chapter.SELECTION,
    place=1,
    answers="Calibration test of model selection on random scenes: estimated and true error, and the time saved",
    quick=CalibrationTest(punches=4, edges=CHEAP_EDGES),
    full=CalibrationTest(
        punches=40, spheres=40, rolling=30, wheels=20, edges=EDGE_SCENES, tolerances=(0.03, 0.1, 0.3), seed=23
    ),
    run=run,
    study=STUDY,
    needs="chosen scene by scene",
)
