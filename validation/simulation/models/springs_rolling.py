"""One-sided springs under a rolling wheel, over the linear filter on the same tracks, times what linear theory has."""

from dataclasses import replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from validation.simulation.method import Prepared, Resolution, Result, Solve
from validation.simulation.model import Cost, ErrorEstimate, Target
from validation.simulation.rolling_claims import (
    FED_BANDS,
    FORCE_RMS,
    NODE,
    SPRING,
    SPRINGS_MOVING,
    SPRINGS_RMS,
    CheapRollingModel,
)
from validation.simulation.rolling_levels import RollingGrid, on_springs, springs_to_a_radius

TRACKS = 60
MOST_ON_TRACKS = 2**27
"""Springs that are drawn at once at the most; they take up to four gigabytes."""


class SpringsRolling(CheapRollingModel):
    """The mean of logarithms over tracks."""

    name: ClassVar = "springs"
    setting: ClassVar = f"{TRACKS} tracks"
    charted: ClassVar = False
    is_mdr: ClassVar = True

    bands: ClassVar = FED_BANDS
    rms: ClassVar = SPRINGS_RMS
    moving: ClassVar = SPRINGS_MOVING
    on_bands: ClassVar = "springs have the right level only in the mean over bands"

    def resolutions(self, target: Target) -> tuple[Resolution, ...]:
        """Springs to a contact radius."""
        return (Resolution(size=springs_to_a_radius(target.rolling)),)

    def cost(self, target: Target, resolution: Resolution) -> Cost:
        """Positions of all tracks, and what linear theory expects."""
        work = TRACKS * RollingGrid.of(target.rolling, 1).along * resolution.size
        nodes = 0 if target.quantity == FORCE_RMS else target.rolling.nodes
        return Cost(work=work, unit="positions", seconds=SPRING * work + NODE * nodes)

    def estimate(self, target: Target, resolution: Resolution) -> ErrorEstimate:
        expected, springs = super().estimate(target, resolution), self.cost(target, resolution).work
        if expected.in_range and springs > MOST_ON_TRACKS:
            return ErrorEstimate.out_of_range(
                f"{TRACKS} tracks need {springs:.2g} springs, more than {MOST_ON_TRACKS:.2g}"
            )
        return replace(expected, sample=target.tolerance / 10)

    def prepare(self, target: Target, resolution: Resolution) -> Prepared:
        quantity = target.rolling
        expected = quantity.expected(one_dimensional=quantity.name == FORCE_RMS)

        def read(change: NDArray[np.float64]) -> Result:
            failed = "" if np.isfinite(change).all() else "a wheel lifted off farther than the sums are exact for"
            work = self.cost(target, resolution).work
            return Result({quantity.name: expected * np.exp(change)}, work, TRACKS, failed)

        return lambda _: Solve(lambda: on_springs(quantity, TRACKS, target.seed), read)


MODEL = SpringsRolling()
