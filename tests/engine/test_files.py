"""What is written where a user says: plain files appear whole, anything else stays what it is and is written into."""

import errno
import os
import stat
import subprocess
import sys
import threading
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest

from tests.seeded import catches
from validation.__main__ import main
from validation.engine import engine as ensemble
from validation.engine.files import ERRORS_OF_A_PATH, read_plain, write_output, write_whole


@pytest.fixture
def umask():
    """Sets it for one test."""
    before = os.umask(0o022)
    yield os.umask
    os.umask(before)


def mode(path):
    return stat.S_IMODE(path.stat().st_mode)


def names(folder):
    return sorted(path.name for path in folder.iterdir())


@pytest.mark.parametrize("write", [write_output, write_whole])
@pytest.mark.parametrize(("mask", "wanted"), [(0o022, 0o644), (0o077, 0o600), (0o002, 0o664)])
def test_a_new_file_has_the_mode_of_the_umask(write, mask, wanted, tmp_path, umask):
    umask(mask)
    write(tmp_path / "new", b"it")
    assert mode(tmp_path / "new") == wanted


@catches("a mode of our own for the file that is there", before=0o600).at("stat.S_IMODE", lambda mode: 0o644)
@pytest.mark.parametrize("before", [0o600, 0o640, 0o666])
def test_a_file_that_is_there_keeps_its_mode_and_is_replaced(before):
    """It is replaced: who reads it goes on with the file that it was."""
    with TemporaryDirectory() as folder:
        path = Path(folder, "old")
        path.write_bytes(b"before")
        path.chmod(before)
        with path.open("rb") as reader:
            write_output(path, b"after")
            assert reader.read() == b"before"
        assert (path.read_bytes(), path.stat().st_mode & 0o777, names(path.parent)) == (b"after", before, ["old"])


@catches("a link replaced by a file").at("posixpath.realpath", str)
def test_a_link_is_followed():
    """To a file, and to nothing yet."""
    with TemporaryDirectory() as folder:
        real, link, to_nothing = (Path(folder, name) for name in ("real", "link", "to nothing"))
        real.write_bytes(b"before")
        real.chmod(0o640)
        link.symlink_to("real")
        to_nothing.symlink_to("new")
        write_output(link, b"after")
        write_output(to_nothing, b"made")
        assert (link.is_symlink(), to_nothing.is_symlink()) == (True, True)
        assert (real.read_bytes(), mode(real), Path(folder, "new").read_bytes()) == (b"after", 0o640, b"made")


def test_a_pipe_is_written_into(tmp_path):
    pipe, got = tmp_path / "pipe", []
    os.mkfifo(pipe)
    reader = threading.Thread(target=lambda: got.append(pipe.read_bytes()))
    reader.start()
    write_output(pipe, b"it")
    reader.join()
    assert got == [b"it"] and stat.S_ISFIFO(pipe.lstat().st_mode)


@pytest.mark.skipif(os.geteuid() != 0, reason="needs the right to make a device")
def test_a_device_stays_one(tmp_path):
    device = tmp_path / "device"
    try:
        os.mknod(device, stat.S_IFCHR | 0o666, os.makedev(1, 3))
    except PermissionError:
        pytest.skip("no device can be made here")
    assert main(["compare", "sphere", "--json", str(device)]) == 0
    assert stat.S_ISCHR(device.lstat().st_mode)


WRITES_TWICE = """
import pathlib
from validation.engine.files import write_output
print("before")
write_output(pathlib.Path("/dev/stdout"), b"it")
print("after")
"""


@pytest.mark.parametrize("into", ["pipe", "file"])
def test_standard_output_has_all_in_its_order(into, tmp_path):
    with (tmp_path / "printed").open("wb") as file:
        stdout = subprocess.PIPE if into == "pipe" else file
        run = subprocess.run([sys.executable, "-c", WRITES_TWICE], stdout=stdout, check=True)
    assert (run.stdout or (tmp_path / "printed").read_bytes()) == b"before\nitafter\n"


@pytest.mark.parametrize("write", [write_output, write_whole])
def test_what_cannot_be_written_is_named_and_nothing_is_left(write, tmp_path):
    (tmp_path / "folder").mkdir()
    (tmp_path / "loop").symlink_to("loop")
    paths = [tmp_path / "folder", tmp_path / "loop" / "below", tmp_path / ("x" * 300)]
    for path in paths:
        with pytest.raises(OSError, match=str(path)) as raised:
            write(path, b"it")
        assert raised.value.errno in {*ERRORS_OF_A_PATH, errno.ENOTEMPTY}
    assert names(tmp_path) == ["folder", "loop"]


def test_a_write_that_fails_leaves_the_file_that_is_there(tmp_path, monkeypatch):
    path = tmp_path / "old"
    path.write_bytes(b"before")
    with pytest.raises(TypeError):
        write_output(path, "text")
    monkeypatch.setattr(type(path), "replace", lambda *_: (_ for _ in ()).throw(OSError(errno.ENOSPC, "full")))
    with pytest.raises(OSError, match="full"):
        write_output(path, b"after")
    assert (path.read_bytes(), names(tmp_path)) == (b"before", ["old"])


@pytest.mark.slow
def test_every_option_that_names_a_file_follows_a_link(tmp_path):
    """None of them replaces what is no plain file."""
    words = ["compare", "rail", "--tolerance", "3 dB", "--models", "linear, on the line"]
    for option, name in (("--json", "a.json"), ("--csv", "a.csv"), ("--cnossos", "b.csv"), ("--figure", "a.svg")):
        (tmp_path / name).symlink_to(f"real-{name}")
        words += [option, str(tmp_path / name)]
    main(words)
    for link in (path for path in tmp_path.iterdir() if not path.name.startswith("real-")):
        assert link.is_symlink() and link.stat().st_size > 100


def test_a_link_is_not_read_as_a_plain_file(tmp_path):
    (tmp_path / "real").write_bytes(b"it")
    (tmp_path / "link").symlink_to("real")
    assert read_plain(tmp_path / "real") == b"it"
    with pytest.raises(OSError):
        read_plain(tmp_path / "link")


def test_a_stored_result_is_known_by_its_seal_alone(tmp_path):
    """Whatever reads the archive would not see it."""
    path = tmp_path / "it.npz"
    ensemble.save_result(path, "key", {"value": np.arange(3.0)})
    whole = path.read_bytes()
    assert (
        ensemble.load_result(path, "key")["value"].tolist() == [0.0, 1.0, 2.0]
        and ensemble.load_result(path, "other") is None
    )
    path.write_bytes(whole[:-1] + bytes([whole[-1] ^ 1]))
    assert ensemble.load_result(path, "key") is None
    ensemble.forget_results({path: "key"})
    assert path.exists()
