"""Scene files that are none, scenes without what is not needed, and moduli whose unit is asked for."""

import pytest

from validation import IndentationScene, load_scene, load_wheel_scene
from validation.scenes.bundled import path_of

SECRET = "root:x:0:0:secret:/root:/bin/bash"


@pytest.mark.parametrize(
    "contents",
    [
        f"{SECRET}\n".encode(),
        f'"{SECRET}" = [\n'.encode(),
        f"\x7fELF\x02{SECRET}".encode() + bytes(range(128, 256)),
        SECRET.encode("utf-16"),
        f"secret{SECRET}".encode() + b"\0" * 40,
        b"name = " + SECRET.encode(),
    ],
)
def test_a_foreign_file_is_named_and_not_quoted(contents, tmp_path):
    path = tmp_path / "foreign"
    path.write_bytes(contents)
    with pytest.raises(ValueError, match="must be valid TOML, got: ") as refused:
        load_scene(path)
    said = str(refused.value)
    assert said.startswith(f"scene {path} ") and len(said.splitlines()) == 1
    assert "secret" not in said.replace(str(path), "") and "root" not in said.replace(str(path), "")


def test_a_dynamic_wheel_is_compared_without_a_simulation(tmp_path):
    text = path_of("table_14_1").read_text(encoding="utf-8")
    path = tmp_path / "my.toml"
    path.write_text(text.partition("[simulation]")[0], encoding="utf-8")
    assert load_scene(path) == load_scene("table_14_1")
    # which rolls along it in time
    with pytest.raises(ValueError, match="simulation is missing"):
        load_wheel_scene(path)


def test_what_the_simulation_holds_is_checked_where_it_is_there(tmp_path):
    text = path_of("table_14_1").read_text(encoding="utf-8")
    path = tmp_path / "my.toml"
    path.write_text(text.replace('distance = "0.65 m"', 'distance = "0.65 kg"'), encoding="utf-8")
    with pytest.raises(ValueError, match=r"simulation\.distance must be a length"):
        load_scene(path)


def of_body(shape="punch", size=1e-3, load=5.0, **material):
    return IndentationScene(name="it", shape=shape, size=size, load=load, **material)


def test_a_smooth_punch_is_asked_for_its_units():
    (doubt,) = of_body(modulus=210.0).diagnose()
    assert "the mean pressure on the punch is 2.38e+04 of E*" in doubt and "are the units of" in doubt
    assert of_body(modulus=210e9).diagnose() == ()
    # a tenth
    assert of_body(modulus=5.01e7).diagnose() == () and len(of_body(modulus=4.99e7).diagnose()) == 1


def test_a_light_load_on_a_modulus_in_gigapascals_is_asked_for_its_unit():
    (doubt,) = of_body(load=1e-6, modulus=210.0).diagnose()
    assert doubt == "E* is 210 Pa, softer than a gel: is its unit Pa?"
    # the unit of pressure of who has none
    assert of_body(size=1.0, load=5.0, modulus=1.0).diagnose() == ()
