"""Numbers of Fig. 14.4: each feature of the spectrum beside theory, and what must hold to rounding."""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from validation.analysis.difference import difference
from validation.analysis.evidence import Number, Role
from validation.analysis.statistics import Estimate
from validation.cases.wheel import features
from validation.cases.wheel.features import BREAK, FLOOR, JUMP, PEAK, PERIOD, PREDICTED, SLOPE, Spectrum
from validation.engine.engine import Outcome

LEVEL = "level of region 3"
LINES = 2
"""Of a record: half of the width of Hann's main lobe."""


class Feature(NamedTuple):
    """A feature of the spectrum: what the chapter says of it, and what theory has for it."""

    quantity: str
    unit: str
    region: str
    chapter: str
    source: str

    @property
    def name(self) -> str:
        return self.quantity if self.unit == "-" else f"{self.quantity} [{self.unit}]"


JUMP_OF_RECORDS = "<J²> / (ω² T), J the jump of a(t) from the end of each record to its beginning"
OSCILLATION = "an oscillating substructure of constant period"
FEATURES = {
    PEAK: Feature("peak ω_eigen", "rad/s", "1", "a sharp maximum at the eigenfrequency", "sqrt(2 a E* / M)"),
    JUMP: Feature("jump", "rad/s", "2 to 3", "a plateau, and a sharp rise at its end", "q_min v₀, (14.20)"),
    SLOPE: Feature("slope of region 3", "-", "3", "a power law", "-2 H - 3, (14.13)"),
    PERIOD: Feature("period of the oscillation", "rad/s", "3", OSCILLATION, "π v₀ / a, (14.12)"),
    FLOOR + PREDICTED: Feature(
        "floor over predicted", "-", "4", "another slope, an artefact of the finite distance?", JUMP_OF_RECORDS
    ),
    BREAK + PREDICTED: Feature(
        "break over predicted", "-", "3 to 4", "a break", "where (14.14) through the resonator meets that floor"
    ),
}


def _tolerance(key: str, reference: float, line: float) -> tuple[float, str]:
    """And its reason; line: distance of two lines of a record."""
    if key == JUMP:
        return LINES * line, f"{LINES} lines of the record, half of the main lobe of Hann's window"
    if key == SLOPE:
        return 0.05, "1 %: a difference of slope that is hardly visible on a double-logarithmic plot"
    if key == PEAK:
        return (
            0.005 * reference,
            "0.5 %: a small part of the spacing of the spectral lines, between which the peak is interpolated",
        )
    if key == PERIOD:
        return 0.01 * reference, "1 %: roughness at the edge of the contact changes the contact length to second order"
    if key == BREAK + PREDICTED:
        return 0.1, "10 %: a floor 0.4 dB off alone moves the break by 3 to 6 %"
    return 0.1, "10 %: 0.4 dB of a level"


def feature_numbers(name: str, spectrum: Spectrum) -> dict[str, Number]:
    """The features that the spectrum of a scene has, beside theory."""
    values, theory = features.measured(spectrum), features.expected(spectrum)
    line, numbers = float(spectrum.omega[0]), {}
    for key in (key for key in FEATURES if key in values):
        reference = theory.get(key, 1.0)
        tolerance, reason = _tolerance(key, reference, line)
        numbers[key] = Number(
            quantity=FEATURES[key].quantity,
            model="springs",
            where={"scene": name},
            value=values[key].value,
            reference=reference,
            source=FEATURES[key].source,
            tolerance=tolerance,
            reason=reason,
            unit=FEATURES[key].unit,
            grid=line / 2 if key == JUMP else 0.0,
            sample=values[key].half_width,
            role=Role.FINDING,
        )
    return numbers


def level_over_linear(spectrum: Spectrum) -> Iterator[Number]:
    """Level of region 3 over (14.12) through the resonator, up to where the floor is far below; if there is room."""
    scene, omega = spectrum.scene, spectrum.omega
    first = max(1.2 * scene.jump, features.FREE_MASS * scene.eigenfrequency)
    last = min(0.7 * features.expected(spectrum)[BREAK], 0.9 * scene.cutoff)
    if first >= last:
        return
    inside = (omega > first) & (omega < last)
    sums = spectrum.hann[:, inside].sum(axis=1)
    mean, linear = float(sums.mean()), float(spectrum.linear[inside].sum())
    error = float(np.std(sums, ddof=1)) / math.sqrt(len(sums)) / mean
    yield difference(
        Estimate(math.log(mean / linear), error, len(sums)),
        quantity=LEVEL,
        model="springs over linear theory",
        where={"theory": "(14.12) through the resonator"},
        source="linear theory: a contact of fixed radius",
        tolerance=0.5,
        reason="0.5 dB: a sixth of the 3 dB accepted for one-third octaves of rolling noise",
    )


def exact_numbers(batches: list[Outcome]) -> list[Number]:
    """Parseval's theorem and Newton's law."""
    wheels = sum(batch["jump"].size for batch in batches)
    return [
        Number(
            quantity="integral of A over f, over the mean square acceleration, less one",
            where={"batches": f"worst of {len(batches)} batches"},
            value=max(abs(_parseval(batch)) for batch in batches),
            reference=0.0,
            source="Parseval",
            tolerance=1e-11,
            reason="rounding of the Fourier transforms",
        ),
        Number(
            quantity="mean of F - F_N less M times the velocity change over T, over the rms of F - F_N",
            where={"wheels": f"worst of {wheels} wheels"},
            value=max(float(np.abs(batch["balance"]).max()) for batch in batches),
            reference=0.0,
            source="Newton: mean force and load balance",
            tolerance=1e-11,
            reason="rounding of a sum over all steps",
        ),
    ]


def _parseval(batch: Outcome) -> float:
    square = float(np.mean(batch["square"]))
    density = batch["plain"].mean(axis=0)
    steps = round(float(batch["duration"] / batch["time step"]))
    weights = np.full(density.size, 2.0)
    weights[-1] = 2.0 if steps % 2 else 1.0
    return (float(weights @ density) / float(batch["duration"]) + float(np.mean(batch["mean"] ** 2))) / square - 1
