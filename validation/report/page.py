"""The pages of a report: the front page and one a chapter, made of sections by the templates beside it."""

from collections.abc import Sequence

from validation.analysis.case import Chapter, Profile
from validation.report.answers.first_screen import MAP, answered_questions
from validation.report.chapter import ERRATA, chapter_of
from validation.report.formats import templates
from validation.report.page_figure import figures_of
from validation.report.provenance import kept_from
from validation.report.section import Section, claims_of, total_of
from validation.report.sounds import sound_place
from validation.scenes.description import describe
from validation.scenes.dynamic_wheel import WheelScene

FRONT = "index.html"
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


def pages(
    sections: Sequence[Section], profile: Profile, about: dict[str, object], scene: WheelScene | None
) -> dict[str, bytes]:
    """By their names. about: the provenance; scene: of the user's own, or None."""
    unsteady = scene is not None and bool(scene.no_steady_answer())
    chapters = [(chapter, some) for chapter in Chapter if (some := [s for s in sections if s.entry.chapter == chapter])]
    in_order = [section for _, some in chapters for section in some]
    figures = figures_of(in_order, unsteady=unsteady)
    places = {section.name: section.place for section in sections}
    environment = templates(unsteady=unsteady)
    environment.filters |= {"place_of": places.__getitem__, "sound_place": sound_place}
    environment.globals |= {
        "front": FRONT,
        "sections": sections,
        "book": [] if scene else chapter_of(sections),
        "errata": ERRATA,
        "answers": [] if scene else answered_questions(sections),
        "total": "" if unsteady else total_of(sections),
        "asked": claims_of(in_order),
        "chapters": chapters,
        "profile": profile,
        "figures": figures,
        "validity_map": None if scene else figures.get(MAP),
        "few_findings": FEW_FINDINGS,
        "about": about,
        "kept": kept_from(about),
        "scene": scene_summary(scene) if scene else None,
        "unsteady": unsteady,
    }
    made = {
        some[0].page: environment.get_template("chapter.html").render(chapter=chapter, some=some)
        for chapter, some in chapters
    }
    # the front page last: it leads to all others
    made[FRONT] = environment.get_template("front.html").render()
    return {name: (text + "\n").encode() for name, text in made.items()}
