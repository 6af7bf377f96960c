"""What the wheel of Fig. 14.4 shows: its regions with verdicts, what moves them, and the picture of its contact."""

import math

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import (
    Evidence,
    Number,
    Role,
    Table,
    Verdict,
    VerdictCell,
    columns,
    if_confirmed,
    plus_minus,
    table_of,
    with_reference,
)
from validation.analysis.spectra import band_means
from validation.analysis.statistics import POWER_DECIBEL, Estimate
from validation.cases.wheel.features import (
    APART,
    BREAK,
    CLEAR,
    FLOOR,
    JUMP,
    PEAK,
    PERIOD,
    PREDICTED,
    SLOPE,
    Spectrum,
    expected,
    found,
)
from validation.cases.wheel.spectrum import TABLE, WheelResult, WheelSpectrum, run
from validation.engine.engine import Outcome
from validation.scenes.dynamic_wheel import WheelScene
from validation.selection import model_needed
from validation.simulation.wheel_on_springs import WAVES_APART as OPEN_WAVES
from validation.theory import wheel as wheel_theory

SPRING_COLUMNS = ("x / a", "wheel / d", "track / d", "compression / d")
BOOK = ("E", "ν", "R", "M", "h₀")
"""What Table 14.1 prints."""
LINES = 2
"""Of a record: half of the width of Hann's main lobe."""
FEW = 3
"""Names that a sentence holds."""
FINE = 12
"""Bands to a period of the oscillation."""
NAMES = {
    PEAK: "peak ω_eigen [rad/s]",
    JUMP: "jump [rad/s]",
    SLOPE: "slope of region 3",
    PERIOD: "period of the oscillation [rad/s]",
    FLOOR + PREDICTED: "floor over predicted",
    BREAK + PREDICTED: "break over predicted",
}
SOURCES = {
    PEAK: "sqrt(2 a E* / M)",
    JUMP: "q_min v₀, (14.20)",
    SLOPE: "-2 H - 3, (14.13)",
    PERIOD: "π v₀ / a, (14.12)",
    FLOOR + PREDICTED: "<J²> / (ω² T), J the jump of a(t) from the end of each record to its beginning",
    BREAK + PREDICTED: "where (14.14) through the resonator meets that floor",
}


def evidence(result: WheelResult) -> Evidence:
    """Features beside theory for the scene and for each variation; balance of forces and Parseval as criteria."""
    case = result.case
    spectra = {name: Spectrum.of(varied, result.batches[name]) for name, varied in case.variations().items()}
    base = next(iter(spectra))
    features = {name: _numbers(name, spectrum) for name, spectrum in spectra.items()}
    level = _level(spectra[base])
    numbers = [*_exact(result), *features[base].values(), *([level] if level else [])]
    return Evidence(
        title="Fig. 14.4: the acceleration of a rolling wheel, on springs",
        method=_method(result, spectra[base]),
        numbers=tuple(numbers),
        tables=(
            _bands(result, spectra, base),
            _oscillation(spectra[base]),
            _variations(spectra),
            Table("springs", columns(**dict(zip(SPRING_COLUMNS, result.still["springs"], strict=True)))),
            _pressure(result),
            _marks(spectra[base]),
        ),
        page_tables=(
            _scene(case.scene),
            _regions(features[base]),
            *([_parameters(features)] if len(features) > 1 else []),
        ),
        conclusions=(
            *_hidden(case.scene),
            *_conclusions(features, base, level),
            _flight(result.batches[base]),
            *filter(None, (case.scene.no_steady_answer(), *case.scene.diagnose())),
        ),
        captions=_captions(result),
    )


def _method(result: WheelResult, spectrum: Spectrum) -> str:
    scene = result.case.scene
    ours = (
        "Table 14.1 prints E, ν, R, M and h₀; all else is our choice, see the table of the scene. "
        if _is_of_the_book(scene)
        else ""
    )
    return (
        f"{spectrum.jumps.size} wheels, M z'' = F - F_N by velocity Verlet in steps of dx / v₀, {scene.springs} "
        f"springs to a contact radius a = {1e3 * scene.contact_radius:.4g} mm, h₀/d = "
        f"{scene.rms / scene.approach:.3g}, {len(spectrum.omega) * 2} steps from static equilibrium; the end of a "
        f"track is {OPEN_WAVES} longest waves from its beginning. {ours}Nothing damps the wheel: the free vibration "
        "with which it begins stays, and makes the level of region 1, of which the frequency alone is the contact's. A "
        "is two-sided over the frequency f, <a²> = int A df; without window as in the book, and with Hann's where "
        "leakage would hide what is looked for. The peak is found between lines of Hann's spectrum; the jump where "
        "that reaches half of the level behind it; slope and break from means over periods of the oscillation; the "
        "floor beyond q_max v₀. Errors by leaving out groups of wheels."
    )


def _exact(result: WheelResult) -> list[Number]:
    """What holds to rounding."""
    batches = [batch for some in result.batches.values() for batch in some]
    parseval = max(abs(_parseval(batch)) for batch in batches)
    balance = max(float(np.abs(batch["balance"]).max()) for batch in batches)
    wheels = sum(batch["jump"].size for batch in batches)
    return [
        Number(
            quantity=f"int A df over the mean square of the acceleration, less one, worst of {len(batches)} batches",
            value=parseval,
            reference=0.0,
            source="Parseval",
            tolerance=1e-11,
            reason="rounding of transforms",
        ),
        Number(
            quantity=f"mean of F - F_N less M times the change of velocity over T, over its rms, "
            f"worst of {wheels} wheels",
            value=balance,
            reference=0.0,
            source="Newton: mean force and load balance",
            tolerance=1e-11,
            reason="rounding of as many sums as steps",
        ),
    ]


def _parseval(batch: dict[str, np.ndarray]) -> float:
    square = float(np.mean(batch["square"]))
    density = batch["plain"].mean(axis=0)
    steps = round(float(batch["duration"] / batch["time step"]))
    weights = np.full(density.size, 2.0)
    weights[-1] = 2.0 if steps % 2 else 1.0
    return (float(weights @ density) / float(batch["duration"]) + float(np.mean(batch["mean"] ** 2))) / square - 1


def _numbers(name: str, spectrum: Spectrum) -> dict[str, Number]:
    """The features that there are, beside theory."""
    values, theory = found(spectrum), expected(spectrum)
    line = float(spectrum.omega[0])
    numbers = {}
    for feature, label in NAMES.items():
        if feature not in values:
            continue
        reference = theory.get(feature, 1.0)
        tolerance, reason = _tolerance(feature, reference, line)
        estimate: Estimate = values[feature]
        numbers[feature] = Number(
            quantity=f"{name}: {label}",
            value=estimate.value,
            reference=reference,
            source=SOURCES[feature],
            tolerance=tolerance,
            reason=reason,
            unit="rad/s" if "rad/s" in label else "-",
            grid=line / 2 if feature == JUMP else 0.0,
            sample=estimate.half_width,
            role=Role.FINDING,
        )
    return numbers


def _tolerance(feature: str, reference: float, line: float) -> tuple[float, str]:
    if feature == JUMP:
        return LINES * line, f"{LINES} lines of the record, half of the main lobe of Hann's window"
    if feature == SLOPE:
        return 0.05, "1 %: what an eye could tell on double-logarithmic paper"
    if feature == PEAK:
        return 0.005 * reference, "0.5 %: a small part of the distance of two lines, between which it is found"
    if feature == PERIOD:
        return 0.01 * reference, "1 %: roughness at the edge of the contact changes its length to second order"
    return 0.1, "10 %: 0.4 dB of a level"


def _level(spectrum: Spectrum) -> Number | None:
    """Level of region 3 over (14.12) through the resonator, to where the floor is far below."""
    scene, omega = spectrum.scene, spectrum.omega
    theory, value = expected(spectrum), spectrum.hann
    first, last = max(1.2 * scene.jump, CLEAR * scene.eigenfrequency), min(0.7 * theory[BREAK], 0.9 * scene.cutoff)
    if first >= last:
        return None
    inside = (omega > first) & (omega < last)
    linear = float(spectrum.linear[inside].sum())
    sums = value[:, inside].sum(axis=1)
    mean = float(sums.mean())
    error = float(np.std(sums, ddof=1)) / math.sqrt(len(sums)) / mean
    estimate = Estimate(math.log(mean / linear), error, len(sums))
    return Number(
        quantity="region 3: level over linear theory, (14.12) through the resonator",
        value=POWER_DECIBEL * estimate.value,
        reference=0.0,
        source="a contact that keeps its radius",
        tolerance=0.5,
        unit="dB",
        reason="0.5 dB: a sixth of what one-third octaves of rolling noise are held to",
        sample=POWER_DECIBEL * estimate.half_width,
        role=Role.FINDING,
    )


def _bands(result: WheelResult, spectra: dict[str, Spectrum], base: str) -> Table:
    """Fig. 14.4 in twelfths of an octave: mean, spread over wheels, with Hann's window, linear theory, floor."""
    spectrum, batches = spectra[base], result.batches[base]
    edges = batches[0]["bands"]
    of_wheels = np.concatenate([batch["levels"] for batch in batches], axis=1)
    low, high = np.quantile(of_wheels, [0.1, 0.9], axis=1)
    rms_jump = math.sqrt(np.mean(spectrum.jumps**2))
    centres = np.sqrt(edges[1:] * edges[:-1])
    linear = np.where(spectrum.omega < 0.9 * spectrum.scene.jump, 0.0, spectrum.linear)
    return Table(
        "spectrum",
        columns(
            **{
                "omega [rad/s]": centres,
                "A [(m/s2)2 s]": of_wheels.mean(axis=1),
                "lowest tenth": low,
                "highest tenth": high,
                "Hann": band_means(spectrum.omega, spectrum.hann.mean(axis=0), edges),
                "linear": band_means(spectrum.omega, linear, edges),
                "floor": wheel_theory.leakage(
                    centres, jump=rms_jump, time_step=spectrum.time_step, duration=spectrum.duration
                ),
            }
        ),
    )


def _oscillation(spectrum: Spectrum) -> Table:
    """Region 3 in bands of a part of a period, over the power law of the mean level."""
    scene, omega = spectrum.scene, spectrum.omega
    theory = expected(spectrum)
    width = max(theory[PERIOD] / FINE, omega[0])
    edges = np.arange(0.9 * scene.jump, 1.1 * scene.cutoff, width)
    centres = (edges[1:] + edges[:-1]) / 2
    law = omega ** theory[SLOPE]
    linear = np.where(omega < 0.5 * scene.jump, 0.0, spectrum.linear)
    inside = (omega > scene.jump) & (omega < scene.cutoff)
    scale = float(np.mean((linear / law)[inside]))
    values = {"springs": spectrum.plain.mean(axis=0), "springs, Hann": spectrum.hann.mean(axis=0), "linear": linear}
    return Table(
        "oscillation",
        columns(
            **{
                "omega [rad/s]": centres,
                **{name: band_means(omega, a / law, edges) / scale for name, a in values.items()},
            }
        ),
    )


def _variations(spectra: dict[str, Spectrum]) -> Table:
    """Mean spectra without window of all variations, in sixths of an octave."""
    rows: list[dict[str, object]] = []
    for name, spectrum in spectra.items():
        low, high = float(spectrum.omega[2]), 1.5 * spectrum.scene.cutoff
        edges = low * 2 ** (np.arange(0, 6 * math.log2(high / low)) / 6)
        plain = band_means(spectrum.omega, spectrum.plain.mean(axis=0), edges)
        for omega, a in zip(np.sqrt(edges[1:] * edges[:-1]), plain, strict=True):
            if np.isfinite(a):
                rows.append({"scene": name, "omega [rad/s]": float(omega), "A [(m/s2)2 s]": float(a)})
    return table_of("variations", rows)


def _pressure(result: WheelResult) -> Table:
    still = result.still
    x, y = np.meshgrid(still["x"], still["y"], indexing="ij")
    values = {"x / a": x.ravel(), "y / a": y.ravel(), "p / p0": still["pressure"].ravel()}
    return Table("pressure", columns(**values))


def _marks(spectrum: Spectrum) -> Table:
    """Frequencies that theory knows."""
    scene, theory = spectrum.scene, expected(spectrum)
    marks = {"ω_eigen": scene.eigenfrequency, "q_min v₀": scene.jump, "break": theory[BREAK], "q_max v₀": scene.cutoff}
    return Table("marks", {"mark": list(marks), "omega [rad/s]": list(marks.values())})


def _scene(scene: WheelScene) -> Table:
    """What the wheel is made of, and who says so."""
    values = {
        "R": f"{scene.radius:g} m",
        "M": f"{scene.mass:g} kg",
        "E": _given(scene.material.youngs_modulus, 1e9, " GPa"),
        "ν": _given(scene.material.poisson_ratio, 1, ""),
        "E*": f"{scene.modulus / 1e9:.5g} GPa: {scene.material.because}",
        "F_N": f"{scene.load:g} N",
        "v₀": f"{scene.speed:g} m/s",
        "h₀": f"{1e6 * scene.rms:.3g} µm",
    }
    for body, rough in (("rail", scene.rail), ("wheel", scene.wheel)):
        if rough:
            values[f"{body}: H; longest, shortest wave"] = (
                f"{rough.hurst:g}; {1e3 * rough.longest:g} mm, {1e3 * rough.shortest:g} mm"
            )
    values |= {
        "distance": f"{scene.length:.3g} m",
        "dx": f"a / {scene.springs}",
        "a": f"{1e3 * scene.contact_radius:.4g} mm",
        "d": f"{1e6 * scene.approach:.4g} µm",
        "h₀ / d": f"{scene.rms / scene.approach:.3g}",
        "ω_eigen": f"{scene.eigenfrequency:.5g} rad/s, {scene.eigenfrequency / (2 * math.pi):.4g} Hz",
        "q_min v₀": f"{scene.jump:.5g} rad/s",
        "q_max v₀": f"{scene.cutoff:.5g} rad/s",
    }
    shown = {"quantity": list(values), "value": list(values.values())}
    if _is_of_the_book(scene):
        shown["source"] = [_source(name) for name in values]
    return Table("the scene", shown)


def _given(value: float | None, scale: float, unit: str) -> str:
    return "not given" if value is None else f"{value / scale:.4g}{unit}"


def _is_of_the_book(scene: WheelScene) -> bool:
    """Whether it has what Table 14.1 prints: a copy of its file that was changed keeps its name."""
    return all(getattr(scene, key) == getattr(TABLE, key) for key in ("name", "radius", "mass", "material", "rms"))


def _source(name: str) -> str:
    if name in BOOK:
        return "printed in the book, Table 14.1"
    follows = name.startswith("E*") or name in ("a", "d", "h₀ / d", "ω_eigen", "q_min v₀", "q_max v₀")
    return "follows" if follows else "ours"


def _hidden(scene: WheelScene) -> list[str]:
    """Why features may be missing."""
    if scene.jump > APART * scene.eigenfrequency:
        return []
    return [
        f"q_min v₀ = {scene.jump:.4g} rad/s is not above ω_eigen = {scene.eigenfrequency:.4g} rad/s by a factor of "
        f"{APART:g}: the roughness excites the resonance itself, and there is no plateau and no jump to look for."
    ]


def _flight(batches: list[Outcome]) -> str:
    """How far the contact goes."""
    lowest, highest = min(float(b["lowest"].min()) for b in batches), max(float(b["highest"].max()) for b in batches)
    airborne = float(np.mean(np.concatenate([b["airborne"] for b in batches])))
    return (
        f"Approaches of all wheels lay between {lowest:.3g} and {highest:.3g} d; without contact they were for "
        f"{100 * airborne:.2g} % of the time."
    )


def _regions(features: dict[str, Number]) -> Table:
    """The chapter's regions, one row a feature."""
    chapter = {
        PEAK: ("1", "a sharp maximum at the eigenfrequency"),
        JUMP: ("2 to 3", "a plateau, and a sharp rise at its end"),
        SLOPE: ("3", "a power law"),
        PERIOD: ("3", "an oscillating substructure of constant period"),
        FLOOR + PREDICTED: ("4", "another slope, an artefact of the finite distance?"),
        BREAK + PREDICTED: ("3 to 4", "a break"),
    }
    rows: list[dict[str, object]] = []
    for feature, (region, says) in chapter.items():
        number = features.get(feature)
        rows.append(
            {
                "region": region,
                "the chapter": says,
                "feature": NAMES[feature],
                "found": "none stands out" if number is None else plus_minus(number.value, number.uncertainty),
                "theory": SOURCES[feature] if number is None else f"{number.reference:.5g} = {SOURCES[feature]}",
                "verdict": "" if number is None else VerdictCell(f"within {number.tolerance:.3g}", number.verdict),
            }
        )
    return table_of("the regions of the spectrum", rows)


def _parameters(features: dict[str, dict[str, Number]]) -> Table:
    """The chapter's parameter studies: found, and what theory has, for each variation."""
    rows: list[dict[str, object]] = []
    for name, numbers in features.items():
        row: dict[str, object] = {"scene": name}
        for feature, label in NAMES.items():
            number = numbers.get(feature)
            row[label] = (
                "none stands out"
                if number is None
                else VerdictCell(
                    f"{plus_minus(number.value, number.uncertainty)} ({number.reference:.5g})", number.verdict
                )
            )
        rows.append(row)
    return table_of("one parameter at a time: found ± 95 % (theory)", rows)


def _conclusions(features: dict[str, dict[str, Number]], base: str, level: Number | None) -> list[str]:
    mine = features[base]
    peak, jump, slope, period = (mine.get(f) for f in (PEAK, JUMP, SLOPE, PERIOD))
    floor, broken = mine.get(FLOOR + PREDICTED), mine.get(BREAK + PREDICTED)
    sentences = [_said("Region 1: the peak is the wheel on its contact spring", peak)]
    sentences.append(_said("Region 3 begins at q_min v₀", jump))
    if slope:
        sentences.append(_said("Its slope is that of linear theory", slope))
    sentences.append(_said("Its oscillation is sin²(q a)", period))
    sentences.append(_said("Its level is that of linear theory", level))
    if floor:
        sentences.append(
            _said("Region 4 is a floor of ω⁻² which the jump at the end of the records makes, not the contact", floor)
        )
    if broken:
        sentences.append(_said("The break is where that floor meets region 3", broken))
    if len(features) > 1:
        sentences += _moves(features)
    return sentences


def _said(sentence: str, number: Number | None) -> str:
    if number is None:
        return f"None stands out in this run: {sentence[0].lower()}{sentence[1:]}."
    return if_confirmed(f"{sentence}: {with_reference(number)}.", [number])


def _moves(features: dict[str, dict[str, Number]]) -> list[str]:
    """Which features follow theory through all variations."""
    parts = []
    for feature, label in NAMES.items():
        numbers = [mine[feature] for mine in features.values() if feature in mine]
        agree = sum(n.verdict is Verdict.AGREE for n in numbers)
        differ = [n.label.split(":")[0] for n in numbers if n.verdict is Verdict.DIFFER]
        missing = [name for name, mine in features.items() if feature not in mine]
        text = f"{label}: {agree} of {len(numbers)}"
        text += f", differs for {_listed(differ)}" if differ else ""
        text += f", none stands out for {_listed(missing)}" if missing else ""
        parts.append(text)
    return [f"One parameter at a time, features that agree with theory: {'; '.join(parts)}."]


def _listed(names: list[str]) -> str:
    return ", ".join(names) if len(names) <= FEW else f"{len(names)} scenes, see the table"


def _captions(result: WheelResult) -> dict[str, str]:
    case = result.case
    captions = {
        "wheel-contact": (
            f"The wheel as the simulation has it. (a) In the manner of Fig. 14.2, after {4 * case.stills} steps: the "
            "profile x²/R of the wheel over springs at the height of the track; dark springs carry, with their "
            "compression below; light ones do not. (b) Its sister in three dimensions, boundary elements in the loop "
            f"after {case.stills} steps of a / {case.cells}: pressure over Hertz's largest in the window that moves "
            "along, over an isotropic surface of the same spectrum (waves of four cells and more); circle: Hertz."
        ),
        "wheel": (
            "Fig. 14.4. (a) Spectrum of the acceleration, (14.17): line, mean over "
            f"{case.realisations} wheels without window, as in the book; band, tenth to ninetieth percentile of "
            "wheels; dashed: with Hann's window; thick grey: linear theory, (14.12) through the resonator; dotted: the "
            "floor that the jumps at the end of the records predict. Vertical lines: ω_eigen, q_min v₀, predicted "
            "break, q_max v₀. (b) Region 3 over ω^(-2H-3), over a linear ω: the oscillation of period π v₀ / a."
        ),
    }
    if len(case.variations()) > 1:
        captions["wheel-parameters"] = (
            f"One parameter at a time, mean of {case.varied} wheels each, without window; thick grey: "
            f"{next(iter(case.variations()))}."
        )
    return captions


CASE = Case(
    name="wheel",
    chapter=Chapter.WHEEL,
    place=1,
    claim="The acceleration of a wheel has four regions, each of known level and slope (Fig. 14.4).",
    answers="Fig. 14.4: the acceleration of a rolling wheel on springs, its regions, and what moves them",
    quick=WheelSpectrum(),
    full=WheelSpectrum(realisations=300, varied=100, cells=24, stills=64),
    run=run,
    evidence=evidence,
    needs=model_needed.wheel,
)
