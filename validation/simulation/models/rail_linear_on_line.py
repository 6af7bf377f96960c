"""Linear springs on one line: sin(k_x a_x) / (k_x a_x), (14.11)."""

from typing import ClassVar

from validation.simulation.equivalent_displacement import LINEAR_ON_LINE
from validation.simulation.rail_models import RailModel


class LinearOnLine(RailModel):
    """Exact over ridges for low roughness."""

    name: ClassVar = LINEAR_ON_LINE
    setting: ClassVar = "sin(q a_x) / (q a_x)"
    is_mdr: ClassVar = True


MODEL = LinearOnLine()
