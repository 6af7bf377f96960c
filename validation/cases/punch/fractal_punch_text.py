"""Fig. 14.1 in words: how it was found, verdicts in per cent, sentences, captions."""

import math
from collections.abc import Sequence

import numpy as np

from validation.analysis.evidence import Number, Table, Verdict, VerdictCell, numbers_with
from validation.analysis.statistics import DECIBEL
from validation.cases.punch.ensembles import Row
from validation.cases.punch.fractal_punch import FractalPunch, FractalPunchResult
from validation.cases.punch.fractal_punch_decades import (
    DEVIATION,
    MARGINS,
    NOTHING_LEFT,
    QUANTITIES,
    DecadeComparison,
)
from validation.cases.punch.fractal_punch_numbers import PUBLISHED, law_decade
from validation.simulation.rough_punch import BEM, FEW_CELLS, MDR

MAX_SAMPLE = 100.0
"""Times the sample: a verdict that needs more is practically undecidable."""
NONE_LEFT = "none left"
"""Of a deviation: less than 1 % of that of the other."""


def method(case: FractalPunch) -> str:
    """How the numbers were found, with the three errors apart."""
    plan = "; ".join(
        f"Fbar = {_range(first, last)}: "
        + ", ".join(f"{count} on {cells}²" for cells, count in zip(case.grids, row, strict=True) if count)
        for (first, last), row in zip(case.parts, case.surfaces, strict=True)
    )
    return (
        f"A rigid square punch of side L, rough from q_min = 2π/L to {case.cells // 4} q_min, no roll-off, amplitudes "
        "fixed by the spectrum as in (14.8), so that every draw has its rms height h exactly. Surfaces and profiles "
        "have the same phases for every H, so that sampling noise does not hide the order of the curves. Both are "
        "pressed with equal forces; Fbar = F / (E* h L), kbar = k / (E* L). "
        f"{case.profiles} profiles of Geike's spectrum on {case.points} springs, {case.fine_profiles} of them on twice "
        f"as many. Surfaces, boundary elements: {plan}. "
        f"A grid of {case.cells // 4}² cells lacks the waves shorter than two of its cells; all others have the whole "
        "band. Mean and variance are sums over grids: of all surfaces on the coarsest, and of the changes to the next "
        "finer grid on the surfaces that both have (multilevel Monte Carlo). Both sums are unbiased. The stiffness is "
        "that of the fixed contact area (3D) and of the springs in contact (1D). There are three errors. Sample: "
        "intervals that hold at 95 % for all forces of a decade at once. Grid: boundary elements are extrapolated to "
        "cells of no size, to first order from the two finest grids; ± grid is the distance to the extrapolation from "
        "the next two, with the change from twice the springs. The rest is the error of the model. The verdict of a "
        "decade is that of its worst force; a deviation below 1 % of the other is none left, and counts as 1 % of it. "
        "An undecided verdict says how many times the sample would decide it at the "
        'same value and grid error. With "grid error too large" no sample size would: finer cells lower that error. '
        f"In the figures, boundary elements are extrapolated to cells of no size; symbols are open where the mean "
        f"contact has fewer than {FEW_CELLS} cells."
    )


def captions(case: FractalPunch) -> dict[str, str]:
    few = f"open where the mean contact has fewer than {FEW_CELLS} cells"
    lines = (
        "Circles: boundary elements. Line: MDR, L_1D = L; dashed: L_1D = 1.1523 L. Bars and band: 95 % of the sample."
    )
    most = [max(column) for column in zip(*case.surfaces, strict=True)]
    return {
        "fractal_punch": (
            "Relative standard deviation of the stiffness over Fbar = F / (E* h L); bands: 95 % of the sample. "
            f"(a) Boundary elements, up to {max(most)} surfaces, {few}. (b) {case.profiles} profiles of springs, "
            "L_1D = L; lines end where all springs touch."
        ),
        "fractal_punch-overlay": f"Relative standard deviation of the stiffness over the force. {lines}",
        "fractal_punch-difference": (
            f"Relative deviation of MDR over that of boundary elements. Circles: at each force, {few}. Thick: the "
            "worst force of each decade; box: its interval of sample and grid. Grey: 10 %; dotted: 3 dB. = agree, "
            "≠ differ, ? undecided."
        ),
        "fractal_punch-mean": f"Mean stiffness kbar = k / (E* L) over the force. {lines} Dotted: slope 1 / (1 + H).",
        "fractal_punch-exponent": (
            f"Local exponent d ln k / d ln F of the mean stiffness. {lines} Dotted: 1 / (1 + H). Grey: published, "
            f"{PUBLISHED[0]} to {PUBLISHED[1]}."
        ),
    }


def matrix(name: str, comparisons: Sequence[DecadeComparison]) -> Table:
    """On the page: a row a Hurst exponent, a column a decade."""
    mine = [c for c in comparisons if c.name == name]
    hursts = list(dict.fromkeys("all" if c.hurst is None else f"{c.hurst:g}" for c in mine))
    decades: dict[str, list[object]] = {}
    for c in mine:
        decades.setdefault(f"Fbar {_decade(c.first)}", []).append(verdict(c.number))
    what = "MDR over boundary elements" if QUANTITIES[name].unit == "dB" else "MDR less boundary elements"
    return Table(f"{name}: {what}, with the 95 % interval of sample and grid", {"H": hursts, **decades})


def margins(name: str, comparisons: Sequence[DecadeComparison]) -> Table:
    """On the page: verdicts of all Hurst exponents by their worst force, a row a margin, a column a decade."""
    mine = [c for c in comparisons if c.name == name and c.hurst is not None]
    firsts = list(dict.fromkeys(c.first for c in mine))
    return Table(
        f"{name}: verdicts of single H by the worst force of a decade, at four margins",
        {"within": list(MARGINS)}
        | {
            f"Fbar {_decade(first)}": [
                counts([n for c in mine if c.first == first and (n := c.within(margin)) is not None])
                for margin in MARGINS.values()
            ]
            for first in firsts
        },
    )


def counts(numbers: Sequence[Number]) -> str:
    """Of each verdict: "2 agree, 5 differ"."""
    verdicts = [number.verdict for number in numbers]
    return ", ".join(f"{verdicts.count(v)} {v}" for v in Verdict if v in verdicts) or "no value"


def verdict(number: Number | None) -> str | VerdictCell:
    """The difference in per cent, or as it stands, with its whole interval; the sample that would decide it."""
    if number is None:
        return "no value"
    after = decided_by(number) if number.verdict is Verdict.UNDECIDED else ""
    return VerdictCell(_interval(number), number.verdict, after)


def decided_by(number: Number) -> str:
    """How large a sample would decide if value and grid error stayed."""
    needed = number.sample_needed
    if math.isinf(needed):
        return "grid error too large"
    if needed > MAX_SAMPLE:
        return f"needs over {MAX_SAMPLE:.0f} times the sample"
    return f"needs {math.ceil(10 * needed) / 10:.1f} times the sample"


def plan(case: FractalPunch, rows: Sequence[Row]) -> Table:
    """On the page: surfaces on each grid, beside those that leave the least error for the same work."""
    found = {(row["Fbar from"], row["cells"]): f"{row['surfaces']:.0f} ({row['best']:.2g})" for row in rows}
    return Table(
        "surfaces on each grid, and in brackets those that would leave the least error of the deviation for the same "
        "work, by the variances of this run",
        {"Fbar": [_range(first, last) for first, last in case.parts]}
        | {f"{cells}²": [found.get((first, cells), "") for first, _ in case.parts] for cells in case.grids},
    )


def law_table(case: FractalPunch, laws: Sequence[Number]) -> Table:
    """On the page: exponents beside 1 / (1 + H), a row a Hurst exponent."""

    def column(model: str) -> list[object]:
        return [VerdictCell(f"{n.value:.3f} ± {n.uncertainty:.3f}", n.verdict) for n in numbers_with(laws, model=model)]

    return Table(
        f"exponent of the mean stiffness beside 1 / (1 + H), Fbar = {_decade(law_decade(case))}; published for fractal "
        f"dimensions 2 to 3: {PUBLISHED[0]} to {PUBLISHED[1]}",
        {
            "H": [f"{hurst:g}" for hurst in case.hursts],
            "1 / (1 + H)": [f"{n.reference:.3f}" for n in numbers_with(laws, model=BEM)],
            "boundary elements, extrapolated": column(BEM),
            "MDR, L_1D = L": column(MDR),
        },
    )


def order(rows: Sequence[Row]) -> tuple[str, ...]:
    """Whether the deviation rises or falls with H, force by force."""
    if len(rows) == 0 or not all(math.isfinite(row[f"{BEM} d ln deviation / d H"]) for row in rows):
        return ()
    return tuple(
        f"Order of the curves, {name}: with H the deviation {_order_of(rows, model)}."
        for model, name in ((BEM, "boundary elements"), (MDR, "MDR"))
    )


def _order_of(rows: Sequence[Row], model: str) -> str:
    slope, grid = f"{model} d ln deviation / d H", f"{model} ± grid"
    rising = [row["Fbar"] for row in rows if row[f"{slope} low"] - row[grid] > 0]
    falling = [row["Fbar"] for row in rows if row[f"{slope} high"] + row[grid] < 0]
    known = [row["Fbar"] for row in rows if math.isfinite(row[slope])]
    open_ = [force for force in known if force not in rising and force not in falling]
    groups = (("rises", rising), ("falls", falling), ("has no order that the sample shows", open_))
    return "; ".join(f"{word} at Fbar = {', '.join(f'{f:.2g}' for f in forces)}" for word, forces in groups if forces)


def cost(result: FractalPunchResult, rows: Sequence[Row]) -> tuple[str, str]:
    """Operator applications of a contact; the work beside that of plain sampling."""
    outcomes = [outcome for e in result.ensembles for outcome in e.outcomes[BEM].values()]
    contacts, fixed = (
        np.concatenate([values[np.isfinite(values)] for values in (outcome[name] for outcome in outcomes)])
        for name in ("applications", "frozen applications")
    )
    gains = "; ".join(
        f"{gain['plain over multilevel, relative deviation']:.2g} and "
        f"{gain['plain over multilevel, mean stiffness']:.2g} for Fbar = {_range(first, gain['Fbar to'])}"
        for first, gain in {row["Fbar from"]: row for row in rows}.items()
    )
    return (
        f"{contacts.size} contacts with their stiffness took {np.mean(contacts + fixed):.1f} operator applications "
        f"each in the mean, {contacts.mean():.1f} for the contact (at most {contacts.max():.0f}) and "
        f"{fixed.mean():.1f} for the stiffness (at most {fixed.max():.0f}), on the smallest window that "
        "holds the contact. Where few cells touch, influence coefficients are multiplied instead; they count as the "
        "applications that take as many operations.",
        "Plain sampling on the two finest grids would take so many times the work (cells times operator applications) "
        f"for the same error of the deviation and of the mean: {gains}.",
    )


def _interval(number: Number) -> str:
    """Value and ends of the whole interval, decibels as per cent, and where in the decade."""
    worst = number.where.get("worst at")
    where = "" if worst is None else f" at Fbar = {worst:.2g}"
    if nothing_left(number):
        return f"{NONE_LEFT}{where}"
    half = number.uncertainty
    middle, low, high = (in_words(number.value + end, number.unit) for end in (0.0, -half, half))
    return f"{middle} ({low.removesuffix(' %')} to {high.removesuffix(' %')}){where}"


def nothing_left(number: Number) -> bool:
    """Whether a deviation stands at the floor that is judged in the place of less: it has no interval."""
    return number.quantity.startswith(DEVIATION) and number.value <= DECIBEL * NOTHING_LEFT * (1 - 1e-9)


def in_words(value: float, unit: str) -> str:
    """Decibels as per cent."""
    return f"{100 * math.expm1(value / DECIBEL):+.0f} %" if unit == "dB" else f"{value:+.3f}"


def _decade(first: float) -> str:
    return _range(first, 10 * first)


def _range(first: float, last: float) -> str:
    return f"{first:.2g} to {last:.2g}"
