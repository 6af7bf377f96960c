"""How long cases take, by `durations.toml`: for the time that is left, and for what help and pages say."""

import tomllib
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from statistics import fmean
from typing import Literal

PROFILES = ("quick", "full")
TIMED = ("precision", "race")
"""Alone, and one after the other."""


@cache
def seconds_of(profile: Literal["quick", "full"]) -> Mapping[str, float]:
    """Seconds of work of one core: of each case, and of all figures."""
    rows = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
    return {name: float(both[PROFILES.index(profile)]) for name, both in rows.items()}


def duration_text(profile: Literal["quick", "full"], names: Iterable[str], cores: int = 1) -> str:
    """In two digits: "about 20 seconds", "about 13 minutes"; what is timed takes one core, whatever there is."""
    seconds = seconds_of(profile)
    mean = fmean(seconds.values())  # of a case that is not there
    total = sum(seconds.get(name, mean) / (1 if name in TIMED else cores) for name in names)
    for unit, size in (("hour", 3600), ("minute", 60)):
        if total >= 1.5 * size:
            return f"about {float(f'{total / size:.2g}'):g} {unit}s"
    return f"about {float(f'{total:.1g}'):g} seconds"
