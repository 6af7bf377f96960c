"""The result of `compare` for other programs: strict JSON, and one table of all models that were solved."""

import math
from collections.abc import Iterable, Sequence
from pathlib import Path

from validation.analysis.contents import as_csv, as_json
from validation.analysis.evidence import Table, table_of
from validation.scenes.indentation import IndentationScene
from validation.scenes.load import Scene
from validation.scenes.rail import RailScene
from validation.selection.compare import Comparison
from validation.selection.hierarchy import Candidate
from validation.selection.one_or_several import OneOrSeveral, listed

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
    found = [_found(one) for one in comparisons]
    return as_json(found if len(found) > 1 else found[0]).decode()


def _found(comparison: Comparison) -> dict[str, object]:
    best = comparison.selection.best
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
        "assumed": assumed(comparison.scene),
        "models": [_became(comparison, one) for one in comparison.models],
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
        interval. A cell is empty where there is no number.

    Examples
    --------
    >>> text = validation.to_csv(validation.compare(validation.load_scene("sphere")))
    >>> print(text.splitlines()[0])
    wavelength_mm,frequency_hz,value,low,high,unit,model,selected
    """
    from validation.selection.several import table_of_several  # which is made of this module's tables

    if isinstance(comparison, Comparison):
        return as_csv(levels_of_models(comparison)).decode()
    return as_csv(table_of_several(listed(comparison))).decode()


def levels_of_models(comparison: Comparison) -> Table:
    """A row a number or a band, of each model that was solved; NaN where there is no number."""
    none = {"wavelength_mm": math.nan, "frequency_hz": math.nan, "value": math.nan, "low": math.nan, "high": math.nan}
    rows: list[dict[str, object]] = []
    for one in comparison.selection.solved:
        value, half = comparison.value_of(one), comparison.errors_of(one)
        for i in range(value.size):
            place = {
                name: float(numbers[i]) if numbers.size else math.nan
                for name, numbers in (
                    ("wavelength_mm", comparison.wavelength_mm),
                    ("frequency_hz", comparison.frequency_hz),
                )
            }
            low, high = float(value[i] - half[i]), float(value[i] + half[i])
            named = {"unit": comparison.unit, "model": one.name, "selected": one.name == comparison.model}
            rows.append({**place, "value": float(value[i]), "low": low, "high": high, **named})
    return table_of(comparison.quantity, rows or [{**none, "unit": comparison.unit, "model": "", "selected": False}])


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


def _became(comparison: Comparison, one: Candidate) -> dict[str, object]:
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
    }


def _parts(comparison: Comparison, one: Candidate) -> dict[str, list[float | None]]:
    """Half-widths of model, grid and sample, in the unit of the error."""
    return {name: _numbers(halves) for name, halves in comparison.error_parts_of(one).items()}


def _numbers(values: Iterable[float]) -> list[float | None]:
    return [_number(value) for value in values]


def _number(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
