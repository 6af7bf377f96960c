"""What `compare` prints first: value, error, whether MDR is accurate enough, in three lines at most, nothing twice."""

import math

import pytest

import validation
from tests.advice.planted_answers import REASON, Fake, Finding, compared, planted, wheel
from tests.seeded import catches
from validation.__main__ import main
from validation.advice.models_of_scene import quantities_of
from validation.advice.summary import WIDTH, findings, in_short
from validation.scenes.load import bundled_for_compare


def answer_of(*quantities):
    """The first lines, up to a blank one."""
    return findings(quantities, in_short).strip("\n").partition("\n\n")[0].splitlines()


@pytest.mark.parametrize("name", bundled_for_compare())
def test_three_lines_at_most_begin_it(name):
    for quantity in quantities_of(validation.load_scene(name)):
        for statuses, error in ((("not needed", "accepted"), 0.01), (("skipped",), 0.5), (("out of range",), math.inf)):
            found = planted(name, quantity, "0.4 dB", statuses=statuses, error=error)
            # what does not fit into a line goes on in the next: nothing is cut
            lines = [line for line in answer_of(found) if not line.startswith(" ")]
            assert len(lines) == (3 if math.isfinite(error) else 2) and lines[-1].startswith("MDR ")
            text = findings([found], in_short)
            assert max(map(len, text.splitlines())) <= WIDTH and "..." not in text
            assert math.isfinite(error) or REASON.strip() in " ".join(text.split())


@catches("a missed tolerance told as met").at(
    "validation.advice.hierarchy.Selection.met", property(lambda selection: True)
)
def test_the_error_is_told_beside_what_was_wanted_with_what_is_left():
    found = compared(Finding(parts=(0.1, 0.03, 0.04)), tolerance="20%")
    assert answer_of(found)[:2] == [
        "stiffness = 1.00 ± 0.15 N/m (ensemble mean, by fake, 1 s): within tolerance",
        EACH_PART,
    ]
    alone = compared(Finding(parts=(0.1, 0, 0)))
    assert answer_of(alone)[1] == "error ± 10 % (95 %), all of it model error; tolerance 20 %"
    assert answer_of(compared(Finding()))[1] == "error ± 0 % (95 %); tolerance 20 %"
    beyond = compared(Finding(parts=(0, 0.1272, 0)), tolerance="1 dB")
    assert answer_of(beyond)[1] == "error ± 1.04 dB (95 %), all of it discretisation error; tolerance 1 dB"
    text = findings([beyond], in_short)
    assert answer_of(beyond)[0].endswith(": outside tolerance")
    assert text.count("a tolerance of 1.1 dB") == text.count("what would help") == 1 and "not reached" not in text


EACH_PART = "error ± 15 % (95 %), of which model 10 %, discretisation 3 %, sampling 4 %; tolerance 20 %"
"""0.1 + sqrt(0.03² + 0.04²) = 0.15."""


def test_the_error_of_levels_is_in_decibels_too_and_bands_stand_above():
    scene = wheel(mass=None, speed=None)
    found = compared(Finding(value=(0.1,) * 5, parts=(0.1, 0, 0)), scene=scene, quantity="force-spectrum")
    value, error, _ = answer_of(found)
    assert value == "force-spectrum in 5 bands (ensemble mean, by fake, 1 s): within tolerance"
    assert error.startswith("error ± 10 % (0.83 dB) over all bands (95 %)")
    assert "level [dB re 1 N]" in findings([found], in_short)


def test_quantities_of_a_rail_have_one_answer_with_the_force():
    both = [planted("rail", quantity) for quantity in quantities_of(validation.load_scene("rail"))[:2]]
    value, *_ = answer_of(*both)
    assert value.startswith("both in ") and "dB(A) re 1 pW" in value
    assert findings(both, in_short).count("  status\n") == 1


PREDICTED = (
    "its predicted error (ensemble mean) is {} %, an upper bound in 97 % of scenes; not solved (--models mdr solves it)"
)


@pytest.mark.parametrize(
    ("springs", "said"),
    [
        (Finding(is_mdr=True, parts=(0.1, 0, 0)), "accurate enough: it is selected"),
        (Finding(is_mdr=True, parts=(0.3, 0, 0)), "not accurate enough: its error (ensemble mean) is 30 %"),
        (Fake(is_mdr=True, claimed=0.62), f"not predicted to be accurate enough: {PREDICTED.format(62)}"),
        (Fake(is_mdr=True, claimed=math.inf), "not known to be accurate enough: claims inf"),
        (Fake(is_mdr=True, failed="it was lost"), "not known to be accurate enough: it was lost"),
    ],
)
def test_mdr_is_enough_or_not_and_why(springs, said):
    assert mdr_of(compared(springs, Fake(name="grid"), tolerance="12%")) == f"MDR (fake) is {said}"


def mdr_of(found):
    """The last sentence, in one line."""
    text = " ".join(line.strip() for line in answer_of(found))
    return text[text.index("MDR ") :]


def test_of_several_springs_the_selected_or_the_best_are_named():
    poor, good = Fake(name="line", is_mdr=True, claimed=0.5), Fake(name="surface", is_mdr=True, claimed=0.1)
    told = f"MDR (surface) is predicted to be accurate enough: {PREDICTED.format(10)}"
    assert mdr_of(compared(Fake(name="formula"), poor, good)) == told
    assert mdr_of(compared(Finding(name="chosen", is_mdr=True, parts=(0.15, 0, 0)), good)) == SELECTED
    assert mdr_of(compared(Fake(name="formula"))) == "MDR has no springs for this scene"


SELECTED = "MDR (chosen) is accurate enough: it is selected"


@pytest.mark.parametrize("option", [[], ["-v"], ["--verbose"]])
def test_the_rest_is_told_by_verbose(option, capsys):
    assert main(["compare", "sphere", *option]) == 0
    text = capsys.readouterr().out
    rest = ("\nwhy\n", "errors of models: ", "cost of the solves: ")
    assert [part in text for part in rest] == [bool(option)] * 3
    assert text.startswith("Smooth sphere: stiffness within 10 %\n")
    assert option or text.startswith(FIRST)


FIRST = """Smooth sphere: stiffness within 10 %

stiffness = 9.3649e8 N/m (by closed form, 1 ms): within tolerance
error ± 0 % (95 %); tolerance 10 %
MDR has no springs for this scene

model        predicted  estimated     cost  status
"""
