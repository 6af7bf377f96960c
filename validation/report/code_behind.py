"""The code behind the numbers of a case: whether an earlier report has what today's code would make."""

import hashlib
from collections.abc import Collection, Mapping
from dataclasses import asdict
from typing import Any

from validation.analysis.case import Case, Profile
from validation.analysis.claims import listed
from validation.analysis.contents import as_json
from validation.engine.sources import version_of
from validation.report.contents import CASES, TIMED

WORDS = tuple(f"validation.analysis.{name}" for name in ("case", "chart", "claims", "conditions", "printed", "study"))
"""What only words claims and declares charts."""


def version_of_numbers(case: Case, profile: Profile) -> str:
    """Digest of what makes the numbers of a case: its settings, code, and the versions of numpy, scipy and pyfftw.

    The code is that of the modules in which its run, its series and its tables stand, and of all that they import.
    Left out are the engine, the room `report` and `WORDS`; a study in a file of its own where that makes no number.
    """
    study = case.study
    makers = {made_by.__module__ for made_by in (case.run, study.series, study.tables, study.once_more)}
    settings = as_json(asdict(case.settings(profile, None)))
    return hashlib.sha256(version_of(tuple(sorted(makers)), WORDS).encode() + settings).hexdigest()


def versions_of(names: Collection[str], profile: Profile) -> dict[str, str]:
    """The digest of each case."""
    return {name: version_of_numbers((CASES | TIMED)[name], profile) for name in names}


def require_todays_code(about: Mapping[str, Any], today: Mapping[str, str]) -> None:
    """Raises ValueError for a case that is kept from a report with this provenance, and that other code has made.

    today: the digests of the cases that are kept.
    """
    made_by = about.get("code", {})
    if old := [name for name, digest in today.items() if made_by.get(name) != digest]:
        raise ValueError(
            f"--keep keeps what today's code and settings have made; the report does not have that of {listed(old)}: "
            f"make it anew, with --only {' '.join(old)}"
        )
