"""Files of roughness levels: a CSV of wavelength and dB re 1 um, its units in the names of its columns."""

import re
from collections.abc import Sequence
from pathlib import Path

from validation.scenes.input_files import contents_of
from validation.scenes.printable import printable, quoted
from validation.scenes.roughness_levels import RoughnessLevels
from validation.scenes.two_columns import numbers_of, rows_of_two
from validation.scenes.units import UNITS, quantity

CURVES = Path(__file__).parent / "levels"
MOST_BYTES = 100_000
COLUMNS = "wavelength [mm],level [dB re 1 um]"
"""The header of a file, in another unit of wavelength too; wavelength_mm and level_dB do as well."""


def curve_names() -> tuple[str, ...]:
    """Of the bundled curves."""
    return tuple(sorted(path.stem for path in CURVES.glob("*.csv")))


def curve(name: str) -> RoughnessLevels:
    """The levels of a bundled curve: "iso3095-2013" or "cnossos-average". Raises ValueError for another name."""
    if name not in curve_names():
        raise ValueError(f"curve must be one of {', '.join(curve_names())}, got {quoted(name)}")
    return read_levels("curve", CURVES / f"{name}.csv", source=name)


def read_levels(name: str, path: Path, *, source: str = "") -> RoughnessLevels:
    """Levels of a file, in any order of long to short waves.

    Raises OSError for a file that cannot be read, ValueError for one that holds no levels; both name it.
    """
    text = contents_of(name, path, most=MOST_BYTES)
    try:
        rows = rows_of_two(text.decode("utf-8-sig"), "a file of levels must have two columns, wavelength and level")
        metre = _metre(rows[0])
        pairs = [(wavelength * metre, level) for wavelength, level in map(numbers_of, rows[1:])]
        if len(pairs) > 1 and pairs[0][0] < pairs[-1][0]:
            pairs.reverse()
        wavelengths, levels = zip(*pairs, strict=True) if pairs else ((), ())
        return RoughnessLevels(wavelengths=wavelengths, levels=levels, source=source or path.name)
    except ValueError as problem:
        raise ValueError(f"{name} {printable(path)}: {printable(problem)}") from None


def _metre(header: Sequence[str]) -> float:
    """The unit of wavelength in metres, by the name of the first column; the second must be of dB re 1 um."""
    words = [re.findall(r"[a-zµμ]+|\d+", cell.replace("_", " "), flags=re.IGNORECASE) for cell in header]
    units = [word for word in words[0] if word in UNITS["length"]]
    level = [word.lower() for word in words[1]]
    reference = level[level.index("re") + 1 :] if "re" in level else []
    if words[0][:1] != ["wavelength"] or len(units) != 1 or "db" not in level:
        raise ValueError(f"the columns must be named as {COLUMNS!r}, with their units, got {','.join(header)!r}")
    if reference not in ([], ["1", "um"], ["1", "µm"], ["1", "μm"], ["um"], ["µm"], ["μm"]):
        raise ValueError(f"levels must be in dB re 1 um, got {header[1]!r}")
    return quantity("wavelength", f"1 {units[0]}", "length")
