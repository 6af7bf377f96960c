"""What is claimed of the models of a rough interface, of the punch on it and of MDR on the same roughness."""

import math
from collections.abc import Iterator, Sequence
from functools import partial
from itertools import groupby

from validation.analysis.chart import Curve
from validation.analysis.claim_text import NOT_THIS_CURVE
from validation.analysis.claims import Matrix
from validation.analysis.evidence import Number, Table, Whose, numbers_with
from validation.analysis.number_text import enumeration, per_cent, with_reference
from validation.analysis.series import numbers_of
from validation.analysis.statistics import DECIBEL
from validation.case import Case, Chapter, Chart, Claim, Outcomes, Panel, Study
from validation.cases.punch.ensembles import worked
from validation.cases.punch.interface import (
    AREA_OVER,
    ASPERITIES,
    BARBER,
    BEARING,
    BESIDE_BEM,
    BOUNDED,
    COMPARED,
    CONTACT,
    ENOUGH_WAVES,
    EXPONENT,
    FITTED,
    GAP_OVER,
    GAP_OVER_H,
    KAPPA,
    KAPPA_LIGHT,
    LEFT_OF_CORRECTION,
    OF_HALF,
    OF_SERIES,
    OVER_LOAD,
    PUNCH,
    ROLL_OFF,
    SCALED,
    TAIL,
    UNFITTED,
    VANISHING,
    Interface,
    run,
    series,
)
from validation.simulation import model_needed
from validation.simulation.model_names import BEM
from validation.simulation.model_names import SPRINGS as MDR

SHOWN_WITHIN = 0.1, 0.3
OVER_BEM = " over that of boundary elements"
RANGES = "models within 10 and 30 % of boundary elements"


def error_ends(number: Number) -> tuple[float, float]:
    """The ends of the 95 % interval of an error relative to boundary elements, 0.1 for 10 %."""
    low, high = (number.value + side * number.uncertainty for side in (-1, 1))
    return math.expm1(low / DECIBEL), math.expm1(high / DECIBEL)


def _is_of_many_waves(number: Number) -> bool:
    waves = number.where.get(ROLL_OFF)
    return isinstance(waves, float) and waves >= ENOUGH_WAVES


def _load(number: Number) -> float:
    return float(number.where[CONTACT])  # type: ignore[arg-type]


class RangesOfModels(Matrix):
    """Which model is within 10 and 30 % of boundary elements under which loads, intervals on all grounds included."""

    def table(self, numbers: Sequence[Number]) -> Table:
        within = [f"within {100 * tolerance:g} % at {CONTACT}" for tolerance in SHOWN_WITHIN]
        heads = ("quantity", "model", *within, "lowest error", "highest error")
        rows = [self._row(quantity, model, chosen) for quantity, model, chosen in self._by_model(numbers)]
        return Table(self.name, {head: [row[i] for row in rows] for i, head in enumerate(heads)})

    def _by_model(self, numbers: Sequence[Number]) -> Iterator[tuple[str, str, list[Number]]]:
        """Quantity, model and its numbers on grounds of enough waves."""
        for quantity in COMPARED:
            of_quantity = [n for n in numbers_with(numbers, quantity) if _is_of_many_waves(n)]
            for model in dict.fromkeys(n.model for n in of_quantity):
                yield quantity, model, [n for n in of_quantity if n.model == model]

    @staticmethod
    def _row(quantity: str, model: str, chosen: Sequence[Number]) -> tuple[str, ...]:
        lowest, highest = (pick(chosen, key=lambda n: n.value) for pick in (min, max))
        ranges = (_range_text(chosen, tolerance) for tolerance in SHOWN_WITHIN)
        return (quantity.removesuffix(OVER_BEM), model, *ranges, _error_text(lowest), _error_text(highest))


def _range_text(numbers: Sequence[Number], tolerance: float) -> str:
    """Neighbouring loads under which the intervals of all numbers are within a tolerance: "0.03 to 0.3, 3"."""
    loads = sorted({_load(number) for number in numbers})

    def within(load: float) -> bool:
        ends = [error_ends(number) for number in numbers if _load(number) == load]
        return all(-tolerance <= low and high <= tolerance for low, high in ends)

    runs = [list(run) for inside, run in groupby(loads, key=within) if inside]
    return ", ".join(f"{run[0]:g} to {run[-1]:g}" if len(run) > 1 else f"{run[0]:g}" for run in runs) or "none"


def _error_text(number: Number) -> str:
    return f"{per_cent(number)} at {_load(number):g} %"


def _work(result: Outcomes) -> tuple[Table]:
    case = result.case
    return (worked(case.cells, case.points, [result[PUNCH, 1]]),)


def notes(result: Outcomes) -> list[str]:
    """Direction, size and range of what theory leaves; whether the finite face is why."""
    case, numbers = result.case, numbers_of(series(result))
    said = [_off_text(numbers, *what) for what in SENTENCES]
    lightest = {"H": case.pressed[1], CONTACT: case.per_cent[0]}
    by_size = {n.where[ROLL_OFF]: per_cent(n) for n in numbers_with(numbers, BESIDE_BEM, FITTED, **lightest)}
    if len(by_size) >= MANY:
        errors = enumeration([f"{by_size[size]} at {ROLL_OFF} = {size:g}" for size in sorted(by_size)])
        load = f"{case.per_cent[0]:g} % {CONTACT.removesuffix(' [%]')}"
        said.append(f"At {load}, H = {case.pressed[1]:g}, the stiffness of Persson's theory is off by {errors}.")
    return [sentence for sentence in said if sentence]


def _off_text(numbers: Sequence[Number], quantity: str, model: str, least: float, most: float) -> str:
    """ "Persson's contact area is 28 to 34 % below that of boundary elements from 0.03 to 3 % contact."; else empty."""
    chosen = [n for n in numbers_with(numbers, quantity, model) if _is_of_many_waves(n) and least <= _load(n) <= most]
    if len(chosen) < 2:
        return ""
    lowest, *_, highest = sorted(round(100 * math.expm1(n.value / DECIBEL)) for n in chosen)
    if lowest < 0 < highest:
        size = f"{lowest:+d} to {highest:+d} % relative to"
    else:
        least, most = sorted((abs(lowest), abs(highest)))
        size = f"{least} to {most} % {'above' if highest > 0 else 'below'}"
    loads = [_load(n) for n in chosen]
    what = quantity.removesuffix(OVER_BEM)
    what = "stiffness" if what == "K" else what
    return (
        f"{model}: the {what} is {size} that of boundary elements from {min(loads):g} to {max(loads):g} % "
        f"contact in Persson's theory."
    )


LIGHTEST, LIGHT, HEAVY = 0.03, 3.0, 20.0
SENTENCES = (
    (AREA_OVER, FITTED, LIGHTEST, LIGHT),
    (AREA_OVER, FITTED, LIGHT, HEAVY),
    *((AREA_OVER, model, LIGHTEST, HEAVY) for model in ASPERITIES),
    (AREA_OVER, BEARING, LIGHTEST, HEAVY),
    (GAP_OVER, FITTED, LIGHTEST, HEAVY),
    (BESIDE_BEM, FITTED, LIGHTEST, LIGHT),
    (BESIDE_BEM, FITTED, LIGHT, HEAVY),
    (BESIDE_BEM, TAIL, LIGHTEST, LIGHT),
    (BESIDE_BEM, TAIL, LIGHT, HEAVY),
    (BESIDE_BEM, ASPERITIES[0], LIGHTEST, 1.0),
    (BESIDE_BEM, MDR, LIGHTEST, 0.3),
)
"""Quantity, model and range of loads of each sentence of the notes."""
of_interface = partial(
    Claim, where={ROLL_OFF: lambda waves: waves >= ENOUGH_WAVES}, along="-" + CONTACT, whose=Whose.LITERATURE
)
from_light = partial(of_interface, along=CONTACT, printed=per_cent)
up_to_3 = partial(from_light, where={**of_interface.keywords["where"], CONTACT: lambda load: load <= VANISHING})
MANY = 3
"""Sizes of the face that show whether it matters."""
OF_FIRST = {ROLL_OFF: "first", "H": "first"}
GREENWOOD, BUSH = ASPERITIES
MODELS = {FITTED: "", GREENWOOD: "", BUSH: ""}


def _by_hurst(quantity: str) -> Curve:
    """Boundary elements on the faces of the first number of waves."""
    return Curve(quantity, BEM, "marks", by=("H",), of={ROLL_OFF: "first"}, bars=True, x_factor=1.08)


def _theories(quantity: str, styles: dict[str, str]) -> tuple[Curve, ...]:
    return tuple(Curve(quantity, model, style, of=OF_FIRST) for model, style in styles.items())


STUDY = Study(
    title="Contact area, mean gap and stiffness of a rough interface: the models of the field and boundary elements",
    method=(
        "A rough face of period L is pressed on a periodic half-space: there is no edge, and the approach is that "
        "of the mean planes, the mean gap u its negative. Its PSD is level up to q_r and a power law of H to {c.band} "
        "q_r. K = dp / d(approach) at constant contact area; {c.surfaces} surfaces of each, on four cells to the "
        "shortest wave. Loads are named by the contact that Persson's theory has under them, erf(√2 p / (E* g)), g the "
        "rms gradient. Gap and stiffness are extrapolated to first order from {c.refined} surfaces on twice as many "
        "cells a side; ± grid is half of that correction, with its 95 % interval. The contact area is that of the "
        "finer cells less (π - 1 + ln 2) / 24 of a cell for each side of a cell on its boundary (Yastrebov, Anciaux "
        f"and Molinari 2017); ± grid is {100 * LEFT_OF_CORRECTION:g} % of that. "
        "Persson's theory has the elastic energy of waves in full contact times γ + (1 - γ) P², P the contact "
        "fraction: γ = 1 in 2007, "
        "0.45 by simulations (Yang and Persson 2008). Greenwood and Williamson's asperities have Nayak's moments "
        "(McCool 1986), those of Bush, Gibson and Thomas (1975) all summits with two curvatures, integrated, not their "
        "asymptote; both have the moments of the discrete PSD that is drawn, and no gap below the mean plane. Two "
        "models have the mean gap of boundary elements: the Gaussian tail, K h / p = 1.5 F_1/2(u/h) / F_3/2(u/h), "
        "F_n(t) = ∫ (s - t)^n φ(s) ds over s > t, "
        "and the bearing area. MDR ({c.profiles} profiles of {c.points} springs) has a stiffness alone, here without "
        "its flat punch, 1 / (K L²) = 1 / k - 1 / (E* L), up to contact of 90 % of the springs. The face of "
        "(q_r L / 2π, H) = ({c.pressed:g}) is also that of a square punch of side L under equal forces."
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
        of_interface(quantity=AREA_OVER, model=FITTED, printed=per_cent).saying(
            "Persson's theory gives the true contact area of a rough interface up to 20 % contact.",
            short="The contact area of Persson's theory agrees with that of boundary elements",
            key="persson-area",
        ),
        of_interface(quantity=KAPPA_LIGHT, model=BEM).saying(
            "Up to 3 % contact κ = A E* g / (L² p) is between 1.60 of Persson and 2.51 of Bush, Gibson and Thomas.",
            short="κ agrees with values between those of Persson and of Bush, Gibson and Thomas",
            key="kappa",
        ),
        from_light(quantity=BESIDE_BEM, model=TAIL, whose=Whose.HYPOTHESIS).saying(
            "With the measured mean gap and no parameter, the tail of Gaussian heights gives the stiffness of a rough "
            "interface from 0.03 to 20 % contact.",
            short="The stiffness of the Gaussian tail at the measured gap agrees with that of boundary elements",
            key="tail",
        ),
        up_to_3(quantity=GAP_OVER, model=ASPERITIES).saying(
            "Up to 3 % contact asperities with Nayak's moments, spheres of Greenwood and Williamson or ellipsoids of "
            "Bush, Gibson and Thomas, give the mean gap of a rough interface.",
            short="The mean gap of asperities agrees with that of boundary elements",
            key="asperity-gap",
        ),
        up_to_3(quantity=(AREA_OVER, BESIDE_BEM), model=GREENWOOD).saying(
            "Up to 3 % contact Greenwood and Williamson's asperities, with Nayak's moments, give contact area and "
            "stiffness of a rough interface.",
            short="Greenwood and Williamson's asperities agree with boundary elements",
            key="greenwood-williamson",
        ),
        up_to_3(quantity=(AREA_OVER, BESIDE_BEM), model=BUSH).saying(
            "Up to 3 % contact the elliptic asperities of Bush, Gibson and Thomas give contact area and stiffness of a "
            "rough interface.",
            short="The asperities of Bush, Gibson and Thomas agree with boundary elements",
            key="bush-gibson-thomas",
        ),
        from_light(quantity=BESIDE_BEM, model=MDR, whose=Whose.HYPOTHESIS).saying(
            "MDR, without its flat punch, gives the stiffness of a rough interface; it has no contact area.",
            short="The stiffness of MDR without its flat punch agrees with that of an interface",
            key="mdr",
        ),
        Claim(quantity=BOUNDED, whose=Whose.LITERATURE).saying(
            "The stiffness of every surface is within the bounds of Barber and of convex load paths.",
            short="The stiffness agrees with its bounds",
            key="barber",
        ),
    ),
    charts=(
        Chart("interface", claims=(2, 4)).of(
            "(a) Contact area times E* g over the load, which is κ at light loads. (b) Mean gap over h. (c) "
            "Stiffness K times "
            "h over the load, level where K is proportional to the load. Symbols: boundary elements, bars 95 % "
            "of sample and grid; lines: the models on the first face; dotted: the least K that is possible (Barber). "
            "(d) K of each model over that of boundary elements; grey: within 10 %.",
            Panel(CONTACT, KAPPA, title="contact area").of(_by_hurst(KAPPA), *_theories(KAPPA, MODELS)),
            Panel(CONTACT, GAP_OVER_H, title="mean gap").of(
                _by_hurst(GAP_OVER_H), *_theories(GAP_OVER_H, {**MODELS, UNFITTED: "dashed"})
            ),
            Panel(CONTACT, SCALED, title="stiffness", ylim=(0.0, 6.0)).of(
                _by_hurst(SCALED), *_theories(SCALED, {**MODELS, TAIL: "", MDR: "", BARBER: "dotted"})
            ),
            Panel(
                CONTACT, BESIDE_BEM, title="error of the stiffness", log="xy", shade=(1 / 1.1, 1.1), ylim=(0.2, 2)
            ).of(*_theories(BESIDE_BEM, {**MODELS, TAIL: "", MDR: "", UNFITTED: "dashed"})),
        ),
    ),
    matrices=(
        RangesOfModels(name=RANGES, rows=(), columns=""),
        Matrix(name=EXPONENT, quantity=EXPONENT, rows=(ROLL_OFF, "H"), columns=CONTACT),
        Matrix(name="κ", quantity=KAPPA_LIGHT, rows=(ROLL_OFF, "H"), columns=CONTACT, printed=with_reference),
        Matrix(
            name="load by load",
            quantity=(OVER_LOAD, AREA_OVER, GAP_OVER, BESIDE_BEM, OF_HALF, OF_SERIES),
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
    answers="Contact area, mean gap and stiffness of a rough interface over the load: models of the field and BEM",
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
