"""Fig. 14.1: mean and relative standard deviation of the contact stiffness of rough square punches."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import bem3d
import mdr
from validation import closed_forms
from validation.ensemble import SERIAL, Engine, Outcome, generator
from validation.evidence import Evidence, NotConvergedError, Number, Role, Table
from validation.statistics import Estimate, Statistic, estimate, log_mean, log_relative_deviation

FloatArray = NDArray[np.float64]

DECIBEL = 20 / np.log(10)
# the spawn keys under which each kind of roughness draws, and the bootstrap
PROFILES, SURFACES, BOOTSTRAP = 1, 2, 3


@dataclass(frozen=True, kw_only=True)
class FractalPunch:
    """A rigid square punch of side L, self-affine from q_min = 2 pi / L to four cells a wave, no roll-off.

    Everything is normalised alike on both sides, in units of L = E* = 1: Fbar = F / (E* h L), kbar = k / (E* L),
    with h the rms height, which each realisation has exactly.

    hursts; cells: on a side; surfaces, profiles: realisations; decades: of Fbar; per_decade: force levels in one;
    reported: forces at which numbers are compared; refined: surfaces solved again on cells half as wide;
    points: springs of a profile; height: h / L; tolerance: residual of the solver; seed: zero or positive.
    """

    hursts: tuple[float, ...] = (0.4, 0.7, 1.0)
    cells: int = 128
    surfaces: int = 24
    profiles: int = 200
    decades: tuple[int, int] = (-2, 1)
    per_decade: int = 3
    reported: tuple[float, ...] = (0.1, 1.0)
    refined: int = 3
    points: int = 2048
    height: float = 1e-3
    tolerance: float = 1e-5
    seed: int = 14

    @property
    def forces(self) -> tuple[float, ...]:
        """Levels of Fbar, ascending."""
        first, last = self.decades
        return tuple(10.0 ** (first + i / self.per_decade) for i in range((last - first) * self.per_decade + 1))

    def spectrum(self, hurst: float) -> mdr.SelfAffine:
        """The band is the same on every grid and in both methods."""
        return mdr.SelfAffine(hurst=hurst, q_min=2 * np.pi, q_max=self.cells // 4 * 2 * np.pi, rms=self.height)


@dataclass(frozen=True, kw_only=True)
class Surface:
    """One rough punch on one grid, pressed with several forces."""

    case: FractalPunch
    hurst: float
    realisation: int
    cells: int
    forces: tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class Profiles:
    """All rough profiles of one Hurst exponent on one number of springs, in a 1D model of length L_1D."""

    case: FractalPunch
    hurst: float
    points: int
    length: float


@dataclass(frozen=True)
class Ensemble:
    """Stiffness and contact fraction for one Hurst exponent, rows are realisations, columns are forces."""

    hurst: float
    bem: FloatArray
    area: FloatArray
    refined: FloatArray
    mdr: FloatArray
    fraction: FloatArray
    mdr_coarse: FloatArray
    mdr_long: FloatArray


@dataclass(frozen=True)
class FractalPunchResult:
    """One ensemble a Hurst exponent, and which solves did not converge."""

    case: FractalPunch
    ensembles: list[Ensemble]
    unconverged: tuple[str, ...]


def run(case: FractalPunch, engine: Engine = SERIAL) -> FractalPunchResult:
    """Press all surfaces and all profiles with equal forces."""
    surfaces = [
        Surface(case=case, hurst=hurst, realisation=i, cells=case.cells, forces=case.forces)
        for hurst in case.hursts
        for i in range(case.surfaces)
    ]
    refined = [
        Surface(case=case, hurst=hurst, realisation=i, cells=2 * case.cells, forces=case.reported)
        for hurst in case.hursts
        for i in range(case.refined)
    ]
    long = closed_forms.SQUARE_PUNCH
    profiles = [
        Profiles(case=case, hurst=hurst, points=points, length=length)
        for hurst in case.hursts
        for points, length in ((case.points, 1.0), (case.points // 2, 1.0), (case.points, long))
    ]
    bem, fine = engine.map(press_surface, surfaces), engine.map(press_surface, refined)
    springs = engine.map(press_profiles, profiles)
    ensembles = []
    for h, hurst in enumerate(case.hursts):
        mine = bem[h * case.surfaces : (h + 1) * case.surfaces]
        finer = fine[h * case.refined : (h + 1) * case.refined]
        same, coarse, longer = springs[3 * h : 3 * h + 3]
        ensembles.append(
            Ensemble(
                hurst=hurst,
                bem=np.array([o["stiffness"] for o in mine]),
                area=np.array([o["area"] for o in mine]),
                refined=np.array([o["stiffness"] for o in finer]),
                mdr=same["stiffness"],
                fraction=same["fraction"],
                mdr_coarse=coarse["stiffness"],
                mdr_long=longer["stiffness"],
            )
        )
    unconverged = tuple(
        f"surface {s.realisation}, H = {s.hurst:g}, {s.cells}² cells, Fbar = {force:.3g}: residual {residual:.2g}"
        for s, o in zip(surfaces + refined, bem + fine, strict=True)
        for force, residual in zip(s.forces, o["residual"], strict=True)
        if not residual <= case.tolerance
    )
    return FractalPunchResult(case, ensembles, unconverged)


def press_surface(surface: Surface) -> Outcome:
    """Boundary elements: stiffness and true contact area at each force, each contact starting from the last."""
    case, cells = surface.case, surface.cells
    half_space = bem3d.HalfSpace(shape=(cells, cells), spacing=1 / cells, modulus=1.0)
    height = bem3d.rough_surface(
        case.spectrum(surface.hurst).c2d,
        shape=half_space.shape,
        spacing=half_space.spacing,
        rng=generator(case.seed, SURFACES, _key(surface.hurst), surface.realisation),
        rms=case.height,
    )
    contact = None
    stiffness, area, residual = [], [], []
    for force in surface.forces:
        contact = bem3d.solve(
            half_space,
            -height,
            force=force * case.height,
            start=contact,
            tolerance=case.tolerance,
            raise_on_failure=False,
        )
        stiffness.append(contact.stiffness(tolerance=1e-6) if contact.converged else np.nan)
        area.append(contact.area if contact.converged else np.nan)
        residual.append(contact.residual)
    return {"stiffness": np.array(stiffness), "area": np.array(area), "residual": np.array(residual)}


def press_profiles(profiles: Profiles) -> Outcome:
    """Springs: stiffness and contact fraction of every profile at each force, one sort a profile."""
    case = profiles.case
    c1d = case.spectrum(profiles.hurst).c1d
    force = case.height * np.array(case.forces)
    stiffness = np.empty((case.profiles, force.size))
    for i in range(case.profiles):
        rng = generator(case.seed, PROFILES, _key(profiles.hurst), i)
        height = mdr.rough_profile(c1d, length=1.0, points=profiles.points, rng=rng, rms=case.height)
        stiffness[i] = mdr.load_curve(height, length=profiles.length, modulus=1.0).at_force(force).stiffness
    return {"stiffness": stiffness, "fraction": stiffness / profiles.length}


def _key(hurst: float) -> int:
    """Address of a Hurst exponent, so that adding one leaves the others their random numbers."""
    return round(1000 * hurst)


def evidence(result: FractalPunchResult) -> Evidence:
    """Means and fluctuations of both methods in decibels apart, with what grid and sample leave open.

    Raises NotConvergedError where too few surfaces have converged at one of the forces.
    """
    case = result.case
    fewest = min(int(np.isfinite(ensemble.bem).sum(axis=0).min()) for ensemble in result.ensembles)
    if fewest < 3:
        raise NotConvergedError(f"{fewest} surfaces converged at one of the forces, 3 are needed", result.unconverged)
    rows: list[dict[str, float]] = []
    numbers = [_bounded(result, "bem3d", closed_forms.SQUARE_PUNCH), _bounded(result, "mdr", 1.0)]
    for h, ensemble in enumerate(result.ensembles):
        numbers += _numbers(case, h, ensemble)
        rows += _rows(case, h, ensemble)
    curves = Table("curves", {name: [row[name] for row in rows] for name in rows[0]})
    at = _level(case, case.reported[0])
    middle = result.ensembles[len(result.ensembles) // 2]
    return Evidence(
        title="Fractal punch (Fig. 14.1)",
        compared=(
            f"A rigid square punch of side L, rough from q_min = 2 pi / L to {case.cells // 4} q_min, no roll-off. "
            f"{case.surfaces} surfaces of {case.cells}² cells under boundary elements, {case.profiles} profiles of "
            f"{case.points} springs of Geike's spectrum, L_1D = L, at equal forces; Fbar = F / (E* h L), "
            "kbar = k / (E* L) on both sides, h exact in every draw. Stiffness of the frozen contact (3D) and of the "
            f"springs in contact (1D). Grid error from {case.refined} surfaces on cells half as wide, and from half as "
            "many springs."
        ),
        numbers=tuple(numbers),
        tables=(curves,),
        conclusions=(
            _summary(numbers, "mean stiffness"),
            _summary(numbers, "relative deviation"),
            f"Contact fraction is another matter: at H = {middle.hurst:g}, Fbar = {case.forces[at]:.2g} the springs in "
            f"contact make up {middle.fraction[:, at].mean():.3f} of the length, the true contact "
            f"{np.nanmean(middle.area[:, at]):.4f} of the area. MDR is no model of the contact area.",
        ),
        caption=(
            "Above: mean stiffness against force. Below: its relative standard deviation. Points with bars: boundary "
            "elements with 95 % intervals. Lines in a band: MDR with L_1D = L and its 95 % interval; dashed: MDR with "
            "L_1D = 1.1523 L."
        ),
        unconverged=result.unconverged,
    )


def _bounded(result: FractalPunchResult, method: str, flat: float) -> Number:
    """No rough punch is stiffer than the flat one."""
    largest = max(float(np.nanmax(getattr(ensemble, method.removesuffix("3d")))) for ensemble in result.ensembles)
    return Number(
        label=f"{method}: excess of the largest stiffness over that of the flat punch, {flat:g} E* L",
        value=max(0.0, largest - flat),
        reference=0.0,
        source="flat punch",
        tolerance=5e-4,
        reason="a part of the contact is never stiffer than all of it; the last digit of 1.1523",
    )


def _level(case: FractalPunch, force: float) -> int:
    """Which of the force levels is the reported one."""
    return int(np.argmin(np.abs(np.log(np.array(case.forces) / force))))


def _numbers(case: FractalPunch, h: int, ensemble: Ensemble) -> list[Number]:
    """MDR beside boundary elements at the reported forces."""
    numbers = []
    for name, statistic in STATISTICS.items():
        for r, force in enumerate(case.reported):
            level = _level(case, force)
            pairs = np.column_stack([ensemble.refined[:, r], ensemble.bem[: case.refined, level]])
            fine, coarse = pairs[np.isfinite(pairs).all(axis=1)].T
            if fine.size < 2:
                raise NotConvergedError(f"{fine.size} surfaces converged on both grids, 2 are needed")
            rng = generator(case.seed, BOOTSTRAP, h, level)
            apart = _estimate(ensemble.mdr[:, level], statistic, rng).minus(
                _estimate(ensemble.bem[:, level], statistic, rng)
            )
            # first order in the cell: what a halving changed is left to come once more, and the same for springs
            of_cells = 2 * abs(float(statistic(fine) - statistic(coarse)))
            of_springs = 2 * abs(float(statistic(ensemble.mdr[:, level]) - statistic(ensemble.mdr_coarse[:, level])))
            numbers.append(
                Number(
                    label=f"{name} at Fbar = {force:g}, H = {ensemble.hurst:g}: mdr over bem3d",
                    value=DECIBEL * apart.value,
                    reference=0.0,
                    source="bem3d",
                    tolerance=1.0,
                    unit="dB",
                    reason="1 dB (12 %): what a third-octave level can tell",
                    grid=DECIBEL * (of_cells + of_springs),
                    sample=DECIBEL * apart.half_width,
                    role=Role.FINDING,
                )
            )
    return numbers


STATISTICS: dict[str, Statistic] = {"mean stiffness": log_mean, "relative deviation": log_relative_deviation}


def _rows(case: FractalPunch, h: int, ensemble: Ensemble) -> list[dict[str, float]]:
    """One row a force: both statistics of both methods with their 95 % intervals."""
    rows = []
    for level, force in enumerate(case.forces):
        row = {"H": ensemble.hurst, "Fbar": force}
        for method, samples in (("bem3d", ensemble.bem), ("mdr", ensemble.mdr), ("mdr 1.1523 L", ensemble.mdr_long)):
            for name, statistic in STATISTICS.items():
                found = _estimate(samples[:, level], statistic, generator(case.seed, BOOTSTRAP, h, level))
                row[f"{method} {name}"] = float(np.exp(found.value))
                row[f"{method} {name} low"] = float(np.exp(found.value - found.half_width))
                row[f"{method} {name} high"] = float(np.exp(found.value + found.half_width))
        row["bem3d contact area"] = float(np.nanmean(ensemble.area[:, level]))
        row["mdr contact fraction"] = float(ensemble.fraction[:, level].mean())
        row["bem3d surfaces"] = int(np.isfinite(ensemble.bem[:, level]).sum())
        rows.append(row)
    return rows


def _estimate(samples: FloatArray, statistic: Statistic, rng: np.random.Generator) -> Estimate:
    """Over the realisations that converged (those that did not are listed by the case).

    Where springs saturate there is no deviation to take a logarithm of: minus infinity, or no finite error.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        return estimate(samples[np.isfinite(samples)], statistic, rng)


def _summary(numbers: list[Number], name: str) -> str:
    mine = [n for n in numbers if n.label.startswith(name)]
    worst = max(mine, key=lambda n: abs(n.value))
    verdicts = [n.verdict.value for n in mine]
    counts = ", ".join(f"{verdicts.count(v)} {v}" for v in ("agree", "differ", "undecided") if v in verdicts)
    return (
        f"{name.capitalize()}, MDR beside boundary elements within 1 dB: {counts}; largest difference "
        f"{worst.value:+.2f} dB ({worst.label.split(':')[0]}; grid {worst.grid:.2f} dB, sample {worst.sample:.2f} dB)."
    )
