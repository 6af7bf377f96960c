"""Springs under a rolling wheel, over linear theory on the same tracks, times what linear theory expects."""

import numpy as np

from validation.simulation.method import Resolution, Result
from validation.simulation.model import Cost, Target
from validation.simulation.model_names import SPRINGS
from validation.simulation.rolling_claims import FORCE_RMS, NODE, RollingClaim
from validation.simulation.rolling_levels import RollingGrid, on_springs, springs_to_a_radius

TRACKS = 60
MOST_ON_TRACKS = 2**27
"""Springs that are drawn at once at the most, which take up to four gigabytes."""
SPRING = 6.0e-7
"""Seconds that a position on springs takes, about."""


def positions(target: Target, resolution: Resolution) -> Cost:
    """Of all tracks, and what linear theory expects."""
    work = TRACKS * RollingGrid.of(target.rolling, 1).along * resolution.size
    nodes = 0 if target.quantity == FORCE_RMS else target.rolling.nodes
    return Cost(work=work, seconds=SPRING * work + NODE * nodes)


ON_TRACKS = RollingClaim(
    bands=(0.0, 0.6, 0.45),
    rms=(1.0, 0.1, 0.002),
    moving=(0.5, 0.0, 0.06, 0.02),
    on_bands="springs have the right level only in the mean over bands",
    sample=10,
    size=lambda target, resolution: positions(target, resolution).work,
    most=MOST_ON_TRACKS,
    too_large=f"{TRACKS} tracks need {{:.2g}} springs",
)


@ON_TRACKS.model(
    name=SPRINGS,
    setting=f"{TRACKS} tracks",
    resolutions=lambda target: (Resolution(size=springs_to_a_radius(target.rolling)),),
    cost=positions,
    charted=False,
    is_mdr=True,
)
def springs(target: Target, resolution: Resolution) -> Result:
    """One-sided springs: the mean of logarithms over tracks."""
    expected = target.rolling.expected(one_dimensional=target.quantity == FORCE_RMS)
    change = on_springs(target.rolling, TRACKS, target.seed)
    failed = "" if np.isfinite(change).all() else "a wheel lifted off farther than the sums are exact for"
    return Result({target.quantity: expected * np.exp(change)}, count=len(change), failed=failed)
