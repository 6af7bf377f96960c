"""One scene: the quantity, the cheapest model that is accurate enough, and why."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from validation.analysis.evidence import plus_minus
from validation.scenes.description import description_lines
from validation.scenes.indentation import IndentationScene
from validation.scenes.load import Scene
from validation.selection import indentation_models, rolling_models
from validation.selection.found_models import with_found_models
from validation.selection.hierarchy import Candidate, ContactModel, Selection, select_model
from validation.simulation.model import all_models
from validation.simulation.rolling_quantity import RollingQuantity

PRESSED = ("stiffness",)
ROLLING = ("force-rms", "force-spectrum")
MOVING = ("acceleration", "acceleration-rms")
QUANTITIES = (*PRESSED, *ROLLING, *MOVING)
UNITS = {
    "stiffness": "N/m",
    "force-rms": "N",
    "force-spectrum": "N",
    "acceleration": "m/s²",
    "acceleration-rms": "m/s²",
}


@dataclass(frozen=True)
class Comparison:
    """A scene, the quantity that is asked of it, and the selection of a model for it."""

    scene: Scene
    quantity: str
    selection: Selection

    @property
    def unit(self) -> str:
        """Of the quantity."""
        return UNITS[self.quantity]


def quantities_of(scene: Scene) -> tuple[str, ...]:
    """The quantities that a scene has; the first is the default."""
    if isinstance(scene, IndentationScene):
        return PRESSED
    return ROLLING if scene.mass is None else (*MOVING, *ROLLING)


def models_of(scene: Scene, quantity: str, tolerance: float, seed: int) -> list[ContactModel]:
    """Models of a scene, the cheapest first. Raises ValueError for a quantity that the scene has not."""
    if quantity not in quantities_of(scene):
        raise ValueError(
            f"quantity must be one of {', '.join(quantities_of(scene))} for scene {scene.name!r}, got {quantity!r}"
        )
    if isinstance(scene, IndentationScene):
        return with_found_models(indentation_models.models(scene, tolerance, seed), scene, quantity)
    models = rolling_models.models(scene, quantity, tolerance, seed)  # type: ignore[arg-type]  # as checked
    return with_found_models(models, scene, quantity)


def kinds_below_boundary_elements() -> tuple[str, ...]:
    """Names of all models below boundary elements."""
    found = (model.name for model in all_models())
    return tuple(dict.fromkeys((*found, *rolling_models.CHEAP, indentation_models.IndentationOnSprings.kind)))


def compare(
    scene: Scene,
    *,
    quantity: str | None = None,
    tolerance: float = 0.1,
    seed: int = 0,
    callback: Callable[[ContactModel], None] = lambda _: None,
) -> Comparison:
    """Select the cheapest model of a scene whose error is within the tolerance.

    quantity: see `quantities_of`, None for the first of them; tolerance: relative, of the number or of the root mean
    square over all bands; seed: of what is drawn, zero or positive; callback: called with each model before its solve.
    Raises ValueError for what the scene cannot answer.
    """
    asked = quantities_of(scene)[0] if quantity is None else quantity
    return Comparison(
        scene, asked, select_model(models_of(scene, asked, tolerance, seed), tolerance, callback=callback)
    )


def summary(comparison: Comparison) -> list[str]:
    """Lines for a person: the result with its error, why this model, and what every model costs."""
    scene, selection = comparison.scene, comparison.selection
    lines = [f"{scene.name}: {comparison.quantity} within {_percent(selection.tolerance)}"]
    lines += description_lines(scene, moving=comparison.quantity in MOVING)
    lines += ["", f"{'model':36s}{'status':22s}{'error':>10s}{'cost':>14s}   reason"]
    lines += [_row(candidate) for candidate in selection.candidates]
    best = selection.best
    if best is None or best.answer is None:
        return [*lines, "", "no model has an answer"]
    lines += ["", *_result(comparison, best)]
    spent = f"solves: about {format_seconds(selection.spent)} by their count, the start of the program not included"
    saved = sum(one.model.cost().seconds for one in selection.candidates if one.status in ("not needed", "skipped"))
    lines.append(
        f"{spent}; the models that were not solved would have cost {format_seconds(saved)}" if saved else spent
    )
    if not selection.met:
        left = f"{100 * best.answer.error:.3g} %"
        lines.append(f"not reached: the tolerance of {_percent(selection.tolerance)}; the best there is leaves {left}")
    return lines


def _row(candidate: Candidate) -> str:
    seconds = format_seconds(candidate.model.cost().seconds)
    known = candidate.answer or candidate.estimate
    error = "—" if candidate.status == "not needed" else _percent(known.error)
    return f"{candidate.model.name:36s}{candidate.status:22s}{error:>10s}{seconds:>14s}   {candidate.reason}"


def _result(comparison: Comparison, best: Candidate) -> list[str]:
    answer = best.answer
    assert answer is not None  # as asked
    parts = f"model {_percent(answer.model)}, grid {_percent(answer.grid)}, sample {_percent(answer.sample)}"
    if answer.value.size == 1:
        value = float(answer.value[0])
        shown = f"{_scaled(value, value * answer.error)} {comparison.unit}"
        return [f"{comparison.quantity} = {shown} ({_percent(answer.error)}: {parts}), by {best.model.name}"]
    assert not isinstance(comparison.scene, IndentationScene)  # which has one number
    quantity = RollingQuantity(comparison.scene, comparison.quantity)  # type: ignore[arg-type]
    radius, speed = comparison.scene.contact_radius, comparison.scene.speed
    decibels = 20 * math.log10(1 + answer.error)
    lines = [
        f"{comparison.quantity} by {best.model.name}, one-third octaves, root mean square in each, "
        f"± {_percent(answer.error)}, {_short(decibels)} dB, over all bands ({parts})",
        f"{'q [rad/m]':>12s}{'q a':>8s}{'f [Hz]' if speed else '':>10s}{'level [' + comparison.unit + ']':>16s}",
    ]
    for q, level in zip(quantity.bands.centres, answer.value, strict=True):
        frequency = f"{q * speed / (2 * math.pi):.4g}" if speed else ""
        lines.append(f"{q:12.4g}{q * radius:8.2f}{frequency:>10s}{level:16.4g}")
    return lines


def _percent(value: float) -> str:
    """Two digits; "none" for what does not hold at all."""
    return "none" if math.isinf(value) else f"{_short(100 * value)} %"


def _scaled(value: float, error: float) -> str:
    """With its error, over a power of ten where that is far from one: (5.49 ± 0.50)e7."""
    power = math.floor(math.log10(value))
    if -3 < power < 4:
        return plus_minus(value, error)
    shown = plus_minus(value / 10**power, error / 10**power)
    return f"({shown})e{power}" if "±" in shown else f"{shown}e{power}"


def format_seconds(seconds: float) -> str:
    """In a unit that fits."""
    for unit, size in (("h", 3600.0), ("min", 60.0), ("s", 1.0), ("ms", 1e-3)):
        if seconds >= size:
            return f"{_short(seconds / size)} {unit}"
    return "1 ms"


def _short(value: float) -> str:
    """Two digits, without a power of ten where that can be."""
    return f"{float(f'{value:.2g}'):g}"
