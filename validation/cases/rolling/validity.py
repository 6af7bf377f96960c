"""Which of h/d and h' a/d says where linear theory ends: other bands and other Hurst exponents at equal values."""

import math
from dataclasses import dataclass

import numpy as np

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.difference import difference
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Place, Table, numbers_with, table_of
from validation.analysis.spectra import Bands
from validation.analysis.statistics import POWER_DECIBEL, Estimate, jackknife_error, ratio_of_means
from validation.cases.rolling.claims import SLOPE_COUNTS
from validation.cases.rolling.force_spectrum_levels import correlation
from validation.cases.rolling.validity_headlines import finding, headline
from validation.cases.rolling.validity_reduced import (
    FOLLOWS,
    MODELS,
    OFF_REDUCED,
    number_of,
    over_boundary_elements,
    roll_reduced,
)
from validation.engine.convergence import require_realisations
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.scenes.description import slope_ratio
from validation.scenes.dynamic_wheel import load_wheel_scene
from validation.simulation.rolling_strip import RoughStrip, Strip, roll_strips, strip_levels
from validation.simulation.track_spectrum import PiecewisePowerLaw, self_affine
from validation.theory.rolling import slope_in_one_direction

SLOPE, HEIGHT = "h' a/d", "h/d"
KEPT, OFF = "share of contact kept", "rms level over linear theory"
REFERENCE = "H = 0.7, q a = 1 to 10"
SPECTRA = {
    REFERENCE: self_affine(0.7, 1.0, 10.0),
    "H = 0.7, q a = 0.3 to 5": self_affine(0.7, 0.3, 5.0),
    "H = 0.7, q a = 2 to 20": self_affine(0.7, 2.0, 20.0),
    "H = 0.4, q a = 1 to 10": self_affine(0.4, 1.0, 10.0),
    "H = 1, q a = 1 to 10": self_affine(1.0, 1.0, 10.0),
}
CLAIM = "Contact is lost at the same h' a/d, whatever the band of the roughness and its Hurst exponent."


@dataclass(frozen=True, kw_only=True)
class Validity:
    """A wheel at the approach d, contact radius a, over surfaces of all spectra, at equal h' a/d and at equal h/d.

    slopes, heights: values of both, ascending, h' along the track, of all waves; strips: realisations; waves: of the
    longest on the length of a surface; width: over a; cells: to a contact radius and, by four, to the shortest wave at
    least; seed: zero or positive.
    """

    slopes: tuple[float, ...] = (slope_in_one_direction(1.0),)
    heights: tuple[float, ...] = (0.3,)
    strips: int = 4
    waves: int = 4
    width: int = 12
    cells: int = 8
    seed: int = 151

    def __post_init__(self) -> None:
        require_realisations(strips=self.strips)

    @property
    def levels(self) -> list[tuple[str, float]]:
        """Values of both parameters."""
        return [*((SLOPE, value) for value in self.slopes), *((HEIGHT, value) for value in self.heights)]

    def cells_for(self, spectrum: PiecewisePowerLaw) -> int:
        return max(self.cells, math.ceil(4 * spectrum.edges[-1] / (2 * math.pi)))

    def length_for(self, spectrum: PiecewisePowerLaw) -> int:
        return math.ceil(self.waves * 2 * math.pi / spectrum.edges[0])

    def bands_for(self, spectrum: PiecewisePowerLaw) -> Bands:
        """One-third octaves in the band of a spectrum, one of them around the first zero of sin(q a)."""
        return Bands.around(math.pi, spectrum.edges[0], spectrum.edges[-1]).on(self.length_for(spectrum))

    def strips_of(self, name: str, parameter: str, value: float) -> list[Strip]:
        spectrum, height = SPECTRA[name], height_at(name, parameter, value)
        scene = RoughStrip(
            spectrum=spectrum, height=height, length=self.length_for(spectrum), width=self.width, seed=self.seed
        )
        return scene.strips(self.cells_for(spectrum), 1e-4 * height, self.strips)


def height_at(name: str, parameter: str, value: float) -> float:
    """h/d of a spectrum at an h' a/d or h/d: an isotropic surface has the rms gradient sqrt(2) h'."""
    return math.sqrt(2) * value / SPECTRA[name].gradient if parameter == SLOPE else value


Key = tuple[str, str, float]
"""Spectrum; h' a/d or h/d; its value."""


@dataclass(frozen=True)
class ValidityResult:
    """Levels beside linear theory; area of contact over that of smooth wheels; reduced models over bem3d [dB]."""

    case: Validity
    levels: dict[Key, Outcome]
    kept: dict[Key, Estimate]
    reduced: dict[tuple[str, Key], Estimate]
    unconverged: tuple[str, ...]


def run(case: Validity, engine: Engine = SERIAL) -> ValidityResult:
    """Roll over all spectra. Raises NotConvergedError where fewer than three strips of one converge."""
    groups = {(name, *level): case.strips_of(name, *level) for name in SPECTRA for level in case.levels}
    strips, unconverged = roll_strips(groups, engine)
    levels = {
        key: strip_levels(found, 1 / case.cells_for(SPECTRA[key[0]]), case.bands_for(SPECTRA[key[0]]))
        for key, found in strips.items()
    }
    rolled = engine.map_groups(roll_reduced, groups)
    reduced = {
        (model, key): off_linear(
            over_boundary_elements(model, rolled[key], mine[0], levels[key], case.bands_for(SPECTRA[key[0]]))
        )
        for key, mine in groups.items()
        for model in MODELS
    }
    kept = {key: contact_kept(found) for key, found in strips.items()}
    return ValidityResult(case, levels, kept, reduced, unconverged)


def contact_kept(strips: list[Outcome]) -> Estimate:
    """Mean area of contact over that of a smooth wheel under the same force, which is as its power 2/3."""
    area, force = (np.array([strip[name] for strip in strips]) for name in ("area", "force"))
    return ratio_of_means(area.mean(axis=1), (np.maximum(force, 0.0) ** (2 / 3)).mean(axis=1))


def off_linear(outcome: Outcome) -> Estimate:
    """Root mean square over bands of the level over linear theory on the same surfaces [dB], with its jackknife."""
    known = np.isfinite(outcome["level"]).all(axis=1)
    level, linear = outcome["level"][known], outcome["linear level"][known]
    count = len(level)

    def rms(mine: np.ndarray, other: np.ndarray) -> np.ndarray:
        return np.asarray(POWER_DECIBEL * np.sqrt(np.mean(np.log(mine / other) ** 2, axis=-1)))

    without = rms(*((one.sum(axis=0) - one) / (count - 1) for one in (level, linear)))
    return Estimate(float(rms(level.mean(axis=0), linear.mean(axis=0))), float(jackknife_error(without)), count)


def evidence(result: ValidityResult) -> Evidence:
    """Each spectrum beside that of reference, at equal h' a/d and at equal h/d."""
    case = result.case
    numbers = [
        number
        for parameter, value in case.levels
        for name in SPECTRA
        if name != REFERENCE
        for number in _numbers(result, name, parameter, value)
    ]
    numbers += [
        number_of(model, found, {key[1]: _rounded(key[2]), "spectrum": key[0]}, len(SPECTRA) * len(_of(case, key[1])))
        for (model, key), found in result.reduced.items()
    ]
    table = _table(result)
    claims = _claims(case, numbers, table)
    return Evidence(
        title="Where linear theory ends: h' a/d against h/d, over bands and Hurst exponents",
        method=(
            f"A wheel rolls at a fixed approach over surfaces of {len(SPECTRA)} spectra, once with equal h' a/d and "
            f"once with equal h/d. {SLOPE_COUNTS}. Boundary elements: {case.strips} surfaces each, "
            f"{case.waves} of their longest waves long, at least {case.cells} cells to a radius and four to the "
            "shortest wave. The share of contact kept is the mean area over that of a smooth wheel under the same "
            "force; cells at its edge may make it a little more than one. The level over linear theory on the "
            "same surfaces is taken in one-third octaves of the band; its root mean square over bands counts. Each "
            f"spectrum is judged beside {REFERENCE}. Springs that read the surface and a pressed layer, on half of the "
            "cells, roll over the same surfaces and are judged beside boundary elements."
        ),
        numbers=tuple(numbers),
        tables=(table,),
        conclusions=(_of_table_14_1(case, table),),
        claims=claims,
        finding=finding(claims),
        headlines={"rolling_validity": headline(claims)},
        captions={
            "rolling_validity": (
                "Over h/d (left) and over h' a/d (right), by spectrum. (a), (b) Share of contact kept on boundary "
                "elements. (c), (d) Root mean square over one-third octaves of the level over linear theory; dotted: "
                "1 dB. (e), (f) The same of reduced models over boundary elements; solid: pressed layer, dashed: "
                "springs that read the surface. Bars: 95 %. Curves that lie on each other show the parameter that "
                "counts."
            )
        },
        unconverged=result.unconverged,
        page_tables=(table,),
    )


def _numbers(result: ValidityResult, name: str, parameter: str, value: float) -> list[Number]:
    """A spectrum beside the reference at an equal value of one parameter; intervals hold at once for all of them."""
    mine, other = (name, parameter, value), (REFERENCE, parameter, value)
    where: dict[str, Place] = {parameter: _rounded(value), "spectrum": name}
    among = len(_of(result.case, parameter)) * (len(SPECTRA) - 1)
    return [
        difference(
            result.kept[mine],
            result.kept[other],
            quantity=KEPT,
            model="bem3d",
            where=where,
            source=REFERENCE,
            tolerance=0.1,
            reason="0.1: a tenth of the contact",
            unit="-",
            scale=1.0,
            absolute=True,
            among=among,
        ),
        difference(
            off_linear(result.levels[mine]),
            off_linear(result.levels[other]),
            quantity=OFF,
            model="bem3d",
            where=where,
            source=REFERENCE,
            tolerance=1.0,
            reason="1 dB: repeatability of measured one-third octave levels",
            scale=1.0,
            absolute=True,
            among=among,
        ),
    ]


def _table(result: ValidityResult) -> Table:
    rows: list[dict[str, object]] = []
    for (name, parameter, value), levels in result.levels.items():
        spectrum, kept, off = SPECTRA[name], result.kept[name, parameter, value], off_linear(levels)
        height = height_at(name, parameter, value)
        rows.append(
            {
                "spectrum": name,
                "at equal": parameter,
                HEIGHT: _rounded(height),
                SLOPE: _rounded(height * spectrum.slope_along),
                "contact kept": round(kept.value, 4),
                "± contact": round(kept.half_width, 4),
                "rms over linear [dB]": round(off.value, 3),
                "± rms [dB]": round(off.half_width, 3),
                "correlation with linear": round(correlation(levels)[0], 4),
                **_over_bem3d(result, (name, parameter, value)),
            }
        )
    return table_of("validity", rows)


def _over_bem3d(result: ValidityResult, key: Key) -> dict[str, float]:
    """Of reduced models, with half-widths."""
    found = {model: result.reduced[model, key] for model in MODELS}
    return {
        name: round(number, 3)
        for model, off in found.items()
        for name, number in ((f"{model} over bem3d [dB]", off.value), (f"± {model} [dB]", off.half_width))
    }


def _rounded(value: float) -> float:
    return float(f"{value:.3g}")


def _claims(case: Validity, numbers: list[Number], table: Table) -> tuple[JudgedClaim, ...]:
    def claim(text: str, quantity: str, column: str, parameter: str) -> JudgedClaim:
        values = _of(case, parameter)
        parts = [f"at {parameter} = {value:g} {spread(table, column, parameter, value)}" for value in values]
        mine = [number for number in numbers_with(numbers, quantity) if parameter in number.where]
        return answered(text, mine, f"{'; '.join(parts)}, over all spectra.")

    kept, off = "contact kept", "rms over linear [dB]"
    other = CLAIM.replace(SLOPE, HEIGHT)
    level = "The level leaves linear theory at the same {}, whatever the band of the roughness and its Hurst exponent."
    return (
        claim(CLAIM, KEPT, kept, SLOPE),
        claim(other, KEPT, kept, HEIGHT),
        claim(level.format(SLOPE), OFF, off, SLOPE),
        claim(level.format(HEIGHT), OFF, off, HEIGHT),
        *(_follows(case, model, numbers) for model in MODELS),
    )


def _follows(case: Validity, model: str, numbers: list[Number]) -> JudgedClaim:
    mine = [number for number in numbers_with(numbers, OFF_REDUCED, model) if SLOPE in number.where]
    parts = [
        f"at {SLOPE} = {value:g} the rms over one-third octaves is {min(of):.2f} to {max(of):.2f} dB"
        for value in _of(case, SLOPE)
        if (of := [number.value for number in mine if number.where[SLOPE] == value])
    ]
    return answered(FOLLOWS[model].format(max(_of(case, SLOPE))), mine, f"{'; '.join(parts)}, over all spectra.")


def _of(case: Validity, parameter: str) -> tuple[float, ...]:
    """Values of a parameter, as they are printed."""
    return tuple(_rounded(value) for of, value in case.levels if of == parameter)


def spread(table: Table, column: str, parameter: str, value: float) -> str:
    """The smallest and the largest over the spectra at one value of a parameter."""
    found = table.where(**{"at equal": parameter, parameter: value})[column]
    what, unit = ("the rms over linear theory is", " dB") if "dB" in column else ("the share kept is", "")
    return f"{what} {found.min():.2f} to {found.max():.2f}{unit}"


def _of_table_14_1(case: Validity, table: Table) -> str:
    """Where the wheel of the book stands, beside the nearest slope of this case."""
    scene = load_wheel_scene("table_14_1")
    height, slope = scene.rms / scene.approach, slope_ratio(scene.slope_along, scene)
    nearest = min(_of(case, SLOPE), key=lambda one: abs(math.log(one / slope)))
    return (
        f"The wheel of Table 14.1 has h/d = {height:.2g}, but h' a/d = {slope:.3g} along the track. At h' a/d = "
        f"{nearest:g}, the nearest here, {spread(table, 'rms over linear [dB]', SLOPE, nearest)}, and "
        f"{spread(table, 'contact kept', SLOPE, nearest)}."
    )


CASE = Case(
    name="rolling_validity",
    chapter=Chapter.ROLLING,
    place=4,
    claim=CLAIM,
    answers="Where linear theory of rolling ends: h' a/d or h/d, over bands and Hurst exponents",
    quick=Validity(strips=3, cells=6),
    full=Validity(
        slopes=tuple(slope_in_one_direction(gradient) for gradient in (0.1, 0.3, 1.0)),
        heights=(0.03, 0.1, 0.3),
        strips=6,
        waves=6,
        width=16,
    ),
    run=run,
    evidence=evidence,
    needs="boundary elements",
)
