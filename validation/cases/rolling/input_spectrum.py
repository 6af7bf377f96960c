"""What springs should be fed for rolling: Geike's spectrum, the line trace, or one with the level along the track."""

import math
import warnings
from dataclasses import dataclass
from functools import cache, partial

import numpy as np
from numpy.typing import NDArray

import mdr
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Role, Table, Verdict, table_of
from validation.analysis.spectra import Bands
from validation.analysis.statistics import (
    POWER_DECIBEL,
    Estimate,
    Sample,
    at_level,
    difference_of_halves,
    log_mean,
    nearest,
    paired_samples,
    sample,
    weighted_mean,
)
from validation.cases.rolling.force_spectrum_evidence import REASON, over_bands
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import SERIAL, Engine, Outcome, random_generator
from validation.simulation.rolling_strip import (
    BOOTSTRAP,
    HERTZ,
    TRACKS,
    Strip,
    Tracks,
    roll_strip,
    roll_tracks,
    strip_levels,
)
from validation.simulation.rough_punch import (
    PunchRoughness,
    Surface,
    describe_failures,
    press_surface,
    require_converged,
    stacked,
)
from validation.simulation.track_spectrum import (
    INPUT_SPECTRA,
    InputSpectrum,
    PiecewisePowerLaw,
    TrackSpectrum,
    self_affine,
)
from validation.theory import rolling as rolling_theory

FloatArray = NDArray[np.float64]
Row = dict[str, object]

NAMES: dict[InputSpectrum, str] = {"geike": "Geike spectrum", "line": "line trace", "rolling": "rolling spectrum"}
FORD_THOMPSON = 3.0
"""dB in one-third octaves: how near springs come to a 3D analysis. Ford and Thompson, J. Sound Vib. 293 (2006)."""


@dataclass(frozen=True, kw_only=True)
class RollingInput:
    """Linear theory of springs by input, for many spectra; springs and boundary elements for those not derived for.

    last: q a of the end of all bands but the narrow one; heights: h_rms / d; length, width, cells, strips, tracks,
    springs, seed: as in `rolling`; punch_cells, surfaces, profiles: those of Fig. 14.1 that are pressed, H = 0.7.
    """

    last: float = 10.0
    heights: tuple[float, ...] = (0.03, 0.3)
    lowest: float = 0.4
    length: float = 64.0
    width: float = 16.0
    cells: int = 8
    strips: int = 4
    tracks: int = 40
    springs: int = 32
    punch_cells: int = 64
    surfaces: int = 12
    profiles: int = 200
    seed: int = 144

    @property
    def derived_for(self) -> dict[str, PiecewisePowerLaw]:
        """Power laws, for which the rule is a factor far from the ends of the band."""
        return {f"H = {hurst:g}": self_affine(hurst, 1.0, self.last) for hurst in (0.4, 0.7, 1.0)}

    @property
    def others(self) -> dict[str, PiecewisePowerLaw]:
        """Spectra that nobody had in mind."""
        return {
            "roll-off": PiecewisePowerLaw(edges=(0.25, 2.0, self.last), exponents=(0.0, 3.4)),
            "two power laws": PiecewisePowerLaw(edges=(1.0, 4.0, self.last), exponents=(2.4, 4.0)),
            "narrow band": PiecewisePowerLaw(edges=(4.0, 6.0), exponents=(0.0,)),
        }

    @property
    def spectra(self) -> dict[str, PiecewisePowerLaw]:
        """All of them."""
        return {**self.derived_for, **self.others}

    @property
    def bands(self) -> Bands:
        """One-third octaves from the lowest to the end of the bands, one of them around the first zero of sin(q a)."""
        return Bands.around(math.pi, self.lowest, self.last).on(self.length)

    @property
    def forces(self) -> tuple[float, ...]:
        """Fbar at which the punches are pressed."""
        return (0.03, 0.1, 0.3)

    @property
    def punch(self) -> PunchRoughness:
        """The punches of Fig. 14.1."""
        return PunchRoughness(hurst=0.7, waves=(1, self.punch_cells // 4), seed=self.seed)

    def within(self, spectrum: PiecewisePowerLaw) -> NDArray[np.bool_]:
        """Bands that lie in that of a spectrum."""
        edges = np.array(self.bands.edges)
        return np.asarray((edges[1:] > spectrum.edges[0] * 1.001) & (edges[:-1] < spectrum.edges[-1] * 0.999))


@dataclass(frozen=True, kw_only=True)
class PunchProfiles:
    """Profiles of the punches of Fig. 14.1, drawn from what a rule makes of their surfaces, pressed at all forces."""

    case: RollingInput
    input_spectrum: InputSpectrum


@dataclass(frozen=True)
class RollingInputResult:
    """Levels by spectrum and height of boundary elements, and by rule of springs; stiffness of punches."""

    case: RollingInput
    bem: dict[tuple[str, float], Outcome]
    mdr: dict[tuple[str, float, InputSpectrum], Outcome]
    punches: Outcome
    profiles: dict[InputSpectrum, Outcome]
    unconverged: tuple[str, ...]


def press_fed_profiles(profiles: PunchProfiles) -> Outcome:
    """k / (E* L) of each profile at each force; height: rms of the profiles over that of the surface."""
    case, punch = profiles.case, profiles.case.punch
    spectrum = PiecewisePowerLaw(edges=(2 * math.pi, math.pi / 2 * case.punch_cells), exponents=(2 * punch.hurst + 2,))
    points = 16 * case.punch_cells
    q = 2 * np.pi * np.arange(1.0, case.punch_cells // 4 + 1)

    # the side of the punch for the diameter of the contact
    c1d = TrackSpectrum(spectrum, profiles.input_spectrum, contact_radius=0.5)
    part = math.sqrt(float(c1d(q).sum() / TrackSpectrum(spectrum, "geike")(q).sum()))
    curves = [
        mdr.load_curve(
            mdr.rough_profile(
                c1d,
                length=1.0,
                points=points,
                rng=random_generator(case.seed, TRACKS, i),
                rms=punch.height * part,
            ),
            length=1.0,
            modulus=1.0,
        )
        for i in range(case.profiles)
    ]
    forces = punch.height * np.array(case.forces)
    with warnings.catch_warnings():
        # the lightest loads stand on few springs
        warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
        stiffness = [curve.at_force(forces).stiffness for curve in curves]
    return {"stiffness": np.array(stiffness), "height": np.array(part)}


def run(case: RollingInput, engine: Engine = SERIAL) -> RollingInputResult:
    """Roll over the spectra that the rule was not derived for, and over H = 0.7; press the punches."""
    spectra = {"H = 0.7": case.derived_for["H = 0.7"], **case.others}
    keys = [(name, height) for name in spectra for height in case.heights]
    strips = [
        Strip(
            spectrum=spectra[name],
            height=height,
            realisation=i,
            length=case.length,
            width=case.width,
            cells=case.cells,
            tolerance=min(1e-5, 1e-4 * height),
            seed=case.seed,
        )
        for name, height in keys
        for i in range(case.strips)
    ]
    outcomes = engine.map(roll_strip, strips)
    unconverged = tuple(
        f"strip {s.realisation}, h/d = {s.height:g}, {s.spectrum}: {int(o['failed'])} positions"
        for s, o in zip(strips, outcomes, strict=True)
        if o["failed"]
    )
    groups = {key: outcomes[i * case.strips : (i + 1) * case.strips] for i, key in enumerate(keys)}
    for key, group in groups.items():
        if sum(not o["failed"] for o in group) < 3:
            raise NotConvergedError(f"fewer than 3 strips converged of {key}", unconverged)
    tracks = [
        Tracks(
            spectrum=spectra[name],
            input_spectrum=rule,
            height=height,
            realisations=case.tracks,
            length=case.length,
            springs=case.springs,
            bands=case.bands,
            seed=case.seed,
        )
        for name, height in keys
        for rule in INPUT_SPECTRA
    ]
    on_springs = iter(engine.map(roll_tracks, tracks))
    surfaces = [
        Surface(roughness=case.punch, realisation=i, cells=case.punch_cells, forces=case.forces, tolerance=1e-4)
        for i in range(case.surfaces)
    ]
    pressed = engine.map(press_surface, surfaces)
    fed_profiles = engine.map(
        press_fed_profiles,
        [PunchProfiles(case=case, input_spectrum=rule) for rule in INPUT_SPECTRA],
    )
    require_converged([stacked(pressed)], describe_failures(surfaces, pressed))
    return RollingInputResult(
        case,
        {key: strip_levels(group, 1 / case.cells, case.bands) for key, group in groups.items()},
        {(name, height, rule): next(on_springs) for name, height in keys for rule in INPUT_SPECTRA},
        stacked(pressed),
        dict(zip(INPUT_SPECTRA, fed_profiles, strict=True)),
        (*unconverged, *describe_failures(surfaces, pressed)),
    )


def evidence(result: RollingInputResult) -> Evidence:
    """Linear errors band by band; springs beside boundary elements; the punches of Fig. 14.1."""
    case = result.case
    linear = [row for name, spectrum in case.spectra.items() for row in _linear(case, name, spectrum)]
    bands = table_of("bands", linear)
    numbers = [number for name in case.spectra for number in _linear_numbers(case, bands, name)]
    levels = {(*key, rule): _levels(result, *key, rule) for key in result.bem for rule in INPUT_SPECTRA}
    numbers += [_rolled(case, *key, mine) for key, mine in levels.items()]
    numbers += [_pressed(result, rule) for rule in INPUT_SPECTRA]
    nonlinear = [
        row
        for name, height in result.bem
        for row in _nonlinear(
            case,
            name,
            height,
            {rule: levels[name, height, rule] for rule in INPUT_SPECTRA},
        )
    ]
    rolled = table_of("rolled", nonlinear)
    verdicts = _within_three(case, bands)
    return Evidence(
        title="What springs should be fed for rolling",
        method=(
            "Three inputs to springs for one isotropic surface: Geike's spectrum, the line trace, and the rolling "
            "spectrum C_1D(q) = ∫ (1 + q²a²) / (1 + s²a²) C_2D(s) dk, s² = q² + k², which has the level along the "
            "track: a wave s that crosses the track at an angle acts as s and shows as q. First in linear theory, "
            "(14.12) beside the spectrum in 3D, both by quadrature, in one-third octaves of q a, for power laws and "
            "for spectra that the "
            f"rule was not derived for; then one-sided springs beside boundary elements ({case.strips} surfaces, "
            f"{case.cells} cells to a radius, {case.tracks} tracks) at h_rms / d = "
            f"{' and '.join(f'{h:g}' for h in case.heights)}"
            " (one grid; what it leaves open is in the case rolling); then the punches of Fig. 14.1 pressed with each "
            "input."
        ),
        numbers=tuple(numbers),
        tables=(bands, rolled, _punches(result), verdicts),
        conclusions=tuple(_conclusions(result, bands, rolled, numbers)),
        captions={
            "rolling_input": (
                "Level of (14.12), fed with each input, over that of linear theory in 3D, in one-third octaves; "
                "shaded: within 3 dB. No rule can mend the bands that hold the first zeros of sin(q a), at q a = π and "
                "2π: in 3D they are filled."
            ),
            "rolling_input-springs": (
                "One-sided springs over boundary elements, by input, in one-third octaves, with 95 % intervals of the "
                f"sample; left h/d = {case.heights[0]:g}, right {case.heights[-1]:g}. Shaded: within 3 dB."
            ),
            "rolling_input-punch": (
                "Fig. 14.1 with the same inputs: mean stiffness of punches, H = 0.7, in MDR over boundary elements, at "
                "three forces, with 95 % intervals; shaded: within 10 %. The line trace and the rolling spectrum leave "
                "out height."
            ),
        },
        unconverged=result.unconverged,
        page_tables=(verdicts,),
    )


@cache
def _exact(case: RollingInput, spectrum: PiecewisePowerLaw) -> FloatArray:
    """Levels of linear theory in 3D at h = d, over the force of Hertz squared."""

    def in_3d(q: FloatArray) -> FloatArray:
        return rolling_theory.force_spectrum_3d(q, spectrum.c2d, edges=spectrum.edges, contact_radius=1.0, modulus=1.0)

    return over_bands(in_3d, case.bands) / HERTZ**2


def _linear(case: RollingInput, name: str, spectrum: PiecewisePowerLaw) -> list[Row]:
    """One row a band: error of (14.12) with each input, in dB; minus infinity where it has nothing."""
    exact, edges = _exact(case, spectrum), case.bands.edges
    found = {}
    for rule in INPUT_SPECTRA:
        on_springs = partial(
            rolling_theory.force_spectrum_1d,
            c1d=TrackSpectrum(spectrum, rule),
            contact_radius=1.0,
            modulus=1.0,
        )
        level = over_bands(on_springs, case.bands)
        with np.errstate(divide="ignore", invalid="ignore"):
            found[rule] = POWER_DECIBEL * np.log(level / HERTZ**2 / exact)
    inside = case.within(spectrum)
    return [
        {
            "spectrum": name,
            "q a": float(centre),
            "in the band": bool(inside[i]),
            "first zero": bool(edges[i] < math.pi < edges[i + 1]),
            **{f"{NAMES[rule]} [dB]": float(found[rule][i]) for rule in INPUT_SPECTRA},
        }
        for i, centre in enumerate(case.bands.centres)
        if edges[i] < spectrum.edges[-1] * 0.999
    ]


def _linear_numbers(case: RollingInput, bands: Table, name: str) -> list[Number]:
    """The mean over the bands in that of the spectrum, and the worst of all bands but that of the first zero."""
    mine = bands.where(spectrum=name)
    inside, clear = mine["in the band"], ~mine["first zero"]
    source = "linear theory in 3D, by quadrature"
    numbers = []
    for rule in INPUT_SPECTRA:
        errors = mine[f"{NAMES[rule]} [dB]"]
        numbers.append(
            Number(
                quantity=f"linear, {name}, {NAMES[rule]}: mean level in the band",
                value=float(errors[inside].mean()),
                reference=0.0,
                source=source,
                tolerance=1.0,
                unit="dB",
                reason=REASON,
                role=Role.FINDING,
            )
        )
        everywhere = np.abs(errors[clear])
        if np.isfinite(everywhere).all():
            numbers.append(
                Number(
                    quantity=f"linear, {name}, {NAMES[rule]}: worst one-third octave but that of q a = π",
                    value=float(everywhere.max()),
                    reference=0.0,
                    source=source,
                    tolerance=FORD_THOMPSON,
                    unit="dB",
                    reason="3 dB: Ford and Thompson (2006)",
                    role=Role.FINDING,
                )
            )
    return numbers


def _within_three(case: RollingInput, bands: Table) -> Table:
    """How many of the one-third octaves lie within 3 dB, by spectrum and input."""
    rows: list[Row] = []
    for name in case.spectra:
        mine = bands.where(spectrum=name)
        row: Row = {"spectrum": name}
        for rule in INPUT_SPECTRA:
            errors = np.abs(mine[f"{NAMES[rule]} [dB]"])
            for part, where in (("in the band", mine["in the band"]), ("below", ~mine["in the band"])):
                row[f"{NAMES[rule]}, {part}"] = f"{int((errors[where] <= FORD_THOMPSON).sum())} of {int(where.sum())}"
        rows.append(row)
    return table_of("within 3 dB", rows)


@dataclass(frozen=True)
class _Levels:
    """ln of levels: boundary elements over linear theory in 3D on the same surfaces, springs; linear theory itself."""

    bem: Sample
    springs: Sample
    exact: FloatArray

    def apart(self, weights: FloatArray) -> Estimate:
        """Springs over boundary elements."""
        used = weights > 0
        reference = float(weights[used] @ np.log(self.exact[used]))
        springs = self.springs.estimate(weighted_mean(weights, log_mean))
        over = Estimate(springs.value - reference, springs.error, springs.samples)
        return over.minus(self.bem.estimate(difference_of_halves(weighted_mean(weights, log_mean))))


def _levels(result: RollingInputResult, name: str, height: float, rule: InputSpectrum) -> _Levels:
    """Of one spectrum, height and input."""
    case = result.case
    key = (list(case.spectra).index(name), case.heights.index(height), INPUT_SPECTRA.index(rule))
    bem, springs = result.bem[name, height], result.mdr[name, height, rule]
    return _Levels(
        paired_samples(bem["linear level"], bem["level"], random_generator(case.seed, BOOTSTRAP, *key, 0)),
        sample(np.maximum(springs["level"], 1e-300), random_generator(case.seed, BOOTSTRAP, *key, 1)),
        height**2 * _exact(case, case.spectra[name]),
    )


def _rolled(case: RollingInput, name: str, height: float, rule: InputSpectrum, levels: _Levels) -> Number:
    inside = case.within(case.spectra[name])
    apart = levels.apart(inside / inside.sum())
    return Number(
        quantity=f"springs over bem3d, {name}, h/d = {height:g}, {NAMES[rule]}: mean level in the band",
        value=POWER_DECIBEL * apart.value,
        reference=0.0,
        source="bem3d, relatively to linear theory on the same surfaces",
        tolerance=1.0,
        unit="dB",
        reason=REASON,
        sample=POWER_DECIBEL * apart.half_width,
        role=Role.FINDING,
    )


def _nonlinear(case: RollingInput, name: str, height: float, levels: dict[InputSpectrum, _Levels]) -> list[Row]:
    """One row a band: springs over boundary elements, by input."""
    rows: list[Row] = []
    for i, centre in enumerate(case.bands.centres):
        if case.bands.edges[i] >= case.spectra[name].edges[-1] * 0.999:
            continue
        row: Row = {"spectrum": name, "h/d": height, "q a": float(centre)}
        for rule, mine in levels.items():
            apart = mine.apart(np.eye(len(case.bands.centres))[i])
            row[f"{NAMES[rule]} [dB]"] = POWER_DECIBEL * apart.value
            row[f"{NAMES[rule]} ± [dB]"] = POWER_DECIBEL * apart.half_width
        rows.append(row)
    return rows


def _stiffness(result: RollingInputResult, rule: InputSpectrum) -> tuple[Sample, Sample]:
    case = result.case
    return (
        sample(
            result.profiles[rule]["stiffness"],
            random_generator(case.seed, BOOTSTRAP, 90, INPUT_SPECTRA.index(rule)),
        ),
        sample(result.punches["stiffness"], random_generator(case.seed, BOOTSTRAP, 91)),
    )


def _pressed(result: RollingInputResult, rule: InputSpectrum) -> Number:
    level = nearest(result.case.forces, 0.1)
    mdr_, bem = (one.estimate(at_level(level, log_mean)) for one in _stiffness(result, rule))
    apart = mdr_.minus(bem)
    return Number(
        quantity=f"mean stiffness of punches at Fbar = 0.1, MDR over bem3d, {NAMES[rule]}",
        value=math.expm1(apart.value),
        reference=0.0,
        source=f"bem3d on {result.case.punch_cells}² cells",
        tolerance=0.1,
        reason="10 %: what the grids of Fig. 14.1 leave open here",
        sample=math.exp(apart.value) * apart.half_width,
        role=Role.FINDING,
    )


def _punches(result: RollingInputResult) -> Table:
    rows: list[Row] = []
    for rule in INPUT_SPECTRA:
        mdr_, bem = _stiffness(result, rule)
        for level, force in enumerate(result.case.forces):
            apart = mdr_.estimate(at_level(level, log_mean)).minus(bem.estimate(at_level(level, log_mean)))
            middle, low, high = (math.exp(value) for value in apart.interval)
            rows.append({"input": NAMES[rule], "Fbar": force, "mdr over bem3d": middle, "low": low, "high": high})
    return table_of("punches", rows)


def _conclusions(result: RollingInputResult, bands: Table, rolled: Table, numbers: list[Number]) -> list[str]:
    case = result.case
    by_label = {number.label: number for number in numbers}

    def chain(start: str, end: str, names: list[str]) -> str:
        return "; ".join(f"{name}: {by_label[f'{start}{name}{end}'].value:+.1f} dB" for name in names)

    sentences = [
        f"In linear theory, mean level of springs over 3D in the band, fed with the {NAMES[rule]}: "
        f"{chain('linear, ', f', {NAMES[rule]}: mean level in the band', list(case.spectra))}."
        for rule in INPUT_SPECTRA
    ]
    for height in case.heights:
        for rule in INPUT_SPECTRA:
            found = chain(
                "springs over bem3d, ",
                f", h/d = {height:g}, {NAMES[rule]}: mean level in the band",
                ["H = 0.7", *case.others],
            )
            sentences.append(f"One-sided springs over boundary elements at h/d = {height:g}, {NAMES[rule]}: {found}.")
    counted = {rule: [abs(x) <= FORD_THOMPSON for x in bands[f"{NAMES[rule]} [dB]"].tolist()] for rule in INPUT_SPECTRA}
    sentences.append(
        "Springs within 3 dB of 3D in one-third octaves (Ford and Thompson 2006), both in linear theory: "
        + "; ".join(f"{NAMES[rule]}: {sum(inside)} of {len(inside)} bands" for rule, inside in counted.items())
        + ". It is a statement about springs that are fed what a line along the track shows, not about Geike's rule."
    )
    for height in case.heights:
        mine = rolled.where(**{"h/d": height})
        counts = {rule: np.abs(mine[f"{NAMES[rule]} [dB]"]) <= FORD_THOMPSON for rule in INPUT_SPECTRA}
        sentences.append(
            f"One-sided springs within 3 dB of boundary elements at h/d = {height:g}: "
            + "; ".join(f"{NAMES[rule]}: {inside.sum()} of {inside.size} bands" for rule, inside in counts.items())
            + "."
        )
    return [*sentences, _both(result, by_label)]


def _both(result: RollingInputResult, by_label: dict[str, Number]) -> str:
    """Whether one rule serves rolling and Fig. 14.1."""
    numbers = {
        rule: by_label[f"mean stiffness of punches at Fbar = 0.1, MDR over bem3d, {NAMES[rule]}"]
        for rule in INPUT_SPECTRA
    }
    punches = "; ".join(
        f"{NAMES[rule]}, {float(result.profiles[rule]['height']):.2f} of the height: {100 * number.value:+.0f} ± "
        f"{100 * number.uncertainty:.0f} % ({number.verdict})"
        for rule, number in numbers.items()
    )
    none = numbers["rolling"].verdict is Verdict.DIFFER and numbers["geike"].verdict is not Verdict.DIFFER
    answer = (
        "So no rule serves both: the punch needs the height of all waves that meet at one place, whatever their "
        "direction; rolling needs, for each wavenumber along the track, what the waves that show it do; and one number "
        "a wavenumber cannot be both."
        if none
        else "Whether one rule could serve both is not decided by this run."
    )
    return (
        "The punches of Fig. 14.1 at Fbar = 0.1, mean stiffness of MDR over boundary elements, by input: "
        f"{punches}. {answer}"
    )


CASE = Case(
    name="rolling_input",
    chapter=Chapter.ROLLING,
    place=3,
    claim="One dimension has it within 3 dB in one-third octaves, if it is fed for it.",
    answers="What MDR should be fed for rolling, and one-third octaves within 3 dB (Ford and Thompson 2006)",
    quick=RollingInput(),
    full=RollingInput(
        last=20.0,
        lowest=0.22,
        length=256.0,
        width=32.0,
        cells=16,
        strips=4,
        tracks=250,
        punch_cells=128,
        surfaces=60,
        profiles=500,
    ),
    run=run,
    evidence=evidence,
    needs="linear filter, 3D",
)
