"""Region 2 and its neighbours: its oscillation, the second-order force that makes it, and low speeds."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from validation.analysis import spectral_features
from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim
from validation.analysis.margins import MARGINS
from validation.analysis.series import Estimates, Margin, Series
from validation.analysis.spectra import band_levels, band_means, one_third_octaves
from validation.analysis.statistics import POWER_DECIBEL, FloatArray, jackknifed
from validation.analysis.study import Outcomes, Study
from validation.cases.wheel import features
from validation.cases.wheel.features import CONTRAST, DENSITY, JUMP, LEVEL, OMEGA, QUANTITIES, TABLE, decibels
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import SERIAL, Engine
from validation.scenes.dynamic_wheel import WheelScene
from validation.selection import model_needed
from validation.simulation.wheel_on_springs import WheelEnsemble, simulate_ensemble
from validation.theory import rolling as rolling_theory

LONG_STEADY, SHORT_STEADY, SHORT_OPEN = "Table 14.1, steady-state", "short waves, steady-state", "short waves, open"


@dataclass(frozen=True, kw_only=True)
class WheelRegions:
    """Wheels on springs over waves as long as those of a scene, over shorter ones, and at lower and lower speeds.

    scene: its rail is rough; distance: of the records of region 2 [m]; springs: to a contact radius there; short:
    longest of the shorter waves [m]; rms: their height [m]; wheels: of each ensemble; groups: of wheels, for errors;
    ratios: q_min v_0 over the eigenfrequency, falling; periods: natural periods of each record at these speeds; coarse:
    shortest wave there [m]; seed: zero or positive.
    """

    scene: WheelScene = TABLE
    distance: float = 0.3
    springs: int = 64
    short: float = 1e-3
    rms: float = 0.18e-6
    wheels: int = 20
    groups: int = 20
    ratios: tuple[float, ...] = (6.0, 3.0, 2.0, 1.6, 1.4, 1.3, 1.2, 1.15, 1.1, 1.05, 1.0)
    periods: int = 30
    coarse: float = 1e-3
    seed: int = 149

    @property
    def q_min_a(self) -> tuple[float, float]:
        """Of the scene, and of the shorter waves [-]."""
        a = self.scene.contact_radius
        return a * self.scene.jump / self.scene.speed, 2 * math.pi * a / self.short

    def plateaus(self) -> dict[str, WheelEnsemble]:
        """Records of region 2: on long waves and on short ones, without leakage and with it."""
        scene = replace(self.scene, distance=self.distance, springs=self.springs)
        assert scene.rail is not None  # as checked
        short = replace(scene, rail=replace(scene.rail, longest=self.short, rms=self.rms))
        one = WheelEnsemble(scene=scene, count=self.wheels, groups=self.groups, track="steady-state", seed=self.seed)
        return {
            LONG_STEADY: one,
            SHORT_STEADY: replace(one, scene=short),
            SHORT_OPEN: replace(one, scene=short, track="open"),
        }

    def speeds(self) -> dict[float, WheelEnsemble]:
        """Open tracks of the same number of natural periods."""
        rail = self.scene.rail
        assert rail is not None  # as checked
        slow = replace(self.scene, springs=24, rail=replace(rail, shortest=self.coarse))
        scenes = {ratio: replace(slow, speed=ratio * slow.eigenfrequency / rail.q_min) for ratio in self.ratios}
        wheels = partial(WheelEnsemble, count=self.wheels, groups=self.groups, seed=self.seed)
        return {r: wheels(scene=replace(one, distance=self.periods * one.period_length)) for r, one in scenes.items()}


def run(case: WheelRegions, engine: Engine = SERIAL) -> Outcomes:
    """Simulate all wheels. Raises ValueError for a smooth rail, NotConvergedError where a wheel does not converge."""
    if case.scene.rail is None or case.scene.wheel is not None:
        raise ValueError("scene must have a rough rail and a smooth wheel")
    ensembles: dict[Any, WheelEnsemble] = {**case.plateaus(), **case.speeds()}
    found = dict(zip(ensembles, engine.map(simulate_ensemble, list(ensembles.values())), strict=True))
    if failed := [f"wheels of {key}" for key, one in found.items() if one["failed"]]:
        raise NotConvergedError("wheels on springs do not repeat their motion, or flew too high", failed)
    return Outcomes(case, found)


RATIO, MAXIMUM = "q_min v₀ / ω_eigen", "maximum of cos²(q a)"
OVER_EIGEN, VALLEY, A, BY_SPEED = "ω / ω_eigen", "valley before the jump [dB]", "A of region 2", "A by speed"
MERGED, MERGES, SECOND_ORDER = f"{RATIO} at which the plateau disappears", "merges at", "second-order force"
FIRST, LAST = 3.0, 0.9
"""Region 2 begins at this multiple of the eigenfrequency and ends at this of q_min v_0."""
OF_SECOND_ORDER = 3
"""Numbers of its claim, whose intervals hold at once: two levels and a contrast."""
RESOLVED = 2
"""Lines between two tones of equal height that Hann's window keeps apart: the width of its main lobe at half height."""
APART = 3.0
"""Decibels by which a valley stands below the jump behind it."""
FORCE = "(E* R / 2a)² cos²(q a) 2 int C_1D(k) C_1D(q - k) dk, through the resonator"


def series(result: Outcomes) -> list[Series]:
    return [*_plateaus(result), *_speeds(result)]


def second_order(scene: WheelScene, omega: FloatArray) -> FloatArray:
    """A of the second-order force of springs through the resonator, up to region 3; zero there."""
    inside = omega < scene.jump
    force = rolling_theory.second_order_force_spectrum(
        omega[inside] / scene.speed,
        features.roughness(scene),
        q_max=scene.cutoff / scene.speed,
        contact_radius=scene.contact_radius,
        radius=scene.radius,
        modulus=scene.modulus,
    )
    found = np.zeros(omega.size)
    found[inside] = features.accelerated_by(force, scene, omega[inside])
    return found


def _plateaus(result: Outcomes) -> Iterator[Series]:
    """A in bands of a part of a period, up to region 3; one-third octaves and contrasts."""
    for name, ensemble in result.case.plateaus().items():
        scene, omega, groups = ensemble.scene, result[name]["omega"], result[name]["plain"]
        theory, place = second_order(scene, omega), {"region": "region 2"}
        width = max(scene.oscillation_period / 12, 2 * float(omega[0]))
        edges = np.arange(FIRST * scene.eigenfrequency, 1.2 * scene.jump, width)
        by_omega = partial(Series, A, along=OMEGA, at=(edges[1:] + edges[:-1]) / 2)
        yield by_omega(name, band_means(omega, groups.mean(axis=0), edges))
        if name != SHORT_OPEN:
            # no band that reaches into region 3
            means = np.where(edges[1:] < scene.jump, band_means(omega, theory, edges), 0.0)
            yield by_omega(f"{name}, {SECOND_ORDER}", means)
            thirds = one_third_octaves(FIRST * scene.eigenfrequency, LAST * scene.jump)
            levels = (band_levels(omega, density, thirds) for density in (groups.T, theory))
            yield decibels(
                LEVEL,
                f"{name}, over the second-order force",
                Estimates.ratios(next(levels).T, next(levels)),
                where=place,
                along=OMEGA,
                at=np.sqrt(thirds[1:] * thirds[:-1]),
                family=OF_SECOND_ORDER,
                margin=MARGINS["level"].beside(FORCE),
            )
        if name != LONG_STEADY:
            contrasts = partial(log_contrasts, scene, omega)
            source = "no substructure" if name == SHORT_OPEN else "the second-order force in the same bands"
            yield decibels(
                CONTRAST,
                name,
                jackknifed(contrasts, groups),
                where=place,
                along=MAXIMUM,
                at=maxima_of(scene),
                reference=0.0 if name == SHORT_OPEN else Estimates.exact(contrasts(theory[np.newaxis])),
                family=OF_SECOND_ORDER,
                margin=MARGINS["contrast"].beside(source),
            )


def maxima_of(scene: WheelScene) -> FloatArray:
    """The numbers n of the maxima q a = n pi of cos²(q a) that have both of their zeros in region 2."""
    return np.arange(1.0, math.floor(LAST * scene.jump / scene.oscillation_period - 0.5) + 1)


def log_contrasts(scene: WheelScene, omega: FloatArray, groups: FloatArray) -> FloatArray:
    """ln of the mean of A omega^2 about each maximum of cos²(q a) over that about the zeros beside it."""
    flat = groups.mean(axis=0) * omega**2
    return -features.log_beside_over_at(omega / scene.oscillation_period, flat, maxima_of(scene))


def _speeds(result: Outcomes) -> Iterator[Series]:
    """Spectra by speed; the jump, as long as a valley is before it; the valley, and where it ends."""
    case, depths, jumps, beside, lines = result.case, [], {}, [], []
    for ratio, ensemble in case.speeds().items():
        scene, omega, groups = ensemble.scene, result[ratio]["omega"], result[ratio]["hann"]
        x, hann = omega / scene.eigenfrequency, groups.mean(axis=0)
        near = (x > 0.5) & (x < 1.5 * max(ratio, 2))
        yield Series(BY_SPEED, "springs, open", hann[near], where={RATIO: ratio}, along=OVER_EIGEN, at=x[near])
        depths.append(valley(scene, omega, hann))
        if depths[-1] > APART and ratio > 1.5:
            (jumps[ratio],) = jackknifed(partial(_jump, scene, omega), groups)
            beside.append(scene.jump)
            lines.append(float(omega[0]) / 2)
    by_ratio = partial(Series, model="springs, open", along=RATIO)
    yield by_ratio(VALLEY, found=depths, at=case.ratios)
    yield by_ratio(
        QUANTITIES[JUMP],
        found=list(jumps.values()),
        at=list(jumps),
        reference=Estimates.exact(beside),
        grid=lines,
        unit="rad/s",
        margin=MARGINS[JUMP].beside("q_min v₀, (14.20)"),
    )
    yield merging(case, np.array(depths))
    yield Series(MERGES, f"1 + {RESOLVED} / N", (1 + RESOLVED / case.periods,))


def valley(scene: WheelScene, omega: FloatArray, hann: FloatArray) -> float:
    """How far A falls between the resonance and the jump, below the rise behind it [dB]; 0 where no line is there."""
    between = (omega > scene.eigenfrequency) & (omega < scene.jump)
    behind = (omega >= scene.jump) & (omega < 1.2 * scene.jump)
    if not between.any():
        return 0.0
    return max(POWER_DECIBEL * math.log(hann[behind].max() / hann[between].min()), 0.0)


def _jump(scene: WheelScene, omega: FloatArray, hann: FloatArray) -> FloatArray:
    between = math.sqrt(scene.eigenfrequency * scene.jump)
    return np.array(spectral_features.jump(omega, hann.mean(axis=0), between, scene.cutoff / 2))


def merging(case: WheelRegions, depths: FloatArray) -> Series:
    """q_min v_0 over the eigenfrequency below which no valley separates regions 1 and 2 from region 3."""
    ratios = np.array(case.ratios[::-1])
    last = int(np.flatnonzero(depths[::-1] < APART).max(initial=-1))
    low, high = ratios[last] if last >= 0 else 0.0, ratios[min(last + 1, ratios.size - 1)]
    lines = Margin(
        3 / case.periods,
        "three lines of the record: the jump is no tone, and the resonance is higher than it",
        source=f"1 + {RESOLVED} / N: a record of N natural periods keeps apart what lies {RESOLVED} lines apart",
    )
    return Series(
        MERGED,
        "springs, open",
        (float((low + high) / 2),),
        where={"natural periods": float(case.periods), "window": "Hann's window"},
        reference=1 + RESOLVED / case.periods,
        grid=float((high - low) / 2),
        margin=lines,
    )


MODEL = ("model",)


def plateau_panel(steady: str, *more: Curve) -> Panel:
    curves = (
        Curve(A, f"{steady}, {SECOND_ORDER}", "exact", SECOND_ORDER),
        Curve(A, steady, "mdr", "springs, steady-state"),
        *more,
    )
    return Panel(OMEGA, DENSITY, log="y").of(*curves)


STUDY = Study(
    title="Region 2: its substructure, and its end at low speed",
    method=(
        "{c.wheels} wheels of {c.scene.name} on springs over {c.distance:g} m: in the steady state, where nothing "
        "leaks, over its own waves and over waves of {c.short:g} m and less, h₀ = {c.rms:g} m; over the latter also on "
        "open tracks without window. q_min a is {c.q_min_a:.3g}. The second-order force is that of the springs which "
        "the ends of the contact gain and lose, E* R / 4a (h(x + a)² + h(x - a)²). Speeds: {c.wheels} wheels on open "
        "tracks of {c.periods} natural periods, Hann's window; the valley is the least A between ω_eigen and q_min v₀ "
        "under the largest within a fifth behind q_min v₀."
    ),
    series=series,
    claims=(
        Claim(quantity=CONTRAST, model=SHORT_OPEN, differ=True).saying(
            "The plateau of region 2 has a substructure or none, depending on the parameters.",
            short="Maxima and zeros of region 2 over short waves",
        ),
        Claim(either=({"quantity": LEVEL}, {"quantity": CONTRAST, "model": SHORT_STEADY})).saying(
            "Without leakage, region 2 of springs is the second-order force of the roughness.",
            short="region 2 without leakage beside the second-order force",
        ),
        Claim(quantity=(QUANTITIES[JUMP], MERGED)).saying(
            "At low speed the jump comes to the resonance, and the plateau disappears.",
            short="the end of its plateau at low speed",
        ),
    ),
    charts=(
        Chart("wheel_regions", claims=(0, 2), columns=2, height=7.2).of(
            "(a) Region 2 over waves of {c.short:g} m and less, and (b) over those of {c.scene.name}. (c) Spectra at "
            "lower and lower speeds, dark to light. (d) The valley between resonance and jump; dotted: where a record "
            f"of this length no longer keeps them apart; line: {APART:g} dB.",
            plateau_panel(SHORT_STEADY, Curve(A, SHORT_OPEN, "guide", "springs, open tracks")),
            plateau_panel(LONG_STEADY),
            Panel(OVER_EIGEN, DENSITY, log="xy").of(Curve(BY_SPEED, by=(RATIO,))),
            Panel(RATIO, VALLEY, lines=(APART,)).of(
                Curve(VALLEY, label="_"), Curve(MERGES, style="guide", upright=True)
            ),
        ),
    ),
)
CASE = Case(
    name="wheel_regions",
    chapter=Chapter.WHEEL,
    place=4,
    answers="Regions 1 and 2: the substructure of the plateau, the force that makes it, and where it ends at low speed",
    quick=WheelRegions(wheels=10, groups=10),
    full=WheelRegions(distance=0.4, springs=96, rms=0.15e-6, wheels=80, periods=60),
    run=run,
    study=STUDY,
    needs=model_needed.wheel,
)
