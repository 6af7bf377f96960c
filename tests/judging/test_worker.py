"""Files of others: whatever they do is a reason in words, and never an exception of ours."""

import os
import sys

import numpy as np
import pytest

from tests.engine.toys import HANG
from validation import stiffness_model, stiffness_of_surface
from validation.judging import source_files as read_files
from validation.judging.registry import Failed
from validation.judging.source_files import digest_of
from validation.judging.worker import Called, OthersError, Visitor, offered_in, visited

FACE = "from validation import stiffness_model, stiffness_of_surface\n"
BAD = {
    "return 1 / 0": "raised ZeroDivisionError: division by zero, line 4 of bad.py",
    "raise ValueError('too\\nlight')": "raised ValueError: too light, line 4 of bad.py",
    "raise SystemExit(3)": "raised SystemExit: 3, line 4 of bad.py",
    "import os; os._exit(3)": "ended its process with status 3",
    "import os; os.kill(os.getpid(), 9)": "ended its process by signal 9",
    "return float('nan')": "returned NaN or infinity",
    "return (1.0, float('inf'))": "returned NaN or infinity, 1 of 2 values",
    "return [1.0, 2.0, 3.0]": r"returned shape (3,), must be one number or (2,)",
    "return [[1.0], [2.0, 3.0]]": "returned rows of different lengths",
    "return None": "returned nothing",
    "return 'stiff'": "returned str, must be real numbers",
    "return 1j": "returned complex numbers, must be real numbers",
    "return input()": "raised EOFError: EOF when reading a line, line 4 of bad.py",
}


def written(folder, body, name="bad.py"):
    path = folder / name
    path.write_text(body, encoding="utf-8")
    return path


@pytest.mark.slow
def test_what_a_function_does_wrong_is_said_in_words_and_the_next_call_is_served(tmp_path):
    """Each under its own name in one file; the process is started again where it has ended."""
    bodies = [FACE]
    for i, body in enumerate(BAD):
        path = written(tmp_path, f"{FACE}@stiffness_model('{i}')\ndef bad(load):\n    {body}\n", "bad.py")
        with Visitor(path) as visitor:
            (caller,) = visitor.callers()
            assert caller.call(load=1.0, side=2.0).reason == BAD[body], body
        bodies.append(f"@stiffness_model('{i}')\ndef bad{i}(load):\n    {body}\n")
    bodies.append("@stiffness_model('good')\ndef good(load):\n    return 2 * load\n")
    with Visitor(written(tmp_path, "".join(bodies))) as visitor:
        *wrong, good = visitor.callers()
        for caller in wrong:
            assert isinstance(caller.call(load=1.0), Failed)
            assert good.call(load=3.0) == 6.0


@pytest.mark.slow
def test_a_hang_is_ended_and_after_three_nothing_is_asked(tmp_path):
    """What answers has all the time that it needs."""
    loops = f"{FACE}@stiffness_model('loops')\ndef loops(load):\n    while load > 1:\n        pass\n    return load\n"
    with Visitor(written(tmp_path, loops), seconds=HANG) as visitor:
        (caller,) = visitor.callers()
        found = caller.calls("load", [0.5], {})
        for seconds, loads in ((0.1, [2.0]), (HANG, [0.5]), (0.1, [2.0, 2.0, 0.5])):
            visitor.seconds = seconds
            found += caller.calls("load", loads, {})
        ended = visitor._process.pid
    late = "no answer within 0.1 s"
    assert [getattr(one, "reason", one) for one in found] == [
        0.5,
        late,
        0.5,
        late,
        late,
        "no answer, 3 times: not asked any more",
    ]
    with pytest.raises(ProcessLookupError):
        os.kill(ended, 0)


@pytest.mark.slow
@pytest.mark.parametrize("end", ["import os; os._exit(0)", "raise KeyboardInterrupt"])
def test_a_function_that_ends_its_process_is_asked_three_times_and_the_others_go_on(end, tmp_path):
    body = f"{FACE}open('starts', 'a').write('.')\n@stiffness_model('ends')\ndef ends(load):\n    {end}\n"
    path = written(
        tmp_path,
        f"{body}@stiffness_model('good')\ndef good(load):\n    return load\n".replace(
            "starts", str(tmp_path / "starts")
        ),
    )
    with Visitor(path) as visitor:
        ends, good = visitor.callers()
        reasons = [one.reason for one in ends.calls("load", [1.0, 2.0, 3.0, 4.0, 5.0], {})]
        assert good.call(load=2.0) == 2.0
    assert all(reason.startswith("ended its process") for reason in reasons[:3])
    assert reasons[3:] == ["no answer, 3 times: not asked any more"] * 2
    assert len((tmp_path / "starts").read_text(encoding="utf-8")) == 4


MANY = """
import own_models
from own_models import imported
for n in (1, 2):
    @stiffness_model(f"law {n}")
    def law(load):
        return load
@stiffness_model("last")
def law(load):
    return 3 * load
"""


def test_all_functions_that_a_file_decorates_are_judged_whatever_their_python_names(tmp_path):
    """Those of a module that it imports are not, but what it imports by name."""
    other = "".join(f"{name} = stiffness_model('{name}')(lambda load: load)\n" for name in ("left", "imported"))
    written(tmp_path, FACE + other, "own_models.py")
    with Visitor(written(tmp_path, FACE + MANY)) as visitor:
        assert [one.name for one in visitor.offered] == ["imported", "law 1", "law 2", "last"]
        assert visitor.callers()[-1].call(load=2.0) == 6.0


def test_a_file_is_run_with_its_folder_and_its_printing_is_caught(tmp_path, capfd):
    """The digest is of its bytes and of the modules that it has loaded from there."""
    written(tmp_path, "FACTOR = 3.0\n", "own_constants.py")
    body = f"{FACE}from own_constants import FACTOR\nprint('begin')\n@stiffness_model('a name')\n"
    path = written(tmp_path, body + "def bad(load):\n    print('called')\n    return FACTOR * load\n")
    with Visitor(path) as visitor:
        (caller,) = visitor.callers()
        assert (caller.kind, caller.name, caller.asks) == ("stiffness_model", "a name", ("load",))
        assert caller.call(load=2.0, side=1.0) == 6.0
        assert caller.printed == "begin called"
        assert [source.name for source in visitor.sources] == ["bad.py", "own_constants.py"]
        before = visitor.digest
    assert capfd.readouterr() == ("", "")
    written(tmp_path, "FACTOR = 4.0\n", "own_constants.py")
    with Visitor(path) as visitor:
        assert visitor.digest != before


READS = """
from pathlib import Path
import numpy as np
HERE = Path(__file__).parent
A = float((HERE / "a.txt").read_text())
@stiffness_model('a name')
def bad(load):
    (HERE / "log.txt").open("a").write("called")
    np.savetxt(HERE / "scratch.txt", [load])
    return A * np.loadtxt(HERE / "b" / "c.csv") * np.loadtxt(HERE / "scratch.txt")
"""


@pytest.mark.parametrize("place", ["mine", "link", "link/../mine"])
def test_data_that_a_file_reads_from_its_folder_belong_to_it_and_what_it_writes_does_not(place, tmp_path):
    """Read when it is loaded, or when it is called."""
    folder = tmp_path / "mine"
    (folder / "b").mkdir(parents=True)
    (tmp_path / "link").symlink_to(folder)
    (folder / "bad.py").write_text(FACE + READS, encoding="utf-8")
    (folder / "b" / "c.csv").write_text("3.0", encoding="utf-8")
    os.utime(folder / "b" / "c.csv", (2**32, 2**32))  # a clock that is ahead
    digests = []
    for a in (2.0, 2.0, 2.5):
        (folder / "a.txt").write_text(str(a), encoding="utf-8")
        with Visitor(tmp_path / place / "bad.py") as visitor:
            assert [source.name for source in visitor.sources] == ["a.txt", "bad.py"]
            assert visitor.callers()[0].call(load=2.0) == 6 * a
            assert [source.name for source in visitor.sources] == ["a.txt", "c.csv", "bad.py"]
            digests.append(visitor.digest)
    assert digests[0] == digests[1] != digests[2]


def test_data_that_a_later_call_alone_reads_belong_to_a_file_as_well(tmp_path):
    """Whether or not that call also loads a module."""
    body = """
from pathlib import Path
@stiffness_model('a name')
def bad(load):
    return float(Path(__file__).with_name(f"{load:g}.txt").read_text(encoding="utf-8"))
"""
    for load in (1, 2, 3):
        written(tmp_path, str(10 * load), f"{load}.txt")
        os.utime(tmp_path / f"{load}.txt", (1e9, 1e9))
    with Visitor(written(tmp_path, FACE + body)) as visitor:
        (caller,) = visitor.callers()
        for load in (1, 2, 3):
            before = visitor.digest
            assert caller.call(load=float(load)) == 10 * load and visitor.digest != before
            assert [path.name for path in visitor.sources] == [*(f"{n}.txt" for n in range(1, load + 1)), "bad.py"]


def test_data_that_are_others_for_a_later_process_are_named_and_the_digest_is_that_of_the_first(tmp_path):
    """As a copy that keeps its date, which no process of the file has written."""
    data, body = tmp_path / "data.txt", f"FACTOR = float(Path(__file__).with_name('data.txt').read_text())\n{TWO}"

    def copied(text):
        data.write_text(text, encoding="utf-8")
        os.utime(data, (1e9, 1e9))

    copied("2")
    with Visitor(written(tmp_path, f"{FACE}from pathlib import Path\n{body}")) as visitor:
        first, second = visitor.callers()
        before = visitor.digest
        assert first.call(load=1.0) == 2.0 and not visitor.changed
        copied("3")
        assert second.call(load=1.0) == 3.0  # in a process of its own
        assert visitor.digest == before and first.changed == second.changed == "data.txt"


TWO = """
a, b = (stiffness_model(name)(lambda load: FACTOR * load) for name in "ab")
"""
BROKEN = {
    "x = 1\n": "bad.py: no function has a decorator, which is one of @stiffness_model, ",
    "def f(:\n": r"bad.py: SyntaxError: ",
    "import no_such_module\n": "bad.py: ModuleNotFoundError: No module named 'no_such_module', line 1 of bad.py",
    "raise SystemExit(1)\n": "bad.py: SystemExit: 1, line 1 of bad.py",
    "import validation\nvalidation.judge(__file__)\n": "OthersError: a file that is judged must not judge files itself",
    "import os; os._exit(7)\n": "bad.py: ended its process with status 7",
    "\0": "bad.py: SyntaxError: source code string cannot contain null bytes",
    f"{FACE}a = stiffness_model('a')(lambda loda: 1)\n": "bad.py: line 2 of bad.py: 'a': loda is unknown: @",
    f"{FACE}a = stiffness_model('a')(lambda load: 1)\nb = stiffness_model('a')(lambda: 1)\n": "are offered as 'a'",
}


@pytest.mark.parametrize("body", BROKEN)
def test_a_broken_file_is_refused_in_one_sentence(body, tmp_path):
    with pytest.raises(OthersError) as refused:
        offered_in(written(tmp_path, body))
    assert BROKEN[body] in str(refused.value)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("place", ["nowhere.py", "."])
def test_what_is_no_file_is_an_error_of_its_path(place, tmp_path):
    with pytest.raises(OSError, match=r"No such file|Is a directory"):
        offered_in(tmp_path / place)


def test_a_function_of_this_process_is_checked_in_the_same_way(capsys):
    @stiffness_of_surface("writes")
    def writes(height):
        sys.stdout.write("hello")
        height[0] = 1.0
        return 1.0

    @stiffness_model("two")
    def two(load):
        return load, 0.1 * load

    height = np.zeros((2, 2))
    caller = Called(writes)
    assert "assignment destination is read-only" in caller.call(height=height).reason
    assert (height == 0).all() and caller.printed == "hello"
    assert Called(two).call(load=2.0).tolist() == [2.0, 0.2]
    assert not capsys.readouterr().out


def test_a_masked_value_is_no_number_though_there_is_one_below_the_mask():
    @stiffness_model("masked")
    def masked(load):
        return np.ma.masked_array([load, 5.0], mask=[False, load > 1])

    assert Called(masked).call(load=1.0).tolist() == [1.0, 5.0]
    assert Called(masked).call(load=2.0).reason == "returned masked values, must be real numbers"


def test_an_own_raise_is_a_refusal_and_a_mistake_is_none():
    @stiffness_model("refuses")
    def refuses(load):
        if load < 1:
            raise ValueError("too light")
        return load / 0

    assert [Called(refuses).call(load=load).refused for load in (0.5, 2.0)] == [True, False]


def test_only_decorated_functions_and_files_are_judged():
    with (
        pytest.raises(TypeError, match="model must be a function with a decorator, as @stiffness_model, or a file"),
        visited(len),
    ):
        pass


def test_a_digest_tells_files_whose_contents_are_exchanged(tmp_path):
    first, second = written(tmp_path, "1", "a.py"), written(tmp_path, "2", "b.py")
    before = digest_of([first, second])
    first.write_text("2", encoding="utf-8")
    second.write_text("1", encoding="utf-8")
    assert digest_of([first, second]) != before


def test_installed_packages_below_the_folder_of_a_file_are_no_part_of_it(tmp_path, monkeypatch):
    """An environment may lie there."""
    names = ("mine.py", "data.txt", "env/lib/site-packages/pack/data.txt", "__pycache__/mine.pyc")
    for name in names:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        written(tmp_path, "1", name)
        os.utime(tmp_path / name, (1e9, 1e9))
    monkeypatch.setattr(read_files, "OPENED", {tmp_path / name for name in names})
    assert [path.name for path in read_files.sources_of(tmp_path / "mine.py")] == ["data.txt", "mine.py"]


WRITES = """
from pathlib import Path
SCRATCH = Path(__file__).with_name("scratch.txt")
@stiffness_model("writes")
def writes(load):
    SCRATCH.write_text(str(load))
    return load
@stiffness_model("reads")
def reads(load):
    return float(SCRATCH.read_text())
"""


def test_what_one_function_of_a_file_has_written_is_no_data_of_the_next_one(tmp_path):
    """Which has a later process."""
    with Visitor(written(tmp_path, FACE + WRITES)) as visitor:
        writes, reads = visitor.callers()
        assert (writes.call(load=2.0), reads.call(load=1.0)) == (2.0, 2.0)
        assert [path.name for path in visitor.sources] == ["bad.py"] and not reads.changed
