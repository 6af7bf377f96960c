"""The map of validity of rolling: up to which roughness each reduced model follows boundary elements."""

from collections.abc import Sequence
from itertools import takewhile

from validation.analysis.evidence import Number, Verdict
from validation.cases.rolling.reduced_models import BED, LAYER, LINE, LINEAR, READ

ON_MAP = (LAYER, READ, BED, LINEAR, LINE)


def reached(numbers: Sequence[Number], model: str) -> float:
    """The largest h' a/d, along the track, up to which all strips agree, 0 if the smallest does not."""
    mine = sorted((number for number in numbers if number.model == model), key=_slope)
    failing = [_slope(number) for number in mine if number.verdict is not Verdict.AGREE]
    below = takewhile(lambda number: not failing or _slope(number) < failing[0], mine)
    return max(map(_slope, below), default=0.0)


def map_headline(numbers: Sequence[Number]) -> str:
    """The models that follow, the one with the largest range first."""
    found = sorted(((reached(numbers, model), model) for model in ON_MAP), reverse=True)
    parts = [f"{model} to h' a/d = {slope:.2g}" for slope, model in found if slope]
    if not parts:
        return "No reduced model is shown to be within 1 dB of boundary elements"
    return f"Within 1 dB of boundary elements: {', '.join(parts)}"


def _slope(number: Number) -> float:
    slope = number.where["h' a/d"]
    assert isinstance(slope, float)
    return slope
