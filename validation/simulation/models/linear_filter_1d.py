"""A linear filter in one dimension, (14.12) with Geike's spectrum."""

from typing import ClassVar

from validation.simulation.method import Prepared, Resolution, Result, Solve
from validation.simulation.model import Cost, Target
from validation.simulation.rolling_claims import FORMULA, GEIKE_BANDS, CheapRollingModel


class LinearFilter1D(CheapRollingModel):
    """Exact over ridges; over isotropic ground in the variance of the force alone."""

    name: ClassVar = "linear filter, 1D"
    setting: ClassVar = "Geike's spectrum"

    bands: ClassVar = GEIKE_BANDS
    on_bands: ClassVar = "Geike's rule does not keep levels along a track"
    on_rms: ClassVar = "Geike's rule keeps the variance of the force"

    def cost(self, target: Target, resolution: Resolution) -> Cost:
        nodes = target.rolling.nodes
        return Cost(work=nodes, unit="nodes", seconds=FORMULA * nodes)

    def prepare(self, target: Target, resolution: Resolution) -> Prepared:
        quantity = target.rolling
        return lambda _: Solve(
            lambda: quantity.expected(one_dimensional=True),
            lambda value: Result({quantity.name: value}, float(quantity.nodes)),
        )


MODEL = LinearFilter1D()
