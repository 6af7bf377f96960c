"""Remington's closed contact filter: the linear bed of springs on a circle, over waves with |k_y| < alpha k_x."""

import math
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from validation.simulation.rail_models import RailModel
from validation.simulation.rail_quantity import RailQuantity
from validation.theory.contact_filters import remington_filter
from validation.theory.elliptic_contact import EllipticContact
from validation.theory.transverse_structure import Ridges

ALPHA = 1.0
"""The usual choice, where the scene states no band of waves."""


class Remington(RailModel):
    """On a circle of radius sqrt(a_x a_y); alpha is that of the scene, or one."""

    name: ClassVar = "Remington"
    setting: ClassVar = "closed form on a circle, alpha of the scene or one"

    def closed(self, quantity: RailQuantity) -> NDArray[np.float64]:
        """The same for each end."""
        across, b = quantity.scene.across, _radius(quantity.scene.contact)
        alpha = ALPHA if across is None or isinstance(across, str) else float(across)
        found = Ridges().band_power(
            quantity.line,
            lambda q, _: np.sqrt(remington_filter(q, radius=b, alpha=alpha)),
            edges=quantity.bands.edges,
            semi_axes=(b, b),
        )
        return np.tile(10 * np.log10(found), (len(quantity.ends), 1))


def _radius(contact: EllipticContact) -> float:
    return math.sqrt(contact.along * contact.across)


MODEL = Remington()
