"""The models of a comparison, by their places or by their names."""

from typing import SupportsIndex, overload

from validation.scenes.printable import quoted
from validation.selection.hierarchy import Candidate


class ComparedModels(tuple[Candidate, ...]):
    """All models, the cheapest first; a text stands for the one of that name, or whose name begins so."""

    __slots__ = ()

    @overload
    def __getitem__(self, which: str | SupportsIndex) -> Candidate: ...
    @overload
    def __getitem__(self, which: slice) -> tuple[Candidate, ...]: ...
    def __getitem__(self, which: str | SupportsIndex | slice) -> Candidate | tuple[Candidate, ...]:
        """Raises KeyError for a name that none has, or the beginning of several."""
        if not isinstance(which, str):
            return super().__getitem__(which)
        asked = which.strip().lower()
        found = [one for one in self if one.name.lower() == asked]
        found = found or [one for one in self if asked and one.name.lower().startswith(asked)]
        if len(found) != 1:
            names = ", ".join(quoted(one.name) for one in found or self)
            raise KeyError(f"models must be named by one of {names}, got {quoted(which)}")
        return found[0]
