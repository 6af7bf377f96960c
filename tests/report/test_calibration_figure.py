"""The figure of the calibration test: each axis is labelled as the column that it shows, and each model as its dots."""

import numpy as np
import pytest

from validation.analysis.evidence import Table
from validation.cases.selection.model_selection import MODELS
from validation.report.figures import ladder

COUNT = 2 * len(MODELS)
ESTIMATED, TRUE, SAVED = (np.random.default_rng(seed).uniform(0.01, 0.5, COUNT) for seed in (1, 2, 3))


def tables():
    """Two scenes a model, met, one a tolerance."""
    columns = {
        "met": [1.0] * COUNT,
        "tolerance": [0.1, 0.3] * len(MODELS),
        "model": [model for model in MODELS for _ in range(2)],
        "estimated error": ESTIMATED.tolist(),
        "true error": TRUE.tolist(),
        "saved": SAVED.tolist(),
    }
    return Table("scenes", columns), Table("claims", columns)


def dots(axis):
    """Both coordinates of all of them, in the order of their abscissae."""
    pairs = [line.get_xydata() for line in axis.get_lines() if line.get_linestyle() == "None"]
    return sorted(map(tuple, np.concatenate(pairs).tolist()))


@pytest.mark.parametrize(
    ("panel", "values", "ylabel", "title"),
    [
        (0, TRUE, "true error", "selected models"),
        (1, SAVED, "fine boundary elements over the selection", "cost"),
        (2, TRUE, "true error", "all cheap models"),
    ],
)
def test_axes_are_labelled_as_their_columns(panel, values, ylabel, title):
    axis = ladder.draw(*tables()).axes[panel]
    assert (axis.get_xlabel(), axis.get_ylabel(), axis.get_title()) == ("estimated error", ylabel, title)
    assert dots(axis) == sorted(zip(ESTIMATED.tolist(), values.tolist(), strict=True))


def test_each_model_has_one_entry_of_the_legend_and_a_marker_of_its_own():
    (legend,) = ladder.draw(*tables()).legends
    assert [text.get_text() for text in legend.get_texts()] == list(MODELS)
    assert len({handle.get_marker() for handle in legend.legend_handles}) == len(MODELS)
