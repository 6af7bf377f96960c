"""The page of `compare --report`: each scene as it was understood, its answer, and what every model says and costs."""

import base64
from collections.abc import Mapping, Sequence
from pathlib import Path

from validation.advice import advice, summary
from validation.advice.compare import Comparison
from validation.advice.exported import SCHEMA_OF_JSON, csv_table, to_json_of
from validation.advice.figure import to_figure
from validation.advice.sound_power import LEVELS
from validation.advice.table import TOGETHER, by_quantity, reference_of
from validation.analysis.contents import as_csv, as_json
from validation.report.formats import templates
from validation.scenes.description import describe

TEMPLATES = Path(__file__).parent / "templates"
PAGE, JSON, SCHEMA, CSV = "index.html", "comparison.json", "comparison.schema.json", "data/levels.csv"


def files_of_comparison(comparisons: Sequence[Comparison], about: dict[str, object]) -> dict[str, bytes]:
    """All that the folder holds, the page last. about: its provenance."""
    files = {
        JSON: to_json_of(comparisons).encode(),
        CSV: as_csv(csv_table(comparisons)),
        SCHEMA: SCHEMA_OF_JSON.read_bytes(),
        "provenance.json": as_json(about),
    }
    drawn = {f"scene-{i}": [comparison] for i, comparison in enumerate(comparisons, 1) if comparison.selection.solved}
    if len(comparisons) > len(by_quantity(comparisons)) and drawn:
        drawn["all"] = list(comparisons)
    for name, group in drawn.items():
        for form in ("svg", "pdf"):
            files[f"figures/{name}.{form}"] = to_figure(group, form=form)
    files[PAGE] = _rendered_page(comparisons, files, about)
    return files


def _rendered_page(comparisons: Sequence[Comparison], files: Mapping[str, bytes], about: dict[str, object]) -> bytes:
    """The page as HTML, with the figures among the files inside it."""
    pictures = {
        Path(name).stem: "data:image/svg+xml;base64," + base64.b64encode(contents).decode()
        for name, contents in files.items()
        if name.endswith(".svg")
    }
    page = templates(TEMPLATES).get_template("comparison.html")
    text = page.render(
        title=_title(comparisons),
        scenes=[_entries_of_scene(f"scene-{i}", comparison) for i, comparison in enumerate(comparisons, 1)],
        overview=summary.overview_of(comparisons) if len(comparisons) > 1 else None,
        pictures=pictures,
        together=TOGETHER,
        about=about,
    )
    return f"{text}\n".encode()


def _entries_of_scene(name: str, comparison: Comparison) -> dict[str, object]:
    """What the template shows of a scene, by the names that the template has."""
    best = comparison.selection.best
    answer = best.answer if best else None
    several = len(comparison.selection.solved) > 1
    letters, levels = summary.levels_of_models(comparison) if several and comparison.is_level else ({}, {})
    return {
        "name": name,
        "title": _title([comparison]),
        "comparison": comparison,
        "answer": summary.result_of(comparison, answer) if answer else "No model has a result with a known error",
        "counted": answer.counted if answer else "",
        "on_mdr": advice.in_full(comparison),
        "help": advice.what_would_help(comparison),
        "notes": _notes(comparison),
        "understood": (*describe(comparison.scene), ("assumed", summary.ASSUMED)),
        "models": summary.models_of_page(comparison),
        "bands": summary.bands_of(comparison, best.name) if best and comparison.is_level else None,
        "levels": LEVELS if comparison.roughness.size else "",
        "power": comparison.power,
        "differences": levels or (summary.numbers_of_models(comparison) if several else None),
        "letters": letters,
        "reference": reference_of(comparison).name if several else "",
        "age": summary.age_of_errors(comparison),
        "cost": summary.cost_of(comparison),
    }


def _title(comparisons: Sequence[Comparison]) -> str:
    """Title of a page or a section: scenes, quantities and tolerance."""
    scenes = list(dict.fromkeys(comparison.scene.name for comparison in comparisons))
    of = scenes[0] if len(scenes) == 1 else f"{len(scenes)} scenes"
    return f"{of}: {', '.join(by_quantity(comparisons))} within {comparisons[0].tolerance}"


def _notes(comparison: Comparison) -> list[str]:
    """Why there is no steady answer, and what may be wrong about the scene."""
    scene = comparison.scene
    reason = scene.no_steady_answer() if comparison.scene_quantity.of_motion else ""
    return [*([f"no steady answer: {reason}"] if reason else []), *scene.diagnose()]
