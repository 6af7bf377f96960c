"""Labels of models in the words of the field, accepted beside those that are printed.

A printed label changes with the pages that have it; scripts may use both until then, and for one release after it.
"""

import re

from validation.simulation import model_names as named

LABELS = {
    named.SPRINGS: "MDR",
    named.SPRINGS_GEIKE: "MDR, Geike PSD",
    named.SPRINGS_ROLLING: "MDR, rolling-equivalent PSD",
    named.SPRINGS_ON_LINE: "MDR, single line",
    named.SPRINGS_ON_MEAN: "MDR, cross-averaged line",
    named.SPRINGS_THAT_READ: "MDR, cross-averaged surface",
    named.LINEAR: "linear half-space filter of the ellipse",
    named.FILTER_3D: "linear half-space filter",
    named.LINEAR_ON_LINE: "1D linear filter, sin(ka)/(ka)",
    named.FILTER_1D: "1D linear filter, sin(ka)/(ka)",
    named.BED: "DPRS (Winkler bed)",
    named.ONE_SIDED_BED: "DPRS (Winkler bed), one-sided",
    named.REMINGTON: "Remington filter",
    named.FIT: "series model",
}
"""Of each printed label; one label stands for two models that no scene has both."""
BEM = "BEM"
GRIDS = (
    (re.compile(rf"{named.BEM}, a = (\d+) cells"), rf"{BEM}, \1 cells per contact radius"),
    (re.compile(rf"{named.BEM} (\d+)²"), rf"{BEM}, \1 cells per side"),
    (re.compile(named.BEM), BEM),
)
"""Boundary elements, by their grid."""


def label_of(printed: str) -> str:
    """The label in the words of the field of a model that is printed with another; itself where there is none."""
    if printed in LABELS:
        return LABELS[printed]
    return next((label.sub(words, printed) for label, words in GRIDS if label.fullmatch(printed)), printed)


def note_of(printed: str) -> str:
    """A note that the model has two labels, for who names it by one; empty where it has one."""
    label = label_of(printed)
    return "" if label == printed else f'"{label}" and "{printed}" are labels of one model; results have the latter.'
