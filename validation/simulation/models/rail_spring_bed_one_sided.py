"""A two-dimensional bed of springs that do not pull, its stiffness matched to Hertz: the DPRS of the field."""

from typing import ClassVar

from validation.simulation.equivalent_displacement import ONE_SIDED_BED
from validation.simulation.rail_models import RolledRailModel


class OneSidedSpringBed(RolledRailModel):
    """Sums over the patch at each position of a strip."""

    name: ClassVar = ONE_SIDED_BED
    seconds: ClassVar = 2e-4


MODEL = OneSidedSpringBed()
