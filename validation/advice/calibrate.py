"""Measurement of the errors that cheap models claim: each beside fine boundary elements, over a sample of scenes.

Some scenes of a table are measured again, and a table takes the place of that of the package.
"""

import csv
import io
import math
import os
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, date, datetime
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from validation.advice import calibration
from validation.advice.calibration import CONDITIONS, TABLE, Key
from validation.advice.calibration_scenes import (
    Answers,
    CalibrationRun,
    CalibrationScene,
    Group,
    answers_in,
    answers_of,
    cheap_models,
    reference_answer,
)
from validation.advice.hierarchy import try_to_solve
from validation.advice.scene_model import SceneModel
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.engine.files import write_output
from validation.scenes.printable import printable
from validation.simulation.method import distance
from validation.simulation.model import Model, Target, all_models

COLUMNS = ("kind", "quantity", "number", "model", *CONDITIONS, "shape", "error", "reference", "code")
"""Of the table; code: digest of what a row was measured with, and of what gave the same numbers since."""
SAME, LEFT = 1e-3, 2e-4
"""Difference of an error measured again, relative, and of any error: the last bits of a solve are those of the machine,
and its residual leaves more than they do, of a stiffness about 1e-4."""
Row = dict[str, str]


def measure_errors(point: CalibrationScene) -> Outcome:
    """Distance of each cheap model from fine boundary elements, NaN where one has no answer.

    With all of the reference, see `reference_answer`.
    """
    reference = reference_answer(point)
    truth = reference["value"]
    return {**reference, "error": np.array([_error(model, point.target(), truth) for model in point.cheap])}


@dataclass(frozen=True)
class MeasuredAlone:
    """A model, a scene, and the stored answer of boundary elements, with the error that this leaves."""

    model: str
    point: CalibrationScene
    truth: tuple[float, ...]
    reference: float


def measure_alone(alone: MeasuredAlone) -> Outcome:
    """The error of one model, as `measure_errors` computes it, NaN for all other models."""
    point, truth = alone.point, np.array(alone.truth)
    errors = [_error(model, point.target(), truth) if model.name == alone.model else math.nan for model in point.cheap]
    return {"error": np.array(errors), "reference": np.array(alone.reference), "failed": np.array(0.0)}


def is_of_package(name: str) -> bool:
    """Whether a model of the package has this name."""
    return any(name == model.name for model in all_models())


def measured_alone(name: str, engine: Engine = SERIAL, path: Path = TABLE) -> bytes:
    """A table in which this model is measured anew, beside the answers that are stored; no other row changes.

    Raises ValueError for a model that no calibrated scene has.
    """
    stored = [
        MeasuredAlone(name, point, tuple(value.tolist()), float(reference))
        for group, answers in answers_in().items()
        for (point, value, _), reference in zip(answers.scenes(group), answers.reference, strict=True)
    ]
    problems = [problem for problem in stored if any(model.name == name for model in problem.point.cheap)]
    if not problems:
        measured_names = dict.fromkeys(model.name for problem in stored for model in problem.point.cheap)
        names = ", ".join(measured_names) or "none, since no answers of boundary elements are stored"
        raise ValueError(f"--model must be a Python file or one of {names}, got {printable(name)}")
    outcomes = engine.map(measure_alone, problems)
    measured = [
        row
        for problem, outcome in zip(problems, outcomes, strict=True)
        for row in rows_of_point(problem.point, outcome)
    ]
    rows = {_place(row): row for row in (*calibration.rows_of(path), *measured)}
    about = {**calibration.provenance(path), "measured alone": f"{name}, {today().isoformat()}"}
    return as_table(about, list(rows.values()))


def _place(row: Row) -> tuple[str, ...]:
    return tuple(row[name] for name in ("kind", "quantity", "number", "model"))


def _error(model: Model, target: Target, truth: NDArray[np.float64]) -> float:
    answer = try_to_solve(SceneModel(model, target, model.resolutions(target)[-1]))
    return math.nan if answer.failed or not np.isfinite(truth).all() else distance(answer.value, truth)


def table_in(folder: Path | None) -> Path:
    """Of a folder of a user's own; without one, that of the package."""
    return TABLE if folder is None else folder / TABLE.name


def measured_table(run: CalibrationRun, engine: Engine = SERIAL) -> tuple[bytes, dict[Group, Answers]]:
    """Measure all errors: the table of them, and the answers of boundary elements that they are measured beside."""
    points, about = run.points, provenance_of(run)
    outcomes = engine.map(measure_errors, points)
    rows = [row for point, outcome in zip(points, outcomes, strict=True) for row in rows_of_point(point, outcome)]
    return as_table(about, rows), answers_of(points, outcomes, about)


def measured_answers(run: CalibrationRun, engine: Engine = SERIAL) -> dict[Group, Answers]:
    """These answers, and no errors."""
    return answers_of(run.points, engine.map(reference_answer, run.points), provenance_of(run, "--answers"))


def provenance_of(run: CalibrationRun, *options: str) -> dict[str, str]:
    """Date and command."""
    counts = f"--punches {run.punches} --spheres {run.spheres} --rolling {run.rolling} --wheels {run.wheels}"
    command = " ".join(["mdr-validation calibrate", *options, counts, f"--seed {run.seed}"])
    return {"measured": today().isoformat(), "command": command}


def as_table(about: Mapping[str, str], rows: Sequence[Mapping[str, object]]) -> bytes:
    """about: lines of the provenance."""
    text = io.StringIO()
    text.writelines(f"# {name}: {value}\n" for name, value in about.items())
    writer = csv.DictWriter(text, COLUMNS)
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue().encode()


def rows_of_point(point: CalibrationScene, outcome: Outcome) -> list[Row]:
    """A row a model that has an answer; none where boundary elements have none."""
    if outcome["failed"]:
        return []
    target = point.target()
    kind, conditions = calibration.conditions_by_kind(target)
    named = {name: f"{conditions[name]:.5g}" for name in CONDITIONS if name in conditions}
    about = {"kind": kind, "quantity": point.quantity, "number": str(point.number), **named}
    return [
        {
            **about,
            "model": model.name,
            "shape": f"{model.shape(target):.5g}",
            "error": f"{error:.5g}",
            "reference": f"{float(outcome['reference']):.3g}",
            "code": calibration.code_behind(model, target),
        }
        for model, error in zip(point.cheap, outcome["error"], strict=True)
        if np.isfinite(error)
    ]


def calibration_lines(path: Path = TABLE) -> list[str]:
    """What the table holds: its age, its code, and how well claims cover scenes that are left out of it."""
    calibration.table.cache_clear()  # which may have been written since
    return [calibration_age(path), *errors_as_lines(calibration.table(path))]


def errors_as_lines(table: Mapping[Key, calibration.MeasuredErrors]) -> list[str]:
    """A line a model."""
    lines = [f"{'scene':10s}{'quantity':18s}{'model':20s}{'scenes':>7s}{'covered':>9s}{'claim/error':>13s}"]
    for (kind, quantity, model), measured in table.items():
        count, shown = len(measured.errors), f"{'—':>9s}{'—':>13s}"
        if count > 1:
            claimed = measured.factor * measured.left_out()
            covered, ratio = np.mean(measured.errors <= claimed), np.median(claimed / measured.errors)
            shown = f"{covered:9.0%}{ratio:13.2g}"
        lines.append(f"{kind:10s}{quantity:18s}{model:20s}{count:7d}{shown}")
    return lines


def calibration_age(path: Path = TABLE, target: Target | None = None) -> str:
    """Age of the table, what it has not, and the models that it was measured with whose code is another today.

    target: of a comparison, whose models alone are asked for.
    """
    about = calibration.provenance(path)
    if not about:
        return "errors of models: no calibration"
    one_of_each = CalibrationRun(punches=1, spheres=1, rolling=1, wheels=1).points
    models = {
        (calibration.kind_of(target_of_kind), target_of_kind.quantity, model.name): calibration.code_behind(
            model, target_of_kind
        )
        for target_of_kind in ([target] if target else [point.target() for point in one_of_each])
        for model in cheap_models(target_of_kind)
    }
    measured = calibration.table(path)
    without = [key for key in models if key not in measured]
    other = [key for key, code in models.items() if key in measured and measured[key].codes != {code}]
    missing = f"not in the table of the calibration: {_names(without, models, target)}" if without else ""
    if len(without) == len(models):
        return f"errors of models: {missing}"
    days = (today() - date.fromisoformat(about["measured"])).days
    checked, _, solves = about.get("checked", "").partition(", ")
    code = f"code that gives the same as today's, checked {checked} on {solves}" if checked else "today's code"
    code = f"other code than today's: {_names(other, models, target)}" if other else code
    age = f"calibrated {about['measured']}, {days} day{'s' * (days != 1)} ago, by {code}"
    return f"errors of models: {'; '.join(filter(None, (age, missing)))}"


def _names(keys: Sequence[Key], all_keys: Iterable[Key], target: Target | None) -> str:
    """Names of models; without a target with the scene in front, or that alone where it is all of its models."""
    if target:
        return "; ".join(model for *_, model in keys)
    partial = {key[:2] for key in all_keys if key not in keys}
    names = (f"{kind} {of}, {model}" if (kind, of) in partial else f"{kind} {of}" for kind, of, model in keys)
    return "; ".join(dict.fromkeys(names))


def today() -> date:
    return datetime.now(tz=UTC).date()


def check_calibration(
    scenes: int, engine: Engine = SERIAL, path: Path = TABLE, *, stamp: bool = False
) -> tuple[list[str], str]:
    """Measure so many scenes of each kind and quantity of a table again.

    stamp: whether today's code becomes that of all rows where these are the same; the table is left as it is
    otherwise. Returns the rows that differ, in words, and how many solves were measured.
    """
    rows, about = calibration.rows_of(path), calibration.provenance(path)
    if not rows:
        raise ValueError(f"no table of the calibration is in {printable(path)}")
    seed = int(about["command"].rsplit(" ", 1)[1])
    of_point, groups = defaultdict[CalibrationScene, list[Row]](list), defaultdict[str, list[CalibrationScene]](list)
    for row in rows:
        of_point[_point(row, seed)].append(row)
    for point in of_point:
        groups[f"{point.kind} {point.quantity}"].append(point)
    points = [point for group in groups.values() for point in _spread(group, scenes)]
    outcomes = engine.map(measure_errors, points)
    again = [rows_of_point(point, outcome) for point, outcome in zip(points, outcomes, strict=True)]
    differing = [
        line
        for point, rows_again in zip(points, again, strict=True)
        for line in _differences(of_point[point], rows_again)
    ]
    solves = f"{len(points)} of {sum(map(len, groups.values()))} solves"
    if stamp and not differing:
        checked = {**about, "checked": f"{today().isoformat()}, {solves}"}
        write_output(path, as_table(checked, [_with_code_of_today(row, seed) for row in rows]))
        calibration.table.cache_clear()
    return differing, solves


def _point(row: Row, seed: int) -> CalibrationScene:
    return CalibrationScene(kind=row["kind"], number=int(row["number"]), quantity=row["quantity"], seed=seed)


def _spread(points: list[CalibrationScene], count: int) -> list[CalibrationScene]:
    """From the first to the last."""
    return [points[i] for i in dict.fromkeys(np.linspace(0, len(points) - 1, count).astype(int).tolist())]


def _differences(rows: list[Row], again: list[Row]) -> list[str]:
    before, after = ({row["model"]: row for row in rows_of_model} for rows_of_model in (rows, again))
    name = f"{rows[0]['kind']} {rows[0]['number']}, {rows[0]['quantity']}"
    lines = [f"{name}, {model}: in the table or measured alone" for model in before.keys() ^ after.keys()]
    for model in before.keys() & after.keys():
        first, second = (float(rows_of_model[model]["error"]) for rows_of_model in (before, after))
        if abs(second - first) > max(SAME * first, LEFT):
            lines.append(f"{name}, {model}: an error of {first:g} in the table, of {second:g} today")
    return sorted(lines)


def _with_code_of_today(row: Row, seed: int) -> Row:
    point = _point(row, seed)
    (model,) = (cheap for cheap in point.cheap if cheap.name == row["model"])
    return {**row, "code": calibration.code_behind(model, point.target())}


def check_installable(run: CalibrationRun, path: Path = TABLE) -> None:
    """Raises ValueError, before anything is measured, where a run has fewer scenes than the table that is there."""
    if not (os.access(path, os.W_OK) and os.access(path.parent, os.W_OK)):
        raise ValueError(f"--install must be allowed to write {printable(path)}, the table of the package")
    scenes = {(row["kind"], row["quantity"], row["number"]) for row in calibration.rows_of(path)}
    _refuse_fewer(
        Counter(f"{point.kind} {point.quantity}" for point in run.points),
        Counter(f"{kind} {quantity}" for kind, quantity, _ in scenes),
    )


def install(measured: Path, path: Path = TABLE) -> None:
    """Raises ValueError where a model has fewer scenes in the table that was measured than in the one that is there."""
    new_counts, old_counts = (
        Counter(f"{row['kind']} {row['quantity']}, {row['model']}" for row in calibration.rows_of(table))
        for table in (measured, path)
    )
    _refuse_fewer(new_counts, old_counts)
    write_output(path, measured.read_bytes())
    calibration.table.cache_clear()


def _refuse_fewer(new_counts: Counter[str], old_counts: Counter[str]) -> None:
    for what, count in old_counts.items():
        if new_counts[what] < count:
            condition = f"as many scenes as the table of the package has, {count} of {what}"
            raise ValueError(f"--install must leave {condition}, got {new_counts[what]}")
