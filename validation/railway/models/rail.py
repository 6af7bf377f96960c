"""Contact filters of a wheel on a rail."""

import math
from functools import partial

import numpy as np

from validation.engine.engine import FloatArray
from validation.railway.problems.equivalent_displacement import FINER, geike_power
from validation.railway.problems.rail_models import STRIPS, rail_model
from validation.railway.problems.rail_quantity import RailQuantity
from validation.railway.theory.contact_filters import remington_filter
from validation.railway.theory.transverse_structure import Ridges
from validation.simulation import model_names as named

ALPHA = 1.0
"""Of Remington's filter, the usual choice, where the scene states no band of waves."""
ON_STRIPS = f"{STRIPS} strips, constant load"


def by_remington(quantity: RailQuantity) -> FloatArray:
    """The linear bed of springs on a circle of radius sqrt(a_x a_y), over waves with |k_y| < alpha k_x."""
    across, contact = quantity.scene.lateral_structure, quantity.scene.contact
    alpha = ALPHA if across is None or isinstance(across, str) else float(across)
    b = math.sqrt(contact.along * contact.across)
    square = partial(remington_filter, radius=b, alpha=alpha)
    over_line = partial(Ridges().band_power, quantity.line, edges=quantity.bands.edges, semi_axes=(b, b))
    return for_each_end(over_line(lambda q, _: np.sqrt(square(q))), quantity)


def by_geike(quantity: RailQuantity) -> FloatArray:
    """Of the isotropic ground that has the line. ValueError where none has."""
    return for_each_end(geike_power(quantity.line, quantity.scene.contact, quantity.bands.edges), quantity)


def for_each_end(power: FloatArray, quantity: RailQuantity) -> FloatArray:
    return np.tile(10 * np.log10(power), (len(quantity.ends), 1))


BOUNDARY_ELEMENTS = rail_model(named.BEM, ON_STRIPS, seconds=4e-3, is_reference=True)
"""The half-space on two grids: the reference of the others."""
LINEAR_ELLIPSE = rail_model(named.LINEAR, "sin(S) / S, an ellipse that keeps its size")
"""S^2 = (k_x a_x)^2 + (k_y a_y)^2: exact for low roughness, whatever lies across."""
LINEAR_LINE = rail_model(named.LINEAR_ON_LINE, "sin(q a_x) / (q a_x)", is_mdr=True)
"""(14.11): exact over ridges for low roughness, as `ON_LINE`."""
CLOSED_REMINGTON = rail_model(
    named.REMINGTON, "closed form on a circle, alpha of the scene or one", closed=by_remington
)
LINEAR_BED = rail_model(named.BED, "2 J_1(S) / S, equal weights over the ellipse")
"""Springs in two dimensions that keep their contact, the linear DPRS of the field.

Source: Remington and Webb, J. Sound Vib. 193 (1996) 83; Ford and Thompson, J. Sound Vib. 293 (2006) 769."""
BED_THAT_DOES_NOT_PULL = rail_model(named.ONE_SIDED_BED, ON_STRIPS, seconds=2e-4)
"""Its stiffness is matched to Hertz: the DPRS of the field, sums over the patch at each position."""
ON_LINE = rail_model(named.SPRINGS_ON_LINE, ON_STRIPS, seconds=3e-5, finer=FINER, is_mdr=True)
ON_MEAN = rail_model(named.SPRINGS_ON_MEAN, ON_STRIPS, seconds=3e-5, finer=FINER, is_mdr=True)
"""MDR on the middle line of a strip, and on the mean over |y| < a_y, which is already a filter."""
READING = rail_model(named.SPRINGS_THAT_READ, ON_STRIPS, finer=FINER, is_mdr=True)
"""MDR with the linear answer of three dimensions: springs that read the surface by the weight of the flat punch."""
ON_ROLLING_SPECTRUM = rail_model(named.SPRINGS_ROLLING, ON_STRIPS, seconds=3e-5, is_mdr=True)
"""MDR with the level of the half-space for long and for short waves, of levels: a spectrum has no places."""
ON_GEIKES_SPECTRUM = rail_model(
    named.SPRINGS_GEIKE, ON_STRIPS, closed=by_geike, seconds=3e-5, across="isotropic", is_mdr=True
)
"""MDR for a punch, C_1D(q) = pi q C_2D(q): not 0 dB for long waves. On other ground there is no C_2D of one number."""
