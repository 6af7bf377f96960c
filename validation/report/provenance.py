"""The provenance of a report: versions, commit, seeds, date, processor and its load; no name of a machine or user."""

import hashlib
import importlib.metadata
import os
import platform
import subprocess
from collections.abc import Collection, Mapping, Sequence
from dataclasses import asdict
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from validation.analysis.case import Case, Profile
from validation.analysis.contents import as_json
from validation.analysis.escapes import printable
from validation.analysis.number_text import enumeration
from validation.engine.engine import LOCAL, Engine
from validation.engine.sources import version_of
from validation.report.contents import CASES, TIMED
from validation.report.section import Section

WORDS = tuple(
    f"validation.analysis.{name}" for name in ("case", "chart", "claim_text", "claims", "number_text", "study")
)
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
            f"--keep keeps what today's code and settings have made; the report does not have that of "
            f"{enumeration(old)}: make it anew, with --only {' '.join(old)}"
        )


ROOT = Path(__file__).parents[2]
LIBRARIES = ("numpy", "scipy", "pyfftw", "matplotlib", "joblib")
PROCESSORS = Path("/proc/cpuinfo")
"""Where Linux lists them, and their models but for some ARM."""


def machine() -> dict[str, object]:
    """What times are measured on, as a run begins: the processor, its cores, their load and the date, UTC.

    load: processes that run or wait for a core, mean over the minute before.
    """
    return {
        "processor": processor(),
        "cores": os.cpu_count(),
        "load": round(os.getloadavg()[0], 2),
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
    }


def provenance(
    profile: str, seeds: dict[str, object], engine: Engine, seconds: dict[str, float], begun: dict[str, object]
) -> dict[str, object]:
    """Plain values for provenance.json: everything about a run that is no result.

    seeds: of the cases that draw; engine: what ran them; seconds: this run took for each case,
    less where it found finished solves; begun: `machine` when it began.
    """
    return {
        "profile": profile,
        "seeds": seeds,
        "workers": engine.workers if engine.executor == LOCAL else "those of a dask scheduler",
        "seconds": {name: round(value, 2) for name, value in seconds.items()},
        "commit": _commit(),
        "kept": {},
        "version": importlib.metadata.version("mdr-validation"),
        "python": platform.python_version(),
        "system": f"{platform.system()} {platform.machine()}",
        **begun,
        "libraries": {name: importlib.metadata.version(name) for name in LIBRARIES},
    }


def processor() -> str:
    """Model of the processor, which times are those of; its architecture where the system names no model."""
    try:
        lines = PROCESSORS.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        lines = []
    models = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return printable("".join(models[:1]) or platform.processor() or platform.machine() or "unknown")


def with_kept(about: dict[str, Any], before: Mapping[str, Any], kept: Sequence[Section]) -> dict[str, Any]:
    """The same with what the provenance before says of the cases that are kept from its report, and their commits."""
    names = [section.name for section in kept]
    of_both = {
        part: {name: before[part][name] for name in before[part] if name in names} | about[part]
        for part in ("seeds", "seconds", "code", "machines")
    }
    return {**about, **of_both, "kept": {name: before["kept"].get(name, before["commit"]) for name in names}}


def kept_from(about: Mapping[str, Any]) -> dict[str, list[str]]:
    """Which cases were kept as made at each commit."""
    kept = about["kept"]
    return {commit: [name for name in kept if kept[name] == commit] for commit in dict.fromkeys(kept.values())}


def _commit() -> str:
    """Commit of the source, with a mark where it has been changed since; "unknown" outside a checkout."""
    if not (ROOT / ".git").exists():
        return "unknown"
    try:
        changed = _git("status", "--porcelain", "--untracked-files=no", "--", ".", ":!reports")
        return _git("rev-parse", "--short", "HEAD") + (", changed since" if changed else "")
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def _git(*words: str) -> str:
    finished = subprocess.run(["git", "-C", str(ROOT), *words], capture_output=True, encoding="utf-8", check=True)
    return finished.stdout.strip()
