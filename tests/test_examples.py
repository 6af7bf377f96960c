"""Docstrings of what users call: examples that run, every argument described."""

import ast
import doctest
import inspect
import re
from pathlib import Path

import numpy as np
import pytest

import bem3d
import mdr
import validation
from validation.analysis.series import Margin
from validation.analysis.statistics import regression_mean
from validation.case import Case, Chart, Claim, Curve, Engine, Panel, Series, Study
from validation.scenes.rail_impedance import FreeBeam
from validation.scenes.scene import Scene

PUBLIC = {
    f"{package.__name__}.{member.__name__}": member
    for package in (mdr, bem3d, validation)
    for member in (getattr(package, name) for name in package.__all__)
    if callable(member)
}
"""Without the names of 0.1, which are the same objects, and without tables."""
CENTRAL = (Series, Margin, Claim, Study, Chart, Curve, Panel, Case, Engine, Scene)
"""What a case, a solve and a scene are made of, for whoever adds one."""
INNER = (FreeBeam, regression_mean)
"""Others with an example: formulas of which a number says more than a sentence."""
SHOWN = {**PUBLIC, **{f"{member.__module__}.{member.__name__}": member for member in (*CENTRAL, *INNER)}}
"""Whose docstrings have an example."""


def own_methods(kind):
    return {name: member for name, member in vars(kind).items() if inspect.isfunction(member) and name[0] != "_"}


CALLED = {
    **SHOWN,
    **{
        f"{name}.{method}": member
        for name, kind in PUBLIC.items()
        if inspect.isclass(kind)
        for method, member in own_methods(kind).items()
    },
}


@pytest.mark.parametrize("name", CALLED)
def test_examples(name):
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
    examples = {"np": np, "mdr": mdr, "bem3d": bem3d, "validation": validation}
    with np.printoptions(precision=4, suppress=True):
        for found in doctest.DocTestFinder(recurse=False).find(CALLED[name], name, globs=examples):
            runner.run(found, clear_globs=False)
    assert runner.failures == 0
    assert runner.tries > 0 or name not in SHOWN


def test_no_example_is_left_out():
    """Every docstring with an example is one of those that run."""
    kinds = (ast.Module, ast.ClassDef, ast.FunctionDef)
    files = (path for package in (mdr, bem3d, validation) for path in Path(package.__file__).parent.rglob("*.py"))
    trees = (ast.parse(text) for text in (path.read_text(encoding="utf-8") for path in files) if ">>>" in text)
    written = [ast.get_docstring(node) or "" for tree in trees for node in ast.walk(tree) if isinstance(node, kinds)]
    run = [inspect.getdoc(member) or "" for member in CALLED.values()]
    assert {text for text in written if ">>>" in text} <= {text for text in run if ">>>" in text}


def entries(member, section):
    """Names in a section of a docstring in numpy's convention."""
    text = inspect.getdoc(member)
    found = re.search(rf"^{section}\n-+\n(.*?)(?=\n\n\S[^\n]*\n-+\n|\Z)", text, flags=re.DOTALL | re.MULTILINE)
    heads = re.findall(r"^(\S[^\n]*?)(?: : [^\n]*)?$", found[1], flags=re.MULTILINE) if found else []
    return {name for head in heads for name in head.split(", ")}


@pytest.mark.parametrize("name", SHOWN)
def test_every_argument_is_described(name):
    member = SHOWN[name]
    if inspect.isclass(member) and issubclass(member, (Exception, str)):
        return
    # a protocol is not called: what it asks for are its properties
    asked = {member for member, kind in vars(Scene).items() if isinstance(kind, property)}
    arguments = asked if member is Scene else set(inspect.signature(member).parameters)
    described = entries(member, "Parameters")
    if inspect.isclass(member) and not described:
        assert entries(member, "Attributes") >= arguments
    else:
        assert described == arguments
