"""The scene of a body pressed onto a half-space: a sphere or a square punch, smooth or rough."""

import math
from dataclasses import dataclass
from typing import ClassVar, Literal

from mdr.checks import positive
from validation.analysis.escapes import shortened
from validation.scenes.description import COUNTED, body_pairs, roughness_pairs, waves_of
from validation.scenes.material import Material, check_scene
from validation.scenes.measured_heights import SQUARE, MeasuredHeights, check_covers
from validation.scenes.roughness import Roughness, RoughSurface, check_band
from validation.scenes.scene import INTERFACE, PRESSED, ContactEllipse, Pairs, SceneDefaults, SceneQuantity
from validation.scenes.units import in_unit
from validation.scenes.wheel_body import OnHalfSpace, Wheel
from validation.theory.closed_forms import square_punch_stiffness

Shape = Literal["sphere", "punch"]

MOST_PRESSURE, SOFTEST = 0.1, 1e3
"""Of E*, that a half-space bears without large strains; E* [Pa] below which its unit is asked for. 1 is no pressure."""


@dataclass(frozen=True, kw_only=True, repr=False)
class IndentationScene(OnHalfSpace, SceneDefaults):
    """Rigid sphere or square punch, smooth or rough, pressed onto an elastic half-space.

    Parameters
    ----------
    name : str
        One line of text.
    shape : {"sphere", "punch"}
        Body.
    size : float
        Radius of the sphere or side of the punch [m].
    load : float
        Normal force F [N].
    modulus : float
        Contact modulus E* [Pa].
    ground : Roughness or MeasuredHeights or None, optional
        Roughness, None where smooth. A measured face is as large as the punch.
    material : Material or None, optional
        What E* is made of, None where only ``modulus`` is known.

    Raises
    ------
    ValueError, TypeError
        If a value is out of range; the message names the key of a scene file.

    Examples
    --------
    >>> scene = validation.IndentationScene(name="ball", shape="sphere", size=0.01, load=10.0, modulus=1e11)
    >>> validation.compare(scene).model
    'closed form'
    """

    speed: ClassVar[None] = None
    mass: ClassVar[None] = None
    damping: ClassVar[float] = 0.0
    roughness_key: ClassVar[str] = "roughness"

    name: str
    shape: Shape
    size: float
    load: float
    modulus: float
    ground: RoughSurface | None = None
    material: Material | None = None

    def __post_init__(self) -> None:
        if self.shape not in ("sphere", "punch"):
            raise ValueError(f'shape must be "sphere" or "punch", got {self.shape!r}')
        positive(self.size_key, self.size)
        check_scene(self, (f"{self.shape}.load",))
        if isinstance(self.ground, Roughness):
            self._check_waves(self.ground)
        elif self.ground is not None:
            self._check_measured(self.ground)

    @property
    def quantities(self) -> tuple[SceneQuantity, ...]:
        """The stiffness; of a rough punch the contact area and the mean gap as well."""
        return (*PRESSED, *INTERFACE) if self.shape == "punch" and self.ground is not None else PRESSED

    @property
    def kind(self) -> Shape:
        """The kind of a pressed scene is the shape of its body."""
        return self.shape

    @property
    def pressure(self) -> float:
        """Mean pressure F / L^2 under a punch [Pa]."""
        return self.load / self.size**2

    @property
    def smooth_contact(self) -> ContactEllipse | None:
        """The contact of Hertz of a sphere; None of a flat punch, which has no such approach."""
        return self.contact_of_hertz if self.shape == "sphere" else None

    @property
    def mean_pressure(self) -> float:
        """F / L^2 under a punch, F / (pi a^2) under a sphere [Pa]."""
        return self.contact_of_hertz.mean_pressure if self.shape == "sphere" else self.pressure

    @property
    def size_key(self) -> str:
        """The key of the size in a scene file."""
        return "sphere.radius" if self.shape == "sphere" else "punch.side"

    @property
    def body(self) -> Wheel:
        """A wheel of unit mass in place of the sphere."""
        return Wheel(radius=self.size, mass=1.0, modulus=self.modulus, load=self.load)

    @property
    def stiffness(self) -> float:
        """Stiffness of the smooth body, 2 E* a or 1.1523 E* L [N/m]."""
        sphere = self.shape == "sphere"
        return self.body.stiffness if sphere else square_punch_stiffness(side=self.size, modulus=self.modulus)

    @property
    def reduced_load(self) -> float:
        """Fbar = F / (E* h L) of a rough punch; infinite where smooth [-]."""
        return self.load / (self.modulus * self.ground.rms * self.size) if self.ground else math.inf

    @property
    def roughness_ratio(self) -> float:
        """h / d of a rough sphere; zero where smooth [-]."""
        return self.ground.rms / self.approach if self.ground else 0.0

    @property
    def error_source(self) -> str:
        """What errors of models rest on; empty where that is the table of the calibration."""
        exact = "errors of models: closed forms are exact for smooth bodies, no measured error is used"
        return "" if self.ground else exact

    def describe(self) -> Pairs:
        """Pairs (name, text with units) on body, contact and roughness."""
        if self.shape == "sphere":
            return *body_pairs("sphere", self.size, self), *roughness_pairs(self, {"waves": self.ground})
        body = ("punch", f"side L = {in_unit(self.size, 'length')}, load {in_unit(self.load, 'force')}")
        if self.ground is None:
            return body, ("roughness", "none")
        # a measured face is as long as its first wave
        longest = f"longest waves on a side: {self.size * self.ground.q_min / (2 * math.pi):.3g}"
        rms = in_unit(self.ground.rms, "length")
        return (
            body,
            ("rms height h", f"{rms}, F / (E* h L) = {self.reduced_load:.3g}"),
            ("rms slope h'", f"{self.ground.slope_along:.3g}, {COUNTED}"),
            ("waves", f"{waves_of(self.ground, None)}; {longest}"),
        )

    def diagnose(self) -> tuple[str, ...]:
        """What may be wrong about this scene though it is valid, in sentences with numbers."""
        notes = self.ground.notes() if self.ground else ()
        if self.shape == "punch" and self.modulus != 1 and self.pressure > MOST_PRESSURE * self.modulus:
            return (
                *notes,
                f"the mean pressure on the punch is {self.pressure / self.modulus:.3g} of E*, more than a tenth: no "
                "half-space; are the units of punch.load, punch.side and E* right?",
            )
        if 1 != self.modulus < SOFTEST:
            notes = *notes, f"E* is {self.modulus:.3g} Pa, softer than a gel: is its unit Pa?"
        return (*notes, *self.diagnose_contact_radius("sphere")) if self.shape == "sphere" else notes

    def _check_waves(self, rough: Roughness) -> None:
        check_band("roughness", rough)
        if self.shape == "punch" and rough.longest > self.size * (1 + 1e-9):
            raise ValueError(
                f"roughness.longest must not exceed the side of the punch, {self.size:g} m, got {rough.longest:g} m"
            )

    def _check_measured(self, heights: object) -> None:
        if not isinstance(heights, MeasuredHeights):
            hint = ": validation.measured(it) makes them" if hasattr(heights, "physical_sizes") else ""
            raise TypeError(f"ground must be Roughness, MeasuredHeights or None, got {shortened(heights)}{hint}")
        longest, shortest = max(heights.sides), min(heights.sides)
        if self.shape == "punch" and longest - shortest > SQUARE * longest:
            raise ValueError(
                f"heights must be as large as the punch, a square, got {heights.sides} m: cut out the central square, "
                "as: crop = true (in Python: measured(surface, crop=True))"
            )
        if self.shape == "punch" and abs(longest / self.size - 1) > SQUARE:
            side = in_unit(longest, "length", digits=9)
            raise ValueError(
                f"heights must be as large as the punch, punch.side = {self.size:g} m, got {heights.sides} m: "
                f'see heights.spacing, or as: side = "{side}"'
            )
        if self.shape == "sphere":
            check_covers("heights", heights, (3 * self.contact_radius,) * 2, self.contact_radius)
