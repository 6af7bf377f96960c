"""One-sided springs under a wheel on the mean of the heights across the contact."""

from typing import ClassVar

from validation.simulation.equivalent_displacement import SPRINGS_ON_MEAN
from validation.simulation.rail_models import RolledRailModel


class SpringsOnMean(RolledRailModel):
    """MDR fed with the mean over |y| < a_y, which is already a filter."""

    name: ClassVar = SPRINGS_ON_MEAN
    is_mdr: ClassVar = True
    seconds: ClassVar = 3e-5


MODEL = SpringsOnMean()
