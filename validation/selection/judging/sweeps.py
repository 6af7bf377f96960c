"""Where a model breaks: it is led past the scenes of its judge, as the methods of the case `limits` are.

References are closed forms, which hold at the ends: the flat punch, Hertz, waves much longer than the contact.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial

import numpy as np

import mdr
from validation.analysis.statistics import FloatArray
from validation.engine.offered import Caller, Failed
from validation.selection.judging import rolling
from validation.selection.judging.judge import Finding, LostError, ModelAnswer, asked, attempted
from validation.selection.judging.references import Reference, curve
from validation.selection.judging.stiffness import FEWEST, FORCE, MEAN, MODULUS, SIDE, AskedPunch, H, answers_of
from validation.theory.closed_forms import SQUARE_PUNCH

HEAVY, LIGHT, FEW = "under a heavy load", "under a light load", "on few cells"
LONG, SHORT, SMOOTH = "for long waves", "for short waves", "smooth wheel on few cells"
SWEPT = (HEAVY, LIGHT, FEW, LONG, SHORT, SMOOTH)
"""Quantities, each a number over its closed form, or over a bound that it must keep."""
EXACT, SPHERE = 1e-9, 64
"""Tolerance of a bound; cells on a side below a sphere."""


def _swept(
    model: Caller, quantity: str, along: str, at: Sequence[float], ratio: Callable[[float], float], grid: float = 0.0
) -> Iterator[Finding]:
    """A number over its closed form, and whether the model warned. grid: what the form, or the cells, leave."""
    for x in at:
        found = attempted(partial(ratio, x))
        warned = f"it warned: {model.warned}" if model.warned else ""
        mine = found if isinstance(found, Failed) else ModelAnswer(found, reason=warned)
        yield Finding(
            quantity, Reference({along: x}, 1.0, 0.0, grid), mine, EXACT if quantity in (LIGHT, SHORT) else None
        )


def of_punch(model: Caller) -> Iterator[Finding]:
    """Loads that flatten all, under which k = 1.1523 E* L; and light ones, under which k must rise with the load."""

    def stiffness(force: float) -> float:
        punch = AskedPunch(0.7, force)
        found = answers_of(model, [punch], FEWEST)[punch]
        if isinstance(found, Failed):
            raise LostError(found)
        return found.mean.value

    heaviest = max((one for one in curve(MEAN) if one.where[H] == 0.7), key=lambda one: float(one.where[FORCE]))
    left = abs(heaviest.value / SQUARE_PUNCH - 1)
    yield from _swept(model, HEAVY, FORCE, (30.0, 1e2, 1e3, 1e4), lambda force: stiffness(force) / SQUARE_PUNCH, left)
    if "rng" not in model.asks:
        rise = lambda force: min(stiffness(2 * force) / stiffness(force), 1.0)  # noqa: E731
        yield from _swept(model, LIGHT, FORCE, (1e-8, 1e-6, 1e-4), rise)


def of_surface(model: Caller) -> Iterator[Finding]:
    """A sphere on a contact of few cells: k = 2 E* a, by Hertz."""
    spacing, radius = SIDE / SPHERE, 100 * SIDE
    x = (np.arange(SPHERE) - (SPHERE - 1) / 2) * spacing
    height = -(x**2 + x[:, np.newaxis] ** 2) / (2 * radius)

    def stiffness(cells: float) -> float:
        a = math.sqrt(cells / math.pi) * spacing
        load = 4 / 3 * MODULUS * a**3 / radius
        return float(asked(model, height=height, spacing=spacing, modulus=MODULUS, load=load)) / (2 * MODULUS * a)

    yield from _swept(model, FEW, "cells in the contact", (3.0, 10.0, 30.0, 100.0, 300.0), stiffness)


def of_spectrum(model: Caller) -> Iterator[Finding]:
    """The rms force of waves that are all longer than the contact: 2 E* a times that of the heights."""

    def rms(qa: float) -> float:
        last, rms = qa / rolling.CONTACT, 1e-3 * rolling.APPROACH
        ground = mdr.SelfAffine(hurst=0.7, q_min=last / 4, q_max=last, rms=rms)
        q = (np.arange(rolling.FINE) + 0.5) / rolling.FINE * last
        density = asked(model, q=q, roughness=ground, contact_radius=rolling.CONTACT, **rolling.SMOOTH_WHEEL)
        variance = 2 * float(density.sum()) * last / rolling.FINE
        return math.sqrt(max(variance, 0.0)) / (2 * rolling.MODULUS * rolling.CONTACT * rms)

    yield from _swept(model, LONG, "q a", (1e-4, 1e-3, 1e-2), rms, 1e-2)


def of_filter(model: Caller) -> Iterator[Finding]:
    """One for long waves, up to those of no wavenumber; not above one for the shortest."""

    def amplitude(qa: float) -> float:
        k = np.full(1, qa / rolling.CONTACT)
        axes = {"a_x": rolling.CONTACT, "a_y": rolling.CONTACT, "approach": rolling.APPROACH, "alpha": 1.0}
        return float(np.abs(asked(model, k_x=k, k_y=0 * k, **axes)[0]))

    yield from _swept(model, LONG, "q a", (0.0, 1e-6, 1e-3), amplitude, 1e-3)
    yield from _swept(model, SHORT, "q a", (1e2, 1e3, 1e4), lambda qa: 2 - max(amplitude(qa), 1.0))


def of_wheel(model: Caller) -> Iterator[Finding]:
    """A smooth wheel on coarse cells, and one that follows a wave much longer than the contact, by Hertz."""
    name, unit = ("force", rolling.FORCE) if "approach" in model.asks else ("approach", rolling.APPROACH)

    def rolled(cells: float, line: FloatArray) -> FloatArray:
        height = rolling.APPROACH * np.broadcast_to(line[:, np.newaxis], (line.size, round(8 * cells)))
        spacing = (rolling.CONTACT / cells,) * 2
        return asked(model, height=height, line=height[:, 0], spacing=spacing, **rolling.SMOOTH_WHEEL) / unit

    def followed(length: float) -> float:
        wave = 0.1 * np.cos(2 * math.pi * np.arange(4 * length) / (4 * length))
        exact = (1 + wave) ** 1.5 if name == "force" else 1 - wave
        found = rolled(4.0, wave) / float(rolled(4.0, 0 * wave)[0])
        return 1 + float(np.std(found - exact) / np.std(exact))

    yield from _swept(
        model,
        SMOOTH,
        "cells to a contact radius",
        (1.0, 2.0, 4.0, 8.0, 16.0),
        lambda n: float(rolled(n, np.zeros(16)).mean()),
    )
    yield from _swept(model, LONG, "wavelength over a", (32.0, 128.0), followed, 1e-2)


SWEEPS: Mapping[str, Callable[[Caller], Iterator[Finding]]] = {
    "stiffness_model": of_punch,
    "stiffness_of_surface": of_surface,
    "force_spectrum": of_spectrum,
    "contact_filter": of_filter,
    "rolling_model": of_wheel,
}
"""Of the kinds that can be asked that."""


def swept(model: Caller) -> Iterator[Finding]:
    if model.kind in SWEEPS:
        yield from SWEEPS[model.kind](model)
