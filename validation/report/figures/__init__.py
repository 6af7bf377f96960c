"""One file per case: its figures, drawn from the tables of its evidence and nothing else."""

from collections.abc import Callable

from matplotlib.figure import Figure

from validation.evidence import Evidence
from validation.report.figures import (
    fractal_punch,
    geike,
    hertz,
    mdr_limits,
    normalisation,
    race,
    square_punch,
    westergaard,
)

DRAW: dict[str, Callable[[Evidence], Figure]] = {
    "hertz": hertz.draw,
    "square_punch": square_punch.draw,
    "westergaard": westergaard.draw,
    "geike": geike.draw,
    "fractal_punch": fractal_punch.draw,
    "fractal_punch-overlay": fractal_punch.draw_overlay,
    "fractal_punch-difference": fractal_punch.draw_difference,
    "fractal_punch-mean": fractal_punch.draw_mean,
    "fractal_punch-exponent": fractal_punch.draw_exponent,
    "normalisation": normalisation.draw,
    "mdr_limits": mdr_limits.draw,
    "race": race.draw,
}
