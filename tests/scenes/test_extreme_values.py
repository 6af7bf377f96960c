"""Every key of every kind of scene with values that no body has: one sentence, or a bounded amount of work."""

import copy
import json
import math
import re
import tomllib

import pytest

from validation.advice.compare import SceneProblem
from validation.advice.models_of_scene import quantities_of
from validation.railway.scenes import rail_file
from validation.railway.scenes.rail import RailScene
from validation.scenes import bundled, load, reader
from validation.scenes.description import description_lines
from validation.scenes.indentation import IndentationScene
from validation.scenes.load import load_scene
from validation.scenes.rolling import RollingScene

LEFT_OUT = None
VARIANTS = {
    "sphere": {},
    "rough sphere": {
        "of": "sphere",
        "roughness": {"rms": "0.5 um", "hurst": 0.7, "longest": "10 mm", "shortest": "1 mm"},
    },
    "rough_punch": {},
    "punch under a pressure": {"of": "rough_punch", "punch": {"load": LEFT_OUT, "pressure": "23 MPa"}},
    "rolling_wheel": {},
    "moving wheel": {"of": "rolling_wheel", "wheel": {"mass": "500 kg", "speed": "20 m/s", "damping": "2 %"}},
    "table_14_1": {"wheel": {"damping": "2 %"}},
    "rough_wheel": {},
    "rail": {
        "wheel": {"mass": "500 kg", "damping": "2 %", "transverse_radius": "1 m"},
        "rail": {"levels": {"offset": 3, "longest": "400 mm", "shortest": "5 mm"}},
    },
    "axle": {
        "of": "rail",
        "wheel": {"load": LEFT_OUT, "axle_load": "100 kN", "wheels_per_axle": 2, "radius": LEFT_OUT, "diameter": "1 m"},
        "rail": {"lateral_structure": LEFT_OUT, "lateral_ratio": 1.0},
    },
    "free beam": {
        "of": "rail",
        "wheel": {"mass": "500 kg", "transfer": 840, "axles": 2},
        "rail": {"impedance": "free beam", "bending_stiffness": 6.38e6, "mass_per_length": 60.2},
    },
    "dashpot": {"of": "rail", "wheel": {"mass": "500 kg"}, "rail": {"impedance": 1.5e5}},
    "number across": {"of": "rail", "rail": {"lateral_structure": 1.0}},
    "contact modulus": {
        "of": "rough_punch",
        "material": dict.fromkeys(("youngs_modulus", "poisson_ratio", "counterface"), LEFT_OUT)
        | {"contact_modulus": "115 GPa"},
    },
    "counterface": {"of": "sphere", "material": {"counterface": {"youngs_modulus": "70 GPa", "poisson_ratio": 0.3}}},
}
"""Shipped scenes with more keys, or others in their place."""
OF_FILES = {"file", "fill", "crop", "spacing", "curve", "name"}
"""Keys without a number, and those of measured heights."""
NUMBERS = ("0", "-1", "1e-300", "1e300", "inf", "-inf", "nan", "x1e-6", "x1e-3", "x300", "x1e6")
"""In the unit of the key; behind x times its value."""
FORMS = (True, "", "m", "1", [], ["1 m"], {}, {"a": 1}, 5, -0.0, 10**400, 1e300, math.nan, "1 K", "1e9999 m", "½ m")
MOST = {"cells of a strip": 1.3e7, "panels across a line": 1e5, "springs of a track": 1.1e7, "panels to a band": 1e4}
MOST_WORK = 1e12
"""Cells times applications, springs or positions of the dearest model that may be tried."""


def merged(tables, more):
    for key, value in more.items():
        if value is LEFT_OUT:
            del tables[key]
        elif isinstance(value, dict) and isinstance(tables.get(key), dict):
            merged(tables[key], value)
        else:
            tables[key] = copy.deepcopy(value)
    return tables


def tables_of(variant):
    changes = dict(VARIANTS[variant])
    text = bundled.path_of(changes.pop("of", variant)).read_text(encoding="utf-8")
    return merged(tomllib.loads(text), changes)


def leaves(tables, above=()):
    for key, value in tables.items():
        if isinstance(value, dict):
            yield from leaves(value, (*above, key))
        elif key not in OF_FILES:
            yield *above, key


def own_keys():
    """Of each variant those that no earlier one of the same scene has."""
    seen = set()
    for variant, changes in VARIANTS.items():
        for key in leaves(tables_of(variant)):
            same = changes.get("of", variant), key
            if key[-1] != "counterface" and same not in seen:
                seen.add(same)
                yield variant, key


KEYS = [*own_keys()]


def in_toml(value):
    if isinstance(value, dict):
        return f"{{{', '.join(f'{key} = {in_toml(one)}' for key, one in value.items())}}}"
    if isinstance(value, list):
        return f"[{', '.join(map(in_toml, value))}]"
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str | bool) else repr(value)


def scene_with(folder, variant, key, value):
    tables = tables_of(variant)
    inner = tables
    for part in key[:-1]:
        inner = inner[part]
    inner[key[-1]] = value
    path = folder / "scene.toml"
    path.write_text("".join(f"{name} = {in_toml(one)}\n" for name, one in tables.items()), encoding="utf-8")
    return load_scene(path)


def values_for(variant, key):
    value = tables_of(variant)
    for part in key:
        value = value[part]
    text = re.fullmatch(r"([-+\d.e]+) ?(.*)", value) if isinstance(value, str) else None
    number, unit = (float(text[1]), text[2]) if text else (value, "")
    for word in NUMBERS:
        if isinstance(number, str):
            continue
        changed = number * float(word[1:]) if word.startswith("x") else float(word)
        yield (
            f"{changed!r} {unit}"
            if unit
            else (round(changed) if isinstance(value, int) and word == "x300" else changed)
        )
    yield from FORMS


def counts_of(scene):
    """What a strip, a quadrature or a track is made of, by the sizes of the scene alone."""
    if isinstance(scene, RollingScene) and scene.has_track:
        length = max(scene.distance, 2 * math.pi * scene.radius)
        return {"springs of a track": length / scene.contact_radius * scene.springs}
    if isinstance(scene, RailScene):
        (a, b), shortest = scene.contact.semi_axes, 0.8e-3
        slope = (
            1.0
            if scene.lateral_structure is None or isinstance(scene.lateral_structure, str)
            else scene.lateral_structure
        )
        # 60 by 12 of the larger semi-axis, 12 cells to the smaller
        return {
            "cells of a strip": 60 * 12 * 144 * (max(a, b) / min(a, b)) ** 2,
            "panels across a line": 2 * slope * max(a, b) / shortest,
        }
    if isinstance(scene, IndentationScene):
        return {}
    return {"panels to a band": 2 * scene.contact_radius / scene.ground.shortest}


def check_work(scene):
    for name, count in counts_of(scene).items():
        assert 0 <= count <= MOST[name], name
    assert not {"nan", "inf"} & {word.strip(",") for line in description_lines(scene) for word in line.split()}
    if isinstance(scene, RollingScene) and scene.has_track:
        if scene.rail_alone_is_rough:
            check_work(scene.for_compare())
        return
    quantity = quantities_of(scene)[-1]
    listed, _ = SceneProblem(scene, (quantity,), 0.1).listed_and_solvable(quantity)
    for one in listed:
        estimate, cost = one.estimate(), one.cost()
        assert not math.isnan(estimate.error)
        assert not (estimate.in_range and estimate.error <= 0.1) or 0 < cost.work <= MOST_WORK, one.name


@pytest.mark.parametrize(("variant", "key"), KEYS, ids=[f"{variant}: {'.'.join(key)}" for variant, key in KEYS])
def test_an_extreme_value_is_one_sentence_or_a_bounded_amount_of_work(tmp_path, variant, key):
    refused = 0
    for value in values_for(variant, key):
        try:
            scene = scene_with(tmp_path, variant, key, value)
        except ValueError as problem:
            said = str(problem)
            assert re.match(r"scene \S+scene\.toml: [\w.]+", said), value
            assert "got" in said or "is unknown" in said or "is missing" in said, said
            assert len(said.splitlines()) == 1 and len(said) < 500, said
            refused += 1
        else:
            check_work(scene)
    assert refused >= 15


def test_every_key_of_a_number_is_tried():
    known = {*reader.VALUES, *rail_file.WHEEL, *rail_file.RAIL, *load.WHEEL} - OF_FILES
    tried = {key[-1] for _, key in KEYS}
    assert known - tried == {"detrend", "offset", "roughness"} - tried
    assert {"rms", "hurst", "longest", "shortest", "distance", "springs", "offset"} <= tried


@pytest.mark.parametrize(
    ("variant", "key", "value", "said"),
    [
        ("rail", ("wheel", "load"), "0.001 N", "wheel.load must press a contact that filters a wavelength"),
        ("rail", ("rail", "lateral_structure"), 1e5, "rail.lateral_structure must be a number alpha from 0.1 to 10"),
        ("rail", ("rail", "lateral_structure"), 1e12, "rail.lateral_structure must be a number alpha from 0.1 to 10"),
        ("axle", ("rail", "lateral_ratio"), 0.09, "rail.lateral_structure must be a number alpha from 0.1 to 10"),
        ("rail", ("rail", "lateral_structure"), 0.1, None),
        ("rail", ("rail", "lateral_structure"), 10, None),
        ("axle", ("rail", "crown_radius"), "1e6 m",
         "rail.crown_radius and wheel.transverse_radius must leave a contact"),
        ("axle", ("rail", "crown_radius"), "10 m",
         "0.1 to 6 times as wide as long, got 6.93 times, which is nearly a line"),
        ("axle", ("rail", "crown_radius"), "10 mm", "which is narrower than that of a gauge corner"),
        ("axle", ("rail", "crown_radius"), "7 m", None),
        ("axle", ("rail", "crown_radius"), "15 mm", None),
        ("rolling_wheel", ("rail", "roughness", "shortest"), "1.9 um",
         "rail.roughness.shortest must be at least 1.98 µm"),
        ("rolling_wheel", ("rail", "roughness", "shortest"), "2 um", None),
        ("sphere", ("sphere", "radius"), "1001 km",
         'sphere.radius must lie between 1e-15 km and 1000 km, got "1001 km"'),
        ("sphere", ("sphere", "radius"), "1000 km", None),
        ("sphere", ("sphere", "load"), "1e-16 N", 'sphere.load must lie between 1e-15 N and 1e+12 N, got "1e-16 N"'),
        ("rough_wheel", ("simulation", "springs"), 10**5, "simulation.springs must be at most"),
        ("rail", ("rail", "levels", "longest"), "4 mm",
         "rail.levels.longest and shortest must leave one of the bands of"),
    ],
)  # fmt: skip
def test_limits_are_named_with_what_is_accepted(tmp_path, variant, key, value, said):
    if said is None:
        check_work(scene_with(tmp_path, variant, key, value))
        return
    with pytest.raises(ValueError, match=re.escape(said)):
        scene_with(tmp_path, variant, key, value)
