"""What `compare` advises can be done: each key that it names is one that the scene takes, in every kind of scene."""

import re
import tomllib
from functools import partial

import numpy as np
import pytest

from tests.advice.planted_answers import Finding
from validation.advice.advice import would_help
from validation.advice.compare import Comparison
from validation.advice.hierarchy import Candidate, Selection
from validation.advice.models_of_scene import models_of, quantities_of
from validation.railway.problems.rail_models import what_would_state_the_ground
from validation.railway.scenes.rail import RailScene
from validation.scenes.bundled import path_of
from validation.scenes.load import bundled_for_compare, load_scene
from validation.simulation.model import ErrorEstimate, Target

RNG = np.random.default_rng(3)
LINES = 'file = "lines.npy"\nspacing = "1 mm"\npositions = ["-10 mm", "0 mm", "10 mm"]'
LEVELS = "[rail.levels]   # or"
CURVE = 'curve = "iso3095-2013"'
KINDS = {
    "punch": ("rough_punch", ()),
    "wheel": ("rolling_wheel", ()),
    "moving wheel": ("table_14_1", ()),
    "measured face": ("rough_punch", (("[roughness]", '[heights]\nfile = "face.npy"\nspacing = "20 um"\n[gone]'),)),
    "rail": ("rail", ()),
    "rail without across": ("rail", (("\nlateral_structure =", "\n# lateral_structure ="),)),
    "rail of ridges": ("rail", (('lateral_structure = "isotropic"', 'lateral_structure = "ridges"'),)),
    "rail with alpha": ("rail", (('lateral_structure = "isotropic"', "lateral_ratio = 0.7"),)),
    "rail of lines": ("rail", ((LEVELS, "[rail.lines] #"), (CURVE, LINES))),
    "rail of lines without across": (
        "rail",
        ((LEVELS, "[rail.lines] #"), (CURVE, LINES), ("\nlateral_structure =", "\n# lateral_structure =")),
    ),
    "rail of peaks": ("rail", ((CURVE, 'file = "peaks.csv"'),)),
    "rail of heights": (
        "rail",
        (
            (LEVELS, "[rail.heights] #"),
            (CURVE, 'file = "patch.npy"\nspacing = "1 mm"'),
            ("\nlateral_structure =", "\n# lateral_structure ="),
        ),
    ),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Scene files of each kind, and the measurements beside them."""
    place = tmp_path_factory.mktemp("scenes")
    np.save(place / "face.npy", 1e-6 * RNG.normal(size=(50, 50)))
    np.save(place / "lines.npy", 2e-6 * np.cumsum(RNG.normal(size=(2000, 3)), axis=0) / 10)
    np.save(place / "patch.npy", 2e-6 * RNG.normal(size=(400, 40)))
    nominal = (400, 315, 250, 200, 160, 125, 100, 80, 63, 50, 40, 31.5, 25, 20, 16, 12.5, 10, 8, 6.3, 5, 4)
    rows = [f"{wave},{40 if wave == 400 else 5 - i}" for i, wave in enumerate(nominal)]
    (place / "peaks.csv").write_text("\n".join(["wavelength [mm],level [dB re 1 um]", *rows]) + "\n", encoding="utf-8")
    for name, (scene, changes) in KINDS.items():
        text = path_of(scene).read_text(encoding="utf-8")
        for old, new in changes:
            assert old in text
            text = text.replace(old, new, 1)
        text, _, _ = text.partition("[gone]")
        (place / f"{name}.toml").write_text(text, encoding="utf-8")
    return place


def sentences(scene):
    """All that may be advised: where model, grid and sample leave the most, and what the ground of a rail leaves."""
    for quantity in quantities_of(scene):
        model = models_of(scene, quantity, 0.01, 0)[0]
        for parts in ((0.5, 0, 0), (0, 0.5, 0), (0, 0, 0.5)):
            for of_scene in (0.0, 0.5) if isinstance(scene, RailScene) else (0.0,):
                estimate = ErrorEstimate(model=0.5, of_scene=of_scene, reason="it is")
                one = Candidate(model, "not accurate enough", "it is", estimate, Finding(parts=parts).solve())
                yield from would_help(Comparison(scene, quantity, Selection(0.01, (one,))))
        if isinstance(scene, RailScene):
            yield what_would_state_the_ground(Target(scene, quantity))


IN_TABLE = re.compile(r"`(\w+)` in \[([\w.]+)\]")
VALUE = re.compile(r'(\w+) = ("[^"]*")(?: in \[([\w.]+)\])?')
ALPHA = re.compile(r"a number (alpha)")
STANDS_FOR = {"lateral_structure": "lateral_ratio", "lateral_ratio": "lateral_structure"}
"""Of which a rail has one."""


def keys_in(sentence):
    """Table, key and value of what is named; None for the value that it has, a little longer."""
    yield from ((table, key, None) for key, table in IN_TABLE.findall(sentence))
    yield from ((table or "rail", key, value) for key, value, table in VALUE.findall(sentence))
    yield from (("rail", "lateral_ratio", "0.5") for _ in ALPHA.findall(sentence))


def with_key(tables, table, key, value):
    """The tables of a file with a key added, or with another value of one that is there."""
    inner = tables
    for room in table.split("."):
        inner = inner[room]  # a table that the scene has not is no advice
    if value is None:
        number, unit = re.fullmatch(r"([\d.]+) (\w+)", inner[key]).groups()
        inner[key] = f"{1.1 * float(number)} {unit}"
    else:
        inner.pop(STANDS_FOR.get(key), None)
        inner[key] = tomllib.loads(f"value = {value}")["value"]
    return tables


@pytest.mark.parametrize("kind", KINDS)
def test_each_key_that_is_advised_is_taken_by_the_scene(kind, folder):
    path = folder / f"{kind}.toml"
    text = path.read_text(encoding="utf-8")
    said = list(sentences(load_scene(path)))
    named = {key for sentence in said for key in keys_in(sentence)}
    for key in named:
        other = folder / "other.toml"
        other.write_text(as_toml(with_key(tomllib.loads(text), *key)), encoding="utf-8")
        load_scene(other)
    words = {word for sentence in said for word in ("shortest", "longest", "lateral_structure") if word in sentence}
    assert {key for _, key, _ in named} >= words
    assert bool(named) is (kind not in ("measured face", "rail of heights"))


def as_toml(tables):
    """Text, number and table alone, which these files have."""
    lines = [f"{key} = {value!r}" for key, value in tables.items() if not isinstance(value, dict)]

    def room(prefix, table):
        lines.append(f"[{prefix}]")
        lines.extend(f"{key} = {value!r}" for key, value in table.items() if not isinstance(value, dict))
        for key, value in table.items():
            if isinstance(value, dict):
                room(f"{prefix}.{key}", value)

    for key, value in tables.items():
        if isinstance(value, dict):
            room(key, value)
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize("name", bundled_for_compare())
def test_a_bundled_scene_is_of_one_of_these_kinds_or_smooth(name):
    scene = load_scene(name)
    smooth = getattr(scene, "ground", True) is None
    assert smooth or name in {scene for scene, _ in KINDS.values()}


def test_a_key_that_a_scene_has_not_is_found(folder):
    """As today's advice of `shortest` was for measured heights."""
    tables = tomllib.loads((folder / "measured face.toml").read_text(encoding="utf-8"))
    with pytest.raises(KeyError):
        with_key(tables, *next(keys_in("longer waves (`shortest` in [roughness]) have less")))
    tables["heights"]["shortest"] = "1 mm"
    (folder / "other.toml").write_text(as_toml(tables), encoding="utf-8")
    with pytest.raises(ValueError, match="shortest"):
        partial(load_scene, folder / "other.toml")()
