"""A function of a file, by FILE:NAME, in this process."""

import runpy
import sys
from functools import cache
from pathlib import Path

from validation.judging.registry import KINDS, Offered, offer
from validation.judging.replies import raised


@cache
def named_in(place: str, kind: str) -> Offered:
    """With or without its decorator; the file is run once, and its folder can be imported.

    Raises ValueError where there is none, or where the file raises, in one sentence.
    """
    file, _, name = place.rpartition(":")
    path = Path(file).resolve()
    if not path.is_file():
        raise ValueError(f"a function is named as FILE:NAME, and there is no file {file!r} in {place!r}")
    sys.path.insert(0, str(path.parent))
    try:
        found = runpy.run_path(str(path)).get(name)
    except (Exception, SystemExit) as error:
        raise ValueError(f"{file}: {raised(error, path)}") from None
    if isinstance(found, Offered) and found.kind == kind:
        return found
    if not callable(found) or isinstance(found, Offered):
        raise ValueError(f"{file} has no function {name!r} for @{kind}")
    return offer(kind, name, KINDS[kind].options, found)
