"""Tables of Fig. 14.5, behind its figures and on its page."""

import math

import numpy as np

from validation.analysis.evidence import Number, Table, columns, plus_minus, table_of
from validation.analysis.spectra import band_means
from validation.analysis.statistics import POWER_DECIBEL
from validation.cases.wheel import features
from validation.cases.wheel.distance import LINEAR_OPEN, OPEN, STEADY, DistanceResult
from validation.cases.wheel.distance_numbers import peaks
from validation.cases.wheel.features import (
    BREAK,
    FLOOR,
    PLATEAU,
    PREDICTED,
    Spectrum,
    level,
    regions_of,
    sixths_of_an_octave,
    spectrum_rows,
)
from validation.theory import wheel as wheel_theory


def breaks_of(result: DistanceResult) -> Table:
    """The break, the floor behind it and the jump that makes the floor, by distance."""
    rows: list[dict[str, object]] = []
    for i, ensemble in enumerate(result.case.distances()):
        spectrum = Spectrum.of(ensemble.scene, [result.distances[i]])
        values, theory = features.measured(spectrum), features.expected(spectrum)
        rows.append(
            {
                "distance [m]": ensemble.steps * ensemble.scene.spacing,
                "duration [s]": spectrum.duration,
                "wheels": ensemble.count,
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
    """The rms jump of linear theory after a start in static equilibrium."""
    scene = spectrum.scene
    # lines of a short record are too far apart to resolve the oscillation
    fine = np.linspace(0.9 * scene.jump, 1.01 * scene.cutoff, 200001)
    forced = 2 * float(np.trapezoid(features.linear_spectrum(scene, fine), fine)) / (2 * math.pi)
    square = wheel_theory.mean_square_jump(forced, eigenfrequency=scene.eigenfrequency, duration=spectrum.duration)
    return math.sqrt(square)


def law_of(law: Number, breaks: Table) -> Table:
    """omega_break ~ T^(1 / (2 H + 1)), through the middle of the breaks."""
    t, measured = breaks["duration [s]"], breaks["break [rad/s]"]
    middle = np.exp(np.mean(np.log(measured) - law.reference * np.log(t)))
    exponent = np.full(t.size, law.reference)
    return Table("law", columns(**{"duration [s]": t, "exponent": exponent, "break [rad/s]": middle * t**exponent}))


def spectra_of(result: DistanceResult) -> Table:
    """Fig. 14.5 in sixths of an octave, without window."""
    rows: list[dict[str, object]] = []
    for i, ensemble in enumerate(result.case.distances()):
        outcome = result.distances[i]
        distance = ensemble.steps * ensemble.scene.spacing
        low, high = 1.5 * float(outcome["omega"][0]), 1.6 * ensemble.scene.cutoff
        spectrum = spectrum_rows(outcome["omega"], outcome["plain"].mean(axis=0), low, high)
        rows += [{"distance [m]": distance, **row} for row in spectrum]
    return table_of("distances", rows)


def endings_of(result: DistanceResult) -> Table:
    """Spectra of every contact and track, in the same bands."""
    omega = result.ends[OPEN]["omega"]
    edges = sixths_of_an_octave(1.5 * float(omega[0]), 4 * result.case.scene.cutoff)
    means = {"omega [rad/s]": np.sqrt(edges[1:] * edges[:-1])}
    for kind, outcome in result.ends.items():
        means[kind] = band_means(outcome["omega"], outcome["plain"].mean(axis=0), edges)
    means[f"{OPEN}, Hann"] = band_means(omega, result.ends[OPEN]["hann"].mean(axis=0), edges)
    return Table("endings", columns(**means))


def plateau_of(result: DistanceResult) -> Table:
    """Levels in region 2 by height."""
    scene = result.case.scene
    rows: list[dict[str, object]] = []
    for height in result.case.heights:
        row: dict[str, object] = {"h / h0": height, "h / d": height * scene.rms / scene.approach}
        for kind in (OPEN, LINEAR_OPEN, STEADY):
            value = level(result.sweep[kind, height], regions_of(scene)[PLATEAU])
            row[f"{kind} [dB]"] = POWER_DECIBEL * value.value
            row[f"± {kind} [dB]"] = POWER_DECIBEL * value.half_width
        rows.append(row)
    return table_of("plateau", rows)


def vibrations_of(result: DistanceResult) -> Table:
    """The frequency of the peak by the amplitude of free vibration."""
    rows: list[dict[str, object]] = [
        {"release / d": release, "peak over omega_eigen": value.value, "± sample": value.half_width}
        for release, value in peaks(result).items()
    ]
    return table_of("vibrations", rows)


def hertz_of(result: DistanceResult) -> Table:
    """The same on a Hertz contact, by quadrature."""
    release = np.linspace(0.02, 1.15 * max(*result.case.releases, 0.1), 60)
    frequency = [1 / wheel_theory.hertz_period(1 + one) for one in release]
    return Table("hertz", {"release / d": release.tolist(), "peak over omega_eigen": frequency})


# --- on the page ---


def shown_breaks(breaks: Table) -> Table:
    measured = zip(breaks["break [rad/s]"], breaks["± break [rad/s]"], strict=True)
    floors = zip(breaks["floor over predicted"], breaks["± sample"], strict=True)
    return Table(
        "the break by distance",
        {
            "distance [m]": [f"{d:.3g}" for d in breaks["distance [m]"]],
            "wheels": breaks["wheels"].tolist(),
            "break [rad/s]": [plus_minus(value, half) for value, half in measured],
            "predicted by its jumps [rad/s]": [f"{b:.4g}" for b in breaks["break by its jumps [rad/s]"]],
            "floor over J² / (ω² T), an identity": [f"{value:.3f} ± {half:.3f}" for value, half in floors],
        },
    )


def shown_levels(result: DistanceResult) -> Table:
    """Levels of the regions of every contact and track, in decibels over (m/s^2)^2 s."""
    rows: list[dict[str, object]] = []
    for kind, outcome in result.ends.items():
        for name, window in (("none", "plain"), ("Hann", "hann")):
            row: dict[str, object] = {"contact and track": kind, "window": name}
            for region, band in regions_of(result.case.scene).items():
                value = POWER_DECIBEL * level(outcome, band, window).value
                row[f"{region} [dB]"] = f"{value:.1f}" if value > -250 else "none"
            rows.append(row)
    return table_of("levels by contact and track", rows)


def shown_plateau(plateau: Table) -> Table:
    """Region 2 by height: each part as a share of its power."""
    whole = plateau[f"{OPEN} [dB]"]

    def shares(kind: str) -> list[str]:
        return [f"{100 * 10 ** (decibels / 10):.2g} %" for decibels in plateau[f"{kind} [dB]"] - whole]

    return Table(
        "region 2 by height: its level without window, and the share of each part in its power",
        {
            "h / h₀": [f"{h:g}" for h in plateau["h / h0"]],
            "h / d": [f"{h:.3g}" for h in plateau["h / d"]],
            f"{OPEN} [dB]": [f"{v:.1f}" for v in whole],
            f"leakage: {LINEAR_OPEN}": shares(LINEAR_OPEN),
            f"nonlinearity: {STEADY}": shares(STEADY),
        },
    )


def shown_phases(result: DistanceResult) -> Table:
    """Region 2 of open tracks by the phase of the natural period in which a record ends."""
    scene, band = result.case.scene, regions_of(result.case.scene)[PLATEAU]
    rows: list[dict[str, object]] = []
    for phase in result.case.phases:
        springs, linear = (result.ended[kind, phase] for kind in (OPEN, LINEAR_OPEN))
        share = math.exp(level(linear, band).value - level(springs, band).value)
        rows.append(
            {
                "natural periods": f"{springs['duration'] * scene.eigenfrequency / 2 / math.pi:.2f}",
                f"{OPEN} [dB]": f"{POWER_DECIBEL * level(springs, band).value:.1f}",
                f"{LINEAR_OPEN} [dB]": f"{POWER_DECIBEL * level(linear, band).value:.1f}",
                "leakage": f"{100 * share:.0f} %",
            }
        )
    return table_of("region 2 by the phase in which a record ends, no window", rows)
