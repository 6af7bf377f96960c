"""Sound files: a tone at its frequency, one gain for all, nothing clipped; the command that writes them."""

import io
import json

import numpy as np
import pytest
import scipy.io.wavfile

from tests.seeded import catches
from validation import __main__ as command
from validation.analysis.evidence import Evidence, Table
from validation.analysis.spectra import Sound, Sounds, common_full_scale
from validation.report import sounds

RATE, TONE = 24000, 1000.0
TIME = np.arange(2400) / RATE


def read(contents):
    rate, samples = scipy.io.wavfile.read(io.BytesIO(contents))
    assert rate == RATE and samples.dtype == np.int16 and samples.ndim == 1
    return samples


def level(samples):
    return 10 * np.log10(np.mean(samples.astype(float) ** 2))


def files(loud, quiet):
    columns = {"loud [N]": loud.tolist(), "quiet [N]": quiet.tolist()}
    tracks = tuple(Sound(name=n, label=n, column=f"{n} [N]", says="") for n in ("loud", "quiet"))
    scale = common_full_scale((loud, quiet))
    heard = Sounds(table="samples", rate=RATE, full_scale=scale, repeats=2, heard="", tracks=tracks)
    none = {"title": "", "method": "", "numbers": (), "conclusions": (), "captions": {}}
    return sounds.sound_files("case", Evidence(**none, tables=(Table("samples", columns),), sounds=heard))


def test_a_tone_comes_out_at_its_frequency_as_often_as_asked():
    """Its largest wave, and the quantisation noise of 16 bit below it: 98 dB less what the full scale is above it."""
    samples = read(files(500 * np.sin(2 * np.pi * TONE * TIME), TIME)["sounds/case-loud.wav"])
    assert samples.size == 2 * TIME.size and (samples[: TIME.size] == samples[TIME.size :]).all()
    power = np.abs(np.fft.rfft(samples)) ** 2
    frequency = np.fft.rfftfreq(samples.size, 1 / RATE)
    assert frequency[power.argmax()] == TONE
    assert power.max() / (power.sum() - power.max()) > 10**9


def by_its_own_peak(samples, full_scale):
    """A sound that is as loud as a file can hold, whatever the others are."""
    values = np.asarray(samples)
    return np.rint(sounds.LARGEST / np.abs(values).max() * values).astype(np.int16)


@catches("a sound normalised by itself").at("validation.report.sounds.quantised", by_its_own_peak)
def test_files_differ_by_the_level_of_the_forces():
    """Rounding to whole numbers leaves less than 0.001 dB."""
    loud = 500 * np.sin(2 * np.pi * TONE * TIME)
    found = files(loud, loud / 10)
    assert set(found) == {"sounds/case-loud.wav", "sounds/case-quiet.wav"}
    difference = level(read(found["sounds/case-loud.wav"])) - level(read(found["sounds/case-quiet.wav"]))
    assert difference == pytest.approx(20, abs=1e-3)


def test_the_largest_sample_is_not_clipped_and_a_larger_one_is_refused():
    assert sounds.quantised([-7.0, 7.0], 7.0).tolist() == [-32767, 32767]
    with pytest.raises(ValueError, match=r"within the full scale 7, got 7\.01"):
        sounds.quantised([7.01], 7.0)
    with pytest.raises(ValueError, match="within the full scale"):
        sounds.quantised([np.nan], 7.0)


def sound(folder, *words):
    return command.main(["sound", "rail", "--seconds", "0.02", "--workers", "1", "--out", str(folder), *words])


@pytest.mark.slow
def test_the_command_writes_one_sound_a_model_with_one_gain(tmp_path, capsys):
    """The level that it states is that of the file."""
    one, two = tmp_path / "one", tmp_path / "two"
    assert sound(one, "--models", "linear,springs,geike") == 0
    printed = capsys.readouterr().out
    about = json.loads((one / "sounds.json").read_text(encoding="utf-8"))
    assert {row["file"] for row in about["sounds"]} == {"linear.wav", "springs.wav", "geike.wav"}
    for row in about["sounds"]:
        samples = read((one / row["file"]).read_bytes())
        assert samples.size == about["repeats"] * round(about["period [s]"] * RATE) >= 2 * RATE
        scale = 20 * np.log10(about["full scale [N]"] / sounds.LARGEST)
        assert level(samples) + scale == pytest.approx(row["level [dB re 1 N]"], abs=0.01)
    assert about["heard"].startswith("What is heard is the contact force")
    assert "50 times a second, which is heard as a tone" in " ".join(printed.split())
    assert "over boundary elements" not in printed
    assert (one / "levels.csv").read_text(encoding="utf-8").startswith('f [Hz],"linear, ellipse [dB re 1 N]",')
    sound(two, "--models", "geike,springs,linear")
    assert {f.name: f.read_bytes() for f in one.iterdir()} == {f.name: f.read_bytes() for f in two.iterdir()}


def test_a_folder_with_files_of_others_is_refused_and_left_as_it_is(tmp_path, capsys):
    """Measured levels are in a levels.csv, too."""
    (tmp_path / "levels.csv").write_text("my own", encoding="utf-8")
    assert sound(tmp_path, "--models", "linear") == command.Exit.BAD_INPUT
    assert "--out must be a new or empty folder" in capsys.readouterr().err
    assert [(path.name, path.read_text(encoding="utf-8")) for path in tmp_path.iterdir()] == [("levels.csv", "my own")]


def edited(tmp_path, capsys, old, new):
    """The scene of a rail with other words in it."""
    command.main(["scene", "rail"])
    (tmp_path / "my.toml").write_text(capsys.readouterr().out.replace(old, new), encoding="utf-8")
    return str(tmp_path / "my.toml")


def test_geikes_rule_is_left_out_where_the_ground_is_not_isotropic(tmp_path, capsys):
    scene = edited(tmp_path, capsys, 'lateral_structure = "isotropic"', 'lateral_structure = "ridges"')
    words = ["sound", scene, "--seconds", "0.02", "--workers", "1", "--out", str(tmp_path / "out")]
    assert command.main([*words, "--models", "linear,geike"]) == 0
    assert "Geike's rule is for isotropic ground, here it is ridges" in capsys.readouterr().out
    assert [f.name for f in (tmp_path / "out").glob("*.wav")] == ["linear.wav"]
    assert command.main([*words, "--models", "geike"]) == command.Exit.BAD_INPUT
    assert "rail.lateral_structure must be isotropic" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("scene", "seconds", "said"),
    [
        ("sphere", "1", "got Smooth sphere"),
        ("rail", "0.001", "at least 0.015"),
        ("rail", "60", "at most"),
        ("still", "1", "a sound needs wheel.speed"),
    ],
)
def test_scenes_and_lengths_without_a_sound_are_refused(scene, seconds, said, tmp_path, capsys):
    if scene == "still":
        scene = edited(tmp_path, capsys, "\nspeed", "\n# speed")
    words = ["sound", scene, "--seconds", seconds, "--out", str(tmp_path / "out")]
    assert command.main(words) == command.Exit.BAD_INPUT
    assert said in capsys.readouterr().err
    assert not (tmp_path / "out").exists()
