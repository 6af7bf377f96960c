"""Functions of others on scenes: what each kind is asked, and the quantity that it gives."""

import math
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import mdr
from validation.advice.calibration import SCATTER
from validation.advice.models import boundary_elements_pressed, boundary_elements_rolling
from validation.engine.random_numbers import random_generator
from validation.judging.kinds.judge import answer_of
from validation.judging.kinds.profiles import rms_of_profile
from validation.judging.kinds.rolling import middle_line
from validation.judging.registry import Caller, FloatArray, Given
from validation.railway.problems.rail_models import ContactFilter, rail_quantity
from validation.railway.problems.rail_quantity import RAIL_QUANTITIES
from validation.railway.problems.rail_strip import structure_of, uniform_parts
from validation.scenes.rolling_quantity import QUANTITIES, RollingQuantity
from validation.scenes.roughness import Roughness, RoughSurface
from validation.simulation.indentation import ground_of, height_of, is_rough, side_of, sufficient_cells
from validation.simulation.method import FEWEST, STUDENT, Resolution, Result, realisations
from validation.simulation.model import Target
from validation.simulation.rolling_levels import by_linear_theory, levels_of, strip_of
from validation.simulation.wheel_on_half_space import crop_to_reach
from validation.theory.half_space import on_panels
from validation.theory.rolling import force_spectrum_1d

DRAWS = 3
"""The spawn key under which models draw."""
CALIBRATED, SURFACES = 100, 4
"""Realisations on a scene of the calibration; of those that are given, which boundary elements have solved as well."""
STEPS, RATIO, NODES = 5, 1.4, 8
"""Panels of a quadrature below the roughness, the ratio of the ends of one in it, and nodes of each."""

Rows = Callable[[Caller, Target, int], FloatArray]
"""(realisations, numbers) of a quantity, of a rail (ends, bands) [dB]; the last argument is how many are drawn."""


@dataclass(frozen=True)
class ServedKind:
    """What a kind of functions has of scenes.

    what: in words; serves: whether it has a quantity of a scene; rows: its values; scatter: relative deviation of one
    realisation, of a function that asks for these arguments, zero where one is all; share, fewest, most: a sample
    leaves this share of the tolerance, within these bounds; reads_surface: whether it is asked on surfaces that
    boundary elements have, too; own: error of one measured surface about the mean of all that have its spectrum, None
    for a kind that is given the surface itself.
    """

    what: str
    serves: Callable[[Any, str], bool]
    rows: Rows
    scatter: Callable[[Sequence[str], Target], float] = lambda asks, target: 0.0
    share: float = 0.2
    fewest: int = 50
    most: int = 2000
    reads_surface: bool = False
    own: float | None = 0.0

    def sample(self, asks: Sequence[str], target: Target) -> tuple[int, float]:
        """Realisations, and the relative half-width that they leave of the mean."""
        scatter = self.scatter(asks, target)
        error = self.share * target.tolerance
        count = realisations(scatter, error, least=self.fewest, most=self.most) if scatter else 1
        return count, STUDENT * scatter / math.sqrt(count)


def roughness_of(ground: RoughSurface) -> object:
    """What a function is given; hurst: None for measured heights."""
    if isinstance(ground, Roughness):
        return ground.spectrum
    about = {name: getattr(ground, name) for name in ("c2d", "rms", "hurst", "q_min", "q_max")}
    return SimpleNamespace(c1d=partial(mdr.geike, c2d=ground.c2d), **about)


def _is_rough_punch(scene: Any, quantity: str) -> bool:
    return is_rough(scene, quantity) and scene.shape == "punch"


def _stiffness(caller: Caller, target: Target, count: int) -> FloatArray:
    scene = target.scene
    arguments = {"load": scene.load, "side": scene.size, "modulus": scene.modulus}
    arguments["roughness"] = roughness_of(ground_of(scene))
    rngs = (random_generator(target.seed, DRAWS, i) for i in range(count))
    return np.array([answer_of(caller, **arguments, rng=rng).flat[:1] for rng in rngs])  # of (mean, deviation) the mean


def _stiffness_of_surfaces(caller: Caller, target: Target, count: int) -> FloatArray:
    """On half as many cells a side as boundary elements have; measured heights on their own points."""
    scene, single = target.scene, ground_of(target.scene).is_single
    cells = round(boundary_elements_pressed.resolutions(target)[-1].size)
    cells = sufficient_cells(scene) if single else max(cells // 2, 1)
    arguments = {"spacing": side_of(scene) / cells, "modulus": scene.modulus, "load": scene.load}
    heights = (height_of(scene, cells, i, target.seed) for i in range(count))
    return np.array([[float(answer_of(caller, height=height, **arguments))] for height in heights])


def _is_rolling(scene: Any, quantity: str) -> bool:
    return scene.kind == "wheel" and quantity in QUANTITIES


def _levels(caller: Caller, target: Target, count: int) -> FloatArray:
    """sqrt(2 int |T|^2 C_F dq) over each band."""
    scene = target.scene
    arguments = {**scene.body.smooth, "contact_radius": scene.contact_radius, "roughness": roughness_of(scene.ground)}
    return _of_density(target.rolling, lambda q: answer_of(caller, q=q, **arguments))


def _of_density(quantity: RollingQuantity, density: Callable[[FloatArray], FloatArray]) -> FloatArray:
    bands = list(_quadratures(quantity))
    q = np.concatenate([nodes for nodes, _ in bands])
    power = 2 * density(q) * quantity.transfer(q) ** 2 * np.concatenate([weight for _, weight in bands])
    of_bands = np.split(power, np.cumsum([nodes.size for nodes, _ in bands])[:-1])
    return np.sqrt(np.maximum([[band.sum() for band in of_bands]], 0.0))


def _quadratures(quantity: RollingQuantity) -> Iterator[tuple[FloatArray, FloatArray]]:
    """Nodes in each band and their weights; a line has waves below those of the surface, too."""
    ground, a = quantity.ground, quantity.scene.contact_radius
    for low, high in pairwise(quantity.bands.edges):
        first, last = max(low, ground.q_min), min(high, ground.q_max)
        waves = np.linspace(low, last, 2 + math.floor((last - low) * a / math.pi))
        powers = np.geomspace(first, last, 2 + math.floor(math.log(last / first) / math.log(RATIO)))
        below = np.linspace(low, first, STEPS)
        yield on_panels(np.unique(np.concatenate([waves, powers, below])), NODES)


def _of_rule(caller: Caller, target: Target, count: int) -> FloatArray:
    """Springs under profiles of that spectrum, L_1D = L; linear theory of a wheel on such a line."""
    scene, roughness = target.scene, roughness_of(target.scene.ground)

    def c1d(q: ArrayLike) -> FloatArray:
        return answer_of(caller, q=np.asarray(q), roughness=roughness)

    if scene.kind == "wheel":
        contact = {"contact_radius": scene.contact_radius, "modulus": scene.modulus}
        return _of_density(target.rolling, lambda q: force_spectrum_1d(q, c1d, **contact))
    points = max(256, math.ceil(NODES * scene.size * scene.ground.q_max / (2 * math.pi)))
    waves = 2 * math.pi / scene.size * np.arange(1, points // 2)
    rms, rng = rms_of_profile(c1d(waves), waves, scene.ground), random_generator(target.seed, DRAWS)
    drawn = mdr.rough_profiles(c1d, length=scene.size, points=points, count=count, rng=rng, rms=rms)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
        stiffness = mdr.stiffness_under(scene.load, drawn, length=scene.size, modulus=scene.modulus)
    return np.asarray(stiffness)[:, np.newaxis]


def _rolled(caller: Caller, target: Target, count: int) -> FloatArray:
    """Over linear theory on the same strips, times what that expects; measured heights are rolled themselves."""
    if "approach" not in caller.asks:
        raise ValueError("a rolling model that asks for a load keeps no approach, at which a force is compared")
    quantity, body, drawn = target.rolling, target.scene.body, not target.scene.ground.is_single
    cells = boundary_elements_rolling.resolutions(target)[0].size
    spacing = target.scene.contact_radius / cells
    rows = []
    for i in range(count):
        surface = strip_of(quantity, cells, i, target.seed)
        strip = {"height": crop_to_reach(surface, spacing, body), "line": middle_line(surface)}
        force = answer_of(caller, **strip, spacing=(spacing, spacing), **body.smooth)
        over = by_linear_theory(quantity, surface, spacing) if drawn else 1.0
        rows.append(levels_of(quantity, force, spacing) / over)
    return np.array(rows) * (quantity.expected(one_dimensional=False) if drawn else 1.0)


def _filtered(caller: Caller, target: Target, count: int) -> FloatArray:
    """A3 in bands, at both ends where the ground is not stated [dB]."""
    quantity, contact, powers = rail_quantity(target), target.scene.contact, []
    arguments = {"a_x": contact.along, "a_y": contact.across, "approach": contact.approach}
    for end in quantity.ends:
        of_end = list[FloatArray]()
        for across, edges in uniform_parts(end, quantity.bands.edges):
            alpha = {"ridges": 0.0, "isotropic": math.inf}.get(str(across), across)
            ground = structure_of(across if "k_y" in caller.asks else "ridges", quantity.line)
            amplitude = partial(_amplitude, caller, {**arguments, "alpha": alpha})
            of_end.append(ground.band_power(quantity.line, amplitude, edges=edges, semi_axes=contact.semi_axes))
        powers.append(np.concatenate(of_end))
    return quantity.between(10 * np.log10(powers))


def filter_of(name: str, a3: FloatArray) -> ContactFilter:
    """Whose error is its distance from linear theory, and that of linear theory. a3: (ends, bands) [dB]."""
    return ContactFilter(name=name, closed=lambda quantity: a3)


def _amplitude(caller: Caller, arguments: Given, k_x: FloatArray, k_y: FloatArray) -> FloatArray:
    k_x, k_y = np.broadcast_arrays(k_x, k_y)
    return answer_of(caller, k_x=k_x, k_y=k_y, **arguments)


def _scatter_of_strips(asks: Sequence[str], target: Target) -> float:
    return 0.0 if target.scene.ground.is_single else boundary_elements_rolling.scatter(target)


SERVED: Mapping[str, ServedKind] = {
    "stiffness_model": ServedKind(
        "stiffness of rough punches",
        _is_rough_punch,
        _stiffness,
        lambda asks, target: SCATTER if "rng" in asks else 0.0,
        own=2 * SCATTER,
    ),
    "stiffness_of_surface": ServedKind(
        "stiffness of rough punches",
        _is_rough_punch,
        _stiffness_of_surfaces,
        lambda asks, target: 0.0 if target.scene.ground.is_single else SCATTER,
        share=0.5,
        fewest=FEWEST,
        most=200,
        reads_surface=True,
        own=None,
    ),
    "force_spectrum": ServedKind("force and acceleration of rolling wheels", _is_rolling, _levels, own=0.5),
    "rolling_model": ServedKind(
        "force of rolling wheels at a constant approach",
        lambda scene, quantity: _is_rolling(scene, quantity) and quantity.startswith("force"),
        _rolled,
        _scatter_of_strips,
        fewest=FEWEST,
        most=FEWEST,
        reads_surface=True,
        own=None,
    ),
    "profile_spectrum": ServedKind(
        "stiffness of rough punches, and force and acceleration of rolling wheels",
        lambda scene, quantity: _is_rough_punch(scene, quantity) or _is_rolling(scene, quantity),
        _of_rule,
        lambda asks, target: 0.0 if target.scene.kind == "wheel" else SCATTER,
        own=0.5,
    ),
    "contact_filter": ServedKind(
        "contact filter and equivalent roughness of rails",
        lambda scene, quantity: scene.kind == "rail" and quantity in RAIL_QUANTITIES,
        _filtered,
    ),
}
"""By the decorator; contact laws and solvers have no quantity of a scene."""


def result_of(caller: Caller, target: Target, count: int) -> Result:
    """So many realisations. Raises ArithmeticError for no answer, ValueError for one that is not positive."""
    rows = SERVED[caller.kind].rows(caller, target, count)
    if caller.kind == "contact_filter":
        return filter_of(caller.name, rows).solve(target, Resolution())
    if not (rows > 0).all():
        raise ValueError(f"a {target.quantity} of {rows.min():.3g}, must be positive")
    return Result({target.quantity: rows}, count=len(rows))
