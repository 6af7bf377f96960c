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
    """number: in the order of the pages; page: where it is; finding: what it shows; caption: what it draws; tables:
    names of those that it draws, each a CSV of its case."""

    number: int
    name: str
    case: str
    page: str
    finding: str
    caption: str
    tables: tuple[str, ...]

    @property
    def address(self) -> str:
        return f"figures/{self.name}.svg"

    @property
    def place(self) -> str:
        return f"{self.page}#{self.anchor}"

    @property
    def anchor(self) -> str:
        """Lasts when figures before it come or go."""
        return f"figure-{self.name}"

    @property
    def data(self) -> tuple[str, ...]:
        """Addresses of its CSV files."""
        return tuple(f"data/{csv_name(self.case, table)}" for table in self.tables)

    @property
    def drawn_again_by(self) -> str:
        """One line of Python, run in the folder of the report."""
        return f'from validation.report.redraw import redraw; redraw(".", "{self.name}").savefig("{self.name}.pdf")'

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
                tables=tuple(table for table in tables_of(name) if section.evidence.has_table(table)),
            )
    return found
