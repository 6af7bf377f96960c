"""Keys and keywords of version 0.3 that the scene of a rail still reads, with a note."""

import pickle
from dataclasses import replace

import pytest

from tests.railway.test_rail_files import loaded, written
from validation.railway.scenes.rail import RailScene
from validation.scenes.load import load_scene, load_varied

KEY = 'lateral_structure = "isotropic"'
NOTE = "rail.{} is named rail.{} now: the former key is read for one release."


@pytest.mark.parametrize(
    ("line", "value", "note"),
    [
        ('across = "ridges"', "ridges", NOTE.format("across", "lateral_structure")),
        ("across = 0.5", 0.5, NOTE.format("across", "lateral_structure")),
        ("alpha = 0.5", 0.5, NOTE.format("alpha", "lateral_ratio")),
    ],
)
def test_a_former_key_is_read_and_a_note_names_the_current_one(tmp_path, line, value, note):
    scene = loaded(tmp_path, (KEY, line))
    assert isinstance(scene, RailScene) and scene.lateral_structure == value
    assert scene.notes == (note,) and note in scene.diagnose()


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (f"{KEY}\nacross = 0.5", "rail must have lateral_structure alone, got across, its former name, too"),
        ("lateral_ratio = 0.5\nalpha = 0.5", "rail must have lateral_ratio alone, got alpha"),
        ("across = 0.5\nalpha = 0.5", "got lateral_structure and lateral_ratio"),
        ('across = "random"', 'rail.lateral_structure must be "ridges"'),
        ("alpha = 20", "rail.lateral_structure must be a number alpha"),
    ],
)
def test_messages_name_the_current_keys(tmp_path, lines, message):
    with pytest.raises(ValueError, match=message):
        loaded(tmp_path, (KEY, lines))


@pytest.mark.parametrize("line", [KEY, 'across = "isotropic"'])
@pytest.mark.parametrize("key", ["lateral_structure", "across"])
def test_a_sweep_takes_both_keys_whichever_the_file_has(tmp_path, line, key):
    scene = load_varied(written(tmp_path, (KEY, line)), f"rail.{key}", "ridges")
    assert isinstance(scene, RailScene) and scene.lateral_structure == "ridges"
    assert bool(scene.notes) == (key == "across")


def test_the_former_keyword_and_attribute_work_with_a_warning():
    scene = load_scene("rail")
    with pytest.warns(FutureWarning, match=r"RailScene\.across is named lateral_structure now"):
        ridges = replace(scene, across="ridges")
    assert ridges == replace(scene, lateral_structure="ridges") and pickle.loads(pickle.dumps(ridges)) == ridges
    with pytest.warns(FutureWarning, match="lateral_structure now"):
        assert ridges.across == "ridges"
