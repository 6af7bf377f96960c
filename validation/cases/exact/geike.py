"""Geike's rule: what a profile drawn by it keeps of the surface, and how its spectrum differs from that of a line."""

import math
from dataclasses import dataclass

import numpy as np

import mdr
from validation.analysis.evidence import Role
from validation.analysis.series import single
from validation.case import SERIAL, Case, Chapter, Chart, Claim, Curve, Engine, Outcomes, Panel, Quantity, Series, Study
from validation.simulation.surface import RoughnessDraw, measure_profile, measure_surface


@dataclass(frozen=True, kw_only=True)
class Geike:
    """Self-affine roughness of one band, drawn once in one and in two dimensions and measured back.

    hurst; rms [m]; length: period of both [m]; longest: waves of length L / longest begin the band, as many as on the
    track of the wheel of Table 14.1, four cells a wave end it; cells: a side and along the profile; seed: zero or
    positive.
    """

    hurst: float = 0.7
    rms: float = 1e-6
    length: float = 1e-2
    longest: int = 65
    cells: int = 1024
    seed: int = 14

    @property
    def shortest(self) -> int:
        """Waves of length L / shortest end the band."""
        return self.cells // 4

    @property
    def spectrum(self) -> mdr.SelfAffine:
        """C_2D of the surface."""
        wave = 2 * np.pi / self.length
        return mdr.SelfAffine(hurst=self.hurst, q_min=self.longest * wave, q_max=self.shortest * wave, rms=self.rms)


def run(case: Geike, engine: Engine = SERIAL) -> Outcomes:
    draw = RoughnessDraw(spectrum=case.spectrum, length=case.length, cells=case.cells, seed=case.seed)
    (profile,), (surface,) = engine.map(measure_profile, [draw]), engine.map(measure_surface, [draw])
    return Outcomes(case, {PROFILE: profile, LINES: surface})


NAMED = (Quantity("mean_square_height"), Quantity("mean_square_gradient"), Quantity("mean_square_curvature"))
PROFILE, LINES, GEIKE, LINE = "drawn profile", "lines of a drawn surface", "Geike's 1D spectrum", "line trace"
OVER_SURFACE, OVER_INTEGRAL = "drawn profile over drawn surface", "drawn profile over integral of the spectrum"
SPECTRUM, WAVENUMBER = Quantity("C_1D_m³", "C_1D [m³]"), "wavenumber q [rad/m]"
SHARE, POWER, DIRECTIONS = Quantity("moment_over_that_of_the_surface"), "moment n of |q|ⁿ", "mean of |cos φ|ⁿ"
CLOSE = "2 %: the first wave of a band counts whole, which adds H / longest to a sum in one dimension"
MOMENTS = (0, 1, 2, 3, 4)


def series(result: Outcomes) -> list[Series]:
    """Moments of the draws, and their spectra beside Geike's and the line trace."""
    case, c1d = result.case, result.case.spectrum.c1d
    q, dq = 2 * np.pi / case.length * np.arange(1, case.cells // 2), 2 * np.pi / case.length
    fine = np.geomspace(case.spectrum.q_min, case.spectrum.q_max, 10_001)
    spectra = {GEIKE: c1d(q), LINE: case.spectrum.line(q)}
    drawn = {kind: result[kind]["spectrum"][1:] for kind in (PROFILE, LINES)}
    shares = {
        kind: [np.sum(q**n * density) * dq / np.trapezoid(fine**n * c1d(fine), fine) for n in MOMENTS]
        for kind, density in drawn.items()
    }
    shares[DIRECTIONS] = [mean_power_of_cosine(n) for n in MOMENTS]
    moments, of_surface = (result[kind]["moments"] for kind in (PROFILE, LINES))
    ratios = [(name, OVER_SURFACE, ratio) for name, ratio in zip(NAMED, moments / of_surface, strict=True)]
    return [
        *(Series(SPECTRUM, rule, values, along=WAVENUMBER, at=q) for rule, values in (spectra | drawn).items()),
        *(Series(SHARE, kind, np.array(values), along=POWER, at=MOMENTS) for kind, values in shares.items()),
        *(
            single(name, over, float(ratio), 0.02, over.partition(" over ")[2], CLOSE, 1.0, role=Role.FINDING)
            for name, over, ratio in (*ratios, (NAMED[0], OVER_INTEGRAL, moments[0] / case.rms**2))
        ),
    ]


def mean_power_of_cosine(n: int) -> float:
    """Of |cos|^n over all directions, what a line keeps: Gamma((n+1)/2) / (sqrt(pi) Gamma(n/2+1))."""
    return math.gamma((n + 1) / 2) / (math.sqrt(math.pi) * math.gamma(n / 2 + 1))


SPECTRA = (
    Curve(SPECTRUM, GEIKE, "black", "Geike, π q C_2D"),
    Curve(SPECTRUM, LINE, "dashed"),
    Curve(SPECTRUM, PROFILE, "marks", marker_spacing=0.02),
    Curve(SPECTRUM, LINES, "marks", marker_spacing=0.02),
)
SHARES = (
    Curve(SHARE, PROFILE, "around"),
    *(Curve(SHARE, kind, style) for kind, style in ((LINES, "marks"), (DIRECTIONS, "black"))),
)
STUDY = Study(
    title="Geike's rule",
    method=(
        "Self-affine roughness, H = {c.hurst:g}, waves from L/{c.longest} to L/{c.shortest}: moments of one profile of "
        "{c.cells} points and of one surface of {c.cells}² cells, with fixed amplitudes and random phases, so that no "
        "moment scatters. The track of the wheel of Table 14.1 has as many of its longest waves. A line cut from the "
        "surface keeps its mean square height and half of its mean square gradient: its spectrum is the line trace, "
        "not Geike's."
    ),
    series=series,
    claims=(
        Claim(quantity=NAMED, model=OVER_SURFACE).saying(
            "A profile drawn by Geike's rule has the mean square height, gradient and curvature of the surface.",
            short="A profile by Geike's rule agrees with the surface",
            key="moments",
        ),
    ),
    charts=(
        Chart("geike").of(
            "(a) Geike's spectrum and the line trace, with those measured on a drawn profile and along the lines of a "
            "drawn surface. (b) n-th moment of both over that of the surface; line: of the line trace.",
            Panel(WAVENUMBER, SPECTRUM, log="xy", decades=3.2).of(*SPECTRA),
            Panel(POWER, SHARE, log="", ylim=(0, 1.1), ticked=True).of(*SHARES),
        ),
    ),
)
CASE = Case(
    name="geike",
    chapter=Chapter.EXACT,
    place=2,
    answers="Geike's rule (10.12): which moments it preserves, and why it is not the spectrum of a line",
    quick=Geike(),
    full=Geike(cells=2048),
    run=run,
    study=STUDY,
    needs="closed form: spectra alone",
)
