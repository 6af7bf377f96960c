"""Geike's rule: which moments it keeps between one and two dimensions, and how it differs from a line trace."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import integrate

import mdr
from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim, off_by
from validation.analysis.evidence import Role
from validation.analysis.series import Series, single
from validation.analysis.study import Outcomes, Study
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.surface import RoughnessDraw, measure_profile, measure_surface


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
    def shortest(self) -> int:
        """Waves of length L / shortest end the band."""
        return self.cells // 4

    @property
    def spectrum(self) -> mdr.SelfAffine:
        """C_2D of the surfaces."""
        wave = 2 * np.pi / self.length
        return mdr.SelfAffine(hurst=self.hurst, q_min=self.longest * wave, q_max=self.shortest * wave, rms=self.rms)


def run(case: Geike, engine: Engine = SERIAL) -> Outcomes:
    draw = partial(RoughnessDraw, spectrum=case.spectrum, length=case.length, cells=case.cells, seed=case.seed)
    draws = [draw(realisation=i) for i in range(case.surfaces)]
    return Outcomes(case, {PROFILES: engine.map(measure_profile, draws), SURFACES: engine.map(measure_surface, draws)})


MOMENTS = (0, 1, 2, 3, 4)
MEASURED = {0: "height", 2: "gradient", 4: "curvature"}
NAMED = {n: f"mean square {measured}" for n, measured in MEASURED.items()}
OVER_SURFACE = {n: f"{name} over that of the surface" for n, name in NAMED.items()}
GEIKE, LINE, LINES = "Geike's 1D spectrum", "line trace", "lines of drawn surfaces"
PROFILES, SURFACES, INTEGRAL = "drawn profiles", "drawn surfaces", "integral of the spectrum"
DIRECTIONS = "mean of |cos φ|ⁿ"
SPECTRUM, WAVENUMBER = "C_1D [m³]", "wavenumber q [rad/m]"
SHARE, POWER = "moment over that of the surface", "moment n of |q|ⁿ"
OVER_LINE, OVER_GEIKE = "measured spectrum over the line trace, mid band", "measured spectrum over Geike's, mid band"
CLOSE = "2 % (0.09 dB of a power), a third of the finest tolerance of a level here"
SUM = "a sum over waves across the line in place of an integral; the integrand is smooth there, and small where it ends"
ON_DIRECTIONS, KINK = "mean of |cos|^n over directions", "exact; error of the quadrature at the kink of the line trace"


def series(result: Outcomes) -> list[Series]:
    """Moments of the line trace and of the draws; spectra measured on profiles and along lines of surfaces."""
    case, spectrum = result.case, result.case.spectrum
    integrals = {n: surface_moment(spectrum, n) for n in MOMENTS}
    profiles, surfaces = (_moments(result[kind]) for kind in (PROFILES, SURFACES))
    rules = {GEIKE: spectrum.c1d, LINE: spectrum.line}
    shares = {rule: [line_moment(c1d, spectrum, n) / integrals[n] for n in MOMENTS] for rule, c1d in rules.items()}
    shares[DIRECTIONS] = [mean_power_of_cosine(n) for n in MOMENTS]
    q = 2 * np.pi / case.length * np.arange(1, case.cells // 2)
    spectra = {rule: c1d(q) for rule, c1d in rules.items()}
    spectra |= {PROFILES: _spectrum(result[PROFILES]), LINES: _spectrum(result[SURFACES])}
    return [
        *(Series(SPECTRUM, rule, values, along=WAVENUMBER, at=q) for rule, values in spectra.items()),
        *(Series(SHARE, rule, values, along=POWER, at=MOMENTS) for rule, values in shares.items()),
        *_ratios(PROFILES, profiles, SURFACES, surfaces),
        *_ratios(PROFILES, profiles, INTEGRAL, integrals),
        *_ratios(SURFACES, surfaces, INTEGRAL, integrals),
        *(
            single(OVER_SURFACE[n], LINE, shares[LINE][n], 1e-6, ON_DIRECTIONS, KINK, shares[DIRECTIONS][n])
            for n in NAMED
        ),
        *_of_lines(case, spectra),
    ]


def surface_moment(spectrum: mdr.SelfAffine, n: int) -> float:
    """int |q|^n C_2D d^2q."""
    return _integral(lambda q: 2 * np.pi * q ** (n + 1) * spectrum.c2d(q), spectrum.q_min, spectrum.q_max)


def line_moment(c1d: Callable[[ArrayLike], NDArray[np.float64]], spectrum: mdr.SelfAffine, n: int) -> float:
    """int |q|^n C_1D dq, both sides; a line has waves below q_min too."""
    below = _integral(lambda q: 2 * q**n * c1d(q), 0.0, spectrum.q_min * (1 - 1e-9))
    return below + _integral(lambda q: 2 * q**n * c1d(q), spectrum.q_min * (1 + 1e-12), spectrum.q_max)


def mean_power_of_cosine(n: int) -> float:
    """Mean of |cos|^n over all directions: Gamma((n+1)/2) / (sqrt(pi) Gamma(n/2+1))."""
    return math.gamma((n + 1) / 2) / (math.sqrt(math.pi) * math.gamma(n / 2 + 1))


def _integral(f: Callable[[float], ArrayLike], low: float, high: float) -> float:
    """Adaptive quadrature, relative error 1e-10."""
    value, _ = integrate.quad(f, low, high, epsabs=0.0, epsrel=1e-11, limit=400)
    return float(value)


def _moments(outcomes: Sequence[Outcome]) -> dict[int, float]:
    """Of draws, their mean."""
    return {n: float(np.mean([o[MEASURED[n]] for o in outcomes])) for n in NAMED}


def _spectrum(outcomes: Sequence[Outcome]) -> NDArray[np.float64]:
    return np.asarray(np.mean([o["spectrum"][1:] for o in outcomes], axis=0))


def _ratios(name: str, moments: Mapping[int, float], over: str, references: Mapping[int, float]) -> Iterator[Series]:
    for n, quantity in NAMED.items():
        yield single(
            quantity, f"{name} over {over}", moments[n] / references[n], 0.02, over, CLOSE, 1.0, role=Role.FINDING
        )


def _of_lines(case: Geike, spectra: Mapping[str, NDArray[np.float64]]) -> Iterator[Series]:
    """The spectrum along lines of surfaces over both rules, mean over twice the lowest to a quarter of the highest."""
    middle = slice(2 * case.longest - 1, case.shortest // 4)
    over_line, over_geike = (float(np.mean(spectra[LINES][middle] / spectra[rule][middle])) for rule in (LINE, GEIKE))
    yield single(OVER_LINE, LINES, over_line, 1e-3, "SelfAffine.line", SUM, 1.0)
    yield single(OVER_GEIKE, LINES, over_geike, 1e-3, "(10.12)", "0.001, as for the line trace", 1.0, role=Role.FINDING)


SPECTRA = (
    Curve(SPECTRUM, GEIKE, "exact", "Geike, π q C_2D"),
    Curve(SPECTRUM, LINE, "other", LINE),
    Curve(SPECTRUM, PROFILES, "mdr", PROFILES, apart=0.02),
    Curve(SPECTRUM, LINES, "bem", "lines cut from drawn surfaces", apart=0.02),
)
SHARES = (
    Curve(SHARE, GEIKE, "mdr around", "Geike"),
    *(Curve(SHARE, model, style, model) for model, style in ((LINE, "bem"), (DIRECTIONS, "exact"))),
)
STUDY = Study(
    title="Geike's rule",
    method=(
        "Self-affine roughness, H = {c.hurst:g}, waves from L/{c.longest} to L/{c.shortest}: moments of the spectra by "
        "quadrature, and of {c.surfaces} profiles of {c.cells} points and {c.surfaces} surfaces of {c.cells}² cells "
        "drawn from them, fixed amplitudes, random phases. In draws the first wave of a band counts whole, and so "
        "their mean square height is above the integral of the spectrum. The cases of rough punches prescribe the rms "
        "height."
    ),
    series=series,
    claims=(
        # the higher the derivative, the less the first wave counts
        Claim(quantity=tuple(NAMED.values()), model=f"{PROFILES} over {SURFACES}", along="-quantity").saying(
            "A profile drawn by Geike's rule has the mean square height, gradient and curvature of the surface.",
            short="Drawn profiles beside drawn surfaces",
        ),
        Claim(quantity=OVER_GEIKE, differ=True).saying(
            "Geike's spectrum is not that of a line on the surface.",
            short="The spectrum of a line on the surface and Geike's",
        ),
        Claim(quantity=(*OVER_SURFACE.values(), OVER_LINE), printed=off_by).saying(
            "A line on the surface keeps its mean square height and half of its mean square gradient."
        ),
    ),
    charts=(
        Chart("geike", claims=(1,)).of(
            "(a) Geike's spectrum and the line trace, with those measured on drawn profiles and along lines of drawn "
            "surfaces. (b) n-th moment of both over that of the surface.",
            Panel(WAVENUMBER, SPECTRUM, log="xy", decades=4.2, legend="lower left").of(*SPECTRA),
            Panel(POWER, SHARE, log="", ylim=(0, 1.1), ticked=True, legend="lower left").of(*SHARES),
        ),
    ),
)
CASE = Case(
    name="geike",
    chapter=Chapter.EXACT,
    place=4,
    answers="Geike's rule (10.12): which moments it preserves, and why it is not the spectrum of a line",
    quick=Geike(),
    full=Geike(cells=1024, surfaces=12),
    run=run,
    study=STUDY,
    needs="closed form: spectra alone",
)
