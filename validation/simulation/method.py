"""One method of a scene: prepare(scene, resolution) gives solve(realisation), and that gives values and counted work.

Model selection adds an estimate of the error, the benchmarks add a clock.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from validation.engine.engine import FloatArray

Values = Mapping[str, FloatArray]
"""By name; where a solve has several realisations, they are along the first axis."""


@dataclass(frozen=True, kw_only=True)
class Resolution:
    """size: cells or springs on a length of the scene; residual: of a solver, zero where there is none."""

    size: float = 1.0
    residual: float = 0.0


@dataclass(frozen=True, eq=False)
class Result:
    """Values of a solve, and its work, which is the same on every machine.

    work: cells times operator applications, springs evaluated, points filtered; NaN where it is not counted;
    count: realisations in this solve; failed: why its values are none, empty where they are.
    """

    values: Values
    work: float = math.nan
    count: int = 1
    failed: str = ""


@dataclass(frozen=True, eq=False)
class Solve:
    """One realisation, ready to be solved.

    run: the solve itself, which a clock may time; read: its Result, which is not timed; repeatable: whether a second
    run takes as long as the first.
    """

    run: Callable[[], Any]
    read: Callable[[Any], Result]
    repeatable: bool = True

    def __call__(self) -> Result:
        return self.read(self.run())


Prepared = Callable[[int], Solve]
"""From the number of a realisation to its solve, from a cold start."""


class Method(Protocol):
    """A frozen dataclass; what it needs to know of a scene, the scene gives."""

    @property
    def name(self) -> str:
        """For tables and figures."""

    def prepare(self, scene: Any, resolution: Resolution) -> Prepared:
        """Set-up, once for all realisations. Raises ValueError where the scene is out of range."""
