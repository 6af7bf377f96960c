"""Geike's rule: which moments it keeps between one and two dimensions, and how it differs from a line trace."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

import bem3d
import mdr
from validation.analysis.answers import agreeing_from_the_first, answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Role, Table, Verdict, columns, number_with
from validation.analysis.wording import by_status, in_a_word, sentence
from validation.cases.exact.spectral_moments import line_moment, mean_power_of_cosine, surface_moment
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.engine.random_numbers import random_generator
from validation.theory import closed_forms

MOMENTS = (0, 1, 2, 3, 4)
NAMED = {0: "mean square height", 2: "mean square gradient", 4: "mean square curvature"}
MEASURED = {0: "height", 2: "gradient", 4: "curvature"}
GEIKE, LINE, LINES = "Geike's 1D spectrum", "line trace", "lines of drawn surfaces"
PROFILES, SURFACES = "drawn profiles", "drawn surfaces"
CLAIM = "A profile drawn by Geike's rule has the mean square height, gradient and curvature of the surface."
CLOSE = 0.02
WHY_CLOSE = "2 % (0.09 dB of a power), a third of the finest tolerance of a level here"


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
        "spectrum": lines[: case.cells // 2] * case.length / (2 * np.pi),
    }


def evidence(result: GeikeResult) -> Evidence:
    """Moments of the line trace and of the draws; spectra measured on profiles and along lines of surfaces."""
    case, spectrum = result.case, result.case.spectrum
    integrals = {n: surface_moment(spectrum, n) for n in MOMENTS}
    ratios = {
        rule: {n: line_moment(c1d, spectrum, n) / integrals[n] for n in MOMENTS}
        for rule, c1d in ((GEIKE, spectrum.c1d), (LINE, spectrum.line))
    }
    drawn = {
        kind: {n: float(np.mean([o[MEASURED[n]] for o in outcomes])) for n in NAMED}
        for kind, outcomes in ((PROFILES, result.profiles), (SURFACES, result.surfaces))
    }
    whole = "integral of the spectrum"
    spectra = _spectra(result)
    on_lines = _of_lines(result.case, spectra)
    profiles_over_surfaces = _ratios(f"{PROFILES} over {SURFACES}", drawn[PROFILES], drawn[SURFACES], SURFACES)
    moments = _of_line_trace(ratios[LINE])
    claims = _claims(case, profiles_over_surfaces, moments, on_lines)
    return Evidence(
        title="Geike's rule",
        method=(
            f"Self-affine roughness, H = {case.hurst:g}, waves from L/{case.longest} to L/{case.cells // 4}: moments "
            f"of the spectra by quadrature, and of {case.surfaces} profiles of {case.cells} points and "
            f"{case.surfaces} surfaces of {case.cells}² cells drawn from them, fixed amplitudes, random phases."
        ),
        numbers=(
            *profiles_over_surfaces,
            *(n for kind in drawn for n in _ratios(f"{kind} over {whole}", drawn[kind], integrals, whole)),
            *moments,
            *on_lines,
        ),
        claims=claims,
        finding=finding(claims),
        headlines={"geike": headline(claims)},
        tables=(spectra, _moments(ratios)),
        conclusions=(
            "The mean square height of draws is off the integral of the spectrum by "
            f"{100 * (drawn[PROFILES][0] / integrals[0] - 1):+.1f} % on profiles and by "
            f"{100 * (drawn[SURFACES][0] / integrals[0] - 1):+.1f} % on surfaces, since the first wave of a band "
            "counts whole. The cases of rough punches prescribe the rms height.",
        ),
        captions={
            "geike": (
                "(a) Geike's spectrum and the line trace, with those measured on drawn profiles and along lines of "
                "drawn surfaces. (b) n-th moment of both over that of the surface."
            )
        },
    )


def headline(claims: Sequence[JudgedClaim]) -> str:
    """claims: profiles keep the moments; Geike's spectrum is no line's; a line keeps what it should."""
    return by_status(
        claims[1],
        holds=f"A line on the surface has {claims[1].numbers[0].value:.2f} of Geike's spectrum",
        fails="A line on the surface has Geike's spectrum",
        undecided="Whether a line on the surface has Geike's spectrum is open",
    )


def finding(claims: Sequence[JudgedClaim]) -> str:
    return sentence(f"drawn profiles keep the moments of the surface: {in_a_word(claims[0])}", _lower(headline(claims)))


def _lower(text: str) -> str:
    return f"{text[0].lower()}{text[1:]}"


def _claims(
    case: Geike, profiles_over_surfaces: tuple[Number, ...], moments: tuple[Number, ...], on_lines: tuple[Number, ...]
) -> tuple[JudgedClaim, ...]:
    over_trace, over_geike = on_lines
    unbounded = closed_forms.line_trace_ratio(case.hurst)
    # the higher the derivative, the less the first wave counts
    kept = agreeing_from_the_first([n] for n in reversed(profiles_over_surfaces))
    off = ", ".join(f"{n.quantity} by {100 * n.difference:+.1f} %" for n in profiles_over_surfaces)
    gradient = number_with(moments, f"{NAMED[2]} over that of the surface")
    return (
        answered(
            CLAIM,
            profiles_over_surfaces,
            f"drawn profiles differ from drawn surfaces in {off}.",
            limits=f"from the {kept[-1].quantity} to higher derivatives" if kept else "",
            inside=kept,
        ),
        answered(
            "Geike's spectrum is not that of a line on the surface.",
            [over_geike],
            f"lines cut from drawn surfaces have {over_geike.value:.3f} of Geike's spectrum in the middle of the "
            f"band; an unbounded power law would have {unbounded:.3f}.",
            confirmed_by=Verdict.DIFFER,
        ),
        answered(
            "A line on the surface keeps its mean square height and half of its mean square gradient.",
            [*moments, over_trace],
            f"the line trace has {gradient.value:.4f} of the gradient, and drawn lines have {over_trace.value:.5f} of "
            "the line trace in the middle of the band.",
        ),
    )


def _of_line_trace(ratios: dict[int, float]) -> tuple[Number, ...]:
    """Moments of the line trace over those of the surface."""
    return tuple(
        Number(
            quantity=f"{name} over that of the surface",
            model=LINE,
            value=ratios[n],
            reference=mean_power_of_cosine(n),
            source="mean of |cos|^n over directions",
            tolerance=1e-6,
            reason="exact; error of the quadrature at the kink of the line trace",
        )
        for n, name in NAMED.items()
    )


def _ratios(model: str, moments: dict[int, float], references: dict[int, float], source: str) -> tuple[Number, ...]:
    return tuple(
        Number(
            quantity=name,
            model=model,
            value=moments[n] / references[n],
            reference=1.0,
            source=source,
            tolerance=CLOSE,
            reason=WHY_CLOSE,
            role=Role.FINDING,
        )
        for n, name in NAMED.items()
    )


def _of_lines(case: Geike, spectra: Table) -> tuple[Number, Number]:
    """The spectrum along lines of surfaces, over the line trace and over Geike's."""
    return (
        Number(
            quantity="measured spectrum over the line trace, mid band",
            model=LINES,
            value=_mid_band(case, spectra, "line trace [m^3]"),
            reference=1.0,
            source="SelfAffine.line",
            tolerance=1e-3,
            reason="a sum over waves across the line in place of an integral; the integrand is smooth there, and small "
            "where it ends",
        ),
        Number(
            quantity="measured spectrum over Geike's, mid band",
            model=LINES,
            value=_mid_band(case, spectra, "geike [m^3]"),
            reference=1.0,
            source="(10.12)",
            tolerance=1e-3,
            reason="0.001, as for the line trace",
            role=Role.FINDING,
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
    claim=CLAIM,
    answers="Geike's rule (10.12): which moments it preserves, and why it is not the spectrum of a line",
    quick=Geike(),
    full=Geike(cells=1024, surfaces=12),
    run=run,
    evidence=evidence,
    needs="closed form: spectra alone",
)
