"""A contact filter of a wheel on a rail as a candidate: its error in each band, and that of the bands that count."""

import math
from dataclasses import dataclass, replace

import numpy as np

from validation.advice.scene_model import Answer, SceneModel
from validation.railway.problems.rail_models import rail_quantity, reason_of, relative, worst
from validation.railway.problems.rail_quantity import COUNTED, RailQuantity
from validation.railway.scenes.measured_lines import MeasuredLines
from validation.scenes.measured import MeasuredHeights


@dataclass(frozen=True)
class RailSceneModel(SceneModel):
    """A solve has all of its strips."""

    def solve(self) -> Answer:
        """The largest errors of the bands in which the tolerance counts, and those of each band."""
        (result,) = self._first(self.resolution, 1)
        if result.failed:
            return Answer(value=np.array([np.nan]), cost=self.cost(), failed=result.failed)
        asked, a3 = rail_quantity(self.target), result.values["a3"]
        counts = asked.counted(a3)
        answer = Answer(
            value=result.values[asked.name],
            cost=self.cost(),
            counted=(
                f"the tolerance counts where A3 is above {COUNTED:g} dB: {asked.bands.names(counts)}"
                if counts.any()
                else asked.none_counts
            ),
            counts=tuple(counts.tolist()),
            band_errors={name: result.values[name] for name in ("model", "grid", "sample")},
            seconds=self._seconds(1),
        )
        error = answer.error_in_bands
        at = int(np.argmax(np.where(counts, error, -1.0)))
        grid, sample = (relative(float(answer.band_errors[name][at]) * counts[at]) for name in ("grid", "sample"))
        left = relative(worst(asked, a3, error)) - math.hypot(grid, sample)
        reason = reason_of(asked, a3, error) if np.isfinite(error).any() else ""
        return replace(answer, model=max(left, 0.0), grid=grid, sample=sample, reason=reason)


def what_would_state_the_ground(asked: RailQuantity) -> str:
    """Keys of a scene file by which the ground leaves less open, and why."""
    scene, stated = asked.scene, 'across = "ridges" in [rail], or a number alpha: waves with |k_y| < alpha k_x'
    faults = asked.left_by_faults
    if 2 * faults.max() > (asked.left_by_ground - faults).max() and faults.max() > 0:
        return "a measurement without the outliers that the notes name, or a part of it that has none"
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
