"""Fig. 14.4: the spectrum of the acceleration of a rolling wheel, its regions, and what moves them."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from validation.analysis.evidence import Role
from validation.analysis.series import MARGINS, Estimates, Margin, Where
from validation.analysis.spectra import band_levels, band_means, one_third_octaves
from validation.case import SERIAL, Engine, Outcomes, Quantity, Series
from validation.cases.wheel import ensembles
from validation.cases.wheel.ensembles import TABLE, decibels
from validation.engine.engine import Outcome
from validation.engine.realisations import NotConvergedError
from validation.scenes.rolling import RollingScene
from validation.simulation import wheel_features
from validation.simulation.wheel_on_springs import WheelEnsemble, simulate_ensemble
from validation.theory import rolling as wheel_theory


@dataclass(frozen=True, kw_only=True)
class WheelSpectrum:
    """An ensemble of wheels of a scene on springs, and the same with one parameter changed at a time.

    scene; realisations: of the scene itself; varied: of each variation; groups: into which both are divided for error
    bars; batch: wheels that are simulated together, at most; parameters: whether to vary any; seed: zero or positive.
    """

    scene: RollingScene = TABLE
    realisations: int = 60
    varied: int = 20
    groups: int = 10
    batch: int = 150
    parameters: bool = True
    seed: int = 146

    def variations(self) -> Mapping[str, RollingScene]:
        varied = _varied(self.scene) if self.parameters else {}
        if self.scene.name in varied:
            raise ValueError(f"name must be another than those of variations, {', '.join(varied)}, got that")
        return {self.scene.name: self.scene, **varied}

    def batches(self) -> dict[str, list[WheelEnsemble]]:
        """Of each variation: of equal size, each of whole groups, with a few wheels more where that is necessary."""
        return {
            name: self._batches(scene, self.realisations if scene is self.scene else self.varied)
            for name, scene in self.variations().items()
        }

    def _batches(self, scene: RollingScene, realisations: int) -> list[WheelEnsemble]:
        batches = math.ceil(realisations / self.batch)
        groups = max(self.groups // batches, 1)
        count = groups * math.ceil(realisations / batches / groups)
        return [
            WheelEnsemble(scene=scene, first=i * count, count=count, groups=groups, seed=self.seed)
            for i in range(batches)
        ]


def run(case: WheelSpectrum, engine: Engine = SERIAL) -> Outcomes:
    """Simulate all wheels of all variations."""
    ensembles.hurst(case.scene)  # which a smooth one has not
    batches = engine.map_groups(simulate_ensemble, case.batches())
    failed = [name for name, group in batches.items() if any(batch["failed"] for batch in group)]
    if failed:
        raise NotConvergedError("wheels flew higher than sums are exact for", failed)
    return Outcomes(case, batches)


def _varied(scene: RollingScene) -> dict[str, RollingScene]:
    """One parameter at a time, down and up."""
    varied = {f"v₀ × {factor:g}": replace(scene, speed=factor * scene.rolling_speed) for factor in (0.25, 2.0)}
    rail = scene.rail
    if rail is None:
        return varied
    rails = {f"q_min × {factor:g}": replace(rail, longest=rail.longest / factor) for factor in (0.5, 2.0)}
    rails |= {f"q_max × {factor:g}": replace(rail, shortest=rail.shortest / factor) for factor in (0.5, 2.0)}
    rails |= {f"H = {hurst:g}": replace(rail, hurst=hurst) for hurst in (0.4, 1.0)}
    rails |= {f"h₀ × {factor:g}": replace(rail, rms=factor * rail.rms) for factor in (0.25, 4.0)}
    return varied | {name: replace(scene, ground=rail) for name, rail in rails.items()}


SPECTRUM, VARIED = Quantity("A_in_twelfths_of_an_octave"), Quantity("A_with_one_parameter_changed")
OSCILLATION = Quantity("A_over_its_mean_law_ω_-2H-3", "A over its mean law ω^(-2H-3)")
MARKS = Quantity("marks_rad_s", "marks [rad/s]")
PARAMETER = "parameter"
NO_WINDOW, HANN, LINEAR = "no window, (14.17)", "Hann's window", "linear theory"
LOWEST, HIGHEST, PREDICTED_FLOOR = "lowest tenth of wheels", "highest tenth of wheels", "floor predicted"
SOURCES = {
    ensembles.PEAK: "sqrt(2 a E* / M)",
    ensembles.JUMP: "q_min v₀, (14.20)",
    ensembles.SLOPE: "-2 H - 3, (14.13)",
    ensembles.PERIOD: "π v₀ / a, (14.12)",
}
"""Of the features that are judged."""
OF_PARAMETERS = ensembles.PEAK, ensembles.JUMP
"""Of these what the book says that no parameter changes."""
CHANGED, NOTHING = "changed", "unchanged"
BANDS_PER_PERIOD = 12
"""Of the oscillation."""
BALANCE = Margin(
    1e-11, "rounding of a sum over all steps", source="Newton: mean force and load balance", role=Role.IDENTITY
)
OVER_LINEAR = MARGINS["level"].with_source("(14.12) through the resonator: a contact of fixed radius")


def series(result: Outcomes) -> list[Series]:
    """Features beside theory for the scene and for each variation; level of region 3; identities."""
    spectra = spectra_of(result)
    base, spectrum = next(iter(spectra.items()))
    return [
        *_identities([batch for name in spectra for batch in result[name]]),
        *features_by_scene(result),
        *levels_over_linear(spectrum),
        *_curves(spectrum, result[base]),
        *(_in_sixths(name, of_scene) for name, of_scene in spectra.items() if name != base),
    ]


def spectra_of(result: Outcomes) -> dict[str, ensembles.Spectrum]:
    """Of the scene itself first."""
    return {name: ensembles.Spectrum.of(scene, result[name]) for name, scene in result.case.variations().items()}


def family_of(case: WheelSpectrum) -> int:
    """Numbers of the claim on Fig. 14.4, whose intervals hold at once: of the scene itself, peak and jump of others."""
    return len(SOURCES) + len(OF_PARAMETERS) * (len(case.variations()) - 1)


def features_by_scene(result: Outcomes) -> list[Series]:
    """Those that each spectrum has, beside theory; of the scene itself first."""
    case, family = result.case, family_of(result.case)
    return [
        Series(
            quantity,
            "springs",
            (values[key],),
            where={"scene": case.scene.name, CHANGED: NOTHING if name == case.scene.name else name},
            reference=theory[key],
            grid=float(spectrum.omega[0]) / 2 if key == ensembles.JUMP else 0.0,
            unit="-" if key == ensembles.SLOPE else "rad/s",
            margin=MARGINS[key].with_source(SOURCES[key]),
            family=family,
        )
        for name, spectrum in spectra_of(result).items()
        for values, theory in [(ensembles.measured(spectrum), ensembles.expected(spectrum))]
        for key, quantity in ensembles.QUANTITIES.items()
        if key in values
    ]


def levels_over_linear(spectrum: ensembles.Spectrum) -> list[Series]:
    """One-third octaves of region 3 over (14.12) through the resonator, up to where the floor is far below."""
    scene, omega = spectrum.scene, spectrum.omega
    first = max(1.2 * scene.jump, wheel_features.FREE_MASS * scene.eigenfrequency)
    last = min(0.7 * ensembles.expected(spectrum)[ensembles.BREAK], 0.9 * scene.cutoff)
    edges = one_third_octaves(first, last) if first < last else np.empty(0)
    if edges.size < 2:
        return []
    levels = Estimates.ratios(band_levels(omega, spectrum.hann.T, edges).T, band_levels(omega, spectrum.linear, edges))
    centres = np.sqrt(edges[1:] * edges[:-1])
    place: Where = {"region": ensembles.THIRD}
    over = partial(decibels, ensembles.LEVEL, "springs over linear theory", where=place, along=ensembles.OMEGA)
    return [over(levels, at=centres, margin=OVER_LINEAR)]


def _identities(batches: list[Outcome]) -> Iterator[Series]:
    wheels = sum(batch["jump"].size for batch in batches)
    yield Series(
        "mean of F - F_N less M times the velocity change over T, over the rms of F - F_N",
        "",
        (max(float(np.abs(batch["balance"]).max()) for batch in batches),),
        where={"wheels": f"worst of {wheels} wheels"},
        margin=BALANCE,
    )


def _curves(spectrum: ensembles.Spectrum, batches: list[Outcome]) -> Iterator[Series]:
    """Fig. 14.4 in twelfths of an octave, with the spread over wheels; region 3 over the power law of its level."""
    scene, omega, theory, edges = (
        spectrum.scene,
        spectrum.omega,
        ensembles.expected(spectrum),
        batches[0]["bands"],
    )
    of_wheels, centres = np.concatenate([batch["levels"] for batch in batches], axis=1), np.sqrt(edges[1:] * edges[:-1])
    # linear theory has nothing below the jump, and is infinite at the resonance
    linear = {part: np.where(omega < part * scene.jump, 0.0, spectrum.linear) for part in (0.9, 0.5)}
    hann, jump = spectrum.hann.mean(axis=0), math.sqrt(np.mean(spectrum.jumps**2))
    floor = wheel_theory.leakage(centres, jump=jump, time_step=spectrum.time_step, duration=spectrum.duration)
    for model, values in {
        NO_WINDOW: of_wheels.mean(axis=1),
        LOWEST: np.quantile(of_wheels, 0.1, axis=1),
        HIGHEST: np.quantile(of_wheels, 0.9, axis=1),
        HANN: band_means(omega, hann, edges),
        LINEAR: band_means(omega, linear[0.9], edges),
        PREDICTED_FLOOR: floor,
    }.items():
        yield ensembles.density_of(SPECTRUM, model, values, at=centres)
    width = max(theory[ensembles.PERIOD] / BANDS_PER_PERIOD, omega[0])
    bands, law = np.arange(0.9 * scene.jump, 1.1 * scene.cutoff, width), omega ** theory[ensembles.SLOPE]
    mean = float(np.mean((linear[0.5] / law)[(omega > scene.jump) & (omega < scene.cutoff)]))
    for model, density in {NO_WINDOW: spectrum.plain.mean(axis=0), HANN: hann, LINEAR: linear[0.5]}.items():
        over = band_means(omega, density / law, bands) / mean
        yield Series(OSCILLATION, model, over, along=ensembles.OMEGA, at=(bands[1:] + bands[:-1]) / 2)
    marks = scene.eigenfrequency, scene.jump, theory[ensembles.BREAK], scene.cutoff
    for name, at in zip(("ω_eigen", "q_min v₀", "break", "q_max v₀"), marks, strict=True):
        yield Series(MARKS, name, (at,))


def _in_sixths(name: str, spectrum: ensembles.Spectrum) -> Series:
    low, high = float(spectrum.omega[2]), 1.5 * spectrum.scene.cutoff
    omega, density = ensembles.in_sixths(spectrum.omega, spectrum.plain.mean(axis=0), low, high)
    where = {PARAMETER: name.split(" ")[0], "scene": name}
    return ensembles.density_of(VARIED, "springs", density, where=where, at=omega)
