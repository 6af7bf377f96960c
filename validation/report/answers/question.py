"""A question of the first screen: its numbers, and what could be taken in the place of MDR."""

from collections.abc import Callable
from dataclasses import dataclass

from validation.analysis.evidence import Evidence
from validation.report.answers.cells import NumberSource
from validation.report.answers.words import Printed
from validation.report.section import Section


@dataclass(frozen=True, kw_only=True)
class ModelCost:
    """What a model costs, counted in a case: of its evidence a text."""

    case: str
    text: Callable[[Evidence], str]


@dataclass(frozen=True, kw_only=True)
class AlternativeModel:
    """What could be taken in the place of MDR; without a source it is what the others are judged by.

    by: what its margin is of, where that is not the quantity of the question; axis: where it is not that of the
    question.
    """

    name: str
    cost: ModelCost
    by: str = ""
    axis: str = ""
    source: NumberSource | None = None


@dataclass(frozen=True, kw_only=True)
class Question:
    """A row of the first screen.

    asks: without "is MDR enough?"; axis: the number that decides, as it is printed; model: what stands for MDR;
    source: its numbers; printed: their differences; alternatives: the cheapest first; told: conditions of the
    numbers beside those of their series; of_scene: what else they were measured for.
    """

    name: str
    asks: str
    axis: str
    model: str
    source: NumberSource
    printed: Printed
    alternatives: tuple[AlternativeModel, ...]
    told: tuple[str, ...] = ()
    of_scene: Callable[[Section], str] = lambda section: ""
