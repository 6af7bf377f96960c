"""A comparison stays what it is, whatever the caller does with its arrays or those of a model."""

import copy
import pickle

import numpy as np
import pytest

from tests.advice.planted_answers import Finding, compared, planted, wheel
from tests.seeded import catches
from validation.advice.scene_model import Answer
from validation.simulation.model import Cost

COPIES = [lambda found: found, copy.copy, copy.deepcopy, lambda found: pickle.loads(pickle.dumps(found))]
AXES = ("value", "wavenumbers", "wavelength_mm", "frequency_hz", "nominal_hz", "roughness")


def arrays_of(found):
    yield from (getattr(found, name) for name in AXES)
    yield from found.error_parts_of(found.selection.best).values()
    for one in found.selection.solved:
        yield from (found.value_of(one), found.errors_of(one), found.a3_of(one), *found.error_parts_of(one).values())
        yield from (one.answer.value, *one.answer.band_errors.values())


@pytest.mark.parametrize("through", COPIES, ids=["itself", "copied", "deeply copied", "unpickled"])
@pytest.mark.parametrize(
    ("scene", "quantity"),
    [("rail", "contact-filter"), ("rail", "equivalent-roughness"), ("rolling_wheel", "force-spectrum")],
)
def test_no_array_of_a_comparison_can_be_written(scene, quantity, through):
    found = through(planted(scene, quantity))
    before = found.value.copy()
    for array in arrays_of(found):
        if array.size:
            with pytest.raises(ValueError, match="read-only"):
                array[...] = 7.0
    assert np.array_equal(found.value, before)


@catches("one number as an array").at(
    "validation.advice.compare.Comparison._number_or_levels", lambda found, values: values
)
def test_one_number_is_a_float():
    found = compared(Finding(value=(3.0,), parts=(0.1, 0.02, 0.03)))
    numbers = found.value, found.value_of(found.models[0]), found.errors_of(found.models[0]), compared().value
    assert {type(number) for number in (*numbers, *found.error_parts_of(found.models[0]).values())} == {float}
    assert found.value == 3.0 and found.error_parts_of(found.models[0])["grid"] == pytest.approx(0.06)
    assert np.isnan(compared().value)


def test_an_answer_has_a_copy_of_what_a_model_returned():
    returned, bands = np.array([1.0, 2.0]), {"model": np.array([0.1, 0.2])}
    answer = Answer(value=returned, cost=Cost(work=1, seconds=1.0), band_errors=bands)
    returned[:], bands["model"][:] = 7.0, 7.0
    assert answer.value.tolist() == [1.0, 2.0] and answer.band_errors["model"].tolist() == [0.1, 0.2]


@catches("levels that can be written").at(
    ("validation.advice.compare.kept", "validation.advice.scene_model.kept"), lambda array: array.copy()
)
def test_levels_of_a_wheel_cannot_be_written():
    found = compared(Finding(value=(0.1,) * 5), scene=wheel(), quantity="force-spectrum")
    assert not found.value.flags.writeable
