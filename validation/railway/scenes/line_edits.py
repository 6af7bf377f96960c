"""What was wrong in measured lines, what was done about it, and the error in each band that this leaves."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Literal

import numpy as np
import scipy
from numpy.typing import NDArray

from validation.analysis.spectra import SHORTEST, NominalBands
from validation.analysis.statistics import FloatArray
from validation.railway.scenes.line_steps import (
    DRIFTS,
    MOST_STEPS,
    WIDE,
    Outlier,
    drift_of,
    interpolated,
    points_of,
    runs_of,
    sensor_step,
    without_outliers,
    without_steps,
)
from validation.scenes.units import in_unit

PARTS = 20, 80
"""Of a line that are as long as a window; what is left by a burst is known from the longer ones."""
FEWEST_POINTS, FEWEST_WINDOWS = 100, 12
"""Of a window, and of a line: with fewer no burst is looked for."""
WAVES, FEWEST_WAVES = 4, 2
"""Of a window in a band, at the least: where a burst is looked for, since those of a corrugation leak into the bands
beside it, and where what a burst adds is found."""
OF_HANN = 35 / 18
"""Waves over independent ones: the mean of the fourth power of Hann's window over the square of that of the second."""
NATURAL = 4.0
"""Power of a part of a line over that of the median, as of roughness that differs by a factor of 2 in rms."""
NEIGHBOURS = 5
"""Bands, half a decade. Those of a part with a corrugation of 20 dB are fewer."""
SHORT, OF_SHORT = 10e-3, 3
"""Nominal wavelength [m]: no corrugation has waves as short, and fewer bands are a burst."""
FALSE = 1e-3
"""Probability that a line of which parts are as rough as `NATURAL` has a burst."""
LEAST = 1e-10
"""Power in a band over that of the differences of all points: with less the windows leak."""
LONGEST = 3
"""Bands from which a burst is carried on to those of longer waves than windows have."""
OF_WHITE = 10**-0.3
"""Power of white noise in so many bands over that in as many of shorter waves."""
LITTLE = 0.25
"""Share of a burst in the power of a band of such waves, at the most, of which it is known."""
MOSTLY = 0.5
"""Of the points of a burst that are spikes and pits, from which on it is one without those that are left."""
MOST_OF_LINE = 1 / 3
"""Of the windows: beyond, the others are too few to tell what a burst changes."""


@dataclass(frozen=True, eq=False)
class Windows:
    """Of a line: the first point of each, their points, and the mean square in bands, (windows, bands) [m^2].

    freedom: nu of each band; floor: mean squares below which the step of the sensor or leakage is seen [m^2].
    """

    starts: NDArray[np.intp]
    points: int
    powers: FloatArray
    bands: NominalBands
    freedom: FloatArray
    floor: FloatArray

    @classmethod
    def of(cls, line: FloatArray, spacing: float, sensor: float, parts: int, waves: int = WAVES) -> "Windows | None":
        """Overlapping windows of a `parts`-th of a line, in bands of so many `waves` and more; None of a short line.

        sensor: the step to which the line was rounded [m]. Spectra are those of the differences of neighbours, which
        hardly leak, over |2 sin(q spacing / 2)|^2.
        """
        points = max(line.size // parts, FEWEST_POINTS)
        starts = np.append(np.arange(0, line.size - 1 - points, max(1, points // 2)), line.size - 1 - points)
        if starts[0] < 0 or starts.size < FEWEST_WINDOWS:
            return None
        steps = np.diff(line)
        steps = steps - steps.mean()
        window = np.sin(np.pi * (np.arange(points) + 0.5) / points) ** 2 * np.sqrt(8 / 3)
        cut = np.lib.stride_tricks.sliding_window_view(steps, points)[starts]
        squares = 2 * np.abs(np.fft.rfft(window * cut, axis=1)[:, 1:] / points) ** 2
        response = (2 * np.sin(np.pi * np.arange(1, squares.shape[1] + 1) / points)) ** 2
        bands = _bands(points * spacing, spacing, waves)
        if bands is None:
            return None
        ends = np.searchsorted(2 * np.pi * np.arange(1, squares.shape[1] + 1) / (points * spacing), bands.edges)
        summed = np.cumsum(np.concatenate([np.zeros((starts.size, 1)), squares / response], axis=1), axis=1)
        count = np.diff(ends)
        leaks = np.diff(np.cumsum(np.append(0.0, 1 / response))[ends]) * LEAST * float(steps.var())
        rounding = sensor**2 / 12 * count * 2 / points
        freedom = np.maximum(2 * count / OF_HANN, 1.0)
        return cls(starts, points, np.diff(summed[:, ends]), bands, freedom, np.maximum(leaks, rounding))

    @property
    def raised(self) -> NDArray[np.bool_]:
        """Bands of windows that are part of a burst."""
        raised = np.zeros(self.powers.shape, dtype=bool)
        short = int(np.argmax(np.append(self.bands.nominal, 0.0) <= SHORT * (1 + 1e-9)))
        for count, first in ((NEIGHBOURS, 0), (OF_SHORT, short)):
            over = self._over((FALSE / self.powers.size) ** (1 / count))[:, first:]
            for i in range(over.shape[1] - count + 1):
                raised[:, first + i : first + i + count] |= over[:, i : i + count].all(axis=1, keepdims=True)
        return raised

    @property
    def excess(self) -> FloatArray:
        """Mean square of each window that is part of a burst, over the median in the bands of the burst [m^2].

        Windows beside them are part of it as far as their powers there are more than half of `NATURAL` of the median,
        in the geometric mean.
        """
        raised, usual = self.raised, np.maximum(np.median(self.powers, axis=0), self.floor)
        bands, inside = raised.any(axis=0), raised.any(axis=1)
        if not inside.any():
            return np.zeros(inside.size)
        ratio = np.log(np.maximum(self.powers, 1e-300) / np.maximum(usual, 1e-300))[:, bands]
        number, _ = scipy.ndimage.label(inside | (ratio.mean(axis=1) > np.log(NATURAL / 2)))
        burst = np.isin(number, number[inside])
        return np.where(burst, np.maximum(self.powers - usual, 0.0)[:, bands].sum(axis=1), 0.0)

    def _over(self, p: float) -> NDArray[np.bool_]:
        """Bands of windows with more power than a part as rough as `NATURAL` has but for a probability."""
        chi2 = scipy.stats.chi2
        most = NATURAL * chi2.isf(p, self.freedom) / chi2.median(self.freedom)
        return np.asarray(self.powers > most * np.maximum(np.median(self.powers, axis=0), self.floor))

    def touched(self, bursts: tuple[Outlier, ...]) -> NDArray[np.bool_]:
        """Windows that have points of bursts."""
        ends = self.starts + self.points
        return np.asarray(np.any([(self.starts <= burst.last) & (ends > burst.first) for burst in bursts], axis=0))


def _bands(window: float, spacing: float, waves: int) -> NominalBands | None:
    """One-third octaves of so many waves in a window and of 2.5 points a wave, at the least; None for too few."""
    share = 10**0.05 - 10**-0.05
    try:
        bands = NominalBands().within(min(2.0, window * share / waves), max(10 ** (SHORTEST / 10), 2.5 * spacing))
    except ValueError:
        return None
    return bands if len(bands) >= OF_SHORT else None


def bursts_of(line: FloatArray, measured: FloatArray, spacing: float, sensor: float) -> tuple[Outlier, ...]:
    """Of a line without other outliers [m], in the order of their places; their size is the rms of what is raised.

    measured: the same line with its spikes and pits [m], many of which may be those of a burst: it goes as far as they
    raise the windows beside it, and where most of its points are replaced it is a burst without these.
    """
    square, replaced = _squares(line, spacing, sensor), line != measured
    if not square.any() and replaced.mean() < MOSTLY / max(PARTS):
        return ()
    both = np.maximum(square, _squares(measured, spacing, sensor))
    number, count = scipy.ndimage.label(both > 0)
    bursts = []
    for (part,) in scipy.ndimage.find_objects(number, count):
        if square[part].any() or replaced[part].mean() > MOSTLY:
            bursts.append(Outlier("burst", part.start, part.stop - 1, float(np.sqrt(both[part].max()))))
    return tuple(bursts)


def _squares(line: FloatArray, spacing: float, sensor: float) -> FloatArray:
    """`Windows.excess` of the windows of a point, the largest [m^2]."""
    square = np.zeros(line.size)
    for parts in PARTS:
        if (windows := Windows.of(line, spacing, sensor, parts)) is not None:
            excess = windows.excess
            for i in np.flatnonzero(excess):
                inside = slice(windows.starts[i], windows.starts[i] + windows.points + 1)
                square[inside] = np.maximum(square[inside], excess[i])
    return square


def left_by_bursts(
    line: FloatArray, spacing: float, bursts: tuple[Outlier, ...], bands: NominalBands
) -> tuple[FloatArray, FloatArray]:
    """What bursts add to the mean square in each band, over that without them, and the half-width of 95 % of this.

    R_b - 1, where R_b is the mean of P_wb with the weight of each window in the spectrum of the whole line, sin^4, over
    that of windows without bursts. Its standard deviation is that of P_wb among these, or sqrt(2 / nu) of P_wb where it
    is larger, times the root of the sum of the squares of the differences of both weights.

    In bands of longer waves than windows have, the burst is taken for noise whose power falls from band to band as in
    the longest that they have, no faster than that of white noise; it is its own half-width. Where this is more than
    `LITTLE` of a band, R_b is the largest of these. To all come the products of waves of both, 2 sqrt(4 (R_b - 1) / nu)
    of a band of the whole line.

    Raises ValueError for a line in which no burst can be, or that has nothing else.
    """
    windows = Windows.of(line, spacing, 0.0, PARTS[0], FEWEST_WAVES)
    if windows is None or (inside := windows.touched(bursts)).all():
        raise ValueError(f"bursts must be those of a part of the line, got {len(bursts)} in {line.size} points")
    at = (windows.starts + windows.points / 2) / line.size
    all_of_it, rest = np.sin(np.pi * at) ** 4, (~inside).astype(np.float64)
    all_of_it, rest = all_of_it / all_of_it.sum(), rest / rest.sum()
    without = np.maximum(rest @ windows.powers, 1e-300)
    scatter = np.maximum(windows.powers[~inside].std(axis=0) / without, np.sqrt(2 / windows.freedom))
    ratio = np.maximum(all_of_it @ windows.powers / without - 1, 0.0)
    own, most = bands.powers_of_records(line, spacing=spacing), float(ratio[:LONGEST].max())
    power = [max(float(np.mean((ratio * without)[i : i + LONGEST])), 1e-300) for i in (0, LONGEST)]
    fall = min(max(power[0] / power[1], OF_WHITE), 1.0) if len(ratio) > LONGEST else 1.0
    beyond = np.maximum(np.array(bands.numbers) - windows.bands.longest + LONGEST // 2, 0)
    share = power[0] * fall ** (beyond / LONGEST) / own
    little = share < LITTLE
    added = np.where(little, share / (1 - np.minimum(share, LITTLE)), most)
    half_width = np.where(little, added, 0.0)
    shorter = np.searchsorted(-np.array(bands.numbers), -windows.bands.longest)
    common = slice(max(0, windows.bands.longest - bands.longest), None)
    added[shorter:] = ratio[common][: len(bands) - shorter]
    half_width[shorter:] = 2 * (scatter * np.sqrt(np.sum((all_of_it - rest) ** 2)))[common][: len(bands) - shorter]
    freedom = np.maximum(2 / OF_HANN * np.diff(bands.edges) / (2 * np.pi) * line.size * spacing, 1.0)
    return added, half_width + 4 * np.sqrt(added / freedom)


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
        """The line without its faults. Runs and clipped parts are taken out first, then spikes and pits, then steps.

        Bursts of noise come last; spikes and pits in them are part of them. Where too much of a line is gone, the rest
        is left as it is. Drift is subtracted at the end.
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
            high = tuple(outlier for outlier in high if not noisy[outlier.first : outlier.last + 1].any())
            clean, steps = without_steps(np.where(points_of(high, height.size), smooth, solid), spacing, sensor)
        far, middle = max(DROPOUT * float(np.ptp(clean)), LEAST_DROPOUT), float(np.median(clean))
        named = [_relabelled(outlier, abs(outlier.size) > far) for outlier in high]
        named += [_relabelled(outlier, outlier.kind == "run" and abs(outlier.size - middle) > far) for outlier in runs]
        bend, over_rest = drift_of(clean)
        drift = [Outlier("drift", 0, clean.size - 1, float(np.ptp(bend)))] if over_rest > DRIFTS else []
        outliers = (*drift, *bursts, *steps, *sorted(named, key=lambda outlier: outlier.first))
        return cls(height, clean - bend if drift else clean, outliers, spacing)

    @property
    def replaced(self) -> NDArray[np.bool_]:
        """Points with a straight line in their place."""
        points = points_of(tuple(outlier for outlier in self.outliers if outlier.kind not in MOVED), self.height.size)
        for step in self.of_kind("step"):
            points[step.first + 1 : step.last] = True
        return points

    def of_kind(self, kind: str) -> list[Outlier]:
        return [outlier for outlier in self.outliers if outlier.kind == kind]

    @property
    def unknown(self) -> str:
        """Why no error is known; empty where one is."""
        clipped = points_of(tuple(self.of_kind("clipping")), self.height.size).mean()
        if clipped > MOST_CLIPPED:
            ends = " and ".join(
                sorted({in_unit(outlier.size, "length", digits=4) for outlier in self.of_kind("clipping")})
            )
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
        total = np.zeros(len(bands))
        if replaced.any():
            rolled = (np.roll(replaced, i * replaced.size // (SHIFTS + 1)) for i in range(1, SHIFTS + 1))
            elsewhere = [np.abs(powers(interpolated(self.clean, places)) - own) for places in rolled]
            wider = np.abs(powers(interpolated(self.clean, self._wider)) - own)
            total += OF_SHIFTS * np.max(elsewhere, axis=0) + wider + powers(self._missed)
        for step in self.of_kind("step"):
            residue = powers(np.where(np.arange(self.clean.size) >= step.last, step.spread, 0.0))
            total += residue + 2 * np.sqrt(residue * own)
        if self.of_kind("drift"):
            total += np.abs(powers(self.clean + drift_of(self.height)[0]) - own)
        if bursts := tuple(self.of_kind("burst")):
            added, half_width = left_by_bursts(self.clean, self.spacing, bursts, bands)
            total += own / (1 + added) * half_width
        return total

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
        for outlier in self.outliers:
            if outlier.kind not in MOVED:
                more = max(1, (outlier.last - outlier.first + 1) // WIDER)
                points[max(0, outlier.first - more) : outlier.last + 1 + more] = True
        return points

    @property
    def _missed(self) -> FloatArray:
        """As much as may not have been found, as low as is just found.

        As many as there are of wide outliers and of those that barely were found, and a share of the others.
        """
        missed = np.zeros_like(self.clean)
        for outlier in self.outliers:
            if outlier.kind in ("spike", "pit", "dropout"):
                inside = slice(outlier.first, outlier.last + 1)
                wide = (outlier.last - outlier.first) * self.spacing > 2 * WIDE
                share = 1.0 if wide or outlier.margin < BARELY else math.sqrt(MISSED)
                missed[inside] = (self.height - self.clean)[inside] * share / max(1.0, outlier.margin)
        return missed


def _relabelled(outlier: Outlier, far: bool) -> Outlier:
    return Outlier("dropout", outlier.first, outlier.last, outlier.size, outlier.margin) if far else outlier


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
        cleaned = height.copy()
        for i, line in self.lines:
            cleaned[:, i] = line.clean
        return cleaned

    def notes(self, positions: Sequence[float]) -> tuple[str, ...]:
        """In sentences. positions: of the lines across the rail [m]."""
        return tuple(sentence for i, line in self.lines for sentence in self._sentences(_line_name(positions, i), line))

    def _sentences(self, name: str, line: EditedLine) -> Iterator[str]:
        for kind, (singular, plural) in KINDS.items():
            those = line.of_kind(kind)
            if not those:
                continue
            count = f"{len(those)} {singular if len(those) == 1 else plural}"
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
    heights = sorted(outlier.size for outlier in those)
    if kind in ("spike", "pit", "step"):
        heights = sorted(map(abs, heights)) if kind != "step" else heights
    ends = dict.fromkeys(in_unit(end, "length", digits=3) if end else "0" for end in (heights[0], heights[-1]))
    wide = in_unit(spacing * max(outlier.last - outlier.first + 1 for outlier in those), "length", digits=3)
    if kind in ("run", "clipping"):
        return f" at {' to '.join(ends)}, up to {wide} long,"
    of = " to ".join(ends)
    if kind == "burst":
        return f" of {of} rms in short waves, up to {wide} long,"
    return f" of {of}" if kind == "step" else f" of {of}, up to {wide} wide,"


def _line_name(positions: Sequence[float], i: int) -> str:
    return "the line" if len(positions) == 1 else f"the line at {1e3 * positions[i]:g} mm"


def edited(height: FloatArray, spacing: float, outliers: Outliers = "remove") -> LineEdits:
    """What is wrong in lines of shape (points, lines) [m]; outliers: what is done about it."""
    lines = ((i, EditedLine.of(line, spacing)) for i, line in enumerate(np.ascontiguousarray(height.T)))
    return LineEdits(lines=tuple((i, line) for i, line in lines if line.outliers), outliers=outliers)


UNTOUCHED = LineEdits()
