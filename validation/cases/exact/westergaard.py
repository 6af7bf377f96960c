"""A periodic wave pressed against the half-space: the periodic operator against Westergaard."""

import math
import warnings
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray

import bem3d
from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.digits import in_four_digits
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Table, columns
from validation.analysis.wording import by_status
from validation.cases.exact.refinement import order
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.theory import closed_forms

CLAIM = "The periodic half-space gives Westergaard's contact."


@dataclass(frozen=True, kw_only=True)
class Westergaard:
    """A rigid cosine wave in line contact, at several mean pressures, on finer and finer grids of one row.

    wavelength, amplitude [m]; modulus: E* [Pa]; loads: mean pressure over that of full contact; cells: in a
    wavelength, each twice the one before; tolerance: residual of the solver.
    """

    wavelength: float = 1e-3
    amplitude: float = 1e-6
    modulus: float = 1e9
    loads: tuple[float, ...] = (0.1, 0.3, 0.5, 0.8)
    cells: tuple[int, ...] = (64, 128, 256, 512)
    tolerance: float = 1e-8

    def __post_init__(self) -> None:
        if 0.5 not in self.loads:
            raise ValueError(f"loads must contain 0.5, where the rate is measured, got {self.loads}")

    @property
    def full_pressure(self) -> float:
        """p* = pi E* h / lambda [Pa]."""
        return closed_forms.westergaard_full_pressure(
            amplitude=self.amplitude, wavelength=self.wavelength, modulus=self.modulus
        )


@dataclass(frozen=True, kw_only=True)
class Wave:
    """One load on one grid."""

    case: Westergaard
    load: float
    cells: int

    @property
    def scene(self) -> dict[str, float]:
        """Arguments of the closed forms."""
        case = self.case
        return {
            "mean_pressure": self.load * case.full_pressure,
            "amplitude": case.amplitude,
            "wavelength": case.wavelength,
            "modulus": case.modulus,
        }


@dataclass(frozen=True)
class WestergaardResult:
    """Outcomes of each load, one a grid."""

    case: Westergaard
    waves: dict[float, list[Outcome]]

    @property
    def finest(self) -> list[Outcome]:
        return [grids[-1] for grids in self.waves.values()]

    @property
    def errors(self) -> NDArray[np.float64]:
        """Of the pressure: a row a load, a column a grid."""
        return np.array([[float(o["error"]) for o in grids] for grids in self.waves.values()])


def run(case: Westergaard, engine: Engine = SERIAL) -> WestergaardResult:
    """Press the wave at each load on each grid."""
    waves = {load: [Wave(case=case, load=load, cells=n) for n in case.cells] for load in case.loads}
    return WestergaardResult(case, engine.map_groups(press_by_bem, waves))


def press_by_bem(wave: Wave) -> Outcome:
    """One row of cells along one wavelength: a third dimension would add nothing."""
    case, spacing = wave.case, wave.case.wavelength / wave.cells
    x = (np.arange(wave.cells) + 0.5) * spacing - case.wavelength / 2
    half_space = bem3d.HalfSpace(shape=(wave.cells, 1), spacing=spacing, modulus=case.modulus, periodic=True)
    gap = 2 * case.amplitude * np.sin(np.pi * x / case.wavelength) ** 2
    force = wave.scene["mean_pressure"] * case.wavelength * spacing
    with warnings.catch_warnings():
        # the contact is a line: one row of cells resolves it
        warnings.simplefilter("ignore", bem3d.ResolutionWarning)
        contact = bem3d.solve(half_space, gap[:, np.newaxis], force=force, tolerance=case.tolerance)
    exact = closed_forms.westergaard_pressure(x, **wave.scene)
    return {
        "x": x,
        "pressure": contact.pressure[:, 0],
        "exact_pressure": exact,
        "error": np.sqrt(np.sum((contact.pressure[:, 0] - exact) ** 2) / np.sum(exact**2)),
        "half_width": np.array(contact.area / (2 * spacing)),
    }


def evidence(result: WestergaardResult) -> Evidence:
    """Pressure and contact width beside the closed form at each load; order of the pressure error."""
    case, n, errors = result.case, result.case.cells, result.errors
    half = errors[case.loads.index(0.5)]
    at_loads = (_at_load(case, load, outcome) for load, outcome in zip(case.loads, result.finest, strict=True))
    numbers = (*(number for pair in at_loads for number in pair), *_at_half_load(case, half))
    edges = min(_share_of_edges(o) for o in result.finest)
    claim = answered(
        CLAIM,
        numbers,
        f"on {n[-1]} cells the relative L2 error of the pressure is {half[-1]:.1e} at 0.5 p*, where the edges of the "
        f"contact lie between cells, and {errors[:, -1].max():.1e} at the worst of {len(case.loads)} loads, where they "
        "cut a cell.",
    )
    return Evidence(
        title="Periodic wave",
        method=(
            f"A rigid wave of amplitude {case.amplitude * 1e6:g} µm and wavelength {case.wavelength * 1e3:g} mm "
            f"pressed against a half-space of E* = {case.modulus / 1e9:g} GPa at prescribed mean pressure, on one row "
            f"of {n[0]} to {n[-1]} cells. MDR is not part of this comparison: independent springs have no equivalent "
            "of a periodic line contact."
        ),
        numbers=numbers,
        tables=tuple(in_four_digits(Table(name, columns(**data))) for name, data in _data(result).items()),
        claims=(claim,),
        finding=f"{headline(claim)}.",
        headlines={"westergaard": headline(claim)},
        conclusions=(
            f"At least {math.floor(1000 * edges) / 10:g} % of the squared error is in the two cells at the edges.",
        ),
        captions={
            "westergaard": (
                "(a) Pressure at each mean pressure, finest grid, some of its cells. (b) Relative L2 error of the "
                "pressure against cells."
            )
        },
    )


def headline(claim: JudgedClaim) -> str:
    return by_status(
        claim,
        holds="The periodic half-space gives Westergaard's contact",
        fails="The periodic half-space does not give Westergaard's contact at every load",
        undecided="Whether the periodic half-space gives Westergaard's contact is open",
    )


def _share_of_edges(outcome: Outcome) -> float:
    """Part of the squared error of the pressure in the two worst cells."""
    square = np.sort((outcome["pressure"] - outcome["exact_pressure"]) ** 2)
    return float(square[-2:].sum() / square.sum())


def _at_load(case: Westergaard, load: float, outcome: Outcome) -> tuple[Number, Number]:
    """Pressure and width at one load, on the finest grid."""
    scene = Wave(case=case, load=load, cells=case.cells[-1]).scene
    a, dx = closed_forms.westergaard_half_width(**scene), case.wavelength / case.cells[-1]
    at_edge = closed_forms.westergaard_pressure(a - dx, **scene)
    here = partial(Number, model="bem3d", where={"mean p / p*": load}, source="Westergaard")
    return (
        here(
            quantity="relative L2 error of the pressure",
            value=float(outcome["error"]),
            reference=0.0,
            tolerance=float(at_edge * np.sqrt(2 / np.sum(outcome["exact_pressure"] ** 2))),
            reason="an error in both edge cells as large as the pressure one cell inside the edge",
        ),
        here(
            quantity="half-width of the contact over Westergaard",
            value=float(outcome["half_width"]) / a,
            reference=1.0,
            tolerance=dx / a,
            reason="one cell at each edge",
        ),
    )


def _at_half_load(case: Westergaard, errors: NDArray[np.float64]) -> tuple[Number, Number]:
    """The pressure where the edges of the contact lie between cells on every grid, and its order."""
    here = partial(Number, model="bem3d", where={"mean p / p*": 0.5})
    return (
        here(
            quantity="relative L2 error of the pressure, edges between cells",
            value=float(errors[-1]),
            reference=0.0,
            source="Westergaard",
            tolerance=7e-4 * 512 / case.cells[-1],
            reason="7e-4 on 512 cells, scaled to other grids at first order",
        ),
        here(
            quantity="order of the pressure error in the cell size",
            value=order(case.cells, errors),
            reference=1.0,
            source="error model",
            tolerance=0.1,
            reason="the edge cells have p ~ dx^(1/2) and the weight dx^(1/2) in L2; at half load the edges lie between "
            "cells on every grid, at other loads the error scatters",
        ),
    )


def _data(result: WestergaardResult) -> dict[str, dict[str, ArrayLike]]:
    case, finest = result.case, result.finest
    return {
        "pressure": {
            "mean p / p*": np.repeat(case.loads, case.cells[-1]),
            "x / wavelength": np.concatenate([o["x"] for o in finest]) / case.wavelength,
            "bem3d p / p*": np.concatenate([o["pressure"] for o in finest]) / case.full_pressure,
            "westergaard p / p*": np.concatenate([o["exact_pressure"] for o in finest]) / case.full_pressure,
        },
        "refinement": {
            "mean p / p*": np.repeat(case.loads, len(case.cells)),
            "cells per wavelength": np.tile(case.cells, len(case.loads)),
            "relative L2 error": result.errors.ravel(),
        },
    }


CASE = Case(
    name="westergaard",
    chapter=Chapter.EXACT,
    place=3,
    claim=CLAIM,
    answers="Periodic wave: the periodic half-space against Westergaard",
    quick=Westergaard(),
    full=Westergaard(cells=(64, 128, 256, 512, 1024)),
    run=run,
    evidence=evidence,
    needs="closed form",
)
