"""Wheels on rails at the edges of what models claim: long and flat ellipses, corrugated rails."""

import numpy as np

from validation.advice.cases.random_scenes import EdgeKind, Generator, log_uniform
from validation.railway.scenes.level_files import MOST, RoughnessLevels, curve
from validation.railway.scenes.rail import CONTACT_FILTER, Across, RailScene

RAIL = "rail"
RADII, CROWNS = (0.15, 0.6), (0.15, 4.0)
"""Of the wheel along the track [m], and of the crown over that: the ellipse is 0.3 to 2.5 times as wide as long."""
WHEEL_LOADS, MODULI = (5e3, 1.5e5), (2e10, 2e11)
"""Of a wheel [N], and E* [Pa]."""
OFFSETS, TILTS, CORRUGATION = (-10.0, 25.0), (-5.0, 5.0), 20.0
"""Of levels over the limit of ISO 3095 [dB]: of all bands, a decade of wavelength, and the most of one band."""
ALPHAS = (0.2, 5.0)
"""Oblique waves, |k_y| < alpha k_x."""


def edge_rail(rng: Generator, name: str) -> RailScene:
    """A wheel on a rail whose ground is stated in one of four ways."""
    radius = log_uniform(rng, RADII)
    stated: tuple[Across, ...] = ("ridges", "isotropic", log_uniform(rng, ALPHAS), None)
    across = stated[int(rng.integers(len(stated)))]
    # isotropic ground has no corrugation along one line alone
    levels = _random_levels(rng, bent=across not in ("isotropic", None))
    return RailScene(
        name=name,
        radius=radius,
        crown_radius=radius * log_uniform(rng, CROWNS),
        load=log_uniform(rng, WHEEL_LOADS),
        modulus=log_uniform(rng, MODULI),
        roughness=levels,
        lateral_structure=across,
    )


def _random_levels(rng: Generator, bent: bool) -> RoughnessLevels:
    """bent: whether the levels are tilted and have a corrugation, its neighbouring bands by half."""
    limit = curve("iso3095-2013")
    numbers = np.array(limit.bands.numbers)
    corrugated = np.clip(1 - np.abs(numbers - rng.choice(numbers)) / 2, 0, None)
    tilt, height = rng.uniform(*TILTS), rng.uniform(0, CORRUGATION)
    raised = rng.uniform(*OFFSETS) + bent * (tilt * (numbers / 10 + 1.5) + height * corrugated)
    levels = tuple(np.minimum(np.array(limit.levels) + raised, MOST).tolist())
    return RoughnessLevels(wavelengths=limit.wavelengths, levels=levels, source="the limit of ISO 3095, changed")


EDGES = EdgeKind(
    RAIL,
    quantity=str(CONTACT_FILTER),
    ranges="rails under ellipses 0.3 to 2.5 times as wide as long, up to 25 dB above the limit of ISO 3095, with "
    "corrugation",
    scene=edge_rail,
)
