"""Very long runs: the drift of the energy on a Hertz contact, and lap after lap over rough tracks on springs."""

import math

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from validation.analysis.evidence import Number, Table, table_of
from validation.analysis.statistics import student
from validation.cases.stability.hertz_vibration import HERTZ, RELEASE
from validation.cases.stability.stability import Row, WheelStabilityResult
from validation.simulation.free_vibration import LIFT_OFF, TENTHS, WHEEL, LongRun
from validation.simulation.integrators import EXPLICIT_EULER, VELOCITY_VERLET
from validation.simulation.spring_tracks import HEIGHT, Laps, RoughTrack

FloatArray = NDArray[np.float64]

UNIFORM = math.sqrt(1 / 12)
"""Standard deviation of rounding, over the last place."""
SQUARE, FREE = "mean square acceleration", "energy of the free vibration"


def long_table(result: WheelStabilityResult) -> Table:
    """Energy over that of the beginning, in tenths of the run."""
    rows: list[Row] = []
    for name, found in result.long.items():
        x = LongRun(scheme=name, highest=(), steps=result.case.long_steps).omega_dt
        for i, highest in enumerate(result.case.long_highest):
            for j in range(TENTHS):
                step = (j + 0.5) * (result.case.long_steps // TENTHS)
                rows.append(
                    {
                        "scheme": name,
                        RELEASE: highest,
                        "steps": step,
                        "change of energy": float(found["energy"][j, i] - 1),
                        "change of conserved quantity": float(found["kept"][j, i] - 1),
                        "linear theory": math.expm1(step * math.log1p(x**2)) if name == EXPLICIT_EULER.name else 0.0,
                    }
                )
    return table_of("long runs", rows)


def long_numbers(result: WheelStabilityResult, table: Table) -> list[Number]:
    """Drift where contact stays, and the growth by explicit Euler."""
    verlet = table.where(scheme=VELOCITY_VERLET.name)
    drifts = [
        _drift_number(result, highest, verlet.where(**{RELEASE: highest})["change of conserved quantity"])
        for highest in result.case.long_highest
        if highest < LIFT_OFF
    ]
    return [*drifts, _euler_number(result, table)]


def _drift_number(result: WheelStabilityResult, highest: float, change: FloatArray) -> Number:
    """Each step rounds the approach by UNIFORM last places, which does the work of the force on the way."""
    slope, uncertainty = fit_drift(change)
    steps, turn = result.case.long_steps, LongRun(scheme=VELOCITY_VERLET.name, highest=(), steps=0).omega_dt
    walk = math.sqrt(2 * steps) * UNIFORM * np.finfo(float).eps * highest / (highest - 1)
    return Number(
        quantity="drift of the conserved energy",
        model=VELOCITY_VERLET.name,
        where={"contact": HERTZ, "steps": steps, RELEASE: highest},
        value=slope,
        reference=0.0,
        source="H + (omega dt)^2 (v^2 V'' / 12 - V'^2 / 24)",
        tolerance=4 * walk + turn**4,
        reason="four standard deviations of a random walk of rounding errors, and the terms of order (omega dt)^4",
        sample=uncertainty,
    )


def fit_drift(y: FloatArray) -> tuple[float, float]:
    """Change over the whole run by a straight line through the tenths, and the half-width of its 95 % interval."""
    line = stats.linregress((np.arange(y.size) + 0.5) / y.size, y)
    return float(line.slope), float(student(y.size - 2) * line.stderr)


def _euler_number(result: WheelStabilityResult, table: Table) -> Number:
    highest = result.case.long_highest[0]
    rows = table.where(**{"scheme": EXPLICIT_EULER.name, RELEASE: highest})
    found, theory = (np.log1p(rows[column]) for column in ("change of energy", "linear theory"))
    amplitude = (highest - 1) * math.exp(theory[-1] / 2)
    return Number(
        quantity="ln(growth of the energy) over n ln(1 + (omega dt)^2)",
        model=EXPLICIT_EULER.name,
        where={"contact": HERTZ, RELEASE: highest},
        value=float((found[-1] - found[0]) / (theory[-1] - theory[0])),
        reference=1.0,
        source="|lambda|^2 = 1 + (omega dt)^2",
        tolerance=amplitude**2,
        reason="square of the largest amplitude over d_N: to that order a Hertz contact is not linear",
    )


def laps_table(result: WheelStabilityResult) -> Table:
    """Tenths of the laps over the first one, means over the wheels."""
    rows: list[Row] = []
    for name, found in result.laps.items():
        for j in range(TENTHS):
            row: Row = {"scheme": name, "laps": (j + 0.5) * result.case.laps / TENTHS}
            row["linear theory"] = _euler_gain(result.case.laps * j / TENTHS) if name == EXPLICIT_EULER.name else 0.0
            for key, label in (("square", SQUARE), ("free", "free vibration")):
                mean, half = mean_of_logs(found[key][j] / found[key][0])
                row |= {f"{label}, log over first tenth": mean, f"{label}, half-width": half}
            rows.append(row)
    return table_of("rounds", rows)


def mean_of_logs(ratios: FloatArray, confidence: float = 0.95) -> tuple[float, float]:
    """Mean of the logarithms over the wheels, and the half-width of its interval."""
    logs = np.log(ratios)
    return float(logs.mean()), float(student(logs.size - 1, confidence) * logs.std(ddof=1) / math.sqrt(logs.size))


def lap_numbers(result: WheelStabilityResult) -> list[Number]:
    """The last tenth of the laps over the first one."""
    verlet, euler = (result.laps[scheme.name] for scheme in (VELOCITY_VERLET, EXPLICIT_EULER))
    laps = result.case.laps
    theory = _euler_gain((1 - 1 / TENTHS) * laps)
    none = "no growth: a periodic track gives the wheel no energy in the mean"
    return [
        _growth_number(VELOCITY_VERLET.name, SQUARE, laps, verlet["square"], 0.0, none),
        _growth_number(VELOCITY_VERLET.name, FREE, laps, verlet["free"], 0.0, none),
        _growth_number(EXPLICIT_EULER.name, FREE, laps, euler["free"], theory, "n log(1 + (omega dt)^2)"),
    ]


def _growth_number(scheme: str, energy: str, laps: int, tenths: FloatArray, theory: float, source: str) -> Number:
    """Within the scatter of the wheels and what a Hertz contact adds, u'' = 1 - u - (u - 1)^2 / 4 + ..., at an
    amplitude A: the square of A, of the theory; the second harmonic, A / 24 of the first, which n turns tell from it
    but for 1 / (2 n): A / (24 n) of the energy of a tenth.
    """
    ratios = tenths[-1] / tenths[0]
    mean, half = mean_of_logs(ratios)
    amplitude = (Laps.lift + HEIGHT / WHEEL.approach) * math.exp(theory / 2)
    problem = Laps(scheme="", track=RoughTrack(rms=HEIGHT, seed=0), wheels=1, laps=laps)
    turns = laps / TENTHS * problem.track.points * problem.omega_dt / (2 * math.pi)
    return Number(
        quantity=f"ln(growth of the {energy}), last tenth over first",
        model=scheme,
        where={"contact": "springs", "laps": laps},
        value=mean,
        reference=theory,
        source=source,
        tolerance=mean_of_logs(ratios, 0.999)[1] + half + amplitude / (12 * turns) + theory * amplitude**2,
        reason=f"the 99.9 % interval of {ratios.size} wheels; of the largest amplitude over d_N the square, of the "
        f"theory, and the second harmonic, which {turns:.3g} turns of a tenth mix with the first",
        sample=half,
    )


def _euler_gain(laps: float) -> float:
    """log of the energy by which explicit Euler multiplies that of a free vibration in so many laps."""
    problem = Laps(scheme=EXPLICIT_EULER.name, track=RoughTrack(rms=HEIGHT, seed=0), wheels=1, laps=0)
    return laps * problem.track.points * math.log1p(problem.omega_dt**2)
