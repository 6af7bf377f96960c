"""Lines of figures belong to their data: labels, bars, boxes, signs.

Figures are drawn from tables alone. Here each column of a table has values of its own, made up, so that a label on
another column's line, a bar of another column, or half of a decibel, is seen.
"""

import zlib
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.container import ErrorbarContainer
from matplotlib.figure import Figure

from validation.analysis.evidence import Table
from validation.cases.rolling.input_spectrum_numbers import NAMES
from validation.cases.rolling.roughness_from_force import FILTERS
from validation.report.figures import (
    geike,
    hertz,
    limits,
    normalisation,
    precision,
    reduced_models,
    rolling_input,
    rolling_validity,
    roughness_from_force,
    track_stiffness,
    wheel,
    wheel_3d,
    wheel_distance,
    wheel_regions,
    wheel_stability,
)
from validation.report.figures import mdr_limits as mdr_limits_figure
from validation.report.figures import rolling as rolling_figure


class Made:
    """A table whose columns are made up, each of its own values from 0.5 to 2, but for those that are given."""

    def __init__(self, given, **bounds):
        self.given = {name: np.asarray(values) for name, values in given.items()}
        self.size = len(next(iter(self.given.values())))
        self.rows = np.arange(self.size)
        self.columns = self.given

    def __getitem__(self, name):
        values = self.given.get(name)
        if values is None:
            values = np.random.default_rng(zlib.crc32(name.encode())).uniform(0.5, 2.0, self.size)
        return values[self.rows]

    def where(self, **equal):
        some = Made(self.given)
        keep = np.logical_and.reduce([self[name] == value for name, value in equal.items()])
        some.rows = self.rows[keep]
        return some


def made(numbers=(), **tables):
    named = {name.replace("_", "-"): table for name, table in tables.items()}
    for name, table in tables.items():
        if isinstance(table, Made):
            table.name = name
    return SimpleNamespace(
        table=lambda name: named[name.replace("_", "-").replace(" ", "-")],
        has_table=lambda name: name.replace("_", "-") in named,
        tables=tuple(tables.values()),
        numbers=numbers,
    )


def series(axis):
    """Of each label: y, and the ends of its bars, None where it has none."""
    found = {}
    for line in axis.get_lines():
        label = line.get_label()
        if not label.startswith("_"):
            assert label not in found, label
            found[label] = (np.asarray(line.get_ydata(), dtype=float), None)
    for container in axis.containers:
        if isinstance(container, ErrorbarContainer) and not (container.get_label() or "_").startswith("_"):
            ends = np.array([[segment[0][1], segment[1][1]] for segment in container.lines[2][-1].get_segments()])
            assert container.get_label() not in found
            found[container.get_label()] = (np.asarray(container.lines[0].get_ydata(), dtype=float), ends)
    return found


def drawn(axis, expected, table=None):
    """The lines of these labels have these values, or those of a column of the table; no other line has a label."""
    found = series(axis)
    assert found.keys() == expected.keys()
    for label, values in expected.items():
        y, bars = values if isinstance(values, tuple) else (values, None)
        y = table[y] if isinstance(y, str) else y
        np.testing.assert_allclose(found[label][0], y, err_msg=label)
        if bars is not None:
            np.testing.assert_allclose(np.sort(found[label][1], axis=1).T, [y - bars[0], y + bars[1]], err_msg=label)


FORCE = np.array([0.01, 0.1, 1.0, 10.0])


def test_lines_of_the_sphere():
    tables = {name: Made({"x [m]": np.arange(4.0)}) for name in ("load", "pressure", "exact-pressure")}
    refinement = Made({"cells per contact radius": np.array([4, 8, 16])})
    load, pressure, errors = hertz.draw(
        made(**{**tables, "exact_pressure": tables["exact-pressure"], "refinement": refinement})
    ).axes
    of = tables["load"]
    drawn(load, {"Hertz": "hertz force [N]", "boundary elements": "bem3d force [N]", "MDR": "mdr force [N]"}, of)
    np.testing.assert_allclose(load.get_lines()[0].get_xdata(), 1e6 * of["approach [m]"])
    exact, found = tables["exact-pressure"]["hertz pressure [Pa]"], tables["pressure"]["bem3d pressure [Pa]"]
    drawn(pressure, {"Hertz": 1e-6 * exact, "boundary elements": 1e-6 * found})
    second_order = refinement["bem3d force error"][0] * np.array([1, 1 / 4, 1 / 16])
    expected = {"boundary elements": "bem3d force error", "MDR": "mdr force error", "second order": second_order}
    drawn(errors, expected, refinement)


def test_lines_of_geikes_rule():
    spectra, moments = Made({"q [rad/m]": np.arange(1.0, 6.0)}), Made({"n": np.arange(4)})
    spectrum, moment = geike.draw(made(spectra=spectra, moments=moments)).axes
    expected = {
        "Geike, π q C_2D": "geike [m^3]",
        "line trace": "line trace [m^3]",
        "drawn profiles": "drawn profiles [m^3]",
        "lines cut from drawn surfaces": "lines of drawn surfaces [m^3]",
    }
    drawn(spectrum, expected, spectra)
    drawn(moment, {"Geike": "geike", "line trace": "line trace", "mean of |cos φ|ⁿ": "exact"}, moments)


def test_lines_of_ways_to_draw():
    keys = {"H": [0.7] * 6, "drawn with": ["fixed"] * 6, "method": ["bem3d"] * 3 + ["mdr"] * 3}
    table = Made({**keys, "Fbar": [0.1, 1.0, 10.0] * 2})
    value = table["relative deviation"]
    table.given["low"], table.given["high"] = 0.8 * value, 1.1 * value
    (axis,) = normalisation.draw(made(curves=table)).axes
    of_bem = value[:3], (0.2 * value[:3], 0.1 * value[:3])
    drawn(axis, {"boundary elements": of_bem, "MDR, L_1D = L": value[3:]})


def test_lines_of_where_mdr_must_fail():
    table = Made({"q_r L / 2π": [1.0] * 4 + [8.0] * 4, "Fbar": [*FORCE, *FORCE], "bem3d few cells": np.full(8, False)})
    names = ("contact fraction", "mean gap", "interface", "relative deviation")
    for name in (f"{method} {what}" for method in ("bem3d", "mdr") for what in names):
        table.given[f"{name} low"], table.given[f"{name} high"] = 0.9 * table[name], 1.3 * table[name]
    axes = mdr_limits_figure.draw(made(curves=table)).axes
    for axis, name in zip(axes, names, strict=True):
        unit = table["Fbar"] if name == "interface" else np.ones(8)
        expected = {"Persson": table["Persson contact fraction"][:4]} if name == "contact fraction" else {}
        for roll_off, rows in ((1, slice(4)), (8, slice(4, 8))):
            value = (table[f"bem3d {name}"] / unit)[rows]
            expected[f"boundary elements, q_r L / 2π = {roll_off}"] = value, (0.1 * value, 0.3 * value)
            expected[f"MDR, q_r L / 2π = {roll_off}"] = (table[f"mdr {name}"] / unit)[rows]
        drawn(axis, expected)


def test_lines_of_fig_14_3():
    table = Made({"q a": np.arange(1.0, 6.0)})
    (axis,) = rolling_figure.draw_line(made(spectrum=table)).axes
    columns = {"linear theory, 3D": "linear 3D", "springs": "springs", "(14.12)": "(14.12)", "(14.14)": "(14.14)"}
    drawn(axis, columns, table)


def rolled_levels():
    """Of two heights and three bands."""
    keys = {"h/d": np.repeat([0.01, 0.1], 3), "q a": [0.5, 1.0, 2.0] * 2, "from": [0.4, 0.8, 1.6] * 2}
    return Made({**keys, "to": [0.8, 1.6, 3.2] * 2})


def test_lines_of_rolling():
    table = rolled_levels()
    for axis, height in zip(rolling_figure.draw(made(levels=table)).axes, (0.01, 0.1), strict=True):
        mine = table.where(**{"h/d": height})
        bars = mine["± sample [dB]"] + mine["± grid [dB]"]
        assert axis.get_title() == f"h/d = {height:g}"
        expected = {
            "linear theory, 3D": "linear 3D [dB]",
            "linear theory, 1D (14.12)": "linear 1D [dB]",
            "springs": "springs [dB]",
            "boundary elements": ("bem3d [dB]", (bars, bars)),
        }
        drawn(axis, expected, mine)


@pytest.mark.slow
def test_panels_of_the_map_have_their_model():
    table = rolled_levels()
    axes = rolling_figure.draw_map(made(levels=table)).axes[:4]
    models = ("linear 1D", "springs", "linear 3D", "rolling-equivalent springs")
    assert tuple(axis.get_title() for axis in axes) == models
    for axis, model in zip(axes, models, strict=True):
        np.testing.assert_allclose(axis.collections[0].get_array().ravel(), table[f"{model} over bem3d [dB]"])


def test_coherence_has_its_lines():
    table = rolled_levels()
    forces = Made({"h/d": np.repeat([0.01, 0.1], 4), "x / a": np.arange(8.0)})
    coherence, departure, _ = rolling_figure.draw_coherence(made(levels=table, forces=forces)).axes
    for i, height in enumerate((0.01, 0.1)):
        mine = table.where(**{"h/d": height})
        assert coherence.get_lines()[2 * i].get_label() == f"h/d = {height:g}"
        np.testing.assert_allclose(coherence.get_lines()[2 * i].get_ydata(), mine["coherence of bem3d"])
        np.testing.assert_allclose(coherence.get_lines()[2 * i + 1].get_ydata(), mine["coherence of springs"][2:])
        np.testing.assert_allclose(departure.get_lines()[2 * i].get_ydata(), -mine["linear 3D over bem3d [dB]"])
        np.testing.assert_allclose(
            departure.get_lines()[2 * i + 1].get_ydata(), (mine["springs [dB]"] - mine["linear 1D [dB]"])[2:]
        )


def test_lines_of_reduced_models():
    """Over h' a/d in the order of that parameter; a point a model over its work, but for the reference."""
    shown = reduced_models.SHOWN
    names = ["boundary elements", *shown, "a trial"]
    table = Made({"model": np.repeat(names, 2), "h' a/d": np.tile([0.8, 0.2], len(names))})
    bands = Made({"model": np.repeat(names, 3), "h' a/d": np.full(3 * len(names), 0.8)})
    over_slope, level, coherence, cost = reduced_models.draw(made(reduced_models=table, one_third_octaves=bands)).axes
    drawn(
        over_slope,
        {n: (table.where(model=n)["rms [dB]"][::-1], (table.where(model=n)["± rms [dB]"][::-1],) * 2) for n in shown},
    )
    for axis, column in ((level, "over bem3d [dB]"), (coherence, "coherence")):
        for name, line in zip(shown, axis.get_lines()[:: 3 if axis is level else 1], strict=False):
            np.testing.assert_allclose(line.get_ydata(), bands.where(model=name)[column])
    there = table.where(**{"h' a/d": 0.8})
    for name, line in zip(names[1:], cost.get_lines(), strict=False):
        mine = there.where(model=name)
        assert line.get_xdata() == mine["work over springs on a line"]
        assert line.get_ydata() == mine["rms [dB]"]


def test_lines_of_the_map_of_reduced_models():
    """Points in the order of h' a/d; the line and its label have the largest up to there."""
    shown = reduced_models.SHOWN
    table = Made({"model": np.repeat(shown, 3), "h' a/d": np.tile([0.8, 0.05, 0.2], len(shown))})
    (axis,) = reduced_models.draw_map(made(reduced_models=table)).axes
    lines = [line for line in axis.get_lines() if line.get_linestyle() == "-"]
    for model, points, line, label in zip(shown, axis.containers, lines, axis.texts, strict=True):
        rms = table.where(model=model)["rms [dB]"][[1, 2, 0]]
        np.testing.assert_allclose(points.lines[0].get_ydata(), rms)
        np.testing.assert_allclose(line.get_ydata(), [rms[0], rms[:2].max(), rms.max()])
        assert label.get_text() == model
        assert label.xy == (0.8, rms.max())


def test_lines_of_where_linear_theory_ends():
    """Over h/d and over h' a/d, each spectrum in the order of that parameter."""
    table = Made({"spectrum": np.repeat(["one", "two"], 3)})
    kept, kept_too, off, off_too, layer, layer_too = rolling_validity.draw(made(validity=table)).axes
    for axes, value, bar in (
        ((kept, kept_too), "contact kept", "± contact"),
        ((off, off_too), "rms over linear [dB]", "± rms [dB]"),
        ((layer, layer_too), "pressed layer over bem3d [dB]", "± pressed layer [dB]"),
    ):
        for axis, parameter in zip(axes, ("h/d", "h' a/d"), strict=True):
            expected = {}
            for name in ("one", "two"):
                mine = table.where(spectrum=name)
                order = np.argsort(mine[parameter])
                expected[name] = mine[value][order], (mine[bar][order],) * 2
            drawn(axis, expected)


def test_lines_of_roughness_from_force():
    table = Made({"h/d": np.repeat([0.1, 0.3], 6), "filter": np.tile(np.repeat(FILTERS, 2), 2), "q a": [1.0, 2.0] * 6})
    for axis, height in zip(roughness_from_force.draw(made(roughness=table)).axes, (0.1, 0.3), strict=True):
        expected = {}
        for name in FILTERS:
            mine = table.where(**{"h/d": height, "filter": name})
            expected[name] = mine["found over true [dB]"], (mine["± [dB]"],) * 2
        drawn(axis, expected)


def test_lines_of_stiffness_along_a_track():
    models = ("wheel, bem3d", "punch, springs")
    moments = Made({"Fbar": [1.0, 1.0, 3.0, 3.0], "model": models * 2})
    bands = Made({"Fbar": np.repeat([1.0, 3.0], 3), "q a": [2.0, 4.0, 8.0] * 2})
    mean, deviation, level = track_stiffness.draw(made(moments=moments, bands=bands)).axes
    for axis, quantity in ((mean, "mean stiffness"), (deviation, "relative deviation of stiffness")):
        expected = {}
        for name in models:
            mine = moments.where(model=name)
            expected[name] = mine[quantity], (mine[f"± {quantity}"],) * 2
        drawn(axis, expected)
    expected = {}
    for force in (1.0, 3.0):
        mine = bands.where(Fbar=force)
        expected[f"Fbar = {force:g}"] = mine["Geike's spectrum [dB]"], (mine["Geike's spectrum ± [dB]"],) * 2
    drawn(level, expected)


def test_lines_of_input_spectra():
    names = ["one", "two", "three", "four", "five", "six"]
    bands = Made({"spectrum": np.repeat(names, 3), "q a": [1.0, 2.0, 3.0] * 6})
    for axis, name in zip(rolling_input.draw(made(bands=bands)).axes, names, strict=True):
        mine = bands.where(spectrum=name)
        drawn(axis, {label: f"{label} [dB]" for label in NAMES.values()}, mine)
    rolled = Made({"spectrum": np.repeat(names[:2], 3), "h/d": np.full(6, 0.1), "q a": [1.0, 2.0, 3.0] * 2})
    for axis, name in zip(rolling_input.draw_springs(made(rolled=rolled)).axes, names, strict=False):
        mine = rolled.where(spectrum=name)
        drawn(axis, {label: (f"{label} [dB]", (mine[f"{label} ± [dB]"],) * 2) for label in NAMES.values()}, mine)
    punches = Made({"input": np.repeat(list(NAMES.values()), 2), "Fbar": [0.1, 1.0] * len(NAMES)})
    value = punches["mdr over bem3d"]
    punches.given["low"], punches.given["high"] = 0.8 * value, 1.1 * value
    (axis,) = rolling_input.draw_punch(made(punches=punches)).axes
    expected = {}
    for label in NAMES.values():
        mine = punches.where(input=label)["mdr over bem3d"]
        expected[label] = mine, (0.2 * mine, 0.1 * mine)
    drawn(axis, expected)


def test_lines_of_fig_14_4():
    spectrum, near = Made({"x": np.arange(6)}), Made({"x": np.arange(5)})
    marks = Table("marks", {"mark": ["ω_eigen"], "omega [rad/s]": [1.0]})
    contrast = Made({"x": np.arange(4)})
    whole, region, last = wheel.draw(made(spectrum=spectrum, oscillation=near, marks=marks, contrast=contrast)).axes
    expected = {
        "linear theory": "linear",
        "no window, (14.17)": "A [(m/s2)2 s]",
        "Hann": "Hann",
        "floor predicted": "floor",
    }
    drawn(whole, expected, spectrum)
    band = whole.collections[0].get_paths()[0].vertices[:, 1]
    assert set(np.round(spectrum["lowest tenth"], 9)) <= set(np.round(band, 9))
    drawn(region, {"linear theory": "linear", "no window": "springs", "Hann": "springs, Hann"}, near)
    drawn(last, {"linear theory": "linear", "springs, Hann": with_bars(contrast, "springs, Hann")}, contrast)
    # a scene whose region 3 has no whole period
    wheel.draw(made(spectrum=spectrum, oscillation=near, marks=marks))


def with_bars(table, name):
    """A column, and how far below and above it the ends of its interval are."""
    return table[name], [np.abs(table[f"{name}, {end}"] - table[name]) for end in ("from", "to")]


def test_lines_of_one_parameter_at_a_time():
    names = ["the scene", "v₀ × 2", "F_N × 2", "q_min × 2", "q_max × 2", "H = 1", "h₀ × 4"]
    table = Made({"scene": np.repeat(names, 3), "omega [rad/s]": [1.0, 2.0, 3.0] * 7})
    for axis, name in zip(wheel.draw_parameters(made(variations=table)).axes, names[1:], strict=True):
        drawn(axis, {name: "A [(m/s2)2 s]"}, table.where(scene=name))


def test_lines_of_fig_14_5():
    distances = Made({"distance [m]": np.repeat([0.1, 0.2], 3), "omega [rad/s]": [1.0, 2.0, 3.0] * 2})
    breaks = Made({"distance [m]": [0.1, 0.2], "duration [s]": np.array([1.0, 2.0]), "break [rad/s]": [1.5, 2.5]})
    law = Made({"duration [s]": np.array([1.0, 2.0]), "exponent": [0.4, 0.4]})
    spectra, found = wheel_distance.draw(made(distances=distances, breaks=breaks, law=law)).axes
    for name in (0.1, 0.2):
        mine = distances.where(**{"distance [m]": name})
        np.testing.assert_allclose(series(spectra)[f"{name:.2g} m"][0], mine["A [(m/s2)2 s]"])
    expected = {
        "found": (np.array([1.5, 2.5]), (breaks["± break [rad/s]"],) * 2),
        "by the jumps of the records": "break by its jumps [rad/s]",
        "T^0.400": law["break [rad/s]"],
    }
    drawn(found, expected, breaks)


def test_lines_of_the_causes():
    ends, plateau = Made({"x": np.arange(5)}), Made({"h / d": np.array([0.1, 0.2, 0.4])})
    vibrations = Made({"release / d": np.array([0.0, 0.4])})
    hertz = Made({"release / d": np.array([0.1, 0.2, 0.3])})
    tables = {"endings": ends, "plateau": plateau, "vibrations": vibrations, "hertz": hertz}
    spectra, region, peak = wheel_distance.draw_cause(made(**tables)).axes
    names = ("springs, steady-state", "springs, open", "springs, periodic", "springs, open, Hann", "linear, open")
    drawn(spectra, {name: name for name in names}, ends)
    kinds = {
        "springs, open": "springs, open",
        "linear, open: leakage": "linear, open",
        "springs, steady-state: nonlinearity": "springs, steady-state",
    }
    expected = {label: (f"{kind} [dB]", (plateau[f"± {kind} [dB]"],) * 2) for label, kind in kinds.items()}
    for label, kind, order in (("h^2", "linear, open", 2), ("h^4", "springs, steady-state", 4)):
        expected[label] = plateau[f"{kind} [dB]"][0] + 10 * np.log10(np.array([1.0, 2.0, 4.0]) ** order)
    drawn(region, expected, plateau)
    bars = next(c for c in peak.containers if isinstance(c, ErrorbarContainer))
    np.testing.assert_allclose(bars.lines[0].get_ydata(), vibrations["peak over omega_eigen"])
    np.testing.assert_allclose(series(peak)["Hertz, quadrature"][0], hertz["peak over omega_eigen"])


def test_lines_of_the_wheel_in_three_dimensions():
    table, near = Made({"omega [rad/s]": np.arange(1.0, 5.0)}), Made({"x": np.arange(6)})
    contrast = Made({"x": np.arange(4)})
    levels, differences, oscillation, last = wheel_3d.draw(made(levels=table, oscillation=near, contrast=contrast)).axes
    names = ("linear, 3D", "linear, 1D (14.12)", "springs, Geike spectrum", "springs, rolling spectrum")
    bem = table["bem3d [dB]"]
    half = sum(table[f"± {of} [dB]"] for of in ("sample", "grid", "solver"))
    over = {name: table[f"{name} over bem3d [dB]"] for name in names}
    drawn(levels, {name: bem + off for name, off in over.items()} | {"boundary elements": (bem, (half, half))})
    for line, name in zip(differences.get_lines(), names, strict=False):
        np.testing.assert_allclose(line.get_ydata(), over[name])
    columns = {"linear contact, 3D": "linear, 3D", names[2]: names[2], "boundary elements": "bem3d"}
    drawn(oscillation, columns, near)
    bars = {name: with_bars(contrast, name) for name in (names[0], names[2], "bem3d")}
    drawn(last, {"sin²(q a), (14.12)": names[1], **bars}, contrast)
    band = differences.collections[0].get_paths()[0].vertices[:, 1]
    assert (band.max(), band.min()) == pytest.approx((half.max(), -half.max()))


def test_lines_of_region_2():
    speeds = Made({"q_min v₀ / ω_eigen": [3.0, 2.0, 1.0]})
    tables = {f"plateau_of_{name}_waves": Made({"omega [rad/s]": [1.0, 2.0, 3.0]}) for name in ("short", "long")}
    spectra = Made({"q_min v₀ / ω_eigen": [3.0, 3.0, 1.0], "omega / omega_eigen": [1.0, 2.0, 1.0]})
    short, long, by_speed, valley = wheel_regions.draw(made(**tables, spectra=spectra, speeds=speeds)).axes
    columns = {"second-order force": "second order", "springs, steady-state": "steady-state"}
    tables["plateau_of_short_waves"].given["open"] = tables["plateau_of_short_waves"]["open"]
    drawn(long, columns, tables["plateau_of_long_waves"])
    drawn(short, columns, tables["plateau_of_short_waves"])
    a = spectra["A [(m/s2)2 s]"]
    drawn(by_speed, {"3": a[:2], "1": a[2:]})
    np.testing.assert_allclose(valley.get_lines()[0].get_ydata(), speeds["valley [dB]"])


def test_lines_of_rounds_and_of_lift_off():
    rounds = Made({"scheme": np.repeat(["velocity Verlet", "explicit Euler"], 3), "laps": [1.0, 2.0, 3.0] * 2})
    axis = plain_axis()
    wheel_stability._laps(axis, rounds)
    expected = {}
    for name in ("velocity Verlet", "explicit Euler"):
        mine = rounds.where(scheme=name)
        for what in ("free vibration", "mean square acceleration"):
            value = np.exp(mine[f"{what}, log over first tenth"])
            expected[f"{name}, {what}"] = value, (value * mine[f"{what}, half-width"],) * 2
    drawn(axis, expected)
    lift = Made({"sweep": np.repeat(["height", "load"], 3)})
    airborne, highest = plain_axis(), plain_axis()
    wheel_stability._lift(airborne, highest, lift)
    of = {sweep: lift.where(sweep=sweep) for sweep in ("height", "load")}
    in_the_air, forces = {}, {}
    for sweep, mine in of.items():
        in_the_air[f"{sweep} changed"] = mine["time airborne"]
        in_the_air[f"linear force below zero, {sweep}"] = mine["time airborne, linear"]
        forces[f"{sweep} changed"] = mine["highest force [F_N]"]
        forces[f"1 + largest linear tension, {sweep}"] = 1 + mine["deepest linear pull [F_N]"]
    drawn(airborne, in_the_air)
    drawn(highest, forces)


def plain_axis():
    return Figure().subplots()


def test_lines_of_iterations():
    keys = {"solver": np.repeat(["solve", "solve_polonsky_keer"], 4), "scene": np.tile(np.repeat(["a", "b"], 2), 2)}
    table = Made({**keys, "cells": [32, 64] * 4})
    residual = Made(keys)
    axes = limits.draw_solver(made(iterations=table, residual=residual)).axes
    pairs = [(solver, scene) for solver in ("solve", "solve_polonsky_keer") for scene in ("a", "b")]
    drawn(axes[0], {f"{v}, {s}": table.where(solver=v, scene=s)["iterations"] for v, s in pairs})
    for axis, measure in zip(axes[1:], ("load", "stiffness", "pressure"), strict=True):
        assert axis.get_title() == f"true error: {measure}"
        for line, (solver, scene) in zip(axis.get_lines(), pairs, strict=False):
            mine = residual.where(solver=solver, scene=scene)
            np.testing.assert_allclose(line.get_ydata(), mine[f"error of the {measure}"])
            assert look(line)[:3] == look(axes[0].get_lines()[pairs.index((solver, scene))])[:3]


@pytest.mark.slow
def test_marks_of_methods_are_those_of_the_legend():
    """Each line of a chart looks as its name does, and no two names look alike."""
    methods = list(precision.STYLES)
    size = 2 * len(methods)
    keys = {"scene": ["s"] * size, "quantity": ["force"] * size, "unit": ["%"] * size, "status": ["finished"] * size}
    yes = np.tile([True, False], len(methods))
    table = Made({**keys, "method": np.repeat(methods, 2), "front": yes, "reference itself": ~yes & False})
    table.given["error"] = table["median [s]"] * 0 + np.linspace(0.01, 0.2, size)
    table.given["lower quartile [s]"] = 0.9 * table["median [s]"]
    table.given["upper quartile [s]"] = 1.2 * table["median [s]"]
    table.given["band"], table.given["± sample"] = np.full(size, 1e-4), np.full(size, 1e-3)
    axes = precision.draw(made(points=table)).axes
    legend = {h.get_label(): look(h) for h in axes[-1].get_legend().legend_handles}
    assert list(legend) == methods and len(set(legend.values())) == len(methods)
    bars = [c for c in axes[0].containers if isinstance(c, ErrorbarContainer)]
    for container, name in zip(bars, methods, strict=True):
        assert look(container.lines[0]) == legend[name]
        np.testing.assert_allclose(container.lines[0].get_ydata(), 100 * table.where(method=name)["error"])


def look(line):
    return line.get_color(), line.get_marker(), line.get_linestyle(), str(line.get_markerfacecolor())
