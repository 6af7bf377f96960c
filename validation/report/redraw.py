"""A figure of a written report once more, from the CSV files beside it."""

import json
from os import PathLike
from pathlib import Path

from matplotlib.figure import Figure

from validation.analysis.contents import csv_name, from_csv
from validation.analysis.evidence import Evidence
from validation.report.figure_tables import tables_of
from validation.report.figures import drawing
from validation.report.folder import RESULTS
from validation.report.style import drawn


def redraw(folder: str | PathLike[str], name: str) -> Figure:
    """The figure `name` of the report in `folder`, drawn again from its data.

    Raises ValueError for a name that no figure has, FileNotFoundError for a folder that is no report or has none of
    its data.
    """
    draw, folder = drawing(name), Path(folder)
    case = name.partition("-")[0]
    profile = json.loads((folder / RESULTS).read_text(encoding="utf-8"))["profile"]
    paths = {table: folder / "data" / csv_name(case, table) for table in tables_of(name)}
    there = {table: path for table, path in paths.items() if path.exists()}
    if not there:
        raise FileNotFoundError(f"data of figure {name!r} must be in {folder / 'data'}, got none of {list(paths)}")
    tables = tuple(from_csv(table, path.read_text(encoding="utf-8")) for table, path in there.items())
    evidence = Evidence(title=name, method="", numbers=(), tables=tables, conclusions=(), captions={})
    return drawn(draw, evidence, profile)
