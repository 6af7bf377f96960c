"""Faults planted in how models of somebody's own are calibrated and chosen, and the test that must catch each."""

import math
from dataclasses import replace
from functools import partial

from tests.judging import test_own_models
from tests.planted_faults.wrong import Fault, module_with
from validation.advice.calibration_scenes import Answers
from validation.judging import files_read as read_files
from validation.judging import own_kinds, own_models
from validation.judging import worker as others
from validation.railway.problems.rail_models import ContactFilter
from validation.simulation.model import ErrorEstimate

scenes_of = Answers.scenes


def as_reference(name, a3):
    return ContactFilter(name=name, closed=lambda quantity: a3, is_reference=True)


def next_scenes(answers, group):
    return ((replace(point, number=point.number + 1), *rest) for point, *rest in scenes_of(answers, group))


def code_of(visitor):
    return read_files.digest_of(path for path in visitor.sources if path.suffix == ".py")


FAULTS = [
    test_own_models.test_the_key_has_the_bytes_of_modules_and_data_that_a_call_reads,
    Fault("a key without the bytes of a module that the file loads").at(
        others.Visitor, "digest", property(lambda visitor: read_files.digest_of([visitor.path]))
    ),
    Fault("a key without the bytes of data that the file reads").at(others.Visitor, "digest", property(code_of)),
    Fault("a key that is taken before a call loads a module").at(own_models, "_probe", lambda called: None),
    partial(test_own_models.test_a_law_that_is_wrong_by_thirty_per_cent_claims_that_and_is_not_chosen, 0.7),
    Fault("a claim that is a distance of logarithms").at(own_models, "math", module_with(math, expm1=float)),
    test_own_models.test_without_references_an_error_is_unknown_and_nothing_is_chosen,
    Fault("a model without references that is chosen").at(
        own_models.OwnModel, "_claim", lambda own, *_: ErrorEstimate(reason="none is known")
    ),
    test_own_models.test_each_error_is_that_of_its_own_scene_and_no_less_than_the_answer_leaves,
    Fault("the error of the next scene of the calibration").at(Answers, "scenes", next_scenes),
    test_own_models.test_surfaces_are_those_that_boundary_elements_have,
    Fault("surfaces of another seed than those of the reference").at(own_models, "OTHER_SEED", 0),
    test_own_models.test_a_function_without_a_file_is_neither_calibrated_nor_stored,
    Fault("a function without a file that is stored").at(own_models, "_digest_of_file", lambda offered: "a file"),
    test_own_models.test_a_filter_of_a_rail_claims_what_the_same_one_of_the_package_does,
    Fault("a filter of somebody's own that is the reference").at((own_kinds, own_models), "filter_of", as_reference),
]
