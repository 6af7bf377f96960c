"""Numbers, claims and columns of cases at quick size, as JSON, and what differs between two such files.

python .ci/same_numbers.py write FOLDER [CASE ...]      without stored solves; timed cases where they are named
python .ci/same_numbers.py compare OLD NEW [CASE ...]   exit status 1 where numbers differ by more than 1e-12, claims,
                                                        or a case, a number or a claim is gone
Numbers are found by the key of their quantity, their model and conditions, and claims by their keys: labels may change.
`OLD/labels.json` maps texts of models and claims that were worded anew to today's.
"""

import json
import math
import pickle
import sys
import time
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from validation.analysis.contents import plain_name

FIELDS = ("value", "reference", "tolerance", "grid", "sample")
WORDS = ("unit", "source", "reason", "role", "verdict")
NEAR = 1e-12


def write(folder: Path, names: list[str]) -> None:
    """A file a case, `NAME.json`; beside it its evidence, pickled, for figures."""
    from validation.engine.engine import Engine
    from validation.report.contents import CASES, TIMED

    folder.mkdir(parents=True, exist_ok=True)
    for name in names or list(CASES):
        case = (CASES | TIMED)[name]
        begin = time.perf_counter()
        evidence = case.evidence(case.run(case.quick, Engine(workers=2)))
        numbers = [
            {
                "label": n.label,
                "key": getattr(n.quantity, "key", ""),
                **asdict(n),
                "unit": n.unit,
                "role": str(n.role),
                "verdict": str(n.verdict),
            }
            for n in evidence.numbers
        ]
        claims = [
            {
                "key": getattr(c, "key", ""),
                "claim": c.claim,
                "status": str(c.status),
                "answer": c.answer,
                "limits": c.limits,
            }
            | {"members": sorted(n.label for n in c.numbers), "inside": sorted(n.label for n in c.inside)}
            for c in evidence.claims
        ]
        columns = {f"{t.name} | {key}": list(map(plain, t[key].tolist())) for t in evidence.tables for key in t.columns}
        text = json.dumps(
            {"numbers": numbers, "claims": claims, "columns": columns, "unconverged": list(evidence.unconverged)},
            default=str,
        )
        (folder / f"{name}.json").write_text(text, encoding="utf-8")
        (folder / f"{name}.pickle").write_bytes(pickle.dumps(evidence))
        print(f"{name}: {len(numbers)} numbers, {len(claims)} claims, {time.perf_counter() - begin:.1f} s", flush=True)


def plain(cell: Any) -> Any:
    """As JSON has it."""
    return None if isinstance(cell, float) and not math.isfinite(cell) else cell


def compare(old: Path, new: Path, names: list[str]) -> bool:
    """Whether all that the old one has is there and equal."""
    labels = old / "labels.json"
    anew = json.loads(labels.read_text(encoding="utf-8")) if labels.exists() else {}
    cases = [path.stem for path in sorted(old.glob("*.json")) if path != labels and path.stem in (names or [path.stem])]
    gone = [
        name for name in (names or cases) if not (old / f"{name}.json").exists() or not (new / f"{name}.json").exists()
    ]
    for name in gone:
        print(f"{name}: no such case in one of the folders")
    equal = not gone and bool(cases)
    for name in cases:
        if name not in gone:
            was, now = (json.loads((folder / f"{name}.json").read_text(encoding="utf-8")) for folder in (old, new))
            equal &= _case(name, was, now, anew)
    return equal


def _key(number: dict[str, Any], anew: dict[str, str]) -> str:
    """Of its quantity, its model and conditions."""
    quantity = number.get("key") or plain_name(number["quantity"])
    return f"{quantity} | {anew.get(number['model'], number['model'])} | {json.dumps(number['where'], sort_keys=True)}"


def _claims(case: dict[str, Any], other: dict[str, Any], anew: dict[str, str]) -> dict[str, dict[str, Any]]:
    """By their keys where both have them, else by their words."""
    by_key = all(claim.get("key") for one in (case, other) for claim in one["claims"])
    return {claim["key"] if by_key else anew.get(claim["claim"], claim["claim"]): claim for claim in case["claims"]}


def _case(name: str, was: dict[str, Any], now: dict[str, Any], anew: dict[str, str]) -> bool:
    mine, theirs = ({_key(n, anew): n for n in one["numbers"]} for one in (now, was))
    worst, said = 0.0, []
    for label in theirs.keys() & mine.keys():
        for field in FIELDS:
            x, y = theirs[label][field], mine[label][field]
            off = abs(x - y) / max(abs(x), abs(theirs[label]["tolerance"]) * 1e-3, 1e-300) if x != y else 0.0
            worst = max(worst, off)
            if off > NEAR:
                said.append(f"  {label}: {field} {x!r} -> {y!r}")
        said += [
            f"  {label}: {f} {theirs[label][f]!r} -> {mine[label][f]!r}"
            for f in WORDS
            if theirs[label][f] != mine[label][f]
        ]
    said += [f"  gone: {label}" for label in theirs if label not in mine]
    said += [f"  new: {label}" for label in mine if label not in theirs]
    labels = {number["label"]: _key(number, anew) for one in (was, now) for number in one["numbers"]}
    old_claims, new_claims = _claims(was, now, anew), _claims(now, was, anew)
    for claim, one in old_claims.items():
        if claim not in new_claims:
            said.append(f"  claim gone: {claim}")
            continue
        for field in ("status", "members", "limits", "inside"):
            of_both = [
                sorted(labels[of] for of in found) if isinstance(found, list) else found
                for found in (one[field], new_claims[claim][field])
            ]
            if of_both[0] != of_both[1]:
                said.append(f"  claim {claim!r}: {field} {one[field]} -> {new_claims[claim][field]}")
    said += [f"  claim new: {claim}" for claim in new_claims if claim not in old_claims]
    pool = np.sort([x for cells in now["columns"].values() for x in cells if isinstance(x, int | float)] or [math.inf])
    lost = []
    for column, cells in was["columns"].items():
        values = np.array([x for x in cells if isinstance(x, int | float) and not isinstance(x, bool)], dtype=float)
        if values.size and (gone := 1 - np.mean([_has(pool, x) for x in values])):
            lost.append(f"  column {column!r}: {gone:.0%} of {values.size} values in no column")
    print(
        f"{name}: {len(theirs)} numbers, largest relative difference {worst:.1e}, {len(said)} lines of differences, "
        f"{len(lost)} columns have lost values"
    )
    print("\n".join(said + lost), end="\n" if said or lost else "")
    return not said


def _has(pool: np.ndarray, x: float) -> bool:
    i = int(np.searchsorted(pool, x - 1e-9 * abs(x)))
    return i < pool.size and bool(abs(pool[i] - x) <= 1e-9 * abs(x))


if __name__ == "__main__":
    command, *rest = sys.argv[1:]
    if command == "write":
        write(Path(rest[0]), rest[1:])
    else:
        sys.exit(0 if compare(Path(rest[0]), Path(rest[1]), rest[2:]) else 1)
