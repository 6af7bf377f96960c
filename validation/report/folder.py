"""The report folder: what is written there is on a list, and replaced whole or not at all."""

import fcntl
import hashlib
import json
import os
import re
import socket
import stat
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from datetime import datetime
from pathlib import Path
from typing import Self

from validation.engine.files import (
    ERRORS_OF_A_PATH,
    PARTIAL_FILE,
    is_plain,
    is_there,
    place_in,
    read_plain,
    with_path_in_errors,
    write_partial_file,
    write_whole,
)

LOCK = ".mdr-validation.lock"
"""The file, there while a run writes, and after one that was killed."""
LOCK_KIND = "mdr-validation lock"


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """No other run writes a report into the folder meanwhile.

    The system gives its lock back when a process ends, however it ends, so a file without a lock is that of a run that
    was killed; unless the run was on another host, whose locks may not be seen from here.
    Raises ValueError where another run is at work, or may be, and where there are no locks; OSError, which names the
    file, where it cannot be written.
    """
    path = folder / LOCK
    while (handle := _taken(path)) is None:
        pass
    try:
        yield
    finally:
        path.unlink(missing_ok=True)
        os.close(handle)


def _taken(path: Path) -> int | None:
    """The file, locked and signed; None where its last holder has removed it meanwhile."""
    folder, host = path.parent, socket.gethostname()
    with ExitStack() as given_up:
        handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC, 0o644)
        given_up.callback(os.close, handle)
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            _, holder = _signature(handle, path)
            message = f"{folder} is being written by {holder or 'another run'}: wait for it, or name another folder"
            raise ValueError(message) from None
        except OSError as error:
            raise ValueError(f"{folder} must be on a file system that has locks: {error.strerror}") from None
        try:
            if not os.path.samestat(os.fstat(handle), path.lstat()):
                return None
        except FileNotFoundError:
            return None
        signed, holder = _signature(handle, path)
        if signed not in ("", host):
            what_to_do = f"wait for it, or remove {path} if it is over"
            raise ValueError(f"{folder} is being written by {holder}, on another host: {what_to_do}")
        since = datetime.now().astimezone().isoformat(" ", timespec="seconds")
        with with_path_in_errors(path):
            os.ftruncate(handle, 0)
            os.pwrite(handle, f"{LOCK_KIND}\n{host}\nprocess {os.getpid()} on {host} since {since}\n".encode(), 0)
        given_up.pop_all()
    return handle


def _signature(handle: int, path: Path) -> tuple[str, str]:
    """Host of a run and the run in words, empty before it has signed. Raises ValueError for a file that is no lock."""
    plain = stat.S_ISREG(os.fstat(handle).st_mode)
    text = os.pread(handle, 4096, 0).decode(errors="replace") if plain else "no plain file"
    kind, *signed = text.split("\n")
    if text and (kind != LOCK_KIND or len(signed) != 3):
        raise ValueError(f"{path} is not the lock of a run: move it away, or name another folder")
    return (signed[0], signed[1]) if text else ("", "")


REALISATIONS = "realisations"
RESULTS = "results.json"
SOUNDS = "sounds"
ROOMS = ("figures", "data", SOUNDS, REALISATIONS)
MANIFEST = "manifest.json"
KIND, FORMAT = "mdr-validation report", 1
COMPARISON, SOUND, CALIBRATION = "mdr-validation comparison", "mdr-validation sound", "mdr-validation calibration"
REFERENCES, JUDGEMENT = "mdr-validation references", "mdr-validation judgement"
"""Kinds of the folders of `compare --report`, `sound`, `judge` and `calibrate`, with and without `--references`: none
takes the place of another."""
NAME = re.compile(
    r"(?:(?:figures|data|sounds)/)?[^./\\\x00-\x1f\x7f][^/\\\x00-\x1f\x7f]*\.(?:html|json|svg|pdf|csv|npz|wav)"
    r"|summary\.txt"
)
"""Names that files of a report may have; a list with other names is none of a report."""

Listed = Mapping[str, tuple[str, ...]]
"""Files below the folder, each with the SHA-256 of what it holds, or of what it may hold while it is replaced."""


class Folder(ExitStack):
    """A folder that holds a report, or nothing yet, for one run at a time: a context manager.

    Made if need be; a link to a folder is followed. What its list names was written by a report: nothing else in it is
    ever replaced or removed, but what killed runs had begun to write, under names of its own. A folder that is rejected
    is left as it was.
    Raises ValueError for a path that is no folder, a folder with something else in it, a report that has been changed
    since, and one that cannot be written or that another run is at; OSError for a full disk.
    """

    def __init__(self, path: Path, *, kind: str = KIND, option: str = "--out"):
        """kind: of report, which replaces no other kind; option: that names the path, for messages."""
        super().__init__()
        self.path, self.kind, self.option = path, kind, option

    def __enter__(self) -> Self:
        try:
            with ExitStack() as opening:
                self._listed()
                self.path.mkdir(parents=True, exist_ok=True)
                opening.enter_context(locked(self.path))
                # once more, now that no other run writes here; the list comes before anything else, so that a killed
                # run can continue
                self._list(self._listed())
                self.enter_context(opening.pop_all())
        except OSError as error:
            if error.errno not in ERRORS_OF_A_PATH:
                raise
            raise ValueError(
                f"{self.option} must be a folder that can be written, got {self.path}: {error.strerror}"
            ) from None
        return self

    def replace(self, contents: Mapping[str, bytes]) -> None:
        """Put a report in the place of the one before: all of it, or nothing where the disk is full.

        Raises ValueError for a file of others in one of its places, OSError, which names the place, for a full disk.
        """
        before = self._listed()
        after = {name: (digest_of(content),) for name, content in contents.items()}
        for name in after.keys() - before.keys():
            if is_there(place_in(self.path, name)):
                raise ValueError(f"{self.path / name} is not of this report and in its way: move it away")
        with ExitStack() as begun:
            places = {}
            for name, content in contents.items():
                temporary = write_partial_file(place_in(self.path, name), content)
                begun.callback(temporary.unlink, missing_ok=True)
                places[temporary] = place_in(self.path, name)
            self._list(both(before, after))
            for temporary, place in places.items():
                with with_path_in_errors(place):
                    temporary.replace(place)
        for name in before.keys() - after.keys():
            place_in(self.path, name).unlink(missing_ok=True)
        self._list(after)
        self._sweep()

    def _list(self, listed: Listed) -> None:
        write_whole(self.path / MANIFEST, as_manifest(listed, self.kind))

    def _listed(self) -> Listed:
        """What a report has written here, as it was written or gone since; nothing where there is none yet."""
        folder = self.path
        if "\0" in str(folder):
            raise ValueError(f"{self.option} must be a name that a folder can have, got {str(folder)!r}")
        if not folder.is_dir():
            return {}
        if not is_there(folder / MANIFEST):
            if any(entry.name != LOCK and not PARTIAL_FILE.fullmatch(entry.name) for entry in folder.iterdir()):
                raise ValueError(
                    f"{self.option} must be a new or empty folder or an earlier report, got {folder} with other files "
                    f"and without {MANIFEST}, by which reports are known: name another, or remove it yourself if it is "
                    "an old report"
                )
            return {}
        _check_rooms(folder)
        listed = listed_in(folder, self.kind)
        for name, digests in listed.items():
            place = place_in(folder, name)
            if is_there(place) and not (is_plain(place) and digest_of(place.read_bytes()) in digests):
                raise ValueError(f"{folder / name} has been changed since the report was written: move it away")
        return listed

    def _sweep(self) -> None:
        """Remove what killed runs had begun to write."""
        for room in (self.path, *(self.path / name for name in ROOMS)):
            for file in room.glob("*.part"):
                if PARTIAL_FILE.fullmatch(file.name) and is_plain(file):
                    file.unlink(missing_ok=True)


def _check_rooms(folder: Path) -> None:
    """Raise ValueError where files of the report would be written elsewhere, or nowhere."""
    for room in (folder / name for name in ROOMS):
        if is_there(room) and (room.is_symlink() or not room.is_dir()):
            raise ValueError(f"{room} must be a folder of the report's own, got a link or a file: move it away")
        if is_there(room) and not os.access(room, os.W_OK | os.X_OK):
            raise ValueError(f"{room} must be a folder that can be written")


def as_manifest(listed: Listed, kind: str = KIND) -> bytes:
    files = {name: sorted(digests) for name, digests in listed.items()}
    return (json.dumps({"kind": kind, "format": FORMAT, "files": files}, indent=1, sort_keys=True) + "\n").encode()


def listed_in(folder: Path, kind: str = KIND) -> Listed:
    """The list of a folder. Raises ValueError where it is of another kind, OSError where there is none."""
    try:
        manifest = json.loads(read_plain(folder / MANIFEST))
        if (manifest["kind"], manifest["format"]) != (kind, FORMAT):
            raise ValueError("of another kind")
        listed = {name: tuple(digests) for name, digests in manifest["files"].items()}
        if not all(NAME.fullmatch(name) and name != MANIFEST for name in listed):
            raise ValueError("names that no report has")
    # a foreign file may hold anything
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        kind_of_report = kind.removeprefix("mdr-validation ")
        raise ValueError(f"{folder / MANIFEST} is not the list of a {kind_of_report}: name another folder") from None
    return listed


def digest_of(contents: bytes) -> str:
    return hashlib.sha256(contents).hexdigest()


def both(before: Listed, after: Listed) -> Listed:
    """Files that may be in the folder while one report replaces another."""
    return {name: tuple({*before.get(name, ()), *after.get(name, ())}) for name in before.keys() | after.keys()}
