"""A model of a rough interface of others, as those of the core: area, gap and stiffness beside boundary elements."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import erfinv

from validation.analysis.quantity import Quantity
from validation.analysis.statistics import FloatArray
from validation.judging.judgement import Conditions
from validation.judging.kinds.judge import Finding, LostError, attempted, compared, rule
from validation.judging.kinds.references import Reference, about, reference_rows
from validation.judging.kinds.stiffness import HEIGHT, MODULUS, ROLL_OFF, SIDE, H, JudgedPunch, PlateauRoughness
from validation.judging.registry import Caller, Failed
from validation.simulation.track_spectrum import PiecewisePowerLaw

CONTACT = "contact in Persson's theory [%]"
AREA, GAP, STIFFNESS = (
    Quantity(f"{name}_of_an_interface", f"{name.replace('_', ' ')} of an interface")
    for name in ("contact_area", "mean_gap", "stiffness")
)
METHODS = {"area_fraction": AREA, "mean_gap": GAP, "stiffness": STIFFNESS}
"""Of an interface model of the core: the quantities of their references."""
LOADS, EXACT, STEP, OF_SLOPE = (1.0, 10.0), 1e-6, 0.01, 0.02
"""Contact in Persson's theory at which rules are asked [%]; tolerances; relative step of the pressure."""


@dataclass(frozen=True)
class OfferedInterface:
    """An offered function as a model of the core, of one roughness: a name and the methods of `METHODS`.

    A method raises LostError, which is a ValueError, where the function has no answer.
    """

    caller: Caller
    roughness: PlateauRoughness
    modulus: float

    @property
    def name(self) -> str:
        return self.caller.name

    def answers(self, method: str, pressures: Sequence[float]) -> list[float | Failed]:
        """A number at each pressure, or why there is none."""
        arguments = {"modulus": self.modulus, "roughness": replace(self.roughness), "quantity": method}
        answers = self.caller.calls("pressure", list(pressures), arguments)
        return [answer if isinstance(answer, Failed) else float(answer) for answer in answers]

    def area_fraction(self, pressure: ArrayLike) -> FloatArray:
        """True contact area over the nominal area."""
        return self._values("area_fraction", pressure)

    def mean_gap(self, pressure: ArrayLike) -> FloatArray:
        """u [m]."""
        return self._values("mean_gap", pressure)

    def stiffness(self, pressure: ArrayLike) -> FloatArray:
        """K = -dp/du [Pa/m]."""
        return self._values("stiffness", pressure)

    def _values(self, method: str, pressure: ArrayLike) -> FloatArray:
        answers = self.answers(method, np.ravel(pressure).tolist())
        if lost := next((answer for answer in answers if isinstance(answer, Failed)), None):
            raise LostError(lost)
        return np.array(answers, dtype=np.float64).reshape(np.shape(pressure))


@dataclass(frozen=True)
class JudgedInterface:
    """One roughness: waves of the roll-off on a period, and H; of the band, height and length of the references."""

    roll_off: int
    hurst: float

    @property
    def band(self) -> int:
        return int(about(STIFFNESS)["settings"]["band"])

    @property
    def roughness(self) -> PlateauRoughness:
        """What a function is given, in SI units."""
        rough = JudgedPunch(self.hurst, 1.0, self.band * self.roll_off, self.roll_off).arguments["roughness"]
        assert isinstance(rough, PlateauRoughness)  # of a punch with a roll-off
        return rough

    def pressure(self, per_cent: float) -> float:
        """p [Pa] of a contact in Persson's theory, erf(sqrt(2) p / (E* g)), g the rms gradient."""
        edges = tuple(2 * math.pi * waves for waves in (1, self.roll_off, self.band * self.roll_off))
        gradient = HEIGHT * PiecewisePowerLaw(edges=edges, exponents=(0.0, 2 * self.hurst + 2)).gradient
        return float(MODULUS * gradient * erfinv(per_cent / 100) / math.sqrt(2))

    def unit(self, method: str, pressure: float) -> float:
        """By which an answer is divided: the references are A / L^2, u / h and K h / p."""
        h = HEIGHT * SIDE
        return {"area_fraction": 1.0, "mean_gap": h, "stiffness": pressure / h}[method]


def judged(model: Caller) -> Iterator[Finding]:
    """Each quantity under each load on each roughness, then scaling, and the stiffness as the slope of the gap."""
    for method, quantity in METHODS.items():
        rows = reference_rows(quantity)
        for ground in dict.fromkeys(_ground_of(row) for row in rows):
            yield from _beside(model, method, ground, [row for row in rows if _ground_of(row) == ground])
    first = _ground_of(reference_rows(STIFFNESS)[0])
    offered = OfferedInterface(model, first.roughness, MODULUS)
    for per_cent in LOADS:
        where, p = {H: first.hurst, CONTACT: per_cent}, first.pressure(per_cent)
        for method in METHODS:
            yield from _scaling(offered, method, where, p)
        slope = attempted(_slope, offered, p)
        if not (isinstance(slope, Failed) and slope.refused):
            yield rule("stiffness over the slope of the gap", where, slope, within=OF_SLOPE)


def _ground_of(row: Reference) -> JudgedInterface:
    return JudgedInterface(round(row[ROLL_OFF]), row[H])


def _beside(model: Caller, method: str, ground: JudgedInterface, rows: Sequence[Reference]) -> Iterator[Finding]:
    pressures = [ground.pressure(row[CONTACT]) for row in rows]
    answers = OfferedInterface(model, ground.roughness, MODULUS).answers(method, pressures)
    return compared(
        rows,
        [
            answer if isinstance(answer, Failed) else answer / ground.unit(method, p)
            for answer, p in zip(answers, pressures, strict=True)
        ],
    )


def _scaling(offered: OfferedInterface, method: str, where: Conditions, p: float) -> Iterator[Finding]:
    """Three times p and E*: A and u stay, K goes as E*. All lengths: A stays, u goes as they, K as one over them."""
    ground = offered.roughness
    longer = {name: getattr(ground, name) / 3 for name in ("q_min", "q_max", "q_roll_off")}
    others = {
        "modulus": (replace(offered, modulus=3 * offered.modulus), 3 * p, {"stiffness": 3.0}),
        "length": (
            replace(offered, roughness=replace(ground, rms=3 * ground.rms, **longer)),
            p,
            {"mean_gap": 3.0, "stiffness": 1 / 3},
        ),
    }
    before = attempted(getattr(offered, method), p)
    if isinstance(before, Failed) and before.refused:
        return
    for name, (other, pressure, factors) in others.items():
        after = before if isinstance(before, Failed) else attempted(getattr(other, method), pressure)
        lost = after if isinstance(after, Failed) else None
        ratio = lost or _ratio(float(after), factors.get(method, 1.0) * float(before))  # type: ignore[arg-type]
        yield rule(f"{METHODS[method]}: scaling with the {name}", where, ratio, within=EXACT)


def _slope(offered: OfferedInterface, p: float) -> float:
    """K over -dp/du, by a difference over 2 % of the pressure."""
    lower, upper = (float(offered.mean_gap(factor * p)) for factor in (1 - STEP, 1 + STEP))
    return _ratio(float(offered.stiffness(p)) * (lower - upper), 2 * STEP * p)


def _ratio(value: float, expected: float) -> float:
    return value / expected if expected else math.inf
