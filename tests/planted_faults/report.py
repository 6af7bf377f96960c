"""Faults planted in what `tests/report` looks at: where, what is wrong there, and the test that must catch it."""

import math
from functools import partial

import numpy as np
from markupsafe import Markup

from tests.analysis import test_units_of_tables
from tests.cases import test_flags_on_the_page
from tests.planted_faults.wrong import Fault
from tests.report import (
    test_answers,
    test_claims,
    test_colours,
    test_columns,
    test_kept,
    test_page,
    test_printed,
    test_sounds,
    test_symbols,
    test_texts_of_users,
)
from validation.analysis import statistics
from validation.analysis.claims import Claim
from validation.analysis.evidence import Verdict
from validation.analysis.series import Series
from validation.report import build, chapter, columns, formats, provenance, sounds, style
from validation.report import columns as symbols
from validation.report import provenance as code_behind
from validation.report.answers import questions as question
from validation.report.answers import strip
from validation.report.page import PageFigure


def by_its_own_peak(samples, full_scale):
    """A sound that is as loud as a file can hold, whatever the others are."""
    values = np.asarray(samples)
    return np.rint(sounds.LARGEST / np.abs(values).max() * values).astype(np.int16)


def enough_by_most(cell):
    """A counterexample outvoted."""
    return (
        Verdict.AGREE
        if 2 * sum(number.verdict is Verdict.AGREE for number in cell.numbers) > len(cell.numbers)
        else Verdict.DIFFER
    )


def enough_unless_it_differs(cell):
    """What is undecided taken for what agrees."""
    right = verdict_of_a_cell(cell)
    return Verdict.AGREE if right is Verdict.UNDECIDED and not cell.lacking else right


STYLES = style.styles_of
verdict_of_a_cell = strip.Cell.verdict.fget

WITH_KEPT, SHEET = provenance.with_kept, test_colours.sheet()


def as_of_today(about, before, kept):
    """A case that is kept passes for one of this run."""
    return WITH_KEPT(about, {**before, "kept": {}, "commit": about["commit"]}, kept)


def exchanged(one, other):
    """The style sheet with two classes in each other's place."""
    return lambda: SHEET.replace(f".{one}", ".between").replace(f".{other}", f".{one}").replace(".between", f".{other}")


CITATION = PageFigure.citation


FAULTS = [
    partial(test_texts_of_users.test_a_model_of_a_user_has_a_marker_however_its_name_begins, "Persson"),
    Fault("a model of a user's in the style of one of the package").at(
        style, "styles_of", lambda n, users=(): STYLES(n)
    ),
    test_texts_of_users.test_a_text_on_a_page_has_no_character_that_acts,
    Fault("texts of users on a page as they are").at(formats, "printable", lambda text, lines: text),
    partial(test_symbols.test_a_symbol_is_a_word_of_its_own, "a wheel on E*", ["E*"]),
    Fault("a symbol found inside of words").at(symbols.Symbol, "stands_in", lambda symbol, text: symbol.name in text),
    test_columns.test_values_have_the_unit_of_their_table,
    Fault("data without units").at(columns, "header_of", lambda table: list(table.columns)),
    partial(
        test_units_of_tables.test_a_table_has_the_unit_of_what_it_shows,
        "ratio",
        {"unit": "dB", "shown": math.exp},
        "",
    ),
    Fault("a ratio in decibels").at(Series, "shown_unit", property(lambda one: one.unit)),
    test_kept.test_a_case_that_is_kept_twice_has_the_commit_that_made_it,
    Fault("a case that is kept has today's commit").at(provenance, "with_kept", as_of_today),
    partial(test_kept.test_a_case_of_other_code_is_not_kept, {}, "geike and hertz"),
    Fault("a case that is kept, whatever code has made it").at(code_behind, "require_todays_code", lambda *of: None),
    test_kept.test_the_code_behind_a_case_is_what_makes_its_numbers,
    Fault("the code behind a case without its settings").at(code_behind, "as_json", lambda value: b""),
    test_page.test_a_figure_is_numbered_on_the_page_and_cited_by_name_version_and_commit,
    Fault("a figure of a case that is kept is cited with today's commit").at(
        PageFigure, "citation", lambda figure, about, profile: CITATION(figure, {**about, "kept": {}}, profile)
    ),
    partial(
        test_flags_on_the_page.test_a_lost_solve_is_told_whatever_its_case_makes_of_it, test_flags_on_the_page.as_it_is
    ),
    Fault("a lost solve that nobody tells").at(build, "_lost", lambda progress: ()),
    partial(test_colours.test_yes_is_green_no_is_red_and_undecided_is_neither, ".cell.yes", ".cell.no", ".cell.open"),
    Fault("yes in the colours of no").at(test_colours, "sheet", exchanged("yes", "no")),
    partial(
        test_colours.test_yes_is_green_no_is_red_and_undecided_is_neither,
        ".verdict.agree",
        ".verdict.differ",
        ".verdict.undecided",
    ),
    Fault("what differs in the colours of what agrees").at(test_colours, "sheet", exchanged("agree", "differ")),
    partial(
        test_answers.test_a_cell_says_yes_only_where_all_agree_and_nothing_lacks,
        [test_answers.AGREES, test_answers.UNDECIDED],
        Verdict.UNDECIDED,
    ),
    Fault("a place with one number that is undecided under a yes").at(
        strip.Cell, "verdict", property(enough_unless_it_differs)
    ),
    partial(test_texts_of_users.test_a_plain_text_is_drawn_as_it_is_written, "$x^2$"),
    Fault("texts of users as mathematics").at(style, "plain", lambda text: text),
    test_answers.test_one_counterexample_among_all_exponents_is_a_no,
    Fault("a cell that says what most of its numbers say").at(strip.Cell, "verdict", property(enough_by_most)),
    test_answers.test_ranges_that_overlap_are_one_cell,
    Fault("cells that overlap").at(strip, "_apart", lambda found: dict(sorted(found.items()))),
    test_answers.test_decibels_are_printed_as_their_quantity,
    Fault("the power of a ratio printed for its amplitude").at(question, "DECIBEL", statistics.POWER_DECIBEL),
    test_sounds.test_files_differ_by_the_level_of_the_forces,
    Fault("a sound normalised by itself").at(sounds, "quantised", by_its_own_peak),
    partial(test_claims.test_a_status_has_its_word_and_sign, [Verdict.AGREE, Verdict.DIFFER], {}, "✗ contradicted"),
    Fault("a contradicted claim under a green badge").at(
        formats, "format_status", lambda status, **_: Markup('<span class="verdict holds">✓ holds</span>')
    ),
    partial(test_claims.test_a_key_that_no_number_has_leaves_no_status, {"quantity": "y0", "model": "m"}),
    Fault("a statement of the book answered by numbers of another model").at(
        chapter, "Claim", lambda model, **more: Claim(**more)
    ),
    partial(test_claims.test_a_key_that_no_number_has_leaves_no_status, {"quantity": "y0", "where": {"h/d": 0.01}}),
    Fault("a statement of the book answered outside of its assumptions").at(
        chapter, "Claim", lambda where, **more: Claim(**more)
    ),
    test_printed.test_every_verdict_has_its_word_and_sign,
    Fault("two signs of verdicts exchanged").at(formats, "SYMBOL", {"agree": "≠", "differ": "✓", "undecided": "?"}),
]
