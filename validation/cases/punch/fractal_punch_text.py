"""Fig. 14.1 in words: how it was found, verdicts in per cent, sentences, captions."""

import math
from collections.abc import Sequence

import numpy as np

from validation.analysis.evidence import Number, Table, Verdict, VerdictCell, numbers_with
from validation.analysis.statistics import DECIBEL
from validation.cases.punch.ensembles import Row
from validation.cases.punch.fractal_punch import FractalPunch, FractalPunchResult
from validation.cases.punch.fractal_punch_decades import QUANTITIES, DecadeComparison, numbers_of
from validation.cases.punch.fractal_punch_numbers import PUBLISHED, law_decade
from validation.simulation.rough_punch import BEM, FEW_CELLS, MDR

MAX_SAMPLE = 100.0
"""Times the sample: a verdict that needs more is practically undecidable."""


def method(case: FractalPunch) -> str:
    """How the numbers were found, with the three errors apart."""
    coarser, cells, finer = case.grids
    return (
        f"A rigid square punch of side L, rough from q_min = 2π/L to {cells // 4} q_min, no roll-off, amplitudes fixed "
        f"by the spectrum as in (14.8), so that every draw has its rms height h exactly. {case.surfaces} surfaces of "
        f"{cells}² cells for boundary elements, {case.profiles} profiles of {case.points} springs of Geike's "
        "spectrum, at equal forces; Fbar = F / (E* h L), kbar = k / (E* L). The stiffness is that of the fixed contact "
        "area (3D) and of the springs in contact (1D). Statistics are means over a decade of force (of the deviation: "
        "root mean square). There are three errors. Sample: 95 % interval, bootstrap over realisations. Grid: "
        f"{case.refined} of the surfaces, and up to Fbar = {case.light:g} all of them, with the same band, were "
        f"pressed on {coarser}² and {finer}² cells too. The difference is to boundary elements extrapolated to first "
        "order from the finer two. ± grid is the distance of that to the extrapolation from the coarser two, with the "
        "interval of the change, and the change from half as many springs. The rest is the error of the model. An "
        "undecided verdict names the sample size that would decide it at the same value and grid error. With "
        '"grid error too large" no sample size would: more refined surfaces or finer cells lower that error.'
    )


def captions(case: FractalPunch) -> dict[str, str]:
    interval, few = "95 % interval of the sample", f"open where the mean contact has fewer than {FEW_CELLS} cells"
    circles = f"Circles: boundary elements, {interval}; {few}."
    lines = "Line in a band: MDR with L_1D = L and its interval; dashed: L_1D = 1.1523 L."
    return {
        "fractal_punch": (
            f"Relative standard deviation of the stiffness against force, Fbar = F / (E* h L). (a) {case.surfaces} "
            f"surfaces, three-dimensional boundary elements, {case.cells}² cells; {few}. (b) {case.profiles} "
            "profiles of springs, L_1D = L; lines end where all springs of all profiles are in contact. Intervals: in "
            "the next figure."
        ),
        "fractal_punch-overlay": f"The relative standard deviation, both methods in one panel. {circles} {lines}",
        "fractal_punch-difference": (
            f"Relative deviation of MDR over that of boundary elements. Circles: at each force on {case.cells}² cells, "
            f"{interval}; {few}; ratios below the axis, and ratios to a deviation of zero, are not drawn. Thick: "
            "root mean square over each decade, boundary elements extrapolated to cells of zero size; in the last "
            "decade the lightest forces dominate it. The thin box is the interval of sample and grid. Grey: the "
            "tolerance of 3 %; dotted: 3 dB. = agree, ≠ differ, ? undecided."
        ),
        "fractal_punch-mean": (
            f"Mean stiffness kbar = k / (E* L). {circles} {lines} Dotted: slope 1 / (1 + H), through the boundary "
            "elements at the middle of the forces."
        ),
        "fractal_punch-exponent": (
            f"Local exponent d ln k / d ln F of the mean stiffness, between neighbouring forces. {circles} {lines} "
            f"Dotted: 1 / (1 + H). Grey: the published exponents of fractal dimensions 2 to 3, {PUBLISHED[0]} to "
            f"{PUBLISHED[1]}."
        ),
    }


def matrix(case: FractalPunch, name: str, comparisons: Sequence[DecadeComparison]) -> Table:
    """On the page: a row a Hurst exponent, a column a decade."""
    mine = [c for c in comparisons if c.name == name]
    hursts = list(dict.fromkeys("all" if c.hurst is None else f"{c.hurst:g}" for c in mine))
    decades: dict[str, list[object]] = {}
    for c in mine:
        decades.setdefault(f"Fbar {_decade(c.first)}", []).append(verdict(case, c.number))
    what = "MDR over boundary elements" if QUANTITIES[name].unit == "dB" else "MDR less boundary elements"
    return Table(f"{name}: {what}, with the 95 % interval of sample and grid", {"H": hursts, **decades})


def verdict(case: FractalPunch, number: Number | None) -> str | VerdictCell:
    """The difference in per cent, or as it stands, with its whole interval; the sample that would decide it."""
    if number is None:
        return "no value"
    after = decided_by(case, number) if number.verdict is Verdict.UNDECIDED else ""
    return VerdictCell(_interval(number), number.verdict, after)


def decided_by(case: FractalPunch, number: Number) -> str:
    """How many realisations would decide if value and grid error stayed."""
    needed = number.sample_needed
    if math.isinf(needed):
        return "grid error too large"
    if needed > MAX_SAMPLE:
        return f"needs over {MAX_SAMPLE:.0f} times the sample"
    return f"needs {math.ceil(needed * case.surfaces)} surfaces, {math.ceil(needed * case.profiles)} profiles"


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


def summary(name: str, comparisons: Sequence[DecadeComparison]) -> str:
    """The means over all Hurst exponents; how many of the single comparisons agree, differ, are open; their range."""
    quantity, mine = QUANTITIES[name], [c for c in comparisons if c.name == name]
    means = "; ".join(
        f"{_interval(n)} over Fbar = {_decade(c.first)}: {n.verdict}"
        for c in mine
        if c.hurst is None and (n := c.number) is not None
    )
    singles = numbers_of(c for c in mine if c.hurst is not None)
    verdicts, values = [n.verdict for n in singles], [n.value for n in singles]
    counts = ", ".join(f"{verdicts.count(v)} {v}" for v in Verdict if v in verdicts)
    return (
        f"{name[0].upper()}{name[1:]}, MDR beside boundary elements within "
        f"{_text(quantity.tolerance, quantity.unit).lstrip('+')}. Mean over H: {means}. For single H: "
        f"{counts}; they range from {_text(min(values), quantity.unit)} to {_text(max(values), quantity.unit)}."
    )


def saturation(rows: Sequence[Row]) -> tuple[str, ...]:
    """Where the springs have no fluctuation left and the boundary elements still have."""
    first = {row["H"]: row for row in reversed(rows) if row["mdr relative deviation"] == 0}
    if not first:
        return ()
    found = ", ".join(
        f"H = {h:g} from Fbar = {row['Fbar']:.3g} on ({row['bem3d relative deviation']:.2g})"
        for h, row in sorted(first.items())
    )
    return (
        "Where all springs of all profiles are in contact, MDR has no fluctuation. Boundary elements still have "
        f"the relative deviation in brackets: {found}.",
    )


def cost(result: FractalPunchResult) -> str:
    contacts = np.concatenate([e.bem["applications"].ravel() for e in result.ensembles])
    fixed = np.concatenate([e.bem["frozen applications"].ravel() for e in result.ensembles])
    return (
        f"{contacts.size} contacts with their stiffness on {result.case.cells}² cells took "
        f"{np.mean(contacts + fixed):.1f} operator applications each in the mean, {contacts.mean():.1f} for the "
        f"contact (at most {contacts.max():.0f}) and {fixed.mean():.1f} for the stiffness (at most "
        f"{fixed.max():.0f}), on the smallest window that holds the contact."
    )


def _interval(number: Number) -> str:
    """Value and ends of the whole interval, decibels as per cent."""
    half = number.uncertainty
    middle, low, high = (_text(number.value + end, number.unit) for end in (0.0, -half, half))
    return f"{middle} ({low.removesuffix(' %')} to {high.removesuffix(' %')})"


def _text(value: float, unit: str) -> str:
    return f"{100 * math.expm1(value / DECIBEL):+.0f} %" if unit == "dB" else f"{value:+.3f}"


def _decade(first: float) -> str:
    return f"{first:g} to {10 * first:g}"
