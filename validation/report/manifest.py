"""The list of the files that a report has written; a folder with such a list is known as a report."""

import hashlib
import json
import re
from collections.abc import Mapping
from pathlib import Path

from validation.engine.files import read_plain

MANIFEST = "manifest.json"
KIND, FORMAT = "mdr-validation report", 1
COMPARISON, SOUND, CALIBRATION = "mdr-validation comparison", "mdr-validation sound", "mdr-validation calibration"
REFERENCES = "mdr-validation references"
"""Kinds of the folders of `compare --report`, `sound` and `calibrate`, with and without `--references`: none takes the
place of another."""
NAME = re.compile(
    r"(?:(?:figures|data|sounds)/)?[^./\\\x00-\x1f\x7f][^/\\\x00-\x1f\x7f]*\.(?:html|json|svg|pdf|csv|wav)"
)
"""Names that files of a report may have; a list with other names is none of a report."""

Listed = Mapping[str, tuple[str, ...]]
"""Files below the folder, each with the SHA-256 of what it holds, or of what it may hold while it is replaced."""


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
        wanted = kind.removeprefix("mdr-validation ")
        raise ValueError(f"{folder / MANIFEST} is not the list of a {wanted}: name another folder") from None
    return listed


def digest_of(contents: bytes) -> str:
    return hashlib.sha256(contents).hexdigest()


def both(before: Listed, after: Listed) -> Listed:
    """Files that may be in the folder while one report replaces another."""
    return {name: tuple({*before.get(name, ()), *after.get(name, ())}) for name in before.keys() | after.keys()}
