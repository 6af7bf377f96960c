"""What `compare` found as one table, from which text, page, CSV, JSON and figures are made.

All models that were solved stand beside the reference, the one with the smallest error: how far off they are, with both
errors, and how fast.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from validation.advice.compare import Comparison
from validation.advice.hierarchy import ALIKE, Candidate, bias
from validation.advice.sound_power import ContactForce
from validation.advice.tolerance import decibels, percentage
from validation.analysis.evidence import Table, table_of
from validation.analysis.spectra import assessed_bands
from validation.engine.engine import FloatArray
from validation.scenes.scene import parameters_of

TOGETHER = "both errors together: of the models the sum, of grid and sample the root of the sum of squares"
"""How the half-width of a difference follows from the errors of both models."""
AXES, NUMBERS = ("wavelength_mm", "frequency_hz", "nominal_hz"), ("value", "low", "high", "error")
OF_RAIL = ("roughness_dB", "a3_dB", "equivalent_dB", "force_dBA")
OF_POWER = ("sound_power_dBA", "sound_power_over_selected_dB")
OF_FORCE = ("force_sum_dBA", "force_over_selected_dB")
"""Former columns, as force_dBA of `OF_RAIL`: a force has the wrong weight, also for differences of filters."""
DIFFERENCES = ("difference_dB", "difference_error_dB")
PARTS = ("model", "grid", "sample")
"""Of an error, as `Comparison.error_parts_of` names them."""


def result_table(comparison: Comparison) -> Table:
    """What `compare` found: a row a number or a band of each model that was solved, and one row of each other model.

    Columns of each number, NaN where there is none
        wavelength_mm, frequency_hz, nominal_hz; value, low, high, error (half-width of 95 %), in ``unit``, and its
        parts error_model, error_grid and error_sample;
        difference_dB and difference_error_dB from the reference, and whether the tolerance counts there (is_counted);
        of a wheel q_a and amplitude; of a rail `OF_RAIL`.
    Columns of each model, equal in all of its rows
        rank (from the cheapest on), model, is_mdr, selected, is_reference, solved, answered (also without a result),
        status, reason, predicted_error and relative_error (infinite where unknown), errors_by_band (or of all bands
        together), cost_s (predicted), spent_s, seconds (by the clock, where all models were asked); of a rough body
        statistic, of a rail with a speed `OF_POWER` and `OF_FORCE`, of a sweep swept, swept_value, swept_unit.
    """
    solved, force = comparison.selection.solved, comparison.force
    reference = reference_of(comparison) if solved else None
    rows = list[dict[str, object]]()
    for rank, candidate in enumerate(comparison.models):
        columns: dict[str, Any] = {"rank": rank, **_columns_of_model(comparison, candidate, reference, force)}
        if reference is not None and candidate in solved:
            columns |= _columns_of_numbers(comparison, candidate, reference, force)
        cells = [np.ravel(column).tolist() for column in np.broadcast_arrays(*columns.values())]
        rows += [dict(zip(columns, row, strict=True)) for row in zip(*cells, strict=True)]
    # a scene may have no model at all
    return table_of(comparison.quantity, rows) if rows else Table(comparison.quantity, {"rank": [], "solved": []})


def rows_of(comparison: Comparison) -> list[dict[str, object]]:
    """Rows of `result_table` behind the scene, its parameters ("scene.load" in SI units), quantity and tolerance.

    Each has the seconds that the solves of its model took by the clock, NaN where it was not solved.
    """
    table = result_table(comparison).columns
    answers = {candidate.name: candidate.answer for candidate in comparison.models}
    front = front_of(comparison)
    rows = [dict(zip(table, cells, strict=True)) for cells in zip(*table.values(), strict=True)]
    return [
        front | row | {"seconds": answer.seconds if (answer := answers[str(row["model"])]) else math.nan}
        for row in rows
        if "model" in row
    ]


def front_of(comparison: Comparison) -> dict[str, object]:
    """What was asked: name and parameters of the scene, quantity, and tolerance (relative)."""
    parameters = {f"scene.{name}": value for name, value in parameters_of(comparison.scene).items() if name != "name"}
    asked = {"quantity": comparison.quantity, "tolerance": comparison.tolerance.relative}
    return {"scene": comparison.scene.name, **parameters, **asked}


def tables_of_models(table: Table) -> list[Table]:
    """The rows of each model, the cheapest first."""
    return [table.where(rank=rank) for rank in dict.fromkeys(table["rank"].tolist())]


def first_row(table: Table) -> dict[str, Any]:
    """The first row by column, as of what is equal in all rows of a model."""
    return {name: column[0] for name, column in table.columns.items()}


def has_numbers(table: Table, name: str) -> bool:
    """Whether a column is there, and not NaN throughout."""
    return name in table.columns and not np.isnan(table[name].astype(np.float64)).all()


def _columns_of_numbers(
    comparison: Comparison, candidate: Candidate, reference: Candidate, force: ContactForce | None
) -> dict[str, Any]:
    """All that a model that was solved has in each band."""
    value, half = comparison.value_of(candidate), comparison.errors_of(candidate)
    axes: dict[str, FloatArray] = {name: getattr(comparison, name) for name in AXES}
    columns: dict[str, Any] = {name: axis if axis.size else math.nan for name, axis in axes.items()}
    columns |= dict(zip(NUMBERS, (value, value - half, value + half, half), strict=True))
    columns |= {f"error_{name}": part for name, part in comparison.error_parts_of(candidate).items()}
    differing = differences(candidate, reference), error_of_difference(comparison, candidate)
    columns |= dict(zip(DIFFERENCES, differing, strict=True))
    columns["is_counted"] = counted_bands(comparison, reference)
    contact = comparison.scene.smooth_contact
    if comparison.roughness.size:
        roughness, a3 = comparison.roughness, comparison.a3_of(candidate)
        columns |= {"roughness_dB": roughness, "a3_dB": a3, "equivalent_dB": roughness + a3}
    elif contact and comparison.is_level:
        amplitude = candidate.solved_answer.value
        columns |= {"q_a": contact.along * comparison.wavenumbers, "amplitude": amplitude}
    return columns | ({"force_dBA": force.levels[candidate.name]} if force else {})


def _columns_of_model(
    comparison: Comparison, candidate: Candidate, reference: Candidate | None, force: ContactForce | None
) -> dict[str, object]:
    """What a model has once: its status, its errors, what it costs, and of what the comparison is."""
    answer, name = candidate.answer, candidate.name
    columns: dict[str, object] = {
        **dict.fromkeys((*AXES, *NUMBERS, *(f"error_{name}" for name in PARTS), *DIFFERENCES), math.nan),
        "is_counted": False,
        "unit": comparison.unit,
        "model": name,
        "is_mdr": candidate.is_mdr,
        "selected": name == comparison.model,
        "is_reference": candidate is reference,
        "solved": candidate in comparison.selection.solved,
        "answered": answer is not None,
        "status": candidate.status,
        "reason": candidate.reason,
        "predicted_error": candidate.predicted_error,
        "relative_error": candidate.error,
        "errors_by_band": bool(answer and answer.band_errors),
        "cost_s": candidate.cost,
        "spent_s": answer.cost.seconds if answer else math.nan,
    }
    if comparison.statistic:
        columns["statistic"] = comparison.statistic
    for of_sum, weighted in ((OF_POWER, comparison.power), (OF_FORCE, force)):
        if weighted:
            known = name in weighted.levels
            sums = (weighted.total(name), weighted.over_chosen(name)) if known else (math.nan, math.nan)
            columns |= dict(zip(of_sum, sums, strict=True))
    if comparison.timed:
        columns["seconds"] = comparison.seconds_of(candidate)
    return columns | (swept_of(comparison) if comparison.swept else {})


def swept_of(comparison: Comparison) -> dict[str, object]:
    """Key, value and unit of a sweep; None where there is none."""
    swept = comparison.swept
    return {"swept": swept and swept.key, "swept_value": swept and swept.value, "swept_unit": swept and swept.unit}


def by_quantity(comparisons: Sequence[Comparison]) -> dict[str, list[Comparison]]:
    """Comparisons by their quantity, in the order in which quantities first stand."""
    names = dict.fromkeys(comparison.quantity for comparison in comparisons)
    return {name: [comparison for comparison in comparisons if comparison.quantity == name] for name in names}


def reference_of(comparison: Comparison) -> Candidate:
    """The least biased of the solved models whose errors are alike the smallest, the dearest of several."""
    solved, least = comparison.selection.solved[::-1], comparison.selection.least_error
    alike = [candidate for candidate in solved if candidate.error <= ALIKE * least]
    return min(alike, key=lambda candidate: bias(candidate.solved_answer))


def differences(candidate: Candidate, reference: Candidate) -> np.ndarray:
    """Of the levels of two models, 20 lg of the ratio of their amplitudes [dB]."""
    assert candidate.answer is not None and reference.answer is not None  # as solved
    return np.asarray(20 * np.log10(candidate.answer.value / reference.answer.value))


def error_of_difference(comparison: Comparison, candidate: Candidate) -> np.ndarray:
    """Half-widths of 95 % of `differences` from the reference [dB]: `TOGETHER`; infinite where one is unknown."""
    parts = [
        {
            name: part / (1.0 if comparison.is_level else np.abs(comparison.value_of(model)))
            for name, part in errors.items()
        }
        for model in (candidate, reference_of(comparison))
        for errors in [comparison.error_parts_of(model)]
    ]
    random = [errors[name] for errors in parts for name in ("grid", "sample")]
    half_width = sum(errors["model"] for errors in parts) + np.sqrt(np.sum(np.square(random), axis=0))
    return np.asarray(half_width if comparison.is_level else 20 * np.log10(1 + half_width))


def counted_bands(comparison: Comparison, candidate: Candidate) -> NDArray[np.bool_]:
    """Mask of the bands in which the tolerance counts: of a rail, those of which more than next to nothing is left."""
    level = (
        comparison.a3_of(candidate) if comparison.roughness.size else np.zeros(np.size(comparison.value_of(candidate)))
    )
    return assessed_bands(level, comparison.scene_quantity.counted_above)


def shown_models(comparison: Comparison) -> list[str]:
    """Names of the solved models, in the order that a figure shows: selected, reference, MDR, the nearest others."""
    solved, reference = comparison.selection.solved, reference_of(comparison)
    chosen = comparison.selection.best or reference
    springs = min(
        (candidate for candidate in solved if candidate.is_mdr), key=lambda candidate: candidate.error, default=chosen
    )

    def distance(candidate: Candidate) -> float:
        off = differences(candidate, chosen)[counted_bands(comparison, chosen)]
        return float(np.sqrt(np.nanmean(off**2))) if np.isfinite(off).any() else math.inf

    first = [chosen.name, reference.name, springs.name]
    return list(dict.fromkeys([*first, *(candidate.name for candidate in sorted(solved, key=distance))]))


def speed_and_accuracy(comparison: Comparison) -> Table:
    """A row a model that was solved: seconds by the clock, and its distance from the reference.

    Columns model, selected, is_reference, seconds, error, low, high, unit; low and high end the interval of both errors
    together, NaN where one is unknown. As the tolerance counts it: the largest of the bands that count, of spectra the
    root mean square over bands. The reference has no distance: its high is the error that it has.
    """
    unit = "dB" if comparison.is_level else comparison.tolerance.unit

    def in_unit(level: float) -> float:
        return level if unit == "dB" else percentage(level)

    rows = list[dict[str, object]]()
    for table in _solved_models(comparison):
        model = first_row(table)
        if model["is_reference"]:
            own = decibels(model["relative_error"]) if unit == "dB" else 100 * model["relative_error"]
            error, low, high = math.nan, math.nan, own if math.isfinite(own) else math.nan
        else:
            error, half = map(in_unit, _distance_from_reference(table, worst=comparison.scene_quantity.by_worst_band))
            low, high = (max(error - half, 0.0), error + half) if math.isfinite(half) else (math.nan, math.nan)
        same = {name: model[name] for name in ("model", "selected", "is_reference")}
        seconds = model.get("seconds", math.nan)
        rows.append({**same, "seconds": seconds, "error": error, "low": low, "high": high, "unit": unit})
    return table_of(comparison.quantity, rows)


def _solved_models(comparison: Comparison) -> Iterator[Table]:
    """The rows of each model that was solved."""
    return (table for table in tables_of_models(result_table(comparison)) if table["solved"][0])


def _distance_from_reference(table: Table, *, worst: bool) -> tuple[float, float]:
    """Distance of a model from the reference, and its half-width of 95 % [dB]. worst: of the band that is farthest."""
    off, half = np.abs(table["difference_dB"]), table["difference_error_dB"]
    within = table["is_counted"] & np.isfinite(off)
    if not within.any():
        return math.nan, math.nan
    if worst:
        at = int(np.argmax(np.where(within, off, -1.0)))
        return float(off[at]), float(half[at])
    return float(np.sqrt(np.mean(off[within] ** 2))), float(np.sqrt(np.mean(half[within] ** 2)))
