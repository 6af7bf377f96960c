"""Independent solves: their workers, and their results on disk.

A file of a result that is not exactly as it was written is ignored.
"""

import hashlib
import io
import json
import logging
import re
import time
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from concurrent.futures import CancelledError, as_completed
from contextlib import closing, contextmanager, nullcontext
from dataclasses import dataclass, fields, is_dataclass, replace
from pathlib import Path
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from validation.engine.files import is_plain, is_there, read_plain, write_whole
from validation.engine.progress import Part
from validation.engine.realisations import as_not_converged
from validation.engine.sources import version_behind, version_of_numerics
from validation.engine.workers import RESUME_NOTE, WorkerLostError, Workers

FloatArray = NDArray[np.float64]
Outcome = dict[str, FloatArray]
P = TypeVar("P")
K = TypeVar("K")

LOCAL = "local"
TIMEOUT = 10
"""Seconds that a scheduler and its first worker have to answer."""


@dataclass(frozen=True)
class Engine:
    """Runs independent solves on worker processes and stores their results.

    Parameters
    ----------
    workers : int, optional
        Processes on this machine, at least 1.
    store : Path or None, optional
        Folder of finished results; None stores nothing.
    progress : Part or None, optional
        Part of a run that is told of each solve.
    executor : str, optional
        "local", or "dask://HOST:PORT": a running scheduler, whose workers take the place of local ones.
    shared : Workers or None, optional
        Processes that several engines share; None for processes of its own in each call.
    timed_results : dict of Path to str, or None, optional
        Places and keys of a timed run, see `timed`.

    Raises
    ------
    ValueError
        If an argument is out of range. When problems are solved: if a file in the store is none of its own, or a
        scheduler does not answer or has no workers.
    ConnectionError, WorkerLostError, OSError
        When problems are solved: if the connection to a scheduler ends, a worker is killed, or a result cannot be
        stored; the message names its file.

    Notes
    -----
    A stored result is used again only if the solve, its problem, the code that both import and the libraries are the
    same; damaged and foreign files are computed anew. Each worker writes its result to disk as soon as it is computed;
    results of other machines are written here as they arrive. An interruption loses no finished result.

    Examples
    --------
    >>> import math
    >>> from validation.engine.engine import Engine
    >>> from validation.simulation.surface import RoughnessDraw, measure_profile
    >>> spectrum = mdr.SelfAffine(hurst=0.7, q_min=20 * np.pi, q_max=200 * np.pi, rms=1e-3)
    >>> draws = [RoughnessDraw(spectrum=spectrum, length=1.0, cells=512, seed=seed) for seed in range(3)]
    >>> outcomes = Engine(workers=1).map(measure_profile, draws)
    >>> [f"{math.sqrt(outcome['moments'][0]):.2g} m" for outcome in outcomes]
    ['0.001 m', '0.001 m', '0.001 m']
    """

    workers: int = 1
    store: Path | None = None
    progress: Part | None = None
    executor: str = LOCAL
    shared: Workers | None = None
    timed_results: dict[Path, str] | None = None
    """The places and keys of a timed run."""

    def __post_init__(self) -> None:
        if self.executor != LOCAL and not re.fullmatch(r"dask://[^/\s]+:\d+", self.executor):
            raise ValueError(f'executor must be "local" or dask://HOST:PORT, got {self.executor!r}')
        if self.workers < 1:
            raise ValueError(f"workers must be at least 1, got {self.workers}")

    def map(self, solve: Callable[[P], Outcome], problems: Sequence[P]) -> list[Outcome]:
        """solve(problem) for each problem, in their order, whatever the number of workers.

        solve: a module's own function; where part of it has not converged, its outcome says so by a number "failed";
        problems: frozen dataclasses of plain values, which `identity` has in full.
        """
        keys = [
            f"{solve.__module__}.{solve.__qualname__}({identity(problem)}) {version_behind(solve.__module__, problem)}"
            for problem in problems
        ]
        name = solve.__module__, solve.__name__
        places = [place_of_result(self.store, *name, key) if self.store else None for key in keys]
        if self.timed_results is not None:
            self.timed_results.update((place, key) for place, key in zip(places, keys, strict=True) if place)
        stored_outcomes = [load_result(place, key) if place else None for place, key in zip(places, keys, strict=True)]
        outcomes = {i: outcome for i, outcome in enumerate(stored_outcomes) if outcome is not None}
        failed = sum(map(_has_failures, outcomes.values()))
        progress = self.progress or Part()
        progress.begin(solve.__name__.replace("_", " "), total=len(problems), stored=len(outcomes), failed=failed)
        tasks = [
            _PendingSolve(solve, problem, i, places[i], keys[i])
            for i, problem in enumerate(problems)
            if i not in outcomes
        ]
        # an exception in this block ends the workers at once
        with closing(self._results(tasks)) as results:
            for i, outcome, seconds in results:
                outcomes[i] = outcome
                progress.step(_has_failures(outcome), seconds)
        return [outcomes[i] for i in range(len(problems))]

    def map_groups(self, solve: Callable[[P], Outcome], groups: Mapping[K, Sequence[P]]) -> dict[K, list[Outcome]]:
        """`map` over the problems of all groups at once: the outcomes of each group, by its key."""
        outcomes = iter(self.map(solve, [problem for group in groups.values() for problem in group]))
        return {key: [next(outcomes) for _ in group] for key, group in groups.items()}

    @contextmanager
    def timed(self) -> Iterator["Engine"]:
        """An engine that solves one problem at a time, so that no other solve disturbs its times.

        A finished run forgets its results, so that the next run measures anew; an interrupted one keeps them.
        """
        measured: dict[Path, str] = {}
        yield replace(self, workers=1, executor=LOCAL, shared=None, timed_results=measured)
        forget_results(measured)

    def _results(self, tasks: Sequence["_PendingSolve[P]"]) -> Generator[tuple[int, Outcome, float], None, None]:
        """Index, outcome and seconds of each task, in the order in which they finish."""
        if not tasks:
            return
        if self.executor == LOCAL:
            with nullcontext(self.shared) if self.shared else Workers(self.workers) as workers:
                yield from _results_of_workers(workers, tasks)
            return
        by_index = {task.index: task for task in tasks}
        with _client(self.executor) as (client, as_arrived):
            submitted = [
                client.submit(_solve, t.solve, t.problem, t.index, version_of_numerics(), pure=False) for t in tasks
            ]
            for future in as_arrived(submitted, loop=client.loop):
                i, outcome, seconds = future.result()
                by_index[i].save(outcome)
                yield i, outcome, seconds


SERIAL = Engine()


def _results_of_workers(workers: Workers, tasks: Sequence["_PendingSolve[P]"]) -> Iterator[tuple[int, Outcome, float]]:
    """Results in the order in which workers finish; an error cancels the tasks of this call that still wait."""
    if workers.count == 1:
        yield from (_solve_and_save(task, version_of_numerics()) for task in tasks)
        return
    futures = [workers.submit(_solve_and_save, task, version_of_numerics()) for task in tasks]
    try:
        yield from (future.result() for future in as_completed(futures))
    finally:
        for future in futures:
            future.cancel()


def identity(value: object) -> str:
    """All digits of all that determines a problem, whatever its `repr` shows: of a dataclass each field.

    A field of ``repr=False`` is left out, and one whose metadata have "later" where it is None, so that keys of what is
    stored stay when it is added.
    """
    if is_dataclass(value) and not isinstance(value, type):
        cells = [(each, getattr(value, each.name)) for each in fields(value) if each.repr]
        kept = [(each.name, cell) for each, cell in cells if cell is not None or "later" not in each.metadata]
        return f"{type(value).__qualname__}({', '.join(f'{name}={identity(cell)}' for name, cell in kept)})"
    if isinstance(value, tuple) and (names := getattr(value, "_fields", ())):
        named = (f"{name}={identity(cell)}" for name, cell in zip(names, value, strict=True))
        return f"{type(value).__name__}({', '.join(named)})"
    if type(value) is tuple:
        return f"({', '.join(map(identity, value))}{',' * (len(value) == 1)})"
    if type(value) is list:
        return f"[{', '.join(map(identity, value))}]"
    if type(value) is dict:
        return "{" + ", ".join(f"{identity(key)}: {identity(cell)}" for key, cell in value.items()) + "}"
    return repr(value)


@dataclass(frozen=True)
class _PendingSolve(Generic[P]):
    """A problem, its index, and where its result belongs."""

    solve: Callable[[P], Outcome]
    problem: P
    index: int
    place: Path | None
    key: str

    def save(self, outcome: Outcome) -> None:
        if self.place is not None:
            save_result(self.place, self.key, outcome)


def _solve_and_save(task: _PendingSolve[P], numerics: str) -> tuple[int, Outcome, float]:
    """`_solve`, whose outcome is on disk before it is returned."""
    i, outcome, seconds = _solve(task.solve, task.problem, task.index, numerics)
    task.save(outcome)
    return i, outcome, seconds


def _solve(solve: Callable[[P], Outcome], problem: P, i: int, numerics: str) -> tuple[int, Outcome, float]:
    """Index, outcome and seconds of a solve; ValueError on a worker whose numerics are not those of the caller."""
    if version_of_numerics() != numerics:
        raise ValueError("a worker has another version of the numerics or of their libraries: it needs the same")
    began = time.perf_counter()
    try:
        with as_not_converged():
            return i, solve(problem), time.perf_counter() - began
    except Exception as error:
        error.add_note(f"in {solve.__name__}({problem!r})")
        raise


def _has_failures(outcome: Outcome) -> bool:
    """Whether any entry of the number "failed" is not zero; an outcome without that number has converged."""
    return bool(outcome.get("failed", np.zeros(1)).any())


@contextmanager
def _client(executor: str) -> Iterator[tuple[Any, Any]]:
    """A connection to a scheduler that has a worker, and the iterator over its results as they arrive."""
    try:
        from distributed import Client, KilledWorker, as_completed
        from distributed.comm.core import CommClosedError
    except ImportError:
        raise ValueError(f"executor {executor} needs the extra dask: pip install 'mdr-validation[dask]'") from None
    address = executor.replace("dask://", "tcp://")
    try:
        client = Client(  # type: ignore[no-untyped-call]
            address, timeout=TIMEOUT, set_as_default=False
        )
    except (OSError, ValueError) as error:
        raise ValueError(f"executor must be a running scheduler, got {executor}: {error}") from None
    logger = logging.getLogger("distributed.client")
    level = logger.level
    # one sentence below stands for its log with tracebacks
    logger.setLevel(logging.CRITICAL)
    try:
        with client:
            try:
                client.wait_for_workers(1, timeout=TIMEOUT)
            except TimeoutError:
                raise ValueError(f"executor must have workers, got {executor} without any") from None
            yield client, as_completed
    except (CancelledError, CommClosedError):
        raise ConnectionError(f"the scheduler at {executor} is gone; {RESUME_NOTE}") from None
    except KilledWorker:
        raise WorkerLostError(f"one solve has killed every worker of {executor} that tried it; {RESUME_NOTE}") from None
    finally:
        logger.setLevel(level)


FORMAT = 2
"""Format 1 had no list of its arrays."""
LABEL = "stored"
"""The entry of an archive that holds its key and lists its arrays."""
SEAL = hashlib.sha256().digest_size


def place_of_result(folder: Path, module: str, solve: str, key: str) -> Path:
    """Where a result belongs. module, solve: names for its file; key: everything that determines it."""
    return folder / f"{module.rpartition('.')[2]}-{solve}-{hashlib.sha256(key.encode()).hexdigest()[:24]}.npz"


def load_result(path: Path, key: str) -> Outcome | None:
    """The result that was stored under this key, or None where no intact one is there.

    Raises ValueError for a link or a folder in its place.
    """
    if is_there(path) and not is_plain(path):
        raise ValueError(f"a stored result must be a plain file, got {path}: move that away")
    try:
        contents = read_plain(path)
        archive, seal = contents[:-SEAL], contents[-SEAL:]
        if hashlib.sha256(archive).digest() != seal:
            return None
        with np.load(io.BytesIO(archive), allow_pickle=False) as entries:
            arrays = {name: entries[name] for name in entries.files}
        label = json.loads(str(arrays.pop(LABEL)))
    # a valid seal may have been put behind any bytes
    except Exception:
        return None
    return arrays if label == {"format": FORMAT, "key": key, "arrays": _array_types(arrays)} else None


def save_result(path: Path, key: str, outcome: Outcome) -> None:
    """Store a result, whole or not at all. Raises OSError, which names the place."""
    arrays = {name: np.asarray(value) for name, value in outcome.items()}
    label = json.dumps({"format": FORMAT, "key": key, "arrays": _array_types(arrays)}, sort_keys=True)
    archive = io.BytesIO()
    np.savez(archive, **{LABEL: np.array(label), **arrays})  # type: ignore[arg-type]  # stubs take a name for a flag
    contents = archive.getvalue()
    # readers of archives ignore a seal at the end
    write_whole(path, contents + hashlib.sha256(contents).digest())


def forget_results(stored: Mapping[Path, str]) -> None:
    """Remove the results at these places, each by its key, and nothing else that is there."""
    for path, key in stored.items():
        if is_plain(path) and load_result(path, key) is not None:
            path.unlink()


def _array_types(arrays: Outcome) -> dict[str, list[object]]:
    """Data type and shape of each array, as the label of an archive has them."""
    return {name: [array.dtype.str, list(array.shape)] for name, array in arrays.items()}
