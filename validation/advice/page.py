"""The page of `compare --report`: each scene as it was understood, its answer, and what every model says and costs."""

import base64
from collections.abc import Mapping, Sequence
from pathlib import Path

from validation.advice import advice, columns, side_by_side, summary
from validation.advice import advice as on_mdr
from validation.advice.compare import Comparison
from validation.advice.contact_force import LEVELS
from validation.advice.exported import SCHEMA_OF_JSON, by_quantity, table_of_several, to_json_of
from validation.advice.figure import to_figure
from validation.analysis.contents import as_csv, as_json
from validation.report.formats import templates
from validation.scenes.description import describe

TEMPLATES = Path(__file__).parent / "templates"
PAGE, JSON, SCHEMA, CSV = "index.html", "comparison.json", "comparison.schema.json", "data/levels.csv"


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
            files[f"figures/{name}.{form}"] = to_figure(of, form=form)
    files[PAGE] = _page(found, files, about)
    return files


def _page(found: Sequence[Comparison], files: Mapping[str, bytes], about: dict[str, object]) -> bytes:
    pictures = {
        Path(name).stem: "data:image/svg+xml;base64," + base64.b64encode(contents).decode()
        for name, contents in files.items()
        if name.endswith(".svg")
    }
    page = templates(TEMPLATES).get_template("comparison.html")
    text = page.render(
        title=_asked(found),
        scenes=[_of_scene(f"scene-{i}", one) for i, one in enumerate(found, 1)],
        overview=columns.overview_of(found) if len(found) > 1 else None,
        pictures=pictures,
        together=side_by_side.TOGETHER,
        about=about,
    )
    return f"{text}\n".encode()


def _of_scene(name: str, found: Comparison) -> dict[str, object]:
    """What the template shows of a scene."""
    best = found.selection.best
    answer = best.answer if best else None
    beside = len(found.selection.solved) > 1
    letters, levels = columns.levels_beside(found) if beside and found.is_level else ({}, {})
    return {
        "name": name,
        "asked": _asked([found]),
        "found": found,
        "answer": summary.result_of(found, answer) if answer else "No model has a result with a known error",
        "counted": answer.counted if answer else "",
        "on_mdr": on_mdr.in_full(found),
        "help": advice.what_would_help(found),
        "notes": _notes(found),
        "understood": (*describe(found.scene), ("assumed", summary.ASSUMED)),
        "models": columns.models_of_page(found),
        "bands": columns.bands_of(found, best) if best and found.is_level else None,
        "levels": LEVELS if found.roughness.size else "",
        "force": found.force,
        "beside": levels or (columns.numbers_beside(found) if beside else None),
        "letters": letters,
        "reference": side_by_side.reference_of(found).name if beside else "",
        "age": summary.age_of_errors(found),
        "cost": summary.cost_of(found),
    }


def _asked(found: Sequence[Comparison]) -> str:
    scenes = list(dict.fromkeys(one.scene.name for one in found))
    of = scenes[0] if len(scenes) == 1 else f"{len(scenes)} scenes"
    return f"{of}: {', '.join(by_quantity(found))} within {found[0].tolerance}"


def _notes(found: Comparison) -> list[str]:
    """Why there is no steady answer, and what may be wrong about the scene."""
    scene = found.scene
    reason = scene.no_steady_answer() if found.asked.of_motion else ""
    return [*([f"no steady answer: {reason}"] if reason else []), *scene.diagnose()]
