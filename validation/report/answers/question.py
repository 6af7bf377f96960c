"""A question of the first screen: which numbers answer it, and what else to take."""

from collections.abc import Callable
from dataclasses import dataclass

from validation.report.answers.seconds import Timed
from validation.report.answers.strip import Source

INTEGRAL = "an integral over the spectrum"
"""What linear models cost, in words."""
CONTACT, SPRINGS, BEM = "roughness and contact", "springs, Geike's rule", "boundary elements"
Printed = Callable[[float], str]
"""From the difference of a number in decibels to a text with its unit."""


@dataclass(frozen=True)
class Alternative:
    """What could be taken in the place of MDR; without a source it is what the others are judged by.

    cost: in words; timed: its seconds, of the evidence of `precision`; by: what its margin is of, where that is not the
    quantity of the question.
    """

    name: str
    source: Source | None = None
    cost: str = ""
    timed: Timed | None = None
    by: str = ""


@dataclass(frozen=True)
class Question:
    """A row of the first screen.

    asks: without "is MDR enough?"; source: its numbers; printed: their differences; instead: the cheapest first; model:
    what stands for MDR; of_scene: a table and the column of it that says what else the numbers were measured for.
    """

    name: str
    asks: str
    source: Source
    printed: Printed
    instead: tuple[Alternative, ...]
    model: str = SPRINGS
    of_scene: tuple[str, str] | None = None
