"""The value of a sweep: a number with its unit where all values are numbers, else a text."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from validation.scenes.units import UNITS, quantity

NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S*)\s*")


@dataclass(frozen=True)
class Swept:
    """One value of a key of a scene file. value: in ``unit``, or a text; scene: name of the scene that is varied."""

    key: str
    value: float | str
    unit: str
    scene: str

    @property
    def label(self) -> str:
        """As "wheel.load [kN]"."""
        return f"{self.key} [{self.unit}]" if self.unit else self.key


def swept_values(key: str, texts: Sequence[str], scene: str) -> list[Swept]:
    """Of texts as in a scene file, all in the unit of the first; as texts where one of them is no number."""
    found = [NUMBER.fullmatch(text) for text in texts]
    numbers = [(float(match[1]), match[2]) for match in found if match]
    units = {unit for _, unit in numbers}
    if len(numbers) == len(texts) and len(units) == 1:
        return [Swept(key, number, unit, scene) for number, unit in numbers]
    for dimension, known in UNITS.items():
        if len(numbers) == len(texts) and units <= set(known):
            unit = numbers[0][1]
            one = quantity(key, f"1 {unit}", dimension)
            return [Swept(key, float(f"{quantity(key, t, dimension) / one:.12g}"), unit, scene) for t in texts]
    return [Swept(key, text, "", scene) for text in texts]
