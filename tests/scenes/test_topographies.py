"""Topographies of SurfaceTopography where it is installed, and files that it or a stand-in of it reads."""

import contextlib
import sys
import warnings
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest

from tests.railway.test_rail_files import CURVE, loaded
from tests.scenes.test_height_forms import scene_of
from validation.scenes.load import load_scene
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.measured_surface import measured

N = 48
HEIGHT = 0.3 * np.random.default_rng(7).standard_normal((N, N))
"""In micrometres, on one millimetre."""


def topographies():
    """The package; the test is skipped where it, or what it imports, is not there."""
    try:
        with warnings.catch_warnings(action="ignore"):
            import SurfaceTopography
    except ImportError as reason:
        pytest.skip(f"could not import SurfaceTopography: {reason}")
    return SurfaceTopography


@pytest.mark.parametrize(("unit", "metre"), [("m", 1.0), ("um", 1e6), ("Å", 1e10)])
def test_heights_and_sizes_have_the_unit_of_a_topography(unit, metre):
    one = topographies().Topography(1e-6 * metre * HEIGHT, (1e-3 * metre, 1e-3 * metre), unit=unit)
    found, expected = measured(one), MeasuredHeights(height=1e-6 * HEIGHT, spacing=(1e-3 / N, 1e-3 / N))
    assert found.spacing == pytest.approx(expected.spacing, rel=1e-12)
    assert found.height == pytest.approx(expected.height, rel=1e-9, abs=1e-18)
    assert load_scene("rough_punch", heights=one).ground.rms == pytest.approx(found.rms, rel=1e-12)


# Files of instruments


def as_installed(monkeypatch, topography, *, sizes=True):
    """A stand-in of the package that reads each file as one topography; it prints, as some of its readers do."""

    @contextlib.contextmanager
    def open_topography(path):
        sys.stdout.write("secret")
        sys.stderr.write("secret")
        if topography is None:
            raise KeyError("secret")
        channel = SimpleNamespace(
            physical_sizes=topography.physical_sizes if sizes else None, nb_grid_pts=topography.heights().shape
        )
        yield SimpleNamespace(default_channel=channel, topography=lambda **sizes: topography)

    package, reader = ModuleType("SurfaceTopography"), ModuleType("SurfaceTopography.IO")
    reader.open_topography = open_topography
    monkeypatch.setitem(sys.modules, "SurfaceTopography", package)
    monkeypatch.setitem(sys.modules, "SurfaceTopography.IO", reader)


def uniform(heights, sizes, unit):
    return SimpleNamespace(heights=lambda: heights, physical_sizes=sizes, unit=unit, is_uniform=True)


BINARY = bytes(range(256)) * 3


@pytest.mark.parametrize("file", ["face.nc", "face.x3p", "face.anything"])
def test_the_file_of_an_instrument_has_its_sizes_and_its_unit(tmp_path, monkeypatch, capsys, file):
    as_installed(monkeypatch, uniform(HEIGHT, (48.0, 48.0), "um"))
    (tmp_path / file).write_bytes(BINARY)
    path = scene_of(tmp_path, file, side="48 um")
    path.write_text(path.read_text(encoding="utf-8").replace('spacing = "1 um"', ""), encoding="utf-8")
    ground = load_scene(path).ground
    expected = MeasuredHeights(height=1e-6 * HEIGHT, spacing=(1e-6, 1e-6))
    assert ground.height == pytest.approx(expected.height, rel=1e-9, abs=1e-18)
    assert ground.spacing == pytest.approx((1e-6, 1e-6))
    assert ground.notes()[0].startswith(f"{file}: SurfaceTopography read it as ")
    assert "secret" not in "".join(capsys.readouterr())
    for key, said in (('unit = "mm"', r"heights\.unit must be that of the file, um"), ("skip = 3", "heights")):
        with pytest.raises(ValueError, match=said):
            load_scene(scene_of(tmp_path, file, key, side="48 um"))
    with pytest.raises(ValueError, match=r"heights\.spacing must be that of the file, 1 µm, or be left out, got 2 µm$"):
        load_scene(scene_of(tmp_path, file, side="48 um", spacing='"2 um"'))


def test_a_file_that_names_no_unit_or_no_size_is_asked_for_it(tmp_path, monkeypatch):
    (tmp_path / "face.nc").write_bytes(BINARY)
    as_installed(monkeypatch, uniform(HEIGHT, (48.0, 48.0), None))
    with pytest.raises(ValueError, match=r'heights\.unit is missing: the file names none, as: unit = "um"$'):
        load_scene(scene_of(tmp_path, "face.nc", side="48 um"))
    assert load_scene(scene_of(tmp_path, "face.nc", 'unit = "um"', side="48 um")).ground.rms < 1e-6
    as_installed(monkeypatch, uniform(HEIGHT, (48.0, 48.0), "um"), sizes=False)
    path = scene_of(tmp_path, "face.nc", side="48 um")
    assert load_scene(path).ground.spacing == (1e-6, 1e-6)
    path.write_text(path.read_text(encoding="utf-8").replace('spacing = "1 um"', ""), encoding="utf-8")
    with pytest.raises(ValueError, match=r'heights\.spacing is missing, heights must have it, as: spacing = "1 um"$'):
        load_scene(path)


def test_a_line_of_an_instrument_is_one_of_a_rail_and_no_face(tmp_path, monkeypatch):
    line = 5 * np.random.default_rng(1).standard_normal(1000)
    (tmp_path / "line.nc").write_bytes(BINARY)
    changes = ("[rail.levels]", "[rail.lines]"), (CURVE, 'file = "line.nc"')
    as_installed(monkeypatch, uniform(1e-3 * line, (1000.0,), "mm"))
    scene = loaded(tmp_path, *changes)
    assert scene.roughness.spacing == 1e-3 and scene.roughness.height[:, 0] == pytest.approx(1e-6 * line)
    as_installed(monkeypatch, uniform(HEIGHT, (48.0, 48.0), "um"))
    with pytest.raises(ValueError, match=r"lines\.file must have lines, got heights over an area: .*rail\.heights"):
        loaded(tmp_path, *changes)
    as_installed(monkeypatch, uniform(HEIGHT[0], (48.0,), "um"))
    with pytest.raises(ValueError, match=r"heights\.file must have heights over an area, got one line"):
        load_scene(scene_of(tmp_path, "line.nc"))


def test_what_no_reader_knows_is_a_sentence_that_shows_nothing_of_it(tmp_path, monkeypatch, capsys):
    (tmp_path / "face.nc").write_bytes(b"secret" + BINARY)
    as_installed(monkeypatch, None)
    with pytest.raises(ValueError, match=r"a format that SurfaceTopography reads, got KeyError from it$") as said:
        load_scene(scene_of(tmp_path, "face.nc"))
    assert "secret" not in f"{said.value}{capsys.readouterr()}"


@pytest.mark.parametrize("file", ["face.nc", "face.plu", "face.sdf"])
def test_a_format_without_its_reader_names_the_extra(tmp_path, monkeypatch, file):
    monkeypatch.setitem(sys.modules, "SurfaceTopography.IO", None)
    (tmp_path / file).write_bytes(BINARY)
    with pytest.raises(ValueError, match=r'not installed: pip install "mdr-validation\[topography\]", or export'):
        load_scene(scene_of(tmp_path, file))


def test_real_files_of_the_package(tmp_path):
    package = topographies()
    one = package.Topography(HEIGHT, (48.0, 48.0), unit="um")
    one.to_netcdf(str(tmp_path / "face.nc"))
    one.to_x3p(str(tmp_path / "face.x3p"))
    rows = "\n".join(" ".join(f"{value:.9f}" for value in row) for row in HEIGHT.T)
    keys = "ManufacID = X\nCreateDate = 010120200000\nModDate = 010120200000\nNumPoints = 48\nNumProfiles = 48\n"
    scales = "Xscale = 1e-06\nYscale = 1e-06\nZscale = 1e-06\nZresolution = -1\nCompression = 0\nDataType = 7\n"
    (tmp_path / "face.sdf").write_text(f"aISO-1.0\n{keys}{scales}CheckType = 0\n*\n{rows}\n*\n", encoding="utf-8")
    for file in ("face.nc", "face.x3p", "face.sdf"):
        found = load_scene(scene_of(tmp_path, file, side="48 um")).ground
        assert found.height == pytest.approx(measured(one).height, rel=1e-5, abs=1e-14), file
    (tmp_path / "face.opd").write_bytes(BINARY)
    with pytest.raises(ValueError, match="must have a format that SurfaceTopography reads"):
        load_scene(scene_of(tmp_path, "face.opd"))
