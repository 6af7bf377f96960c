"""A contact filter of a wheel on a rail as a candidate: its error in each band, and that of the bands that count."""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from validation.analysis.nominal_bands import LONGEST
from validation.scenes.measured import MeasuredHeights
from validation.scenes.measured_lines import MeasuredLines
from validation.scenes.rail import RailScene
from validation.selection.hierarchy import Answer
from validation.selection.scene_model import SceneModel, Shared
from validation.simulation.model import Target, models_serving
from validation.simulation.rail_models import RailModel, rail_quantity, reason_of, relative, worst
from validation.simulation.rail_quantity import COUNTED, RailQuantity

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class RailSceneModel(SceneModel):
    """A model with what is asked of it; a solve has all of its strips."""

    @property
    def name(self) -> str:
        return self.kind

    @cached_property
    def quantity(self) -> RailQuantity:
        return rail_quantity(self.target)

    def of_longer_waves(self) -> FloatArray:
        """A3 of the linear filter in all bands from 2000 mm to the last of the roughness [dB]."""
        assert isinstance(self.model, RailModel)  # as all of `rail_models`
        return np.asarray(self.model.closed(replace(self.quantity, longest=LONGEST)).mean(axis=0))

    @cached_property
    def closed(self) -> FloatArray:
        """A3 of the linear filter, in the middle of both ends of the ground [dB]."""
        assert isinstance(self.model, RailModel)  # which alone serves a rail
        return np.asarray(self.model.closed(self.quantity).mean(axis=0))

    def solve(self) -> Answer:
        """The largest errors of the bands in which the tolerance counts, and those of each band."""
        (result,) = self._first(self.resolution, 1)
        if result.failed:
            return Answer(value=np.array([np.nan]), cost=self.cost(), failed=result.failed)
        asked, a3 = self.quantity, result.values["a3"]
        answer = Answer(
            value=result.values[asked.name],
            cost=self.cost(),
            counted=counted_wavelengths(asked, a3),
            band_errors={name: result.values[name] for name in ("model", "grid", "sample")},
            seconds=self._seconds(1),
        )
        error, counts = answer.error_in_bands, asked.counted(a3)
        at = int(np.argmax(np.where(counts, error, -1.0)))
        grid, sample = (relative(float(answer.band_errors[name][at]) * counts[at]) for name in ("grid", "sample"))
        left = relative(worst(asked, a3, error)) - math.hypot(grid, sample)
        return replace(answer, model=max(left, 0.0), grid=grid, sample=sample, reason=reason_of(asked, a3, error))


def rail_models(scene: RailScene, quantity: str, tolerance: float, seed: int, shared: Shared) -> list[SceneModel]:
    """All models of a quantity, the cheapest first. shared: what is solved for both quantities."""
    target = Target(scene, quantity, tolerance, seed)
    found = [
        RailSceneModel(model, target, resolution, shared)
        for model in models_serving(scene, quantity)
        for resolution in model.resolutions(target)
    ]
    return sorted(found, key=lambda one: one.cost().seconds)


def what_would_state_the_ground(asked: RailQuantity) -> str:
    """Keys of a scene file by which the ground leaves less open, and why."""
    scene, stated = asked.scene, 'across = "ridges" in [rail], or a number alpha: waves with |k_y| < alpha k_x'
    if isinstance(scene.roughness, MeasuredHeights):
        return "a filter of this surface, by its own heights: of its lines both ends of what lies across are open"
    if scene.across is None:
        return f'to tell what lies across the rail, as across = "isotropic" or {stated[9:]}'
    table = "rail.lines" if isinstance(scene.roughness, MeasuredLines) else "rail.levels"
    if not asked.stands_out.any():
        return f"levels of more lines or of longer ones, which scatter less; or {stated}"
    rest = asked.bands.nominal[~asked.stands_out]
    long = asked.stands_out[0] and rest.size
    cut = f'; or longest = "{1e3 * rest.max():g} mm" in [{table}]' if long else ""
    return f"{stated}{cut}, since no isotropic ground has the levels at {asked.bands.names(asked.stands_out)}"


def counted_wavelengths(asked: RailQuantity, a3: FloatArray) -> str:
    """The bands in which the tolerance counts, in words."""
    counted = asked.counted(a3)
    if not counted.any():
        return asked.none_counts
    return f"the tolerance counts where A3 is above {COUNTED:g} dB: {asked.bands.names(counted)}"
