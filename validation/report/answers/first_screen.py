"""The rows of the first screen, from the sections of a report: words change with the verdicts of the numbers."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from validation.analysis.evidence import OF_NUMBERS, Evidence, Number, Place, Verdict, placed
from validation.analysis.number_text import enumeration, half_open_text, level_as_factor, level_in_per_cent
from validation.analysis.ranges import VerdictRange, ends_of, verdict_ranges
from validation.report.answers.question import TIMES, Alternative, Printed, Question
from validation.report.answers.questions import QUESTIONS
from validation.report.answers.strip import EARLIER_WORDS, Cell, Source, span
from validation.report.section import Section

REGIONS = "the spectrum"
"""An axis whose places are parts of it, not surfaces."""
NOT_RUN, NO_RESULT, NOT_MEASURED = "Not run", "No result", "Not measured"
WITHIN_TOLERANCE: Mapping[Verdict | None, bool] = {Verdict.WITHIN: True, Verdict.OUTSIDE: False}
"""In results.json, null where that is inconclusive or was not measured."""
ENSEMBLE_MEAN = "ensemble mean"
"""What all answers are of: a single surface may be off by more."""


@dataclass(frozen=True)
class StripCell:
    """A place, its verdict, None where it was not measured, and the conditions that alone have it, empty where all
    have; ends: of a range; by: all verdicts with their conditions.
    """

    place: str
    verdict: Verdict | None
    alone: str = ""
    ends: tuple[float, float] | None = None
    by: str = ""

    @property
    def css(self) -> str:
        """A class of the style sheet: of its verdict, or "unmeasured"."""
        return self.verdict.css if self.verdict else "unmeasured"

    @property
    def word(self) -> str:
        """As the cell has it: "within", "outside", "inconclusive", "not measured"."""
        return self.verdict.css if self.verdict else NOT_MEASURED.lower()


@dataclass(frozen=True)
class AnsweredQuestion:
    """A row: the answer in a word and in a sentence; the case, if it was run; the strip; its range and margin.

    within: the margin itself; instead: where each model is enough, what it costs, and the case that says so, if it was
    run.
    """

    question: Question
    word: str
    answer: str
    evidence: str = ""
    strip: tuple[StripCell, ...] = ()
    measured: str = ""
    margin: str = ""
    within: str = ""
    instead: tuple[tuple[str, str, str], ...] = ()


def answered_questions(sections: Sequence[Section]) -> list[AnsweredQuestion]:
    """All rows; none where the report has no case of any of them."""
    by_name = {section.name: section for section in sections}
    is_covered = any(question.source.case in by_name for question in QUESTIONS)
    return [_answered_question(question, by_name) for question in QUESTIONS] if is_covered else []


def plain(rows: Sequence[AnsweredQuestion]) -> list[dict[str, object]]:
    """The same for results.json: keys of schema 2, and for one release those of schema 1 that were renamed."""
    return [
        {
            "question": row.question.asks,
            "case": row.question.source.case,
            "deciding_number": row.question.source.over,
            "number that decides": row.question.source.over,
            "answer": row.word,
            "sentence": row.answer,
            "of": ENSEMBLE_MEAN,
            "strip": [
                {
                    "place": cell.place,
                    "within_tolerance": WITHIN_TOLERANCE.get(cell.verdict),
                    "enough": EARLIER_WORDS[cell.verdict] if cell.verdict else NOT_MEASURED.lower(),
                    "verdict": cell.verdict,
                    "alone": cell.alone,
                    "by_condition": cell.by,
                    "by condition": cell.by,
                    "ends": cell.ends,
                }
                for cell in row.strip
            ],
            "measured": row.measured,
            "margin": row.margin,
            "instead": [{"model": text, "cost": cost} for text, cost, _ in row.instead],
        }
        for row in rows
    ]


def _answered_question(question: Question, sections: Mapping[str, Section]) -> AnsweredQuestion:
    source, section = question.source, sections.get(question.source.case)
    if section is None:
        return AnsweredQuestion(question, NOT_RUN, f"The case {source.case} is not in this report.")
    if section.evidence is None:
        return AnsweredQuestion(question, NO_RESULT, f"The case {section.name} did not converge.", section.name)
    cells = source.cells(section.evidence)
    if not cells:
        return AnsweredQuestion(question, NOT_MEASURED, f"{section.name} has no number for it.", section.name)
    numbers, verdicts = _numbers_of_cells(cells), {cell.verdict for cell in cells}
    within = _margins(question, numbers)
    evidence = {name: case_section.evidence for name, case_section in sections.items() if case_section.evidence}
    alternatives = [
        (text, _cost(model, evidence), model.source.case if model.source else TIMES * bool(model.timed))
        for model in question.instead
        if (text := _alternative_text(model, question, within, evidence))
    ]
    return AnsweredQuestion(
        question,
        _word(verdicts),
        sentence(cells, source.over, question.printed),
        section.name,
        tuple(_strip(cells)),
        ", ".join([*_measured(cells, source), *_of_scene(question, section)]),
        " ".join(dict.fromkeys(number.reason for number in numbers)),
        within,
        tuple(
            (text, cost, case * (case in evidence)) for text, cost, case in alternatives if verdicts != {Verdict.WITHIN}
        ),
    )


def _numbers_of_cells(cells: Iterable[Cell]) -> list[Number]:
    return [number for cell in cells for number in cell.numbers]


def _strip(cells: Sequence[Cell]) -> list[StripCell]:
    """With what was not measured at both ends of an axis that has any."""
    inside, places = [_strip_cell(cell) for cell in cells], [cell.place for cell in cells]
    if any(isinstance(place, str) for place in places):
        return inside
    below, above = f"< {ends_of(places[0])[0]:.2g}", f"> {ends_of(places[-1])[1]:.2g}"
    return [StripCell(below, None), *inside, StripCell(above, None)]


def _strip_cell(cell: Cell) -> StripCell:
    """The cell as the strip prints it, with the text of its place."""
    both = cell.place if isinstance(cell.place, tuple) else None
    return StripCell(span([cell.place]), cell.verdict, cell.alone, both, cell.by_condition)


def _measured(cells: Sequence[Cell], source: Source) -> list[str]:
    """The whole range, and the conditions of its numbers: outside nothing is known."""
    ranges: dict[str, list[Place]] = {source.over: [cell.place for cell in cells if not isinstance(cell.place, str)]}
    for name in source.series:
        ranges[name] = [number.where[name] for number in _numbers_of_cells(cells) if name in number.where]
    return [span(places, name) for name, places in ranges.items() if places]


def _of_scene(question: Question, section: Section) -> list[str]:
    """What its case says of it; a case that is kept from before it said so has no such column."""
    conditions = [f"H = {section.settings['hurst']:g}"] if "hurst" in section.settings else []
    if question.of_scene and section.evidence:
        table, column = question.of_scene
        values = section.evidence.table(table).columns.get(column, ())
        conditions += [f"{column} = {value if isinstance(value, str) else f'{value:.2g}'}" for value in values[:1]]
    return conditions


def _alternative_text(model: Alternative, question: Question, within: str, evidence: Mapping[str, Evidence]) -> str:
    """A model where it is enough, within its margin where that is another one; empty where it is so nowhere or was not
    run.
    """
    if model.source is None:
        return model.name
    cells = model.source.cells(evidence[model.source.case]) if model.source.case in evidence else []
    margin = _margins(question, _numbers_of_cells(cells))
    by = f", within {margin} {model.by}".rstrip() if model.by or margin != within else ""
    where = _verdict_range(cells, Verdict.WITHIN, model.source.over)
    return f"{model.name} {where}{by}" if where else ""


def _cost(model: Alternative, evidence: Mapping[str, Evidence]) -> str:
    seconds = model.timed(evidence[TIMES]) if model.timed and TIMES in evidence else ""
    return ", ".join(filter(None, (model.cost, seconds)))


def _margins(question: Question, numbers: Sequence[Number]) -> str:
    """Tolerances of the numbers; of what is printed as a factor, in per cent."""
    printed = level_in_per_cent if question.printed is level_as_factor else question.printed
    tolerances = sorted({number.tolerance for number in numbers})
    return " and ".join(printed(tolerance).removeprefix("+") for tolerance in tolerances)


def _word(verdicts: set[Verdict]) -> str:
    """The whole strip."""
    if len(verdicts) == 1:
        return next(iter(verdicts)).capitalize()
    return "In part" if Verdict.WITHIN in verdicts else "Outside tolerance or inconclusive"


def _verdict_range(cells: Sequence[Cell], verdict: Verdict, over: str) -> str:
    """Neighbouring cells that say it: "at h' a/d = 0.3", "for 0.1 ≤ Fbar < 1 (H = 1 alone)", "over ridges"."""
    places, conditions = [cell.place for cell in cells], [cell.alone for cell in cells]
    ranges = verdict_ranges(places, [cell.verdict for cell in cells], conditions)
    ranges = [part for part in ranges if part.verdict is verdict]
    if len(ranges) > 1 and all(len(part.places) == 1 and isinstance(part.places[0], float) for part in ranges):
        texts = [f"{span(part.places)}{_alone(part)}" for part in ranges]
        return f"at {placed(over, enumeration(texts))}"
    return " and ".join(f"{_span_of_group(part.places, cells, over)}{_alone(part)}" for part in ranges)


def _span_of_group(places: Sequence[Place], cells: Sequence[Cell], over: str) -> str:
    """Neighbours, and how they lie on the axis."""
    text = span(places, over)
    if isinstance(places[0], tuple) and "[" not in over:
        (low, _), (_, high) = ends_of(places[0]), ends_of(places[-1])
        follows = any(not isinstance(cell.place, str) and ends_of(cell.place)[0] == high for cell in cells)
        return f"for {half_open_text(over, low, high, closed=not follows)}"
    if isinstance(places[0], str) and over != REGIONS and len(places) > 2:
        return f"from {places[0]} to {places[-1]}"
    if isinstance(places[0], str):
        return f"{'in' if over == REGIONS else 'over'} {text}"
    return f"{'from' if ' to ' in text else 'at'} {text}"


def _alone(part: VerdictRange) -> str:
    return f" ({part.split})" if part.split else ""


def sentence(cells: Sequence[Cell], over: str, printed: Printed) -> str:
    """Where it is within tolerance, outside, inconclusive; each with the numbers that say so."""
    clauses = []
    for verdict in OF_NUMBERS:
        if where := _verdict_range(cells, verdict, over):
            numbers = _numbers_of_cells(cell for cell in cells if cell.verdict is verdict)
            clauses.append(f"{verdict} {where}: {_deviations(verdict, numbers, printed)}")
    text = "; ".join(clauses)
    return f"{text[0].upper()}{text[1:]}."


def _deviations(verdict: Verdict, numbers: Sequence[Number], printed: Printed) -> str:
    judged = [number for number in numbers if number.verdict is verdict]
    if verdict is Verdict.OUTSIDE:
        return f"{'' if printed is level_as_factor else 'off by '}{_by_quantity(judged, printed)}"
    if not judged:
        return "some numbers are missing"
    ends = (number.difference + sign * number.uncertainty for number in judged for sign in (-1, 1))
    off = from_to(ends, printed)
    return f"{'' if printed is level_as_factor else 'off by '}{off}, error bars included"


def _by_quantity(numbers: Sequence[Number], printed: Printed) -> str:
    """The least and the largest, below and above the reference; apart where there are several quantities."""
    quantities = list(dict.fromkeys(number.quantity for number in numbers))
    parts = []
    for quantity in quantities:
        values = [number.difference for number in numbers if number.quantity == quantity]
        sides = [value for value in values if value < 0], [value for value in values if value >= 0]
        name = f"{quantity} " if len(quantities) > 1 else ""
        parts.append(name + " and ".join(from_to(side, printed) for side in sides if side))
    return ", ".join(parts)


def from_to(values: Iterable[float], printed: Printed) -> str:
    """The least and the largest, the unit once: "-13 to -11 %"."""
    both = sorted(values)
    first, last = printed(both[0]), printed(both[-1])
    return last if first == last else f"{first.split(' ')[0]} to {last}"
