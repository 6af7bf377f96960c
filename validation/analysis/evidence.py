"""Evidence: numbers with a reference, a tolerance, an error bar and a verdict; tables behind figures; conclusions."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike

from validation.analysis.spectra import Sounds

Place = str | float | tuple[float, float]
"""A region by its name, a parameter by its value, or a range of it by both ends."""


class Verdict(StrEnum):
    """Of a number relative to its reference; the last two are of a model that has no number.

    Attributes
    ----------
    WITHIN : Verdict
        The whole 95 % interval lies within the tolerance.
    OUTSIDE : Verdict
        The whole interval lies outside it.
    INCONCLUSIVE : Verdict
        The interval straddles the limit.
    NOT_SERVED : Verdict
        The model rejects the scene.
    NO_RESULT : Verdict
        The model failed.

    Examples
    --------
    >>> [str(verdict) for verdict in validation.Verdict]
    ['within tolerance', 'outside tolerance', 'inconclusive', 'not served', 'no result']
    """

    WITHIN = "within tolerance"
    OUTSIDE = "outside tolerance"
    INCONCLUSIVE = "inconclusive"
    NOT_SERVED = "not served"
    NO_RESULT = "no result"

    @classmethod
    def _missing_(cls, value: object) -> "Verdict | None":
        """The verdict whose value in files of schema 1 this is; None where there is none."""
        return next((verdict for verdict, earlier in EARLIER_VERDICTS.items() if earlier == value), None)

    @property
    def earlier(self) -> str:
        """Its value in files of schema 1, which schema 2 keeps for one release under the same key."""
        return EARLIER_VERDICTS[self]

    @property
    def css(self) -> str:
        """A class of the style sheet: "within", "outside", "inconclusive", "not-served", "no-result"."""
        return self.removesuffix(" tolerance").replace(" ", "-")

    @property
    def sign(self) -> str:
        """One character of a strip: = within tolerance, # outside, ? inconclusive, r not served, x no result."""
        return SIGNS[self]


EARLIER_VERDICTS = {
    Verdict.WITHIN: "agree",
    Verdict.OUTSIDE: "differ",
    Verdict.INCONCLUSIVE: "undecided",
    Verdict.NOT_SERVED: "refused",
    Verdict.NO_RESULT: "failed",
}
OF_NUMBERS = (Verdict.WITHIN, Verdict.OUTSIDE, Verdict.INCONCLUSIVE)
"""Verdicts that a number has."""
SIGNS = dict(zip(Verdict, "=#?rx", strict=True))


def verdict_of(difference: float, half_width: float, tolerance: float, rounding: float = 0.0) -> Verdict:
    """WITHIN where |difference| + half_width <= tolerance, OUTSIDE where |difference| - half_width > tolerance.

    Else INCONCLUSIVE. All three in one unit; half_width: of the 95 % interval; rounding: relative to the tolerance, of
    values that are computed from each other.
    """
    limit = tolerance * (1 + rounding)
    if abs(difference) + half_width <= limit:
        return Verdict.WITHIN
    return Verdict.OUTSIDE if abs(difference) - half_width > limit else Verdict.INCONCLUSIVE


class Role(StrEnum):
    """A criterion must agree, or the run has failed; a finding is an answer whichever way it comes out.

    An identity agrees for every input by construction: it checks the code, must agree, and is evidence of no claim.
    """

    CRITERION = "criterion"
    FINDING = "finding"
    IDENTITY = "identity"


@dataclass(frozen=True, kw_only=True)
class Number:
    """One number beside its reference.

    quantity: what was measured; model: by which model, and over which, empty where there is one alone; where: the
    conditions, by name; these three are its key. value, reference, tolerance: in the same unit; grid, sample:
    half-widths of the 95 % intervals that the grid and the number of realisations leave open, in the same unit. What is
    left of value - reference is the model's.
    """

    quantity: str
    model: str = ""
    where: Mapping[str, Place] = field(default_factory=dict)
    value: float
    reference: float
    source: str
    tolerance: float
    reason: str
    unit: str = "-"
    grid: float = 0.0
    sample: float = 0.0
    role: Role = Role.CRITERION

    def __post_init__(self) -> None:
        for name in ("value", "reference", "tolerance", "grid", "sample"):
            if not np.isfinite(getattr(self, name)):
                raise ValueError(f"{name} of {self.label!r} must be finite, got {getattr(self, name)}")
        for name in ("tolerance", "grid", "sample"):
            if getattr(self, name) < 0:
                raise ValueError(f"{name} of {self.label!r} must not be negative, got {getattr(self, name)}")

    @property
    def label(self) -> str:
        """Its key as a person reads it: "springs over bem3d: level, h/d = 0.1, low band"."""
        what = f"{self.model}: {self.quantity}" if self.model else self.quantity
        return f"{what}, {self.conditions}" if self.where else what

    @property
    def conditions(self) -> str:
        """The last part of its key: "h/d = 0.1, low band"."""
        return where_text(self.where)

    @property
    def difference(self) -> float:
        return self.value - self.reference

    @property
    def uncertainty(self) -> float:
        """The two half-widths together, added as if they went the same way."""
        return self.grid + self.sample

    @property
    def verdict(self) -> Verdict:
        """The verdict on the difference from the reference, by the 95 % interval and the tolerance."""
        return verdict_of(self.difference, self.uncertainty, self.tolerance)

    @property
    def sample_needed(self) -> float:
        """How many times the sample would decide if value and grid stayed; infinite where the grid leaves too much."""
        room = abs(abs(self.difference) - self.tolerance) - self.grid
        ratio = self.sample / room if room > 0 else np.inf
        return ratio * ratio

    @property
    def sentence(self) -> str:
        """All of it in a line."""
        return (
            f"{self.label} = {self.value:.6g}{self.behind} ± {self.uncertainty:.2g}{self.behind}, {self.verdict}: "
            f"reference {self.reference:.6g}{self.behind}, tolerance {self.tolerance:.2g}{self.behind}"
        )

    @property
    def behind(self) -> str:
        """Its unit as it stands behind a value, nothing where it has none."""
        return "" if self.unit == "-" else f" {self.unit}"

    @property
    def met(self) -> bool:
        """False for a criterion or an identity that does not agree."""
        return self.role is Role.FINDING or self.verdict is Verdict.WITHIN


def numbers_with(
    numbers: Iterable[Number], quantity: str | None = None, model: str | None = None, **where: Place
) -> list[Number]:
    """Those whose key has these parts, in their order. Conditions with other letters: `**{"h/d": 0.1}`."""
    named = (n for n in numbers if quantity in (None, n.quantity) and model in (None, n.model))
    return [number for number in named if where.items() <= number.where.items()]


def number_with(
    numbers: Iterable[Number], quantity: str | None = None, model: str | None = None, **where: Place
) -> Number:
    """The one number whose key has these parts. Raises LookupError where there is none, or more than one."""
    matching = numbers_with(numbers, quantity, model, **where)
    if len(matching) != 1:
        raise LookupError(f"one number must have quantity {quantity!r}, model {model!r}, {where}, got {len(matching)}")
    return matching[0]


def where_text(where: Mapping[str, Place]) -> str:
    """ "h/d = 0.1, low band": values by their names, a region by itself."""
    return ", ".join(_placed(name, value) for name, value in where.items())


def _placed(name: str, value: Place) -> str:
    if isinstance(value, str):
        return value
    return placed(name, f"{value[0]:g} to {value[1]:g}" if isinstance(value, tuple) else f"{value:g}")


def placed(name: str, value: str) -> str:
    """ "h/d = 0.1", "f = 177 Hz", and of words with a unit "10 dB over ISO 3095"."""
    symbol, _, unit = name.removesuffix("]").partition(" [")
    if unit and " " in symbol:
        return f"{value} {unit} {symbol}"
    return f"{symbol} = {value}{f' {unit}' if unit else ''}"


@dataclass(frozen=True)
class VerdictCell:
    """A cell of a table on the page: a text, the verdict that belongs to it, and what may follow."""

    text: str
    verdict: Verdict
    after: str = ""

    def __str__(self) -> str:
        return f"{self.text}: {self.verdict}" + (f"; {self.after}" if self.after else "")


@dataclass(frozen=True)
class Table:
    """Columns of equal length: the data behind a figure. A name carries its unit, as in "approach [m]".

    unit: of the columns value, low and high; empty where they have none, or no such columns are there.
    """

    name: str
    columns: Mapping[str, Sequence[object]]
    unit: str = ""

    def __post_init__(self) -> None:
        lengths = {name: len(column) for name, column in self.columns.items()}
        if len(set(lengths.values())) != 1:
            raise ValueError(f"columns of table {self.name!r} must have one length, got {lengths}")

    def __getitem__(self, column: str) -> np.ndarray:
        return np.asarray(self.columns[column])

    def where(self, **equal: object) -> "Table":
        """The rows whose columns have the given values."""
        return self.rows(np.logical_and.reduce([self[name] == value for name, value in equal.items()]))

    def rows(self, kept: ArrayLike) -> "Table":
        """The table with the kept rows alone; kept: a mask over the rows, or their indices."""
        return replace(self, columns={name: self[name][np.asarray(kept)].tolist() for name in self.columns})


def table_of(name: str, rows: Sequence[Mapping[str, object]]) -> Table:
    """A table of at least one row; it has the columns of all, and NaN where a row lacks a cell."""
    columns = dict.fromkeys(column for row in rows for column in row)
    return Table(name, {column: [row.get(column, math.nan) for row in rows] for column in columns})


Columns = Mapping[str, Callable[[Table], object]]


def grouped(name: str, table: Table, by: tuple[str, ...], columns: Columns) -> Table:
    """A row for each value of some columns, with what is found in the rows that have it."""
    keys = list(dict.fromkeys(zip(*(table[key_column].tolist() for key_column in by), strict=True)))
    groups = [table.where(**dict(zip(by, key, strict=True))) for key in keys]
    named = {key_column: [key[i] for key in keys] for i, key_column in enumerate(by)}
    return Table(name, {**named, **{column: [of(group) for group in groups] for column, of in columns.items()}})


class ClaimStatus(StrEnum):
    """What the numbers say of a claim."""

    SUPPORTED = "supported"
    LIMITED = "supported within limits"
    REFUTED = "refuted"
    INCONCLUSIVE = "inconclusive"

    @classmethod
    def _missing_(cls, value: object) -> "ClaimStatus | None":
        """The status whose value in files of schema 1 this is; None where there is none."""
        return next((status for status, earlier in EARLIER_STATUSES.items() if earlier == value), None)

    @property
    def earlier(self) -> str:
        """Its value in files of schema 1, which schema 2 keeps for one release under the same key."""
        return EARLIER_STATUSES[self]

    @property
    def css(self) -> str:
        """A class of the style sheet: "supported", "supported-within-limits"."""
        return self.replace(" ", "-")


EARLIER_STATUSES = {
    ClaimStatus.SUPPORTED: "holds",
    ClaimStatus.LIMITED: "holds within limits",
    ClaimStatus.REFUTED: "contradicted",
    ClaimStatus.INCONCLUSIVE: "open",
}


def claim_status(numbers: Iterable[Number], inside: Iterable[Number], confirmed_by: Verdict) -> ClaimStatus:
    """Whether these numbers support a claim; inside: those within its limits, none where it has no limits."""
    verdicts = {number.verdict for number in numbers}
    if verdicts == {confirmed_by}:
        return ClaimStatus.SUPPORTED
    if {number.verdict for number in inside} == {confirmed_by}:
        return ClaimStatus.LIMITED
    return ClaimStatus.INCONCLUSIVE if verdicts <= {confirmed_by, Verdict.INCONCLUSIVE} else ClaimStatus.REFUTED


class Whose(StrEnum):
    """Who states a claim: its author would recognise it, or it is a hypothesis of this suite."""

    BOOK = "the book"
    LITERATURE = "the literature"
    HYPOTHESIS = "our hypothesis"

    @classmethod
    def _missing_(cls, value: object) -> "Whose | None":
        """The one whose value in files of schema 1 this is; None where there is none."""
        return next((whose for whose, earlier in EARLIER_ORIGINS.items() if earlier == value), None)

    @property
    def earlier(self) -> str:
        """Its value in files of schema 1, which schema 2 keeps for one release under the same key."""
        return EARLIER_ORIGINS[self]


EARLIER_ORIGINS = {
    Whose.BOOK: "statements of the book",
    Whose.LITERATURE: "statements of the field",
    Whose.HYPOTHESIS: "findings of ours",
}


@dataclass(frozen=True, kw_only=True)
class JudgedClaim:
    """A claim, the numbers that test it, and the answer: one sentence with three numbers at most.

    key: by which it is found in its case; confirmed_by: within tolerance, or outside, where the claim says that two
    things are not the same; limits: the conditions under which alone it is said to hold, as text; inside: the numbers
    under these.
    Raises ValueError without numbers, for an identity among them, and for limits without numbers inside.
    """

    claim: str
    answer: str
    numbers: tuple[Number, ...]
    confirmed_by: Verdict = Verdict.WITHIN
    limits: str = ""
    inside: tuple[Number, ...] = ()
    whose: Whose = Whose.HYPOTHESIS
    key: str = ""

    def __post_init__(self) -> None:
        if not self.numbers:
            raise ValueError(f"numbers must test the claim {self.claim!r}, got none")
        if identities := [number.label for number in self.numbers if number.role is Role.IDENTITY]:
            raise ValueError(f"numbers of the claim {self.claim!r} must not be identities, got {identities}")
        if self.confirmed_by is Verdict.INCONCLUSIVE:
            raise ValueError(
                f"confirmed_by of the claim {self.claim!r} must be within or outside tolerance, got inconclusive"
            )
        labels = {number.label for number in self.numbers}
        if bool(self.limits) != bool(self.inside) or any(number.label not in labels for number in self.inside):
            raise ValueError(f"limits of the claim {self.claim!r} must come with numbers of its own inside them")

    @property
    def status(self) -> ClaimStatus:
        """The status by the verdicts of all numbers, or of those inside the limits; one counterexample refutes it."""
        return claim_status(self.numbers, self.inside, self.confirmed_by)

    def count(self, verdict: Verdict) -> int:
        """How many of the numbers that test the claim have this verdict."""
        return sum(number.verdict is verdict for number in self.numbers)


@dataclass(frozen=True, kw_only=True)
class Evidence:
    """What a case shows: its numbers, the tables behind its figures, and what follows from them.

    claims: with the numbers that test them, the claim of the case first; finding: the case in one sentence; method: how
    the numbers were found; captions: what each figure draws, by its name; headlines: what each figure shows, the
    finding as its title, by the same names; page_tables: printed on the page as they stand; sounds: played
    on it.
    Raises ValueError for a headline of a figure that has no caption.
    """

    title: str
    method: str
    numbers: tuple[Number, ...]
    tables: tuple[Table, ...]
    conclusions: tuple[str, ...]
    captions: Mapping[str, str]
    unconverged: tuple[str, ...] = field(default=())
    page_tables: tuple[Table, ...] = ()
    claims: tuple[JudgedClaim, ...] = ()
    finding: str = ""
    headlines: Mapping[str, str] = field(default_factory=dict)
    sounds: Sounds | None = None

    def __post_init__(self) -> None:
        labels = [number.label for number in self.numbers]
        if twice := {label for label in labels if labels.count(label) > 1}:
            raise ValueError(f"numbers of {self.title!r} must have a key of their own, got twice: {sorted(twice)}")
        tests = {number.label for claim in self.claims for number in claim.numbers}
        if strangers := tests - set(labels):
            raise ValueError(f"claims of {self.title!r} must be tested by its numbers, got also {sorted(strangers)}")
        if strangers := set(self.headlines) - set(self.captions):
            raise ValueError(f"headlines of {self.title!r} must be of its figures, got also {sorted(strangers)}")

    def table(self, name: str) -> Table:
        return next(table for table in self.tables if table.name == name)

    def has_table(self, name: str) -> bool:
        return any(table.name == name for table in self.tables)
