"""The result of `compare` for other programs: strict JSON, and one table of all models."""

import math
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from validation.advice.columns import levels_of
from validation.advice.compare import Comparison, OneOrSeveral, listed
from validation.advice.contact_force import ContactForce
from validation.advice.hierarchy import Candidate
from validation.advice.tolerance import decibels
from validation.analysis.contents import as_csv, as_json, finite_or_none
from validation.analysis.evidence import Table, table_of
from validation.scenes.scene import Scene

SCHEMA = 2
"""Of the JSON; 1 had no key of its own and no `predicted_error`, whose former name `claimed` stays for one release."""
SCHEMA_OF_JSON = Path(__file__).with_name("comparison.schema.json")
AXES, OF_RAIL = ("wavelength_mm", "frequency_hz"), ("roughness_dB", "a3_dB", "equivalent_dB", "force_dBA")


def to_json(comparison: OneOrSeveral) -> str:
    """Result of a comparison as strict JSON, for other programs.

    Parameters
    ----------
    comparison : Comparison or list of Comparison
        What `compare` returns; of a list, a list.

    Returns
    -------
    str
        An object as validation/advice/comparison.schema.json describes it; null for what is not known.

    Examples
    --------
    >>> import json
    >>> result = json.loads(validation.to_json(validation.compare(validation.load_scene("sphere"))))
    >>> result["quantity"], result["unit"], result["model"], result["met"]
    ('stiffness', 'N/m', 'closed form', True)
    """
    records = list(map(_record_of_comparison, listed(comparison)))
    return as_json(records[0] if isinstance(comparison, Comparison) else records).decode()


def to_json_of(comparisons: Sequence[Comparison]) -> str:
    """The object of one comparison, or the list of several."""
    return to_json(comparisons if len(comparisons) > 1 else comparisons[0])


def _record_of_comparison(comparison: Comparison) -> dict[str, object]:
    """The object of one comparison that `SCHEMA_OF_JSON` describes, without infinities and NaN."""
    best, force = comparison.selection.best, comparison.force
    levels = levels_of(comparison, best, force)
    parts = comparison.error_parts_of(best) if best else {}
    return {
        "schema_version": SCHEMA,
        "scene": comparison.scene.name,
        "quantity": comparison.quantity,
        "unit": comparison.unit,
        "tolerance": comparison.tolerance.relative,
        "tolerance_dB": decibels(comparison.tolerance.relative),
        "met": comparison.met,
        "statistic": comparison.statistic or None,
        "beyond_elasticity": comparison.beyond_elasticity or None,
        "model": comparison.model or None,
        **{name: _finite_numbers(levels[name]) for name in ("value", "error")},
        "error_parts": {name: _finite_numbers(halves) for name, halves in parts.items()},
        **{name: _finite_numbers(levels.get(name, ())) for name in (*AXES, "nominal_hz", *OF_RAIL)},
        **swept_of(comparison),
        "assumed": assumed(comparison.scene),
        "notes": list(comparison.scene.diagnose()),
        "models": [_record_of_model(comparison, candidate, force) for candidate in comparison.models],
    }


def to_csv(comparison: OneOrSeveral) -> str:
    """Result of a comparison as CSV: a row a number or a band, of each model that was solved.

    Parameters
    ----------
    comparison : Comparison or list of Comparison
        What `compare` returns; of a list, one under another, with the name of the scene in a first column.

    Returns
    -------
    str
        Columns wavelength_mm, frequency_hz, value, low, high, unit, model, selected; low and high end the 95 %
        interval; of rough bodies statistic, "ensemble mean" or "single surface". Of a rail also the levels
        roughness_dB, a3_dB and equivalent_dB, with a speed those of the force; of all models their seconds; of a sweep
        its value. A cell is empty where there is no number.

    Examples
    --------
    >>> text = validation.to_csv(validation.compare(validation.load_scene("sphere")))
    >>> print(text.splitlines()[0])
    wavelength_mm,frequency_hz,value,low,high,unit,model,selected
    """
    return as_csv(table_of_several(listed(comparison))).decode()


def table_of_several(comparisons: Sequence[Comparison]) -> Table:
    """The rows of all, one under another, behind the name of the scene, and of the quantity where these differ."""
    several, kinds = len(comparisons) > 1, len(by_quantity(comparisons)) > 1
    rows = list[dict[str, object]]()
    for comparison in comparisons:
        front = ({"scene": comparison.scene.name} if several else {}) | (
            {"quantity": comparison.quantity} if kinds else {}
        )
        rows += [front | row for row in _rows_of_comparison(comparison)]
    return table_of(comparisons[0].quantity, rows)


def by_quantity(comparisons: Sequence[Comparison]) -> dict[str, list[Comparison]]:
    """Comparisons by their quantity, in the order in which quantities first stand."""
    names = dict.fromkeys(comparison.quantity for comparison in comparisons)
    return {name: [comparison for comparison in comparisons if comparison.quantity == name] for name in names}


def _rows_of_comparison(comparison: Comparison) -> list[dict[str, object]]:
    """A row a number or a band, of each model that was solved; NaN where there is no number."""
    force, swept = comparison.force, swept_of(comparison) if comparison.swept else {}
    rows = [row for candidate in comparison.selection.solved for row in _rows_of_model(comparison, candidate, force)]
    none = dict.fromkeys((*AXES, "value", "low", "high"), math.nan)
    return [row | swept for row in rows or [{**none, "unit": comparison.unit, "model": "", "selected": False}]]


def _rows_of_model(comparison: Comparison, candidate: Candidate, force: ContactForce | None) -> list[dict[str, object]]:
    """Rows of one model, a band each; columns of a rail, its force and the clock where the comparison has them."""
    levels = levels_of(comparison, candidate, force)
    value, half = levels["value"], levels["error"]
    columns: dict[str, Any] = {name: levels[name] if levels[name].size else math.nan for name in AXES}
    columns |= {"value": value, "low": value - half, "high": value + half}
    columns |= {"unit": comparison.unit, "model": candidate.name, "selected": candidate.name == comparison.model}
    columns |= {"statistic": comparison.statistic} if comparison.statistic else {}
    columns |= {name: levels[name] for name in OF_RAIL if name in levels}
    if force:
        columns |= {
            "force_sum_dBA": force.total(candidate.name),
            "force_over_selected_dB": force.over_chosen(candidate.name),
        }
    if comparison.timed:
        columns["seconds"] = comparison.seconds_of(candidate)
    cells = [np.broadcast_to(column, value.shape).tolist() for column in columns.values()]
    return [dict(zip(columns, row, strict=True)) for row in zip(*cells, strict=True)]


def swept_of(comparison: Comparison) -> dict[str, object]:
    """Key, value and unit of a sweep; None where there is none."""
    swept = comparison.swept
    return {"swept": swept and swept.key, "swept_value": swept and swept.value, "swept_unit": swept and swept.unit}


def assumed(scene: Scene) -> dict[str, float]:
    """The contact of the smooth bodies, in SI units, and a damping ratio: a scene that was misread shows here."""
    assumptions = {"E_star_Pa": scene.modulus, "load_N": scene.load}
    if scene.mass is not None:
        assumptions["damping_ratio"] = scene.damping
    if (contact := scene.smooth_contact) is None:
        return assumptions
    axes = {"a_x_m": contact.along, "a_y_m": contact.across, "approach_m": contact.approach}
    return {**assumptions, **axes, "largest_pressure_Pa": contact.largest_pressure}


def _record_of_model(comparison: Comparison, candidate: Candidate, force: ContactForce | None) -> dict[str, object]:
    """The entry of one model in the list "models" of a record; numbers that need a solve are None without one."""
    solved = candidate in comparison.selection.solved
    return {
        "model": candidate.name,
        "is_mdr": candidate.is_mdr,
        "status": candidate.status,
        "predicted_error": finite_or_none(candidate.predicted_error),
        "claimed": finite_or_none(candidate.predicted_error),
        "error": finite_or_none(candidate.error) if solved else None,
        "cost_s": finite_or_none(candidate.cost),
        "reason": candidate.reason,
        "value": _finite_numbers(comparison.value_of(candidate)) if solved else None,
        "seconds": finite_or_none(comparison.seconds_of(candidate)),
        "force_sum_dBA": finite_or_none(force.total(candidate.name))
        if force and candidate.name in force.levels
        else None,
    }


def _finite_numbers(values: Iterable[float]) -> list[float | None]:
    return [finite_or_none(value) for value in values]
