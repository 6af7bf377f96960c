"""A rail at the limit of ISO 3095 and rougher: where linear theory and springs leave boundary elements."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Role, Table, Verdict, numbers_with, table_of
from validation.analysis.over_range import worst
from validation.analysis.statistics import POWER_DECIBEL, Estimate, mean_estimate
from validation.analysis.wording import by_status, decibels, farthest_off, sentence
from validation.cases.rail.filter_tables import a3, bands_table
from validation.cases.rail.filters import COUNTED, counted
from validation.cases.rail.rolled_filters import Key, RolledFilters, RolledFiltersResult, run_filters
from validation.simulation.equivalent_displacement import (
    AREA,
    BEM,
    LINEAR,
    ONE_SIDED_BED,
    SPRINGS_ON_LINE,
    SPRINGS_THAT_READ,
)
from validation.simulation.rail_ground import SHORTEST, lost_contact_number, strip_bands
from validation.simulation.spectral_springs import SPRINGS_GEIKE, SPRINGS_ROLLING, twin_of

WAVES = "waves of h'"
SHORT, LONG = "waves beyond the first zero", "bands that count"
OVER_BEM, LOST = "A3 over that of boundary elements", "area in contact over that of the smooth wheel"
FIELD = "1 dB: a tolerance of the field"
GROUND = "isotropic ground"
CLAIM = "Linear theory of the ellipse follows boundary elements within 1 dB up to 20 dB over the limit of ISO 3095."
CLAIM_SHORT = "It follows them within 1 dB at the waves beyond its first zero too."
CLAIM_READ = "Springs that read the surface follow boundary elements within 1 dB at all of these waves."
CLAIM_CONTACT = "At the limit of ISO 3095 the wheel keeps 95 % of the area of the smooth contact."


def model_over_bem(result: RolledFiltersResult, key: Key, model: str) -> list[Estimate]:
    """ln of the ratio of powers in each band: on the same strips where both have one linear twin, else over its own."""
    twin = twin_of(model)
    if twin == LINEAR:
        return result.over(key, model, BEM)
    exact = (a3(result, key, twin) - a3(result, key, LINEAR)) / POWER_DECIBEL
    pairs = zip(exact, result.over_twin(key, model), result.over_twin(key, BEM), strict=True)
    return [replace(mine.minus(bem), value=float(e) + mine.value - bem.value) for e, mine, bem in pairs]


def over_boundary_elements(result: RolledFiltersResult, key: Key, model: str, waves: str) -> Number:
    """The worst band, both on the same strips: longer than the first band below -15 dB, or all bands shorter.

    The two bands of the shortest waves are left out, where oblique waves are missing.
    """
    bands, offset = strip_bands(result.case.scene(key)), key[1]
    keep = counted(a3(result, key, LINEAR))
    inside = np.flatnonzero(keep if waves == LONG else ~keep)
    inside = inside[inside < len(bands) - 2]
    over = model_over_bem(result, key, model)
    grid = POWER_DECIBEL * result.left_by_grid(key, BEM, twin_of(model))
    points = [
        Number(
            quantity=OVER_BEM,
            model=model,
            where={"offset [dB]": offset, "waves": waves, "wavelength [mm]": round(1000 * float(bands.nominal[i]), 2)},
            value=POWER_DECIBEL * over[i].value,
            reference=0.0,
            source=f"boundary elements on the same {result.case.strips} strips",
            tolerance=1.0,
            reason=FIELD,
            unit="dB",
            grid=float(grid[i]),
            sample=POWER_DECIBEL * over[i].half_width_among(inside.size),
            role=Role.FINDING,
        )
        for i in inside
    ]
    return worst(points, "wavelength [mm]")


def area_in_contact(result: RolledFiltersResult, key: Key) -> Number:
    """Mean along all strips, on the finer grid, beside that of the coarser one."""
    coarse, fine = (
        mean_estimate(np.array([float(one[AREA].mean()) for one in result.outcomes[key, cells]]))
        for cells in result.case.cells
    )
    cells = result.case.cells
    return Number(
        quantity=LOST,
        model=BEM,
        where={"offset [dB]": key[1]},
        value=fine.value,
        reference=1.0,
        source="the ellipse of Hertz",
        tolerance=0.05,
        reason="5 %: hardly any contact is lost; cells at the edge count whole, which is 2 % on these grids",
        grid=abs(fine.value - coarse.value) * cells[0] / (cells[1] - cells[0]),
        sample=fine.half_width,
        role=Role.FINDING,
    )


def evidence(result: RolledFiltersResult) -> Evidence:
    """Models over boundary elements, roughness by roughness."""
    case = result.case
    models = (LINEAR, SPRINGS_THAT_READ, ONE_SIDED_BED, SPRINGS_ON_LINE, SPRINGS_ROLLING, SPRINGS_GEIKE)
    numbers = [
        over_boundary_elements(result, key, model, waves)
        for key in case.keys
        for model in models
        for waves in (LONG, SHORT)
    ]
    areas = [area_in_contact(result, key) for key in case.keys]
    claim = partial(_claim, case, numbers)
    claims = (
        claim(CLAIM, LINEAR, LONG),
        claim(CLAIM_SHORT, LINEAR, SHORT),
        claim(CLAIM_READ, SPRINGS_THAT_READ, LONG, SHORT),
        answered(CLAIM_CONTACT, areas[:1], f"{areas[0].value:.3f} ± {areas[0].uncertainty:.3f} of it is in contact."),
    )
    return Evidence(
        title="A rougher rail: where linear theory leaves boundary elements, and where springs do",
        method=(
            f"{case.strips} strips of isotropic ground with the levels of ISO 3095:2013, and with more, under a wheel "
            f"of {case.keys[0][0].label} on a crown of {1000 * case.crown:g} mm; boundary elements have "
            f"{case.cells[0]} and {case.cells[1]} cells to the smaller semi-axis. All models roll over the same "
            "strips, so each is divided by boundary elements strip by strip. "
            f"Bands count down to the first with A3 below {COUNTED:g} dB; shorter waves are "
            "judged apart. h' is the rms slope along the track, in one direction, of the waves of the strips, "
            f"{strip_bands(case.scene(case.keys[0])).span}. They end at {SHORTEST:g} a_x: shorter waves, of which "
            "nothing is known from measurements at 1 mm, would make the slope h' larger."
        ),
        numbers=(*numbers, *areas),
        tables=(bands_table(result), _roughness_table(result, areas)),
        conclusions=(),
        claims=claims,
        finding=finding(claims),
        headlines={"rough_rail": headline(claims)},
        captions={
            "rough_rail": (
                "A3 of models over that of boundary elements on the same strips. Left of the dotted line: bands that "
                "count. Shaded: within 1 dB. Grey: 95 % of boundary elements, sample and grid."
            )
        },
        unconverged=result.unconverged,
        page_tables=(_roughness_table(result, areas),),
    )


def _claim(case: RolledFilters, numbers: list[Number], sentence: str, model: str, *waves: str) -> JudgedClaim:
    """Of all offsets; where it fails, it may hold up to one."""
    mine = [number for part in waves for number in numbers_with(numbers, OVER_BEM, model, waves=part)]
    failing = [offset_of(number) for number in mine if number.verdict is not Verdict.AGREE]
    inside = [number for number in mine if offset_of(number) < min(failing)] if failing else []
    off = [max((n for n in mine if offset_of(n) == o), key=lambda n: abs(n.value)) for o in case.offsets]
    found = "; ".join(f"{decibels(n)} at {n.where['worst at']:g} mm for {n.where['offset [dB]']:+g} dB" for n in off)
    highest = max((offset_of(number) for number in inside), default=0.0)
    return answered(
        sentence, mine, f"{found}.", limits=f"up to {highest:+g} dB over ISO 3095" if inside else "", inside=inside
    )


def headline(claims: Sequence[JudgedClaim]) -> str:
    """Linear theory in the bands that count."""
    return f"Linear theory of the ellipse: {_said(claims[0])}"


def finding(claims: Sequence[JudgedClaim]) -> str:
    return sentence(
        headline(claims),
        f"beyond its first zero {_said(claims[1])}",
        f"springs that read the surface: {_said(claims[2])}",
    )


def _said(claim: JudgedClaim) -> str:
    """Within 1 dB, or the farthest that differs and at which level."""
    worst_one = farthest_off(claim.numbers)
    return by_status(
        claim,
        holds="within 1 dB",
        fails=f"{worst_one.value:+.1f} dB off at {offset_of(worst_one):+g} dB over ISO 3095",
        undecided="open within 1 dB",
    )


def offset_of(number: Number) -> float:
    offset = number.where["offset [dB]"]
    assert isinstance(offset, float)
    return offset


def _roughness_table(result: RolledFiltersResult, areas: list[Number]) -> Table:
    return table_of(
        "roughness and contact",
        [
            {
                "offset [dB]": key[1],
                WAVES: strip_bands(result.case.scene(key)).span,
                "h' a_x / d": round(lost_contact_number(result.case.scene(key)), 4),
                "area in contact over smooth": round(area.value, 4),
                "±": round(area.uncertainty, 4),
            }
            for key, area in zip(result.case.keys, areas, strict=True)
        ],
    )


CASE = Case(
    name="rough_rail",
    chapter=Chapter.RAIL,
    place=3,
    claim=CLAIM,
    answers="How rough a rail may be before its contact filter depends on the roughness",
    quick=RolledFilters(offsets=(0.0, 20.0), across=(GROUND,), strips=3, cells=(5, 7), seed=21),
    full=RolledFilters(offsets=(0.0, 5.0, 10.0, 15.0, 20.0), across=(GROUND,), strips=10, cells=(8, 16), seed=21),
    run=run_filters,
    evidence=evidence,
    needs="linear theory of the ellipse; boundary elements for short waves on rougher rails",
)
