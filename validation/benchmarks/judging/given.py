"""What conformance tests are given: functions of a file, our own solver and Geike's rule, and roughness."""

import math
import runpy
import sys
import warnings
from pathlib import Path
from typing import Any

import numpy as np

import bem3d
import mdr
from validation.benchmarks.judging.discrete import KnownContact
from validation.benchmarks.judging.judged import Asked
from validation.engine.offered import KINDS, FloatArray, Offered, offer
from validation.engine.others import Called


def named_in(place: str, kind: str) -> Offered:
    """FILE:NAME, a function with or without its decorator; the file is run, and its folder can be imported.

    Raises ValueError where there is none.
    """
    file, _, name = place.rpartition(":")
    if not Path(file).is_file():
        raise ValueError(f"a function is named as FILE:NAME, and there is no file {file!r} in {place!r}")
    sys.path.insert(0, str(Path(file).resolve().parent))
    found = runpy.run_path(file).get(name)
    if isinstance(found, Offered) and found.kind == kind:
        return found
    if not callable(found):
        raise ValueError(f"{file} has no function {name!r} for @{kind}")
    return offer(kind, name, KINDS[kind].options, found)


def solver_of(place: str | None) -> Asked:
    """That of a file, or ours; it is called in this process."""
    options = {**KINDS["contact_solver"].options, "periodic": True, "residual": 1e-5}
    return Asked(
        Called(named_in(place, "contact_solver") if place else offer("contact_solver", "bem3d", options, ours))
    )


def ours(gap: FloatArray, spacing: tuple[float, float], modulus: float, periodic: bool, force: float) -> FloatArray:
    return _pressed(gap, spacing, modulus, periodic, force).pressure


def approach_of(problem: KnownContact) -> float:
    """Under its force, by our solver."""
    return _pressed(problem.gap, problem.spacing, problem.modulus, problem.periodic, problem.force).approach


def _pressed(
    gap: FloatArray, spacing: tuple[float, float], modulus: float, periodic: bool, force: float
) -> bem3d.Contact:
    half_space = bem3d.HalfSpace(shape=gap.shape, spacing=spacing, modulus=modulus, periodic=periodic)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bem3d.ContactWarning)  # a few cells are what is asked for
        return bem3d.solve(half_space, gap, force=force, indenter_ends_at_edge=True)


def rule_of(place: str | None) -> Any:
    """C_1D(q) of a roughness, by a file or by Geike."""
    return named_in(place, "profile_spectrum").function if place else geike


def geike(q: FloatArray, roughness: mdr.SelfAffine) -> FloatArray:
    return mdr.geike(q, roughness.c2d)


def roughness_of(hurst: float, q_min: float, ratio: float, rms: float) -> mdr.SelfAffine:
    return mdr.SelfAffine(hurst=hurst, q_min=q_min, q_max=q_min * ratio, rms=rms)


def inside(roughness: mdr.SelfAffine, nodes: int = 400) -> tuple[FloatArray, FloatArray]:
    """Nodes and weights of an integral over the band, Gauss-Legendre in ln q."""
    node, weight = np.polynomial.legendre.leggauss(nodes)
    half = math.log(roughness.q_max / roughness.q_min) / 2
    q = roughness.q_min * np.exp(half * (node + 1))
    return q, weight * half * q
