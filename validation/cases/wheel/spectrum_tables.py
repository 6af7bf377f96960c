"""Tables of Fig. 14.4, behind its figures and on its page."""

import math

import numpy as np

from validation.analysis.evidence import Number, Role, Table, VerdictCell, columns, plus_minus, table_of
from validation.analysis.spectra import band_means
from validation.cases.wheel.contrast import ZERO, contrast_table, linear_contrasts, log_contrasts, zeros_of
from validation.cases.wheel.features import BREAK, PERIOD, SLOPE, Spectrum, expected, spectrum_rows
from validation.cases.wheel.spectrum import TABLE, WheelResult
from validation.cases.wheel.spectrum_numbers import FEATURES
from validation.engine.engine import Outcome
from validation.scenes.dynamic_wheel import WheelScene
from validation.theory import wheel as wheel_theory

SPRING_COLUMNS = ("x / a", "wheel / d", "track / d", "compression / d")
BANDS_PER_PERIOD = 12
"""Of the oscillation."""
ABSENT, IDENTITY = "none stands out", "identity, no evidence"
BOOK, OURS, FOLLOWS = "printed in the book, Table 14.1", "chosen here", "computed from the above"


def tables_of(result: WheelResult, spectra: dict[str, Spectrum]) -> tuple[Table, ...]:
    """All tables behind the figures; the first spectrum is that of the scene itself."""
    name, spectrum = next(iter(spectra.items()))
    return (
        bands_of(spectrum, result.batches[name]),
        oscillation_of(spectrum),
        *contrast_of(spectrum),
        variations_of(spectra),
        Table("springs", columns(**dict(zip(SPRING_COLUMNS, result.snapshot["springs"], strict=True)))),
        pressure_of(result.snapshot),
        marks_of(spectrum),
    )


def bands_of(spectrum: Spectrum, batches: list[Outcome]) -> Table:
    """Fig. 14.4 in twelfths of an octave: mean, spread over wheels, with Hann's window, linear theory, floor."""
    edges = batches[0]["bands"]
    of_wheels = np.concatenate([batch["levels"] for batch in batches], axis=1)
    low, high = np.quantile(of_wheels, [0.1, 0.9], axis=1)
    rms_jump = math.sqrt(np.mean(spectrum.jumps**2))
    centres = np.sqrt(edges[1:] * edges[:-1])
    floor = wheel_theory.leakage(centres, jump=rms_jump, time_step=spectrum.time_step, duration=spectrum.duration)
    values = {
        "omega [rad/s]": centres,
        "A [(m/s2)2 s]": of_wheels.mean(axis=1),
        "lowest tenth": low,
        "highest tenth": high,
        "Hann": band_means(spectrum.omega, spectrum.hann.mean(axis=0), edges),
        "linear": band_means(spectrum.omega, _linear_from(0.9, spectrum), edges),
        "floor": floor,
    }
    return Table("spectrum", columns(**values))


def oscillation_of(spectrum: Spectrum) -> Table:
    """Region 3 in bands of a part of a period, over the power law of the mean level."""
    scene, omega, theory = spectrum.scene, spectrum.omega, expected(spectrum)
    edges = np.arange(0.9 * scene.jump, 1.1 * scene.cutoff, max(theory[PERIOD] / BANDS_PER_PERIOD, omega[0]))
    law, linear = omega ** theory[SLOPE], _linear_from(0.5, spectrum)
    inside = (omega > scene.jump) & (omega < scene.cutoff)
    scale = float(np.mean((linear / law)[inside]))
    values = {"springs": spectrum.plain.mean(axis=0), "springs, Hann": spectrum.hann.mean(axis=0), "linear": linear}
    means = {name: band_means(omega, a / law, edges) / scale for name, a in values.items()}
    return Table("oscillation", columns(**{"omega [rad/s]": (edges[1:] + edges[:-1]) / 2, **means}))


def contrast_of(spectrum: Spectrum) -> list[Table]:
    """On springs with either window, and of linear theory; none where region 3 has no whole period."""
    scene, omega = spectrum.scene, spectrum.omega
    if not zeros_of(scene).size:
        return []
    linear = linear_contrasts(omega, scene)
    return [contrast_table(scene, {"springs, Hann": log_contrasts(omega, spectrum.hann, scene), "linear": linear})]


def _linear_from(part: float, spectrum: Spectrum) -> np.ndarray:
    """Linear theory above a part of the jump: it has nothing below, and is infinite at the resonance."""
    return np.where(spectrum.omega < part * spectrum.scene.jump, 0.0, spectrum.linear)


def variations_of(spectra: dict[str, Spectrum]) -> Table:
    """Mean spectra without window of all variations, in sixths of an octave."""
    rows: list[dict[str, object]] = []
    for name, spectrum in spectra.items():
        low, high = float(spectrum.omega[2]), 1.5 * spectrum.scene.cutoff
        means = spectrum_rows(spectrum.omega, spectrum.plain.mean(axis=0), low, high)
        rows += [{"scene": name, **row} for row in means]
    return table_of("variations", rows)


def pressure_of(snapshot: Outcome) -> Table:
    x, y = np.meshgrid(snapshot["x"], snapshot["y"], indexing="ij")
    values = {"x / a": x.ravel(), "y / a": y.ravel(), "p / p0": snapshot["pressure"].ravel()}
    return Table("pressure", columns(**values))


def marks_of(spectrum: Spectrum) -> Table:
    scene, theory = spectrum.scene, expected(spectrum)
    marks = {"ω_eigen": scene.eigenfrequency, "q_min v₀": scene.jump, "break": theory[BREAK], "q_max v₀": scene.cutoff}
    return Table("marks", {"mark": list(marks), "omega [rad/s]": list(marks.values())})


# --- on the page ---


def shown_scene(scene: WheelScene) -> Table:
    """The scene, and where each value is from if that is the book."""
    material = scene.material
    rows = [
        ("R", f"{scene.radius:g} m", BOOK),
        ("M", f"{scene.mass:g} kg", BOOK),
        ("E", _given(material.youngs_modulus, 1e9, " GPa"), BOOK),
        ("ν", _given(material.poisson_ratio, 1, ""), BOOK),
        ("E*", f"{scene.modulus / 1e9:.5g} GPa: {material.origin}", FOLLOWS),
        ("F_N", f"{scene.load:g} N", OURS),
        ("v₀", f"{scene.speed:g} m/s", OURS),
        ("h₀", f"{1e6 * scene.rms:.3g} µm", BOOK),
        *(
            (
                f"{body}: H; longest, shortest wave",
                f"{rough.hurst:g}; {1e3 * rough.longest:g} mm, {1e3 * rough.shortest:g} mm",
                OURS,
            )
            for body, rough in (("rail", scene.rail), ("wheel", scene.wheel))
            if rough
        ),
        ("distance", f"{scene.length:.3g} m", OURS),
        ("dx", f"a / {scene.springs}", OURS),
        ("a", f"{1e3 * scene.contact_radius:.4g} mm", FOLLOWS),
        ("d", f"{1e6 * scene.approach:.4g} µm", FOLLOWS),
        ("h₀ / d", f"{scene.rms / scene.approach:.3g}", FOLLOWS),
        ("ω_eigen", f"{scene.eigenfrequency:.5g} rad/s, {scene.eigenfrequency / (2 * math.pi):.4g} Hz", FOLLOWS),
        ("q_min v₀", f"{scene.jump:.5g} rad/s", FOLLOWS),
        ("q_max v₀", f"{scene.cutoff:.5g} rad/s", FOLLOWS),
    ]
    names = ("quantity", "value", "source") if is_of_the_book(scene) else ("quantity", "value")
    return Table("the scene", dict(zip(names, map(list, zip(*rows, strict=True)), strict=False)))


def _given(value: float | None, scale: float, unit: str) -> str:
    return "not given" if value is None else f"{value / scale:.4g}{unit}"


def is_of_the_book(scene: WheelScene) -> bool:
    """Whether it has what Table 14.1 prints: a changed copy of its file has the same name."""
    return all(getattr(scene, key) == getattr(TABLE, key) for key in ("name", "radius", "mass", "material", "rms"))


def shown_regions(numbers: dict[str, Number]) -> Table:
    """The chapter's regions, one row a feature."""
    rows: list[dict[str, object]] = []
    for key, feature in FEATURES.items():
        row: dict[str, object] = {
            "region": feature.region,
            "Chapter 14 of the book": feature.chapter,
            "feature": feature.name,
        }
        if number := numbers.get(key):
            row["found"] = plus_minus(number.value, number.uncertainty)
            row["theory"] = f"{number.reference:.5g} = {feature.source}"
            identity = number.role is Role.IDENTITY
            row["verdict"] = IDENTITY if identity else VerdictCell(f"within {number.tolerance:.3g}", number.verdict)
        else:
            row |= {"found": ABSENT, "theory": feature.source, "verdict": ""}
        rows.append(row)
    return table_of("the regions of the spectrum", rows)


def shown_contrasts(scene: WheelScene, numbers: list[Number]) -> Table:
    """How the oscillation of region 3 dies."""
    return Table(
        "contrast of the oscillation of region 3, maxima over zeros",
        {
            "zero": [f"{number.where[ZERO]:g}" for number in numbers],
            "ω [rad/s]": [f"{omega:.4g}" for omega in zeros_of(scene) * scene.oscillation_period],
            "springs [dB]": [plus_minus(number.value, number.sample) for number in numbers],
            "linear theory [dB]": [f"{number.reference:.1f}" for number in numbers],
            "verdict": [VerdictCell(f"within {n.tolerance:g}", n.verdict) for n in numbers],
        },
    )


def shown_parameters(numbers: dict[str, dict[str, Number]]) -> Table:
    """The chapter's parameter studies: found and expected features of each variation."""

    def cell(number: Number | None) -> object:
        if number is None:
            return ABSENT
        text = f"{plus_minus(number.value, number.uncertainty)} ({number.reference:.5g})"
        return text if number.role is Role.IDENTITY else VerdictCell(text, number.verdict)

    rows: list[dict[str, object]] = [
        {"scene": name, **{feature.name: cell(mine.get(key)) for key, feature in FEATURES.items()}}
        for name, mine in numbers.items()
    ]
    return table_of("one parameter at a time: found ± 95 % (theory)", rows)
