"""The contact force of a wheel on a rail as a sound, by four models on the same surface, and its levels.

Levels are in one-third octaves; A-weighted ones of a force are written for one release alone.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from validation.analysis.evidence import Table, table_of
from validation.analysis.spectra import (
    KILOHERTZ,
    Bands,
    a_weighting,
    common_full_scale,
    filtered,
    levels,
    powers_of_blocks,
    waves,
)
from validation.analysis.statistics import POWER_DECIBEL, Estimate, FloatArray, jackknifed
from validation.case import SERIAL, Engine, Outcomes
from validation.engine.engine import Outcome
from validation.engine.realisations import NotConvergedError
from validation.railway.problems import rail_sound as sounds
from validation.railway.problems.rail_sound import GEIKE, ISOTROPIC, HeldWheel
from validation.railway.problems.rail_strip import RailStrip, StatedAcross, strip_bands, strip_of
from validation.railway.scenes.rail import RailScene
from validation.scenes.load import load_scene
from validation.simulation.model_names import BEM, LINEAR, SPRINGS_THAT_READ

SOUNDING = {"bem": BEM, "linear": LINEAR, "springs": SPRINGS_THAT_READ, "geike": GEIKE}
"""Models by the names of their files."""
SHORTEST = 0.9
"""Largest wavenumber over that of two cells a wave."""
LOWEST, FEWEST_WAVES = 20.0, 5
"""First frequency of one-third octaves [Hz], and waves of a period below it."""
LEAST = -40.0
"""dB re 1 N: of 0.01 N, a tenth of the last digit of the samples."""


def shipped_rail() -> RailScene:
    scene = load_scene("rail")
    assert isinstance(scene, RailScene)
    return scene


@dataclass(frozen=True, kw_only=True)
class RailSound:
    """A wheel that rolls over one rough strip at a constant height.

    rail: the scene, with a speed; seconds: to roll over the strip, which is a period; repeats: of it in a file; rate:
    samples a second; models: names of `SOUNDING`; cells: to the smaller semi-axis, two grids; parts: of the strip,
    which boundary elements solve one by one; tolerance: residual of boundary elements; blocks: pieces of the strip, of
    which error bars are made; seed.
    """

    rail: RailScene
    seconds: float
    repeats: int
    rate: int = 24000
    models: tuple[str, ...] = tuple(SOUNDING)
    cells: tuple[int, int] = (4, 6)
    parts: int = 4
    tolerance: float = 1e-4
    blocks: int = 10
    seed: int = 22

    def __post_init__(self) -> None:
        if unknown := [name for name in self.models if name not in SOUNDING]:
            raise ValueError(f"models must be of {', '.join(SOUNDING)}, got {', '.join(unknown)}")
        if not self.models:
            raise ValueError(f"models must be one of {', '.join(SOUNDING)} at least, got none")
        if self.across != ISOTROPIC and set(self.models) == {"geike"}:
            raise ValueError(
                "Geike's rule is for isotropic ground: rail.lateral_structure must be isotropic, or another model given"
            )

    @property
    def across(self) -> StatedAcross:
        """Isotropic where the scene leaves it out."""
        return ISOTROPIC if self.rail.lateral_structure is None else self.rail.lateral_structure

    @property
    def sounding(self) -> tuple[str, ...]:
        """Models in the order of `SOUNDING`, without Geike's rule where the ground is not isotropic."""
        models = [model for name, model in SOUNDING.items() if name in self.models]
        return tuple(model for model in models if model != GEIKE or self.across == ISOTROPIC)

    @property
    def samples(self) -> int:
        return round(self.seconds * self.rate)

    @property
    def speed(self) -> float:
        """v [m/s]."""
        assert self.rail.speed is not None  # or there is no strip
        return self.rail.speed

    @property
    def metres(self) -> float:
        """Of rail in a period."""
        return self.speed * self.seconds

    @property
    def band(self) -> tuple[float, float]:
        """Frequencies between which the strip is rough along the track [Hz]."""
        edges = strip_bands(self.rail).edges
        return float(edges[0]) * self.speed / (2 * math.pi), float(edges[-1]) * self.speed / (2 * math.pi)

    @property
    def of_contact(self) -> float:
        """v / (2 a_x): of the wave as long as the contact [Hz]."""
        return self.speed / (2 * self.rail.contact.along)

    @cached_property
    def finer(self) -> float:
        """1, or more where oblique waves are too short for the coarse grid."""
        short = strip_of(self.rail, self.across, self.cells[0], 0, self.seed)
        return max(1.0, short.ground.highest * short.spacing / (SHORTEST * math.pi))

    def strip(self, cells: int) -> RailStrip:
        return sounds.sounding_strip(
            self.rail,
            across=self.across,
            samples=self.samples,
            rate=self.rate,
            cells=math.ceil(cells * self.finer),
            seed=self.seed,
        )

    def problems(self, model: str, cells: int) -> list[HeldWheel]:
        strip = self.strip(cells)
        ends = np.linspace(0, strip.shape[0], 1 + (self.parts if model == BEM else 1)).astype(int).tolist()
        return [
            HeldWheel(strip=strip, model=model, first=first, last=last, tolerance=self.tolerance)
            for first, last in pairwise(ends)
        ]


@dataclass(frozen=True)
class RailSoundResult(Outcomes):
    """Samples of one period of each model on both grids, the force less its mean [N], and their levels."""

    case: RailSound

    def signal(self, model: str) -> FloatArray:
        """On the finer grid."""
        samples: FloatArray = self[model, self.case.cells[1]]
        return samples

    @cached_property
    def full_scale(self) -> float:
        """Force that the largest number of a file stands for, one for all models [N]."""
        return common_full_scale(self.signal(model) for model in self.case.sounding)

    @cached_property
    def weight(self) -> FloatArray:
        """A-weighting of the waves of a period, as a gain."""
        f = np.fft.rfftfreq(self.case.samples, 1 / self.case.rate)
        return np.asarray(10 ** (a_weighting(np.maximum(f, f[1])) / 20))

    def level(self, model: str) -> float:
        """dB re 1 N."""
        return decibels(float(np.mean(self.signal(model) ** 2)))

    def weighted(self, model: str) -> float:
        """dB(A) re 1 N."""
        return decibels(float(np.mean(filtered(self.signal(model), self.weight) ** 2)))

    def over(self, model: str) -> tuple[Estimate, float]:
        """A-weighted level over boundary elements on the same strip, and what the grid leaves, to first order [dB]."""
        coarse, fine = self.case.cells
        estimate, on_coarse = (self._over_bem(model, cells) for cells in (fine, coarse))
        return estimate, abs(estimate.value - on_coarse.value) * coarse / (fine - coarse)

    def _over_bem(self, model: str, cells: int) -> Estimate:
        """A-weighted level relative to boundary elements on so many cells [dB], by the jackknife over pieces."""
        powers = [powers_of_blocks(filtered(self[name, cells], self.weight), self.case.blocks) for name in (model, BEM)]

        def ratio(rows: FloatArray) -> FloatArray:
            power, reference = rows.sum(axis=0)
            return np.atleast_1d(decibels(power / reference))

        return jackknifed(ratio, np.stack(powers, axis=1))[0]

    @cached_property
    def bands(self) -> Bands:
        """One-third octaves of frequency, in rad/s."""
        first = max(LOWEST, FEWEST_WAVES * self.case.rate / self.case.samples)
        return Bands.around(KILOHERTZ, 2 * math.pi * first, 2 * math.pi * min(self.case.band[1], self.case.rate / 2))

    def in_bands(self, model: str) -> FloatArray:
        """dB re 1 N; NaN below that of the samples' last digit."""
        powers = levels(waves(self.signal(model), spacing=1 / self.case.rate), self.bands)
        level = np.array([decibels(2 * power) for power in powers])
        return np.where(level > LEAST, np.round(level, 2), np.nan)

    def bands_table(self) -> Table:
        columns = {f"{model} [dB re 1 N]": self.in_bands(model).tolist() for model in self.case.sounding}
        return Table("levels", {"f [Hz]": (self.bands.centres / (2 * math.pi)).tolist(), **columns})

    def sounds_table(self) -> Table:
        """A row a model: its level, without a weight, since a force has another one than sound power."""
        rows = []
        for model in self.case.sounding:
            row: dict[str, object] = {
                "model": model,
                "level [dB re 1 N]": round(self.level(model), 2),
                "largest [N]": round(float(np.abs(self.signal(model)).max()), 1),
                "full scale [N]": self.full_scale,
                "samples a second": self.case.rate,
            }
            rows.append(row)
        return table_of("sounds", rows)

    def former_levels(self, model: str) -> dict[str, float]:
        """A-weighted level of the force, and over boundary elements: in sounds.json alone, for one release."""
        levels = {"A-weighted [dB re 1 N]": round(self.weighted(model), 2)}
        if BEM in self.case.sounding:
            estimate, grid = self.over(model)
            levels["A-weighted over boundary elements [dB]"] = round(estimate.value, 2)
            levels["± [dB]"] = round(estimate.half_width + grid, 2)
        return levels

    def samples_table(self) -> Table:
        """A column a model, to a tenth of a newton."""
        columns = {column_of(model): np.round(self.signal(model), 1).tolist() for model in self.case.sounding}
        return Table("samples", columns)


def column_of(model: str) -> str:
    """Of the table of samples."""
    return f"{model} [N]"


def decibels(power: float) -> float:
    """-300 dB where there is none."""
    return POWER_DECIBEL * math.log(max(power, 1e-30))


def run(case: RailSound, engine: Engine = SERIAL) -> RailSoundResult:
    """Roll each model on both grids. Raises NotConvergedError where boundary elements fail anywhere."""
    groups = {(model, cells): case.problems(model, cells) for cells in case.cells for model in case.sounding}
    outcomes = engine.map_groups(sounds.roll_held_wheel, groups)
    lost = tuple(
        f"{model}, {cells} cells to an axis: {count} positions"
        for (model, cells), parts in outcomes.items()
        if (count := int(sum(float(part["failed"]) for part in parts)))
    )
    if lost:
        raise NotConvergedError("a sound has no gaps: some positions did not converge", lost)
    return RailSoundResult(case, {key: _joined(case, parts) for key, parts in outcomes.items()})


def _joined(case: RailSound, parts: Sequence[Outcome]) -> FloatArray:
    return sounds.samples_of(np.concatenate([part["force"] for part in parts]), case.samples)
