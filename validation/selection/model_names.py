"""Models of a scene by the names that a user gives: mdr, bem, a full name, or its beginning."""

from collections.abc import Sequence

from validation.scenes.printable import quoted
from validation.selection.scene_model import SceneModel

BEM = "boundary elements"
"""What bem is short for; mdr are all springs by the method of dimensionality reduction."""


def models_named(models: Sequence[SceneModel], names: Sequence[str], tolerance: float) -> list[SceneModel]:
    """The models of these names, in their order; a text may have several, with commas.

    Of boundary elements without a grid, the cheapest grid that claims the tolerance, or else the last. Raises
    ValueError for a name that no model of the scene has, or that several have.
    """
    if isinstance(names, str):
        names = names_in(names, [model.name for model in models])
    found = [model for name in names for model in _of_name(models, name, tolerance)]
    return [model for model in models if any(model is one for one in found)]


def names_in(text: str, known: Sequence[str]) -> list[str]:
    """The names in a list with commas, some of which have commas themselves: "mdr, linear filter, 1D"."""
    parts, names = [part.strip() for part in text.split(",")], list[str]()
    whole = {name.lower() for name in known}
    while parts:
        ends = [end for end in range(len(parts), 0, -1) if ", ".join(parts[:end]).lower() in whole]
        end = ends[0] if ends else 1
        names.append(", ".join(parts[:end]))
        parts = parts[end:]
    return names


def _of_name(models: Sequence[SceneModel], name: str, tolerance: float) -> list[SceneModel]:
    if not isinstance(name, str):
        raise TypeError(f"models must be names, got {quoted(name)}")
    asked = name.strip().lower()
    asked = BEM if asked == "bem" else asked
    if asked == "mdr":
        found = [model for model in models if model.is_mdr]
    elif exact := [model for model in models if model.name.lower() == asked]:
        found = exact
    elif kind := [model for model in models if model.kind.lower() == asked]:
        found = _cheapest_grid(kind, tolerance)
    else:
        found = [model for model in models if asked and model.name.lower().startswith(asked)]
        if len(found) > 1:
            raise ValueError(f"models: {quoted(name)} begins {len(found)} names, {_names(found)}")
    if not found:
        raise ValueError(
            f"models must be mdr, bem or names of models of this scene, {_names(models)}, got {quoted(name)}"
        )
    return found


def _names(models: Sequence[SceneModel]) -> str:
    return ", ".join(quoted(model.name) for model in models)


def _cheapest_grid(grids: Sequence[SceneModel], tolerance: float) -> list[SceneModel]:
    claiming = [grid for grid in grids if grid.estimate().error <= tolerance]
    return list(claiming[:1] or grids[-1:])
