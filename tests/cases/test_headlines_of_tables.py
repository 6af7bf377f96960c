"""Titles of figures that are read from tables and charts: planted values, and the words that follow from them."""

import numpy as np

from validation.analysis.evidence import Table
from validation.cases.wheel import spectrum_evidence


def springs(compression):
    """Four inside of Hertz's contact, one at each side of it."""
    x = np.array([-1.1, -0.9, -0.2, 0.2, 0.9, 1.1])
    return Table("springs", {"x / a": x, "compression / d": np.array(compression)})


def test_the_contact_of_a_moment_is_counted_inside_of_that_of_hertz():
    pressure = Table("pressure", {"p / p0": np.array([0.0, np.nan, 1.3])})
    full, half = springs([0.0, 0.1, 1.0, 0.9, 0.2, 0.0]), springs([0.5, 0.0, 1.0, 0.9, 0.0, 0.5])
    titles = [spectrum_evidence._touching([one, pressure])["wheel-contact"] for one in (full, half)]
    assert ["100 % of the springs" in titles[0], "50 % of the springs" in titles[1]] == [True, True]
    assert titles[0].endswith("is 1.30 times Hertz's")
