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
from validation.analysis.contents import as_csv, as_json
from validation.analysis.evidence import Table
from validation.scenes.scene import Scene

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
    >>> found = json.loads(validation.to_json(validation.compare(validation.load_scene("sphere"))))
    >>> found["quantity"], found["unit"], found["model"], found["met"]
    ('stiffness', 'N/m', 'closed form', True)
    """
    found = [_found(one) for one in listed(comparison)]
    return as_json(found[0] if isinstance(comparison, Comparison) else found).decode()


def to_json_of(comparisons: Sequence[Comparison]) -> str:
    """The object of one comparison, or the list of several."""
    return to_json(comparisons if len(comparisons) > 1 else comparisons[0])


def _found(comparison: Comparison) -> dict[str, object]:
    best, force = comparison.selection.best, comparison.force
    levels = levels_of(comparison, best, force)
    parts = comparison.error_parts_of(best) if best else {}
    return {
        "scene": comparison.scene.name,
        "quantity": comparison.quantity,
        "unit": comparison.unit,
        "tolerance": comparison.tolerance.relative,
        "tolerance_dB": decibels(comparison.tolerance.relative),
        "met": comparison.met,
        "statistic": comparison.statistic or None,
        "beyond_elasticity": comparison.beyond_elasticity or None,
        "model": comparison.model or None,
        **{name: _numbers(levels[name]) for name in ("value", "error")},
        "error_parts": {name: _numbers(halves) for name, halves in parts.items()},
        **{name: _numbers(levels.get(name, ())) for name in (*AXES, "nominal_hz", *OF_RAIL)},
        **swept_of(comparison),
        "assumed": assumed(comparison.scene),
        "notes": list(comparison.scene.diagnose()),
        "models": [_became(comparison, one, force) for one in comparison.models],
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
    for one in comparisons:
        front = ({"scene": one.scene.name} if several else {}) | ({"quantity": one.quantity} if kinds else {})
        rows += [front | row for row in _rows(one)]
    names = dict.fromkeys(name for row in rows for name in row)
    return Table(comparisons[0].quantity, {name: [row.get(name, math.nan) for row in rows] for name in names})


def by_quantity(comparisons: Sequence[Comparison]) -> dict[str, list[Comparison]]:
    """In the order in which they were asked."""
    return {name: [one for one in comparisons if one.quantity == name] for name in (o.quantity for o in comparisons)}


def _rows(comparison: Comparison) -> list[dict[str, object]]:
    """A row a number or a band, of each model that was solved; NaN where there is no number."""
    force, swept = comparison.force, swept_of(comparison) if comparison.swept else {}
    found = [row for one in comparison.selection.solved for row in _rows_of_model(comparison, one, force)]
    none = dict.fromkeys((*AXES, "value", "low", "high"), math.nan)
    return [row | swept for row in found or [{**none, "unit": comparison.unit, "model": "", "selected": False}]]


def _rows_of_model(comparison: Comparison, one: Candidate, force: ContactForce | None) -> list[dict[str, object]]:
    """Those of a rail, of its force and of a clock where there are such."""
    levels = levels_of(comparison, one, force)
    value, half = levels["value"], levels["error"]
    found: dict[str, Any] = {name: levels[name] if levels[name].size else math.nan for name in AXES}
    found |= {"value": value, "low": value - half, "high": value + half}
    found |= {"unit": comparison.unit, "model": one.name, "selected": one.name == comparison.model}
    found |= {"statistic": comparison.statistic} if comparison.statistic else {}
    found |= {name: levels[name] for name in OF_RAIL if name in levels}
    if force:
        found |= {"force_sum_dBA": force.total(one.name), "force_over_selected_dB": force.over_chosen(one.name)}
    if comparison.timed:
        found["seconds"] = comparison.seconds_of(one)
    columns = [np.broadcast_to(of, value.shape).tolist() for of in found.values()]
    return [dict(zip(found, row, strict=True)) for row in zip(*columns, strict=True)]


def swept_of(comparison: Comparison) -> dict[str, object]:
    """Key, value and unit of a sweep; None where there is none."""
    swept = comparison.swept
    return {"swept": swept and swept.key, "swept_value": swept and swept.value, "swept_unit": swept and swept.unit}


def assumed(scene: Scene) -> dict[str, float]:
    """The contact of the smooth bodies, in SI units, and a damping ratio: a scene that was misread shows here."""
    found = {"E_star_Pa": scene.modulus, "load_N": scene.load}
    if scene.mass is not None:
        found["damping_ratio"] = scene.damping
    if (contact := scene.smooth_contact) is None:
        return found
    axes = {"a_x_m": contact.along, "a_y_m": contact.across, "approach_m": contact.approach}
    return {**found, **axes, "largest_pressure_Pa": contact.largest_pressure}


def _became(comparison: Comparison, one: Candidate, force: ContactForce | None) -> dict[str, object]:
    solved = one in comparison.selection.solved
    return {
        "model": one.name,
        "is_mdr": one.is_mdr,
        "status": one.status,
        "claimed": _number(one.claimed),
        "error": _number(one.error) if solved else None,
        "cost_s": _number(one.cost),
        "reason": one.reason,
        "value": _numbers(comparison.value_of(one)) if solved else None,
        "seconds": _number(comparison.seconds_of(one)),
        "force_sum_dBA": _number(force.total(one.name)) if force and one.name in force.levels else None,
    }


def _numbers(values: Iterable[float]) -> list[float | None]:
    return [_number(value) for value in values]


def _number(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
