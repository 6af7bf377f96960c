"""The names that a case is declared with, each from where it is defined.

A module that defines a solve, or the class of a problem, does not import them from here: all that it imports is a part
of the keys of its stored results.
"""

from validation.analysis.case import Case, Chapter, Outcomes, Study
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim
from validation.analysis.quantity import Quantity
from validation.analysis.series import Series
from validation.engine.engine import SERIAL, Engine

__all__ = [
    "SERIAL",
    "Case",
    "Chapter",
    "Chart",
    "Claim",
    "Curve",
    "Engine",
    "Outcomes",
    "Panel",
    "Quantity",
    "Series",
    "Study",
]
