"""A dynamic wheel on the charts: the spectrum of its acceleration in one-third octaves."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from validation.analysis.spectra import band_levels, one_third_octaves, record_spectra
from validation.benchmarks.timing import Configuration, NamedMethod
from validation.benchmarks.work_precision.problem import (
    ChartProblem,
    CountedSpectrum,
    Found,
    Grids,
    Quantity,
    along_a_track,
    linear_power,
    log_power,
)
from validation.engine.engine import FloatArray
from validation.scenes.dynamic_wheel import WheelScene, load_wheel_scene
from validation.scenes.wheel_body import Wheel
from validation.simulation.contact_laws import BoundaryElementsLaw, LinearLaw, SpringsLaw
from validation.simulation.method import Prepared, Resolution, Result, Solve
from validation.simulation.motion import periodic_motion, simulate, simulate_from_linear_motion
from validation.simulation.track_spectrum import InputSpectrum
from validation.simulation.wheel_on_half_space import WheelStrip, crop_to_reach, linear_law_3d
from validation.simulation.wheel_on_springs import STEADY_TOLERANCE, WheelEnsemble, linear_law_1d
from validation.theory import rolling as rolling_theory
from validation.theory import wheel as wheel_theory

TABLE = load_wheel_scene("table_14_1")
SCENE = replace(TABLE, rail=replace(TABLE.rail, shortest=0.8e-3)) if TABLE.rail else TABLE
WARM = 40
"""Places before the clock runs: frames that find their size, plans."""
GRIDS = Grids(cells=(6, 12), fixed=6, tolerances=(1e-2, 1e-3), per="to a radius")


@dataclass(frozen=True, kw_only=True)
class WheelProblem(ChartProblem):
    """Wheels of a scene over isotropic surfaces, in one round of a track.

    wheel_scene: whose rail alone is rough; turns: whole, of the resonance, to which a half is added; width: of
    surfaces over the longest wave; realisations: of strips; wheels: on springs, in a batch; filtered: cells for the
    linear filter; shared: of which all cells are multiples; springs: to a contact radius; seed: zero or positive.
    No models are found: these values are those of a periodic strip.
    """

    name: ClassVar = "dynamic wheel"
    # between twice the resonance and the shortest wave
    quantities: ClassVar = (
        Quantity(name="acceleration spectrum", log=partial(log_power, name="level"), needs=("level",), decibel=True),
    )
    wheel_scene: WheelScene = field(default=SCENE)
    turns: int = 0
    width: int = 2
    realisations: int = 3
    wheels: int = 20
    grids: Grids = GRIDS
    filtered: tuple[int, ...] = (6, 12)
    shared: int = 3
    springs: tuple[int, ...] = (12, 25)
    seed: int = 152

    def strip(self, realisation: int, cells: int, tolerance: float) -> WheelStrip:
        """The same surface on every grid."""
        own = {"natural_periods": self.turns, "width": self.width, "shared": self.shared, "seed": self.seed}
        return WheelStrip(scene=self.wheel_scene, realisation=realisation, cells=cells, tolerance=tolerance, **own)

    @property
    def duration(self) -> float:
        """Of a record on boundary elements [s]."""
        strip = self.strip(0, self.shared, self.grids.tight)
        return strip.shape[0] * strip.spacing / self.wheel_scene.speed

    @property
    def edges(self) -> FloatArray:
        """One-third octaves that hold two lines of a record and end where the roughness does [rad/s]."""
        lines = 2 * 2 * math.pi / self.duration / (2 ** (1 / 3) - 1)
        return one_third_octaves(max(2 * self.wheel_scene.eigenfrequency, lines), self.wheel_scene.cutoff)

    def levels(self, acceleration: FloatArray, time_step: float) -> FloatArray:
        """int A df in each band, with Hann's window, one row a wheel."""
        record = record_spectra(acceleration, time_step=time_step, window="hann")
        return band_levels(record.omega, record.density, self.edges).T

    def configurations(self) -> tuple[Configuration, ...]:
        springs, strips = (wheels_on_springs, _filtered, _on_springs), (wheel_on_strips, _filter_strip)
        return along_a_track(self, linear_spectrum, springs, strips)

    @property
    def method(self) -> NamedMethod:
        return NamedMethod("BEM", wheel_on_strips, (_in_time_loop,))


StripRunner = Callable[[WheelStrip, FloatArray, LinearLaw, float], Callable[[], Found]]
"""Of a strip, its surface, the linear contact on it and a time step."""


def transfer(wheel: Wheel, omega: NDArray[np.floating], time_step: float) -> FloatArray:
    """z'' over dF in leapfrog steps, -s^2 / (k - M s^2), s = 2 sin(omega dt / 2) / dt; see `LinearLaw.steady_state`."""
    square = (2 * np.sin(omega * time_step / 2) / time_step) ** 2
    return np.asarray(-square / (wheel.stiffness - wheel.mass * square))


def steady_acceleration(linear: LinearLaw, time_step: float) -> FloatArray:
    """z'' of the motion on a linear contact that repeats itself, by one filter, shape (places, wheels)."""
    count = len(linear.change)
    omega = 2 * np.pi * np.fft.rfftfreq(count, time_step)[:, np.newaxis]
    return np.fft.irfft(transfer(linear.wheel, omega, time_step) * np.fft.rfft(linear.change, axis=0), count, axis=0)


def mean_levels(scene: WheelProblem, surface: FloatArray, spacing: float, time_step: float) -> FloatArray:
    """Levels of the linear wheel in the mean over all phases of the waves of this surface.

    Hann's window mixes a line with its neighbours: 2/3 of itself, 1/6 of each.
    """
    wheel = scene.wheel_scene.body
    q, force = linear_power(surface, spacing, contact_radius=wheel.contact_radius, modulus=wheel.modulus)
    omega = q * scene.wheel_scene.speed
    density = transfer(wheel, omega, time_step) ** 2 * force * q.size * time_step
    mixed = 2 / 3 * density + (np.roll(density, 1) + np.roll(density, -1)) / 6
    along = slice(1, q.size // 2)
    return band_levels(omega[along], mixed[along], scene.edges)


def linear_spectrum(scene: WheelProblem, resolution: Resolution) -> Prepared:
    """Linear theory in closed form at the lines of a record."""
    wheel, speed = scene.wheel_scene.body, scene.wheel_scene.speed
    rough = scene.strip(0, scene.shared, scene.grids.tight).roughness
    line = 2 * math.pi / scene.duration
    omega = line * np.arange(1, math.ceil(scene.edges[-1] / line) + 1)
    c2d = CountedSpectrum(rough.spectrum.c2d)
    body = {"contact_radius": wheel.contact_radius, "modulus": wheel.modulus}

    def solve() -> FloatArray:
        c2d.nodes = 0
        force = rolling_theory.force_spectrum_3d(omega / speed, c2d, edges=(rough.q_min, rough.q_max), **body)
        dynamic = wheel_theory.acceleration_over_force(omega, eigenfrequency=wheel.eigenfrequency, mass=wheel.mass)
        return np.asarray(dynamic * wheel_theory.over_frequency(force, speed=speed))

    def read(density: FloatArray) -> Result:
        return Result({"level": band_levels(omega, density, scene.edges)}, c2d.nodes)

    return lambda _: Solve(solve, read)


class CountedSprings(SpringsLaw):
    """Springs that count how many of them they examine, one by one, for a wheel at each time."""

    def __init__(self, *track: Any):
        super().__init__(*track)
        self.examined: list[float] = []
        self.work = 0.0

    def force(self, place: int, approach: FloatArray) -> FloatArray:
        found = super().force(place, approach)
        self.examined.append(self.foundation.examined)
        # a prefix sum costs as much as two springs
        self.work += (self.foundation.examined + 2) * approach.size
        return found


Runner = Callable[[WheelEnsemble, FloatArray], Found]
"""Of wheels and the heights under them."""


def wheels_on_springs(
    scene: WheelProblem, resolution: Resolution, spectrum: InputSpectrum, simulated: Runner
) -> Prepared:
    """Batched, in the periodic motion; or the filter (14.11) under them."""
    distance = scene.duration * scene.wheel_scene.speed
    on = replace(scene.wheel_scene, distance=distance, springs=round(resolution.size))
    count = scene.wheels
    rides = WheelEnsemble(scene=on, count=count, track="steady-state", input_spectrum=spectrum, seed=scene.seed)

    def read(found: Found) -> Result:
        return Result({"level": scene.levels(found[0], on.time_step)}, found[1], count)

    run = partial(simulated, rides, rides.heights())
    return lambda _: Solve(run, read)


def _filtered(rides: WheelEnsemble, heights: FloatArray) -> Found:
    linear = linear_law_1d(rides.scene.body, heights, rides.scene.spacing)
    return steady_acceleration(linear, rides.scene.time_step), float(heights.size)


def _on_springs(rides: WheelEnsemble, heights: FloatArray) -> Found:
    scene, wheel, laws = rides.scene, rides.scene.body, []
    settings: dict[str, Any] = {"time_step": scene.time_step, "steps": rides.steps}

    def law(copies: int) -> CountedSprings:
        laws.append(CountedSprings(wheel, np.tile(heights, (1, copies)), scene.spacing))
        return laws[-1]

    first = law(1)
    start = first.at_rest(0), np.zeros(rides.count)
    approach, velocity, left = periodic_motion(wheel, law, **settings, start=start)
    if (left > STEADY_TOLERANCE).any():
        raise RuntimeError(f"{np.count_nonzero(left > STEADY_TOLERANCE)} wheels do not repeat their motion")
    motion = simulate(wheel, first, **settings, approach=approach, velocity=velocity)
    return motion.acceleration, float(sum(each.work for each in laws))


def wheel_on_strips(scene: WheelProblem, resolution: Resolution, simulated: StripRunner) -> Prepared:
    """Beside that of linear theory on each surface, and its mean over all phases of these waves.

    Raises ValueError for waves that cells do not resolve.
    """
    cells = round(resolution.size)

    def draw(realisation: int) -> Solve:
        strip = scene.strip(realisation, cells, resolution.residual)
        surface, time_step = strip.surface(), strip.spacing / scene.wheel_scene.speed
        linear = linear_law_3d(strip.scene.body, surface, strip.spacing)

        def level(acceleration: FloatArray) -> FloatArray:
            return np.asarray(scene.levels(acceleration, time_step)[0])

        known = {"linear level": level(steady_acceleration(linear, time_step))}
        known |= {"mean level": mean_levels(scene, surface, strip.spacing, time_step)}
        run = simulated(strip, surface, linear, time_step)
        return Solve(run, lambda found: Result({"level": level(found[0]), **known}, found[1]))

    draw(0)
    return draw


def _filter_strip(strip: WheelStrip, surface: FloatArray, _: LinearLaw, time_step: float) -> Callable[[], Found]:
    """Force and wheel by their responses."""
    wheel, work = strip.scene.body, float(surface.size)
    return lambda: (steady_acceleration(linear_law_3d(wheel, surface, strip.spacing), time_step), work)


def _in_time_loop(strip: WheelStrip, surface: FloatArray, linear: LinearLaw, time_step: float) -> Callable[[], Found]:
    """Boundary elements at each time step, each contact from the two before."""
    wheel = strip.scene.body
    height = crop_to_reach(surface, strip.spacing, wheel)
    contact = BoundaryElementsLaw(wheel, [height], strip.spacing, tolerance=strip.tolerance)
    # frames and their plans belong to a strip: they are made over its beginning
    for place in range(min(WARM, len(height))):
        contact.force(place, np.array([wheel.approach]))

    def run() -> Found:
        contact.operator_applications = 0
        motion = simulate_from_linear_motion(contact, linear, time_step, len(height))
        return motion.acceleration, contact.operator_applications * (2.0 * strip.cells) ** 2

    return run
