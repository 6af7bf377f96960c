"""The figures of the cases, drawn by the workers while other cases are solved."""

from concurrent.futures import Future
from dataclasses import replace

from validation.analysis.case import Profile
from validation.analysis.contents import as_written
from validation.analysis.evidence import Evidence
from validation.engine.progress import Part
from validation.engine.workers import Workers
from validation.report.figures import drawing
from validation.report.style import drawn, picture

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
    for one in begun.values():
        one.add_done_callback(lambda _: progress.step())
    return begun


def draw_figure(name: str, evidence: Evidence, profile: Profile) -> bytes:
    """SVG of a figure, from its tables as their files have them, so that `redraw` gives the same bytes."""
    written = replace(evidence, tables=tuple(as_written(table) for table in evidence.tables))
    return picture(drawn(drawing(name), written, profile))
