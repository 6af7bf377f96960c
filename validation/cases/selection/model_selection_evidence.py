"""What the calibration test shows: how often the true error is within the estimated one, and what selection saves."""

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import product

import numpy as np

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.digits import in_four_digits
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Table, numbers_with, table_of
from validation.cases.selection.edge_evidence import (
    by_scene,
    edge_answer,
    edge_numbers,
    edge_table,
    edges_by_kind,
    kind_answer,
    kind_numbers,
)
from validation.cases.selection.edge_scenes import MEASURED, PUNCH, RAIL, ROLLING, SPHERE, WHEEL
from validation.cases.selection.edge_scenes import RANGES as EDGE_RANGES
from validation.cases.selection.edge_test import DRAWN
from validation.cases.selection.model_selection import (
    CHEAP,
    MODELS,
    CalibrationResult,
    CalibrationTest,
    run,
)
from validation.cases.selection.model_selection_numbers import (
    COVERAGE,
    SAVING,
    TIGHTNESS,
    calibrated_numbers,
    clopper_pearson,
    covered,
    numbers_at,
    resampled,
    saving_of,
    tightness,
    with_answer,
    within_claims,
)
from validation.cases.selection.random_scenes import KINDS, RANGES
from validation.engine.engine import Outcome

CLAIM = "The cheapest model that a scene needs can be chosen beforehand, with an error estimate that holds."
COVERS = "Errors of cheap models that were calibrated cover 94 to 98 % of scenes that were not."
TIGHT = "Estimated errors are no more than three times the true ones, in the median."
SAVES = "Selection takes less than half of the time of fine boundary elements on every scene, in all scenes together."
NONE = "none"
EDGES = "At the edges of the ranges, too, an answer holds or is refused."
EACH_KIND = "There, on each kind of scene all answers hold on 97 % of the scenes and more."
Row = dict[str, object]


def evidence(result: CalibrationResult) -> Evidence:
    """Coverage of the estimated errors, savings, and the estimates of each model by itself."""
    case, scenes, estimates = result.case, _scenes(result), _estimates(result)
    known = [(tolerance, with_answer(scenes.where(tolerance=tolerance))) for tolerance in case.tolerances]
    known = [(tolerance, table) for tolerance, table in known if table["kind"].size]
    edges = edge_table(case.edge_trials, result.edges) if result.edges else None
    numbers = tuple(number for tolerance, table in known for number in numbers_at(tolerance, table))
    calibrated = calibrated_numbers(estimates)
    at_edges = edge_numbers(edges) if edges else ()
    of_kinds = kind_numbers(edges) if edges else ()
    return Evidence(
        title="Calibration test of model selection",
        method=(
            f"{len(result.outcomes)} scenes drawn at random ({case.punches} rough punches, {case.spheres} rough "
            f"spheres, {case.rolling} rolling and {case.wheels} dynamic wheels): {RANGES}. For each scene the cheapest "
            "model is selected whose error is within the tolerance. The reference is boundary elements on the finest "
            "grid with surfaces of its own; its error is added at a right angle to the estimated one. The test is "
            "blind to what both share: the finest grid, its shortest wave, the quadratures of linear theory. Costs are "
            "counts of operations times "
            "the time of one, so that they are the same on every machine. The cost of a selection includes all "
            "models that were solved. "
            f"{len(case.edge_trials)} scenes more of {len(case.edges)} kinds lie at the edges of all ranges and "
            f"beyond: {EDGE_RANGES}; of {DRAWN} times as many those whose reference costs least. There the "
            "reference of a measured face has its points split; a measured track is its own reference, and an answer "
            "on the grid of the reference is not tested."
        ),
        numbers=(*numbers, *calibrated, *at_edges, *of_kinds),
        claims=(
            *_claims(known, numbers),
            *((answered(COVERS, calibrated, _calibrated_answer(estimates)),) if calibrated else ()),
            *((answered(EDGES, at_edges, edge_answer(edges)),) if edges and at_edges else ()),
            *((answered(EACH_KIND, of_kinds, kind_answer(of_kinds, edges)),) if edges and of_kinds else ()),
        ),
        finding=f"{headline(known)}; {saving(known)}." if known else "",
        headlines={"ladder": headline(known)} if known else {},
        tables=(
            in_four_digits(scenes),
            in_four_digits(estimates),
            *((by_scene(case.edge_trials, result.edges),) if edges else ()),
        ),
        conclusions=tuple(_conclusion(tolerance, scenes, table) for tolerance, table in known),
        captions={
            "ladder": (
                "(a) True error, beside fine boundary elements, against the error that the selected model estimates; "
                "below the line the estimate holds. (b) Cost of fine boundary elements over that of the selection. (c) "
                "Estimates of every model below boundary elements on every scene, selected or not. Filled: the first "
                "tolerance; open: others."
            )
        },
        unconverged=result.unconverged,
        page_tables=(_by_kind(case, scenes), _by_model(estimates), *((edges_by_kind(edges),) if edges else ())),
    )


def _calibrated_answer(estimates: Table) -> str:
    inside = within_claims(estimates)
    least, most = clopper_pearson(inside)
    return f"{inside.mean():.1%} of {inside.size} errors are within their claims ({least:.1%} to {most:.1%})."


def _claims(known: Sequence[tuple[float, Table]], numbers: Sequence[Number]) -> tuple[JudgedClaim, ...]:
    """What the case claims, with the numbers of each."""

    def judged(claim: str, quantity: str, answer: str) -> JudgedClaim:
        return answered(claim, numbers_with(numbers, quantity), answer)

    def at_each(shown: Callable[[Table], str]) -> str:
        return ", ".join(f"{shown(table)} at {tolerance:.0%}" for tolerance, table in known)

    return (
        judged(CLAIM, COVERAGE, f"the true error is within the estimated one in {at_each(_share)}."),
        judged(
            TIGHT, TIGHTNESS, f"the estimated error is {at_each(lambda t: f'{tightness(t):.2g} times')} the true one."
        ),
        judged(SAVES, SAVING, f"fine boundary elements take {at_each(lambda t: f'{saving_of(t):.3g} times')} as long."),
    )


def headline(known: Sequence[tuple[float, Table]]) -> str:
    """Coverage at all tolerances, from the least to the largest."""
    shares = [float(np.mean(covered(table))) for _, table in known]
    least, most = (f"{end:.0%}" for end in (min(shares), max(shares)))
    span = least if least == most else f"{least} to {most}"
    return f"{span} of true errors lie within their estimates, of 94 % wanted or more"


def saving(known: Sequence[tuple[float, Table]]) -> str:
    """In all scenes together, at all tolerances; less than one is a loss."""
    totals = [saving_of(table) for _, table in known]
    least, most = (f"{end:.2g}" for end in (min(totals), max(totals)))
    span = least if least == most else f"{least} to {most}"
    return f"fine boundary elements on every scene take {span} times as long as the selection"


def _share(table: Table) -> str:
    inside = covered(table)
    least, most = clopper_pearson(inside)
    return f"{inside.mean():.1%} of {inside.size} scenes ({least:.0%} to {most:.0%})"


def _conclusion(tolerance: float, scenes: Table, known: Table) -> str:
    """scenes: all of them, of which those with an answer and a reference are known."""
    true, met = known["true error"], known["met"] == 1
    mine = scenes.where(tolerance=tolerance)
    without = f"; without them the median is {np.median(known['saved'][met]):.3g}" if met.any() else ""
    median = resampled(known, lambda some: float(np.median(known["saved"][some])))
    total = resampled(known, lambda some: saving_of(known, some))
    return (
        f"At {tolerance:.0%}: the true error is within the estimated one in {_share(known)}, and within the tolerance "
        f"in {np.mean(true <= tolerance):.1%}; the estimated error is {tightness(known):.2g} times the true one in "
        "the median. Beside fine boundary elements on every scene, selection saves a factor "
        f"{np.median(known['saved']):.3g} ({median[0]:.2g} to {median[1]:.2g}) in the median, which depends on the "
        f"ranges that were drawn, and {saving_of(known):.3g} ({total[0]:.2g} to {total[1]:.2g}) in all scenes "
        "together, where those that need fine boundary elements count most. Scenes whose tolerance no model meets: "
        f"{np.count_nonzero(mine['met'] == 0)}{without}. Scenes without any answer: "
        f"{len(mine['kind']) - true.size}. Selected models: {_selected(mine)}."
    )


def _selected(table: Table) -> str:
    counts = {name: int(np.count_nonzero(table["model"] == name)) for name in (*MODELS, NONE)}
    return ", ".join(f"{name} ({count})" for name, count in counts.items() if count)


def _trials(result: CalibrationResult) -> Iterator[tuple[Outcome, Row]]:
    """Outcome of each trial, and the columns that both tables begin with."""
    for trial, outcome in zip(result.case.trials, result.outcomes, strict=True):
        yield outcome, {"kind": trial.kind, "number": trial.number, "quantity": trial.quantity}


def _scene(outcome: Outcome) -> Row:
    return {"h/d": float(outcome["height"]), "F / (E* h L)": float(outcome["load"])}


def _scenes(result: CalibrationResult) -> Table:
    rows: list[Row] = []
    for outcome, named in _trials(result):
        for i, tolerance in enumerate(result.case.tolerances):
            index, spent, fine = (float(outcome[name][i]) for name in ("model", "spent", "fine"))
            rows.append(
                {
                    **named,
                    "tolerance": tolerance,
                    **_scene(outcome),
                    "model": MODELS[int(index)] if index >= 0 else NONE,
                    "met": int(outcome["met"][i]),
                    "estimated error": float(outcome["estimated"][i]),
                    "true error": float(outcome["true"][i]),
                    "error of the reference": float(outcome["reference"]),
                    "selection [s]": spent,
                    "fine [s]": fine,
                    "saved": fine / spent if spent > 0 else math.nan,
                }
            )
    return table_of("scenes", rows)


def _estimates(result: CalibrationResult) -> Table:
    """A row a scene and model below boundary elements."""
    rows: list[Row] = [
        {**named, **_scene(outcome), "model": name, "estimated error": float(estimated), "true error": float(true)}
        for outcome, named in _trials(result)
        for name, estimated, true in zip(CHEAP, outcome["every estimated"], outcome["every true"], strict=True)
        if np.isfinite(true)
    ]
    return table_of("claims", rows)


def _by_kind(case: CalibrationTest, scenes: Table) -> Table:
    rows: list[Row] = []
    for kind, tolerance in product(KINDS, case.tolerances):
        mine = scenes.where(kind=kind, tolerance=tolerance)
        known = with_answer(mine)
        if known["kind"].size:
            rows.append(
                {
                    "scene": kind,
                    "tolerance": f"{tolerance:.0%}",
                    "scenes": len(mine["kind"]),
                    "tolerance met": int(mine["met"].sum()),
                    "true error within the estimate": f"{covered(known).mean():.0%}",
                    "median saving": f"{np.median(known['saved']):.3g}",
                    "selected models": _selected(mine),
                }
            )
    return table_of("Estimated errors, and the time that selection saves", rows)


def _by_model(estimates: Table) -> Table:
    """Of every model below boundary elements on all scenes: a wide estimate of one must not hide a narrow one."""
    rows: list[Row] = []
    for name in CHEAP:
        mine = estimates.where(model=name)
        inside, ratio = within_claims(mine), mine["true error"] / mine["estimated error"]
        if not inside.size:
            continue
        least, most = clopper_pearson(inside)
        rows.append(
            {
                "model": name,
                "scenes": int(inside.size),
                "true error within the estimate": f"{inside.mean():.0%} ({least:.0%} to {most:.0%})",
                "estimated over true error, median": f"{np.median(mine['estimated error'] / mine['true error']):.2g}",
                "true over estimated error, largest above 1": "never"
                if inside.all()
                else f"{ratio[~inside].max():.2g} times",
            }
        )
    return table_of("Estimated error of each model, selected or not", rows)


CHEAP_EDGES = tuple((kind, 1) for kind in (PUNCH, SPHERE, ROLLING, MEASURED + PUNCH, MEASURED + SPHERE))
"""Kinds of scenes at the edges whose references take seconds."""
MANY, ENOUGH, SOME, FEW = 210, 110, 20, 6
"""Scenes of a kind at the edges. 210 decide that 97 % hold where two do not, 100 where all do, and of some no answer is
tested. Moving wheels on measured tracks take 20 s each, so that there are fewer; rails have cases of their own: a few
are to find a false claim."""
EDGE_SCENES = (
    *((kind, MANY) for kind in (PUNCH, SPHERE, ROLLING, MEASURED + PUNCH, MEASURED + SPHERE)),
    *((kind, ENOUGH) for kind in (WHEEL, MEASURED + ROLLING)),
    (MEASURED + WHEEL, SOME),
    (RAIL, FEW),
)


CASE = Case(
    name="ladder",
    chapter=Chapter.SELECTION,
    place=1,
    claim=CLAIM,
    answers="Calibration test of model selection on random scenes: estimated and true error, and the time saved",
    quick=CalibrationTest(punches=4, edges=CHEAP_EDGES),
    full=CalibrationTest(
        punches=40, spheres=40, rolling=30, wheels=20, edges=EDGE_SCENES, tolerances=(0.03, 0.1, 0.3), seed=23
    ),
    run=run,
    evidence=evidence,
    needs="chosen scene by scene",
)
