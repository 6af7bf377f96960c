"""A case of the report: the claim under test, its two sizes, and how its evidence comes about."""

import string
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any, Literal

from validation.analysis.chart import Chart
from validation.analysis.claim_text import in_sentence
from validation.analysis.claims import Claim, Matrix
from validation.analysis.escapes import one_line
from validation.analysis.evidence import Evidence, Number, Table
from validation.analysis.number_text import with_prefix
from validation.analysis.series import Series, numbers_of, tables_of
from validation.analysis.spectra import Sounds

Profile = Literal["quick", "full"]


class Chapter(StrEnum):
    """A chapter of the report; the order is that of its argument."""

    EXACT = "What is known exactly"
    PRESSED = "Rough punches: the stiffness and its fluctuation"
    ROLLING = "Rolling: the force along the track"
    RAIL = "The wheel on a real rail"
    WHEEL = "The dynamic wheel"
    LIMITS = "Where each method fails"
    SPEED = "Speed against accuracy"
    SELECTION = "The cheapest sufficient model"


@dataclass(frozen=True, kw_only=True)
class Case:
    """One claim of the report: its settings in two sizes, its solves and its study.

    A module in a folder ``cases`` that holds one as ``CASE`` is found by it.

    Attributes
    ----------
    name : str
        On the command line, of its figures and of its data.
    chapter : Chapter
        Where it stands.
    place : int
        Position in the chapter: cases stand in ascending order.
    answers : str
        Which figure or question of the book it answers.
    quick, full : object
        Settings in both sizes, frozen dataclasses of one type.
    run : callable
        From settings and an `Engine` to a result.
    needs : str or callable
        The cheapest sufficient model: a text, or a function of the settings.
    study : Study
        What the result shows.
    timed : bool
        Whether it measures times, and so runs last and alone.

    Examples
    --------
    >>> from validation.case import SERIAL
    >>> case = validation.CASES["geike"]
    >>> case.chapter.value, case.model_needed(case.quick)
    ('What is known exactly', 'closed form: spectra alone')
    >>> result = case.run(case.settings("quick", seed=7), SERIAL)
    >>> print(case.evidence(result).claims[0].status)
    supported
    """

    name: str
    chapter: Chapter
    place: int
    answers: str
    quick: Any
    full: Any
    run: Callable[[Any, Any], Any]
    needs: Callable[[Any], str] | str
    study: "Study"
    timed: bool = False

    def __repr__(self) -> str:
        return one_line(f"Case({self.name!r}, {self.answers})")

    def evidence(self, result: Any) -> "Evidence":
        """The tables, numbers, claims and charts that the study derives from a result of `run`."""
        return self.study.evidence(result)

    @property
    def claim(self) -> str:
        """The first of the study, empty where it has none."""
        return self.study.claims[0].says if self.study.claims else ""

    def settings(self, profile: Profile, seed: int | None, scene: Any = None, own: str = "") -> Any:
        """The settings of a profile; seed, scene and the file `own` replace those fields that the settings have."""
        settings = self.quick if profile == "quick" else self.full
        if seed is not None and hasattr(settings, "seed"):
            settings = replace(settings, seed=seed)
        if own and hasattr(settings, "own"):
            settings = replace(settings, own=own)
        return replace(settings, scene=scene) if scene is not None and hasattr(settings, "scene") else settings

    def model_needed(self, settings: Any) -> str:
        """The cheapest model that these settings need."""
        return self.needs if isinstance(self.needs, str) else self.needs(settings)


class Settings(string.Formatter):
    """Settings in a text: `{c.hurst:g}`; of several values, `{c.heights:g}` prints all; `{c.height:SI}m` has "2 µm"."""

    def format_field(self, value: Any, format_spec: str) -> str:
        if isinstance(value, tuple | list):
            parts = [self.format_field(part, format_spec) for part in value]
            return f"{', '.join(parts[:-1])} and {parts[-1]}" if len(parts) > 1 else "".join(parts)
        if format_spec == "SI":
            return with_prefix(value)
        return str(super().format_field(value, format_spec))


def _title(clauses: Iterable[str]) -> str:
    """Join the clauses to one title, "First; second; third"."""
    return "; ".join(in_sentence(clause) if i else clause for i, clause in enumerate(clauses))


def nothing(*_: Any) -> tuple[()]:
    return ()


@dataclass(frozen=True, kw_only=True)
class Study:
    """What a case declares in addition to its settings and solves.

    Texts may have settings in braces, as ``{c.hurst:g}``; ``:SI`` prints a prefix.

    Attributes
    ----------
    title, method : str
        Heading of the case, and how its numbers were found.
    series : callable
        From a result to the series that it shows. A result has ``case``, its settings, and ``unconverged``, names of
        failed solves, as `Outcomes` does.
    claims : sequence of Claim
        The first is that of the case; none where a case is only played. A claim without numbers is named as untested.
    charts : sequence of Chart
        Figures, drawn from the tables alone.
    matrices : sequence of Matrix
        Tables of verdicts on the page.
    printed : sequence of str
        Names of tables that are on the page as they stand.
    tables : callable
        From a result to tables that no series makes.
    once_more : callable
        From a result and its numbers to numbers that are judged by another margin in addition.
    notes : callable
        From a result to sentences that no pattern has.
    sounds : callable
        From a result to what the page plays, or None.

    Raises
    ------
    ValueError
        If two claims have one key.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> from validation.analysis.series import single
    >>> from validation.case import Claim, Outcomes, Study
    >>> claim = Claim(quantity="k").saying("{c.body} has 2 E* a.", short="The stiffness agrees with 2 E* a", key="k")
    >>> study = Study(
    ...     title="Hertz",
    ...     method="One load.",
    ...     series=lambda result: [single("k", "BEM", result["k"], 0.01, "2 E* a", "1 % of it", 1.0)],
    ...     claims=[claim],
    ... )
    >>> evidence = study.evidence(Outcomes(SimpleNamespace(body="A sphere"), {"k": 1.002}))
    >>> evidence.claims[0].claim, evidence.finding
    ('A sphere has 2 E* a.', 'The stiffness agrees with 2 E* a within 0.01.')
    """

    title: str
    method: str
    series: Callable[[Any], Sequence[Series]]
    claims: Sequence[Claim] = ()
    charts: Sequence[Chart] = ()
    matrices: Sequence[Matrix] = ()
    printed: Sequence[str] = ()
    tables: Callable[[Any], Sequence[Table]] = nothing
    once_more: Callable[[Any, Sequence[Number]], Sequence[Number]] = nothing
    notes: Callable[[Any], Sequence[str]] = nothing
    sounds: Callable[[Any], Sounds | None] = lambda result: None

    def __post_init__(self) -> None:
        keys = [claim.key for claim in self.claims if claim.key]
        if twice := {key for key in keys if keys.count(key) > 1}:
            raise ValueError(f"claims must have keys of their own, got twice: {', '.join(sorted(twice))}")

    def evidence(self, result: Any) -> Evidence:
        series = self.series(result)
        numbers, tables, case = numbers_of(series), (*tables_of(series), *self.tables(result)), result.case
        numbers = (*self.once_more(result, numbers), *numbers)
        filled = [replace(claim, says=self._filled(claim.says, case)) for claim in self.claims]
        pairs = [(claim, claim.judged(numbers)) for claim in filled if claim.numbers(numbers)]
        untested = [f"No number tests the claim: {claim.says}" for claim in filled if not claim.numbers(numbers)]
        headlines = {claim.says: claim.headline(judged) for claim, judged in pairs if claim.short}
        return Evidence(
            title=self.title,
            method=self._filled(self.method, case),
            numbers=numbers,
            tables=tables,
            page_tables=(
                *(matrix.table(numbers) for matrix in self.matrices),
                *(table for table in tables if table.name in self.printed),
            ),
            claims=tuple(judged for _, judged in pairs),
            conclusions=(*self.notes(result), *untested),
            captions={chart.name: self._filled(chart.caption, case) for chart in self.charts},
            headlines={
                chart.name: _title(headlines[filled[i].says] for i in chart.claims if filled[i].says in headlines)
                for chart in self.charts
            },
            finding=f"{_title(list(headlines.values())[:2])}." if headlines else "",
            unconverged=result.unconverged,
            sounds=self.sounds(result),
        )

    @staticmethod
    def _filled(text: str, case: Any) -> str:
        return Settings().format(text, c=case)


@dataclass(frozen=True)
class Outcomes:
    """Outcomes by the keys that the case has given them."""

    case: Any
    by_key: Mapping[Any, Any]
    unconverged: tuple[str, ...] = ()

    def __getitem__(self, key: Any) -> Any:
        return self.by_key[key]
