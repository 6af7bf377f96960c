"""Roughness as the field of rolling noise has it: levels in dB re 1 um of one line, over nominal wavelengths."""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.checks import finite
from validation.analysis.nominal_bands import NominalBands
from validation.analysis.statistics import FloatArray
from validation.railway.theory.line_spectrum import LineSpectrum

MICROMETRE = 1e-6
LEAST, MOST = -100.0, 50.0
"""dB re 1 um of one band, 0.01 nm and 0.3 mm: beyond, the unit is another, as 1 m or 1 nm."""
STEPS, CLOSE = 200, 1e-12
"""Of the iteration for the spectrum, and the relative error of a band's power that ends it."""


@dataclass(frozen=True, kw_only=True)
class RoughnessLevels:
    """Levels L = 20 lg(rms / 1 um) of a line in base-ten one-third octaves.

    wavelengths: nominal [m], the longest first, none left out; levels: dB re 1 um; source: where they come from;
    errors: half-widths of 95 % that faults of a measurement leave in each band [dB], none where there are no faults;
    fault: why such an error is not known, where it is infinite.

    Raises ValueError for wavelengths that are no such bands, and for levels or errors that are none.
    """

    wavelengths: tuple[float, ...]
    levels: tuple[float, ...]
    source: str = "given"
    errors: tuple[float, ...] = ()
    fault: str = ""

    def __post_init__(self) -> None:
        _ = self.bands
        if len(self.errors) not in (0, len(self.levels)) or not all(error >= 0 for error in self.errors):
            raise ValueError(f"errors must be none or one a level, zero or positive, got {self.errors}")
        if len(self.levels) != len(self.wavelengths):
            raise ValueError(
                f"levels must be one a wavelength, got {len(self.levels)} for {len(self.wavelengths)} wavelengths"
            )
        for wavelength, level in zip(self.wavelengths, self.levels, strict=True):
            if not LEAST <= finite("levels", level) <= MOST:
                raise ValueError(
                    f"levels must lie between {LEAST:g} and {MOST:g} dB re 1 um, got {level:g} dB at "
                    f"{wavelength * 1000:g} mm: is the unit another?"
                )

    @classmethod
    def of_powers(cls, bands: NominalBands, powers: ArrayLike, *, source: str, **faults: Any) -> "RoughnessLevels":
        """Of the mean square of the heights in each band [m^2]."""
        # a band without any power is refused with the others that are none
        levels = 10 * np.log10(np.maximum(np.asarray(powers, dtype=np.float64), 1e-99) / MICROMETRE**2)
        return cls(wavelengths=tuple(bands.nominal.tolist()), levels=tuple(levels.tolist()), source=source, **faults)

    @cached_property
    def bands(self) -> NominalBands:
        """The base-ten one-third octaves that the wavelengths name."""
        return NominalBands.named(self.wavelengths)

    @property
    def powers(self) -> FloatArray:
        """Mean square of the heights in each band [m^2]."""
        return np.asarray(MICROMETRE**2 * 10 ** (np.array(self.levels) / 10))

    @property
    def rms(self) -> float:
        """Root mean square height over all bands [m]."""
        return math.sqrt(float(self.powers.sum()))

    @property
    def slope_along(self) -> float:
        """h', the root mean square slope along the line, of the waves in all bands [-]."""
        return self.bands.slope_of_spectrum(self.c_line)

    def within(self, longest: float | None, shortest: float | None) -> "RoughnessLevels":
        """Bands between two nominal wavelengths [m] alone, None for the end that there is. ValueError for none."""
        first, last = self.bands.nominal[[0, -1]]
        try:
            kept = self.bands.within(first if longest is None else longest, last if shortest is None else shortest)
        except ValueError as none:
            known = f"one of the bands of {self.bands.span}"
            raise ValueError(f"longest and shortest must leave {known}, got that {none}") from None
        start = self.bands.longest - kept.longest
        inside = slice(start, start + len(kept))
        return replace(
            self, wavelengths=self.wavelengths[inside], levels=self.levels[inside], errors=self.errors[inside]
        )

    def raised(self, offset: float) -> "RoughnessLevels":
        """The same with so many dB more in each band."""
        levels = tuple(level + offset for level in self.levels)
        return replace(self, levels=levels, source=f"{self.source} {offset:+g} dB")

    def __add__(self, other: "RoughnessLevels") -> "RoughnessLevels":
        """Energies of both, over these bands; where the other has no level it adds nothing."""
        more, left = (
            dict(zip(other.bands.numbers, values, strict=True)) for values in (other.powers, other._powers_of_errors)
        )
        powers = self.powers + [more.get(number, 0.0) for number in self.bands.numbers]
        change = self._powers_of_errors + [left.get(number, 0.0) for number in self.bands.numbers]
        return RoughnessLevels.of_powers(
            self.bands,
            powers,
            source=f"{self.source} and {other.source}",
            errors=tuple((10 * np.log10(1 + change / powers)).tolist()) if self.errors or other.errors else (),
            fault="; ".join(filter(None, (self.fault, other.fault))),
        )

    @property
    def _powers_of_errors(self) -> FloatArray:
        """What errors are of the mean squares, which add [m^2]."""
        return np.asarray(self.powers * (10 ** (np.array(self.errors or (0.0,)) / 10) - 1))

    @cached_property
    def c_line(self) -> LineSpectrum:
        """C_line of one line [m^3], whose integral over each band is the power of that band.

        A power of q between the centres of the bands, and up to both outer edges.
        """
        return line_of_powers(self.bands, self.powers)


def line_of_powers(bands: NominalBands, powers: FloatArray) -> LineSpectrum:
    """`RoughnessLevels.c_line` of mean squares of the heights in each band [m^2]."""
    density = powers / (2 * np.diff(bands.edges))
    for _ in range(STEPS):
        line = LineSpectrum.through(*_with_outer_edges(bands, density))
        excess = bands.powers_of_spectrum(line) / powers
        if np.abs(excess - 1).max() < CLOSE:
            break
        density = density / excess
    return line


def _with_outer_edges(bands: NominalBands, density: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Centres and both outer edges, and the density there; beyond the last centres the last power goes on."""
    q, edges = bands.centres, bands.edges[[0, -1]]
    if len(bands) == 1:
        return edges, np.repeat(density, 2)
    first, last = (density[i] * math.sqrt(density[i] / density[j]) for i, j in ((0, 1), (-1, -2)))
    return np.concatenate([edges[:1], q, edges[1:]]), np.concatenate([[first], density, [last]])
