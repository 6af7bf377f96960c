"""Claims of the exact cases: they hold on sound solves, and a planted error turns their status."""

import numpy as np
import pytest

import mdr
from tests.cases.planted import changed, judged, statuses, times
from tests.seeded import catches
from validation.analysis.evidence import ClaimStatus, Verdict
from validation.cases.exact import geike, hertz
from validation.simulation import exact_contacts as contacts

SMALL = hertz.Hertz(
    cells_per_radius=(4, 6, 8), load_steps=2, wave_cells=(32, 64, 128), loads=(0.3, 0.5), ellipse_cells=(16, 32)
)
CONTACTS = hertz.run(SMALL)
DRAWN = geike.run(geike.Geike())
HOLDS, CONTRADICTED = ClaimStatus.SUPPORTED, ClaimStatus.REFUTED
WIDE = [one | {"half_width": one["half_width"] + 2 * np.diff(one["x"])[0]} for one in CONTACTS[0.3]]
OFF = {
    "sphere by boundary elements": (0, {(hertz.BEM, "grids"): times(CONTACTS[hertz.BEM, "grids"], 1.02, "force")}),
    "sphere on springs": (0, {(hertz.MDR, "grids"): times(CONTACTS[hertz.MDR, "grids"], 1.02, "force")}),
    "square": (0, {hertz.PUNCH: times(CONTACTS[hertz.PUNCH], 0.99, "square")}),
    "circle": (0, {hertz.PUNCH: times(CONTACTS[hertz.PUNCH], 0.97, "circle")}),
    "wave": (0, {0.3: WIDE}),
    "ellipse": (1, {hertz.ELLIPSE: times(CONTACTS[hertz.ELLIPSE], 1.001, contacts.PRESSURE)}),
}
"""Which claim, and what is off: a force by two per cent, (dx/a)^2 / 4 is 0.4 %; a wave too wide by two cells a side."""


@catches("the stiffness of the square is that of the finest grid", contact="square").at(
    "validation.cases.exact.hertz.first_order_limit", lambda values: values[-1]
)
@catches("one of two elastic bodies taken for rigid", contact="ellipse").at(
    "validation.simulation.exact_contacts.PublishedContact.modulus", property(lambda problem: 2 * 82e9 / (1 - 0.28))
)
@pytest.mark.parametrize("contact", OFF)
def test_a_contact_that_is_off_contradicts_its_claim(contact):
    at, found = OFF[contact]
    expected = [HOLDS, HOLDS, HOLDS]
    assert statuses(hertz.CASE.evidence(CONTACTS)) == expected
    expected[at] = CONTRADICTED
    assert statuses(hertz.CASE.evidence(changed(CONTACTS, found))) == expected


def test_springs_as_long_as_the_side_are_softer_than_the_square_by_its_capacitance():
    (number,) = judged(hertz.CASE, CONTACTS, hertz.FULL, hertz.LENGTHS[0])
    assert number.value == pytest.approx(100 * (1 / 1.1523 - 1), abs=0.01) and number.verdict is Verdict.OUTSIDE


@catches("a line trace with the moments of Geike's spectrum").at(
    "validation.cases.exact.geike.mean_power_of_cosine", lambda n: 1.0
)
def test_a_profile_keeps_the_moments_and_a_line_the_share_of_its_direction():
    """Sums over 65 and more waves in place of integrals: the first wave counts whole, 0.7 / 65 of the height."""
    assert statuses(geike.CASE.evidence(changed(DRAWN, {geike.PROFILE: DRAWN[geike.LINES]}))) == [HOLDS]
    halved = {"moments": DRAWN[geike.PROFILE]["moments"] * [1, 0.5, 1]}
    assert statuses(geike.CASE.evidence(changed(DRAWN, {geike.PROFILE: DRAWN[geike.PROFILE] | halved}))) == [
        CONTRADICTED
    ]
    shares = geike.CASE.evidence(DRAWN).table(geike.SHARE)
    line, directions, profile = (
        shares.where(model=kind)["value"] for kind in (geike.LINES, geike.DIRECTIONS, geike.PROFILE)
    )
    np.testing.assert_allclose(line, directions, rtol=0.02)
    np.testing.assert_allclose(profile, 1.0, rtol=0.05)
    assert line[2] == pytest.approx(0.5, rel=0.02)


@catches("the spectrum of a line in Geike's place").at("mdr.SelfAffine.line", mdr.SelfAffine.c1d)
def test_lines_of_a_drawn_surface_have_the_line_trace():
    """A sum over waves across the line in place of an integral; the integrand is smooth there, and small at its end."""
    waves = np.arange(2 * DRAWN.case.longest, 3 * DRAWN.case.longest)
    line = DRAWN.case.spectrum.line(2 * np.pi / DRAWN.case.length * waves)
    assert np.mean(DRAWN[geike.LINES]["spectrum"][waves] / line) == pytest.approx(1.0, abs=2e-3)


@pytest.mark.parametrize("power", [0.5, 1.0, 2.0])
def test_the_order_of_errors_is_the_power_of_the_cell_size(power):
    """On grids of equal and of unequal steps, of either sign."""
    for cells in ((8, 16, 32, 64), (4, 6, 8, 24)):
        for sign in (1, -1):
            assert hertz.order(cells, sign * 3.0 / np.array(cells) ** power) == pytest.approx(power, abs=1e-12)


order = hertz.order


@catches("a tenth more in the order of a case", power=1.0).at(
    "validation.cases.exact.hertz.order", lambda cells, errors: order(cells, errors) + 0.1
)
@pytest.mark.parametrize("power", [1.0, 2.0])
def test_a_case_has_the_order_of_its_errors(power):
    """Planted errors of that power, of the sphere and of the square: numbers and data have it."""
    cells = np.array(SMALL.cells_per_radius)
    force = [{"force": SMALL.force * (1 + 0.1 / n**power)} for n in cells]
    square = [{"square": hertz.CAPACITANCE * (1 + 0.1 / n**power)} for n in SMALL.punch_cells]
    found = {
        (hertz.BEM, "grids"): [old | new for old, new in zip(CONTACTS[hertz.BEM, "grids"], force, strict=True)],
        hertz.PUNCH: [old | new for old, new in zip(CONTACTS[hertz.PUNCH], square, strict=True)],
    }
    result = changed(CONTACTS, found)
    for model in (f"{hertz.SPHERE}, {hertz.BEM}", hertz.PUNCH):
        (number,) = judged(hertz.CASE, result, hertz.ORDER, model)
        assert number.value == pytest.approx(power, abs=1e-6)
        assert number.verdict is (Verdict.WITHIN if number.reference == power else Verdict.OUTSIDE)
    errors = hertz.CASE.evidence(result).table(hertz.ERROR).where(model=f"{hertz.SPHERE}, {hertz.BEM}")
    np.testing.assert_allclose(errors["value"], 0.1 / cells**power)
