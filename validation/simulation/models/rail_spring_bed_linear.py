"""A two-dimensional bed of springs that keep their contact, 2 J_1(S) / S: the linear DPRS of the field."""

from typing import ClassVar

from validation.simulation.equivalent_displacement import BED
from validation.simulation.rail_models import RailModel


class LinearSpringBed(RailModel):
    """Source: Remington and Webb, J. Sound Vib. 193 (1996) 83; Ford and Thompson, J. Sound Vib. 293 (2006) 769."""

    name: ClassVar = BED
    setting: ClassVar = "2 J_1(S) / S, equal weights over the ellipse"


MODEL = LinearSpringBed()
