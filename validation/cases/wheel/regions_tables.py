"""Region 2 and its neighbours: tables behind the figure and on the page."""

from collections.abc import Sequence

import numpy as np

from validation.analysis.evidence import Number, Table, VerdictCell, columns, plus_minus, table_of
from validation.analysis.spectra import band_means
from validation.cases.wheel.regions import LONG_STEADY, SHORT_OPEN, SHORT_STEADY, RegionsResult
from validation.cases.wheel.regions_numbers import FIRST, RATIO, second_order


def plateau_tables(result: RegionsResult) -> list[Table]:
    """A in bands of a part of a period, up to region 3, with the second-order force."""
    tables = []
    for name, short in ((LONG_STEADY, "long"), (SHORT_STEADY, "short")):
        scene, outcome = result.case.plateaus()[name].scene, result.plateaus[name]
        omega = outcome["omega"]
        width = max(scene.oscillation_period / 12, 2 * float(omega[0]))
        edges = np.arange(FIRST * scene.eigenfrequency, 1.2 * scene.jump, width)
        curves = {
            "omega [rad/s]": (edges[1:] + edges[:-1]) / 2,
            "steady-state": band_means(omega, outcome["plain"].mean(axis=0), edges),
            # no band that reaches into region 3
            "second order": np.where(edges[1:] < scene.jump, band_means(omega, second_order(scene, omega), edges), 0.0),
        }
        if short == "short":
            leaking = result.plateaus[SHORT_OPEN]
            curves["open"] = band_means(leaking["omega"], leaking["plain"].mean(axis=0), edges)
        tables.append(Table(f"plateau of {short} waves", columns(**curves)))
    return tables


def spectra_by_speed(result: RegionsResult) -> Table:
    """Mean A with Hann's window over omega / omega_eigen, line by line up to four times the jump."""
    rows: list[dict[str, object]] = []
    for ratio, ensemble in result.case.speeds().items():
        omega = result.speeds[ratio]["omega"] / ensemble.scene.eigenfrequency
        density = result.speeds[ratio]["hann"].mean(axis=0)
        for x, a in zip(omega, density, strict=True):
            if 0.5 < x < 1.5 * max(ratio, 2):
                rows.append({RATIO: ratio, "omega / omega_eigen": float(x), "A [(m/s2)2 s]": float(a)})
    return table_of("spectra", rows)


def shown_speeds(speeds: Table, jumps: Sequence[Number]) -> Table:
    """Jump and valley by speed."""
    verdicts = {number.where[RATIO]: number for number in jumps}

    def verdict(ratio: float) -> object:
        number = verdicts.get(float(ratio))
        return VerdictCell(plus_minus(number.value, number.uncertainty), number.verdict) if number else "not sought"

    return Table(
        "regions 1 to 3 by speed",
        {
            RATIO: [f"{ratio:g}" for ratio in speeds[RATIO]],
            "v₀ [m/s]": [f"{speed:.3g}" for speed in speeds["v0 [m/s]"]],
            "q_min v₀ [rad/s]": [f"{jump:.5g}" for jump in speeds["q_min v0 [rad/s]"]],
            "jump [rad/s]": [verdict(ratio) for ratio in speeds[RATIO]],
            "valley [dB]": [f"{depth:.1f}" for depth in speeds["valley [dB]"]],
        },
    )
