"""A figure on the page: its number, the finding that is its title, the tables that it draws, and how to cite it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from validation.analysis.contents import csv_name
from validation.report.figures import tables_of
from validation.report.formats import first_sentence
from validation.report.section import Section


@dataclass(frozen=True, kw_only=True)
class PageFigure:
    """number: in the order of the pages; page: where it is; finding: what it shows; caption: what it draws; data: names
    of the CSV files that it draws."""

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
            f"Figure {self.number}, “{self.finding}”, in: Reduced contact models: validation report "
            f"(mdr-validation {about['version']}, commit {commit}, profile {profile}), "
            f"{self.place}"
        )


def figures_of(sections: Sequence[Section], *, unsteady: bool = False) -> dict[str, PageFigure]:
    """All figures by name, in the order of the pages. unsteady: no finding may be stated."""
    found: dict[str, PageFigure] = {}
    for section in sections:
        if section.evidence is None:
            continue
        headlines = {} if unsteady else section.evidence.headlines
        for name, caption in section.evidence.captions.items():
            found[name] = PageFigure(
                number=len(found) + 1,
                name=name,
                case=section.name,
                page=section.page,
                finding=headlines.get(name) or first_sentence(caption),
                caption=caption,
                data=tuple(csv_name(section.name, t) for t in tables_of(name) if section.evidence.has_table(t)),
            )
    return found
