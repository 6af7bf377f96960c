"""Models of somebody's own beside those of a scene."""

from collections.abc import Sequence
from typing import Protocol

from validation.scenes.printable import quoted
from validation.scenes.rail import RailScene
from validation.selection.rail_model import RailSceneModel
from validation.selection.scene_model import SceneModel
from validation.simulation.method import Resolution
from validation.simulation.model import Model, Target
from validation.simulation.model_names import SHORT


class Own(Protocol):
    """What `own_models` makes of a function; serves: in words.

    It is known by this alone: what is stored of scenes without such models must not be keyed by their code.
    """

    @property
    def name(self) -> str: ...
    @property
    def serves(self) -> str: ...
    def model(self) -> Model: ...


def own_candidates(own: Sequence[Own], target: Target, others: Sequence[SceneModel]) -> list[SceneModel]:
    """Those that serve the scene. ValueError where none does, and for a name that another model has."""
    taken = {name.lower() for one in others for name in (one.name, one.kind)} | {"mdr", *SHORT}
    if same := [one.name for one in own if one.name.lower() in taken]:
        raise ValueError(f"a model of your own must have a name that no other has, got {quoted(same[0])}")
    found = [model for one in own if (model := one.model()).serves(target.scene, target.quantity)]
    if own and not found:
        served = "; ".join(one.serves for one in own)
        raise ValueError(f"no model of your own has {target.quantity} of scene {target.scene.name!r}: {served}")
    kind = RailSceneModel if isinstance(target.scene, RailScene) else SceneModel
    return [kind(model, target, Resolution()) for model in found]
