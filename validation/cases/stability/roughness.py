"""Tables and numbers of rough tracks on springs: round after round, springs too far apart, lift-off."""

import math

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from validation.analysis.evidence import Number, Role, Table, table_of
from validation.cases.stability.stability import Row, WheelStabilityResult
from validation.engine.engine import Outcome
from validation.simulation.free_vibration import TENTHS, WHEEL
from validation.simulation.integrators import EXPLICIT_EULER, VELOCITY_VERLET
from validation.simulation.spring_tracks import FINE, HEIGHT, STRIDES, LiftOff, RoughTrack, Rounds

FloatArray = NDArray[np.float64]

OPEN = "left open by the ends of contact, first order [dB]"
QUARTER = 25
"""The stride of springs a quarter of the shortest wave apart."""


def rounds_table(result: WheelStabilityResult) -> Table:
    """Tenths of the rounds over the first one, means over the wheels."""
    rows: list[Row] = []
    for name, found in result.rounds.items():
        for j in range(TENTHS):
            row: Row = {"scheme": name, "rounds": (j + 0.5) * result.case.rounds / TENTHS}
            row["linear theory"] = _gain(result.case.rounds * j / TENTHS) if name == EXPLICIT_EULER.name else 0.0
            for key, label in (("square", "mean square acceleration"), ("free", "free vibration")):
                mean, half = _log_mean(found[key][j] / found[key][0])
                row |= {f"{label}, log over first tenth": mean, f"{label}, half-width": half}
            rows.append(row)
    return table_of("rounds", rows)


def _log_mean(ratios: FloatArray, confidence: float = 0.95) -> tuple[float, float]:
    """Mean of the logarithms over the wheels, and the half-width of its interval."""
    logs = np.log(ratios)
    quantile = stats.t.ppf((1 + confidence) / 2, logs.size - 1)
    return float(logs.mean()), float(quantile * logs.std(ddof=1) / math.sqrt(logs.size))


def round_numbers(result: WheelStabilityResult) -> list[Number]:
    """The last tenth of the rounds over the first one."""
    verlet, euler = (result.rounds[scheme.name] for scheme in (VELOCITY_VERLET, EXPLICIT_EULER))
    rounds = result.case.rounds
    free, theory = "energy of the free vibration", _gain((1 - 1 / TENTHS) * rounds)
    none, grows = "a periodic track that gives the wheel no energy in the mean", "n log(1 + (omega dt)^2)"
    return [
        _growth(f"{VELOCITY_VERLET.name}, springs: mean square acceleration", rounds, verlet["square"], 0.0, none),
        _growth(f"{VELOCITY_VERLET.name}, springs: {free}", rounds, verlet["free"], 0.0, none),
        _growth(f"{EXPLICIT_EULER.name}, springs: {free}", rounds, euler["free"], theory, grows),
    ]


def _growth(what: str, rounds: int, tenths: FloatArray, theory: float, source: str) -> Number:
    """Within what wheels scatter and what a Hertz contact adds, u'' = 1 - u - (u - 1)^2 / 4 + ..., at an amplitude A.

    The square of A, of the theory; the second harmonic, A / 24 of the first, which n turns tell from it but for
    1 / (2 n): A / (24 n) of the energy of a tenth.
    """
    ratios = tenths[-1] / tenths[0]
    mean, half = _log_mean(ratios)
    amplitude = (Rounds.lift + HEIGHT / WHEEL.approach) * math.exp(theory / 2)
    problem = Rounds(scheme="", track=RoughTrack(rms=HEIGHT, seed=0), wheels=1, rounds=rounds)
    turns = rounds / TENTHS * problem.track.points * problem.turn / (2 * math.pi)
    return Number(
        quantity=f"{what}, last tenth of {rounds} rounds over the first, log",
        value=mean,
        reference=theory,
        source=source,
        tolerance=_log_mean(ratios, 0.999)[1] + half + amplitude / (12 * turns) + theory * amplitude**2,
        reason=f"the 99.9 % interval of {ratios.size} wheels; of the largest amplitude over d_N the square, of the "
        f"theory, and the second harmonic, which {turns:.3g} turns of a tenth mix with the first",
        sample=half,
    )


def _gain(rounds: float) -> float:
    """log of the energy by which explicit Euler multiplies that of a free vibration in so many rounds."""
    problem = Rounds(scheme=EXPLICIT_EULER.name, track=RoughTrack(rms=HEIGHT, seed=0), wheels=1, rounds=0)
    return rounds * problem.track.points * math.log1p(problem.turn**2)


def spacing_table(result: WheelStabilityResult) -> Table:
    """Of each height and spacing, means over the tracks; no level where the springs cannot carry the last band."""
    rows: list[Row] = []
    for height in result.case.spacing_heights:
        found = [outcome for problem, outcome in result.spacing if problem.track.rms == height * WHEEL.approach]
        error, level, linear, spread = (
            np.stack([outcome[key] for outcome in found]) for key in ("error", "level", "linear", "spread")
        )
        for i, stride in enumerate(STRIDES):
            carried = bool(level[:, i].mean() > 0)
            rows.append(
                {
                    "height [d_N]": height,
                    "q_max dx": 2 * math.pi * stride / FINE,
                    "dx [shortest wave]": stride / FINE,
                    "error of force over its fluctuation": float(np.sqrt(np.mean(error[:, i] ** 2))),
                    "error of the last one-third octave [dB]": _decibel(level[:, i].mean()) if carried else 0.0,
                    "by linear theory [dB]": _decibel(linear[:, i].mean()),
                    OPEN: _decibel(1 + spread[:, i].mean() / math.sqrt(len(found))),
                    "carried": float(carried),
                }
            )
    return table_of("spacing", rows)


def _decibel(ratio: float) -> float:
    return 10 * math.log10(ratio)


def spacing_numbers(table: Table) -> list[Number]:
    """The lowest roughness against linear theory, and what a quarter of a wave costs there: above, tracks differ."""
    heights = sorted(set(table["height [d_N]"].tolist()))
    low = table.where(**{"height [d_N]": heights[0], "carried": 1.0})
    off = low["error of the last one-third octave [dB]"] - low["by linear theory [dB]"]
    open_ends = low[OPEN]
    worst = int(np.argmax(np.abs(off) / open_ends))
    linear = Number(
        quantity=f"springs, h = {heights[0]:g} d: level of the last one-third octave less the sum over springs, "
        f"at the spacing where that is least likely, {low['dx [shortest wave]'][worst]:g} of the shortest wave",
        value=float(off[worst]),
        reference=0.0,
        source="dx sin(q (m + 1/2) dx) / sin(q dx / 2) in place of 2 sin(q a) / q",
        tolerance=5 * float(open_ends[worst]),
        reason="five standard deviations of what the ends of contact, which the height moves, do to the waves of a "
        "track: each spring there by phi(gap / h_rms)",
        unit="dB",
    )
    return [linear, _quarter(low)]


def quarter_wave(table: Table) -> Table:
    """Springs a quarter of the shortest wave apart."""
    return table.where(**{"dx [shortest wave]": QUARTER / FINE})


def _quarter(rows: Table) -> Number:
    return Number(
        quantity=f"springs, h = {rows['height [d_N]'][0]:g} d: error of the last one-third "
        f"octave with a quarter of the "
        "shortest wave",
        value=float(quarter_wave(rows)["error of the last one-third octave [dB]"][0]),
        reference=0.0,
        source="the condition dx < lambda / 4",
        tolerance=1.0,
        reason="a decibel, z / sin(z) with z = pi / 4 being 0.91 dB at the last wave alone",
        unit="dB",
        sample=2 * float(quarter_wave(rows)[OPEN][0]),
        role=Role.FINDING,
    )


def lift_table(result: WheelStabilityResult) -> Table:
    """Of each load and height, over all wheels; beside it linear theory on the same tracks, and Gauss."""
    return table_of("lift-off", [_lift_row(problem, found) for problem, found in result.lift])


def _lift_row(problem: LiftOff, found: Outcome) -> Row:
    rms = float(np.sqrt(np.mean(found["rms"] ** 2)))
    return {
        "sweep": problem.sweep,
        "load [N]": problem.load,
        "height [d_N]": problem.track.rms / problem.wheel.approach,
        "time airborne": float(found["airborne"].mean()),
        "time airborne, linear": float(found["negative"].mean()),
        "time airborne, Gaussian": float(stats.norm.cdf(-1 / rms)),
        "rms of linear force [F_N]": rms,
        "deepest linear pull [F_N]": float(found["pull"].max()),
        "highest force [F_N]": float(found["highest"].max()),
        "highest force, median [F_N]": float(np.median(found["highest"])),
        "lowest force [F_N]": float(found["lowest"].min()),
        "largest error of the mean force": float(np.abs(found["mean"] - 1).max()),
        "balance of momentum": float(np.abs(found["mean"] - 1 + found["momentum"]).max()),
        "hop [d_N]": float(found["hop"].max() / problem.wheel.approach),
    }


def lift_numbers(result: WheelStabilityResult, table: Table) -> list[Number]:
    """What must hold in the air as on the ground, and from where on wheels lift off."""
    steps = result.case.lift_rounds * RoughTrack(rms=HEIGHT, seed=0).points
    highest = float(table["highest force [F_N]"].max())
    return [
        Number(
            quantity="force never negative: the lowest, where that is below zero, over F_N",
            value=float(np.minimum(table["lowest force [F_N]"], 0.0).min()),
            source="springs pull nowhere",
            tolerance=4 * float(np.finfo(float).eps),
            reason="rounding of g - F / M",
            reference=0.0,
        ),
        Number(
            quantity="F T - F_N T = M (v_0 - v_end), largest difference over F_N T, all loads and heights",
            value=float(table["balance of momentum"].max()),
            source="momentum; steps of Verlet sum accelerations with half of the first and of the last",
            tolerance=float(np.finfo(float).eps) * highest * steps,
            reason="rounding, a last place of the highest force each step",
            reference=0.0,
        ),
        *[number for sweep in ("height", "load") for number in _thresholds(table.where(sweep=sweep), sweep)],
    ]


def _thresholds(rows: Table, sweep: str) -> list[Number]:
    """From which h / d linear theory pulls, and springs were seen to let go: between which of them."""
    seen = first_lift(rows)
    if seen is None:
        return []
    below = rows["height [d_N]"][rows["height [d_N]"] < seen]
    pull = pulls_from(rows)
    return [
        Number(
            quantity=f"first lift-off seen, h / d, changing the {sweep}",
            value=seen,
            reference=pull,
            source="(14.11): from where the deepest pull exceeds F_N, on the same tracks",
            tolerance=0.2 * pull,
            reason="a fifth",
            grid=seen - float(below.max()) if below.size else 0.0,
            role=Role.FINDING,
        )
    ]


def first_lift(rows: Table) -> float | None:
    """The lowest h / d at which a wheel was in the air."""
    found = rows["height [d_N]"][rows["time airborne"] > 0]
    return float(found.min()) if found.size else None


def pulls_from(rows: Table) -> float:
    """h / d at which the deepest linear pull is F_N: interpolated, both logarithmic, where the load changes too."""
    order = np.argsort(rows["height [d_N]"])
    height, pull = (np.log(rows[name][order]) for name in ("height [d_N]", "deepest linear pull [F_N]"))
    slope = (height[-1] - height[0]) / (pull[-1] - pull[0])
    if pull[0] <= 0 <= pull[-1]:
        return float(np.exp(np.interp(0.0, pull, height)))
    return float(np.exp(height[0] - slope * pull[0]))
