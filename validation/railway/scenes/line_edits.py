"""What was wrong in measured lines, what was done about it, and the error in each band that this leaves."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from validation.analysis.nominal_bands import NominalBands
from validation.analysis.statistics import FloatArray
from validation.railway.scenes.line_bursts import MOST_OF_LINE, bursts_of, left_by_bursts
from validation.railway.scenes.line_outliers import WIDE, Outlier, interpolated, sensor_step, without_outliers
from validation.railway.scenes.line_steps import DRIFTS, MOST_STEPS, drift_of, points_of, runs_of, without_steps
from validation.scenes.units import in_unit

Outliers = Literal["remove", "keep"]
"""What is done about outliers."""
MOST_REPLACED, MOST_CLIPPED = 0.1, 0.01
"""Of the points of a line: beyond, what stood there is not known well enough for an error."""
SHIFTS = 24
"""Places along a line at which what replaces outliers is tried on points without any."""
OF_SHIFTS, WIDER = 1.5, 4
"""Error over the largest change of these trials; parts of its width by which an outlier may be wider than it was taken.
"""
BARELY, MISSED = 1.5, 0.1
"""Margin of outliers below which as many again may have been missed; share of the others that is."""
MOVED = ("step", "drift", "burst")
"""Kinds that leave all points where they are, but for a height; a burst is left as it was measured."""
DROPOUT, LEAST_DROPOUT = 3.0, 0.3e-3
"""Height of a dropout over the span of all else, and in metres, at the least: nothing on a rail is so high."""
SHOWN = 30
"""Places of outliers of one kind in a sentence."""
KINDS = {
    "spike": ("spike", "spikes"),
    "pit": ("pit", "pits"),
    "dropout": ("dropout", "dropouts"),
    "run": ("run of equal values", "runs of equal values"),
    "clipping": ("clipped part", "clipped parts"),
    "step": ("step", "steps"),
    "drift": ("drift", "drifts"),
    "burst": ("burst of noise", "bursts of noise"),
}
"""One and several of a kind."""


@dataclass(frozen=True, eq=False)
class EditedLine:
    """One line as it was measured and without its outliers [m], these, and which of its points they have."""

    height: FloatArray
    clean: FloatArray
    outliers: tuple[Outlier, ...]
    spacing: float

    @classmethod
    def of(cls, height: FloatArray, spacing: float) -> "EditedLine":
        """Runs and clipped parts are taken out first, then spikes and pits, then steps, which neither of them is.

        Bursts of noise come last; spikes and pits in them are part of them. Where too much of a line is gone, the rest
        is left as it is.
        """
        runs = runs_of(height)
        if (first := cls(height, height, runs, spacing)).unknown:
            return first
        sensor = sensor_step(height)
        solid = interpolated(height, points_of(runs, height.size))
        smooth, high = without_outliers(solid, spacing, sensor)
        clean, steps = without_steps(smooth, spacing, sensor)
        if bursts := bursts_of(clean, clean + solid - smooth, spacing, sensor):
            noisy = points_of(bursts, height.size)
            high = tuple(one for one in high if not noisy[one.first : one.last + 1].any())
            clean, steps = without_steps(np.where(points_of(high, height.size), smooth, solid), spacing, sensor)
        far, middle = max(DROPOUT * float(np.ptp(clean)), LEAST_DROPOUT), float(np.median(clean))
        named = [_named(one, abs(one.size) > far) for one in high]
        named += [_named(one, one.kind == "run" and abs(one.size - middle) > far) for one in runs]
        bend, over_rest = drift_of(clean)
        drift = [Outlier("drift", 0, clean.size - 1, float(np.ptp(bend)))] if over_rest > DRIFTS else []
        found = (*drift, *bursts, *steps, *sorted(named, key=lambda one: one.first))
        return cls(height, clean - bend if drift else clean, found, spacing)

    @property
    def replaced(self) -> NDArray[np.bool_]:
        """Points with a straight line in their place."""
        points = points_of(tuple(one for one in self.outliers if one.kind not in MOVED), self.height.size)
        for step in self.of_kind("step"):
            points[step.first + 1 : step.last] = True
        return points

    def of_kind(self, kind: str) -> list[Outlier]:
        return [one for one in self.outliers if one.kind == kind]

    @property
    def unknown(self) -> str:
        """Why no error is known; empty where one is."""
        clipped = points_of(tuple(self.of_kind("clipping")), self.height.size).mean()
        if clipped > MOST_CLIPPED:
            ends = " and ".join(sorted({in_unit(one.size, "length", digits=4) for one in self.of_kind("clipping")}))
            return f"clipped at {ends} in {100 * clipped:.3g} % of its points"
        if (share := self.replaced.mean()) > MOST_REPLACED:
            return f"none of a rail in {100 * share:.3g} % of its points"
        if (share := points_of(tuple(self.of_kind("burst")), self.height.size).mean()) > MOST_OF_LINE:
            return f"noisy in {100 * share:.3g} % of its points"
        steps = len(self.of_kind("step"))
        return f"broken by {steps} steps or more" if steps >= MOST_STEPS else ""

    def change(self, bands: NominalBands) -> FloatArray:
        """Half-width of 95 % of the mean squares in bands that the removal leaves [m^2].

        Each added linearly: `OF_SHIFTS` times the most that straight lines as many and as wide change elsewhere along
        the line; what changes where each outlier is taken for wider; what was missed; the spread of each step;
        the half-width of what bursts add.
        """
        powers = partial(self._powers, bands)
        own, replaced = powers(self.clean), self.replaced
        found = np.zeros(len(bands))
        if replaced.any():
            rolled = (np.roll(replaced, i * replaced.size // (SHIFTS + 1)) for i in range(1, SHIFTS + 1))
            elsewhere = [np.abs(powers(interpolated(self.clean, places)) - own) for places in rolled]
            wider = np.abs(powers(interpolated(self.clean, self._wider)) - own)
            found += OF_SHIFTS * np.max(elsewhere, axis=0) + wider + powers(self._missed)
        for step in self.of_kind("step"):
            residue = powers(np.where(np.arange(self.clean.size) >= step.last, step.spread, 0.0))
            found += residue + 2 * np.sqrt(residue * own)
        if self.of_kind("drift"):
            found += np.abs(powers(self.clean + drift_of(self.height)[0]) - own)
        if bursts := tuple(self.of_kind("burst")):
            added, half_width = left_by_bursts(self.clean, self.spacing, bursts, bands)
            found += own / (1 + added) * half_width
        return found

    def of_bursts(self, bands: NominalBands) -> FloatArray:
        """What bursts of noise, which are left in, add to the mean squares in bands [m^2]."""
        bursts = tuple(self.of_kind("burst"))
        if not bursts:
            return np.zeros(len(bands))
        added, _ = left_by_bursts(self.clean, self.spacing, bursts, bands)
        return self._powers(bands, self.clean) * added / (1 + added)

    def kept(self, bands: NominalBands) -> FloatArray:
        """What outliers that are kept change in the mean squares in bands [m^2]."""
        return self._powers(bands, self.height) - self._powers(bands, self.clean)

    def _powers(self, bands: NominalBands, line: FloatArray) -> FloatArray:
        return np.asarray(bands.powers_of_records(line, spacing=self.spacing))

    @property
    def _wider(self) -> NDArray[np.bool_]:
        """Points of outliers that are half as wide again."""
        points = self.replaced
        for one in self.outliers:
            if one.kind not in MOVED:
                more = max(1, (one.last - one.first + 1) // WIDER)
                points[max(0, one.first - more) : one.last + 1 + more] = True
        return points

    @property
    def _missed(self) -> FloatArray:
        """As much as may not have been found, as low as is just found.

        As many as there are of wide outliers and of those that barely were found, and a share of the others.
        """
        missed = np.zeros_like(self.clean)
        for one in self.outliers:
            if one.kind in ("spike", "pit", "dropout"):
                inside = slice(one.first, one.last + 1)
                wide = (one.last - one.first) * self.spacing > 2 * WIDE
                share = 1.0 if wide or one.margin < BARELY else math.sqrt(MISSED)
                missed[inside] = (self.height - self.clean)[inside] * share / max(1.0, one.margin)
        return missed


def _named(one: Outlier, far: bool) -> Outlier:
    return Outlier("dropout", one.first, one.last, one.size, one.margin) if far else one


@dataclass(frozen=True, eq=False, kw_only=True)
class LineEdits:
    """Lines that have outliers, by their number from zero, what was done about these, and what else is in doubt."""

    lines: tuple[tuple[int, EditedLine], ...] = ()
    outliers: Outliers = "remove"
    doubt: str = ""

    @property
    def fault(self) -> str:
        """Why no error of the levels is known; empty where one is."""
        unknown = [f"measured line {i + 1} is {line.unknown}" for i, line in self.lines if line.unknown]
        return "; ".join(filter(None, (*unknown, self.doubt)))

    def errors(self, bands: NominalBands, powers: FloatArray) -> tuple[float, ...]:
        """Half-width of 95 % of the levels of the mean of all lines [dB], none where no line has outliers.

        powers: mean squares of each line in each band, (lines, bands). Linear, since outliers raise all levels.
        """
        if self.fault:
            return (math.inf,) * len(bands)
        if not self.lines:
            return ()
        total = powers.sum(axis=0)
        change = np.sum([line.change(bands) for _, line in self.lines], axis=0)
        kept = np.sum([line.of_bursts(bands) for _, line in self.lines], axis=0)
        if self.outliers == "keep":
            kept = kept + np.sum([line.kept(bands) for _, line in self.lines], axis=0)
        clean = np.maximum(total - kept, 1e-300)
        return tuple((np.abs(10 * np.log10(total / clean)) + 10 * np.log10(1 + change / clean)).tolist())

    def result(self, height: FloatArray) -> FloatArray:
        """Lines of shape (points, lines) [m] as their levels are to have them, from those that were searched."""
        if self.outliers == "keep" or not self.lines:
            return height
        found = height.copy()
        for i, line in self.lines:
            found[:, i] = line.clean
        return found

    def notes(self, positions: Sequence[float]) -> tuple[str, ...]:
        """In sentences. positions: of the lines across the rail [m]."""
        return tuple(sentence for i, line in self.lines for sentence in self._of_line(_name(positions, i), line))

    def _of_line(self, name: str, line: EditedLine) -> Iterator[str]:
        for kind, (one, several) in KINDS.items():
            those = line.of_kind(kind)
            if not those:
                continue
            count = f"{len(those)} {one if len(those) == 1 else several}"
            if kind == "drift":
                size = in_unit(those[0].size, "length", digits=3)
                yield f"{name} has a drift of {size} from its beginning to its end: {self._done(line, kind)}."
                continue
            shown = ", ".join(f"{line.spacing * (i.last if kind == 'step' else i.first):.4g}" for i in those[:SHOWN])
            more = f" and {len(those) - SHOWN} more places" if len(those) > SHOWN else ""
            yield f"{name} has {count}{_sizes(kind, those, line.spacing)} at {shown} m{more}: {self._done(line, kind)}."
        if line.unknown:
            yield f"{name} is {line.unknown}: no error of its levels is known."

    def _done(self, line: EditedLine, kind: str) -> str:
        if line.unknown:
            return "left as measured"
        if self.outliers == "keep":
            return "kept, as asked by outliers, and the error of each band has what they change"
        if kind == "burst":
            return "left as measured, and the error of each band has what this adds: measure it again, or cut it out"
        done = {"step": "the part behind is moved", "drift": "subtracted"}.get(kind, "replaced by straight lines")
        return f'{done}, and the error of each band has what this leaves; outliers = "keep" leaves them in'


def _sizes(kind: str, those: list[Outlier], spacing: float) -> str:
    """Heights and widths of some of one kind."""
    heights = sorted(one.size for one in those)
    if kind in ("spike", "pit", "step"):
        heights = sorted(map(abs, heights)) if kind != "step" else heights
    ends = dict.fromkeys(in_unit(end, "length", digits=3) if end else "0" for end in (heights[0], heights[-1]))
    wide = in_unit(spacing * max(one.last - one.first + 1 for one in those), "length", digits=3)
    if kind in ("run", "clipping"):
        return f" at {' to '.join(ends)}, up to {wide} long,"
    of = " to ".join(ends)
    if kind == "burst":
        return f" of {of} rms in short waves, up to {wide} long,"
    return f" of {of}" if kind == "step" else f" of {of}, up to {wide} wide,"


def _name(positions: Sequence[float], i: int) -> str:
    return "the line" if len(positions) == 1 else f"the line at {1e3 * positions[i]:g} mm"


def edited(height: FloatArray, spacing: float, outliers: Outliers = "remove") -> LineEdits:
    """What is wrong in lines of shape (points, lines) [m]; outliers: what is done about it."""
    lines = ((i, EditedLine.of(line, spacing)) for i, line in enumerate(np.ascontiguousarray(height.T)))
    return LineEdits(lines=tuple((i, line) for i, line in lines if line.outliers), outliers=outliers)


UNTOUCHED = LineEdits()
