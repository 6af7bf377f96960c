"""The page of a report: sections and pictures into the templates beside it."""

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path

import jinja2

from validation.analysis.case import Chapter, Profile
from validation.report import formats
from validation.report.answers.first_screen import MAP, answered_questions
from validation.report.chapter import ERRATA, chapter_of
from validation.report.page_figure import figures_of
from validation.report.provenance import kept_from
from validation.report.section import Section, answer_of, total_of
from validation.report.sounds import sound_place
from validation.report.verdict_map import map_of
from validation.scenes.description import describe
from validation.scenes.dynamic_wheel import WheelScene

FEW_FINDINGS = 2
"""Conclusions of a case that are read before unfolding."""


def scene_summary(scene: WheelScene) -> dict[str, object]:
    """The first lines of a report on a scene of the user's own."""
    return {
        "name": scene.name,
        "no steady answer": scene.no_steady_answer(),
        "doubts": list(scene.diagnose()),
        "understood": dict(describe(scene)),
    }


def page(
    sections: Sequence[Section],
    profile: Profile,
    pictures: Mapping[str, bytes],
    about: dict[str, object],
    scene: WheelScene | None,
) -> bytes:
    """The whole page. pictures: SVG of each figure; about: the provenance; scene: of the user's own, or None."""
    unsteady = scene is not None and bool(scene.no_steady_answer())
    chapters = [(chapter, some) for chapter in Chapter if (some := [s for s in sections if s.entry.chapter == chapter])]
    in_order = [section for _, some in chapters for section in some]
    figures = figures_of(in_order, pictures, unsteady=unsteady)
    text = (
        _environment(unsteady)
        .get_template("page.html")
        .render(
            sections=sections,
            book=[] if scene else chapter_of(sections),
            errata=ERRATA,
            answers=[] if scene else answered_questions(sections),
            total="" if unsteady else total_of(sections),
            chapters=chapters,
            profile=profile,
            figures=figures,
            validity_map=None if scene else figures.get(MAP),
            few_findings=FEW_FINDINGS,
            about=about,
            kept=kept_from(about),
            zip=zip,
            scene=scene_summary(scene) if scene else None,
            unsteady=unsteady,
        )
    )
    return (text + "\n").encode()


def _environment(unsteady: bool) -> jinja2.Environment:
    """unsteady: no verdict is printed."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent / "templates"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {
        "format_value": formats.format_value,
        "format_cell": partial(formats.format_cell, unsteady=unsteady),
        "format_verdict": partial(formats.format_verdict, unsteady=unsteady),
        "format_status": partial(formats.format_status, unsteady=unsteady),
        "format_counts": formats.format_counts,
        "answer_of": answer_of,
        "map_of": map_of,
        "sound_place": sound_place,
        "small": formats.format_small,
        "capitalized": formats.capitalized,
    }
    return environment
