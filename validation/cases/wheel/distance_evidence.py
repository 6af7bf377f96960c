"""What ends of records do to spectra: the law of the break, its cause, what is real in the plateau, and the peak."""

import math

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import (
    Evidence,
    Number,
    Role,
    Table,
    columns,
    if_confirmed,
    plus_minus,
    table_of,
    with_reference,
)
from validation.analysis.spectra import band_means
from validation.analysis.statistics import POWER_DECIBEL, Estimate, ratio_of_means
from validation.cases.wheel.distance import LINEAR, SPRINGS, TABLE, DistanceResult, WheelDistance, run
from validation.cases.wheel.features import BREAK, FLOOR, PEAK, PREDICTED, Spectrum, expected, found, linear_spectrum
from validation.engine.engine import Outcome
from validation.scenes.dynamic_wheel import WheelScene
from validation.selection import model_needed
from validation.simulation.wheel_on_springs import WAVES_APART as APART
from validation.theory import wheel as wheel_theory

OPEN, STEADY, LINEAR_OPEN = f"{SPRINGS}, open", f"{SPRINGS}, steady-state", f"{LINEAR}, open"
WINDOWS = ("plain", "plain")
QUARTER, WHOLE = 0.25, 1.0
"""Heights over h_0 between which growth is told."""
PLATEAU, THIRD, FOURTH = "region 2", "region 3", "region 4"


def evidence(result: DistanceResult) -> Evidence:
    """The break and its law; levels of the regions by the way a record ends, and by height; the peak by amplitude."""
    breaks = _breaks(result)
    law, plateau = _law(result.case, breaks), _plateau(result)
    ends, peaks = _ends(result), _peaks(result)
    numbers = [
        *_exact(result),
        law,
        *_floors(breaks),
        _jump(breaks),
        *_cause(result),
        *_shares(result),
        _order(result),
        _start(result),
        *peaks,
    ]
    return Evidence(
        title="Fig. 14.5: the break, the plateau and the ends of a record",
        method=_method(result.case),
        numbers=tuple(numbers),
        tables=(_spectra(result), breaks, _endings(result), plateau, _vibrations(result)),
        page_tables=(_shown_breaks(breaks), ends, _shown_plateau(plateau), _phases(result)),
        conclusions=tuple(_conclusions(result, law, numbers)),
        captions=_captions(result.case),
        unconverged=result.unconverged,
    )


def _method(case: WheelDistance) -> str:
    scene = case.scene
    return (
        f"Wheels of {scene.name}, {case.wheels} and fewer, over {case.turns} to "
        f"{case.turns * 2**case.doublings} whole turns of the resonance, from static equilibrium; and over "
        f"{scene.length:.3g} m in several ways. Open tracks: their end is {APART} longest waves from their beginning. "
        "Closed tracks, after a whole number of turns, on which a rough wheel has the period of the track. And the "
        "motion that repeats itself with its closed track, found by shooting for the approach and the velocity to "
        "begin with: it has no free vibration, and nothing leaks. Beside springs the linear contact of fixed radius, "
        "(14.11), on the same tracks. What that has in regions 2 and 4 is leakage alone, since its waves end at q_min "
        "v₀ and q_max v₀; what repeating springs have there is nonlinearity alone. Region 2 is looked at from 2 "
        "ω_eigen to 0.8 q_min v₀, region 3 from 1.1 q_min v₀ half a period of its oscillation further, region 4 from "
        "1.3 to 2.6 q_max v₀."
    )


def regions_of(scene: WheelScene) -> dict[str, tuple[float, float]]:
    """Where each region is looked at [rad/s]."""
    period = math.pi * scene.speed / scene.contact_radius
    return {
        PLATEAU: (2 * scene.eigenfrequency, 0.8 * scene.jump),
        THIRD: (1.1 * scene.jump, 1.1 * scene.jump + period / 2),
        FOURTH: (1.3 * scene.cutoff, 2.6 * scene.cutoff),
    }


def level(outcome: Outcome, band: tuple[float, float], window: str = "plain") -> Estimate:
    """ln of the mean of A in a band, with its standard error over groups of wheels."""
    omega = outcome["omega"]
    inside = (omega >= band[0]) & (omega <= band[1])
    groups = outcome[window][:, inside].mean(axis=1)
    mean = float(groups.mean())
    error = float(np.std(groups, ddof=1)) / math.sqrt(groups.size) / mean if groups.size > 1 else 0.0
    return Estimate(math.log(max(mean, 1e-300)), error, max(groups.size, 2))


def ratio(mine: Outcome, other: Outcome, band: tuple[float, float], windows: tuple[str, str] = WINDOWS) -> Estimate:
    """ln of the ratio of both levels, with its standard error over groups of wheels, which may share their tracks."""
    parts = []
    for outcome, window in zip((mine, other), windows, strict=True):
        inside = (outcome["omega"] >= band[0]) & (outcome["omega"] <= band[1])
        groups = outcome[window][:, inside].mean(axis=1)
        parts.append(groups / groups.mean())
    value = level(mine, band, windows[0]).value - level(other, band, windows[1]).value
    return Estimate(value, float(np.std(parts[0] - parts[1], ddof=1)) / math.sqrt(parts[0].size), parts[0].size)


def _breaks(result: DistanceResult) -> Table:
    rows: list[dict[str, object]] = []
    for rides, outcome in zip(result.case.distances(), result.distances, strict=True):
        spectrum = Spectrum.of(rides.scene, [outcome])
        values, theory = found(spectrum), expected(spectrum)
        rows.append(
            {
                "distance [m]": rides.steps * rides.scene.spacing,
                "duration [s]": spectrum.duration,
                "wheels": rides.count,
                "break [rad/s]": values[BREAK].value,
                "standard error [rad/s]": values[BREAK].error,
                "± break [rad/s]": values[BREAK].half_width,
                "break by its jumps [rad/s]": theory[BREAK],
                "floor over predicted": values[FLOOR + PREDICTED].value,
                "± sample": values[FLOOR + PREDICTED].half_width,
                "rms jump [m/s2]": float(np.sqrt(np.mean(spectrum.jumps**2))),
                "of linear theory [m/s2]": _linear_jump(spectrum),
            }
        )
    return table_of("breaks", rows)


def _linear_jump(spectrum: Spectrum) -> float:
    """The rms jump that linear theory expects from a start in static equilibrium."""
    scene = spectrum.scene
    # the lines of short records are too far apart for the oscillation
    fine = np.linspace(0.9 * scene.jump, 1.01 * scene.cutoff, 200001)
    forced = 2 * float(np.trapezoid(linear_spectrum(scene, fine), fine)) / (2 * math.pi)
    square = wheel_theory.mean_square_jump(forced, eigenfrequency=scene.eigenfrequency, duration=spectrum.duration)
    return math.sqrt(square)


def _law(case: WheelDistance, breaks: Table) -> Number:
    """d ln omega_break / d ln T by least squares, weighted."""
    x, y = np.log(breaks["duration [s]"]), np.log(breaks["break [rad/s]"])
    weights = breaks["break [rad/s]"] / breaks["standard error [rad/s]"]
    (slope, _), covariance = np.polyfit(x, y, 1, w=weights, cov="unscaled")
    estimate = Estimate(float(slope), math.sqrt(covariance[0, 0]), case.groups)
    rough = case.scene.rail or case.scene.wheel
    hurst = rough.hurst if rough else math.nan
    return Number(
        quantity=f"break against duration over a factor {2**case.doublings}: d ln ω_break / d ln T",
        value=estimate.value,
        reference=wheel_theory.break_exponent(hurst),
        source="1 / (2 H + 1): a floor J² / (ω² T) under a spectrum of ω^(-2H-3)",
        tolerance=0.1,
        reason="0.1: tells the law from none, 0, and from the one of a slope as in region 1, 1/2 and more",
        sample=estimate.half_width,
        role=Role.FINDING,
    )


def _floors(breaks: Table) -> list[Number]:
    return [
        Number(
            quantity=f"floor over J² / (ω² T), {distance:.3g} m",
            value=value,
            reference=1.0,
            source="the jump of a(t) from the end of each record to its beginning",
            tolerance=0.1,
            reason="10 %: 0.4 dB of a level",
            sample=half,
            role=Role.FINDING,
        )
        for distance, value, half in zip(
            breaks["distance [m]"], breaks["floor over predicted"], breaks["± sample"], strict=True
        )
    ]


def _jump(breaks: Table) -> Number:
    """The jump beside linear theory, over all distances; the error of a mean square of so many Gaussian values."""
    ratio, wheels = (breaks["rms jump [m/s2]"] / breaks["of linear theory [m/s2]"]) ** 2, breaks["wheels"]
    return Number(
        quantity="rms jump over that of linear theory, all distances",
        value=math.sqrt(float(np.average(ratio, weights=wheels))),
        reference=1.0,
        source="(1 + cos²(ω_eigen T)) int A df of (14.12) through the resonator, from static equilibrium",
        tolerance=0.1,
        reason="10 %: 0.8 dB; nonlinearity adds a part of order h₀/d",
        sample=2 / math.sqrt(2 * float(wheels.sum())),
        role=Role.FINDING,
    )


def _exact(result: DistanceResult) -> list[Number]:
    """A linear contact has nothing where it has no waves, once nothing leaks."""
    bands = regions_of(result.case.scene)
    third = level(result.ends["linear, repeating"], bands[THIRD]).value
    return [
        Number(
            quantity=f"linear contact, repeating: level in {region} over that in region 3",
            value=math.exp(level(result.ends["linear, repeating"], bands[region]).value - third),
            reference=0.0,
            source="no waves outside of q_min to q_max",
            tolerance=1e-18,
            reason="rounding of the acceleration, 1e-16 of its size, squared, and spread over all frequencies",
        )
        for region in (PLATEAU, FOURTH)
    ]


def _over(label: str, value: Estimate, source: str, reason: str) -> Number:
    """A ratio of levels in decibels, beside none, within one."""
    return Number(
        quantity=label,
        value=POWER_DECIBEL * value.value,
        reference=0.0,
        source=source,
        tolerance=1.0,
        unit="dB",
        reason=reason,
        sample=POWER_DECIBEL * value.half_width,
        role=Role.FINDING,
    )


def _cause(result: DistanceResult) -> list[Number]:
    """Level of region 4 of springs in the ways that leave no jump, and of the linear contact, over open springs."""
    band = regions_of(result.case.scene)[FOURTH]
    base = result.ends[OPEN]
    ways: dict[str, Estimate] = {
        "springs, open, Hann's window": ratio(base, base, band, ("hann", "plain")),
        "springs, whole turns": ratio(result.ends["springs, whole turns"], base, band),
        "springs, repeating": ratio(result.ends["springs, repeating"], base, band),
        "linear, open": ratio(result.ends[LINEAR_OPEN], base, band),
    }
    return [
        _over(
            f"region 4: {name}, over springs, open, no window",
            value,
            "no change, if region 4 were real",
            "1 dB: the scatter of a few wheels",
        )
        for name, value in ways.items()
    ]


def _shares(result: DistanceResult) -> list[Number]:
    """Region 2 of open springs: what the linear contact leaks, and what is left when nothing leaks."""
    band = regions_of(result.case.scene)[PLATEAU]
    base = result.ends[OPEN]
    parts = {"linear, open": "leakage alone", "springs, repeating": "nonlinearity alone"}
    return [
        _over(
            f"region 2: {name}, {what}, over springs, open",
            ratio(result.ends[name], base, band),
            "the whole plateau",
            "1 dB: a fifth of its power",
        )
        for name, what in parts.items()
    ]


def _order(result: DistanceResult) -> Number:
    """The power of h_0 by which the nonlinear part of region 2 grows; what leaks of a linear contact grows as h_0^2."""
    band, step = regions_of(result.case.scene)[PLATEAU], math.log(WHOLE / QUARTER)
    change = ratio(result.sweep[STEADY, WHOLE], result.sweep[STEADY, QUARTER], band)
    return Number(
        quantity=f"region 2, {STEADY}: d ln A / d ln h₀ from {QUARTER:g} to {WHOLE:g} h₀",
        value=change.value / step,
        reference=4.0,
        source="products of two waves, each linear in h₀",
        tolerance=0.3,
        reason="0.3: tells 2 from 3 and 3 from 4",
        sample=change.half_width / step,
        role=Role.FINDING,
    )


def _start(result: DistanceResult) -> Number:
    """Mean square of the acceleration from static equilibrium over that without free vibration."""
    found_ = ratio_of_means(result.ends[OPEN]["square"], result.ends["springs, repeating"]["square"])
    return Number(
        quantity="mean square acceleration, open from static equilibrium, over that of the repeating motion",
        value=found_.value,
        reference=1.5,
        source="1 + 1/2: the free vibration begins with the amplitude dF / M that cancels the forced acceleration",
        tolerance=0.15,
        reason="10 %: waves far above the resonance, a few wheels",
        sample=found_.half_width,
        role=Role.FINDING,
    )


def _phases(result: DistanceResult) -> Table:
    """Region 2 of open tracks by the phase of the resonance in which a record ends."""
    band = regions_of(result.case.scene)[PLATEAU]
    rows: list[dict[str, object]] = []
    for phase in result.case.phases:
        springs, linear = (result.ended[law, phase] for law in (SPRINGS, LINEAR))
        share = math.exp(level(linear, band).value - level(springs, band).value)
        rows.append(
            {
                "turns of the resonance": f"{springs['duration'] * result.case.scene.eigenfrequency / 2 / math.pi:.2f}",
                "springs, open [dB]": f"{POWER_DECIBEL * level(springs, band).value:.1f}",
                "linear, open [dB]": f"{POWER_DECIBEL * level(linear, band).value:.1f}",
                "leakage": f"{100 * share:.0f} %",
            }
        )
    return table_of("region 2 by the phase in which a record ends, no window", rows)


def _peaks(result: DistanceResult) -> list[Number]:
    numbers = []
    for release, estimate in _frequencies(result).items():
        exact = 1 / wheel_theory.hertz_period(1 + release) if release else 1.0
        numbers.append(
            Number(
                quantity=f"peak over ω_eigen, released {release:g} d below equilibrium",
                value=estimate.value,
                reference=exact,
                source="period of free vibration on a Hertz contact, quadrature" if release else "sqrt(2 a E* / M)",
                tolerance=0.005,
                reason="0.5 %: roughness makes a part of the amplitude, and bears a part of the load",
                sample=estimate.half_width,
                role=Role.FINDING,
            )
        )
    return numbers


def _frequencies(result: DistanceResult) -> dict[float, Estimate]:
    """Of the peak over omega_eigen, by release."""
    frequencies = {}
    for release, rides in result.case.vibrations().items():
        value = found(Spectrum.of(rides.scene, [result.vibrations[release]]))[PEAK]
        frequency = rides.scene.eigenfrequency
        frequencies[release] = Estimate(value.value / frequency, value.error / frequency, value.samples)
    return frequencies


def _spectra(result: DistanceResult) -> Table:
    """Fig. 14.5 in sixths of an octave, without window."""
    rows: list[dict[str, object]] = []
    for rides, outcome in zip(result.case.distances(), result.distances, strict=True):
        omega = outcome["omega"]
        edges = _edges(omega, 1.6 * rides.scene.cutoff)
        means = band_means(omega, outcome["plain"].mean(axis=0), edges)
        for centre, a in zip(np.sqrt(edges[1:] * edges[:-1]), means, strict=True):
            if np.isfinite(a):
                rows.append(
                    {
                        "distance [m]": rides.steps * rides.scene.spacing,
                        "omega [rad/s]": float(centre),
                        "A [(m/s2)2 s]": float(a),
                    }
                )
    return table_of("distances", rows)


def _edges(omega: np.ndarray, last: float) -> np.ndarray:
    """Sixths of an octave from the second line on."""
    low = 1.5 * float(omega[0])
    return np.asarray(low * 2 ** (np.arange(0, 6 * math.log2(last / low)) / 6))


def _endings(result: DistanceResult) -> Table:
    """Spectra by the way a record ends; the same bands for all."""
    omega = result.ends[OPEN]["omega"]
    edges = _edges(omega, 4 * result.case.scene.cutoff)
    found_: dict[str, np.ndarray] = {"omega [rad/s]": np.sqrt(edges[1:] * edges[:-1])}
    for name, outcome in result.ends.items():
        found_[name] = band_means(outcome["omega"], outcome["plain"].mean(axis=0), edges)
    found_["springs, open, Hann"] = band_means(omega, result.ends[OPEN]["hann"].mean(axis=0), edges)
    return Table("endings", columns(**found_))


def _ends(result: DistanceResult) -> Table:
    """Levels of the regions in each way, in decibels over (m/s^2)^2 s."""
    rows: list[dict[str, object]] = []
    for name, outcome in result.ends.items():
        for window, of in (("none", "plain"), ("Hann", "hann")):
            row: dict[str, object] = {"contact and track": name, "window": window}
            for region, band in regions_of(result.case.scene).items():
                value = POWER_DECIBEL * level(outcome, band, of).value
                row[f"{region} [dB]"] = f"{value:.1f}" if value > -250 else "none"
            rows.append(row)
    return table_of("levels by the way a record ends", rows)


def _plateau(result: DistanceResult) -> Table:
    band = regions_of(result.case.scene)[PLATEAU]
    rows: list[dict[str, object]] = []
    for height in result.case.heights:
        row: dict[str, object] = {
            "h / h0": height,
            "h / d": height * result.case.scene.rms / result.case.scene.approach,
        }
        for kind in (OPEN, LINEAR_OPEN, STEADY):
            value = level(result.sweep[kind, height], band)
            row[f"{kind} [dB]"], row[f"± {kind} [dB]"] = POWER_DECIBEL * value.value, POWER_DECIBEL * value.half_width
        rows.append(row)
    return table_of("plateau", rows)


def _shown_plateau(plateau: Table) -> Table:
    whole = plateau[f"{OPEN} [dB]"]

    def share(decibels: float) -> str:
        return f"{100 * 10 ** (decibels / 10):.2g} %"

    return Table(
        "region 2 by height: its level without window, and the level of each part beside it",
        {
            "h / h₀": [f"{h:g}" for h in plateau["h / h0"]],
            "h / d": [f"{h:.3g}" for h in plateau["h / d"]],
            "springs, open [dB]": [f"{v:.1f}" for v in whole],
            "leakage: linear, open": [share(v - w) for v, w in zip(plateau[f"{LINEAR_OPEN} [dB]"], whole, strict=True)],
            "nonlinearity: springs, repeating": [
                share(v - w) for v, w in zip(plateau[f"{STEADY} [dB]"], whole, strict=True)
            ],
        },
    )


def _shown_breaks(breaks: Table) -> Table:
    return Table(
        "the break by distance",
        {
            "distance [m]": [f"{d:.3g}" for d in breaks["distance [m]"]],
            "wheels": breaks["wheels"].tolist(),
            "break [rad/s]": [
                plus_minus(b, half) for b, half in zip(breaks["break [rad/s]"], breaks["± break [rad/s]"], strict=True)
            ],
            "by its own jumps [rad/s]": [f"{b:.4g}" for b in breaks["break by its jumps [rad/s]"]],
            "floor over J² / (ω² T)": [
                f"{v:.3f} ± {h:.3f}" for v, h in zip(breaks["floor over predicted"], breaks["± sample"], strict=True)
            ],
        },
    )


def _vibrations(result: DistanceResult) -> Table:
    rows: list[dict[str, object]] = [
        {"release / d": release, "peak over omega_eigen": value.value, "± sample": value.half_width}
        for release, value in _frequencies(result).items()
    ]
    return table_of("vibrations", rows)


def _conclusions(result: DistanceResult, law: Number, numbers: list[Number]) -> list[str]:
    def value(start: str) -> Number:
        return next(n for n in numbers if n.label.startswith(start))

    hann, repeating = value("region 4: springs, open, Hann"), value("region 4: springs, repeating")
    leak, own = value("region 2: linear, open"), value("region 2: springs, repeating")
    share = [100 * 10 ** (n.value / 10) for n in (leak, own)]
    floors = [n for n in numbers if n.label.startswith("floor")]
    jump = value("rms jump")
    shifts = [n for n in numbers if n.label.startswith("peak")]
    start, order = value("mean square"), value("region 2, springs, steady")
    turns = float(result.ends[OPEN]["duration"]) * result.case.scene.eigenfrequency / (2 * math.pi)
    band = regions_of(result.case.scene)[PLATEAU]
    leaks = [POWER_DECIBEL * level(result.ended[LINEAR, phase], band).value for phase in result.case.phases]
    phases = f"{min(leaks):.0f} and {max(leaks):.0f} dB"
    return [
        if_confirmed(
            f"The break moves as T^{law.reference:.3f}: exponent {with_reference(law)}. It goes to higher frequencies "
            "with the distance, and with it region 4 disappears.",
            [law],
        ),
        if_confirmed(
            "The level of region 4 follows from the jump between the end and the beginning of each record, "
            f"J² / (ω² T), at all {len(floors)} distances, to {100 * max(abs(n.value - 1) for n in floors):.1f} %.",
            floors,
        ),
        if_confirmed(
            "That jump follows from linear theory and the start in static equilibrium, 1 + cos²(ω_eigen T) times the "
            f"forced acceleration squared: rms over all distances {jump.value:.3f} ± {jump.uncertainty:.3f} of it.",
            [jump],
        ),
        if_confirmed(
            "Region 4 is leakage of the rectangular window, the linear contact has it as well: Hann's window lowers it "
            f"by {-hann.value:.1f} dB, a motion that repeats itself by {-repeating.value:.1f} dB, to what nonlinear "
            "springs really have there.",
            [value("region 4: linear, open")],
        ),
        f"Region 2, the plateau, of springs on open tracks at h₀ and {turns:.2f} turns of the resonance: the linear "
        f"contact, which has nothing there but leakage, has {share[0]:.0f} % of its power; springs that leak nothing "
        f"have {share[1]:.0f} %. The first grows as h₀² and falls as 1/T, and depends on the phase in which the record "
        f"ends, between {phases}; the second grows as h₀^{order.value:.2f} ({order.verdict} with h₀⁴ within "
        f"{order.tolerance:g}), whatever the record. On springs of Geike's spectrum nothing else is there.",
        if_confirmed(
            "Nothing damps the wheel, so the free vibration with which it begins stays: the mean square acceleration "
            f"is {start.value:.2f} ± {start.uncertainty:.2f} times that without it. The level of region 1 is that of "
            "the start; its frequency alone is the contact's.",
            [start],
        ),
        if_confirmed(
            "The peak follows the amplitude of free vibration as a Hertz contact has it: "
            + "; ".join(f"{n.label.split('released ')[1]}: {n.value:.4f} beside {n.reference:.4f}" for n in shifts)
            + ".",
            shifts,
        ),
    ]


def _captions(case: WheelDistance) -> dict[str, str]:
    return {
        "wheel_distance": (
            "Fig. 14.5. (a) Spectra without window, dark to light from the shortest distance to the longest, "
            f"{2**case.doublings} times as long; circles: the break. (b) The break against the duration with 95 % "
            "intervals; crosses: from the jumps of the same records; line: T^(1/(2H+1)) through the middle."
        ),
        "wheel_distance-cause": (
            f"(a) The same wheels over {case.scene.length:.3g} m. Springs: full line, open track, no window; dashed, "
            "the same with Hann's window; thick, motion that repeats itself; dash-dotted, closed after whole turns. "
            "Dotted: the linear contact on open tracks, leakage alone outside of its waves. (b) Region 2 against the "
            "roughness: circles, springs on open tracks; crosses, linear contact, leakage; squares, repeating springs, "
            "nonlinearity; lines: h² and h⁴. (c) The peak against the amplitude of free vibration: line, quadrature "
            "for a Hertz contact."
        ),
    }


CASE = Case(
    name="wheel_distance",
    chapter=Chapter.WHEEL,
    place=2,
    claim="The break that moves with the distance is leakage (Fig. 14.5).",
    answers="Fig. 14.5: the break that moves with the distance, its cause, and what is real in the plateau",
    quick=WheelDistance(),
    full=WheelDistance(
        scene=TABLE,
        doublings=6,
        wheels=300,
        fewest=40,
        causes=60,
        rough=20,
        heights=(0.125, 0.25, 0.5, 1.0, 2.0, 4.0),
        phases=(0.0, 0.25, 0.5),
        releases=(0.0, 0.1, 0.2, 0.4),
        released=5,
    ),
    run=run,
    evidence=evidence,
    needs=model_needed.wheel,
)
