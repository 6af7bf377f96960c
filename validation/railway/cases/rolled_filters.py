"""Strips of rough rail under a wheel of constant load, by boundary elements and by one-sided springs."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import product, starmap
from typing import Any, TypeVar

import numpy as np

from validation.analysis.series import Estimates, Where
from validation.analysis.spectra import Bands
from validation.analysis.statistics import POWER_DECIBEL, FloatArray
from validation.case import SERIAL, Engine, Outcomes, Quantity, Series
from validation.engine.engine import Outcome
from validation.engine.realisations import FEWEST, NotConvergedError, require_realisations
from validation.railway.cases import filters
from validation.railway.cases.filters import GROUNDS, REMINGTON, RailWheel
from validation.railway.problems import equivalent_displacement as tracks
from validation.railway.problems.rail_strip import strip_bands, strip_of
from validation.railway.scenes.rail import RailScene
from validation.simulation import model_names as named
from validation.simulation.model_names import BEM, twin_of

Key = tuple[RailWheel, float, str]
"""Wheel, dB over the levels, and what lies across, by its name."""

FILTERS = (named.LINEAR, named.LINEAR_ON_LINE, named.LINEAR_ON_MEAN, named.BED, REMINGTON)
RIVALS = (named.SPRINGS_THAT_READ, named.SPRINGS_ON_LINE, named.SPRINGS_ON_MEAN, named.ONE_SIDED_BED)
A3, OVER_BEM, WAVE = Quantity("A3"), Quantity("A3_over_that_of_boundary_elements"), "wavelength [mm]"


@dataclass(frozen=True, kw_only=True)
class RolledFilters:
    """Strips of rail under wheels of constant load, rolled over by boundary elements and by one-sided springs.

    wheels: load of one wheel [kN] and diameter [mm]; crown: of the rail [m]; offsets: dB over ISO 3095:2013; across:
    what lies across; strips; cells: to the smaller semi-axis, two grids; seed.
    """

    wheels: tuple[tuple[float, float], ...] = ((50.0, 920.0),)
    crown: float = 0.3
    offsets: tuple[float, ...] = (0.0,)
    across: tuple[str, ...] = ("ridges", "isotropic ground")
    strips: int = 4
    cells: tuple[int, int] = (6, 9)
    seed: int = 20

    def __post_init__(self) -> None:
        require_realisations(strips=self.strips)

    @property
    def keys(self) -> list[Key]:
        return list(product(starmap(RailWheel, self.wheels), self.offsets, self.across))

    def scene(self, key: Key) -> RailScene:
        wheel, offset, _ = key
        return filters.scene_of(wheel, crown=self.crown, offset=offset)

    def problems(self, key: Key, cells: int) -> list[Any]:
        scene, across, models = self.scene(key), GROUNDS[key[2]], (BEM, *RIVALS, *spectral_models(key))
        return [
            tracks.RolledRail(strip=strip_of(scene, across, cells, i, self.seed), models=models)
            for i in range(self.strips)
        ]


def spectral_models(key: Key) -> tuple[str, ...]:
    """Springs of input spectra on a kind of strip: Geike's rule is for isotropic ground alone."""
    return (named.SPRINGS_ROLLING, named.SPRINGS_GEIKE)[: 2 if GROUNDS[key[2]] == "isotropic" else 1]


def models_of(key: Key) -> tuple[str, ...]:
    return (BEM, *FILTERS, *RIVALS, *spectral_models(key))


@dataclass(frozen=True)
class RolledFiltersResult(Outcomes):
    """Tracks of all models along each strip, by kind of strip and by cells."""

    case: RolledFilters

    def over(self, key: Key, model: str, other: str, cells: int | None = None) -> Estimates:
        """ln of the band power over that of another track of the same strips; on the finer grid unless told."""
        cells, bands = cells or self.case.cells[1], strip_bands(self.case.scene(key))
        if model == other:
            return Estimates.exact(np.zeros(len(bands)))
        spacing = self.case.problems(key, cells)[0].strip.spacing
        converged = [outcome for outcome in self[key, cells] if not outcome["failed"]]
        return Estimates(tracks.log_over(model, other, converged, spacing, Bands(tuple(bands.edges.tolist()))))

    def over_twin(self, key: Key, model: str) -> Estimates:
        return self.over(key, model, twin_of(model))

    def left_by_grid(self, key: Key, model: str, other: str) -> FloatArray:
        """Half-width that cells leave, to first order: what is left of the way from the coarse grid to the fine one."""
        coarse, fine = self.case.cells
        change = self.over(key, model, other, fine).values - self.over(key, model, other, coarse).values
        return np.abs(change) * coarse / (fine - coarse)

    def linear(self, key: Key, model: str = named.LINEAR) -> FloatArray:
        """A3 of the linear twin of a model in the bands of the strips [dB]."""
        scene = self.case.scene(key)
        return filters.on_strips(scene, filters.linear_filter(scene, twin_of(model), GROUNDS[key[2]]))

    def over_linear(self, key: Key, model: str) -> Estimates:
        """ln of the filter of a model over that of linear theory of the ellipse: that of its twin is exact."""
        difference = Estimates.exact((self.linear(key, model) - self.linear(key)) / POWER_DECIBEL)
        return difference + self.over_twin(key, model)

    def filters(self, key: Key) -> Iterator[Series]:
        """A3 of all models."""
        linear = Estimates.exact(self.linear(key) / POWER_DECIBEL)
        for model in models_of(key):
            grid = self.left_by_grid(key, model, twin_of(model))
            yield in_bands(self.case, key)(A3, model, self.over_linear(key, model) + linear, grid=grid)


def in_bands(case: RolledFilters, key: Key) -> Callable[..., Series]:
    """A series over the bands of a kind of strip [dB]."""
    wheel, offset, name = key
    where: Where = {"wheel": wheel.label, filters.OFFSET: offset, "across": name}
    at = filters.millimetres(strip_bands(case.scene(key)))
    return partial(Series, where=where, along=WAVE, at=at, scale=POWER_DECIBEL, unit="dB")


R = TypeVar("R", bound=RolledFiltersResult)


def run_filters(case: RolledFilters, engine: Engine = SERIAL) -> RolledFiltersResult:
    return solved(case, engine, tracks.roll_rail, RolledFiltersResult)


def solved(case: RolledFilters, engine: Engine, solve: Callable[[Any], Outcome], result: type[R]) -> R:
    """Roll on both grids. Raises NotConvergedError where fewer than three strips of a kind converge."""
    groups: dict[tuple[Key, int], Sequence[Any]] = {
        (key, cells): case.problems(key, cells) for key in case.keys for cells in case.cells
    }
    outcomes = engine.map_groups(solve, groups)
    lost = tuple(
        f"strip {i}, {wheel.label}, {offset:+g} dB, {name}, {cells} cells to an axis: "
        f"{int(outcome['failed'])} positions"
        for ((wheel, offset, name), cells), of_strips in outcomes.items()
        for i, outcome in enumerate(of_strips)
        if outcome["failed"]
    )
    for ((wheel, offset, name), _), of_strips in outcomes.items():
        if sum(not outcome["failed"] for outcome in of_strips) < FEWEST:
            raise NotConvergedError(f"fewer than {FEWEST} strips of {wheel.label}, {offset:+g} dB, {name}", lost)
    return result(case, outcomes, lost)
