"""Geike's rule: what it keeps between one and two dimensions, and how it differs from the spectrum of a line."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import integrate

import bem3d
import mdr
from validation import closed_forms
from validation.ensemble import SERIAL, Engine, Outcome, generator
from validation.evidence import Evidence, Number, Role, Table, columns

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
    isotropic = np.array([_isotropic_moment(spectrum, n) for n in MOMENTS])
    geike = np.array([_moment(spectrum.c1d, spectrum, n) for n in MOMENTS]) / isotropic
    line = np.array([_moment(spectrum.line, spectrum, n) for n in MOMENTS]) / isotropic
    directions = np.array([math.gamma((n + 1) / 2) / (math.sqrt(math.pi) * math.gamma(n / 2 + 1)) for n in MOMENTS])
    numbers = [
        Number(
            label=f"spectra: {KEPT[n]} of Geike's 1D spectrum over that of the surface",
            value=geike[n],
            reference=1.0,
            source="(10.12)",
            tolerance=1e-9,
            reason="exact; error of the quadrature",
        )
        for n in KEPT
    ]
    numbers += [
        Number(
            label=f"spectra: {KEPT[n]} of the line trace over that of the surface",
            value=line[n],
            reference=float(directions[n]),
            source="mean of |cos|^n over directions",
            tolerance=1e-6,
            reason="exact; error of the quadrature at the kink of the line trace",
        )
        for n in KEPT
    ]
    for kind, outcomes in (("profiles", result.profiles), ("surfaces", result.surfaces)):
        numbers += [
            Number(
                label=f"drawn {kind}: {KEPT[n]} over that of the spectrum",
                value=float(np.mean([o[MEASURED[n]] for o in outcomes])) / isotropic[n],
                reference=1.0,
                source="(14.8), (14.9)",
                tolerance=_edge_share(spectrum, n, 2 * np.pi / case.length),
                reason="a sum over waves in place of an integral: each edge of the band counts up to half a step too "
                "much or too little",
            )
            for n in KEPT
        ]
    mode = np.arange(case.cells // 2)
    q = 2 * np.pi / case.length * mode
    profile = np.mean([o["spectrum"] for o in result.profiles], axis=0)
    lines = np.mean([o["spectrum"] for o in result.surfaces], axis=0)
    band = spectrum.c1d(q) > 0
    middle = (mode >= 2 * case.longest) & (mode <= case.cells // 16)
    over_line = float(np.mean(lines[middle] / spectrum.line(q[middle])))
    over_geike = float(np.mean(lines[middle] / spectrum.c1d(q[middle])))
    numbers += [
        Number(
            label="drawn profiles: largest relative deviation of the measured spectrum in the band",
            value=float(np.max(np.abs(profile[band] / spectrum.c1d(q[band]) - 1))),
            reference=0.0,
            source="(14.9)",
            tolerance=1e-6,
            reason="fixed amplitudes: exact but for the rounding of transforms, relative to the largest wave",
        ),
        Number(
            label="lines cut from drawn surfaces: measured spectrum over the line trace, mid band",
            value=over_line,
            reference=1.0,
            source="SelfAffine.line",
            tolerance=1 / (2 * case.longest),
            reason="a sum over waves across the line in place of an integral: one half step at the edge of the band",
        ),
        Number(
            label="lines cut from drawn surfaces: measured spectrum over Geike's, mid band",
            value=over_geike,
            reference=1.0,
            source="(10.12)",
            tolerance=1 / (2 * case.longest),
            reason="as above; a line is not what Geike's rule describes",
            role=Role.FINDING,
        ),
        Number(
            label="lines cut from drawn surfaces: mean square slope over that of the surface",
            value=float(np.mean([o["line_gradient"] / o["gradient"] for o in result.surfaces])),
            reference=0.5,
            source="isotropy",
            tolerance=1e-9,
            reason="exact on a square grid, whose axes are alike, for fixed amplitudes",
        ),
    ]
    unbounded = closed_forms.line_trace_ratio(case.hurst)
    return Evidence(
        title="Geike's rule",
        compared=(
            f"Self-affine roughness, H = {case.hurst:g}, waves from L/{case.longest} to L/{case.cells // 4}: moments "
            f"of the spectra by quadrature, and of {case.surfaces} profiles of {case.cells} points and "
            f"{case.surfaces} surfaces of {case.cells}² cells drawn from them, fixed amplitudes, random phases."
        ),
        numbers=tuple(numbers),
        tables=(
            Table(
                "spectra",
                columns(
                    **{
                        "q [rad/m]": q[1:],
                        "geike [m^3]": spectrum.c1d(q[1:]),
                        "line trace [m^3]": spectrum.line(q[1:]),
                        "drawn profiles [m^3]": profile[1:],
                        "lines of drawn surfaces [m^3]": lines[1:],
                    }
                ),
            ),
            Table("moments", columns(**{"n": MOMENTS, "geike": geike, "line trace": line, "exact": directions})),
        ),
        conclusions=(
            "Geike's rule keeps every moment; the line trace keeps the height and loses "
            f"{100 * (1 - line[2]):.1f} % of the mean square gradient.",
            f"Lines cut from the drawn surfaces have {over_geike:.3f} of Geike's spectrum in the middle of the band; "
            f"an unbounded power law would have {unbounded:.3f}.",
        ),
        caption=(
            "(a) Spectra: Geike's 1D spectrum and the line trace, with what was measured on drawn profiles and along "
            "lines of drawn surfaces. (b) Share of the n-th moment of the surface that each keeps."
        ),
    )


KEPT = {0: "mean square height", 2: "mean square gradient", 4: "mean square curvature"}
MEASURED = {0: "height", 2: "gradient", 4: "curvature"}


def _isotropic_moment(spectrum: mdr.SelfAffine, n: int) -> float:
    """int |q|^n C_2D d^2q."""
    return _integral(lambda q: 2 * np.pi * q ** (n + 1) * spectrum.c2d(q), spectrum.q_min, spectrum.q_max)


def _moment(c1d: mdr.border.Spectrum, spectrum: mdr.SelfAffine, n: int) -> float:
    """int |q|^n C_1D dq, both sides; below q_min a line has waves too."""
    below = _integral(lambda q: 2 * q**n * c1d(q), 0.0, spectrum.q_min * (1 - 1e-9))
    return below + _integral(lambda q: 2 * q**n * c1d(q), spectrum.q_min * (1 + 1e-12), spectrum.q_max)


def _integral(f: mdr.border.Spectrum, low: float, high: float) -> float:
    """Adaptive quadrature, relative error 1e-10."""
    value, _ = integrate.quad(f, low, high, epsabs=0.0, epsrel=1e-11, limit=400)
    return float(value)


def _edge_share(spectrum: mdr.SelfAffine, n: int, step: float) -> float:
    """Share of the n-th moment within half a step of both edges, each at the larger of its two sides."""

    def density(q: float) -> float:
        return math.pow(q, n - 2 * spectrum.hurst - 1)

    edges = [max(density(q - step / 2), density(q + step / 2)) for q in (spectrum.q_min, spectrum.q_max)]
    level = float(spectrum.c1d(spectrum.q_min)) / math.pow(spectrum.q_min, -2 * spectrum.hurst - 1)
    return level * sum(edges) * step / _isotropic_moment(spectrum, n)
