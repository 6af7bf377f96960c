"""Numbers of Fig. 14.4: each feature of the spectrum beside theory, and what must hold to rounding."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from validation.analysis.difference import difference
from validation.analysis.evidence import Number, Role
from validation.analysis.statistics import Estimate
from validation.cases.wheel.features import (
    BREAK,
    CLEAR,
    FLOOR,
    JUMP,
    PEAK,
    PERIOD,
    PREDICTED,
    SLOPE,
    Spectrum,
    expected,
    found,
)
from validation.engine.engine import Outcome

LEVEL = "level of region 3"
LINES = 2
"""Of a record: half of the width of Hann's main lobe."""


@dataclass(frozen=True, kw_only=True)
class Feature:
    """A feature of the spectrum: what the chapter says of it, what theory has for it, and how close they must be.

    tolerance: of the reference and of the distance of two lines of a record.
    """

    quantity: str
    unit: str = "-"
    region: str
    chapter: str
    source: str
    tolerance: Callable[[float, float], float]
    reason: str

    @property
    def name(self) -> str:
        """With its unit."""
        return self.quantity if self.unit == "-" else f"{self.quantity} [{self.unit}]"


FEATURES = {
    PEAK: Feature(
        quantity="peak ω_eigen",
        unit="rad/s",
        region="1",
        chapter="a sharp maximum at the eigenfrequency",
        source="sqrt(2 a E* / M)",
        tolerance=lambda reference, line: 0.005 * reference,
        reason="0.5 %: a small part of the distance of two lines, between which it is found",
    ),
    JUMP: Feature(
        quantity="jump",
        unit="rad/s",
        region="2 to 3",
        chapter="a plateau, and a sharp rise at its end",
        source="q_min v₀, (14.20)",
        tolerance=lambda reference, line: LINES * line,
        reason=f"{LINES} lines of the record, half of the main lobe of Hann's window",
    ),
    SLOPE: Feature(
        quantity="slope of region 3",
        region="3",
        chapter="a power law",
        source="-2 H - 3, (14.13)",
        tolerance=lambda reference, line: 0.05,
        reason="1 %: what an eye could tell on double-logarithmic paper",
    ),
    PERIOD: Feature(
        quantity="period of the oscillation",
        unit="rad/s",
        region="3",
        chapter="an oscillating substructure of constant period",
        source="π v₀ / a, (14.12)",
        tolerance=lambda reference, line: 0.01 * reference,
        reason="1 %: roughness at the edge of the contact changes its length to second order",
    ),
    FLOOR + PREDICTED: Feature(
        quantity="floor over predicted",
        region="4",
        chapter="another slope, an artefact of the finite distance?",
        source="<J²> / (ω² T), J the jump of a(t) from the end of each record to its beginning",
        tolerance=lambda reference, line: 0.1,
        reason="10 %: 0.4 dB of a level",
    ),
    BREAK + PREDICTED: Feature(
        quantity="break over predicted",
        region="3 to 4",
        chapter="a break",
        source="where (14.14) through the resonator meets that floor",
        tolerance=lambda reference, line: 0.1,
        reason="10 %: 0.4 dB of a level",
    ),
}


def feature_numbers(name: str, spectrum: Spectrum) -> dict[str, Number]:
    """The features that the spectrum of a scene has, beside theory."""
    values, theory = found(spectrum), expected(spectrum)
    line = float(spectrum.omega[0])
    return {
        key: Number(
            quantity=feature.quantity,
            model="springs",
            where={"scene": name},
            value=values[key].value,
            reference=theory.get(key, 1.0),
            source=feature.source,
            tolerance=feature.tolerance(theory.get(key, 1.0), line),
            reason=feature.reason,
            unit=feature.unit,
            grid=line / 2 if key == JUMP else 0.0,
            sample=values[key].half_width,
            role=Role.FINDING,
        )
        for key, feature in FEATURES.items()
        if key in values
    }


def level_over_linear(spectrum: Spectrum) -> Iterator[Number]:
    """Level of region 3 over (14.12) through the resonator, up to where the floor is far below; if there is room."""
    scene, omega = spectrum.scene, spectrum.omega
    first = max(1.2 * scene.jump, CLEAR * scene.eigenfrequency)
    last = min(0.7 * expected(spectrum)[BREAK], 0.9 * scene.cutoff)
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
        source="a contact that keeps its radius",
        tolerance=0.5,
        reason="0.5 dB: a sixth of what one-third octaves of rolling noise are held to",
    )


def exact_numbers(batches: list[Outcome]) -> list[Number]:
    """Parseval's theorem and Newton's law."""
    wheels = sum(batch["jump"].size for batch in batches)
    return [
        Number(
            quantity="int A df over the mean square of the acceleration, less one",
            where={"batches": f"worst of {len(batches)} batches"},
            value=max(abs(_parseval(batch)) for batch in batches),
            reference=0.0,
            source="Parseval",
            tolerance=1e-11,
            reason="rounding of transforms",
        ),
        Number(
            quantity="mean of F - F_N less M times the change of velocity over T, over its rms",
            where={"wheels": f"worst of {wheels} wheels"},
            value=max(float(np.abs(batch["balance"]).max()) for batch in batches),
            reference=0.0,
            source="Newton: mean force and load balance",
            tolerance=1e-11,
            reason="rounding of as many sums as steps",
        ),
    ]


def _parseval(batch: Outcome) -> float:
    square = float(np.mean(batch["square"]))
    density = batch["plain"].mean(axis=0)
    steps = round(float(batch["duration"] / batch["time step"]))
    weights = np.full(density.size, 2.0)
    weights[-1] = 2.0 if steps % 2 else 1.0
    return (float(weights @ density) / float(batch["duration"]) + float(np.mean(batch["mean"] ** 2))) / square - 1
