"""Independent solves: their seeds, their workers, their stored results. The one seam for everything done many times."""

import hashlib
import importlib.metadata
import io
import json
import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TypeVar
from zipfile import BadZipFile

import joblib
import numpy as np
from numpy.typing import NDArray
from tqdm import tqdm

from validation.files import write_whole

Outcome = dict[str, NDArray[np.float64]]
P = TypeVar("P")

ROOT = Path(__file__).parents[1]
NUMERICS = ("mdr", "bem3d", "validation")
ON_PAPER = ROOT / "validation" / "report"
LIBRARIES = ("numpy", "scipy", "pyfftw")


def generator(entropy: int, *key: int) -> np.random.Generator:
    """The random numbers of one realisation, independent of all others and of who computes them.

    entropy: seed of the whole run, zero or positive; key: address of the realisation, whole numbers.
    """
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(entropy, spawn_key=key)))


@dataclass(frozen=True)
class Engine:
    """Runs independent solves on worker processes and keeps what they found.

    workers: processes; store: folder for finished results, None keeps nothing; progress: a bar, on a terminal only.
    A stored result is used again only if the solve, its problem, the source of the numerics and their libraries are
    the same; damaged or foreign files are computed anew.
    """

    workers: int = 1
    store: Path | None = None
    progress: bool = False

    def map(self, solve: Callable[[P], Outcome], problems: Sequence[P]) -> list[Outcome]:
        """solve(problem) for each problem, in their order, whatever the number of workers.

        solve: a module's own function; problems: frozen dataclasses of plain values, which their repr identifies.
        """
        tasks = [joblib.delayed(_solve_or_load)(solve, problem, self.store) for problem in problems]
        outcomes = joblib.Parallel(n_jobs=min(self.workers, len(tasks)) or 1, return_as="generator")(tasks)
        bar = tqdm(outcomes, total=len(tasks), desc=solve.__name__, disable=None if self.progress else True)
        return list(bar)


SERIAL = Engine()


def _solve_or_load(solve: Callable[[P], Outcome], problem: P, store: Path | None) -> Outcome:
    if store is None:
        return solve(problem)
    key = f"{solve.__module__}.{solve.__qualname__}({problem!r}) {_numerics()}"
    case, digest = solve.__module__.rpartition(".")[2], hashlib.sha256(key.encode()).hexdigest()
    path = store / f"{case}-{solve.__name__}-{digest[:24]}.npz"
    stored = _load(path, key)
    if stored is not None:
        return stored
    outcome = solve(problem)
    _save(path, key, outcome)
    return outcome


def _load(path: Path, key: str) -> Outcome | None:
    """A stored result, or None if there is none that can be trusted."""
    try:
        with np.load(io.BytesIO(path.read_bytes()), allow_pickle=False) as archive:
            contents = {name: archive[name] for name in archive.files}
    except (OSError, ValueError, KeyError, EOFError, BadZipFile, zlib.error):
        return None
    if str(contents.pop("key", "")) != key:
        return None
    return contents


def _save(path: Path, key: str, outcome: Outcome) -> None:
    archive = io.BytesIO()
    np.savez(archive, **{"key": np.array(key), **outcome})  # type: ignore[arg-type]  # stubs take a name for a flag
    write_whole(path, archive.getvalue())


@cache
def _numerics() -> str:
    """Digest of all source but what only draws and writes, and of the libraries under it."""
    digest = hashlib.sha256()
    for package in NUMERICS:
        for source in sorted((ROOT / package).rglob("*.py")):
            if ON_PAPER not in source.parents:
                digest.update(source.read_bytes())
    digest.update(json.dumps({name: importlib.metadata.version(name) for name in LIBRARIES}).encode())
    return digest.hexdigest()
