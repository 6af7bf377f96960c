"""The references of the judges from the folder of a full report: its numbers, and the few solves that it does not keep.

The report keeps no mean force by itself and no force position by position: springs roll over their tracks once more, and
boundary elements over three short strips. Both take minutes; finished solves are stored.
"""

import json
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from validation.analysis.contents import csv_name, from_csv
from validation.analysis.spectra import Bands
from validation.engine.engine import Engine
from validation.selection.judging.references import VALUES, Place, as_file, file_name
from validation.simulation.rolling_strip import (
    HERTZ,
    SMOOTH,
    RoughStrip,
    Strip,
    Tracks,
    level_3d,
    roll_strip,
    roll_tracks,
)
from validation.simulation.track_spectrum import PiecewisePowerLaw, self_affine
from validation.theory.rolling import force_variance

Rows = Iterator[dict[str, Place]]
BEM, SPRINGS_OVER, LINEAR_OVER = "bem3d", "springs over boundary elements", "linear theory, 3D over boundary elements"
FBAR, Q, BAND = "Fbar", "q a", "q_max / q_min"
HEIGHTS, CELLS, LENGTH, WIDTH, SEED = (0.03, 0.1, 0.3), (8, 24), 32.0, 16.0, 351
"""Of the strips for position by position: h/d; cells to a contact radius, an odd ratio, so that centres meet."""


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

    def rows(self, case: str, quantity: str, **equal: Place) -> list[dict[str, Any]]:
        table = from_csv(quantity, (self.folder / "data" / csv_name(case, quantity)).read_text("utf-8"))
        rows = [dict(zip(table.columns, row, strict=True)) for row in zip(*table.columns.values(), strict=True)]
        return [row for row in rows if equal.items() <= row.items()]


@dataclass(frozen=True)
class Source:
    """A file of references. unit; case: of the report; found: its rows."""

    unit: str
    case: str
    found: Callable[[Report, Engine], Rows]


def references_of(folder: Path, engine: Engine) -> dict[str, bytes]:
    """Contents of all files, by their names. Raises ValueError for what is no full report."""
    report = Report(folder)
    files = {}
    for quantity, source in SOURCES.items():
        head = {
            "quantity": quantity,
            "unit": source.unit,
            "case": source.case,
            "commit": report.commit(source.case),
            "settings": report.settings(source.case),
        }
        rows = [row for row in source.found(report, engine) if math.isfinite(float(row["value"]))]
        files[file_name(quantity)] = as_file(head, rows)
    return files


def _valued(value: float, sample: float, grid: float = math.nan) -> dict[str, Place]:
    return dict(zip(VALUES, (value, sample, grid), strict=True))


def _half(row: Mapping[str, Any]) -> float:
    return float(row["high"] - row["low"]) / 2


def _punch(statistic: str, ratio: str) -> Callable[[Report, Engine], Rows]:
    """Of Fig. 14.1: intervals of both methods are of the sample, that of their ratio has what the grids leave too."""

    def found(report: Report, _: Engine) -> Rows:
        case = "fractal_punch"
        band = float(report.settings(case)["cells"] // 4)
        mine, springs = (
            {(row["H"], row[FBAR]): row for row in report.rows(case, statistic, model=model)} for model in (BEM, "mdr")
        )
        for row in report.rows(case, ratio, model=SPRINGS_OVER):
            key = row["H"], row[FBAR]
            value = mine[key]["value"]
            own, others = (_log_half(one[key]) for one in (mine, springs))
            grid = max(_log_half(row) - math.hypot(own, others), 0.0)
            yield {"H": key[0], BAND: band, FBAR: key[1], **_valued(value, value * own, value * grid)}

    return found


def _log_half(row: Mapping[str, Any]) -> float:
    """Of springs in full contact, which do not scatter, none."""
    return math.log(row["high"] / row["low"]) / 2 if row["low"] > 0 else 0.0


def _by_band(report: Report, _: Engine) -> Rows:
    for row in report.rows("bandwidth", "relative deviation", model=BEM):
        yield {name: row[name] for name in ("H", FBAR, BAND)} | _valued(row["value"], _half(row))


def _interface(report: Report, _: Engine) -> Rows:
    names = ["q_r L / 2π", "H", "contact in Persson's theory [%]"]
    for row in report.rows("interface", "K h over p", model=BEM):
        yield {name: float(row[name]) for name in names} | _valued(row["value"], _half(row))


def _spectrum(settings: Mapping[str, Any]) -> PiecewisePowerLaw:
    return self_affine(settings["hurst"], settings["first"], settings["last"])


def _bands(settings: Mapping[str, Any]) -> Bands:
    return Bands.around(math.pi, settings["lowest"], settings["last"]).on(settings["length"])


def _at(row: Mapping[str, Any]) -> dict[str, Place]:
    return {name: float(row[name]) for name in ("h/d", "h' a/d")}


def _levels(report: Report, _: Engine) -> Rows:
    """Of octaves: linear theory on the half-space less what it is over boundary elements."""
    settings = report.settings("rolling")
    bands = _bands(settings)
    exact = level_3d(_spectrum(settings), bands)
    for row in report.rows("rolling", "level of an octave", model=LINEAR_OVER):
        middle = int(np.argmin(np.abs(np.log(bands.centres / row[Q]))))
        level = 10 * math.log10(exact[middle - 1 : middle + 2].sum()) - row["value"]
        yield _at(row) | {Q: float(row[Q])} | _valued(level, _half(row))


def _rms(report: Report, _: Engine) -> Rows:
    spectrum = _spectrum(report.settings("rolling"))
    variance = force_variance(spectrum.c2d, edges=spectrum.edges, contact_radius=1.0, modulus=1.0) / HERTZ**2
    for row in report.rows("rolling", "rms force", model=LINEAR_OVER):
        yield _reversed(row) | _valued(10 * math.log10(variance) - row["value"], _half(row))


def _reversed(row: Mapping[str, Any]) -> dict[str, Place]:
    """The slope first, so that the height is the parameter."""
    return dict(reversed(_at(row).items()))


def _mean(report: Report, engine: Engine) -> Rows:
    settings = report.settings("rolling")
    rows = report.rows("rolling", "mean force", model=SPRINGS_OVER)
    of_strip = {name: settings[name] for name in ("length", "width", "seed")}
    tracks = [
        Tracks(
            scene=RoughStrip(spectrum=_spectrum(settings), height=row["h/d"], **of_strip),
            input_spectrum="geike",
            realisations=settings["tracks"],
            springs=settings["springs"],
            bands=_bands(settings),
        )
        for row in rows
    ]
    for row, springs in zip(rows, engine.map(roll_tracks, tracks), strict=True):
        mean = float(springs["mean"].mean()) / 10 ** (row["value"] / 20)
        yield _reversed(row) | _valued(mean, mean * math.log(10) / 20 * _half(row))


def stored_strip(height: float) -> RoughStrip:
    """The strip for position by position, of rms height h/d."""
    return RoughStrip(spectrum=self_affine(0.7, 1.0, 10.0), height=height, length=LENGTH, width=WIDTH, seed=SEED)


def _positions(_: Report, engine: Engine) -> Rows:
    """The force at each position of the coarse grid, to first order on cells of no size."""
    coarse, fine = CELLS
    problems = {(h, n): stored_strip(h).strips(n, 1e-4 * h, 1) for h in HEIGHTS for n in CELLS}
    force = {key: one[0]["force"] for key, one in engine.map_groups(roll_strip, problems).items()}
    times = fine // coarse
    for h in HEIGHTS:
        at_coarse = force[h, fine][times // 2 :: times]
        left = (at_coarse - force[h, coarse]) / (times - 1)
        for i, (value, change) in enumerate(zip((at_coarse + left).tolist(), left.tolist(), strict=True)):
            yield {"h/d": h, "x / a": (i + 0.5) / coarse} | _valued(value, 0.0, abs(change))


def _filters(report: Report, _: Engine) -> Rows:
    alpha = {"ridges": 0.0, "isotropic ground": math.inf}
    for row in report.rows("across", "A3", model="boundary elements"):
        load, diameter = (float(word.split()[0]) for word in row["wheel"].split(", "))
        across = alpha[row["across"]] if row["across"] in alpha else float(row["across"].split(" = ")[1])
        place = {"load [kN]": load, "diameter [mm]": diameter, "over ISO 3095 [dB]": float(row["over ISO 3095 [dB]"])}
        yield {**place, "alpha": across, "wavelength [mm]": float(row["wavelength [mm]"])} | _valued(
            row["value"], _half(row)
        )


FEATURES = ("peak ω_eigen", "jump", "slope of region 3", "period of the oscillation")


def _features(report: Report, _: Engine) -> Rows:
    for number, name in enumerate(FEATURES):
        (row,) = report.rows("wheel", name, changed="nothing")
        yield {"feature": name, "number": float(number)} | _valued(row["value"], _half(row))


SOURCES: Mapping[str, Source] = {
    "mean stiffness": Source("k / (E* L)", "fractal_punch", _punch("k / (E* L)", "mean stiffness")),
    "deviation of the stiffness": Source(
        "over the mean", "fractal_punch", _punch("relative deviation of k", "relative deviation")
    ),
    "deviation of the stiffness by bandwidth": Source("over the mean", "bandwidth", _by_band),
    "stiffness of an interface": Source("K h / p", "interface", _interface),
    "force level": Source("dB, over F_Hertz^2 (h/d)^2, of an octave", "rolling", _levels),
    "rms force": Source("dB, over F_Hertz^2 (h/d)^2", "rolling", _rms),
    "mean force": Source("over F_Hertz", "rolling", _mean),
    "force at a position": Source("over F_Hertz", "rolling", _positions),
    "contact filter": Source("dB, A3", "across", _filters),
    "feature of the wheel": Source("rad/s, but for the slope", "wheel", _features),
}
