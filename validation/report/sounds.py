"""Sound files of a report: columns of its tables as 16 bit WAV."""

import io

import numpy as np
import scipy.io.wavfile
from numpy.typing import ArrayLike, NDArray

from validation.analysis.evidence import Evidence, Table
from validation.analysis.spectra import Sounds
from validation.report.folder import SOUNDS

LARGEST = 2**15 - 1
"""Number of a 16 bit file that stands for the full scale."""


def quantised(samples: ArrayLike, full_scale: float) -> NDArray[np.int16]:
    """Samples as whole numbers. Raises ValueError where one is beyond the full scale: it would be clipped."""
    values = np.asarray(samples, dtype=np.float64)
    if not np.abs(values).max(initial=0.0) <= full_scale:
        raise ValueError(f"samples must lie within the full scale {full_scale:g}, got {np.abs(values).max():g}")
    return np.rint(LARGEST / full_scale * values).astype(np.int16)


def wavs(sounds: Sounds, samples: Table) -> dict[str, bytes]:
    """A mono file of 16 bit for each track, by its name without a suffix, `repeats` times the samples.

    Raises ValueError for a sample beyond `full_scale`.
    """
    files = {}
    for track in sounds.tracks:
        values = quantised(samples[track.column], sounds.full_scale)
        buffer = io.BytesIO()
        scipy.io.wavfile.write(buffer, sounds.rate, np.tile(values, sounds.repeats))
        files[track.name] = buffer.getvalue()
    return files


def sound_files(case: str, evidence: Evidence) -> dict[str, bytes]:
    """Of all sounds of a case, by the places in the report folder."""
    files = wavs(evidence.sounds, evidence.table(evidence.sounds.table)) if evidence.sounds else {}
    return {sound_place(case, name): contents for name, contents in files.items()}


def sound_place(case: str, name: str) -> str:
    """In the report folder."""
    return f"{SOUNDS}/{case}-{name}.wav"
