"""Where what lies across is left out, both ends of it limit every model: no solve is made that cannot help."""

from dataclasses import replace

import pytest

from validation.scenes.load import load_scene
from validation.selection.compare import compare
from validation.selection.summary import what_would_help

RAIL = load_scene("rail")
OPEN = replace(RAIL, across=None)


def test_no_model_is_solved_that_what_lies_across_makes_too_wide():
    names = []
    found = compare(OPEN, quantity="contact-filter", tolerance="1 dB", callback=lambda one: names.append(one.name))
    assert names == ["linear, ellipse"] and not found.met
    (missed, helps) = what_would_help(found)
    assert missed.startswith("not reached: the tolerance of 1 dB")
    assert 'across = "isotropic" or "ridges" in [rail]' in helps


@pytest.mark.parametrize(("scene", "tolerance"), [(RAIL, "0.2 dB"), (OPEN, "1.6 dB")])
def test_a_solve_that_may_help_is_made(scene, tolerance):
    """The ground is known, or both ends are within the tolerance."""

    class AskedError(Exception):
        pass

    def stop(model):
        raise AskedError(model.name)

    with pytest.raises(AskedError, match="boundary elements"):
        compare(scene, quantity="contact-filter", tolerance=tolerance, callback=stop)
