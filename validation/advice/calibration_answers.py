"""Answers of boundary elements on the scenes of the calibration, so that a new model is measured in seconds.

They stand in `calibration_answers.npz` beside this file, readable with numpy alone: of each kind of scene and quantity,
as "punch stiffness", an array a field of `Answers` and "about", a text with date, command and digest of the code.
"""

import hashlib
import io
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import astuple, dataclass, fields
from functools import cache, cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from validation.advice import calibration
from validation.advice.calibration_scenes import CalibrationScene
from validation.engine.engine import FloatArray, Outcome
from validation.simulation.model import GridModel, models_serving

ANSWERS = Path(__file__).with_suffix(".npz")
ABOUT = "about"
Group = tuple[str, str]
"""Kind of scene, quantity."""


@dataclass(frozen=True, eq=False)
class Answers:
    """Of one kind of scene and quantity, scenes without an answer left out.

    number: of the scenes; reference: relative error that each answer leaves; size: numbers of it, as bands; count:
    realisations that it is the mean of; value: all answers, one behind the other; each: their realisations, as
    well; about: date, command, seed, digest of the code.
    """

    number: NDArray[np.int64]
    reference: FloatArray
    size: NDArray[np.int64]
    count: NDArray[np.int64]
    value: FloatArray
    each: FloatArray
    about: Mapping[str, str]

    @classmethod
    def of(cls, found: Sequence[tuple[CalibrationScene, Outcome]], about: Mapping[str, str]) -> "Answers":
        known = [(point.number, one) for point, one in found if not one["failed"]]
        each = [one["each"] for _, one in known]
        return cls(
            number=np.array([number for number, _ in known], dtype=np.int64),
            reference=np.array([float(one["reference"]) for _, one in known]),
            size=np.array([one["value"].size for _, one in known], dtype=np.int64),
            count=np.array([len(one) for one in each], dtype=np.int64),
            value=np.concatenate([np.empty(0), *(one["value"] for _, one in known)]),
            each=np.concatenate([np.empty(0), *(one.ravel() for one in each)]),
            about=about,
        )

    def scenes(self, group: Group) -> Iterator[tuple[CalibrationScene, FloatArray, FloatArray]]:
        """Each with its value and its realisations (count, size)."""
        values = np.split(self.value, np.cumsum(self.size)[:-1])
        each = np.split(self.each, np.cumsum(self.size * self.count)[:-1])
        for number, value, rows in zip(self.number.tolist(), values, each, strict=bool(self.number.size)):
            point = CalibrationScene(kind=group[0], number=number, quantity=group[1], seed=self.seed)
            yield point, value, rows.reshape(-1, value.size)

    @property
    def seed(self) -> int:
        """Of the scenes."""
        return int(self.about["command"].rsplit(" ", 1)[1])

    @cached_property
    def digest(self) -> str:
        """Of all numbers."""
        return hashlib.sha256(b"".join(one.tobytes() for one in astuple(self)[:-1])).hexdigest()[:16]


def answers_of(
    points: Sequence[CalibrationScene], outcomes: Sequence[Outcome], about: Mapping[str, str]
) -> dict[Group, Answers]:
    """Of `reference_answer` or more. about: lines of the provenance."""
    groups: dict[Group, list[tuple[CalibrationScene, Outcome]]] = {}
    for point, outcome in zip(points, outcomes, strict=True):
        groups.setdefault((point.kind, point.quantity), []).append((point, outcome))
    return {group: Answers.of(some, {**about, "code": code_of(some[0][0])}) for group, some in groups.items()}


def code_of(point: CalibrationScene) -> str:
    """Digest of the code that an answer rests on."""
    (judge,) = (one for one in models_serving(point.scene, point.quantity) if isinstance(one, GridModel))
    return calibration.code_behind(judge, point.target())


def as_file(groups: Mapping[Group, Answers]) -> bytes:
    """Equal for equal answers."""
    arrays = {
        f"{kind} {quantity} {field.name}": np.array(json.dumps(value)) if field.name == ABOUT else value
        for (kind, quantity), answers in sorted(groups.items())
        for field in fields(answers)
        for value in [getattr(answers, field.name)]
    }
    contents = io.BytesIO()
    np.savez_compressed(contents, **arrays)  # type: ignore[arg-type]  # stubs take a name for a flag
    return contents.getvalue()


@cache
def answers_in(path: Path = ANSWERS) -> Mapping[Group, Answers]:
    """All that are there; none without a file."""
    if not path.exists():
        return {}
    with np.load(path, allow_pickle=False) as entries:
        arrays = {name: entries[name] for name in entries.files}
    found: dict[Group, dict[str, NDArray[np.generic]]] = {}
    for name, array in arrays.items():
        kind, quantity, field = name.split(" ")
        found.setdefault((kind, quantity), {})[field] = array
    return {group: Answers(**{**some, ABOUT: json.loads(str(some[ABOUT]))}) for group, some in found.items()}


def merged(path: Path, made: Mapping[Group, Answers]) -> bytes:
    """Those of a file, with these in the place of the same kinds. ValueError where a kind would have fewer scenes."""
    answers_in.cache_clear()  # which may have been written since
    there = answers_in(path)
    for group, answers in there.items():
        if group in made and made[group].number.size < answers.number.size:
            wanted = f"as many answers as there are, {answers.number.size} of {' '.join(group)}"
            raise ValueError(f"--answers must leave {wanted}, got {made[group].number.size}")
    return as_file({**there, **made})
