"""Measured heights, and the files of all scenes: what is read, what is warned of, what is refused by name."""

import math
import re
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest
from scipy import stats

import bem3d
import mdr
from validation.__main__ import main
from validation.report.commands import compare as command_compare
from validation.scenes.bundled import SCENES
from validation.scenes.dynamic_wheel import load_wheel_scene
from validation.scenes.indentation import IndentationScene
from validation.scenes.load import load_scene
from validation.scenes.measured import MeasuredHeights, measured
from validation.scenes.rolling import RollingScene
from validation.selection.compare import models_of

N, DX = 256, 1e-6
BAND = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi * 4 / (N * DX), q_max=2 * np.pi * 32 / (N * DX), rms=1e-7)
IN_FILE = r"scene \S+scene\.toml: "
PUNCH = (SCENES / "rough_punch.toml").read_text(encoding="utf-8")
ROLLING = (SCENES / "rolling_wheel.toml").read_text(encoding="utf-8")


def drawn(seed=1, c2d=BAND.c2d):
    return bem3d.rough_surface(c2d, shape=(N, N), spacing=DX, rng=np.random.default_rng(seed), rms=1e-7)


def heights(height, spacing=(DX, DX)):
    return MeasuredHeights(height=height, spacing=spacing)


# Heights


def test_the_spectrum_is_found_in_the_heights():
    ratios = []
    for seed in range(4):
        found = heights(drawn(seed))
        edges = np.array(found.edges)
        middle = np.sqrt(edges[1:] * edges[:-1])
        # a ring next to the ends of the band is half empty, and a window smears over two waves
        inside = (edges[:-1] > 1.3 * BAND.q_min) & (edges[1:] < BAND.q_max / 1.3)
        # over a ring, q^-3.4 has a mean above its middle
        width = edges[1:][inside] / edges[:-1][inside]
        mean = 2 * (width**-1.4 - 1) / (-1.4 * (width**2 - 1)) * (edges[:-1][inside] ** -3.4)
        exact = BAND.c2d(edges[:-1][inside]) * mean / edges[:-1][inside] ** -3.4
        ratios.append(found.c2d(middle[inside]) / exact)
    # rings of tens of waves, four surfaces
    assert np.mean(ratios, axis=0) == pytest.approx(np.ones(inside.sum()), abs=0.35)
    assert np.mean(ratios) == pytest.approx(1.0, abs=0.08)


def test_the_spectrum_has_the_height():
    found = heights(drawn())
    edges = np.array(found.edges)
    level = found.c2d(np.sqrt(edges[1:] * edges[:-1]))
    assert np.pi * np.sum(level * np.diff(edges**2)) / found.rms**2 == pytest.approx(1.0, rel=1e-12)
    assert (found.c2d(np.array([0.0, 0.9 * edges[0], 1.1 * edges[-1]])) == 0).all()


@pytest.mark.slow
def test_a_tilt_is_taken_off():
    x = np.arange(N)[:, np.newaxis] * DX
    y = np.arange(N) * DX
    height = drawn()
    level = heights(height).height
    assert heights(height + 3e-3 * x - 2e-3 * y + 5e-6).height == pytest.approx(level, abs=1e-9 * 1e-7 * N)
    assert level == pytest.approx(height, abs=0.2 * 1e-7)


@pytest.mark.parametrize("times", [0.5, 2.0])
def test_note_of_a_tilt_larger_than_the_roughness(times):
    ramp = np.arange(N)[:, np.newaxis] - (N - 1) / 2 + np.zeros(N)
    level = heights(drawn()).height
    found = heights(level + 3e-6 + times * level.std() / ramp.std() * ramp)
    assert found.tilt == pytest.approx(times, rel=1e-9)
    assert [f"{times:.2g} times as rough" in doubt for doubt in found.notes()] == [True] * (times > 1)


def test_isotropic_gaussian_heights_leave_no_doubt():
    assert heights(drawn()).texture == pytest.approx(1.0, abs=0.1)
    assert heights(drawn()).notes() == ()


def test_note_of_ridges():
    x = np.arange(N) * DX
    ridges = 1e-7 * np.cos(2 * np.pi * 16 * x / (N * DX))[:, np.newaxis] + 0.1 * drawn()
    (doubt,) = (d for d in heights(ridges).notes() if "anisotropic" in d)
    assert "boundary elements do" in doubt
    # slopes of a stretched surface are as many times steeper across
    stretched = heights(drawn(), spacing=(DX, 3 * DX))
    assert stretched.texture == pytest.approx(3.0, rel=0.1)
    assert "times those along the other" in stretched.notes()[0]


def test_note_of_heights_that_are_not_gaussian():
    worn = np.minimum(drawn(), 0.3e-7)
    (doubt,) = heights(worn).notes()
    assert re.match(r"heights are not Gaussian, skewness -\d", doubt)


def test_note_of_plateaus_that_neither_skewness_nor_kurtosis_shows():
    """Ground on top and pitted as deep below: of honed faces at a light load springs were a factor of six too soft."""
    plateaus = np.clip(drawn(), -1.6e-7, 1.6e-7)
    assert abs(stats.skew(plateaus, axis=None)) < 0.5 and abs(stats.kurtosis(plateaus, axis=None)) < 1
    assert ["highest hundredth from 1." in doubt for doubt in heights(plateaus).notes()] == [True]


@pytest.mark.parametrize("call", [True, False])
def test_any_object_with_heights_and_sizes_will_do(call):
    height = drawn()[:, : N // 2]
    found = measured(surface((lambda: height) if call else height, (N * DX, N * DX)))
    assert found.spacing == pytest.approx((DX, 2 * DX))
    assert found.sides == pytest.approx((N * DX, N * DX))
    assert found.height == pytest.approx(heights(height, (DX, 2 * DX)).height, rel=1e-12, abs=0)


def test_other_objects_are_refused():
    with pytest.raises(TypeError, match=r"^surface must have heights and physical_sizes, got list$"):
        measured([1.0])
    with pytest.raises(ValueError, match=r"^heights must be two-dimensional"):
        measured(SimpleNamespace(heights=np.ones(8), physical_sizes=(1.0,)))


def surface(height, sizes=(N * DX, N * DX), **more):
    return SimpleNamespace(heights=height, physical_sizes=sizes, **more)


def refusal(question):
    """What is said of what is refused; nothing where it is not."""
    try:
        question()
    except ValueError as problem:
        return str(problem)
    return ""


def test_points_without_data_are_refused():
    """A masked point is no height: what stands behind the mask entered as one, and gave a stiffness 8 % off."""
    height, gone = drawn(), np.zeros((N, N), dtype=bool)
    gone[3, 5:40] = gone[200:, 7] = True
    sentence = (
        f"heights must be known everywhere, got {gone.sum()} of 65536 (0.139 %) masked, the first at [3, 5]: "
        "cut out a part that is known, or fill them in from their neighbours"
    )
    masked = np.ma.masked_array(height, gone)
    for refused in (surface(masked), surface(lambda: masked), surface(masked, unit="um")):
        assert refusal(lambda given=refused: measured(given)) == sentence
    assert refusal(lambda: heights(masked)) == sentence
    unknown = surface(np.where(gone, np.nan, height))
    assert refusal(lambda: measured(unknown)) == sentence.replace("masked", "not finite")
    # an array that could have a mask and has none is as good as any
    assert (measured(surface(np.ma.masked_array(height))).height == heights(height).height).all()


@pytest.mark.parametrize("kind", [np.float32, np.int32, np.uint16])
def test_numbers_of_any_kind_are_heights(kind):
    height = (1e4 * np.abs(drawn() / 1e-7)).astype(kind)
    assert (measured(surface(height)).height == heights(height.astype(float)).height).all()


@pytest.mark.parametrize("kind", [complex, object, str, bool])
def test_what_are_no_real_numbers_are_no_heights(kind):
    with pytest.raises(TypeError, match=r"^heights must be real numbers, got dtype "):
        measured(surface(drawn().astype(kind)))


def test_rows_of_different_length_are_no_heights():
    with pytest.raises(ValueError, match=r"^heights must be a regular array of numbers, got rows of different length$"):
        measured(surface([[1.0, 2.0], [3.0]]))


@pytest.mark.parametrize("more", [{"unit": "um"}, {"info": {"unit": "µm"}}, {"unit": None, "info": {"unit": "um"}}])
def test_the_unit_that_a_surface_names_is_that_of_heights_and_sizes(more):
    found = measured(surface(1e6 * drawn(), (1e6 * N * DX, 1e6 * N * DX), **more))
    assert found.rms == pytest.approx(heights(drawn()).rms, rel=1e-12)
    assert found.spacing == pytest.approx((DX, DX), rel=1e-12)
    assert found.notes() == ()


def test_a_unit_that_is_none_is_refused():
    with pytest.raises(ValueError, match=r"^unit of the surface must be one of m, mm, um, µm, nm, km, got 'parsec'$"):
        measured(surface(drawn(), unit="parsec"))
    assert measured(surface(drawn(), unit=None, info={})).rms == heights(drawn()).rms


@pytest.mark.parametrize("sizes", [(1.0,), (1.0, 1.0, 1.0), None, 3.0, "mm"])
def test_sizes_that_are_not_two_are_refused(sizes):
    with pytest.raises(
        (ValueError, TypeError), match=r"^heights must be two-dimensional with two|^physical_sizes\[0\] must be a real"
    ):
        measured(surface(drawn(), sizes))


@pytest.mark.parametrize("side", [0.0, -1.0, math.nan, math.inf])
def test_sizes_that_are_no_lengths_are_refused(side):
    with pytest.raises(ValueError, match=r"^physical_sizes\[1\] must be (finite|positive), got "):
        measured(surface(drawn(), (1.0, side)))


def test_note_of_sizes_in_the_other_order():
    half, (long, short) = drawn()[:, : N // 2], (N * DX, N // 2 * DX)
    assert not any("order of the axes" in note for note in measured(surface(half, (long, short))).notes())
    (note,) = (n for n in measured(surface(half, (short, long))).notes() if "order of the axes" in n)
    assert "points are 4 times as far apart along one side as along the other" in note
    # three times as far apart, and no square points either way
    assert not any("order of the axes" in note for note in measured(surface(half, (3 * long, short))).notes())


def test_a_tilt_and_steepness_are_notes_and_texture_and_skewness_are_reasons():
    ramp = 1e-4 * (np.arange(N)[:, np.newaxis] + np.zeros(N))
    tilted, steep = heights(drawn() + ramp), heights(1e4 * drawn())
    assert len(tilted.notes()) == len(steep.notes()) == 1
    scene = {"name": "it", "shape": "punch", "size": N * DX, "load": 0.1, "modulus": 1e9}
    for ground in (tilted, steep):
        assert ground.beyond_a_spectrum() == ()
        claims = [
            model.estimate() for model in models_of(IndentationScene(**scene, ground=ground), "stiffness", 0.1, 0)
        ]
        assert not any("knows the spectrum alone" in claim.reason for claim in claims)
        assert IndentationScene(**scene, ground=ground).diagnose() == ground.notes()
    for ground in (heights(drawn(), spacing=(DX, 3 * DX)), heights(np.minimum(drawn(), 0.3e-7))):
        assert ground.beyond_a_spectrum() == ground.notes() != ()
    worn = IndentationScene(**scene, ground=heights(np.minimum(drawn(), 0.3e-7)))
    assert "knows the spectrum alone" in models_of(worn, "stiffness", 0.1, 0)[0].estimate().reason


@pytest.mark.parametrize(
    ("height", "words"),
    [
        (np.ones((4, 64)), ["16 points or more", "(4, 64)"]),
        (np.ones(64), ["16 points or more", "(64,)"]),
        (np.full((64, 64), np.nan), ["known everywhere", "4096 of 4096 (100 %) not finite", "[0, 0]"]),
        (np.add.outer(np.arange(64.0), np.arange(64.0)), ["rough", "a plane"]),
    ],
)
def test_heights_that_are_none_are_refused(height, words):
    with pytest.raises(ValueError, match=f"^heights must be {'.*'.join(map(re.escape, words))}"):
        heights(height)


def test_spacings_that_are_none_are_refused():
    with pytest.raises(ValueError, match=r"^spacing\[1\] must be positive, got -1.0$"):
        heights(drawn(), spacing=(1.0, -1.0))


# Files


def written(folder, text, *changes):
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = folder / "scene.toml"
    path.write_text(text, encoding="utf-8")
    return path


def with_heights(folder, file, *, unit="", side="0.256 mm"):
    start, _, _ = PUNCH.partition("[roughness]")
    text = f'{start}\n[heights]\nfile = "{file}"\nspacing = "1 um"\n{unit}'
    return written(folder, text, ("1 mm", side), ("23.076923 N", "0.01 N"))


def test_shipped_scenes_are_what_they_say():
    sphere, rolling = load_scene("sphere"), load_scene("rolling_wheel")
    assert isinstance(sphere, IndentationScene)
    assert isinstance(rolling, RollingScene)
    assert sphere.contact_radius == pytest.approx(rolling.contact_radius) == pytest.approx(1.982e-3, rel=1e-3)
    assert load_scene("rough_punch").reduced_load == pytest.approx(0.1, rel=1e-6)
    assert load_scene("table_14_1") == RollingScene.of_wheel(load_wheel_scene("table_14_1"))


@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["npy", "csv", "txt", "tsv"])
def test_heights_are_read_from_a_file_beside_the_scene(tmp_path, suffix):
    height = drawn()
    if suffix == "npy":
        np.save(tmp_path / "face.npy", height)
    else:
        np.savetxt(tmp_path / f"face.{suffix}", height, delimiter={"csv": ",", "txt": " ", "tsv": "\t"}[suffix])
    scene = load_scene(with_heights(tmp_path, f"face.{suffix}"))
    assert scene.ground.height == pytest.approx(heights(height).height, rel=1e-12, abs=1e-20)
    assert scene.ground.spacing == (1e-6, 1e-6)


def test_a_unit_of_heights_is_taken(tmp_path):
    np.save(tmp_path / "face.npy", 1e6 * drawn())
    scene = load_scene(with_heights(tmp_path, "face.npy", unit='unit = "um"'))
    assert scene.ground.rms == pytest.approx(1e-7, rel=0.05)


def test_files_without_heights_are_refused(tmp_path):
    (tmp_path / "face.csv").write_bytes(b"1, 2\n3, 4\n")
    with pytest.raises(ValueError, match=rf"^{IN_FILE}heights: heights must be 16 points"):
        load_scene(with_heights(tmp_path, "face.csv"))
    np.save(tmp_path / "face.npy", np.ones((32, 32), dtype=complex))
    with pytest.raises(ValueError, match=r"must hold real numbers, got complex128$"):
        load_scene(with_heights(tmp_path, "face.npy"))
    with pytest.raises(OSError, match=r"^heights.file .* cannot be read: No such file"):
        load_scene(with_heights(tmp_path, "none.npy"))


@pytest.mark.parametrize(
    ("text", "old", "new", "words"),
    [
        (PUNCH, "[punch]", "[block]", ["a scene must have one table of sphere, punch and wheel", "none"]),
        (PUNCH, "[material]", '[sphere]\nradius = "1 m"\n[material]', ["a scene must have one", "sphere and punch"]),
        (PUNCH, 'side = "1 mm"', "", ["punch.side is missing"]),
        (PUNCH, "side =", "radius =", ["punch.radius is unknown", "side, load"]),
        (PUNCH, "poisson_ratio = 0.3", "poisson_ratio = 0.6", ["material.poisson_ratio must", "0.6"]),
        (PUNCH, "rms =", "RMS =", ["roughness.RMS is unknown", "rms, hurst, longest, shortest"]),
        (PUNCH, 'longest = "1 mm"', 'longest = "2 mm"', ["roughness.longest must", "0.001 m", "0.002 m"]),
        (ROLLING, "[rail.roughness]", "[rail]\n[stuff]", ["stuff is unknown", "name, wheel, material, rail"]),
        (ROLLING, 'load = "4905 N"', 'load = "4905 N"\nspeed = "20 m/s"', ["wheel.speed is unknown", "radius, load"]),
    ],
)
def test_scenes_are_refused_by_key_and_value(tmp_path, text, old, new, words):
    with pytest.raises(ValueError, match=f"^{IN_FILE}{'.*'.join(map(re.escape, words))}"):
        load_scene(written(tmp_path, text, (old, new)))


def test_a_smooth_rail_is_no_scene_to_roll_over(tmp_path):
    start, _, _ = ROLLING.partition("[rail.roughness]")
    with pytest.raises(ValueError, match=rf"^{IN_FILE}rail must have roughness or heights, got a smooth one$"):
        load_scene(written(tmp_path, start + "[rail]\n"))
    with pytest.raises(ValueError, match=r"must have a rough rail and a smooth wheel to be compared$"):
        load_scene("rough_wheel")


def test_ground_is_a_spectrum_or_heights_not_both(tmp_path):
    np.save(tmp_path / "face.npy", drawn())
    text = PUNCH + '\n[heights]\nfile = "face.npy"\nspacing = "1 um"\n'
    with pytest.raises(ValueError, match=rf"^{IN_FILE}a scene must have roughness or heights, got both$"):
        load_scene(written(tmp_path, text))


@pytest.mark.parametrize(
    ("key", "changes", "got"),
    [
        ("shape", {"shape": "cone"}, "'cone'"),
        ("punch.side", {"size": 0.0}, "0.0"),
        ("punch.load", {"load": math.nan}, "nan"),
        ("modulus", {"modulus": -1.0}, "-1.0"),
        ("name", {"name": " "}, "' '"),
    ],
)
def test_scenes_at_the_prompt_are_refused_by_key_and_value(key, changes, got):
    settings = {"name": "it", "shape": "punch", "size": 1.0, "load": 1.0, "modulus": 1.0}
    with pytest.raises(ValueError, match=f"^{key} must .*, got {got}$"):
        IndentationScene(**{**settings, **changes})


def test_heights_must_cover_the_body():
    ground = heights(drawn())
    settings = {"name": "it", "load": 1.0, "modulus": 1e9, "ground": ground}
    with pytest.raises(ValueError, match=r"^heights must be as large as the punch, punch.side = 0.001 m"):
        IndentationScene(shape="punch", size=1e-3, **settings)
    with pytest.raises(ValueError, match=r"^heights must be three contact radii wide"):
        IndentationScene(shape="sphere", size=1.0, **settings)
    with pytest.raises(ValueError, match=r"^rail.heights must be .* long and .* wide"):
        RollingScene(radius=1.0, **settings)
    far = {**settings, "ground": MeasuredHeights(height=ground.height, spacing=(0.2, 0.2)), "load": 1e-3}
    for scene in (partial(RollingScene, radius=1e-3), partial(IndentationScene, shape="sphere", size=1e-3)):
        with pytest.raises(ValueError, match=r"^heights.spacing must be no more than the contact radius, .* 0.2 m"):
            scene(**far)


def test_heights_in_the_wrong_unit_are_steep():
    ground = heights(drawn())
    assert not any("steep" in doubt for doubt in ground.notes())
    metres = MeasuredHeights(height=1e6 * ground.height, spacing=ground.spacing)
    assert "rms slope" in metres.notes()[0]
    ramp = np.add.outer(np.abs(np.arange(32) - 15.5), np.zeros(32))
    assert MeasuredHeights(height=ramp, spacing=(2.0, 1.0)).slope == pytest.approx(0.5 * math.sqrt(30 / 31))


# The command


def test_compare_prints_result_error_cost_and_reason(capsys):
    assert main(["compare", "sphere"]) == 0
    text = capsys.readouterr().out
    assert text.startswith("Smooth sphere: stiffness within 10 %\n")
    # a = (3 F R / 4 E*)^(1/3), k = 2 E* a
    stiffness = 2 * 236.25e9 * (0.75 * 4905 * 0.5 / 236.25e9) ** (1 / 3)
    assert f"stiffness = {stiffness / 1e8:.4f}e8 N/m" in text
    assert "closed form" in text


@pytest.mark.parametrize(
    ("word", "shown"), [("5%", "5 %"), ("0.05", "5 %"), ("0.4238 dB", "0.42 dB"), (" 20 % ", "20 %")]
)
def test_tolerances_come_in_three_forms(capsys, word, shown):
    assert main(["compare", "sphere", "--tolerance", word]) == 0
    assert f"within {shown}\n" in capsys.readouterr().out


@pytest.mark.parametrize("word", ["0", "-1%", "nan", "inf", "five", "5 percent", ""])
def test_tolerances_that_are_none_are_refused(capsys, word):
    with pytest.raises(SystemExit) as refusal:
        main(["compare", "sphere", "--tolerance", word])
    assert refusal.value.code == 2
    assert "--tolerance" in capsys.readouterr().err


def test_what_a_scene_cannot_answer_is_refused(capsys):
    assert main(["compare", "sphere", "--quantity", "acceleration"]) == 2
    assert "error: quantity must be one of stiffness for scene 'Smooth sphere'" in capsys.readouterr().err
    assert main(["compare", "nowhere"]) == 2
    assert "error: scene must be a file" in capsys.readouterr().err


def test_what_cannot_be_reached_is_no_success(capsys, tmp_path):
    np.save(tmp_path / "face.npy", drawn()[:64, :64])
    path = with_heights(tmp_path, "face.npy", side="0.064 mm")
    assert main(["compare", str(path), "--tolerance", "0.001%"]) == 3
    assert "not reached: the tolerance of 0.001 %" in capsys.readouterr().out


def test_the_seed_of_a_comparison_is_that_of_the_command(capsys, monkeypatch):
    seeds, compared = [], command_compare.compared

    def seen(scene, **settings):
        seeds.append(settings["seed"])
        return compared(scene, **settings)

    monkeypatch.setattr(command_compare, "compared", seen)
    for words in ([], ["--seed", "0"], ["--seed", "7"]):
        assert main(["compare", "sphere", *words]) == 0
    assert seeds == [0, 0, 7]


def test_slopes_along_the_track_are_those_of_the_first_axis():
    ridges = 1e-7 * np.sin(2 * np.pi * 8 * np.arange(N) / N)[:, np.newaxis] + 1e-3 * drawn()
    assert heights(ridges).slope_along == pytest.approx(heights(ridges).slope, rel=1e-3)
    assert heights(ridges.T).slope_along < 0.1 * heights(ridges.T).slope
