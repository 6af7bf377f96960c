"""The A-weighted contact force of a rail: k times the equivalent displacement, by the table of the standard."""

import csv
import dataclasses
import io
import json
import math
from dataclasses import replace

import numpy as np
import pytest

import validation
from tests.advice.planted_answers import Finding, compared, planted
from tests.seeded import catches
from validation.advice import compare
from validation.advice.scene_model import Answer
from validation.advice.summary import bands_of, summary
from validation.railway import rail_columns
from validation.railway.scenes import rail
from validation.simulation.model import Cost

RAIL = validation.load_scene("rail")
KILOHERTZ_AT_20_MM = 1e3 * 10**-1.7
"""Speed [m/s] at which each band of wavelength has the frequency of one of the table, 10 Hz to 25 kHz."""
TABLE = [-70.4, -63.4, -56.7, -50.5, -44.7, -39.4, -34.6, -30.2, -26.2, -22.5, -19.1, -16.1, -13.4, -10.9, -8.6, -6.6]
TABLE += [-4.8, -3.2, -1.9, -0.8, 0.0, 0.6, 1.0, 1.2, 1.3, 1.2, 1.0, 0.5, -0.1, -1.1, -2.5, -4.3, -6.6, -9.3]
"""IEC 61672-1, dB, to a tenth, 10 Hz to 20 kHz."""


class Filter(Finding):
    """A filter in decibels, with an error in each band."""

    def solve(self):
        bands = {"model": np.full(35, self.parts[0]), "grid": np.zeros(35), "sample": np.zeros(35)}
        bands["model"][self.parts[1] :] = np.inf
        value, cost = 10 ** (np.array(self.value) / 20), Cost(work=1, seconds=1.0)
        return Answer(value=value, cost=cost, model=0.01, band_errors=bands)


def filters(*shifts, speed=KILOHERTZ_AT_20_MM, error=0.5, count=35):
    """A3 falls by a third of a decibel a band; others lie above it."""
    first = [
        Filter(name=f"by {shift:g} dB", value=tuple(shift - np.arange(35) / 3), parts=(error, count))
        for shift in shifts
    ]
    return compared(*first, scene=replace(RAIL, speed=speed), quantity="contact-filter", solve_all=True)


real_contact = rail.RailScene.contact.func


def of_the_secant(scene):
    contact = real_contact(scene)
    return dataclasses.replace(contact, stiffness=contact.force / contact.approach)


@catches("the force over the approach for the stiffness of Hertz").at(
    "validation.railway.scenes.rail.RailScene.contact", property(of_the_secant)
)
def test_the_force_is_the_stiffness_of_hertz_times_the_equivalent_displacement():
    """At 1 kHz nothing is weighted; k = 3 F / (2 d), 50 kN and 65.6 um."""
    force = filters(0.0).force
    at_20_mm, l_r = 20, RAIL.levels.levels[20]
    displacement = 1e-6 * 10 ** ((l_r - 20 / 3) / 20)
    newton = 1.5 * 50e3 / 65.6e-6 * displacement
    assert force.levels[force.chosen][at_20_mm] == pytest.approx(20 * math.log10(newton), abs=0.02)
    assert force.stiffness == pytest.approx(1.5 * 50e3 / 65.6e-6, rel=1e-3)


def answering(comparison, which, **changes):
    """The same comparison with another answer of one model."""
    models = list(comparison.models)
    models[which] = replace(models[which], answer=replace(models[which].answer, **changes))
    return replace(comparison, selection=replace(comparison.selection, candidates=tuple(models)))


real_weighting = rail_columns.a_weighting


@catches("A-weighting at the frequency of half a wave").at(
    "validation.railway.rail_columns.a_weighting", lambda frequency: real_weighting(2 * frequency)
)
@catches("a force at nominal frequencies").at(
    "validation.analysis.spectra.NominalBands.wavelengths", property(lambda bands: bands.nominal)
)
def test_each_band_is_weighted_as_the_table_of_the_standard_has_its_frequency():
    """f = v / lambda of the exact wavelength of the band: a nominal one, as 160 for 158.5 mm, is off by 0.1 dB."""
    force = filters(0.0).force
    unweighted = np.array(RAIL.levels.levels) - np.arange(35) / 3 + 20 * math.log10(1.5 * 50e3 / 65.6)
    np.testing.assert_allclose((force.levels[force.chosen] - unweighted)[:34], TABLE, atol=0.065)


@catches("the mean error of bands as that of their sum").at(
    "validation.advice.contact_force.ContactForce.error", property(lambda force: float(force.half_width.mean()))
)
def test_the_error_of_the_sum_counts_loud_bands_most():
    """All bands louder by their errors, over the sum as it is: a loud band of 3 dB among others that are known."""
    comparison = filters(0.0)
    loud = int(np.argmax(comparison.force.levels["by 0 dB"]))
    errors = comparison.models[0].answer.band_errors
    force = answering(comparison, 0, band_errors={**errors, "model": np.where(np.arange(35) == loud, 3.0, 0.0)}).force
    powers = [10 ** (level / 10) for level in force.levels["by 0 dB"]]
    louder = sum(powers) + powers[loud] * (10**0.3 - 1)
    assert force.error == pytest.approx(10 * math.log10(louder / sum(powers)))
    assert force.error > 2 * 3.0 / 35


def test_another_filter_changes_the_sum_by_what_it_is_louder():
    force = filters(0.0, 0.8, -1.5).force
    assert [force.over_chosen(name) for name in force.levels] == pytest.approx([0.0, 0.8, -1.5])
    assert force.change.endswith(" -1.5 to +0.8 dB(A)")


def independent_bands(force):
    level = force.levels[force.chosen]
    share = 10 ** (level / 10) / np.sum(10 ** (level / 10))
    return float(np.sqrt(np.sum((share * force.half_width) ** 2)))


@catches("errors of bands taken as independent in their sum").at(
    "validation.advice.contact_force.ContactForce.error", property(independent_bands)
)
def test_the_error_of_the_sum_is_that_of_its_bands_and_says_which_are_unknown():
    assert filters(0.0).force.error == pytest.approx(0.5)
    force = filters(0.0, count=20).force
    level = force.levels[force.chosen]
    share = (10 ** (level[20:] / 10)).sum() / (10 ** (level / 10)).sum()
    assert (force.error, force.unsure) == (pytest.approx(0.5), pytest.approx(share))
    assert f"bands of unknown error, {100 * share:.2g} % of its energy" in force.sentences[0]


@catches("sums over unlike bands beside each other").at(
    "validation.advice.contact_force.ContactForce.over_chosen",
    lambda force, model: force.total(model) - force.total("by 0 dB"),
)
def test_bands_without_an_answer_are_left_out_of_both_sums():
    """A filter is no quieter where it has no answer; its own sum is that of the bands that it has."""
    number, comparison = np.arange(35), filters(0.0, 2.0)
    value = comparison.models[1].answer.value
    force = answering(comparison, 1, value=np.where((number >= 15) & (number < 25), np.nan, value)).force
    assert force.over_chosen("by 2 dB") == pytest.approx(2.0)
    assert force.total("by 2 dB") < force.total("by 0 dB")
    value = comparison.models[0].answer.value
    force = answering(comparison, 0, value=np.where(number < 15, np.nan, value)).force
    assert force.over_chosen("by 2 dB") == pytest.approx(2.0)
    assert "summed over bands of 2000 to 0.8 mm, but for 15 without an answer" in force.sentences[1]
    assert math.isfinite(force.error) and math.isfinite(force.unsure)
    assert answering(comparison, 0, value=value + np.nan).force is None


def test_the_closed_filters_stand_beside_the_chosen_one_unasked():
    comparison = validation.compare(RAIL, quantity="contact-filter", tolerance="1 dB")
    assert [candidate.name for candidate in comparison.selection.solved] == ["linear, ellipse"]
    names = ["linear, ellipse", "linear, on the line", "Remington", "spring bed (DPRS), linear"]
    assert list(comparison.force.levels) == names
    assert "another filter changes the sum by +0.2 to +0.6 dB(A)" in " ".join(summary(comparison).split())


@catches("the equivalent roughness filtered once more").at(
    "validation.advice.compare.Comparison.a3_of", compare.Comparison.value_of
)
def test_text_json_and_csv_have_the_same_table():
    """L_eq = L_r + A3, whichever quantity is asked."""
    filters, keys = [], ("roughness_dB", "a3_dB", "equivalent_dB", "force_dBA")
    for quantity in ("contact-filter", "equivalent-roughness"):
        comparison = validation.compare(
            RAIL, quantity=quantity, tolerance="1 dB", models=["linear, ellipse", "Remington"]
        )
        written = json.loads(validation.to_json(comparison))
        lists = [np.array(written[key]) for key in keys]
        assert lists[0].tolist() == list(RAIL.levels.levels)
        assert lists[2] == pytest.approx(lists[0] + lists[1])
        filters.append(written["a3_dB"])
        rows = [row for row in csv.DictReader(io.StringIO(validation.to_csv(comparison))) if row["selected"] == "True"]
        shown = bands_of(comparison, comparison.model)
        for key, name, values in zip(keys, ("L_r", "A3", "L_eq", "L_FA"), lists, strict=True):
            assert [float(row[key]) for row in rows] == pytest.approx(values.tolist(), abs=1e-8)
            assert [float(cell) for cell in shown[name]] == pytest.approx(values, abs=0.0501)
        sums = {row["model"]: row["force_sum_dBA"] for row in written["models"]}
        assert sums["linear, ellipse"] == pytest.approx(10 * np.log10((10 ** (lists[3] / 10)).sum()))
        assert sums["boundary elements"] is None
    assert filters[0] == pytest.approx(filters[1], abs=1e-9)


def test_without_a_speed_a_rail_or_an_answer_there_is_no_force():
    failed = planted("rail", "contact-filter", statuses=("failed", "out of range"), error=math.inf)
    slow, sphere = (
        validation.compare(scene, tolerance="1 dB")
        for scene in (replace(RAIL, speed=None), validation.load_scene("sphere"))
    )
    for comparison in (failed, slow, sphere):
        assert comparison.force is None and "dB(A)" not in summary(comparison)
        assert json.loads(validation.to_json(comparison))["force_dBA"] == [] and "force_dBA" not in validation.to_csv(
            comparison
        )
