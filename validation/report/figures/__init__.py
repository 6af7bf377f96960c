"""One file per case: its figure, drawn from the tables of its evidence and nothing else."""

from collections.abc import Callable

from matplotlib.figure import Figure

from validation.evidence import Evidence
from validation.report.figures import fractal_punch, geike, hertz, race, square_punch, westergaard

DRAW: dict[str, Callable[[Evidence], Figure]] = {
    "hertz": hertz.draw,
    "square_punch": square_punch.draw,
    "westergaard": westergaard.draw,
    "geike": geike.draw,
    "fractal_punch": fractal_punch.draw,
    "race": race.draw,
}
