"""A contact model in one file of `simulation/models`: found there, it is in `compare`, on the charts, in the race."""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from importlib import import_module
from pkgutil import iter_modules
from typing import Any, ClassVar

from validation.simulation import models
from validation.simulation.method import Prepared, Resolution


@dataclass(frozen=True, kw_only=True)
class ErrorEstimate:
    """The error that a model expects, before it has computed anything.

    error: relative half-width of 95 %, infinite where none is known; reason: the conditions that this rests on, with
    their numbers.
    """

    error: float
    reason: str

    @classmethod
    def out_of_range(cls, reason: str) -> "ErrorEstimate":
        """None: the scene is not of those on which the error was measured, or the model cannot serve it at all."""
        return cls(error=math.inf, reason=reason)

    @property
    def in_range(self) -> bool:
        """Whether there is one."""
        return math.isfinite(self.error)


@dataclass(frozen=True, kw_only=True)
class Cost:
    """work: operations, expected or counted; unit: of them; seconds: what those take on one core, about."""

    work: float
    unit: str
    seconds: float


class Model(ABC):
    """A method with an estimate of its error and of its cost. A module of `simulation/models` holds one as `MODEL`.

    name: for tables and figures; setting: its resolution or its formula, in words.
    """

    name: ClassVar[str]
    setting: ClassVar[str]

    @abstractmethod
    def serves(self, scene: Any, quantity: str) -> bool:
        """Whether it has this quantity of such scenes."""

    @abstractmethod
    def estimate(self, scene: Any) -> ErrorEstimate:
        """The error that it expects of a scene that it serves."""

    @abstractmethod
    def cost(self, scene: Any) -> Cost:
        """What a solve is expected to cost."""

    @abstractmethod
    def prepare(self, scene: Any, resolution: Resolution) -> Prepared:
        """As every `Method`; its results have the values of the quantities that it serves, by their names."""


def models_serving(scene: Any, quantity: str) -> tuple[Model, ...]:
    """All models in `simulation/models` that have this quantity of the scene."""
    return tuple(model for model in all_models() if model.serves(scene, quantity))


def all_models() -> tuple[Model, ...]:
    """In the order of the names of their modules."""
    found = (import_module(f"{models.__name__}.{module.name}") for module in iter_modules(models.__path__))
    return tuple(module.MODEL for module in found)
