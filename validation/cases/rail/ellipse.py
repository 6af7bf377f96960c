"""The smooth contact of a wheel with two radii: a published example, and what a circle in its place costs."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim, Matrix, decibels
from validation.analysis.evidence import Role
from validation.analysis.margins import FIELD
from validation.analysis.series import Margin, Series, Where, only
from validation.analysis.statistics import FloatArray
from validation.analysis.study import Outcomes, Study
from validation.cases.rail import filters
from validation.cases.rail.filters import ACROSS, COUNTED, RailWheel, counted, scene_of
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import SERIAL, Engine
from validation.simulation.exact_contacts import APPROACH, PRESSURE, PublishedContact, press_ellipse
from validation.simulation.model_names import LINEAR
from validation.simulation.rail_strip import StatedAcross


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


def run(case: Ellipse, engine: Engine = SERIAL) -> Outcomes:
    """Press on every grid. Raises NotConvergedError where one does not converge."""
    problems = [PublishedContact(cells=n, tolerance=case.tolerance) for n in case.cells]
    found = dict(zip(case.cells, engine.map(press_ellipse, problems), strict=True))
    if lost := [f"{n} cells to the semi-axis" for n, one in found.items() if one["failed"]]:
        raise NotConvergedError("a grid of the ellipse has no contact", lost)
    return Outcomes(case, found)


CONTACT = {APPROACH: (0.08190, "mm"), PRESSURE: (770.6, "MPa")}
"""Published example output of the program CONTACT for 100 kN, G = 82 GPa, nu = 0.28 on both bodies."""
CLOSED, BEM, CIRCLE = "closed form", "boundary elements", "circle of the same area"
A3, EXCESS, SHORT = "A3", "A3 of a circle over that of the ellipse", "A3 of a circle over that of the ellipse, 16 mm"
WEIGHTED, SEMI_AXIS = "A-weighted level with the circle over that with the ellipse", "semi-axis"
CROWN, GROUND, WAVE, SPEED = "crown [mm]", "across", "wavelength [mm]", "speed [km/h]"
DIGITS = Margin(
    2e-4,
    "2e-4: the fourth digit of what is published",
    relative=True,
    source="CONTACT, published example output, four digits",
    role=Role.CRITERION,
)
OF_ELLIPSE = FIELD.beside("filter of the ellipse")


def series(result: Outcomes) -> list[Series]:
    return [*_published(result), *(one for crown in result.case.crowns for one in _crown(result.case, crown))]


def _published(result: Outcomes) -> Iterator[Series]:
    """Closed form and the finest grid beside CONTACT; what the grid leaves is what the next coarser one is off."""
    smooth = PublishedContact(cells=1, tolerance=1e-8).closed
    closed = {APPROACH: 1e3 * smooth.approach, PRESSURE: 1e-6 * smooth.pressure}
    coarse, fine = (result[n] for n in sorted(result.found)[-2:])
    for quantity, (reference, unit) in CONTACT.items():
        found = float(fine[quantity])
        grid = abs(found - float(coarse[quantity])) / 3
        for model, value, left in ((CLOSED, closed[quantity], 0.0), (BEM, found, grid)):
            yield Series(quantity, model, (value,), reference=reference, grid=left, unit=unit, margin=DIGITS)


def _crown(case: Ellipse, crown: float) -> Iterator[Series]:
    """Over both grounds, in the bands that count and A-weighted; an ellipse that is a circle is beside itself."""
    scene = scene_of(case.wheel, crown=crown)
    along, across = 1000 * scene.contact.along, 1000 * scene.contact.across
    for axis, value in {"a_x, along": along, "a_y, across": across, "sqrt(a_x a_y)": math.sqrt(along * across)}.items():
        yield Series(SEMI_AXIS, axis, (value,), where={CROWN: 1000 * crown}, unit="mm")
    itself = math.isclose(1000 * crown, case.wheel.diameter / 2)
    margin = replace(OF_ELLIPSE, role=Role.IDENTITY) if itself else OF_ELLIPSE
    at = filters.millimetres(scene.levels.bands)
    for name, ground in ACROSS.items():
        where: Where = {CROWN: 1000 * crown, GROUND: name}
        ellipse, circle = circle_excess(case, crown, ground)
        keep, excess = counted(ellipse), circle - ellipse
        in_bands = partial(Series, where=where, along=WAVE, at=at, unit="dB")
        yield in_bands(A3, "ellipse", ellipse)
        yield in_bands(A3, CIRCLE, circle)
        yield in_bands(EXCESS, "", np.where(keep, excess, np.nan), margin=margin, ranges=only(at, keep))
        yield Series(SHORT, "", excess[at == 16], where=where, unit="dB")
        weighted = partial(Series, WEIGHTED, "", where=where, along=SPEED, at=filters.SPEEDS, unit="dB(A)")
        yield weighted(filters.over_in_decibel_a(scene, circle, ellipse), margin=margin)


def circle_excess(case: Ellipse, crown: float, across: StatedAcross) -> tuple[FloatArray, FloatArray]:
    """A3 of the ellipse and of the circle of the same area [dB]."""
    scene = scene_of(case.wheel, crown=crown)
    contact = scene.contact
    radius = float(np.sqrt(contact.along * contact.across))
    circle = replace(contact, along=radius, across=radius)
    return filters.linear_filter(scene, LINEAR, across), filters.linear_filter(scene, LINEAR, across, circle)


STUDY = Study(
    title="The ellipse of contact of a wheel with two radii",
    method=(
        "A flat strip is pressed by a body with the two curvatures of the published example, by boundary elements with "
        "{c.cells} cells to the semi-axis along. The filter sin S / S of the ellipse is compared with that of a circle "
        "of the same area, for {c.wheel.label} on crowns of {c.crowns:g} m, at the levels of ISO 3095:2013, over "
        f"ridges and over isotropic ground. Bands count down to the first with A3 of the ellipse below {COUNTED:g} dB."
    ),
    series=series,
    claims=(
        Claim(quantity=tuple(CONTACT)).saying(
            "Both the closed form and boundary elements give the contact of the program CONTACT.",
            short="Closed form and boundary elements beside the contact of CONTACT",
        ),
        Claim(quantity=EXCESS, printed=decibels).saying(
            "A circle of the same area, sqrt(a_x a_y), has the contact filter of the ellipse within 1 dB.",
            short="A circle of the same area for the ellipse",
        ),
    ),
    charts=(
        Chart("ellipse", claims=(1,)).of(
            "(a) Semi-axes of the contact of {c.wheel.label} over the crown, and the circle of the same area. (b) A3 "
            "of this circle over that of the ellipse, isotropic ground, bands that count; shaded: within 1 dB. (c) The "
            "same at 16 mm, over the crown, both grounds.",
            Panel(CROWN, "semi-axis [mm]", ylim=(0, None), legend="upper left").of(
                Curve(SEMI_AXIS, ("a_x, along", "a_y, across"), by=("model",)),
                Curve(SEMI_AXIS, "sqrt(a_x a_y)", "guide", by=("model",)),
            ),
            Panel(
                WAVE, "circle over ellipse [dB]", shade=(-1, 1), xlim=(11, 140), downward=True, legend="upper left"
            ).of(Curve(EXCESS, of={GROUND: "isotropic ground"}, by=(CROWN,))),
            Panel(CROWN, "circle over ellipse at 16 mm [dB]", shade=(-1, 1), legend="upper right").of(
                Curve(SHORT, by=(GROUND,))
            ),
        ),
    ),
    matrices=(
        Matrix(name=EXCESS, quantity=EXCESS, rows=(CROWN,), columns=GROUND, printed=decibels),
        Matrix(name=WEIGHTED, quantity=WEIGHTED, rows=(CROWN,), columns=GROUND),
    ),
)
CASE = Case(
    name="ellipse",
    chapter=Chapter.RAIL,
    place=1,
    answers="The contact of a wheel with two radii, and what a circle in its place costs",
    quick=Ellipse(),
    full=Ellipse(cells=(16, 32, 64, 128)),
    run=run,
    study=STUDY,
    needs="closed form",
)
