"""One question has one answer: of models that disagree, of the mean or of one surface, and where no half-space is."""

import csv
import io
import json
import math
import re
from dataclasses import fields, replace

import numpy as np
import pytest

import validation
from tests.advice.planted_answers import Fake, Finding, compared, planted, punch, wheel
from tests.seeded import catches
from validation.advice import advice
from validation.advice import advice as on_mdr
from validation.advice.compare import Comparison, SceneProblem
from validation.advice.exported import to_csv
from validation.advice.hierarchy import ALIKE, Candidate, contradict
from validation.advice.models_of_scene import models_of, quantities_of
from validation.advice.scene_model import Answer
from validation.advice.summary import findings, in_short, overview_of, summary
from validation.simulation.model import Cost, ErrorEstimate


def answer(value, model=0.0, grid=0.0, sample=0.0, **more):
    return Answer(
        value=np.atleast_1d(value), cost=Cost(work=1, seconds=1.0), model=model, grid=grid, sample=sample, **more
    )


@pytest.mark.parametrize(
    ("other", "errors", "tolerance", "apart"),
    [
        (1.3, (0.1, 0.1), 0.1, True),
        # 1.2 < 1.1 * 1.1
        (1.2, (0.1, 0.1), 0.1, False),
        # intervals lie apart, values are within the tolerance
        (1.04, (0.01, 0.01), 0.05, False),
        (1 / 1.3, (0.1, 0.1), 0.1, True),
        (9.0, (math.inf, 0.1), 0.1, False),
    ],
)
def test_answers_contradict_beyond_both_intervals_and_the_tolerance(other, errors, tolerance, apart):
    one, two = (answer(value, model=error) for value, error in zip((1.0, other), errors, strict=True))
    assert contradict(one, two, tolerance) is contradict(two, one, tolerance) is apart


def test_levels_contradict_by_the_root_mean_square_and_those_of_a_rail_in_bands_that_count():
    flat = np.ones(4)
    once = np.array([1.4, 1.0, 1.0, 1.0])  # the rms of ln 1.4 / 2 = 0.17 is inside of 2 ln 1.1 = 0.19
    assert not contradict(answer(flat, 0.1), answer(once, 0.1), 0.1)
    assert contradict(answer(flat, 0.1), answer(flat * 1.4, 0.1), 0.1)
    bands = {"model": np.full(4, 0.5), "grid": np.zeros(4), "sample": np.zeros(4)}
    for counts, apart in (((True,) * 4, True), ((False, True, True, True), False)):
        about = {"band_errors": bands, "counts": counts}
        assert contradict(answer(flat, **about), answer(once, **about), 0.1) is apart


@pytest.mark.parametrize(("decibels", "apart"), [(0.8, False), (0.95, False), (1.05, True)])
def test_errors_in_bands_of_two_answers_add_up_as_if_they_went_opposite_ways(decibels, apart):
    """Both of 0.5 dB: intervals of levels that are less than 1 dB apart overlap."""
    one, other = (
        answer(np.array([1.0, value]), band_errors={"model": half, "grid": 0 * half, "sample": 0 * half})
        for value, half in ((1.0, np.full(2, 0.5)), (10 ** (decibels / 20), np.full(2, 0.5)))
    )
    assert contradict(one, other, 0.05) is contradict(other, one, 0.05) is apart


@catches("a contradiction that nobody looks for").at(
    "validation.advice.hierarchy.contradicting", lambda found, one: None
)
@catches("the model with the smallest error, however biased").at(
    "validation.advice.hierarchy.bias", lambda answer: (answer.error, 0.0)
)
def test_no_model_is_selected_that_a_less_biased_one_contradicts():
    """Springs find 4 % and are 30 % off boundary elements: those are the answer, within the tolerance or not."""
    springs = Finding(name="springs", is_mdr=True, parts=(0.04, 0, 0), value=(1.0,))
    for left, met in ((0.03, True), (0.08, False)):
        grid = Finding(name="grid", parts=(0, left, 0), value=(1.3,), claimed=0.0)
        found = compared(springs, grid, tolerance="5%", solve_all=True)
        assert (found.model, found.met, found.value) == ("grid", met, 1.3)
        assert found.models["springs"].status == "not accurate enough"
        assert found.models["springs"].reason.startswith(
            "grid, with less bias, is 30 % away, beyond the errors of both"
        )
        assert on_mdr.in_short(found) == "MDR (springs) is not accurate enough: grid, with less bias, contradicts it"
    # a cheaper one of more bias is no evidence
    rough = Finding(name="rough", parts=(0.1, 0, 0), value=(2.0,), claimed=0.1)
    assert compared(rough, springs, tolerance="5%", solve_all=True).model == "springs"
    unlike = compared(springs, Finding(name="near", parts=(0, 0.03, 0), value=(1.06,)), tolerance="5%", solve_all=True)
    assert unlike.model == "springs" and unlike.met


@catches("errors that a sample tells apart", sample=0.12, name="grid").at("validation.advice.hierarchy.ALIKE", 1.0)
@pytest.mark.parametrize(("sample", "name"), [(0.12, "grid"), (0.1 * ALIKE, "grid"), (0.1 * ALIKE + 0.01, "springs")])
def test_of_errors_that_are_alike_the_less_biased_model_is_taken(sample, name):
    springs = Finding(name="springs", parts=(0.1, 0, 0))
    found = compared(springs, Finding(name="grid", parts=(0, 0, sample), value=(1.05,)), tolerance="5%")
    assert found.model == name and not found.met


@catches("a prediction told as a solve").at("validation.advice.advice.is_solved", lambda comparison, springs: True)
def test_a_sentence_on_springs_that_were_not_solved_says_predicted():
    cheaper, springs = Fake(name="formula", seconds=0.5), Fake(name="line", is_mdr=True, claimed=0.1)
    found = compared(cheaper, springs)
    for text in (findings([found], in_short), summary(found), "".join(on_mdr.in_full(found))):
        text = " ".join(text.split())
        assert (
            "is predicted to be accurate enough" in text
            or "predicted to be accurate enough: its predicted error" in text
        )
        assert "is accurate enough: " not in text and "not solved (--models mdr solves it)" in text
    assert overview_of([found])["MDR"] == ["10 %, predicted"]
    assert overview_of([compared(cheaper, springs, solve_all=True)])["MDR"] == ["0 %"]


def test_springs_that_were_solved_and_are_enough_go_before_a_prediction():
    grid, predicted = Finding(name="grid", seconds=0.1), Fake(name="a", is_mdr=True)
    solved = Finding(name="b", is_mdr=True, parts=(0.1, 0, 0))
    found = compared(grid, predicted, solved, also=lambda model: model.name == "b")
    assert on_mdr.in_short(found).startswith("MDR (b) is accurate enough: its error")


SINGLE = validation.MeasuredHeights(height=np.random.default_rng(0).normal(size=(32, 32)) * 1e-7, spacing=(1e-5, 1e-5))


def of_ground(ground, **more):
    return compared(Finding(value=(5.0,)), scene=punch(load=1.0, ground=ground, **more))


@pytest.mark.parametrize(
    ("found", "said"),
    [
        (compared(Finding(value=(5.0,))), "ensemble mean"),
        (of_ground(SINGLE, size=3.2e-4), "single surface"),
        (of_ground(None), None),
        (planted("rolling_wheel", "force-spectrum"), "ensemble mean"),
    ],
)
def test_what_is_of_the_mean_and_what_of_one_surface_says_so(found, said):
    assert json.loads(validation.to_json(found))["statistic"] == said
    first = next(csv.DictReader(io.StringIO(to_csv(found))))
    assert first.get("statistic") == said
    for text in (findings([found], in_short), summary(found)):
        assert [name in text for name in ("ensemble mean", "single surface")] == [
            name == said for name in ("ensemble mean", "single surface")
        ]


def heavy(scene, over):
    """The load at which the mean pressure is so much of E*: of Hertz 4 a / (3 pi R)."""
    if scene.get("shape") == "punch":
        return over * scene["modulus"] * scene["size"] ** 2
    radius = scene.get("radius", scene.get("size"))
    a = over * 3 * math.pi * radius / 4
    return 4 / 3 * scene["modulus"] * a**3 / radius


BODY = {"name": "it", "modulus": 1e11}
BODIES = [
    (validation.IndentationScene, BODY | {"shape": "punch", "size": 1e-3}),
    (validation.IndentationScene, BODY | {"shape": "sphere", "size": 1e-2}),
    (validation.RollingScene, BODY | {"radius": 0.5, "ground": wheel().ground}),
]


@catches("a half-space that bears any pressure", *BODIES[0]).at(
    "validation.advice.compare.beyond_elasticity", lambda scene: ""
)
@catches("the peak for the mean pressure", *BODIES[1]).at(
    "validation.scenes.scene.ContactEllipse.mean_pressure",
    property(lambda contact: 1.5 * contact.load / (math.pi * contact.along**2)),
)
@pytest.mark.parametrize(("kind", "about"), BODIES)
def test_no_model_is_enough_beyond_linear_elasticity(kind, about):
    for over, holds in ((0.099, True), (0.101, False), (9.4, False)):
        scene = kind(**about, load=heavy(about, over))
        found = compared(Finding(is_mdr=True, value=(5.0,)), scene=scene, quantity=quantities_of(scene)[0])
        assert found.selection.met and found.met is holds and (found.beyond_elasticity == "") is holds
        written = json.loads(validation.to_json(found))
        assert written["met"] is holds and (written["beyond_elasticity"] is None) is holds
        text = " ".join(findings([found], in_short).split())
        assert ("linear elasticity does not hold" in text) is not holds
        assert ("MDR (fake) is accurate enough" in text) is holds and (": outside tolerance" in text) is not holds
        assert holds or re.search(rf"the mean pressure is {over:.2g} E\*, above 0.1 E\*", text)
    unit = kind(**(about | {"modulus": 1.0}), load=heavy(about | {"modulus": 1.0}, 9.4))
    assert compared(Finding(value=(5.0,)), scene=unit, quantity=quantities_of(unit)[0]).met  # the unit of pressure


def test_a_punch_at_an_absurd_load_ends_with_status_3_and_the_rail_is_no_exception():
    scene = validation.IndentationScene(**BODY, shape="punch", size=1e-3, load=9.4e5)
    found = validation.compare(scene)
    assert found.model == "closed form" and not found.met and not found.selection.met
    (alone,) = found.models
    assert alone.status == "not accurate enough" and "linear elasticity does not hold" in alone.reason
    assert "rejected: no elastic half-space" in summary(found) and "is accurate enough" not in summary(found)
    assert "  selected\n" not in summary(found)
    rail = validation.load_scene("rail")
    loaded = Comparison(type(rail)(**{**vars_of(rail), "load": 1e10}), "contact-filter", found.selection)
    assert "wheel.load, wheel.radius" in loaded.beyond_elasticity and not loaded.met


def vars_of(scene):
    return {field.name: getattr(scene, field.name) for field in fields(scene)}


ROUGH = validation.load_scene("rough_punch")


@catches("no number of realisations would do").at(
    "validation.advice.advice.sufficient_realisations", lambda one, tolerance: 0
)
def test_where_the_sample_is_the_error_a_number_of_realisations_is_advised_that_does():
    """N = (2 s / (0.9 t))^2: with as many, the tolerance is met, and the command tells what they cost before."""
    found = validation.compare(ROUGH, tolerance="4%", models=["boundary elements 64²", "springs"], realisations=8)
    assert not found.met and found.model == "boundary elements 64²"
    (line,) = advice.would_help(found)
    match = re.search(
        r"(\d+) realisations by boundary elements 64², about (.*) \(8 were solved\): --realisations (\d+)", line
    )
    assert match and match[1] == match[3]
    assert "scatter of the surfaces" in line and "lower roughness" not in line


@pytest.mark.parametrize(("model", "tolerance"), [(0.05, 0.15), (0.2, 0.3)])
def test_realisations_that_are_advised_leave_the_sample_what_the_model_does_not_take(model, tolerance):
    """One that leaves 5 % of 15 % needs as many as one that leaves none of 10 %; none do where it leaves all."""

    def wanted(left, within):
        found = answer(1.0, model=left, sample=0.4, realisations=8)
        estimate = ErrorEstimate(model=left, reason="")
        one = Candidate(Fake(is_sampled=True), "not accurate enough", "", estimate, found)
        return advice.sufficient_realisations(one, within)

    alone = wanted(0.0, 0.1)
    assert alone > 50 and wanted(model, tolerance) == alone
    assert wanted(model, model) == wanted(model, 0.9 * model) == 0


@pytest.mark.parametrize("crown", [0.1, 1.0])
def test_the_mean_pressure_on_a_rail_is_that_of_its_ellipse(crown):
    """Two thirds of the largest, by which the load is the integral over half of an ellipsoid."""
    rail = replace(validation.load_scene("rail"), crown_radius=crown)
    x, y = np.meshgrid(*2 * [(np.arange(1000) + 0.5) / 500 - 1], indexing="ij")
    a, b = rail.contact.along, rail.contact.across
    assert abs(a / b - 1) > 0.05
    shape = np.sqrt(np.maximum(1 - x**2 - y**2, 0)).mean() * 4 * a * b
    assert rail.mean_pressure == pytest.approx(2 / 3 * rail.load / shape, rel=1e-3)


@pytest.mark.parametrize("count", [9, 36, 400])
def test_the_sample_that_is_claimed_of_so_many_realisations_is_half_of_a_95_per_cent_interval(count):
    """About two standard errors, and never less than those of a normal mean."""
    model = next(
        one for one in models_of(ROUGH, "stiffness", 0.01, 0, realisations=count) if one.name == "boundary elements 64²"
    )
    standard_error = model.sampling.scatter / math.sqrt(count)
    assert 1.96 * standard_error <= model.estimate().sample <= 2.5 * standard_error


@catches("as many realisations as ever").at("validation.advice.scene_model.replace", lambda plan, **_: plan)
def test_so_many_realisations_are_solved_as_are_asked():
    for count in (2, 9):
        found = validation.compare(ROUGH, tolerance="1%", models=["boundary elements 64²"], realisations=count)
        assert found.models["boundary elements 64²"].answer.realisations == count
    sample = [found.selection.solved[0].answer.sample for count in (9,)]
    assert sample[0] > 0


@pytest.mark.parametrize(
    ("scene", "realisations", "said"),
    [
        ("sphere", 20, "realisations must be left out for scene 'Smooth sphere', got 20: its body is smooth"),
        ("rail", 20, "got 20: each model of a rail has as many strips"),
        ("rough_punch", 1, "realisations must be at least 2, got 1"),
        ("rough_punch", 10**6, "realisations must be from 2 to 100000, got 1000000"),
    ],
)
def test_realisations_are_refused_where_none_are_drawn(scene, realisations, said):
    with pytest.raises(ValueError, match=re.escape(said)):
        validation.compare(validation.load_scene(scene), realisations=realisations)


def test_realisations_are_of_the_key_of_a_stored_scene():
    one, other = (SceneProblem(ROUGH, ("stiffness",), "5%", realisations=count) for count in (None, 20))
    assert repr(one) != repr(other)
