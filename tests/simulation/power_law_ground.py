"""The ground of a made-up strip of rail."""

from validation.simulation.rail_strip import RailGround, StatedAcross
from validation.theory.line_spectrum import LineSpectrum


def power_law_ground(rms: float, first: float, last: float, across: StatedAcross = "isotropic") -> RailGround:
    """A line of this rms [m] with C_line ~ k^-2 between two wavenumbers."""
    level = rms**2 / 2 / (1 / first - 1 / last)
    line = LineSpectrum.through([first, last], [level / first**2, level / last**2])
    return RailGround(line=line, across=across, first=first, last=last)
