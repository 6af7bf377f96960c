"""Which of h/d and h' a/d says where linear theory ends: other bands and other Hurst exponents at equal values."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim, Matrix
from validation.analysis.margins import REPEATABLE
from validation.analysis.series import Margin, Series
from validation.analysis.spectra import Bands
from validation.analysis.statistics import Estimate, ratio_of_means
from validation.analysis.study import Outcomes, Study
from validation.cases.rolling.settings import HEIGHT, SLOPE, SLOPE_COUNTS, rms_decibels
from validation.engine.convergence import require_realisations
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.scenes.description import slope_ratio
from validation.scenes.dynamic_wheel import load_wheel_scene
from validation.simulation.reduced_strip import FOLLOWING, LAYER, READ, over_boundary_elements, roll_reduced
from validation.simulation.rolling_strip import RoughStrip, Strip, correlation, roll_strips, strip_levels
from validation.simulation.track_spectrum import PiecewisePowerLaw, self_affine
from validation.theory.rolling import slope_in_one_direction

REFERENCE = "H = 0.7, q a = 1 to 10"
SPECTRA = {
    REFERENCE: self_affine(0.7, 1.0, 10.0),
    "H = 0.7, q a = 0.3 to 5": self_affine(0.7, 0.3, 5.0),
    "H = 0.7, q a = 2 to 20": self_affine(0.7, 2.0, 20.0),
    "H = 0.4, q a = 1 to 10": self_affine(0.4, 1.0, 10.0),
    "H = 1, q a = 1 to 10": self_affine(1.0, 1.0, 10.0),
}
STEEPEST = slope_in_one_direction(1.0)
"""h' a/d where the rms gradient g a/d is 1."""


@dataclass(frozen=True, kw_only=True)
class Validity:
    """A wheel at the approach d, contact radius a, over surfaces of all spectra, at equal h' a/d and at equal h/d.

    slopes, heights: values of both, ascending, h' along the track, of all waves; strips: realisations; waves: of the
    longest on the length of a surface; width: over a; cells: to a contact radius and, by four, to the shortest wave at
    least; seed: zero or positive.
    """

    slopes: tuple[float, ...] = (STEEPEST,)
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


def run(case: Validity, engine: Engine = SERIAL) -> Outcomes:
    """Roll over all spectra; what is found of each, at equal h' a/d or h/d, by quantity or reduced model.

    Raises NotConvergedError where fewer than three strips of one converge.
    """
    groups = {(name, *level): case.strips_of(name, *level) for name in SPECTRA for level in case.levels}
    strips, unconverged = roll_strips(groups, engine)
    reduced = engine.map_groups(roll_reduced, groups)
    found = {}
    for key, mine in groups.items():
        spectrum = SPECTRA[key[0]]
        bands = case.bands_for(spectrum)
        levels = strip_levels(strips[key], 1 / case.cells_for(spectrum), bands)
        over = {m: off_linear(over_boundary_elements(m, reduced[key], mine[0], levels, bands)) for m in FOLLOWING}
        found[key] = over | {
            KEPT: contact_kept(strips[key]),
            OFF: off_linear(levels),
            CORRELATION: correlation(levels)[0],
        }
    return Outcomes(case, found, unconverged)


def contact_kept(strips: list[Outcome]) -> Estimate:
    """Mean area of contact over that of a smooth wheel under the same force, which is as its power 2/3."""
    area, force = (np.array([strip[name] for strip in strips]) for name in ("area", "force"))
    return ratio_of_means(area.mean(axis=1), (np.maximum(force, 0.0) ** (2 / 3)).mean(axis=1))


def off_linear(outcome: Outcome) -> Estimate:
    """Root mean square over bands of the level over linear theory on the same surfaces [dB]."""
    return rms_decibels(np.stack([outcome["level"], outcome["linear level"]], axis=1))


KEPT, OFF, OFF_REDUCED = "share of contact kept", "rms level over linear theory", "rms level over boundary elements"
CORRELATION, TABLE_14_1 = "correlation with linear theory", "wheel of Table 14.1"
SPECTRUM, ALL = "spectrum", ", all spectra"
TENTH = Margin(tolerance=0.1, reason="0.1: a tenth of the contact", source=REFERENCE)
DECIBEL_APART, FOLLOWS = REPEATABLE.beside(REFERENCE), REPEATABLE.beside("boundary elements on the same surfaces")


def series(result: Outcomes) -> list[Series]:
    """Each spectrum beside that of reference, at equal h' a/d and at equal h/d; reduced models."""
    return [*_judged(result), *_shown(result), *_table_14_1()]


def _judged(result: Outcomes) -> Iterator[Series]:
    """Intervals hold at once for all values of a parameter and all spectra."""
    for name, parameter, value in result.found:
        mine, other = result[name, parameter, value], result[REFERENCE, parameter, value]
        values = len([one for one, _ in result.case.levels if one == parameter])
        single = partial(Series, where={parameter: _rounded(value), SPECTRUM: name})
        if name != REFERENCE:
            beside = partial(single, family=values * (len(SPECTRA) - 1))
            yield beside(KEPT, "bem3d", (mine[KEPT],), reference=(other[KEPT],), margin=TENTH)
            yield beside(OFF, "bem3d", (mine[OFF],), reference=(other[OFF],), unit="dB", margin=DECIBEL_APART)
        for model in FOLLOWING:
            yield single(OFF_REDUCED, model, (mine[model],), unit="dB", margin=FOLLOWS, family=values * len(SPECTRA))


def _shown(result: Outcomes) -> Iterator[Series]:
    """All that is found of a spectrum, the lowest first."""
    for name, spectrum in SPECTRA.items():
        heights = {key: height_at(*key) for key in result.found if key[0] == name}
        for key in sorted(heights, key=heights.__getitem__):
            mine, height = result[key], heights[key]
            at = {SPECTRUM: name, "at equal": key[1], HEIGHT: height, SLOPE: height * spectrum.slope_along}
            for quantity in (KEPT, OFF, CORRELATION):
                yield Series(quantity + ALL, "bem3d", (mine[quantity],), where=at)
            for model in FOLLOWING:
                yield Series(OFF_REDUCED + ALL, model, (mine[model],), where=at)


def _table_14_1() -> Iterator[Series]:
    scene = load_wheel_scene("table_14_1")
    yield Series(TABLE_14_1, HEIGHT, (scene.rms / scene.approach,))
    yield Series(TABLE_14_1, SLOPE, (slope_ratio(scene.slope_along, scene),))


def _rounded(value: float) -> float:
    return float(f"{value:.3g}")


BARS = partial(Curve, by=(SPECTRUM,), bars=True, beside=1.0)


def _panels(y: str, *curves: Curve, **settings: Any) -> tuple[Panel, Panel]:
    return Panel(HEIGHT, y, **settings).of(*curves), Panel(SLOPE, y, **settings).of(*curves)


STUDY = Study(
    title="Where linear theory ends: h' a/d against h/d, over bands and Hurst exponents",
    method=(
        f"A wheel rolls at a fixed approach over surfaces of {len(SPECTRA)} spectra, once with equal h' a/d and "
        f"once with equal h/d. {SLOPE_COUNTS}. Boundary elements: {{c.strips}} surfaces each, "
        "{c.waves} of their longest waves long, at least {c.cells} cells to a radius and four to the "
        "shortest wave. The share of contact kept is the mean area over that of a smooth wheel under the same "
        "force; cells at its edge may make it a little more than one. The level over linear theory on the "
        "same surfaces is taken in one-third octaves of the band; its root mean square over bands counts. Each "
        f"spectrum is judged beside {REFERENCE}. Springs that read the surface and a pressed layer, on half of the "
        "cells, roll over the same surfaces and are judged beside boundary elements."
    ),
    series=series,
    claims=(
        *(
            Claim(quantity=quantity, where={parameter: ...}).saying(
                f"{what} at the same {parameter}, whatever the band of the roughness and its Hurst exponent.",
                short=f"{short} over all spectra at equal {parameter}",
            )
            for what, short, quantity in (
                ("Contact is lost", "Contact kept", KEPT),
                ("The level leaves linear theory", "Level off linear theory", OFF),
            )
            for parameter in (SLOPE, HEIGHT)
        ),
        *(
            Claim(quantity=OFF_REDUCED, model=model, where={SLOPE: ...}).saying(
                f"{what} boundary elements within 1 dB up to h' a/d of {STEEPEST:.3g}, in all bands."
            )
            for model, what in ((READ, "Springs that read the surface follow"), (LAYER, "A pressed layer follows"))
        ),
    ),
    charts=(
        Chart("rolling_validity", claims=(0, 1), columns=2, width=9.0, height=8.6).of(
            "Over h/d (left) and over h' a/d (right), by spectrum. (a), (b) Share of contact kept on boundary "
            "elements. (c), (d) Root mean square over one-third octaves of the level over linear theory; line: 1 dB. "
            "(e), (f) The same of reduced models over boundary elements; solid: pressed layer, dashed: springs that "
            "read the surface. Bars: 95 %. Curves that lie on each other show the parameter that counts.",
            *_panels(KEPT, BARS(KEPT + ALL)),
            *_panels("rms over linear theory [dB]", BARS(OFF + ALL), lines=(1.0,), ylim=(0.0, None)),
            *_panels(
                "rms over bem3d [dB]",
                BARS(OFF_REDUCED + ALL, LAYER),
                Curve(OFF_REDUCED + ALL, READ, "graded dashed", "_", by=(SPECTRUM,)),
                lines=(1.0,),
                ylim=(0.0, None),
            ),
        ),
    ),
    matrices=tuple(
        Matrix(
            name=f"{what} at equal {parameter}",
            quantity=quantity,
            rows=(parameter, SPECTRUM),
            columns=columns,
            where={parameter: ...},
        )
        for parameter in (SLOPE, HEIGHT)
        for what, quantity, columns in (
            ("boundary elements beside " + REFERENCE, (KEPT, OFF), "quantity"),
            ("reduced models over boundary elements [dB]", OFF_REDUCED, "model"),
        )
    ),
    printed=(CORRELATION + ALL, TABLE_14_1),
)
CASE = Case(
    name="rolling_validity",
    chapter=Chapter.ROLLING,
    place=4,
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
    study=STUDY,
    needs="boundary elements",
)
