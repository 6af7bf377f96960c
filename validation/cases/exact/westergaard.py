"""A periodic wave pressed against the half-space: the periodic operator against Westergaard."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim, off_by
from validation.analysis.series import Series, single
from validation.analysis.study import Outcomes, Study
from validation.cases.exact.refinement import order
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.exact_contacts import CosineWave, press_wave
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

    def wave(self, load: float, cells: int) -> CosineWave:
        same = partial(CosineWave, wavelength=self.wavelength, amplitude=self.amplitude, modulus=self.modulus)
        return same(load=load, cells=cells, tolerance=self.tolerance)


def run(case: Westergaard, engine: Engine = SERIAL) -> Outcomes:
    """Press the wave at each load on each grid."""
    waves = {load: [case.wave(load, n) for n in case.cells] for load in case.loads}
    return Outcomes(case, engine.map_groups(press_wave, waves))


BEM, EXACT, FIRST = "bem3d", "Westergaard", "first order"
LOAD, PLACE, CELLS = "mean p / p*", "x / wavelength", "cells per wavelength"
PRESSURE, ERROR = "pressure p / p*", "relative L2 error of the pressure"
ON_GRIDS, EDGES = f"{ERROR} on each grid", "share of the squared error in the two worst cells"
FIRST_ORDER = (
    "the edge cells have p ~ dx^(1/2) and the weight dx^(1/2) in L2; at half load the edges lie between cells on every "
    "grid, at other loads the error scatters"
)


def series(result: Outcomes) -> list[Series]:
    """Pressure and contact width beside the closed form at each load; order of the pressure error."""
    case, loads = result.case, result.case.loads
    errors = {load: np.array([float(o["error"]) for o in result[load]]) for load in loads}
    edges = np.array([_share_of_edges(result[load][-1]) for load in loads])
    guide = errors[0.5][0] * case.cells[0] / np.array(case.cells)
    by_cells = partial(Series, ON_GRIDS, along=CELLS, at=case.cells)
    return [
        *(one for load in loads for one in _at_load(case.wave(load, case.cells[-1]), result[load][-1])),
        *(by_cells(BEM, errors[load], where={LOAD: load}) for load in loads),
        by_cells(FIRST, guide, where={LOAD: 0.5}),
        Series(EDGES, BEM, edges, along=LOAD, at=loads),
        *_at_half_load(case, errors[0.5]),
    ]


def _share_of_edges(found: Outcome) -> float:
    square = np.sort((found["pressure"] - found["exact_pressure"]) ** 2)
    return float(square[-2:].sum() / square.sum())


def _at_load(wave: CosineWave, found: Outcome) -> Iterator[Series]:
    """Pressure and width on the finest grid."""
    here = partial(single, where={LOAD: wave.load})
    by_place = partial(Series, PRESSURE, where={LOAD: wave.load}, along=PLACE, at=found["x"] / wave.wavelength)
    yield by_place(BEM, found["pressure"] / wave.full_pressure)
    yield by_place(EXACT, found["exact_pressure"] / wave.full_pressure)
    a = closed_forms.westergaard_half_width(**wave.scene)
    at_edge = closed_forms.westergaard_pressure(a - wave.spacing, **wave.scene)
    near = float(at_edge * np.sqrt(2 / np.sum(found["exact_pressure"] ** 2)))
    why = "an error in both edge cells as large as the pressure one cell inside the edge"
    yield here(ERROR, BEM, float(found["error"]), near, EXACT, why)
    width, one_cell = float(found["half_width"]) / a, "one cell at each edge"
    yield here("half-width of the contact over Westergaard", BEM, width, wave.spacing / a, EXACT, one_cell, 1.0)


def _at_half_load(case: Westergaard, errors: NDArray[np.float64]) -> Iterator[Series]:
    """The pressure where the edges of the contact lie between cells on every grid, and its order."""
    here = partial(single, where={LOAD: 0.5})
    near, scaled = 7e-4 * 512 / case.cells[-1], "7e-4 on 512 cells, scaled to other grids at first order"
    yield here(f"{ERROR}, edges between cells", BEM, float(errors[-1]), near, EXACT, scaled)
    rate = order(case.cells, errors)
    yield here("order of the pressure error in the cell size", BEM, rate, 0.1, "error model", FIRST_ORDER, 1.0)


at_each_load = partial(Curve, by=(LOAD,))
PRESSED = at_each_load(PRESSURE, EXACT, "exact", EXACT), at_each_load(PRESSURE, BEM, "open marks", apart=0.02)
ERRORS = at_each_load(ON_GRIDS, BEM, "open marks"), Curve(ON_GRIDS, FIRST, "guide", FIRST)
STUDY = Study(
    title="Periodic wave",
    method=(
        "A rigid wave of amplitude {c.amplitude:SI}m and wavelength {c.wavelength:SI}m pressed against a half-space of "
        "E* = {c.modulus:SI}Pa at prescribed mean pressure, on one row of {c.cells} cells. MDR is not part of this "
        "comparison: independent springs have no equivalent of a periodic line contact."
    ),
    series=series,
    claims=(
        Claim(printed=off_by).saying(
            "The periodic half-space gives Westergaard's contact.",
            short="The periodic half-space beside Westergaard's contact",
        ),
    ),
    charts=(
        Chart("westergaard").of(
            "(a) Pressure at each mean pressure, finest grid, some of its cells; lines: Westergaard. (b) Relative L2 "
            "error of the pressure against cells.",
            Panel(PLACE, PRESSURE, log="").of(*PRESSED),
            Panel(CELLS, ERROR, log="xy", ticked=True).of(*ERRORS),
        ),
    ),
    printed=(EDGES,),
)
CASE = Case(
    name="westergaard",
    chapter=Chapter.EXACT,
    place=3,
    answers="Periodic wave: the periodic half-space against Westergaard",
    quick=Westergaard(),
    full=Westergaard(cells=(64, 128, 256, 512, 1024)),
    run=run,
    study=STUDY,
    needs="closed form",
)
