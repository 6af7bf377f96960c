"""A contact filter of a wheel on a rail as a candidate: its error in each band, and that of the bands that count."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

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
        a3, model, grid, sample = (result.values[name] for name in ("a3", "model", "grid", "sample"))
        error = model + np.hypot(grid, sample)
        at = int(np.argmax(np.where(self.quantity.counted(a3), error, -1.0)))
        counted = relative(worst(self.quantity, a3, error))
        left = np.hypot(relative(float(grid[at])), relative(float(sample[at])))
        return Answer(
            value=result.values[self.quantity.name],
            cost=self.cost(),
            model=max(counted - float(left), 0.0),
            grid=relative(float(grid[at])),
            sample=relative(float(sample[at])),
            reason=reason_of(self.quantity, a3, error),
            counted=counted_wavelengths(self.quantity, a3),
            band_errors={"model": model, "grid": grid, "sample": sample},
            seconds=self._seconds(1),
        )


def rail_models(scene: RailScene, quantity: str, tolerance: float, seed: int, shared: Shared) -> list[SceneModel]:
    """All models of a quantity, the cheapest first. shared: what is solved for both quantities."""
    target = Target(scene, quantity, tolerance, seed)
    found = [
        RailSceneModel(model, target, resolution, shared)
        for model in models_serving(scene, quantity)
        for resolution in model.resolutions(target)
    ]
    return sorted(found, key=lambda one: one.cost().seconds)


def counted_wavelengths(asked: RailQuantity, a3: FloatArray) -> str:
    """The bands in which the tolerance counts, in words."""
    nominal = 1e3 * asked.bands.nominal[asked.counted(a3)]
    left = 1e3 * asked.bands.nominal[~asked.counted(a3)]
    between = [f"{wave:g}" for wave in left if wave > nominal.min(initial=np.inf)]
    without = f" without {', '.join(between)} mm" if between else ""
    return (
        f"the tolerance counts where A3 is above {COUNTED:g} dB: {nominal.max():g} to {nominal.min():g} mm{without}"
        if nominal.size
        else f"no band has A3 above {COUNTED:g} dB: the tolerance counts in none"
    )
