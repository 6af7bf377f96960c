"""A rigid cosine wave pressed against the periodic half-space on one row of cells, beside Westergaard."""

import warnings
from dataclasses import dataclass

import numpy as np

import bem3d
from validation.engine.engine import Outcome
from validation.theory import closed_forms


@dataclass(frozen=True, kw_only=True)
class CosineWave:
    """wavelength, amplitude [m]; modulus: E* [Pa]; load: mean pressure over that of full contact; cells: in a
    wavelength; tolerance: residual of the solver."""

    wavelength: float
    amplitude: float
    modulus: float
    load: float
    cells: int
    tolerance: float

    @property
    def full_pressure(self) -> float:
        """p* = pi E* h / lambda [Pa]."""
        return closed_forms.westergaard_full_pressure(
            amplitude=self.amplitude, wavelength=self.wavelength, modulus=self.modulus
        )

    @property
    def scene(self) -> dict[str, float]:
        """Arguments of the closed forms."""
        return {
            "mean_pressure": self.load * self.full_pressure,
            "amplitude": self.amplitude,
            "wavelength": self.wavelength,
            "modulus": self.modulus,
        }

    @property
    def spacing(self) -> float:
        """Side of a cell [m]."""
        return self.wavelength / self.cells


def press_wave(wave: CosineWave) -> Outcome:
    """One row of cells along one wavelength: a third dimension would add nothing."""
    x = (np.arange(wave.cells) + 0.5) * wave.spacing - wave.wavelength / 2
    half_space = bem3d.HalfSpace(shape=(wave.cells, 1), spacing=wave.spacing, modulus=wave.modulus, periodic=True)
    gap = 2 * wave.amplitude * np.sin(np.pi * x / wave.wavelength) ** 2
    force = wave.scene["mean_pressure"] * wave.wavelength * wave.spacing
    with warnings.catch_warnings():
        # the contact is a line: one row of cells resolves it
        warnings.simplefilter("ignore", bem3d.ResolutionWarning)
        contact = bem3d.solve(half_space, gap[:, np.newaxis], force=force, tolerance=wave.tolerance)
    exact = closed_forms.westergaard_pressure(x, **wave.scene)
    return {
        "x": x,
        "pressure": contact.pressure[:, 0],
        "exact_pressure": exact,
        "error": np.sqrt(np.sum((contact.pressure[:, 0] - exact) ** 2) / np.sum(exact**2)),
        "half_width": np.array(contact.area / (2 * wave.spacing)),
    }
