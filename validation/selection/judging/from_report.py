"""The references of the judges, from the folder of a full report and a few solves that it does not keep.

It keeps no mean force by itself and no force position by position: springs roll over their tracks once more, and
boundary elements over three short strips and press some surfaces. That takes minutes; finished solves are stored.
"""

import json
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from scipy.special import erfinv

import bem3d
from validation.analysis.contents import csv_name, from_csv
from validation.analysis.statistics import DECIBEL
from validation.engine.engine import Engine, Outcome
from validation.scenes.dynamic_wheel import load_wheel_scene
from validation.selection.judging import surfaces
from validation.selection.judging.filters import ALPHA, DIAMETER, FILTER, LOAD, OFFSET, WAVE
from validation.selection.judging.laws import FEATURE, REGION, ends_of
from validation.selection.judging.references import Reference, as_file, file_name
from validation.selection.judging.rolling import ACROSS, ALONG, EACH, GRIDS, HEIGHTS, LIFT, SEED, strip_of
from validation.selection.judging.spectra import HEIGHT, LEVEL, MEAN, RMS, SLOPE, bands_of, spectrum_of, variance_of
from validation.simulation.model_names import BEM, FILTER_3D, SPRINGS
from validation.simulation.rolling_strip import (
    HERTZ,
    RoughStrip,
    Strip,
    Tracks,
    crop_to_reach,
    level_3d,
    roll_strip,
    roll_tracks,
)
from validation.simulation.track_spectrum import PiecewisePowerLaw

Rows = Iterator[Reference]
SPRINGS_OVER, LINEAR_OVER = (f"{model} over {BEM}" for model in (SPRINGS, FILTER_3D))
FBAR, Q, BAND, ROLL_OFF = "Fbar", "q a", "q_max / q_min", "q_r L / 2π"
FORMER = {"bem3d": BEM, "mdr": SPRINGS, f"linear theory, 3D over {BEM}": LINEAR_OVER, "nothing": "unchanged"}
"""Words of reports that were made before each thing had one name."""
TENTH = 1.2816
"""Of a Gaussian, its deviations to the highest tenth."""
FEATURES = ("peak ω_eigen", "jump", "slope of region 3", "period of the oscillation")


@dataclass(frozen=True)
class Report:
    """The folder of a full report. Raises ValueError for another folder."""

    folder: Path

    def __post_init__(self) -> None:
        if not (self.folder / "results.json").exists() or self._results["profile"] != "full":
            raise ValueError(f"--references needs the folder of a full report, got {self.folder}")

    @cached_property
    def _results(self) -> dict[str, Any]:
        return dict(json.loads((self.folder / "results.json").read_text("utf-8")))

    def settings(self, case: str) -> dict[str, Any]:
        return dict(self._results["cases"][case]["settings"])

    def commit(self, case: str) -> str:
        """Of the code that made the case, which a later report may have kept."""
        about = json.loads((self.folder / "provenance.json").read_text("utf-8"))
        return str(about.get("kept", {}).get(case, about["commit"]))

    def rows(self, case: str, quantity: str, **equal: float | str) -> list[dict[str, Any]]:
        table = from_csv(quantity, (self.folder / "data" / csv_name(case, quantity)).read_text("utf-8"))
        cells = zip(*table.columns.values(), strict=True)
        named = [[FORMER.get(cell, cell) if isinstance(cell, str) else cell for cell in row] for row in cells]
        rows = [dict(zip(table.columns, row, strict=True)) for row in named]
        found = [row for row in rows if equal.items() <= row.items()]
        if not found:
            raise ValueError(f"--references needs a report with {quantity!r} of {case}, got {self.folder} without it")
        return found


@dataclass(frozen=True)
class ReferenceFile:
    """unit; case: of the report; found: its rows; settings: of solves that the report does not have."""

    unit: str
    case: str
    found: Callable[[Report, Engine], Rows]
    settings: Mapping[str, Any] | None = None

    def head(self, report: Report) -> dict[str, Any]:
        if self.settings is not None:
            return {"case": self.case, "commit": "as this file", "settings": dict(self.settings)}
        return {"case": self.case, "commit": report.commit(self.case), "settings": report.settings(self.case)}


def references_of(folder: Path, engine: Engine) -> dict[str, bytes]:
    """Contents of all files, by their names. Raises ValueError for what is no full report."""
    report, files = Report(folder), {}
    for quantity, source in SOURCES.items():
        rows = [row for row in source.found(report, engine) if math.isfinite(row.value)]
        files[file_name(quantity)] = as_file({"quantity": quantity, "unit": source.unit, **source.head(report)}, rows)
    return files


def _half(row: Mapping[str, Any]) -> float:
    return float(row["high"] - row["low"]) / 2


def _log_half(row: Mapping[str, Any]) -> float:
    """Of a logarithm; of springs in full contact, which do not scatter, none."""
    return math.log(row["high"] / row["low"]) / 2 if row["low"] > 0 else 0.0


def _punch(statistic: str, ratio: str) -> Callable[[Report, Engine], Rows]:
    """Of Fig. 14.1: intervals of both methods are of the sample, that of their ratio has what the grids leave too."""

    def found(report: Report, _: Engine) -> Rows:
        mine, springs = (
            {(row["H"], row[FBAR]): row for row in report.rows("fractal_punch", statistic, model=model)}
            for model in (BEM, SPRINGS)
        )
        for row in report.rows("fractal_punch", ratio, model=SPRINGS_OVER):
            key = row["H"], row[FBAR]
            own, others = (_log_half(one[key]) for one in (mine, springs))
            grid = max(_log_half(row) - math.hypot(own, others), 0.0)
            yield Reference({"H": key[0], FBAR: key[1]}, mine[key]["value"], own, grid)

    return found


def _rolled_off(report: Report, _: Engine) -> Rows:
    """Of the punch of the case interface, whose loads are those of contact fractions in Persson's theory."""
    settings = report.settings("interface")
    waves, hurst = settings["pressed"]
    edges = tuple(2 * math.pi * q for q in (1, waves, settings["band"] * waves))
    gradient = PiecewisePowerLaw(edges=edges, exponents=(0.0, 2 * hurst + 2)).gradient
    for row in report.rows("interface", "k h over F", model=f"{BEM}, punch"):
        force = gradient * float(erfinv(row["contact in Persson's theory [%]"] / 100)) / math.sqrt(2)
        where = {"H": hurst, ROLL_OFF: float(waves), FBAR: force}
        yield Reference(where, force * row["value"], _log_half(row), 0.0)


def _by_band(report: Report, _: Engine) -> Rows:
    """But for the band of Fig. 14.1."""
    known = report.settings("fractal_punch")["cells"] // 4
    for row in report.rows("bandwidth", "relative deviation", model=BEM):
        if row[BAND] != known:
            where = {name: float(row[name]) for name in ("H", FBAR, BAND)}
            yield Reference(where, row["value"], _log_half(row), 0.0)


def _interface(report: Report, _: Engine) -> Rows:
    for row in report.rows("interface", "K h over p", model=BEM):
        where = {name: float(row[name]) for name in (ROLL_OFF, "H", "contact in Persson's theory [%]")}
        yield Reference(where, row["value"], _log_half(row), 0.0)


def _levels(report: Report, _: Engine) -> Rows:
    """Of octaves: linear theory on the half-space less what it is over boundary elements."""
    settings = report.settings("rolling")
    bands = bands_of(settings)
    exact = level_3d(spectrum_of(settings), bands)
    for row in report.rows("rolling", "level of an octave", model=LINEAR_OVER):
        middle = int(np.argmin(np.abs(np.log(bands.centres / row[Q]))))
        level = 10 * math.log10(exact[middle - 1 : middle + 2].sum()) - row["value"]
        yield Reference({**_at(row), Q: row[Q]}, level, _half(row), 0.0)


def _at(row: Mapping[str, Any]) -> dict[str, float]:
    return {name: float(row[name]) for name in (HEIGHT, SLOPE)}


def _rms(report: Report, _: Engine) -> Rows:
    variance = variance_of(spectrum_of(report.settings("rolling")))
    for row in report.rows("rolling", "rms force", model=LINEAR_OVER):
        yield Reference(_at(row), 10 * math.log10(variance) - row["value"], _half(row), 0.0)


def _mean(report: Report, engine: Engine) -> Rows:
    """The springs of the case over what they are over boundary elements."""
    settings, rows = report.settings("rolling"), report.rows("rolling", "mean force", model=SPRINGS_OVER)
    of_strip = {name: settings[name] for name in ("length", "width", "seed")}
    tracks = [
        Tracks(
            scene=RoughStrip(spectrum=spectrum_of(settings), height=row[HEIGHT], **of_strip),
            input_spectrum="geike",
            realisations=settings["tracks"],
            springs=settings["springs"],
            bands=bands_of(settings),
        )
        for row in rows
    ]
    for row, springs in zip(rows, engine.map(roll_tracks, tracks), strict=True):
        yield Reference(_at(row), float(springs["mean"].mean()) / 10 ** (row["value"] / 20), _half(row) / DECIBEL, 0.0)


def roll_under_load(strip: Strip) -> Outcome:
    """Boundary elements under the load of Hertz: the approach over d; failed: positions that did not converge."""
    seen, spacing = crop_to_reach(strip.surface(), 1 / strip.cells), 1 / strip.cells
    wheel: dict[str, Any] = {"radius": 1.0, "modulus": 1.0, "force": HERTZ}
    found = bem3d.roll(seen, spacing=spacing, tolerance=strip.tolerance, raise_on_failure=False, **wheel)
    return {"approach": found.approach, "failed": np.array(float(np.count_nonzero(~found.converged)))}


def _positions(name: str, solve: Callable[[Strip], Outcome]) -> Callable[[Report, Engine], Rows]:
    """At each position of the coarse grid, to first order on cells of no size, and as much is left."""

    def found(_: Report, engine: Engine) -> Rows:
        coarse, fine = GRIDS
        problems = {(h, n): strip_of(h).strips(n, 1e-4 * h, 1) for h in HEIGHTS for n in GRIDS}
        on = {key: one[0][name] for key, one in engine.map_groups(solve, problems).items()}
        for h in HEIGHTS:
            there = on[h, fine][fine // coarse // 2 :: fine // coarse]
            left = (there - on[h, coarse]) / (fine // coarse - 1)
            for i, (value, change) in enumerate(zip((there + left).tolist(), left.tolist(), strict=True)):
                yield Reference({HEIGHT: h, "x / a": (i + 0.5) / coarse}, value, 0.0, abs(change / value))

    return found


def _filters(report: Report, _: Engine) -> Rows:
    """alpha: zero of ridges, infinite of isotropic ground."""
    alpha = {"ridges": 0.0, "isotropic ground": math.inf}
    for row in report.rows("across", "A3", model=BEM):
        load, diameter = (float(word.split()[0]) for word in row["wheel"].split(", "))
        across = alpha[row["across"]] if row["across"] in alpha else float(row["across"].split(" = ")[1])
        where = {LOAD: load, DIAMETER: diameter, OFFSET: float(row[OFFSET]), ALPHA: across, WAVE: float(row[WAVE])}
        yield Reference(where, row["value"], _half(row), 0.0)


def _features(report: Report, _: Engine) -> Rows:
    for name in FEATURES:
        (row,) = report.rows("wheel", name, changed="unchanged")
        yield Reference({"feature": name}, row["value"], abs(_half(row) / row["value"]), 0.0)


def _regions(report: Report, _: Engine) -> Rows:
    """Of springs without a window; the sample by the lowest and the highest tenth of the wheels, as if Gaussian."""
    curves = {}
    for model in ("no window, (14.17)", "lowest tenth of wheels", "highest tenth of wheels"):
        rows = report.rows("wheel", "A in twelfths of an octave", model=model)
        curves[model] = np.array([row["value"] for row in rows])
        centres = np.array([row["ω [rad/s]"] for row in rows])
    mean, lowest, highest = curves.values()
    spread = 10 * np.log10(highest / lowest) / (2 * TENTH) / math.sqrt(report.settings("wheel")["realisations"])
    for name, (first, last) in ends_of(load_wheel_scene("table_14_1")).items():
        inside = (centres > first) & (centres < last)
        half = 1.96 * float(np.mean(spread[inside]))
        yield Reference({"region": name}, float(np.mean(10 * np.log10(mean[inside]))), half, 0.0)


def _surfaces(_: Report, engine: Engine) -> Rows:
    yield from surfaces.solved(engine)


OF_STRIPS = {"heights": HEIGHTS, "cells": GRIDS, "length": ALONG, "width": ACROSS, "seed": SEED}
OF_SURFACES = {
    "hursts": surfaces.HURSTS,
    "surfaces": surfaces.SURFACES,
    "cells": surfaces.CELLS,
    "seed": surfaces.SEED,
    "tolerance": surfaces.TOLERANCE,
}
SOURCES: Mapping[str, ReferenceFile] = {
    "mean stiffness": ReferenceFile("k / (E* L)", "fractal_punch", _punch("k / (E* L)", "mean stiffness")),
    "deviation of the stiffness": ReferenceFile(
        "over the mean", "fractal_punch", _punch("relative deviation of k", "relative deviation")
    ),
    "mean stiffness with a roll-off": ReferenceFile("k / (E* L)", "interface", _rolled_off),
    "deviation of the stiffness, by bandwidth": ReferenceFile("over the mean", "bandwidth", _by_band),
    "stiffness of an interface": ReferenceFile("K h / p", "interface", _interface),
    LEVEL: ReferenceFile("dB, over F_Hertz^2 (h/d)^2, of an octave", "rolling", _levels),
    RMS: ReferenceFile("dB, over F_Hertz^2 (h/d)^2", "rolling", _rms),
    MEAN: ReferenceFile("over F_Hertz", "rolling", _mean),
    EACH: ReferenceFile("over F_Hertz", "judging/rolling", _positions("force", roll_strip), OF_STRIPS),
    LIFT: ReferenceFile("over d", "judging/rolling", _positions("approach", roll_under_load), OF_STRIPS),
    surfaces.OF_SURFACE: ReferenceFile("k / (E* L)", "judging/surfaces", _surfaces, OF_SURFACES),
    FILTER: ReferenceFile("dB, A3", "across", _filters),
    FEATURE: ReferenceFile("rad/s, but for the slope", "wheel", _features),
    REGION: ReferenceFile("dB re 1 (m/s^2)^2 s", "wheel", _regions),
}
