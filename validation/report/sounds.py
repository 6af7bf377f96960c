"""Sound files of a report: columns of its tables as 16 bit WAV."""

import io
from pathlib import PurePath

import numpy as np
import scipy.io.wavfile
from numpy.typing import ArrayLike, NDArray

from validation.analysis.evidence import Evidence
from validation.report.folder import SOUNDS

LARGEST = 2**15 - 1
"""Number of a 16 bit file that stands for the full scale."""


def quantised(samples: ArrayLike, full_scale: float) -> NDArray[np.int16]:
    """Samples as whole numbers. Raises ValueError where one is beyond the full scale: it would be clipped."""
    values = np.asarray(samples, dtype=np.float64)
    if not np.abs(values).max(initial=0.0) <= full_scale:
        raise ValueError(f"samples must lie within the full scale {full_scale:g}, got {np.abs(values).max():g}")
    return np.rint(LARGEST / full_scale * values).astype(np.int16)


def wav(samples: ArrayLike, *, rate: int, full_scale: float, repeats: int = 1) -> bytes:
    """A mono file of 16 bit; rate: samples a second."""
    buffer = io.BytesIO()
    scipy.io.wavfile.write(buffer, rate, np.tile(quantised(samples, full_scale), repeats))
    return buffer.getvalue()


def sound_files(case: str, evidence: Evidence) -> dict[str, bytes]:
    """Of all sounds of a case, by the places in the report folder."""
    sounds = evidence.sounds
    if sounds is None:
        return {}
    table = evidence.table(sounds.table)
    return {
        sound_place(case, sound.name): wav(
            table[sound.column], rate=sounds.rate, full_scale=sounds.full_scale, repeats=sounds.repeats
        )
        for sound in sounds.tracks
    }


def sound_place(case: str, name: str) -> str:
    """In the report folder."""
    return PurePath(SOUNDS, f"{case}-{name}.wav").as_posix()
