"""Parallel lines that are measured on one strip of a rail."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from validation.analysis.spectra import Bands, levels, waves
from validation.engine.engine import Outcome
from validation.simulation.rail_strip import RailStrip, Transfer

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class ParallelLines:
    """strip; lines: how many, about the middle; spacings: of them [m]; bands: of the levels."""

    strip: RailStrip
    lines: int
    spacings: tuple[float, ...]
    bands: Bands


def measure_lines(problem: ParallelLines) -> Outcome:
    """Band powers of one line, "line", and their mean over parallel lines, by the spacing of these [m^2]."""
    strip, places = problem.strip, {spacing: lines_across(problem.lines, spacing) for spacing in problem.spacings}

    def powers(place: float) -> FloatArray:
        return levels(waves(strip.along_middle(line_at(place)), spacing=strip.spacing), problem.bands)

    along = {place: powers(place) for place in {0.0}.union(*places.values())}
    means = {f"{spacing:g}": np.mean([along[y] for y in mine], axis=0) for spacing, mine in places.items()}
    return {"line": along[0.0], **means}


def lines_across(count: int, spacing: float) -> tuple[float, ...]:
    """Their places about the middle [m]."""
    return tuple((i - (count - 1) / 2) * spacing for i in range(count))


def line_at(place: float) -> Transfer:
    """H = exp(i k_y y): the line at y in place of the middle one."""
    return lambda along, across: np.exp(1j * across * place)


def mean_of_lines(places: tuple[float, ...]) -> Transfer:
    """H = mean of cos(k_y y_j) over lines that lie symmetrically about the middle: of their heights."""
    return lambda along, across: np.mean([np.cos(across * place) for place in places], axis=0) + 0 * along
