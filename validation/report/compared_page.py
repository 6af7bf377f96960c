"""The page of `compare --report`: each scene as it was understood, its answer, and what every model says and costs."""

import base64
from collections.abc import Mapping, Sequence
from pathlib import Path

import jinja2

from validation.analysis.contents import as_csv, as_json
from validation.report.compared import figure_of
from validation.scenes.description import describe
from validation.scenes.rolling import RollingScene
from validation.selection.compare import Comparison
from validation.selection.contact_force import LEVELS, contact_force
from validation.selection.exported import SCHEMA_OF_JSON, by_quantity, table_of_several, to_json_of
from validation.selection.hierarchy import Candidate
from validation.selection.quantities import MOVING
from validation.selection.several import overview_of
from validation.selection.side_by_side import (
    TOGETHER,
    differences,
    error_of_difference,
    half_width,
    levels_beside,
    numbers_beside,
    per_cent,
    reference_of,
)
from validation.selection.summary import (
    ASSUMED,
    age_of_errors,
    bands_of,
    became_of,
    claim_of,
    cost_of,
    format_seconds,
    found_of,
    label,
    result_of,
    sentences_on_mdr,
    took_by,
    what_would_help,
)
from validation.selection.tolerance import short

PAGE, JSON, SCHEMA, CSV = "index.html", "comparison.json", "comparison.schema.json", "data/levels.csv"
Columns = Mapping[str, Sequence[str]]


def files_of_comparison(found: Sequence[Comparison], about: dict[str, object]) -> dict[str, bytes]:
    """All that the folder holds, the page last. about: its provenance."""
    files = {
        JSON: to_json_of(found).encode(),
        CSV: as_csv(table_of_several(found)),
        SCHEMA: SCHEMA_OF_JSON.read_bytes(),
        "provenance.json": as_json(about),
    }
    drawn = {f"scene-{i}": [one] for i, one in enumerate(found, 1) if one.selection.solved}
    if len(found) > len(by_quantity(found)) and drawn:
        drawn["all"] = list(found)
    for name, of in drawn.items():
        for form in ("svg", "pdf"):
            files[f"figures/{name}.{form}"] = figure_of(of, form)
    files[PAGE] = _page(found, files, about)
    return files


def _page(found: Sequence[Comparison], files: Mapping[str, bytes], about: dict[str, object]) -> bytes:
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent / "templates"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    text = environment.get_template("comparison.html").render(
        title=_asked(found[0]) if len(found) == 1 else _asked_of_several(found),
        scenes=[_of_scene(f"scene-{i}", one) for i, one in enumerate(found, 1)],
        overview=overview_of(found) if len(found) > 1 else None,
        pictures={
            Path(name).stem: "data:image/svg+xml;base64," + base64.b64encode(contents).decode()
            for name, contents in files.items()
            if name.endswith(".svg")
        },
        about=about,
        zip=zip,
    )
    return (text + "\n").encode()


def _of_scene(name: str, found: Comparison) -> dict[str, object]:
    """What the template shows of a scene."""
    best, scene = found.selection.best, found.scene
    beside = len(found.selection.solved) > 1
    letters, levels = levels_beside(found) if beside and found.is_level else ({}, {})
    return {
        "name": name,
        "asked": _asked(found),
        "met": found.met,
        "answer": result_of(found, best.answer) if best and best.answer else "No model has a result with a known error",
        "counted": best.answer.counted if best and best.answer else "",
        "on_mdr": sentences_on_mdr(found),
        "help": list(what_would_help(found)),
        "notes": _notes(found),
        "understood": (*describe(scene), ("assumed", ASSUMED)),
        "models": [_model_row(found, one) for one in found.models],
        "bands": bands_of(found, best) if best and found.is_level else None,
        "levels": LEVELS if found.roughness.size else "",
        "force": contact_force(found),
        "timed": found.timed,
        "beside": levels or (numbers_beside(found) if beside else None),
        "letters": letters,
        "reference": reference_of(found).name if beside else "",
        "unit": found.unit,
        "together": TOGETHER,
        "age": age_of_errors(found),
        "cost": cost_of(found),
        "alternative": f"{found.quantity} of {scene.name} by {', '.join(one.name for one in found.selection.solved)}",
    }


def _model_row(found: Comparison, one: Candidate) -> dict[str, str]:
    return {
        "model": label(one),
        "claims": claim_of(found, one),
        "found": found_of(found, one),
        "apart": _apart(found, one),
        "cost": format_seconds(one.cost),
        "took": took_by(found, one),
        "became": became_of(one),
        "why": one.reason,
        "selected": "selected" if one.name == found.model else "",
    }


def _apart(found: Comparison, one: Candidate) -> str:
    """The largest difference from the model with the smallest error, in any band."""
    if one not in found.selection.solved:
        return "—"
    reference = reference_of(found)
    if one is reference:
        return "—"
    off = differences(one, reference)
    worst = abs(off).argmax()
    largest, error = (float(values[worst]) for values in (off, error_of_difference(found, one, reference)))
    if found.is_level or found.in_decibels:
        return f"{'+' if largest > 0 else ''}{short(largest)} {half_width(error)} dB"
    return f"{per_cent(largest):+.2g} {half_width(per_cent(error))} %"


def _asked(found: Comparison) -> str:
    return f"{found.scene.name}: {found.quantity} within {found.tolerance}"


def _asked_of_several(found: Sequence[Comparison]) -> str:
    scenes = list(dict.fromkeys(one.scene.name for one in found))
    of = scenes[0] if len(scenes) == 1 else f"{len(scenes)} scenes"
    return f"{of}: {', '.join(by_quantity(found))} within {found[0].tolerance}"


def _notes(found: Comparison) -> list[str]:
    """Why there is no steady answer, and what may be wrong about the scene."""
    scene = found.scene
    reason = scene.no_steady_answer() if isinstance(scene, RollingScene) and found.quantity in MOVING else ""
    return [*([f"no steady answer: {reason}"] if reason else []), *scene.diagnose()]
