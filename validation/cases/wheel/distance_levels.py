"""Levels of Fig. 14.5: in the regions of a spectrum, one ensemble over another; the frequency of the peak."""

import math

import numpy as np

from validation.analysis.statistics import Estimate
from validation.cases.wheel.distance import DistanceResult
from validation.cases.wheel.features import PEAK, Spectrum, measured
from validation.engine.engine import Outcome
from validation.scenes.dynamic_wheel import WheelScene

PLATEAU, THIRD, FOURTH = "region 2", "region 3", "region 4"


def regions_of(scene: WheelScene) -> dict[str, tuple[float, float]]:
    """The band in which each region is measured [rad/s]."""
    return {
        PLATEAU: (2 * scene.eigenfrequency, 0.8 * scene.jump),
        THIRD: (1.1 * scene.jump, 1.1 * scene.jump + scene.oscillation_period / 2),
        FOURTH: (1.3 * scene.cutoff, 2.6 * scene.cutoff),
    }


def _of_groups(outcome: Outcome, band: tuple[float, float], window: str) -> np.ndarray:
    """The mean of A in a band, group by group."""
    inside = (outcome["omega"] >= band[0]) & (outcome["omega"] <= band[1])
    return np.asarray(outcome[window][:, inside].mean(axis=1))


def level(outcome: Outcome, band: tuple[float, float], window: str = "plain") -> Estimate:
    """ln of the mean of A in a band, with its standard error over groups of wheels."""
    groups = _of_groups(outcome, band, window)
    mean = float(groups.mean())
    error = float(np.std(groups, ddof=1)) / math.sqrt(groups.size) / mean if groups.size > 1 else 0.0
    return Estimate(math.log(max(mean, 1e-300)), error, max(groups.size, 2))


def ratio(mine: Outcome, other: Outcome, band: tuple[float, float], window: str = "plain") -> Estimate:
    """ln of a level over that of another ensemble without window; with its standard error over groups of wheels, which
    may share their tracks.
    """
    value = level(mine, band, window).value - level(other, band).value
    groups, others = _of_groups(mine, band, window), _of_groups(other, band, "plain")
    spread = np.std(groups / groups.mean() - others / others.mean(), ddof=1)
    return Estimate(value, float(spread) / math.sqrt(groups.size), groups.size)


def peaks(result: DistanceResult) -> dict[float, Estimate]:
    """The frequency of the peak over omega_eigen, by release."""
    frequencies = {}
    for release, ensemble in result.case.vibrations().items():
        value = measured(Spectrum.of(ensemble.scene, [result.vibrations[release]]))[PEAK]
        frequency = ensemble.scene.eigenfrequency
        frequencies[release] = Estimate(value.value / frequency, value.error / frequency, value.samples)
    return frequencies
