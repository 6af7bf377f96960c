"""What is claimed of the stiffness of a rough interface, of its punch and of MDR on the same roughness."""

from functools import partial

from validation.analysis.chart import by_model
from validation.analysis.claim_text import NOT_THIS_CURVE
from validation.analysis.claims import Matrix
from validation.analysis.evidence import Table, Whose, numbers_with
from validation.analysis.number_text import enumeration, per_cent, times
from validation.analysis.series import numbers_of
from validation.case import Case, Chapter, Chart, Claim, Curve, Outcomes, Panel, Study
from validation.cases.punch.ensembles import worked
from validation.cases.punch.interface import (
    AREA,
    BARBER,
    BESIDE_BEM,
    CONTACT,
    EDGELESS,
    ENOUGH_WAVES,
    EXPONENT,
    FITTED,
    FRACTION,
    GAP,
    GAP_OVER_H,
    OF_HALF,
    OF_SERIES,
    ON_PUNCH,
    OVER_LOAD,
    PUNCH,
    ROLL_OFF,
    SCALED,
    SCALED_PUNCH,
    SERIES,
    UNFITTED,
    Interface,
    run,
    series,
)
from validation.simulation import model_needed
from validation.simulation.model_names import BEM
from validation.simulation.model_names import SPRINGS as MDR
from validation.theory.closed_forms import INTERFACE


def _work(result: Outcomes) -> tuple[Table]:
    case = result.case
    return (worked(case.cells, case.points, [result[PUNCH, 1]]),)


def notes(result: Outcomes) -> list[str]:
    """Whether the finite face is why theory is too soft under light loads."""
    case, numbers = result.case, numbers_of(series(result))
    lightest = {"H": case.pressed[1], CONTACT: case.per_cent[0]}
    by_size = {n.where[ROLL_OFF]: per_cent(n) for n in numbers_with(numbers, BESIDE_BEM, FITTED, **lightest)}
    if len(by_size) < MANY:
        return []
    errors = enumeration([f"{by_size[size]} at {ROLL_OFF} = {size:g}" for size in sorted(by_size)])
    return [f"Under the lightest load, H = {case.pressed[1]:g}, the stiffness of Persson's theory is off by {errors}."]


of_interface = partial(
    Claim, where={ROLL_OFF: lambda waves: waves >= ENOUGH_WAVES}, along="-" + CONTACT, whose=Whose.LITERATURE
)
MANY = 3
"""Sizes of the face that show whether it matters."""
FIRST = {ROLL_OFF: "first", "H": "first"}
LINES = {FITTED: "", UNFITTED: "dashed", BARBER: ""}
STYLES = {EDGELESS: "marks", ON_PUNCH: "marks", SERIES: "dashed", MDR: ""}
STUDY = Study(
    title="The stiffness of a rough interface without edges, and of the same roughness under a punch",
    method=(
        "A rough face of period L is pressed on a periodic half-space: there is no edge, and the approach is that "
        "of the mean planes. Its spectrum is level up to q_r and a power law of H to {c.band} q_r. K = dp / "
        "d(approach) at constant contact area; {c.surfaces} surfaces of each, on four cells to the shortest wave. "
        "Loads are named by the contact that Persson's theory has under them, erf(√2 p / (E* g)), g the rms "
        "gradient. The face of (q_r L / 2π, H) = ({c.pressed:g}) is that of a square punch of side L too, under equal "
        "forces, beside {c.profiles} profiles of {c.points} springs. Values are extrapolated to first order from "
        "{c.refined} surfaces on twice as many cells a side; ± grid is half of that correction, with its 95 % "
        "interval. Persson's elastic energy of waves in full contact has a factor γ + (1 - γ) P², P the contact "
        "fraction: γ = 1 in 2007, 0.45 by simulations (Yang and Persson 2008)."
    ),
    series=series,
    claims=(
        of_interface(quantity=EXPONENT, no=NOT_THIS_CURVE).saying(
            "Up to 10 % contact the normal stiffness of a rough interface is proportional to the load: its exponent is "
            "1.",
            short="The exponent of the stiffness of an interface over the load agrees with 1",
            key="proportional",
        ),
        of_interface(quantity=BESIDE_BEM, model=FITTED, printed=per_cent).saying(
            "Persson's theory, with γ = 0.45, gives the normal stiffness of a rough interface up to 20 % contact.",
            short="The stiffness of Persson's theory agrees with that of boundary elements",
            key="persson",
        ),
        Claim(quantity=(AREA, GAP), differ=True, printed=times).saying(
            "MDR's contact area and mean gap differ from those of a rough punch.",
            short="MDR's contact area and mean gap differ from those of boundary elements",
            key="area-and-gap",
        ),
    ),
    charts=(
        Chart("interface", claims=(0, 1)).of(
            "(a) Stiffness K of the interface times h over the load, level where K is proportional to the load. "
            "Symbols: periodic boundary elements; lines: Persson's theory of the first face; level line: K = "
            "p / (0.48 h), the fit for punches; dotted: the least that is possible, p over the largest height "
            "(Barber). (b) The same of a punch, of its interface in series with the flat punch, and of MDR. (c) "
            "Contact fraction, (d) mean gap over h. Bars: 95 % of sample and grid.",
            Panel(CONTACT, SCALED, title="interface", log="xy", lines=(1 / INTERFACE,)).of(
                Curve(SCALED, BEM, "marks", by=(ROLL_OFF, "H"), bars=True, x_factor=1.06),
                *(Curve(SCALED, model, style, of=FIRST) for model, style in LINES.items()),
            ),
            Panel(CONTACT, SCALED_PUNCH, title="punch", log="xy").of(*by_model(SCALED_PUNCH, STYLES, bars=True)),
            Panel(CONTACT, FRACTION, log="xy").of(*by_model(FRACTION, STYLES, bars=True)),
            Panel(CONTACT, GAP_OVER_H).of(*by_model(GAP_OVER_H, STYLES, bars=True)),
        ),
    ),
    matrices=(
        Matrix(name=EXPONENT, quantity=EXPONENT, rows=(ROLL_OFF, "H"), columns=CONTACT),
        Matrix(
            name="load by load",
            quantity=(OVER_LOAD, BESIDE_BEM, OF_HALF, OF_SERIES),
            rows=("quantity", "model", ROLL_OFF, "H"),
            columns=CONTACT,
            printed=per_cent,
        ),
    ),
    tables=_work,
    notes=notes,
)
CASE = Case(
    name="interface",
    chapter=Chapter.PRESSED,
    place=3,
    answers="Stiffness of a rough interface over the load, beside Persson's theory; contact area and mean gap of MDR",
    quick=Interface(),
    full=Interface(
        grounds=((8, 0.7), (4, 0.7), (16, 0.7), (8, 0.4), (8, 1.0)),
        pressed=(8, 0.7),
        band=8,
        surfaces=48,
        refined=16,
        profiles=500,
    ),
    run=run,
    study=STUDY,
    needs=model_needed.rolled_off,
)
