"""What a stream cannot write is replaced: no command ends by a character that the encoding of a terminal lacks."""

import io
import os
import subprocess
import sys

import pytest

from validation.analysis.escapes import never_fatal

SAID = "± 1.2 µm × 2 dB — k̄ ≥ 0 é ☃"


def written(encoding, text, **settings):
    """What a stream of this encoding has, decoded."""
    raw = io.BytesIO()
    stream = io.TextIOWrapper(raw, encoding=encoding, write_through=True, **settings)
    never_fatal([stream, None, io.StringIO()])
    stream.write(text)
    return raw.getvalue().decode(encoding)


@pytest.mark.parametrize(
    ("encoding", "expected"),
    [
        ("ascii", "+- 1.2 um x 2 dB - k >= 0 e ?"),
        ("latin-1", "± 1.2 µm × 2 dB - k >= 0 é ?"),
        ("cp437", "± 1.2 µm x 2 dB - k ≥ 0 é ?"),
        ("cp1252", "± 1.2 µm × 2 dB — k >= 0 é ?"),
        ("utf-8", SAID),
    ],
)
def test_what_an_encoding_lacks_is_written_with_what_it_has(encoding, expected):
    assert written(encoding, SAID).replace("k?", "k") == expected


def test_a_handler_that_a_user_has_chosen_stays():
    assert written("ascii", "±", errors="xmlcharrefreplace") == "&#177;"


FIT = ["compare", "rough_punch", "--models", "fit", "--tolerance", "100%"]
ASCII = {"PYTHONIOENCODING": "ascii"}
LOCALE = {"LC_ALL": "C", "PYTHONUTF8": "0"}


@pytest.mark.parametrize("about", [ASCII, LOCALE], ids=["PYTHONIOENCODING", "LC_ALL"])
@pytest.mark.parametrize("words", [FIT, ["sound", "-h"]])
def test_a_command_ends_well_in_ascii(about, words):
    """PYTHONIOENCODING goes before what the locale says."""
    kept = {name: value for name, value in os.environ.items() if name not in ("PYTHONIOENCODING", *LOCALE)}
    command = [sys.executable, "-m", "validation", *words]
    found = subprocess.run(command, env=kept | about, capture_output=True, check=False)
    notes = [line for line in found.stderr.splitlines() if line.startswith(b"note: ")]
    assert (found.returncode, found.stderr.splitlines()) == (0, notes)
    assert words[0] == "sound" or b"1 um" in found.stdout


def test_an_error_names_what_a_terminal_cannot_show():
    """A file that is missing is named with escapes, by which a person finds it."""
    command = [sys.executable, "-m", "validation", "compare", "µ.toml".encode()]  # in whatever encoding the tests run
    about = {**os.environ, "PYTHONIOENCODING": "ascii:strict", "PYTHONUTF8": "1"}
    found = subprocess.run(command, env=about, capture_output=True, check=False)
    assert (found.returncode, found.stderr[:26]) == (2, rb"error: scene \xb5.toml can")
