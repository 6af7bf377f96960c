"""The references of the judges, from the folder of a full report and a few solves that it does not keep.

It keeps no mean force by itself and no force position by position: springs roll over their tracks once more, and
boundary elements over three short strips and press some surfaces. That takes minutes; finished solves are stored.
"""

import json
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.special import erfinv

import bem3d
from validation.analysis.contents import csv_name, from_csv
from validation.analysis.statistics import DECIBEL
from validation.cases.punch.interface import Interface
from validation.cases.wheel import ensembles
from validation.engine.engine import Engine, Outcome
from validation.engine.files import place_in
from validation.judging.judgement import DEVIATION
from validation.judging.kinds import held_out_points, interfaces, own, rolling, stiffness
from validation.judging.kinds.held_out_points import OF_FACES, OF_POSITIONS, OF_PUNCHES, held_out
from validation.judging.kinds.interfaces import CONTACT
from validation.judging.kinds.laws import FEATURE, REGION, by_region
from validation.judging.kinds.references import Reference, as_file, file_name, rows_of
from validation.judging.kinds.rolling import ALPHA, DIAMETER, FILTER, HEIGHT, LOAD, OFFSET, SLOPE, WAVE, Q
from validation.judging.kinds.stiffness import BAND, FORCE, ROLL_OFF, H
from validation.scenes.load import load_scene_with_track
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

Row = Mapping[str, Any]
Find = Callable[["Report", Engine], Iterable[Reference]]
SPRINGS_OVER = f"{SPRINGS} over {BEM}"
TENTH = 1.2816
"""Of a Gaussian, its deviations to the highest tenth."""
FEATURES = tuple(ensembles.QUANTITIES.values())


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
        table = from_csv(quantity, place_in(self.folder / "data", csv_name(case, quantity)).read_text("utf-8"))
        if rows := [row for row in rows_of(table) if equal.items() <= row.items()]:
            return rows
        raise ValueError(f"--references needs a report with {quantity!r} of {case}, got {self.folder} without it")

    def references(self, case: str, quantity: str, *names: str, model: str = BEM) -> list[Reference]:
        """Rows of a model, under the conditions that these columns name."""
        rows = self.rows(case, quantity, model=model)
        return [Reference({name: float(row[name]) for name in names}, row["value"], _log_half(row)) for row in rows]


class ReferenceFile(NamedTuple):
    """unit; case: of the report; find: its rows; settings: of solves that the report does not have."""

    unit: str
    case: str
    find: Find
    settings: Mapping[str, Any] | None = None


def references_of(folder: Path, engine: Engine) -> dict[str, bytes]:
    """Contents of all files, by their names. Raises ValueError for what is no full report."""
    report, files = Report(folder), {}
    for quantity, (unit, case, find, settings) in SOURCES.items():
        rows = [row for row in find(report, engine) if math.isfinite(row.value)]
        commit = "as this file" if settings is not None else report.commit(case)
        head = {"quantity": quantity, "unit": unit, "case": case, "commit": commit}
        about = settings if settings is not None else report.settings(case)
        files[file_name(quantity)] = as_file({**head, "settings": about}, rows)
    return files


def _half(row: Row) -> float:
    return float(row["high"] - row["low"]) / 2


def _log_half(row: Row) -> float:
    """Of a logarithm; of springs in full contact, which do not scatter, none."""
    return math.log(row["high"] / row["low"]) / 2 if row["low"] > 0 else 0.0


def _punch(statistic: str, ratio: str) -> Find:
    """Of Fig. 14.1: intervals of both methods are of the sample, that of their ratio has what the grids leave too."""

    def find(report: Report, _: Engine) -> Iterator[Reference]:
        case, where = "fractal_punch", (H, FORCE)
        boundary_elements = {(row[H], row[FORCE]): row for row in report.references(case, statistic, *where)}
        springs = {(row[H], row[FORCE]): row for row in report.references(case, statistic, *where, model=SPRINGS)}
        for row in report.references(case, ratio, *where, model=SPRINGS_OVER):
            reference = boundary_elements[key := (row[H], row[FORCE])]
            yield replace(reference, grid=max(row.sample - math.hypot(reference.sample, springs[key].sample), 0.0))

    return find


def _rolled_off(report: Report, _: Engine) -> Iterator[Reference]:
    """Of the punch of the case interface, whose loads are those of contact fractions in Persson's theory."""
    settings = report.settings("interface")
    waves, hurst = settings["pressed"]
    edges = tuple(2 * math.pi * q for q in (1, waves, settings["band"] * waves))
    gradient = PiecewisePowerLaw(edges=edges, exponents=(0.0, 2 * hurst + 2)).gradient
    for row in report.references("interface", "k_h_over_F", CONTACT, model=f"{BEM}, punch"):
        force = gradient * float(erfinv(row[CONTACT] / 100)) / math.sqrt(2)
        yield replace(row, where={H: hurst, ROLL_OFF: float(waves), FORCE: force}, value=force * row.value)


def _interface(quantity: str) -> Find:
    return lambda report, _: report.references("interface", quantity, ROLL_OFF, H, CONTACT)


def _areas(report: Report, _: Engine) -> Iterator[Reference]:
    """A / L^2, of which the report has A E* g / (L^2 p) with the rms gradient g of the drawn surfaces."""
    settings = report.settings("interface")
    case = Interface(**{name: _frozen(value) for name, value in settings.items()})
    for row in report.references("interface", "A_E_g_over_p", ROLL_OFF, H, CONTACT):
        ground, load = (round(row[ROLL_OFF]), row[H]), case.per_cent.index(row[CONTACT])
        pressure = case.height * float(case.pressures(ground)[load])
        yield replace(row, value=row.value * pressure / case.drawn(ground).gradient)


def _frozen(value: Any) -> Any:
    """Lists of JSON as the tuples that they were."""
    return tuple(map(_frozen, value)) if isinstance(value, list) else value


def _by_band(report: Report, _: Engine) -> Iterator[Reference]:
    """But for the band of Fig. 14.1."""
    rows = report.references("bandwidth", "relative_deviation", H, FORCE, BAND)
    return (row for row in rows if row[BAND] != stiffness.WAVES)


def _levels(report: Report, _: Engine) -> Iterator[Reference]:
    """Of octaves."""
    bands = rolling.bands_of(settings := report.settings("rolling"))
    exact = level_3d(rolling.spectrum_of(settings), bands)
    return _over_linear(report, "level_of_an_octave", lambda row: float(rolling.octave(exact, bands, row[Q])), Q)


def _rms(report: Report, _: Engine) -> Iterator[Reference]:
    variance = rolling.variance_of(rolling.spectrum_of(report.settings("rolling")))
    return _over_linear(report, "rms_force", lambda row: variance)


def _over_linear(report: Report, quantity: str, power: Callable[[Row], float], *names: str) -> Iterator[Reference]:
    """Levels, of which the report has how far linear theory on the half-space, with this power, is above them."""
    for row in report.rows("rolling", quantity, model=f"{FILTER_3D} over {BEM}"):
        where = {name: row[name] for name in (HEIGHT, SLOPE, *names)}
        yield Reference(where, 10 * math.log10(power(row)) - row["value"], _half(row))


def _mean(report: Report, engine: Engine) -> Iterator[Reference]:
    """The springs of the case over what they are over boundary elements."""
    settings, rows = report.settings("rolling"), report.rows("rolling", "mean_force", model=SPRINGS_OVER)
    of = {"spectrum": rolling.spectrum_of(settings), **{name: settings[name] for name in ("length", "width", "seed")}}
    how = {"realisations": settings["tracks"], "springs": settings["springs"], "bands": rolling.bands_of(settings)}
    tracks = [Tracks(scene=RoughStrip(height=row[HEIGHT], **of), input_spectrum="geike", **how) for row in rows]
    for row, springs in zip(rows, engine.map(roll_tracks, tracks), strict=True):
        value = float(springs["mean"].mean()) / 10 ** (row["value"] / 20)
        yield Reference({name: float(row[name]) for name in (HEIGHT, SLOPE)}, value, _half(row) / DECIBEL)


def roll_under_load(strip: Strip) -> Outcome:
    """Boundary elements under the load of Hertz: the approach over d; failed: positions that did not converge."""
    seen, spacing = crop_to_reach(strip.surface(), 1 / strip.cells), 1 / strip.cells
    wheel: dict[str, Any] = {"radius": 1.0, "modulus": 1.0, "force": HERTZ}
    rolled = bem3d.roll(seen, spacing=spacing, tolerance=strip.tolerance, raise_on_failure=False, **wheel)
    return {"approach": rolled.approach, "failed": np.array(float(np.count_nonzero(~rolled.converged)))}


def _positions(name: str, solve: Callable[[Strip], Outcome]) -> Find:
    """See `rolling.at_positions`."""

    def find(_: Report, engine: Engine) -> Iterator[Reference]:
        problems = {(h, n): rolling.strip_of(h).strips(n, 1e-4 * h, 1) for h in rolling.HEIGHTS for n in rolling.GRIDS}
        on = {key: outcomes[0][name] for key, outcomes in engine.map_groups(solve, problems).items()}
        for h in rolling.HEIGHTS:
            yield from rolling.at_positions({HEIGHT: h}, *(on[h, cells] for cells in rolling.GRIDS))

    return find


def _filters(report: Report, _: Engine) -> Iterator[Reference]:
    """alpha: zero of ridges, infinite of isotropic ground."""
    alpha = {"ridges": 0.0, "isotropic ground": math.inf}
    for row in report.rows("across", "A3", model=BEM):
        load, diameter = (float(word.split()[0]) for word in row["wheel"].split(", "))
        across = alpha[row["across"]] if row["across"] in alpha else float(row["across"].split(" = ")[1])
        where = {LOAD: load, DIAMETER: diameter, OFFSET: float(row[OFFSET]), ALPHA: across, WAVE: float(row[WAVE])}
        yield Reference(where, row["value"], _half(row))


def _features(report: Report, _: Engine) -> Iterator[Reference]:
    """Of the scene itself, which comes first."""
    for name in FEATURES:
        row = report.rows("wheel", name)[0]
        yield Reference({"feature": name}, row["value"], abs(_half(row) / row["value"]))


def _regions(report: Report, _: Engine) -> Iterator[Reference]:
    """Of springs without a window; the sample by the lowest and the highest tenth of the wheels, as if Gaussian."""
    models = ("no window, (14.17)", "lowest tenth of wheels", "highest tenth of wheels")
    rows = [report.rows("wheel", "A_in_twelfths_of_an_octave", model=model) for model in models]
    level, lowest, highest = 10 * np.log10([[row["value"] for row in rows_of_model] for rows_of_model in rows])
    omega = np.array([row["ω [rad/s]"] for row in rows[0]])
    half = 1.96 * (highest - lowest) / (2 * TENTH) / math.sqrt(report.settings("wheel")["realisations"])
    levels, halves = (by_region(load_scene_with_track("table_14_1"), omega, values) for values in (level, half))
    return (Reference({"region": name}, levels[name], halves[name]) for name in levels)


OF_STRIPS = {
    "heights": rolling.HEIGHTS,
    "cells": rolling.GRIDS,
    "length": rolling.ALONG,
    "width": rolling.ACROSS,
    "seed": rolling.SEED,
}
OF_SURFACES = {name: getattr(stiffness, name.upper()) for name in ("hursts", "surfaces", "cells", "seed", "tolerance")}
_file, _UNIT = ReferenceFile, "dB, over F_Hertz^2 (h/d)^2"


def _solved(solve: held_out_points.Solve) -> Find:
    """Without a report."""
    return lambda report, engine: solve(engine)


HELD_OUT: Mapping[str, ReferenceFile] = {
    held_out(stiffness.MEAN): _file("k / (E* L)", "judging/held out", _solved(held_out_points.pressed), OF_PUNCHES),
    held_out(stiffness.OF_SURFACE): _file("k / (E* L)", "judging/held out", _solved(held_out_points.faces), OF_FACES),
    held_out(rolling.LEVEL): _file(
        f"{_UNIT}, of an octave",
        "judging/held out",
        _solved(held_out_points.of_octaves),
        held_out_points.OF_STRIPS,
    ),
    held_out(rolling.RMS): _file(
        _UNIT, "judging/held out", _solved(held_out_points.of_variance), held_out_points.OF_STRIPS
    ),
    held_out(rolling.EACH): _file(
        "over F_Hertz", "judging/held out", _solved(held_out_points.at_positions(by_load=False)), OF_POSITIONS
    ),
    held_out(rolling.LIFT): _file(
        "over d", "judging/held out", _solved(held_out_points.at_positions(by_load=True)), OF_POSITIONS
    ),
}
"""Between and beside the tables."""
SOURCES: Mapping[str, ReferenceFile] = {
    stiffness.MEAN: _file("k / (E* L)", "fractal_punch", _punch("k_E_L", "mean_stiffness")),
    stiffness.DEVIATION: _file(DEVIATION, "fractal_punch", _punch("relative_deviation_of_k", "relative_deviation")),
    stiffness.ROLLED_OFF: _file("k / (E* L)", "interface", _rolled_off),
    stiffness.BY_BAND: _file(DEVIATION, "bandwidth", _by_band),
    interfaces.STIFFNESS: _file("K h / p", "interface", _interface("K_h_over_p")),
    interfaces.GAP: _file("u / h", "interface", _interface("mean_gap_over_h")),
    interfaces.AREA: _file("A / L²", "interface", _areas),
    rolling.LEVEL: _file(f"{_UNIT}, of an octave", "rolling", _levels),
    rolling.RMS: _file(_UNIT, "rolling", _rms),
    rolling.MEAN: _file("over F_Hertz", "rolling", _mean),
    rolling.EACH: _file("over F_Hertz", "judging/rolling", _positions("force", roll_strip), OF_STRIPS),
    rolling.LIFT: _file("over d", "judging/rolling", _positions("approach", roll_under_load), OF_STRIPS),
    stiffness.OF_SURFACE: _file(
        "k / (E* L)", "judging/surfaces", lambda _, engine: stiffness.solved_surfaces(engine), OF_SURFACES
    ),
    FILTER: _file("dB, A3", "across", _filters),
    FEATURE: _file("rad/s, but for the slope", "wheel", _features),
    own.ERRORS: _file("over the reference, of levels in dB", "judging/own", lambda *_: own.errors(), {}),
    REGION: _file("dB re 1 (m/s^2)^2 s", "wheel", _regions),
    **HELD_OUT,
}
