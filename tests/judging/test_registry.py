"""What a function may ask for: every other argument is refused in a sentence that lists those that it can have."""

import copy
import functools
import inspect
import multiprocessing
import pickle
import pydoc
import subprocess
import sys
from functools import partial
from importlib.metadata import EntryPoint
from pathlib import Path

import numpy as np
import pytest

import validation
from tests.seeded import catches, module_with
from validation.judging import source_files as installed
from validation.judging.own_models import named_in
from validation.judging.registry import KINDS, OfferedError
from validation.judging.worker import Called


def test_a_decorated_function_is_called_as_before():
    @validation.stiffness_model("mine")
    def mine(load, side):
        return load / side

    assert (mine(6.0, side=2.0), mine.name, mine.kind, mine.asks) == (3.0, "mine", "stiffness_model", ("load", "side"))


@validation.stiffness_model("placed")
def placed(load: float, side: float = 2.0) -> float:
    """The load over the side."""
    return load / side


@catches("an offered function that has lost its signature").at(
    "validation.judging.registry.functools", module_with(functools, update_wrapper=lambda wrapper, wrapped: wrapper)
)
def test_a_decorated_function_keeps_its_signature_and_its_documentation():
    again = validation.stiffness_model("placed")(placed.function)
    assert str(inspect.signature(again)) == "(load: float, side: float = 2.0) -> float"
    assert (again.__name__, again.__doc__) == ("placed", "The load over the side.")
    shown = pydoc.render_doc(again, renderer=pydoc.plaintext)
    assert "placed(load, side)" in shown and "The load over the side." in shown
    assert len(repr(placed)) < 100 and "@stiffness_model('placed')" in repr(placed)
    assert validation.stiffness_model("lambda")(lambda load: load).__doc__.startswith("@stiffness_model('lambda')")
    assert validation.stiffness_model("part")(partial(lambda load, side: load, side=1.0))(load=2.0) == 2.0


def test_a_decorated_function_is_copied_and_pickled_as_a_function_is():
    for same in (copy.copy(placed), copy.deepcopy([placed])[0], pickle.loads(pickle.dumps(placed))):
        assert same is placed
    assert b"load / side" not in pickle.dumps(placed)


@catches("a model of a notebook without its code").at("validation.judging.registry._by_value", lambda function: None)
def test_a_function_without_a_place_is_pickled_with_its_code():
    pytest.importorskip("cloudpickle")
    factor = 3.0

    @validation.contact_solver("local", periodic=True)
    def local(gap, force):
        return factor * gap

    try:
        other = pickle.loads(pickle.dumps(local))
    except pickle.PicklingError as error:
        raise AssertionError from error
    assert other is not local and other(2.0, None) == 6.0
    assert (other.name, other.kind, other.asks, other.options) == (local.name, local.kind, local.asks, local.options)


def test_without_cloudpickle_a_function_without_a_place_is_refused(monkeypatch):
    monkeypatch.setitem(sys.modules, "cloudpickle", None)
    with pytest.raises(pickle.PicklingError, match=r"'local' must stand at the top of a module .* install cloudpickle"):
        pickle.dumps(validation.stiffness_model("local")(lambda load: load))


SCRIPT = """
import multiprocessing, sys
from concurrent.futures import ProcessPoolExecutor
import validation

@validation.stiffness_model("in series")
def series(load, side, modulus):
    return 1 / (1e-9 / load + 1 / (1.1523 * modulus * side))

def compared(name):
    return validation.compare(validation.load_scene(name), models=[series, "fit"])

if __name__ == "__main__":
    for start in sys.argv[1:]:
        with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context(start)) as pool:
            result = pool.submit(compared, "rough_punch").result()
            judgement = pool.submit(validation.judge, series).result()
        assert validation.to_json(result) == validation.to_json(compared("rough_punch"))
        assert judgement.as_dict() | {"seconds": 0} == validation.judge(series).as_dict() | {"seconds": 0}
        print(start, result.models["in series"].name, judgement.model)
"""


@pytest.mark.slow
def test_results_and_models_of_a_script_go_through_pools(tmp_path):
    starts = [start for start in ("fork", "spawn", "forkserver") if start in multiprocessing.get_all_start_methods()]
    (tmp_path / "script.py").write_text(SCRIPT, encoding="utf-8")
    words = [sys.executable, "script.py", *starts]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, encoding="utf-8")
    assert done.stdout.splitlines() == [f"{start} in series in series" for start in starts], done.stderr


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_has_a_decorator_of_its_name_whose_example_it_takes(kind):
    space = {}
    exec(KINDS[kind].example, space)
    function = next(value for name, value in space.items() if name != "__builtins__")
    found = getattr(validation, kind)("shown")(function)
    assert (found.kind, found.name) == (kind, "shown")
    assert found.options == KINDS[kind].options


WRONG = [
    ("stiffness_model", lambda laod: 1, "'mine': laod is unknown: @stiffness_model may ask for load, side, modulus, "),
    ("stiffness_model", lambda *loads: 1, r"by name, one by one, got \*loads: .* may ask for load, side"),
    ("stiffness_model", lambda **given: 1, "one by one"),
    ("stiffness_model", lambda load, /: 1, "one by one"),
    ("stiffness_model", 3.0, "must stand above a function, got 3.0"),
    ("stiffness_of_surface", lambda load: 1, "height must be asked for"),
    ("force_spectrum", lambda radius: 1, "q must be asked for"),
    ("profile_spectrum", lambda q: 1, "roughness must be asked for"),
    ("contact_filter", lambda a_x: 1, "k_x must be asked for"),
    ("contact_law", lambda position: 1, "approach must be asked for"),
    ("contact_solver", lambda force: 1, "gap must be asked for"),
    ("rolling_model", lambda height, load, line: 1, "either height or line must be asked for, got height and line"),
    ("rolling_model", lambda line: 1, "either approach or load must be asked for, got neither"),
    ("contact_solver", lambda gap, force, approach: 1, "either force or approach must be asked for, got force and app"),
]


@pytest.mark.parametrize(("kind", "function", "sentence"), WRONG)
def test_another_signature_is_refused_in_one_sentence(kind, function, sentence):
    with pytest.raises(TypeError, match=sentence) as refused:
        getattr(validation, kind)("mine")(function)
    assert "\n" not in str(refused.value)


def test_both_of_a_pair_are_served_where_both_are_none_by_default():
    solver = validation.contact_solver("both")(lambda gap, force=None, approach=None: gap)
    assert solver.asks == ("gap", "force", "approach")


def test_what_a_partial_function_has_already_is_not_asked_for():
    def solve(gap, force, tolerance, smoother):
        return gap * 0 + force + tolerance + smoother

    offered = validation.contact_solver("bound")(partial(solve, tolerance=2.0, smoother=3.0))
    assert offered.asks == ("gap", "force")
    assert Called(offered).call(gap=np.zeros((2, 2)), force=1.0, tolerance=7.0) == pytest.approx(6.0)
    with pytest.raises(OfferedError, match="gap must be asked for"):
        validation.contact_solver("bound")(partial(solve, gap=1.0, smoother=3.0))


@pytest.mark.parametrize(
    ("name", "options", "sentence"),
    [
        ((len,), {}, r"must have a name, as @stiffness_model\(.my model.\), got <built-in function len>"),
        ((), {}, r"must have a name, as @stiffness_model\(.my model.\), got none"),
        (("a", "b"), {}, "must have a name, as .*, got 'a', 'b'"),
        (("",), {}, "must have a name"),
        (("a\nb",), {}, "must have a name"),
        (("mine",), {"periodic": True}, "option periodic is unknown: @stiffness_model has none"),
    ],
)
def test_a_name_is_a_text_and_options_are_those_of_the_kind(name, options, sentence):
    with pytest.raises(TypeError, match=sentence):
        validation.stiffness_model(*name, **options)
    with pytest.raises(TypeError, match=r"option residual must be as 0\.0001, got 'small'"):
        validation.contact_solver("mine", residual="small")
    with pytest.raises(TypeError, match="option cells must be as inf, got True"):
        validation.contact_solver("mine", cells=True)


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"free": False, "periodic": False}, "'mine': free or periodic must be True, got neither"),
        ({"residual": 0.01}, r"'mine': residual must be above zero and at most 0\.001, got 0\.01"),
        ({"residual": 0.0}, "residual must be above zero"),
        ({"residual": float("nan")}, "residual must be above zero"),
        ({"cells": 0}, "'mine': cells must be one or more, the most that a grid may have, got 0"),
        ({"cells": float("nan")}, "'mine': cells must be one or more"),
    ],
)
def test_a_solver_that_cannot_be_judged_is_refused_where_it_is_decorated(options, sentence):
    with pytest.raises(ValueError, match=sentence) as refused:
        validation.contact_solver("mine", **options)
    assert "\n" not in str(refused.value)
    assert validation.contact_solver("mine", free=False, periodic=True, residual=1e-3, cells=900)


def test_what_is_offered_already_is_not_offered_again():
    once = validation.stiffness_model("once")(lambda load: 1)
    with pytest.raises(TypeError, match="must stand above a function, got one that is offered already"):
        validation.stiffness_model("twice")(once)


def test_a_model_that_draws_has_one_number_a_call_and_another_may_have_two():
    shapes = KINDS["stiffness_model"].shapes
    assert (shapes({"load": 1.0}), shapes({"load": 1.0, "rng": None})) == (((), (2,)), ((),))


def test_a_function_is_named_by_its_file_and_kind(tmp_path):
    """Decorated as another kind, it is none of this one; without a decorator it has the options of the kind."""
    path = tmp_path / "named.py"
    body = (
        "@profile_spectrum('rule')\ndef rule(q, roughness): return q\ndef solve(gap, force): return gap\nnumber = 3\n"
    )
    path.write_text(f"from validation import profile_spectrum\n{body}", encoding="utf-8")
    assert named_in(f"{path}:rule", "profile_spectrum").name == "rule"
    solver = named_in(f"{path}:solve", "contact_solver")
    assert (solver.asks, solver.options) == (("gap", "force"), KINDS["contact_solver"].options)
    for name in ("rule", "number", "nobody"):
        with pytest.raises(ValueError, match=f"has no function '{name}' for @contact_solver"):
            named_in(f"{path}:{name}", "contact_solver")
    with pytest.raises(ValueError, match="there is no file"):
        named_in(f"{tmp_path}/nothing.py:rule", "profile_spectrum")


def test_a_file_comes_before_what_a_package_offers_under_its_name(tmp_path, monkeypatch):
    entry = EntryPoint("mine", "pack.models:series", installed.GROUP)
    monkeypatch.setattr(installed, "installed", lambda: {"mine": entry})
    monkeypatch.chdir(tmp_path)
    with installed.file_of("mine") as path:
        assert path.read_text(encoding="utf-8") == "from pack.models import series\n" and path.name.startswith(
            installed.ENTRY
        )
    (tmp_path / "mine").touch()
    with installed.file_of("mine") as path:
        assert path == Path("mine")
