"""Models of a rough interface without edges beside boundary elements: contact area, mean gap and stiffness by load."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise, repeat
from typing import Any

import numpy as np
from scipy.special import erfinv

from validation.analysis.evidence import Place
from validation.analysis.series import Estimates, Margin, Where, masked, single
from validation.analysis.statistics import DECIBEL, Estimate, FloatArray, Statistic, jackknifed, log_mean
from validation.case import SERIAL, Engine, Outcomes, Quantity, Series
from validation.cases.punch.ensembles import OVER, change, of_rows, press, with_solver
from validation.engine.engine import Outcome
from validation.simulation.interface import MdrInterface, press_interface, without_flat_punch
from validation.simulation.model_names import BEM
from validation.simulation.model_names import SPRINGS as MDR
from validation.simulation.rough_punch import RolledOffRoughness, Surface, require_converged
from validation.simulation.track_spectrum import PiecewisePowerLaw
from validation.theory.closed_forms import SQUARE_PUNCH
from validation.theory.interface import (
    KAPPA_BUSH_GIBSON_THOMAS,
    KAPPA_PERSSON,
    YANG_AND_PERSSON,
    Barber,
    BearingArea,
    BushGibsonThomas,
    GreenwoodWilliamson,
    InterfaceModel,
    MeasuredGap,
    Persson,
    RoughnessSpectrum,
    TailFormula,
    quantities_of,
)

Left = Sequence[Estimate | float]
"""What the grid leaves at each load, as `grid` of a series."""
Ground = tuple[int, float]
"""Waves of the roll-off on a side, and H."""


@dataclass(frozen=True, kw_only=True)
class Interface:
    """Roughness with a plateau from the longest wave, L, to the roll-off, self-affine beyond; in units of L = E* = 1.

    grounds: q_r L / 2 pi and H; pressed: the one that is under a punch too; band: q_max / q_r; contacts:
    the contact fraction that Persson's theory has under each load, ascending; surfaces: of each; refined: the first of
    them, on twice as many cells a side; profiles, points: of springs; height: h / L; tolerance: residual of the solver;
    seed: zero or positive.
    """

    grounds: tuple[Ground, ...] = ((8, 0.7), (4, 0.7))
    pressed: Ground = (4, 0.7)
    band: int = 4
    contacts: tuple[float, ...] = (3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.2)
    surfaces: int = 24
    refined: int = 12
    profiles: int = 200
    points: int = 2048
    height: float = 1e-3
    tolerance: float = 1e-4
    seed: int = 142

    def roughness(self, ground: Ground) -> RolledOffRoughness:
        first, hurst = ground
        waves = (1, self.band * first)
        return RolledOffRoughness(hurst=hurst, waves=waves, roll_off=first, height=self.height, seed=self.seed)

    def spectrum(self, ground: Ground) -> PiecewisePowerLaw:
        """Of unit height."""
        roll_off, hurst = ground
        edges = tuple(2 * math.pi * waves for waves in (1, roll_off, self.band * roll_off))
        return PiecewisePowerLaw(edges=edges, exponents=(0.0, 2 * hurst + 2))

    def pressures(self, ground: Ground) -> FloatArray:
        """p / E* at which Persson's contact fraction is erf(sqrt(2) p / (E* g)), over h: Fbar of the punch."""
        return np.asarray(self.spectrum(ground).gradient * erfinv(self.contacts) / math.sqrt(2))

    def drawn(self, ground: Ground) -> RoughnessSpectrum:
        """The discrete PSD of the surfaces, of which all realisations have the same."""
        cells = 4 * self.band * ground[0]
        return RoughnessSpectrum.of_heights(self.roughness(ground).surface(cells, 0), spacing=1 / cells)

    def springs(self, ground: Ground) -> MdrInterface:
        return MdrInterface(roughness=self.roughness(ground), realisations=self.profiles, points=self.points)

    @property
    def per_cent(self) -> tuple[float, ...]:
        """The contacts."""
        return tuple(round(100 * contact, 6) for contact in self.contacts)

    def slopes(self, ground: Ground) -> Statistic:
        """d ln K / d ln p from each load to the next."""
        steps = np.diff(np.log(self.pressures(ground)))
        return lambda mean, deviation: np.asarray(np.diff(np.log(mean)) / steps)

    def beside_heavier(self, ground: Ground) -> Statistic:
        """ln of K / p over that of the contact LIGHT."""
        pressures, heavier = self.pressures(ground), self.contacts.index(LIGHT)
        return lambda mean, deviation: np.asarray(np.log(mean / pressures) - np.log(mean / pressures)[heavier])

    @property
    def forces(self) -> tuple[float, ...]:
        """Fbar of the punch."""
        return tuple(self.pressures(self.pressed).tolist())

    @property
    def cells(self) -> int:
        """On a side of the punch, four to the shortest wave."""
        return 4 * self.band * self.pressed[0]

    def surfaces_of(self, ground: Ground) -> dict[tuple[Ground, int], list[Surface]]:
        """On four cells to the shortest wave, and the first of them on eight."""
        of_ground = partial(
            Surface,
            roughness=self.roughness(ground),
            forces=tuple(self.pressures(ground).tolist()),
            tolerance=self.tolerance,
        )
        return {
            (ground, finer): [of_ground(realisation=i, cells=4 * finer * self.band * ground[0]) for i in range(count)]
            for finer, count in ((1, self.surfaces), (2, self.refined))
        }


def run(case: Interface, engine: Engine = SERIAL) -> Outcomes:
    """Outcomes by ground and how many times finer the grid is; punch by "punch", springs by MDR and ground."""
    grounds = {key: surfaces for ground in case.grounds for key, surfaces in case.surfaces_of(ground).items()}
    punches = {(PUNCH, finer): surfaces for (_, finer), surfaces in case.surfaces_of(case.pressed).items()}
    springs = {(MDR, g): case.springs(g).profiles(case.height * case.pressures(g)) for g in case.grounds}
    interfaces, _, lost = press(engine, grounds, {}, press_interface)
    punched, mdr, lost_too = press(engine, punches, springs)
    return Outcomes(case, {**interfaces, **punched, **mdr}, (*lost, *lost_too))


LIGHT = 0.1
"""Contact up to which the stiffness is proportional in theory; one of the contacts."""
VANISHING = 3.0
"""Per cent of contact up to which kappa is that of light loads."""
PUNCH = "punch"
FITTED, UNFITTED = (f"Persson, γ = {gamma:g}" for gamma in (YANG_AND_PERSSON, 1.0))
ASPERITIES = GreenwoodWilliamson.name, BushGibsonThomas.name
TAIL, BEARING, BARBER = TailFormula.name, BearingArea.name, Barber.name
ON_PUNCH, SERIES = "boundary elements, punch", "interface and flat punch in series"
ROLL_OFF, CONTACT = "q_r L / 2π", "contact in Persson's theory [%]"
KAPPA, KAPPA_LIGHT = Quantity("A_E_g_over_p", "A E* g / (L² p)"), Quantity("kappa", "κ")
GAP_OVER_H = Quantity("mean_gap_over_h")
SCALED, SCALED_PUNCH = Quantity("K_h_over_p"), Quantity("k_h_over_F")
AREA_OVER = Quantity("contact_area_over_that_of_boundary_elements")
GAP_OVER = Quantity("mean_gap_over_that_of_boundary_elements")
BESIDE_BEM = Quantity("K_over_that_of_boundary_elements")
COMPARED = AREA_OVER, GAP_OVER, BESIDE_BEM
STIFFNESS, EXPONENT = "stiffness", Quantity("exponent_of_K_over_p")
OVER_LOAD = f"K over p beside that at {100 * LIGHT:g} % contact"
OF_SERIES = Quantity("k_over_that_of_interface_and_flat_punch_in_series")
OF_HALF = Quantity("K_h_over_p_beside_that_of_half_as_many_waves")
BOUNDED = Quantity("share_of_loads_within_the_bounds_of_K")
ENOUGH_WAVES = 8
"""A period: fewer leave more of the lightest loads to the highest summit alone."""
LEFT_OF_CORRECTION = 0.25
"""Part of the perimeter correction of the contact area that is uncertain: by grids four times as fine."""
MOST_SPRINGS = 0.9
"""Share of springs that touch up to which MDR is compared: beyond, its flat punch is all but all of its compliance."""
DECIBELS: Mapping[str, Any] = {"scale": DECIBEL, "unit": "dB", "shown": lambda level: math.exp(level / DECIBEL)}
ONE: Mapping[str, Any] = {"reference": 1.0}
NEAR = Margin(
    DECIBEL * math.log(1.1),
    "10 %: 0.8 dB, less than the 1 dB within which measured levels of rolling repeat",
    source="boundary elements",
)
PROPORTIONAL = Margin(
    math.log10(1.1),
    "0.04: K over p changes by 10 % in a decade of load",
    source="K ~ p: Persson (2007); Akarapu, Sharp and Robbins (2011); Campana, Persson and Müser (2011)",
)
BETWEEN = Margin(
    (KAPPA_BUSH_GIBSON_THOMAS - KAPPA_PERSSON) / 2,
    f"half of the way from {KAPPA_PERSSON:.3f} of Persson to {KAPPA_BUSH_GIBSON_THOMAS:.3f} of Bush, Gibson and Thomas",
    source="the middle between Persson (2001) and Bush, Gibson and Thomas (1975)",
)


@dataclass(frozen=True)
class Measured:
    """One ground on cells of two sizes."""

    coarse: Outcome
    fine: Outcome

    def __iter__(self) -> Iterator[Outcome]:
        return iter((self.coarse, self.fine))

    def of(self, *names: str, statistic: Statistic = log_mean) -> tuple[Estimates, Estimates]:
        """ln of the mean, by default, at zero cell size at each load, and the changes that leave its grid error.

        names: an outcome, or several, which stand behind each other along the first axis of what the statistic has.
        """
        coarse, fine = (self._rows(on, *names or ("stiffness",)) for on in self)
        finer = change(statistic, coarse, fine)
        return Estimates(jackknifed(partial(of_rows, statistic), coarse)).extrapolate_to_zero(finer), finer

    def corrected(self, *names: str, statistic: Statistic = log_mean) -> tuple[Estimates, Left]:
        """As `of` with the corrected area of the finer grid, and what that leaves open: a part of the correction."""
        coarse, fine = (self._rows(on, "corrected", *names) for on in self)
        values = Estimates(jackknifed(partial(of_rows, statistic), coarse)) + change(statistic, coarse, fine)
        counted, area = (np.nanmean(self.fine[name], axis=0) for name in ("area", "corrected"))
        return values, np.log1p(LEFT_OF_CORRECTION * (counted - area) / area).tolist()

    @staticmethod
    def _rows(outcome: Outcome, *names: str) -> FloatArray:
        return outcome[names[0]] if len(names) == 1 else np.stack([outcome[name] for name in names], axis=1)

    def gap(self, pressures: FloatArray) -> MeasuredGap:
        return MeasuredGap(tuple(pressures.tolist()), tuple(np.exp(self.of("gap")[0].values).tolist()))


def series(result: Outcomes) -> list[Series]:
    """Raises NotConvergedError where too few surfaces have converged under one of the loads."""
    case = result.case
    require_converged([o for key, o in result.by_key.items() if key[0] != MDR], result.unconverged)
    grounds = {g: Measured(result[g, 1], result[g, 2]) for g in case.grounds}
    rows = [s for g, measured in grounds.items() for s in _of_interface(case, g, measured, result[MDR, g])]
    inside = np.concatenate([_within_bounds(case, ground, result[ground, 1]) for ground in case.grounds])
    exact = "contact areas only grow with the load: Barber (2003)"
    rows.append(single(BOUNDED, BEM, float(inside.mean()), 1e-9, exact, "a theorem", 1.0))
    for ground, more in grounds.items():
        fewer = ground[0] // 2, ground[1]
        if half := grounds.get(fewer):
            loads = Estimates.exact(np.log(case.pressures(ground) / case.pressures(fewer)))
            ratios, finer = (value - reference for value, reference in zip(more.of(), half.of(), strict=True))
            rows += _at_each_load(case, ground, OF_HALF, BEM, ratios - loads, finer)
    punch = Measured(result[PUNCH, 1], result[PUNCH, 2])
    return rows + list(_of_punch(case, grounds[case.pressed], punch, result[MDR, case.pressed]))


def _within_bounds(case: Interface, ground: Ground, outcome: Outcome) -> FloatArray:
    """Whether K is within `Barber.stiffness_bounds`, of each surface and load that converged."""
    p, inside = case.height * case.pressures(ground), []
    for highest, full, k, gap in zip(*(outcome[name] for name in ("highest", "full", "stiffness", "gap")), strict=True):
        least, most = Barber(float(highest), float(full)).stiffness_bounds(p, gap)
        inside.append(((least <= k) & (k <= most))[np.isfinite(k)])
    return np.concatenate(inside)


def models_of(case: Interface, ground: Ground, measured: Measured) -> tuple[InterfaceModel, ...]:
    """The models of this ground but for MDR, in units of L = E* = 1; the last two have the measured gap."""
    spectrum, gap = case.drawn(ground), measured.gap(case.height * case.pressures(ground))
    return (
        Persson(spectrum, 1.0),
        Persson(spectrum, 1.0, gamma=1.0),
        GreenwoodWilliamson(spectrum, 1.0),
        BushGibsonThomas(spectrum, 1.0),
        TailFormula(spectrum.height, gap),
        BearingArea(spectrum.height, gap),
    )


@dataclass(frozen=True)
class Compared:
    """A quantity of boundary elements: ln of it at each load, what the grid leaves, and what divides it in figures."""

    quantity: Quantity
    over: Quantity
    values: Estimates
    left: Left
    unit: FloatArray


def _compared(measured: Measured, p: FloatArray, spectrum: RoughnessSpectrum) -> dict[str, Compared]:
    """By the methods of an interface model."""
    h = spectrum.height
    return {
        "area_fraction": Compared(KAPPA, AREA_OVER, *measured.corrected(), p / spectrum.gradient),
        "mean_gap": Compared(GAP_OVER_H, GAP_OVER, *measured.of("gap"), np.full(p.shape, h)),
        "stiffness": Compared(SCALED, BESIDE_BEM, *measured.of("stiffness"), p / h),
    }


def _of_interface(case: Interface, ground: Ground, measured: Measured, springs: Outcome) -> Iterator[Series]:
    """Area, gap and stiffness along the loads, all models beside boundary elements load by load, and exponents."""
    p, spectrum = case.height * case.pressures(ground), case.drawn(ground)
    shown = partial(Series, where=_where(ground), along=CONTACT, at=case.per_cent, shown=math.exp)
    compared = _compared(measured, p, spectrum)
    for one in compared.values():
        left = [*map(with_solver, one.left)] if one.quantity == SCALED else one.left
        yield shown(one.quantity, BEM, one.values - Estimates.exact(np.log(one.unit)), grid=left)
    yield from _kappa(case, ground, compared["area_fraction"])
    bound = Barber(float(measured.coarse["highest"].mean()), math.inf)
    yield shown(SCALED, bound.name, np.log(bound.stiffness(p) * spectrum.height / p))
    for model in models_of(case, ground, measured):
        for name in quantities_of(model):
            if (name, model.name) == ("area_fraction", UNFITTED):
                continue  # which does not depend on gamma
            one, theory = compared[name], getattr(model, name)(p)
            # asperity models close the gap and more under loads beyond their range
            positive = np.where(theory > 0, theory, np.nan)
            yield shown(one.quantity, model.name, np.log(positive / one.unit))
            over, left = Estimates.exact(np.log(positive)) - one.values, one.left
            if isinstance(model, TailFormula | BearingArea):
                over, left = _with_measured_gap(measured, name, model, p)
            yield from _at_each_load(case, ground, one.over, model.name, over, left)
        if isinstance(model, Persson):
            theory = model.stiffness(p)
            slopes = case.slopes(ground)(theory, theory)
            yield from _at_each_load(case, ground, EXPONENT, model.name, slopes, margin=None)
    yield from _of_springs(case, ground, compared["stiffness"], springs)
    slope = case.slopes(ground)
    yield from _at_each_load(case, ground, EXPONENT, BEM, *measured.of(statistic=slope), PROPORTIONAL)
    ratios, finer = measured.of(statistic=case.beside_heavier(ground))
    yield from _at_each_load(case, ground, OVER_LOAD, BEM, masked(ratios, np.array(case.contacts) < LIGHT), finer)


def _of_springs(case: Interface, ground: Ground, one: Compared, springs: Outcome) -> Iterator[Series]:
    """MDR without its flat punch, while no more than most of the springs touch."""
    alone = Estimates(jackknifed(lambda rows: np.log(without_flat_punch(rows.mean(axis=0))), springs["stiffness"]))
    alone = Estimates(masked(alone, springs["stiffness"].mean(axis=0) < MOST_SPRINGS))
    over_unit = alone - Estimates.exact(np.log(one.unit))
    yield Series(one.quantity, MDR, over_unit, where=_where(ground), along=CONTACT, at=case.per_cent, shown=math.exp)
    yield from _at_each_load(case, ground, one.over, MDR, alone - one.values, one.left)


def _with_measured_gap(
    measured: Measured, name: str, model: TailFormula | BearingArea, p: FloatArray
) -> tuple[Estimates, Left]:
    """ln of a quantity of a model with the measured gap over that of boundary elements, and what the grid leaves.

    The sampling errors of both are those of one ratio.
    """

    def ratio(mean: FloatArray, deviation: FloatArray) -> FloatArray:
        value, gap = mean
        at_gap = replace(model, gap=MeasuredGap(tuple(p.tolist()), tuple(gap.tolist())))
        return np.asarray(np.log(getattr(at_gap, name)(p) / value))

    if name == "area_fraction":
        return measured.corrected("gap", statistic=ratio)
    return measured.of(name, "gap", statistic=ratio)


def _kappa(case: Interface, ground: Ground, area: Compared) -> Iterator[Series]:
    """kappa = A E* g / (L^2 p) at each light load, beside the range of the theories."""
    values = area.values - Estimates.exact(np.log(area.unit))
    for place, value, half in zip(case.per_cent, values, area.left, strict=True):
        if place <= VANISHING:
            kappa = math.exp(value.value)
            estimate = Estimate(kappa, kappa * value.error, value.samples)
            where, family = {**_where(ground), CONTACT: place}, len(case.per_cent) * len(case.grounds)
            middle = (KAPPA_PERSSON + KAPPA_BUSH_GIBSON_THOMAS) / 2
            yield Series(
                KAPPA_LIGHT,
                BEM,
                (estimate,),
                where=where,
                grid=(kappa * math.expm1(float(half)),),  # type: ignore[arg-type]
                reference=middle,
                margin=BETWEEN,
                family=family,
            )


def _of_punch(case: Interface, interface: Measured, punch: Measured, springs: Outcome) -> Iterator[Series]:
    """Stiffness of the punch over its load, of its interface in series with the flat one, and of springs, by load."""
    ground, forces, slope = case.pressed, np.array(case.forces), case.slopes(case.pressed)
    shown = partial(Series, where=_where(ground), along=CONTACT, at=case.per_cent, shown=math.exp)
    (on_punch, finer), over = punch.of("stiffness"), Estimates.exact(np.log(forces))
    logs = Estimates(jackknifed(partial(of_rows, log_mean), springs["stiffness"]))
    yield shown(SCALED_PUNCH, ON_PUNCH, on_punch - over, grid=[*map(with_solver, finer)])
    yield shown(SCALED_PUNCH, MDR, logs - over)
    yield from _at_each_load(case, ground, STIFFNESS, OVER, logs - on_punch, finer)
    yield from _at_each_load(case, ground, EXPONENT, ON_PUNCH, *punch.of(statistic=slope), None)
    slopes = Estimates(jackknifed(partial(of_rows, slope), springs["stiffness"]))
    yield from _at_each_load(case, ground, EXPONENT, MDR, slopes, margin=None)
    alone = np.exp(interface.of()[0].values)
    yield shown(SCALED_PUNCH, SERIES, -np.log(forces * (1 / alone + 1 / SQUARE_PUNCH)))
    coarse, fine = (np.stack([p["stiffness"], i["stiffness"]], axis=1) for p, i in zip(punch, interface, strict=True))
    both = np.stack([coarse[: len(fine)], fine], axis=1)
    finer = Estimates(jackknifed(lambda rows: _over_series(rows[:, 1]) - _over_series(rows[:, 0]), both))
    ratios = Estimates(jackknifed(_over_series, coarse)).extrapolate_to_zero(finer)
    yield from _at_each_load(case, ground, OF_SERIES, BEM, ratios, finer)


def _over_series(rows: FloatArray) -> FloatArray:
    """ln of the mean k over that of the mean K in series with the flat punch; rows: k and K of each surface."""
    k, alone = rows.mean(axis=0)
    return np.asarray(np.log(k * (1 / alone + 1 / SQUARE_PUNCH)))


def _at_each_load(
    case: Interface,
    ground: Ground,
    quantity: str,
    model: str,
    values: Iterable[Estimate | float],
    finer: Iterable[Estimate | float] = repeat(0.0),
    margin: Margin | None = NEAR,
) -> Iterator[Series]:
    """A number at each load; of exponents for each step between light loads."""
    places: Sequence[Place] = [step for step in pairwise(case.per_cent) if step[1] <= 100 * LIGHT]
    places, unit = (places, ONE) if quantity == EXPONENT else (case.per_cent, DECIBELS)
    # the solver leaves a part of the stiffness, from which area and gap do not follow
    lefts = finer if quantity in (AREA_OVER, GAP_OVER) else map(with_solver, finer)
    for place, value, left in zip(places, values, lefts, strict=False):
        where: Where = {**_where(ground), CONTACT: place}
        family = len(places) * len(case.grounds)
        yield Series(quantity, model, (value,), where=where, grid=(left,), margin=margin, family=family, **unit)


def _where(ground: Ground) -> Where:
    return dict(zip((ROLL_OFF, "H"), map(float, ground), strict=True))
