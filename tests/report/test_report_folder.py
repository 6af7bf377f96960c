"""A report replaces an earlier one and touches nothing else; one run at a time; what a folder must be."""

import errno
import fcntl
import io
import json
import os
import signal
import socket
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from tests.engine.toys import ENVIRONMENT, ROOT
from tests.report.test_command_line import SMALL
from validation import __main__ as command
from validation.engine import files
from validation.engine.files import name_in
from validation.report.contents import CASES
from validation.report.folder import LOCK, LOCK_KIND, MANIFEST, Folder, as_manifest, digest_of, listed_in, locked


@pytest.fixture(autouse=True)
def _small(monkeypatch, without_figures):
    for name in ("hertz", "geike"):
        monkeypatch.setitem(CASES, name, replace(CASES[name], quick=SMALL[name]))


def report(out, *names):
    return command.main(["report", "--only", *names, "--out", str(out), "--workers", "1"])


def tree(folder):
    """All that is below, links as links."""
    return {name_in(folder, path): held_by(path) for path in sorted(folder.rglob("*"))}


def held_by(path):
    if path.is_symlink():
        return path.readlink()
    return path.read_bytes() if path.is_file() else None


def refused(out, capsys, *said):
    """Bad input in one sentence, and nothing has changed."""
    before = tree(out)
    capsys.readouterr()
    assert report(out, "geike") == command.Exit.BAD_INPUT
    sentence = capsys.readouterr().err.splitlines()[-1]
    assert sentence.startswith("error: ")
    for part in said:
        assert part in sentence
    assert tree(out) == before


def fill(folder, contents):
    for name, text in contents.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")


THESIS = {"figures/thesis.svg": "mine", "data/measured.csv": "mine", "data/half.part": "mine"}


@pytest.mark.parametrize(
    "marks",
    [
        {"results.json": "mine"},
        {"results.json": json.dumps({"profile": "quick", "cases": {}}), "index.html": "<html>"},
        {"realisations/x.npz": "mine"},
        {MANIFEST: '{"name": "an app of the web"}'},
        {MANIFEST: "half of"},
        {MANIFEST: "[" * 100_000},
        {MANIFEST: json.dumps({"kind": "mdr-validation report", "format": 99, "files": {}})},
        {MANIFEST: json.dumps({"kind": "mdr-validation report", "format": 1, "files": ["index.html"]})},
    ],
)
def test_a_folder_of_others_is_refused_and_left_as_it_is(marks, tmp_path, capsys):
    """results.json or realisations/ alone are no report, nor is a list that is not ours; an old report has none."""
    fill(tmp_path, THESIS | marks)
    refused(tmp_path, capsys, str(tmp_path), MANIFEST)


@pytest.mark.parametrize(
    "name", ["../thesis.svg", "/etc/passwd.csv", "figures/../../x.svg", "data/.hidden.csv", "notes.txt", "a/b.csv"]
)
def test_a_list_never_reaches_out_of_its_folder(name, tmp_path, capsys):
    """Not even where it knows what is there."""
    out = tmp_path / "out"
    fill(tmp_path, {"thesis.svg": "mine", "out/notes.txt": "mine", "x.svg": "mine"})
    (out / MANIFEST).write_bytes(as_manifest({name: (digest_of(b"mine"),)}))
    refused(out, capsys, MANIFEST)
    assert (tmp_path / "thesis.svg").exists()


def test_an_earlier_report_is_replaced_and_files_of_others_stay(tmp_path):
    """What the list names goes; all else, whatever it is called, is as it was."""
    assert report(tmp_path, "hertz", "geike") == command.Exit.MET
    ours = set(listed_in(tmp_path))
    assert ours == {n for n, text in tree(tmp_path).items() if text} - {MANIFEST} - realisations(tmp_path)
    others = {
        **THESIS,
        "notes.txt": "mine",
        "figures/hertz-mine.svg": "mine",
        "figures/deeper/a.svg": "mine",
        "realisations/race-run_heat-0123456789abcdef01234567.npz": "mine",
        "realisations/race.npz": "mine",
        "realisations/mine.part": "mine",
        "tmpabcdefgh.part": "mine",
    }
    fill(tmp_path, others)
    rooms = ("figures/", "data/", "realisations/", "")
    begun = [f"{room}.mdr-validation-a1_cdefg.part" for room in rooms]
    fill(tmp_path, dict.fromkeys(begun, "half of"))
    assert report(tmp_path, "geike") == command.Exit.MET
    assert {name: (tmp_path / name).read_text(encoding="utf-8") for name in others} == others
    left = {n for n, text in tree(tmp_path).items() if text} - {MANIFEST} - realisations(tmp_path)
    assert left - others.keys() == set(listed_in(tmp_path))
    assert not any("hertz" in name for name in left - others.keys())
    assert not any((tmp_path / name).exists() for name in begun)


def realisations(folder):
    return {name for name in tree(folder) if name.startswith("realisations/")}


@pytest.mark.parametrize("room", ["figures", "data", "sounds", "realisations"])
@pytest.mark.parametrize("taken", ["link", "file", "dangling"])
def test_a_room_that_is_a_link_is_refused(room, taken, tmp_path, capsys):
    out, elsewhere = tmp_path / "out", tmp_path / "elsewhere"
    with Folder(out) as folder:
        folder.replace({"index.html": b"old"})
    elsewhere.mkdir()
    if taken == "file":
        (out / room).write_text("mine", encoding="utf-8")
    else:
        (out / room).symlink_to(elsewhere if taken == "link" else tmp_path / "nowhere")
    refused(out, capsys, str(out / room))
    assert tree(elsewhere) == {}


@pytest.mark.parametrize("name", [MANIFEST, LOCK])
@pytest.mark.parametrize("kind", ["link", "pipe", "folder", "text"])
def test_a_marker_that_is_no_plain_file_of_ours_is_refused(name, kind, tmp_path, capsys):
    out = tmp_path / "out"
    with Folder(out) as folder:
        folder.replace({"index.html": b"old"})
    (tmp_path / "mine").write_bytes((out / MANIFEST).read_bytes() if name == MANIFEST else b"mine")
    (out / name).unlink(missing_ok=True)
    if kind == "link":
        (out / name).symlink_to(tmp_path / "mine")
    elif kind == "pipe":
        os.mkfifo(out / name)
    elif kind == "folder":
        (out / name).mkdir()
    else:
        (out / name).write_text("mine", encoding="utf-8")
    refused(out, capsys, str(out))
    assert (out / name).is_symlink() == (kind == "link")


def test_a_file_in_the_way_is_never_overwritten(tmp_path, capsys):
    """One of others at a place of the new report, and one of the old report that somebody has changed since."""
    assert report(tmp_path, "hertz") == command.Exit.MET
    fill(tmp_path, {"figures/geike.svg": "mine"})
    assert report(tmp_path, "geike") == command.Exit.BAD_INPUT
    assert "figures/geike.svg is not of this report" in capsys.readouterr().err
    assert (tmp_path / "figures/geike.svg").read_text(encoding="utf-8") == "mine"
    assert (tmp_path / "figures/hertz.svg").exists()
    (tmp_path / "figures/geike.svg").unlink()
    fill(tmp_path, {"figures/hertz.svg": "mine"})
    refused(tmp_path, capsys, "figures/hertz.svg", "changed")
    (tmp_path / "figures/hertz.svg").unlink()
    (tmp_path / "figures/hertz.svg").symlink_to("hertz.pdf")
    refused(tmp_path, capsys, "figures/hertz.svg", "changed")


@pytest.mark.parametrize(("step", "at"), [("replace", 4), ("unlink", 3)])
def test_a_report_that_was_cut_short_while_it_was_replaced_is_still_one(step, at, tmp_path, monkeypatch):
    """Between two new files, or before the old ones are gone: the next run forgets none and ends as if nothing was."""
    old = ("figures/old.svg", "figures/both.svg", "results.json")
    with Folder(tmp_path) as folder:
        folder.replace(dict.fromkeys(old, b"old"))
    done, count = getattr(Path, step), []

    def cut(self, *rest, **more):
        count.append(self)
        if len(count) == at:
            raise KeyboardInterrupt
        return done(self, *rest, **more)

    monkeypatch.setattr(Path, step, cut)
    with pytest.raises(KeyboardInterrupt), Folder(tmp_path) as folder:
        folder.replace({"figures/both.svg": b"new", "index.html": b"new"})
    monkeypatch.undo()
    assert (tmp_path / "figures/both.svg").read_bytes() == b"new"
    assert (tmp_path / "results.json").exists() and {*old, "index.html"} == set(listed_in(tmp_path))
    assert (tmp_path / "index.html").exists() is (step == "unlink")
    link = ".mdr-validation-abcdefgh.part"
    (tmp_path / link).symlink_to("thesis.svg")
    with Folder(tmp_path) as folder:
        folder.replace({"figures/b.svg": b"newer"})
    # a link that is named like something begun is no file of ours
    assert sorted(tree(tmp_path)) == [link, "figures", "figures/b.svg", MANIFEST]


def test_a_run_that_was_killed_before_anything_goes_on(tmp_path):
    """A lock and half a list, nothing else."""
    fill(tmp_path, {LOCK: "", ".mdr-validation-abcdefgh.part": "{"})
    assert report(tmp_path, "geike") == command.Exit.MET
    assert not list(tmp_path.rglob(".mdr*"))


HOLD = """
import sys
from pathlib import Path
from validation.report.folder import locked
with locked(Path(sys.argv[1])):
    print("here", flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def holder(tmp_path):
    process = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(tmp_path)],
        cwd=ROOT,
        env=ENVIRONMENT,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    )
    assert process.stdout.readline() == b"here\n"
    yield process
    process.kill()
    process.communicate()


def test_the_second_of_two_runs_is_refused_and_a_killed_one_forgotten(tmp_path, holder, capsys):
    for command_name in ("report", "precision", "benchmark"):
        assert command.main([command_name, "--out", str(tmp_path)]) == command.Exit.BAD_INPUT
        said = capsys.readouterr().err
        assert f"is being written by process {holder.pid} on {socket.gethostname()} since 20" in said
    assert [path.name for path in tmp_path.iterdir()] == [LOCK]
    holder.send_signal(signal.SIGKILL)
    holder.wait()
    assert (tmp_path / LOCK).exists()
    assert report(tmp_path, "geike") == command.Exit.MET
    assert not (tmp_path / LOCK).exists()


def test_the_lock_of_another_host_is_respected(tmp_path, capsys):
    """Its process cannot be seen from here; the sentence says what to remove."""
    host = "elsewhere\x1b[2J"
    fill(tmp_path, {LOCK: f"{LOCK_KIND}\n{host}\nprocess 1 on {host} since yesterday\n"})
    refused(tmp_path, capsys, r"process 1 on elsewhere\x1b[2J since yesterday", f"remove {tmp_path / LOCK}")
    (tmp_path / LOCK).unlink()
    assert report(tmp_path, "geike") == command.Exit.MET


def test_a_file_system_without_locks_is_refused(tmp_path, capsys, monkeypatch):
    def flock(handle, how):
        raise OSError(errno.EOPNOTSUPP, "Operation not supported")

    monkeypatch.setattr(fcntl, "flock", flock)
    assert report(tmp_path / "out", "geike") == command.Exit.BAD_INPUT
    assert "must be on a file system that has locks: Operation not supported" in capsys.readouterr().err


def test_a_lock_whose_file_was_removed_is_taken_anew(tmp_path, monkeypatch):
    """Its last holder removes the file between our opening and our locking it: what we have then is nobody's."""
    flock, removed = fcntl.flock, []

    def late(handle, how):
        if not removed:
            removed.append((tmp_path / LOCK).unlink())
        flock(handle, how)

    monkeypatch.setattr(fcntl, "flock", late)
    with locked(tmp_path):
        assert (tmp_path / LOCK).exists()
        with pytest.raises(ValueError, match="is being written by process"), locked(tmp_path):
            pass


def test_a_link_to_a_folder_is_followed_and_one_to_nothing_refused(tmp_path, capsys):
    (tmp_path / "there").mkdir()
    (tmp_path / "link").symlink_to("there")
    assert report(tmp_path / "link", "geike") == command.Exit.MET
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "there" / "index.html").exists()
    (tmp_path / "dangling").symlink_to("nowhere")
    refused(tmp_path / "dangling", capsys, "--out must be a folder")
    assert not (tmp_path / "nowhere").exists()


@pytest.mark.parametrize("name", ["file", "file/below", "x" * 300, "nul\0", "/proc/none/report"])
def test_a_path_that_can_be_no_folder_is_refused(name, tmp_path, capsys):
    (tmp_path / "file").write_text("mine", encoding="utf-8")
    assert report(tmp_path / name, "geike") == command.Exit.BAD_INPUT
    assert capsys.readouterr().err.startswith("error: --out must be a")
    assert (tmp_path / "file").read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize("refusal", [errno.EROFS, errno.EACCES])
def test_a_folder_that_cannot_be_written_is_refused(refusal, tmp_path, capsys, monkeypatch):
    opened = os.open

    def read_only(path, flags, *rest, **more):
        if flags & os.O_CREAT and str(path).startswith(str(tmp_path)):
            raise OSError(refusal, os.strerror(refusal), str(path))
        return opened(path, flags, *rest, **more)

    monkeypatch.setattr(os, "open", read_only)
    refused(tmp_path, capsys, "--out must be a folder that can be written", os.strerror(refusal))


def test_a_room_that_cannot_be_written_is_refused(tmp_path, capsys, monkeypatch):
    """Before anything is computed."""
    assert report(tmp_path, "geike") == command.Exit.MET
    monkeypatch.setattr(os, "access", lambda path, mode: Path(path).name != "realisations")
    refused(tmp_path, capsys, f"{tmp_path / 'realisations'} must be a folder that can be written")


class Full(io.BytesIO):
    """A file on a full disk, which says so without a name."""

    def __init__(self, handle):
        super().__init__()
        os.close(handle)

    def write(self, contents):
        raise OSError(self.says, os.strerror(self.says))


@pytest.mark.parametrize("says", [errno.ENOSPC, errno.EDQUOT])
@pytest.mark.parametrize("what", [".npz", ".svg", MANIFEST])
def test_a_full_disk_is_exit_4_and_names_the_path(says, what, tmp_path, capsys, monkeypatch):
    """While a result is stored, a figure or the list written: the report before is still whole."""
    assert report(tmp_path, "hertz") == command.Exit.MET
    before = tree(tmp_path)
    write = files.write_partial_file
    monkeypatch.setattr(Full, "says", says, raising=False)

    def begun(path, contents):
        with monkeypatch.context() as patch:
            if path.name.endswith(what):
                patch.setattr(os, "fdopen", lambda handle, mode: Full(handle))
            return write(path, contents)

    for module in ("validation.engine.files", "validation.report.folder"):
        monkeypatch.setattr(f"{module}.write_partial_file", begun)
    assert report(tmp_path, "geike") == command.Exit.UNFINISHED == 4
    sentence = capsys.readouterr().err.splitlines()[-1]
    assert sentence.startswith(f"error: {tmp_path}")
    assert f"{what}: {os.strerror(says)}; finished solves are kept" in sentence
    after = tree(tmp_path)
    assert {name: after[name] for name in before} == before
    assert not [name for name in after if name.endswith(".part")]


def test_only_may_be_given_more_than_once_and_with_commas(tmp_path):
    words = ["report", "--only", "geike,geike", "geike", "--only", "hertz", "--out", str(tmp_path), "--workers", "1"]
    assert command.main(words) == command.Exit.MET
    assert list(json.loads((tmp_path / "results.json").read_text(encoding="utf-8"))["cases"]) == ["geike", "hertz"]
    assert (tmp_path / "exact.html").read_text(encoding="utf-8").count('id="geike"') == 1


def test_the_reference_report_is_a_report():
    """It can be made anew where it is: its list names what it holds, and nothing else."""
    folder = ROOT / "reports" / "reference"
    listed = listed_in(folder)
    held = {
        name_in(folder, path): (digest_of(path.read_bytes()),)
        for path in folder.rglob("*")
        if path.is_file() and path.relative_to(folder).parts[0] not in (MANIFEST, "realisations")
    }
    assert listed == held


def test_a_lock_is_given_back_whatever_happens_and_gone_before(tmp_path, monkeypatch):
    """Who removes it afterwards removes the lock of the next one."""
    close, there = os.close, []

    def late(handle):
        there.append((tmp_path / LOCK).exists())
        close(handle)

    monkeypatch.setattr(os, "close", late)
    with pytest.raises(KeyboardInterrupt), locked(tmp_path):
        raise KeyboardInterrupt
    monkeypatch.undo()
    assert there == [False]
