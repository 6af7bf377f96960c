"""Stiffness of a pressed body without a grid: in closed form, by a fit for rough square punches, on springs."""

import math
from dataclasses import replace
from functools import partial

import numpy as np

import mdr
from validation.advice.calibration import SCATTER, WAVES, calibrated_by_spectrum, conditions_of, sphere_shape
from validation.engine.realisations import random_generator
from validation.simulation.indentation import ground_of, is_pressed, is_rough, side_of
from validation.simulation.method import Resolution, Result, realisations
from validation.simulation.model import Cost, ErrorEstimate, Model, Target, model
from validation.simulation.model_names import CLOSED_FORM, FIT, SPRINGS
from validation.theory.closed_forms import rough_punch_stiffness

PROFILES = 1
"""The spawn key under which profiles draw."""
SPRING = 3.5e-8
"""Seconds that a spring takes in a sort, about."""
SPRINGS_TO_A_WAVE, SPRINGS_TO_A_RADIUS = 8, 100
ROLL_OFF = 0.6
"""By which the error of springs under a punch grows, relative, with each more of the longest waves on a side."""
MOST_SPRINGS, BLOCK = 2**26, 2**22
"""Springs of a profile at the most, which take four gigabytes, and of all that are drawn at once, or one profile."""


def formula(target: Target, resolution: Resolution) -> Cost:
    return Cost(work=1, seconds=2.0e-5)


def exact_if_smooth(model: Model, target: Target, resolution: Resolution) -> ErrorEstimate:
    if target.scene.ground is None:
        return ErrorEstimate(reason="exact for a smooth body")
    return calibrated_by_spectrum(model, target, resolution)


@model(
    name=CLOSED_FORM,
    setting="smooth body",
    serves=lambda scene, quantity: is_pressed(scene, quantity) and (scene.shape == "sphere" or scene.ground is None),
    cost=formula,
    claim=exact_if_smooth,
    shape=lambda target: sphere_shape(target.scene),
)
def closed_form(target: Target, resolution: Resolution) -> float:
    """k = 2 E* a of a sphere, 1.1523 E* L of a square punch; the roughness of a sphere is the error."""
    return float(target.scene.stiffness)


def one_of_many_faces(model: Model, target: Target, resolution: Resolution) -> ErrorEstimate:
    """A measured face is one of those that have its spectrum, and its interface yields as one over the load."""
    return calibrated_by_spectrum(model, target, resolution, own=2 * SCATTER / max(target.scene.reduced_load, 1.0) ** 2)


@model(
    name=FIT,
    setting="flat punch on its rough face",
    serves=lambda scene, quantity: is_rough(scene, quantity) and scene.shape == "punch",
    cost=formula,
    claim=one_of_many_faces,
    # few waves are no mean face: N on a side are N^2 parts, whose mean scatters as 1 / N about a bias
    shape=lambda target: float(conditions_of(target.scene)[WAVES] ** -0.75),
)
def fit(target: Target, resolution: Resolution) -> float:
    """1 / k = 1 / (1.1523 E* L) + 0.48 h / F, h measured: the flat punch in series with its rough face."""
    scene, height = target.scene, ground_of(target.scene).rms
    return rough_punch_stiffness(side=scene.size, modulus=scene.modulus, force=scene.load, height=height)


def springs_of_a_profile(target: Target) -> tuple[Resolution, ...]:
    """Eight to the shortest wave, and a hundred to the contact radius of a smooth sphere."""
    scene, length = target.scene, side_of(target.scene)
    radii = length / scene.contact_radius if scene.shape == "sphere" else 0.0
    waves = length * ground_of(scene).q_max / (2 * math.pi)
    return (Resolution(size=max(256, math.ceil(SPRINGS_TO_A_WAVE * waves), math.ceil(SPRINGS_TO_A_RADIUS * radii))),)


def profiles(target: Target) -> int:
    """So many that the sample leaves a fifth of the tolerance."""
    return realisations(SCATTER, target.tolerance / 5, least=50)


def all_profiles(target: Target, resolution: Resolution) -> Cost:
    work = profiles(target) * resolution.size
    return Cost(work=work, seconds=1e-3 + SPRING * work)


def one_of_many_surfaces(model: Model, target: Target, resolution: Resolution) -> ErrorEstimate:
    """A measured surface is one of those that have its spectrum."""
    needed, own = f"a profile needs {resolution.size:.3g} springs, more than {MOST_SPRINGS:.3g}", 2 * SCATTER
    too_many = needed if resolution.size > MOST_SPRINGS else ""
    expected = calibrated_by_spectrum(model, target, resolution, own=own, beyond=too_many)
    is_single = ground_of(target.scene).is_single and expected.in_range
    scatters = f"one surface scatters {own:.0%} about the mean of its spectrum; " if is_single else ""
    return replace(expected, sample=target.tolerance / 5, reason=scatters + expected.reason)


@model(
    name=SPRINGS,
    setting="profiles of Geike's spectrum",
    serves=is_rough,
    resolutions=springs_of_a_profile,
    cost=all_profiles,
    claim=one_of_many_surfaces,
    shape=lambda target: (
        sphere_shape(target.scene) * (1 + ROLL_OFF * (conditions_of(target.scene).get(WAVES, 1.0) - 1))
    ),
    element="springs",
    charted=False,
    is_mdr=True,
)
def springs(target: Target, resolution: Resolution) -> Result:
    """MDR, L_1D = L: the mean of many profiles, of a measured surface of its spectrum.

    They draw from one stream of random numbers, in blocks that fit into memory.
    """
    scene, ground, points = target.scene, ground_of(target.scene), round(resolution.size)
    length, count, block = side_of(scene), profiles(target), max(1, BLOCK // points)
    x = (np.arange(points) + 0.5) * length / points - length / 2
    smooth = mdr.sphere_profile(x, radius=scene.size) if scene.shape == "sphere" else np.zeros(points)
    rng, stiffnesses = random_generator(target.seed, PROFILES), []
    profile = partial(mdr.rough_profiles, lambda q: mdr.geike(q, ground.c2d), length=length, points=points, rng=rng)
    for first in range(0, count, block):
        rough = profile(count=min(block, count - first), rms=ground.rms)
        stiffnesses.append(mdr.stiffness_under(scene.load, rough - smooth, length=length, modulus=scene.modulus))
    stiffness = np.concatenate(stiffnesses)
    in_contact = stiffness / (scene.modulus * length / points)
    return Result({target.quantity: stiffness, "in contact": in_contact}, count=count)
