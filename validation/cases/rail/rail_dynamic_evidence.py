"""The wheel that moves beside the one that bears a constant load: contact filters, band by band."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from validation.analysis.answers import agreeing_from_the_first, answered
from validation.analysis.case import Case, Chapter
from validation.analysis.difference import difference
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Table, numbers_with, table_of
from validation.analysis.over_range import root_mean_square, signed_mean
from validation.analysis.statistics import POWER_DECIBEL, Estimate, log_ratio_of_means
from validation.analysis.wording import by_status, farthest_off
from validation.cases.rail.rail_dynamic import COARSE, FINE, MODELS, RailDynamic, RailDynamicResult, run
from validation.simulation.wheel_on_rail import BEM, SPRINGS

FloatArray = NDArray[np.float64]

CLAIM = "The contact filter of constant load holds when the wheel moves."
OFFSET, FREQUENCY = "dB over the curve", "f [Hz]"
MOVING, INFERRED, BESIDE = "filter in motion", "filter inferred from the force", "filter in motion, of two models"
RMS = "rms of "
"""Before the name of what the root mean square over bands is taken of."""
NEAR, ABOVE = "near the resonance", "above the resonance"
LOUD, WIDEST = -15.0, 1.5
"""Level of the filter [dB] down to which its bands are judged; bands near the resonance are within this factor."""
ONE_DECIBEL, REPEATABLE = 1.0, "1 dB: repeatability of measured one-third octave levels"


@dataclass(frozen=True)
class DynamicLevels:
    """Natural logarithms of band powers of two tracks over each other, on the same strips."""

    result: RailDynamicResult

    @property
    def case(self) -> RailDynamic:
        return self.result.case

    @cached_property
    def linear(self) -> FloatArray:
        """A3 of linear theory on these strips [dB]."""
        key = self.case.offsets[0], SPRINGS, FINE
        linear, line = (self.result.powers(key, name).mean(axis=0) for name in ("linear", "line"))
        return np.asarray(POWER_DECIBEL * np.log(linear / line))

    @cached_property
    def judged(self) -> NDArray[np.intp]:
        """Bands before the first zero of the filter, at lambda = 2 a, and not below -15 dB."""
        before = self.case.bands.wavelengths > 2.5 * self.case.contact.along
        return np.flatnonzero(before & (self.linear > LOUD))

    def over(self, mine: tuple[float, str, str], other: tuple[float, str, str]) -> list[tuple[Estimate, float]]:
        """(offset, model, track) over another one, each band, and what the grid leaves."""
        fine = self._ratios(mine, other, FINE)
        coarse, same = self._ratios(mine, other, COARSE), self._ratios(mine, other, FINE, self.case.compared)
        apart = self.case.cells / self.case.coarse - 1
        return [
            (ratio, abs(ours.value - theirs.value) / apart)
            for ratio, ours, theirs in zip(fine, same, coarse, strict=True)
        ]

    def _ratios(
        self, mine: tuple[float, str, str], other: tuple[float, str, str], grid: str, strips: int | None = None
    ) -> list[Estimate]:
        found, reference = (
            self.result.powers((offset, model, grid), track)[:strips] for offset, model, track in (mine, other)
        )
        return [log_ratio_of_means(found, reference, band) for band in np.eye(found.shape[1])]


def evidence(result: RailDynamicResult) -> Evidence:
    """Filters in motion and from the force over that of constant load; springs over boundary elements in motion."""
    levels = DynamicLevels(result)
    points = {offset: _points(levels, offset) for offset in result.case.offsets}
    numbers = [
        root_mean_square(some, FREQUENCY, ONE_DECIBEL, REPEATABLE)
        for groups in points.values()
        for some in groups.values()
        if some
    ]
    claims = _claims(result, numbers, points)
    return Evidence(
        title="The wheel that moves on a rail: does the contact filter of constant load hold?",
        method=_method(result.case),
        numbers=tuple(numbers),
        tables=(_filters(levels),),
        claims=claims,
        finding=f"{headline(claims[0])}.",
        headlines={"rail_dynamic": headline(claims[0])},
        conclusions=(_resonance(result),),
        captions=_captions(result.case),
    )


Groups = dict[tuple[str, str, str], list[Number]]
"""Quantity, model and range of the bands."""


def _points(levels: DynamicLevels, offset: float) -> Groups:
    """Each judged band; the intervals of the root mean squares over them hold at once for all numbers of a claim."""
    case = levels.case
    f = case.frequencies
    near = (f > case.resonance / WIDEST) & (f < WIDEST * case.resonance)
    above = f >= WIDEST * case.resonance
    every = np.ones(f.size, dtype=bool)
    compared = [
        *((MOVING, m, "all bands", every, (offset, m, "moving"), (offset, m, "constant")) for m in MODELS),
        (BESIDE, f"{SPRINGS} over {BEM}", "all bands", every, (offset, SPRINGS, "moving"), (offset, BEM, "moving")),
        *(
            (INFERRED, BEM, name, inside, (offset, BEM, "inferred"), (offset, BEM, "constant"))
            for name, inside in ((ABOVE, above), (NEAR, near))
        ),
    ]
    together = len(MODELS) * len(case.offsets)
    found: Groups = {}
    for quantity, model, name, inside, mine, other in compared:
        ratios = levels.over(mine, other)
        found[quantity, model, name] = [
            difference(
                ratios[band][0],
                quantity=quantity,
                model=model,
                where={OFFSET: offset, "bands": name, FREQUENCY: float(f[band])},
                source="at constant load, same strips" if quantity != BESIDE else "boundary elements, same strips",
                tolerance=ONE_DECIBEL,
                reason=REPEATABLE,
                grid=ratios[band][1],
                among=together,
            )
            for band in levels.judged
            if inside[band]
        ]
    return found


def _claims(
    result: RailDynamicResult, numbers: Sequence[Number], points: dict[float, Groups]
) -> tuple[JudgedClaim, ...]:
    """Limits are the lowest levels: nonlinearity and flight grow with the roughness."""
    offsets = result.case.offsets

    def found(quantity: str, model: str, name: str = "all bands") -> str:
        parts = []
        for offset in offsets:
            number = numbers_with(of(quantity, offset), model=model, bands=name)[0]
            bands = points[offset][quantity, model, name]
            farthest = max(bands, key=lambda n: abs(n.value))
            parts.append(
                f"rms over bands {number.value:.1f} ± {number.uncertainty:.1f} dB, mean {signed_mean(bands):+.1f} dB, "
                f"worst band {farthest.value:+.1f} dB ({farthest.where[FREQUENCY]:.0f} Hz) at {offset:+g} dB"
            )
        return f"{model}: {'; '.join(parts)}"

    def of(quantity: str, offset: float) -> list[Number]:
        return [n for n in numbers if n.quantity == RMS + quantity and n.where[OFFSET] == offset]

    def by_offset(claim: str, mine: Sequence[Number], answer: str) -> JudgedClaim:
        groups = {offset: [n for n in mine if n.where[OFFSET] == offset] for offset in offsets}
        inside = agreeing_from_the_first(groups.values())
        highest = max((offset for offset, group in groups.items() if group[0] in inside), default=0.0)
        limits = f"up to {highest:+g} dB over {result.case.curve}" if inside else ""
        return answered(claim, mine, answer, limits=limits, inside=inside)

    beside = f"{SPRINGS} over {BEM}"
    inferred = [numbers_with(numbers, RMS + INFERRED, bands=name) for name in (ABOVE, NEAR)]
    return (
        by_offset(
            CLAIM, numbers_with(numbers, RMS + MOVING), "; ".join(found(MOVING, model) for model in MODELS) + "."
        ),
        by_offset(
            "Springs that read the surface lift a wheel that moves as boundary elements do.",
            numbers_with(numbers, RMS + BESIDE),
            f"{found(BESIDE, beside)}.",
        ),
        *(
            by_offset(
                f"The force over the linear dynamic stiffness tells what lifts the wheel {name}.",
                some,
                f"{found(INFERRED, BEM, name)}.",
            )
            for name, some in zip((ABOVE, NEAR), inferred, strict=True)
            if len(some) == len(offsets)
        ),
    )


def headline(claim: JudgedClaim) -> str:
    """The filter of constant load in motion, with the largest root mean square that decides."""
    off = farthest_off(claim.numbers)
    return by_status(
        claim,
        holds="In motion the filter of constant load holds within 1 dB rms",
        fails=f"In motion the filter of constant load is {off.value:.1f} dB rms off",
        undecided=f"Not decided: in motion the filter changes by {off.value:.1f} ± {off.uncertainty:.1f} dB rms",
    )


def airborne(result: RailDynamicResult, offset: float, model: str = BEM) -> float:
    """Part of the time without contact."""
    return float(np.mean([outcome["force"] <= 0 for outcome in result.outcomes[offset, model, FINE]]))


def _resonance(result: RailDynamicResult) -> str:
    parts = [f"{100 * airborne(result, offset):.1f} % of the time at {offset:+g} dB" for offset in result.case.offsets]
    return f"On boundary elements the wheel is in the air for {', '.join(parts)}."


def _filters(levels: DynamicLevels) -> Table:
    """A3 [dB] by offset and band; motion over constant load with its interval."""
    case, rows = levels.case, []
    for offset in case.offsets:
        line = levels.result.powers((offset, BEM, FINE), "line").mean(axis=0)
        level = {
            (model, track): POWER_DECIBEL
            * np.log(levels.result.powers((offset, model, FINE), track).mean(axis=0) / line)
            for model in MODELS
            for track in ("constant", "moving", "inferred")
        }
        change = {model: levels.over((offset, model, "moving"), (offset, model, "constant")) for model in MODELS}
        for i, wavelength in enumerate(case.bands.nominal):
            row: dict[str, object] = {
                OFFSET: offset,
                "wavelength [mm]": 1e3 * float(wavelength),
                FREQUENCY: float(case.frequencies[i]),
                "judged": int(i in levels.judged),
                "resonance [Hz]": case.resonance,
                "linear theory [dB]": float(levels.linear[i]),
            }
            row |= {f"{model}, {track} [dB]": float(value[i]) for (model, track), value in level.items()}
            for model, ratios in change.items():
                ratio, grid = ratios[i]
                row[f"{model}, change [dB]"] = POWER_DECIBEL * ratio.value
                row[f"{model}, ± change [dB]"] = POWER_DECIBEL * (ratio.half_width + grid)
            rows.append(row)
    return table_of("filters", rows)


def _method(case: RailDynamic) -> str:
    first, last = case.speed * case.bands.edges[[0, -1]] / (2 * np.pi)
    shortest = 1e3 * case.bands.nominal[-1]
    return (
        f"A rigid wheel, M = {case.mass:g} kg, {1e-3 * case.load:g} kN, {3.6 * case.speed:.0f} km/h, radii "
        f"{1e3 * case.radii[0]:g} and {1e3 * case.radii[1]:g} mm, over {case.strips} isotropic surfaces whose lines "
        f"have the levels of {case.curve}, raised by {', '.join(f'{o:g}' for o in case.offsets)} dB. M z'' = F - F_N "
        f"by velocity Verlet, the contact solved in each step by boundary elements, {case.cells} cells to the "
        "semi-axis along, or by springs that read the surface; it begins in the steady state of linear theory. The "
        "lift in motion is d_Hertz(F) - d, the approach of the smooth wheel under this force less the true one: a "
        "vibration on a smooth rail has none, however large. At constant load it is the contact filter's equivalent "
        "displacement. The force over the linear dynamic stiffness, F (1/k - 1/(M ω²)), is what a measured "
        f"force would tell; a large vibration has a second harmonic, {2 * case.resonance:.0f} Hz, which it takes for "
        f"roughness. Nothing damps the resonance, {case.resonance:.0f} Hz: its vibration grows with the length of the "
        f"strip, {case.periods + 0.5:g} natural periods. All through Hann's window. Judged are the root mean squares "
        f"over bands before the first zero of the filter and above {LOUD:g} dB. Bands reach from {first:.0f} to "
        f"{last:.0f} Hz: the roughness ends there, the shortest waves, {shortest:g} mm, have "
        f"{case.bands.wavelengths[-1] * case.cells / case.contact.along:.1f} cells, and in the last two bands oblique "
        f"waves are missing. Grid: from {case.coarse} cells on {case.compared} surfaces, to first order."
    )


def _captions(case: RailDynamic) -> dict[str, str]:
    return {
        "rail_dynamic": (
            f"(a) A3 at {3.6 * case.speed:.0f} km/h, {case.offsets[0]:+g} dB: grey, linear theory; "
            "full line, boundary elements at constant load; circles, in motion; squares, springs that read the surface "
            "in motion; crosses, inferred from the force. (b) In motion over at constant load, 95 %: "
            "filled, boundary elements; open, springs; a colour for each level. Dotted: ± 1 dB. Shaded: near the "
            "resonance. Right of the dashed line: not judged."
        )
    }


CASE = Case(
    name="rail_dynamic",
    chapter=Chapter.RAIL,
    place=5,
    claim=CLAIM,
    answers="A contact filter is measured and computed at constant load; the wheel of rolling noise moves",
    quick=RailDynamic(strips=3),
    full=RailDynamic(
        offsets=(-10.0, 0.0, 10.0),
        longest=0.4,
        shortest=0.0025,
        periods=12,
        width=0.6,
        cells=12,
        coarse=8,
        strips=14,
        compared=4,
    ),
    run=run,
    evidence=evidence,
    needs="boundary elements in the time loop",
)
