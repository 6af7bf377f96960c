"""One-sided springs under a wheel on the middle line of a strip of rail."""

from typing import ClassVar

from validation.simulation.equivalent_displacement import SPRINGS_ON_LINE
from validation.simulation.rail_models import RolledRailModel


class SpringsOnLine(RolledRailModel):
    """MDR fed with one line: exact over ridges for low roughness."""

    name: ClassVar = SPRINGS_ON_LINE
    is_mdr: ClassVar = True
    seconds: ClassVar = 2e-5


MODEL = SpringsOnLine()
