"""The cheapest model that is accurate enough for a scene, and why."""

COMMANDS = {
    "compare": "select the cheapest model of a scene that meets a tolerance",
    "calibrate": "show the errors that cheap models claim, or measure those of your models",
}
BRINGS = {"model_for": "validation.advice.models_of_scene:model_for"}
