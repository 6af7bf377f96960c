"""The figure of the solver comparison: which solvers are told apart."""

import numpy as np

from validation.analysis.evidence import table_of
from validation.report.figures.race import draw

KNOWN = {"problem": "rough, 64²", "name": "rough", "surface": "rough", "half-space": "free", "status": "finished"}
KNOWN |= {"cells": 64, "operator applications": 20.0}


def test_times_grow_by_an_exponent_of_the_cells():
    rows = [{**KNOWN, "cells": n, "problem": f"rough, {n}²", "solver": "bem3d"} for n in (64, 128, 256)]
    times = ("median [s]", "fastest [s]", "slowest [s]")
    figure = draw(table_of("heats", [row | dict.fromkeys(times, row["cells"] ** 2.2) for row in rows]))
    assert [text.get_text() for text in figure.axes[3].texts] == ["1.10"]


def test_solvers_of_a_file_have_marks_of_their_own_and_none_without_a_time():
    times = {"median [s]": 2.0, "fastest [s]": 1.0, "slowest [s]": 3.0}
    lost = {**dict.fromkeys(times, np.nan), "status": "failed"}
    solvers = {"bem3d": {}, "one": {}, "broken": lost, "two": {}}
    figure = draw(table_of("heats", [{**KNOWN, "solver": name, **times, **own} for name, own in solvers.items()]))
    handles = figure.axes[0].get_legend_handles_labels()[0]
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["bem3d", "one", "two"]
    assert len({handle.lines[0].get_marker() for handle in handles}) == 3
