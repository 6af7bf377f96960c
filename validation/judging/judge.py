"""Judge a user's model: `validation.judge`, and what it returns."""

import math
import time
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from pkgutil import resolve_name
from typing import TYPE_CHECKING, Any, TypeVar

from validation.advice.tolerance import Tolerance, tolerance_of
from validation.analysis.contents import as_csv, as_html, as_json, condition_key, finite_or_none
from validation.analysis.escapes import one_line, printable, shortened_text
from validation.analysis.evidence import Verdict, table_of, where_text
from validation.analysis.number_text import interval_text
from validation.judging.judgement import (
    WITHOUT_NUMBER,
    Conditions,
    JudgedNumber,
    JudgedRange,
    SolverTime,
    counts_of,
    missing_number,
    ranges_of,
    trusted_numbers,
)
from validation.judging.judgement_text import solver_lines, summary_lines
from validation.judging.kinds.diagnosis import Remark, remarks
from validation.judging.kinds.judge import JUDGES, points_of
from validation.judging.kinds.own import ErrorOfCall, costs_of
from validation.judging.replies import raised
from validation.judging.worker import Called, visited
from validation.report.folder import JUDGEMENT, Folder

if TYPE_CHECKING:
    from matplotlib.axes import Axes

OF_SOLVER = "validation.judging.solvers.checks:judged"
"""Of a contact solver; it imports all solvers."""
BROKEN = "mdr-validation could not go on, which is its own error"
RETURNED = "a process that it forked came back from the function: its answers were left out"
SCHEMA = 2
"""Of the JSON; 1 had the verdicts agree, differ, undecided, refused and failed, and no key of its own."""
VALUES = ("value", "reference", "difference", "error", "unit")
"""Numbers of a row of CSV and JSON, and the unit of the difference."""
CSV_COLUMNS = (*VALUES, "outcome", "reason")
Row = TypeVar("Row", JudgedNumber, JudgedRange)


@dataclass(frozen=True, eq=False)
class Judgement:
    """What `judge` found of one model.

    Attributes
    ----------
    model, kind : str
        Name and decorator of the function.
    tolerance : Tolerance
        Of a ratio; levels have 20 lg(1 + ratio) dB.
    numbers : tuple of JudgedNumber
        A row a number: quantity, where, value, reference, difference, error, verdict, reason.
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
    >>> judgement = validation.judge(flat)
    >>> print(judgement.numbers[0].verdict)
    outside tolerance
    """

    model: str
    kind: str
    tolerance: Tolerance
    numbers: tuple[JudgedNumber, ...]
    seconds: float
    times: tuple[SolverTime, ...] = ()
    costs: tuple[ErrorOfCall, ...] = ()

    def __repr__(self) -> str:
        return one_line(f"Judgement({shortened_text(self.model)!r}, {self.tolerance}: {self._counts})")

    def _repr_html_(self) -> str:
        """The counts of verdicts, and a row a range, for a notebook."""
        parts = self.ranges
        columns: dict[str, Sequence[object]] = {
            "quantity": [part.quantity for part in parts],
            "conditions": [where_text(part.where) for part in parts],
            "range": [f"{part.along} = {interval_text(part.start, part.stop)}" if part.along else "" for part in parts],
            "verdict": [part.verdict for part in parts],
        }
        return as_html(f"{self.model}, tolerance {self.tolerance}: {self._counts}", columns)

    @property
    def _counts(self) -> str:
        """How many numbers have each verdict."""
        return ", ".join(f"{count} {verdict}" for verdict, count in counts_of(self.numbers).items()) or "no numbers"

    @property
    def ranges(self) -> list[JudgedRange]:
        """Ranges of equal verdict, each along the condition that has most values."""
        return ranges_of(self.numbers)

    @property
    def verdicts(self) -> tuple[JudgedNumber, ...]:
        """The column of numbers with the verdicts of version 0.3 (agree, differ, ...). Goes after one release."""
        _warn_of_earlier_name("verdicts", "numbers")
        return tuple(_with_earlier_verdict(number) for number in self.numbers)

    @property
    def enough(self) -> list[JudgedRange]:
        """`ranges` with the verdicts of version 0.3. Goes after one release."""
        _warn_of_earlier_name("enough", "ranges")
        return [_with_earlier_verdict(part) for part in self.ranges]

    @property
    def remarks(self) -> list[Remark]:
        """Of a reduced model: errors that its numbers have in common, as a factor everywhere."""
        return remarks(self.numbers) if self.kind in JUDGES else []

    @property
    def answered(self) -> bool:
        """Whether any row has a number."""
        return any(math.isfinite(number.difference) for number in self.numbers)

    @property
    def wrong(self) -> bool:
        """Of a solver: whether a number that decides is outside of the tolerance, or missing."""
        lost = (Verdict.OUTSIDE, *WITHOUT_NUMBER)
        return any(number.decides and number.verdict in lost for number in self.numbers)

    def table(self) -> list[dict[str, object]]:
        """The numbers as rows: a flat dict each.

        Returns
        -------
        list of dict
            Keys model, kind, quantity; the conditions, by their names in CSV, as normalised_load; value, reference,
            difference, error (half-width of 95 %), error_grid (its part by discretisation), tolerance, and the unit of
            these four; outcome, reason. NaN where there is no number.

        Examples
        --------
        >>> @validation.stiffness_model("flat punch")
        ... def flat(side, modulus):
        ...     return 1.1523 * modulus * side
        >>> row = validation.judge(flat).table()[0]
        >>> row["model"], row["quantity"], row["outcome"]
        ('flat punch', 'mean stiffness', 'outside tolerance')
        """
        front = {"model": self.model, "kind": self.kind}
        columns = (*VALUES, "tolerance", "outcome", "reason")
        return [
            front
            | {"quantity": str(number.quantity), **number.conditions}
            | {name: getattr(number, name) for name in columns}
            | {"error_grid": number.grid}
            for number in self.numbers
        ]

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw the deviations of the first quantity with their intervals and the tolerance; of a solver its seconds.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Axes to draw on, by default those of a new figure.

        Returns
        -------
        matplotlib.axes.Axes
            The axes. `save` draws all quantities.

        Raises
        ------
        TypeError
            If ``ax`` is no Axes.
        """
        from validation.judging.figure import plot  # which takes half a second to import

        return plot(self, ax)

    def summary(self) -> str:
        """Ranges of equal verdict, the largest deviations and their common condition, and a paragraph for a paper."""
        if self.kind == "contact_solver":
            lines = solver_lines(self.model, self.numbers, self.times, self.seconds)
        else:
            lines = summary_lines(self)
        return printable("\n".join(lines), lines=True)

    def as_dict(self) -> dict[str, object]:
        """The contents of judgement.json, schema 2, where a number that is not finite is None.

        Rows under "numbers" and "ranges" have the names of `JudgedNumber` and `JudgedRange`, `conditions` those of
        CSV. For one release there are also "verdicts", with `verdict` and `where` as in schema 1, and "enough", and a
        range has `from` and `to`.
        """
        return {
            "schema_version": SCHEMA,
            "model": self.model,
            "kind": self.kind,
            "tolerance": self.tolerance.relative,
            "numbers": [_in_json(row_of_number(number)) for number in self.numbers],
            "verdicts": [_in_json(_row(number)) for number in self.numbers],
            "ranges": [_in_json(_range_row(part)) for part in self.ranges],
            "enough": [_in_json(_range_row(part, schema=1)) for part in self.ranges],
            "remarks": [remark._asdict() for remark in self.remarks],
            "seconds": round(self.seconds, 3),
            **({"times": [time._asdict() for time in self.times]} if self.times else {}),
        }

    def save(self, folder: str | Path) -> None:
        """Write judgement.json, verdicts.csv, summary.txt and judgement.svg into a folder of its own, which is made.

        Seconds that the figure shows are in costs.csv: of calls with the error, of a solver by the cells on a side.
        manifest.json lists the files: an earlier judgement is recognised by it, and replaced.

        Raises
        ------
        TypeError
            For a folder that is no path.
        ValueError
            For a folder with other files, which are not replaced.
        """
        if not isinstance(folder, str | Path):
            raise TypeError(f"folder must be a path, got {folder!r}")
        with Folder(Path(folder), kind=JUDGEMENT, option="folder") as target:
            target.replace(self.files())

    def files(self) -> dict[str, bytes]:
        """The contents of what `save` writes, by name."""
        from validation.judging.figure import figure_of  # which takes half a second to import

        files = {
            "judgement.json": as_json(self.as_dict()),
            "verdicts.csv": numbers_as_csv([self]),
            "summary.txt": f"{self.summary()}\n".encode(),
            "judgement.svg": figure_of([self], "svg"),
        }
        if costs := [cost._asdict() for cost in self.costs or self.times]:
            files["costs.csv"] = as_csv(table_of("costs", costs))
        return files


def judge(model: object, tolerance: float | str = 0.1, *, only: str | None = None) -> Judgement:
    """Judge a model: where it is accurate enough, with error bars, by references that come with this package.

    Parameters
    ----------
    model : callable or path
        A function with one of the decorators, as `stiffness_model`; or a file that offers one, which is run as a
        program, in a process of its own.
    tolerance : float or str, optional
        A ratio, or "10 %" or "1 dB". Levels are judged by 20 lg(1 + ratio) dB.
    only : str, optional
        Name of the model of a file that offers several.

    Returns
    -------
    Judgement
        Numbers with their verdicts, ranges of equal verdict, and their summary.

    Raises
    ------
    TypeError, ValueError, OSError
        For a function without a decorator, a file that cannot be read, offers more than one model or none of the name
        ``only``, a tolerance that is none.

    Examples
    --------
    >>> @validation.stiffness_model("in series")
    ... def series(load, side, modulus, roughness):
    ...     return 1 / (0.49 * roughness.rms / load + 1 / (1.1523 * modulus * side))
    >>> judgement = validation.judge(series, "10 %")
    >>> [str(part.verdict) for part in judgement.ranges if part.where == {"H": 0.7} and part.stop == 10]
    ['within tolerance']
    """
    with visited(model) as callers:
        chosen = callers_named(callers, only, option="only")
        if len(chosen) > 1:
            names = ", ".join(repr(caller.name) for caller in chosen)
            raise ValueError(f"model must be one, got {names}: choose by only={chosen[0].name!r}, or judge them apart")
        return judged(chosen[0], tolerance_of(tolerance))


def callers_named(callers: Sequence[Called], name: str | None, *, option: str) -> list[Called]:
    """Those of a name, or all for None. Raises ValueError where none has it. option: by which it is chosen."""
    chosen = [caller for caller in callers if name in (None, caller.name)]
    if not chosen:
        raise ValueError(f"{option} must be one of {', '.join(caller.name for caller in callers)}, got {name}")
    return chosen


def judged(model: Called, tolerance: Tolerance) -> Judgement:
    """The judgement of one function, of this process or of another one."""
    begin = time.perf_counter()
    where: Conditions = {} if model.kind in JUDGES else {"problem": "any"}
    numbers: list[JudgedNumber] = []
    times: Sequence[SolverTime] = ()
    costs: Sequence[ErrorOfCall] = ()

    def add_failure(quantity: str, reason: str, decides: bool = False) -> None:
        numbers.append(missing_number(quantity, where, Verdict.NO_RESULT, reason, decides=decides))

    try:
        if model.kind in JUDGES:
            for number in points_of(model, tolerance.relative):
                numbers.append(number)
            costs = costs_of(model, numbers)
        else:
            numbers, times = resolve_name(OF_SOLVER)(model)
    except Exception as error:
        # one model of a file takes nothing from the others, nor from its own numbers so far
        add_failure("judging", f"{BROKEN}: {raised(error)}")
    if model.printed:
        add_failure("printing", f"printed {model.printed!r}")
    if model.forked:
        add_failure("forking", RETURNED)
    if model.changed:
        reason = f"{model.changed} was changed while it was judged: judge it again"
        add_failure("file", reason, decides=model.kind == "contact_solver")
    seconds = time.perf_counter() - begin
    numbers = trusted_numbers(numbers)
    return Judgement(model.name, model.kind, tolerance, tuple(numbers), seconds, tuple(times), tuple(costs))


def numbers_as_csv(judgements: Sequence[Judgement]) -> bytes:
    """A row a number of each model; a condition that a number does not have is left empty."""
    rows = [
        {"model": judgement.model, "quantity": row["quantity"], **row["conditions"]} | {n: row[n] for n in CSV_COLUMNS}
        for judgement in judgements
        for row in map(_row, judgement.numbers)
    ]
    table = table_of("verdicts", rows)
    names = sorted(table.columns, key=CSV_COLUMNS.__contains__)
    return as_csv(replace(table, columns={name: table.columns[name] for name in names}))


def _row(number: JudgedNumber) -> dict[str, Any]:
    """Of the table of numbers in CSV and JSON; the latter has the keys `where` and `verdict` of schema 1 as well."""
    return {
        "quantity": number.quantity,
        "where": dict(number.where),
        "conditions": number.conditions,
        **{name: getattr(number, name) for name in VALUES},
        "verdict": number.verdict.earlier,
        "outcome": number.outcome,
        "reason": number.reason,
    }


def row_of_number(number: JudgedNumber) -> dict[str, Any]:
    """Of JSON, by the names that a `JudgedNumber` has."""
    return {name: getattr(number, name) for name in ("quantity", "conditions", *CSV_COLUMNS, "tolerance", "decides")}


def _range_row(part: JudgedRange, *, schema: int = SCHEMA) -> dict[str, Any]:
    """Of the ranges in JSON."""
    if schema == 1:
        where, verdict = {"where": dict(part.where), "along": part.along}, {"verdict": part.verdict.earlier}
    else:
        where = {"conditions": part.conditions, "along": condition_key(part.along)}
        verdict = {"outcome": part.outcome}
    ends = {"start": part.start, "stop": part.stop} if schema > 1 else {}
    return {"quantity": part.quantity, **where, **ends, "from": part.start, "to": part.stop, **verdict}


def _in_json(row: Mapping[str, Any]) -> dict[str, Any]:
    return {name: finite_or_none(cell) if isinstance(cell, float) else cell for name, cell in row.items()}


def _with_earlier_verdict(row: Row) -> Row:
    """Scripts of version 0.3 compare the verdict with a text."""
    earlier: Any = row.verdict.earlier
    return replace(row, verdict=earlier)


def _warn_of_earlier_name(earlier: str, name: str) -> None:
    """To the line that has used the property."""
    message = f"Judgement.{earlier} is Judgement.{name} now, whose verdicts are {', '.join(Verdict)}"
    warnings.warn(message, FutureWarning, stacklevel=3)
