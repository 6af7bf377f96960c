"""The statement of a contact problem: half-space, gap, and what is prescribed."""

from dataclasses import dataclass

from bem3d.checks import FloatArray, field, finite, not_negative
from bem3d.halfspace import HalfSpace
from bem3d.read_only import ReadOnly, kept


@dataclass(frozen=True, eq=False, kw_only=True)
class Problem(ReadOnly):
    """p >= 0, w = gap + u - approach >= 0, p w = 0, at a given approach or a given force.

    half_space: the operator u = K p and its grid; gap: undeformed separation, shape of the half-space, a bump makes
    it smaller [m]; exactly one of approach, of any sign [m], and force, zero or positive [N].

    A periodic half-space measures the approach from its mean plane, so an approach of mean(gap) or more is full
    contact under an unknown mean pressure: it is refused, give the force.
    Raises ValueError or TypeError naming the argument that is out of range.
    """

    half_space: HalfSpace
    gap: FloatArray
    approach: float | None = None
    force: float | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.half_space, HalfSpace):
            raise TypeError(f"half_space must be a bem3d.HalfSpace, got {type(self.half_space).__name__}")
        # a result carries the problem it answers, whatever the caller does with the array afterwards
        object.__setattr__(self, "gap", kept(field("gap", self.gap, self.half_space.shape)))
        self._check_load()

    def _check_load(self) -> None:
        if (self.approach is None) == (self.force is None):
            raise ValueError(f"give either approach or force, got approach={self.approach} and force={self.force}")
        if self.force is not None:
            object.__setattr__(self, "force", not_negative("force", self.force))
        if self.approach is not None:
            object.__setattr__(self, "approach", finite("approach", self.approach))
            mean = float(self.gap.mean())
            if self.half_space.periodic and self.approach >= mean:
                raise ValueError(
                    f"approach must stay below the mean gap, {mean:.6g} m, of a periodic half-space, "
                    f"got {self.approach:.6g}: beyond it the contact is full and only a force sets the pressure"
                )

    @property
    def first_touch(self) -> float:
        """The approach at which contact begins: min(gap) [m]."""
        return float(self.gap.min())

    @property
    def depth(self) -> float | None:
        """Prescribed approach beyond the first touch, the deepest geometric overlap [m]; None where force is given."""
        return None if self.approach is None else self.approach - self.first_touch

    @property
    def total(self) -> float | None:
        """Sum of the pressures over the cells, F / (dx dy) [Pa]; None where approach is given."""
        return None if self.force is None else self.force / self.half_space.cell_area

    def under(self, value: float) -> "Problem":
        """The same problem at another approach or force, whichever is prescribed; the gap is shared."""
        other = object.__new__(Problem)
        other.__dict__.update(self.__dict__)
        object.__setattr__(other, "force" if self.approach is None else "approach", value)
        other._check_load()
        return other

    @property
    def uniform(self) -> bool:
        """Whether a flat gap meets a periodic half-space: a uniform pressure, and no overlap to scale by."""
        return self.half_space.periodic and float(self.gap.max()) == self.first_touch

    @property
    def touching(self) -> bool:
        """Whether there is any contact: an approach beyond the first touch, or a force above zero."""
        return self.depth > 0 if self.depth is not None else self.force != 0
