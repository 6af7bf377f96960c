"""A contact model: a function with a declaration of what it serves, of its error and of its cost.

Found in a folder `models`, it is a candidate of `compare` and a point on the charts.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property, partial
from pkgutil import resolve_name
from typing import Any

import numpy as np

from mdr.checks import positive
from validation.analysis.escapes import one_line
from validation.engine.engine import FloatArray
from validation.engine.street import modules_in
from validation.scenes.rolling import RollingQuantity
from validation.simulation.method import FEWEST, Prepared, Resolution, Result, Solve
from validation.simulation.model_names import BEM, MODELS


@dataclass(frozen=True)
class Target:
    """A quantity of a scene, how far off it may be, relative, and the seed of the roughness that is drawn."""

    scene: Any
    quantity: str = "stiffness"
    tolerance: float = 0.1
    seed: int = 0

    def __post_init__(self) -> None:
        positive("tolerance", self.tolerance)

    @cached_property
    def rolling(self) -> RollingQuantity:
        return RollingQuantity(self.scene, self.quantity)


@dataclass(frozen=True, kw_only=True)
class ErrorEstimate:
    """The error that a model expects, before it has computed anything.

    model, sample: relative half-widths of 95 %, infinite where none is known; of_scene: what the scene leaves open of
    that of the model, so that no model has less; reason: the conditions that they rest on, with their numbers.
    """

    model: float = 0.0
    sample: float = 0.0
    of_scene: float = 0.0
    reason: str

    @classmethod
    def out_of_range(cls, reason: str) -> "ErrorEstimate":
        """None: the scene is not of those on which the error was measured, or the model cannot serve it at all."""
        return cls(model=math.inf, reason=reason)

    @property
    def error(self) -> float:
        """Errors of model and sample, added as if they had the same sign."""
        return self.model + self.sample

    @property
    def in_range(self) -> bool:
        return math.isfinite(self.error)


@dataclass(frozen=True, kw_only=True)
class Cost:
    """work: operations, expected or counted; seconds: what those take on one core, about."""

    work: float
    seconds: float


@dataclass(frozen=True, kw_only=True)
class Sampling:
    """scatter: relative deviation of one solve, about; fewest, most: solves; compared: of these, on other grids too."""

    scatter: float = 0.0
    fewest: int = 1
    most: int = 1
    compared: int = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class Model:
    """What a model declares; a `Method` that claims an error.

    name: for tables and figures; setting: its resolution or its formula, in words;
    serves: whether it has this quantity of such scenes;
    prepare: as of every `Method`; its results have the values of the quantities that it serves, by their names;
    cost: what one solve is expected to cost;
    claim: the error that the model expects of a scene that it serves;
    resolutions: those that are offered, the cheapest first;
    shape: what its error is expected to go with; the calibration measures how many times that it is;
    left_out: error of the model that shows in its result alone;
    element: what a contact consists of, where a result counts those "in contact";
    answer: what a scene's error and value are, where its solves say that themselves, of a `SceneModel`;
    helps: what of the scene would leave less open of `ErrorEstimate.of_scene`, in words;
    charted: whether charts take it as it is, or vary its resolution;
    is_mdr: whether its springs are the method of dimensionality reduction.
    """

    name: str
    setting: str
    serves: Callable[[Any, str], bool]
    prepare: Callable[[Target, Resolution], Prepared]
    cost: Callable[[Target, Resolution], Cost]
    claim: Callable[["Model", Target, Resolution], ErrorEstimate]
    resolutions: Callable[[Target], tuple[Resolution, ...]] = lambda target: (Resolution(),)
    shape: Callable[[Target], float] = lambda target: 1.0
    left_out: Callable[[Target, FloatArray], float] = lambda target, value: 0.0
    element: str = ""
    answer: Callable[[Any], Any] | None = None
    helps: Callable[[Target], str] = lambda target: ""
    charted: bool = True
    is_mdr: bool = False

    def __repr__(self) -> str:
        return one_line(f"{type(self).__name__}({self.name!r}, {self.setting!r})")

    def estimate(self, target: Target, resolution: Resolution) -> ErrorEstimate:
        """The error that it expects, before it has computed anything."""
        return self.claim(self, target, resolution)

    @property
    def place(self) -> tuple[str, str]:
        """Module and variable in which it is declared."""
        return next((module, variable) for module, variable, candidate in _model_variables() if candidate is self)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the module and variable of the model, since nested functions cannot be pickled."""
        return resolve_name, (":".join(self.place),)


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class GridModel(Model):
    """Boundary elements, whose solves on other grids tell what a grid leaves: the reference of all other models.

    label: name on one grid; references: the grids that one is compared with; scatter: of one drawn surface, relative,
    about; most: surfaces; compared: of these, on the other grids too;
    grid_error: relative half-width of 95 %, infinite where grids do not converge, and what it rests on, by values,
    (realisations, numbers), and others, the first of them on the grids of `references`, grids first.
    """

    name: str = BEM
    setting: str = "on a grid"
    element: str = "cells"
    charted: bool = False
    label: Callable[[Resolution], str]
    references: Callable[[Target, Resolution], tuple[Resolution, ...]]
    scatter: Callable[[Target], float]
    most: int
    compared: int
    grid_error: Callable[[Target, Resolution, FloatArray, FloatArray], tuple[float, str]]

    def sampling(self, target: Target) -> Sampling:
        """A single surface that was measured, or as many as leave the most of the tolerance."""
        if target.scene.ground.is_single:
            return Sampling(compared=1)
        return Sampling(scatter=self.scatter(target), fewest=FEWEST, most=self.most, compared=self.compared)


Value = float | FloatArray | Result
"""Value of the target's quantity; a Result where there are more values, several realisations, or none."""
Function = Callable[[Target, Resolution], Value]


def model(*, cost: Callable[[Target, Resolution], Cost], **declared: Any) -> Callable[[Function], Model]:
    """The model that a function is which has all of a solve. declared: the other fields of `Model`."""

    def declare(function: Function) -> Model:
        def prepare(target: Target, resolution: Resolution) -> Prepared:
            def read(value: Value) -> Result:
                result = value if isinstance(value, Result) else Result({target.quantity: np.asarray(value)})
                return replace(result, work=float(cost(target, resolution).work))

            return lambda _: Solve(partial(function, target, resolution), read)

        return Model(prepare=prepare, cost=cost, **declared)

    return declare


def models_serving(scene: Any, quantity: str) -> tuple[Model, ...]:
    """All models that have this quantity of the scene."""
    return tuple(model for model in all_models() if model.serves(scene, quantity))


def all_models() -> tuple[Model, ...]:
    """All models that are declared, in the order of `MODELS`, then of their names."""
    order = {name: place for place, name in enumerate(MODELS)}
    models = dict.fromkeys(model for *_, model in _model_variables())
    return tuple(sorted(models, key=lambda model: (order.get(model.name, len(order)), model.name)))


def _model_variables() -> Iterator[tuple[str, str, Model]]:
    """Module, name and value of each variable that is a model, in the modules of folders `models`."""
    for module in modules_in("models"):
        yield from ((module.__name__, key, value) for key, value in vars(module).items() if isinstance(value, Model))
