"""The scenes that come with this package: a file each, beside this one."""

import re
from pathlib import Path

from validation.scenes.printable import printable

SCENES = Path(__file__).parent

COMMENTED = re.compile(r"^# (\w+ = |\[[\w.]+\]\s)")
"""The beginning of a line that would be one of the scene without its sign."""


def bundled() -> tuple[str, ...]:
    """Names of the scenes that come with this package."""
    return tuple(sorted(path.stem for path in SCENES.glob("*.toml")))


def path_of(scene: str | Path) -> Path:
    """The file of a scene: a path, or, without folder and without ".toml", the name of a shipped one.

    Raises ValueError for a name that none has.
    """
    name = str(scene)
    if name.endswith(".toml") or Path(name).name != name:
        return Path(name)
    if name not in bundled():
        name = printable(name)
        raise ValueError(f'scene must be a file, as "./{name}.toml", or one of {", ".join(bundled())}, got "{name}"')
    return SCENES / f"{name}.toml"


def line_for(key: str) -> str:
    """The line of a shipped scene for a key as "wheel.load", or for a table; empty where none has it.

    Where no scene has the key in this table, one that has it in another. A line of a table in comments counts, too.
    """
    elsewhere, name = "", key.rpartition(".")[2]
    for scene in bundled():
        table = ""
        for line in path_of(scene).read_text(encoding="utf-8").splitlines():
            code = COMMENTED.sub(r"\1", line).partition("  #")[0].strip()
            if code.startswith("["):
                table = f"{code[1:-1]}."
            if code == f"[{key}]" or (code.startswith(f"{name} = ") and f"{table}{name}" == key):
                return code
            if code.startswith(f"{name} = "):
                elsewhere = elsewhere or code
    return elsewhere
