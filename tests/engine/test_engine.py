"""Independent solves: seeds, stored results that can be trusted."""

import hashlib
import importlib.metadata
import io
import json
import os
import subprocess
import sys
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import pytest

import mdr
from tests.engine.toys import ENVIRONMENT, ROOT, computed, other_toy, same, toy
from tests.seeded import catches
from validation.engine import engine as ensemble
from validation.engine import sources
from validation.engine.engine import Engine, identity
from validation.engine.realisations import random_generator
from validation.simulation.method import Resolution


def test_results_come_in_order_and_once(problems, tmp_path):
    engine = Engine(store=tmp_path / "store")
    first = engine.map(toy, problems)
    again = engine.map(toy, problems[::-1])[::-1]
    assert computed(problems[0].log) == [0, 1, 2, 3, 4]
    assert same(first, again)
    assert same(first, Engine().map(toy, problems))


@pytest.mark.slow
def test_every_damaged_bit_is_seen(problems, tmp_path):
    """One bit of each byte of a stored file turned over: never taken, never an error."""
    store = tmp_path / "store"
    whole = Engine(store=store).map(toy, problems[:1])
    (path,) = store.iterdir()
    contents = path.read_bytes()
    key = f"{toy.__module__}.{toy.__qualname__}({problems[0]!r}) {sources.version_behind(toy.__module__, problems[0])}"
    assert same([ensemble.load_result(path, key)], whole)
    for i in range(len(contents)):
        path.write_bytes(contents[:i] + bytes([contents[i] ^ (1 << i % 8)]) + contents[i + 1 :])
        assert ensemble.load_result(path, key) is None


def sealed(archive):
    return archive + hashlib.sha256(archive).digest()


def repacked(contents, change):
    """The same archive with other arrays in it, and a right seal."""
    with np.load(io.BytesIO(contents[: -ensemble.SEAL])) as arrays:
        held = {name: arrays[name] for name in arrays.files}
    archive = io.BytesIO()
    np.savez(archive, **change(held))
    return sealed(archive.getvalue())


def without(name):
    return lambda held: {key: value for key, value in held.items() if key != name}


def relabelled(contents, **changes):
    """As above, with another label."""

    def change(held):
        label = json.loads(str(held[ensemble.LABEL])) | changes
        return held | {ensemble.LABEL: np.array(json.dumps(label))}

    return repacked(contents, change)


FORGED = {
    "the first half": lambda whole: whole[: len(whole) // 2],
    "nothing": lambda whole: b"",
    "noise": lambda whole: os.urandom(1000),
    "a missing array": lambda whole: repacked(whole, without("value")),
    "one too many": lambda whole: repacked(whole, lambda held: held | {"more": np.ones(2)}),
    "another shape": lambda whole: repacked(whole, lambda held: held | {"value": np.ones((2, 2))}),
    "another type": lambda whole: repacked(whole, lambda held: held | {"value": np.array(["a", "b", "c", "d"])}),
    "objects": lambda whole: repacked(whole, lambda held: held | {"value": np.array([{}, [], (), 1], dtype=object)}),
    "no label": lambda whole: repacked(whole, without(ensemble.LABEL)),
    "a label that is a number": lambda whole: repacked(whole, lambda held: held | {ensemble.LABEL: np.ones(1)}),
    "an older format": lambda whole: relabelled(whole, format=1),
    "another problem": lambda whole: relabelled(whole, key="another"),
    "no archive": lambda whole: sealed(b"text"),
    "a seal alone": lambda whole: sealed(b""),
    "an archive of others": lambda whole: whole[: -ensemble.SEAL],
}


@pytest.mark.parametrize("forged", FORGED.values(), ids=FORGED)
def test_what_is_not_as_it_was_written_is_computed_anew(forged, problems, tmp_path):
    """Though the seal may be right: never taken, never an error, and written over."""
    engine = Engine(store=tmp_path / "store")
    first = engine.map(toy, problems[:1])
    (path,) = (tmp_path / "store").iterdir()
    whole = path.read_bytes()
    path.write_bytes(forged(whole))
    assert same(first, engine.map(toy, problems[:1]))
    assert computed(problems[0].log) == [0, 0]
    assert path.read_bytes() == whole


def test_what_is_stored_comes_back_as_it_was(tmp_path):
    """Numbers, words, nothing at all, any order in memory; and it may be written to, as it could at first."""
    outcome = {
        "square": np.asfortranarray(np.arange(6.0).reshape(2, 3)),
        "number": np.float64(3.0),
        "words": np.array(["finished", "failed: BrokenProcessPool"]),
        "none": np.empty((0, 3)),
        "count": np.array(3),
        "with / and .npy": np.array([np.nan, np.inf]),
    }
    ensemble.save_result(tmp_path / "x.npz", "key", outcome)
    again = ensemble.load_result(tmp_path / "x.npz", "key")
    assert again.keys() == outcome.keys()
    for name, array in outcome.items():
        np.testing.assert_array_equal(again[name], array)
        assert again[name].dtype == array.dtype
        assert again[name].flags.writeable
    assert ensemble.load_result(tmp_path / "x.npz", "another key") is None
    assert ensemble.load_result(tmp_path / "y.npz", "key") is None


@pytest.mark.parametrize("kind", ["link", "dangling", "pipe", "folder"])
def test_a_place_that_something_else_has_taken_is_refused(kind, problems, tmp_path):
    """Before anything is computed; a pipe is not waited for, a link not followed and not replaced."""
    store = tmp_path / "store"
    Engine(store=store).map(toy, problems[:1])
    (path,) = store.iterdir()
    path.rename(tmp_path / "elsewhere")
    if kind in ("link", "dangling"):
        path.symlink_to(tmp_path / ("elsewhere" if kind == "link" else "nowhere"))
    elif kind == "pipe":
        os.mkfifo(path)
    else:
        path.mkdir()
    with pytest.raises(ValueError, match=f"a stored result must be a plain file, got {path}: move that away"):
        Engine(store=store).map(toy, problems)
    assert computed(problems[0].log) == [0]


def test_what_is_timed_is_timed_anew(problems, tmp_path):
    """Results of this run are forgotten; others, and files of others, stay."""
    engine = Engine(store=tmp_path)
    engine.map(other_toy, problems[:1])
    (kept,) = (path.name for path in tmp_path.glob("*.npz"))
    with engine.timed() as alone:
        assert alone.workers == 1
        alone.map(toy, problems)
        ours = sorted(path.name for path in tmp_path.glob("*.npz") if path.name != kept)
        others = [ours[0].replace("toys", "test"), "toys.npz", "toys-toy-abc.npz", "a.txt"]
        for name in others:
            (tmp_path / name).write_bytes((tmp_path / ours[0]).read_bytes())
        (tmp_path / ours[1]).write_bytes(b"mine")
        (tmp_path / ours[2]).unlink()
        (tmp_path / ours[2]).symlink_to(ours[3])
    assert {path.name for path in tmp_path.iterdir()} == {*others, kept, ours[1], ours[2], "log"}
    with Engine().timed() as alone:
        alone.map(toy, problems[:1])


def test_a_timed_run_that_is_interrupted_goes_on(problems, tmp_path):
    engine = Engine(store=tmp_path)
    with pytest.raises(KeyboardInterrupt), engine.timed() as alone:
        alone.map(toy, problems)
        raise KeyboardInterrupt
    assert len(list(tmp_path.glob("*.npz"))) == len(problems)


def test_results_are_keyed_by_source_that_is_there(monkeypatch):
    """Wherever the engine stands in the house: without a file, every version of the code would have one key."""
    found = sources.modules()
    assert Path(ensemble.__file__) == found["validation.engine.engine"]
    assert {name.partition(".")[0] for name in found} == set(sources.PACKAGES) and len(found) > 100
    assert not [file for file in found.values() if "report" in file.parts]
    monkeypatch.setattr(sources, "PACKAGES", ("no_such_package",))
    with pytest.raises(RuntimeError, match=r"the source of .*no_such_package"):
        sources.modules.__wrapped__()


def explode(problem):
    raise FloatingPointError("too steep")


@pytest.mark.slow
@pytest.mark.parametrize("workers", [1, 2])
def test_a_solve_that_raises_is_named(problems, workers):
    with pytest.raises(FloatingPointError, match="too steep") as caught:
        Engine(workers=workers).map(explode, problems)
    assert any(note.startswith("in explode(Toy(number=") for note in caught.value.__notes__)


def test_other_numerics_do_not_reuse_results(problems, tmp_path, monkeypatch):
    engine = Engine(store=tmp_path / "store")
    engine.map(toy, problems)
    monkeypatch.setattr(ensemble, "version_behind", lambda module, problem: "another version")
    engine.map(toy, problems)
    assert len(computed(problems[0].log)) == 10


def test_realisations_have_addresses():
    """Independent of how many others are drawn; different for every key."""
    draws = {key: random_generator(7, *key).random() for key in [(1, 700, 0), (1, 700, 1), (2, 700, 0), (1, 400, 0)]}
    assert len(set(draws.values())) == 4
    assert random_generator(7, 1, 700, 1).random() == draws[1, 700, 1]
    assert random_generator(8, 1, 700, 1).random() != draws[1, 700, 1]


@pytest.mark.slow
def test_fewer_surfaces_are_the_first_of_more():
    from tests.engine.small_punches import SMALL, fractal_punch

    few = fractal_punch.run(SMALL)
    more = fractal_punch.run(fractal_punch.FractalPunch(**{**vars(SMALL), "surfaces": ((0, 5, 5, 4, 0),)}))
    of_few, of_more = (result[0.7, "boundary elements", 16]["stiffness"] for result in (few, more))
    np.testing.assert_array_equal(of_few, of_more[:4])


@catches("results of other libraries", library="scipy").at("validation.engine.sources.LIBRARIES", ("numpy",))
@pytest.mark.parametrize("library", ["numpy", "scipy", "pyfftw"])
def test_another_version_of_a_library_is_another_version_of_the_numerics(library):
    digest, version = sources.version_of_numerics.__wrapped__, importlib.metadata.version
    here = digest()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(importlib.metadata, "version", lambda name: "9" if name == library else version(name))
        assert digest() != here


@pytest.mark.slow
def test_the_source_is_read_when_the_code_is():
    """Whoever edits it while it runs does not make old results new."""
    code = "from validation.engine import engine, sources; print(sources.version_of_numerics.cache_info().currsize)"
    run = subprocess.run([sys.executable, "-c", code], cwd=ROOT, env=ENVIRONMENT, capture_output=True, encoding="utf-8")
    assert run.stdout == "1\n", run.stderr


@dataclass(frozen=True)
class Several:
    """A problem that holds what problems hold."""

    spectra: tuple[mdr.SelfAffine, ...]
    places: list[float]
    named: dict[str, float]
    hidden: float = field(default=0.0, repr=False)
    later: float | None = field(default=None, metadata={"later": True})

    def __repr__(self) -> str:
        return "Several(...)"


@catches("a key of what a problem prints").at("tests.engine.test_engine.identity", repr)
def test_a_key_has_all_digits_whatever_prints():
    """Else two problems would share a stored result."""
    near = [mdr.SelfAffine(hurst=0.7, q_min=1.0, q_max=2.0, rms=rms) for rms in (1.0, 1.0 + 1e-12)]
    assert repr(near[0]) == repr(near[1]) and identity(near[0]) != identity(near[1])
    assert identity(near[0]) == "SelfAffine(hurst=0.7, q_min=1.0, q_max=2.0, rms=1.0)"
    several = Several((near[1],), [0.1 + 0.2], {"x": 1 / 3})
    assert identity(several) == (
        "Several(spectra=(SelfAffine(hurst=0.7, q_min=1.0, q_max=2.0, rms=1.000000000001),), "
        "places=[0.30000000000000004], named={'x': 0.3333333333333333})"
    )
    assert identity(replace(several, later=1.0)) == identity(several)[:-1] + ", later=1.0)"
    assert identity(Resolution(size=3)) == repr(Resolution(size=3))
