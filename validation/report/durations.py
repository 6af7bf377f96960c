"""How long the cases are expected to take, for the time that a run has left."""

import tomllib
from collections.abc import Sequence
from pathlib import Path

from validation.analysis.case import Profile

TABLE = Path(__file__).with_suffix(".toml")


def expected_seconds(names: Sequence[str], profile: Profile) -> dict[str, float]:
    """Of work of one core, by the table beside this file; a case that is not there is like their mean."""
    known = tomllib.loads(TABLE.read_text(encoding="utf-8"))[profile]
    mean = sum(known.values()) / len(known)
    return {name: known.get(name, mean) for name in names}
