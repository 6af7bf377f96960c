"""The cheapest model that is accurate enough for a scene, and why."""

COMMANDS = {
    "compare": "select the cheapest model of a scene that meets a tolerance",
    "calibrate": "measure the errors that cheap models claim, beside boundary elements",
}
BRINGS = {"model_for": "validation.advice.quantities:model_for"}
