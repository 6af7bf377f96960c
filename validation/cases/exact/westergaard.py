"""A periodic wave pressed against the half-space: the periodic operator against Westergaard."""

import warnings
from dataclasses import dataclass

import numpy as np

import bem3d
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Table, claim, columns
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.theory import closed_forms


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


@dataclass(frozen=True)
class WestergaardResult:
    """One outcome for each load and grid, grids running fastest."""

    case: Westergaard
    waves: list[Outcome]


def run(case: Westergaard, engine: Engine = SERIAL) -> WestergaardResult:
    """Press the wave at each load on each grid."""
    waves = [Wave(case=case, load=load, cells=n) for load in case.loads for n in case.cells]
    return WestergaardResult(case, engine.map(press_by_bem, waves))


def press_by_bem(wave: Wave) -> Outcome:
    """One row of cells along one wavelength: a third dimension would add nothing."""
    case, spacing = wave.case, wave.case.wavelength / wave.cells
    x = (np.arange(wave.cells) + 0.5) * spacing - case.wavelength / 2
    half_space = bem3d.HalfSpace(shape=(wave.cells, 1), spacing=spacing, modulus=case.modulus, periodic=True)
    gap = 2 * case.amplitude * np.sin(np.pi * x / case.wavelength) ** 2
    mean = wave.load * case.full_pressure
    with warnings.catch_warnings():
        # cells enough for a ridge, of which there is one row
        warnings.simplefilter("ignore", bem3d.ResolutionWarning)
        contact = bem3d.solve(
            half_space, gap[:, np.newaxis], force=mean * case.wavelength * spacing, tolerance=case.tolerance
        )
    exact = closed_forms.westergaard_pressure(
        x, mean_pressure=mean, amplitude=case.amplitude, wavelength=case.wavelength, modulus=case.modulus
    )
    return {
        "x": x,
        "pressure": contact.pressure[:, 0],
        "exact_pressure": exact,
        "error": np.sqrt(np.sum((contact.pressure[:, 0] - exact) ** 2) / np.sum(exact**2)),
        "half_width": np.array(contact.area / (2 * spacing)),
    }


def evidence(result: WestergaardResult) -> Evidence:
    """Pressure and contact width against the closed form at each load; rate of the pressure error."""
    case = result.case
    n = np.array(case.cells)
    error = np.array([float(o["error"]) for o in result.waves]).reshape(len(case.loads), n.size)
    finest = result.waves[n.size - 1 :: n.size]
    numbers = [
        number
        for load, errors, outcome in zip(case.loads, error, finest, strict=True)
        for number in _at_load(case, load, float(errors[-1]), float(outcome["half_width"]))
    ]
    half = case.loads.index(0.5)
    order = float(-np.polynomial.polynomial.polyfit(np.log(n), np.log(error[half]), 1)[1])
    numbers += [
        Number(
            quantity="bem3d: pressure at 0.5 p*, relative L2 error, edges between cells",
            value=float(error[half, -1]),
            reference=0.0,
            source="Westergaard",
            tolerance=7e-4 * 512 / n[-1],
            reason="target of this suite, 7e-4 on 512 cells, carried to other grids at first order",
        ),
        Number(
            quantity="bem3d: order of the pressure error in the cell size, at 0.5 p*",
            value=order,
            reference=1.0,
            source="error model",
            tolerance=0.1,
            reason="pressure ~ dx^(1/2) in the edge cells, which weigh dx^(1/2) in L2; at half load the edges fall "
            "between cells on every grid, elsewhere they scatter",
        ),
    ]
    return Evidence(
        title="Periodic wave",
        compared=(
            f"A rigid wave of amplitude {case.amplitude * 1e6:g} µm and wavelength {case.wavelength * 1e3:g} mm "
            f"pressed against a half-space of E* = {case.modulus / 1e9:g} GPa at prescribed mean pressure, on one row "
            f"of {n[0]} to {n[-1]} cells. MDR has no part in it: a line contact that repeats itself has no "
            "one-dimensional image of independent springs."
        ),
        numbers=tuple(numbers),
        tables=(_pressure_table(result), _refinement_table(result, error)),
        conclusions=(
            claim("The periodic operator follows Westergaard at every load.", numbers),
            f"On {n[-1]} cells the relative L2 error of the pressure is {error[half, -1]:.1e} where the edges of the "
            f"contact fall between cells (0.5 p*), and {error[:, -1].max():.1e} at the worst load, where they cut a "
            f"cell; at least {100 * min(_share_of_edges(o) for o in finest):.0f} % of its square sits in the two cells "
            "at the edges.",
        ),
        captions={
            "westergaard": (
                "(a) Pressure at each mean pressure, finest grid, some of its cells. (b) Relative L2 error of the "
                "pressure against cells: of first order at 0.5 p*, where the edges fall between cells; elsewhere it "
                "rises and falls with where the edge cuts its cell."
            )
        },
    )


def _share_of_edges(outcome: Outcome) -> float:
    """Part of the squared error of the pressure in the two worst cells."""
    square = np.sort((outcome["pressure"] - outcome["exact_pressure"]) ** 2)
    return float(square[-2:].sum() / square.sum())


def _at_load(case: Westergaard, load: float, error: float, half_width: float) -> tuple[Number, Number]:
    """Pressure and width at one load, on the finest grid."""
    scene = {"amplitude": case.amplitude, "wavelength": case.wavelength, "modulus": case.modulus}
    mean = load * case.full_pressure
    a = closed_forms.westergaard_half_width(mean_pressure=mean, **scene)
    dx = case.wavelength / case.cells[-1]
    x = (np.arange(case.cells[-1]) + 0.5) * dx - case.wavelength / 2
    pressure = closed_forms.westergaard_pressure(x, mean_pressure=mean, **scene)
    at_edge = closed_forms.westergaard_pressure(a - dx, mean_pressure=mean, **scene)
    return (
        Number(
            quantity=f"bem3d: pressure at {load:g} p*, relative L2 error",
            value=error,
            reference=0.0,
            source="Westergaard",
            tolerance=float(at_edge * np.sqrt(2 / np.sum(pressure**2))),
            reason="no more than the two edge cells wrong by the pressure one cell inside the edge",
        ),
        Number(
            quantity=f"bem3d: half-width of the contact at {load:g} p*, over Westergaard",
            value=half_width / a,
            reference=1.0,
            source="Westergaard",
            tolerance=dx / a,
            reason="one cell at each edge",
        ),
    )


def _pressure_table(result: WestergaardResult) -> Table:
    case, grids = result.case, len(result.case.cells)
    outcomes = result.waves[grids - 1 :: grids]
    return Table(
        "pressure",
        columns(
            **{
                "mean p / p*": np.repeat(case.loads, case.cells[-1]),
                "x / wavelength": np.concatenate([o["x"] for o in outcomes]) / case.wavelength,
                "bem3d p / p*": np.concatenate([o["pressure"] for o in outcomes]) / case.full_pressure,
                "westergaard p / p*": np.concatenate([o["exact_pressure"] for o in outcomes]) / case.full_pressure,
            }
        ),
    )


def _refinement_table(result: WestergaardResult, error: np.ndarray) -> Table:
    case = result.case
    return Table(
        "refinement",
        columns(
            **{
                "mean p / p*": np.repeat(case.loads, len(case.cells)),
                "cells per wavelength": np.tile(case.cells, len(case.loads)),
                "relative L2 error": error.ravel(),
            }
        ),
    )


CASE = Case(
    name="westergaard",
    chapter=Chapter.EXACT,
    place=3,
    claim="The periodic half-space gives Westergaard's contact.",
    answers="Periodic wave: the periodic half-space against Westergaard",
    quick=Westergaard(),
    full=Westergaard(cells=(64, 128, 256, 512, 1024)),
    run=run,
    evidence=evidence,
    needs="closed form",
)
