"""Judge a model of somebody's own: `validation.judge`, and what it returns."""

import math
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from pkgutil import resolve_name
from typing import TYPE_CHECKING

from validation.advice.tolerance import Tolerance, tolerance_of
from validation.analysis.contents import as_csv, as_json
from validation.analysis.evidence import Table, table_of
from validation.judging.judgement import (
    DIFFER,
    FAILED,
    REFUSED,
    Conditions,
    Enough,
    JudgedPoint,
    enough,
    not_compared,
    trusted,
)
from validation.judging.kinds.diagnosis import Remark, remarks
from validation.judging.kinds.judge import JUDGES, points_of
from validation.judging.kinds.own import ErrorOfCall, costs_of
from validation.judging.replies import raised
from validation.judging.words import solver_lines, summary_lines
from validation.judging.worker import Called, visited
from validation.report.folder import JUDGEMENT, Folder
from validation.scenes.printable import printable

if TYPE_CHECKING:
    from validation.judging.solvers.judged import SolverTime

OF_SOLVER = "validation.judging.solvers.judged:judged"
"""Of a contact solver; it imports all solvers."""
BROKEN = "mdr-validation could not go on, which is its own error"
RETURNED = "a process that it forked came back from the function: its answers were left out"
COLUMNS = ("value", "reference", "difference", "error", "unit", "verdict", "reason")
NAMES = {"start": "from", "stop": "to"}
"""Of a range in JSON: words that Python keeps for itself."""


@dataclass(frozen=True, eq=False)
class Judgement:
    """What `judge` found of one model.

    Attributes
    ----------
    model, kind : str
        Name and decorator of the function.
    tolerance : Tolerance
        How near is near.
    verdicts : tuple
        A point each: quantity, where, value, reference, difference, error, verdict, reason.
    seconds : float
        That the judgement took.
    times : tuple
        Of a solver: cells on a side, its seconds, and those of `bem3d`, which are neither right nor wrong.
    costs : tuple
        Error against seconds of one call: of the model, and of the suite's own of its kind.

    Examples
    --------
    >>> @validation.stiffness_model("flat punch")
    ... def flat(side, modulus):
    ...     return 1.1523 * modulus * side
    >>> found = validation.judge(flat)
    >>> found.verdicts[0].verdict
    'differ'
    """

    model: str
    kind: str
    tolerance: Tolerance
    verdicts: tuple[JudgedPoint, ...]
    seconds: float
    times: "tuple[SolverTime, ...]" = ()
    costs: tuple[ErrorOfCall, ...] = ()

    @property
    def enough(self) -> list[Enough]:
        """Ranges of one verdict, along the number that decides."""
        return enough(self.verdicts)

    @property
    def remarks(self) -> list[Remark]:
        """What its points show of a reduced model as a whole, as a factor that is one everywhere."""
        return remarks(self.verdicts) if self.kind in JUDGES else []

    @property
    def answered(self) -> bool:
        """Whether there is any number to be judged."""
        return any(math.isfinite(point.difference) for point in self.verdicts)

    @property
    def wrong(self) -> bool:
        """Of a solver: whether it differs or fails where that decides."""
        return any(point.decides and point.verdict in (DIFFER, FAILED, REFUSED) for point in self.verdicts)

    def summary(self) -> str:
        """Where it is enough, the worst points and what they share, and a paragraph for a paper."""
        if self.kind == "contact_solver":
            lines = solver_lines(self.model, self.verdicts, self.times, self.seconds)
        else:
            lines = summary_lines(self)
        return printable("\n".join(lines), lines=True)

    def as_dict(self) -> dict[str, object]:
        """Of JSON: None for what is no number."""
        return {
            "model": self.model,
            "kind": self.kind,
            "tolerance": self.tolerance.relative,
            "verdicts": [_as_dict(point) for point in self.verdicts],
            "enough": [_as_dict(some) for some in self.enough],
            "remarks": [remark._asdict() for remark in self.remarks],
            "seconds": round(self.seconds, 3),
            **({"times": [time._asdict() for time in self.times]} if self.times else {}),
        }

    def save(self, folder: str | Path) -> None:
        """Write judgement.json, verdicts.csv, summary.txt and judgement.svg into a folder of its own, which is made.

        Seconds that the figure shows are in costs.csv: of calls with the error, of a solver by the cells on a side.
        manifest.json lists the files, by which an earlier judgement is known and replaced.

        Raises
        ------
        TypeError
            For what is no path.
        ValueError
            For a folder with other files, which are not replaced.
        """
        if not isinstance(folder, str | Path):
            raise TypeError(f"folder must be a path, got {folder!r}")
        with Folder(Path(folder), kind=JUDGEMENT, option="folder") as place:
            place.replace(self.files())

    def files(self) -> dict[str, bytes]:
        """What `save` writes, by name."""
        from validation.judging.figure import figure_of  # which takes half a second to import

        files = {
            "judgement.json": as_json(self.as_dict()),
            "verdicts.csv": points_as_csv([self]),
            "summary.txt": f"{self.summary()}\n".encode(),
            "judgement.svg": figure_of([self], "svg"),
        }
        if costs := [one._asdict() for one in self.costs or self.times]:
            files["costs.csv"] = as_csv(table_of("costs", costs))
        return files


def judge(model: object, tolerance: float | str = 0.1) -> Judgement:
    """Judge a model: where it is enough, with error bars, beside references that come with this package.

    Parameters
    ----------
    model : callable or path
        A function with one of the decorators, as `stiffness_model`; or a file that offers one, which is run as a
        program, in a process of its own.
    tolerance : float or str, optional
        A ratio, or "10 %" or "1 dB". Levels are judged by 20 lg(1 + ratio) dB.

    Returns
    -------
    Judgement
        Verdicts, ranges, and their summary.

    Raises
    ------
    TypeError, ValueError, OSError
        For a function without a decorator, a file that cannot be read or offers more than one model, a tolerance that
        is none.

    Examples
    --------
    >>> @validation.stiffness_model("in series")
    ... def series(load, side, modulus, roughness):
    ...     return 1 / (0.49 * roughness.rms / load + 1 / (1.1523 * modulus * side))
    >>> found = validation.judge(series, "10 %")
    >>> [some.verdict for some in found.enough if some.where == {"H": 0.7} and some.stop == 10]
    ['agree']
    """
    with visited(model) as callers:
        if len(callers) > 1:
            raise ValueError(f"model must be one, got {', '.join(repr(one.name) for one in callers)}: judge them apart")
        return judged(callers[0], tolerance_of(tolerance))


def judged(model: Called, tolerance: Tolerance) -> Judgement:
    """Of one function, here or in another process."""
    begin = time.perf_counter()
    everywhere: Conditions = {} if model.kind in JUDGES else {"problem": "any"}
    points: list[JudgedPoint] = []
    times: Sequence[SolverTime] = ()
    costs: Sequence[ErrorOfCall] = ()
    try:
        if model.kind in JUDGES:
            for point in points_of(model, tolerance.relative):
                points.append(point)
            costs = costs_of(model, points)
        else:
            points, times = resolve_name(OF_SOLVER)(model)
    except Exception as error:
        # one model of a file takes nothing from the others, nor from what was found of it
        points.append(not_compared("judging", everywhere, FAILED, f"{BROKEN}: {raised(error)}"))
    if model.printed:
        points.append(not_compared("printing", everywhere, FAILED, f"printed {model.printed!r}"))
    if model.forked:
        points.append(not_compared("forking", everywhere, FAILED, RETURNED))
    if model.changed:
        reason = f"{model.changed} was changed while it was judged: judge it again"
        points.append(not_compared("file", everywhere, FAILED, reason, decides=model.kind == "contact_solver"))
    seconds = time.perf_counter() - begin
    return Judgement(model.name, model.kind, tolerance, tuple(trusted(points)), seconds, tuple(times), tuple(costs))


def points_as_csv(judgements: Sequence[Judgement]) -> bytes:
    """A row a point of each; a condition that a point does not have is left empty."""
    points = [(one.model, point) for one in judgements for point in one.verdicts]
    places = dict.fromkeys(name for _, point in points for name in point.where)
    columns: dict[str, list[object]] = {"model": [model for model, _ in points]}
    columns |= {"quantity": [point.quantity for _, point in points]}
    columns |= {name: [point.where.get(name, math.nan) for _, point in points] for name in places}
    columns |= {name: [getattr(point, name) for _, point in points] for name in COLUMNS}
    return as_csv(Table("verdicts", columns))


def _as_dict(part: JudgedPoint | Enough) -> dict[str, object]:
    known = {name: None if isinstance(v, float) and not math.isfinite(v) else v for name, v in asdict(part).items()}
    return {NAMES.get(name, name): value for name, value in known.items() if name != "decides"}
