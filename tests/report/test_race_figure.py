"""The figure of the solver comparison: which solvers are told apart."""

import numpy as np

from validation.analysis.evidence import table_of
from validation.report.figures.race import draw


def test_solvers_of_a_file_have_marks_of_their_own_and_none_without_a_time():
    times = {"median [s]": 2.0, "fastest [s]": 1.0, "slowest [s]": 3.0}
    lost = {**dict.fromkeys(times, np.nan), "status": "failed"}
    solvers = {"bem3d": {}, "one": {}, "broken": lost, "two": {}}
    known = {"problem": "sphere", "surface": "sphere", "half-space": "free", "name": "sphere", "cells": 64}
    rows = [{**known, "solver": name, "status": "finished", **times, **own} for name, own in solvers.items()]
    figure = draw(table_of("heats", rows))
    handles = figure.axes[0].get_legend_handles_labels()[0]
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["bem3d", "one", "two"]
    assert len({handle.lines[0].get_marker() for handle in handles}) == 3
