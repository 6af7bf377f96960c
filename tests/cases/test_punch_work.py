"""What a punch costs, counted."""

import numpy as np
import pytest

from validation.cases.punch.work import Worked


def test_work_counts_loads_alike():
    """Four surfaces under a light load and one under a heavy one: two loads, not five contacts."""
    light, heavy = np.full(4, 0.5), np.array([20.0, np.nan, np.nan, np.nan])
    applications = np.stack([light, heavy], axis=1)
    outcome = {"applications": applications, "frozen applications": np.zeros_like(applications)}
    assert Worked.of(64, 2048, [outcome]).applications == pytest.approx(10.25)
