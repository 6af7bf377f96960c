"""The interface case on outcomes made up: exponents, theory beside them, finer cells, the punch in series."""

from dataclasses import replace

import numpy as np
import pytest
from scipy import special

from tests.seeded import Times, catches
from validation.analysis.case import Outcomes
from validation.analysis.claim_text import NOT_THIS_CURVE
from validation.analysis.evidence import ClaimStatus, Number, Verdict, numbers_with
from validation.cases.punch import interface_study
from validation.cases.punch.interface import (
    AREA_OVER,
    ASPERITIES,
    BEARING,
    BESIDE_BEM,
    BOUNDED,
    CONTACT,
    EXPONENT,
    FITTED,
    GAP_OVER,
    KAPPA_LIGHT,
    MDR,
    OF_HALF,
    OF_SERIES,
    OVER_LOAD,
    PUNCH,
    ROLL_OFF,
    TAIL,
    UNFITTED,
    Interface,
)
from validation.simulation.interface import without_flat_punch
from validation.theory.interface import Barber, GreenwoodWilliamson, Persson, TailFormula

CASE = Interface(grounds=((4, 0.7), (8, 0.7)), surfaces=6, refined=4, profiles=8)
THREE = Interface(grounds=((4, 0.7), (8, 0.7)), pressed=(8, 0.7), surfaces=6, refined=4, profiles=8)


def outcome(stiffness, count, finer=1.0, area=None, gap=None, correction=0.0):
    """The same in every draw but for some noise; on cells half as wide so many times as stiff."""
    noise = 1 + 1e-4 * np.random.default_rng(0).standard_normal((count, 1))
    area = stiffness if area is None else area
    rows = {"corrected": area * noise, "area": (1 + correction) * area * noise, "stiffness": finer * stiffness * noise}
    rows["gap"] = (CASE.height * np.linspace(3.0, 0.5, stiffness.size) if gap is None else gap) * noise
    work = dict.fromkeys(("applications", "frozen applications"), np.full(rows["gap"].shape, 10.0))
    return {**rows, **work, "highest": np.full(count, 4 * CASE.height), "full": np.full(count, 1e3)}


def evidence(law, case=CASE, finer=1.0, flat=1.1523, springs=None, **rows):
    """K = law(ground) on the interfaces; the punch in series with a flat one; springs as stiff as it, or as given."""
    found = {}
    for ground in case.grounds:
        values = {name: row(ground) for name, row in rows.items()}
        for times, count in ((1, case.surfaces), (2, case.refined)):
            found[ground, times] = outcome(law(ground), count, finer if times == 2 else 1.0, **values)
        found[MDR, ground] = outcome(law(ground) / (1 + law(ground)) if springs is None else springs, case.profiles)
    punch = 1 / (1 / law(case.pressed) + 1 / flat)
    found |= {(PUNCH, 1): outcome(punch, case.surfaces), (PUNCH, 2): outcome(punch, case.refined)}
    return interface_study.CASE.evidence(Outcomes(case, found))


def power(exponent):
    """Level at 3 % contact, where K = 2 p / h."""
    return lambda ground: (
        2 * CASE.pressures(ground)[4] * (CASE.pressures(ground) / CASE.pressures(ground)[4]) ** exponent
    )


def theory(ground, factor=1.0):
    return factor * Persson(CASE.drawn(ground), 1.0).stiffness(CASE.height * CASE.pressures(ground))


@catches("exponents of an interface over equal steps of the load", exponent=1.0, status=ClaimStatus.SUPPORTED).at(
    "validation.cases.punch.interface.Interface.slopes",
    lambda case, ground: lambda mean, _: np.diff(np.log(mean)) / np.log(3),
)
@pytest.mark.parametrize(("exponent", "status"), [(1.0, ClaimStatus.SUPPORTED), (0.9, ClaimStatus.REFUTED)])
def test_a_power_of_the_load_is_found_and_judged(exponent, status):
    found = evidence(power(exponent))
    numbers = numbers_with(found.numbers, EXPONENT)
    # up to a tenth in contact: two grounds, five steps
    assert len(numbers) == 10
    assert [n.value for n in numbers] == pytest.approx(10 * [exponent], abs=1e-9)
    assert found.claims[0].status is status
    assert interface_study.CASE.study.claims[0].no == NOT_THIS_CURVE
    lightest = numbers_with(found.numbers, OVER_LOAD)[0]
    p = CASE.pressures((4, 0.7))
    assert lightest.value == pytest.approx(20 * (exponent - 1) * np.log10(p[0] / p[5]), abs=1e-3)
    # K h / p at equal contact does not depend on the number of waves
    assert [n.value for n in numbers_with(found.numbers, OF_HALF)] == pytest.approx(7 * [0.0], abs=1e-3)


def test_theory_is_put_over_boundary_elements_and_few_waves_do_not_judge_it():
    found = evidence(lambda ground: theory(ground, 1.25 if ground[0] == 4 else 1.0))
    values = {(n.where[ROLL_OFF], n.where[CONTACT]): n for n in numbers_with(found.numbers, BESIDE_BEM, FITTED)}
    assert values[8, 1.0].value == pytest.approx(0.0, abs=1e-3)
    assert values[4, 1.0].value == pytest.approx(-20 * np.log10(1.25), abs=1e-3)
    assert found.claims[1].status is ClaimStatus.SUPPORTED


@catches("sample and grid exchanged").at(
    "validation.analysis.series.Number", lambda grid, sample, **settings: Number(grid=sample, sample=grid, **settings)
)
def test_what_finer_cells_change_is_extrapolated_and_half_of_it_left_open():
    """5 % stiffer on half as wide cells: 10 % on those of no size, to first order, in the logarithm."""
    plain, finer = (evidence(theory, finer=factor) for factor in (1.0, 1.05))
    one, two = (numbers_with(found.numbers, BESIDE_BEM, FITTED)[9] for found in (plain, finer))
    assert two.value - one.value == pytest.approx(-2 * 20 * np.log10(1.05), abs=1e-6)
    # beside what the solver leaves, which is all that equal grids have
    assert two.grid == pytest.approx(np.hypot(20 * np.log10(1.05), one.grid), rel=1e-3)


SERIES = 1.1523, Verdict.WITHIN


@catches("an interface and a punch side by side", *SERIES).at(
    "validation.cases.punch.interface._over_series",
    lambda rows: np.log(rows.mean(axis=0)[0] / (rows.mean(axis=0)[1] + 1.1523)),
)
@pytest.mark.parametrize(("flat", "verdict"), [(1.1523, Verdict.WITHIN), (0.8, Verdict.OUTSIDE)])
def test_a_punch_is_put_beside_its_interface_in_series_with_the_flat_punch(flat, verdict):
    heaviest = numbers_with(evidence(theory, THREE, flat=flat).numbers, OF_SERIES)[-1]
    assert heaviest.verdict is verdict


@catches("bounds of half of the largest height").at(
    "validation.cases.punch.interface.Barber", lambda highest, full: Barber(0.2 * highest, full)
)
@catches("an upper bound without the gap").at(
    "validation.cases.punch.interface.Barber", lambda highest, full: Barber(highest, 1e-9 * full)
)
def test_bounds_of_the_stiffness_are_a_criterion():
    (inside,) = numbers_with(evidence(theory).numbers, BOUNDED)
    assert inside.met
    # h / 4 h at the least
    (outside,) = numbers_with(evidence(lambda ground: 0.2 * CASE.pressures(ground)).numbers, BOUNDED)
    assert not outside.met and outside.value == 0.0


def pressures(ground):
    return CASE.height * CASE.pressures(ground)


def areas(ground):
    """An eighth more than Persson's."""
    return 1.125 * Persson(CASE.drawn(ground), 1.0).area_fraction(pressures(ground))


def gaps(ground):
    return GreenwoodWilliamson(CASE.drawn(ground), 1.0).mean_gap(pressures(ground))


def in_decibels(numbers):
    return [n.value for n in numbers]


@catches("the area that cells count").at(
    "validation.cases.punch.interface.Measured.corrected",
    lambda measured, *names, **settings: (measured.of("area", *names, **settings)[0], np.zeros(7)),
)
def test_models_are_put_over_the_corrected_area_and_the_gap():
    """20 log 1 / 1.125 of Persson's area, zero of the gap that boundary elements have of Greenwood and Williamson."""
    light = CASE.per_cent[:4]
    found = evidence(theory, area=areas, gap=gaps, correction=lambda ground: 0.2)
    numbers = [n for n in numbers_with(found.numbers, AREA_OVER, FITTED) if n.where[CONTACT] in light]
    assert in_decibels(numbers) == pytest.approx(8 * [-20 * np.log10(1.125)], abs=1e-3)
    # a quarter of the correction of 20 % is left, beside the sample
    assert [n.grid for n in numbers] == pytest.approx(8 * [20 * np.log10(1.05)], rel=1e-2)
    of_asperities = [n for n in numbers_with(found.numbers, GAP_OVER, ASPERITIES[0]) if n.where[CONTACT] in light]
    assert in_decibels(of_asperities) == pytest.approx(8 * [0.0], abs=2e-3)
    assert not numbers_with(found.numbers, AREA_OVER, UNFITTED) and not numbers_with(found.numbers, AREA_OVER, MDR)
    assert not numbers_with(found.numbers, GAP_OVER, MDR)


@catches("kappa of one direction").at("validation.theory.interface.RoughnessSpectrum.gradient", Times(0.5**0.5))
def test_kappa_is_the_slope_of_the_area_over_the_load():
    """1.125 sqrt(8 / pi) where the contact is light; its error is that of the area."""
    found = evidence(theory, area=areas, gap=gaps)
    numbers = [n for n in numbers_with(found.numbers, KAPPA_LIGHT) if n.where[CONTACT] <= 1]
    p = pressures((4, 0.7))
    heights = CASE.roughness((4, 0.7)).surface(256, 0)
    g = np.hypot(*((np.roll(heights, -1, axis) - heights).std() * 256 for axis in (0, 1)))
    assert numbers[0].value == pytest.approx(areas((4, 0.7))[0] * g / p[0], rel=0.01)
    assert numbers[0].value == pytest.approx(1.125 * np.sqrt(8 / np.pi), rel=1e-3)
    assert all(n.verdict is Verdict.WITHIN for n in numbers)


TAIL_STIFFNESS = TailFormula.stiffness


@catches("a gap in the tail formula that is not over h").at(
    "validation.theory.interface.TailFormula.stiffness",
    lambda tail, pressure: TAIL_STIFFNESS(replace(tail, height=1.1 * tail.height), pressure),
)
def test_models_with_the_measured_gap_have_that_of_boundary_elements():
    """p ~ F_3/2(u / h): a gap of those quantiles leaves K = -dp / du, by differences over a per cent."""
    z = CASE.height * special.ndtri((np.arange(100_000) + 0.5) / 100_000)

    def pressed(ground, shift=0.0):
        return [np.mean(np.maximum(z - u + shift, 0.0) ** 1.5) for u in gaps(ground)]

    def law(ground):
        step = 1e-3 * CASE.height
        more, less = (
            np.array([np.mean(np.maximum(z - u + s, 0.0) ** 1.5) for u in gaps(ground)]) for s in (step, -step)
        )
        return (more - less) / (2 * step) / np.array(pressed(ground)) * pressures(ground)

    numbers = numbers_with(evidence(law, gap=gaps).numbers, BESIDE_BEM, TAIL)
    assert in_decibels(numbers)[1:7] == pytest.approx(6 * [0.0], abs=0.05)
    sections = numbers_with(evidence(law, gap=gaps).numbers, AREA_OVER, BEARING)
    # under the last load the gap of these asperities is negative
    assert len(sections) == 12


@catches("springs with their flat punch").at(
    "validation.cases.punch.interface.without_flat_punch", lambda stiffness: stiffness
)
def test_springs_are_compared_without_their_flat_punch():
    """1 / K = 1 / k - 1 / E* L: springs of k = K / (1 + K) have the stiffness of the interface, while k < 0.9."""
    numbers = numbers_with(evidence(theory).numbers, BESIDE_BEM, MDR)
    assert len(numbers) == sum(int((theory(ground) < 9).sum()) for ground in CASE.grounds)
    assert in_decibels(numbers) == pytest.approx(len(numbers) * [0.0], abs=0.01)
    # where all springs touch there is no interface
    full = evidence(theory, springs=np.array([0.1, 0.2, 0.5, 1.0, 1.0, 1.0, 1.0]))
    assert len(numbers_with(full.numbers, BESIDE_BEM, MDR)) == 6
    assert without_flat_punch(np.array([0.5, 1.0])).tolist() == [1.0, np.inf]


def test_the_table_has_the_ranges_within_10_and_30_per_cent_of_all_grounds():
    """Persson's stiffness is that of boundary elements but for the first two loads, 25 % too large and 2 times."""
    factors = np.array([0.5, 0.8, 1, 1, 1, 1, 1])
    tables = evidence(lambda ground: theory(ground) * factors, THREE).page_tables
    table = next(table for table in tables if table.name == interface_study.RANGES)
    row = table.where(quantity="K", model=FITTED)
    assert [row[name][0] for name in row.columns][2:4] == ["0.3 to 20", "0.1 to 20"]
    error, at = row["highest error"][0].split(" ± ")
    assert float(error) == pytest.approx(100, rel=1e-3) and at.endswith("% at 0.03 %")


def test_the_notes_say_direction_size_and_range():
    found = evidence(lambda ground: theory(ground, 1.25), THREE)
    said = next(text for text in found.conclusions if text.startswith(f"{FITTED}: the stiffness"))
    assert said == (
        f"{FITTED}: the stiffness is 20 to 20 % below that of boundary elements from 0.03 to 3 % contact in "
        "Persson's theory."
    )
