"""Cases that a report keeps from the one before: read back from its results and the files beside them."""

import json
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

from validation.analysis.case import Profile
from validation.analysis.contents import csv_name, from_csv
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Role, Table, Verdict, VerdictCell
from validation.analysis.sound import Sound, Sounds
from validation.report.contents import CASES, TIMED
from validation.report.folder import RESULTS, SOUNDS
from validation.report.section import Section

PROVENANCE = "provenance.json"
DATA = "data"


def kept_sections(folder: Path, profile: Profile, anew: Collection[str]) -> list[Section]:
    """All cases of the report in folder but those that are made anew and those that the project no longer has.

    Raises ValueError for a folder without a report, a report in the other size or of a scene of the user's own, and one
    that does not hold all that its page says.
    """
    found = _results(folder / RESULTS)
    if "scene" in found:
        raise ValueError(f"--keep is for reports on the scenes of the cases, got one on a scene of your own: {folder}")
    if found["profile"] != profile:
        raise ValueError(f"--keep needs the profile of the report in {folder}, {found['profile']}, got {profile}")
    cases = dict(found["cases"])
    for name in TIMED:
        if (folder / f"{name}.json").exists():
            cases |= _results(folder / f"{name}.json")["cases"]
    return [_section(folder, name, case) for name, case in cases.items() if name in CASES | TIMED and name not in anew]


def kept_provenance(folder: Path) -> dict[str, Any]:
    """What the report in folder says of how it was made."""
    return _read(folder / PROVENANCE)


def _results(path: Path) -> dict[str, Any]:
    if not path.exists():
        raise ValueError(f"--keep needs an earlier report in --out, got {path.parent} without {path.name}")
    return _read(path)


def _read(path: Path) -> dict[str, Any]:
    return dict(json.loads(path.read_text(encoding="utf-8")))


def _section(folder: Path, name: str, case: Mapping[str, Any]) -> Section:
    try:
        evidence = _evidence(folder, name, case) if case["numbers"] else None
    except KeyError as missing:
        raise ValueError(f"--keep cannot keep {name}: {missing} is not among its results; make it anew") from None
    return Section(
        name,
        (CASES | TIMED)[name],
        case["model needed"],
        case["settings"],
        evidence,
        tuple(case["unconverged"]) if evidence is None else (),
        files={file.relative_to(folder).as_posix(): file.read_bytes() for file in _files(folder, name)},
    )


def _files(folder: Path, name: str) -> list[Path]:
    """Data and sounds of a case; no name of a case has a hyphen."""
    return sorted((folder / DATA).glob(f"{name}-*.csv")) + sorted((folder / SOUNDS).glob(f"{name}-*.wav"))


def _evidence(folder: Path, name: str, case: Mapping[str, Any]) -> Evidence:
    numbers = {number["label"]: _number(number) for number in case["numbers"]}
    tables = (
        from_csv(table, (folder / DATA / csv_name(name, table)).read_text(encoding="utf-8")) for table in case["tables"]
    )
    figures = case["figures"]
    return Evidence(
        title=case["title"],
        method=case["method"],
        numbers=tuple(numbers.values()),
        tables=tuple(tables),
        conclusions=tuple(case["conclusions"]),
        captions={figure["name"]: figure["caption"] for figure in figures},
        headlines={figure["name"]: figure["headline"] for figure in figures if figure["headline"]},
        unconverged=tuple(case["unconverged"]),
        page_tables=tuple(_page_table(table) for table in case["page tables"]),
        claims=tuple(_claim(claim, numbers) for claim in case["claims"]),
        finding=case["finding"],
        sounds=_sounds(case["sounds"]) if case["sounds"] else None,
    )


def _number(number: Mapping[str, Any]) -> Number:
    where = {name: tuple(place) if isinstance(place, list) else place for name, place in number["where"].items()}
    names = ("quantity", "model", "value", "reference", "source", "tolerance", "reason", "unit", "grid", "sample")
    return Number(where=where, role=Role(number["role"]), **{name: number[name] for name in names})


def _claim(claim: Mapping[str, Any], numbers: Mapping[str, Number]) -> JudgedClaim:
    return JudgedClaim(
        claim=claim["claim"],
        answer=claim["answer"],
        numbers=tuple(numbers[label] for label in claim["numbers"]),
        confirmed_by=Verdict(claim["confirmed by"]),
        limits=claim["limits"],
        inside=tuple(numbers[label] for label in claim["inside"]),
    )


def _page_table(table: Mapping[str, Any]) -> Table:
    return Table(table["name"], {name: list(map(_cell, cells)) for name, cells in table["columns"].items()})


def _cell(cell: object) -> object:
    if not isinstance(cell, dict):
        return cell
    return VerdictCell(cell["text"], Verdict(cell["verdict"]), cell["after"])


def _sounds(sounds: Mapping[str, Any]) -> Sounds:
    return Sounds(**{**sounds, "tracks": tuple(Sound(**track) for track in sounds["tracks"])})
