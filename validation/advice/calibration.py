"""Errors of cheap models, measured beside boundary elements, and interpolated in the conditions of a scene."""

import csv
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from validation.engine.engine import FloatArray
from validation.engine.sources import version_of
from validation.scenes.indentation import IndentationScene
from validation.scenes.rolling import RollingQuantity, RollingScene
from validation.scenes.roughness import RoughSurface
from validation.simulation.indentation import ground_of
from validation.simulation.method import Resolution
from validation.simulation.model import ErrorEstimate, GridModel, Model, Target, models_serving
from validation.theory.rolling import contact_lost

Conditions = Mapping[str, float]
Ranges = Mapping[str, tuple[float, float]]

SLACK = 1e-9
"""By which a scene may lie beyond an end, relative: the rounding of its units."""


def outside(conditions: Conditions, ranges: Ranges) -> str:
    """The first condition beyond the range in which the error was measured, in words; empty where none is.

    A range that a scene has no condition for, as the Hurst exponent of measured heights, says nothing of it.
    """
    for name, (low, high) in ranges.items():
        value = conditions.get(name, low)
        if not low * (1 - SLACK) <= value <= high * (1 + SLACK):
            span = f"from {low:g} on" if math.isinf(high) else f"from {low:g} to {high:g}"
            return f"{name} = {value:.3g}; the error of the model is known {span} only"
    return ""


def counted(conditions: Conditions) -> str:
    """Names with their numbers, for a reason."""
    return ", ".join(f"{name} = {value:.3g}" for name, value in conditions.items())


LOAD, HEIGHT, WAVES, HURST = "F / (E* h L)", "h/d", "longest waves on a side", "Hurst exponent"
LONG, SHORT, RATIO = "q a of the longest wave", "q a of the shortest wave", "longest over shortest wave"
MOVING_LONG = "q a of the longest wave above the resonance"
"""What decides how far cheap models are off, in words."""
CONDITIONS = (LOAD, HEIGHT, WAVES, LONG, MOVING_LONG, RATIO, HURST)
"""Those of the calibration."""
ENVELOPE: Ranges = {HEIGHT: (0, 1), LONG: (0, 2), SHORT: (0, 40), RATIO: (2, 64), HURST: (0.2, 1.2)}
"""Of rolling: drawn scenes were rolled with h/d from 0.003, q a of the longest wave from 0.2 and bands up to a factor
20 wide. Longer waves only move the contact, which linear theory knows; that it holds in wider bands is taken from Table
14.1 alone."""
SPHERE_SHAPE = (1.0, 0.05, 0.005)
"""What the errors of a rough sphere go with, `shape` of the calibration: the contact that is lost, h q a / d with the q
of the longest wave, no rms slope, and what the reference leaves."""
SCATTER = 0.22
"""Relative deviation of the stiffness of one rough punch without roll-off, about: Fig. 14.1."""


def conditions_of(scene: IndentationScene) -> dict[str, float]:
    """What decides how far cheap models are off."""
    ground = ground_of(scene)
    band = {RATIO: ground.q_max / ground.q_min}
    if ground.hurst is not None:
        band[HURST] = ground.hurst
    if scene.shape == "punch":
        return {LOAD: scene.reduced_load, WAVES: ground.q_min * scene.size / (2 * math.pi), **band}
    radius = scene.contact_radius
    return {HEIGHT: scene.roughness_ratio, LONG: ground.q_min * radius, SHORT: ground.q_max * radius, **band}


def rolling_conditions(quantity: RollingQuantity) -> dict[str, float]:
    """The same of a wheel; of a moving one h/d is by its resonance, and the waves are those that count."""
    scene, ground = quantity.scene, quantity.ground
    first, last = (q * scene.contact_radius for q in (ground.q_min, quantity.q_max))
    height = scene.roughness_ratio * quantity.amplification
    longest = {MOVING_LONG: quantity.longest_moving * scene.contact_radius} if quantity.dynamic else {LONG: first}
    conditions = {HEIGHT: height, **longest, SHORT: last, RATIO: last / first}
    return conditions if ground.hurst is None else {**conditions, HURST: ground.hurst}


def beyond_envelope(quantity: RollingQuantity) -> str:
    """Why rules of rolling models do not hold where no error is measured; empty where they do."""
    scene = quantity.scene
    as_given = {LONG: quantity.ground.q_min * scene.contact_radius, HEIGHT: scene.roughness_ratio}
    return outside({**rolling_conditions(quantity), **as_given}, ENVELOPE)


def lost_contact(scene: IndentationScene | RollingScene) -> float:
    """Share of the contact of a smooth sphere or wheel that linear theory loses to the roughness."""
    ground = scene.ground
    assert ground is not None  # as asked
    smooth = {"contact_radius": scene.contact_radius, "radius": scene.body.radius}
    return contact_lost(ground.c2d, edges=ground.edges, **smooth)


def sphere_shape(scene: IndentationScene) -> float:
    """What errors of cheap models of a rough sphere go with; one for a punch."""
    if scene.shape == "punch":
        return 1.0
    longest = scene.roughness_ratio * ground_of(scene).q_min * scene.contact_radius
    return float(np.dot(SPHERE_SHAPE, (lost_contact(scene), longest, 1.0)))


def beyond_spectrum(ground: RoughSurface) -> str:
    """Why a model that knows a surface by its spectrum alone is out of range for this one; empty where it is not."""
    beyond = ground.beyond_a_spectrum()
    return f"it knows the spectrum alone, and {beyond[0]}" if beyond else ""


Key = tuple[str, str, str]
"""Kind of scene, quantity, name of the model."""

TABLE = Path(__file__).with_name("calibration.csv")
SHARE = 0.97
"""Of the calibrated scenes, whose error a claim covers when they are left out of the table."""
NEIGHBOURS, NEARBY, NEARBY_IN_SHAPE = 6, 0.05, 0.3
"""Scenes of the table that an error is interpolated between, at the least, and their share of all: a larger one where
it goes with a shape that is known, as under spheres and wheels."""
LEADS = 2.0
"""Weight of the load or the height in the distance between scenes; of every other condition, one."""
MARGIN = 0.15
"""Decades by which a scene may lie beyond the outermost of the table; of the Hurst exponent, as much."""
OPEN_ABOVE, OPEN_BELOW = (LOAD,), (HEIGHT, LONG, MOVING_LONG)
"""Beyond these ends of the table the error at the end holds: a punch under a high load is a flat one, low roughness
changes next to nothing, and waves much longer than the contact only move it."""
NO_NUMBERS = (
    "mdr.results",
    "bem3d.results",
    "bem3d.progress",
    "validation.analysis.number_text",
    "validation.scenes",
    "validation.advice.models",
    "validation.advice.calibration",
)
"""What is left out of the code behind an error: what prints, files of scenes, other models, and the claims."""
DRAWN = ("validation.scenes.indentation", "validation.scenes.rolling", "validation.scenes.roughness")
"""What the scenes of the table are made of."""
SAMPLED = "validation.advice.scene_model"
"""What decides how many realisations a sample has."""


@dataclass(frozen=True, eq=False)
class MeasuredErrors:
    """Errors of one model over a sample of scenes.

    names: of the conditions; points: their coordinates, (scenes, conditions): decades, and the Hurst exponent itself;
    shapes: what the errors are expected to go with, one where nothing is known of that; codes: digests of the code
    that measured them.
    """

    names: tuple[str, ...]
    points: FloatArray
    errors: FloatArray
    shapes: FloatArray
    codes: frozenset[str] = frozenset()

    def estimate(self, conditions: Mapping[str, float], shape: float = 1.0) -> ErrorEstimate:
        """The root mean square of the errors nearby over their shapes, times the factor that covers them."""
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        at = np.array([_coordinate(name, conditions[name]) if name in conditions else math.nan for name in self.names])
        for name, place, *ends in zip(self.names, at, low, high, strict=True):
            below, above = place < ends[0] - MARGIN, place > ends[1] + MARGIN
            if (below and name not in OPEN_BELOW) or (above and name not in OPEN_ABOVE):
                span = " to ".join(f"{end if name == HURST else 10**end:.3g}" for end in ends)
                reason = f"{name} = {conditions[name]:.3g}; the error of the model is measured from {span} only"
                return ErrorEstimate.out_of_range(reason)
        error = self.factor * shape * self._scale(np.clip(at, low, high), np.ones(len(self.errors), dtype=bool))
        leading = counted({name: conditions[name] for name in self.names[:2]})
        reason = f"errors reach so far on the nearest of {len(self.errors)} measured scenes, at {leading}"
        return ErrorEstimate(model=error, reason=reason)

    @cached_property
    def factor(self) -> float:
        """Of the errors nearby, that covers a share of all scenes, each left out of its own neighbours."""
        return float(np.quantile(self.errors / self.left_out(), SHARE, method="weibull"))

    def left_out(self) -> FloatArray:
        """Root mean square errors nearby, at each scene without itself."""
        all_rows = np.arange(len(self.errors))
        nearby = [self._scale(point, all_rows != i) for i, point in enumerate(self.points)]
        return np.asarray(self.shapes * nearby)

    @cached_property
    def trend(self) -> float:
        """p of an error over its shape that grows as (h/d)^p; zero where the first condition is a load."""
        if self.names[0] != HEIGHT:
            return 0.0
        slope = np.polyfit(self.points[:, 0], np.log10(self.errors / self.shapes), 1)[0]
        return float(np.clip(slope, 0.0, 1.0))

    def _scale(self, at: FloatArray, of: NDArray[np.bool_]) -> float:
        """The nearest scenes weigh the most. A condition that measured heights do not have counts for nothing."""
        weights = np.array([LEADS] + [1.0] * (len(at) - 1))
        distance = np.sqrt(np.nansum((weights * (self.points[of] - at)) ** 2, axis=1))
        share = NEARBY_IN_SHAPE if self.names[0] == HEIGHT else NEARBY
        nearest = np.argsort(distance, kind="stable")[: max(NEIGHBOURS, round(share * len(distance)))]
        weight = 1 - 0.9 * (distance[nearest] / (distance[nearest[-1]] + 1e-12)) ** 2
        grown = 10 ** (self.trend * (at[0] - self.points[of][nearest, 0]))
        return math.sqrt(float(np.average(((self.errors / self.shapes)[of][nearest] * grown) ** 2, weights=weight)))


def calibrated(model: Model, target: Target) -> ErrorEstimate:
    """The error of a model by the table."""
    kind, conditions = conditions_by_kind(target)
    measured = table().get((kind, target.quantity, model.name))
    if measured is None:
        return ErrorEstimate.out_of_range(f"the error of {target.quantity} is not in the table of the calibration")
    return measured.estimate(conditions, model.shape(target))


def calibrated_by_spectrum(
    model: Model, target: Target, resolution: Resolution, *, own: float = 0.0, beyond: str = ""
) -> ErrorEstimate:
    """The claim of a model that knows a rough surface by its spectrum alone: the error by the table.

    own: what one measured surface has beside the mean of all with its spectrum; beyond: why no error is known, or none.
    """
    ground = target.scene.ground
    if reason := beyond_spectrum(ground) or beyond:
        return ErrorEstimate.out_of_range(reason)
    expected = calibrated(model, target)
    return replace(expected, model=expected.model + own) if ground.is_single else expected


def kind_of(target: Target) -> str:
    """Of the scene, in the table."""
    kind: str = target.scene.kind
    return "rolling" if kind == "wheel" and not target.rolling.dynamic else kind


def conditions_by_kind(target: Target) -> tuple[str, dict[str, float]]:
    """Kind of the scene, and what decides how far cheap models are off."""
    rolls = target.scene.kind == "wheel"
    return kind_of(target), rolling_conditions(target.rolling) if rolls else conditions_of(target.scene)


def _coordinate(name: str, value: float) -> float:
    return value if name == HURST else math.log10(value)


@cache
def table(path: Path = TABLE) -> Mapping[Key, MeasuredErrors]:
    """All models that are calibrated."""
    rows: dict[Key, list[dict[str, str]]] = {}
    for row in rows_of(path):
        rows.setdefault((row["kind"], row["quantity"], row["model"]), []).append(row)
    return {key: _errors_of(rows_of_key) for key, rows_of_key in rows.items()}


def _errors_of(rows: Sequence[Mapping[str, str]]) -> MeasuredErrors:
    names = tuple(name for name in CONDITIONS if rows[0][name])
    points = [[_coordinate(name, float(row[name])) for name in names] for row in rows]
    errors, shapes = (np.array([float(row[name]) for row in rows]) for name in ("error", "shape"))
    return MeasuredErrors(names, np.array(points), errors, shapes, frozenset(row.get("code", "") for row in rows))


def rows_of(path: Path) -> list[dict[str, str]]:
    """All rows, without the lines of the provenance."""
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def provenance(path: Path = TABLE) -> dict[str, str]:
    """When and how the table was measured, and when some of its scenes gave the same numbers again."""
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    return dict(line[1:].strip().split(": ", 1) for line in lines if line.startswith("#"))


def code_behind(model: Model, target: Target) -> str:
    """Digest of the code that an error rests on: the solves of the model and of boundary elements, scenes, samples."""
    judges = [serving for serving in models_serving(target.scene, target.quantity) if isinstance(serving, GridModel)]
    return _version(tuple(sorted({used.place[0] for used in (model, *judges)})))


@cache
def _version(modules: tuple[str, ...]) -> str:
    return version_of((*modules, *DRAWN, SAMPLED), NO_NUMBERS)[:12]
