"""Limits of springs that are pressed: the true contact area, the mean gap, the last asperity."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

import mdr
from validation.cases.limits.sweep import Limit, call_and_record_warnings, swept
from validation.engine.engine import Outcome
from validation.simulation.rough_punch import (
    Profiles,
    PunchRoughness,
    Surface,
    force_levels,
    press_profiles,
    press_surface,
)

FULL, HALF = 1.1631 / math.sqrt(2), 0.4769 / math.sqrt(2)
"""p over E* g at which Persson's contact fraction erf(sqrt(2) p / (E* g)) is 0.9, and one half; g: rms gradient."""

AREA = Limit(
    name="area",
    method="MDR",
    title="true contact area",
    parameter="force F / (E* h L)",
    error="contact fraction, over that of 3D, less one",
    reference="boundary elements, rough punches",
    condition=(
        "p = 0.82 E* g, g the rms gradient, where Persson's contact fraction is 0.9: springs are right near full "
        "contact only"
    ),
    failing_side="below",
    tolerance=0.1,
    factor=3.0,
)
GAP = Limit(
    name="gap",
    method="MDR",
    title="mean gap",
    parameter="force F / (E* h L)",
    error="difference of the mean gaps [h]",
    reference="boundary elements, rough punches",
    condition=(
        "p = 0.34 E* g, g the rms gradient, where Persson's contact fraction is a half: springs are right where gaps "
        "are closed"
    ),
    failing_side="below",
    tolerance=0.1,
    factor=3.0,
)
ASPERITY = Limit(
    name="asperity",
    method="MDR",
    title="the last asperity",
    parameter="springs in contact",
    error="stiffness, rms over profiles",
    reference="many more springs on the same profile",
    condition="1 / (√6 tolerance): the length of one contact is rounded to whole springs",
    failing_side="below",
    tolerance=0.05,
    factor=2.5,
    derived=True,
    warned=True,
)


@dataclass(frozen=True, kw_only=True)
class Punches:
    """Rough punches of Fig. 14.1, from few contacts to full contact, by both methods."""

    roughness: PunchRoughness
    cells: int
    surfaces: int
    profiles: int
    points: int = 1024
    forces: tuple[float, ...] = (*force_levels((-2, 2), 2), 10**2.5)

    def sweep(self) -> Outcome:
        """Contact fraction and mean gap of springs against boundary elements, means over the draws."""
        r, forces = self.roughness, self.forces
        surfaces = [
            press_surface(Surface(roughness=r, realisation=i, cells=self.cells, forces=forces, tolerance=1e-4))
            for i in range(self.surfaces)
        ]
        springs = press_profiles(
            Profiles(roughness=r, realisations=self.profiles, points=self.points, length=1.0, forces=forces)
        )
        area, gap = (np.mean([s[name] for s in surfaces], axis=0) for name in ("area", "gap"))
        area_error = np.abs(springs["area"].mean(axis=0) / area - 1)
        gap_error = np.abs(springs["gap"].mean(axis=0) - gap) / r.height
        curve = mdr.load_curve(r.profile(self.points, 0), length=1.0, modulus=1.0)
        messages = [call_and_record_warnings(partial(curve.at_force, r.height * f))[1] for f in forces]
        gradient = float(np.mean([s["gradient"] for s in surfaces])) / r.height
        return {
            **swept(AREA, forces, list(zip(area_error, messages, strict=True)), FULL * gradient),
            **swept(GAP, forces, list(zip(gap_error, messages, strict=True)), HALF * gradient),
            "failed": np.array(sum(float(s["failed"]) for s in surfaces)),
        }


@dataclass(frozen=True, kw_only=True)
class Asperities:
    """Rough profiles under very low forces, on so many points and on finer ones."""

    roughness: PunchRoughness
    profiles: int
    points: int = 256
    finer: int = 32
    forces: tuple[float, ...] = tuple(10.0 ** (-i / 2) for i in range(1, 11))

    def sweep(self) -> Outcome:
        """Stiffness against finer springs on the same profiles, rms at each force.

        Messages are those of the profile whose number of springs in contact is nearest to the mean.
        """
        r, forces = self.roughness, self.forces
        coarse, fine = (
            press_profiles(Profiles(roughness=r, realisations=self.profiles, points=n, length=1.0, forces=forces))
            for n in (self.points, self.finer * self.points)
        )
        springs = coarse["stiffness"] * self.points
        error = np.sqrt(np.mean((coarse["stiffness"] / fine["stiffness"] - 1) ** 2, axis=0))
        messages = []
        for force, count in zip(r.height * np.array(forces), springs.T, strict=True):
            typical = int(np.argmin(np.abs(count - count.mean())))
            curve = mdr.load_curve(r.profile(self.points, typical), length=1.0, modulus=1.0)
            messages.append(call_and_record_warnings(partial(curve.at_force, float(force)))[1])
        threshold = 1 / (math.sqrt(6) * ASPERITY.tolerance)
        return swept(ASPERITY, springs.mean(axis=0), list(zip(error, messages, strict=True)), threshold)
