"""The scenes that come with this package: a file each, beside this one."""

from pathlib import Path

from validation.scenes.printable import printable

SCENES = Path(__file__).parent


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
