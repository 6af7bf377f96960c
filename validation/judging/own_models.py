"""A user's models beside those of a scene: what each kind of function serves, its errors, and solvers for the race."""

import atexit
import math
import runpy
import sys
import time
import warnings
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, suppress
from dataclasses import dataclass, field, fields, replace
from functools import cache, partial
from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import mdr
from validation.advice.calibration import (
    CONDITIONS,
    HURST,
    SCATTER,
    MeasuredErrors,
    beyond_spectrum,
    conditions_by_kind,
    kind_of,
)
from validation.advice.calibration_scenes import OTHER_SEED, CalibrationScene, Group, answers_in
from validation.advice.models import boundary_elements_pressed, boundary_elements_rolling
from validation.analysis.escapes import quoted
from validation.benchmarks.discrete import ContactProblem
from validation.benchmarks.peers import TIGHTER, ColdSolve, Field, PeerSolver
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.engine.realisations import random_generator
from validation.judging.kinds.judge import answer_of
from validation.judging.kinds.profiles import rms_of_profile
from validation.judging.kinds.rolling import middle_line
from validation.judging.registry import KINDS, Caller, FloatArray, Given, Offered, offer
from validation.judging.replies import raised
from validation.judging.source_files import digest_of, file_of, sources_of
from validation.judging.worker import Called, OthersError, Visitor, offered_in
from validation.railway.problems.rail_models import ContactFilter, rail_quantity
from validation.railway.problems.rail_quantity import RAIL_QUANTITIES
from validation.railway.problems.rail_strip import structure_of, uniform_parts
from validation.scenes.load import load_scene
from validation.scenes.rolling import QUANTITIES, RollingQuantity
from validation.scenes.roughness import Roughness, RoughSurface
from validation.scenes.scene import Scene
from validation.simulation.indentation import ground_of, height_of, is_rough, side_of, sufficient_cells
from validation.simulation.method import FEWEST, STUDENT, Resolution, Result, distance, realisations
from validation.simulation.model import Cost, ErrorEstimate, Model, Target, model
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


@cache
def named_in(place: str, kind: str) -> Offered[..., Any]:
    """With or without its decorator; the file is run once, and its folder can be imported.

    Raises ValueError where there is none, or where the file raises, in one sentence.
    """
    file, _, name = place.rpartition(":")
    path = Path(file).resolve()
    if not path.is_file():
        raise ValueError(f"a function is named as FILE:NAME, and there is no file {file!r} in {place!r}")
    sys.path.insert(0, str(path.parent))
    try:
        function = runpy.run_path(str(path)).get(name)
    except (Exception, SystemExit) as error:
        raise ValueError(f"{file}: {raised(error, path)}") from None
    if isinstance(function, Offered) and function.kind == kind:
        return function
    if not callable(function) or isinstance(function, Offered):
        raise ValueError(f"{file} has no function {name!r} for @{kind}")
    return offer(kind, name, KINDS[kind].options, function)


@cache
def _solvers_in(file: str) -> list[Offered[..., Any]]:
    solvers = [offered for offered in offered_in(Path(file)) if offered.kind == "contact_solver"]
    if not solvers:
        raise OthersError(f"{Path(file).name}: no function has the decorator @contact_solver")
    return solvers


def solvers_in(file: str, taken: Collection[str]) -> list[PeerSolver]:
    """Contact solvers of a file for the race, by names that are not taken. Raises OthersError where it has none."""
    return [
        _own(solver, file, f"{solver.name}, own" if solver.name in taken else solver.name)
        for solver in _solvers_in(file)
    ]


def _own(offered: Offered[..., Any], file: str, name: str) -> PeerSolver:
    served, by_force = tuple(kind for kind in ("free", "periodic") if offered.options[kind]), "force" in offered.asks
    mode, prepare = "by force" if by_force else "by approach", partial(of_file, file, offered.name)
    cells = float(offered.options["cells"])
    return PeerSolver(name, "", mode, prepare, TIGHTER, served, by_force, file, cells=cells)


def of_file(file: str, name: str, problem: ContactProblem, tolerance: float) -> ColdSolve:
    """A solver of somebody's own, in the process that times it."""
    (solver,) = (offered for offered in _loaded(file) if offered.name == name)
    gap = problem.gap.copy()
    gap.flags.writeable = False
    other = "approach" if "force" in solver.asks else "force"
    available = {**vars(problem), "gap": gap, "tolerance": tolerance, other: None}
    arguments = {argument: available[argument] for argument in solver.asks}

    def solve() -> tuple[Field, float]:
        return np.array(solver(**arguments), dtype=float), math.nan

    return solve


@cache
def _loaded(file: str) -> tuple[Offered[..., Any], ...]:
    sys.path.insert(0, str(Path(file).resolve().parent))
    return tuple(value for value in runpy.run_path(file).values() if isinstance(value, Offered))


CALL = 1e-4
"""Seconds of a realisation where none was timed."""
FEWEST_SCENES = 20
"""On which a model must have an answer, for its error to be known."""
NOT_IN_KEY = (
    "by the bytes of the file and of what it has from its folder; environment variables, random seeds, time, network, "
    "other programs, files elsewhere and those that C code reads are no part of that: with others take another --store"
)
"""What kept errors are known by."""
VISITORS: dict[tuple[Path, str], Visitor] = {}
"""Processes of files, by what these had been when they were run."""
RUNNING = ExitStack()
atexit.register(RUNNING.close)


class ChangedError(OSError):
    """A file was changed while its models were compared: no failure of a model, so that nothing of it is stored."""


@dataclass(frozen=True)
class OwnErrors:
    """Of one model beside the answers of one kind of scene and quantity.

    digest: of the answers; measured: None where a model answers too few scenes; seconds: of the
    fastest realisation, rounded up to a power of ten, so that the order of models does not go with what else runs.
    """

    digest: str
    measured: MeasuredErrors | None = field(repr=False)
    seconds: float = field(repr=False)


@dataclass(frozen=True)
class OwnModel:
    """A function of somebody's own, as workers get it.

    digest: of its file and of the modules and data that this has had; empty for a function without a file, which is
    neither calibrated nor stored. path, sources: of the file; function: of this process, in the place of its file;
    errors: by kind of scene and quantity.
    """

    kind: str
    name: str
    asks: tuple[str, ...]
    digest: str
    path: Path | None = field(default=None, repr=False)
    sources: tuple[Path, ...] = field(default=(), repr=False)
    function: Offered[..., Any] | None = field(default=None, repr=False)
    errors: Mapping[Group, OwnErrors] = field(default_factory=dict, compare=False)

    @property
    def serves(self) -> str:
        """In words."""
        return f"{quoted(self.name)} (@{self.kind}) serves {SERVED[self.kind].what}"

    def called(self) -> Called:
        """Raises ChangedError where a file was changed since."""
        if self.function is not None:
            return Called(self.function)
        assert self.path is not None  # in the place of a function
        self.check_unchanged()
        key = self.path, self.digest
        visitor = VISITORS[key] = VISITORS.get(key) or RUNNING.enter_context(Visitor(self.path))
        return next(caller for caller in visitor.callers() if caller.name == self.name)

    def check_unchanged(self) -> None:
        """Raises ChangedError where its file, or a module or data of that, has other bytes than at first."""
        if self.path is not None and digest_of(self.sources) != self.digest:
            raise ChangedError(f"{self.path.name}, or what it reads, was changed while its models were compared")

    def model(self) -> Model:
        """Of the house."""
        of = SERVED[self.kind]
        about = {"name": self.name, "setting": f"@{self.kind}", "serves": of.serves, "charted": False}
        declared = model(cost=self._cost, claim=self._claim, **about)(self._solve)
        return ModelOfUser(**{each.name: getattr(declared, each.name) for each in fields(declared)}, own=self)

    def _solve(self, target: Target, resolution: Resolution) -> Result:
        result = result_of(self.called(), target, self._sample(target)[0])
        # a process that had to be started again has run the file once more
        self.check_unchanged()
        return result

    def _sample(self, target: Target) -> tuple[int, float]:
        return SERVED[self.kind].sample(self.asks, target)

    def _cost(self, target: Target, resolution: Resolution) -> Cost:
        (count, _), errors = self._sample(target), self.errors.get(_group(target))
        return Cost(work=count, seconds=count * (errors.seconds if errors else CALL))

    def _claim(self, of: Model, target: Target, resolution: Resolution) -> ErrorEstimate:
        """As measured, what the sample leaves, and what one measured surface has beside all that have its spectrum."""
        if self.kind == "contact_filter":
            try:
                a3 = SERVED[self.kind].rows(self.called(), target, 1)
            except (ValueError, ArithmeticError) as problem:
                return ErrorEstimate.out_of_range(str(problem))
            return filter_of(self.name, a3).claim(of, target, resolution)
        errors, own = self.errors.get(_group(target)), SERVED[self.kind].own
        if errors is None or errors.measured is None:
            return ErrorEstimate.out_of_range(self.unknown(errors))
        ground = target.scene.ground
        of_spectrum = beyond_spectrum(ground) if own is not None else ""
        if reason := of_spectrum or (_group(target)[0] in ("rolling", "wheel") and target.rolling.no_answer):
            return ErrorEstimate.out_of_range(reason)
        estimate = errors.measured.estimate(conditions_by_kind(target)[1])
        scatters = own or 0.0 if ground.is_single else 0.0
        # a distance of logarithms: 0.7 of what is right is off by 43 % of itself
        return replace(estimate, model=math.expm1(estimate.model) + scatters, sample=self._sample(target)[1])

    def unknown(self, errors: OwnErrors | None) -> str:
        """Why an error is unknown."""
        if self.kind == "contact_filter":
            return "its error is known on each rail, beside linear theory"
        if not self.digest:
            return "a function without a file is not calibrated: its error is unknown"
        if errors is None:
            return "no answers of boundary elements are stored for such scenes: its error is unknown"
        return f"it answers fewer than {FEWEST_SCENES} scenes of the calibration: its error is unknown"


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class ModelOfUser(Model):
    """Of a function that no module of the package declares. own: what makes it, also where it is unpickled."""

    own: OwnModel

    def __reduce__(self) -> tuple[Any, ...]:
        return OwnModel.model, (self.own,)


def group_of(scene: Scene, quantity: str) -> Group:
    """Which answers a model of it is measured beside; of rails there are none."""
    return kind_of(Target(scene, quantity)), quantity


def _group(target: Target) -> Group:
    return group_of(target.scene, target.quantity)


def models_in(file: str | Path) -> list[OwnModel]:
    """What a file offers to scenes, or an installed package under that name, none of it calibrated yet.

    The file is run as a program. Raises OthersError for a broken one and one without such a model, OSError where it
    cannot be read.
    """
    path = RUNNING.enter_context(file_of(file))
    visitor = RUNNING.enter_context(Visitor(path))
    callers = [caller for caller in visitor.callers() if caller.kind in SERVED]
    for caller in callers:
        _probe(caller)
    VISITORS[visitor.path, visitor.digest] = visitor
    if not callers:
        raise OthersError(f"{path.name}: no function serves a scene, as @{', @'.join(SERVED)} do")
    files = {"digest": visitor.digest, "path": visitor.path, "sources": visitor.sources}
    return [OwnModel(caller.kind, caller.name, caller.asks, **files) for caller in callers]  # type: ignore[arg-type]


def _probe(called: Called) -> None:
    """On a scene of each kind: a function may load modules and data of its folder when it is called."""
    drawn = [_first_of(group).target() for group in (("punch", "stiffness"), ("rolling", "force-rms"))]
    for target in (*drawn, Target(load_scene("rail"), "contact-filter")):
        if SERVED[called.kind].serves(target.scene, target.quantity):
            with suppress(ValueError, ArithmeticError):
                result_of(called, target, 1)


def of_functions(functions: Iterable[Offered[..., Any]], scene: Scene, quantity: str) -> tuple[OwnModel, ...]:
    """Functions of this process, those of files calibrated. Raises TypeError for a kind that has no scenes."""
    models = []
    for function in functions:
        if function.kind not in SERVED:
            raise TypeError(f"models must be of @{', @'.join(SERVED)}, got {quoted(function.name)} of @{function.kind}")
        own = OwnModel(function.kind, function.name, function.asks, _digest_of_file(function), function=function)
        models.append(calibrated(own, [group_of(scene, quantity)]))
    return tuple(models)


def _digest_of_file(offered: Offered[..., Any]) -> str:
    """Of that which defines a function, and of what is loaded from its folder; empty where there is none."""
    path = Path(getattr(getattr(offered.function, "__code__", None), "co_filename", ""))
    return digest_of(sources_of(path)) if path.is_file() else ""


@dataclass(frozen=True)
class OwnPart:
    """What is measured: a model beside the answers of a group; digest: of these."""

    own: OwnModel
    group: Group
    digest: str


def calibrated(own: OwnModel, groups: Iterable[Group] | None = None, engine: Engine = SERIAL) -> OwnModel:
    """With its errors of these groups, or of all, for which answers are stored; those that are known are taken."""
    stored = answers_in()
    parts = [
        OwnPart(own, group, stored[group].digest)
        for group in (stored if groups is None else groups)
        if own.digest and group in stored and SERVED[own.kind].serves(_first_of(group).scene, group[1])
    ]
    return replace(own, errors={part.group: _errors(part, engine) for part in parts})


def _first_of(group: Group) -> CalibrationScene:
    return CalibrationScene(kind=group[0], number=0, quantity=group[1], seed=0)


@cache
def _errors(part: OwnPart, engine: Engine) -> OwnErrors:
    (outcome,) = engine.map(measure_own, [part])
    answered, measured = np.isfinite(outcome["error"]), None
    if answered.sum() >= FEWEST_SCENES:
        conditions = [
            conditions_by_kind(point.target())[1] for point, *_ in answers_in()[part.group].scenes(part.group)
        ]
        names = tuple(name for name in CONDITIONS if name in conditions[0])
        at = np.array([[row[name] if name == HURST else math.log10(row[name]) for name in names] for row in conditions])
        measured = MeasuredErrors(names, at[answered], outcome["error"][answered], np.ones(answered.sum()))
    return OwnErrors(part.digest, measured, float(outcome["seconds"]))


def measure_own(part: OwnPart) -> Outcome:
    """Distance from boundary elements on each scene, NaN where the model has no answer; seconds of a realisation."""
    called, errors, seconds, answers = part.own.called(), [], [], answers_in()[part.group]
    for (point, value, each), reference in zip(answers.scenes(part.group), answers.reference, strict=True):
        begin = time.perf_counter()
        error, count = _error(called, point, value, each)
        seconds.append((time.perf_counter() - begin) / count)
        # no model is known to be nearer than what it is measured beside, not even one that was fitted to that
        errors.append(np.maximum(error, reference))
    part.own.check_unchanged()
    return {"error": np.array(errors), "seconds": np.array(10.0 ** math.ceil(math.log10(min(seconds))))}


def _error(called: Called, point: CalibrationScene, value: FloatArray, each: FloatArray) -> tuple[float, int]:
    """And of how many realisations: on the surfaces of the reference where a model is given them."""
    of = SERVED[called.kind]
    target = point.target(seed=OTHER_SEED if of.reads_surface else 0)
    most = min(SURFACES, len(each)) if of.reads_surface else CALIBRATED
    count = min(most, of.sample(called.asks, target)[0])
    try:
        values = result_of(called, target, count).values[point.quantity]
    except (ValueError, ArithmeticError):
        return math.nan, 1
    truth = _mean(each[:count], point.quantity) if of.reads_surface else value
    return distance(_mean(values, point.quantity), truth), count


def _mean(rows: FloatArray, quantity: str) -> FloatArray:
    """As of a sample: of a stiffness itself, of levels of their logarithms."""
    return np.asarray(rows.mean(axis=0) if quantity == "stiffness" else np.exp(np.log(rows).mean(axis=0)))
