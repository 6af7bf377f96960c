"""What a scene says of itself, whichever body it has."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, fields, is_dataclass
from types import MappingProxyType
from typing import Any, ClassVar, NamedTuple, Protocol, Self

import numpy as np

from validation.analysis.contents import as_html
from validation.analysis.escapes import one_line, shortened_text
from validation.analysis.statistics import FloatArray
from validation.scenes.material import Material
from validation.scenes.roughness import RoughSurface
from validation.scenes.units import in_unit


@dataclass(frozen=True)
class SceneQuantity:
    """A quantity that scenes have.

    key: in scripts, on the command line and in files; unit: of its amplitude; reference: of its decibels, in SI units;
    in_bands: whether it is a level in each one-third octave, else one number; of_motion: whether the wheel has to move;
    by_worst_band: whether a tolerance holds in each band that counts, else over the root mean square of all;
    counted_above: level above which a band counts, up to the first that is not [dB]; averaged_itself: whether
    realisations have the mean of their values, else that of their logarithms.
    """

    key: str
    unit: str
    reference: float = 1.0
    in_bands: bool = False
    of_motion: bool = False
    by_worst_band: bool = False
    counted_above: float = -math.inf
    averaged_itself: bool = False

    def __str__(self) -> str:
        return self.key


STIFFNESS = SceneQuantity("stiffness", "N/m", averaged_itself=True)
CONTACT_AREA = SceneQuantity("contact-area", "m²", averaged_itself=True)
MEAN_GAP = SceneQuantity("mean-gap", "m", averaged_itself=True)
FORCE_RMS = SceneQuantity("force-rms", "N")
FORCE_SPECTRUM = SceneQuantity("force-spectrum", "N", in_bands=True)
ACCELERATION = SceneQuantity("acceleration", "m/s²", in_bands=True, of_motion=True)
ACCELERATION_RMS = SceneQuantity("acceleration-rms", "m/s²", of_motion=True)
PRESSED = (STIFFNESS,)
INTERFACE = (CONTACT_AREA, MEAN_GAP)
"""Of a rough punch: the true contact area, and the mean distance of the deformed faces over the side."""
ROLLING = (FORCE_RMS, FORCE_SPECTRUM)
MOVING = (ACCELERATION, ACCELERATION_RMS)


Pairs = tuple[tuple[str, str], ...]
"""Names and values with their units, in the order in which they are printed."""
LATER = MappingProxyType({"later": True})
"""Metadata of a field that came after the first release: without a value it is in no key of what is stored."""
ENSEMBLE_MEAN, SINGLE_SURFACE = "ensemble mean", "single surface"


class ContactEllipse(NamedTuple):
    """Hertz's contact of the smooth bodies: semi-axes a_x along the track and a_y [m], approach [m], force F [N]."""

    along: float
    across: float
    approach: float
    load: float

    @property
    def mean_pressure(self) -> float:
        """F / (pi a_x a_y) [Pa]."""
        return self.load / (math.pi * self.along * self.across)

    @property
    def largest_pressure(self) -> float:
        """3 F / (2 pi a_x a_y) of Hertz [Pa]."""
        return 1.5 * self.mean_pressure


class Scene(Protocol):
    """A loaded body on an elastic half-space, rough or smooth: what each kind of scene says of itself.

    Attributes
    ----------
    name : str
        One line of text.
    kind : {"sphere", "punch", "wheel", "rail"}
        Body.
    load : float
        Normal force F, positive [N].
    modulus : float
        Contact modulus E*, positive [Pa].
    material : Material or None
        What E* is made of, None where only ``modulus`` is known.
    speed, mass : float or None
        Of a wheel, positive [m/s], [kg]; None where it has none.
    damping : float
        Ratio to critical damping, zero or positive [-].
    ground : RoughSurface or None
        Roughness as a surface; None where smooth, and where lines alone are known.
    quantities : tuple of SceneQuantity
        That it has; the first is the default.
    smooth_contact : ContactEllipse or None
        Without roughness; None under a flat punch.
    mean_pressure : float
        Of the smooth contact [Pa].
    size_key, roughness_key : str
        Keys of a scene file: of the size, as "wheel.radius", and of generated roughness, empty where there may be none.
    roughness_levels : ndarray, shape (bands,)
        L_r in each band [dB re 1 µm]; empty where roughness is no line.
    statistic : {"ensemble mean", "single surface", ""}
        What a value is of; empty of smooth bodies.
    sample_note : str
        Why nobody may ask for a number of realisations, where no model of the scene generates as many as are asked.
    error_source : str
        What errors of models rest on; empty where that is the table of the calibration.
    shares_solves : bool
        Whether one solve has all of its quantities.

    Examples
    --------
    >>> from validation.scenes.scene import Scene
    >>> scene: Scene = validation.load_scene("rolling_wheel")
    >>> scene.kind, [str(quantity) for quantity in scene.quantities], scene.bands("force-spectrum").shape
    ('wheel', ['force-rms', 'force-spectrum'], (9,))
    """

    @property
    def name(self) -> str: ...
    @property
    def kind(self) -> str: ...
    @property
    def load(self) -> float: ...
    @property
    def modulus(self) -> float: ...
    @property
    def material(self) -> Material | None: ...
    @property
    def speed(self) -> float | None: ...
    @property
    def mass(self) -> float | None: ...
    @property
    def damping(self) -> float: ...
    @property
    def ground(self) -> RoughSurface | None: ...

    @property
    def quantities(self) -> tuple[SceneQuantity, ...]:
        """That it has; the first is the default."""

    def bands(self, quantity: str) -> FloatArray:
        """Centres of the one-third octaves of a quantity [rad/m], none of one number."""

    @property
    def smooth_contact(self) -> ContactEllipse | None:
        """The contact ellipse of the bodies without roughness; None under a flat punch."""

    @property
    def mean_pressure(self) -> float:
        """The load over the area of the smooth contact [Pa]."""

    @property
    def size_key(self) -> str:
        """The key of a scene file that has the size of the body, as "wheel.radius"."""

    @property
    def roughness_key(self) -> str:
        """The table of a scene file that has the generated roughness; empty where there may be none."""

    @property
    def roughness_levels(self) -> FloatArray:
        """L_r in each band [dB re 1 µm]; empty where roughness is no line."""

    @property
    def statistic(self) -> str:
        """What a value is of: all surfaces that are drawn, or the one that was measured; empty of smooth bodies."""

    @property
    def sample_note(self) -> str:
        """Why nobody may ask for a number of realisations, where no model of the scene draws as many as are asked."""

    @property
    def error_source(self) -> str:
        """What errors of models rest on, in words; empty where that is the table of the calibration."""

    @property
    def shares_solves(self) -> bool:
        """Whether one solve has all of its quantities."""

    def no_answer(self, quantity: str) -> str:
        """Why there is no such value, whatever the model; empty where there is one."""

    def no_steady_answer(self) -> str:
        """Why the level of the motion depends on the distance; empty where it does not, and without a motion."""

    def diagnose(self) -> tuple[str, ...]:
        """What may be wrong about it though it is valid, in sentences with numbers."""

    def describe(self) -> Pairs:
        """Body, contact, motion and roughness."""

    def contact_force(self, comparison: Any) -> Any:
        """A-weighted force by each model of a comparison of this scene; None where it has none."""

    def sound_power(self, comparison: Any) -> Any:
        """Sound power by each model of a comparison of this scene; None where it has none."""

    def added_to_filter(self, quantity: str) -> tuple[FloatArray, FloatArray]:
        """L_r in each band of a quantity, empty where roughness is no line, and what the quantity is over L_r + A3."""

    def for_compare(self) -> "Scene":
        """The scene without what `compare` has no need of. Raises ValueError for one that no model takes."""


def values_of(scene: Any) -> dict[str, Any]:
    """Fields of a scene and their values, but for `LATER` ones without a value."""
    values = {each.name: (getattr(scene, each.name), each.metadata) for each in fields(scene)}
    return {name: value for name, (value, about) in values.items() if value is not None or "later" not in about}


def parameters_of(scene: Any) -> dict[str, float | str | None]:
    """Numbers and texts of a scene and of what it holds in SI units, by their names in Python, as "ground.rms".

    Arrays and tuples, as heights and levels, are left out.
    """

    def walk(part: Any, path: str) -> Iterator[tuple[str, Any]]:
        for name in (each.name for each in fields(part)):
            value = getattr(part, name)
            if is_dataclass(value):
                yield from walk(value, f"{path}{name}.")
            elif value is None or isinstance(value, str | int | float):
                yield f"{path}{name}", value

    return dict(walk(scene, ""))


class SceneDefaults:
    """What most scenes answer."""

    ground: RoughSurface | None
    shares_solves: ClassVar[bool] = False

    def __repr__(self) -> str:
        scene: Any = self
        size = getattr(scene, "size", None) or scene.radius
        parts = [
            repr(shortened_text(scene.name)),
            f"{scene.size_key.partition('.')[2]}={in_unit(size, 'length')}",
            f"load={in_unit(scene.load, 'force')}",
            *([f"speed={in_unit(scene.speed, 'speed')}"] if scene.speed is not None else []),
            *([f"rms={in_unit(scene.ground.rms, 'length')}"] if scene.ground is not None else []),
        ]
        return one_line(f"{type(self).__name__}({', '.join(parts)})")

    def _repr_html_(self) -> str:
        """What `describe` says, as a table."""
        scene: Any = self
        names, texts = zip(*scene.describe(), strict=True)
        return as_html(scene.name, {"": names, " ": texts})

    @property
    def error_source(self) -> str:
        return ""

    @property
    def roughness_levels(self) -> FloatArray:
        return np.empty(0)

    def bands(self, quantity: str) -> FloatArray:
        return np.empty(0)

    @property
    def statistic(self) -> str:
        return "" if self.ground is None else SINGLE_SURFACE if self.ground.is_single else ENSEMBLE_MEAN

    @property
    def sample_note(self) -> str:
        return "its body is smooth" if self.ground is None else "its heights are measured, one surface"

    def no_answer(self, quantity: str) -> str:
        return ""

    def no_steady_answer(self) -> str:
        return ""

    def contact_force(self, comparison: Any) -> Any:
        return None

    def sound_power(self, comparison: Any) -> Any:
        return None

    def added_to_filter(self, quantity: str) -> tuple[FloatArray, FloatArray]:
        return np.empty(0), np.empty(0)

    def for_compare(self) -> Self:
        return self
