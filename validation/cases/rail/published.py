"""The published contact filter of the field, CNOSSOS-EU: an overlay, which knows nothing of a scene."""

import csv
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

TABLE = Path(__file__).with_name("cnossos_a3_2021.csv")
SOURCE = "CNOSSOS-EU, Table G-2 in the edition of (EU) 2021/1226"
FOLLOWED = -13.0
"""dB: below, the table is no linear filter."""
LEAST = -0.1
"""dB: above, the table is rounded to nothing."""


class RailWheel(NamedTuple):
    """A column of the table: load of one wheel [kN] and diameter [mm]."""

    load: float
    diameter: float

    @property
    def label(self) -> str:
        return f"{self.load:g} kN, {self.diameter:g} mm"


MASKED = {(RailWheel(50, 920), 40.0)}
"""-1.3 dB in all transcriptions, where its neighbours -1.1 and -3.5 suggest -2.1: perhaps a misprint."""


@cache
def columns_of_table() -> dict[RailWheel, dict[float, float]]:
    """A3 [dB] by wheel and nominal wavelength [mm]."""
    found: dict[RailWheel, dict[float, float]] = {}
    with TABLE.open() as lines:
        for row in csv.DictReader(line for line in lines if not line.startswith("#")):
            wheel = RailWheel(float(row["wheel_load_kN"]), float(row["wheel_diameter_mm"]))
            found.setdefault(wheel, {})[float(row["wavelength_mm"])] = float(row["a3_dB"])
    return found


def a3_of_table(wheel: RailWheel) -> NDArray[np.float64]:
    """From 2000 to 0.8 mm [dB]."""
    return np.array(list(columns_of_table()[wheel].values()))


def compared(wheel: RailWheel) -> NDArray[np.bool_]:
    """The wavelengths at which a filter is compared with the table: -13 to -0.1 dB, and none that is masked."""
    return np.array(
        [FOLLOWED <= a3 <= LEAST and (wheel, mm) not in MASKED for mm, a3 in columns_of_table()[wheel].items()]
    )
