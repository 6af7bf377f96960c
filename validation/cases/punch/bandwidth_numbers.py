"""How the answer of Fig. 14.1 changes with bandwidth and with a roll-off, and a fit beside it: worst points."""

import math
from collections.abc import Sequence

from validation.analysis.difference import difference
from validation.analysis.evidence import Number, Place
from validation.analysis.over_range import worst
from validation.analysis.statistics import DECIBEL, FIVE_PER_CENT, Estimate
from validation.cases.punch.bandwidth import Bandwidth
from validation.cases.punch.bandwidth_levels import DEVIATION, MEAN, BandwidthLevels, Estimates, minus
from validation.theory import closed_forms

BANDWIDTH, ROLL_OFF, FORCE = "q_max / q_min", "q_r L / 2π", "Fbar"
CHANGE, SIZE, STIFFNESS = "change of MDR over bem3d", "with the roll-off over without", "mean stiffness over bem3d"
BEM, MDR, FIT, OVER = "bem3d", "mdr", "fit", "mdr over bem3d"
TOLERANCES = {
    MEAN: (FIVE_PER_CENT, "5 %, less than half of what MDR is off by in full contact, 13 %"),
    DEVIATION: (DECIBEL * math.log(1.1), "10 %, the margin at which Fig. 14.1 is decided"),
}
FIT_RANGE = 0.3, 10.0
FIT_ERROR = DECIBEL * math.log(1.06), "6 %, less than half of what MDR is off by in full contact, 13 %"


def numbers_of(case: Bandwidth, found: dict[str, BandwidthLevels]) -> list[Number]:
    """Of both quantities over each decade, and of the fit over its range."""
    decades = [
        number
        for quantity, levels in found.items()
        for first in case.first_forces
        for number in _over_decade(case, quantity, levels, (first, 10 * first))
    ]
    return [*decades, *_over_fit(case, found[MEAN])]


def _over_decade(case: Bandwidth, quantity: str, of: BandwidthLevels, inside: tuple[float, float]) -> list[Number]:
    steps = zip(case.bandwidths, case.bandwidths[1:], of.over_bem_changes, strict=False)
    judged: list[tuple[str, str, str, Place, Estimates]] = [
        (CHANGE, OVER, BANDWIDTH, (before, wider), step) for before, wider, step in steps
    ]
    judged.append((CHANGE, OVER, ROLL_OFF, float(case.roll_off), minus(of.over_bem_rolled_off, of.over_bem[0])))
    if quantity == DEVIATION:
        judged.append((SIZE, BEM, ROLL_OFF, float(case.roll_off), minus(of.bem_rolled_off, of.bem[0])))
        judged.append((SIZE, MDR, ROLL_OFF, float(case.roll_off), minus(of.springs_rolled_off, of.springs[0])))
    return [
        number
        for about, model, name, place, estimates in judged
        for number in _worst(
            case,
            estimates,
            grid_left(of),
            inside,
            quantity=f"{about}, {quantity}",
            model=model,
            where={name: place},
            source="no change",
            tolerance=TOLERANCES[quantity],
        )
    ]


def _over_fit(case: Bandwidth, of: BandwidthLevels) -> list[Number]:
    """The fit and MDR over boundary elements."""
    fit = [Estimate(math.log(stiffness), 0.0, 10**9) for stiffness in fitted(case)]
    surfaces: list[tuple[str, float, Estimates, Estimates]] = [
        (BANDWIDTH, float(bandwidth), of.springs[i], of.bem[i]) for i, bandwidth in enumerate(case.bandwidths)
    ]
    surfaces.append((ROLL_OFF, float(case.roll_off), of.springs_rolled_off, of.bem_rolled_off))
    return [
        number
        for name, place, springs, bem in surfaces
        for model, values in ((FIT, fit), (MDR, springs))
        for number in _worst(
            case,
            minus(values, bem),
            # to first order cells of no size are twice as far away as cells of half the size
            [2 * left for left in grid_left(of)],
            FIT_RANGE,
            quantity=STIFFNESS,
            model=model,
            where={name: place},
            source=BEM,
            tolerance=FIT_ERROR,
        )
    ]


def _worst(
    case: Bandwidth,
    found: Estimates,
    grid: Sequence[float],
    inside: tuple[float, float],
    *,
    quantity: str,
    model: str,
    where: dict[str, Place],
    source: str,
    tolerance: tuple[float, str],
) -> list[Number]:
    """The worst force of a range; none where saturation leaves nothing to compare but at one end."""
    low, high = inside[0] * (1 - 1e-9), inside[1] * (1 + 1e-9)
    kept = [
        (force, one, left)
        for force, one, left in zip(case.forces, found, grid, strict=True)
        if low <= force <= high and math.isfinite(one.value) and math.isfinite(one.error + left)
    ]
    points = [
        difference(
            one,
            quantity=quantity,
            model=model,
            where={**where, FORCE: force},
            source=source,
            tolerance=tolerance[0],
            reason=tolerance[1],
            scale=DECIBEL,
            grid=left,
            among=len(kept) * _ranges(case),
        )
        for force, one, left in kept
    ]
    return [worst(points, FORCE)] if len(points) > 1 else []


def _ranges(case: Bandwidth) -> int:
    """Numbers of a claim at most, whose intervals hold at once: decades of all bandwidths, of mean and deviation."""
    return 2 * len(case.first_forces) * max(len(case.bandwidths) - 1, 1)


def fitted(case: Bandwidth) -> list[float]:
    """k / (E* L) of the fit, the flat punch in series with its rough face, at each force."""
    h = case.height
    return [
        closed_forms.rough_punch_stiffness(side=1.0, modulus=1.0, force=force * h, height=h) for force in case.forces
    ]


def grid_left(of: BandwidthLevels) -> list[float]:
    """What twice as many cells a side change in the narrowest band, with its interval."""
    return [abs(one.value) + one.half_width for one in of.grid]
