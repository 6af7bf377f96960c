"""The stiffness of a rough interface alone, from that of the punch: a flat punch on a uniform elastic layer."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse.linalg import LinearOperator, cg

import bem3d
from validation.analysis.statistics import FloatArray, Statistic
from validation.engine.convergence import NotConvergedError


@dataclass(frozen=True)
class Layer:
    """A flat punch on a uniform elastic layer of stiffness kappa an area, over E* / L: the rough interface alone.

    In one dimension the layer is in series with every spring, k = 1 / (1/kappa + 1). On the half-space it is not in
    series with the whole punch, since the pressure is even on a soft layer and that of the flat punch on a stiff one:
    there k belongs to (K + 1 / kappa) p = 1. excess: ln kappa less that of the series, at part: k over k_flat,
    ascending.
    """

    flat: float
    part: FloatArray
    excess: FloatArray

    def log_kappa(self, stiffness: FloatArray) -> FloatArray:
        """ln kappa of a punch of this k / (E* L); NaN where it is as stiff as the flat one."""
        with np.errstate(divide="ignore", invalid="ignore"):
            series = -np.log(1 / stiffness - 1 / self.flat)
        return np.where(np.isfinite(series), series + np.interp(stiffness / self.flat, self.part, self.excess), np.nan)

    @property
    def statistic(self) -> Statistic:
        """ln kappa from the mean stiffness of the punch, level by level."""
        return lambda mean, deviation: self.log_kappa(mean)


SPRINGS = Layer(1.0, np.array([0.0, 1.0]), np.zeros(2))


def layer_on_half_space(cells: int) -> Layer:
    """k of kappa on so many cells a side, by conjugate gradients."""
    half_space = bem3d.HalfSpace(shape=(cells, cells), spacing=1 / cells, modulus=1.0)
    ones = np.ones(half_space.shape)
    flat = bem3d.solve_fixed_area(half_space, ones > 0).stiffness
    kappas, stiffness = np.geomspace(1e-3, 1e3, 37), []
    pressure = ones.ravel()
    for kappa in kappas:

        def displacement(p: FloatArray, kappa: float = kappa) -> FloatArray:
            return half_space.displacement(p.reshape(cells, cells)).ravel() + p / kappa

        operator = LinearOperator((cells**2, cells**2), matvec=displacement, dtype=np.float64)
        pressure, status = cg(operator, ones.ravel(), x0=kappa * pressure, rtol=1e-6)
        if status:
            raise NotConvergedError(f"the flat punch on a layer of stiffness {kappa:g} did not converge")
        stiffness.append(float(pressure.sum()) / cells**2)
        pressure = pressure / kappa
    found = np.array(stiffness)
    excess = np.log(kappas) + np.log(1 / found - 1 / flat)
    return Layer(flat, np.append(found / flat, 1.0), np.append(excess, excess[-1]))
