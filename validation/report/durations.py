"""How long the cases are expected to take, for the time that a run has left."""

import statistics
import tomllib
from collections.abc import Sequence
from pathlib import Path

from validation.analysis.case import Profile

TABLE = Path(__file__).with_suffix(".toml")


def expected_seconds(names: Sequence[str], profile: Profile) -> dict[str, float]:
    """Of work of one core, by the table beside this file; a case that is not there is like their mean."""
    rows = tomllib.loads(TABLE.read_text(encoding="utf-8"))
    known = {name: quick if profile == "quick" else full for name, (quick, full) in rows.items()}
    return {name: known.get(name, statistics.fmean(known.values())) for name in names}
