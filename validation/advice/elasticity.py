"""Whether linear elasticity holds in a scene: the mean pressure of its smooth contact over E*."""

import math

from bem3d.diagnostics import HIGHEST_PRESSURE
from validation.railway.scenes.rail import RailScene
from validation.scenes.indentation import IndentationScene
from validation.scenes.load import Scene


def mean_pressure(scene: Scene) -> float:
    """F / L^2 under a punch, else F / (pi a_x a_y) of the contact of Hertz [Pa]."""
    if isinstance(scene, IndentationScene) and scene.shape == "punch":
        return scene.pressure
    if isinstance(scene, RailScene):
        return scene.load / (math.pi * scene.contact.along * scene.contact.across)
    return scene.load / (math.pi * scene.contact_radius**2)


def beyond_elasticity(scene: Scene) -> str:
    """Why no answer of a half-space is one of the scene; empty where it may be.

    Strains are of the order of p / E*: from a tenth on, `HIGHEST_PRESSURE`, what linear elasticity leaves out is as
    large as the default tolerance, and no solid stays elastic. A modulus of exactly 1 is the unit of pressure.
    """
    over = mean_pressure(scene) / scene.modulus
    if scene.modulus == 1 or over <= HIGHEST_PRESSURE:
        return ""
    body = scene.shape if isinstance(scene, IndentationScene) else "wheel"
    size = "side" if body == "punch" else "radius"
    return (
        f"the mean pressure is {over:.2g} E*, above {HIGHEST_PRESSURE:g} E*: linear elasticity does not hold; are the "
        f"units of {body}.load, {body}.{size} and E* right?"
    )
