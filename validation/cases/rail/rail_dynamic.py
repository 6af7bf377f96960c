"""A wheel with a mass on a rough rail: does the contact filter of constant load hold when the wheel moves?"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from validation.analysis.nominal_bands import NominalBands
from validation.analysis.spectra import Bands
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.scenes.level_files import curve
from validation.simulation.rail_ground import RailGround
from validation.simulation.rail_strip import RailStrip
from validation.simulation.wheel_on_rail import BEM, SPRINGS, WheelOnRail, roll_and_move
from validation.theory.elliptic_contact import EllipticContact, elliptic_contact
from validation.theory.line_spectrum import LineSpectrum

FloatArray = NDArray[np.float64]

MODELS = (BEM, SPRINGS)
FINE, COARSE = "fine", "coarse"
Key = tuple[float, str, str]
"""Offset of the levels, model, grid."""


@dataclass(frozen=True, kw_only=True)
class RailDynamic:
    """Wheels of a mass over isotropic rails of a level curve, and the same contacts at constant load.

    curve: of a line; offsets: of its levels [dB]; radii: along and across [m]; load [N]; modulus: E* [Pa]; mass [kg];
    speed [m/s]; longest, shortest: nominal wavelengths of the bands [m]; periods: whole natural periods of a strip,
    before a half, so that no wave has the resonance; width: of the strips over the longest wave; cells, coarse: to the
    semi-axis along; strips; compared: of them on the coarse grid too; tolerance: of each contact.
    """

    curve: str = "iso3095-2013"
    offsets: tuple[float, ...] = (0.0, 10.0)
    radii: tuple[float, float] = (0.46, 0.3)
    load: float = 5e4
    modulus: float = 210e9 / (2 * (1 - 0.3**2))
    mass: float = 500.0
    speed: float = 80 / 3.6
    longest: float = 0.125
    shortest: float = 0.005
    periods: int = 6
    width: float = 1.0
    cells: int = 6
    coarse: int = 5
    strips: int = 7
    compared: int = 2
    tolerance: float = 1e-4
    seed: int = 20

    def __post_init__(self) -> None:
        try:
            Bands(tuple(self.bands.edges.tolist())).on(self.length)
        except ValueError:
            raise ValueError(
                f"periods must be so many that each band of the track has a wave, got {self.periods}, which are "
                f"{self.length:.3g} m, for waves of up to {self.longest:g} m"
            ) from None

    @cached_property
    def contact(self) -> EllipticContact:
        """At rest on the smooth rail."""
        return elliptic_contact(self.radii, modulus=self.modulus, force=self.load)

    @cached_property
    def bands(self) -> NominalBands:
        return NominalBands().within(self.longest, self.shortest)

    @property
    def frequencies(self) -> FloatArray:
        """f = v / lambda of the bands [Hz]."""
        return np.asarray(self.speed / self.bands.wavelengths)

    @property
    def resonance(self) -> float:
        """sqrt(k / M) / 2 pi [Hz]."""
        return math.sqrt(self.contact.stiffness / self.mass) / (2 * math.pi)

    @property
    def length(self) -> float:
        """Of a track [m]: whole semi-axes, about `periods` of the resonance and a half."""
        unit = self.contact.along
        return unit * round((self.periods + 0.5) * self.speed / self.resonance / unit)

    def problem(self, key: Key, realisation: int) -> WheelOnRail:
        offset, model, grid = key
        unit, cells = self.contact.along, self.cells if grid == FINE else self.coarse
        q, density = curve(self.curve).raised(offset).nodes
        first, last = float(self.bands.edges[0]), float(self.bands.edges[-1])
        strip = RailStrip(
            ground=RailGround(line=LineSpectrum(tuple(q), tuple(density)), across="isotropic", first=first, last=last),
            radii=self.radii,
            force=self.load,
            modulus=self.modulus,
            length=self.length,
            width=unit * round(self.width * self.longest / unit),
            spacing=unit / cells,
            realisation=realisation,
            seed=self.seed,
        )
        return WheelOnRail(strip=strip, mass=self.mass, speed=self.speed, model=model, tolerance=self.tolerance)

    @property
    def keys(self) -> dict[Key, int]:
        """How many strips of each."""
        counts = {FINE: self.strips, COARSE: self.compared}
        return {(offset, model, grid): n for offset in self.offsets for model in MODELS for grid, n in counts.items()}


@dataclass(frozen=True)
class RailDynamicResult:
    """Outcomes of the strips, by offset, model and grid."""

    case: RailDynamic
    outcomes: dict[Key, list[Outcome]]

    def powers(self, key: Key, name: str) -> FloatArray:
        """Mean square in each band of what lifts the wheel, (strips, bands), through Hann's window.

        name: "constant", "moving", "linear" or "line"; or "inferred", the force over the linear dynamic stiffness.
        Free vibration does not end where it began: without a window it would leak.
        """
        spacing = self.case.problem(key, 0).strip.spacing
        tracks = [self._track(key, outcome, name) for outcome in self.outcomes[key]]
        return np.array([self.case.bands.powers_of_track(track, spacing=spacing) for track in tracks])

    def _track(self, key: Key, outcome: Outcome, name: str) -> FloatArray:
        values = outcome["force" if name == "inferred" else name]
        seen = hann(values.size) * (values - values.mean())
        return over_dynamic_stiffness(self.case.problem(key, 0), seen) if name == "inferred" else seen


def over_dynamic_stiffness(problem: WheelOnRail, force: FloatArray) -> FloatArray:
    """F (1 / k - 1 / (M omega^2)), omega that of leapfrog: what lifts a wheel on a linear contact."""
    dt = problem.time_step
    stepped = (2 * np.sin(math.pi * np.fft.rfftfreq(force.size, dt)[1:] * dt) / dt) ** 2
    waves = np.fft.rfft(force)
    waves[0] = 0.0
    waves[1:] *= 1 / problem.wheel.stiffness - 1 / (problem.mass * stepped)
    return np.fft.irfft(waves, force.size)


def hann(points: int) -> FloatArray:
    """Hann's window, of mean square one."""
    return np.asarray(np.sin(np.pi * (np.arange(points) + 0.5) / points) ** 2 * math.sqrt(8 / 3))


def run(case: RailDynamic, engine: Engine = SERIAL) -> RailDynamicResult:
    """All strips, on both grids. Raises NotConvergedError where one is lost: the models are compared strip by strip."""
    problems = {key: [case.problem(key, i) for i in range(count)] for key, count in case.keys.items()}
    outcomes = engine.map_groups(roll_and_move, problems)
    failed = {key: sum(bool(one["failed"]) for one in some) for key, some in outcomes.items()}
    if lost := [f"{key[1]} at +{key[0]:g} dB, {key[2]} grid: {n} strips" for key, n in failed.items() if n]:
        raise NotConvergedError("models are compared strip by strip, and some are lost", lost)
    return RailDynamicResult(case, outcomes)
