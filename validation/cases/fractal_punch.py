"""Fig. 14.1: mean and relative standard deviation of the contact stiffness of rough square punches."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import bem3d
import mdr
from validation import closed_forms
from validation.ensemble import SERIAL, Engine, Outcome, generator
from validation.evidence import Evidence, NotConvergedError, Number, Role, Table, Verdict
from validation.statistics import Estimate, Statistic, estimate, log_mean, log_relative_deviation

FloatArray = NDArray[np.float64]

Row = dict[str, float]

DECIBEL = 20 / np.log(10)
# a contact of fewer cells is under-resolved
FEW_CELLS = 16
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
    reported: tuple[float, ...] = (0.01, 0.1, 1.0, 10 ** (1 / 3), 10.0)
    refined: int = 3
    points: int = 2048
    height: float = 1e-3
    tolerance: float = 1e-5
    seed: int = 14

    def __post_init__(self) -> None:
        for force in self.reported:
            if not np.isclose(force, self.forces).any():
                raise ValueError(f"reported must be among the forces {self.forces}, got {force}")

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
    bounds = [_bounded(result, "bem3d", closed_forms.SQUARE_PUNCH), _bounded(result, "mdr", 1.0)]
    apart = {
        name: [n for h, ensemble in enumerate(result.ensembles) for n in _apart(case, h, ensemble, name)]
        for name in STATISTICS
    }
    rows = [row for h, ensemble in enumerate(result.ensembles) for row in _rows(case, h, ensemble)]
    return Evidence(
        title="Fractal punch (Fig. 14.1)",
        compared=(
            f"A rigid square punch of side L, rough from q_min = 2π/L to {case.cells // 4} q_min, no roll-off. "
            f"{case.surfaces} surfaces of {case.cells}² cells under boundary elements, {case.profiles} profiles of "
            f"{case.points} springs of Geike's spectrum, L_1D = L, at equal forces; Fbar = F / (E* h L), "
            "kbar = k / (E* L) on both sides, h exact in every draw. Stiffness of the frozen contact (3D) and of the "
            f"springs in contact (1D). Grid error from {case.refined} surfaces on cells half as wide, and from half as "
            "many springs."
        ),
        numbers=(*bounds, *apart["mean stiffness"], *apart["relative deviation"]),
        tables=(Table("curves", {name: [row[name] for row in rows] for name in rows[0]}),),
        conclusions=(*(_summary(name, numbers) for name, numbers in apart.items()), *_saturation(rows), *_area(rows)),
        caption=(
            "Above: mean stiffness k / (E* L) against force Fbar = F / (E* h L). Below: its relative standard "
            "deviation. Circles: boundary elements, 95 % intervals of the sample alone, open where the mean contact "
            f"has fewer than {FEW_CELLS} cells. Full line in a band: MDR with L_1D = L and its 95 % interval; dashed: "
            "MDR with L_1D = 1.1523 L. Below, the lines end where all springs of all profiles are in contact and no "
            "deviation is left. Dotted: slope 1 / (1 + H), through the boundary elements at Fbar = 0.1."
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


def _apart(case: FractalPunch, h: int, ensemble: Ensemble, name: str) -> list[Number]:
    """MDR beside boundary elements at the reported forces, as far as both have the statistic."""
    statistic = STATISTICS[name]
    numbers = []
    for r, force in enumerate(case.reported):
        level = _level(case, force)
        pairs = np.column_stack([ensemble.refined[:, r], ensemble.bem[: case.refined, level]])
        fine, coarse = pairs[np.isfinite(pairs).all(axis=1)].T
        if fine.size < 2:
            raise NotConvergedError(f"{fine.size} surfaces converged on both grids, 2 are needed")
        rng = generator(case.seed, BOOTSTRAP, h, level)
        springs = _estimate(ensemble.mdr[:, level], statistic, rng)
        if not np.isfinite([springs.value, springs.error]).all():
            continue
        apart = springs.minus(_estimate(ensemble.bem[:, level], statistic, rng))
        # first order in the cell: what a halving changed is left to come once more, and the same for springs
        of_cells = 2 * abs(float(statistic(fine) - statistic(coarse)))
        of_springs = 2 * abs(springs.value - float(statistic(ensemble.mdr_coarse[:, level])))
        numbers.append(
            Number(
                label=f"{name} at H = {ensemble.hurst:g}, Fbar = {force:.3g}: mdr over bem3d",
                value=DECIBEL * apart.value,
                reference=0.0,
                source="bem3d",
                tolerance=1.0,
                unit="dB",
                reason="12 %, what a third-octave level can tell",
                grid=DECIBEL * (of_cells + of_springs),
                sample=DECIBEL * apart.half_width,
                role=Role.FINDING,
            )
        )
    return numbers


STATISTICS: dict[str, Statistic] = {"mean stiffness": log_mean, "relative deviation": log_relative_deviation}


def _rows(case: FractalPunch, h: int, ensemble: Ensemble) -> list[Row]:
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
        row["bem3d contact fraction"] = float(np.nanmean(ensemble.area[:, level]))
        row["bem3d cells in contact"] = row["bem3d contact fraction"] * case.cells**2
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


def _summary(name: str, numbers: list[Number]) -> str:
    """How many agree, which differ and by how much."""
    verdicts = [n.verdict for n in numbers]
    counts = ", ".join(f"{verdicts.count(v)} {v}" for v in Verdict if v in verdicts)
    differ = [
        f"{n.label.removeprefix(name + ' at ').removesuffix(': mdr over bem3d')} ({n.value:+.2f} dB)"
        for n in numbers
        if n.verdict is Verdict.DIFFER
    ]
    return f"{name.capitalize()}, MDR beside boundary elements within 1 dB: {counts}" + (
        f"; differ: {'; '.join(differ)}." if differ else "."
    )


def _saturation(rows: list[Row]) -> tuple[str, ...]:
    """Where the springs have no fluctuation left and the boundary elements still have."""
    still = [row for row in rows if row["mdr relative deviation"] == 0]
    first = {row["H"]: row for row in reversed(still)}
    return tuple(
        f"At H = {hurst:g} all springs of all profiles are in contact from Fbar = {row['Fbar']:.3g} on: MDR has no "
        f"fluctuation left, boundary elements have a relative deviation of {row['bem3d relative deviation']:.2g}."
        for hurst, row in sorted(first.items())
    )


def _area(rows: list[Row]) -> tuple[str, ...]:
    """True contact beside the springs in contact, in the middle of the curves."""
    row = rows[len(rows) // 2]
    return (
        f"Contact area is another matter: at H = {row['H']:g}, Fbar = {row['Fbar']:.2g} the springs in contact make up "
        f"{row['mdr contact fraction']:.3f} of the length, the true contact {row['bem3d contact fraction']:.4f} of the "
        "area. MDR is no model of the contact area.",
    )
