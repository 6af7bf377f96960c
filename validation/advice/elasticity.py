"""Whether linear elasticity holds in a scene: the mean pressure of its smooth contact over E*."""

from bem3d.diagnostics import HIGHEST_PRESSURE
from validation.scenes.scene import Scene


def beyond_elasticity(scene: Scene) -> str:
    """Why no answer of a half-space is one of the scene; empty where it may be.

    Strains are of the order of p / E*: from a tenth on, `HIGHEST_PRESSURE`, what linear elasticity leaves out is as
    large as the default tolerance, and no solid stays elastic. A modulus of exactly 1 is the unit of pressure.
    """
    over = scene.mean_pressure / scene.modulus
    if scene.modulus == 1 or over <= HIGHEST_PRESSURE:
        return ""
    body = scene.size_key.partition(".")[0]
    return (
        f"the mean pressure is {over:.2g} E*, above {HIGHEST_PRESSURE:g} E*: linear elasticity does not hold; are the "
        f"units of {body}.load, {scene.size_key} and E* right?"
    )
