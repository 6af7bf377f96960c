"""Persson's theory of an interface: the stiffness of a rough elastic half-space without ends under a mean pressure."""

from collections.abc import Callable, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special

from validation.theory.closed_forms import positive
from validation.theory.half_space import on_panels

FloatArray = NDArray[np.float64]
PANELS, NODES = 1000, 4
YANG_AND_PERSSON = 0.45
"""gamma: 0.42 to 0.48 in their simulations; one takes the energy of full contact on the area that touches."""


def persson_stiffness(
    pressure: ArrayLike,
    *,
    c2d: Callable[[FloatArray], FloatArray],
    edges: Sequence[float],
    modulus: float,
    gamma: float = YANG_AND_PERSSON,
) -> FloatArray:
    """K = dp / d(approach of the mean planes) = -dp/du [Pa/m], u the mean gap.

    Waves up to q, of C_2D(q) [m^4], leave P = erf(w p) of the area in contact, w(q)^2 = 1 / (pi E*^2 int^q q'^3 C dq').
    The elastic energy an area, U = (pi/2) E* int q^2 C P (gamma + (1 - gamma) P^2) dq, is the work of the pressure,
    p du = -dU. With s(q)^2 = int^q q'^3 C dq' and x = w p = p / (sqrt(pi) E* s) that is

        p / K = 2 int (gamma + 3 (1 - gamma) erf(x)^2) exp(-x^2) / q ds.

    For p -> 0, K = p / u_0 with u_0 = 2 gamma int ds / q, about 1.2 gamma times the rms height for a plateau and a
    power law beyond. K grows beyond all bounds towards full contact. Range: linear elasticity without adhesion; gamma
    is fitted to simulations. Trapezoidal rule over s, good to 1e-5.

    pressure: mean pressure p, positive, any shape [Pa]; c2d: of wavenumbers, smooth between edges; edges: ascending,
    the band between the first and the last [rad/m]; gamma: in (0, 1]. ValueError names what is out of range.
    Source: Persson, J. Chem. Phys. 115, 3840 (2001) for P, Phys. Rev. Lett. 99, 125502 (2007) for u with gamma = 1;
    Yang and Persson, J. Phys.: Condens. Matter 20, 215214 (2008) for gamma.
    """
    positive(modulus=modulus, gamma=gamma)
    p = np.asarray(pressure, dtype=np.float64)
    if not (np.isfinite(p).all() and (p > 0).all()):
        raise ValueError(f"pressure must be finite and positive, got {p}")
    if gamma > 1:
        raise ValueError(f"gamma must be in (0, 1], got {gamma}")
    q, s = _slopes(c2d, edges)
    with np.errstate(divide="ignore"):
        x = p[..., np.newaxis] / (np.sqrt(np.pi) * modulus * s)
        energy = (gamma + 3 * (1 - gamma) * special.erf(x) ** 2) * np.exp(-(x**2))
        return np.asarray(p / (2 * np.trapezoid(energy / q, s)))


def _slopes(c2d: Callable[[FloatArray], FloatArray], edges: Sequence[float]) -> tuple[FloatArray, FloatArray]:
    """Wavenumbers along the band, and s of each: the mean square gradient of the waves up to there is 2 pi s^2."""
    if len(edges) < 2 or not (edges[0] > 0 and (np.diff(edges) > 0).all()):
        raise ValueError(f"edges must be two or more, positive and ascending, got {tuple(edges)}")
    # s rises as a root from the longest wave on
    first = edges[0] + (edges[1] - edges[0]) * np.linspace(0, 1, PANELS + 1) ** 4
    q = np.unique(np.concatenate([first, *(np.geomspace(*ends, PANELS + 1) for ends in pairwise(edges[1:]))]))
    node, weight = on_panels(q, NODES)
    gained = (weight * node**3 * c2d(node)).reshape(-1, NODES).sum(axis=1)
    return q, np.sqrt(np.append(0.0, np.cumsum(gained)))
