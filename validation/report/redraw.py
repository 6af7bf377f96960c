"""A figure of a written report once more, from the CSV files beside it."""

import json
from os import PathLike
from pathlib import Path

from matplotlib.figure import Figure

from validation.analysis.contents import csv_name, from_csv
from validation.analysis.evidence import Evidence
from validation.engine.files import place_in
from validation.report.figures import drawing, tables_of
from validation.report.folder import RESULTS
from validation.report.style import drawn


def redraw(folder: str | PathLike[str], name: str) -> Figure:
    """The figure `name` of the report in `folder`, drawn again from its data.

    Raises ValueError for a name that no figure has, FileNotFoundError for a folder that is no report or has none of
    its data.
    """
    data, case = Path(folder, "data"), name.partition("-")[0]
    paths = {table: place_in(data, csv_name(case, table)) for table in tables_of(name)}
    tables = tuple(from_csv(table, path.read_text("utf-8")) for table, path in paths.items() if path.exists())
    profile = json.loads(Path(folder, RESULTS).read_text("utf-8"))["profile"]
    if not tables:
        raise FileNotFoundError(f"data of figure {name!r} must be in {data}, got none of {list(paths)}")
    evidence = Evidence(title=name, method="", numbers=(), tables=tables, conclusions=(), captions={})
    return drawn(drawing(name), evidence, profile)
