"""What the table of measured errors holds: its age, the code it was measured with, and how well it covers scenes.

It is measured by `.ci/calibrate.py` of a checkout.
"""

from collections.abc import Iterable, Mapping, Sequence
from datetime import UTC, date, datetime
from pathlib import Path

import numpy as np

from validation.advice import calibration
from validation.advice.calibration import TABLE, Key
from validation.advice.calibration_scenes import CalibrationRun, cheap_models
from validation.simulation.model import Target


def table_in(folder: Path | None) -> Path:
    """Of a folder of a user's own; without one, that of the package."""
    return TABLE if folder is None else folder / TABLE.name


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
