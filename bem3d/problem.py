"""The statement of a contact problem: half-space, gap, and what is prescribed."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from bem3d.checks import FloatArray, boolean, field, finite, not_negative
from bem3d.diagnostics import typical_slope
from bem3d.halfspace import HalfSpace
from bem3d.results import ReadOnly, kept, line, span


@dataclass(frozen=True, eq=False, kw_only=True)
class Problem(ReadOnly):
    """Statement of a contact problem: p >= 0, w = gap + u - approach >= 0, p w = 0.

    Parameters
    ----------
    half_space : HalfSpace
        Operator u = K p and its grid.
    gap : array_like, shape of the half-space
        Undeformed separation; a bump makes it smaller [m].
    approach : float, optional
        Rigid approach, of any sign [m]. Give either ``approach`` or ``force``.
    force : float, optional
        Normal force, zero or positive [N].
    indenter_ends_at_edge : bool, optional
        Whether the indenter is a punch that ends where its grid does. It is not warned of, and changes no result.

    Raises
    ------
    ValueError, TypeError
        If an argument is out of range; the message names it.

    Notes
    -----
    A periodic half-space counts the approach from its mean plane. At mean(gap) or more the contact is full under an
    unknown mean pressure: such an approach is a ValueError, give the force.

    Examples
    --------
    >>> body = bem3d.HalfSpace(shape=(4, 4), spacing=1e-4, modulus=1e11)
    >>> problem = bem3d.Problem(half_space=body, gap=np.full((4, 4), 1e-6), approach=3e-6)
    >>> print(f"contact begins at {problem.first_touch:.3g} m, overlap {problem.depth:.3g} m")
    contact begins at 1e-06 m, overlap 2e-06 m
    """

    half_space: HalfSpace
    gap: FloatArray
    approach: float | None = None
    force: float | None = None
    indenter_ends_at_edge: bool = False

    def __post_init__(self) -> None:
        if not isinstance(self.half_space, HalfSpace):
            raise TypeError(f"half_space must be a bem3d.HalfSpace, got {type(self.half_space).__name__}")
        # a result carries the problem it answers, whatever the caller does with the array afterwards
        object.__setattr__(self, "gap", kept(field("gap", self.gap, self.half_space.shape)))
        boolean("indenter_ends_at_edge", self.indenter_ends_at_edge)
        self._check_load()

    def __repr__(self) -> str:
        cells = " x ".join(map(str, self.half_space.shape))
        given = ("force", self.force, "N") if self.approach is None else ("approach", self.approach, "m")
        load = f"{given[0]}={span(given[1] or 0.0, given[2])}"
        more = ", periodic" * self.half_space.periodic + ", indenter_ends_at_edge" * self.indenter_ends_at_edge
        modulus = span(self.half_space.modulus, "Pa")
        return line(f"Problem({cells} cells, modulus={modulus}, gap={span(self.gap, 'm')}, {load}{more})")

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

    @cached_property
    def first_touch(self) -> float:
        """The approach at which contact begins: min(gap) [m]."""
        return float(self.gap.min())

    @cached_property
    def slope(self) -> float:
        """`typical_slope` of the gap."""
        return typical_slope(self.gap, self.half_space.steps)

    @property
    def depth(self) -> float | None:
        """Prescribed approach beyond the first touch, the deepest geometric overlap [m]; None where force is given."""
        return None if self.approach is None else self.approach - self.first_touch

    @property
    def total(self) -> float | None:
        """Sum of the pressures over the cells, F / (dx dy) [Pa]; None where approach is given."""
        return None if self.force is None else self.force / self.half_space.cell_area

    def under(self, value: float) -> Problem:
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
