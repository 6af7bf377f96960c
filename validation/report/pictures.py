"""The figures of the cases, drawn by the workers while other cases are solved."""

from concurrent.futures import Future
from dataclasses import replace

from validation.analysis.case import Profile
from validation.analysis.contents import as_written
from validation.analysis.evidence import Evidence
from validation.engine.progress import Part
from validation.engine.workers import Workers
from validation.report.figures import drawing
from validation.report.section import Section
from validation.report.style import drawn, picture

FIGURES = "figures"
"""The part of a run in which they are drawn, and their folder."""


class Pictures:
    """SVG of each figure. progress: the part of the run that is told of them."""

    def __init__(self, workers: Workers, progress: Part, profile: Profile):
        self._workers, self._progress, self._profile = workers, progress, profile
        self._begun: dict[str, Future[bytes]] = {}

    def draw(self, section: Section) -> None:
        """Have the figures of a case drawn."""
        if section.evidence is None:
            return
        names = list(section.evidence.captions)
        self._progress.begin("drawn", total=len(names))
        for name in names:
            self._begun[name] = self._workers.submit(draw_figure, name, section.evidence, self._profile)
            self._begun[name].add_done_callback(lambda _: self._progress.step())

    def found(self) -> dict[str, bytes]:
        """All that were to be drawn, as soon as they are."""
        return {name: picture.result() for name, picture in self._begun.items()}


def draw_figure(name: str, evidence: Evidence, profile: Profile) -> bytes:
    """SVG of a figure, from its tables as their files have them, so that `redraw` gives the same bytes."""
    written = replace(evidence, tables=tuple(as_written(table) for table in evidence.tables))
    return picture(drawn(drawing(name), written, profile))
