"""Claims of the exact cases: they hold on sound solves, and a planted error turns their status."""

import numpy as np
import pytest

from tests.cases.planted import changed, statuses, times
from validation.analysis.evidence import ClaimStatus, Verdict
from validation.cases.exact import geike, hertz, square_punch, westergaard

HERTZ = hertz.run(hertz.Hertz(cells_per_radius=(4, 6, 8), load_steps=2))
SQUARE = square_punch.run(square_punch.SquarePunch())
WAVE = westergaard.run(westergaard.Westergaard(loads=(0.3, 0.5), cells=(32, 64, 128)))
DRAWN = geike.run(geike.Geike(cells=128, surfaces=2, longest=4))
HOLDS, CONTRADICTED = ClaimStatus.HOLDS, ClaimStatus.CONTRADICTED


def of(module, result):
    return statuses(module.CASE.evidence(result))


@pytest.mark.parametrize("model", [hertz.BEM, hertz.MDR])
def test_both_methods_have_hertz_on_few_cells_and_a_force_that_is_off_by_two_per_cent_contradicts_it(model):
    """(dx/a)^2 / 4 is 0.4 % on these grids; the answer has what is left."""
    assert of(hertz, HERTZ) == [HOLDS]
    key = model, "grids"
    (claim,) = hertz.CASE.evidence(changed(HERTZ, {key: times(HERTZ[key], 1.02, "force")})).claims
    assert claim.status is CONTRADICTED
    assert f"{model}, force at the given approach over Hertz: off by +2." in claim.answer


def test_the_square_the_model_of_its_length_and_the_quoted_factor():
    assert of(square_punch, SQUARE) == [HOLDS, CONTRADICTED, CONTRADICTED]
    soft = {n: times([one], 0.99, "square")[0] for n, one in SQUARE.found.items()}
    assert of(square_punch, changed(SQUARE, soft))[0] is CONTRADICTED


def test_one_wrong_load_contradicts_westergaard():
    """Of two loads one has a contact that is two cells too wide at either edge."""
    assert of(westergaard, WAVE) == [HOLDS]
    wide = [one | {"half_width": one["half_width"] + 2 * np.diff(one["x"])[0]} for one in WAVE[0.3]]
    (claim,) = westergaard.CASE.evidence(changed(WAVE, {0.3: wide})).claims
    assert claim.status is CONTRADICTED and claim.count(Verdict.DIFFER) == 1


def test_the_line_is_not_geikes_spectrum_and_would_be_told_if_it_were():
    keeps, *of_line = geike.CASE.evidence(DRAWN).claims
    assert [claim.status for claim in of_line] == [HOLDS, HOLDS]
    assert keeps.status is CONTRADICTED or "height" not in keeps.limits
    spectrum = DRAWN[geike.PROFILES][0]["spectrum"]
    by_geike = [one | {"spectrum": spectrum} for one in DRAWN[geike.SURFACES]]
    assert of(geike, changed(DRAWN, {geike.SURFACES: by_geike}))[1:] == [CONTRADICTED, CONTRADICTED]
