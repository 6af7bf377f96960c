"""The pages of a report: the front page and one a chapter, made of sections by the templates beside it."""

from collections.abc import Mapping, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, replace
from typing import Any

from validation.analysis.case import Chapter, Profile
from validation.analysis.contents import as_written, csv_name
from validation.analysis.evidence import Evidence
from validation.analysis.number_text import plus_minus
from validation.engine.progress import Part
from validation.engine.street import objects_of_houses
from validation.engine.workers import Workers
from validation.report.answers.first_screen import answered_questions
from validation.report.answers.front_tables import failures, times_faster, times_faster_said
from validation.report.chapter import ERRATA, REMARKS, book_figures, chapter_of
from validation.report.figures import drawing, tables_of
from validation.report.formats import first_sentence, templates
from validation.report.provenance import kept_from
from validation.report.section import Section, claims_of_others, total_of
from validation.report.sounds import sound_place
from validation.report.style import drawn, picture
from validation.scenes.description import describe
from validation.scenes.rolling import RollingScene

FIGURES = "figures"
"""The part of a run in which they are drawn, and their folder."""


def begin_to_draw(
    evidence: Evidence | None, workers: Workers, progress: Part, profile: Profile
) -> dict[str, Future[bytes]]:
    """SVG of each figure of a case, as soon as it is drawn. progress: the part of the run that counts them."""
    if evidence is None:
        return {}
    progress.begin("drawn", total=len(evidence.captions))
    begun = {name: workers.submit(draw_figure, name, evidence, profile) for name in evidence.captions}
    for figure in begun.values():
        figure.add_done_callback(lambda _: progress.step())
    return begun


def draw_figure(name: str, evidence: Evidence, profile: Profile) -> bytes:
    """SVG of a figure, from its tables as their files have them, so that `redraw` gives the same bytes."""
    written = replace(evidence, tables=tuple(as_written(table) for table in evidence.tables))
    return picture(drawn(drawing(name), written, profile))


FRONT, READING = "index.html", "reading.html"
BOOK_PAGE = "book.html"
FRONT_FIGURES = ("fractal_punch", "rolling", "precision")
FEW_FINDINGS = 2
"""Conclusions of a case that are read before unfolding."""


@dataclass(frozen=True, kw_only=True)
class PageFigure:
    """A figure on the page. number: in the order of the pages; page: where it is; finding: its title; caption: what it
    draws; data: names of the CSV files that it draws.
    """

    number: int
    name: str
    case: str
    page: str
    finding: str
    caption: str
    data: tuple[str, ...]

    @property
    def place(self) -> str:
        """Lasts when figures before it come or go."""
        return f"{self.page}#figure-{self.name}"

    def citation(self, about: Mapping[str, Any], profile: str) -> str:
        """about: provenance of the report, with the commits of the cases that it has kept."""
        commit = about["kept"].get(self.case, about["commit"])
        return (
            f"Figure {self.number}, in: Reduced contact models: validation report "
            f"(mdr-validation {about['version']}, commit {commit}, profile {profile}), "
            f"{self.place}"
        )


def figures_of(sections: Sequence[Section]) -> dict[str, PageFigure]:
    """All figures by name, in the order of the pages."""
    figures: dict[str, PageFigure] = {}
    for section in sections:
        if section.evidence is None:
            continue
        for name, caption in section.evidence.captions.items():
            figures[name] = PageFigure(
                number=len(figures) + 1,
                name=name,
                case=section.name,
                page=section.page,
                finding=section.evidence.headlines.get(name) or first_sentence(caption),
                caption=caption,
                data=tuple(csv_name(section.name, t) for t in tables_of(name) if section.evidence.has_table(t)),
            )
    return figures


def scene_summary(scene: RollingScene) -> dict[str, object]:
    """The first lines of a report on a scene of the user's own."""
    return {
        "name": scene.name,
        "no steady answer": scene.no_steady_answer(),
        "doubts": list(scene.diagnose()),
        "understood": dict(describe(scene)),
    }


def sections_by_chapter(sections: Sequence[Section]) -> list[tuple[Chapter, list[Section]]]:
    """The chapters that have sections, in the order of the pages."""
    of_chapters = ((chapter, [s for s in sections if s.entry.chapter == chapter]) for chapter in Chapter)
    return [(chapter, of_chapter) for chapter, of_chapter in of_chapters if of_chapter]


def pages(
    sections: Sequence[Section], profile: Profile, about: dict[str, object], scene: RollingScene | None
) -> dict[str, bytes]:
    """By their names. about: the provenance; scene: of the user's own, or None."""
    chapters = sections_by_chapter(sections)
    in_order = [section for _, of_chapter in chapters for section in of_chapter]
    figures, faster = figures_of(in_order), times_faster(sections)
    book = [] if scene else chapter_of(sections)
    places = {section.name: section.place for section in sections}
    houses = [] if scene else objects_of_houses("front_page")
    environment = templates(*(house.TEMPLATES for house in houses))
    environment.filters |= {
        "place_of": places.__getitem__,
        "sound_place": sound_place,
        "claims_of_others": claims_of_others,
    }
    environment.globals |= {
        "front": FRONT,
        "reading": READING,
        "book_page": BOOK_PAGE,
        "sections": sections,
        "book": book,
        "errata": ERRATA,
        "remarks": REMARKS,
        "answers": [] if scene else answered_questions(sections),
        "failures": [] if scene else failures(sections),
        "total": total_of(sections),
        "has_claims": any(section.claims for section in sections),
        "chapters": chapters,
        "profile": profile,
        "figures": figures,
        "faster": faster,
        "times_faster_said": times_faster_said(faster),
        "plus_minus": plus_minus,
        "front_figures": [] if scene else [name for name in FRONT_FIGURES if name in figures],
        "book_figures": [] if scene else book_figures(sections),
        "few_findings": FEW_FINDINGS,
        "about": about,
        "kept": kept_from(about),
        "scene": scene_summary(scene) if scene else None,
    }
    parts = {house: house.globals_of(sections) for house in houses}
    for shown in parts.values():
        environment.globals |= shown
    environment.globals["front_parts"] = [house.TEMPLATE for house in houses]
    environment.globals["front_links"] = tuple((*house.LINK, any(shown.values())) for house, shown in parts.items())
    page_of_chapter = environment.get_template("chapter.html")
    made = {
        of_chapter[0].page: page_of_chapter.render(chapter=chapter, chapter_sections=of_chapter)
        for chapter, of_chapter in chapters
    }
    made[READING] = environment.get_template("reading.html").render()
    if book:
        made[BOOK_PAGE] = environment.get_template("book.html").render()
    # the front page last: it leads to all others
    made[FRONT] = environment.get_template("front.html").render()
    return {name: (text + "\n").encode() for name, text in made.items()}
