"""The smooth contact of a wheel with two radii: a published example, and what a circle in its place costs."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

import bem3d
from validation.analysis.answers import agreeing_from_the_first, answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Role, table_of
from validation.analysis.over_range import worst
from validation.analysis.wording import by_status, farthest_off, sentence, title
from validation.cases.rail.filters import (
    ACROSS,
    COUNTED,
    SPEEDS,
    counted,
    linear_filter,
    scene_of,
    weighted_difference,
)
from validation.cases.rail.published import RailWheel
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.equivalent_displacement import LINEAR
from validation.simulation.rail_ground import StatedAcross
from validation.theory.elliptic_contact import elliptic_contact

FloatArray = NDArray[np.float64]

APPROACH, PRESSURE = "approach", "largest pressure"
CONTACT = {APPROACH: (0.08190, "mm"), PRESSURE: (770.6, "MPa")}
"""Published example output of the program CONTACT for 100 kN, G = 82 GPa, nu = 0.28 on both bodies."""
CURVATURES = (0.001015, 0.0004215)
"""Of its gap, A x^2 + B y^2 [1/mm]."""
CLOSED, BEM = "closed form", "boundary elements"
DIGITS = 2e-4
STRIP = 2.6
"""Length and width of the flat strip over those of the contact."""
CLAIM = "Both the closed form and boundary elements give the contact of the program CONTACT."
CIRCLE = "A circle of the same area, sqrt(a_x a_y), has the contact filter of the ellipse within 1 dB."
EXCESS = "A3 of a circle over that of the ellipse"


@dataclass(frozen=True, kw_only=True)
class Ellipse:
    """cells: to the semi-axis along, two grids or more, ascending; crowns: radii of the rail across [m]; load of one
    wheel [kN], diameter [mm]; tolerance: residual of boundary elements."""

    cells: tuple[int, ...] = (16, 32, 64)
    crowns: tuple[float, ...] = (0.08, 0.13, 0.2, 0.3, 0.46, 0.8, 1.2)
    load: float = 50.0
    diameter: float = 920.0
    tolerance: float = 1e-8

    @property
    def wheel(self) -> RailWheel:
        return RailWheel(self.load, self.diameter)


@dataclass(frozen=True, kw_only=True)
class PublishedContact:
    """The example of CONTACT on a grid."""

    cells: int
    tolerance: float
    force: float = 100e3

    @property
    def modulus(self) -> float:
        """E* = G / (1 - nu) of two equal bodies [Pa]."""
        return 82e9 / (1 - 0.28)

    @property
    def radii(self) -> tuple[float, float]:
        """1 / (2 A) along, 1 / (2 B) across [m]."""
        along, across = (1e-3 / (2 * curvature) for curvature in CURVATURES)
        return along, across


@dataclass(frozen=True)
class EllipseResult:
    """Approach [mm] and largest pressure [MPa] of boundary elements, by cells."""

    case: Ellipse
    found: dict[int, Outcome]


def press_ellipse(problem: PublishedContact) -> Outcome:
    """Boundary elements on a flat strip; an odd number of columns puts a cell under the deepest point."""
    smooth = elliptic_contact(problem.radii, modulus=problem.modulus, force=problem.force)
    spacing = smooth.along / problem.cells
    shape = tuple(2 * round(STRIP / 2 * axis / spacing) + 1 for axis in (2 * smooth.along, 2 * smooth.across))
    track = bem3d.Track(height=np.zeros(shape), spacing=spacing, radius=problem.radii, modulus=problem.modulus)
    wheel = bem3d.RollingContact(track, tolerance=problem.tolerance)
    found = wheel.carry(0, problem.force)
    return {
        APPROACH: np.array(1e3 * found.approach),
        PRESSURE: np.array(1e-6 * wheel.pressure()[2].max() if found.converged else math.nan),
        "failed": np.array(float(not found.converged)),
    }


def run(case: Ellipse, engine: Engine = SERIAL) -> EllipseResult:
    """Press on every grid. Raises NotConvergedError where one does not converge."""
    problems = [PublishedContact(cells=n, tolerance=case.tolerance) for n in case.cells]
    found = dict(zip(case.cells, engine.map(press_ellipse, problems), strict=True))
    if lost := [f"{n} cells to the semi-axis" for n, one in found.items() if one["failed"]]:
        raise NotConvergedError("a grid of the ellipse has no contact", lost)
    return EllipseResult(case, found)


def evidence(result: EllipseResult) -> Evidence:
    """The example of CONTACT, and the circle over crowns."""
    case = result.case
    grids = _grids(result)
    rows = [row for crown in case.crowns for row in _crown(case, crown)]
    circle = [_worst_of_crown(rows, case, crown, name) for crown in case.crowns for name in ACROSS]
    speeds = [_weighted(case, crown, name) for crown in case.crowns for name in ACROSS]
    contact = [number for number in grids if number.role is Role.CRITERION]
    claims = (answered(CLAIM, contact, _contact_answer(contact)), _circle_claim(circle, case))
    return Evidence(
        title="The ellipse of contact of a wheel with two radii",
        method=(
            "A flat strip is pressed by a body with the two curvatures of the published example, by boundary elements "
            f"with {', '.join(str(n) for n in case.cells)} cells to the semi-axis along. The filter sin S / S of the "
            f"ellipse is compared with that of a circle of the same area, for {case.wheel.label} on crowns of "
            f"{1000 * min(case.crowns):g} to {1000 * max(case.crowns):g} mm, at the levels of ISO 3095:2013, over "
            "ridges and over isotropic ground. Bands count down to the first in which A3 of the ellipse is below "
            f"{COUNTED:g} dB."
        ),
        numbers=(*grids, *circle, *speeds),
        tables=(table_of("crowns", rows), table_of("weighted", _speed_rows(case))),
        conclusions=(),
        claims=claims,
        finding=finding(claims),
        headlines={"ellipse": title(circle_cost(claims[1]))},
        captions={
            "ellipse": (
                f"(a) Semi-axes of the contact of {case.wheel.label} over the crown; dotted: the circle of the same "
                "area. (b) A3 of this circle over that of the ellipse, isotropic ground, bands that count; shaded: "
                "within 1 dB. (c) The same at 16 mm, over the crown, both grounds."
            )
        },
    )


def _grids(result: EllipseResult) -> list[Number]:
    """Closed form and the finest grid beside CONTACT; what the grid leaves is what the next coarser one is off."""
    problem = PublishedContact(cells=1, tolerance=1e-8)
    smooth = elliptic_contact(problem.radii, modulus=problem.modulus, force=problem.force)
    closed = {APPROACH: 1e3 * smooth.approach, PRESSURE: 1e-6 * smooth.pressure}
    coarse, fine = (result.found[n] for n in sorted(result.found)[-2:])
    numbers = []
    for quantity, (reference, unit) in CONTACT.items():
        for model, value, grid in (
            (CLOSED, closed[quantity], 0.0),
            (BEM, float(fine[quantity]), abs(float(fine[quantity] - coarse[quantity])) / 3),
        ):
            numbers.append(
                Number(
                    quantity=quantity,
                    model=model,
                    value=value,
                    reference=reference,
                    source="CONTACT, published example output, four digits",
                    tolerance=DIGITS * reference,
                    reason="2e-4: the fourth digit of what is published",
                    unit=unit,
                    grid=grid,
                )
            )
    return numbers


def circle_excess(case: Ellipse, crown: float, across: StatedAcross) -> tuple[FloatArray, FloatArray]:
    """A3 of the ellipse and of the circle of the same area [dB]."""
    scene = scene_of(case.wheel, crown=crown)
    contact = scene.contact
    radius = float(np.sqrt(contact.along * contact.across))
    circle = replace(contact, along=radius, across=radius)
    return (
        linear_filter(scene, LINEAR, across, contact),
        linear_filter(scene, LINEAR, across, circle),
    )


def _crown(case: Ellipse, crown: float) -> list[dict[str, object]]:
    scene = scene_of(case.wheel, crown=crown)
    rows: list[dict[str, object]] = []
    for name, across in ACROSS.items():
        ellipse, circle = circle_excess(case, crown, across)
        for wave, mine, other, count in zip(scene.levels.bands.nominal, ellipse, circle, counted(ellipse), strict=True):
            rows.append(
                {
                    "crown [mm]": 1000 * crown,
                    "across": name,
                    "a_x [mm]": 1000 * scene.contact.along,
                    "a_y [mm]": 1000 * scene.contact.across,
                    "wavelength [mm]": round(1000 * float(wave), 2),
                    "ellipse [dB]": float(mine),
                    "circle [dB]": float(other),
                    "counted": bool(count),
                }
            )
    return rows


def _worst_of_crown(rows: list[dict[str, object]], case: Ellipse, crown: float, across: str) -> Number:
    """The worst of the bands that count."""
    points = [
        Number(
            quantity=EXCESS,
            where={"crown [mm]": 1000 * crown, "across": across, "wavelength [mm]": row["wavelength [mm]"]},  # type: ignore[dict-item]
            value=row["circle [dB]"] - row["ellipse [dB]"],  # type: ignore[operator]
            reference=0.0,
            source="filter of the ellipse",
            tolerance=1.0,
            reason="1 dB: a tolerance of the field",
            unit="dB",
            role=_role_of(case, crown),
        )
        for row in rows
        if row["crown [mm]"] == 1000 * crown and row["across"] == across and row["counted"]
    ]
    return worst(points, "wavelength [mm]")


def _role_of(case: Ellipse, crown: float) -> Role:
    """An ellipse that is a circle is compared with itself."""
    return Role.IDENTITY if math.isclose(1000 * crown, case.wheel.diameter / 2) else Role.FINDING


def _weighted(case: Ellipse, crown: float, name: str) -> Number:
    """The worst speed."""
    scene = scene_of(case.wheel, crown=crown)
    ellipse, circle = circle_excess(case, crown, ACROSS[name])
    by_speed = weighted_difference(scene, circle, ellipse)
    points = [
        Number(
            quantity="A-weighted level with the circle over that with the ellipse",
            where={"crown [mm]": 1000 * crown, "across": name, "speed [km/h]": speed},
            value=by_speed(speed),
            reference=0.0,
            source="filter of the ellipse",
            tolerance=1.0,
            reason="1 dB: a tolerance of the field",
            unit="dB(A)",
            role=_role_of(case, crown),
        )
        for speed in SPEEDS
    ]
    return worst(points, "speed [km/h]")


def _speed_rows(case: Ellipse) -> list[dict[str, object]]:
    rows: list[dict[str, object]] = []
    for crown in case.crowns:
        scene = scene_of(case.wheel, crown=crown)
        for name, across in ACROSS.items():
            ellipse, circle = circle_excess(case, crown, across)
            by_speed = weighted_difference(scene, circle, ellipse)
            rows.append(
                {"crown [mm]": 1000 * crown, "across": name}
                | {f"{v:g} km/h [dB(A)]": round(by_speed(v), 3) for v in SPEEDS}
            )
    return rows


def _contact_answer(numbers: list[Number]) -> str:
    found = max(abs(number.difference) / number.reference for number in numbers)
    return f"they differ by {found:.1e} of its printed values at the most, of which the fourth digit is 2e-4."


def circle_cost(claim: JudgedClaim) -> str:
    """What a circle costs, at the worst crown that differs."""
    off = farthest_off(claim.numbers)
    return by_status(
        claim,
        holds="a circle of the same area has the filter of the ellipse within 1 dB",
        fails=f"a circle for the ellipse costs {off.value:+.1f} dB on a crown of {off.where['crown [mm]']:g} mm",
        undecided="whether a circle has the filter of the ellipse is open",
    )


def finding(claims: Sequence[JudgedClaim]) -> str:
    return sentence(
        by_status(
            claims[0],
            holds="the closed form and boundary elements give the contact of CONTACT",
            fails="the closed form and boundary elements do not both give the contact of CONTACT",
            undecided="whether both give the contact of CONTACT is open",
        ),
        circle_cost(claims[1]),
    )


def _circle_claim(numbers: list[Number], case: Ellipse) -> JudgedClaim:
    """Limits are crowns about that of a circular contact, at which both are the same and nothing is tested."""
    mine = [number for number in numbers if number.role is not Role.IDENTITY]
    off = max(mine, key=lambda number: abs(number.value))
    circle = case.wheel.diameter / 2
    crowns = sorted((1000 * crown for crown in case.crowns), key=lambda crown: abs(math.log(crown / circle)))
    inside = agreeing_from_the_first([n for n in mine if n.where["crown [mm]"] == crown] for crown in crowns)
    kept = dict.fromkeys(f"{number.where['crown [mm]']:g}" for number in inside)
    return answered(
        CIRCLE,
        mine,
        f"at worst it is {off.value:+.1f} dB off in a band with A3 > {COUNTED:g} dB, on a crown of "
        f"{off.where['crown [mm]']:g} mm, {off.where['across']}, at {off.where['worst at']:g} mm.",
        limits=f"crowns of {', '.join(kept)} mm" if kept else "",
        inside=inside,
    )


CASE = Case(
    name="ellipse",
    chapter=Chapter.RAIL,
    place=1,
    claim=CLAIM,
    answers="The contact of a wheel with two radii, and what a circle in its place costs",
    quick=Ellipse(),
    full=Ellipse(cells=(16, 32, 64, 128)),
    run=run,
    evidence=evidence,
    needs="closed form",
)
