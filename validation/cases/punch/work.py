"""What a punch costs, counted: operator applications of boundary elements, springs of the 1D model."""

from collections.abc import Iterable

import numpy as np

from validation.analysis.evidence import Table
from validation.engine.engine import Outcome

WORK, CELLS, SPRINGS = "work", "cells on a side", "springs of a profile"
APPLICATIONS = "operator applications a load"


def worked(cells: int, springs: int, outcomes: Iterable[Outcome]) -> Table:
    """A contact with its stiffness on so many cells a side: the mean over loads, each the mean of what it took.

    outcomes: a row a surface and a column a load, NaN where a surface was not pressed: light loads have more.
    """
    found = [outcome["applications"] + outcome["frozen applications"] for outcome in outcomes]
    mean_of_loads = float(np.nanmean(np.concatenate([np.nanmean(values, axis=0) for values in found])))
    return Table(WORK, {CELLS: [cells], SPRINGS: [springs], APPLICATIONS: [mean_of_loads]})
