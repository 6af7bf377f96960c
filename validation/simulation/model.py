"""A contact model in one file of `simulation/models`: found there, it is in `compare`, on the charts, in the race."""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from importlib import import_module
from pkgutil import iter_modules
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from mdr.checks import positive
from validation.simulation import models
from validation.simulation.method import Prepared, Resolution
from validation.simulation.rolling_quantity import RollingQuantity

FloatArray = NDArray[np.float64]


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
        return RollingQuantity(self.scene, self.quantity)  # type: ignore[arg-type]  # of its names


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
        """Both, added as if they went the same way."""
        return self.model + self.sample

    @property
    def in_range(self) -> bool:
        return math.isfinite(self.error)


@dataclass(frozen=True, kw_only=True)
class Cost:
    """work: operations, expected or counted; unit: of them; seconds: what those take on one core, about."""

    work: float
    unit: str
    seconds: float


@dataclass(frozen=True, kw_only=True)
class Sampling:
    """scatter: relative deviation of one solve, about; fewest, most: solves; compared: of these, on other grids too."""

    scatter: float = 0.0
    fewest: int = 1
    most: int = 1
    compared: int = 0


class Model(ABC):
    """A method with an estimate of its error and of its cost. A module of `simulation/models` holds one as `MODEL`.

    name: for tables and figures; setting: its resolution or its formula, in words; element: what a contact consists
    of, where a result counts those "in contact"; charted: whether charts take it as it is, or vary its resolution;
    is_mdr: whether its springs are the method of dimensionality reduction.
    """

    name: ClassVar[str]
    setting: ClassVar[str]
    element: ClassVar[str] = ""
    charted: ClassVar[bool] = True
    is_mdr: ClassVar[bool] = False

    @abstractmethod
    def serves(self, scene: Any, quantity: str) -> bool:
        """Whether it has this quantity of such scenes."""

    @abstractmethod
    def estimate(self, target: Target, resolution: Resolution) -> ErrorEstimate:
        """The error that it expects of a scene that it serves."""

    @abstractmethod
    def cost(self, target: Target, resolution: Resolution) -> Cost:
        """What one solve is expected to cost."""

    @abstractmethod
    def prepare(self, target: Target, resolution: Resolution) -> Prepared:
        """As every `Method`; its results have the values of the quantities that it serves, by their names."""

    def resolutions(self, target: Target) -> tuple[Resolution, ...]:
        """Those that are offered, the cheapest first."""
        return (Resolution(),)

    def shape(self, target: Target) -> float:
        """What its error is expected to go with; the calibration measures how many times that it is."""
        return 1.0

    def left_out(self, target: Target, value: FloatArray) -> float:
        """Error of the model that shows in its result alone."""
        return 0.0


class GridModel(Model):
    """Boundary elements, whose solves on other grids tell what a grid leaves: the reference of all other models."""

    name: ClassVar = "boundary elements"
    setting: ClassVar = "on a grid"
    element: ClassVar = "cells"
    charted: ClassVar = False

    @abstractmethod
    def label(self, resolution: Resolution) -> str: ...

    @abstractmethod
    def sampling(self, target: Target) -> Sampling:
        """How many realisations."""

    @abstractmethod
    def references(self, target: Target, resolution: Resolution) -> tuple[Resolution, ...]:
        """The grids that this one is compared with."""

    @abstractmethod
    def grid_error(
        self, target: Target, resolution: Resolution, values: FloatArray, others: FloatArray
    ) -> tuple[float, str]:
        """Relative half-width of 95 %, infinite where grids do not converge, and what it rests on.

        values: (realisations, numbers); others: the first of them on the grids of `references`, grids first.
        """


def models_serving(scene: Any, quantity: str) -> tuple[Model, ...]:
    """All models in `simulation/models` that have this quantity of the scene."""
    return tuple(model for model in all_models() if model.serves(scene, quantity))


def all_models() -> tuple[Model, ...]:
    """In the order of the names of their modules."""
    found = (import_module(f"{models.__name__}.{module.name}") for module in iter_modules(models.__path__))
    return tuple(module.MODEL for module in found)
