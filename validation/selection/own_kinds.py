"""Functions of others on scenes: what each kind is asked, and the quantity that it gives."""

import math
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, get_args

import numpy as np
from numpy.typing import ArrayLike

import mdr
from validation.engine.offered import Caller, Failed, FloatArray
from validation.engine.random_numbers import random_generator
from validation.scenes.rail import RailScene
from validation.scenes.rolling import RollingScene
from validation.scenes.roughness import Roughness, RoughSurface
from validation.selection.judging.rolling import middle_line
from validation.simulation.calibrated_range import SCATTER
from validation.simulation.indentation import cells_wanted, ground_of, height_of, is_rough, side_of
from validation.simulation.method import Result
from validation.simulation.model import Target
from validation.simulation.models import boundary_elements_pressed, boundary_elements_rolling
from validation.simulation.rail_models import rail_quantity
from validation.simulation.rail_quantity import RAIL_QUANTITIES
from validation.simulation.rail_strip import structure_of
from validation.simulation.rolling_levels import by_linear_theory, levels_of, strip_of
from validation.simulation.rolling_quantity import QuantityName, RollingQuantity
from validation.simulation.sampling import FEWEST, STUDENT, realisations
from validation.simulation.wheel_on_half_space import crop_to_reach
from validation.theory.gauss_legendre import on_panels
from validation.theory.rolling import force_spectrum_1d

DRAWS = 3
"""The spawn key under which models draw."""
CALIBRATED, SURFACES = 100, 4
"""Realisations on a scene of the calibration; of those that are given, which boundary elements have solved as well."""
MOST = 200
"""Surfaces that are given at the most."""
STEPS, RATIO, NODES = 5, 1.4, 8
"""Panels of a quadrature below the roughness, the ratio of the ends of one in it, and nodes of each."""

Rows = Callable[[Caller, Target, int], FloatArray]
"""(realisations, numbers) of a quantity, of a rail (1, bands) [dB]; the last argument is how many are drawn."""


@dataclass(frozen=True)
class ServedKind:
    """What a kind of functions has of scenes.

    what: in words; serves: whether it has a quantity of a scene; rows: its values; draws: realisations of a function
    that asks for these arguments, and the half-width that they leave; given: whether they are of surfaces that boundary
    elements have, too; own: error of one measured surface about the mean of all that have its spectrum, None for a kind
    that is given the surface itself.
    """

    what: str
    serves: Callable[[Any, str], bool]
    rows: Rows
    draws: Callable[[Sequence[str], Target], tuple[int, float]] = lambda asks, target: (1, 0.0)
    given: bool = False
    own: float | None = 0.0


@dataclass(frozen=True)
class MeasuredSpectrum:
    """The spectrum of measured heights, as that of `mdr.SelfAffine`; hurst: None."""

    surface: RoughSurface

    def c2d(self, q: ArrayLike) -> FloatArray:
        return np.asarray(self.surface.c2d(q))

    def c1d(self, q: ArrayLike) -> FloatArray:
        """Geike's rule."""
        return mdr.geike(q, self.surface.c2d)

    def __getattr__(self, name: str) -> Any:
        if name not in ("rms", "hurst", "q_min", "q_max"):
            raise AttributeError(name)
        return getattr(self.surface, name)


def roughness_of(ground: RoughSurface) -> object:
    return ground.spectrum if isinstance(ground, Roughness) else MeasuredSpectrum(ground)


def number(found: FloatArray | Failed) -> FloatArray:
    """Raises ValueError with what is wrong."""
    if isinstance(found, Failed):
        raise ValueError(found.reason)
    return found


def _is_rough_punch(scene: Any, quantity: str) -> bool:
    return is_rough(scene, quantity) and scene.shape == "punch"


def _stiffness(caller: Caller, target: Target, count: int) -> FloatArray:
    scene = target.scene
    given = {"load": scene.load, "side": scene.size, "modulus": scene.modulus}
    given["roughness"] = roughness_of(ground_of(scene))
    if "rng" not in caller.asks:
        return np.atleast_2d(number(caller.call(**given)).flat[0])
    drawn = [random_generator(target.seed, DRAWS, i) for i in range(count)]
    return np.array([[float(number(one))] for one in caller.calls("rng", drawn, given)])


def _sample(scatter: float, error: float, least: int = 50, most: int = 2000) -> tuple[int, float]:
    count = realisations(scatter, error, least=least, most=most)
    return count, STUDENT * scatter / math.sqrt(count)


def _drawn(asks: Sequence[str], target: Target) -> tuple[int, float]:
    return _sample(SCATTER, target.tolerance / 5) if "rng" in asks else (1, 0.0)


def _stiffness_of_surfaces(caller: Caller, target: Target, count: int) -> FloatArray:
    """On half as many cells a side as boundary elements have; measured heights on their own points."""
    scene, single = target.scene, ground_of(target.scene).is_single
    cells = round(boundary_elements_pressed.resolutions(target)[-1].size)
    cells = cells_wanted(scene) if single else max(cells // 2, 1)
    given = {"spacing": side_of(scene) / cells, "modulus": scene.modulus, "load": scene.load}
    heights = (height_of(scene, cells, i, target.seed) for i in range(count))
    return np.array([[float(number(caller.call(height=height, **given)))] for height in heights])


def _surfaces(asks: Sequence[str], target: Target) -> tuple[int, float]:
    single = target.scene.ground.is_single
    return (1, 0.0) if single else _sample(SCATTER, target.tolerance / 2, FEWEST, MOST)


def _is_rolling(scene: Any, quantity: str) -> bool:
    return isinstance(scene, RollingScene) and quantity in get_args(QuantityName)


def _levels(caller: Caller, target: Target, count: int) -> FloatArray:
    """sqrt(2 int |T|^2 C_F dq) over each band."""
    scene = target.scene
    given = {**scene.body.smooth, "contact_radius": scene.contact_radius, "roughness": roughness_of(scene.ground)}
    return _of_density(target.rolling, lambda q: number(caller.call(q=q, **given)))


def _of_density(quantity: RollingQuantity, density: Callable[[FloatArray], FloatArray]) -> FloatArray:
    bands = list(_quadratures(quantity))
    q = np.concatenate([one for one, _ in bands])
    power = 2 * density(q) * quantity.transfer(q) ** 2 * np.concatenate([weight for _, weight in bands])
    of_bands = np.split(power, np.cumsum([one.size for one, _ in bands])[:-1])
    return np.sqrt(np.maximum([[one.sum() for one in of_bands]], 0.0))


def _quadratures(quantity: RollingQuantity) -> Iterator[tuple[FloatArray, FloatArray]]:
    """Nodes in each band and their weights; a line has waves below those of the surface, too."""
    ground, a = quantity.scene.ground, quantity.scene.contact_radius
    for low, high in pairwise(quantity.bands.edges):
        last = min(high, ground.q_max)
        first = max(low, ground.q_min)
        waves = np.linspace(low, last, 2 + math.floor((last - low) * a / math.pi))
        powers = np.geomspace(first, last, 2 + math.floor(math.log(last / first) / math.log(RATIO)))
        below = np.linspace(low, first, STEPS) if first > low else powers[:1]
        yield on_panels(np.unique(np.concatenate([waves, powers, below])), NODES)


def _serves_of_rule(scene: Any, quantity: str) -> bool:
    return _is_rough_punch(scene, quantity) or _is_rolling(scene, quantity)


def _of_rule(caller: Caller, target: Target, count: int) -> FloatArray:
    """Springs under profiles of that spectrum, L_1D = L; linear theory of a wheel on such a line."""
    scene, roughness = target.scene, roughness_of(target.scene.ground)

    def c1d(q: ArrayLike) -> FloatArray:
        return number(caller.call(q=np.asarray(q), roughness=roughness))

    if isinstance(scene, RollingScene):
        contact = {"contact_radius": scene.contact_radius, "modulus": scene.modulus}
        return _of_density(target.rolling, lambda q: force_spectrum_1d(q, c1d, **contact))
    points = max(256, math.ceil(NODES * scene.size * scene.ground.q_max / (2 * math.pi)))
    # a band that begins at the first wave counts it whole, as that of Geike's rule, which has the rms of the surface
    waves = 2 * math.pi / scene.size * np.arange(1, points // 2)
    share = float(c1d(waves).sum() / mdr.geike(waves, scene.ground.c2d).sum())
    if not share > 0:
        raise ValueError("no profile has a spectrum that is negative, or zero")
    rms, rng = scene.ground.rms * math.sqrt(share), random_generator(target.seed, DRAWS)
    drawn = mdr.rough_profiles(c1d, length=scene.size, points=points, count=count, rng=rng, rms=rms)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
        found = mdr.stiffness_under(scene.load, drawn, length=scene.size, modulus=scene.modulus)
    return np.asarray(found)[:, np.newaxis]


def _profiles(asks: Sequence[str], target: Target) -> tuple[int, float]:
    return (1, 0.0) if isinstance(target.scene, RollingScene) else _sample(SCATTER, target.tolerance / 5)


def _is_still(scene: Any, quantity: str) -> bool:
    return _is_rolling(scene, quantity) and quantity.startswith("force")


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
        force = number(caller.call(**strip, spacing=(spacing, spacing), **body.smooth))
        over = by_linear_theory(quantity, surface, spacing) if drawn else 1.0
        rows.append(levels_of(quantity, force, spacing) / over)
    return np.array(rows) * (quantity.expected(one_dimensional=False) if drawn else 1.0)


def _strips(asks: Sequence[str], target: Target) -> tuple[int, float]:
    scatter = boundary_elements_rolling.scatter(target)
    return (1, 0.0) if target.scene.ground.is_single else _sample(scatter, target.tolerance, FEWEST, FEWEST)


def _is_rail(scene: Any, quantity: str) -> bool:
    return isinstance(scene, RailScene) and quantity in RAIL_QUANTITIES


def _filtered(caller: Caller, target: Target, count: int) -> FloatArray:
    """A3 in bands, in the middle of both ends where the ground is not stated [dB]."""
    asked, contact, found = rail_quantity(target), target.scene.contact, []
    bands = {"edges": asked.bands.edges, "semi_axes": contact.semi_axes}
    given = {"a_x": contact.along, "a_y": contact.across, "approach": contact.approach}
    for across in asked.ends:
        alpha = {"ridges": 0.0, "isotropic": math.inf}.get(str(across), across)

        def transfer(k_x: FloatArray, k_y: FloatArray, alpha: object = alpha) -> FloatArray:
            k_x, k_y = np.broadcast_arrays(k_x, k_y)
            return number(caller.call(k_x=k_x, k_y=k_y, **given, alpha=alpha))

        ground = structure_of(across if "k_y" in caller.asks else "ridges", asked.line)
        found.append(10 * np.log10(ground.band_power(asked.line, transfer, **bands)))
    return np.asarray(asked.between(np.array(found)).mean(axis=0, keepdims=True))


SERVED: Mapping[str, ServedKind] = {
    "stiffness_model": ServedKind("stiffness of rough punches", _is_rough_punch, _stiffness, _drawn, own=2 * SCATTER),
    "stiffness_of_surface": ServedKind(
        "stiffness of rough punches", _is_rough_punch, _stiffness_of_surfaces, _surfaces, given=True, own=None
    ),
    "force_spectrum": ServedKind("force and acceleration of rolling wheels", _is_rolling, _levels, own=0.5),
    "rolling_model": ServedKind(
        "force of rolling wheels at a constant approach", _is_still, _rolled, _strips, given=True, own=None
    ),
    "profile_spectrum": ServedKind(
        "stiffness of rough punches, and force and acceleration of rolling wheels",
        _serves_of_rule,
        _of_rule,
        _profiles,
        own=0.5,
    ),
    "contact_filter": ServedKind("contact filter and equivalent roughness of rails", _is_rail, _filtered),
}
"""By the decorator; contact laws and solvers have no quantity of a scene."""


def result_of(caller: Caller, target: Target, count: int) -> Result:
    """So many realisations. Raises ValueError for no answer, and for one that is not positive."""
    rows = SERVED[caller.kind].rows(caller, target, count)
    if isinstance(target.scene, RailScene):
        # nothing is known of its error, in any band
        halves = {"model": np.full(rows[0].shape, math.inf), "grid": 0 * rows[0], "sample": 0 * rows[0]}
        return Result({target.quantity: rail_quantity(target).amplitude(rows[0]), "a3": rows[0], **halves})
    if not (rows > 0).all():
        raise ValueError(f"a {target.quantity} of {rows.min():.3g}, must be positive")
    return Result({target.quantity: rows}, count=len(rows))
