"""Spikes, pits, dropouts, steps, runs and clipping of measured lines: found, named, replaced, and the error left."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.seeded import catches
from validation.analysis.spectra import NominalBands
from validation.railway.problems.rail_quantity import RailQuantity
from validation.railway.scenes import line_steps
from validation.railway.scenes import line_steps as line_outliers
from validation.railway.scenes.level_files import RoughnessLevels
from validation.railway.scenes.line_edits import EditedLine, LineEdits, edited
from validation.railway.scenes.measured_lines import MeasuredLines
from validation.scenes.load import load_scene

POINTS, UM = 12000, 1e-6
"""Of a line at 1 mm."""
X = 1e-3 * np.arange(POINTS)


def of_spectrum(density, seed):
    """A line whose waves have a density over k in cycles over a metre, of random phases [um]."""
    k = np.fft.rfftfreq(POINTS, 1e-3)
    k[0] = 1.0
    waves = np.sqrt(density(k)) * np.exp(2j * np.pi * np.random.default_rng(seed).random(k.size))
    waves[0] = 0.0
    return np.fft.irfft(waves, POINTS)


def rail(seed=21):
    """As of a track: 20 dB re 1 um at 4 m, falling to -15 dB at 1 mm, in one-third octaves."""

    def density(k):
        levels = np.interp(np.log(k), -np.log([4.0, 0.4, 1e-2, 3.15e-3, 1e-3]), [20.0, 14.0, -6.0, -10.0, -15.0])
        return 10 ** (levels / 10) / k

    line = of_spectrum(density, seed)
    return 12.0 * line / line.std()


def fractal(hurst, seed, *, longest=0.5, shortest=0.0, rms=5.0):
    line = of_spectrum(
        lambda k: np.maximum(k, 1 / longest) ** (-1 - 2 * hurst) * (k * shortest <= 1) + 1e-15 * (k * shortest > 1),
        seed,
    )
    return rms * line / line.std()


CLEAN = {
    **{f"H = {h}": lambda seed, h=h: fractal(h, seed) for h in (0.3, 0.5, 0.8, 1.0)},
    **{f"H = {h}, smooth": lambda seed, h=h: fractal(h, seed, shortest=0.01, rms=20.0) for h in (0.3, 1.0)},
    **{f"H = {h}, long": lambda seed, h=h: fractal(h, seed, longest=12.0) for h in (0.3, 1.0)},
    "rail": rail,
    "rough": lambda seed: 10.0 * rail(seed),
    "tilted": lambda seed: rail(seed) + 50e3 * X,
    "corrugated": lambda seed: rail(seed) + 30.0 * np.sin(2 * np.pi * X / 0.04 + seed),
    "corrugated in part": lambda seed: rail(seed) + 30.0 * np.sin(2 * np.pi * X / 0.05) * (abs(X - 5.0) < 1.0),
    "one wave": lambda seed: 10.0 * np.sin(2 * np.pi * X / (0.032 + 0.01 * seed)),
    "white": lambda seed: np.random.default_rng(seed).standard_normal(POINTS),
}
"""What is roughness, however rough, in um."""


@catches("roughness taken for spikes", kind="H = 0.5", rounded=0.0).at(
    "validation.railway.scenes.line_steps.STANDS_OUT", 3.0
)
@catches("one scale of a line of two grounds", kind="corrugated in part", rounded=0.0).at(
    "validation.railway.scenes.line_steps.STRETCH", 1e3
)
@pytest.mark.parametrize("rounded", [0.0, 0.1, 1.0])
@pytest.mark.parametrize("kind", CLEAN)
def test_clean_lines_have_no_outliers(kind, rounded):
    for seed in (1, 2):
        line = CLEAN[kind](seed)
        line = np.round(line / rounded) * rounded if rounded else line
        assert EditedLine.of(UM * line, 1e-3).outliers == ()


# What is planted: a function of the line [um] and of random numbers changes it, and has the places


def spikes(line, rng, low=30.0, high=150.0):
    at = 30 + 400 * np.arange(25) + rng.integers(0, 300, 25)
    line[at] += rng.uniform(low, high, 25)
    return at


def pits(line, rng, shape=(0.3, 0.8, 1.0, 0.8, 0.3), depth=60.0, count=15):
    at = 60 + 700 * np.arange(count) + rng.integers(0, 600, count)
    for middle in at:
        first = middle - len(shape) // 2
        line[first : first + len(shape)] -= depth * np.array(shape)
    return at


def step(line, rng, height=300.0):
    line[6000:] += height
    return np.array([6000])


def zeros(line, rng):
    line[4000:4200] = 0.0
    return np.array([4000])


def frozen(line, rng):
    line[4000:4200] = line[4000]
    return np.array([4000])


def dropouts(line, rng):
    line[[0, 500, 501, 502, 9000]] = -9999.0
    return np.array([0, 500, 9000])


def noisy(line, rng):
    line[4000:4080] = 500.0 * rng.standard_normal(80)
    return np.array([4000])


def several(line, rng):
    return np.concatenate([step(line, rng), spikes(line, rng)])


PLANTED = {
    "spikes": spikes,
    "spikes of 10 um": lambda line, rng: spikes(line, rng, 10.0, 12.0),
    "dirt": lambda line, rng: pits(line, rng, tuple(np.hanning(9)[1:-1]), depth=-50.0),
    "pits": pits,
    "wide pits": lambda line, rng: pits(line, rng, tuple(np.hanning(23)[1:-1]), count=6),
    "step": step,
    "step down": lambda line, rng: step(line, rng, -40.0),
    "zeros": zeros,
    "frozen": frozen,
    "dropouts": dropouts,
    "noisy": noisy,
    "a step and spikes": several,
}
KIND = {"step": "step", "zeros": "run", "frozen": "run", "dropouts": "dropout", "noisy": "dropout"}


def changed(plant, seed, line=None):
    line = rail(seed) if line is None else line.copy()
    places = plant(line, np.random.default_rng(seed))
    return UM * line, places


def lines(height, outliers="remove", **keys):
    found = edited(height[:, np.newaxis], 1e-3, outliers)
    result = found.result(height[:, np.newaxis])
    return MeasuredLines(height=result, spacing=1e-3, edits=found, **keys)


def levels(height):
    return np.array(MeasuredLines(height=height, spacing=1e-3).levels.levels)


change = EditedLine.change


without_steps = line_steps.without_steps


def steps_downwards(line, spacing, sensor):
    clean, steps = without_steps(line, spacing, sensor)
    return 2 * line - clean, steps


@catches("the part behind a step moved the other way", name="step").at(
    "validation.railway.scenes.line_edits.without_steps", steps_downwards
)
@catches("no error of what a straight line replaces", name="zeros").at(
    "validation.railway.scenes.line_edits.EditedLine.change", lambda line, bands: 0 * change(line, bands)
)
@pytest.mark.parametrize("name", PLANTED)
def test_levels_without_outliers_are_those_of_the_clean_line_within_the_error_that_is_left(name):
    """In 95 % of the bands, and nowhere by more than a few tenths of a decibel beyond it."""
    beyond = []
    for seed in (21, 22, 23):
        height, _ = changed(PLANTED[name], seed)
        found = lines(height).levels
        beyond.append(np.abs(np.array(found.levels) - levels(UM * rail(seed))) - found.errors)
    assert np.mean(np.concatenate(beyond) <= 0.01) >= 0.95
    assert np.max(beyond) < 0.3


@pytest.mark.parametrize("name", PLANTED)
def test_an_error_that_is_left_is_no_larger_than_what_is_gained(name):
    """It says that spikes are gone, and not that nothing is known; a gap of 0.2 m leaves decibels in few long bands."""
    height, _ = changed(PLANTED[name], 21)
    errors = np.array(lines(height).levels.errors)
    assert np.median(errors) < 0.7
    assert (errors > 0).all()


kept = EditedLine.kept


@catches("no error of outliers that are kept", name="spikes").at(
    "validation.railway.scenes.line_edits.EditedLine.kept", lambda line, bands: 0 * kept(line, bands)
)
@pytest.mark.parametrize("name", PLANTED)
def test_outliers_that_are_kept_are_in_the_error(name):
    height, _ = changed(PLANTED[name], 21)
    kept = lines(height, "keep")
    off = np.abs(levels(height) - levels(UM * rail(21)))
    assert (kept.height[:, 0] == height).all()
    assert np.mean(off <= np.array(kept.levels.errors) + 0.01) >= 0.95
    assert kept.levels.levels == MeasuredLines(height=height, spacing=1e-3).levels.levels


@catches("spikes that nobody finds", name="spikes").at("validation.railway.scenes.line_steps.STANDS_OUT", 100.0)
@catches("pits wider than a few points that are not seen", name="wide pits").at(
    "validation.railway.scenes.line_steps.DISTANCES", line_steps.DISTANCES[:4]
)
@catches("steps of a hundred scales alone", name="step down").at("validation.railway.scenes.line_steps.STEP", 100.0)
@pytest.mark.parametrize("name", [name for name in PLANTED if name != "spikes of 10 um"])
def test_all_that_is_planted_is_found_where_it_is(name):
    height, places = changed(PLANTED[name], 21)
    found = EditedLine.of(height, 1e-3).outliers
    assert len(found) == len(places)
    for place in places.tolist():
        assert any(one.first - 1 <= place <= one.last + 1 for one in found)
    first = found[0]
    kinds = {"spikes": "spike", "dirt": "spike", "pits": "pit", "wide pits": "pit"} | KIND
    assert first.kind == kinds.get(name, "step")


def test_heights_of_outliers_are_those_that_were_planted():
    height, _ = changed(step, 21)
    (one,) = EditedLine.of(height, 1e-3).outliers
    assert (one.last, one.size) == (6000, pytest.approx(300e-6, abs=3e-6)) and 0 < one.spread < 10e-6
    line = rail(21)
    line[[1000, 5000]] += [80.0, -60.0]
    high, low = EditedLine.of(UM * line, 1e-3).outliers
    assert (high.first, high.last, high.kind) == (1000, 1000, "spike")
    assert (low.first, low.last, low.kind) == (5000, 5000, "pit")
    assert [high.size, low.size] == pytest.approx([80e-6, -60e-6], abs=4e-6)


def test_the_spread_of_a_step_is_the_half_width_of_95_per_cent_of_its_height():
    """Of steps of a known height at many places of lines whose differences are normal."""
    inside = []
    for seed in range(21, 26):
        line = UM * rail(seed)
        for place in range(300, 2700, 60):
            stepped = line[:3000] + np.where(np.arange(3000) >= place, 300e-6, 0.0)
            _, (one,) = line_steps.without_steps(stepped, 1e-3, 0.0)
            assert one.last == place
            inside.append(abs(one.size - 300e-6) <= one.spread)
    assert 0.9 < np.mean(inside) < 0.99


def test_a_spike_is_replaced_by_a_straight_line_and_all_else_stays():
    line = UM * rail(21)
    spiked = line.copy()
    spiked[5000] += 100e-6
    clean = EditedLine.of(spiked, 1e-3).clean
    assert clean[5000] == pytest.approx((line[4999] + line[5001]) / 2, rel=1e-12)
    assert (np.delete(clean, 5000) == np.delete(line, 5000)).all()


def test_spikes_of_ten_micrometres_on_a_smooth_rail_are_found_at_any_spacing():
    for spacing in (0.5e-3, 1e-3, 2e-3):
        smooth = 0.1 * fractal(1.0, 3)
        smooth[[2000, 4000, 8000]] += 10.0
        assert [one.first for one in EditedLine.of(UM * smooth, spacing).outliers] == [2000, 4000, 8000]


def test_a_step_that_takes_some_points_is_one_step():
    line = rail(21) + np.interp(np.arange(POINTS), [5997, 6003], [0.0, 300.0])
    (one,) = EditedLine.of(UM * line, 1e-3).outliers
    assert one.kind == "step" and 5993 <= one.first < one.last <= 6007


@pytest.mark.parametrize("rounded", [0.1, 1.0])
def test_outliers_of_rounded_lines_are_found(rounded):
    for plant in (spikes, pits, step, zeros):
        line = np.round(rail(22) / rounded) * rounded
        height, places = changed(plant, 22, line)
        assert len(EditedLine.of(height, 1e-3).outliers) == len(places)


@pytest.mark.parametrize("distance", [3, 8])
def test_beyond_its_ends_a_straight_line_goes_on_though_its_ends_stand_out(distance):
    """By the median of the six points beside each end, so that a spike there has its own height."""
    straight = 3.0 + 0.5 * np.arange(40)
    line = straight.copy()
    line[[0, -1]] += [90.0, -70.0]
    before, behind = line_outliers._sides(line, distance)
    assert before[:distance] == pytest.approx(straight[:distance] - 0.5 * distance)
    assert behind[-distance:] == pytest.approx(straight[-distance:] + 0.5 * distance)


# What is not known


CLIPPED = {
    "both sides": lambda z: z.clip(-15.0, 15.0),
    "above": lambda z: z.clip(None, 12.0),
    "below": lambda z: z.clip(-12.0, None),
    "a gap": lambda z: np.where(abs(X - 5.0) < 0.8, 0.0, z),
}


@catches("clipping at one end that is not seen", name="above").at(
    "validation.railway.scenes.line_steps.CROWDED", np.inf
)
@catches("half of a line that is made up", name="a gap").at("validation.railway.scenes.line_edits.MOST_REPLACED", 1.0)
@catches("clipping that is forgiven", name="below").at("validation.railway.scenes.line_edits.MOST_CLIPPED", 1.0)
@pytest.mark.parametrize("name", CLIPPED)
def test_lines_of_which_too_much_is_gone_have_no_error(name):
    height = UM * CLIPPED[name](rail(21))
    for outliers in ("remove", "keep"):
        found = lines(height, outliers)
        assert set(found.levels.errors) == {math.inf}
        assert ("none of a rail" if name == "a gap" else "clipped at") in found.levels.fault
        assert (found.height[:, 0] == height).all()


def test_a_little_clipping_is_in_the_error():
    line = rail(21)
    height = UM * line.clip(None, np.quantile(line, 0.997))
    found = lines(height).levels
    assert {one.kind for one in EditedLine.of(height, 1e-3).outliers} == {"clipping"}
    assert max(found.errors) < 1.0 and found.fault == ""


def test_a_large_drift_is_named_and_in_the_error():
    line = rail(21)
    drifting = UM * (line + 20e3 * np.exp(-X / 3.0))
    (one,) = EditedLine.of(drifting, 1e-3).outliers
    assert one.kind == "drift" and one.size > 1e-3
    for outliers in ("remove", "keep"):
        found = lines(drifting, outliers).levels
        assert np.mean(np.abs(np.array(found.levels) - levels(UM * line)) <= np.array(found.errors) + 0.01) >= 0.95
    assert max(lines(drifting, "keep").levels.errors) > max(lines(drifting).levels.errors)


# What is said


def test_notes_name_number_size_and_places():
    line = UM * rail(21)
    line[[1000, 5000]] += 80e-6
    line[8000] = 5e-3
    of_two = edited(np.stack([line, UM * rail(22)], axis=1), 1e-3, "remove")
    spiky, lost = of_two.notes([-0.01, 0.0])
    assert spiky.startswith("the line at -10 mm has 2 spikes of ") and "at 1, 5 m: replaced by straight" in spiky
    assert "up to 1 mm wide" in spiky and 'outliers = "keep"' in spiky
    assert lost.startswith("the line at -10 mm has 1 dropout of ") and "at 8 m: " in lost
    (kept, _) = LineEdits(lines=of_two.lines, outliers="keep").notes([-0.01, 0.0])
    assert "kept, as asked by outliers" in kept
    moved, _ = edited(np.stack([changed(several, 21)[0]], axis=1), 1e-3).notes([0.0])[::-1]
    assert "the line has 1 step of 300 µm at 6 m: the part behind is moved" in moved


def test_places_of_many_outliers_are_shortened():
    line = UM * rail(21)
    line[100:10000:200] += 100e-6
    (note,) = edited(line[:, np.newaxis], 1e-3).notes([0.0])
    assert "has 50 spikes" in note and "and 20 more places" in note and len(note) < 600


# The levels


errors = LineEdits.errors


@catches("the error of the worst line for that of the mean").at(
    "validation.railway.scenes.line_edits.LineEdits.errors",
    lambda edits, bands, powers: errors(edits, bands, powers / len(powers)),
)
def test_errors_of_several_lines_are_those_of_their_mean_energy():
    """One spiky line of two has half of the energy, and about half of its error."""
    spiky, _ = changed(spikes, 21)
    alone = np.array(lines(spiky).levels.errors)
    both = np.stack([spiky, spiky[::-1] * 0 + UM * rail(21)], axis=1)
    found = edited(both, 1e-3)
    of_both = MeasuredLines(height=found.result(both), spacing=1e-3, positions=(0.0, 0.01), edits=found).levels.errors
    assert np.array(of_both) == pytest.approx(alone / 2, rel=0.15)


@catches("errors of the wheel left out of the sum").at(
    "validation.railway.scenes.level_files.RoughnessLevels._powers_of_errors",
    property(lambda levels: 0 * levels.powers),
)
def test_errors_are_cut_and_added_with_their_levels():
    bands = NominalBands().within(0.1, 0.063)
    one = RoughnessLevels.of_powers(bands, [4e-12, 2e-12, 1e-12], source="a", errors=(1.0, 2.0, 3.0), fault="a is off")
    assert one.within(0.08, None).errors == (2.0, 3.0)
    plain = RoughnessLevels.of_powers(bands, [4e-12, 2e-12, 1e-12], source="b")
    both = one + plain
    assert both.errors == pytest.approx([10 * math.log10((1 + 10 ** (e / 10)) / 2) for e in (1.0, 2.0, 3.0)])
    assert (plain + one).errors == pytest.approx(both.errors) and both.fault == "a is off"
    assert (plain + plain).errors == () and one.raised(3.0).errors == one.errors
    with pytest.raises(ValueError, match="errors must be none or one a level"):
        RoughnessLevels.of_powers(bands, [1e-12] * 3, source="", errors=(1.0,))


@catches("a filter without the error of its lines").at(
    "validation.railway.problems.rail_quantity.RailQuantity.left_by_faults",
    property(lambda asked: np.zeros(len(asked.bands))),
)
def test_no_filter_has_less_error_than_its_lines():
    """Which is added linearly to that of what lies across."""
    height, _ = changed(spikes, 21)
    of_lines = lines(height, "keep")
    scene = replace(load_scene("rail"), roughness=of_lines, lateral_structure="ridges")
    left = RailQuantity(scene, "contact-filter").left_by_ground
    assert (left >= np.array(of_lines.levels.errors)).all() and left.max() > 3


def test_a_line_may_keep_its_tilt_or_its_mean():
    x = X - X.mean()
    found = {
        detrend: MeasuredLines(height=UM * (rail(21) + 3e3 * x + 2e3), spacing=1e-3, detrend=detrend).levels.levels[0]
        for detrend in ("plane", "mean", "none")
    }
    alone = levels(UM * rail(21))[0]
    assert found["plane"] == pytest.approx(alone, abs=0.2)
    # Hann's window leaks a mean into the first two waves alone, which no band has, and a tilt into all
    assert found["mean"] > alone + 10 and found["none"] == pytest.approx(found["mean"], abs=1e-6)
    with pytest.raises(ValueError, match="detrend must be one of"):
        MeasuredLines(height=UM * rail(21), spacing=1e-3, detrend="tilt")
