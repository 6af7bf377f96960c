"""The stiffness of a rough interface without edges, beside Persson's theory; the same roughness on a punch and MDR."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
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
from validation.simulation.interface import press_interface
from validation.simulation.model_names import BEM
from validation.simulation.model_names import SPRINGS as MDR
from validation.simulation.rough_punch import Profiles, RolledOffRoughness, Surface, require_converged
from validation.simulation.track_spectrum import PiecewisePowerLaw
from validation.theory.closed_forms import SQUARE_PUNCH
from validation.theory.interface import YANG_AND_PERSSON, persson_stiffness

Ground = tuple[int, float]
"""Waves of the roll-off on a side, and H."""


@dataclass(frozen=True, kw_only=True)
class Interface:
    """Roughness with a plateau from the longest wave, L, to the roll-off, self-affine beyond; in units of L = E* = 1.

    grounds: q_r L / 2 pi and H; pressed: the one that is on a punch and on springs too; band: q_max / q_r; contacts:
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
    """Outcomes by ground and how many times finer the grid is, for the punch by "punch" and for the springs by MDR."""
    grounds = {key: surfaces for ground in case.grounds for key, surfaces in case.surfaces_of(ground).items()}
    punches = {(PUNCH, finer): surfaces for (_, finer), surfaces in case.surfaces_of(case.pressed).items()}
    springs = Profiles(
        roughness=case.roughness(case.pressed),
        realisations=case.profiles,
        points=case.points,
        length=1.0,
        forces=case.forces,
    )
    interfaces, _, lost = press(engine, grounds, {}, press_interface)
    punched, mdr, lost_too = press(engine, punches, {MDR: springs})
    return Outcomes(case, {**interfaces, **punched, **mdr}, (*lost, *lost_too))


LIGHT = 0.1
"""Contact up to which the stiffness is proportional in theory; one of the contacts."""
PUNCH, BARBER = "punch", "at the least (Barber)"
GAMMAS = {f"Persson, γ = {gamma:g}": gamma for gamma in (YANG_AND_PERSSON, 1.0)}
FITTED, UNFITTED = GAMMAS
EDGELESS, ON_PUNCH, SERIES = (
    "boundary elements, interface",
    "boundary elements, punch",
    "interface and flat punch in series",
)
ROLL_OFF, CONTACT = "q_r L / 2π", "contact in Persson's theory [%]"
STIFFNESS, AREA, GAP = "stiffness", Quantity("contact_fraction"), Quantity("mean_gap")
SCALED, SCALED_PUNCH = Quantity("K_h_over_p"), Quantity("k_h_over_F")
FRACTION, GAP_OVER_H = Quantity("contact_fraction_A_over_L²"), Quantity("mean_gap_over_h")
EXPONENT, BESIDE_BEM = Quantity("exponent_of_K_over_p"), Quantity("K_over_that_of_boundary_elements")
OVER_LOAD = f"K over p beside that at {100 * LIGHT:g} % contact"
OF_SERIES = Quantity("k_over_that_of_interface_and_flat_punch_in_series")
OF_HALF = Quantity("K_h_over_p_beside_that_of_half_as_many_waves")
BOUNDED = Quantity("share_of_loads_above_Barber's_least_K")
ENOUGH_WAVES = 8
"""A period: fewer leave more of the lightest loads to the highest summit alone."""
ZERO_GAP = 1e-12
DECIBELS: Mapping[str, Any] = {"scale": DECIBEL, "unit": "dB"}
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


@dataclass(frozen=True)
class Measured:
    """One ground on cells of two sizes."""

    coarse: Outcome
    fine: Outcome

    def __iter__(self) -> Iterator[Outcome]:
        return iter((self.coarse, self.fine))

    def of(self, name: str = "stiffness", statistic: Statistic = log_mean) -> tuple[Estimates, Estimates]:
        """ln of the mean, by default, on cells of no size at each load, and the changes that leave its grid error."""
        finer = change(statistic, self.coarse[name], self.fine[name])
        return Estimates(jackknifed(partial(of_rows, statistic), self.coarse[name])).extrapolate_to_zero(finer), finer


def series(result: Outcomes) -> list[Series]:
    """Raises NotConvergedError where too few surfaces have converged under one of the loads."""
    case = result.case
    require_converged([o for key, o in result.by_key.items() if key != MDR], result.unconverged)
    grounds = {g: Measured(result[g, 1], result[g, 2]) for g in case.grounds}
    rows = [s for ground, measured in grounds.items() for s in _of_interface(case, ground, measured)]
    inside = [result[g, 1]["stiffness"] * result[g, 1]["highest"][:, np.newaxis] for g in case.grounds]
    shares = [np.mean(k > case.height * case.pressures(g)) for k, g in zip(inside, case.grounds, strict=True)]
    exact = "no load path leaves those of the smooth faces shifted by the extreme heights: Barber (2003)"
    rows.append(single(BOUNDED, BEM, float(np.mean(shares)), 1e-9, exact, "a theorem", 1.0))
    for ground, more in grounds.items():
        fewer = ground[0] // 2, ground[1]
        if half := grounds.get(fewer):
            loads = Estimates.exact(np.log(case.pressures(ground) / case.pressures(fewer)))
            ratios, finer = (value - reference for value, reference in zip(more.of(), half.of(), strict=True))
            rows += _at_each_load(case, ground, OF_HALF, BEM, ratios - loads, finer)
    punch = Measured(result[PUNCH, 1], result[PUNCH, 2])
    return rows + list(_of_punch(case, grounds[case.pressed], punch, result[MDR]))


def _of_interface(case: Interface, ground: Ground, measured: Measured) -> Iterator[Series]:
    """K h / p along the loads, theory beside it load by load, and the exponents of both from load to load."""
    over_h, where = case.pressures(ground), _where(ground)
    stiffness, finer = measured.of()
    shown = partial(Series, SCALED, where=where, along=CONTACT, at=case.per_cent, shown=math.exp)
    yield shown(BEM, stiffness - Estimates.exact(np.log(over_h)), grid=[*map(with_solver, finer)])
    yield shown(BARBER, np.full(over_h.size, math.log(case.height / float(measured.coarse["highest"].mean()))))
    spectrum = case.spectrum(ground)
    for model, gamma in GAMMAS.items():
        theory = persson_stiffness(over_h, c2d=spectrum.c2d, edges=spectrum.edges, modulus=1.0, gamma=gamma)
        yield shown(model, np.log(theory / over_h))
        yield from _at_each_load(case, ground, BESIDE_BEM, model, Estimates.exact(np.log(theory)) - stiffness, finer)
        yield from _at_each_load(case, ground, EXPONENT, model, case.slopes(ground)(theory, theory), margin=None)
    yield from _at_each_load(case, ground, EXPONENT, BEM, *measured.of(statistic=case.slopes(ground)), PROPORTIONAL)
    ratios, finer = measured.of(statistic=case.beside_heavier(ground))
    yield from _at_each_load(case, ground, OVER_LOAD, BEM, masked(ratios, np.array(case.contacts) < LIGHT), finer)


def _of_punch(case: Interface, interface: Measured, punch: Measured, springs: Outcome) -> Iterator[Series]:
    """The punch, its interface in series with the flat punch, and springs, load by load."""
    ground, forces, slope = case.pressed, np.array(case.forces), case.slopes(case.pressed)
    shown = partial(Series, where=_where(ground), along=CONTACT, at=case.per_cent, shown=math.exp)
    drawn: dict[str, tuple[str, FloatArray | float]] = {
        "stiffness": (SCALED_PUNCH, forces),
        "area": (FRACTION, 1.0),
        "gap": (GAP_OVER_H, case.height),
    }
    for (name, (quantity, unit)), judged in zip(drawn.items(), (STIFFNESS, AREA, GAP), strict=True):
        # zero where all springs touch, which leaves no ratio; its digits are rounding
        values = np.where(springs[name] > ZERO_GAP, springs[name], 0.0)
        logs = Estimates(jackknifed(partial(of_rows, log_mean), values))
        (on_punch, finer), (edgeless, left) = punch.of(name), interface.of(name)
        over = Estimates.exact(np.log(unit * np.ones(forces.size)))
        yield shown(quantity, ON_PUNCH, on_punch - over, grid=[*map(with_solver, finer)])
        yield shown(quantity, MDR, logs - over)
        if name != "stiffness":
            yield shown(quantity, EDGELESS, edgeless - over, grid=[*map(with_solver, left)])
        yield from _at_each_load(case, ground, judged, OVER, logs - on_punch, finer)
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
    for place, value, left in zip(places, values, map(with_solver, finer), strict=False):
        where: Where = {**_where(ground), CONTACT: place}
        family = len(places) * len(case.grounds)
        yield Series(quantity, model, (value,), where=where, grid=(left,), margin=margin, family=family, **unit)


def _where(ground: Ground) -> Where:
    return dict(zip((ROLL_OFF, "H"), map(float, ground), strict=True))
