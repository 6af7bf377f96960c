"""Who raised an exception decides whether it is a refusal: the instruction and its file, not the text of a line."""

import subprocess
import sys

import pytest

from tests.engine.toys import ENVIRONMENT, ROOT
from tests.seeded import catches
from validation import stiffness_model
from validation.judging import replies as refusals
from validation.judging.replies import is_own
from validation.judging.worker import Called, Visitor

HEAD = """
import contextlib, functools, math, os, warnings
import numpy as np
import helper, mdr
from validation import stiffness_model
class TooLight(ValueError): pass
class Beyond(Exception): pass
class Missing(LookupError): pass
class Rough(UserWarning): pass
def reject(words="too light"):
    raise ValueError(words)
def singular():
    return np.linalg.inv(np.zeros((2, 2)))
def deco(function):
    @functools.wraps(function)
    def inner(load):
        if load < 0: raise ValueError("negative")
        return function(load)
    return inner
def generated():
    space = {}
    exec("def f(load):\\n if load: raise ValueError('generated')", space)
    return space["f"]
"""
REFUSED = {
    "one line": "if load: raise ValueError('too light')",
    "two lines": "if load:\n        raise ValueError('too light')",
    "three": "if load:\n        raise ValueError(\n            'too light')",
    "after a semicolon": "x = 1; raise ValueError('too light')",
    "no words": "raise ValueError",
    "not implemented": "raise NotImplementedError('no light loads')",
    "runtime": "raise RuntimeError('no convergence')",
    "arithmetic": "raise ArithmeticError('no convergence')",
    "overflow": "raise OverflowError('too heavy')",
    "own class of ValueError": "raise TooLight('too light')",
    "own class of Exception": "raise Beyond",
    "own class of LookupError": "raise Missing(load)",
    "class of a helper": "raise helper.Refused('too light')",
    "by a function": "reject()",
    "by a helper beside it": "helper.reject()",
    "by a helper in a package beside it": "from below.deeper import reject as other; other()",
    "from another": "try:\n        1 / 0\n    except ArithmeticError as e:\n        raise ValueError('flat') from e",
    "instead of another": "try:\n        singular()\n    except ValueError:\n        raise ValueError('flat')",
    "from None": "raise ValueError('flat') from None",
    "raised again": "try:\n        reject()\n    except ValueError:\n        raise",
    "raised again by name": "try:\n        reject()\n    except ValueError as error:\n        raise error",
    "after finally": "try:\n        reject()\n    finally:\n        load = 2",
    "within with": "with open(os.devnull), contextlib.suppress(KeyError):\n        raise ValueError('too light')",
    "lambda": "return (lambda: reject())()",
    "lambda that throws": "return (lambda: (_ for _ in ()).throw(ValueError('too light')))()",
    "comprehension": "return [reject() for _ in range(3)]",
    "generator": "return sum(reject() for _ in range(3))",
    "in a library that calls": "return functools.reduce(lambda a, b: reject(), [1, 2])",
    "in numpy that calls": "return np.vectorize(lambda x: reject())([1.0])",
    "decorator of its own": "return deco(lambda load: load)(-load)",
    "exec": "exec('raise ValueError(1)')",
    "compiled": "exec(compile('raise ValueError(1)', 'nowhere.py', 'exec'))",
    "generated": "return generated()(load)",
    "error of numpy, raised here": "raise np.linalg.LinAlgError('singular')",
    "own warning as error": "warnings.simplefilter('error'); warnings.warn('out of range')",
    "own class of warning": "warnings.simplefilter('error'); warnings.warn(Rough('out of range'))",
    "group": "raise ExceptionGroup('two', [ValueError(1), ValueError(2)])",
}
FAILED = {
    "numpy": "np.linalg.inv(np.zeros((2, 2)))",
    "numpy, raised again": "try:\n        singular()\n    except ValueError:\n        raise",
    "numpy, raised by name": "try:\n        singular()\n    except ValueError as error:\n        raise error",
    "shapes": "return np.ones(2) + np.ones(3)",
    "a number": "return int('x')",
    "a root": "return math.sqrt(-load)",
    "unpacking": "a, b = 1, 2, 3",
    "package of this project": "mdr.load_curve(np.zeros(3), length=-1.0, modulus=1.0)",
    "standard library": "import statistics; statistics.mean([])",
    "json": "import json; json.loads('{')",
    "a helper's bug": "helper.bug()",
    "type": "return 1 + 'x'",
    "name": "return laod",
    "index": "return [][3]",
    "key": "return {}[load]",
    "attribute": "return load.mean_square",
    "division": "return 1 / 0",
    "overflow of a number": "return math.exp(1e6)",
    "assert": "assert load < 0, 'negative loads alone'",
    "raised type error": "raise TypeError('a load')",
    "raised key error": "raise KeyError('load')",
    "file": "open('no such file')",
    "import": "import no_such_module",
    "recursion": "def f(): return f()\n    return f()",
    "memory": "raise MemoryError",
    "exit": "raise SystemExit('too light')",
    "what is no exception": "raise 'too light'",
    "decoding": "return b'\\xff'.decode()",
    "warning of numpy as error": "warnings.simplefilter('error'); np.seterr(all='warn'); return np.log(np.zeros(1))",
    "stopped": "return next(iter(()))",
    "wrong arguments": "return reject(1, 2)",
    "bug in exec": "exec('1 / 0')",
    "value in exec": "exec('int(chr(120))')",
}
HELPER = """
class Refused(Exception): pass
def reject():
    raise ValueError("too light")
def bug():
    return float("1,5")
"""


def answer(folder, body):
    (folder / "helper.py").write_text(HELPER, encoding="utf-8")
    (folder / "below").mkdir(exist_ok=True)
    (folder / "below" / "deeper.py").write_text(HELPER, encoding="utf-8")
    path = folder / "bad.py"
    functions = (f'@stiffness_model("{i}")\ndef f{i}(load):\n    {b}\n' for i, b in enumerate(body))
    path.write_text(HEAD + "".join(functions), encoding="utf-8")
    with Visitor(path) as visitor:
        # in one process: these do no harm
        visitor._serve = lambda offered: None
        return [caller.call(load=1.0) for caller in visitor.callers()]


@pytest.mark.parametrize(("bodies", "refused"), [(REFUSED, True), (FAILED, False)])
def test_what_its_author_raises_is_a_refusal_and_what_goes_wrong_is_a_failure(bodies, refused, tmp_path):
    replies = dict(zip(bodies, answer(tmp_path, bodies.values()), strict=True))
    assert {name: reply.reason for name, reply in replies.items() if reply.refused != refused} == {}
    assert all(reply.reason.startswith("raised ") for reply in replies.values())


def test_the_line_of_the_file_stands_with_an_error_of_a_library(tmp_path):
    (reply,) = answer(tmp_path, ["return np.linalg.inv(np.zeros((2, 2)))"])
    assert reply.reason == f"raised LinAlgError: Singular matrix, line {HEAD.count(chr(10)) + 3} of bad.py"


@catches("a refusal of whatever a line of the file comes to").at(
    "validation.judging.replies._is_thrown_into", lambda *_: True
)
@catches("no refusal by a function without a file").at(
    "validation.judging.replies.homes_of", lambda function, file=None: ()
)
def test_in_this_process_a_function_of_a_console_refuses_too():
    """Its code has a file that is none."""
    space = {"stiffness_model": stiffness_model}
    source = "@stiffness_model('mine')\ndef f(load):\n    if load > 1: raise ValueError('heavy')\n    return int('x')"
    exec(compile(source, "<console>", "exec"), space)
    assert [Called(space["f"]).call(load=load).refused for load in (2.0, 1.0)] == [True, False]


def test_a_file_beside_the_packages_is_not_their_author(tmp_path, monkeypatch):
    """What lies in the folder of an environment, of the standard library or of this project is of a library."""
    assert not is_own(str(ROOT / "mdr" / "spectrum.py"), (str(ROOT / "pyproject.toml"),))
    assert is_own(__file__, (str(ROOT / "pyproject.toml"),))
    (tmp_path / "lib" / "python").mkdir(parents=True)
    for name in ("lib/python/json.py", "mine.py"):
        (tmp_path / name).touch()
    monkeypatch.setattr(refusals, "LIBRARIES", (tmp_path / "lib" / "python",))
    assert not is_own(str(tmp_path / "lib" / "python" / "json.py"), (str(tmp_path / "mine.py"),))
    packages = tmp_path / "lib" / "site-packages"
    for name in ("a/one.py", "a/b/two.py", "c/one.py", "alone.py"):
        (packages / name).parent.mkdir(parents=True, exist_ok=True)
        (packages / name).touch()
    (tmp_path / "mine.py").touch()
    a, b, c, alone = (str(packages / name) for name in ("a/one.py", "a/b/two.py", "c/one.py", "alone.py"))
    assert is_own(b, (a,)) and is_own(a, (b,)) and not is_own(c, (a,)) and not is_own(alone, (a,))
    assert not is_own(a, (alone,)) and is_own(alone, (alone,)) and not is_own(a, (str(tmp_path / "mine.py"),))


SCRIPT = """
import validation
from validation.judging.worker import Called
@validation.stiffness_model("mine")
def f(load):
    if load > 1: raise ValueError("heavy")
    return int("x")
print([Called(f).call(load=load).refused for load in (2.0, 1.0)])
"""


def test_a_script_refuses_whatever_way_it_is_named(tmp_path):
    (tmp_path / "script.py").write_text(SCRIPT, encoding="utf-8")
    for words in (["script.py"], ["-c", SCRIPT], [str(tmp_path / "script.py")]):
        run = subprocess.run(
            [sys.executable, *words], cwd=tmp_path, env=ENVIRONMENT, capture_output=True, encoding="utf-8"
        )
        assert (run.stdout, run.stderr) == ("[True, False]\n", "")
