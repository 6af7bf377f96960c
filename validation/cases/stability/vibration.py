"""Tables and numbers of free vibration: four schemes on a linear and a Hertz contact, and very long runs."""

import math

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from validation.analysis.evidence import Number, Table, table_of
from validation.cases.stability.stability import Row, WheelStabilityResult
from validation.simulation.free_vibration import LIFT_OFF, SCHEMES, TENTHS, Endurance, amplification, first_turn
from validation.simulation.integrators import EXPLICIT_EULER, RUNGE_KUTTA, SYMPLECTIC_EULER, VELOCITY_VERLET
from validation.theory import wheel as wheel_theory

FloatArray = NDArray[np.float64]

ROUNDING = 1e-9
EVEN = math.sqrt(1 / 12)
"""Standard deviation of rounding, over the last place."""
PERIOD_ORDERS = {EXPLICIT_EULER.name: 2.0, SYMPLECTIC_EULER.name: 2.0, VELOCITY_VERLET.name: 2.0, RUNGE_KUTTA.name: 4.0}
ENERGY_ORDERS = {EXPLICIT_EULER.name: 1.0, SYMPLECTIC_EULER.name: 1.0, VELOCITY_VERLET.name: 2.0, RUNGE_KUTTA.name: 5.0}


def linear_table(result: WheelStabilityResult) -> Table:
    """Growth, angle and energy of each scheme and step beside the eigenvalue of a step."""
    rows: list[Row] = []
    for name, found in result.linear.items():
        x = np.array(result.case.steps)
        exact = amplification(name, x)
        theory = first_turn(name, np.minimum(x, 1.99))
        for i, step in enumerate(result.case.steps):
            rows.append(
                {
                    "scheme": name,
                    "omega dt": step,
                    "growth of a step": float(found["growth"][i]),
                    "growth by theory": float(abs(exact[i])),
                    "angle of a step [rad]": float(found["angle"][i]),
                    "angle by theory [rad]": float(np.angle(exact[i])),
                    "error of the period": float(abs(step / found["angle"][i] - 1)) if found["angle"][i] else 1.0,
                    "drift of energy in a turn": abs(math.expm1(4 * math.pi / step * math.log(found["growth"][i]))),
                    "change in a turn": float(found["change"][i]),
                    "change by theory": float(theory[i]),
                }
            )
    return table_of("linear vibration", rows)


def linear_numbers(table: Table) -> list[Number]:
    """Five of each scheme."""
    return [number for name in SCHEMES for number in _numbers_of_scheme(name, table.where(scheme=name))]


def _numbers_of_scheme(name: str, table: Table) -> list[Number]:
    """Growth and angle of every step; orders of the period and of the energy, and the energy itself, of small ones."""
    x = table["omega dt"]
    growth = np.abs(np.log(table["growth of a step"] / table["growth by theory"])).max()
    below = x < (SCHEMES[name].limit or x[-1])
    angle = np.abs(table["angle of a step [rad]"] / table["angle by theory [rad]"] - 1)[below].max()
    return [
        _eigen(f"{name}: growth of a step, log, largest error on both sides of the limit", float(growth)),
        _eigen(f"{name}: angle of a step below the limit, largest relative error", float(angle)),
        _order(name, table, "error of the period", PERIOD_ORDERS[name]),
        _order(name, table, "change in a turn", ENERGY_ORDERS[name]),
        _energy(name, table),
    ]


def _eigen(label: str, error: float) -> Number:
    return Number(
        quantity=label,
        value=error,
        reference=0.0,
        source="eigenvalue of a step for y'' = -omega^2 y",
        tolerance=ROUNDING,
        reason="both are exact but for rounding",
    )


def _order(name: str, table: Table, column: str, order: float) -> Number:
    """Between the two smallest steps."""
    x, error = table["omega dt"][:2], table[column][:2]
    return Number(
        quantity=f"{name}: order of the {column}",
        value=math.log(error[1] / error[0]) / math.log(x[1] / x[0]),
        reference=order,
        source="the first term of the eigenvalue of a step in omega dt",
        tolerance=10 * x[1] + 2 * ROUNDING,
        reason="higher terms, and a turn that does not end with a step: of the order of omega dt",
    )


def _energy(name: str, table: Table) -> Number:
    """The change within a turn against its theory at the smallest step."""
    return Number(
        quantity=f"{name}: change of the energy in a turn, omega dt = {table['omega dt'][0]:g}, over theory",
        value=float(table["change in a turn"][0] / table["change by theory"][0]),
        reference=1.0,
        source="what the scheme keeps in place of the energy, or |lambda|^2",
        tolerance=max(10 * table["omega dt"][0] ** 2, 1e-4 if name == RUNGE_KUTTA.name else 0.0),
        reason="the extremes may lie between steps, (omega dt)^2; of Runge-Kutta rounding in so small a change",
    )


def hertz_table(result: WheelStabilityResult) -> Table:
    """Period and energy of each scheme, step and release."""
    rows: list[Row] = []
    for problem, found in result.hertz:
        for i, highest in enumerate(problem.highest):
            exact = wheel_theory.hertz_period(highest)
            rows.append(
                {
                    "scheme": problem.scheme,
                    "omega dt": problem.step,
                    "released at [d_N]": highest,
                    "period [2 pi/omega]": float(found["period"][i]),
                    "period of Hertz [2 pi/omega]": exact,
                    "error of the period": abs(float(found["period"][i]) / exact - 1),
                    "energy, first half": float(found["early"][i]),
                    "energy, second half": float(found["late"][i]),
                }
            )
    return table_of("Hertz vibration", rows)


def orders_table(hertz: Table) -> Table:
    """The order of the period on a Hertz contact, by its three smallest steps."""
    rows: list[Row] = []
    for name in (VELOCITY_VERLET.name, RUNGE_KUTTA.name):
        for highest in sorted(set(hertz["released at [d_N]"].tolist())):
            found = hertz.where(**{"scheme": name, "released at [d_N]": highest})
            x, error = (np.log(found[column][:3]) for column in ("omega dt", "error of the period"))
            row: Row = {"scheme": name, "released at [d_N]": highest, "loses contact": float(highest > LIFT_OFF)}
            rows.append(row | {"order": float(np.polyfit(x, error, 1)[0]), "order where smooth": PERIOD_ORDERS[name]})
    return table_of("order on a Hertz contact", rows)


def hertz_numbers(result: WheelStabilityResult, table: Table) -> list[Number]:
    """The period of every release; energy and orders where contact stays: where it opens, they are irregular."""
    numbers = [_extrapolated(table, highest) for highest in result.case.highest]
    numbers += [_bounded(table, highest) for highest in result.case.highest if highest < LIFT_OFF]
    orders = orders_table(table).where(**{"loses contact": 0.0})
    names, releases = orders["scheme"].tolist(), orders["released at [d_N]"].tolist()
    found = zip(names, releases, orders["order"].tolist(), strict=True)
    step = result.case.hertz_steps[2]
    return numbers + [_hertz_order(name, highest, order, step) for name, highest, order in found]


def _extrapolated(table: Table, highest: float) -> Number:
    rows = table.where(**{"scheme": VELOCITY_VERLET.name, "released at [d_N]": highest})
    x, found = rows["omega dt"][:2], rows["period [2 pi/omega]"][:2]
    square = x**2
    limit = (square[1] * found[0] - square[0] * found[1]) / (square[1] - square[0])
    correction = abs(limit - found[0])
    part = 0.1 if highest < LIFT_OFF else 0.5
    return Number(
        quantity=f"velocity Verlet: period released at {highest:g} d_N, over 2 pi / omega, extrapolated to dt = 0",
        value=float(limit),
        reference=float(rows["period of Hertz [2 pi/omega]"][0]),
        source="integral of the energy between the turning points",
        tolerance=float(part * correction),
        reason=f"terms after dt^2, less than {part:g} of the correction; more where the contact opens, at a kink of k",
    )


def _bounded(table: Table, highest: float) -> Number:
    rows = table.where(**{"scheme": VELOCITY_VERLET.name, "released at [d_N]": highest})
    return Number(
        quantity=f"velocity Verlet: largest change of energy in the second half over the first, {highest:g} d_N",
        value=float(rows["energy, second half"][0] / rows["energy, first half"][0]),
        reference=1.0,
        source="a symplectic scheme keeps a neighbour of the energy",
        tolerance=0.05,
        reason="steps do not meet the extremes exactly; a drift of a twentieth of the band would show",
    )


def _hertz_order(name: str, highest: float, order: float, step: float) -> Number:
    return Number(
        quantity=f"{name}: order of the period on a Hertz contact, released at {highest:g} d_N",
        value=order,
        reference=PERIOD_ORDERS[name],
        source="its order",
        tolerance=2 * step,
        reason=f"twice the largest of three steps, omega dt = {step:g}: by that the next term is smaller, since "
        "Runge-Kutta loses (omega dt)^5 of its energy in a turn",
    )


def long_table(result: WheelStabilityResult) -> Table:
    """Energy over the first, in tenths of the run."""
    rows: list[Row] = []
    for name, found in result.long.items():
        x = Endurance(scheme=name, highest=(), steps=result.case.long_steps).turn
        for i, highest in enumerate(result.case.long_highest):
            for j in range(TENTHS):
                step = (j + 0.5) * (result.case.long_steps // TENTHS)
                grown = math.expm1(step * math.log1p(x**2)) if name == EXPLICIT_EULER.name else 0.0
                change = float(found["energy"][j, i] - 1)
                rows.append(
                    {
                        "scheme": name,
                        "released at [d_N]": highest,
                        "steps": step,
                        "change of energy": change,
                        "change of energy kept": float(found["kept"][j, i] - 1),
                        "linear theory": grown,
                    }
                )
    return table_of("long runs", rows)


def long_numbers(result: WheelStabilityResult, table: Table) -> list[Number]:
    """Drift where contact stays, and how explicit Euler grows."""
    numbers = []
    for highest in (u for u in result.case.long_highest if u < LIFT_OFF):
        rows = table.where(**{"scheme": VELOCITY_VERLET.name, "released at [d_N]": highest})
        numbers.append(_drift(result, highest, rows["change of energy kept"]))
    return [*numbers, _predicted_growth(result, table)]


def _drift(result: WheelStabilityResult, highest: float, change: FloatArray) -> Number:
    """Each step rounds the approach by EVEN last places, which does the work of the force on the way."""
    slope, uncertainty = _fit(change)
    steps, turn = result.case.long_steps, Endurance(scheme=VELOCITY_VERLET.name, highest=(), steps=0).turn
    walk = math.sqrt(2 * steps) * EVEN * np.finfo(float).eps * highest / (highest - 1)
    return Number(
        quantity=f"velocity Verlet: drift of the energy it keeps, over {steps} steps, released at {highest:.4g} d_N",
        value=slope,
        reference=0.0,
        source="H + (omega dt)^2 (v^2 V'' / 12 - V'^2 / 24)",
        tolerance=4 * walk + turn**4,
        reason="four standard deviations of a walk of rounding errors, and (omega dt)^4, which is left out",
        sample=uncertainty,
    )


def _fit(y: FloatArray) -> tuple[float, float]:
    """Change over the whole run by a straight line through the tenths, and the half-width of its 95 % interval."""
    line = stats.linregress((np.arange(y.size) + 0.5) / y.size, y)
    return float(line.slope), float(stats.t.ppf(0.975, y.size - 2) * line.stderr)


def _predicted_growth(result: WheelStabilityResult, table: Table) -> Number:
    highest = result.case.long_highest[0]
    rows = table.where(**{"scheme": EXPLICIT_EULER.name, "released at [d_N]": highest})
    found, theory = (np.log1p(rows[column]) for column in ("change of energy", "linear theory"))
    amplitude = (highest - 1) * math.exp(theory[-1] / 2)
    return Number(
        quantity=f"explicit Euler: growth of the energy, log, over (1 + (omega dt)^2)^n, released at {highest:.4g} d_N",
        value=float((found[-1] - found[0]) / (theory[-1] - theory[0])),
        reference=1.0,
        source="|lambda|^2 = 1 + (omega dt)^2",
        tolerance=amplitude**2,
        reason="the square of the largest amplitude over d_N, to which a Hertz contact is not linear",
    )
