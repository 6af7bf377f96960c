"""The result of `compare` for other programs: strict JSON, and one table of all models that were solved."""

import math
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from validation.analysis.contents import as_csv, as_json
from validation.analysis.evidence import Table, table_of
from validation.scenes.indentation import IndentationScene
from validation.scenes.load import Scene
from validation.scenes.rail import RailScene
from validation.selection.compare import Comparison, OneOrSeveral, listed
from validation.selection.contact_force import ContactForce, contact_force
from validation.selection.hierarchy import Candidate

SCHEMA_OF_JSON = Path(__file__).with_name("comparison.schema.json")


def to_json(comparison: OneOrSeveral) -> str:
    """Result of a comparison as strict JSON, for other programs.

    Parameters
    ----------
    comparison : Comparison or list of Comparison
        What `compare` returns; of a list, a list.

    Returns
    -------
    str
        An object as validation/selection/comparison.schema.json describes it; null for what is not known.

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
    best, force = comparison.selection.best, contact_force(comparison)
    roughness = comparison.roughness if best else np.empty(0)
    a3 = comparison.a3_of(best) if best and roughness.size else np.empty(0)
    return {
        "scene": comparison.scene.name,
        "quantity": comparison.quantity,
        "unit": comparison.unit,
        "tolerance": comparison.tolerance.relative,
        "tolerance_dB": 20 * math.log10(1 + comparison.tolerance.relative),
        "met": comparison.met,
        "model": comparison.model or None,
        "value": _numbers(comparison.value),
        "error": [None] * comparison.value.size if best is None else _numbers(comparison.errors_of(best)),
        "error_parts": {} if best is None else _parts(comparison, best),
        "wavelength_mm": _numbers(comparison.wavelength_mm),
        "frequency_hz": _numbers(comparison.frequency_hz),
        "nominal_hz": _numbers(comparison.nominal_hz),
        "roughness_dB": _numbers(roughness),
        "a3_dB": _numbers(a3),
        "equivalent_dB": _numbers(roughness + a3),
        "force_dBA": _numbers(force.levels[force.chosen]) if force else [],
        **swept_of(comparison),
        "assumed": assumed(comparison.scene),
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
        interval. Of a rail also the levels roughness_dB, a3_dB and equivalent_dB, with a speed those of the force; of
        all models their seconds; of a sweep its value. A cell is empty where there is no number.

    Examples
    --------
    >>> text = validation.to_csv(validation.compare(validation.load_scene("sphere")))
    >>> print(text.splitlines()[0])
    wavelength_mm,frequency_hz,value,low,high,unit,model,selected
    """
    return as_csv(table_of_several(listed(comparison))).decode()


def table_of_several(comparisons: Sequence[Comparison]) -> Table:
    """The tables of all, one under another, behind the name of the scene, and of the quantity where these differ."""
    tables = [levels_of_models(one) for one in comparisons]
    if len(tables) == 1:
        return tables[0]
    counts = [len(table["value"]) for table in tables]
    front = {"scene": [one.scene.name for one in comparisons]}
    if len(by_quantity(comparisons)) > 1:
        front["quantity"] = [one.quantity for one in comparisons]
    repeated = {name: [v for v, n in zip(of, counts, strict=True) for _ in range(n)] for name, of in front.items()}
    columns = {
        name: [v for table, n in zip(tables, counts, strict=True) for v in table.columns.get(name, [math.nan] * n)]
        for name in dict.fromkeys(name for table in tables for name in table.columns)
    }
    return Table(comparisons[0].quantity, {**repeated, **columns})


def by_quantity(comparisons: Sequence[Comparison]) -> dict[str, list[Comparison]]:
    """In the order in which they were asked."""
    return {name: [one for one in comparisons if one.quantity == name] for name in (o.quantity for o in comparisons)}


def levels_of_models(comparison: Comparison) -> Table:
    """A row a number or a band, of each model that was solved; NaN where there is no number."""
    force = contact_force(comparison)
    found = [_columns(comparison, one, force) for one in comparison.selection.solved]
    if not found:
        none = dict.fromkeys(("wavelength_mm", "frequency_hz", "value", "low", "high"), math.nan)
        swept = swept_of(comparison) if comparison.swept else {}
        row = {**none, "unit": comparison.unit, "model": "", "selected": False, **swept}
        return table_of(comparison.quantity, [row])
    return Table(comparison.quantity, {name: [value for one in found for value in one[name]] for name in found[0]})


def _columns(comparison: Comparison, one: Candidate, force: ContactForce | None) -> dict[str, list[object]]:
    """Of one model; those of a rail, of its force, of a clock and of a sweep where there are such."""
    value, half = comparison.value_of(one), comparison.errors_of(one)
    found: dict[str, Any] = {
        "wavelength_mm": comparison.wavelength_mm if comparison.is_level else math.nan,
        "frequency_hz": comparison.frequency_hz if comparison.frequency_hz.size else math.nan,
        **{"value": value, "low": value - half, "high": value + half},
        **{"unit": comparison.unit, "model": one.name, "selected": one.name == comparison.model},
    }
    if comparison.roughness.size:
        a3 = comparison.a3_of(one)
        found |= {"roughness_dB": comparison.roughness, "a3_dB": a3, "equivalent_dB": comparison.roughness + a3}
    if force:
        found |= {"force_dBA": force.levels[one.name], "force_sum_dBA": force.total(one.name)}
        found |= {"force_over_selected_dB": force.over_chosen(one.name)}
    if comparison.timed:
        found["seconds"] = comparison.seconds_of(one)
    found |= swept_of(comparison) if comparison.swept else {}
    return {name: np.broadcast_to(np.asarray(of), value.shape).tolist() for name, of in found.items()}


def swept_of(comparison: Comparison) -> dict[str, object]:
    """Key, value and unit of a sweep; None where there is none."""
    swept = comparison.swept
    return {"swept": swept and swept.key, "swept_value": swept and swept.value, "swept_unit": swept and swept.unit}


def assumed(scene: Scene) -> dict[str, float]:
    """The contact of the smooth bodies, in SI units: a scene that was misread shows here."""
    found = {"E_star_Pa": scene.modulus, "load_N": scene.load}
    if isinstance(scene, RailScene):
        a_x, a_y = scene.contact.along, scene.contact.across
        approach = scene.contact.approach
    elif isinstance(scene, IndentationScene) and scene.shape == "punch":
        return found
    else:
        a_x = a_y = scene.contact_radius
        approach = scene.approach
    pressure = 1.5 * scene.load / (math.pi * a_x * a_y)
    return {**found, "a_x_m": a_x, "a_y_m": a_y, "approach_m": approach, "largest_pressure_Pa": pressure}


def _became(comparison: Comparison, one: Candidate, force: ContactForce | None) -> dict[str, object]:
    solved = one in comparison.selection.solved
    return {
        "model": one.name,
        "is_mdr": one.model.is_mdr,
        "status": one.status,
        "claimed": _number(one.claimed),
        "error": _number(one.error) if solved else None,
        "cost_s": _number(one.cost),
        "reason": one.reason,
        "value": _numbers(comparison.value_of(one)) if solved else None,
        "seconds": _number(comparison.seconds_of(one)),
        "force_sum_dBA": _number(force.total(one.name)) if force and one.name in force.levels else None,
    }


def _parts(comparison: Comparison, one: Candidate) -> dict[str, list[float | None]]:
    """Half-widths of model, grid and sample, in the unit of the error."""
    return {name: _numbers(halves) for name, halves in comparison.error_parts_of(one).items()}


def _numbers(values: Iterable[float]) -> list[float | None]:
    return [_number(value) for value in values]


def _number(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
