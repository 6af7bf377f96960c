"""What results have in common: read-only arrays of their own, the numbers in the line that each prints, and maps."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from bem3d.checks import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Kept = TypeVar("Kept")


class ReadOnly:
    """For frozen dataclasses: arrays are copied and closed when one is made, copied or unpickled.

    A read-only array is not enough: an older view of it is still writable.
    """

    def __post_init__(self) -> None:
        for name in (field.name for field in fields(self)):  # type: ignore[arg-type]
            object.__setattr__(self, name, kept(getattr(self, name)))

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update({name: kept(value) for name, value in state.items()})


def kept(value: Kept) -> Kept:
    """A read-only copy of an array; anything else as it is."""
    if not isinstance(value, np.ndarray):
        return value
    own = np.array(value, order="C")
    own.flags.writeable = False
    return own  # type: ignore[return-value]


def span(values: float | FloatArray, unit: str) -> str:
    """A number, or the smallest and the largest of an array, with the unit: "499..567 N"."""
    array = np.asarray(values)
    if array.ndim == 0:
        return f"{short(float(array), 4)} {unit}"
    if array.size == 0:
        return "none"
    lowest, highest = short(float(array.min()), 3), short(float(array.max()), 3)
    return f"{lowest} {unit}" if lowest == highest else f"{lowest}..{highest} {unit}"


def line(text: str) -> str:
    """What a result prints, cut from 100 characters on."""
    return text if len(text) < 100 else f"{text[:95]}...{text[-1]}"


def pair(unit: str, along: float, across: float) -> str:
    """One number for both axes where they are equal, or two: "0.5 x 0.3 m"."""
    both = [short(along, 4), short(across, 4)]
    return f"{both[0]} {unit}" if along == across else f"{' x '.join(both)} {unit}"


def short(value: float, digits: int) -> str:
    """So many digits, and no zeros in the exponent: 1.23e-6."""
    return f"{value:.{digits}g}".replace("e-0", "e-").replace("e+0", "e").replace("e+", "e")


def map_of(values: FloatArray, steps: tuple[float, float], name: str, unit: str, title: str, axis: Axes | None) -> Axes:
    """Values of cells as a map with a scale, on axes of a user or on those of a new figure; NaN is left empty."""
    # imported where a figure is asked for: a solver needs none
    import matplotlib.pyplot as plt
    from matplotlib.axes import Axes
    from matplotlib.ticker import EngFormatter

    if axis is None:
        axis = plt.subplots(layout="constrained")[1]
    if not isinstance(axis, Axes):
        raise TypeError(f"ax must be an Axes of matplotlib, or None for a new figure, got {type(axis).__name__}")
    ends = [cells * step for cells, step in zip(values.shape, steps, strict=True)]
    image = axis.imshow(values.T, origin="lower", extent=(0.0, ends[0], 0.0, ends[1]), cmap="cividis")
    axis.figure.colorbar(image, ax=axis, label=name, format=EngFormatter(unit))
    for each, label in ((axis.xaxis, "x"), (axis.yaxis, "y")):
        each.set_major_formatter(EngFormatter("m"))
        each.set_label_text(label)
    axis.set_title(title, loc="left")
    return axis
