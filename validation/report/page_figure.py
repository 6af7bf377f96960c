"""A figure on the page: its number, the finding that is its title, the tables that it draws, and how to cite it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any
from urllib.parse import quote

from validation.analysis.contents import csv_name
from validation.report.figure_tables import tables_of
from validation.report.formats import first_sentence
from validation.report.section import Section

SAFE = " !$'()*+,-./;=?@[]_~{}<>|^`"
"""What an address in quotation marks may hold as it is."""


@dataclass(frozen=True, kw_only=True)
class PageFigure:
    """number: in the order of the page; finding: what it shows; caption: what it draws; address: the picture itself;
    tables: names of those that it draws, each a CSV of its case."""

    number: int
    name: str
    case: str
    finding: str
    caption: str
    address: str
    tables: tuple[str, ...]

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
            f"index.html#{self.anchor}"
        )


def figures_of(
    sections: Sequence[Section], pictures: Mapping[str, bytes], *, unsteady: bool = False
) -> dict[str, PageFigure]:
    """All figures by name, in the order of the page. pictures: their SVG; unsteady: no finding may be stated."""
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
                finding=headlines.get(name) or first_sentence(caption),
                caption=caption,
                address=as_address(pictures[name]),
                tables=tuple(table for table in tables_of(name) if section.evidence.has_table(table)),
            )
    return found


def as_address(picture: bytes) -> str:
    """A picture as text of an attribute: a third shorter than in base64."""
    return "data:image/svg+xml," + quote(" ".join(picture.decode().replace('"', "'").split()), safe=SAFE)
