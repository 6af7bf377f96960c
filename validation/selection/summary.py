"""The text that `compare` prints: what the scene is, what became of each model, the result with its error."""

import math

from validation.analysis.evidence import plus_minus
from validation.scenes.description import description_lines
from validation.scenes.rolling import RollingScene
from validation.selection.calibrate import calibration_age
from validation.selection.compare import MOVING, UNITS, Comparison
from validation.selection.hierarchy import Candidate


def summary(comparison: Comparison) -> str:
    """Text of a comparison: the scene, what became of each model, the result with its error.

    Parameters
    ----------
    comparison : Comparison
        What `compare` returns.

    Returns
    -------
    str
        The lines that the command ``mdr-validation compare`` prints.

    Examples
    --------
    >>> text = validation.summary(validation.compare(validation.load_scene("sphere")))
    >>> print(text.splitlines()[0])
    Smooth sphere: stiffness within 10 %
    """
    scene, selection = comparison.scene, comparison.selection
    lines = [f"{scene.name}: {comparison.quantity} within {_percent(selection.tolerance)}"]
    lines += description_lines(scene, moving=comparison.quantity in MOVING)
    lines += ["", f"{'model':36s}{'status':22s}{'error':>10s}{'cost':>14s}   reason"]
    lines += [_row(candidate) for candidate in selection.candidates]
    best = selection.best
    if best is None or best.answer is None:
        return "\n".join([*lines, "", "no model has a result"])
    lines += ["", *_result(comparison, best)]
    lines.append(calibration_age())
    spent = (
        f"cost of the solves: about {format_seconds(selection.spent)}, from counted operations, without program start"
    )
    saved = sum(one.cost for one in selection.candidates if one.status in ("not needed", "skipped"))
    lines.append(
        f"{spent}; the models that were not solved would have cost {format_seconds(saved)}" if saved else spent
    )
    if not selection.met:
        left = f"{100 * best.answer.error:.3g} %"
        lines.append(f"not reached: the tolerance of {_percent(selection.tolerance)}; the smallest error is {left}")
    return "\n".join(lines)


def _row(candidate: Candidate) -> str:
    error = "—" if candidate.status == "not needed" else _percent(candidate.error)
    cost = format_seconds(candidate.cost)
    return f"{candidate.name:36s}{candidate.status:22s}{error:>10s}{cost:>14s}   {candidate.reason}"


def _result(comparison: Comparison, best: Candidate) -> list[str]:
    answer = best.answer
    assert answer is not None  # as asked
    parts = f"model {_percent(answer.model)}, grid {_percent(answer.grid)}, sample {_percent(answer.sample)}"
    if answer.value.size == 1:
        value = float(answer.value[0])
        shown = f"{_scaled(value, value * answer.error)} {comparison.unit}"
        return [f"{comparison.quantity} = {shown} ({_percent(answer.error)}: {parts}), by {best.name}"]
    assert isinstance(comparison.scene, RollingScene)  # of which alone there are levels
    radius, speed, unit = comparison.scene.contact_radius, comparison.scene.speed, UNITS[comparison.quantity]
    decibels = 20 * math.log10(1 + answer.error)
    lines = [
        f"{comparison.quantity} by {best.name}, one-third octaves, root mean square in each, "
        f"± {_percent(answer.error)}, {_short(decibels)} dB, over all bands ({parts})",
        f"{'q [rad/m]':>12s}{'q a':>8s}{'f [Hz]' if speed else '':>10s}{f'rms [{unit}]':>16s}",
    ]
    for q, level in zip(comparison.wavenumbers, answer.value, strict=True):
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
