"""A function that harms the process it is in: its own answers are told from others, the next function is served."""

import os
import signal
import subprocess
import sys
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import mdr
from tests.engine.toys import ENVIRONMENT, wait_until
from tests.seeded import catches
from validation import stiffness_model
from validation.judging import replies as lent
from validation.judging import worker as others
from validation.judging import worker_main as serving
from validation.judging.registry import Failed, offer
from validation.judging.worker import Called, Visitor
from validation.judging.worker_main import Channel, ForeignBytesError

HEAD = """
import os, signal, sys, threading, time
import numpy as np
from validation import stiffness_model
CALLS = []
@stiffness_model("hostile")
def hostile(load):
    CALLS.append(load)
    {body}
    return 2 * load
@stiffness_model("good")
def good(load):
    return float(np.sqrt(load * load)) * 2
"""
LOADS = [1.0, 2.0, 3.0]
RIGHT = [2.0, 4.0, 6.0]


def file_of(folder, body):
    path = folder / "bad.py"
    path.write_text(HEAD.format(body=body), encoding="utf-8")
    return path


def answers(caller):
    return [getattr(reply, "reason", reply) for reply in caller.calls("load", LOADS, {})]


def forks(body):
    return f"child = os.fork()\n    if child:\n        os.waitpid(child, 0)\n    else:\n        {body}"


HARMLESS = {
    "a fork that answers": forks("pass"),
    "a fork that raises": forks("raise ValueError('child')"),
    "a fork that exits": forks("sys.exit(3)"),
    "a fork of a fork": forks("os.fork()"),
    "a fork that ends by a signal": forks("os.kill(os.getpid(), 9)"),
    "a thread that prints later": "threading.Thread(target=lambda: (time.sleep(.01), print('later'))).start()",
    "a thread that never ends": "threading.Thread(target=time.sleep, args=(1e6,)).start()",
    "no streams": "sys.stdout = sys.stderr = sys.stdin = None",
    "closed streams": "sys.stdout.close(); sys.stdin.close(); sys.stderr.close()",
    "closed descriptors of streams": "[os.close(n) for n in (0, 1, 2) if len(CALLS) == 1]",
    "another folder": "os.chdir('/')",
    "no environment": "os.environ.clear()",
    "modules that are none": "sys.modules['odd'] = type('Odd', (), {'__getattr__': lambda s, n: 1 / 0})()",
    "no garbage of ours": "import gc; gc.disable(); sys.setrecursionlimit(60)",
    "a handler at the end": "import atexit; atexit.register(time.sleep, 1e6)",
    "no signals": "[signal.signal(n, signal.SIG_IGN) for n in (15, 2, 1, signal.SIGIO)]",
    "numpy that is wrong, from the next function on": "np.sqrt = lambda x: 5.0",
    "no copies": "import copy; copy.deepcopy = None",
}


@pytest.mark.parametrize("name", HARMLESS)
def test_what_harms_no_answer_is_no_failure_and_the_next_function_is_right(name, tmp_path):
    with Visitor(file_of(tmp_path, HARMLESS[name])) as visitor:
        hostile, good = visitor.callers()
        assert answers(hostile) == RIGHT
        assert hostile.forked == (name.startswith("a fork") and "signal" not in name)
        assert answers(good) == RIGHT and not good.forked


CLOSED = "wrote into the files of its process, or closed them, by which it answers"
HARMFUL = {
    "os.closerange(3, 64)": CLOSED,
    "os.closerange(3, 64); time.sleep(1e6)": CLOSED,
    "os.closerange(3, 64); KEPT = [open('scratch', 'w') for _ in range(9)]": CLOSED,
    "[os.write(n, b'x' * 4096) for n in range(3, 64) if stat(n)]": CLOSED,
    "os._exit(0)": "ended its process with status 0",
    "os.abort()": "ended its process by signal 6",
    "os.kill(os.getpid(), signal.SIGSTOP)": "no answer within 2 s",
    "signal.pthread_sigmask(signal.SIG_BLOCK, range(1, 65)); time.sleep(1e6)": "no answer within 2 s",
    "return hostile(load)": "raised RecursionError: maximum recursion depth exceeded",
    "return np.ones(10**14)": "MemoryError: Unable to allocate 728. TiB",
    "return [bytes(10**9) for n in range(10**6)]": "raised MemoryError, line",
    "return (n for n in iter(int, 1))": "returned generator, must be real numbers",
    "return np.broadcast_to(load, (10**7,) * 2)": "returned shape (10000000, 10000000), must be one number or (2,)",
    "np.isfinite = lambda x: np.ones(np.shape(x), bool); return float('nan')": "returned NaN or infinity",
    "return type('A', (), {'__array__': lambda s, *a, **k: 1 / 0})()": "returned A, whose numbers cannot be read: Zer",
    "raise type('E', (Exception,), {'__str__': lambda s: 1 / 0})": "raised E, line",
    "raise ValueError(chr(0xdc80))": "raised ValueError: \udc80, line",
    "import validation.judging.replies as r; r.Reply.__new__ = None": "ended its process with status 1",
    "sys.modules.clear()": "ended its process with status 1",
}
STAT = """
def stat(n):
    try: return os.fstat(n)
    except OSError: return False
"""


HANGS = [body for body in HARMFUL if "sleep" in body or "STOP" in body]


@pytest.mark.parametrize("body", [pytest.param(body, marks=[pytest.mark.slow] * (body in HANGS)) for body in HARMFUL])
def test_what_a_function_does_to_its_process_is_its_own_failure_alone(body, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = file_of(tmp_path, body)
    path.write_text(path.read_text(encoding="utf-8") + STAT, encoding="utf-8")
    with Visitor(path, seconds=2.0 if body in HANGS else others.SECONDS) as visitor:
        hostile, good = visitor.callers()
        said = answers(hostile)
        assert all(HARMFUL[body] in str(reply) for reply in said), said
        assert answers(good) == RIGHT


def test_a_descriptor_that_is_another_file_now_is_not_written_into(tmp_path, monkeypatch):
    """Whatever file has the number of the channel, or of what is printed."""
    monkeypatch.chdir(tmp_path)
    body = (
        "print('x'); os.closerange(3, 64)\n    for n in range(9): open(f'own{n}', 'w+').write('mine') and 0; os.dup(1)"
    )
    keeps = "    KEPT = [open(f'own{n}', 'r+') for n in range(9)]; CALLS.append(KEPT)"
    with Visitor(file_of(tmp_path, f"{body}\n{keeps}")) as visitor:
        assert answers(visitor.callers()[0]) == [CLOSED] * 3
    assert {path.read_text(encoding="utf-8") for path in tmp_path.glob("own*")} == {"mine"}


def runs(process):
    """Whether a process is there, and no zombie."""
    try:
        return Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


DAEMON = forks("os.setsid(); os.fork() and os._exit(0); open('daemon', 'w').write(str(os.getpid())); time.sleep(1e6)")


@pytest.mark.skipif(not Path("/proc/self/environ").exists(), reason="the system does not list the environments")
def test_no_process_of_a_file_outlives_it(tmp_path, monkeypatch):
    """Not even one that has left its group."""
    monkeypatch.chdir(tmp_path)
    with Visitor(file_of(tmp_path, DAEMON)) as visitor:
        assert answers(visitor.callers()[0])[0] == 2.0
        wait_until(lambda: (tmp_path / "daemon").exists() and (tmp_path / "daemon").read_text(encoding="utf-8"))
        daemon = int((tmp_path / "daemon").read_text(encoding="utf-8"))
        assert runs(daemon)
    wait_until(lambda: not runs(daemon))


ASKS = """
import sys
from pathlib import Path
from validation.judging.worker import Visitor
with Visitor(Path(sys.argv[1]), seconds=1e6) as visitor:
    print(visitor._process.pid, flush=True)
    visitor.callers()[0].call(load=1.0)
"""


@pytest.mark.skipif(not hasattr(serving.fcntl, "F_SETSIG"), reason="the system has no such signal")
def test_a_file_that_hangs_ends_with_the_process_that_asks_also_where_that_is_killed(tmp_path):
    path = file_of(tmp_path, "open('begun', 'w')\n    while True: pass")
    words = [sys.executable, "-c", ASKS, str(path)]
    with subprocess.Popen(words, stdout=subprocess.PIPE, encoding="utf-8", env=ENVIRONMENT, cwd=tmp_path) as asks:
        process = int(asks.stdout.readline())
        wait_until((tmp_path / "begun").exists, asks)
        os.kill(asks.pid, signal.SIGKILL)
    wait_until(lambda: not runs(process))


def test_a_channel_takes_no_other_bytes_and_waits_no_longer_than_it_may():
    here, there = Channel.pair()
    other = Channel.at(there.detach())
    other.send(("a", np.arange(3.0)), 5.0)
    name, array = here.receive(5.0)
    assert name == "a" and array.tolist() == [0.0, 1.0, 2.0]
    with pytest.raises(TimeoutError):
        here.receive(0.01)
    with pytest.raises(TimeoutError):
        here.send(b"x" * 10**8, 0.01)  # nobody reads it
    other._end.send(b"y" * 64)
    with pytest.raises(ForeignBytesError):
        here.receive(5.0)
    other.close()
    with pytest.raises((EOFError, OSError)):
        for _ in range(3):
            here.receive(5.0)
    here.close()


def test_a_reply_to_another_call_is_none(tmp_path, monkeypatch):
    """It is left out, and the next one is taken."""
    with Visitor(file_of(tmp_path, "pass")) as visitor:
        hostile = visitor.callers()[0]
        assert answers(hostile) == RIGHT
        first = visitor._channel.receive
        late = iter([((visitor._asked, 2), others.Reply(np.array(7.0)), "", (), False)])
        monkeypatch.setattr(visitor._channel, "receive", lambda seconds: next(late, None) or first(seconds))
        assert answers(hostile) == RIGHT


CHANGES_ITSELF = """len(CALLS) > 1 and Path(__file__).with_name("{name}").write_text("# another " + str(len(CALLS)))"""


@pytest.mark.parametrize("name", ["bad.py", "data.txt"])
def test_another_function_of_a_file_that_was_changed_is_not_run(name, tmp_path):
    """It would be of another file; where data alone are others, it is, and they are named."""
    (tmp_path / "data.txt").write_text("as it was", encoding="utf-8")
    body = f"from pathlib import Path; Path(__file__).with_name('data.txt').read_text(); {CHANGES_ITSELF}"
    with Visitor(file_of(tmp_path, body.format(name=name))) as visitor:
        hostile, good = visitor.callers()
        assert hostile.call(load=1.0) == 2.0 and not hostile.changed
        before = visitor.digest
        assert answers(hostile) == RIGHT and hostile.changed == good.changed == name
        refused = ["cannot be run again: bad.py was changed since it was first run"] * 3
        assert answers(good) == (refused if name == "bad.py" else RIGHT)
        # the digest is of what was run, as it was then
        assert visitor.digest == before


OTHERS = """
from pathlib import Path
from validation import stiffness_model
count = len(list(Path(__file__).parent.glob("start*")))
Path(__file__).with_name(f"start{count}").touch()
for name in ("a", "b") if count == 0 else ("b", "a"):
    stiffness_model(name)(lambda load, name=None: load)
"""


def test_a_file_that_offers_other_functions_the_next_time_answers_no_more(tmp_path):
    (tmp_path / "bad.py").write_text(OTHERS.replace(", name=None", ""), encoding="utf-8")
    with Visitor(tmp_path / "bad.py") as visitor:
        a, b = visitor.callers()
        assert answers(a) == LOADS
        assert answers(b) == ["cannot be run again: bad.py offers other functions than at first"] * 3


# --- arguments ---


@dataclass(frozen=True)
class Ground:
    rms: float = 1.0
    parts: list = field(default_factory=lambda: [1.0, {"a": np.zeros(2)}])

    def c2d(self, q):
        return self.rms * q


def plain():
    ground = Ground(2.0)
    return SimpleNamespace(c2d=ground.c2d, c1d=partial(mdr.geike, c2d=ground.c2d), rms=2.0)


CHANGES = {
    "object.__setattr__(roughness, 'rms', 3.0)": True,
    "roughness.__dict__['rms'] = 3.0": True,
    "roughness.parts[1]['a'][0] = 1.0": True,
    "roughness.parts.append(1)": True,
    "object.__delattr__(roughness, 'rms')": True,
    "type(roughness).c2d = lambda self, q: 0 * q": True,
    "type(roughness).rms = property(lambda self: 3.0)": True,
    "roughness.c2d(np.ones(2))": False,
    "object.__setattr__(roughness, 'cache', 3.0)": False,
    "object.__setattr__(roughness, 'rms', 2.0)": False,
}


def members(kind):
    """Of a class, but for what `copy` remembers of it from the first time on."""
    return vars(kind).keys() - {"__slotnames__"}


RMS = "object.__setattr__(roughness, 'rms', 3.0)"


DEEP = "roughness.parts[1]['a'][0] = 1.0"


@catches("a changed argument that is never named", change=RMS).at(
    "validation.judging.replies.changed", lambda arguments, lent: ""
)
@catches("an argument itself lent, so that the next call has what this one left", change=RMS).at(
    "validation.judging.replies.copy_of", lambda v: v
)
@catches("arguments compared by their attributes, and not by what these hold", change=DEEP).at(
    "validation.judging.replies.changed",
    lambda a, b: next((n for n in a if getattr(a[n], "rms", 0) != getattr(b[n], "rms", 0)), ""),
)
@pytest.mark.parametrize("change", CHANGES)
def test_an_argument_that_is_changed_is_seen_and_the_next_call_has_a_fresh_one(change):
    def function(load, roughness):
        before = roughness.rms, members(type(roughness)), len(roughness.parts)
        exec(change, {"roughness": roughness, "np": np})
        return before[0] + len(before[1]) + before[2]

    ground, caller = Ground(2.0), Called(offer("stiffness_model", "mine", {}, function))
    expected = 2.0 + len(members(Ground)) + 2
    for _ in range(2):
        reply = caller.call(load=1.0, roughness=ground)
        words = "changed roughness, which is not its own"
        assert getattr(reply, "reason", reply) == (words if CHANGES[change] else expected)
    assert (ground.rms, ground.parts[0], ground.parts[1]["a"].tolist()) == (2.0, 1.0, [0.0, 0.0])
    assert ground.c2d(1.0) == 2.0


def test_what_a_model_of_measured_heights_is_given_is_compared_as_well():
    @stiffness_model("mine")
    def function(roughness):
        object.__setattr__(roughness.c2d.__self__, "rms", 5.0)
        return 1.0

    @stiffness_model("right")
    def right(roughness, rng):
        return float(roughness.c1d(1.0) / np.pi + 0 * rng.random())

    ground, rng = plain(), np.random.default_rng(1)
    assert Called(function).call(roughness=ground).reason == "changed roughness, which is not its own"
    assert Called(right).call(roughness=ground, rng=rng) == 2.0
    assert rng.random() != np.random.default_rng(1).random()  # drawing from it is its use


@catches("arrays that can be written").at("validation.judging.replies.as_argument", lambda value: value.copy())
def test_arrays_cannot_be_written_and_are_compared_to_the_byte():
    before, other = {"x": np.array([0.0, np.nan])}, {"x": np.array([0.0, np.nan])}
    assert lent.changed(before, other) == ""
    other["x"][0] = 1e-300
    assert lent.changed(before, other) == "x"
    assert not lent.as_argument(lent.copy_of(before["x"])).flags.writeable


def test_a_key_that_a_mapping_has_gained_or_lost_is_a_change():
    """Unlike a new attribute, which may be a cache."""
    for before, after in (({}, {"b": 1.0}), ({"a": 1.0}, {"a": 1.0, "b": 1.0}), ({"a": 1.0, "b": 1.0}, {"a": 1.0})):
        assert lent.changed({"x": before}, {"x": dict(before)}) == ""
        assert lent.changed({"x": before}, {"x": after}) == "x"
        assert lent.changed({"x": [0.0, before]}, {"x": [0.0, after]}) == "x"


def test_a_fork_of_a_function_of_this_process_never_comes_back(tmp_path):
    """It would judge on beside the first, and write the same files."""
    mark = tmp_path / "returned"

    @stiffness_model("forks")
    def function(load):
        child = os.fork()
        if child:
            os.waitpid(child, 0)
        return 2 * load

    caller, process = Called(function), os.getpid()
    reply = caller.call(load=1.0)
    if os.getpid() != process:
        mark.write_text("it did", encoding="utf-8")
        os._exit(0)
    assert reply == 2.0 and caller.forked and not mark.exists()
    assert not isinstance(caller.call(load=2.0), Failed)
