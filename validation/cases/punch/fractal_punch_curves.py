"""Tables of Fig. 14.1: statistics of both methods force by force, on one grid and on three; what its figures mark."""

import math

import numpy as np

from validation.analysis.evidence import Table
from validation.analysis.statistics import at_level, log_mean, log_relative_deviation
from validation.cases.punch.decade_statistics import local_exponent
from validation.cases.punch.ensembles import Row, cells_in_contact, interval_columns
from validation.cases.punch.fractal_punch import Ensemble, FractalPunch
from validation.cases.punch.fractal_punch_decades import QUANTITIES, EnsembleSamples
from validation.cases.punch.fractal_punch_numbers import CLAIMED, PUBLISHED
from validation.simulation.rough_punch import BEM, MDR


def curve(case: FractalPunch, ensemble: Ensemble, samples: EnsembleSamples) -> list[Row]:
    """One row a force: the statistics of both methods with their 95 % intervals, and the ratio of the deviations."""
    return [_row(case, ensemble, samples, level) for level in range(len(case.forces))]


def _row(case: FractalPunch, ensemble: Ensemble, samples: EnsembleSamples, level: int) -> Row:
    row = {"H": ensemble.hurst, "Fbar": case.forces[level]}
    mean, deviation = at_level(level, log_mean), at_level(level, log_relative_deviation)
    slope = local_exponent(case.forces, level)
    for method, mine in samples.methods.items():
        row |= interval_columns(f"{method} mean stiffness", mine.estimate(mean), math.exp)
        row |= interval_columns(f"{method} relative deviation", mine.estimate(deviation), math.exp)
        row |= interval_columns(f"{method} exponent", mine.estimate(slope), float)
    mdr, bem = (samples.methods[method].estimate(deviation) for method in (MDR, BEM))
    row |= interval_columns("mdr over bem3d relative deviation", mdr.minus(bem), math.exp)
    row["bem3d contact fraction"] = float(np.nanmean(ensemble.bem["area"][:, level]))
    row |= cells_in_contact(row["bem3d contact fraction"], case.cells)
    row["mdr contact fraction"] = float(ensemble.mdr["area"][:, level].mean())
    row["bem3d applications"] = float(np.mean(ensemble.bem["applications"][:, level]))
    row["bem3d applications of the stiffness"] = float(np.mean(ensemble.bem["frozen applications"][:, level]))
    row["bem3d surfaces"] = int(np.isfinite(ensemble.bem["stiffness"][:, level]).sum())
    return row


def grids(case: FractalPunch, ensemble: Ensemble, samples: EnsembleSamples) -> list[Row]:
    """One row a force of the refined surfaces: both statistics on three grids, and extrapolated."""
    rows = []
    half = len(case.refined_forces)
    for level, force in enumerate(case.refined_forces):
        surfaces = np.isfinite(ensemble.finer["stiffness"][:, level]).sum()
        row = {"H": ensemble.hurst, "Fbar": force, "surfaces": float(surfaces)}
        for name, statistic in (("mean stiffness", log_mean), ("relative deviation", log_relative_deviation)):
            places = (samples.coarser, level), (samples.finer, level), (samples.finer, half + level)
            values = [s.estimate(at_level(place, statistic)).value for s, place in places]
            for cells, value in zip(case.grids, values, strict=True):
                row[f"{name}, {cells}²"] = math.exp(value)
            row[f"{name}, extrapolated"] = math.exp(2 * values[2] - values[1])
        rows.append(row)
    return rows


def marks() -> Table:
    """Constants that the figures draw."""
    values = {
        "tolerance of the relative deviation [dB]": QUANTITIES["relative deviation"].tolerance,
        "claimed of rolling [dB]": CLAIMED,
        "smallest published exponent": PUBLISHED[0],
        "largest published exponent": PUBLISHED[1],
    }
    return Table("marks", {"mark": list(values), "value": list(values.values())})
