"""Geike's rule: what it keeps between one and two dimensions, and how it differs from the spectrum of a line."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import integrate

import bem3d
import mdr
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Role, Table, claim
from validation.engine.engine import SERIAL, Engine, Outcome, generator
from validation.theory import closed_forms

FloatArray = NDArray[np.float64]

MOMENTS = (0, 1, 2, 3, 4)


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
        """Of the surface."""
        wave = 2 * np.pi / self.length
        return mdr.SelfAffine(hurst=self.hurst, q_min=self.longest * wave, q_max=self.cells // 4 * wave, rms=self.rms)

    @property
    def spacing(self) -> float:
        """Of the cells [m]."""
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
    """Draw and measure."""
    draws = [Draw(case=case, realisation=i) for i in range(case.surfaces)]
    return GeikeResult(case, engine.map(measure_profile, draws), engine.map(measure_surface, draws))


def measure_profile(draw: Draw) -> Outcome:
    """Mean squares of height, gradient and curvature of a profile, and its spectrum."""
    case = draw.case
    height = mdr.rough_profile(
        case.spectrum.c1d, length=case.length, points=case.cells, rng=generator(case.seed, 1, draw.realisation)
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
        case.spectrum.c2d, shape=shape, spacing=case.spacing, rng=generator(case.seed, 2, draw.realisation)
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
    """Moments of the spectra, moments of the draws, and the line trace in Geike's place."""
    case, spectrum = result.case, result.case.spectrum
    isotropic = {n: _isotropic_moment(spectrum, n) for n in MOMENTS}
    geike = {n: _moment(spectrum.c1d, spectrum, n) / isotropic[n] for n in MOMENTS}
    line = {n: _moment(spectrum.line, spectrum, n) / isotropic[n] for n in MOMENTS}
    lines = _lines(result)
    return Evidence(
        title="Geike's rule",
        compared=(
            f"Self-affine roughness, H = {case.hurst:g}, waves from L/{case.longest} to L/{case.cells // 4}: moments "
            f"of the spectra by quadrature, and of {case.surfaces} profiles of {case.cells} points and "
            f"{case.surfaces} surfaces of {case.cells}² cells drawn from them, fixed amplitudes, random phases."
        ),
        numbers=(
            *_of_spectra(geike, line),
            *_of_draws("profiles", result.profiles, _sum_over_profile(case), isotropic),
            *_of_draws("surfaces", result.surfaces, _sum_over_surface(case), isotropic),
            *_of_lines(result, lines),
        ),
        tables=(
            Table("spectra", lines),
            Table(
                "moments",
                {
                    "n": list(MOMENTS),
                    "geike": list(geike.values()),
                    "line trace": list(line.values()),
                    "exact": [_mean_power_of_cosine(n) for n in MOMENTS],
                },
            ),
        ),
        conclusions=(
            claim(
                "Geike's rule keeps every moment; the line trace keeps the height and loses "
                f"{100 * (1 - line[2]):.1f} % of the mean square gradient.",
                _of_spectra(geike, line),
            ),
            f"Lines cut from the drawn surfaces have {_mid_band(case, lines, 'geike [m^3]'):.3f} of Geike's spectrum "
            "in the middle of the band; an unbounded power law would have "
            f"{closed_forms.line_trace_ratio(case.hurst):.3f}.",
            "The sum over the waves of a period exceeds the integral of a spectrum that begins near the first wave "
            f"(in one dimension by {100 * (_sum_over_profile(case)[0] / isotropic[0] - 1):.1f} % here): ensembles that "
            "are normalised by the rms height prescribe it.",
        ),
        captions={
            "geike": (
                "(a) Spectra: Geike's 1D spectrum and the line trace, with what was measured on drawn profiles and "
                "along lines of drawn surfaces (every mode in the CSV, some in the figure). (b) Share of the n-th "
                "moment of the surface that each keeps."
            )
        },
    )


def _of_spectra(geike: dict[int, float], line: dict[int, float]) -> list[Number]:
    """What both rules keep of the surface's moments."""
    of_geike = [
        Number(
            quantity=f"spectra: {KEPT[n]} of Geike's 1D spectrum over that of the surface",
            value=geike[n],
            reference=1.0,
            source="(10.12)",
            tolerance=1e-9,
            reason="exact; error of the quadrature",
        )
        for n in KEPT
    ]
    of_line = [
        Number(
            quantity=f"spectra: {KEPT[n]} of the line trace over that of the surface",
            value=line[n],
            reference=_mean_power_of_cosine(n),
            source="mean of |cos|^n over directions",
            tolerance=1e-6,
            reason="exact; error of the quadrature at the kink of the line trace",
        )
        for n in KEPT
    ]
    return of_geike + of_line


def _of_draws(
    kind: str, outcomes: list[Outcome], over_waves: dict[int, float], isotropic: dict[int, float]
) -> list[Number]:
    """Moments measured on draws against the sum over their waves, and that sum against the integral it stands for."""
    measured = [
        Number(
            quantity=f"drawn {kind}: {KEPT[n]} over the sum over the waves of the period",
            value=float(np.mean([o[MEASURED[n]] for o in outcomes])) / over_waves[n],
            reference=1.0,
            source="(14.8), (14.9)",
            tolerance=1e-9,
            reason="exact for fixed amplitudes; rounding of transforms",
        )
        for n in KEPT
    ]
    lattice = [
        Number(
            quantity=f"{kind}: {KEPT[n]}, sum over the waves of the period over the integral of the spectrum",
            value=over_waves[n] / isotropic[n],
            reference=1.0,
            source="integral",
            tolerance=0.01,
            reason="1 % (0.04 dB), finer than any level is measured; the sum counts the edges of the band in whole "
            "waves",
            role=Role.FINDING,
        )
        for n in KEPT
    ]
    return measured + lattice


def _of_lines(result: GeikeResult, lines: Mapping[str, Sequence[float]]) -> list[Number]:
    """Spectra measured on profiles and along lines of surfaces, against both rules."""
    case = result.case
    profile, geike = np.array(lines["drawn profiles [m^3]"]), np.array(lines["geike [m^3]"])
    band = geike > 0
    return [
        Number(
            quantity="drawn profiles: largest relative deviation of the measured spectrum in the band",
            value=float(np.max(np.abs(profile[band] / geike[band] - 1))),
            reference=0.0,
            source="(14.9)",
            tolerance=1e-6,
            reason="fixed amplitudes: exact but for the rounding of transforms, relative to the largest wave",
        ),
        Number(
            quantity="lines cut from drawn surfaces: measured spectrum over the line trace, mid band",
            value=_mid_band(case, lines, "line trace [m^3]"),
            reference=1.0,
            source="SelfAffine.line",
            tolerance=1e-3,
            reason="a sum over waves across the line in place of an integral whose integrand is smooth there and ends "
            "far up the band, where little is left",
        ),
        Number(
            quantity="lines cut from drawn surfaces: measured spectrum over Geike's, mid band",
            value=_mid_band(case, lines, "geike [m^3]"),
            reference=1.0,
            source="(10.12)",
            tolerance=1e-3,
            reason="as above; a line is not what Geike's rule describes",
            role=Role.FINDING,
        ),
        Number(
            quantity="lines cut from drawn surfaces: mean square slope over that of the surface",
            value=float(np.mean([o["line_gradient"] / o["gradient"] for o in result.surfaces])),
            reference=0.5,
            source="isotropy",
            tolerance=1e-9,
            reason="exact on a square grid, whose axes are alike, for fixed amplitudes",
        ),
    ]


def _lines(result: GeikeResult) -> dict[str, list[float]]:
    """Spectra against wavenumber: both rules, and what was measured, the mean over the draws."""
    case, spectrum = result.case, result.case.spectrum
    q = 2 * np.pi / case.length * np.arange(1, case.cells // 2)
    return {
        "q [rad/m]": q.tolist(),
        "geike [m^3]": spectrum.c1d(q).tolist(),
        "line trace [m^3]": spectrum.line(q).tolist(),
        "drawn profiles [m^3]": np.mean([o["spectrum"][1:] for o in result.profiles], axis=0).tolist(),
        "lines of drawn surfaces [m^3]": np.mean([o["spectrum"][1:] for o in result.surfaces], axis=0).tolist(),
    }


def _mid_band(case: Geike, lines: Mapping[str, Sequence[float]], rule: str) -> float:
    """Lines of surfaces over a rule, mean over twice the lowest wave to a quarter of the highest."""
    middle = slice(2 * case.longest - 1, case.cells // 16)
    return float(np.mean(np.array(lines["lines of drawn surfaces [m^3]"])[middle] / np.array(lines[rule])[middle]))


def _sum_over_profile(case: Geike) -> dict[int, float]:
    """sum |q|^n 2 pi C_1D / L over the waves of the points."""
    q = 2 * np.pi * np.abs(np.fft.fftfreq(case.cells, case.spacing))
    power = 2 * np.pi / case.length * case.spectrum.c1d(q)
    return {n: float(np.sum(q**n * power)) for n in KEPT}


def _sum_over_surface(case: Geike) -> dict[int, float]:
    """sum |q|^n (2 pi / L)^2 C_2D over the waves of the grid."""
    axis = 2 * np.pi * np.fft.fftfreq(case.cells, case.spacing)
    q = np.hypot(axis[:, np.newaxis], axis)
    power = (2 * np.pi / case.length) ** 2 * case.spectrum.c2d(q)
    return {n: float(np.sum(q**n * power)) for n in KEPT}


def _mean_power_of_cosine(n: int) -> float:
    """Mean of |cos|^n over all directions: Gamma((n+1)/2) / (sqrt(pi) Gamma(n/2+1))."""
    return math.gamma((n + 1) / 2) / (math.sqrt(math.pi) * math.gamma(n / 2 + 1))


KEPT = {0: "mean square height", 2: "mean square gradient", 4: "mean square curvature"}
MEASURED = {0: "height", 2: "gradient", 4: "curvature"}


def _isotropic_moment(spectrum: mdr.SelfAffine, n: int) -> float:
    """int |q|^n C_2D d^2q."""
    return _integral(lambda q: 2 * np.pi * q ** (n + 1) * spectrum.c2d(q), spectrum.q_min, spectrum.q_max)


def _moment(c1d: mdr.checks.Spectrum, spectrum: mdr.SelfAffine, n: int) -> float:
    """int |q|^n C_1D dq, both sides; below q_min a line has waves too."""
    below = _integral(lambda q: 2 * q**n * c1d(q), 0.0, spectrum.q_min * (1 - 1e-9))
    return below + _integral(lambda q: 2 * q**n * c1d(q), spectrum.q_min * (1 + 1e-12), spectrum.q_max)


def _integral(f: mdr.checks.Spectrum, low: float, high: float) -> float:
    """Adaptive quadrature, relative error 1e-10."""
    value, _ = integrate.quad(f, low, high, epsabs=0.0, epsrel=1e-11, limit=400)
    return float(value)


CASE = Case(
    name="geike",
    chapter=Chapter.EXACT,
    place=4,
    claim="Geike's rule keeps height and slope; it is no cut along a line.",
    answers="Geike's rule (10.12): what it keeps, and why it is not the spectrum of a line",
    quick=Geike(),
    full=Geike(cells=1024, surfaces=12),
    run=run,
    evidence=evidence,
    needs="closed form: spectra alone",
)
