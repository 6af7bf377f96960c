"""What rolling over isotropic roughness shows: levels, coherence, variance and mean, beside linear theory."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Role, Table, Verdict, columns, table_of
from validation.analysis.spectra import Bands
from validation.analysis.statistics import (
    POWER_DECIBEL,
    Estimate,
    Sample,
    at_level,
    difference_of_halves,
    extrapolated,
    log_mean,
    mean_estimate,
    paired_samples,
    ratio_of_means,
    sample,
    weighted_mean,
)
from validation.cases.rolling.force_spectrum import ROUGH, ForceSpectrum, RollingResult, run
from validation.engine.engine import Outcome, random_generator
from validation.selection import model_needed
from validation.simulation.rolling_strip import BOOTSTRAP, HERTZ
from validation.simulation.track_spectrum import InputSpectrum, TrackSpectrum
from validation.theory import rolling as rolling_theory

FloatArray = NDArray[np.float64]
Row = dict[str, object]

ONE = 1.0
LOW = 0.01
"""Heights over d up to which boundary elements must agree with linear theory, or something is wrong with them."""
LINEAR_1D, SPRINGS, LINEAR_3D, FED_SPRINGS = "linear 1D", "springs", "linear 3D", "springs, fed for rolling"
MODELS = (LINEAR_1D, SPRINGS, LINEAR_3D, FED_SPRINGS)
REASON = "1 dB: what a level in a one-third octave repeats to when it is measured"


@dataclass(frozen=True, kw_only=True)
class Height:
    """All levels at one height, resampled.

    bem_over_linear, finer: pairs of boundary elements and linear theory on the same surfaces, and of the same surfaces
    on two grids; springs: levels by what they were fed; springs_over_linear: pairs with the filter on the same tracks;
    exact_1d, exact_3d: levels of linear theory, by quadrature.
    """

    height: float
    bands: Bands
    bem: Outcome
    mdr: dict[InputSpectrum, Outcome]
    bem_over_linear: Sample
    finer: Sample
    springs: dict[InputSpectrum, Sample]
    springs_over_linear: Sample
    exact_1d: FloatArray
    exact_3d: FloatArray

    def weights(self, first: float, last: float) -> FloatArray:
        """The mean over the bands that lie between two wavenumbers."""
        edges = np.array(self.bands.edges)
        inside = (edges[:-1] > first * (1 - 1e-9)) & (edges[1:] < last * (1 + 1e-9))
        return np.asarray(inside / inside.sum())

    def bem_level(self, weights: FloatArray) -> tuple[Estimate, float]:
        """ln of boundary elements over linear theory in 3D on cells of no size, and what that leaves open."""
        statistic = difference_of_halves(weighted_mean(weights, log_mean))
        finer = self.finer.estimate(statistic)
        return extrapolated(self.bem_over_linear.estimate(statistic), finer)

    def model_level(self, model: str, weights: FloatArray) -> Estimate:
        """ln of a model over linear theory in 3D."""
        used = weights > 0
        reference = float(weights[used] @ np.log(self.exact_3d[used]))
        if model == LINEAR_3D:
            return _exactly(0.0)
        if model == LINEAR_1D:
            with np.errstate(divide="ignore"):
                return _exactly(float(weights[used] @ np.log(self.exact_1d[used])) - reference)
        rule: InputSpectrum = "geike" if model == SPRINGS else "rolling"
        found = self.springs[rule].estimate(weighted_mean(weights, log_mean))
        return Estimate(found.value - reference, found.error, found.samples)

    def apart(self, model: str, where: str, weights: FloatArray, role: Role = Role.FINDING) -> Number:
        """A model over boundary elements in decibels."""
        bem, grid = self.bem_level(weights)
        apart = self.model_level(model, weights).minus(bem)
        return Number(
            quantity=f"{model} over bem3d, h/d = {self.height:g}, {where}",
            value=POWER_DECIBEL * apart.value,
            reference=0.0,
            source="bem3d, extrapolated, on the same surfaces as linear theory in 3D",
            tolerance=ONE,
            unit="dB",
            reason=REASON,
            grid=POWER_DECIBEL * grid,
            sample=POWER_DECIBEL * apart.half_width,
            role=role,
        )

    def departure(self, where: str, weights: FloatArray) -> Number:
        """What nonlinearity does to springs, beside what it does to boundary elements."""
        bem, grid = self.bem_level(weights)
        springs = self.springs_over_linear.estimate(difference_of_halves(weighted_mean(weights, log_mean)))
        apart = springs.minus(bem)
        return Number(
            quantity=f"nonlinear over linear, h/d = {self.height:g}, {where}: springs beside bem3d",
            value=POWER_DECIBEL * springs.value,
            reference=POWER_DECIBEL * bem.value,
            source="bem3d over linear theory in 3D",
            tolerance=ONE,
            unit="dB",
            reason=REASON,
            grid=POWER_DECIBEL * grid,
            sample=POWER_DECIBEL * apart.half_width,
            role=Role.FINDING,
        )


def evidence(result: RollingResult) -> Evidence:
    """Ratios in one-third octaves and over ranges of them; coherence, variance, mean; the map of validity."""
    case = result.case
    found = [_height(result, i) for i in range(len(case.heights))]
    ranges = _ranges(case)
    numbers = [number for mine in found for number in _numbers(mine, ranges)]
    numbers.append(_louder(case, numbers, list(ranges)[-1]))
    summary = table_of("summary", [_summary(result, mine) for mine in found])
    tables = (
        table_of("levels", [row for mine in found for row in _levels(case, mine)]),
        summary,
        _narrow(result),
        _forces(result),
    )
    within = _within(case, found)
    heights = ", ".join(f"{h:g}" for h in case.heights)
    return Evidence(
        title="Rolling over isotropic roughness: where one dimension is some decibels off",
        method=(
            f"A wheel at a fixed approach d over self-affine roughness, H = {case.hurst:g}, q a = {case.first:g} to "
            f"{case.last:g}, h_rms / d = {heights}. Boundary elements: {case.strips} surfaces {case.length:g} a long "
            f"({case.rough_strips} from h/d = {ROUGH:g} on), "
            f"{case.cells} cells to a contact radius, and {case.refined} of them with {2 * case.cells}, extrapolated "
            f"to first order; ± grid is half of that way, and the interval of what it rests on. Springs: {case.tracks} "
            "tracks as long, of Geike's spectrum, and of the spectrum that has the level of linear theory in 3D along "
            "the track (case rolling_input). Linear theory: (14.12) in 1D, and the same filter on the surface in 3D, "
            "in both cases by quadrature. Levels of the force in one-third octaves of q a, as powers in dB; boundary "
            "elements are taken relatively to linear theory on the same surfaces, which removes most of the scatter. "
            "Means over the bands within a range are resampled as one number; errors of single bands, as at the zeros "
            "of sin(q a), may cancel in them: the first table below and the map have these."
        ),
        numbers=tuple(numbers),
        tables=tables,
        conclusions=tuple(_conclusions(case, found, numbers)),
        captions=_captions(case),
        unconverged=result.unconverged,
        page_tables=(within, summary),
    )


def _ranges(case: ForceSpectrum) -> dict[str, tuple[float, float]]:
    """Below the band, where springs have nothing; its long waves; its short ones."""
    middle = 4 * case.first
    return {
        f"q a = {first:g} to {last:g}": (first, last)
        for first, last in ((case.lowest, case.first), (case.first, middle), (middle, case.last))
        if first < last
    }


def _height(result: RollingResult, i: int) -> Height:
    case, height = result.case, result.case.heights[i]
    bem, finer = result.bem[height], result.refined[height]
    mdr: dict[InputSpectrum, Outcome] = {rule: result.mdr[rule, height] for rule in ("geike", "rolling")}

    def rng(part: int) -> np.random.Generator:
        return random_generator(case.seed, BOOTSTRAP, i, part)

    exact_1d, exact_3d = (height**2 * level for level in exact_levels(case))
    return Height(
        height=height,
        bands=case.bands,
        bem=bem,
        mdr=mdr,
        bem_over_linear=paired_samples(bem["linear level"], bem["level"], rng(0)),
        finer=paired_samples(bem["level"][: case.refined], finer["level"], rng(1)),
        springs={rule: sample(outcome["level"], rng(2 + j)) for j, (rule, outcome) in enumerate(mdr.items())},
        springs_over_linear=paired_samples(_positive(mdr["geike"]["linear level"]), mdr["geike"]["level"], rng(4)),
        exact_1d=exact_1d,
        exact_3d=exact_3d,
    )


def _positive(level: FloatArray) -> FloatArray:
    """Where (14.12) has nothing, its level is rounding's, which is no reference."""
    return np.maximum(level, 1e-300)


def exact_levels(case: ForceSpectrum) -> tuple[FloatArray, FloatArray]:
    """int C_F dq of linear theory over each band at h = d, over the force of Hertz squared: in 1D, in 3D."""
    spectrum = case.spectrum

    def in_1d(q: FloatArray) -> FloatArray:
        return rolling_theory.force_spectrum_1d(q, TrackSpectrum(spectrum, "geike"), contact_radius=1.0, modulus=1.0)

    def in_3d(q: FloatArray) -> FloatArray:
        return rolling_theory.force_spectrum_3d(q, spectrum.c2d, edges=spectrum.edges, contact_radius=1.0, modulus=1.0)

    return over_bands(in_1d, case.bands) / HERTZ**2, over_bands(in_3d, case.bands) / HERTZ**2


def over_bands(spectrum: rolling_theory.Spectrum, bands: Bands, points: int = 48) -> FloatArray:
    """Integrals over each band by the midpoint rule, with as many points in each."""
    edges = np.array(bands.edges)
    part = (np.arange(points) + 0.5) / points
    q = edges[:-1, np.newaxis] + np.diff(edges)[:, np.newaxis] * part
    return np.asarray(spectrum(q).mean(axis=1) * np.diff(edges))


def _exactly(value: float) -> Estimate:
    return Estimate(value, 0.0, 10**6)


def _numbers(mine: Height, ranges: dict[str, tuple[float, float]]) -> list[Number]:
    numbers = []
    for i, (where, (first, last)) in enumerate(ranges.items()):
        weights = mine.weights(first, last)
        role = Role.CRITERION if mine.height <= LOW else Role.FINDING
        numbers.append(mine.apart(LINEAR_3D, where, weights, role if i < 2 else Role.FINDING))
        if i > 0:
            numbers += [mine.apart(LINEAR_1D, where, weights), mine.departure(where, weights)]
        numbers += [mine.apart(model, where, weights) for model in (SPRINGS, FED_SPRINGS)]
    return [*numbers, *_moments(mine)]


def _moments(mine: Height) -> list[Number]:
    """Variance at one position over that of linear theory, the same in 1D and in 3D; the mean force."""
    numbers = []
    for name, outcome in (("bem3d", mine.bem), ("springs", mine.mdr["geike"])):
        ratio = ratio_of_means(outcome["variance"], outcome["linear variance"])
        numbers.append(
            Number(
                quantity=f"variance of the force over that of linear theory, h/d = {mine.height:g}: {name}",
                value=ratio.value,
                reference=1.0,
                source="Geike's rule keeps the variance of the force at one position",
                tolerance=0.1,
                reason="10 %: half a decibel",
                sample=ratio.half_width,
                role=Role.FINDING,
            )
        )
    bem, springs = mean_estimate(mine.bem["mean"]), mean_estimate(mine.mdr["geike"]["mean"])
    numbers.append(
        Number(
            quantity=f"mean force over that of Hertz, h/d = {mine.height:g}: springs beside bem3d",
            value=springs.value,
            reference=bem.value,
            source="bem3d",
            tolerance=0.02,
            reason="2 %: the force of a wheel is not known better",
            sample=springs.minus(bem).half_width,
            role=Role.FINDING,
        )
    )
    return numbers


def coherence(outcome: Outcome) -> FloatArray:
    """|<F F_lin*>|^2 / (<|F|^2> <|F_lin|^2>) in each band, over all waves and realisations."""
    cross = np.nansum(outcome["cross"][0] + 1j * outcome["cross"][1], axis=0)
    known = np.isfinite(outcome["level"])
    linear = np.where(known, outcome["linear level"], 0.0).sum(axis=0)
    return np.asarray(np.abs(cross) ** 2 / np.nansum(outcome["level"], axis=0) / np.maximum(linear, 1e-300))


def correlation(outcome: Outcome) -> tuple[float, float]:
    """Of the force with linear theory, position by position, in the bands: correlation and slope."""
    cross = float(np.nansum(outcome["cross"][0]))
    known = np.isfinite(outcome["level"])
    linear, level = float(outcome["linear level"][known].sum()), float(outcome["level"][known].sum())
    return cross / math.sqrt(linear * level), cross / linear


def _summary(result: RollingResult, mine: Height) -> Row:
    bem, springs = mine.bem, mine.mdr["geike"]
    (of_bem, slope), (of_springs, slope_1d) = correlation(bem), correlation(springs)
    return {
        "h / d": mine.height,
        "bem3d: correlation with linear": round(of_bem, 4),
        "slope": round(slope, 4),
        "springs: correlation with linear": round(of_springs, 4),
        "slope of springs": round(slope_1d, 4),
        "bem3d: variance over linear": round(ratio_of_means(bem["variance"], bem["linear variance"]).value, 4),
        "springs: variance over linear": round(
            ratio_of_means(springs["variance"], springs["linear variance"]).value, 4
        ),
        "bem3d: mean force over Hertz": round(float(np.nanmean(bem["mean"])), 5),
        "springs: mean force over Hertz": round(float(springs["mean"].mean()), 5),
        "applications a position": round(float(result.forces[mine.height]["applications"].mean()), 2),
        "springs examined a position": round(float(springs["examined"].mean()), 1),
    }


def _levels(case: ForceSpectrum, mine: Height) -> list[Row]:
    """One row a band: levels over (h/d)^2 and F_Hertz^2 in dB; errors of the models; coherence."""
    of_bem, of_springs = coherence(mine.bem), coherence(mine.mdr["geike"])
    waves = mine.bands.counts(2 * np.pi / case.length * np.arange(1, int(case.length * case.springs / 2)))
    rows: list[Row] = []
    for i, centre in enumerate(mine.bands.centres):
        weights = np.eye(len(mine.bands.centres))[i]
        bem, grid = mine.bem_level(weights)
        unit = POWER_DECIBEL * math.log(mine.exact_3d[i] / mine.height**2)
        row: Row = {
            "h/d": mine.height,
            "q a": float(centre),
            "from": mine.bands.edges[i],
            "to": mine.bands.edges[i + 1],
            "waves": float(waves[i] * np.isfinite(mine.bem["level"][:, i]).sum()),
            "bem3d [dB]": unit + POWER_DECIBEL * bem.value,
            "± sample [dB]": POWER_DECIBEL * bem.half_width,
            "± grid [dB]": POWER_DECIBEL * grid,
            "bem3d over linear 3D, as rolled [dB]": POWER_DECIBEL
            * mine.bem_over_linear.estimate(difference_of_halves(at_level(i, log_mean))).value,
            "coherence of bem3d": float(of_bem[i]),
            "coherence of springs": float(of_springs[i]) if mine.exact_1d[i] > 0 else math.nan,
        }
        for model in MODELS:
            level = mine.model_level(model, weights)
            row[f"{model} [dB]"] = unit + POWER_DECIBEL * level.value
            row[f"{model} over bem3d [dB]"] = POWER_DECIBEL * (level.value - bem.value)
        rows.append(row)
    return rows


def _narrow(result: RollingResult) -> Table:
    """Fig. 14.3: C_F over F_Hertz^2 a (h/d)^2, wave by wave, of the lowest roughness."""
    case, height = result.case, result.case.heights[0]
    springs = result.mdr["geike", height]
    q, spectrum = springs["wavenumber"], case.spectrum
    inside = (q > case.first / 2) & (q < case.last)
    q = q[inside]
    geike = TrackSpectrum(spectrum, "geike")
    exact = rolling_theory.force_spectrum_3d(q, spectrum.c2d, edges=spectrum.edges, contact_radius=1.0, modulus=1.0)
    return Table(
        "spectrum",
        columns(
            **{
                "q a": q,
                "(14.12)": rolling_theory.force_spectrum_1d(q, geike, contact_radius=1.0, modulus=1.0) / HERTZ**2,
                "(14.14)": rolling_theory.mean_force_spectrum_1d(q, geike, modulus=1.0) / HERTZ**2,
                "linear 3D": exact / HERTZ**2,
                "springs": springs["spectrum"][inside] / height**2,
            }
        ),
    )


def _forces(result: RollingResult) -> Table:
    """The force along some of the first strip, boundary elements beside linear theory."""
    case = result.case
    points = min(12 * case.cells, round(case.length * case.cells))
    rows: list[Row] = [
        {
            "h/d": height,
            "x / a": i / case.cells,
            "bem3d": float(found["force"][i]),
            "linear 3D": float(found["linear"][i]),
        }
        for height, found in result.forces.items()
        for i in range(points)
    ]
    return table_of("forces", rows)


def _conclusions(case: ForceSpectrum, found: list[Height], numbers: list[Number]) -> list[str]:
    by_label = {number.label: number for number in numbers}
    ranges = list(_ranges(case))
    sentences = []
    for where in ranges:
        chain = "; ".join(
            f"{mine.height:g}: {_signed(by_label[f'{LINEAR_3D} over bem3d, h/d = {mine.height:g}, {where}'])}"
            for mine in found
        )
        sentences.append(f"Linear theory in 3D over boundary elements, {where}, by h/d: {chain}.")
    for where in ranges[1:]:
        chain = "; ".join(
            f"{mine.height:g}: {_signed(by_label[f'{SPRINGS} over bem3d, h/d = {mine.height:g}, {where}'])}, fed for "
            f"rolling {_signed(by_label[f'{FED_SPRINGS} over bem3d, h/d = {mine.height:g}, {where}'])}"
            for mine in found
        )
        sentences.append(f"Springs of Geike's spectrum over boundary elements, {where}, by h/d: {chain}.")
    for where in ranges[1:]:
        chain = "; ".join(
            f"{n.label.split('h/d = ')[1].split(',')[0]}: {n.value:+.1f} and {n.reference:+.1f} dB ({n.verdict})"
            for n in numbers
            if n.label.startswith("nonlinear over linear") and where in n.label
        )
        sentences.append(
            f"Level of the nonlinear over the linear force, of springs and of boundary elements, {where}, by h/d: "
            f"{chain}."
        )
    holding = [_holding(model, found, by_label, ranges) for model in MODELS]
    return [*holding, *sentences, _lasting(found), _variances(numbers), _means(numbers), _scatter(found)]


def _holding(model: str, found: list[Height], by_label: dict[str, Number], ranges: list[str]) -> str:
    """Up to which height a model is within 1 dB of boundary elements, in the mean over each range."""
    parts = []
    for where in ranges:
        upto = "at no height"
        for mine in found:
            number = by_label.get(f"{model} over bem3d, h/d = {mine.height:g}, {where}")
            if number is None or number.verdict is not Verdict.AGREE:
                break
            upto = f"up to h/d = {mine.height:g}"
        parts.append(f"{where}: {upto}")
    return f"Within {ONE:g} dB of boundary elements in the mean over bands, {model}: {'; '.join(parts)}."


def _scatter(found: list[Height]) -> str:
    """What the sample leaves open in single bands."""
    parts = []
    for mine in found:
        errors = [mine.bem_level(np.eye(len(mine.bands.centres))[i])[0].error for i in range(len(mine.bands.centres))]
        parts.append(
            f"{mine.height:g}: {POWER_DECIBEL * max(errors):.2f} dB, "
            f"median {POWER_DECIBEL * float(np.median(errors)):.2f} dB"
        )
    return (
        "Standard error of the sample in single one-third octaves of boundary elements, largest, by h/d: "
        f"{'; '.join(parts)}."
    )


def _louder(case: ForceSpectrum, numbers: list[Number], where: str) -> Number:
    """By how much Geike's spectrum is too loud along the track, beside the power law without ends."""
    height = case.heights[0]
    found = next(n for n in numbers if n.label == f"{LINEAR_1D} over bem3d, h/d = {height:g}, {where}")
    return Number(
        quantity=f"Geike's spectrum, (14.12), over bem3d, h/d = {height:g}, {where}, beside q a >> 1",
        value=found.value,
        reference=-POWER_DECIBEL * math.log(rolling_theory.level_ratio(case.hurst)),
        source="sqrt(π) Γ(H + 2) / Γ(H + 3/2), an unbounded power law in linear theory",
        tolerance=0.5,
        unit="dB",
        reason="0.5 dB: the band ends, and q a is not infinite",
        grid=found.grid,
        sample=found.sample,
        role=Role.FINDING,
    )


def _signed(number: Number) -> str:
    return f"{number.value:+.1f} ± {number.uncertainty:.1f} dB ({number.verdict})"


def _lasting(found: list[Height]) -> str:
    """To which height the force is that of linear theory position by position, not only in its level."""
    parts = [
        f"{mine.height:g}: {np.count_nonzero(coherence(mine.bem) >= 0.9)} of {len(mine.bands.centres)} bands, "
        f"correlation {correlation(mine.bem)[0]:.3f}"
        for mine in found
    ]
    return (
        "Position by position linear theory is lost much earlier than in its level. Bands in which boundary elements "
        f"have a coherence of 0.9 and more with it, and correlation over all bands, by h/d: {'; '.join(parts)}."
    )


def _within(case: ForceSpectrum, found: list[Height]) -> Table:
    """In how many single one-third octaves each model lies within 1 and 3 dB of boundary elements."""
    rows: list[Row] = []
    for mine in found:
        inside = np.array(mine.bands.edges[1:]) > case.first * (1 + 1e-9)
        row: Row = {"h / d": mine.height}
        for model in MODELS:
            off = np.array([abs(_over(mine, model, i)) for i in range(inside.size)])
            for where, some in (("band", inside), ("below it", ~inside)):
                row[f"{model}, {where}"] = f"{(off[some] <= 1).sum()} and {(off[some] <= 3).sum()} of {some.sum()}"
        rows.append(row)
    return table_of("bands within 1 and within 3 dB of boundary elements", rows)


def _over(mine: Height, model: str, band: int) -> float:
    """A model over boundary elements in one band, in decibels."""
    weights = np.eye(len(mine.bands.centres))[band]
    return POWER_DECIBEL * (mine.model_level(model, weights).value - mine.bem_level(weights)[0].value)


def _variances(numbers: list[Number]) -> str:
    mine = [n for n in numbers if n.label.startswith("variance of the force")]
    parts = [f"{n.label.split('h/d = ')[1]} {n.value:.3f} ± {n.uncertainty:.3f} ({n.verdict})" for n in mine]
    return f"Variance of the force over that of linear theory, by h/d: {'; '.join(parts)}."


def _means(numbers: list[Number]) -> str:
    mine = [n for n in numbers if n.label.startswith("mean force")]
    parts = [
        f"{n.label.split('h/d = ')[1].split(':')[0]}: {n.value:.3f} and {n.reference:.3f} ({n.verdict})" for n in mine
    ]
    agree = [n for n in mine if n.verdict is Verdict.AGREE]
    return (
        f"Mean force over that of Hertz at the same approach, springs and boundary elements, by h/d: "
        f"{'; '.join(parts)}: within 2 % at {len(agree)} of {len(mine)} heights."
    )


def _captions(case: ForceSpectrum) -> dict[str, str]:
    return {
        "rolling-line": (
            f"Fig. 14.3 of the book, H = {case.hurst:g}: spectrum of the normal force over wavenumber. Line: (14.12); "
            f"dashed: its mean (14.14); dots: one-sided springs, mean of {case.tracks} tracks at h/d = "
            f"{case.heights[0]:g}; thick grey: linear theory in 3D of the isotropic surface, whose zeros fill in."
        ),
        "rolling": (
            "Level of the force in one-third octaves, over (h/d)² and the square of Hertz's force: circles: boundary "
            "elements with 95 % intervals of sample and grid; squares: one-sided springs of Geike's spectrum; solid "
            "line: linear theory in 3D; dashed: linear theory in 1D, (14.12), which has nothing below the band "
            "(shaded)."
        ),
        "rolling-coherence": (
            "(a) Coherence of the force with linear theory on the same roughness: filled, boundary elements; open, "
            "springs. (b) What nonlinearity does to the level: boundary elements over linear theory in 3D (filled), "
            "springs over (14.12) (open). Dark to light: h/d. (c) Force along a part of one strip at the lowest, a "
            "middle and the largest h/d: line, boundary elements; dotted, linear theory, in units of h/d about their "
            "means."
        ),
        "rolling-map": (
            "Validity: level of each model over that of boundary elements, in dB, over h/d and q a. Solid lines: ± 1 "
            "dB, dashed: ± 3 dB, hatched: 3 dB too low and more. Left of the vertical line, below the band, springs of "
            "Geike's spectrum have next to nothing."
        ),
    }


CASE = Case(
    name="rolling",
    chapter=Chapter.ROLLING,
    place=2,
    claim="One dimension has the force spectrum of a rolling wheel (Fig. 14.3).",
    answers="Fig. 14.3: rolling force over isotropic roughness, where each model holds",
    quick=ForceSpectrum(),
    full=ForceSpectrum(
        heights=(0.003, 0.01, 0.03, 0.1, 0.3, 1.0),
        last=20.0,
        lowest=0.22,
        length=256.0,
        width=32.0,
        cells=16,
        strips=6,
        rough_strips=8,
        refined=3,
        tracks=400,
    ),
    run=run,
    evidence=evidence,
    needs=model_needed.rolling,
)
