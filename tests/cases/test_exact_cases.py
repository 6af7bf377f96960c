"""Claims of the exact cases: they hold on sound solves, and a planted error turns status and answer."""

from dataclasses import replace
from types import MappingProxyType

import numpy as np
import pytest

from validation.analysis.evidence import ClaimStatus, Verdict
from validation.cases.exact import geike, hertz, square_punch, westergaard

HERTZ = hertz.run(hertz.Hertz(cells_per_radius=(4, 6, 8), load_steps=2))
SQUARE = square_punch.run(square_punch.SquarePunch())
WAVE = westergaard.run(westergaard.Westergaard(loads=(0.3, 0.5), cells=(32, 64, 128)))
DRAWN = geike.run(geike.Geike(cells=128, surfaces=2, longest=4))


def of(module, result, found=MappingProxyType({})):
    """Claims of a result, some of whose outcomes are others."""
    return module.CASE.evidence(replace(result, found=result.found | found)).claims


def times(outcomes, factor, *names):
    """Outcomes with a factor on some of their values."""
    return [o | {name: factor * o[name] for name in names} for o in outcomes]


def test_both_methods_have_hertz_on_few_cells():
    assert [claim.status for claim in of(hertz, HERTZ)] == [ClaimStatus.HOLDS]


@pytest.mark.parametrize("model", [hertz.BEM, hertz.MDR])
def test_a_force_that_is_off_by_two_per_cent_contradicts_hertz(model):
    """(dx/a)^2 / 4 is 0.4 % on these grids; the answer has what is left."""
    key = model, "grids"
    (claim,) = of(hertz, HERTZ, found={key: times(HERTZ[key], 1.02, "force")})
    assert claim.status is ClaimStatus.CONTRADICTED
    assert f"{model}, force at the given approach over Hertz: off by +2." in claim.answer


def test_the_square_the_model_of_its_length_and_the_quoted_factor():
    found = square_punch.CASE.evidence(SQUARE).claims
    assert [claim.status for claim in found] == [ClaimStatus.HOLDS, *2 * [ClaimStatus.CONTRADICTED]]
    soft = replace(SQUARE, found={n: one | {"square": 0.99 * one["square"]} for n, one in SQUARE.found.items()})
    assert square_punch.CASE.evidence(soft).claims[0].status is ClaimStatus.CONTRADICTED
    assert "1 beside 1.1523" in found[1].answer


def test_one_wrong_load_contradicts_westergaard():
    """Of two loads one has a contact that is two cells too wide at either edge."""
    assert of(westergaard, WAVE)[0].status is ClaimStatus.HOLDS
    wide = [o | {"half_width": o["half_width"] + 2 * np.diff(o["x"])[0]} for o in WAVE[0.3]]
    (claim,) = of(westergaard, WAVE, found={0.3: wide})
    assert claim.status is ClaimStatus.CONTRADICTED
    assert claim.count(Verdict.DIFFER) == 1


def test_the_line_is_not_geikes_spectrum_and_would_be_told_if_it_were():
    keeps, differs, line = of(geike, DRAWN)
    assert differs.status is line.status is ClaimStatus.HOLDS
    assert keeps.status is ClaimStatus.CONTRADICTED or "height" not in keeps.limits
    spectrum = DRAWN[geike.PROFILES][0]["spectrum"]
    by_geike = {geike.SURFACES: [o | {"spectrum": spectrum} for o in DRAWN[geike.SURFACES]]}
    _, differs, line = of(geike, DRAWN, found=by_geike)
    assert differs.status is line.status is ClaimStatus.CONTRADICTED


def test_a_study_hands_on_what_is_lost():
    assert geike.CASE.evidence(replace(DRAWN, unconverged=("surface 3",))).unconverged == ("surface 3",)
