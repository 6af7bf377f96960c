"""Cases that a report keeps from the one before: read back from its results and the files beside them."""

import json
from collections.abc import Collection, Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

from validation.analysis.case import Profile
from validation.analysis.contents import csv_name, from_csv
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Role, Table, Verdict, VerdictCell, Whose
from validation.analysis.quantity import quantity_with
from validation.analysis.spectra import Sound, Sounds
from validation.engine.files import name_in, place_in
from validation.engine.former_names import value_of
from validation.report.contents import CASES, TIMED
from validation.report.folder import RESULTS, SOUNDS
from validation.report.section import WORDS, Section

PROVENANCE = "provenance.json"
DATA = "data"


def kept_sections(folder: Path, profile: Profile, regenerated: Collection[str]) -> list[Section]:
    """All cases of the report in folder but those that are made anew and those that the project no longer has.

    Raises ValueError for a folder without a report, a report in the other size or of a scene of the user's own, and one
    that does not hold all that its page says.
    """
    if not (folder / RESULTS).exists():
        raise ValueError(f"--keep needs an earlier report in --out, got {folder} without {RESULTS}")
    results = _read_json(folder / RESULTS)
    if "scene" in results:
        raise ValueError(f"--keep is for reports on the scenes of the cases, got one on a scene of your own: {folder}")
    if results["profile"] != profile:
        raise ValueError(f"--keep needs the profile of the report in {folder}, {results['profile']}, got {profile}")
    cases = dict(results["cases"])
    for name in TIMED:
        if (folder / f"{name}.json").exists():
            cases |= _read_json(folder / f"{name}.json")["cases"]
    return [
        _section(folder, name, case)
        for name, case in cases.items()
        if name in CASES | TIMED and name not in regenerated
    ]


def kept_provenance(folder: Path) -> dict[str, Any]:
    """What the report in folder says of how it was made."""
    return _read_json(folder / PROVENANCE)


def _read_json(path: Path) -> dict[str, Any]:
    return dict(json.loads(path.read_text(encoding="utf-8")))


def _section(folder: Path, name: str, case: Mapping[str, Any]) -> Section:
    try:
        evidence = _evidence(folder, name, case) if "tables" in case else None
    except KeyError as missing:
        raise ValueError(f"--keep cannot keep {name}: {missing} is not among its results; make it anew") from None
    failure = () if evidence else tuple(case["unconverged"])
    # no name of a case has a hyphen
    files = [*sorted((folder / DATA).glob(f"{name}-*.csv")), *sorted((folder / SOUNDS).glob(f"{name}-*.wav"))]
    held = {name_in(folder, file): file.read_bytes() for file in files}
    return Section(
        name,
        (CASES | TIMED)[name],
        value_of(case, "model_needed", "model needed"),
        case["settings"],
        evidence,
        failure,
        held,
    )


def _evidence(folder: Path, name: str, case: Mapping[str, Any]) -> Evidence:
    numbers = {number["label"]: _number(number) for number in case["numbers"]}
    sounds = case["sounds"]
    tables = [quantity_with(table) for table in case["tables"]]
    paths = {table: place_in(folder / DATA, csv_name(name, table)) for table in tables}
    return Evidence(
        **{word: case[word] for word in WORDS},
        numbers=tuple(numbers.values()),
        tables=tuple(from_csv(table, path.read_text(encoding="utf-8")) for table, path in paths.items()),
        conclusions=tuple(case["conclusions"]),
        unconverged=tuple(case["unconverged"]),
        page_tables=tuple(
            Table(table["name"], {name: list(map(_read_cell, cells)) for name, cells in table["columns"].items()})
            for table in value_of(case, "page_tables", "page tables")
        ),
        claims=tuple(_claim(name, claim, numbers) for claim in case["claims"]),
        sounds=Sounds(**{**sounds, "tracks": tuple(Sound(**track) for track in sounds["tracks"])}) if sounds else None,
    )


def _number(entry: Mapping[str, Any]) -> Number:
    """A number from its entry in results.json. Raises KeyError for a missing field, ValueError for an unknown role."""
    fields_of_number = {field.name: entry[field.name] for field in fields(Number)}
    fields_of_number["quantity"] = quantity_with(entry["quantity"])
    where = {name: tuple(place) if isinstance(place, list) else place for name, place in entry["where"].items()}
    return Number(**{**fields_of_number, "where": where, "role": Role(entry["role"])})


def _claim(case: str, entry: Mapping[str, Any], numbers: Mapping[str, Number]) -> JudgedClaim:
    tested, inside = (tuple(numbers[label] for label in entry[of]) for of in ("numbers", "inside"))
    words = {name: entry[name] for name in ("claim", "answer", "limits")}
    origin, confirmed_by = (
        Whose(entry.get("stated_by") or entry.get("whose", Whose.HYPOTHESIS)),
        Verdict(value_of(entry, "confirmed_by", "confirmed by")),
    )
    key = entry.get("key") or _key_of(case, entry["claim"])
    return JudgedClaim(**words, numbers=tested, inside=inside, confirmed_by=confirmed_by, whose=origin, key=key)


def _key_of(case: str, words: str) -> str:
    """Of a claim in a report from before claims had keys: that of the declared one with its words, up to a setting."""
    declared = (CASES | TIMED)[case].study.claims
    return next((claim.key for claim in declared if words.startswith(claim.says.partition("{")[0])), "")


def _read_cell(cell: Any) -> object:
    return VerdictCell(cell["text"], Verdict(cell["verdict"]), cell["after"]) if isinstance(cell, dict) else cell
