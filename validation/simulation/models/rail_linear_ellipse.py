"""Linear theory of the ellipse on the stated ground: sin(S) / S, S^2 = (k_x a_x)^2 + (k_y a_y)^2."""

from typing import ClassVar

from validation.simulation.equivalent_displacement import LINEAR
from validation.simulation.rail_models import RailModel


class LinearEllipseOnRail(RailModel):
    """The half-space under an ellipse that keeps its size; exact for low roughness, whatever lies across."""

    name: ClassVar = LINEAR
    setting: ClassVar = "sin(S) / S, an ellipse that keeps its size"


MODEL = LinearEllipseOnRail()
