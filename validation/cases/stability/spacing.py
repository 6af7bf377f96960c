"""Springs too far apart: the level of the last one-third octave and the force on coarser springs."""

import math
from functools import partial

import numpy as np

from validation.analysis.evidence import Number, Role, Table, table_of
from validation.analysis.statistics import student
from validation.cases.stability.stability import Row, WheelStabilityResult
from validation.simulation.spring_tracks import FINE, STRIDES

HEIGHT, LEVEL = "height [d_N]", "error of the last one-third octave [dB]"
OPEN = "left open by the ends of contact, first order [dB]"
PARTS = "dx over the shortest wave"
QUARTER = 25
"""The stride of springs a quarter of the shortest wave apart."""


def spacing_table(result: WheelStabilityResult) -> Table:
    """Of each height and spacing, means over the tracks; no level where the springs cannot carry the last band."""
    rows: list[Row] = []
    for height, found in result.spacing.items():
        error, level, linear, spread = (
            np.stack([outcome[key] for outcome in found]) for key in ("error", "level", "linear", "spread")
        )
        for i, stride in enumerate(STRIDES):
            carried = bool(level[:, i].mean() > 0)
            rows.append(
                {
                    HEIGHT: height,
                    "q_max dx": 2 * math.pi * stride / FINE,
                    "dx [shortest wave]": stride / FINE,
                    "error of force over its fluctuation": float(np.sqrt(np.mean(error[:, i] ** 2))),
                    LEVEL: 10 * math.log10(level[:, i].mean()) if carried else 0.0,
                    "by linear theory [dB]": 10 * math.log10(linear[:, i].mean()),
                    OPEN: 10 * math.log10(1 + spread[:, i].mean() / math.sqrt(len(found))),
                    "carried": float(carried),
                }
            )
    return table_of("spacing", rows)


def spacing_numbers(table: Table) -> list[Number]:
    """The lowest roughness against linear theory, and what a quarter of a wave costs there: above, tracks differ."""
    lowest = float(table[HEIGHT].min())
    rows = table.where(**{HEIGHT: lowest, "carried": 1.0})
    difference = rows[LEVEL] - rows["by linear theory [dB]"]
    least_likely = int(np.argmax(np.abs(difference) / rows[OPEN]))
    quarter = quarter_wave(rows)
    number = partial(Number, model="springs", reference=0.0, unit="dB")
    return [
        number(
            quantity="level of the last one-third octave over the sum over springs, at the least likely spacing",
            where={"h/d": lowest, PARTS: float(rows["dx [shortest wave]"][least_likely])},
            value=float(difference[least_likely]),
            source="dx sin(q (m + 1/2) dx) / sin(q dx / 2) in place of 2 sin(q a) / q",
            tolerance=5 * float(rows[OPEN][least_likely]),
            reason="five standard deviations of the part of the waves that the moving ends of the contact make on a "
            "track; each spring there has the weight phi(gap / h_rms)",
        ),
        number(
            quantity="error of the last one-third octave",
            where={"h/d": lowest, PARTS: QUARTER / FINE},
            value=float(quarter[LEVEL][0]),
            source="the condition dx < lambda / 4",
            tolerance=1.0,
            reason="1 dB: z / sin(z) with z = pi / 4 is 0.91 dB at the shortest wave alone",
            sample=student(math.inf) * float(quarter[OPEN][0]),
            role=Role.FINDING,
        ),
    ]


def quarter_wave(table: Table) -> Table:
    """Springs a quarter of the shortest wave apart."""
    return table.where(**{"dx [shortest wave]": QUARTER / FINE})
