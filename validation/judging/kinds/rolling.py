"""A wheel that rolls, of others, beside boundary elements: spectrum of its force, each position, and contact filter.

A force is relative to that of Hertz, a filter is judged by A3 of five wheels on a rail over each lateral structure;
wheels and roughness beside those of the table are in `held_out_points`.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from itertools import groupby
from typing import Any

import numpy as np

import mdr
from validation.analysis.quantity import MEAN_FORCE, RMS_FORCE, Quantity
from validation.analysis.series import Estimates
from validation.analysis.spectra import Bands, assessed_bands, levels, waves
from validation.analysis.statistics import POWER_DECIBEL, Estimate, FloatArray, mean_estimate
from validation.judging.judgement import LEVEL as DECIBELS
from validation.judging.judgement import RATIO, Conditions
from validation.judging.kinds.judge import Finding, ModelAnswer, answer_of, attempted, compared, rule
from validation.judging.kinds.references import Reference, about, reference_rows
from validation.judging.registry import Caller, Failed
from validation.railway.problems.rail_strip import line_of, strip_bands, structure_of
from validation.railway.scenes.level_files import curve as levels_of
from validation.railway.scenes.rail import RailScene
from validation.railway.theory.contact_filters import half_space_filter
from validation.simulation.rolling_strip import HERTZ, SMOOTH, RoughStrip, crop_to_reach, level_3d, over_bands
from validation.simulation.track_spectrum import PiecewisePowerLaw, self_affine
from validation.theory.rolling import force_variance, linear_force

LEVEL, RMS, MEAN = Quantity("force_level"), RMS_FORCE, MEAN_FORCE
HEIGHT, SLOPE, Q = "h/d", "h' a/d", "q a"
RADIUS, CONTACT, MODULUS = 0.5, 2e-3, 1.15e11
APPROACH = CONTACT**2 / RADIUS
FORCE = 4 / 3 * MODULUS * CONTACT * APPROACH
FINE = 800
"""Of the midpoint rule from zero to the end of the roughness."""
NOTHING = 1e-30
"""Power, or a share of it, that has a logarithm; less than nothing is as nothing."""
EACH, LIFT = "force at a position", "approach at a position"
APART, OF_APART = "{}, position by position", "rms of the fluctuation, and that with the rms of the difference on top"
STRIPS, LENGTH, WIDTH, CELLS = 6, 64.0, 16.0, 16
"""On which levels are taken, as ratios to linear theory on the same strips."""
OF_STRIP = 0.7, 1.0, 10.0
"""H, first and last q a of the strips for each position."""
HEIGHTS, GRIDS, ALONG, ACROSS, SEED = (0.03, 0.1, 0.3), (8, 24), 32.0, 16.0, 351
"""Of the strips for each position: h/d; cells to a contact radius, an odd ratio, so that centres meet; sides over a."""


@dataclass(frozen=True)
class WheelAtApproach:
    """A wheel at a prescribed approach d = a^2 / R.

    radius: R [m]; contact: a, the contact radius of the smooth wheel [m]; modulus: E* [Pa].
    """

    radius: float = RADIUS
    contact: float = CONTACT
    modulus: float = MODULUS

    @property
    def approach(self) -> float:
        """d [m]."""
        return self.contact**2 / self.radius

    @property
    def force(self) -> float:
        """Of Hertz, 4/3 E* a d [N]."""
        return 4 / 3 * self.modulus * self.contact * self.approach

    @property
    def arguments(self) -> dict[str, float]:
        """Of a model, in SI units."""
        return {"radius": self.radius, "modulus": self.modulus, "approach": self.approach, "load": self.force}

    def __str__(self) -> str:
        return f"R = {self.radius:g} m, a = {1e3 * self.contact:g} mm, E* = {self.modulus / 1e9:g} GPa"


MAIN = WheelAtApproach()
"""That of the tables."""
SMOOTH_WHEEL = MAIN.arguments
Density = Callable[[FloatArray, WheelAtApproach, mdr.SelfAffine], FloatArray]
"""Two-sided C_F(q) of the force on a wheel over roughness [N^2 m]."""


def judged(model: Caller) -> Iterator[Finding]:
    """Findings of a model of the force on a wheel: its deviation at each position of short strips, by h/d.

    Of a model that takes the approach also octave levels, rms and mean of the force on the strips of the case.
    """
    for height in HEIGHTS:
        yield _position_by_position(model, height)
    if "approach" in model.asks:
        yield from _at_heights((LEVEL, RMS, MEAN), partial(_of_strips, model))


def judged_spectrum(model: Caller) -> Iterator[Finding]:
    """Octaves of the force along the track, and its variance."""
    return of_density(lambda q, wheel, ground: answer_of(model, **over(q, ground, wheel)))


def of_density(density: Density) -> Iterator[Finding]:
    return _at_heights((LEVEL, RMS), partial(_of_table, density))


def _at_heights(quantities: Sequence[str], find: Callable[[float], Iterable[ModelAnswer | float]]) -> Iterator[Finding]:
    """At each h/d of the case all that is known of each quantity, in the order of what is found."""
    for height in dict.fromkeys(row[HEIGHT] for row in reference_rows(LEVEL)):
        rows = reference_rows(*quantities, where={HEIGHT: height})
        table = [replace(row, where={n: place for n, place in row.where.items() if n != HEIGHT}) for row in rows]
        yield from compared(table, attempted(find, height))


def spectrum_of(settings: Mapping[str, Any]) -> PiecewisePowerLaw:
    """The roughness of the case, of unit height and contact radius."""
    return self_affine(settings["hurst"], settings["first"], settings["last"])


def about_roughness() -> str:
    """That of the levels, in words."""
    settings = about(LEVEL)["settings"]
    return f"H = {settings['hurst']:g}, q a = {settings['first']:g} to {settings['last']:g}"


def about_strip() -> str:
    """That of the strip for each position, in words."""
    (hurst, first, last) = OF_STRIP
    return f"roughness of H = {hurst:g}, q a = {first:g} to {last:g}"


def bands_of(settings: Mapping[str, Any]) -> Bands:
    return Bands.around(math.pi, settings["lowest"], settings["last"]).on(settings["length"])


def variance_of(spectrum: PiecewisePowerLaw) -> float:
    """Of linear theory, over F_Hertz^2 (h/d)^2; Geike's rule keeps it."""
    return force_variance(spectrum.c2d, edges=spectrum.edges, contact_radius=1.0, modulus=1.0) / HERTZ**2


def octave(thirds: FloatArray, bands: Bands, q: float) -> FloatArray:
    """Of levels in thirds of octaves, (..., bands), the octave about q."""
    i = int(np.argmin(np.abs(np.log(bands.centres / q))))
    return np.asarray(thirds[..., i - 1 : i + 2].sum(axis=-1))


def _octaves(thirds: FloatArray) -> FloatArray:
    """Those that are known."""
    bands = bands_of(about(LEVEL)["settings"])
    return np.stack([octave(thirds, bands, q) for q in dict.fromkeys(row[Q] for row in reference_rows(LEVEL))], axis=-1)


def ground_of(height: float) -> mdr.SelfAffine:
    """The roughness of the case, of rms height h/d."""
    settings = about(LEVEL)["settings"]
    first, last = settings["first"] / CONTACT, settings["last"] / CONTACT
    return mdr.SelfAffine(hurst=settings["hurst"], q_min=first, q_max=last, rms=height * APPROACH)


def over(q: FloatArray, ground: mdr.SelfAffine, wheel: WheelAtApproach = MAIN) -> dict[str, Any]:
    """What a spectrum may ask for; the roughness is a new object in each call."""
    return {"q": q, "roughness": replace(ground), "contact_radius": wheel.contact, **wheel.arguments}


def _of_table(density: Density, height: float) -> FloatArray:
    settings = about(LEVEL)["settings"]
    centres = list(dict.fromkeys(row[Q] for row in reference_rows(LEVEL)))
    ground = ground_of(height)
    return levels_of_density(lambda q: density(q, MAIN, ground), MAIN, height, settings, centres)


def levels_of_density(
    density: Callable[[FloatArray], FloatArray],
    wheel: WheelAtApproach,
    height: float,
    settings: Mapping[str, Any],
    centres: Sequence[float],
) -> FloatArray:
    """Octaves about these q a, and the variance, by quadrature [dB over F_Hertz^2 (h/d)^2]."""
    last, bands = settings["last"], bands_of(settings)

    def power(q: FloatArray) -> FloatArray:
        return density(q.ravel() / wheel.contact).reshape(q.shape) / wheel.contact / (wheel.force * height) ** 2

    thirds = over_bands(power, bands)
    variance = 2 * power((np.arange(FINE) + 0.5) * last / FINE).sum() * last / FINE
    octaves = [float(octave(thirds, bands, q)) for q in centres]
    return np.asarray(POWER_DECIBEL * np.log(np.maximum([*octaves, variance], NOTHING)))


def _of_strips(model: Caller, height: float) -> list[ModelAnswer]:
    """Octaves and variance over linear theory on the same strips, so that most of the scatter drops out; the mean."""
    settings, rows = about(LEVEL)["settings"], []
    spectrum, bands = spectrum_of(settings), bands_of(settings)
    for surface, linear in _strips():
        both = np.stack([_rolled_over_strip(model, height * surface, CELLS) / FORCE, height * linear])
        thirds = levels(waves(both, spacing=1 / CELLS), bands)
        rows.append(np.column_stack([_octaves(thirds), both.var(axis=1), both.mean(axis=1)]))
    of_model, of_linear = np.maximum(np.moveaxis(np.array(rows), 1, 0), NOTHING)
    # over (h/d)^2, as linear theory is
    exact = Estimates.exact(np.log([*_octaves(level_3d(spectrum, bands)), variance_of(spectrum)]))
    over = Estimates.ratios(of_model[:, :-1], of_linear[:, :-1]) + exact
    decibels = (Estimate(POWER_DECIBEL * log.value, POWER_DECIBEL * log.error, log.samples) for log in over)
    mean = ModelAnswer.of(mean_estimate(of_model[:, -1]), RATIO)
    return [*(ModelAnswer.of(level, DECIBELS) for level in decibels), mean]


@cache
def _strips() -> list[tuple[FloatArray, FloatArray]]:
    """Surfaces of unit height, over d, and what linear theory adds to the force of Hertz there."""
    settings = about(LEVEL)["settings"]
    unit = RoughStrip(spectrum=spectrum_of(settings), height=1.0, length=LENGTH, width=WIDTH, seed=settings["seed"])
    surfaces = [unit.surface(CELLS, realisation) for realisation in range(STRIPS)]
    return [(surface, linear_force(surface, spacing=1 / CELLS, **SMOOTH) / HERTZ - 1) for surface in surfaces]


def strip_of(height: float) -> RoughStrip:
    """For each position, of rms height h/d."""
    return RoughStrip(spectrum=self_affine(*OF_STRIP), height=height, length=ALONG, width=ACROSS, seed=SEED)


def _position_by_position(model: Caller, height: float) -> Finding:
    """On the strip of a height."""
    cells = GRIDS[1]
    answer = attempted(_rolled_over_strip, model, strip_of(height).surface(cells, 0), cells)
    where: Conditions = {HEIGHT: height}
    return position_by_position(model, reference_rows(_each(model), where=where), answer, MAIN, where)


def _each(model: Caller) -> str:
    return EACH if "approach" in model.asks else LIFT


def position_by_position(
    model: Caller,
    rows: Sequence[Reference],
    answer: FloatArray | Failed,
    wheel: WheelAtApproach,
    where: Conditions,
    of: str = "",
) -> Finding:
    """The rms of what boundary elements fluctuate beside the same with the rms of what is apart added.

    found: force [N] or approach [m] on the finer grid; of: what stands behind the name of the quantity.
    """
    unit, name = (wheel.force, "force") if "approach" in model.asks else (wheel.approach, "approach")
    values, grid = np.array([(row.value, row.value * row.grid) for row in rows]).T
    fluctuation = Reference(where, float(values.std()), quantity=APART.format(name) + of)
    if isinstance(answer, Failed):
        return Finding(fluctuation, answer)
    deviation = at_centres(answer) / unit - values
    value = fluctuation.value + math.sqrt(np.mean(deviation**2))
    left = math.sqrt(np.mean(grid**2)) / value
    return Finding(replace(fluctuation, grid=left), ModelAnswer(value, reason=OF_APART))


def at_centres(fine: FloatArray) -> FloatArray:
    """Of values along the finer grid those at the centres of the coarser one."""
    times = GRIDS[1] // GRIDS[0]
    return fine[times // 2 :: times]


def at_positions(where: Conditions, coarse: FloatArray, fine: FloatArray) -> Iterator[Reference]:
    """At each position of the coarse grid, extrapolated to zero cell size to first order, and as much is left."""
    finer = at_centres(fine)
    left = (finer - coarse) / (GRIDS[1] // GRIDS[0] - 1)
    for i, (value, change) in enumerate(zip((finer + left).tolist(), left.tolist(), strict=True)):
        yield Reference({**where, "x / a": (i + 0.5) / GRIDS[0]}, value, grid=abs(change / value))


def _rolled_over_strip(model: Caller, surface: FloatArray, cells: int) -> FloatArray:
    """What a model makes of a strip."""
    return answer_of(model, **on(surface, cells))


def on(surface: FloatArray, cells: int, wheel: WheelAtApproach = MAIN, lateral: int = 1) -> dict[str, Any]:
    """What it may ask for, of a strip in units of a and d, in metres; lateral: cells across to one along."""
    height, line = (
        wheel.approach * profile for profile in (crop_to_reach(surface, 1 / (lateral * cells)), middle_line(surface))
    )
    spacing = wheel.contact / cells, wheel.contact / (lateral * cells)
    return {"height": height, "line": line, "spacing": spacing, **wheel.arguments}


def middle_line(surface: FloatArray) -> FloatArray:
    """Of a periodic surface, along the middle of axis 1, which may lie between cells."""
    ny = surface.shape[1]
    turn = np.exp(2j * np.pi * np.fft.fftfreq(ny) * (ny - 1) / 2)
    return np.asarray((np.fft.fft(surface, axis=1) @ turn / ny).real)


Transfer = Callable[[FloatArray, FloatArray], FloatArray]
"""abs(H)(k_x, k_y)."""
FILTER, LONG = Quantity("contact_filter"), "contact filter of a long wave"
LOAD, DIAMETER, OFFSET, ALPHA, WAVE = "load [kN]", "diameter [mm]", "over ISO 3095 [dB]", "alpha", "wavelength [mm]"
STEEL = 210e9 / (2 * (1 - 0.3**2))
"""E* of steel on steel [Pa]."""
COUNTED = -15.0
"""dB of A3 of linear theory: shorter waves, from the first band below on, are no gate."""
LONG_WAVE = 1e-4
"""Its wavenumber times the semi-axis along."""


def judged_filter(model: Caller) -> Iterator[Finding]:
    """In one-third octaves from ridges to isotropic ground; boundary elements rolled over rougher rails too."""
    rows = reference_rows(FILTER)
    scene = scene_of(rows[0][LOAD], rows[0][DIAMETER])
    k_x = np.array([LONG_WAVE / scene.contact.along])
    long = attempted(lambda: float(np.abs(_transfer(model, scene, 1.0)(k_x, 0 * k_x)[0])))
    yield rule(LONG, {"k_x a_x": LONG_WAVE}, long, LONG_WAVE)
    for (load, diameter, offset, alpha), ground in groupby(rows, _ground):
        if math.isfinite(alpha) or answers_isotropic(model):
            yield from _over_ground(model, scene_of(load, diameter), offset, alpha, ground)


def answers_isotropic(model: Caller) -> bool:
    """A filter of the line that goes by alpha has no value for isotropic ground."""
    return "k_y" in model.asks or ALPHA not in model.asks


def _ground(row: Reference) -> tuple[float, ...]:
    return tuple(row[name] for name in (LOAD, DIAMETER, OFFSET, ALPHA))


def _over_ground(
    model: Caller, scene: RailScene, offset: float, alpha: float, rows: Iterator[Reference]
) -> Iterator[Finding]:
    """One ground, in the bands that count."""
    wheel = f"{scene.name}, {offset:+g} dB" if offset else scene.name
    bands = {wave: band for band, wave, _ in counted_bands(scene, alpha)}
    counted = [row for row in rows if row[WAVE] in bands]
    levels = attempted(in_bands, model, scene, alpha, [bands[row[WAVE]] for row in counted])
    ground = conditions_of(wheel, alpha)
    yield from compared([replace(row, where={**ground, WAVE: row[WAVE]}) for row in counted], levels)


def conditions_of(wheel: str, alpha: float) -> dict[str, float | str]:
    """Of a filter: the wheel, and what lies across."""
    return {"wheel": wheel, ALPHA: "isotropic" if math.isinf(alpha) else alpha}


def in_bands(model: Caller, scene: RailScene, alpha: float, bands: Sequence[int]) -> FloatArray:
    """A3 of a model in these bands of a strip [dB]."""
    across = alpha if "k_y" in model.asks else 0.0
    return _in_one_call(partial(a3, scene, across), _transfer(model, scene, alpha))[bands]


def a3(scene: RailScene, alpha: float, transfer: Transfer) -> FloatArray:
    """10 lg of int abs(H)^2 C_line dq over int C_line dq in the bands of a strip, over ground of that alpha [dB]."""
    structure = structure_of("isotropic" if math.isinf(alpha) else alpha or "ridges", line := line_of(scene))
    edges, axes = strip_bands(scene).edges, scene.contact.semi_axes
    share = structure.band_power(line, transfer, edges=edges, semi_axes=axes)
    return np.asarray(10 * np.log10(np.maximum(share, NOTHING)))


def _transfer(model: Caller, scene: RailScene, alpha: float) -> Transfer:
    """What a model has for the amplitude; one that does not ask for k_y is a filter of the line, as over ridges."""
    contact = scene.contact
    arguments = {"a_x": contact.along, "a_y": contact.across, "approach": contact.approach, "alpha": alpha}

    return lambda k_x, k_y: answer_of(model, k_x=k_x, k_y=k_y, **arguments)


def _in_one_call(integral: Callable[[Transfer], FloatArray], transfer: Transfer) -> FloatArray:
    """Of a function that is asked for all waves at once: they are noted first."""
    waves: list[tuple[FloatArray, ...]] = []

    def noted(k_x: FloatArray, k_y: FloatArray) -> FloatArray:
        waves.append(tuple(np.broadcast_arrays(k_x, k_y)))
        return np.ones(waves[-1][0].shape)

    integral(noted)
    k_x, k_y = (np.concatenate([wave.ravel() for wave in component]) for component in zip(*waves, strict=True))
    values = iter(np.split(transfer(k_x, k_y), np.cumsum([wave.size for wave, _ in waves])[:-1]))
    return integral(lambda k_x, k_y: next(values).reshape(np.broadcast_shapes(k_x.shape, k_y.shape)))


@cache
def counted_bands(scene: RailScene, alpha: float) -> list[tuple[int, float, float]]:
    """Bands that count, up to the first below `COUNTED`: number, wavelength [mm], and A3 of linear theory [dB]."""
    levels = a3(scene, alpha, partial(half_space_filter, semi_axes=scene.contact.semi_axes))
    waves = np.round(1000 * strip_bands(scene).nominal, 2).tolist()
    inside = assessed_bands(levels, COUNTED)
    return [(i, wave, float(levels[i])) for i, wave in enumerate(waves) if inside[i]]


@cache
def scene_of(load: float, diameter: float, crown: float = 0.0) -> RailScene:
    """A conical wheel on a rail of the roughness of ISO 3095. crown: of its crown, by default of the table [m]."""
    return RailScene(
        name=f"{load:g} kN, {diameter:g} mm{f', crown {1000 * crown:g} mm' if crown else ''}",
        radius=diameter / 2000,
        load=1000 * load,
        modulus=STEEL,
        roughness=levels_of("iso3095-2013"),
        crown_radius=crown or about(FILTER)["settings"]["crown"],
    )
