"""Tables of roughness levels: wavelength, or wavenumber in cycles per length, and dB re 1 um of one-third octaves."""

import math
from dataclasses import dataclass, replace
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.checks import finite
from validation.analysis.escapes import one_line, printable, quoted
from validation.analysis.spectra import NominalBands, nominal_wavelength
from validation.analysis.statistics import FloatArray
from validation.railway.theory.transverse_structure import LineSpectrum
from validation.scenes.number_table import NumberTable
from validation.scenes.reader import DECIBELS, Reader, errors_of, table, value_of_one_key, values
from validation.scenes.table_files import FORM, read_scene_table, read_table, sentence_about
from validation.scenes.text_dialect import RADIANS, WAVENUMBERS
from validation.scenes.units import UNITS, in_unit, metres_of

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

    def __repr__(self) -> str:
        ends = " to ".join(in_unit(wave, "length") for wave in (self.wavelengths[0], self.wavelengths[-1]))
        return one_line(f"RoughnessLevels({len(self.levels)} bands, {ends}, source={self.source!r})")

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
            allowed = f"one of the bands of {self.bands.span}"
            raise ValueError(f"longest and shortest must leave {allowed}, got that {none}") from None
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


CURVES = Path(__file__).parent / "levels"
COLUMNS = "wavelength [mm],level [dB re 1 um]"
"""The header of a file; other units of length do as well, and 1/m for a wavenumber."""
REFERENCES = ("", "1um", "um", "1micron", "1e-6m", "10^-6m", "1micrometre", "1micrometer")
NEAR = 0.05
"""By how much the wavelength of a wavenumber may differ from that of its band: 1/16 m beside 63 mm."""


@cache
def curve(name: str) -> RoughnessLevels:
    """The levels of a bundled curve: "iso3095-2013" or "cnossos-average". Raises ValueError for another name."""
    paths = {path.stem: path for path in sorted(CURVES.glob("*.csv"))}
    if name not in paths:
        raise ValueError(f"curve must be one of {', '.join(paths)}, got {quoted(name)}")
    return _levels_of("curve", paths[name], read_table("curve", paths[name]), source=name)[0]


def levels_in(name: str, value: object, *, folder: Path, notes: list[str]) -> RoughnessLevels:
    """Of a bundled curve or of a file, so many decibels more, between two wavelengths. notes: takes assumptions."""
    readers: dict[str, Reader] = {
        **values("curve", "file"),
        "offset": DECIBELS,
        **values("longest", "shortest"),
        "unit": unit_of_wavelengths,
        **FORM,
    }
    entries = table(readers, tuple(readers), name, value)
    value_of_one_key(entries, name, ("curve", "file"))
    if "file" in entries:
        path, numbers = read_scene_table(name, entries, folder)
        levels, assumptions = _levels_of(f"{name}.file", path, numbers, unit=entries.get("unit"))
        notes += sentence_about(path, assumptions)
    elif superfluous := [key for key in entries if key not in ("curve", "offset", "longest", "shortest")]:
        raise ValueError(
            f"{name}.{superfluous[0]} must be left out beside a curve, got it with {quoted(entries['curve'])}"
        )
    with errors_of(f"{name}."):
        levels = curve(entries["curve"]) if "curve" in entries else levels
        levels = levels.within(entries.get("longest"), entries.get("shortest"))
        return levels.raised(entries["offset"]) if "offset" in entries else levels


def _levels_of(
    name: str, path: Path, table: NumberTable, *, unit: str | None = None, source: str = ""
) -> tuple[RoughnessLevels, tuple[str, ...]]:
    """Levels of a file, in any order of long to short waves, and what was assumed of it, in sentences.

    unit: of the wavelengths, where their column does not name it. Raises ValueError for a file that holds no levels.
    """
    with errors_of(f"{name} {printable(path)}: "):
        of_wave, of_level = _wave_and_level(table, unit)
        complete = np.isfinite(table.values[:, [of_wave, of_level]]).all(axis=1)
        waves, levels = (table.values[complete, i] for i in (of_wave, of_level))
        wavelengths, notes = _wavelengths(waves, table.columns[of_wave].unit or str(unit))
        order = slice(None, None, -1 if wavelengths[:1] < wavelengths[-1:] else 1)
        left_out = int((~complete).sum())
        notes += (f"{left_out} of its rows have no level and are left out",) if left_out else ()
        roughness = RoughnessLevels(
            wavelengths=tuple(wavelengths[order]), levels=tuple(levels[order].tolist()), source=source or path.name
        )
    unread = [i for i in range(len(table.columns)) if i not in (of_wave, of_level)]
    notes += (f"without {table.names(unread)}",) if unread else ()
    return roughness, (*table.notes, *notes)


def _wave_and_level(table: NumberTable, unit: str | None) -> tuple[int, int]:
    """The columns of wavelength and level. Raises ValueError."""
    units = [column.unit for column in table.columns]
    lengths = [i for i, name in enumerate(units) if name in UNITS["length"]]
    waves = lengths or [i for i, name in enumerate(units) if name in WAVENUMBERS]
    levels = [i for i, name in enumerate(units) if name == "dB"]
    if len(units) == 2 and (waves or unit or levels):
        # the other of two is the other, unless it is another quantity
        waves = waves or [i for i in ([1 - levels[0]] if levels else [0]) if not units[i]]
        levels = levels or [i for i in range(2) if i not in waves and not units[i]]
    if len(levels) > 1 or (levels and len(waves) > 1):
        raise ValueError(
            f"one column of wavelengths and one of levels must be read, got {table.names([*waves, *levels])}: say which"
            f", as: columns = [{(waves or [0])[0] + 1}, {levels[0] + 1}]"
        )
    if not waves or not levels:
        of_units = "" if any(units) else ': without such names, as: columns = [1, 2], unit = "mm"'
        of_many = ": the key columns has the two that are read, as numbers from 1 or as names" if len(units) > 2 else ""
        raise ValueError(
            f"the columns must be named as {COLUMNS!r}, with their units, got {table.names(range(len(units)))}"
            + (of_units or of_many)
        )
    of_wave, of_level = waves[0], levels[0]
    if unit is None and not units[of_wave]:
        raise ValueError(
            f'wavelengths must have a unit, as in {COLUMNS!r}, got {table.names([of_wave])}: as: unit = "mm"'
        )
    if unit is not None and units[of_wave] and metres_of("unit", unit) != metres_of("unit", units[of_wave]):
        raise ValueError(
            f"unit must be that of the column {table.names([of_wave])}, or be left out, got {quoted(unit)}"
        )
    reference = table.columns[of_level].reference.replace(" ", "").lower()
    if reference not in REFERENCES:
        raise ValueError(f"levels must be in dB re 1 um, got dB re {printable(table.columns[of_level].reference)}")
    return of_wave, of_level


def _wavelengths(values: NDArray[np.float64], unit: str) -> tuple[list[float], tuple[str, ...]]:
    """In metres, those of wavenumbers by the nominal band."""
    numbers = values.tolist()
    if unit not in WAVENUMBERS:
        return [value * metres_of("unit", unit) for value in numbers], ()
    if any(value <= 0 for value in numbers):
        raise ValueError(f"wavenumbers must be positive, got {min(numbers):g} {unit}")
    nominal = []
    for value in numbers:
        length = 1 / (value * WAVENUMBERS[unit])
        band = nominal_wavelength(round(10 * math.log10(length)))
        if abs(length / band - 1) > NEAR:
            raise ValueError(f"wavenumbers must be those of one-third octaves, got {value:g} {unit}")
        nominal.append(band)
    words = "k = 2 pi / wavelength" if unit == RADIANS else "cycles: wavelength = 1 / k"
    return nominal, (f"its wavenumbers in {unit} are {words}, each of the nearest one-third octave",)


def unit_of_wavelengths(name: str, value: object) -> str:
    """A length, or cycles over one. Raises ValueError."""
    if value not in WAVENUMBERS:
        metres_of(name, value)
    return str(value)
