"""Models of a scene by the names that a user gives: mdr, bem, a full name, or its beginning."""

from collections.abc import Callable, Collection, Sequence
from pkgutil import resolve_name
from typing import Any, Protocol, SupportsIndex, TypeVar, overload, runtime_checkable

from validation.advice.hierarchy import Candidate
from validation.advice.scene_model import SceneModel
from validation.engine.street import places
from validation.scenes.printable import quoted
from validation.scenes.scene import Scene
from validation.simulation.method import Resolution
from validation.simulation.model import Model, Target
from validation.simulation.model_names import SHORT

T = TypeVar("T", SceneModel, Candidate)


def named(items: Sequence[T], name: str) -> list[T]:
    """Those that a name stands for: springs by MDR, all grids of a kind, or the ones whose name is or begins so."""
    asked = _asked(name)
    rules: list[Callable[[T], bool]] = [
        lambda one: one.name.lower() == asked,
        lambda one: asked == "mdr" and one.is_mdr,
        lambda one: one.kind.lower() == asked,
        lambda one: asked != "" and one.name.lower().startswith(asked),
    ]
    return next((found for rule in rules if (found := [one for one in items if rule(one)])), [])


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
    found, asked = named(models, name), _asked(name)
    if not found:
        known = ", ".join(quoted(model.name) for model in models)
        raise ValueError(f"models must be mdr, bem or names of models of this scene, {known}, got {quoted(name)}")
    if len(found) == 1 or asked == "mdr":
        return found
    if any(model.kind.lower() != asked for model in found):
        several = ", ".join(quoted(model.name) for model in found)
        raise ValueError(f"models: {quoted(name)} begins {len(found)} names, {several}")
    claiming = [grid for grid in found if grid.estimate().error <= tolerance]
    return claiming[:1] or found[-1:]


def _asked(name: str) -> str:
    asked = name.strip().lower()
    return SHORT.get(asked, asked)


class ComparedModels(tuple[Candidate, ...]):
    """All models, the cheapest first; a text stands for the one that it names."""

    __slots__ = ()

    @overload
    def __getitem__(self, which: str | SupportsIndex) -> Candidate: ...
    @overload
    def __getitem__(self, which: slice) -> tuple[Candidate, ...]: ...
    def __getitem__(self, which: str | SupportsIndex | slice) -> Candidate | tuple[Candidate, ...]:
        """Raises KeyError for a name that none has, or several."""
        if not isinstance(which, str):
            return super().__getitem__(which)
        found = named(self, which)
        if len(found) != 1:
            known = ", ".join(quoted(one.name) for one in found or self)
            raise KeyError(f"models must be named by one of {known}, got {quoted(which)}")
        return found[0]


@runtime_checkable
class Decorated(Protocol):
    """A function with one of the decorators of the face, as `stiffness_model`."""

    @property
    def name(self) -> str: ...
    @property
    def kind(self) -> str: ...
    def __call__(self, *arguments: Any, **named: Any) -> Any: ...


class Own(Protocol):
    """What `own_models` makes of a function; serves: in words."""

    @property
    def name(self) -> str: ...
    @property
    def serves(self) -> str: ...
    def model(self) -> Model: ...


def names_and_own(
    models: str | Decorated | Sequence[str | Decorated] | None, scene: Scene, quantity: str
) -> tuple[Sequence[str], tuple[Own, ...]]:
    """Names of all that are asked, and functions as models; none for None.

    Raises ValueError for what is no list, or an empty one, and for a name that two functions have.
    """
    if models is None or isinstance(models, str):
        return () if models is None else models or ("",), ()
    asked = [models] if isinstance(models, Decorated) else models
    if not isinstance(asked, Collection) or len(asked) == 0:
        raise ValueError(f"models must be names, functions with a decorator, or left out for all, got {quoted(asked)}")
    functions = [one for one in asked if isinstance(one, Decorated)]
    names = [one.name for one in functions]
    if twice := next((name for name in names if names.count(name) > 1), ""):
        raise ValueError(f"two functions are offered as {twice!r}")
    own: tuple[Own, ...] = ()
    if functions:
        # not `brought`: what is stored of scenes without such models is not keyed by their code
        (place,) = places("models_of_functions")
        own = resolve_name(place)(functions, scene, quantity)
    return tuple(one.name if isinstance(one, Decorated) else one for one in asked), own


def own_candidates(own: Sequence[Own], target: Target, others: Sequence[SceneModel]) -> list[SceneModel]:
    """Those that serve the scene. ValueError where none does, and for a name that another model has."""
    taken = {name.lower() for one in others for name in (one.name, one.kind)} | {"mdr", *SHORT}
    if same := [one.name for one in own if one.name.lower() in taken]:
        raise ValueError(f"a model of your own must have a name that no other has, got {quoted(same[0])}")
    found = [model for one in own if (model := one.model()).serves(target.scene, target.quantity)]
    if own and not found:
        served = "; ".join(one.serves for one in own)
        raise ValueError(f"no model of your own has {target.quantity} of scene {target.scene.name!r}: {served}")
    return [SceneModel(model, target, Resolution()) for model in found]
