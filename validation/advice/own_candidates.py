"""Models of somebody's own beside those of a scene."""

from collections.abc import Collection, Sequence
from pkgutil import resolve_name
from typing import Any, Protocol, runtime_checkable

from validation.advice.scene_model import SceneModel
from validation.engine.street import places
from validation.scenes.printable import quoted
from validation.scenes.scene import Scene
from validation.simulation.method import Resolution
from validation.simulation.model import Model, Target
from validation.simulation.model_names import SHORT


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
