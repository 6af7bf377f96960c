"""One measured line, the energy mean of parallel lines, and the mean of their heights: what each says of a rail."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from validation.analysis.answers import agreeing_from_the_first, answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Role, Table, numbers_with, table_of
from validation.analysis.over_range import worst
from validation.analysis.spectra import Bands, levels, waves
from validation.analysis.statistics import POWER_DECIBEL, Estimate, jackknifed
from validation.analysis.wording import by_status, decibels, farthest_off
from validation.cases.rail.filters import counted, decibel, linear_filter, scene_of
from validation.cases.rail.published import RailWheel
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.scenes.rail import RailScene
from validation.simulation.equivalent_displacement import LINE, LINEAR, LINEAR_MODELS
from validation.simulation.rail_ground import StatedAcross, line_of, strip_bands, strip_of, structure_of
from validation.simulation.rail_strip import RailStrip, Transfer

FloatArray = NDArray[np.float64]

RIDGES = "ridges"
GROUNDS: dict[str, StatedAcross] = {
    RIDGES: "ridges",
    "alpha = 0.5": 0.5,
    "alpha = 1": 1.0,
    "isotropic ground": "isotropic",
}
ENERGY, HEIGHTS, SCATTER = "energy mean of lines over one line", "mean of heights over one line", "scatter of a level"
FIELD = "1 dB: a tolerance of the field"
WIDER = 2
CELLS = 5
"""To the smaller semi-axis: the bands that count have waves three times as long as it."""
CLAIM = "The mean of the heights of parallel lines has the levels of one line within 1 dB."
CLAIM_ENERGY = "The energy mean of the spectra of parallel lines has the levels of one line within 1 dB."
CLAIM_SCATTER = "Levels from the energy mean of three lines scatter as those of one line do."


@dataclass(frozen=True, kw_only=True)
class LineConvention:
    """lines: parallel ones; spacings: of them [m]; strips: realisations of each ground; load of one wheel [kN],
    diameter [mm]; seed."""

    lines: int = 3
    spacings: tuple[float, ...] = (0.005, 0.010)
    strips: int = 60
    load: float = 50.0
    diameter: float = 920.0
    seed: int = 22

    @property
    def scene(self) -> RailScene:
        return scene_of(RailWheel(self.load, self.diameter))

    @property
    def bands(self) -> Bands:
        return Bands(tuple(strip_bands(self.scene).edges.tolist()))

    def places(self, spacing: float) -> FloatArray:
        """Of the lines across, about the middle [m]."""
        return np.asarray((np.arange(self.lines) - (self.lines - 1) / 2) * spacing)

    def strip(self, ground: str, realisation: int = 0) -> RailStrip:
        """As of the contact filter, and wider: its oblique waves have k_y = 2 pi / width and multiples."""
        strip = strip_of(self.scene, GROUNDS[ground], CELLS, realisation, self.seed)
        return replace(strip, width=WIDER * strip.width)


@dataclass(frozen=True, kw_only=True)
class ParallelLines:
    """One strip of a ground, measured along parallel lines."""

    case: LineConvention
    ground: str
    realisation: int


@dataclass(frozen=True)
class LineConventionResult:
    """Band powers of strips, by ground: (strips, bands), by convention and spacing."""

    case: LineConvention
    found: dict[str, dict[str, FloatArray]]


def measure_lines(problem: ParallelLines) -> Outcome:
    """Band powers of one line, and of both means at each spacing [m^2]."""
    case, strip = problem.case, problem.case.strip(problem.ground, problem.realisation)
    places = {0.0}.union(*(case.places(spacing).tolist() for spacing in case.spacings))
    along = {place: _powers(case, strip, _line_at(place)) for place in places}
    found = {LINE: along[0.0]}
    for spacing in case.spacings:
        found[f"{ENERGY} {spacing:g}"] = np.mean([along[place] for place in case.places(spacing).tolist()], axis=0)
        found[f"{HEIGHTS} {spacing:g}"] = _powers(case, strip, mean_of_lines(case.places(spacing)))
    return found


def _powers(case: LineConvention, strip: RailStrip, transfer: Transfer) -> FloatArray:
    return levels(waves(strip.along_middle(transfer), spacing=strip.spacing), case.bands)


def _line_at(place: float) -> Transfer:
    """H = exp(i k_y y): the line at y in place of the middle one."""
    return lambda along, across: np.exp(1j * across * place)


def mean_of_lines(places: FloatArray) -> Transfer:
    """H = mean of cos(k_y y_j) over lines that lie symmetrically about the middle."""
    return lambda along, across: np.mean([np.cos(across * place) for place in places], axis=0) + 0 * along


def run(case: LineConvention, engine: Engine = SERIAL) -> LineConventionResult:
    """Measure the lines of all strips."""
    groups = {
        ground: [ParallelLines(case=case, ground=ground, realisation=i) for i in range(case.strips)]
        for ground in GROUNDS
    }
    outcomes = engine.map_groups(measure_lines, groups)
    return LineConventionResult(
        case,
        {
            ground: {name: np.array([one[name] for one in found]) for name in found[0]}
            for ground, found in outcomes.items()
        },
    )


def evidence(result: LineConventionResult) -> Evidence:
    """Both means over one line, ground by ground, and their scatter."""
    case = result.case
    pairs = [(ground, spacing) for ground in GROUNDS for spacing in case.spacings]
    numbers = [
        worst(_over_line(result, quantity, ground, spacing), "wavelength [mm]")
        for quantity in (ENERGY, HEIGHTS)
        for ground, spacing in pairs
    ]
    scatter = [_scatter(result, ground, spacing) for ground, spacing in pairs]
    claim = partial(_claim, numbers)
    claims = (claim(CLAIM, HEIGHTS), claim(CLAIM_ENERGY, ENERGY), _scatter_claim(scatter))
    table = _table(result)
    return Evidence(
        title="Which line: one, the energy mean of parallel lines, or the mean of their heights",
        method=(
            f"{case.strips} strips of each ground, whose lines have the levels of ISO 3095:2013, are measured along "
            f"{case.lines} parallel lines, {' or '.join(f'{1000 * s:g}' for s in case.spacings)} mm apart. The levels "
            "of the energy mean of their spectra and of the mean of their heights are compared with those of one "
            "line in the mean of all realisations. The mean of heights is an integral over what lies across; the "
            f"energy mean is found on strips. Bands are those in which the filter of {case.scene.name} counts. "
            "Waves with |k_y| < alpha k_x "
            "lie between ridges and isotropic ground."
        ),
        numbers=(*numbers, *scatter),
        tables=(table,),
        conclusions=(_double(result),),
        claims=claims,
        finding=f"{headline(claims)}.",
        headlines={"line_convention": headline(claims)},
        captions={
            "line_convention": (
                "(a), (b) Levels of the mean of heights over one line, lines 5 and 10 mm apart; dotted: A3 of the "
                "ellipse over that of a line; points: energy mean, 95 %; shaded: within 1 dB. (c) Deviation of a level "
                "from strip to strip. Dotted, points and (c): isotropic ground."
            )
        },
    )


def _over_line(result: LineConventionResult, quantity: str, ground: str, spacing: float) -> list[Number]:
    """In the bands that count; the mean of heights is exact, the energy mean is found on strips."""
    case = result.case
    keep = _counted(case)
    if quantity == HEIGHTS:
        value = _heights(case, ground, spacing)
        half = np.zeros(value.size)
    else:
        found = _energy_mean(result, ground, spacing)
        value = POWER_DECIBEL * np.array([estimate.value for estimate in found])
        half = POWER_DECIBEL * np.array([estimate.half_width_among(keep.size) for estimate in found])
    wave = strip_bands(case.scene).nominal
    return [
        Number(
            quantity=quantity,
            where={
                "across": ground,
                "spacing [mm]": 1000 * spacing,
                "wavelength [mm]": round(1000 * float(wave[i]), 2),
            },
            value=float(value[i]),
            reference=0.0,
            source="one line, mean of all realisations",
            tolerance=1.0,
            reason=FIELD,
            unit="dB",
            sample=float(half[i]),
            role=Role.IDENTITY if ground == RIDGES else Role.FINDING,
        )
        for i in keep
    ]


def _heights(case: LineConvention, ground: str, spacing: float) -> FloatArray:
    """Levels of the mean of heights over those of one line: an integral over what lies across [dB]."""
    line, places = line_of(case.scene), case.places(spacing)
    structure = structure_of(GROUNDS[ground], line)
    reach = (case.scene.contact.along, float(np.ptp(places)))
    return decibel(structure.band_power(line, mean_of_lines(places), edges=case.bands.edges, semi_axes=reach))


def _energy_mean(result: LineConventionResult, ground: str, spacing: float) -> list[Estimate]:
    """ln of the energy mean over one line in the mean of all realisations."""
    strip = result.case.strip(ground)
    one = strip.expected_power(LINEAR_MODELS[LINE](strip.contact), result.case.bands)
    return jackknifed(lambda rows: np.log(rows.mean(axis=0) / one), result.found[ground][f"{ENERGY} {spacing:g}"])


def _counted(case: LineConvention) -> NDArray[np.int64]:
    """Numbers of the bands of the strips that count over isotropic ground."""
    scene = case.scene
    first = scene.levels.bands.longest - strip_bands(scene).longest
    return np.flatnonzero(counted(linear_filter(scene, LINEAR, "isotropic"))[first : first + len(strip_bands(scene))])


def _scatter(result: LineConventionResult, ground: str, spacing: float) -> Number:
    """rms over bands of the deviation of a level from strip to strip, energy mean over one line, with a jackknife."""
    keep = _counted(result.case)
    rows = np.stack([result.found[ground][f"{ENERGY} {spacing:g}"], result.found[ground][LINE]], axis=1)[:, :, keep]

    def ratio(some: FloatArray) -> FloatArray:
        deviation = np.sqrt(np.mean(np.var(decibel(some), axis=0, ddof=1), axis=-1))
        return np.asarray(deviation[0] / deviation[1] if deviation[1] > 1e-6 else 1.0)

    estimate = jackknifed(ratio, rows)[0]
    return Number(
        quantity=SCATTER,
        model="energy mean over one line",
        where={"across": ground, "spacing [mm]": 1000 * spacing},
        value=estimate.value,
        reference=1.0,
        source="one line on the same strips",
        tolerance=0.15,
        reason="15 %: a third less would be that of three independent lines, 1 / sqrt(3) = 0.58",
        sample=estimate.half_width,
        role=Role.IDENTITY if ground == RIDGES else Role.FINDING,
    )


def _claim(numbers: list[Number], sentence: str, quantity: str) -> JudgedClaim:
    """Limits reach from the narrowest band of waves to isotropic ground."""
    mine = _tested(numbers_with(numbers, quantity))
    off = max(mine, key=lambda number: abs(number.value))
    grounds = dict.fromkeys(number.where["across"] for number in mine)
    inside = agreeing_from_the_first([n for n in mine if n.where["across"] == ground] for ground in grounds)
    kept = dict.fromkeys(str(number.where["across"]) for number in inside)
    return answered(
        sentence,
        mine,
        f"at worst {decibels(off)} off at {off.where['worst at']:g} mm, "
        f"{off.where['across']}, lines {off.where['spacing [mm]']:g} mm apart.",
        limits=", ".join(kept) if len(inside) < len(mine) else "",
        inside=inside if len(inside) < len(mine) else (),
    )


def headline(claims: Sequence[JudgedClaim]) -> str:
    """Both means over one line, with the worst band that differs."""

    def said(claim: JudgedClaim) -> str:
        off = f"{farthest_off(claim.numbers).value:+.1f} dB at worst"
        return by_status(claim, holds="within 1 dB", fails=off, undecided="open within 1 dB")

    return f"Over one line, the mean of heights is {said(claims[0])}, the energy mean {said(claims[1])}"


def _scatter_claim(numbers: list[Number]) -> JudgedClaim:
    mine = _tested(numbers)
    least = min(mine, key=lambda number: number.value)
    return answered(
        CLAIM_SCATTER,
        mine,
        f"their scatter is {least.value:.2f} ± {least.uncertainty:.2f} of that of one line over "
        f"{least.where['across']}, lines {least.where['spacing [mm]']:g} mm apart.",
    )


def _tested(numbers: Iterable[Number]) -> list[Number]:
    """Lines over ridges are all alike, and so are their means."""
    return [number for number in numbers if number.where["across"] != RIDGES]


def _double(result: LineConventionResult) -> str:
    """What is counted twice if a mean of heights is fed to a filter of the whole contact."""
    parts = []
    for spacing in result.case.spacings:
        off = _over_line(result, HEIGHTS, "isotropic ground", spacing)[-2:]
        waves_off = " and ".join(f"{n.value:+.1f} dB at {n.where['wavelength [mm]']:g} mm" for n in off)
        parts.append(f"{1000 * spacing:g} mm apart, {waves_off}")
    return (
        "Over isotropic ground the mean of the heights of lines is itself a filter: "
        f"{'; '.join(parts)}. A filter of the ellipse that is applied to it counts this twice."
    )


def _table(result: LineConventionResult) -> Table:
    case = result.case
    scene, keep = case.scene, set(_counted(case).tolist())
    first = scene.levels.bands.longest - strip_bands(scene).longest
    line, ellipse = (linear_filter(scene, name, "isotropic") for name in ("linear, on the line", LINEAR))
    rows = []
    for ground in GROUNDS:
        spread = decibel(result.found[ground][LINE]).std(axis=0, ddof=1)
        for spacing in case.spacings:
            heights = _heights(case, ground, spacing)
            energy = result.found[ground][f"{ENERGY} {spacing:g}"]
            found = _energy_mean(result, ground, spacing)
            for i in sorted(keep):
                rows.append(
                    {
                        "across": ground,
                        "spacing [mm]": 1000 * spacing,
                        "wavelength [mm]": round(1000 * float(strip_bands(scene).nominal[i]), 2),
                        "mean of heights [dB]": float(heights[i]),
                        "energy mean [dB]": POWER_DECIBEL * found[i].value,
                        "energy mean ± [dB]": POWER_DECIBEL * found[i].half_width,
                        "scatter of one line [dB]": float(spread[i]),
                        "scatter of energy mean [dB]": float(decibel(energy).std(axis=0, ddof=1)[i]),
                        "ellipse over line [dB]": float((ellipse - line)[first + i]),
                    }
                )
    return table_of("lines", rows)


CASE = Case(
    name="line_convention",
    chapter=Chapter.RAIL,
    place=4,
    claim=CLAIM,
    answers="Whether lines are averaged as energies or as heights, and what lies across a rail",
    quick=LineConvention(strips=40),
    full=LineConvention(strips=400),
    run=run,
    evidence=evidence,
    needs="linear theory of the ellipse, with what lies across the track",
)
