"""What rolling along a track of springs gives."""

from __future__ import annotations

from dataclasses import dataclass

from mdr.checks import FloatArray
from mdr.formatting import span
from mdr.read_only import ReadOnlyArrays


@dataclass(frozen=True, eq=False, kw_only=True)
class RollingTrack(ReadOnlyArrays):
    """Wheel at each point of its track. Made by `roll`; ``mdr.Rolling`` in 0.1.

    Attributes
    ----------
    force : ndarray, shape (points,)
        Normal force [N].
    approach : ndarray, shape (points,)
        Approach of the smooth wheel to the plane of height zero [m].
    stiffness : ndarray, shape (points,)
        dF/dd of the springs in contact [N/m].
    examined : ndarray, shape (points,)
        Springs that were looked at one by one: those that may touch or not. A measure of the work.

    Examples
    --------
    >>> rolled = mdr.roll(np.zeros(64), spacing=1e-4, radius=0.5, modulus=2e11, force=1e3)
    >>> print(f"{rolled.approach[0]:.3g} m")
    3.04e-06 m
    """

    force: FloatArray
    approach: FloatArray
    stiffness: FloatArray
    examined: FloatArray

    def __repr__(self) -> str:
        load = f"force={span(self.force, 'N')}, approach={span(self.approach, 'm')}"
        return f"RollingTrack({self.force.size} points, {load}, stiffness={span(self.stiffness, 'N/m')})"
