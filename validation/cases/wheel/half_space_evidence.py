"""The wheel in three dimensions: levels of every model beside boundary elements in the loop, and its regions."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from validation.analysis import spectral_features as regions
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Role, Table, columns, if_confirmed, table_of, with_reference
from validation.analysis.spectra import band_levels, band_means, one_third_octaves, record_spectra
from validation.analysis.statistics import POWER_DECIBEL, Estimate, jackknife_error
from validation.cases.wheel.features import linear_spectrum
from validation.cases.wheel.half_space import COARSER, FINEST, LOOSE, TABLE, TIGHT, Result3D, Wheel3D, run
from validation.engine.engine import Outcome
from validation.selection import model_needed
from validation.simulation.wheel_on_springs import InputSpectrum
from validation.theory import rolling as rolling_theory
from validation.theory import wheel as wheel_theory

FloatArray = NDArray[np.float64]

LINEAR_3D, LINEAR_1D = "linear, 3D", "linear, 1D (14.12)"
SPRINGS, FED = "springs, Geike", "springs, fed for rolling"
MODELS = (LINEAR_3D, LINEAR_1D, SPRINGS, FED)
INPUT_SPECTRA: dict[str, InputSpectrum] = {SPRINGS: "geike", FED: "rolling"}
ONE, THREE = 1.0, 3.0
POINTS = 40
"""At which a spectrum is taken in each band."""


def evidence(result: Result3D) -> Evidence:
    """Levels in one-third octaves with intervals; means over the plateau and parts of region 3."""
    found = Levels(result)
    numbers = [*_exact(result), *_means(found), *_region_numbers(found)]
    return Evidence(
        title="The wheel in three dimensions: boundary elements inside the time loop",
        method=_method(found),
        numbers=tuple(numbers),
        tables=(_table(found), _narrow(found)),
        page_tables=(_regions(found, numbers), _within(found)),
        conclusions=tuple(_conclusions(found, numbers)),
        captions=_captions(found),
        unconverged=result.unconverged,
    )


@dataclass(frozen=True)
class Levels:
    """Levels of the acceleration in one-third octaves: int A df of positive frequencies, natural logarithms."""

    result: Result3D

    @cached_property
    def edges(self) -> FloatArray:
        """Bands that hold two lines of a strip and end where the roughness does."""
        scene = self.result.case.scene
        line = 2 * math.pi / self._duration
        return one_third_octaves(max(2.0 * scene.eigenfrequency, 2 * line / (2 ** (1 / 3) - 1)), scene.cutoff)

    @property
    def centres(self) -> FloatArray:
        """Geometric means."""
        return np.asarray(np.sqrt(self.edges[1:] * self.edges[:-1]))

    @property
    def _duration(self) -> float:
        one = self.result.strips[FINEST][0]
        return one["bem"].size * float(one["time step"])

    def of_strips(self, name: str, model: str, edges: FloatArray | None = None) -> FloatArray:
        """Levels of each strip, (strips, bands), those that converged; with Hann's window."""
        rows = [
            _levels(one[model], float(one["time step"]), self.edges if edges is None else edges)
            for one in self.result.strips[name]
            if not one["failed"]
        ]
        return np.array(rows)

    @cached_property
    def ratio(self) -> list[Estimate]:
        """ln of boundary elements over the linear contact on the same strips, band by band."""
        return log_ratio(self.of_strips(FINEST, "bem"), self.of_strips(FINEST, "linear"))

    @cached_property
    def grid(self) -> FloatArray:
        """What the grid leaves open of that: to first order in the cells, three times the change from 3/4 as many."""
        case = self.result.case
        pairs = [
            (fine, coarse)
            for fine, coarse in zip(self.result.strips[FINEST], self.result.strips[COARSER], strict=False)
            if not fine["failed"]
        ]
        on_grids = []
        for grid in zip(*pairs, strict=True):
            bem, linear = (
                np.array([_levels(one[model], float(one["time step"]), self.edges) for one in grid])
                for model in ("bem", "linear")
            )
            on_grids.append(_log_mean(bem) - _log_mean(linear))
        change = on_grids[0] - on_grids[1]
        return np.asarray(np.abs(change) / (case.cells / case.coarse - 1))

    @cached_property
    def solver(self) -> FloatArray:
        """How much a tighter residual changes the level of a short strip; NaN where that has no line."""
        loose, tight = (self.of_strips(name, "bem")[0] for name in (LOOSE, TIGHT))
        return np.asarray(np.abs(np.log(loose / tight)))

    @cached_property
    def exact(self) -> dict[str, FloatArray]:
        """ln of linear theory in three dimensions and in one; minus infinity where it has nothing."""
        scene = self.result.case.scene
        rough = scene.rail
        assert rough is not None  # strips have refused it
        found: dict[str, list[float]] = {LINEAR_3D: [], LINEAR_1D: []}
        for low, high in zip(self.edges, self.edges[1:], strict=False):
            omega = np.linspace(low, high, POINTS)
            force = rolling_theory.force_spectrum_3d(
                omega / scene.speed,
                rough.spectrum.c2d,
                edges=(rough.q_min, rough.q_max),
                contact_radius=scene.contact_radius,
                modulus=scene.modulus,
            )
            resonator = wheel_theory.acceleration_over_force(
                omega, eigenfrequency=scene.eigenfrequency, mass=scene.mass
            )
            density = wheel_theory.over_frequency(force, speed=scene.speed) * resonator
            found[LINEAR_3D].append(float(np.trapezoid(density, omega)) / (2 * math.pi))
            fine = np.linspace(low, high, 50 * POINTS)
            found[LINEAR_1D].append(float(np.trapezoid(linear_spectrum(scene, fine), fine)) / (2 * math.pi))
        with np.errstate(divide="ignore"):
            return {name: np.log(values) for name, values in found.items()}

    @cached_property
    def bem(self) -> FloatArray:
        """ln of the level of boundary elements: linear theory, and what the strips add to it."""
        return np.asarray(self.exact[LINEAR_3D] + np.array([e.value for e in self.ratio]))

    @cached_property
    def springs(self) -> dict[str, FloatArray]:
        """ln of the mean level of springs, (groups, bands), by what they were fed."""
        return {name: self._of_springs(self.result.springs[chosen]) for name, chosen in INPUT_SPECTRA.items()}

    def _of_springs(self, batches: list[Outcome]) -> FloatArray:
        omega = batches[0]["omega"]
        groups = np.concatenate([batch["hann"] for batch in batches])
        return np.asarray(np.log(band_levels(omega, groups.T, self.edges)).T)

    def over_bem(self, model: str) -> FloatArray:
        """ln of a model's level over boundary elements, band by band."""
        value = self.exact[model] if model in self.exact else np.log(np.exp(self.springs[model]).mean(axis=0))
        return np.asarray(value - self.bem)

    def mean_over_bem(self, model: str, where: NDArray[np.bool_]) -> tuple[Estimate, float]:
        """Mean of that over some bands, with the error of both samples, and of grid and solver."""
        error = math.sqrt(self._error_of_ratio(where) ** 2 + self._error_of_model(model, where) ** 2)
        value = float(self.over_bem(model)[where].mean())
        solver = self.solver[where][np.isfinite(self.solver[where])]
        grid = float(self.grid[where].mean() + (solver.mean() if solver.size else 0.0))
        return Estimate(value, error, len(self.of_strips(FINEST, "bem"))), grid

    def _error_of_ratio(self, where: NDArray[np.bool_]) -> float:
        bem, linear = (self.of_strips(FINEST, model)[:, where] for model in ("bem", "linear"))
        return float(jackknife_error(_without(bem, linear).mean(axis=1)))

    def _error_of_model(self, model: str, where: NDArray[np.bool_]) -> float:
        if model in self.exact:
            return 0.0
        groups = self.springs[model][:, where].mean(axis=1)
        return float(np.std(groups, ddof=1)) / math.sqrt(groups.size)


def log_ratio(mine: FloatArray, other: FloatArray) -> list[Estimate]:
    """ln of the ratio of both means, realisations in pairs along the first axis; error by leaving out one of them."""
    value, errors = _log_mean(mine) - _log_mean(other), jackknife_error(_without(mine, other))
    return [Estimate(float(v), float(e), len(mine)) for v, e in zip(value, errors, strict=True)]


def _without(mine: FloatArray, other: FloatArray) -> FloatArray:
    """ln of that ratio, without one realisation after the other."""
    return np.array([_log_mean(np.delete(mine, i, 0)) - _log_mean(np.delete(other, i, 0)) for i in range(len(mine))])


def _log_mean(levels: FloatArray) -> FloatArray:
    return np.asarray(np.log(levels.mean(axis=0)))


def _levels(series: FloatArray, time_step: float, edges: FloatArray) -> FloatArray:
    record = record_spectra(series[:, np.newaxis], time_step=time_step, window="hann")
    return band_levels(record.omega, record.density, edges)[:, 0]


def ranges(found: Levels) -> dict[str, NDArray[np.bool_]]:
    """Bands of the plateau, and of region 3 in two parts."""
    scene, edges = found.result.case.scene, found.edges
    middle = math.sqrt(scene.jump * scene.cutoff)
    low, high = edges[:-1] * (1 + 1e-9), edges[1:] * (1 - 1e-9)
    return {
        "region 2": high < 0.95 * scene.jump,
        "region 3, lower half": (low > 0.99 * scene.jump) & (high <= middle),
        "region 3, upper half": (low > middle * 0.8) & (high > middle),
    }


def _method(found: Levels) -> str:
    case, scene = found.result.case, found.result.case.scene
    strips = case.strip(0, case.cells, case.tolerance, case.turns)
    steps, across = strips.shape
    rail = scene.rail
    waves = f"{1e3 * rail.longest:g} to {1e3 * rail.shortest:g} mm, H = {rail.hurst:g}" if rail else ""
    return (
        f"{case.strips} wheels of {scene.name} over isotropic surfaces, waves of {waves}, h₀/d = "
        f"{scene.rms / scene.approach:.3g}; contact by boundary elements in each of {steps} time steps, {case.cells} "
        f"cells to a contact radius, residual {case.tolerance:g}; surfaces {1e3 * steps * strips.spacing:.0f} mm by "
        f"{1e3 * across * strips.spacing:.0f} mm, periodic, {case.turns + 0.5:g} turns of the resonance long. Beside "
        "them, on the same surfaces, the linear contact of fixed radius, on whose repeating motion both begin; and "
        f"{case.wheels} wheels on springs, in the motion that repeats itself, fed with Geike's spectrum of these "
        "surfaces, or with the spectrum that gives them the level of rolling on the half-space. Hann's window for all. "
        "Levels of boundary elements are over the linear contact on the same surfaces, times linear theory; grid: from "
        f"{case.coarse} cells to a radius to first order; solver: from a residual {case.tolerance / 10:g}."
    )


def _exact(result: Result3D) -> list[Number]:
    """The linear contact in the time loop is what Fourier's method has for it."""
    worst = 0.0
    for one in result.strips[FINEST]:
        series = one["linear"]
        worst = max(worst, abs(float(series.mean())) / float(series.std()))
    return [
        Number(
            quantity="linear contact on the strips, repeating motion: mean acceleration over its rms",
            value=worst,
            reference=0.0,
            source="a motion that repeats itself gains no velocity",
            tolerance=1e-9,
            reason="rounding of as many sums as steps",
        )
    ]


def _means(found: Levels) -> list[Number]:
    numbers = []
    for where, bands in ranges(found).items():
        for model in MODELS:
            if not bands.any() or not np.isfinite(found.over_bem(model)[bands]).all():
                continue
            value, grid = found.mean_over_bem(model, bands)
            numbers.append(
                Number(
                    quantity=f"{model} over bem3d, {where}",
                    value=POWER_DECIBEL * value.value,
                    reference=0.0,
                    source="boundary elements in the time loop",
                    tolerance=ONE,
                    unit="dB",
                    reason="1 dB: a third of what one-third octaves of rolling noise are held to",
                    grid=POWER_DECIBEL * grid,
                    sample=POWER_DECIBEL * value.half_width,
                    role=Role.FINDING,
                )
            )
    return numbers


def _region_numbers(found: Levels) -> list[Number]:
    """Slope and oscillation of region 3 by boundary elements."""
    case, scene = found.result.case, found.result.case.scene
    rail = scene.rail
    assert rail is not None  # strips have refused it
    period = math.pi * scene.speed / scene.contact_radius
    whole = [one for one in found.result.strips[FINEST] if not one["failed"]]
    records = [
        record_spectra(one["bem"][:, np.newaxis], time_step=float(one["time step"]), window="hann") for one in whole
    ]
    omega = records[0].omega
    density = np.array([record.density[:, 0] for record in records])
    first, last = 1.1 * scene.jump, 0.7 * scene.cutoff
    if last - first < 4 * period:
        return []

    def slope(some: FloatArray) -> float:
        return regions.slope(omega, some.mean(axis=0), first, last, period)

    without = [slope(np.delete(density, i, axis=0)) for i in range(len(density))]
    value = Estimate(slope(density), float(jackknife_error(without)), len(density))
    return [
        Number(
            quantity="region 3 by boundary elements: slope",
            value=value.value,
            reference=-2 * rail.hurst - 3,
            source="-2 H - 3, (14.13); the same in linear theory in 3D",
            tolerance=0.2,
            reason=f"0.2: 5 %, {case.strips} strips and the end of the band",
            sample=value.half_width,
            role=Role.FINDING,
        )
    ]


def _table(found: Levels) -> Table:
    rows: list[dict[str, object]] = []
    for i, centre in enumerate(found.centres):
        row: dict[str, object] = {
            "omega [rad/s]": float(centre),
            "from [rad/s]": float(found.edges[i]),
            "to [rad/s]": float(found.edges[i + 1]),
            "bem3d [dB]": POWER_DECIBEL * float(found.bem[i]),
            "± sample [dB]": POWER_DECIBEL * found.ratio[i].half_width,
            "± grid [dB]": POWER_DECIBEL * float(found.grid[i]),
            "± solver [dB]": POWER_DECIBEL * float(found.solver[i]),
        }
        for model in MODELS:
            row[f"{model} over bem3d [dB]"] = POWER_DECIBEL * float(found.over_bem(model)[i])
        rows.append(row)
    return table_of("levels", rows)


def _narrow(found: Levels) -> Table:
    """Spectra line by line where the oscillation is, in bands of a twelfth of its period."""
    scene = found.result.case.scene
    period = math.pi * scene.speed / scene.contact_radius
    whole = [one for one in found.result.strips[FINEST] if not one["failed"]]
    time_step = float(whole[0]["time step"])
    series = {model: np.stack([one[model] for one in whole], axis=1) for model in ("bem", "linear")}
    records = {model: record_spectra(x, time_step=time_step, window="hann") for model, x in series.items()}
    omega = records["bem"].omega
    edges = np.arange(0.7 * scene.jump, min(scene.cutoff, 12 * period), max(period / 12, 2 * float(omega[0])))
    springs = found.result.springs["geike"]
    of_springs = np.concatenate([batch["hann"] for batch in springs]).mean(axis=0)
    return Table(
        "oscillation",
        columns(
            **{
                "omega [rad/s]": (edges[1:] + edges[:-1]) / 2,
                "bem3d": band_means(omega, records["bem"].density.mean(axis=1), edges),
                LINEAR_3D: band_means(omega, records["linear"].density.mean(axis=1), edges),
                SPRINGS: band_means(springs[0]["omega"], of_springs, edges),
            }
        ),
    )


def _regions(found: Levels, numbers: list[Number]) -> Table:
    """The chapter's regions in three dimensions."""
    scene = found.result.case.scene
    plateau = [n for n in numbers if n.label.endswith("region 2") and n.label.startswith(LINEAR_3D)]
    third = [n for n in numbers if "slope" in n.label]
    return Table(
        "the regions in three dimensions",
        {
            "region": ["1", "2", "3", "4"],
            "on springs of Geike's spectrum": [
                "excited by the start alone: no wave of the track has the resonance",
                "leakage and nonlinearity",
                "-2 H - 3, and zeros of sin²(q a)",
                "leakage; the roughness ends at q_max",
            ],
            "by boundary elements": [
                f"excited by the roughness: its force there over that at q_min v₀ is {_at_resonance(found):+.1f} dB",
                f"real; linear theory over it {with_reference(plateau[0])}" if plateau else "no band holds it",
                f"slope {with_reference(third[0])}; zeros filled in"
                if third
                else "too few periods for a slope; zeros filled in",
                f"beyond 1.3 q_max v₀ {_beyond(found):.0f} dB below the last tenth of the roughness, with Hann's "
                "window",
            ],
            "ω [rad/s]": [
                f"{scene.eigenfrequency:.4g}",
                f"up to {scene.jump:.4g}",
                f"up to {scene.cutoff:.4g}",
                f"from {scene.cutoff:.4g}",
            ],
        },
    )


def _at_resonance(found: Levels) -> float:
    """C_F of linear theory in 3D at the resonance over that where the band begins [dB]."""
    scene = found.result.case.scene
    rough = scene.rail
    assert rough is not None  # strips have refused it
    force = rolling_theory.force_spectrum_3d(
        np.array([scene.eigenfrequency / scene.speed, 1.001 * rough.q_min]),
        rough.spectrum.c2d,
        edges=(rough.q_min, rough.q_max),
        contact_radius=scene.contact_radius,
        modulus=scene.modulus,
    )
    return POWER_DECIBEL * math.log(force[0] / force[1])


def _beyond(found: Levels) -> float:
    """How far boundary elements fall beyond the roughness [dB]."""
    cutoff = found.result.case.scene.cutoff
    inside, outside = (
        found.of_strips(FINEST, "bem", np.array(band) * cutoff)[:, 0].mean() / (band[1] - band[0])
        for band in ((0.9, 1.0), (1.3, 1.8))
    )
    return -POWER_DECIBEL * math.log(outside / inside)


def _within(found: Levels) -> Table:
    """Bands of each range in which each model is within 1 and within 3 dB of boundary elements."""
    rows: list[dict[str, object]] = []
    for model in MODELS:
        row: dict[str, object] = {"model": model}
        off = np.abs(POWER_DECIBEL * found.over_bem(model))
        for where, bands in ranges(found).items():
            row[where] = f"{(off[bands] <= ONE).sum()} and {(off[bands] <= THREE).sum()} of {bands.sum()}"
        rows.append(row)
    return table_of("one-third octaves within 1 and within 3 dB of boundary elements", rows)


def _conclusions(found: Levels, numbers: list[Number]) -> list[str]:
    sentences = []
    for where in ranges(found):
        parts = [
            f"{n.label.split(' over bem3d')[0]} {n.value:+.1f} ± {n.uncertainty:.1f} dB ({n.verdict})"
            for n in numbers
            if n.label.endswith(f"over bem3d, {where}")
        ]
        if parts:
            sentences.append(f"Level over boundary elements, {where}: {'; '.join(parts)}.")
    slope = next((n for n in numbers if "slope" in n.label), None)
    if slope is not None:
        sentences.append(
            if_confirmed(
                f"The power law of region 3 holds in three dimensions: slope {with_reference(slope)}.", [slope]
            )
        )
    plateau = [n for n in numbers if n.label.endswith("region 2")]
    theory = next((n for n in plateau if n.label.startswith(LINEAR_3D)), None)
    geike = next((n for n in plateau if n.label.startswith(SPRINGS)), None)
    if theory is not None and geike is not None:
        sentences.append(
            if_confirmed(
                "In three dimensions region 2 is real: an isotropic surface has waves that cross the track aslant, and "
                "along it they are longer than those of q_min. Linear theory has it, "
                f"{with_reference(theory)}; springs of Geike's spectrum, of which only leakage and nonlinearity are "
                f"there, are {abs(geike.value):.0f} dB too {'low' if geike.value < 0 else 'high'} once nothing leaks.",
                [theory],
            )
        )
    applications = np.mean([one["applications"] for one in found.result.strips[FINEST] if not one["failed"]])
    sentences.append(
        f"A step takes {applications:.1f} applications of the operator, a step on springs as many additions as springs "
        "may or may not touch; what both cost, a step and a simulated metre, is in the race."
    )
    sentences.append(
        "Nothing damps the wheel, and in three dimensions roughness excites its resonance: on an open track that would "
        "grow with the distance, without a level to compare. So all begin on the motion that repeats itself with the "
        "track, and bands begin at twice the eigenfrequency."
    )
    return sentences


def _captions(found: Levels) -> dict[str, str]:
    case = found.result.case
    return {
        "wheel_3d": (
            "(a) Acceleration of the wheel in one-third octaves: circles, boundary elements in the time loop, "
            f"{case.strips} surfaces, with 95 % intervals of sample, grid and solver; thick grey: linear theory in 3D; "
            "line: linear theory in 1D, (14.12); squares: springs of Geike's spectrum; triangles: springs fed for "
            "rolling. Shaded: region 2. (b) The same over boundary elements; dotted: ± 1 and ± 3 dB, shaded: what the "
            "boundary elements leave open. (c) The oscillation of region 3: boundary elements, linear contact on the "
            "same surfaces, springs."
        )
    }


CASE = Case(
    name="wheel_3d",
    chapter=Chapter.WHEEL,
    place=3,
    claim="Boundary elements in the time loop confirm Fig. 14.4.",
    answers="Boundary elements inside the time loop: the wheel in three dimensions, beside everything cheaper",
    quick=Wheel3D(),
    full=Wheel3D(
        scene=TABLE,
        strips=16,
        turns=4,
        width=4,
        cells=40,
        shared=10,
        coarse=30,
        coarser=3,
        tolerance=0.0001,
        short=1,
        wheels=200,
    ),
    run=run,
    evidence=evidence,
    needs=model_needed.wheel,
)
