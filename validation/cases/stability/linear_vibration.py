"""Free vibration on a linear contact: growth, angle and energy of a step of each scheme against its eigenvalue."""

import math
from functools import partial

import numpy as np

from validation.analysis.evidence import Number, Table, table_of
from validation.cases.stability.stability import Row, WheelStabilityResult
from validation.simulation.free_vibration import SCHEMES, amplification, first_period
from validation.simulation.integrators import EXPLICIT_EULER, RUNGE_KUTTA, SYMPLECTIC_EULER, VELOCITY_VERLET

ROUNDING = 1e-9
PERIOD_ORDERS = {EXPLICIT_EULER.name: 2.0, SYMPLECTIC_EULER.name: 2.0, VELOCITY_VERLET.name: 2.0, RUNGE_KUTTA.name: 4.0}
ENERGY_ORDERS = {EXPLICIT_EULER.name: 1.0, SYMPLECTIC_EULER.name: 1.0, VELOCITY_VERLET.name: 2.0, RUNGE_KUTTA.name: 5.0}
LINEAR = "linear contact"
GROWTH = "largest error of ln(growth in one step), on both sides of the limit"


def linear_table(result: WheelStabilityResult) -> Table:
    rows: list[Row] = []
    for name, found in result.linear.items():
        x = np.array(result.case.steps)
        exact = amplification(name, x)
        theory = first_period(name, np.minimum(x, 1.99))
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
    return [number for name in SCHEMES for number in _numbers_of_scheme(name, table.where(scheme=name))]


def _numbers_of_scheme(name: str, table: Table) -> list[Number]:
    """Growth and angle of every step; orders of the period and of the energy, and the energy itself, of small ones."""
    x = table["omega dt"]
    growth = np.abs(np.log(table["growth of a step"] / table["growth by theory"])).max()
    below = x < (SCHEMES[name].limit or x[-1])
    angle = np.abs(table["angle of a step [rad]"] / table["angle by theory [rad]"] - 1)[below].max()
    errors = {
        GROWTH: growth,
        "largest relative error of the phase angle of one step, below the limit": angle,
    }
    number = partial(Number, model=name)
    return [
        *(
            number(
                quantity=quantity,
                where={"contact": LINEAR},
                value=float(error),
                reference=0.0,
                source="eigenvalue of one step of y'' = -omega^2 y",
                tolerance=ROUNDING,
                reason="both are exact; rounding remains",
            )
            for quantity, error in errors.items()
        ),
        *(
            number(
                quantity=f"order of the {column}",
                where={"contact": LINEAR},
                value=math.log(table[column][1] / table[column][0]) / math.log(x[1] / x[0]),
                reference=order,
                source="leading term in omega dt of the eigenvalue of one step",
                tolerance=10 * x[1] + 2 * ROUNDING,
                reason="higher terms, and a period that is no whole number of steps: both of the order of omega dt",
            )
            for column, order in (
                ("error of the period", PERIOD_ORDERS[name]),
                ("change in a turn", ENERGY_ORDERS[name]),
            )
        ),
        number(
            quantity="change of the energy in one period, over theory",
            where={"contact": LINEAR, "omega dt": float(x[0])},
            value=float(table["change in a turn"][0] / table["change by theory"][0]),
            reference=1.0,
            source="the conserved quantity of the scheme, or |lambda|^2",
            tolerance=max(10 * x[0] ** 2, 1e-4 if name == RUNGE_KUTTA.name else 0.0),
            reason="the extremes may lie between steps, (omega dt)^2; for Runge-Kutta the change is so small that "
            "rounding shows",
        ),
    ]
