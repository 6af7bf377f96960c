"""Results and tables as the contents of files: strict JSON, and CSV."""

import csv
import io
import json
import math

from validation.analysis.evidence import Table


def as_json(value: object) -> bytes:
    """Readable, sorted, strict: no NaN, no infinity."""
    return (json.dumps(value, indent=1, sort_keys=True, allow_nan=False, ensure_ascii=False) + "\n").encode()


def as_csv(table: Table) -> bytes:
    """Numbers to ten digits, more than any curve shows; what is not finite is left empty."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(table.columns)
    for row in zip(*table.columns.values(), strict=True):
        writer.writerow(_cell(value) for value in row)
    return text.getvalue().encode()


def _cell(value: object) -> object:
    if not isinstance(value, float):
        return value
    return f"{value:.10g}" if math.isfinite(value) else ""
