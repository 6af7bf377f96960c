"""What a function is judged to be, in this process, point by point."""

from pkgutil import resolve_name

from validation.engine.offered import offer
from validation.engine.others import Called
from validation.selection.judging.judge import JUDGES

SWEEPS = "sweeps:swept"


def judged(kind, function, tolerance=0.1, by=None):
    """By the judge of the kind, or past its scenes."""
    model = Called(offer(kind, "mine", {}, getattr(function, "function", function)))
    judge = resolve_name(f"validation.selection.judging.{by or JUDGES[kind]}")
    return [one.judged(tolerance) for one in judge(model)]


def of(points, quantity, **where):
    """Those of a quantity under these conditions."""
    return [p for p in points if p.quantity == quantity and where.items() <= p.where.items()]


def verdicts(points, quantity, **where):
    return {p.verdict for p in of(points, quantity, **where)}
