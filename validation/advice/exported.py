"""The result of `compare` for other programs: strict JSON, and one table of all models."""

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from validation.advice.compare import Comparison, OneOrSeveral, comparisons_of
from validation.advice.table import (
    AXES,
    OF_FORCE,
    OF_POWER,
    OF_RAIL,
    PARTS,
    by_quantity,
    first_row,
    front_of,
    result_table,
    swept_of,
    tables_of_models,
)
from validation.advice.tolerance import decibels
from validation.analysis.contents import as_csv, as_json, finite_or_none
from validation.analysis.evidence import Table, table_of
from validation.scenes.scene import Scene

SCHEMA = 2
"""Of the JSON; 1 had no key of its own and no `predicted_error`, whose former name `claimed` stays for one release."""
SCHEMA_OF_JSON = Path(__file__).with_name("comparison.schema.json")
CSV = (
    *("wavelength_mm", "frequency_hz", "value", "low", "high", "unit", "model", "selected", "statistic"),
    *(*OF_RAIL, *OF_POWER, *OF_FORCE, "seconds", "swept", "swept_value", "swept_unit"),
    *("nominal_hz", "error", *(f"error_{name}" for name in PARTS), "status"),
)
"""Columns of `result_table` in a CSV, where the table has them; those of `front_of` follow."""


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
    records = list(map(_record_of_comparison, comparisons_of(comparison)))
    return as_json(records[0] if isinstance(comparison, Comparison) else records).decode()


def to_json_of(comparisons: Sequence[Comparison]) -> str:
    """The object of one comparison, or the list of several."""
    return to_json(comparisons if len(comparisons) > 1 else comparisons[0])


def _record_of_comparison(comparison: Comparison) -> dict[str, object]:
    """The object of one comparison that `SCHEMA_OF_JSON` describes, without infinities and NaN."""
    table = result_table(comparison)
    models = tables_of_models(table)
    columns: Mapping[str, Sequence[Any]] = next((model.columns for model in models if model["selected"][0]), {})
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
        **{name: _finite_numbers(columns.get(name, np.atleast_1d(comparison.value))) for name in ("value", "error")},
        "error_parts": {
            name: _finite_numbers(np.atleast_1d(halves)) for name, halves in comparison.error_parts.items()
        },
        **{name: _finite_numbers(getattr(comparison, name)) for name in AXES},
        **{name: _finite_numbers(columns.get(name, ())) for name in OF_RAIL},
        **swept_of(comparison),
        "assumed": assumed(comparison.scene),
        "notes": list(comparison.notes),
        "models": [_record_of_model(model) for model in models],
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
        roughness_dB, a3_dB and equivalent_dB, with a speed the sums of sound power, and former ones of the force; of
        all models their seconds; of a sweep its value. Then nominal_hz, error with error_model, error_grid and
        error_sample, status, quantity, tolerance (relative) and parameters of the scene in SI units, as scene.load. A
        cell is empty where there is no number.

    Examples
    --------
    >>> text = validation.to_csv(validation.compare(validation.load_scene("sphere")))
    >>> print(text.splitlines()[0][:61])
    wavelength_mm,frequency_hz,value,low,high,unit,model,selected
    """
    return as_csv(csv_table(comparisons_of(comparison))).decode()


def csv_table(comparisons: Sequence[Comparison]) -> Table:
    """The rows of all, one under another, behind the name of the scene, and of the quantity where these differ."""
    several, kinds = len(comparisons) > 1, len(by_quantity(comparisons)) > 1
    rows = list[dict[str, object]]()
    for comparison in comparisons:
        asked = front_of(comparison)
        first = {name: asked.pop(name) for name, leads in (("scene", several), ("quantity", kinds)) if leads}
        asked.pop("scene", None)
        rows += [first | row | asked for row in _rows_of_comparison(comparison)]
    return table_of(comparisons[0].quantity, rows)


def _rows_of_comparison(comparison: Comparison) -> list[dict[str, object]]:
    """Rows of the models that were solved, in the columns of CSV; one without a number where there is none."""
    table = result_table(comparison)
    solved = table.where(solved=True).columns if True in table.columns["solved"] else {}
    columns = {name: solved[name] for name in CSV if name in solved}
    rows = [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]
    none = dict.fromkeys(CSV[:5], math.nan) | {"unit": comparison.unit, "model": "", "selected": False}
    return rows or [none | (swept_of(comparison) if comparison.swept else {})]


def assumed(scene: Scene) -> dict[str, float]:
    """The contact of the smooth bodies, in SI units, and a damping ratio: a scene that was misread shows here."""
    assumptions = {"E_star_Pa": scene.modulus, "load_N": scene.load}
    if scene.mass is not None:
        assumptions["damping_ratio"] = scene.damping
    if (contact := scene.smooth_contact) is None:
        return assumptions
    axes = {"a_x_m": contact.along, "a_y_m": contact.across, "approach_m": contact.approach}
    return {**assumptions, **axes, "largest_pressure_Pa": contact.largest_pressure}


def _record_of_model(table: Table) -> dict[str, object]:
    """The entry of one model in the list "models" of a record; numbers that need a solve are None without one."""
    model, solved = first_row(table), bool(table["solved"][0])
    return {
        "model": model["model"],
        "is_mdr": model["is_mdr"],
        "status": model["status"],
        "predicted_error": finite_or_none(model["predicted_error"]),
        "claimed": finite_or_none(model["predicted_error"]),
        "error": finite_or_none(model["relative_error"]) if solved else None,
        "cost_s": finite_or_none(model["cost_s"]),
        "reason": model["reason"],
        "value": _finite_numbers(table["value"]) if solved else None,
        "seconds": finite_or_none(model.get("seconds", math.nan)),
        "sound_power_dBA": finite_or_none(model.get("sound_power_dBA", math.nan)),
        "force_sum_dBA": finite_or_none(model.get("force_sum_dBA", math.nan)),
    }


def _finite_numbers(values: Iterable[float]) -> list[float | None]:
    return [finite_or_none(value) for value in values]
