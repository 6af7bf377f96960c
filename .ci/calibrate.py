"""Measure the errors that cheap models of the package claim, each relative to fine boundary elements.

python .ci/calibrate.py [--punches N ...] [--seed S]  table of errors and answers of boundary elements, in a folder
python .ci/calibrate.py --model NAME                  one model alone, relative to the stored answers
python .ci/calibrate.py --answers                     the answers alone; those of kinds of which no scene is asked stay
python .ci/calibrate.py --check N                     N scenes of each kind once more; exit status 1 where one differs
python .ci/calibrate.py --references FOLDER           references of `judge`, as `mdr-validation calibrate` has made them

--install puts what was made in the place of that of the package, if it has as many scenes of all kinds; with --check it
gives the rows today's code where all are the same. A run goes on in its folder where it was interrupted.
"""

import argparse
import csv
import io
import json
import os
import sys
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import fields
from pathlib import Path

from validation.__main__ import _Parser, main
from validation.engine.workers import ONE_THREAD

# before numpy is loaded: the last bits of sums depend on the threads of BLAS, and workers have one
os.environ.update(ONE_THREAD | os.environ)

import numpy as np

from validation.advice import calibration
from validation.advice.calibrate import calibration_lines, table_in, today
from validation.advice.calibration import CONDITIONS, TABLE
from validation.advice.calibration_scenes import (
    ABOUT,
    ANSWERS,
    Answers,
    CalibrationRun,
    CalibrationScene,
    Group,
    answers_in,
)
from validation.advice.calibration_solves import MeasuredAlone, measure_alone, measure_errors, reference_answer
from validation.analysis.escapes import printable
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.engine.files import write_output, write_whole
from validation.engine.progress import progress_of
from validation.report.commands.arguments import Exit, add_options, add_workers, at_least, check_places, not_beside
from validation.report.folder import CALIBRATION, MANIFEST, REALISATIONS, Folder
from validation.simulation.model import GridModel, models_serving

OUT = Path("calibration")
"""Where a table is measured, below the working folder."""
COUNTED = {
    "punches": "rough punches",
    "spheres": "rough spheres",
    "rolling": "rolling wheels",
    "wheels": "dynamic wheels",
}
COLUMNS = ("kind", "quantity", "number", "model", *CONDITIONS, "shape", "error", "reference", "code")
"""Of the table; code: digest of what a row was measured with, and of what gave the same numbers since."""
SAME, LEFT = 1e-3, 2e-4
"""Difference of an error measured again, relative, and of any error: the last bits of a solve are those of the machine,
and its residual leaves more than they do, of a stiffness about 1e-4."""
Row = dict[str, str]


# The table


def measured_table(run: CalibrationRun, engine: Engine = SERIAL) -> tuple[bytes, dict[Group, Answers]]:
    """Measure all errors: the table of them, and the answers of boundary elements that they are relative to."""
    points, about = run.points, provenance_of(run)
    outcomes = engine.map(measure_errors, points)
    rows = [row for point, outcome in zip(points, outcomes, strict=True) for row in rows_of_point(point, outcome)]
    return as_table(about, rows), answers_of(points, outcomes, about)


def measured_alone(name: str, engine: Engine = SERIAL, path: Path = TABLE) -> bytes:
    """A table in which this model is measured anew, relative to the stored answers; no other row changes.

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
        raise ValueError(f"--model must be one of {names}, got {printable(name)}")
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


def provenance_of(run: CalibrationRun, *options: str) -> dict[str, str]:
    """Date and command."""
    counts = f"--punches {run.punches} --spheres {run.spheres} --rolling {run.rolling} --wheels {run.wheels}"
    command = " ".join(["python .ci/calibrate.py", *options, counts, f"--seed {run.seed}"])
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


# The answers of boundary elements


def measured_answers(run: CalibrationRun, engine: Engine = SERIAL) -> dict[Group, Answers]:
    """These answers, and no errors."""
    return answers_of(run.points, engine.map(reference_answer, run.points), provenance_of(run, "--answers"))


def answers_of(
    points: Sequence[CalibrationScene], outcomes: Sequence[Outcome], about: Mapping[str, str]
) -> dict[Group, Answers]:
    """Of `reference_answer` or more. about: lines of the provenance."""
    groups: dict[Group, list[tuple[CalibrationScene, Outcome]]] = {}
    for point, outcome in zip(points, outcomes, strict=True):
        groups.setdefault((point.kind, point.quantity), []).append((point, outcome))
    return {group: Answers.of(pairs, {**about, "code": code_of(pairs[0][0])}) for group, pairs in groups.items()}


def code_of(point: CalibrationScene) -> str:
    """Digest of the code that an answer rests on."""
    (judge,) = (model for model in models_serving(point.scene, point.quantity) if isinstance(model, GridModel))
    return calibration.code_behind(judge, point.target())


def as_file(groups: Mapping[Group, Answers]) -> bytes:
    """Equal for equal answers."""
    arrays = {
        f"{kind} {quantity} {field.name}": np.array(json.dumps(value)) if field.name == ABOUT else value
        for (kind, quantity), answers in sorted(groups.items())
        for field in fields(answers)
        for value in [getattr(answers, field.name)]
    }
    contents = io.BytesIO()
    np.savez_compressed(contents, **arrays)  # type: ignore[arg-type]  # stubs take a name for a flag
    return contents.getvalue()


def merged(path: Path, made: Mapping[Group, Answers]) -> bytes:
    """Those of a file, with these in the place of the same kinds. ValueError where a kind would have fewer scenes."""
    answers_in.cache_clear()  # which may have been written since
    before = answers_in(path)
    for group, answers in before.items():
        if group in made and made[group].number.size < answers.number.size:
            count = f"as many answers as there are, {answers.number.size} of {' '.join(group)}"
            raise ValueError(f"--answers must leave {count}, got {made[group].number.size}")
    return as_file({**before, **made})


# The command


def parser() -> argparse.ArgumentParser:
    """Of the script, whose errors end as those of the commands."""
    run = CalibrationRun()
    calibrating = _Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, what in COUNTED.items():
        default = getattr(run, name)
        calibrating.add_argument(
            f"--{name}", type=at_least(0), default=default, metavar="N", help=f"{what} (default: {default})"
        )
    add_workers(calibrating)
    out = f"folder of the table and of finished solves (default: {OUT}; of --check: the table of the package)"
    add_options(calibrating, ("--seed", "S", at_least(0), "seed of the scenes"), ("--out", "DIR", Path, out))
    calibrating.add_argument("--install", action="store_true", help="put it in the place of that of the package")
    alone = calibrating.add_mutually_exclusive_group()
    alone.add_argument("--answers", action="store_true", help="make the answers of boundary elements alone")
    alone.add_argument("--model", metavar="NAME", help="measure this model of the package alone")
    alone.add_argument("--check", type=at_least(1), metavar="N", help="measure N scenes of each kind again")
    alone.add_argument("--references", type=Path, metavar="FOLDER", help="references of `judge`, for --install")
    calibrating.set_defaults(command=calibrate, seed=run.seed)
    return calibrating


def calibrate(arguments: argparse.Namespace) -> Exit:
    """Measure, check or install."""
    arguments.keeps = not (arguments.check or arguments.references)
    for name in ("check", "model", "references"):
        if getattr(arguments, name):
            not_beside(arguments, f"beside --{name}", "--seed", *(f"--{counted}" for counted in COUNTED))
    if arguments.references:
        return _install_references(arguments)
    if arguments.check:
        return _check(arguments)
    check_places(arguments, {})
    return _measure(arguments)


def _install_references(arguments: argparse.Namespace) -> Exit:
    """Files of references, as they are in a folder that `mdr-validation calibrate --references` has made."""
    from validation.judging.kinds.references import FOLDER

    not_beside(arguments, "beside --references", "--workers", "--out")
    if not (arguments.install and (arguments.references / MANIFEST).is_file()):
        raise ValueError("--references must be a folder of mdr-validation calibrate --references, with --install")
    files = [path for path in arguments.references.iterdir() if path.is_file() and path.name != MANIFEST]
    for path in files:
        write_whole(FOLDER / path.name, path.read_bytes())
    print(printable(f"{len(files)} files of references in {FOLDER}, where `judge` reads them"))
    return Exit.MET


def _check(arguments: argparse.Namespace) -> Exit:
    if arguments.install and arguments.out is not None:
        raise ValueError("--install is for a table that is measured, or for --check of that of the package")
    table, engine = table_in(arguments.out), Engine(workers=arguments.workers)
    differing, solves = check_calibration(arguments.check, engine, table, stamp=arguments.install)
    if differing:
        print("\n".join(differing))
        return Exit.CRITERION_FAILED
    print("\n".join(calibration_lines(table)))
    rows = "their rows have today's code" if arguments.install else "nothing was written"
    print(f"measured again: {solves}, all the same; {rows}")
    return Exit.MET


def _measure(arguments: argparse.Namespace) -> Exit:
    """Table and answers, or one of them, in a folder, and in the package if asked for."""
    run = CalibrationRun(seed=arguments.seed, **{name: getattr(arguments, name) for name in COUNTED})
    if arguments.install and not (arguments.answers or arguments.model):
        check_installable(run)
    arguments.out = arguments.out or OUT
    table, answers = places = table_in(arguments.out), arguments.out / ANSWERS.name
    with (
        Folder(arguments.out, kind=CALIBRATION) as folder,
        progress_of("calibration", arguments.workers) as progress,
    ):
        engine = Engine(workers=arguments.workers, store=arguments.out / REALISATIONS, progress=progress)
        files = {place.name: place.read_bytes() for place in places if place.exists()}
        made: Mapping[Group, Answers] = {}
        if arguments.model:
            files[table.name] = measured_alone(arguments.model, engine, table if table.exists() else table_in(None))
        elif arguments.answers:
            made = measured_answers(run, engine)
        else:
            files[table.name], made = measured_table(run, engine)
        if made:
            files[answers.name] = merged(answers, made)
        folder.replace(files)
    if arguments.install and not arguments.answers:
        install(table)
    if arguments.install and made:
        write_whole(ANSWERS, merged(ANSWERS, made))
    print("\n".join(_report_lines(table, made, arguments)))
    return Exit.MET


def _report_lines(table: Path, made: Mapping[Group, Answers], arguments: argparse.Namespace) -> list[str]:
    """What was measured, where it is, and whether `compare` goes by it."""
    if arguments.answers:
        lines = [
            f"{' '.join(group)}: {answers.number.size} answers, {answers.each.size} numbers of realisations"
            for group, answers in made.items()
        ]
        return [*lines, printable(f"answers: {ANSWERS if arguments.install else arguments.out / ANSWERS.name}")]
    used = "goes on with that of the package: the same command with --install"
    where = f"{table}, installed: `compare` claims errors by it" if arguments.install else f"{table}; `compare` {used}"
    return [*calibration_lines(table), printable(f"table: {where}")]


if __name__ == "__main__":
    sys.exit(main(parser=parser()))
