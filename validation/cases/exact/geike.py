"""Geike's rule: which moments it keeps between one and two dimensions, and how it differs from a line trace."""

from dataclasses import dataclass
from functools import partial

import numpy as np

import bem3d
import mdr
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Role, Table, columns, if_confirmed
from validation.cases.exact.spectral_moments import (
    line_moment,
    mean_power_of_cosine,
    sum_over_profile,
    sum_over_surface,
    surface_moment,
)
from validation.engine.engine import SERIAL, Engine, Outcome, random_generator
from validation.theory import closed_forms

MOMENTS = (0, 1, 2, 3, 4)
NAMED = {0: "mean square height", 2: "mean square gradient", 4: "mean square curvature"}
MEASURED = {0: "height", 2: "gradient", 4: "curvature"}
GEIKE, LINE = "Geike's 1D spectrum", "line trace"


@dataclass(frozen=True, kw_only=True)
class Geike:
    """Self-affine roughness of one band, drawn in one and in two dimensions and measured back.

    hurst; rms [m]; length: period of both [m]; longest: waves of length L / longest begin the band, four cells a wave
    end it; cells: a side and along the profile; surfaces: drawn of each kind; seed: zero or positive.
    """

    hurst: float = 0.7
    rms: float = 1e-6
    length: float = 1e-2
    longest: int = 8
    cells: int = 512
    surfaces: int = 4
    seed: int = 14

    @property
    def spectrum(self) -> mdr.SelfAffine:
        """C_2D of the surfaces."""
        wave = 2 * np.pi / self.length
        return mdr.SelfAffine(hurst=self.hurst, q_min=self.longest * wave, q_max=self.cells // 4 * wave, rms=self.rms)

    @property
    def spacing(self) -> float:
        """Side of a cell [m]."""
        return self.length / self.cells


@dataclass(frozen=True, kw_only=True)
class Draw:
    """One realisation."""

    case: Geike
    realisation: int


@dataclass(frozen=True)
class GeikeResult:
    """What was measured on the draws, one outcome a realisation for each kind of roughness."""

    case: Geike
    profiles: list[Outcome]
    surfaces: list[Outcome]


def run(case: Geike, engine: Engine = SERIAL) -> GeikeResult:
    draws = [Draw(case=case, realisation=i) for i in range(case.surfaces)]
    return GeikeResult(case, engine.map(measure_profile, draws), engine.map(measure_surface, draws))


def measure_profile(draw: Draw) -> Outcome:
    """Mean squares of height, gradient and curvature of a profile, and its spectrum."""
    case = draw.case
    height = mdr.rough_profile(
        case.spectrum.c1d, length=case.length, points=case.cells, rng=random_generator(case.seed, 1, draw.realisation)
    )
    power = np.abs(np.fft.fft(height, norm="forward")) ** 2
    q = 2 * np.pi * np.abs(np.fft.fftfreq(case.cells, case.spacing))
    return {
        "height": np.mean(height**2),
        "gradient": np.sum(q**2 * power),
        "curvature": np.sum(q**4 * power),
        "spectrum": power[: case.cells // 2] * case.length / (2 * np.pi),
    }


def measure_surface(draw: Draw) -> Outcome:
    """Mean squares of height, gradient and curvature of a surface, and the spectrum of its lines."""
    case = draw.case
    shape = case.cells, case.cells
    height = bem3d.rough_surface(
        case.spectrum.c2d, shape=shape, spacing=case.spacing, rng=random_generator(case.seed, 2, draw.realisation)
    )
    power = np.abs(np.fft.fft2(height, norm="forward")) ** 2
    q = 2 * np.pi * np.fft.fftfreq(case.cells, case.spacing)
    square = q[:, np.newaxis] ** 2 + q**2
    lines = np.mean(np.abs(np.fft.fft(height, axis=0, norm="forward")) ** 2, axis=1)
    return {
        "height": np.mean(height**2),
        "gradient": np.sum(square * power),
        "curvature": np.sum(square**2 * power),
        "line_gradient": np.sum(q**2 * lines),
        "spectrum": lines[: case.cells // 2] * case.length / (2 * np.pi),
    }


def evidence(result: GeikeResult) -> Evidence:
    """Moments of the spectra and of the draws; spectra measured on profiles and along lines of surfaces."""
    case, spectrum = result.case, result.case.spectrum
    surface = {n: surface_moment(spectrum, n) for n in MOMENTS}
    ratios = {
        rule: {n: line_moment(c1d, spectrum, n) / surface[n] for n in MOMENTS}
        for rule, c1d in ((GEIKE, spectrum.c1d), (LINE, spectrum.line))
    }
    profiles = {n: sum_over_profile(spectrum.c1d, n, case.cells, case.length) for n in NAMED}
    surfaces = {n: sum_over_surface(spectrum.c2d, n, case.cells, case.length) for n in NAMED}
    spectra = _spectra(result)
    exact = _of_spectra(ratios)
    return Evidence(
        title="Geike's rule",
        method=(
            f"Self-affine roughness, H = {case.hurst:g}, waves from L/{case.longest} to L/{case.cells // 4}: moments "
            f"of the spectra by quadrature, and of {case.surfaces} profiles of {case.cells} points and "
            f"{case.surfaces} surfaces of {case.cells}² cells drawn from them, fixed amplitudes, random phases."
        ),
        numbers=(
            *exact,
            *_of_draws("drawn profiles", result.profiles, profiles, surface),
            *_of_draws("drawn surfaces", result.surfaces, surfaces, surface),
            *_of_lines(result, spectra),
        ),
        tables=(spectra, _moments(ratios)),
        conclusions=(
            if_confirmed(
                "Geike's rule keeps every moment of the surface; the line trace keeps the mean square height but has "
                f"{100 * (1 - ratios[LINE][2]):.1f} % less mean square gradient.",
                exact,
            ),
            f"Lines cut from the drawn surfaces have {_mid_band(case, spectra, 'geike [m^3]'):.3f} of Geike's spectrum "
            "in the middle of the band; an unbounded power law would have "
            f"{closed_forms.line_trace_ratio(case.hurst):.3f}.",
            "The sum over the waves of a period exceeds the integral of a spectrum that begins near the first wave "
            f"(by {100 * (profiles[0] / surface[0] - 1):.1f} % in 1D here). Ensembles that are normalised by the rms "
            "height therefore prescribe it.",
        ),
        captions={
            "geike": (
                "(a) Spectra: Geike's 1D spectrum and the line trace, with those measured on drawn profiles and along "
                "lines of drawn surfaces (every wave in the CSV, some in the figure). (b) n-th moment of both over "
                "that of the surface."
            )
        },
    )


def _of_spectra(ratios: dict[str, dict[int, float]]) -> list[Number]:
    """Moments of both rules over those of the surface."""
    why = "exact; error of the quadrature"
    rules = (
        (GEIKE, lambda n: 1.0, "(10.12)", 1e-9, why),
        (LINE, mean_power_of_cosine, "mean of |cos|^n over directions", 1e-6, f"{why} at the kink of the line trace"),
    )
    return [
        Number(
            quantity=f"{name} over that of the surface",
            model=rule,
            value=ratios[rule][n],
            reference=reference(n),
            source=source,
            tolerance=tolerance,
            reason=reason,
        )
        for rule, reference, source, tolerance, reason in rules
        for n, name in NAMED.items()
    ]


def _of_draws(kind: str, outcomes: list[Outcome], waves: dict[int, float], integral: dict[int, float]) -> list[Number]:
    """Moments of draws over the sum over their waves; that sum over the integral of the spectrum."""
    measured = [
        Number(
            quantity=f"{NAMED[n]} over the sum over the waves of the period",
            model=kind,
            value=float(np.mean([o[MEASURED[n]] for o in outcomes])) / waves[n],
            reference=1.0,
            source="(14.8), (14.9)",
            tolerance=1e-9,
            reason="exact for fixed amplitudes; rounding of the transforms",
        )
        for n in NAMED
    ]
    return measured + [
        Number(
            quantity=f"{NAMED[n]}, sum over the waves of the period over the integral of the spectrum",
            model=kind,
            value=waves[n] / integral[n],
            reference=1.0,
            source="integral of the spectrum",
            tolerance=0.01,
            reason="1 % (0.04 dB), finer than any level here; the sum has whole waves at the edges of the band",
            role=Role.FINDING,
        )
        for n in NAMED
    ]


def _of_lines(result: GeikeResult, spectra: Table) -> tuple[Number, ...]:
    """Spectra measured on profiles and along lines of surfaces, over both rules."""
    profile, geike = spectra["drawn profiles [m^3]"], spectra["geike [m^3]"]
    band = geike > 0
    of_lines = partial(Number, model="lines of drawn surfaces", reference=1.0, tolerance=1e-3)
    return (
        Number(
            quantity="largest relative deviation of the measured spectrum in the band",
            model="drawn profiles",
            value=float(np.max(np.abs(profile[band] / geike[band] - 1))),
            reference=0.0,
            source="(14.9)",
            tolerance=1e-6,
            reason="exact for fixed amplitudes; rounding of the transforms, relative to the largest wave",
        ),
        of_lines(
            quantity="measured spectrum over the line trace, mid band",
            value=_mid_band(result.case, spectra, "line trace [m^3]"),
            source="SelfAffine.line",
            reason="a sum over waves across the line in place of an integral; the integrand is smooth there, and small "
            "where it ends",
        ),
        of_lines(
            quantity="measured spectrum over Geike's, mid band",
            value=_mid_band(result.case, spectra, "geike [m^3]"),
            source="(10.12)",
            reason="0.001, as for the line trace; Geike's rule does not describe a line",
            role=Role.FINDING,
        ),
        of_lines(
            quantity="mean square slope over that of the surface",
            value=float(np.mean([o["line_gradient"] / o["gradient"] for o in result.surfaces])),
            reference=0.5,
            source="isotropy",
            tolerance=1e-9,
            reason="exact on a square grid for fixed amplitudes: both axes are alike",
        ),
    )


def _spectra(result: GeikeResult) -> Table:
    """Spectra against wavenumber: both rules, and the mean over the draws."""
    case, spectrum = result.case, result.case.spectrum
    q = 2 * np.pi / case.length * np.arange(1, case.cells // 2)
    data = {
        "q [rad/m]": q,
        "geike [m^3]": spectrum.c1d(q),
        "line trace [m^3]": spectrum.line(q),
        "drawn profiles [m^3]": np.mean([o["spectrum"][1:] for o in result.profiles], axis=0),
        "lines of drawn surfaces [m^3]": np.mean([o["spectrum"][1:] for o in result.surfaces], axis=0),
    }
    return Table("spectra", columns(**data))


def _moments(ratios: dict[str, dict[int, float]]) -> Table:
    geike, line = (list(ratios[rule].values()) for rule in (GEIKE, LINE))
    exact = [mean_power_of_cosine(n) for n in MOMENTS]
    return Table("moments", {"n": MOMENTS, "geike": geike, "line trace": line, "exact": exact})


def _mid_band(case: Geike, spectra: Table, rule: str) -> float:
    """Lines of surfaces over a rule, mean over twice the lowest wave to a quarter of the highest."""
    middle = slice(2 * case.longest - 1, case.cells // 16)
    return float(np.mean(spectra["lines of drawn surfaces [m^3]"][middle] / spectra[rule][middle]))


CASE = Case(
    name="geike",
    chapter=Chapter.EXACT,
    place=4,
    claim="Geike's rule keeps height and slope; its 1D spectrum is not that of a line on the surface.",
    answers="Geike's rule (10.12): which moments it preserves, and why it is not the spectrum of a line",
    quick=Geike(),
    full=Geike(cells=1024, surfaces=12),
    run=run,
    evidence=evidence,
    needs="closed form: spectra alone",
)
