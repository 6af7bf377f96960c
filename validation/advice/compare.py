"""One scene: the quantity, the cheapest model that is accurate enough, and why."""

import functools
import hashlib
import json
import math
import re
import warnings
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field
from functools import cached_property
from pkgutil import resolve_name
from typing import TYPE_CHECKING, Any, ParamSpec

import numpy as np

from bem3d.diagnostics import HIGHEST_PRESSURE
from bem3d.results import kept
from mdr.checks import count
from validation.advice.hierarchy import Candidate, Selection, rejected, select_model
from validation.advice.models_of_scene import (
    BY_NAME,
    ComparedModels,
    Decorated,
    Own,
    models_named,
    models_of,
    names_and_own,
    own_candidates,
    quantities_of,
    quantity_of,
)
from validation.advice.scene_model import SceneModel, Shared
from validation.advice.sound_power import ContactForce, SoundPower
from validation.advice.tolerance import Tolerance, decibels, tolerance_of
from validation.analysis.contents import as_html
from validation.analysis.escapes import one_line, shortened, shortened_text
from validation.analysis.number_text import format_seconds, short
from validation.analysis.spectra import MANTISSAS
from validation.engine.engine import FloatArray
from validation.scenes.scene import Scene, SceneQuantity, values_of
from validation.scenes.units import UNITS, quantity
from validation.simulation.model import Target

if TYPE_CHECKING:
    from matplotlib.axes import Axes

NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S*)\s*")


@dataclass(frozen=True)
class Swept:
    """One value of a key of a scene file. value: in ``unit``, or a text; scene: name of the scene that is varied."""

    key: str
    value: float | str
    unit: str
    scene: str

    @property
    def label(self) -> str:
        """As "wheel.load [kN]"."""
        return f"{self.key} [{self.unit}]" if self.unit else self.key


def swept_values(key: str, texts: Sequence[str], scene: str) -> list[Swept]:
    """The values of texts as in a scene file, all in the unit of the first; texts where one of them is no number."""
    matches = [NUMBER.fullmatch(text) for text in texts]
    numbers = [(float(match[1]), match[2]) for match in matches if match]
    units = {unit for _, unit in numbers}
    if len(numbers) == len(texts) and len(units) == 1:
        return [Swept(key, number, unit, scene) for number, unit in numbers]
    for dimension, units_of_dimension in UNITS.items():
        if len(numbers) == len(texts) and units <= set(units_of_dimension):
            unit = numbers[0][1]
            unit_size = quantity(key, f"1 {unit}", dimension)
            return [Swept(key, float(f"{quantity(key, t, dimension) / unit_size:.12g}"), unit, scene) for t in texts]
    return [Swept(key, text, "", scene) for text in texts]


def beyond_elasticity(scene: Scene) -> str:
    """Why no answer of a half-space is an answer of the scene; empty where it may be.

    Strains are of the order of p / E*: from a tenth on, `HIGHEST_PRESSURE`, what linear elasticity leaves out is as
    large as the default tolerance, and no solid stays elastic. A modulus of exactly 1 is the unit of pressure.
    """
    over = scene.mean_pressure / scene.modulus
    if scene.modulus == 1 or over <= HIGHEST_PRESSURE:
        return ""
    body = scene.size_key.partition(".")[0]
    return (
        f"the mean pressure is {over:.2g} E*, above {HIGHEST_PRESSURE:g} E*: linear elasticity does not hold; are the "
        f"units of {body}.load, {scene.size_key} and E* right?"
    )


ROWS, PLOT = "validation.advice.table:rows_of", "validation.advice.figure:plot"
"""Imported where they are asked for, since tables and figures are of comparisons."""
MOST_REALISATIONS = 100_000
LONGEST_BEYOND_RANGE = 60.0
"""Seconds that a model may take whose error is unknown."""


NumberOrLevels = Any
"""A float of one number, an array of levels: a type checker cannot tell which, as of what NumPy's functions return."""


@dataclass(frozen=True, eq=False, repr=False)
class Comparison:
    """Result of `compare`: a quantity of a scene, its error, and what became of each model.

    Attributes
    ----------
    scene : IndentationScene, RollingScene or RailScene
        The scene.
    quantity : str
        "stiffness", "contact-area", "mean-gap", "force-rms", "force-spectrum", "acceleration", "acceleration-rms",
        "contact-filter", "equivalent-roughness" or "sound-power".
    selection : Selection
        Models, estimates and answers in full.
    in_decibels : bool
        Whether the tolerance was asked in dB, so that errors are printed in dB.
    timed : bool
        Whether all models were asked, so that the seconds of their solves are printed and written, too.
    swept : Swept or None
        The value of a sweep, of which this is one scene.
    tolerance : Tolerance
        What was asked, with its unit.
    value : float or ndarray
        One number in SI units; of a quantity in bands, as "force-spectrum", the level in each one-third octave, in dB
        re 1 N or 1 m/s^2, of "sound-power" in dB re 1 pW. NaN where no model has an answer. Read-only, as all arrays
        of a comparison.
    error : float
        Half-width of the 95 % interval: relative, in dB for levels. For levels it is that of all bands together.
    unit : str
        Unit of ``value``.
    wavenumbers : ndarray
        Centres of the one-third octaves [rad/m]; empty where ``value`` is one number.
    wavelength_mm, frequency_hz, nominal_hz : ndarray
        The same as wavelengths [mm], and where the scene has a speed as frequencies [Hz] and as the nominal frequencies
        of the one-third octaves in which these lie.
    model : str
        Name of the model that gives ``value``; empty where none has an answer.
    met : bool
        Whether the tolerance is met.
    statistic : str
        What ``value`` and its error are of: "ensemble mean", over all surfaces of the roughness that is drawn, or
        "single surface", that was measured; empty of smooth bodies.
    beyond_elasticity : str
        Why no model is within tolerance whatever its error: the mean pressure is above 0.1 E*. Empty where it is not.
    models : ComparedModels
        All models, the cheapest first: ``models[0]``, or by name, ``models["springs"]``. Each has ``name``,
        ``status``, ``error`` (relative), ``cost`` (seconds on one core) and ``reason``.

    Examples
    --------
    >>> result = validation.compare(validation.load_scene("rolling_wheel"), quantity="force-spectrum", tolerance=0.3)
    >>> result.met, result.model, result.unit, result.value.shape == result.wavenumbers.shape
    (True, 'linear filter, 3D', 'dB re 1 N', True)
    """

    scene: Scene
    quantity: str
    selection: Selection
    in_decibels: bool = False
    timed: bool = False
    swept: Swept | None = None

    def __repr__(self) -> str:
        scene, model = shortened_text(self.scene.name, 24), shortened_text(self.model, 24)
        within = f"{'within' if self.met else 'not within'} {self.tolerance}"
        return one_line(f"Comparison({scene!r}: {self._answer}{f' by {model!r}' * bool(model)}, {within})")

    def _repr_html_(self) -> str:
        """The answer, and a row a model, for a notebook."""
        within = f"{'within' if self.met else 'not within'} the tolerance of {self.tolerance}"
        answer = f"{self.scene.name}: {self._answer}{f' by {self.model}' * bool(self.model)}, {within}"
        columns: dict[str, Sequence[object]] = {
            "model": [candidate.name for candidate in self.models],
            "status": [candidate.status for candidate in self.models],
            "error": [self.tolerance.shown(candidate.error) for candidate in self.models],
            "cost": [format_seconds(candidate.cost) for candidate in self.models],
        }
        return as_html(answer, columns)

    @property
    def _answer(self) -> str:
        """The value with its unit and error, of levels how many there are."""
        if not self.model:
            return f"{self.quantity}: no result"
        if self.is_level:
            return f"{self.quantity}, {np.size(self.value)} bands ± {short(self.error)} dB"
        return f"{self.quantity} = {self.value:.4g} {self.unit} ± {short(100 * self.error)} %"

    @property
    def scene_quantity(self) -> SceneQuantity:
        """The quantity with its unit, and how it is judged."""
        return quantity_of(self.scene, self.quantity)

    @property
    def asked(self) -> SceneQuantity:
        """`scene_quantity` by its name of version 0.3."""
        warnings.warn("Comparison.asked is Comparison.scene_quantity now", FutureWarning, stacklevel=2)
        return self.scene_quantity

    @property
    def tolerance(self) -> Tolerance:
        return Tolerance(self.selection.tolerance, self.in_decibels)

    @property
    def value(self) -> NumberOrLevels:
        if self.selection.best is not None:
            return self.value_of(self.selection.best)
        return self._number_or_levels(np.full(max(1, self.wavenumbers.size), math.nan))

    def table(self) -> list[dict[str, object]]:
        """All models as rows: a flat dict a number or a band, and one of each model that was not solved.

        Returns
        -------
        list of dict
            Keys scene, parameters of it in SI units (``"scene.load"``), quantity, tolerance (relative); wavelength_mm,
            frequency_hz, nominal_hz; value, low, high, error and its parts error_model, error_grid, error_sample (half-
            widths of 95 %), unit; model, status, selected, reason, predicted_error, cost_s, seconds and others, NaN
            where there is no number. A data frame is ``pandas.DataFrame(comparison.table())``.

        Examples
        --------
        >>> (row,) = validation.compare(validation.load_scene("sphere")).table()
        >>> row["model"], row["status"], row["unit"], row["scene.load"]
        ('closed form', 'accepted', 'N/m', 4905.0)
        """
        rows: list[dict[str, object]] = resolve_name(ROWS)(self)
        return rows

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw the models that were solved, the selected one with its error.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Axes to draw on, by default those of a new figure.

        Returns
        -------
        matplotlib.axes.Axes
            The axes, with the quantity and its unit.

        Raises
        ------
        TypeError
            If ``ax`` is no Axes.
        """
        axes: Axes = resolve_name(PLOT)(self, ax)
        return axes

    def value_of(self, candidate: Candidate) -> NumberOrLevels:
        """The value that a solved model gives, in the unit of ``value``. Raises ValueError for one without a solve."""
        value = candidate.solved_answer.value
        return self._number_or_levels(20 * np.log10(value / self.scene_quantity.reference) if self.is_level else value)

    def errors_of(self, candidate: Candidate) -> NumberOrLevels:
        """Half-widths of 95 % of a solved model, one for each number, in dB for levels and else in ``unit``."""
        answer = candidate.solved_answer
        return self._number_or_levels(
            answer.error_in_bands if answer.band_errors else self._half_widths(candidate, candidate.error)
        )

    def error_parts_of(self, candidate: Candidate) -> dict[str, NumberOrLevels]:
        """What model, grid and sample leave of `errors_of`, by their names; none of a model that was not solved."""
        if (answer := candidate.answer) is None:
            return {}
        parts = {"model": answer.model, "grid": answer.grid, "sample": answer.sample}
        half_widths = answer.band_errors or {name: self._half_widths(candidate, part) for name, part in parts.items()}
        return {name: self._number_or_levels(half) for name, half in half_widths.items()}

    @property
    def error_parts(self) -> dict[str, NumberOrLevels]:
        """`error_parts_of` the model that gives ``value``: model, grid and sample; none where none has an answer."""
        return {} if self.selection.best is None else self.error_parts_of(self.selection.best)

    @property
    def notes(self) -> tuple[str, ...]:
        """What may be wrong about the scene though it is valid, in sentences."""
        return self.scene.diagnose()

    def _number_or_levels(self, values: FloatArray) -> NumberOrLevels:
        """One number as a float, levels as a read-only array."""
        return kept(values) if self.is_level else float(values.item())

    @property
    def roughness(self) -> FloatArray:
        """L_r of a rail in each band of the quantity [dB re 1 µm]; empty of any other scene."""
        return kept(self.scene.added_to_filter(self.quantity)[0])

    def a3_of(self, candidate: Candidate) -> FloatArray:
        """Contact filter of a model of a rail that was solved, whichever quantity was asked [dB].

        Of sound power it is L_eq less L_r, both brought to bands of frequency.
        """
        roughness, over = self.scene.added_to_filter(self.quantity)
        value = np.asarray(self.value_of(candidate))
        return kept(value - (roughness + over)) if roughness.size else value

    def seconds_of(self, candidate: Candidate) -> float:
        """Seconds that a model took; NaN where it was not solved, or not all models were asked."""
        return candidate.answer.seconds if self.timed and candidate.answer is not None else math.nan

    def _half_widths(self, candidate: Candidate, error: float) -> FloatArray:
        """Half-widths of each number, from a relative error of all numbers together."""
        value = np.asarray(self.value_of(candidate))
        return np.full(value.shape, decibels(error)) if self.is_level else np.asarray(error * np.abs(value))

    @property
    def error(self) -> float:
        error = math.inf if self.selection.best is None else self.selection.best.error
        return decibels(error) if self.is_level else error

    @property
    def unit(self) -> str:
        unit = self.scene_quantity.unit
        if not self.is_level:
            return unit
        return "dB" if unit == "1" else f"dB re 1 {unit}"

    @property
    def is_level(self) -> bool:
        """Whether the value is a level in each one-third octave."""
        return self.scene_quantity.in_bands

    @property
    def wavenumbers(self) -> FloatArray:
        if not self.is_level or not self.selection.solved:
            return kept(np.empty(0))
        return kept(self.scene.bands(self.quantity))

    @property
    def wavelength_mm(self) -> FloatArray:
        # twelve digits: nominal wavelengths have theirs again, 2000 and not 1999.9999999999998
        return kept(np.array([float(f"{wave:.12g}") for wave in 2e3 * math.pi / self.wavenumbers]))

    @property
    def frequency_hz(self) -> FloatArray:
        speed = getattr(self.scene, "speed", None)
        return kept(np.empty(0) if speed is None else speed * self.wavenumbers / (2 * math.pi))

    @property
    def nominal_hz(self) -> FloatArray:
        numbers = np.rint(10 * np.log10(self.frequency_hz)).astype(int)
        return kept(np.array([float(f"{MANTISSAS[n % 10] * 10.0 ** (n // 10):.3g}") for n in numbers]))

    @property
    def model(self) -> str:
        return self.selection.best.name if self.selection.best is not None else ""

    @property
    def met(self) -> bool:
        return self.selection.met and not self.beyond_elasticity

    @property
    def beyond_elasticity(self) -> str:
        return beyond_elasticity(self.scene)

    @property
    def statistic(self) -> str:
        return self.scene.statistic

    @cached_property
    def force(self) -> ContactForce | None:
        """A-weighted force of a wheel on a rail at a constant height, by each model; None of any other scene.

        In files alone, and for one release: `power` is what differences of filters are meant in.
        """
        force: ContactForce | None = self.scene.contact_force(self)
        return force

    @cached_property
    def power(self) -> SoundPower | None:
        """Sound power of a wheel on a rail by each model; None of any other scene, and without a speed."""
        power: SoundPower | None = self.scene.sound_power(self)
        return power

    @property
    def models(self) -> ComparedModels:
        return ComparedModels(self.selection.candidates)


OneOrSeveral = Comparison | Sequence[Comparison]
"""What functions of the face take."""


def comparisons_of(comparison: OneOrSeveral) -> list[Comparison]:
    """The comparisons as a list. Raises TypeError for anything else, ValueError for an empty list."""
    if isinstance(comparison, Comparison):
        return [comparison]
    if not isinstance(comparison, Sequence) or not all(isinstance(element, Comparison) for element in comparison):
        raise TypeError(f"comparison must be what compare returns, or a list of that, got {shortened(comparison)}")
    if not comparison:
        raise ValueError("comparison must be one or several, got an empty list")
    return list(comparison)


P = ParamSpec("P")


def with_earlier_places(compare: Callable[P, Comparison]) -> Callable[P, Comparison]:
    """A second place that is a tolerance; for one release also quantity, tolerance and seed there, as in version 0.3.

    What begins as a number is a tolerance, which no quantity does.
    """

    @functools.wraps(compare)
    def with_places(*places: Any, **named: Any) -> Comparison:
        if len(places) < 2 or (len(places) == 2 and not _is_quantity(places[1])):
            return compare(*places, **named)
        if not _is_quantity(places[1]):
            raise TypeError(
                f"compare takes scene and tolerance by place, and {', '.join(EARLIER_PLACES[::2])} and others by "
                f"keyword, got {len(places)} places"
            )
        warnings.warn(
            "compare takes a tolerance in second place now: give quantity, tolerance and seed by keyword",
            FutureWarning,
            stacklevel=2,
        )
        earlier = dict(zip(EARLIER_PLACES, places[1:], strict=False))
        if twice := [name for name in earlier if name in named]:
            raise TypeError(f"compare must have one {twice[0]}, got it by place and by keyword")
        return compare(*places[:1], **earlier, **named)

    return with_places


EARLIER_PLACES = ("quantity", "tolerance", "seed")


def _is_quantity(second: object) -> bool:
    """Whether the second place has a quantity, or None for the first one of the scene."""
    return second is None or (isinstance(second, str) and not re.match(r"\s*[-+.\d]", second))


@with_earlier_places
def compare(
    scene: Scene,
    tolerance: float | str = 0.1,
    *,
    quantity: str | None = None,
    seed: int = 0,
    solve_all: bool = False,
    models: str | Decorated | Sequence[str | Decorated] | None = None,
    realisations: int | None = None,
    callback: Callable[[SceneModel], None] = lambda _: None,
) -> Comparison:
    """Select the cheapest model of a scene whose error is within the tolerance.

    Models are tried from the cheapest on, each where the error that its calibration claims is within the tolerance;
    the first is accepted whose solve leaves no larger one.

    Parameters
    ----------
    scene : IndentationScene, RollingScene or RailScene
        What `load_scene` returns.
    tolerance : float or str, optional
        Largest half-width of the 95 % interval: relative, or a text as "5 %" or "0.4 dB", in whose unit errors are
        printed; of a spectrum, of the root mean square over all bands.
    quantity : str, optional
        One that the scene has, by default the first.
    seed : int, optional
        Seed of the roughness that is drawn, zero or positive.
    solve_all : bool, optional
        Whether all models are solved and timed, one out of its range where that takes a minute at the most.
    models : str, function or sequence of these, optional
        Solve these alone: "mdr", "bem", or names of models of this scene, in one text with commas too; functions with a
        decorator, as `stiffness_model`: the error of one that a file defines is measured first, else it is unknown.
    realisations : int, optional
        Surfaces, or strips under a wheel, that boundary elements solve where roughness is drawn, from 2 to 100000; by
        default as many as the tolerance takes, up to 1000 surfaces or 32 strips.
    callback : callable, optional
        Called with each model before its solve, as for a note that it takes a while.

    Returns
    -------
    Comparison
        The quantity with its error, and what became of each model.

    Raises
    ------
    TypeError, ValueError
        If ``scene`` is not a scene or has no such quantity or model, or if another argument is out of range.

    Examples
    --------
    >>> result = validation.compare(validation.load_scene("sphere"), "1 %")
    >>> result.quantity, result.model, result.met
    ('stiffness', 'closed form', True)
    """
    if not hasattr(scene, "quantities"):
        raise TypeError(f"scene must be what load_scene returns, got {type(scene).__name__}")
    scene = scene.for_compare()
    key = quantity or quantities_of(scene)[0]
    settings = (tolerance, count("seed", seed, least=0), solve_all, *names_and_own(models, scene, key), realisations)
    return SceneProblem(scene, (key,), *settings).compared(callback)[key]


@dataclass(frozen=True)
class SceneProblem:
    """What `compare` is asked of one scene, of each quantity.

    own: models of somebody's own; realisations: as of `compare`; content: digest of all that the scene is made of,
    since its repr leaves out most of an array.
    """

    scene: Scene = field(repr=False)
    quantities: tuple[str, ...]
    tolerance: float | str
    seed: int = 0
    solve_all: bool = False
    models: Sequence[str] = ()
    own: tuple[Own, ...] = ()
    realisations: int | None = None
    content: str = field(init=False)

    def __post_init__(self) -> None:
        if self.realisations is not None:
            object.__setattr__(self, "realisations", count("realisations", self.realisations, least=2))
            if self.realisations > MOST_REALISATIONS:
                raise ValueError(f"realisations must be from 2 to {MOST_REALISATIONS}, got {self.realisations}")
        object.__setattr__(self, "scene", self.scene.for_compare())
        object.__setattr__(self, "content", content_of(self.scene))

    @property
    def parsed_tolerance(self) -> Tolerance:
        return tolerance_of(self.tolerance)

    def listed_and_solvable(
        self, quantity: str, shared: Shared | None = None
    ) -> tuple[list[SceneModel], list[SceneModel]]:
        """The models that are listed, the cheapest first, and those of them that may be solved. Raises ValueError."""
        tolerance = self.parsed_tolerance.relative
        models = models_of(
            *(self.scene, quantity, tolerance, self.seed, shared),
            include_by_name=bool(self.models),
            realisations=self.realisations,
        )
        own = own_candidates(self.own, Target(self.scene, quantity, tolerance, self.seed), models)
        models = sorted([*models, *own], key=lambda model: model.cost().seconds)
        only = models_named(models, self.models, tolerance) if self.models else models
        return [model for model in models if model.kind not in BY_NAME or any(model is named for named in only)], only

    def compared(self, callback: Callable[[SceneModel], None] = lambda _: None) -> dict[str, Comparison]:
        """Each quantity by its name; those of a scene whose results have all of them share their solves."""
        comparisons, shared, tolerance = dict[str, Comparison](), Shared(), self.parsed_tolerance.relative
        for key in self.quantities:
            models, only = self.listed_and_solvable(key, shared if self.scene.shares_solves else None)
            announced = comparisons and self.scene.shares_solves
            selection = select_model(
                models,
                tolerance,
                callback=(lambda _: None) if announced else callback,
                solve_all=self.solve_all or bool(self.models),
                only=only,
                also=lambda model: not self.models and any(model.kind == own.name for own in self.own),
                beyond=_beyond,
            )
            if reason := beyond_elasticity(self.scene):
                selection = rejected(selection, reason)
            comparisons[key] = Comparison(
                self.scene, key, selection, self.parsed_tolerance.in_decibels, timed=self.solve_all
            )
        return comparisons


def content_of(scene: Scene) -> str:
    """Digest of a scene: equal for equal values, whatever has been computed from them."""

    def of_array(value: Any) -> object:
        return value.dtype.str, value.shape, hashlib.sha256(value.tobytes()).hexdigest()

    values = asdict(scene)  # type: ignore[call-overload]  # scenes are dataclasses
    made_of = json.dumps(
        [type(scene).__name__, {name: values[name] for name in values_of(scene)}],
        default=of_array,
    )
    return hashlib.sha256(made_of.encode()).hexdigest()[:16]


def _beyond(model: SceneModel) -> bool:
    """Whether the scene has an answer at all, and the model is expected to find one soon."""
    scene, quantity = model.target.scene, model.target.quantity
    return model.cost().seconds <= LONGEST_BEYOND_RANGE and not scene.no_answer(quantity)
