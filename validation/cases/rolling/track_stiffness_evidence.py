"""What the stiffness along a track shows: numbers, tables, sentences, and the case of the report."""

import math
from collections.abc import Sequence

import numpy as np

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.difference import difference
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Role, Table, Verdict, numbers_with, table_of
from validation.analysis.over_range import root_mean_square, worst
from validation.analysis.statistics import (
    POWER_DECIBEL,
    Estimate,
    extrapolated,
    jackknife_error,
    log_ratio_of_means,
)
from validation.analysis.wording import by_status, farthest_off, share
from validation.cases.rolling import settings
from validation.cases.rolling.claims import from_to
from validation.cases.rolling.track_stiffness import FloatArray, TrackStiffness, TrackStiffnessResult, run
from validation.engine.engine import Outcome
from validation.simulation.track_spectrum import INPUT_NAMES as NAMES
from validation.simulation.track_spectrum import INPUT_SPECTRA, InputSpectrum

THREE_DECIBELS, FORD_THOMPSON = settings.THREE_DECIBELS.tolerance, settings.THREE_DECIBELS.reason
(ONE_DECIBEL, REPEATABLE), RMS = settings.ONE_DECIBEL, "rms of "
MEAN, DEVIATION = "mean stiffness", "relative deviation of stiffness"
LEVEL = "level of stiffness in a one-third octave"
PUNCH, PROFILE, WHEEL = "punch, bem3d", "punch, springs", "wheel, bem3d"
PUNCH_OVER_WHEEL = "punch over wheel, bem3d"
ROWS = {MEAN: np.array([0.0, 1.0]), DEVIATION: np.array([0.5, -1.0])}
"""Weights of ln of the mean variance and of ln of the mean."""
ROUNDING = 1e-9
"""A relative deviation below is none: all springs touch."""
CLAIM = (
    "Along a track under constant load, springs with Geike's spectrum have the fluctuation of stiffness of boundary "
    "elements."
)


def over(rule: InputSpectrum) -> str:
    return f"springs with {NAMES[rule]} over bem3d"


def statistic(quantity: str, outcome: Outcome, other: Outcome | None = None) -> Estimate:
    """ln of the mean stiffness, or of its relative deviation, along tracks; or of what it is over another's."""
    mine, reference = (np.stack([one["variance"], one["mean"]], axis=1) for one in (outcome, other or outcome))
    return log_ratio_of_means(mine, reference if other else np.ones(2), ROWS[quantity])


def of_bem(result: TrackStiffnessResult, quantity: str, force: float) -> tuple[Estimate, float]:
    """The same of boundary elements on cells of no size, and the half-width that the grid leaves."""
    coarse, fine = result.bem[force], result.refined[force]
    same = {name: values[: len(fine["mean"])] for name, values in coarse.items()}
    return extrapolated(statistic(quantity, coarse), statistic(quantity, fine, same))


def of_punches(stiffness: FloatArray, quantity: str) -> Estimate:
    """The same over punches, with its jackknife error."""
    known = stiffness[np.isfinite(stiffness)]
    without = np.array([np.delete(known, i) for i in range(known.size)])

    def log(values: FloatArray) -> FloatArray:
        mean = values.mean(axis=-1)
        value = mean if quantity == MEAN else np.maximum(values.std(axis=-1, ddof=1) / mean, ROUNDING)
        return np.asarray(np.log(value))

    return Estimate(float(log(known)), float(jackknife_error(log(without))), known.size)


def evidence(result: TrackStiffnessResult) -> Evidence:
    """Springs beside boundary elements along tracks; the punches of Fig. 14.1 beside both."""
    case = result.case
    numbers = [number for force in case.forces for number in _at_force(result, force)]
    moments, bands = _moments(result), _bands(result)
    claims = _claims(case, numbers)
    return Evidence(
        title="Stiffness along a track at constant load: from Fig. 14.1 to rolling",
        method=(
            f"A wheel rolls under a constant force over {case.strips} isotropic surfaces, H = {case.hurst:g}, whose "
            f"longest wave is the diameter L = 2 a of the smooth contact and whose shortest is L / {case.waves}, as on "
            "the punches of Fig. 14.1. At each position the stiffness is dF/dd of boundary elements at a constant "
            f"contact area, {case.cells} cells to a radius, {case.refined} surfaces again with {2 * case.cells}; and "
            f"that of the springs in contact, {case.tracks} tracks with each of three input spectra. Beside them: "
            f"{case.surfaces} punches of side L with the same roughness on {8 * case.waves}² cells, and "
            f"{case.profiles} profiles, at the same Fbar = F / (E* h L)."
        ),
        numbers=tuple(numbers),
        tables=(moments, bands),
        conclusions=(),
        claims=claims,
        finding=f"{headline(claims)}.",
        headlines={"track_stiffness": headline(claims)},
        captions={
            "track_stiffness": (
                "(a) Mean stiffness over 2 E* a of a wheel, and over E* L of punches, over Fbar. (b) Relative "
                "deviation, along the track and from punch to punch. Filled: boundary elements; open: springs; 95 %. "
                "(c) Level of the stiffness, springs of Geike's spectrum over boundary elements, dark to light: Fbar; "
                "shaded: within 3 dB."
            )
        },
        unconverged=result.unconverged,
        page_tables=(moments,),
    )


def _at_force(result: TrackStiffnessResult, force: float) -> list[Number]:
    numbers, together = [], len(result.case.forces) * len(INPUT_SPECTRA)
    for rule in INPUT_SPECTRA:
        springs = result.springs[force, rule]
        for quantity in (MEAN, DEVIATION):
            bem, grid = of_bem(result, quantity, force)
            apart = statistic(quantity, springs).minus(bem)
            numbers.append(_relative(quantity, over(rule), force, apart, grid, together))
        numbers += _levels(result, force, rule)
    bem, grid = of_bem(result, DEVIATION, force)
    punch = of_punches(result.punches[force], DEVIATION)
    return [*numbers, _relative(DEVIATION, PUNCH_OVER_WHEEL, force, punch.minus(bem), grid, together)]


def _relative(quantity: str, model: str, force: float, apart: Estimate, grid: float, among: int) -> Number:
    """exp(x) - 1 of the difference x of two logarithms; among: numbers whose intervals hold at once."""
    ratio = math.exp(apart.value)
    return Number(
        quantity=quantity,
        model=model,
        where={"Fbar": force},
        value=ratio - 1,
        reference=0.0,
        source="bem3d along the track, extrapolated",
        tolerance=0.1,
        reason="10 %: the margin of Fig. 14.1",
        grid=ratio * grid,
        sample=ratio * apart.half_width_among(among),
        role=Role.FINDING,
    )


def _levels(result: TrackStiffnessResult, force: float, rule: InputSpectrum) -> list[Number]:
    """Worst one-third octave, and root mean square over all; intervals hold at once for all forces."""
    centres, together = result.case.bands.centres, 2 * len(result.case.forces)

    def points(among: int) -> list[Number]:
        return [
            difference(
                level_of(result.springs[force, rule], weights),
                bem,
                quantity=LEVEL,
                model=over(rule),
                where={"Fbar": force, "q a": float(q)},
                source="bem3d along the track, extrapolated",
                tolerance=THREE_DECIBELS,
                reason=FORD_THOMPSON,
                grid=grid,
                among=among,
            )
            for q, weights in zip(centres, np.eye(centres.size), strict=True)
            for bem, grid in [bem_level(result, force, weights, among)]
        ]

    return [
        worst(points(centres.size * together), "q a"),
        root_mean_square(points(together), "q a", ONE_DECIBEL, REPEATABLE),
    ]


def level_of(outcome: Outcome, weights: FloatArray) -> Estimate:
    return log_ratio_of_means(outcome["level"], np.ones(weights.size), weights)


def bem_level(result: TrackStiffnessResult, force: float, weights: FloatArray, among: int) -> tuple[Estimate, float]:
    coarse, fine = result.bem[force]["level"], result.refined[force]["level"]
    return extrapolated(
        level_of(result.bem[force], weights), log_ratio_of_means(fine, coarse[: len(fine)], weights), among
    )


def _claims(case: TrackStiffness, numbers: list[Number]) -> tuple[JudgedClaim, ...]:
    def of(model: str, *quantities: str) -> list[Number]:
        return [n for n in numbers if n.model == model and n.quantity in quantities]

    geike = over("geike")
    levels = of(geike, LEVEL, RMS + LEVEL)
    rms = numbers_with(levels, RMS + LEVEL)
    others = [n for rule in INPUT_SPECTRA if rule != "geike" for n in of(over(rule), DEVIATION)]
    return (
        answered(CLAIM, of(geike, DEVIATION), f"the relative deviation is {_percent(of(geike, DEVIATION))}."),
        answered(
            "Along a track under constant load, springs with Geike's spectrum have the mean stiffness of boundary "
            "elements.",
            of(geike, MEAN),
            f"the mean is {_percent(of(geike, MEAN))}.",
        ),
        answered(
            "Springs with Geike's spectrum have the level of the stiffness in each one-third octave.",
            levels,
            f"the rms over bands is {from_to([n.value for n in rms], signed=False)} dB, the worst band of a force is "
            f"{from_to([n.value for n in numbers_with(levels, LEVEL)])} dB off.",
        ),
        answered(
            "The line trace or the rolling-equivalent spectrum mends the fluctuation of stiffness.",
            others,
            "; ".join(
                f"with the {NAMES[rule]} the relative deviation is {_percent(of(over(rule), DEVIATION))}"
                for rule in INPUT_SPECTRA
                if rule != "geike"
            )
            + ".",
        ),
        answered(
            "The fluctuation of stiffness along a track is that from punch to punch of Fig. 14.1 at the same Fbar.",
            of(PUNCH_OVER_WHEEL, DEVIATION),
            f"from punch to punch it is {_percent(of(PUNCH_OVER_WHEEL, DEVIATION))}, for Fbar up to "
            f"{case.forces[-1]:g}.",
        ),
    )


def _percent(numbers: Sequence[Number]) -> str:
    """At the force where it is farthest off, and how many forces are within the margin."""
    off = farthest_off(numbers)
    return (
        f"{100 * off.value:+.0f} ± {100 * off.uncertainty:.0f} % off at worst, at Fbar = {off.where['Fbar']:g} "
        f"({share(numbers, Verdict.AGREE)} agree)"
    )


def headline(claims: Sequence[JudgedClaim]) -> str:
    """The fluctuation and the mean along the track."""

    def said(claim: JudgedClaim) -> str:
        off = farthest_off(claim.numbers)
        at = f"{100 * off.value:+.0f} ± {100 * off.uncertainty:.0f} % off at Fbar = {off.where['Fbar']:g}"
        return by_status(claim, holds="within 10 %", fails=at, undecided="open within 10 %")

    return f"Springs along the track: fluctuation {said(claims[0])}, mean {said(claims[1])}"


def _moments(result: TrackStiffnessResult) -> Table:
    """A row a force and model: mean and relative deviation, with their half-widths."""
    rows: list[dict[str, object]] = []
    for force in result.case.forces:
        bem = {quantity: of_bem(result, quantity, force) for quantity in ROWS}
        found: dict[str, dict[str, tuple[Estimate, float]]] = {WHEEL: bem}
        for rule in INPUT_SPECTRA:
            found[f"wheel, springs with {NAMES[rule]}"] = {
                quantity: (statistic(quantity, result.springs[force, rule]), 0.0) for quantity in ROWS
            }
        for model, stiffness in ((PUNCH, result.punches[force]), (PROFILE, result.profiles[force])):
            found[model] = {quantity: (of_punches(stiffness, quantity), 0.0) for quantity in ROWS}
        for model, estimates in found.items():
            row: dict[str, object] = {"Fbar": force, "h/d": round(result.case.height(force), 4), "model": model}
            for quantity, (estimate, grid) in estimates.items():
                value = math.exp(estimate.value)
                row[quantity] = round(value, 5)
                row[f"± {quantity}"] = round(value * (grid + estimate.half_width), 5)
            rows.append(row)
    return table_of("moments", rows)


def _bands(result: TrackStiffnessResult) -> Table:
    """A row a force and band: springs over boundary elements [dB]."""
    rows: list[dict[str, object]] = []
    centres = result.case.bands.centres
    for force in result.case.forces:
        for q, weights in zip(centres, np.eye(centres.size), strict=True):
            bem, grid = bem_level(result, force, weights, 1)
            row: dict[str, object] = {"Fbar": force, "q a": float(q), "bem3d [dB]": POWER_DECIBEL * bem.value}
            for rule in INPUT_SPECTRA:
                apart = level_of(result.springs[force, rule], weights).minus(bem)
                row[f"{NAMES[rule]} [dB]"] = POWER_DECIBEL * apart.value
                row[f"{NAMES[rule]} ± [dB]"] = POWER_DECIBEL * (grid + apart.half_width)
            rows.append(row)
    return table_of("bands", rows)


CASE = Case(
    name="track_stiffness",
    chapter=Chapter.ROLLING,
    place=6,
    claim=CLAIM,
    answers="Fluctuation of stiffness along a track: the link from Fig. 14.1 to rolling",
    quick=TrackStiffness(cells=6, strips=4, tracks=20),
    full=TrackStiffness(
        forces=(0.3, 1.0, 3.0, 10.0),
        length=32,
        width=12,
        strips=8,
        refined=6,
        tracks=60,
        surfaces=100,
        profiles=2000,
    ),
    run=run,
    evidence=evidence,
    needs="boundary elements",
)
