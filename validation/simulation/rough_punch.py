"""A rigid square punch with a rough face, drawn and pressed by either method: one solve of every case about it."""

import math
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any, Literal

import numpy as np

import bem3d
import mdr
from bem3d.checks import Spectrum
from validation.engine.engine import FloatArray, Outcome
from validation.engine.realisations import FEWEST, NotConvergedError, random_generator
from validation.scenes.indentation import IndentationScene
from validation.scenes.roughness import Roughness
from validation.simulation.surface import draw_surface, refined

BEM, MDR = "bem3d", "mdr"
METHODS = (BEM, MDR)
# the spawn keys under which each kind of roughness draws, and what is drawn again to tell the error of a sample
PROFILES, SURFACES = 1, 2
FEW_CELLS = 30
"""A contact of fewer cells is under-resolved."""
STIFFNESS_TOLERANCE = 3e-3
"""Residual of the fixed contact areas of ensembles, for two thirds of the applications that 1e-4 takes."""
STIFFNESS_ERROR = 1e-4
"""Relative error of a mean stiffness, twice the standard deviation of those of single ones, and a fifth of the largest
of these, that this residual leaves at the most. It goes with the square of the residual."""
# stiffness, area, approach and mean gap of a load that did not converge
LOST = (np.nan,) * 4


def left_by_solver(log_deviation: float = math.inf) -> float:
    """Of a logarithm at zero cell size, by the residual of the fixed contact areas; of the mean, or of a deviation.

    2 fine - coarse has three times the error of one grid, as if all went the same way. That of a standard deviation is
    no more than the standard deviation of the errors (triangle inequality).
    """
    return 3 * STIFFNESS_ERROR * (1 + 1 / (2 * math.exp(log_deviation)))


def force_levels(decades: tuple[int, int], per_decade: int) -> tuple[float, ...]:
    """Fbar from one power of ten to another, ascending, so many equal steps of its logarithm in each decade."""
    first, last = decades
    return tuple(10.0 ** (first + i / per_decade) for i in range((last - first) * per_decade + 1))


@dataclass(frozen=True, kw_only=True)
class PunchRoughness:
    """Self-affine roughness on a side L, in units of L = 1, the same on every grid and for both methods.

    hurst: H; waves: the first and the last of the band, as many on a side: q = 2 pi waves / L; height: rms, over L;
    amplitudes: "fixed" by the spectrum, or "gaussian" around it; normalised: "each" draw has its rms height exactly,
    or the "ensemble" has it in the mean; common: a realisation has the same phases for every Hurst exponent; seed: zero
    or positive. Fixed amplitudes are normalised alike either way.
    """

    hurst: float
    waves: tuple[int, int]
    seed: int
    height: float = 1e-3
    amplitudes: Literal["fixed", "gaussian"] = "fixed"
    normalised: Literal["each", "ensemble"] = "each"
    common: bool = False

    @property
    def spectrum(self) -> mdr.SelfAffine:
        """C_2D of the surfaces, and C_1D by Geike's rule of the profiles."""
        first, last = self.waves
        return mdr.SelfAffine(hurst=self.hurst, q_min=2 * np.pi * first, q_max=2 * np.pi * last, rms=self.height)

    def surface(self, cells: int, realisation: int) -> FloatArray:
        """Height of one realisation at the centres of cells x cells."""
        grid: dict[str, Any] = {"shape": (cells, cells), "spacing": 1 / cells}
        return self._drawn(draw_surface, self.spectrum.c2d, SURFACES, realisation, **grid)

    def profile(self, points: int, realisation: int) -> FloatArray:
        """Height of one realisation of Geike's profile at the middle of its springs."""
        return self._drawn(mdr.rough_profile, self.spectrum.c1d, PROFILES, realisation, length=1.0, points=points)

    def scene(self, force: float) -> IndentationScene:
        """A punch of this roughness under Fbar, E* = 1, for models that know no realisation."""
        first, last = self.waves
        ground = Roughness(rms=self.height, hurst=self.hurst, longest=1 / first, shortest=1 / last)
        load = force * self.height
        return IndentationScene(name="punch", shape="punch", size=1.0, load=load, modulus=1.0, ground=ground)

    def _drawn(
        self, draw: Callable[..., FloatArray], spectrum: Spectrum, kind: int, realisation: int, **grid: Any
    ) -> FloatArray:
        """Heights of a realisation; each Hurst exponent has random numbers of its own, unless they are `common`."""
        address = 0 if self.common else round(1000 * self.hurst)
        rng = random_generator(self.seed, kind, address, realisation)
        return self._normalised(draw(spectrum, rng=rng, rms=self.height, amplitudes=self.amplitudes, **grid))

    def _normalised(self, height: FloatArray) -> FloatArray:
        """Heights with exactly the rms height of the scene, where the amplitudes of each draw scatter."""
        if self.amplitudes == "fixed" or self.normalised == "ensemble":
            return height
        return np.asarray(height * (self.height / height.std()))


@dataclass(frozen=True, kw_only=True)
class Surface:
    """One rough punch on one grid, pressed with ascending forces Fbar = F / (E* h L) to a residual."""

    roughness: PunchRoughness
    realisation: int
    cells: int
    forces: tuple[float, ...]
    tolerance: float


@dataclass(frozen=True, kw_only=True)
class Profiles:
    """The first so many rough profiles on one number of springs, in a 1D model of length L_1D, pressed alike."""

    roughness: PunchRoughness
    realisations: int
    points: int
    length: float
    forces: tuple[float, ...]


def press_surface(surface: Surface) -> Outcome:
    """Boundary elements: k / (E* L), true contact area / L^2, approach / L and mean gap / L at each force.

    Each contact starts from the last. residual: of each; applications: of the operator, by the contacts and by their
    frozen ones; height, gradient: rms of the surface as drawn, over L, and g, that of abs(grad h); failed: loads that
    did not converge, whose values are NaN.
    """
    cells = surface.cells
    half_space = bem3d.HalfSpace(shape=(cells, cells), spacing=1 / cells, modulus=1.0)
    height = surface.roughness.surface(cells, surface.realisation)
    # the mean displacement is the work of p on that of a uniform unit pressure
    uniform = half_space.displacement(np.ones(half_space.shape)) / cells**2
    path = bem3d.indent(
        half_space,
        -height,
        forces=surface.roughness.height * np.array(surface.forces),
        stiffness=True,
        stiffness_tolerance=STIFFNESS_TOLERANCE,
        tolerance=surface.tolerance,
        raise_on_failure=False,
    )
    rows = []
    with warnings.catch_warnings():
        # the punch ends where its grid does, and the figures mark what stands on few cells
        warnings.simplefilter("ignore", bem3d.ContactWarning)
        for contact in path:
            frozen, gap = contact.frozen, float((contact.pressure * uniform).sum()) - contact.approach
            converged = contact.converged and frozen is not None and frozen.converged
            values = (contact.stiffness(), contact.area, contact.approach, gap) if converged else LOST
            applications = contact.operator_applications, frozen.operator_applications if frozen is not None else 0
            rows.append((*values, contact.residual, *applications))
    names = "stiffness", "area", "approach", "gap", "residual", "applications", "frozen applications"
    columns = dict(zip(names, np.array(rows).T, strict=True))
    of_surface = {"height": np.array(height.std()), "gradient": np.array(_gradient(height))}
    return {**columns, **of_surface, "failed": np.array(float(np.isnan(columns["stiffness"]).sum()))}


def press_profiles(profiles: Profiles) -> Outcome:
    """Springs: `press_surface` of each profile at each force, one sort a profile; area: springs in contact over all."""
    roughness, length = profiles.roughness, profiles.length
    force = roughness.height * np.array(profiles.forces)
    stiffness, approach = np.empty((2, profiles.realisations, force.size))
    heights = np.empty(profiles.realisations)
    for i in range(profiles.realisations):
        height = roughness.profile(profiles.points, i)
        with warnings.catch_warnings():
            # as with cells: the lightest loads stand on few springs
            warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
            points = mdr.load_curve(height, length=length, modulus=1.0).at_force(force)
        heights[i], stiffness[i], approach[i] = height.std(), points.stiffness, points.approach
    return {
        "stiffness": stiffness,
        "area": stiffness / length,
        "approach": approach,
        # heights have no mean: what is compressed less what is open is the approach
        "gap": force / length - approach,
        "height": heights,
    }


def stacked(outcomes: list[Outcome]) -> Outcome:
    """One row a realisation; NaN at the largest forces of who was pressed at fewer."""
    longest = max(outcome["stiffness"].size for outcome in outcomes)

    def row(values: FloatArray) -> FloatArray:
        return np.pad(values, (0, longest - values.size), constant_values=np.nan) if values.ndim else values

    return {name: np.array([row(outcome[name]) for outcome in outcomes]) for name in outcomes[0]}


def describe_failures(problems: list[Surface], outcomes: list[Outcome]) -> tuple[str, ...]:
    """A line for each load that did not converge."""
    return tuple(
        f"surface {s.realisation}, H = {s.roughness.hurst:g}, {s.cells}² cells, Fbar = {force:.3g}: "
        f"residual {residual:.2g}"
        for s, o in zip(problems, outcomes, strict=True)
        for force, residual, stiffness in zip(s.forces, o["residual"], o["stiffness"], strict=True)
        if np.isnan(stiffness)
    )


def require_converged(outcomes: Iterable[Outcome], unconverged: Sequence[str]) -> None:
    """Raise NotConvergedError unless three surfaces at the least have converged at each force."""
    for outcome in outcomes:
        converged = int(np.isfinite(outcome["stiffness"]).sum(axis=0).min())
        if converged < FEWEST:
            raise NotConvergedError(f"{converged} surfaces converged at one force, {FEWEST} are needed", unconverged)


def _gradient(height: FloatArray) -> float:
    """Root mean square of |grad h| over a period of the unit square."""
    q = 2 * np.pi * np.fft.fftfreq(height.shape[0], 1 / height.shape[0])
    power = np.abs(np.fft.fft2(height, norm="forward")) ** 2
    return float(np.sqrt((power * (q[:, np.newaxis] ** 2 + q**2)).sum()))


HIGHEST = 0.001, 0.01, 0.1
"""Parts of the face whose mean height is measured."""


@dataclass(frozen=True, kw_only=True)
class Faces:
    """Some realisations of rough faces on one grid, from the first on, whose heights are measured, without a solve."""

    roughness: PunchRoughness
    first: int
    realisations: int
    cells: int


def measure_faces(faces: Faces) -> Outcome:
    """Statistics of the heights of each face, over h, that go with its stiffness: one row a realisation.

    heights: mean of the highest 0.1, 1 and 10 % of the cells, which carry light loads; mean, variance and third central
    moment over the face, weighted by the pressure of the flat punch, of which the edges carry most: so F = k d + E* p.h
    in full contact.
    """
    cells = faces.cells
    half_space = bem3d.HalfSpace(shape=(cells, cells), spacing=1 / cells, modulus=1.0)
    weight = bem3d.solve_fixed_area(half_space, np.ones(half_space.shape, dtype=np.bool_)).pressure
    weight = weight / weight.sum()
    rows = []
    for i in range(faces.first, faces.first + faces.realisations):
        height = faces.roughness.surface(cells, i) / faces.roughness.height
        ascending = np.sort(height, axis=None)
        highest = [float(ascending[-max(round(part * height.size), 1) :].mean()) for part in HIGHEST]
        about = height - (mean := float((weight * height).sum()))
        rows.append((*highest, mean, *(float((weight * about**n).sum()) for n in (2, 3))))
    return {"heights": np.array(rows)}


@dataclass(frozen=True, kw_only=True)
class PlateauSpectrum(mdr.SelfAffine):
    """Self-affine beyond a roll-off, constant from q_min to there; its level is that of the draw, which has an rms."""

    q_roll_off: float

    def _density(self, q: FloatArray) -> FloatArray:
        """C_2D(max(q, q_r)) in the band [m^4]."""
        return np.asarray(np.where(super()._density(q) > 0, super()._density(np.maximum(q, self.q_roll_off)), 0.0))


@dataclass(frozen=True, kw_only=True)
class RolledOffRoughness(PunchRoughness):
    """With a plateau from the first wave of the band to the roll-off, as many waves on a side."""

    roll_off: int

    @property
    def spectrum(self) -> PlateauSpectrum:
        return PlateauSpectrum(**asdict(super().spectrum), q_roll_off=2 * np.pi * self.roll_off)


CELLS_A_WAVE = 4
"""Cells to the shortest wave on the grid that a surface is drawn on; a finer one has the same waves."""
OVERLAPPING = 4
"""Times the cells on a side: when more overlap, an application by transforms costs less than one by a matrix."""
TOUCHING = 1
"""Times the cells on a side: a load under which more will touch is not tried on a matrix. Half as many cost more."""


def press_lightly(surface: Surface) -> Outcome:
    """`press_surface` by stiffness, area and approach, in a small part of its time where few cells touch.

    residual: of each; applications: of the operator, by the contacts and by their fixed contact areas, or as many as
    have the floating-point operations of the products with influence coefficients; failed: loads that did not
    converge, whose values are NaN.
    """
    cells = surface.cells
    half_space = bem3d.HalfSpace(shape=(cells, cells), spacing=1 / cells, modulus=1.0)
    forces = surface.roughness.height * np.array(surface.forces)
    rows: list[tuple[float, ...]] = []
    # two real transforms of a padded grid take 5/2 n log2(n) operations each, a product two
    points = (2 * cells) ** 2
    products = 2.5 * points * math.log2(points)
    try:
        contacts = bem3d.indent_few_cells(
            half_space,
            -_surface_height(surface),
            forces=forces,
            max_cells=OVERLAPPING * cells,
            tolerance=surface.tolerance,
        )
        for contact in _while_few(contacts, forces, TOUCHING * cells):
            work = np.array([contact.products, contact.stiffness_products]) / products
            rows.append((contact.stiffness, contact.area, contact.approach, contact.residual, *work))
    except (bem3d.TooManyCellsError, bem3d.ConvergenceError):
        pass
    names = "stiffness", "area", "approach", "residual", "applications", "frozen applications"
    columns = np.array(rows).reshape(-1, len(names)).T
    outcome = dict(zip(names, columns, strict=True))
    if len(rows) < len(forces):
        rest = press_surface(replace(surface, forces=surface.forces[len(rows) :]))
        outcome = {name: np.append(values, rest[name]) for name, values in outcome.items()}
    return {**outcome, "failed": np.array(float(np.isnan(outcome["stiffness"]).sum()))}


def _while_few(
    contacts: Iterable[bem3d.FewCellsContact], forces: FloatArray, most: float
) -> Iterator[bem3d.FewCellsContact]:
    """The contacts up to the load after which more cells will touch: their number goes with the force, nearly."""
    for contact, following in zip(contacts, [*forces[1:], 0.0], strict=False):
        yield contact
        if len(contact.cells) * following > most * contact.force:
            return


def _surface_height(surface: Surface) -> FloatArray:
    """Heights of the realisation on its grid, drawn on a coarser one and refined where that has all its waves."""
    _, last = surface.roughness.waves
    cells = min(surface.cells, CELLS_A_WAVE * last)
    return refined(surface.roughness.surface(cells, surface.realisation), surface.cells)
