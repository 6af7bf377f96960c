"""What is heard: the A-weighting of levels, and columns of a table that are played at one rate and with one gain."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from validation.analysis.statistics import FloatArray


def a_weighting(frequency: ArrayLike) -> FloatArray:
    """A(f) [dB] of IEC 61672-1: 20 lg of the product of its four corner frequencies' factors, 0 at 1 kHz."""
    square = np.asarray(frequency, dtype=np.float64) ** 2
    low, middle, upper, high = 20.6**2, 107.7**2, 737.9**2, 12194.0**2
    gain = high * square**2 / ((square + low) * np.sqrt((square + middle) * (square + upper)) * (square + high))
    return np.asarray(20 * np.log10(gain) + 2.00)


def energy_sum(levels: ArrayLike) -> float:
    """10 lg of the sum of the powers of levels [dB]."""
    return float(10 * np.log10(np.sum(10 ** (np.asarray(levels) / 10))))


@dataclass(frozen=True, kw_only=True)
class Sound:
    """A column that is played. name: of its file; label: of its player; says: what is to be known beside it."""

    name: str
    label: str
    column: str
    says: str


@dataclass(frozen=True, kw_only=True)
class Sounds:
    """Sounds that are compared, so that they have one gain.

    table: of the samples, a column each; rate [1/s]; full_scale: what the largest number of a file stands for, in the
    unit of the columns; repeats: how often the samples, a period, are played; heard: what is heard, in sentences.
    Raises ValueError for two sounds of one name.
    """

    table: str
    rate: int
    full_scale: float
    repeats: int
    heard: str
    tracks: tuple[Sound, ...]

    def __post_init__(self) -> None:
        names = [sound.name for sound in self.tracks]
        if twice := {name for name in names if names.count(name) > 1}:
            raise ValueError(f"sounds must have names of their own, got twice: {', '.join(sorted(twice))}")


def common_full_scale(signals: Iterable[FloatArray]) -> float:
    """The least number of two digits that no sample of any signal exceeds."""
    peak = max(float(np.abs(signal).max()) for signal in signals)
    if not peak > 0:
        raise ValueError("signals must have a sample that is not zero, got silence alone")
    digit = 10.0 ** (math.floor(math.log10(peak)) - 1)
    return float(f"{math.ceil(peak / digit) * digit:.6g}")


def filtered(signal: FloatArray, gain: FloatArray) -> FloatArray:
    """A periodic signal whose waves have a gain each, from frequency zero on."""
    return np.asarray(np.fft.irfft(gain * np.fft.rfft(signal), signal.size))


def powers_of_blocks(signal: FloatArray, blocks: int) -> FloatArray:
    """Mean square of so many equal pieces; what is left over belongs to none."""
    complete_blocks = signal[: signal.size // blocks * blocks]
    return np.asarray(np.mean(complete_blocks.reshape(blocks, -1) ** 2, axis=1))
