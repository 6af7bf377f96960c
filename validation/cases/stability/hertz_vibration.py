"""Free vibration on a Hertz contact: period and energy of each scheme, and the order of the period."""

import numpy as np

from validation.analysis.evidence import Number, Table, table_of
from validation.cases.stability.linear_vibration import PERIOD_ORDERS
from validation.cases.stability.stability import Row, WheelStabilityResult
from validation.simulation.free_vibration import LIFT_OFF
from validation.simulation.integrators import RUNGE_KUTTA, VELOCITY_VERLET
from validation.theory import wheel as wheel_theory

HERTZ = "Hertz contact"
RELEASE = "released at [d_N]"


def hertz_table(result: WheelStabilityResult) -> Table:
    rows: list[Row] = []
    for problem, found in result.hertz:
        for i, highest in enumerate(problem.highest):
            exact = wheel_theory.hertz_period(highest)
            rows.append(
                {
                    "scheme": problem.scheme,
                    "omega dt": problem.step,
                    RELEASE: highest,
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
        for highest in sorted(set(hertz[RELEASE].tolist())):
            found = _of(hertz, name, highest)
            x, error = (np.log(found[column][:3]) for column in ("omega dt", "error of the period"))
            row: Row = {"scheme": name, RELEASE: highest, "loses contact": float(highest > LIFT_OFF)}
            rows.append(row | {"order": float(np.polyfit(x, error, 1)[0]), "order where smooth": PERIOD_ORDERS[name]})
    return table_of("order on a Hertz contact", rows)


def hertz_numbers(result: WheelStabilityResult, table: Table) -> list[Number]:
    """The period of every release; energy and orders where contact stays: where it opens, they are irregular."""
    smooth = orders_table(table).where(**{"loses contact": 0.0})
    names, releases, orders = (smooth[column].tolist() for column in ("scheme", RELEASE, "order"))
    step = result.case.hertz_steps[2]
    verlet = {highest: _of(table, VELOCITY_VERLET.name, highest) for highest in result.case.highest}
    return [
        *(_period_number(rows, highest) for highest, rows in verlet.items()),
        *(
            Number(
                quantity="largest change of energy, second half over first half",
                model=VELOCITY_VERLET.name,
                where={"contact": HERTZ, RELEASE: highest},
                value=float(rows["energy, second half"][0] / rows["energy, first half"][0]),
                reference=1.0,
                source="no drift: a symplectic scheme conserves a quantity close to the energy",
                tolerance=0.05,
                reason="extremes lie between steps; a drift by a twentieth of the oscillation of the energy would show",
            )
            for highest, rows in verlet.items()
            if highest < LIFT_OFF
        ),
        *(
            Number(
                quantity="order of the error of the period",
                model=name,
                where={"contact": HERTZ, RELEASE: highest},
                value=order,
                reference=PERIOD_ORDERS[name],
                source="order of the scheme",
                tolerance=2 * step,
                reason=f"twice the largest of three steps, omega dt = {step:g}: the next term is smaller by that "
                "factor, since Runge-Kutta loses a part of order (omega dt)^5 of its energy in one period",
            )
            for name, highest, order in zip(names, releases, orders, strict=True)
        ),
    ]


def _of(table: Table, scheme: str, highest: float) -> Table:
    return table.where(**{"scheme": scheme, RELEASE: highest})


def _period_number(rows: Table, highest: float) -> Number:
    """Extrapolated from the two smallest steps."""
    x, found = rows["omega dt"][:2], rows["period [2 pi/omega]"][:2]
    square = x**2
    limit = (square[1] * found[0] - square[0] * found[1]) / (square[1] - square[0])
    part = 0.1 if highest < LIFT_OFF else 0.5
    return Number(
        quantity="period over 2 pi / omega, extrapolated to dt = 0",
        model=VELOCITY_VERLET.name,
        where={"contact": HERTZ, RELEASE: highest},
        value=float(limit),
        reference=float(rows["period of Hertz [2 pi/omega]"][0]),
        source="integral of the energy between the turning points",
        tolerance=float(part * abs(limit - found[0])),
        reason=f"terms after dt^2, less than {part:g} of the correction; that part is larger where the contact opens",
    )
