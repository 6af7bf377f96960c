"""One scene, up the ladder: what is wanted of it, the cheapest model that is enough, and why."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from validation.analysis.evidence import plus_minus
from validation.scenes.description import description_lines
from validation.scenes.indentation import IndentationScene
from validation.scenes.load import Scene
from validation.selection import indentation_models as rungs_pressed
from validation.selection import rolling_models as rungs_rolling
from validation.selection.hierarchy import Candidate, ContactModel, Selection, select_model
from validation.simulation.rolling_quantity import RollingQuantity

PRESSED = ("stiffness",)
ROLLING = ("force-rms", "force-spectrum")
MOVING = ("acceleration", "acceleration-rms")
WANTS = (*PRESSED, *ROLLING, *MOVING)
UNITS = {
    "stiffness": "N/m",
    "force-rms": "N",
    "force-spectrum": "N",
    "acceleration": "m/s²",
    "acceleration-rms": "m/s²",
}


@dataclass(frozen=True)
class Comparison:
    """A scene, what was wanted of it within which tolerance, and how far the ladder was climbed."""

    scene: Scene
    want: str
    climb: Selection

    @property
    def unit(self) -> str:
        """Of what is wanted."""
        return UNITS[self.want]


def wants_of(scene: Scene) -> tuple[str, ...]:
    """What a scene can be asked for, the first unless something else is wanted."""
    if isinstance(scene, IndentationScene):
        return PRESSED
    return ROLLING if scene.mass is None else (*MOVING, *ROLLING)


def rungs_of(scene: Scene, want: str, tolerance: float, seed: int) -> list[ContactModel]:
    """The ladder of a scene, the cheapest model first. Raises ValueError for a want that the scene cannot answer."""
    if want not in wants_of(scene):
        raise ValueError(f"want must be one of {', '.join(wants_of(scene))} for scene {scene.name!r}, got {want!r}")
    if isinstance(scene, IndentationScene):
        return rungs_pressed.rungs(scene, tolerance, seed)
    return rungs_rolling.rungs(scene, want, tolerance, seed)  # type: ignore[arg-type]  # one of its own, as checked


def compare(
    scene: Scene,
    *,
    want: str | None = None,
    tolerance: float = 0.1,
    seed: int = 0,
    tell: Callable[[ContactModel], None] = lambda _: None,
) -> Comparison:
    """Climb the ladder of a scene as far as the tolerance asks.

    want: see `wants_of`, None for the first of them; tolerance: relative, of the number or of the root mean square over
    all bands; seed: of what is drawn, zero or positive; tell: is called with each rung before it is asked.
    Raises ValueError for what the scene cannot answer.
    """
    asked = wants_of(scene)[0] if want is None else want
    return Comparison(scene, asked, select_model(rungs_of(scene, asked, tolerance, seed), tolerance, tell=tell))


def told(comparison: Comparison) -> list[str]:
    """Lines for a person: the result with its error, why the ladder ended there, and what every rung costs."""
    scene, climbed = comparison.scene, comparison.climb
    lines = [f"{scene.name}: {comparison.want} within {_percent(climbed.tolerance)}"]
    lines += description_lines(scene, moving=comparison.want in MOVING)
    lines += ["", f"{'rung':36s}{'what became of it':18s}{'error':>10s}{'cost':>14s}   because"]
    lines += [_row(step) for step in climbed.steps]
    best = climbed.best
    if best is None or best.answer is None:
        return [*lines, "", "no rung has an answer"]
    lines += ["", *_result(comparison, best)]
    unasked = sum(step.rung.cost().seconds for step in climbed.steps if step.fate in ("not needed", "skipped"))
    spent = f"solves that were done: about {time_of(climbed.spent)} by their count, the start of the program apart"
    lines.append(f"{spent}; the rungs that were not asked would have cost {time_of(unasked)}" if unasked else spent)
    if not climbed.met:
        left = f"{100 * best.answer.error:.3g} %"
        lines.append(f"not reached: the tolerance of {_percent(climbed.tolerance)}; the best there is leaves {left}")
    return lines


def _row(step: Candidate) -> str:
    cost = step.rung.cost()
    error = "—" if step.fate == "not needed" else _percent(step.answer.error if step.answer else step.claim.error)
    return f"{step.rung.name:36s}{step.fate:18s}{error:>10s}{time_of(cost.seconds):>14s}   {step.because}"


def _result(comparison: Comparison, best: Candidate) -> list[str]:
    answer = best.answer
    assert answer is not None  # as asked
    parts = f"model {_percent(answer.model)}, grid {_percent(answer.grid)}, sample {_percent(answer.sample)}"
    if answer.value.size == 1:
        value = float(answer.value[0])
        shown = f"{_scaled(value, value * answer.error)} {comparison.unit}"
        return [f"{comparison.want} = {shown} ({_percent(answer.error)}: {parts}), by {best.rung.name}"]
    assert not isinstance(comparison.scene, IndentationScene)  # which has one number
    question = RollingQuantity(comparison.scene, comparison.want)  # type: ignore[arg-type]
    radius, speed = comparison.scene.contact_radius, comparison.scene.speed
    decibels = 20 * math.log10(1 + answer.error)
    lines = [
        f"{comparison.want} by {best.rung.name}, one-third octaves, root mean square in each, "
        f"± {_percent(answer.error)}, {_short(decibels)} dB, over all bands ({parts})",
        f"{'q [rad/m]':>12s}{'q a':>8s}{'f [Hz]' if speed else '':>10s}{'level [' + comparison.unit + ']':>16s}",
    ]
    for q, level in zip(question.bands.centres, answer.value, strict=True):
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


def time_of(seconds: float) -> str:
    """In a unit that fits."""
    for unit, size in (("h", 3600.0), ("min", 60.0), ("s", 1.0), ("ms", 1e-3)):
        if seconds >= size:
            return f"{_short(seconds / size)} {unit}"
    return "1 ms"


def _short(value: float) -> str:
    """Two digits, without a power of ten where that can be."""
    return f"{float(f'{value:.2g}'):g}"
