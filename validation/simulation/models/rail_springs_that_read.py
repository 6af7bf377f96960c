"""One-sided springs that read the surface across the contact, by the weight of the flat punch."""

from typing import ClassVar

from validation.simulation.equivalent_displacement import SPRINGS_THAT_READ
from validation.simulation.rail_models import RolledRailModel


class SpringsThatRead(RolledRailModel):
    """MDR with the linear answer of three dimensions."""

    name: ClassVar = SPRINGS_THAT_READ
    is_mdr: ClassVar = True


MODEL = SpringsThatRead()
