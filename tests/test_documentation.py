"""The sources of the documentation, without building it: names that are there, formulas that are all there."""

import ast
import re
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

import bem3d
import mdr
import validation
from validation.railway.scenes import rail_file
from validation.simulation import limits

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "reports" / "docs"
PAGES = {path.stem: path.read_text(encoding="utf-8") for path in DOCS.glob("*.md")}
NAMED = {name for page in PAGES.values() for name in re.findall(r"\{py:\w+\}`(?:[^`<]*<)?~?([\w.]+)>?`", page)}
(SCENE,) = re.findall(r"```toml\n(.*?)```", PAGES["own_rail"], flags=re.DOTALL)
THEORY = Path(validation.__file__).parent / "theory"
THEORIES = (THEORY, *THEORY.parent.glob("*/theory"))
HELPERS = {
    "validation.theory.closed_forms.positive",
    "validation.theory.half_space.gauss_legendre",
    "validation.theory.half_space.on_panels",
    "validation.railway.theory.transverse_structure.gauss",
    "validation.railway.theory.line_coherence.in_words",
    *(f"validation.railway.theory.sound_power.{name}" for name in ("frequencies", "tracks", "wheels", "nearest_wheel")),
}
METHODS = {
    *("mdr.geike", "mdr.line_trace", "mdr.load_curve", "mdr.rough_profile", "mdr.roll", "mdr.roll_surface"),
    *("mdr.rolling_spectrum", "mdr.sphere_profile", "mdr.stiffness_under", "mdr.press_sphere", "mdr.SelfAffine"),
    *("bem3d.HalfSpace", "bem3d.solve", "bem3d.solve_fixed_area", "bem3d.indent_few_cells", "bem3d.residual"),
    *("bem3d.rough_surface", "bem3d.solve_polonsky_keer", "bem3d.roll"),
}
"""What has a formula in the two methods."""


def found(name):
    """What has this dotted name: a module, or an attribute of the longest part that is one."""
    module, *attributes = name.split(".")
    thing = import_module(module)
    for attribute in attributes:
        module = f"{module}.{attribute}"
        thing = getattr(thing, attribute, None) or import_module(module)
    return thing


def public(path):
    """Functions and classes of a module of closed forms."""
    kinds = (ast.FunctionDef, ast.ClassDef)
    names = (node.name for node in ast.parse(path.read_text(encoding="utf-8")).body if isinstance(node, kinds))
    module = ".".join(path.relative_to(ROOT).with_suffix("").parts)
    return {f"{module}.{name}" for name in names if name[0] != "_"}


@pytest.mark.parametrize("name", sorted(NAMED))
def test_a_name_is_there(name):
    assert found(name).__doc__


def test_theory_has_every_formula():
    formulas = set().union(*(public(path) for theory in THEORIES for path in theory.glob("*.py"))) - HELPERS
    said = set(re.findall(r"\{py:obj\}`~?([\w.]+)`", PAGES["theory"]))
    assert len(formulas) > 40
    assert formulas | METHODS <= said


def test_every_module_of_theory_has_its_reference():
    reference = (DOCS / "reference" / "theory.rst").read_text(encoding="utf-8")
    modules = set(re.findall(r"automodule:: validation\.(?:\w+\.)?theory\.(\w+)", reference))
    assert modules == {path.stem for theory in THEORIES for path in theory.glob("*.py")} - {"__init__"}


@pytest.mark.parametrize("package", [mdr, bem3d, validation])
def test_the_overview_has_every_name(package):
    """But for names of an earlier release, and tables."""
    reference = (DOCS / "reference" / f"{package.__name__}.rst").read_text(encoding="utf-8")
    members = {name: getattr(package, name) for name in package.__all__}
    listed = re.findall(r"^   (\w+)$", reference, flags=re.MULTILINE)
    assert sorted(listed) == sorted(name for name, member in members.items() if getattr(member, "__name__", "") == name)


def test_pages_are_included_not_copied():
    included = [
        (name, DOCS / path, start, end)
        for name, page in PAGES.items()
        for path, start, end in re.findall(
            r'```\{include\} (\S+)\n(?::start-after: "(.*)"\n)?(?::end-before: "(.*)"\n)?(?::relative.*\n)*```', page
        )
    ]
    assert {name for name, *_ in included} == {"commands", "conventions", "index", "theory", "verdicts"}
    for _, path, start, end in included:
        assert re.search(f"{re.escape(start)}.+{re.escape(end)}", path.read_text(encoding="utf-8"), re.DOTALL)


def test_your_own_rail_names_every_key_of_a_rail(tmp_path):
    """Those that the readers of a file have; the message of an unknown key lists them."""
    page = PAGES["own_rail"]
    keys = [f"wheel.{key}" for key in (*rail_file.WHEEL, "profile")] + [f"rail.{key}" for key in rail_file.RAIL]
    assert [key for key in (*keys, "rail.profile") if f"`{key}`" not in page] == []
    own = own_rail(tmp_path)
    for name in ("levels", "lines"):
        own.write_text(SCENE.replace("[rail.lines]", f"[rail.{name}]\nweight = 1"), encoding="utf-8")
        with pytest.raises(ValueError, match=rf"rail\.{name}\.weight is unknown") as refused:
            validation.load_scene(own)
        known = str(refused.value).partition("must be made of ")[2].split("\n")[0].split(", ")
        assert "file" in known and [key for key in known if f"`{key}`" not in page] == []


def test_the_scene_of_your_own_rail_is_one(tmp_path):
    rail = validation.load_scene(own_rail(tmp_path))
    assert (rail.load, rail.radius, rail.roughness.positions) == (50e3, 0.46, (-0.01, 0.0, 0.01))


def own_rail(folder):
    """The scene of the page, beside three lines of noise."""
    np.savetxt(folder / "lines.csv", np.random.default_rng(1).standard_normal((2000, 3)), delimiter=",")
    (folder / "my_rail.toml").write_text(SCENE, encoding="utf-8")
    return folder / "my_rail.toml"


def test_what_the_page_of_verdicts_shows_is_printed(capsys):
    (example,) = re.findall(r"```python\n(.*?)```", PAGES["verdicts"], flags=re.DOTALL)
    exec(compile(example, "verdicts", "exec"), {})
    assert "inconclusive\n" in capsys.readouterr().out


@pytest.mark.slow
def test_what_the_reference_of_models_says_is_printed(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (example,) = re.findall(r"```python\n(.*?)```", PAGES["own_model_reference"], flags=re.DOTALL)
    exec(compile(example, "own_model_reference", "exec"), {})
    first, second = capsys.readouterr().out.splitlines()
    assert f"prints `{first}` and `{second}`." in PAGES["own_model_reference"]


def test_the_tables_of_your_own_scene_make_a_scene(tmp_path):
    material, roughness = re.findall(r"```toml\n(.*?)```", PAGES["own_scene"], flags=re.DOTALL)
    own = tmp_path / "my_scene.toml"
    own.write_text(f'name = "mine"\n[punch]\nside = "1 mm"\nload = "10 N"\n{material}\n{roughness}', encoding="utf-8")
    scene = validation.load_scene(own)
    assert scene.modulus == pytest.approx(210e9 / 2 / (1 - 0.3**2))
    assert scene.ground.rms == pytest.approx(1e-6)


def test_the_table_of_measured_heights_makes_a_scene(tmp_path):
    (heights,) = (table for table in re.findall(r"```toml\n(.*?)```", PAGES["own_data"], re.DOTALL))
    np.savetxt(tmp_path / "face.csv", np.random.default_rng(1).standard_normal((64, 48)), delimiter=",")
    own = tmp_path / "my_scene.toml"
    base = 'name = "mine"\n[punch]\nside = "48 um"\nload = "10 mN"\n[material]\ncontact_modulus = "115 GPa"\n'
    own.write_text(base + heights, encoding="utf-8")
    assert "48 x 48 points" in validation.load_scene(own).ground.waves


def test_the_images_of_the_scope_are_those_of_the_limits():
    share = 4 * limits.LATTICE / 3 / np.pi
    for words in (f"{limits.LATTICE:.4f}", f"{share:.3f}", f"{share / 0.1:.1f}", f"{share / 0.01:.0f}"):
        assert words in PAGES["scope"], words
    assert f"{share:.3f} a/L" in (ROOT / "README.md").read_text(encoding="utf-8")
