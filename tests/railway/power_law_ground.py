"""The ground of a made-up strip of rail, and such a strip."""

import math

from validation.railway.problems.rail_strip import RailGround, RailStrip, StatedAcross
from validation.railway.theory.transverse_structure import LineSpectrum


def power_law_ground(rms: float, first: float, last: float, across: StatedAcross = "isotropic") -> RailGround:
    """Heights of this rms [m], C_line ~ k^-2; if isotropic, C_line = 2 q C_2D and <h^2> = 2 pi int q C_2D dq."""
    level = rms**2 / (2 if across == "ridges" else math.pi) / (1 / first - 1 / last)
    line = LineSpectrum.through([first, last], [level / first**2, level / last**2])
    return RailGround(line=line, across=across, first=first, last=last)


def isotropic_strip(rms: float, length: float, spacing: float) -> RailStrip:
    """Waves of 15 to 60 mm under a wheel of 50 kN."""
    return RailStrip(
        ground=power_law_ground(rms, 2 * math.pi / 0.06, 2 * math.pi / 0.015),
        radii=(0.46, 0.3),
        **{"force": 5e4, "modulus": 115e9, "length": length, "width": 0.06, "spacing": spacing},
        **{"realisation": 0, "seed": 3},
    )
