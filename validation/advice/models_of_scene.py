"""Models of a scene: those of each of its quantities, and those a user names: mdr, bem, a label or its beginning."""

from collections.abc import Callable, Collection, Sequence
from pkgutil import resolve_name
from typing import Any, Protocol, SupportsIndex, TypeVar, overload, runtime_checkable

from validation.advice.hierarchy import Candidate, needed
from validation.advice.scene_model import SceneModel, Shared
from validation.analysis.escapes import one_line, quoted
from validation.engine.street import objects_of_houses, places
from validation.scenes.scene import INTERFACE, MOVING, PRESSED, ROLLING, Scene, SceneQuantity
from validation.simulation.method import Resolution
from validation.simulation.model import Model, Target, models_serving
from validation.simulation.model_names import SHORT, SPRINGS_THAT_READ, label_of, note_of

BY_NAME = (SPRINGS_THAT_READ,)
"""Models that are offered by name alone: linear theory costs less and is closer; they pay in the time loop alone."""


def all_quantities() -> tuple[str, ...]:
    """Keys of the quantities of all scenes."""
    brought_by_houses = (quantity for quantities in objects_of_houses("quantities") for quantity in quantities)
    return tuple(map(str, (*PRESSED, *INTERFACE, *ROLLING, *MOVING, *brought_by_houses)))


def quantities_of(scene: Scene) -> tuple[str, ...]:
    """The quantities that a scene has; the first is the default."""
    return tuple(map(str, scene.quantities))


def quantity_of(scene: Scene, key: str) -> SceneQuantity:
    """The quantity with this key. Raises ValueError for a quantity that the scene has not."""
    for quantity in scene.quantities:
        if key == str(quantity):
            return quantity
    raise ValueError(f"quantity must be one of {', '.join(quantities_of(scene))} for scene {scene.name!r}, got {key!r}")


def models_of(
    scene: Scene,
    quantity: str,
    tolerance: float,
    seed: int,
    shared: Shared | None = None,
    *,
    include_by_name: bool = False,
    realisations: int | None = None,
) -> list[SceneModel]:
    """Models of a scene, the cheapest first. Raises ValueError for a quantity that the scene has not.

    shared: solves for several quantities of one scene; include_by_name: whether those of `BY_NAME` are among them;
    realisations: as of `SceneModel`, for which a scene must have a model that draws surfaces.
    """
    quantity_of(scene, quantity)
    target, solved = Target(scene, quantity, tolerance, seed), Shared() if shared is None else shared
    models = [
        SceneModel(model, target, resolution, solved, realisations)
        for model in models_serving(scene, quantity)
        if include_by_name or model.name not in BY_NAME
        for resolution in model.resolutions(target)
    ]
    if realisations is not None and not any(scene_model.is_sampled for scene_model in models):
        raise ValueError(
            f"realisations must be left out for scene {scene.name!r}, got {realisations}: {scene.sample_note}"
        )
    return sorted(models, key=lambda scene_model: scene_model.cost().seconds)


def model_for(scene: Scene, quantity: SceneQuantity, tolerance: float) -> str:
    """The first model whose estimated error is within the tolerance, all grids one; empty where there is none."""
    model = needed(models_of(scene, str(quantity), tolerance, 0), tolerance)
    return "" if model is None else model.kind


T = TypeVar("T", SceneModel, Candidate)


def named(items: Sequence[T], name: str) -> list[T]:
    """The models that a name stands for: springs by MDR, all grids of a kind, or those whose name is or begins so."""
    full_name = _full_name(name)
    rules: list[Callable[[T], bool]] = [
        lambda model: model.name.lower() == full_name,
        lambda model: full_name == "mdr" and model.is_mdr,
        lambda model: model.kind.lower() == full_name,
        lambda model: label_of(model.name).lower() == full_name,
        lambda model: full_name != "" and model.name.lower().startswith(full_name),
        lambda model: full_name != "" and label_of(model.name).lower().startswith(full_name),
    ]
    return next((matches for rule in rules if (matches := [model for model in items if rule(model)])), [])


def models_named(models: Sequence[SceneModel], names: Sequence[str], tolerance: float) -> list[SceneModel]:
    """The models of these names, in their order; a text may have several, with commas.

    Of boundary elements without a grid, the cheapest grid that claims the tolerance, or else the last. Raises
    ValueError for a name that no model of the scene has, or that several have.
    """
    if isinstance(names, str):
        names = names_in(names, _labels_of(models))
    chosen = [model for name in names for model in _models_of_name(models, name, tolerance)]
    return [model for model in models if any(model is candidate for candidate in chosen)]


def label_notes(models: Sequence[SceneModel], names: str) -> list[str]:
    """A note for each model of a list with commas that is not named by "mdr" or "bem" and has two labels."""
    given = names_in(names, _labels_of(models))
    matches = [named(models, name) for name in given if name.lower() not in {"mdr", *SHORT}]
    labelled = [found[0].name if len(found) == 1 else found[0].kind for found in matches if found]
    return [note for name in dict.fromkeys(labelled) if (note := note_of(name))]


def names_in(text: str, full_names: Sequence[str]) -> list[str]:
    """The names in a list with commas, some of which have commas themselves: "mdr, linear filter, 1D"."""
    parts, names = [part.strip() for part in text.split(",")], list[str]()
    lowered = {name.lower() for name in full_names}
    while parts:
        ends = [end for end in range(len(parts), 0, -1) if ", ".join(parts[:end]).lower() in lowered]
        end = ends[0] if ends else 1
        names.append(", ".join(parts[:end]))
        parts = parts[end:]
    return names


def _labels_of(models: Sequence[SceneModel]) -> list[str]:
    """All labels that are accepted."""
    return [label for model in models for label in (model.name, label_of(model.name))]


def _models_of_name(models: Sequence[SceneModel], name: str, tolerance: float) -> list[SceneModel]:
    """The models that a name stands for, of several grids one. Raises ValueError for no model and for several kinds."""
    if not isinstance(name, str):
        raise TypeError(f"models must be names, got {quoted(name)}")
    matches, full_name = named(models, name), _full_name(name)
    if not matches:
        names = ", ".join(quoted(model.name) for model in models)
        raise ValueError(f"models must be mdr, bem or names of models of this scene, {names}, got {quoted(name)}")
    if len(matches) == 1 or full_name == "mdr":
        return matches
    if any(model.kind.lower() != full_name for model in matches):
        several = ", ".join(quoted(model.name) for model in matches)
        raise ValueError(f"models: {quoted(name)} begins {len(matches)} names, {several}")
    claiming = [grid for grid in matches if grid.estimate().error <= tolerance]
    return claiming[:1] or matches[-1:]


def _full_name(name: str) -> str:
    """The name in lower case, that of the model where it is one of the abbreviations of `SHORT`."""
    lowered = name.strip().lower()
    return SHORT.get(lowered, lowered)


class ComparedModels(tuple[Candidate, ...]):
    """All models, the cheapest first; a text stands for the one that it names."""

    __slots__ = ()

    def __repr__(self) -> str:
        """The names, as many as a line has room for."""
        return one_line(f"ComparedModels({len(self)}: {', '.join(repr(candidate.name) for candidate in self)})")

    @overload
    def __getitem__(self, which: str | SupportsIndex) -> Candidate: ...
    @overload
    def __getitem__(self, which: slice) -> tuple[Candidate, ...]: ...
    def __getitem__(self, which: str | SupportsIndex | slice) -> Candidate | tuple[Candidate, ...]:
        """Raises KeyError for a name that none has, or several."""
        if not isinstance(which, str):
            return super().__getitem__(which)
        matches = named(self, which)
        if len(matches) != 1:
            names = ", ".join(quoted(candidate.name) for candidate in matches or self)
            raise KeyError(f"models must be named by one of {names}, got {quoted(which)}")
        return matches[0]


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
    """Names of all models that are chosen, and the functions among them as models; none for None.

    Raises ValueError for what is no list, or an empty one, and for a name that two functions have.
    """
    if models is None or isinstance(models, str):
        return () if models is None else models or ("",), ()
    choices = [models] if isinstance(models, Decorated) else models
    if not isinstance(choices, Collection) or len(choices) == 0:
        raise ValueError(
            f"models must be names, functions with a decorator, or left out for all, got {quoted(choices)}"
        )
    functions = [choice for choice in choices if isinstance(choice, Decorated)]
    names = [choice.name for choice in functions]
    if twice := next((name for name in names if names.count(name) > 1), ""):
        raise ValueError(f"two functions are offered as {twice!r}")
    own: tuple[Own, ...] = ()
    if functions:
        # not `objects_of_houses`: what is stored of scenes without such models is not keyed by their code
        (place,) = places("models_of_functions")
        own = resolve_name(place)(functions, scene, quantity)
    return tuple(choice.name if isinstance(choice, Decorated) else choice for choice in choices), own


def own_candidates(own: Sequence[Own], target: Target, packaged: Sequence[SceneModel]) -> list[SceneModel]:
    """Own models that serve the scene. ValueError where none does, and for a name that a packaged model has."""
    taken = {name.lower() for model in packaged for name in (model.name, model.kind, label_of(model.name))} | {
        "mdr",
        *SHORT,
    }
    if same := [function.name for function in own if function.name.lower() in taken]:
        raise ValueError(f"a model of your own must have a name that no other has, got {quoted(same[0])}")
    own_models = [function.model() for function in own]
    serving = [model for model in own_models if model.serves(target.scene, target.quantity)]
    if own and not serving:
        served = "; ".join(function.serves for function in own)
        raise ValueError(f"no model of your own has {target.quantity} of scene {target.scene.name!r}: {served}")
    return [SceneModel(model, target, Resolution()) for model in serving]
