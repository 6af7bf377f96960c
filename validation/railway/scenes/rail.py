"""The scene of a wheel on a real rail: two radii or a profile, roughness as levels of a line, and what lies across."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, ClassVar, Literal

import numpy as np

from mdr.checks import count, positive
from validation.analysis.escapes import quoted, shortened
from validation.analysis.spectra import NominalBands
from validation.analysis.statistics import FloatArray
from validation.engine.former_names import renamed_field
from validation.railway.scenes.isotropic_line import IsotropicLine, isotropic_line
from validation.railway.scenes.level_files import MICROMETRE, RoughnessLevels
from validation.railway.scenes.measured_lines import MeasuredLines
from validation.railway.scenes.transverse_profile import TransverseProfile, fitted_radius
from validation.railway.theory.line_coherence import LateralEstimate, ParallelLines, in_words
from validation.railway.theory.sound_power import (
    DEFAULT_TRACK,
    MOST_AXLES,
    SoundTransfer,
    frequencies,
    in_frequency,
    nearest_wheel,
    tracks,
    wheels,
)
from validation.railway.theory.transverse_structure import IsotropicGround
from validation.scenes.description import damping_of
from validation.scenes.material import Material, check_scene
from validation.scenes.measured_heights import MeasuredHeights, check_covers
from validation.scenes.rail_impedance import RailImpedance
from validation.scenes.reader import errors_of
from validation.scenes.scene import ENSEMBLE_MEAN, LATER, ContactEllipse, Pairs, SceneDefaults, SceneQuantity
from validation.scenes.units import in_unit
from validation.scenes.wheel_body import MAX_FORCE, check_damping
from validation.theory.half_space import EllipticContact, elliptic_contact
from validation.theory.rolling import contact_resonance

Across = Literal["ridges", "isotropic"] | float | None
"""What lies across a measured line: ridges; isotropic ground; waves with |k_y| < alpha k_x; None: nobody knows."""

COUNTED = -15.0
"""A3 [dB] above which the tolerance counts: below it nothing is left to hear, and models differ by decibels."""
CONTACT_FILTER = SceneQuantity("contact-filter", "1", in_bands=True, by_worst_band=True, counted_above=COUNTED)
EQUIVALENT_ROUGHNESS = SceneQuantity(
    "equivalent-roughness", "µm", MICROMETRE, in_bands=True, by_worst_band=True, counted_above=COUNTED
)
SOUND_POWER = SceneQuantity("sound-power", "pW", in_bands=True)
"""Of one axle or of all; an amplitude is the root of the power over 1 pW. Its tolerance is that of the sum in dB(A)."""
QUANTITIES = CONTACT_FILTER, EQUIVALENT_ROUGHNESS, SOUND_POWER
MAX_PRESSURE = 4e9
"""Largest pressure [Pa] that a half-space of steel is asked for."""
POINTS = 400
"""To a band, of the force in motion."""
HALF_HEAD = 0.036
"""Half of the width of the head of a rail [m], 72 mm of 60E1."""
WIDE = 0.1
"""Semi-axis of the contact over the radius along it: beyond it the bodies are no half-spaces."""
NARROWEST, WIDEST = 0.1, 6.0
"""a_y / a_x: of a gauge corner of 13 mm, and of a crown of 7 m. The cells of a strip go with the square of the longer
axis over the shorter: ten million at these ends."""
LEAST_ALPHA, MOST_ALPHA = 0.1, 10.0
"""Waves within 6 and 84 degrees of the track: less are ridges to a strip, whose width holds no wave as long; of more,
hardly any run along the track."""
LONGEST_OF_CONTACT, SHORTEST_OF_CONTACT = 10.0, 0.45
"""Wavelengths over the half-length of the contact, one of which at least the roughness must have."""


@renamed_field("across", "lateral_structure")
@dataclass(frozen=True, kw_only=True, repr=False)
class RailScene(SceneDefaults):
    """A wheel that rolls along a rail with rough surfaces.

    Parameters
    ----------
    name : str
        One line of text.
    radius : float
        Rolling radius of the wheel [m].
    load : float
        Static load of one wheel [N].
    modulus : float
        Contact modulus E* [Pa].
    roughness : RoughnessLevels, MeasuredLines or MeasuredHeights
        Of wheel and rail together: levels of a line, measured lines, or heights whose first axis is along the track.
    transverse_radius, crown_radius : float or None, optional
        Radii of wheel and rail across the track [m], None where straight; one of the two is given.
    speed, mass : float or None, optional
        Of the wheel [m/s], [kg]. Without a speed there are wavelengths alone, without a mass no dynamic wheel.
    material : Material or None, optional
        What E* is made of, None where only ``modulus`` is known.
    lateral_structure : "ridges", "isotropic", float or None, optional
        Lateral structure of the roughness: ridges, isotropic ground, or waves with abs(k_y) < alpha k_x. None: that
        of the coherence of parallel lines, with its interval in each band; of anything else ridges and isotropic
        ground, as both ends.
    notes : tuple of str, optional
        What was assumed where the scene was made, in sentences.
    damping : float, optional
        Damping ratio of a wheel with a mass, as of `RollingScene`. None by default.
    impedance : RailDashpot, FreeBeam or None, optional
        Of the rail under a wheel with a mass: a dashpot with or without a mass, or a free beam. None: a rigid rail.
    track : str or None, optional
        Column of table G-3a of CNOSSOS-EU, as "M/S"; None: "M/M".
    transfer : int or None, optional
        Column of table G-3b, a diameter of wheels [mm]; None: that nearest to the diameter of the wheel.
    axles : int or None, optional
        Number of axles whose sound power is summed; None: one.

    Raises
    ------
    ValueError, TypeError
        If a value is out of range; the message names the key of a scene file.

    Examples
    --------
    >>> contact = validation.load_scene("rail").contact
    >>> print(f"{contact.along:.3g} m along, {contact.across:.3g} m across, pressed by {contact.approach:.3g} m")
    0.00568 m along, 0.00428 m across, pressed by 6.56e-05 m
    """

    kind: ClassVar[str] = "rail"
    ground = None
    quantities: ClassVar[tuple[SceneQuantity, ...]] = QUANTITIES
    shares_solves: ClassVar[bool] = True
    size_key: ClassVar[str] = "wheel.radius"
    roughness_key: ClassVar[str] = ""

    name: str
    radius: float
    load: float
    modulus: float
    roughness: RoughnessLevels | MeasuredLines | MeasuredHeights
    transverse_radius: float | None = None
    crown_radius: float | None = None
    speed: float | None = None
    mass: float | None = None
    material: Material | None = None
    lateral_structure: Across = None
    notes: tuple[str, ...] = ()
    damping: float = 0.0
    impedance: RailImpedance | None = field(default=None, metadata=LATER)
    track: str | None = field(default=None, metadata=LATER)
    transfer: int | None = field(default=None, metadata=LATER)
    axles: int | None = field(default=None, metadata=LATER)

    def __post_init__(self) -> None:
        optional = ("wheel.transverse_radius", "rail.crown_radius", "wheel.speed", "wheel.mass")
        check_scene(self, ("wheel.radius", "wheel.load"), optional)
        check_damping(self.damping, self.mass)
        if self.impedance is not None and self.mass is None:
            raise ValueError(
                "rail.impedance needs a mass: under a constant load a rail does not move, got it alone, as: "
                'mass = "500 kg" of wheel'
            )
        if self.transverse_radius is None and self.crown_radius is None:
            raise ValueError(
                "rail.crown_radius or wheel.transverse_radius must be given, got none: the contact is no ellipse"
            )
        if not isinstance(self.roughness, RoughnessLevels | MeasuredLines | MeasuredHeights):
            kind = type(self.roughness).__name__
            raise TypeError(f"roughness must be RoughnessLevels, MeasuredLines or MeasuredHeights, got {kind}")
        if self.lateral_structure not in ("ridges", "isotropic", None):
            _check_alpha(self.lateral_structure)
        _check_transfer(self)
        _check_contact(self)
        if isinstance(self.roughness, MeasuredHeights):
            if self.lateral_structure is not None:
                raise ValueError(
                    "rail.lateral_structure must be left out beside rail.heights, which have it, "
                    f"got {self.lateral_structure!r}"
                )
            along, across = self.contact.along, self.contact.across
            check_covers("rail.heights", self.roughness, (4 * math.pi * along, 3 * across), min(along, across))
        else:
            _check_bands(self)

    @property
    def radii(self) -> tuple[float, float]:
        """(along, across) of both bodies together, their curvatures added [m]."""
        curvature = sum(1 / radius for radius in (self.transverse_radius, self.crown_radius) if radius is not None)
        return self.radius, 1 / curvature

    @cached_property
    def contact(self) -> EllipticContact:
        """Of the smooth bodies under the static load."""
        return elliptic_contact(self.radii, modulus=self.modulus, force=self.load)

    @property
    def smooth_contact(self) -> ContactEllipse:
        """The ellipse of Hertz."""
        return ContactEllipse(self.contact.along, self.contact.across, self.contact.approach, self.load)

    @property
    def mean_pressure(self) -> float:
        """F / (pi a_x a_y) [Pa]."""
        return self.smooth_contact.mean_pressure

    @cached_property
    def levels(self) -> RoughnessLevels:
        """Levels of one line along the track; of several that were measured, of their mean energy."""
        if isinstance(self.roughness, RoughnessLevels):
            return self.roughness
        if isinstance(self.roughness, MeasuredLines):
            return self.roughness.levels
        with errors_of("rail.heights."):
            return MeasuredLines.of_heights(self.roughness).levels

    @cached_property
    def isotropic(self) -> IsotropicLine | None:
        """The line of isotropic ground nearest to the levels; None where other ground is stated."""
        if self.lateral_structure not in ("isotropic", None):
            return None
        waves = 1 / self.levels.bands.wavelengths
        few = not isinstance(self.roughness, RoughnessLevels)
        weights = waves / np.median(waves) if few else np.ones_like(waves)
        return isotropic_line(self.levels, weights)

    @cached_property
    def sound_transfer(self) -> SoundTransfer:
        """From the equivalent roughness to sound power, with what stands for keys that are left out."""
        wheel = nearest_wheel(2 * self.radius) if self.transfer is None else int(self.transfer)
        return SoundTransfer(self.track or DEFAULT_TRACK, wheel, self.axles or 1)

    @property
    def parallel_lines(self) -> ParallelLines | None:
        """Of several measured lines, where no other lateral structure is stated."""
        lines = self.roughness
        if self.lateral_structure is not None or not isinstance(lines, MeasuredLines) or len(lines.positions) < 2:
            return None
        return ParallelLines(lines.height, lines.spacing, lines.positions)

    @cached_property
    def measured_structure(self) -> tuple[LateralEstimate, ...] | None:
        """Lateral structure in each band by the coherence of parallel lines; None without such lines."""
        lines, isotropic = self.parallel_lines, self.isotropic
        if lines is None or isotropic is None or self.levels.fault:
            return None
        return lines.estimates(self.levels.bands, IsotropicGround(isotropic.line))

    def frequency(self, wavelength: float) -> float:
        """f = v / lambda [Hz], NaN without a speed."""
        return math.nan if self.speed is None else self.speed / wavelength

    @property
    def force_in_motion(self) -> float:
        """Rms change of the contact force by linear theory, over the load; NaN without mass and speed.

        <F^2> = sum over bands of <r^2> abs(1 / (1/k + R_wheel + R_rail))^2, R the receptances -1 / (M w^2 - i c w) and
        1 / (i w Z), r the levels through the filter of ridges, sin(k a_x) / (k a_x). Infinite at a resonance that
        nothing damps.
        """
        if self.mass is None or self.speed is None:
            return math.nan
        edges, k = np.log(self.levels.bands.edges), self.contact.stiffness
        q = np.exp(edges[:-1, np.newaxis] + np.diff(edges)[:, np.newaxis] * ((np.arange(POINTS) + 0.5) / POINTS))
        omega, dashpot = q * self.speed, 2 * self.damping * math.sqrt(k * self.mass)
        compliance = np.asarray(1 / k - 1 / (self.mass * omega**2 - 1j * dashpot * omega), dtype=np.complex128)
        if self.impedance is not None:
            compliance = compliance + 1 / (1j * omega * self.impedance.impedance(omega))
        elif not self.damping and omega[0, 0] < math.sqrt(k / self.mass) < omega[-1, -1]:
            return math.inf
        passed = np.mean((np.sinc(q * self.contact.along / np.pi) / np.abs(compliance)) ** 2, axis=1)
        power = MICROMETRE**2 * 10 ** (self.roughness_levels / 10)
        return math.sqrt(float(np.sum(power * passed))) / self.load

    @property
    def resonance(self) -> float:
        """Of wheel and rail on the contact spring [Hz]; NaN without a mass."""
        if self.mass is None:
            return math.nan
        if self.impedance is None:
            return math.sqrt(self.contact.stiffness / self.mass) / (2 * math.pi)
        wheel = {"stiffness": self.contact.stiffness, "mass": self.mass}
        return contact_resonance(impedance=self.impedance.impedance, **wheel) / (2 * math.pi)

    @property
    def statistic(self) -> str:
        """Of strips that are drawn."""
        return ENSEMBLE_MEAN

    @property
    def sample_note(self) -> str:
        """Why nobody may ask for a number of realisations."""
        return "each model of a rail has as many strips as its errors were measured on"

    @property
    def roughness_levels(self) -> FloatArray:
        """L_r in each band [dB re 1 µm]."""
        return np.array(self.levels.levels)

    def bands(self, quantity: str) -> FloatArray:
        """2 pi over the nominal wavelengths [rad/m]; of sound power over v / f at nominal frequencies."""
        if quantity == str(SOUND_POWER):
            return 2 * math.pi * frequencies() / (self.speed or math.nan)
        return 2 * math.pi / self.levels.bands.nominal

    def added_to_filter(self, quantity: str) -> tuple[FloatArray, FloatArray]:
        """L_r [dB re 1 µm] in each band of a quantity, and what the quantity is over L_r + A3 [dB]."""
        if quantity != str(SOUND_POWER) or self.speed is None:
            over = 0.0 if quantity == str(EQUIVALENT_ROUGHNESS) else -self.roughness_levels
            return self.roughness_levels, over + np.zeros(len(self.levels.bands))
        return in_frequency(self.levels.levels, self.levels.bands.nominal, self.speed), self.sound_transfer.of_both

    def no_answer(self, quantity: str) -> str:
        """Why there is no sound power: no speed, or no roughness in its bands; empty of other quantities."""
        if quantity != str(SOUND_POWER):
            return ""
        if self.speed is None:
            return 'wheel.speed is missing, by which each wavelength has its frequency, as: speed = "80 km/h"'
        if np.isnan(self.added_to_filter(quantity)[0]).all():
            return (
                f"wheel.speed must bring a wavelength of the roughness, {self.levels.bands.span}, to 50 Hz to 10 kHz, "
                f"got {3.6 * self.speed:.4g} km/h"
            )
        return ""

    @property
    def error_source(self) -> str:
        """What errors of models rest on, in words."""
        # imported here, since models are of this scene
        from validation.railway.problems.rail_models import MEASURED_ON_STRIPS

        return MEASURED_ON_STRIPS

    def contact_force(self, comparison: Any) -> Any:
        """A-weighted force by each model, where the wheel has a speed: for files alone, and for one release."""
        from validation.railway.rail_columns import contact_force

        return contact_force(self, comparison)

    def sound_power(self, comparison: Any) -> Any:
        """Sound power by each model, where the wheel has a speed."""
        from validation.railway.rail_columns import sound_power

        return sound_power(self, comparison)

    def describe(self) -> Pairs:
        """Bodies, the contact that is assumed, motion, roughness, and what lies across."""
        contact, levels = self.contact, self.levels
        axes = f"a_x = {_short(contact.along)} along, a_y = {_short(contact.across)} across"
        slope, ratio = levels.slope_along, levels.slope_along * contact.along / contact.approach
        return (
            *self._bodies(),
            ("contact ellipse", f"{axes}, of the smooth bodies"),
            ("approach d", _short(contact.approach)),
            ("peak pressure p0", in_unit(contact.pressure, "pressure", digits=3)),
            ("motion", self._motion()),
            *self._dynamics(),
            ("roughness", f"rms {_short(levels.rms)} over all bands: {self._source()}"),
            ("bands", f"{len(levels.bands)} one-third octaves, {levels.bands.span}"),
            ("rms slope h'", f"{slope:.3g} along the track, of all bands, h' a_x/d = {ratio:.3g}"),
            ("what lies across", self._structure()),
            *(() if self.speed is None else (("sound power", self._sound()),)),
        )

    def _sound(self) -> str:
        """Which tables it is of, and which of them stand for a key that is left out."""
        keys = {"rail.track": self.track, "wheel.transfer": self.transfer}
        left_out = [key for key, value in keys.items() if value is None]
        assumed = f"; {' and '.join(left_out)} left out" if left_out else ""
        return f"{self.sound_transfer.in_words}{assumed}"

    def _bodies(self) -> Pairs:
        radius, load = f"radius {in_unit(self.radius, 'length')}", f"load {in_unit(self.load, 'force')} of one wheel"
        wheel, rail = (
            "straight across" if across is None else f"radius {in_unit(across, 'length')} across"
            for across in (self.transverse_radius, self.crown_radius)
        )
        return ("wheel", f"{radius}, {wheel}, {load}"), ("rail", rail)

    def _motion(self) -> str:
        if self.speed is None:
            return "none: wavelengths have no frequencies"
        mass = "" if self.mass is None else f"mass {in_unit(self.mass, 'mass')}"
        return ", ".join(filter(None, (f"speed {3.6 * self.speed:.5g} km/h", mass, damping_of(self.damping))))

    def _dynamics(self) -> Pairs:
        """The rail, the resonance and the force of a wheel with a mass; nothing of one without."""
        if self.mass is None or self.speed is None:
            return ()
        rail, force = "rigid", self.force_in_motion
        if self.impedance is not None:
            z = abs(complex(self.impedance.impedance(2 * math.pi * self.resonance)))
            rail = f"{self.impedance.description}, abs(Z) = {z:.3g} N s/m at the contact resonance"
        rms = f"rms {100 * force:.3g} % of the load" if math.isfinite(force) else "unbounded, nothing damps it"
        motion = f"contact resonance {self.resonance:.4g} Hz; force by linear theory {rms}"
        return ("impedance of the rail", rail), ("wheel in motion", motion)

    def _source(self) -> str:
        if isinstance(self.roughness, MeasuredHeights):
            return self.roughness.waves
        if isinstance(self.roughness, MeasuredLines) and len(self.roughness.positions) > 1:
            places = ", ".join(f"{1000 * position:g}" for position in self.roughness.positions)
            return f"{self.levels.source}, at {places} mm across"
        return self.levels.source

    def _structure(self) -> str:
        if isinstance(self.roughness, MeasuredHeights):
            return "measured"
        words = {
            None: "not given: from ridges to isotropic ground",
            "isotropic": "isotropic ground",
            "ridges": "ridges",
        }
        if self.measured_structure is not None and self.parallel_lines is not None:
            count = len(self.parallel_lines.positions)
            return f"by the coherence of {count} lines: {in_words(self.measured_structure, self.levels.bands)}"
        if self.lateral_structure is None or isinstance(self.lateral_structure, str):
            return words[self.lateral_structure]
        angle = math.degrees(math.atan(self.lateral_structure))
        return f"waves within {angle:.3g} degrees of the track, alpha = {self.lateral_structure:g}"

    def diagnose(self) -> tuple[str, ...]:
        """What may be wrong about this scene though it is valid, in sentences with numbers."""
        return (*self.notes, *self._doubts())

    def _doubts(self) -> Iterator[str]:
        contact = self.contact
        if contact.pressure > MAX_PRESSURE:
            yield (
                f"the largest pressure is {contact.pressure / 1e9:.3g} GPa, more than {MAX_PRESSURE / 1e9:g} GPa: "
                "steel yields; is wheel.load that of one wheel?"
            )
        for side, semi_axis, radius in (
            ("along", contact.along, self.radii[0]),
            ("across", contact.across, self.radii[1]),
        ):
            if semi_axis > WIDE * radius:
                yield (
                    f"the contact is wider than the crown of the bodies: {semi_axis / radius:.3g} of the radius {side} "
                    f"the track, {in_unit(radius, 'length')}, more than a tenth: no half-space."
                )
        if contact.across > HALF_HEAD:
            width, head = in_unit(2 * contact.across, "length", digits=3), in_unit(2 * HALF_HEAD, "length")
            yield (
                f"the contact is wider than the crown: {width} across, the head of a rail has {head}; are the units of "
                "rail.crown_radius and wheel.load right?"
            )
        if (bands := self.levels.bands) != NominalBands():
            yield (
                f"roughness is known in bands of {bands.span}: the others of {NominalBands().span} are missing, and "
                "have no answer."
            )
        if self.force_in_motion > MAX_FORCE:
            change = f"changes by {self.force_in_motion:.3g} of the load, root mean square by linear theory, more than "
            if math.isinf(self.force_in_motion):
                change = "has no bound by linear theory, since nothing damps the contact resonance: its limit is "
            yield (
                f"in motion the contact force {change}{MAX_FORCE:g}; the wheel leaves the rail at times. The contact "
                "filter is that of a constant load."
            )
        if (lines := self.parallel_lines) is not None and lines.shifts.any():
            shown = ", ".join(f"{1e3 * shift:g}" for shift in lines.shifts)
            yield (
                f"lines are shifted along the track by about {shown} mm relative to the first: their coherence has "
                "no lateral structure; cut them so that they begin at one place."
            )
        yield from self._scatter()
        if isinstance(self.roughness, MeasuredHeights):
            yield from self.roughness.notes()

    def _scatter(self) -> Iterator[str]:
        """What no isotropic ground has, where it may be isotropic."""
        if (ground := self.isotropic) is None or ground.as_it_is:
            return
        yield (
            f"the levels scatter by {ground.scatter:.2g} dB rms about the smooth line that isotropic ground is given: "
            "what that leaves is in the error of each band."
        )
        if ground.stands_out.any():
            taken = (
                "the smooth line"
                if self.lateral_structure is None
                else "the range from the smooth line's to that of ridges"
            )
            yield (
                f"no isotropic ground has the levels at {self.levels.bands.names(ground.stands_out)}, which rise too "
                f"steeply or stand out of their neighbours: there it has {taken}."
            )


def _short(length: float) -> str:
    return in_unit(length, "length", digits=3)


def _check_alpha(alpha: Any) -> None:
    if not LEAST_ALPHA <= positive("rail.lateral_structure", alpha) <= MOST_ALPHA:
        raise ValueError(
            f"rail.lateral_structure must be a number alpha from {LEAST_ALPHA:g} to {MOST_ALPHA:g}, waves within 6 to "
            f'84 degrees of the track, got {alpha:g}; "ridges" stands for less, "isotropic" for all directions'
        )


def _check_transfer(scene: RailScene) -> None:
    """Raises ValueError, TypeError for columns that tables G-3a and G-3b have not."""
    if scene.track is not None and scene.track not in tracks():
        raise ValueError(
            f"rail.track must be one of {', '.join(map(quoted, tracks()))}, sleeper and pad, table G-3a of CNOSSOS-EU, "
            f"got {shortened(scene.track)}; left out: {quoted(DEFAULT_TRACK)}"
        )
    if scene.transfer is not None and scene.transfer not in wheels():
        raise ValueError(
            f"wheel.transfer must be one of {', '.join(map(str, wheels()))}, diameters in mm of table G-3b of "
            f"CNOSSOS-EU, got {shortened(scene.transfer)}; left out: the nearest to that of the wheel"
        )
    if scene.axles is not None and count("wheel.axles", scene.axles, least=1) > MOST_AXLES:
        raise ValueError(f"wheel.axles must be at most {MOST_AXLES}, got {shortened(scene.axles)}")


def _check_bands(scene: RailScene) -> None:
    """Raises ValueError for roughness of which no band is near the length of the contact, which no model filters."""
    along, waves = scene.contact.along, scene.levels.wavelengths
    ends = LONGEST_OF_CONTACT * along, SHORTEST_OF_CONTACT * along
    try:
        scene.levels.bands.within(*ends)
    except ValueError:
        far, near, first, last, half = (in_unit(x, "length", digits=3) for x in (*ends, waves[0], waves[-1], along))
        raise ValueError(
            f"wheel.load must press a contact that filters a wavelength of the roughness, {first} to {last}, "
            f"got one of {half} to both sides, which filters {near} to {far}: another load or shorter waves are needed"
        ) from None


def _check_contact(scene: RailScene) -> None:
    """Raises ValueError for one that is larger than the wheel, or too narrow or wide for a strip around it."""
    contact, profiled = scene.contact, isinstance(scene, ProfiledRail)
    for side, semi_axis, radius in zip(("along", "across"), contact.semi_axes, scene.radii, strict=True):
        if not semi_axis < radius:
            raise ValueError(
                f"wheel.load must leave a contact smaller than the radius {side} the track, {radius:g} m, got "
                f"{semi_axis:g} m"
            )
    if not NARROWEST <= (ratio := contact.across / contact.along) <= WIDEST:
        shape = "is narrower than that of a gauge corner" if ratio < NARROWEST else "is nearly a line"
        key = "profile" if profiled else "rail.crown_radius and wheel.transverse_radius"
        instead = "" if profiled else ', a measured shape has its own width, as: profile = "head.csv"'
        raise ValueError(
            f"{key} must leave a contact {NARROWEST:g} to {WIDEST:g} times as wide as long, got {ratio:.3g} times, "
            f"which {shape}{instead}"
        )


@renamed_field("across", "lateral_structure")
@dataclass(frozen=True, kw_only=True)
class ProfiledRail(RailScene):
    """A wheel on a rail with a transverse profile.

    Boundary elements take the profile itself. All else takes `radii` of a fit: the ellipse of contact, linear theory,
    springs, and the bands and strips on which models are compared.

    profile: of both bodies together, zero and highest at y = 0 [m]. The radius across is not given: `crown_radius`
    becomes that of the fit over the contact, of both bodies, and `transverse_radius` is None. offset: where y = 0 of
    the wheel stands on the rail [m]. Other fields: as of `RailScene`. Raises ValueError, too, for a profile that has no
    such radius.
    """

    profile: TransverseProfile
    offset: float = 0.0

    def __post_init__(self) -> None:
        if self.transverse_radius is not None:
            raise ValueError(f"wheel.transverse_radius must be part of the profile, got {self.transverse_radius} m")
        for name in ("radius", "load"):
            positive(f"wheel.{name}", getattr(self, name))
        positive("modulus", self.modulus)
        fitted = fitted_radius(self.profile, along=self.radius, modulus=self.modulus, load=self.load)
        object.__setattr__(self, "crown_radius", fitted)
        super().__post_init__()

    def _bodies(self) -> Pairs:
        """The profile of both stands with the rail."""
        radius, load = f"radius {in_unit(self.radius, 'length')}", f"load {in_unit(self.load, 'force')} of one wheel"
        both = f"profile of {self.profile.source} across, radius {_short(self.radii[1])} fitted over the contact"
        return ("wheel", f"{radius}, {load}"), ("wheel and rail", both), ("contact lies at", self.contact_place)

    def diagnose(self) -> tuple[str, ...]:
        """With what stands in for the profile."""
        return (f"{self.stand_in}.", *super().diagnose())

    @property
    def contact_place(self) -> str:
        """Where the contact lies, in words."""
        on_rail, on_wheel = (round(1e3 * y, 3) + 0.0 for y in (self.profile.at, self.profile.at - self.offset))
        inclined = f"{math.degrees(self.profile.inclination):.2g} degrees"
        return f"y = {on_rail:g} mm on the rail, {on_wheel:g} mm on the wheel, inclined by {inclined}"

    @property
    def stand_in(self) -> str:
        """What models of two radii assume, in words."""
        radius, half = (in_unit(length, "length", digits=3) for length in (self.radii[1], self.contact.across))
        return (
            f"the transverse profile of {self.profile.source} has a radius of {radius}, fitted over the contact, "
            f"{half} to both sides: boundary elements of compare take the profile, all other models that radius"
        )
