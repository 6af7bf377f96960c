"""The names of all models, in the order in which models of equal cost are tried and listed, and labels beside them.

Models of one kind have one name, whatever they are asked for: boundary elements press a body, and roll with a wheel and
on a rail. On a rail, where a scene has springs on several tracks, the name of springs says which.

A label in the words of the field is accepted beside the name that is printed. A printed label changes with the pages
that have it; scripts may use both until then, and for one release after it.
"""

import re

BEM = "boundary elements"
CLOSED_FORM, FIT = "closed form", "fit"
FILTER_1D, FILTER_3D = "linear filter, 1D", "linear filter, 3D"
LINEAR, LINEAR_ON_LINE, REMINGTON = "linear, ellipse", "linear, on the line", "Remington"
BED, ONE_SIDED_BED = "spring bed (DPRS), linear", "spring bed (DPRS), one-sided"
SPRINGS_GEIKE, SPRINGS_ON_LINE = "springs, Geike's rule", "springs on the line"
SPRINGS_ON_MEAN, SPRINGS_ROLLING = "springs on the mean across", "springs, rolling spectrum"
SPRINGS, SPRINGS_THAT_READ = "springs", "springs that read the surface"
MODELS = (
    *(BEM, CLOSED_FORM, FIT, FILTER_1D, FILTER_3D, LINEAR, LINEAR_ON_LINE, REMINGTON, BED),
    *(ONE_SIDED_BED, SPRINGS_GEIKE, SPRINGS_ON_LINE, SPRINGS_ON_MEAN, SPRINGS_ROLLING, SPRINGS, SPRINGS_THAT_READ),
)
LINE, LINEAR_ON_MEAN = "line roughness", "linear, on the mean across"
LINEAR_ROLLING, LINEAR_GEIKE = "linear, rolling spectrum", "linear, Geike's rule"
"""What is beside models of a rail and no model of `compare`: the roughness itself, and springs that all touch."""
TWINS = {
    **{BEM: LINEAR, SPRINGS_THAT_READ: LINEAR, SPRINGS_ON_LINE: LINEAR_ON_LINE, SPRINGS_ON_MEAN: LINEAR_ON_MEAN},
    **{ONE_SIDED_BED: BED, SPRINGS_ROLLING: LINEAR_ROLLING, SPRINGS_GEIKE: LINEAR_GEIKE},
}
"""On a rail the linear model of each one-sided one: the same where all touches."""
SHORT = {"bem": BEM}
"""Other names that users may give; "mdr" are all springs by the method of dimensionality reduction."""


def twin_of(model: str) -> str:
    """The linear model of a one-sided one; of any other, itself."""
    return TWINS.get(model, model)


LABELS = {
    SPRINGS: "MDR",
    SPRINGS_GEIKE: "MDR, Geike PSD",
    SPRINGS_ROLLING: "MDR, rolling-equivalent PSD",
    SPRINGS_ON_LINE: "MDR, single line",
    SPRINGS_ON_MEAN: "MDR, cross-averaged line",
    SPRINGS_THAT_READ: "MDR, cross-averaged surface",
    LINEAR: "linear half-space filter of the ellipse",
    FILTER_3D: "linear half-space filter",
    LINEAR_ON_LINE: "1D linear filter, sin(ka)/(ka)",
    FILTER_1D: "1D linear filter, sin(ka)/(ka)",
    BED: "DPRS (Winkler bed)",
    ONE_SIDED_BED: "DPRS (Winkler bed), one-sided",
    REMINGTON: "Remington filter",
    FIT: "series model",
}
"""Of each printed label; one label stands for two models that no scene has both."""
BEM_LABEL = "BEM"
GRIDS = (
    (re.compile(rf"{BEM}, a = (\d+) cells"), rf"{BEM_LABEL}, \1 cells per contact radius"),
    (re.compile(rf"{BEM} (\d+)²"), rf"{BEM_LABEL}, \1 cells per side"),
    (re.compile(BEM), BEM_LABEL),
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
