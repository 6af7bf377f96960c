"""The rows of the first screen, from the sections of a report."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from validation.analysis.evidence import Evidence
from validation.report.answers.cells import Enough, RangeCell, ends, runs, span
from validation.report.answers.question import AlternativeModel, Question
from validation.report.answers.questions import QUESTIONS
from validation.report.answers.words import first_word, measured, per_cent, sentence, times
from validation.report.section import Section

MAP = "reduced_models-map"
"""The figure below the rows: the map of validity of rolling."""
NOT_RUN, NO_RESULT, NOT_MEASURED = "Not run", "No result", "Not measured"


@dataclass(frozen=True)
class StripCell:
    """A cell of a strip as it is printed: its place, its letter; enough: of `Enough`, or empty where not measured."""

    place: str
    enough: str
    word: str


@dataclass(frozen=True)
class OfferedModel:
    """What could be taken: where it is enough and what it costs; case: that says so, if it was run."""

    text: str
    case: str


@dataclass(frozen=True)
class AnsweredQuestion:
    """A row: the strip, its range and margin, the answer in a word and in a sentence, what else could be taken.

    within: the margin itself; evidence: the case, if it was run.
    """

    question: Question
    word: str
    answer: str = ""
    strip: tuple[StripCell, ...] = ()
    measured: str = ""
    margin: str = ""
    within: str = ""
    instead: tuple[OfferedModel, ...] = ()
    evidence: str = ""


def answered_questions(sections: Sequence[Section]) -> list[AnsweredQuestion]:
    """All rows; none where the report has no case of any of them."""
    found = {section.name: section for section in sections}
    if not any(question.source.case in found for question in QUESTIONS):
        return []
    return [_answered(question, found) for question in QUESTIONS]


def plain(rows: Sequence[AnsweredQuestion]) -> list[dict[str, object]]:
    """The same for results.json."""
    return [
        {
            "question": row.question.asks,
            "case": row.question.source.case,
            "number that decides": row.question.axis,
            "answer": row.word,
            "sentence": row.answer,
            "strip": [{"place": cell.place, "enough": cell.word} for cell in row.strip],
            "measured": row.measured,
            "margin": row.margin,
            "instead": [model.text for model in row.instead],
        }
        for row in rows
    ]


def _answered(question: Question, sections: Mapping[str, Section]) -> AnsweredQuestion:
    section = sections.get(question.source.case)
    if section is None:
        return AnsweredQuestion(question, NOT_RUN, f"The case {question.source.case} is not in this report.")
    if section.evidence is None:
        return AnsweredQuestion(
            question, NO_RESULT, f"The case {section.name} did not converge.", evidence=section.name
        )
    cells = question.source.cells(section.evidence)
    if not cells:
        return AnsweredQuestion(question, NOT_MEASURED, f"{section.name} has no number for it.", evidence=section.name)
    told = (*question.source.series, *question.told)
    evidence = {name: one.evidence for name, one in sections.items() if one.evidence}
    return AnsweredQuestion(
        question,
        first_word(cells),
        sentence(cells, question.axis, question.printed),
        _strip(cells),
        ", ".join(filter(None, (measured(cells, question.axis, told), question.of_scene(section)))),
        " ".join(dict.fromkeys(number.reason for cell in cells for number in cell.numbers)),
        _margins(question, cells),
        tuple(_instead(cells, question, evidence)),
        section.name,
    )


def _strip(cells: Sequence[RangeCell]) -> tuple[StripCell, ...]:
    """With what was not measured at both ends of an axis that has any."""
    places = [cell.place for cell in cells]
    inside = [StripCell(_printed(cell), cell.enough.value, cell.enough.value) for cell in cells]
    if any(isinstance(place, str) for place in places):
        return tuple(inside)
    low, high = ends(places[0])[0], ends(places[-1])[1]
    below, above = (StripCell(text, "", "not measured") for text in (f"< {low:.2g}", f"> {high:.2g}"))
    return (below, *inside, above)


def _printed(cell: RangeCell) -> str:
    if isinstance(cell.place, str):
        return cell.place
    low, high = ends(cell.place)
    return f"{low:.2g}" if low == high else f"{low:.3g} to {high:.3g}"


def _instead(cells: Sequence[RangeCell], question: Question, evidence: Mapping[str, Evidence]) -> list[OfferedModel]:
    """Each model with where it is enough and what it costs, as long as MDR is not enough everywhere."""
    if all(cell.enough is Enough.YES for cell in cells):
        return []
    found = [
        (_offered(model, question, evidence), model.source.case if model.source else model.cost.case)
        for model in question.alternatives
    ]
    return [OfferedModel(text, case if case in evidence else "") for text, case in found if text]


def _offered(model: AlternativeModel, question: Question, evidence: Mapping[str, Evidence]) -> str:
    """Empty where it was not run or is enough nowhere."""
    cost = f" ({model.cost.text(evidence[model.cost.case])})" if model.cost.case in evidence else ""
    if model.source is None:
        return f"{model.name}{cost}"
    if model.source.case not in evidence:
        return ""
    mine = model.source.cells(evidence[model.source.case])
    where = " and ".join(span(piece, model.axis or question.axis) for piece in runs(mine, Enough.YES))
    margin = _other_margin(model, question, mine, question.source.cells(evidence[question.source.case]))
    return f"{model.name} {where}{margin}{cost}" if where else ""


def _other_margin(
    model: AlternativeModel, question: Question, mine: Sequence[RangeCell], judged: Sequence[RangeCell]
) -> str:
    """Where it is not judged as the question is."""
    found, other = ({number.tolerance for cell in cells for number in cell.numbers} for cells in (mine, judged))
    if found == other and not model.by:
        return ""
    return f", within {_margins(question, mine)} {model.by}".rstrip()


def _margins(question: Question, cells: Sequence[RangeCell]) -> str:
    """Tolerances of the numbers; of what is printed as a factor, in per cent."""
    printed = per_cent if question.printed is times else question.printed
    tolerances = sorted({number.tolerance for cell in cells for number in cell.numbers})
    return " and ".join(printed(tolerance).removeprefix("+") for tolerance in tolerances)
