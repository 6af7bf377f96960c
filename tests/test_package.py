"""What pip installs: the same files from the checkout and from the sdist, and commands that need no checkout."""

import os
import re
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from importlib import metadata
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
VERSION = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
PACKAGES = ("mdr", "bem3d", "validation")
pytestmark = pytest.mark.slow


def run(*words, cwd, **variables):
    done = subprocess.run(
        [sys.executable, *map(str, words)],
        cwd=cwd,
        env={name: value for name, value in os.environ.items() if name != "PYTHONPATH"} | variables,
        capture_output=True,
        encoding="utf-8",
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def built(kind, source, folder):
    """The wheel or the sdist of a source tree."""
    run("-m", "hatchling", "build", "-t", kind, "-d", folder, cwd=source)
    (made,) = folder.iterdir()
    return made


def files(wheel):
    with zipfile.ZipFile(wheel) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    return built("wheel", ROOT, tmp_path_factory.mktemp("wheel"))


@pytest.fixture(scope="module")
def installed(wheel, tmp_path_factory):
    target = tmp_path_factory.mktemp("installed")
    run("-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--target", target, wheel, cwd=target)
    return target


def test_what_names_the_version_agrees():
    """The newest section of the changelog, with its date, and what is cited."""
    newest = re.search(
        r"^## \[([\d.]+)\] - ([\d-]+)$", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE
    ).groups()
    cited = re.search(
        r"^version: (.+)\ndate-released: (.+)$", (ROOT / "CITATION.cff").read_text(encoding="utf-8"), re.MULTILINE
    ).groups()
    assert newest == cited and cited[0] == VERSION == metadata.version("mdr-validation")


def test_the_wheel_has_all_files_of_the_packages(wheel):
    """Also those that are no Python: templates, scenes, levels, statements of the book, errors of models, examples."""
    there = (path for package in PACKAGES for path in (ROOT / package).rglob("*") if path.is_file())
    expected = {
        path.relative_to(ROOT).as_posix(): path.read_bytes() for path in there if "__pycache__" not in path.parts
    }
    found = {name: data for name, data in files(wheel).items() if ".dist-info" not in name}
    assert found == expected
    assert {Path(name).suffix for name in found} >= {".py", ".pyi", ".typed", ".html", ".css", ".toml", ".csv", ".npz"}


def test_the_sdist_builds_the_same_wheel(wheel, tmp_path):
    sdist = built("sdist", ROOT, tmp_path / "sdist")
    with tarfile.open(sdist) as archive:
        archive.extractall(tmp_path / "source", filter="data")
    (source,) = (tmp_path / "source").iterdir()
    again = built("wheel", source, tmp_path / "wheel")
    assert again.name == wheel.name
    assert files(again) == files(wheel)
    assert (source / "reports/docs/conf.py").exists()
    assert not (source / "reports/reference").exists()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("--version", VERSION),
        ("scene rail", "[wheel]"),
        ("cases", "fractal_punch"),
        ("compare sphere", "closed form"),
        ("report --only geike --out made --workers 1", "made/index.html"),
    ],
)
def test_a_command_runs_outside_of_the_checkout(installed, tmp_path, words, said):
    printed = run(installed / "bin" / "mdr-validation", *words.split(), cwd=tmp_path, PYTHONPATH=str(installed))
    assert said in printed
    place = run("-c", "import validation; print(validation.__file__)", cwd=tmp_path, PYTHONPATH=str(installed))
    assert Path(place.strip()).parent == installed / "validation"
