"""The interface case on outcomes made up: exponents, theory beside them, finer cells, the punch in series."""

import numpy as np
import pytest

from tests.seeded import catches
from validation.analysis.case import Outcomes
from validation.analysis.claim_text import NOT_THIS_CURVE
from validation.analysis.evidence import ClaimStatus, Number, Verdict, numbers_with
from validation.cases.punch import interface_study
from validation.cases.punch.interface import (
    BESIDE_BEM,
    BOUNDED,
    CONTACT,
    EXPONENT,
    FITTED,
    GAP,
    OF_HALF,
    OF_SERIES,
    OVER_LOAD,
    PUNCH,
    ROLL_OFF,
    Interface,
)
from validation.theory.interface import persson_stiffness

CASE = Interface(grounds=((4, 0.7), (8, 0.7)), surfaces=6, refined=4, profiles=8)
THREE = Interface(grounds=((4, 0.7), (8, 0.7)), pressed=(8, 0.7), surfaces=6, refined=4, profiles=8)


def outcome(stiffness, count, finer=1.0):
    """The same in every draw but for some noise; on cells half as wide so many times as stiff."""
    noise = 1 + 1e-4 * np.random.default_rng(0).standard_normal((count, 1))
    rows = dict.fromkeys(("area", "gap"), stiffness * noise) | {"stiffness": finer * stiffness * noise}
    work = dict.fromkeys(("applications", "frozen applications"), np.full(rows["gap"].shape, 10.0))
    return {**rows, **work, "highest": np.full(count, 4 * CASE.height)}


def evidence(law, case=CASE, finer=1.0, flat=1.1523):
    """K = law(ground) on the interfaces; the punch in series with a flat one; springs twice as stiff."""
    found = {}
    for ground in case.grounds:
        for times, count in ((1, case.surfaces), (2, case.refined)):
            found[ground, times] = outcome(law(ground), count, finer if times == 2 else 1.0)
    punch = 1 / (1 / law(case.pressed) + 1 / flat)
    found |= {(PUNCH, 1): outcome(punch, case.surfaces), (PUNCH, 2): outcome(punch, case.refined)}
    found["springs"] = outcome(2 * punch, case.profiles)
    return interface_study.CASE.evidence(Outcomes(case, found))


def power(exponent):
    """Level at 3 % contact, where K = 2 p / h."""
    return lambda ground: (
        2 * CASE.pressures(ground)[4] * (CASE.pressures(ground) / CASE.pressures(ground)[4]) ** exponent
    )


def theory(ground, factor=1.0):
    spectrum = CASE.spectrum(ground)
    return factor * persson_stiffness(CASE.pressures(ground), c2d=spectrum.c2d, edges=spectrum.edges, modulus=1.0)


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


def test_springs_without_the_gap_have_no_number_and_barbers_bound_is_a_criterion():
    found = evidence(theory)
    assert len(numbers_with(found.numbers, GAP)) == 7
    (inside,) = numbers_with(found.numbers, BOUNDED)
    assert inside.met
    # h / 4 h at the least
    (outside,) = numbers_with(evidence(lambda ground: 0.2 * CASE.pressures(ground)).numbers, BOUNDED)
    assert not outside.met and outside.value == 0.0
