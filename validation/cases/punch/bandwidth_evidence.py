"""Whether the answer of Fig. 14.1 depends on bandwidth, on a roll-off and on the size: claims, tables and sentences."""

import math
from collections.abc import Sequence

import numpy as np

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Table, Verdict, numbers_with, table_of
from validation.analysis.statistics import DECIBEL, Estimate
from validation.analysis.wording import by_status, farthest_off, sentence, share
from validation.cases.punch.bandwidth import Bandwidth, BandwidthResult, run
from validation.cases.punch.bandwidth_levels import MEAN, STATISTICS, BandwidthLevels, levels
from validation.cases.punch.bandwidth_numbers import (
    BANDWIDTH,
    BEM,
    CHANGE,
    FIT,
    FIT_RANGE,
    FORCE,
    MDR,
    ROLL_OFF,
    SIZE,
    STIFFNESS,
    fitted,
    numbers_of,
)
from validation.cases.punch.ensembles import Row, interval_columns
from validation.engine.engine import Outcome
from validation.selection import model_needed
from validation.simulation.rough_punch import require_converged

CLAIM = "What Fig. 14.1 says of MDR beside boundary elements does not depend on bandwidth."
CLAIM_ROLL_OFF = "What Fig. 14.1 says of MDR beside boundary elements does not depend on a roll-off."
CLAIM_SIZE = "The fluctuation of Fig. 14.1 does not depend on how many of its longest waves the punch holds."
CLAIM_FIT = "The fit 1/kbar = 1/1.1523 + 0.48/Fbar has the mean stiffness within 6 % for Fbar from 0.32 to 10."
CLAIM_MDR = "MDR has the mean stiffness within 6 % for Fbar from 0.32 to 10."


def evidence(result: BandwidthResult) -> Evidence:
    """Raises NotConvergedError where too few surfaces have converged at one of the forces."""
    case = result.case
    pairs = [outcome for pair in result.pairs for outcome in pair]
    require_converged((result.narrow, result.refined, result.rolled_off, *pairs), result.unconverged)
    found = {quantity: levels(result, quantity) for quantity in STATISTICS}
    numbers = numbers_of(case, found)
    claims = _claims(numbers)
    return Evidence(
        title="Bandwidth, roll-off and size: does the answer of Fig. 14.1 depend on them?",
        method=_method(case),
        numbers=tuple(numbers),
        claims=claims,
        finding=finding(claims),
        headlines={"bandwidth": headline(claims)},
        tables=(_curves(case, found),),
        page_tables=(_over_bem(case, found), _fit(case, found[MEAN])),
        conclusions=(_cost(result),),
        captions={
            "bandwidth": (
                f"H = {case.hurst:g}. (a) Mean stiffness over that of boundary elements: MDR at each bandwidth, with "
                "and without a roll-off, and the fit; 95 %. (b) Relative deviation, MDR over bem3d. (c) Relative "
                "deviation itself: symbols, boundary elements; lines, MDR."
            )
        },
        unconverged=result.unconverged,
    )


def _method(case: Bandwidth) -> str:
    pairs = " and ".join(
        f"{n} surfaces of q_max / q_min = {b}" for n, b in zip(case.pairs, case.bandwidths[1:], strict=True)
    )
    return (
        f"Punches as in Fig. 14.1, H = {case.hurst:g}, longest wave L, q_max / q_min = "
        f"{', '.join(map(str, case.bandwidths))}, each on four cells to its shortest wave. Boundary elements press "
        f"{case.surfaces} surfaces of the narrowest band. They press {pairs} both in that band and in the one before, "
        "with the same long waves. The narrowest band and these changes add up to the widest. With a roll-off: "
        f"{case.rolled_off} surfaces whose spectrum is constant up to q_r = {case.roll_off} · 2π/L and the narrowest "
        f"band beyond. {case.profiles} profiles of {case.points} springs in each band, all with the same long waves. "
        f"Intervals by the jackknife and Student's t. Grid: {case.refined} surfaces of the narrowest band on twice as "
        "many cells a side; wider bands have as many cells to a wave and more to a contact, and are taken to err by no "
        "more."
    )


def _claims(numbers: Sequence[Number]) -> tuple[JudgedClaim, ...]:
    changes = [n for n in numbers if n.quantity.startswith(CHANGE)]
    sizes = [n for n in numbers if n.quantity.startswith(SIZE)]
    return (
        _judged(CLAIM, "from one bandwidth to the next", [n for n in changes if BANDWIDTH in n.where]),
        _judged(CLAIM_ROLL_OFF, "with the roll-off", [n for n in changes if ROLL_OFF in n.where]),
        answered(CLAIM_SIZE, sizes, _of_size(sizes)),
        *(
            _of_stiffness(claim, mine)
            for claim, model in ((CLAIM_FIT, FIT), (CLAIM_MDR, MDR))
            if (mine := numbers_with(numbers, STIFFNESS, model))
        ),
    )


def headline(claims: Sequence[JudgedClaim]) -> str:
    """What may change MDR over boundary elements."""
    return f"MDR over boundary elements: bandwidth {_effect(claims[0])}, roll-off {_effect(claims[1])}"


def finding(claims: Sequence[JudgedClaim]) -> str:
    return sentence(headline(claims), f"the fluctuation itself: size of the punch {_effect(claims[2])}")


def _effect(claim: JudgedClaim) -> str:
    return by_status(claim, holds="changes nothing", fails="changes it", undecided="open")


def _judged(claim: str, subject: str, numbers: Sequence[Number]) -> JudgedClaim:
    """With the Fbar from which on all decades agree, if there is one with numbers of both quantities."""
    starts = sorted({_ends(n)[0] for n in numbers})
    inside = next((_from(numbers, first) for first in starts if _all_agree(_from(numbers, first))), [])
    quantities = {n.quantity for n in inside}
    whole = len(inside) == len(numbers) or len(quantities) < len(STATISTICS)
    answer = "; ".join(f"in {quantity} {_worst_decade(numbers, quantity)}" for quantity in STATISTICS)
    return answered(
        claim,
        numbers,
        f"{subject} MDR over boundary elements changes {answer}.",
        limits="" if whole else f"Fbar from {_ends(inside[0])[0]:g} on",
        inside=() if whole else inside,
    )


def _worst_decade(numbers: Sequence[Number], quantity: str) -> str:
    """By how much at worst, and how many of its decades are within the tolerance."""
    mine = numbers_with(numbers, f"{CHANGE}, {quantity}")
    return f"by {_per_cent(farthest_off(mine))} at worst ({share(mine, Verdict.AGREE)} agree)"


def _from(numbers: Sequence[Number], first: float) -> list[Number]:
    return [n for n in numbers if _ends(n)[0] >= first]


def _all_agree(numbers: Sequence[Number]) -> bool:
    return all(n.verdict is Verdict.AGREE for n in numbers)


def _ends(number: Number) -> tuple[float, float]:
    ends = number.where[FORCE]
    if not isinstance(ends, tuple):
        raise TypeError(f"{FORCE} of {number.label!r} must be a range, got {ends!r}")
    return ends


def _largest(numbers: Sequence[Number]) -> Number:
    return max(numbers, key=lambda n: abs(n.value))


def _per_cent(number: Number) -> str:
    """A ratio in decibels with its interval, and where it was found."""
    ratio, half = number.value / DECIBEL, number.uncertainty / DECIBEL
    middle, low, high = (f"{100 * math.expm1(value):+.1f}" for value in (ratio, ratio - half, ratio + half))
    return f"{middle} % ({low} to {high}) at Fbar = {number.where['worst at']:.2g}"


def _of_size(numbers: Sequence[Number]) -> str:
    """The largest change of each method that differs, else of all."""
    found = []
    for model in (BEM, MDR):
        mine = [n for n in numbers if n.model == model]
        found.append(f"{model} by {_per_cent(_largest([n for n in mine if n.verdict is Verdict.DIFFER] or mine))}")
    return f"with {numbers[0].where[ROLL_OFF]:g} of them on a side it changes in {' and in '.join(found)}."


def _of_stiffness(claim: str, numbers: Sequence[Number]) -> JudgedClaim:
    """Perhaps true without a roll-off alone."""
    plain, rolled_off = ([n for n in numbers if name in n.where] for name in (BANDWIDTH, ROLL_OFF))
    limited = _all_agree(plain) and not _all_agree(rolled_off)
    return answered(
        claim,
        numbers,
        f"at worst it is off by {_per_cent(_largest(plain))} of {len(plain)} bandwidths without a roll-off, and by "
        f"{_per_cent(_largest(rolled_off))} with one.",
        limits="without a roll-off" if limited else "",
        inside=plain if limited else (),
    )


def _cost(result: BandwidthResult) -> str:
    """Of one load path, in cells times operator applications."""
    case = result.case
    outcomes = [result.narrow, *(wider for _, wider in result.pairs)]
    work = [_work(outcome, 4 * b) for outcome, b in zip(outcomes, case.bandwidths, strict=True)]
    times = ", ".join(f"{w / work[0]:.0f} on {4 * b}²" for w, b in zip(work[1:], case.bandwidths[1:], strict=True))
    return (
        f"Cost: a load path on {case.cells}² cells takes {work[0] / case.cells**2:.0f} operator applications. In cells "
        f"times applications it takes so many times as much on wider bands: {times}. The widest band therefore has few "
        "surfaces of its own, and rests on the long waves that it shares with the one before."
    )


def _work(outcome: Outcome, cells: int) -> float:
    applications = outcome["applications"] + outcome["frozen applications"]
    return float(cells**2 * np.nansum(applications, axis=1).mean())


def _curves(case: Bandwidth, found: dict[str, BandwidthLevels]) -> Table:
    return table_of("curves", [row for level in range(len(case.forces)) for row in _rows(case, found, level)])


def _rows(case: Bandwidth, found: dict[str, BandwidthLevels], level: int) -> list[Row]:
    """A row a bandwidth, and one for the roll-off."""
    rows = []
    kinds = [(float(b), 1.0) for b in case.bandwidths]
    kinds.append((float(case.roll_off * case.bandwidths[0]), float(case.roll_off)))
    for i, (bandwidth, roll_off) in enumerate(kinds):
        row: Row = {BANDWIDTH: bandwidth, ROLL_OFF: roll_off, FORCE: case.forces[level]}
        for quantity, of in found.items():
            plain = i < len(case.bandwidths)
            bem = of.bem[i] if plain else of.bem_rolled_off
            springs = of.springs[i] if plain else of.springs_rolled_off
            row |= interval_columns(f"bem3d {quantity}", bem[level], math.exp)
            row |= interval_columns(f"mdr {quantity}", springs[level], math.exp)
            row |= interval_columns(f"mdr over bem3d {quantity}", springs[level].minus(bem[level]), math.exp)
        row["fit over bem3d mean stiffness"] = fitted(case)[level] / row["bem3d mean stiffness"]
        rows.append(row)
    return rows


def _over_bem(case: Bandwidth, found: dict[str, BandwidthLevels]) -> Table:
    """On the page: MDR over boundary elements, in per cent."""
    rows = []
    for quantity, of in found.items():
        for level, force in enumerate(case.forces):
            row: dict[str, object] = {"quantity": quantity, FORCE: f"{force:.2g}"}
            for bandwidth, one in zip(case.bandwidths, of.over_bem, strict=True):
                row[f"{BANDWIDTH} = {bandwidth}"] = _cell(one[level])
            row[f"{ROLL_OFF} = {case.roll_off}"] = _cell(of.over_bem_rolled_off[level])
            rows.append(row)
    return table_of("MDR over boundary elements, % (95 % interval)", rows)


def _cell(found: Estimate) -> str:
    if not math.isfinite(found.error):
        return "no scatter in MDR" if found.value == -math.inf else "–"
    middle, low, high = (f"{100 * math.expm1(value):+.1f}" for value in found.interval)
    return f"{middle} ({low} to {high})"


def _fit(case: Bandwidth, of: BandwidthLevels) -> Table:
    """On the page: how good the fit is, and MDR."""
    names = [*(f"{BANDWIDTH} = {b}" for b in case.bandwidths), f"{ROLL_OFF} = {case.roll_off}"]
    kinds = list(zip(names, [*of.springs, of.springs_rolled_off], [*of.bem, of.bem_rolled_off], strict=True))
    rows = []
    for level, (force, fit) in enumerate(zip(case.forces, fitted(case), strict=True)):
        if force >= FIT_RANGE[0]:
            row: dict[str, object] = {FORCE: f"{force:.2g}"}
            for name, springs, bem in kinds:
                off = [100 * math.expm1(value - bem[level].value) for value in (math.log(fit), springs[level].value)]
                row[name] = f"{off[0]:+.1f}, {off[1]:+.1f}"
            rows.append(row)
    return table_of("mean stiffness: the fit 1/kbar = 1/1.1523 + 0.48/Fbar, and MDR, over boundary elements, %", rows)


CASE = Case(
    name="bandwidth",
    chapter=Chapter.PRESSED,
    place=4,
    claim=CLAIM,
    answers="Fig. 14.1 at other bandwidths, with a roll-off, and on larger punches; a fit for the mean stiffness",
    quick=Bandwidth(surfaces=60, pairs=(10, 6), refined=15, rolled_off=10),
    full=Bandwidth(
        cells=64,
        wider=(4, 16),
        surfaces=900,
        pairs=(80, 8),
        refined=150,
        rolled_off=50,
        profiles=2000,
        points=4096,
    ),
    run=run,
    evidence=evidence,
    needs=model_needed.punches,
)
