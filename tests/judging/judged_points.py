"""What a function is judged to be, in this process, point by point."""

import itertools
from pkgutil import resolve_name
from types import SimpleNamespace
from unittest import mock

from validation.analysis.evidence import Verdict
from validation.judging.kinds import stiffness
from validation.judging.kinds.judge import JUDGES
from validation.judging.registry import offer
from validation.judging.worker import Called

WITHIN, OUTSIDE, INCONCLUSIVE, NOT_SERVED, NO_RESULT = Verdict
SWEEPS, SCALING = "properties:swept", "properties:judged_scaling"


def judged(kind, function, tolerance=0.1, by=None):
    """By the judge of the kind, by rules of scaling, or past its scenes; by a clock on which nothing takes long."""
    model = Called(offer(kind, "mine", {}, getattr(function, "function", function)))
    judge = resolve_name(f"validation.judging.kinds.{by or JUDGES[kind]}")
    clock = SimpleNamespace(perf_counter=itertools.count(0.0, 1e-9).__next__)
    with mock.patch.object(stiffness, "time", clock):
        return [one.judged(tolerance) for one in judge(model)]


def of(points, quantity, **where):
    """Those of a quantity under these conditions."""
    return [p for p in points if p.quantity == quantity and where.items() <= p.where.items()]


def verdicts(points, quantity, **where):
    return {p.verdict for p in of(points, quantity, **where)}
