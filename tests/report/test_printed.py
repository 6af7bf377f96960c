"""What is printed belongs to its data: cells of pages and files, words and signs of verdicts, numbers in sentences."""

import csv
import io
import math
from dataclasses import replace
from html.parser import HTMLParser
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from validation.analysis.contents import as_csv
from validation.analysis.evidence import (
    Evidence,
    Number,
    Role,
    Table,
    Verdict,
    VerdictCell,
    columns,
    if_confirmed,
    plus_minus,
    table_of,
    with_reference,
)
from validation.cases.limits import evidence as limits_evidence
from validation.cases.limits import numbers as limits_numbers
from validation.cases.punch import fractal_punch_decades, fractal_punch_text
from validation.cases.rolling import claims as rolling_claims
from validation.cases.rolling import force_spectrum_evidence as rolling_evidence
from validation.cases.rolling import force_spectrum_tables as rolling_tables
from validation.cases.rolling.force_spectrum_numbers import LEVEL, MEAN, VARIANCE
from validation.cases.wheel import distance_evidence as wheel_distance_evidence
from validation.cases.wheel import (
    distance_numbers,
    distance_tables,
    spectrum_tables,
)
from validation.cases.wheel import half_space_evidence as wheel_3d_evidence
from validation.cases.wheel import spectrum_evidence as wheel_evidence
from validation.cases.wheel.spectrum_numbers import FEATURES, OMEGA
from validation.report import formats, page
from validation.report.contents import CASES
from validation.report.documentation import BUILT, documentation_beside
from validation.report.figures import fractal_punch
from validation.report.section import Section, case_results, numbers_table

# --- the page, files ---

reals = st.floats(-1e6, 1e6).filter(lambda x: x == 0 or abs(x) > 1e-6)
widths = st.floats(1e-6, 1e4)


def number(value=1.0, **changes):
    settings = {"reference": 1.0, "source": "s", "tolerance": 0.1, "reason": "r", "unit": "dB", **changes}
    return Number(**{"quantity": "x", "value": value, **settings})


class Rows(HTMLParser):
    """Cells of all tables of a page, row by row; pieces of a cell apart."""

    def __init__(self, page):
        super().__init__()
        self.rows, self._in = [], False
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append([])
            self._in = True

    def handle_endtag(self, tag):
        if tag in ("td", "th"):
            self._in = False

    def handle_data(self, data):
        if self._in and data.strip():
            self.rows[-1][-1].append(data.strip())


def evidence_with(numbers, page_tables=(), claims=()):
    return Evidence(
        title="t",
        method="c",
        numbers=tuple(numbers),
        tables=(Table("t", {"x": [1.0]}),),
        conclusions=(),
        captions={},
        page_tables=tuple(page_tables),
        claims=tuple(claims),
    )


def html_of(section, documentation=""):
    """The front page, and that of the chapter of one case."""
    about = {name: {} for name in ("libraries", "seeds", "kept")} | {"seconds": {section.name: 1.0}, "timed": ()}
    about |= dict.fromkeys(("version", "commit", "python", "system", "processor", "cores", "workers"), "")
    about |= {"documentation": documentation}
    pages = page.pages([section], "full", about, None)
    return pages.pop("index.html").decode() + "".join(chapter.decode() for chapter in pages.values())


def page_of(numbers, page_tables=()):
    """Its rows."""
    return Rows(html_of(Section("geike", CASES["geike"], "none", {}, evidence_with(numbers, page_tables)))).rows


def test_the_page_links_to_the_documentation_that_is_built(tmp_path):
    section = Section("geike", CASES["geike"], "none", {}, evidence_with([number(1.0)]))
    assert documentation_beside(tmp_path / "quick") == ""
    assert "make docs" not in html_of(section)
    built = tmp_path / BUILT
    built.parent.mkdir(parents=True)
    built.touch()
    address = documentation_beside(tmp_path / "quick")
    (tmp_path / "quick").mkdir()
    assert (tmp_path / "quick" / address).samefile(built)
    assert f'<a href="{address}">Documentation</a>' in html_of(section, address)


NUMBERS = [
    number(1.234567, reference=1.2, tolerance=0.5, grid=0.0123, sample=0.0456, quantity="agrees"),
    number(-3.5, reference=2.5, tolerance=0.25, grid=0.031, quantity="differs", unit="rad/s"),
    number(7.25, reference=7.0, tolerance=0.5, sample=0.9, quantity="open", unit="-", role=Role.FINDING),
]


def test_rows_of_the_file_are_the_numbers():
    table = numbers_table(NUMBERS)
    assert [table[name].tolist() for name in ("quantity", "verdict", "unit", "role")] == [
        ["agrees", "differs", "open"],
        ["agree", "differ", "undecided"],
        ["dB", "rad/s", "-"],
        ["criterion", "criterion", "finding"],
    ]
    for name in ("value", "reference", "difference", "grid", "sample", "tolerance"):
        assert table[name].tolist() == [getattr(number, name) for number in NUMBERS]


def test_every_verdict_has_its_word_and_sign():
    assert formats.SYMBOL == {"agree": "✓", "differ": "≠", "undecided": "?"} and set(formats.SYMBOL) == set(Verdict)
    assert fractal_punch.SIGN == {"agree": "=", "differ": "≠", "undecided": "?"}
    for verdict, symbol in formats.SYMBOL.items():
        assert formats.format_cell(VerdictCell("+3 %", Verdict(verdict), "more")) == (
            f'+3 %<br><span class="verdict {verdict}">{symbol} {verdict}</span>; more'
        )
    assert formats.format_cell("<a> & b") == "&lt;a&gt; &amp; b" and formats.format_cell(0.123456) == "0.1235"


def test_criteria_of_the_page_are_those_of_the_numbers():
    findings = [number(v, quantity=f"y{v}", tolerance=0.5, role=Role.FINDING) for v in (1.0, 1.1, 9.0)]
    text = " ".join(" ".join(cell) for row in page_of([*NUMBERS, *findings]) for cell in row)
    assert "criteria met 1 of 2" in text


def test_tables_of_the_page_keep_their_columns():
    table = Table(
        "shown", {"force [N]": ["1.5", "2.5"], "verdict": [VerdictCell("+1 %", Verdict.AGREE), "no"], "k": [0.25, 3]}
    )
    rows = page_of((), [table])
    at = next(i for i, row in enumerate(rows) if row and row[0] == ["force [N]"])
    assert rows[at : at + 3] == [
        [["force [N]"], ["verdict"], ["k"]],
        [["1.5"], ["+1 %", "✓ agree"], ["0.25"]],
        [["2.5"], ["no"], ["3"]],
    ]


def test_a_table_is_found_by_its_name():
    tables = tuple(Table(name, {"x": [i]}) for i, name in enumerate(("first", "second", "third")))
    shown = Evidence(title="t", method="c", numbers=(), tables=tables, conclusions=(), captions={})
    assert [shown.table(name)["x"][0] for name in ("third", "first", "second")] == [2, 0, 1]


def test_columns_are_plain_values():
    found = columns(**{"x [m]": np.arange(2.0), "n": [1, 2]})
    assert found == {"x [m]": [0.0, 1.0], "n": [1, 2]}
    assert all(type(value) is float for value in found["x [m]"])


@given(st.lists(st.floats(-1e12, 1e12), min_size=1, max_size=5), st.integers(1, 4))
def test_files_hold_their_columns(values, width):
    """To ten digits; columns in their order, under their names."""
    columns = {f"c{j} [m]": [(j + 1) * value for value in values] for j in range(width)}
    rows = list(csv.reader(io.StringIO(as_csv(Table("t", columns)).decode())))
    assert rows[0] == list(columns)
    for j, name in enumerate(columns):
        np.testing.assert_allclose([float(row[j]) for row in rows[1:]], columns[name], rtol=1e-9)


def test_what_is_not_finite_is_left_empty_in_a_file():
    text = as_csv(Table("t", {"x": [math.nan, math.inf, 1.5], "y": ["a", 2, True]})).decode()
    assert text == "x,y\n,a\n,2\n1.5,True\n"


def test_results_hold_verdict_difference_and_whether_a_criterion_is_met():
    section = Section("geike", CASES["geike"], "none", {}, evidence_with(NUMBERS))
    rows = case_results(section)["numbers"]
    assert [row["verdict"] for row in rows] == ["agree", "differ", "undecided"]
    assert [row["met"] for row in rows] == [True, False, None]
    assert [row["difference"] for row in rows] == pytest.approx([0.034567, -6.0, 0.25])


# --- words ---


@given(value=reals, half=widths)
def test_a_value_with_its_interval(value, half):
    """Both to the second digit of the interval."""
    text, width = plus_minus(value, half).split(" ± ")
    assert abs(float(width) - half) <= 0.051 * half
    assert abs(float(text) - value) <= 0.051 * half + 1e-9
    assert plus_minus(value, 0.0) == f"{value:.5g}"


@pytest.mark.parametrize(
    ("value", "half", "text"),
    [
        (12640.4, 110.0, "12640 ± 110"),
        (1.23456, 0.0789, "1.235 ± 0.079"),
        (99.6, 10.0, "100 ± 10"),
        (1.5, 1.04, "1.5 ± 1.0"),
        (1.0, 2e-9, "1 ± 2e-09"),
        (1.0, 2.4e-6, "1.0000000 ± 0.0000024"),
        (1.0, 2.4e-7, "1 ± 2.4e-07"),
    ],
)
def test_values_with_intervals_of_all_sizes(value, half, text):
    assert plus_minus(value, half) == text


def test_a_number_in_a_sentence():
    n = number(1.25, reference=1.0, tolerance=0.5, grid=0.02, sample=0.03)
    assert n.sentence == "x = 1.25 dB ± 0.05 dB, agree with 1 dB within 0.5 dB"
    assert replace(n, unit="-").sentence == "x = 1.25 ± 0.05, agree with 1 within 0.5"
    assert replace(n, value=3.0).sentence == "x = 3 dB ± 0.05 dB, differ with 1 dB within 0.5 dB"
    assert replace(n, value=1.5).sentence == "x = 1.5 dB ± 0.05 dB, undecided with 1 dB within 0.5 dB"


def test_a_number_beside_its_reference():
    n = number(1.25, reference=1.0, tolerance=0.5, grid=0.02, sample=0.03)
    assert with_reference(n) == "1.250 ± 0.050 beside 1 dB (agree within 0.5, off by +0.25 dB)"
    assert with_reference(replace(n, unit="-", value=0.9)) == "0.900 ± 0.050 beside 1 (agree within 0.5, off by -0.1)"
    # an interval that holds the difference, or none at all, leaves nothing to tell
    assert with_reference(replace(n, value=1.04)) == "1.040 ± 0.050 beside 1 dB (agree within 0.5)"
    assert with_reference(replace(n, grid=0.0, sample=0.0)) == "1.25 beside 1 dB (agree within 0.5)"
    assert with_reference(replace(n, value=9.0)) == "9.000 ± 0.050 beside 1 dB (differ within 0.5)"
    even = number(1.25, reference=1.0, tolerance=0.5, sample=0.25)
    assert with_reference(even) == "1.25 ± 0.25 beside 1 dB (agree within 0.5)"


def test_a_claim_holds_with_all_of_its_numbers():
    good, bad = number(1.0), number(5.0)
    assert if_confirmed("So it is.", [good, good]) == "So it is."
    wide = number(1.0, sample=1.0)
    for numbers in ([bad], [good, bad], [bad, good], [bad, wide]):
        assert if_confirmed("So it is.", numbers) == "Contradicted by this run: So it is."
    for numbers in ([wide], [good, wide]):
        assert if_confirmed("So it is.", numbers) == "Not confirmed by this run: So it is."


# --- sentences built from numbers ---


def decade(value, half, *, verdict=None, unit="dB", h=0.7, first=0.1, name="relative deviation"):
    """A comparison of Fig. 14.1 that came out so."""
    tolerance = fractal_punch_decades.QUANTITIES[name].tolerance
    n = number(value, reference=0.0, tolerance=tolerance, sample=half, unit=unit, role=Role.FINDING)
    return SimpleNamespace(name=name, hurst=h, first=first, number=n)


def test_verdicts_of_fig_14_1_are_in_per_cent():
    """20 lg 1.20 dB is +20 %; its interval from 14 to 26 %, both ends, by half-widths of 20 lg."""
    half = 20 * math.log10(1.26 / 1.14) / 2
    middle = 20 * math.log10(1.26 * 1.14) / 2
    cell = fractal_punch_text.verdict(decade(middle, half).number)
    assert str(cell) == "+20 % (+14 to +26): differ"
    assert fractal_punch_text.verdict(None) == "no value"
    exponent = decade(0.0123, 0.001, unit="-", name="exponent").number
    assert str(fractal_punch_text.verdict(exponent)) == "+0.012 (+0.011 to +0.013): agree"


def test_the_sample_that_would_decide():
    """Times the factor; out of reach, and where no sample can."""
    decided_by = fractal_punch_text.decided_by
    n = number(0.75, reference=0.0, tolerance=0.25, sample=1.0)
    assert n.sample_needed == 4
    assert decided_by(n) == "needs 4.0 times the sample"
    assert decided_by(replace(n, sample=5.1)) == "needs over 100 times the sample"
    assert decided_by(replace(n, grid=0.5)) == "grid error too large"
    assert str(fractal_punch_text.verdict(n)).endswith(f"undecided; {decided_by(n)}")


def test_rolling_prints_the_numbers_it_is_given():
    mine = [
        number(v, quantity=VARIANCE, model=model, where={"h/d": 0.1}, sample=0.0123)
        for v, model in ((0.7777, "bem3d"), (1.05, "springs"))
    ]
    assert rolling_evidence._variances([*mine, replace(mine[0], where={"h/d": 0.3}, value=0.9)]) == (
        "farthest are bem3d 0.778 ± 0.012 at h/d = 0.1 (differ), springs 1.050 ± 0.012 at h/d = 0.1 (agree)"
    )
    means = [
        number(0.5432, quantity=MEAN, where={"h/d": 0.3}, reference=0.9, tolerance=0.02),
        number(1.001, quantity=MEAN, where={"h/d": 0.1}, tolerance=0.02),
    ]
    assert rolling_evidence._means(means) == (
        "farthest, at h/d = 0.3, springs have 0.543 and boundary elements 0.900 of Hertz's (differ)"
    )


def test_a_claim_of_rolling_holds_up_to_the_last_height_that_agrees():
    heights = (0.1, 0.3, 1.0)
    found = [
        number(v, reference=0.0, tolerance=1.0, quantity=LEVEL, where={"h/d": h})
        for v, h in zip((0.5, 2.5, 0.1), heights, strict=True)
    ]
    claim = rolling_claims.answered_up_to("It is so.", found, "that much.", slope=2.7)
    assert claim.answer == "Within limits (up to h/d = 0.1, h' a/d = 0.27): that much."
    assert rolling_claims.answered_up_to("It is so.", found[1:], "that much.", slope=2.7).answer == "No: that much."
    assert rolling_claims.answered_up_to("It is so.", found[:1], "that much.", slope=2.7).answer == "Yes: that much."


def test_bands_within_1_and_3_db_are_counted():
    case = SimpleNamespace(first=1.0, bands=SimpleNamespace(edges=(0.5, 0.9, 1.2, 1.6, 2.0)))
    off = (0.5, -2.0, 3.5, -0.9)
    mine = SimpleNamespace(
        height=0.1, slope=0.3, single_bands=range(4), decibels_over_bem=lambda model, band: off[band]
    )
    table = rolling_tables.bands_within(case, [mine])
    assert table.columns["springs, in the band"] == ["1 and 2 of 3"]
    assert table.columns["springs, below the band"] == ["1 and 1 of 1"]


def test_limits_print_the_numbers_they_are_given():
    n = number(0.123, quantity="exponent", model="solve", where={"scene": "sphere"}, sample=0.0456)
    assert limits_evidence._on_iterations([n]).endswith("to the power of: solve, sphere 0.12 ± 0.05.")
    residuals = table_of(
        "residual",
        [
            {"solver": solver, "residual": 1e-3, **{f"error of the {m}": f * 1e-3 for m in limits_evidence.MEASURES}}
            for solver, f in (("solve", 2.0), ("solve_polonsky_keer", 7.0))
        ],
    )
    honest = [limits_numbers.residual_number(residuals, measure) for measure in limits_evidence.MEASURES]
    assert [n.value for n in honest] == pytest.approx([7.0] * 3)
    text = limits_evidence._on_residuals(residuals, honest)
    assert "c = load 7, stiffness 7, pressure 7" in text and "alone load 2, stiffness 2, pressure 2." in text


def test_the_plateau_is_printed_in_shares_of_its_power():
    """10 lg: -10 dB is a tenth."""
    names = (f"{kind} [dB]" for kind in ("springs, open", "linear, open", "springs, steady-state"))
    plateau = Table(
        "plateau", {"h / h0": [1.0], "h / d": [0.063], **dict(zip(names, ([-20.0], [-30.0], [-21.0]), strict=True))}
    )
    shown = distance_tables.shown_plateau(plateau)
    assert shown.columns["leakage: linear, open"] == ["10 %"]
    assert shown.columns["nonlinearity: springs, steady-state"] == ["79 %"]
    assert shown.columns["springs, open [dB]"] == ["-20.0"]


def test_the_table_of_breaks_prints_its_intervals():
    columns = {
        "distance [m]": [0.1],
        "wheels": [20],
        "break [rad/s]": [12640.4],
        "± break [rad/s]": [110.0],
        "standard error [rad/s]": [1.0],
        "break by its jumps [rad/s]": [12345.6],
        "floor over predicted": [0.9876],
        "± sample": [0.0321],
    }
    shown = distance_tables.shown_breaks(Table("breaks", columns))
    assert [column[0] for column in shown.columns.values()] == [
        "0.1",
        20,
        "12640 ± 110",
        "1.235e+04",
        "0.988 ± 0.032",
    ]


def feature(value, scene="the scene", name="peak"):
    return number(
        value,
        quantity=FEATURES[name].quantity,
        where={"scene": scene},
        reference=1.0,
        tolerance=0.2,
        sample=0.05,
        unit="rad/s",
        role=Role.FINDING,
    )


def test_fig_14_4_says_what_does_not_stand_out_and_what_no_claim_counts():
    without = wheel_evidence.conclusions({"peak": feature(1.0)})
    assert [s.split(":")[0] for s in without] == ["None stands out in this run"] * 2
    mine = {name: feature(1.0, name=name) for name in ("peak", "jump", "period")}
    assert wheel_evidence.conclusions(mine) == []
    (floor,) = wheel_evidence.conclusions({**mine, "floor over predicted": feature(1.023)})
    assert floor.startswith("Region 4 is 1.023 ± 0.050 times the floor")


def test_tables_of_fig_14_4_print_the_numbers_they_are_given():
    mine = {"peak": feature(1.1), "jump": feature(3.3, name="jump")}
    shown = spectrum_tables.shown_regions(mine)
    assert shown.columns["found"][:3] == ["1.100 ± 0.050", "3.300 ± 0.050", "none stands out"]
    assert list(map(str, shown.columns["verdict"]))[:3] == ["within 0.2: agree", "within 0.2: differ", ""]
    varied = spectrum_tables.shown_parameters({"the scene": mine, "v₀ × 2": {"peak": feature(2.2)}})
    assert list(map(str, varied.columns[FEATURES["peak"].name])) == [
        "1.100 ± 0.050 (1): agree",
        "2.200 ± 0.050 (1): differ",
    ]
    assert list(map(str, varied.columns[FEATURES["jump"].name])) == ["3.300 ± 0.050 (1): differ", "none stands out"]


def test_the_wheel_in_three_dimensions_prints_the_numbers_it_is_given():
    def over_bem(value, model, where, **errors):
        key = {"quantity": "level", "model": f"{model}, over bem3d", "where": {"range": where, OMEGA: 1e4}}
        return number(value, **key, reference=0.0, tolerance=1.0, **errors)

    numbers = [
        over_bem(0.31, "linear, 3D", "region 2", grid=0.1, sample=0.1),
        over_bem(-23.4, "springs, Geike spectrum", "region 2", sample=0.3),
        over_bem(5.55, "linear, 3D", "region 3", sample=0.1),
        number(-4.44, quantity="slope of region 3", model="bem3d", reference=-4.4, sample=0.01, unit="-"),
    ]
    assert wheel_3d_evidence._geike(numbers) == "Springs of Fig. 14.4: up to 23.4 dB too quiet in region 2"
    (cost,) = wheel_3d_evidence.conclusions(11.5)
    assert "11.5 applications" in cost


def spectrum_of(level):
    omega = np.arange(1.0, 2e5, 500.0)
    return {"omega": omega, "plain": np.full((2, omega.size), level), "duration": 0.1}


def test_fig_14_5_prints_the_numbers_it_is_given():
    at = distance_numbers

    def ratio(kind, region, value):
        key = {"quantity": at.LEVEL, "model": f"{kind}, over springs, open", "where": {"region": region}}
        return number(value, **key, reference=0.0, tolerance=1.0, sample=0.1)

    numbers = [
        ratio("linear, open", "region 2", -10.0),
        ratio("springs, steady-state", "region 2", -20.0),
        number(1.05, quantity=at.JUMP, where={"worst at": 0.2}, reference=1.0, sample=0.02),
        number(1.52, quantity=at.SQUARE, reference=1.5, sample=0.03),
        number(3.87, quantity=at.ORDER, reference=4.0, tolerance=0.3, sample=0.05),
    ]
    text = wheel_distance_evidence.conclusions(numbers)
    assert "1.050 ± 0.020" in text[0] and "1.52 ± 0.03 times" in text[1]
    words = "10 % of the power of region 2 is leakage, 1 % nonlinearity"
    law = {"quantity": at.BREAK_LAW, "reference": 0.417, "tolerance": 0.1, "sample": 0.01}
    for value, said in ((0.4, "as leakage does"), (0.8, "not as leakage"), (0.51, "T^(0.51 ± 0.01)")):
        titles = wheel_distance_evidence.headlines([*numbers, number(value, **law)])
        assert said in titles["wheel_distance"] and titles["wheel_distance-cause"] == words
    assert not any(sentence.startswith("Not confirmed") for sentence in text)
