"""Limits of every method, as a table: what is swept, how it must fail, and the threshold that a condition predicts."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from validation.analysis.series import MARGINS
from validation.engine.engine import FloatArray, Outcome
from validation.simulation import limits
from validation.simulation.limits import SweepProblem
from validation.simulation.rough_punch import force_levels
from validation.simulation.spring_tracks import FINE, STRIDES

FULL, HALF = 1.1631 / math.sqrt(2), 0.4769 / math.sqrt(2)
"""p over E* g at which Persson's contact fraction erf(sqrt(2) p / (E* g)) is 0.9, and one half; g: rms gradient."""


class LimitName(NamedTuple):
    """The method, the limit in a few words, and the parameter with its unit."""

    method: str
    title: str
    parameter: str


@dataclass(frozen=True)
class Probe:
    """run: of `simulation`; values: of its parameter; takes: settings of the case; settings: fixed; part: of errors."""

    run: Callable[..., Outcome]
    values: tuple[float, ...]
    takes: tuple[str, ...] = ()
    settings: tuple[tuple[str, str], ...] = ()
    part: int = 0


class Failing(NamedTuple):
    """On which side of the threshold, by which error, with its unit, against what, past which tolerance."""

    side: Literal["above", "below"]
    error: str
    reference: str
    tolerance: float


class Judged(NamedTuple):
    """factor: above one, within which the threshold must be found; derived: whether it follows from theory alone, and
    must, or is an estimate; warned: whether the software must warn or refuse past it, and nowhere else."""

    factor: float
    derived: bool = False
    warned: bool = False


@dataclass(frozen=True)
class Limit:
    """condition: of the threshold; threshold: which that is, a number, or of the tolerance and what the probe has
    measured."""

    named: LimitName
    probe: Probe
    fails: Failing
    condition: str
    threshold: float | Callable[[float, float], float]
    judged: Judged

    @property
    def name(self) -> str:
        return f"{self.named.method}: {self.named.title}"

    def problem(self, case: Any) -> SweepProblem:
        """For the settings of a case. Limits that have the same problem are found by one solve."""
        settings = (*((name, getattr(case, name)) for name in self.probe.takes), *self.probe.settings)
        return SweepProblem(probe=self.probe.run.__name__, values=self.probe.values, settings=settings)


VERLET, EULER, KUTTA = ((("scheme", name),) for name in ("velocity Verlet", "explicit Euler", "Runge-Kutta"))
SEED, PUNCHES = ("seed",), ("cells", "surfaces", "profiles", "seed")
FORCES, SIDES = (*force_levels((-2, 2), 2), 10**2.5), (6, 10, 13, 14, 15, 16, 17, 18, 20, 24, 32)
SPRINGS = (
    Limit(
        LimitName("linear filter, 3D", "rough strip", "height h_rms / d"),
        Probe(
            limits.rough_strips,
            (0.003, 0.01, 0.02, 0.04, 0.08, 0.12, 0.18, 0.27, 0.4, 0.7),
            ("length", "strip_cells", "seed"),
        ),
        Failing("above", "force, over its fluctuation", "boundary elements on the same strip", 0.2),
        "√(π/8) g a / d = tolerance, g = √2 h' the rms gradient: the part out of contact by Persson, weighted with "
        "the pressure of a flat punch",
        lambda tolerance, gradient: tolerance / (math.sqrt(math.pi / 8) * gradient),
        Judged(3.0),
    ),
    Limit(
        LimitName("springs", "true contact area", "force F / (E* h L)"),
        Probe(limits.rough_punches, FORCES, PUNCHES),
        Failing("below", "contact fraction, over that of 3D, less one", "boundary elements, rough punches", 0.1),
        "p = 0.82 E* g, g the rms gradient, where Persson's contact fraction is 0.9: springs are right near full "
        "contact only",
        lambda _, gradient: FULL * gradient,
        Judged(3.0),
    ),
    Limit(
        LimitName("springs", "mean gap", "force F / (E* h L)"),
        Probe(limits.rough_punches, FORCES, PUNCHES, part=1),
        Failing("below", "difference of the mean gaps [h]", "boundary elements, rough punches", 0.1),
        "p = 0.34 E* g, g the rms gradient, where Persson's contact fraction is a half: springs are right where gaps "
        "are closed",
        lambda _, gradient: HALF * gradient,
        Judged(3.0),
    ),
    Limit(
        LimitName("linear filter, 1D", "level along the track", "wavenumber q a"),
        Probe(limits.octaves, (0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0, 8.0, 16.0), SEED),
        Failing("above", "level over that of 3D [dB]", "linear theory of the half-space, octaves", 3.0),
        "q a = 1: waves shorter than the contact are lower by Γ(H+3/2) / (√π Γ(H+2)) on the half-space",
        1.0,
        Judged(2.5),
    ),
    Limit(
        LimitName("linear filter, 1D", "anisotropic surface", "aspect ratio of the waves, less one"),
        Probe(limits.anisotropy, (1.05, 1.1, 1.2, 1.3, 1.45, 1.65, 2.0, 3.0, 5.0, 9.0), SEED),
        Failing("above", "rms force, over that of 3D, less one", "linear theory of the half-space, quadrature", 0.2),
        "√ratio = 1 + tolerance, for q a >> 1: a line along the long waves is taken for one of an isotropic surface",
        lambda tolerance, _: (1 + tolerance) ** 2 - 1,
        Judged(2.0, derived=True),
    ),
    Limit(
        LimitName("linear filter, 1D", "rough track", "height h_rms / d"),
        Probe(limits.rough_tracks, (0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.45, 0.7, 1.0), ("track", "seed")),
        Failing("above", "force, over its fluctuation", "one-sided springs on the same track", 0.1),
        "h / d = 2 c tolerance, c = rms dF / (E* a h): second-order effect of the moving ends of the contact",
        lambda tolerance, c: 2 * c * tolerance,
        Judged(2.0, derived=True, warned=True),
    ),
    Limit(
        LimitName("springs", "springs too far apart", "springs to the shortest wave"),
        Probe(limits.coarser_springs, STRIDES, SEED),
        Failing("below", "last one-third octave [dB]", f"{FINE} springs to the shortest wave", 1.0),
        "4 springs: z / sin z = 0.91 dB at z = π/4",
        4.0,
        Judged(1.75, derived=True, warned=True),
    ),
    Limit(
        LimitName("springs", "the last asperity", "springs in contact"),
        Probe(limits.last_asperities, tuple(10.0 ** (-i / 2) for i in range(1, 11)), ("profiles", "seed")),
        Failing("below", "stiffness, rms over profiles", "many more springs on the same profile", 0.05),
        "1 / (√6 tolerance): the length of one contact is rounded to whole springs",
        lambda tolerance, _: 1 / (math.sqrt(6) * tolerance),
        Judged(2.5, derived=True, warned=True),
    ),
    Limit(
        LimitName("velocity Verlet", "long time step", "ω_eigen dt"),
        Probe(limits.time_steps, (1.5, 1.9, 1.99, 2.01, 2.1, 2.5, 3.0), settings=VERLET),
        Failing("above", "growth in one step, less one", "the bounded motion", 1e-3),
        "|λ| = 1 up to ω dt = 2, exp(2 arccosh(ω dt / 2)) above",
        2.0,
        Judged(1.01, derived=True, warned=True),
    ),
    Limit(
        LimitName("explicit Euler", "energy gained", "ω_eigen dt"),
        Probe(limits.time_steps, (0.004, 0.006, 0.009, 0.013, 0.018, 0.03, 0.1, 0.5, 1.5, 2.1), settings=EULER),
        Failing("above", "energy gained in one period", "the initial energy", 0.1),
        "ω dt = ln(1 + tolerance) / 2π: each step multiplies the energy by 1 + (ω dt)²",
        lambda tolerance, _: math.log1p(tolerance) / (2 * math.pi),
        Judged(1.5, derived=True),
    ),
    Limit(
        LimitName("Runge-Kutta", "energy lost", "ω_eigen dt"),
        Probe(limits.time_steps, (0.3, 0.6, 0.9, 1.1, 1.4, 2.0, 2.6, 2.9), settings=KUTTA),
        Failing("above", "energy lost in one period", "the initial energy", 0.1),
        "(ω dt)⁵ = -72 ln(1 - tolerance) / 2π: each step multiplies the energy by 1 - (ω dt)⁶ / 72",
        lambda tolerance, _: (-72 * math.log1p(-tolerance) / (2 * math.pi)) ** 0.2,
        Judged(1.25, derived=True),
    ),
    Limit(
        LimitName("linear contact", "lift-off", "height h_rms / d_N"),
        Probe(limits.higher_tracks, (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0, 1.3, 1.8), ("wheels", "seed")),
        Failing("above", "share of the time in the air", "one-sided springs, dynamic", 1e-4),
        "the largest tension of (14.11) reaches the load, on one of the tracks",
        lambda _, pulls_from: pulls_from,
        Judged(1 + MARGINS["lift-off"].tolerance),
    ),
)
HALF_SPACE = (
    Limit(
        LimitName("boundary elements", "waves of few cells", "cells to the shortest wave"),
        Probe(limits.rough_grids, (12, 18, 24, 32, 48, 64, 96, 128), ("resolved", "seed")),
        Failing("below", "contact area, rms over surfaces", "64 cells to the shortest wave", 0.1),
        "4 cells: the edge of the contact is made of cells; its error, 0.4 / cells, is measured",
        4.0,
        Judged(1.5, warned=True),
    ),
    Limit(
        LimitName("boundary elements", "contact of few cells", "cells in the contact, π (a/dx)²"),
        Probe(limits.few_cells, (0.5, 0.8, 1.2, 1.5, 1.8, 2.1, 2.4, 3.4, 4.8, 6.8, 9.6)),
        Failing("below", "stiffness, rms over places", "Hertz, k = 2 E* a", 0.05),
        "0.3 / √cells = tolerance: the error of a flat punch, an upper bound",
        lambda tolerance, _: (0.3 / tolerance) ** 2,
        Judged(4.0, warned=True),
    ),
    Limit(
        LimitName("boundary elements, periodic", "images, no padding", "period L / a"),
        Probe(limits.images, (4, 8, 16, 24, 32, 40, 64)),
        Failing("below", "approach under a force", "free space, the same cells", 0.05),
        "1.655 a / L = tolerance: 3.9003 F / (π E* L) of all images and the mean plane",
        lambda tolerance, _: limits.LATTICE * limits.HERTZ / math.pi / tolerance,
        Judged(1.25, derived=True),
    ),
    Limit(
        LimitName("boundary elements", "edge of the grid", "side of the grid / 2 a"),
        Probe(limits.grid_sides, SIDES),
        Failing("below", "force at an approach", "the same cells on a wider grid", 1e-3),
        "side = 2 a: beyond the edge there is no pressure",
        1.0,
        Judged(1.2, derived=True, warned=True),
    ),
    Limit(
        LimitName("boundary elements, rolling", "narrow strip", "width of the strip / 2 a"),
        Probe(limits.strip_widths, SIDES),
        Failing("below", "force at an approach", "the same cells on a wider strip", 0.01),
        "width = 2 a: the contact must end within the strip",
        1.0,
        Judged(1.2, derived=True, warned=True),
    ),
    Limit(
        LimitName("boundary elements, approach", "full contact by approach", "mean pressure / p*"),
        Probe(limits.full_contact, (0.5, 0.8, 0.9, 0.98, 0.995, 0.999, 1.0, 1.01, 1.1, 1.5)),
        Failing("above", "mean pressure at an approach", "the pressure that has this approach", 0.01),
        "p* = π E* h / λ: in full contact the approach is the mean gap at any pressure",
        1.0,
        Judged(1.002, derived=True, warned=True),
    ),
    Limit(
        LimitName("boundary elements, force", "huge force, full contact", "mean pressure / p*"),
        Probe(limits.huge_forces, tuple(2 * 10.0**i for i in range(17))),
        Failing("above", "waves of the pressure / p*", "p* cos(2π x / λ)", 1e-5),
        "tolerance / ε, the rounding unit: the waves are lost in the digits of the uniform pressure",
        lambda tolerance, _: tolerance / np.finfo(float).eps,
        Judged(30.0, derived=True, warned=True),
    ),
    Limit(
        LimitName("boundary elements", "one bad cell", "height of the spike / d"),
        Probe(limits.spikes, (0.01, 0.03, 0.1, 0.3, 1.0, 2.0, 4.0, 7.0, 10.0, 15.0, 30.0, 100.0, 1e3)),
        Failing("above", "force at an approach", "the sphere without the bad cell", 0.1),
        "0.891 E* dx H = F: by Love's formula the bad cell alone carries the force of the sphere",
        lambda _, one_cell: limits.HERTZ * one_cell,
        Judged(2.0, warned=True),
    ),
)
LIMITS = SPRINGS + HALF_SPACE


@dataclass(frozen=True, eq=False)
class Sweep:
    """A limit, swept: values of its parameter, ascending; the error at each, infinite where there is no answer; the
    threshold by its condition; the message of the software at each value, empty where it gives none.
    """

    limit: Limit
    values: FloatArray
    error: FloatArray
    predicted_threshold: float
    messages: tuple[str, ...]

    @classmethod
    def of(cls, limit: Limit, outcome: Outcome) -> "Sweep":
        """By the outcome of its probe."""
        part, at = limit.probe.part, limit.threshold
        threshold = at(limit.fails.tolerance, float(outcome["measured"][part])) if callable(at) else at
        return cls(limit, outcome["values"], outcome["error"][part], threshold, tuple(map(str, outcome["messages"])))

    @property
    def sign(self) -> int:
        return 1 if self.limit.fails.side == "above" else -1

    @property
    def past_threshold(self) -> NDArray[np.bool_]:
        """Values on the failing side, further from the threshold than the factor."""
        return np.asarray((self.values / self.predicted_threshold) ** self.sign > self.limit.judged.factor)

    @property
    def before_threshold(self) -> NDArray[np.bool_]:
        """Values on the other side, further from the threshold than the factor."""
        return np.asarray((self.predicted_threshold / self.values) ** self.sign > self.limit.judged.factor)

    @property
    def warned(self) -> NDArray[np.bool_]:
        return np.array([bool(message) for message in self.messages])

    @property
    def predicted(self) -> bool:
        """Whether the error exceeds its tolerance everywhere past the threshold, and nowhere before it."""
        fails = self.error > self.limit.fails.tolerance
        good, failed = fails[self.before_threshold], fails[self.past_threshold]
        return bool(good.size and failed.size and failed.all() and not good.any())

    @property
    def share_of_correct_warnings(self) -> float:
        """Of the values past the threshold and before it: where a message was given, and where there was none."""
        return float(np.concatenate([self.warned[self.past_threshold], ~self.warned[self.before_threshold]]).mean())

    @property
    def crossing(self) -> tuple[float, float] | None:
        """Where the error passes its tolerance, on a logarithmic scale, and half of the step it lies in, in octaves.

        From the good side on, for the last time; None where it does not.
        """
        values, error = np.log2(self.values[:: self.sign]), self.error[:: self.sign]
        tolerance = self.limit.fails.tolerance
        good = np.flatnonzero(error <= tolerance)
        if not good.size or good[-1] == error.size - 1:
            return None
        last = slice(int(good[-1]), int(good[-1]) + 2)
        (x, y), (low, high) = values[last], np.maximum(error[last], 1e-3 * tolerance)
        part = math.log(tolerance / low) / math.log(high / low) if math.isfinite(high) else 0.5
        return float(2 ** (x + part * (y - x))), abs(float(y - x)) / 2

    @property
    def first_message(self) -> str:
        """The message nearest to the threshold on its failing side, empty where there is none."""
        past_messages = [m for m, past in zip(self.messages, self.past_threshold, strict=True) if m and past]
        return past_messages[:: self.sign][0] if past_messages else ""
