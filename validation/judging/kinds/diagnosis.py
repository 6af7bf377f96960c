"""What is wrong with a model as a whole, by its points: a common factor, a table, equal draws, answers that change."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from validation.analysis.evidence import Verdict, where_text
from validation.analysis.statistics import FloatArray
from validation.judging.judgement import AGAIN, DEVIATION, LEVEL, WITHOUT_NUMBER, Conditions, JudgedNumber
from validation.judging.kinds.held_out_points import SUFFIX
from validation.judging.kinds.profiles import MOMENTS
from validation.judging.kinds.rolling import ALPHA, APART, FILTER, HEIGHT, MEAN, SLOPE, WAVE, Q
from validation.judging.kinds.stiffness import BY_BAND, DIFFERENT_DRAWS, EQUAL_DRAWS, FORCE
from validation.judging.kinds.stiffness import DEVIATION as OF_STIFFNESS

NEAR, SPARE = 0.006, 0.01
"""Relative: of a factor that is known by a name; of each point, beside its error."""
LEAST, MOST_OF, OFF = 5, 0.95, 0.02
"""Points that have a factor in common, the part of them that keep to it, and the least that a factor is off one."""
OF_VALUES: Mapping[str, float] = {
    "E for E*, at nu = 0.3": 1 - 0.3**2,
    "E* divided by 1 - nu^2 once more, at nu = 0.3": 1 / (1 - 0.3**2),
    "E for E*, at nu = 1/3": 8 / 9,
    "E* divided by 1 - nu^2 once more, at nu = 1/3": 9 / 8,
    "E for E*, at nu = 0.5": 3 / 4,
    "4/3: E* divided by 1 - nu^2 once more at nu = 0.5, or the factor of Hertz": 4 / 3,
    "a factor 2: a diameter for a radius, or one-sided for two-sided": 2.0,
    "a factor 1/2: a radius for a diameter, or E* of two equal bodies for that of one": 0.5,
    "a factor 4": 4.0,
    "a factor 1/4": 0.25,
    "a factor pi": math.pi,
    "a factor 1/pi": 1 / math.pi,
    "a factor 2 pi: per radian for per cycle": 2 * math.pi,
    "a factor 1/(2 pi): per cycle for per radian": 1 / (2 * math.pi),
    "a factor sqrt(2): an amplitude for an rms value, or a gradient for a slope": math.sqrt(2),
    "a factor 1/sqrt(2): an rms value for an amplitude, or a slope for a gradient": 1 / math.sqrt(2),
    "1.1523, the factor of a square punch": 1.1523,
    "1/1.1523, without the factor of a square punch": 1 / 1.1523,
    "2/sqrt(pi), a circular punch of equal area": 2 / math.sqrt(math.pi),
    "sqrt(pi)": math.sqrt(math.pi),
    "1/sqrt(pi)": 1 / math.sqrt(math.pi),
}
"""Ratios of values, or of amplitudes."""
OF_POWERS: Mapping[str, float] = {
    "one-sided for two-sided": 2.0,
    "two-sided counted as one-sided": 0.5,
    "a factor pi": math.pi,
    "a factor 1/pi": 1 / math.pi,
    "a factor 2 pi: per radian for per cycle": 2 * math.pi,
    "a factor 1/(2 pi): per cycle for per radian": 1 / (2 * math.pi),
    "a factor 2 of the amplitude": 4.0,
    "a factor 1/2 of the amplitude": 0.25,
    "E for E*, at nu = 0.3": 0.91**2,
    "E* divided by 1 - nu^2 once more, at nu = 0.3": 0.91**-2,
    "E for E*, at nu = 1/3": (8 / 9) ** 2,
    "E* divided by 1 - nu^2 once more, at nu = 1/3": (9 / 8) ** 2,
    "a factor 4 pi: per cycle and one-sided": 4 * math.pi,
    "a factor 1/(4 pi)": 1 / (4 * math.pi),
}
"""Ratios of powers, of which a level is 10 lg."""


class CommonFactor(NamedTuple):
    """factor: by which values are off; half: of its 95 % interval, relative; kept: how many points keep to it."""

    factor: float
    half: float
    kept: int


def common_factor(ratios: Sequence[float] | FloatArray, halves: Sequence[float] | FloatArray) -> CommonFactor | None:
    """The factor that nearly all ratios have within their errors, if it is not one; None where they have none.

    ratios: positive, of values over their references; halves: of their 95 % intervals, relative.
    """
    logs, errors = np.log(np.asarray(ratios, dtype=float)), np.asarray(halves, dtype=float)
    finite = np.isfinite(logs) & np.isfinite(errors)
    logs, errors = logs[finite], errors[finite]
    if logs.size < LEAST:
        return None
    weights = 1 / (errors**2 + SPARE**2)
    mean = float(_median(logs, weights))
    kept = np.abs(logs - mean) <= errors + SPARE
    mean = float((weights * logs)[kept].sum() / weights[kept].sum())
    kept = np.abs(logs - mean) <= errors + SPARE
    half = 1 / math.sqrt(float(weights[kept].sum()))
    # most points must show by themselves that they are off
    shown = np.abs(logs) > errors + SPARE
    if kept.mean() < MOST_OF or shown.mean() < 0.5 or abs(mean) < max(OFF, half):
        return None
    return CommonFactor(math.exp(mean), half, int(kept.sum()))


def _median(values: FloatArray, weights: FloatArray) -> float:
    order = np.argsort(values)
    total = np.cumsum(weights[order])
    return float(values[order][int(np.searchsorted(total, total[-1] / 2))])


def named(factor: float, half: float, names: Mapping[str, float]) -> str:
    """What a factor may come from, the nearest first; nothing where it is none of these."""
    distances = {name: abs(math.log(factor / value)) for name, value in names.items()}
    near = sorted((name for name in distances if distances[name] <= NEAR + half), key=lambda name: distances[name])
    return "; or ".join(near[:2])


UNSIGNED = {APART.format(name) + end for name in ("force", "approach") for end in ("", SUFFIX)}
"""Quantities that have no sign."""
ALONG = FORCE, HEIGHT, SLOPE, Q, WAVE
"""Conditions along which a table has its points; a held-out point is compared with the nearest ones."""
NEAREST, MOST, FEW, SHOWN = 0.8, 0.5, 0.2, 3
"""Part of the nearest points of a table that must agree; part of the held-out points of a scene, and of all, that fail;
scenes that are listed."""
SQUARED, LOWEST = 0.15, -8.0
"""Of levels that are twice, or half of, their references: what each may be off [dB, and of the reference], and the
lowest reference [dB]."""
SMOOTH, FLAT = 0.1, 3.0
"""h' a/d up to which linear theory holds, and Fbar from which on a punch is flat, nearly."""


class Remark(NamedTuple):
    """cause: a noun; sentence: with numbers; decides: whether no verdict can be trusted."""

    cause: str
    sentence: str
    decides: bool = False


def remarks(points: Sequence[JudgedNumber]) -> list[Remark]:
    """Those that decide come first."""
    return [*_changing(points), *_draws(points), *_table(points), *_factor(points)]


def _changing(points: Sequence[JudgedNumber]) -> Iterator[Remark]:
    for point in points:
        if point.quantity == AGAIN and point.verdict is not Verdict.WITHIN:
            size = f" by {100 * point.difference:.2g} %" if math.isfinite(point.difference) else ""
            cause, _, detail = point.reason.partition(": ")
            yield Remark(
                cause,
                f"No verdict can be trusted: asked again, the model has another answer to the same problem{size} "
                f"({cause}{f': {detail}' if detail else ''}).",
                decides=True,
            )


def _draws(points: Sequence[JudgedNumber]) -> Iterator[Remark]:
    reasons = [point.reason for point in points if point.quantity != AGAIN]
    if equal := next((reason for reason in reasons if EQUAL_DRAWS in reason), ""):
        count = equal.split()[0]
        yield Remark(
            "equal draws",
            f"Its {count} draws are equal: {EQUAL_DRAWS}, its mean and deviation are inconclusive.",
        )
    elif few := next((reason for reason in reasons if DIFFERENT_DRAWS in reason), ""):
        yield Remark("few draws", f"Its draws are taken from few: {few}; the error is that of as many.")


# --- right on the table alone ---


def _table(points: Sequence[JudgedNumber]) -> Iterator[Remark]:
    """Scenes of held-out points where the model fails and the nearest points of the table agree."""
    failed: list[str] = []
    lost = expected = wrong = sure = 0
    for scene, held_out in _scenes(points).items():
        comparable = [point for point in held_out if _is_right_nearby(point, points)]
        out = [point for point in comparable if point.verdict in (Verdict.OUTSIDE, *WITHOUT_NUMBER)]
        expected, wrong = expected + len(comparable), wrong + len(out)
        lost += sum(point.verdict is not Verdict.OUTSIDE for point in out)
        if comparable and len(out) >= MOST * len(comparable):
            failed.append(f"{scene or 'all'} ({len(out)} of {len(comparable)})")
            sure += len(comparable) > 1 or comparable[0].quantity in UNSIGNED or comparable[0].reference == 1
    # one point of a scene may be off by chance, one of each of several is not
    if (sure or len(failed) >= SHOWN) and wrong >= FEW * expected:
        what = "has no value" if lost == wrong else "is outside of the tolerance"
        yield Remark(
            "right on the table alone" if wrong > MOST * expected else "wrong beside the table",
            f"Right at the points of the table alone? Where the nearest points of the table are within the tolerance "
            f"it {what} at {wrong} of {expected} held-out points: {'; '.join(failed[:SHOWN])}"
            f"{f' and {len(failed) - SHOWN} more' if len(failed) > SHOWN else ''}.",
        )


def _scenes(points: Sequence[JudgedNumber]) -> dict[str, list[JudgedNumber]]:
    """Held-out points by their conditions but those along which a table goes."""
    scenes: dict[str, list[JudgedNumber]] = {}
    for point in points:
        # a mean over a strip shows little of a model
        if point.quantity.endswith(SUFFIX) and point.quantity.removesuffix(SUFFIX) not in (MEAN, "mean approach"):
            where = {name: value for name, value in point.where.items() if name not in ALONG}
            scenes.setdefault(where_text(where), []).append(point)
    return scenes


def _is_right_nearby(point: JudgedNumber, points: Sequence[JudgedNumber]) -> bool:
    quantity = point.quantity.removesuffix(SUFFIX)
    table = [other for other in points if other.quantity == quantity]
    names = [name for name in ALONG if name in point.where and all(name in other.where for other in table)]
    if not table or not names:
        return bool(table) and all(other.verdict is Verdict.WITHIN for other in table)
    distance = np.array([_distance(point.where, other.where, names) for other in table])
    near = [other for other, far in zip(table, distance, strict=True) if far <= distance.min() + 1e-9]
    return sum(other.verdict is Verdict.WITHIN for other in near) >= NEAREST * len(near)


def _distance(where: Conditions, other: Conditions, names: Sequence[str]) -> float:
    return sum(abs(math.log(float(where[name]) / float(other[name]))) for name in names)


# --- a factor, or a shift ---


def _factor(points: Sequence[JudgedNumber]) -> Iterator[Remark]:
    """Of values, and of levels; else where linear theory holds, or where the punch is flat; of a rule its moments."""
    signed = [
        point
        for point in points
        if point.reference != 1 and math.isfinite(point.difference) and math.isfinite(point.error)
        if point.quantity.removesuffix(SUFFIX) not in (*UNSIGNED, OF_STIFFNESS, BY_BAND) and point.unit != DEVIATION
    ]
    for of, is_level in ((_of_values, False), (_of_levels, True)):
        selected = [point for point in signed if (point.unit == LEVEL) == is_level]
        table = [point for point in selected if not point.quantity.endswith(SUFFIX)]
        of_each = [[p for p in table if p.quantity == name] for name in dict.fromkeys(p.quantity for p in table)]
        if everywhere := next(filter(None, (list(of(part, "")) for part in (selected, table, *of_each))), []):
            yield from everywhere
            continue
        smooth = [point for point in selected if float(point.where.get(SLOPE, math.inf)) <= SMOOTH]
        flat = [point for point in selected if float(point.where.get(FORCE, 0.0)) >= FLAT]
        yield from (remark for remark in of(smooth, f" up to {SLOPE} = {SMOOTH:g}") if remark.sentence.endswith("?"))
        yield from (remark for remark in of(flat, f" from {FORCE} = {FLAT:g} on") if remark.sentence.endswith("?"))
    yield from _of_moments(points)


def _of_moments(points: Sequence[JudgedNumber]) -> Iterator[Remark]:
    """Of a rule for the spectrum of a profile, beside those of the surface."""
    moments = [p for p in points if p.quantity.removesuffix(SUFFIX) in MOMENTS.values() and math.isfinite(p.difference)]
    power = [2.0 if point.quantity.startswith("rms") else 1.0 for point in moments]
    ratios = np.array([max(1 + point.difference, 0.0) ** n for point, n in zip(moments, power, strict=True)])
    common = common_factor(ratios, np.full(len(moments), SPARE)) if moments and ratios.min() > 0 else None
    if common and common.kept == len(moments):
        sentence = f"All moments of the profile are {common.factor:.3g} times those of the surface"
        yield _factor_remark("a factor everywhere", sentence, common, OF_POWERS)


def _columns(points: Sequence[JudgedNumber]) -> tuple[FloatArray, FloatArray]:
    return np.array([p.difference for p in points]), np.array([p.error for p in points])


def _of_values(points: Sequence[JudgedNumber], where: str) -> Iterator[Remark]:
    positive = [point for point in points if point.difference > -1]
    difference, error = _columns(positive)
    if len(positive) == len(points) and (common := common_factor(1 + difference, error / (1 + difference))):
        sentence = f"{_subject(common.kept, points, where)} {common.factor:.3g} times the reference"
        yield _factor_remark("a factor everywhere", sentence, common, OF_VALUES)


def _of_levels(points: Sequence[JudgedNumber], where: str) -> Iterator[Remark]:
    """A shift is a factor of powers; of filters, levels that are twice the references are those of a square."""
    difference, error = _columns(points)
    in_power = math.log(10) / 10
    if common := common_factor(np.exp(in_power * difference), in_power * error):
        shift = 10 * math.log10(common.factor)
        side = "above" if shift > 0 else "below"
        sentence = f"{_subject(common.kept, points, where)} {abs(shift):.2f} dB {side} the reference"
        yield _factor_remark("a shift everywhere", sentence, common, OF_POWERS)
        return
    yield from _of_squares(points)


def _of_squares(points: Sequence[JudgedNumber]) -> Iterator[Remark]:
    """Of a filter over ridges, where a band has one wave along and none across, and not its zeros."""
    ridges = [p for p in points if p.quantity == FILTER and p.where.get(ALPHA) == 0.0 and p.reference > LOWEST]
    if len(ridges) < LEAST:
        return
    (difference, error), reference = _columns(ridges), np.array([point.reference for point in ridges])
    for times, cause in ((2.0, "the square of the amplitude, 20 lg for 10 lg"), (0.5, "the root of the amplitude")):
        # the mean of a power over a band is a little more than the power of the mean
        kept = np.abs(difference - (times - 1) * reference) <= error + SQUARED * (1 + np.abs(reference))
        if kept.mean() > MOST_OF:
            sentence = f"{_subject(int(kept.sum()), ridges, ' over ridges')} {times:g} times the reference in dB"
            yield Remark("levels of a power of the amplitude", f"{sentence}: {cause}?")


def _factor_remark(remark: str, sentence: str, common: CommonFactor, names: Mapping[str, float]) -> Remark:
    """The sentence, with what the factor may come from as a question."""
    cause = named(common.factor, common.half, names)
    return Remark(remark, f"{sentence}: {cause}?" if cause else f"{sentence}.")


def _subject(kept: int, points: Sequence[JudgedNumber], where: str) -> str:
    quantities = " and ".join(dict.fromkeys(point.quantity.removesuffix(SUFFIX) for point in points))
    count = len(points)
    return f"{'All' if kept == count else f'{kept} of'} {count} points of its {quantities}{where} are"
