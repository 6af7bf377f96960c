"""What functions of the face take: one comparison, or several of them."""

from collections.abc import Sequence

from validation.scenes.printable import shortened
from validation.selection.compare import Comparison

OneOrSeveral = Comparison | Sequence[Comparison]


def listed(comparison: OneOrSeveral) -> list[Comparison]:
    """All of them. Raises TypeError for anything else, ValueError for none."""
    if isinstance(comparison, Comparison):
        return [comparison]
    if not isinstance(comparison, Sequence) or not all(isinstance(one, Comparison) for one in comparison):
        raise TypeError(f"comparison must be what compare returns, or a list of that, got {shortened(comparison)}")
    if not comparison:
        raise ValueError("comparison must be one or several, got an empty list")
    return list(comparison)
