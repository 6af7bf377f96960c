"""What reduced models do beside boundary elements on the same strips: levels, coherence, mean force, work."""

import math
from collections.abc import Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Role, Table, Verdict, numbers_with, table_of
from validation.analysis.statistics import POWER_DECIBEL, Estimate, jackknifed
from validation.analysis.wording import by_status, joint_verdict, sentence
from validation.cases.rolling.claims import SLOPE_COUNTS
from validation.cases.rolling.reduced_models import (
    BED,
    COARSE,
    COARSE_LAYER,
    COARSEST,
    JUDGE,
    LAYER,
    LINE,
    LINEAR,
    MODELS,
    READ,
    Key,
    ReducedModels,
    ReducedResult,
    bands_of,
    run,
)
from validation.cases.rolling.reduced_models_map import map_headline
from validation.simulation.track_spectrum import self_affine
from validation.theory.rolling import slope_in_one_direction

FloatArray = NDArray[np.float64]

OFF = "rms over octaves of the level over boundary elements"
LIMIT, LIMIT_OF_READ = slope_in_one_direction(1.0), slope_in_one_direction(0.3)
"""h' a/d up to which two models are claimed to follow, where the rms gradient g a/d is 1 and 0.3."""
SLACK = 1.15
"""By which h' a/d may lie above a limit."""
USUAL = (LINEAR, LINE, READ, BED)
CLAIM = (
    "In octaves a rough layer that is pressed flat beforehand follows boundary elements within 1 dB up to h' a/d of "
    f"{LIMIT:.2g}."
)
GRID = 1 / 3
"""Error of a grid over its change to half of the cells, of second order."""


def evidence(result: ReducedResult) -> Evidence:
    case = result.case
    numbers = [_number(result, key, model) for key in result.strips for model in MODELS if model != JUDGE]
    table, bands = _table(result), _table_of_bands(result)
    claims = _claims(result, numbers, table)
    return Evidence(
        title="Reduced models of the wheel on a rough surface, beside boundary elements",
        method=(
            f"A wheel rolls at a fixed approach over {case.strips} strips of each spectrum and height, {case.waves} of "
            f"the longest waves long, {case.cells} cells to a contact radius. Each model rolls over the same strips. "
            "Levels of the force are taken in octaves from the longest wave on, over those of boundary elements. "
            f"{SLOPE_COUNTS}. Errors of the sample are by the jackknife, and those of the grid a third of what half of "
            "the cells change. Work counts springs, cells read, and cells of every application of an operator, over "
            "that of springs on a line; it is not a time."
        ),
        numbers=tuple(numbers),
        tables=(table, bands),
        conclusions=(),
        claims=claims,
        finding=finding(claims),
        headlines={"reduced_models-map": map_headline(numbers), "reduced_models": headline(numbers)},
        captions={
            "reduced_models-map": (
                "Root mean square over octaves of the level of the force over boundary elements, over h' a/d. Points: "
                "strips of all spectra, with 95 % intervals; lines: the largest up to there. Shaded: within 1 dB."
            ),
            "reduced_models": (
                "(a) Root mean square over octaves of the level over boundary elements, over h' a/d; dotted: 1 dB. At "
                f"the h' a/d nearest to {LIMIT:.2g}: (b) that level in one-third octaves, (c) coherence, (d) the root "
                "mean square over counted work; crosses: trials. Bars: 95 %."
            ),
        },
        unconverged=result.unconverged,
        page_tables=(table,),
    )


def slope_of(key: Key) -> float:
    """h' a/d, along the track, of all waves."""
    spectrum, height = key
    return height * self_affine(*spectrum).slope_along


def octaves(level: FloatArray) -> FloatArray:
    """Sums of three one-third octaves, along the last axis."""
    return np.asarray(level.reshape(*level.shape[:-1], -1, 3).sum(axis=-1))


def decibels(pairs: FloatArray) -> FloatArray:
    """Mean level of a model over that of boundary elements: pairs (strips, 2, bands)."""
    mine, other = pairs.mean(axis=0)
    return np.asarray(POWER_DECIBEL * np.log(mine / other))


def rms_decibels(pairs: FloatArray) -> FloatArray:
    return np.asarray(np.sqrt(np.mean(decibels(pairs) ** 2)))


def _pairs(result: ReducedResult, key: Key, model: str) -> FloatArray:
    """Levels in one-third octaves of a model and of boundary elements, (strips, 2, bands)."""
    names = list(MODELS)
    return np.array([one["level"][[names.index(model), names.index(JUDGE)]] for one in result.strips[key]])


def off(result: ReducedResult, key: Key, model: str) -> Estimate:
    return jackknifed(rms_decibels, octaves(_pairs(result, key, model)))[0]


def _number(result: ReducedResult, key: Key, model: str) -> Number:
    (hurst, first, last), height = key
    found = off(result, key, model)
    return Number(
        quantity=OFF,
        model=model,
        where={"H": hurst, "q a": (first, last), "h/d": height, "h' a/d": _rounded(slope_of(key))},
        value=found.value,
        reference=0.0,
        source="boundary elements on the same strips",
        tolerance=1.0,
        reason="1 dB: repeatability of measured one-third octave levels",
        unit="dB",
        grid=GRID * off(result, key, COARSE).value,
        sample=found.half_width,
        role=Role.FINDING,
    )


def coherence(result: ReducedResult, key: Key, model: str) -> FloatArray:
    """|sum of cross levels|^2 over both levels, of all strips, in one-third octaves."""
    place = list(MODELS).index(model)
    real, imaginary = np.sum([one["cross"][:, place] for one in result.strips[key]], axis=0)
    mine, other = _pairs(result, key, model).sum(axis=0)
    return np.asarray((real**2 + imaginary**2) / (mine * other))


def _mean(result: ReducedResult, key: Key, name: str) -> FloatArray:
    """Of all strips, by model."""
    return np.asarray(np.mean([one[name] for one in result.strips[key]], axis=0))


def _table(result: ReducedResult) -> Table:
    rows: list[dict[str, object]] = []
    for key in result.strips:
        (hurst, first, last), height = key
        force, work = _mean(result, key, "mean"), _mean(result, key, "work")
        for i, model in enumerate(MODELS):
            found = off(result, key, model)
            levels = decibels(octaves(_pairs(result, key, model)))
            rows.append(
                {
                    "model": model,
                    "H": hurst,
                    "q a": f"{first:g} to {last:g}",
                    "h/d": height,
                    "h' a/d": _rounded(slope_of(key)),
                    "octaves over bem3d [dB]": ", ".join(f"{x:+.2f}" for x in levels),
                    "rms [dB]": round(found.value, 3),
                    "± rms [dB]": round(found.half_width, 3),
                    "coherence": round(float(coherence(result, key, model).mean()), 3),
                    "mean force over bem3d": round(float(force[i] / force[0]), 3),
                    "work over springs on a line": _rounded(float(work[i] / work[list(MODELS).index(LINE)])),
                }
            )
    return table_of("reduced_models", rows)


def _table_of_bands(result: ReducedResult) -> Table:
    """In one-third octaves, where h' a/d is nearest to the limit."""
    key = min(result.strips, key=lambda one: abs(math.log(slope_of(one) / LIMIT)))
    centres = bands_of(self_affine(*key[0])).centres
    rows: list[dict[str, object]] = []
    for model in MODELS:
        levels = jackknifed(decibels, _pairs(result, key, model))
        for q, level, shared in zip(centres, levels, coherence(result, key, model), strict=True):
            rows.append(
                {
                    "model": model,
                    "h' a/d": _rounded(slope_of(key)),
                    "q a": float(q),
                    "over bem3d [dB]": level.value,
                    "± [dB]": level.half_width,
                    "coherence": float(shared),
                }
            )
    return table_of("one_third_octaves", rows)


def _rounded(value: float) -> float:
    return float(f"{value:.3g}")


def _claims(result: ReducedResult, numbers: list[Number], table: Table) -> tuple[JudgedClaim, ...]:
    def below(model: str, limit: float) -> list[Number]:
        return up_to(numbers, model, limit)

    def worst(mine: list[Number]) -> str:
        largest = max(mine, key=lambda one: one.value)
        reached = max(_slope(one) for one in mine)
        return f"{largest.value:.2f} dB at the most, at h' a/d = {_slope(largest):g}, of strips up to {reached:g}"

    layer, read = below(LAYER, LIMIT), below(READ, LIMIT_OF_READ)
    usual = at_limit(numbers)
    at = sorted({_slope(one) for one in usual})
    listed = "; ".join(
        f"at h' a/d = {slope:g} the rms over octaves is "
        + ", ".join(
            f"{one.value:.2f} ± {one.uncertainty:.2f} dB ({one.model})" for one in usual if _slope(one) == slope
        )
        for slope in at
    )
    cheap = below(COARSEST, LIMIT)
    work = partial(_work, table)
    return (
        answered(CLAIM, layer, f"its rms over octaves is {worst(layer)}."),
        answered(
            "In octaves springs that read the surface follow boundary elements within 1 dB up to h' a/d of "
            f"{LIMIT_OF_READ:.2g}.",
            read,
            f"their rms over octaves is {worst(read)}, for {_digits(work(READ))} times the counted work (springs and "
            "heights that are read) of springs on a line.",
        ),
        answered(
            f"At h' a/d of {LIMIT:.2g}, linear theory, springs and the bed of the field are more than 1 dB off "
            "boundary elements in octaves.",
            usual,
            f"{listed}.",
            confirmed_by=Verdict.DIFFER,
        ),
        answered(
            "In octaves boundary elements on a third of the cells follow those on all within 1 dB up to h' a/d of "
            f"{LIMIT:.2g}.",
            cheap,
            f"their rms over octaves is {worst(cheap)}, for {_digits(work(COARSEST))} times the counted work of "
            f"springs on a line, where the pressed layer takes {_digits(work(LAYER))} times that, on half of the cells "
            f"{_digits(work(COARSE_LAYER))} times.",
        ),
    )


def at_limit(numbers: Sequence[Number]) -> list[Number]:
    """Of the usual models, from all strips about as rough as the roughest up to the limit: no strip is chosen."""
    usual = [one for model in USUAL for one in up_to(numbers, model, LIMIT)]
    roughest = max((_slope(one) for one in usual), default=0.0)
    return [one for one in usual if _slope(one) >= roughest / SLACK]


def up_to(numbers: Sequence[Number], model: str, limit: float) -> list[Number]:
    """Of a model, up to an h' a/d."""
    return [one for one in numbers_with(numbers, OFF, model) if _slope(one) <= SLACK * limit]


def headline(numbers: Sequence[Number]) -> str:
    """Which reduced models stay within the tolerance over all strips up to the limit."""
    of = {model: up_to(numbers, model, LIMIT) for model in (LAYER, *USUAL)}
    reached = max(_slope(one) for one in of[LAYER])
    verdicts = {model: joint_verdict(mine) for model, mine in of.items()}
    follow = [model for model, verdict in verdicts.items() if verdict is Verdict.AGREE]
    count = list(verdicts.values()).count(Verdict.UNDECIDED)
    return (
        f"Within 1 dB up to h' a/d = {reached:.2g}: {', '.join(follow) or 'no reduced model'}"
        f"{f'; {count} of {len(of)} open' if count else ''}"
    )


def finding(claims: Sequence[JudgedClaim]) -> str:
    """The layer and springs that read the surface, each up to the roughest strip of its claim."""
    parts = []
    for claim, name in zip(claims, (LAYER, READ), strict=False):
        where = f"up to h' a/d = {max(_slope(one) for one in claim.numbers):.2g}"
        parts.append(
            by_status(
                claim,
                holds=f"{name}: within 1 dB of boundary elements {where}",
                fails=f"{name}: not within 1 dB of boundary elements {where}",
                undecided=f"{name}: whether within 1 dB of boundary elements {where} is open",
            )
        )
    return sentence(*parts)


def _slope(number: Number) -> float:
    found = number.where["h' a/d"]
    assert isinstance(found, float)
    return found


def _digits(value: float) -> str:
    """Three of them, without an exponent: 4110, 47.6."""
    return f"{_rounded(value):g}"


def _work(table: Table, model: str) -> float:
    """Over springs on a line, the mean of all strips."""
    return float(table.where(model=model)["work over springs on a line"].mean())


CASE = Case(
    name="reduced_models",
    chapter=Chapter.ROLLING,
    place=7,
    claim=CLAIM,
    answers="Reduced models of the rolling wheel: which one follows boundary elements as contact is lost",
    quick=ReducedModels(strips=3),
    full=ReducedModels(
        spectra=((0.7, 1.0, 10.0), (0.4, 1.0, 10.0), (0.7, 0.3, 5.0), (0.4, 0.3, 5.0)),
        heights=(0.03, 0.1, 0.3, 1.0),
        width=12,
    ),
    run=run,
    evidence=evidence,
    needs="boundary elements",
)
