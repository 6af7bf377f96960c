"""FFTW, by its package without the parts that are not needed here."""

import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder
from importlib.util import LazyLoader
from types import ModuleType

UNUSED = "pyfftw.interfaces"
"""Imports scipy.fftpack and, where it is installed, dask.array: four fifths of the time of `import pyfftw`."""


class _OnFirstUse(MetaPathFinder):
    """Finds the unused part as a module that is executed when somebody first uses it."""

    @staticmethod
    def find_spec(fullname: str, path: Sequence[str] | None, target: ModuleType | None = None) -> ModuleSpec | None:
        spec = PathFinder.find_spec(fullname, path, target) if fullname == UNUSED else None
        if spec is not None and spec.loader is not None:
            spec.loader = LazyLoader(spec.loader)
        return spec


@contextmanager
def _unused_part_later() -> Iterator[None]:
    finder = _OnFirstUse()
    sys.meta_path.insert(0, finder)
    try:
        yield
    finally:
        sys.meta_path.remove(finder)


def import_pyfftw() -> ModuleType:
    """The package `pyfftw`; whoever uses `pyfftw.interfaces` later finds it as usual."""
    with nullcontext() if "pyfftw" in sys.modules else _unused_part_later():
        import pyfftw  # noqa: F401
    return sys.modules["pyfftw"]
