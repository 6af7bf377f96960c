"""Numbers of the calibration test: how many true errors estimates cover, how tight they are, and what is saved."""

import math
from collections.abc import Callable
from functools import partial

import numpy as np
from scipy import stats

from validation.analysis.evidence import Number, Role, Table
from validation.engine.random_numbers import random_generator

COVERAGE, CALIBRATED, TIGHTNESS, SAVING = (
    "share of scenes whose true error is within the estimated one",
    "share of errors of cheap models, selected or not, that are within what was calibrated",
    "estimated over true error, in the median",
    "shortfall of the total saving below a factor 2, in decades",
)
SAVED = 2.0
RESAMPLED = 400
"""Bootstrap samples of scenes, for the interval of a saving."""


def with_answer(table: Table) -> Table:
    """Rows with an answer and a reference."""
    return Table(table.name, {name: table[name][np.isfinite(table["true error"])].tolist() for name in table.columns})


def covered(table: Table) -> np.ndarray:
    """Beside a reference that has an error of its own, independent of the estimated one."""
    return np.asarray(table["true error"] <= np.hypot(table["estimated error"], table["error of the reference"]))


def tightness(table: Table) -> float:
    return float(np.median(table["estimated error"] / table["true error"]))


def saving_of(table: Table, some: slice | np.ndarray = slice(None)) -> float:
    return float(table["fine [s]"][some].sum() / table["selection [s]"][some].sum())


def clopper_pearson(inside: np.ndarray) -> tuple[float, float]:
    """95 % interval of a share."""
    found = stats.binomtest(int(np.count_nonzero(inside)), inside.size).proportion_ci()
    return float(found.low), float(found.high)


def resampled(table: Table, statistic: Callable[[np.ndarray], float]) -> tuple[float, float]:
    """95 % interval, by scenes drawn again: of the numbers of the scenes drawn."""
    size = len(table["kind"])
    rng = random_generator(0, size)
    found = [statistic(rng.integers(0, size, size)) for _ in range(RESAMPLED)]
    low, high = np.quantile(found, (0.025, 0.975))
    return float(low), float(high)


def _shortfall(saving: float) -> float:
    return max(math.log10(SAVED / saving), 0.0)


def numbers_at(tolerance: float, table: Table) -> tuple[Number, Number, Number]:
    inside = covered(table)
    least, most = clopper_pearson(inside)
    share, total, ratio = float(np.mean(inside)), saving_of(table), table["estimated error"] / table["true error"]
    low, high = resampled(table, lambda some: float(np.median(ratio[some])))
    slow, _ = resampled(table, lambda some: saving_of(table, some))
    finding = partial(Number, where={"tolerance": tolerance}, role=Role.FINDING)
    return (
        finding(
            quantity=COVERAGE,
            value=share,
            reference=1.0,
            source="an upper bound of the error",
            tolerance=0.06,
            reason="0.94: a 95 % interval; what is too wide is not tight",
            sample=max(share - least, most - share),
        ),
        finding(
            quantity=TIGHTNESS,
            value=float(np.median(ratio)),
            reference=2.0,
            source="1.96 / 0.67 of a Gaussian error, less where it is no surprise",
            tolerance=1.0,
            reason="1 to 3",
            sample=(high - low) / 2,
        ),
        finding(
            quantity=SAVING,
            value=_shortfall(total),
            reference=0.0,
            source=f"a factor {SAVED:g}",
            tolerance=0.05,
            reason="0.05 decades: 12 % of the factor",
            sample=_shortfall(slow) - _shortfall(total),
        ),
    )


def calibrated_numbers(estimates: Table) -> tuple[Number, ...]:
    """None where no cheap model has an error that is known."""
    inside = within_claims(estimates)
    if not inside.size:
        return ()
    least, most = clopper_pearson(inside)
    share = float(inside.mean())
    number = Number(
        quantity=CALIBRATED,
        value=share,
        reference=0.96,
        source="coverage of a 95 % interval",
        tolerance=0.02,
        reason="0.94 to 0.98: less is too narrow, more is too wide",
        sample=max(share - least, most - share),
        role=Role.FINDING,
    )
    return (number,)


def within_claims(estimates: Table) -> np.ndarray:
    """Of each model on each scene; the error of the reference is not allowed for."""
    return np.asarray(estimates["true error"] <= estimates["estimated error"])
