"""Titles of figures and first sentences on planted numbers: their words change sides with their numbers."""

import pytest

from tests.analysis.test_judged_claims import point
from validation.analysis.answers import answered
from validation.analysis.evidence import Table, Verdict
from validation.benchmarks.solvers import claims as solver_claims
from validation.benchmarks.work_precision import claims as precision_claims
from validation.cases.exact import geike, hertz, westergaard
from validation.cases.limits import evidence as limits_evidence
from validation.cases.punch import area_gap_rolloff_evidence, normalisation
from validation.cases.punch.area_gap_rolloff_numbers import AREA, GAP
from validation.cases.rail import contact_filter, ellipse, line_convention, rail_dynamic_evidence, rough_rail
from validation.cases.rolling import (
    input_spectrum_evidence,
    ridges_evidence,
    roughness_from_force_evidence,
    track_stiffness_evidence,
)
from validation.cases.rolling import reduced_models_evidence as reduced
from validation.cases.rolling import validity_headlines as validity
from validation.cases.rolling.reduced_models import LAYER
from validation.cases.rolling.reduced_models_map import map_headline
from validation.cases.stability import evidence as stability_evidence
from validation.cases.wheel import distance_evidence, half_space_evidence, regions_evidence, spectrum_evidence
from validation.cases.wheel.distance import LINEAR_OPEN, OPEN, STEADY
from validation.cases.wheel.features import PLATEAU
from validation.cases.wheel.half_space_numbers import LEVEL, OVER_BEM

AGREE, DIFFER, UNDECIDED = Verdict.AGREE, Verdict.DIFFER, Verdict.UNDECIDED
VALUE = {AGREE: (0.2, 0.1), DIFFER: (3.0, 0.1), UNDECIDED: (1.0, 0.3)}
"""dB and half-width of a number with each verdict within 1 dB."""


def number(verdict, quantity="level", model="m", sign=1, **where):
    value, half = VALUE[verdict]
    return point(sign * value, half, quantity=quantity, model=model, where=where)


def claim_with(verdict, sign=1, **where):
    return answered("It is so.", [number(verdict, sign=sign, **where)], "so it is.")


@pytest.mark.parametrize(
    ("verdicts", "words"),
    [
        ((AGREE, DIFFER), "different at equal h/d, the same at equal h' a/d"),
        ((DIFFER, AGREE), "the same at equal h/d, different at equal h' a/d"),
        ((UNDECIDED, UNDECIDED), "not decided at equal h/d, not decided at equal h' a/d"),
    ],
)
def test_the_parameter_that_counts_is_named_by_its_claims(verdicts, words):
    """verdicts: at equal h' a/d, at equal h/d."""
    claims = [claim_with(verdict) for verdict in (*verdicts, *verdicts)]
    assert validity.headline(claims) == f"Contact kept over all spectra: {words}"
    assert validity.finding(claims).count(words) == 2


def of_models(layer, others, slope=0.8):
    models = {LAYER: layer} | dict.fromkeys(reduced.USUAL, others)
    return [
        number(verdict, quantity=reduced.OFF, model=model, **{"h' a/d": at})
        for model, verdict in models.items()
        for at in (0.2, slope)
    ]


@pytest.mark.parametrize(
    ("layer", "others", "title", "finding"),
    [
        (
            AGREE,
            DIFFER,
            "h' a/d = 0.8: pressed layer",
            "Pressed layer: within 1 dB of boundary elements up to h' a/d = 0.8",
        ),
        (DIFFER, DIFFER, "h' a/d = 0.8: no reduced model", "Pressed layer: not within 1 dB"),
        (UNDECIDED, UNDECIDED, "no reduced model; 5 of 5 open", "Pressed layer: whether within 1 dB"),
    ],
)
def test_reduced_models_that_follow_are_named(layer, others, title, finding):
    numbers = of_models(layer, others)
    claims = [
        answered("It follows.", reduced.up_to(numbers, LAYER, 1.0), "so."),
        answered("They follow.", reduced.up_to(numbers, reduced.READ, 0.3), "so."),
    ]
    assert reduced.headline(numbers).endswith(title)
    assert reduced.finding(claims).startswith(finding)


def test_a_reduced_model_is_said_to_follow_no_farther_than_it_was_rolled():
    """Strips beyond the limit are not part of it."""
    numbers = [*of_models(AGREE, AGREE, slope=0.6), number(DIFFER, reduced.OFF, LAYER, **{"h' a/d": 2.0})]
    assert reduced.headline(numbers).startswith("Within 1 dB up to h' a/d = 0.6: pressed layer, ")


@pytest.mark.parametrize(
    ("verdicts", "title"),
    [
        ((AGREE, AGREE, DIFFER), "Within 1 dB of boundary elements: pressed layer to h' a/d = 0.3"),
        ((AGREE, UNDECIDED, AGREE), "Within 1 dB of boundary elements: pressed layer to h' a/d = 0.1"),
        ((DIFFER, AGREE, AGREE), "No reduced model is shown to be within 1 dB of boundary elements"),
    ],
)
def test_the_map_ends_a_range_where_the_first_strip_leaves_it(verdicts, title):
    strips = zip((0.1, 0.3, 1.0), verdicts, strict=True)
    numbers = [number(verdict, reduced.OFF, LAYER, **{"h' a/d": slope}) for slope, verdict in strips]
    assert map_headline(numbers[::-1]) == title


def test_two_strips_of_one_slope_are_both_needed():
    numbers = [number(verdict, reduced.OFF, LAYER, **{"h' a/d": 0.3}) for verdict in (AGREE, DIFFER)]
    assert map_headline(numbers).startswith("No reduced model")


# --- a wheel on a rail ---


@pytest.mark.parametrize(
    ("linear", "read", "others", "title", "finding"),
    [
        (AGREE, AGREE, DIFFER, "is within 1 dB; m is up to -3.0 dB off", "is within 1 dB; so are springs"),
        (DIFFER, DIFFER, AGREE, "is -3.0 dB off; m is up to -3.0 dB off", "springs that read the surface are not"),
        (UNDECIDED, UNDECIDED, AGREE, "is within 1 dB is open; no other model is", "the surface are is open"),
    ],
)
def test_the_title_of_contact_filters_names_what_is_off(linear, read, others, title, finding):
    claims = [claim_with(verdict, sign=-1) for verdict in (linear, read, others, AGREE)]
    assert title in contact_filter.headline(claims)
    assert finding in contact_filter.finding(claims)


def test_the_table_of_the_field_is_no_model_of_the_title():
    claims = [claim_with(verdict) for verdict in (AGREE, AGREE, AGREE, DIFFER)]
    assert "no other model" in contact_filter.headline(claims)


@pytest.mark.parametrize(
    ("long", "short", "words"),
    [
        (
            AGREE,
            DIFFER,
            "Linear theory of the ellipse: within 1 dB; beyond its first zero +3.0 dB off at +20 dB over ISO 3095",
        ),
        (
            DIFFER,
            AGREE,
            "Linear theory of the ellipse: +3.0 dB off at +20 dB over ISO 3095; beyond its first zero within 1 dB",
        ),
        (
            UNDECIDED,
            UNDECIDED,
            "Linear theory of the ellipse: open within 1 dB; beyond its first zero open within 1 dB",
        ),
    ],
)
def test_the_title_of_rougher_rails_has_both_ranges_of_waves(long, short, words):
    where = {"offset [dB]": 20.0}
    claims = [claim_with(verdict, **where) for verdict in (long, short, AGREE)]
    assert words.startswith(rough_rail.headline(claims))
    assert rough_rail.finding(claims) == f"{words}; springs that read the surface: within 1 dB."


@pytest.mark.parametrize(
    ("verdict", "moving", "lines", "circle"),
    [
        (AGREE, "holds within 1 dB rms", "heights is within 1 dB", "has the filter of the ellipse within 1 dB"),
        (DIFFER, "is 3.0 dB rms off", "heights is +3.0 dB at worst", "costs +3.0 dB on a crown of 80 mm"),
        (UNDECIDED, "Not decided: in motion the filter changes by 1.0 ± 0.3", "heights is open", "is open"),
    ],
)
def test_titles_of_the_rail_have_the_status_of_their_claims(verdict, moving, lines, circle):
    claim = claim_with(verdict, **{"crown [mm]": 80.0})
    assert moving in rail_dynamic_evidence.headline(claim)
    assert lines in line_convention.headline([claim, claim_with(AGREE)])
    assert line_convention.headline([claim, claim_with(AGREE)]).endswith("the energy mean within 1 dB")
    assert circle in ellipse.circle_cost(claim)
    assert ellipse.finding([claim_with(AGREE), claim]).startswith("The closed form and boundary elements give the")
    assert "do not both give" in ellipse.finding([claim_with(DIFFER), claim])


# --- the dynamic wheel ---


@pytest.mark.parametrize(
    ("verdict", "words"),
    [
        (AGREE, "is that of sin²(q a)"),
        (DIFFER, "at zero 3 the oscillation has 3.0 dB of 0"),
        (UNDECIDED, "lasts to zero 3 is open"),
    ],
)
def test_the_title_of_the_wheel_counts_its_features_and_tells_of_its_oscillation(verdict, words):
    figure = answered("Four regions.", [number(v, at=i) for i, v in enumerate((AGREE, verdict))], "so.")
    zeros = answered(spectrum_evidence.DOWN_TO_ZEROS, [number(verdict, **{"worst at": 3.0})], "so.")
    moved = [answered(text, [number(verdict)], "so.") for text in spectrum_evidence.MOVED.values()]
    found = spectrum_evidence.headlines([figure, zeros, *moved])
    assert found["wheel"].startswith(f"{2 if verdict is AGREE else 1} of 2 features")
    assert found["wheel"].endswith(words)
    word = {AGREE: "agrees", DIFFER: "differs", UNDECIDED: "open"}[verdict]
    assert found["wheel-parameters"].count(word) == len(spectrum_evidence.MOVED)
    assert "wheel-parameters" not in spectrum_evidence.headlines([figure, zeros])


def test_a_level_that_rounds_to_nothing_has_no_sign():
    worst = point(-0.04, reference=22.0, where={"worst at": 19.0})
    zeros = answered(spectrum_evidence.DOWN_TO_ZEROS, [worst], "so.")
    assert spectrum_evidence._oscillation([zeros]) == ["at zero 19 the oscillation has 0.0 dB of 22"]


def test_shares_of_a_plateau_are_printed_without_a_power_of_ten():
    """-0.46 dB is 90 %, -10 dB is 10 %."""
    of = {LINEAR_OPEN: -0.46, STEADY: -10.0}
    numbers = [
        point(value, quantity=distance_evidence.LEVEL, model=f"{kind}, over {OPEN}", where={"region": PLATEAU})
        for kind, value in of.items()
    ]
    assert distance_evidence._plateau(numbers).endswith("90 % of the power of region 2 is leakage, 10 % nonlinearity")


@pytest.mark.parametrize(
    ("second", "third", "words"),
    [
        (DIFFER, DIFFER, "up to 3.0 dB too quiet in region 2, up to 3.0 dB too quiet in region 3"),
        (AGREE, UNDECIDED, "within 1 dB in region 2, open within 1 dB in region 3"),
    ],
)
def test_the_title_of_the_wheel_in_3d_has_a_side_for_each_region(second, third, words):
    """The upper half of region 3 agrees: the worse half counts."""
    where = (("region 2", second), ("region 3, lower half", third), ("region 3, upper half", AGREE))
    model = OVER_BEM[half_space_evidence.GEIKE]
    numbers = [number(verdict, LEVEL, model, sign=-1, range=region) for region, verdict in where]
    assert half_space_evidence._geike(numbers) == f"Springs of Fig. 14.4: {words}"


@pytest.mark.parametrize(
    ("contrast", "merged", "words"),
    [
        (DIFFER, AGREE, "Over short waves region 2 has maxima 3 dB over its zeros; its plateau ends at"),
        (
            AGREE,
            DIFFER,
            "Over short waves region 2 has no substructure; its plateau ends at q_min v₀ = 3.00 ω_eigen, pr",
        ),
        (UNDECIDED, UNDECIDED, "Whether region 2 has a substructure over short waves is open"),
    ],
)
def test_the_first_sentence_of_region_2_follows_its_claims(contrast, merged, words):
    claims = [
        answered("A substructure.", [number(contrast)], "so.", confirmed_by=DIFFER),
        claim_with(AGREE),
        claim_with(merged),
    ]
    assert regions_evidence.finding(claims).startswith(words)


# --- the other cases of rolling, and punches ---


@pytest.mark.parametrize(
    ("verdict", "ridges", "track", "word"),
    [
        (AGREE, "follow (14.11) through its zeros", "fluctuation within 10 %, mean within 10 %", "yes"),
        (DIFFER, "do not both follow (14.11)", "fluctuation +300 ± 10 % off at Fbar = 3, mean +300 ± 10 % off", "no"),
        (UNDECIDED, "whether both follow (14.11) is open", "fluctuation open within 10 %, mean open", "open"),
    ],
)
def test_titles_of_rolling_have_the_status_of_their_claims(verdict, ridges, track, word):
    claims = [claim_with(verdict, Fbar=3.0)] * 4
    assert ridges in ridges_evidence.headline(claims[0])
    assert track in track_stiffness_evidence.headline(claims)
    title = f"by (14.14) {word}, by the filter in 3D {word}"
    assert roughness_from_force_evidence.headline(claims).endswith(title)
    assert roughness_from_force_evidence.finding(claims).endswith(f"{word} at them.")
    assert input_spectrum_evidence.finding(claims[:3]).count(f" {word}") == 3


def test_bands_of_each_input_spectrum_are_counted():
    names = list(input_spectrum_evidence.measured.NAMES.values())
    bands = Table("bands", {f"{name} [dB]": [0.0, 3.5, -2.9, -i] for i, name in enumerate(names, start=2)})
    for verdict, words in ((AGREE, "keeps"), (DIFFER, "+300 ± 10 % off the mean"), (UNDECIDED, "not decided")):
        found = input_spectrum_evidence.headlines(bands, bands, number(verdict))
        assert found["rolling_input"] == f"Bands within 3 dB of 4: {names[0]} 3, {names[1]} 3, {names[2]} 2"
        assert words in found["rolling_input-punch"]


@pytest.mark.parametrize(
    ("verdict", "drawing"),
    [
        (AGREE, "amplitudes leave the fluctuation; heights of the ensemble leave it"),
        (DIFFER, "amplitudes change the fluctuation; heights of the ensemble change it"),
        (UNDECIDED, "amplitudes may change the fluctuation; heights of the ensemble may change it"),
    ],
)
def test_titles_of_punches_have_the_status_of_their_claims(verdict, drawing):
    claims = [claim_with(verdict)] * 2
    assert normalisation.headline(claims).endswith(drawing)


def test_the_title_of_area_and_gap_has_their_ratios():
    """20 lg 10 is ten times."""
    numbers = [point(20.0, quantity=AREA), point(40.0, quantity=AREA, at=2.0), point(-20.0, quantity=GAP)]
    claim = answered("Neither.", numbers, "so.", confirmed_by=DIFFER)
    words = "MDR has 10 to 100 times the contact area and 0.1 times the mean gap"
    assert area_gap_rolloff_evidence.headline([claim]) == words
    same = answered("Neither.", [*numbers, point(0.0, quantity=GAP, at=3.0)], "so.", confirmed_by=DIFFER)
    assert area_gap_rolloff_evidence.headline([same]) == "MDR has the contact area or the mean gap at some forces"


# --- closed forms, limits, benchmarks ---


@pytest.mark.parametrize(
    ("verdict", "sphere", "wave", "line"),
    [
        (AGREE, "elements give the contact", "gives Westergaard's", "has Geike's spectrum"),
        (DIFFER, "do not both give", "does not give", "has 3.00 of Geike's spectrum"),
        (UNDECIDED, "of Hertz is open", "is open", "is open"),
    ],
)
def test_titles_of_closed_forms_have_the_status_of_their_claims(verdict, sphere, wave, line):
    claim = claim_with(verdict)
    assert sphere in hertz.headline(claim)
    assert wave in westergaard.headline(claim)
    other = answered("Not the same.", [number(verdict)], "so.", confirmed_by=DIFFER)
    assert line in geike.headline([claim, other])
    assert ("yes" in geike.finding([claim, other])) == (verdict is AGREE)


def test_limits_and_times_are_counted():
    mixed = [number(verdict, at=i) for i, verdict in enumerate((AGREE, DIFFER, UNDECIDED, AGREE))]
    assert limits_evidence.predicted(mixed).startswith("2 of 4 limits")
    assert limits_evidence.warned_of(mixed).endswith("rightly at 2 of 4")
    assert solver_claims.headline(mixed) == "Our solver is the fastest on 2 of 4 problems, undecided on 1"
    assert solver_claims.headline(mixed[:2]) == "Our solver is the fastest on 1 of 2 problems"
    times = [number(AGREE, model=precision_claims.UP_TO), number(DIFFER, model=precision_claims.FROM)]
    found = precision_claims.headlines(times)
    assert found["precision-summary"].endswith("cheapest on 1 of 1 charts")
    assert found["precision"].endswith("cheapest on 0 of 1 charts")
    assert precision_claims.headlines([]) == {}


@pytest.mark.parametrize(
    ("verdict", "stable", "rough"),
    [
        (AGREE, "unstable where theory says, and steps", "Velocity Verlet keeps the energy; springs"),
        (DIFFER, "does not become unstable", "Velocity Verlet does not keep the energy"),
        (UNDECIDED, "says is open", "Whether velocity Verlet keeps the energy is open"),
    ],
)
def test_titles_of_time_stepping_have_the_status_of_their_claims(verdict, stable, rough):
    claims = [claim_with(verdict)] * 4
    found = stability_evidence.headlines(claims)
    assert stable in found["wheel_stability"] and stable in stability_evidence.finding(claims)
    assert found["wheel_stability-rough"].startswith(rough)
    assert "lift off" not in stability_evidence.headlines(claims[:3])["wheel_stability-rough"]
