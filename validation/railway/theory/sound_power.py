"""Sound power of a rolling wheel and its track from the equivalent roughness, by the transfer functions of CNOSSOS-EU.

L_W,tr = L_eq + G-3a + 10 lg N_a and L_W,veh = L_eq + G-3b + 10 lg N_a [dB re 1 pW] are summed as energies; L_eq [dB re
1 um] is the roughness of wheel and rail together behind the contact filter, N_a the number of axles. Source: Directive
2002/49/EC, Annex II, (2.3.7) to (2.3.9), and tables G-3a and G-3b of Appendix G as amended by (EU) 2021/1226.

G-3a and G-3b contain the mobilities and the radiation of their own track and wheel, sleepers and ballast included.
"""

import math
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.checks import count, positive
from validation.analysis.spectra import a_weighting, energy_sum

FloatArray = NDArray[np.float64]

TABLE, HEADER = Path(__file__).parents[1] / "tables" / "cnossos_g3_2021.csv", 2
"""Lines of source and edition above the names of the columns."""
DEFAULT_TRACK = "M/M"
"""Mono-block sleepers on pads of medium stiffness."""
SLEEPERS = {"M": "mono-block sleepers", "B": "bi-block sleepers", "W": "wooden sleepers"}
PADS = {"S": "soft pads", "M": "medium pads", "H": "hard pads"}
MOST_AXLES = 1000
NEAR = 1e-9
"""Of the distance of two bands, by which a frequency may lie beyond the last."""


@cache
def _columns() -> dict[str, FloatArray]:
    """Columns of the table by their names."""
    lines = TABLE.read_text(encoding="utf-8").splitlines()[HEADER:]
    rows = np.array([line.split(",") for line in lines[1:]], dtype=np.float64)
    return dict(zip(lines[0].split(","), rows.T, strict=True))


@cache
def frequencies() -> FloatArray:
    """Nominal frequencies of the one-third octaves of the tables, 50 Hz to 10 kHz [Hz]."""
    return _columns()["frequency [Hz]"]


@cache
def tracks() -> tuple[str, ...]:
    """Columns of G-3a: sleeper and pad, as "M/S"; "W" has no pad."""
    return tuple(name for name in _columns() if name in SLEEPERS or "/" in name)


@cache
def wheels() -> tuple[int, ...]:
    """Columns of G-3b: diameters of wheels, ascending [mm]."""
    return tuple(sorted(int(name.removeprefix("wheel ")) for name in _columns() if name.startswith("wheel ")))


def nearest_wheel(diameter: float) -> int:
    """The column of G-3b whose diameter has the smallest ratio to a diameter [m], in mm."""
    return min(wheels(), key=lambda of_column: abs(math.log(of_column / (1e3 * positive("diameter", diameter)))))


@dataclass(frozen=True)
class SoundTransfer:
    """From equivalent roughness to sound power. track: of ``tracks``; wheel: of ``wheels`` [mm]; axles: N_a, 1 or more.

    Raises ValueError, TypeError for any other value.
    """

    track: str = DEFAULT_TRACK
    wheel: int = 920
    axles: int = 1

    def __post_init__(self) -> None:
        if self.track not in tracks():
            raise ValueError(f"track must be one of {', '.join(tracks())}, got {self.track!r}")
        if self.wheel not in wheels():
            raise ValueError(f"wheel must be one of {', '.join(map(str, wheels()))} mm, got {self.wheel!r}")
        if count("axles", self.axles, least=1) > MOST_AXLES:
            raise ValueError(f"axles must be at most {MOST_AXLES}, got {self.axles}")

    @property
    def of_track(self) -> FloatArray:
        """G-3a + 10 lg N_a: L_W,tr - L_eq in each band [dB]."""
        return _columns()[self.track] + 10 * math.log10(self.axles)

    @property
    def of_wheel(self) -> FloatArray:
        """G-3b + 10 lg N_a: L_W,veh - L_eq in each band [dB]."""
        return _columns()[f"wheel {self.wheel}"] + 10 * math.log10(self.axles)

    @property
    def of_both(self) -> FloatArray:
        """L_W - L_eq in each band, energies of track and wheel added [dB]."""
        return np.asarray(10 * np.log10(10 ** (self.of_track / 10) + 10 ** (self.of_wheel / 10)))

    @property
    def in_words(self) -> str:
        """As "track M/M (mono-block sleepers, medium pads), wheel of 920 mm, per axle"."""
        sleeper, _, pad = self.track.partition("/")
        made_of = ", ".join(filter(None, (SLEEPERS[sleeper], PADS.get(pad, ""))))
        axles = "per axle" if self.axles == 1 else f"{self.axles} axles"
        return f"track {self.track} ({made_of}), wheel of {self.wheel} mm, {axles}"


def in_frequency(levels: ArrayLike, wavelengths: ArrayLike, speed: float) -> FloatArray:
    """Levels over wavelength as levels in the bands of ``frequencies``, at f = v / lambda [dB].

    Each band takes the energies of the two bands of wavelength between whose nominal centres v / f lies, in proportion
    to the distances over lg(lambda), as the directive averages them. levels: (..., bands) [dB]; wavelengths: nominal,
    descending, (bands,) [m]; speed: v [m/s]. Bands beyond the first or last wavelength are NaN.
    """
    wave = np.log10(np.asarray(wavelengths, dtype=np.float64))[::-1]
    energy = 10 ** (np.asarray(levels, dtype=np.float64)[..., ::-1] / 10)
    at = np.log10(positive("speed", speed) / frequencies())
    shorter = np.clip(np.searchsorted(wave, at, side="right") - 1, 0, wave.size - 2) if wave.size > 1 else 0 * at
    low = np.asarray(shorter, dtype=np.intp)
    high = np.minimum(low + 1, wave.size - 1)
    share = (at - wave[low]) / np.where(high > low, wave[high] - wave[low], 1.0)
    # of a band without a part in it, an infinite one takes no part either
    parts = [
        np.multiply(of, energy[..., i], where=of > 0, out=np.zeros((*energy.shape[:-1], at.size)))
        for of, i in ((1 - share, low), (share, high))
    ]
    inside = (share >= -NEAR) & (share <= 1 + NEAR) if wave.size > 1 else np.abs(at - wave[0]) < NEAR
    with np.errstate(divide="ignore"):
        return np.asarray(np.where(inside, 10 * np.log10(parts[0] + parts[1]), np.nan))


def weighting() -> FloatArray:
    """A-weighting of IEC 61672-1 in the bands of ``frequencies``, at their exact centres 10^(n/10) Hz [dB]."""
    return a_weighting(10 ** (np.rint(10 * np.log10(frequencies())) / 10))


def weighted_total(levels: ArrayLike) -> float:
    """Sum of the energies of A-weighted levels in the bands of ``frequencies``, those that are not NaN [dB(A)]."""
    weighted = np.asarray(levels, dtype=np.float64) + weighting()
    present = weighted[~np.isnan(weighted)]
    return energy_sum(present) if present.size else math.nan
