"""The ladder held to account: random scenes, what it claims beside fine boundary elements, and what it saves."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats

from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Role, Table, table_of
from validation.cases.selection.random_scenes import KINDS, RANGES, WANTED, random_scene
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.scenes.indentation import IndentationScene
from validation.selection.compare import kinds_below_boundary_elements, models_of
from validation.selection.hierarchy import BOUNDARY_ELEMENTS, ContactModel, answered, distance, select_model

GOAL_COVERED, GOAL_SAVED = 0.95, 50.0
OTHER_SEED = 1_000_003
"""Added to the seed of what the ladder draws: the referee has surfaces of its own."""
COARSE, FINE = "coarse boundary elements", "fine boundary elements"
CHEAP = kinds_below_boundary_elements()
RUNGS = (*CHEAP, COARSE, FINE)
"""What a climb may end on: the models below boundary elements by their own names, and those on two kinds of grid."""
NONE = "none"
REFEREE = 0.1
"""Tolerance of the referee: a sample that leaves half of it."""


@dataclass(frozen=True, kw_only=True)
class Ladder:
    """Random scenes of each kind, each climbed at one tolerance.

    punches, spheres, rolling, wheels: how many; tolerances: relative, of the climbs; seed: zero or positive.
    """

    punches: int = 8
    spheres: int = 2
    rolling: int = 1
    wheels: int = 0
    tolerances: tuple[float, ...] = (0.1,)
    seed: int = 14

    @property
    def trials(self) -> list["CalibrationTrial"]:
        """All of them; what takes longest first."""
        counts = dict(zip(KINDS, (self.punches, self.spheres, self.rolling, self.wheels), strict=True))
        return [
            CalibrationTrial(kind=kind, number=number, tolerances=self.tolerances, seed=self.seed)
            for kind in reversed(KINDS)
            for number in range(counts[kind])
        ]


@dataclass(frozen=True, kw_only=True)
class CalibrationTrial:
    """One random scene, refereed once and climbed at each tolerance."""

    kind: str
    number: int
    tolerances: tuple[float, ...]
    seed: int

    @property
    def want(self) -> str:
        """In turns."""
        wanted = WANTED[self.kind]
        return wanted[self.number % len(wanted)]


@dataclass(frozen=True)
class LadderResult:
    """One outcome a trial."""

    case: Ladder
    outcomes: list[Outcome]
    unconverged: tuple[str, ...]


def run(case: Ladder, engine: Engine = SERIAL) -> LadderResult:
    """Climb all scenes. Raises NotConvergedError where no referee has an answer."""
    outcomes = engine.map(hold_to_account, case.trials)
    lost = tuple(f"{t.kind} {t.number}" for t, o in zip(case.trials, outcomes, strict=True) if o["failed"])
    if len(lost) == len(outcomes):
        raise NotConvergedError("boundary elements converged on no scene", lost)
    return LadderResult(case, outcomes, lost)


def hold_to_account(trial: CalibrationTrial) -> Outcome:
    """Fine boundary elements as referee, and the ladder beside them.

    truth: error that the referee itself leaves; rung: index of the rung that was enough, -1 for none; claimed, true:
    error of the best answer, by itself and beside the referee; spent, fine: seconds of what the climb did, and of what
    the referee did, the latter as many surfaces more or fewer as the tolerance asks; settled: one where the tolerance
    was met, each one a tolerance; every claimed, every true: of all rungs below boundary elements, asked whatever they
    claim, one each of RUNGS; height, load: h/d and F / (E* h L) of the scene; failed: one where the referee did not
    converge.
    """
    scene = random_scene(trial.kind, trial.number, trial.seed)
    finest = models_of(scene, trial.want, REFEREE, trial.seed + OTHER_SEED)[-1]
    referee = answered(finest)
    taken = referee.cost.seconds / finest.cost().seconds
    rows = np.array([_climbed(trial, tolerance, referee.value, taken) for tolerance in trial.tolerances])
    rungs = models_of(scene, trial.want, REFEREE, trial.seed)
    every = np.array([_asked(rungs, name, referee.value) for name in RUNGS])
    punch = isinstance(scene, IndentationScene) and scene.shape == "punch"
    return {
        "truth": np.array(referee.error if not referee.failed else math.nan),
        **dict(zip(("rung", "claimed", "true", "spent", "fine", "settled"), rows.T, strict=True)),
        "every claimed": every[:, 0],
        "every true": every[:, 1],
        "height": np.array(math.nan if punch else scene.roughness_ratio),
        "load": np.array(scene.reduced_load if isinstance(scene, IndentationScene) and punch else math.nan),
        "failed": np.array(float(bool(referee.failed))),
    }


def _climbed(trial: CalibrationTrial, tolerance: float, truth: np.ndarray, taken: float) -> tuple[float, ...]:
    """taken: what the referee did over what it expected."""
    scene = random_scene(trial.kind, trial.number, trial.seed)
    rungs = models_of(scene, trial.want, tolerance, trial.seed)
    climbed = select_model(rungs, tolerance)
    best, fine = climbed.best, rungs[-1].cost().seconds * taken
    if best is None or best.answer is None:
        return -1.0, math.nan, math.nan, climbed.spent, fine, 0.0
    true = distance(best.answer.value, truth) if np.isfinite(truth).all() else math.nan
    index = RUNGS.index(_rung_of(best.model, rungs))
    return float(index), best.answer.error, true, climbed.spent, fine, float(climbed.met)


def _rung_of(rung: ContactModel, rungs: Sequence[ContactModel]) -> str:
    """Which of RUNGS it is. Raises ValueError for a model that is none of them: its claims would not be tested."""
    name = (FINE if rung is rungs[-1] else COARSE) if rung.kind == BOUNDARY_ELEMENTS else rung.kind
    if name not in RUNGS:
        raise ValueError(f"the kind of a model must be one of {', '.join((*CHEAP, BOUNDARY_ELEMENTS))}, got {name}")
    return name


def _asked(rungs: Sequence[ContactModel], name: str, truth: np.ndarray) -> tuple[float, float]:
    """Claimed and true error of a rung below boundary elements; NaN where the scene has none, or it claims nothing."""
    rung = next((rung for rung in rungs if _rung_of(rung, rungs) == name), None)
    if name not in CHEAP or rung is None or not rung.estimate().in_range:
        return math.nan, math.nan
    answer = answered(rung)
    return (math.nan, math.nan) if answer.failed else (answer.error, distance(answer.value, truth))


def evidence(result: LadderResult) -> Evidence:
    """How often the true error is within the claimed one, and what was saved."""
    case, table, claims = result.case, _table(result), _claims(result)
    numbers, sentences = [], []
    for tolerance in case.tolerances:
        mine = table.where(tolerance=tolerance)
        known = np.isfinite(mine["true error"])
        if not known.any():
            continue
        claimed, true = mine["claimed error"][known], mine["true error"][known]
        covered, saved = float(np.mean(true <= claimed)), float(np.median(mine["saved"][known]))
        least, most = _interval(int(np.count_nonzero(true <= claimed)), true.size)
        numbers += _numbers(tolerance, covered, least, saved)
        together = mine["fine [s]"][known].sum() / mine["climb [s]"][known].sum()
        sentences.append(
            f"At {tolerance:.0%}: the true error is within the claimed one in {covered:.1%} of {true.size} scenes "
            f"(95 % interval {least:.0%} to {most:.0%}), within the tolerance in {np.mean(true <= tolerance):.1%}; "
            f"beside always running fine boundary elements a factor {saved:.3g} is saved in the median, "
            f"{together:.3g} in all scenes together, where those that need fine boundary elements count most; the "
            f"median is that of the ranges that were drawn. {_out_of_reach(mine, known)} {_ended(mine)}"
        )
    return Evidence(
        title="No more model than a scene needs: the ladder held to account",
        method=(
            f"{len(result.outcomes)} scenes drawn at random ({case.punches} rough punches, {case.spheres} rough "
            f"spheres, {case.rolling} rolling and {case.wheels} dynamic wheels): {RANGES}. The ladder is climbed as "
            "far as the tolerance asks; the referee is boundary elements on the finest grid with surfaces of its own, "
            "whose error is not taken off; what both share, as the finest grid, its shortest wave and the "
            "quadratures of linear theory, this cannot tell. Costs are counts of what was done times the time of one, "
            "so that they are the same on every machine; all rungs that were asked count."
        ),
        numbers=tuple(numbers),
        tables=(table, claims),
        conclusions=tuple(sentences),
        captions={"ladder": CAPTION},
        unconverged=result.unconverged,
        page_tables=(_summary(case, table), _by_rung(claims)),
    )


def _out_of_reach(table: Table, known: np.ndarray) -> str:
    """Of scenes whose tolerance was not met, with an answer or without."""
    met = known & (table["met"] == 1)
    found = f"Scenes that were said to be out of reach: {np.count_nonzero(table['met'] == 0)}"
    if met.any():
        found += f"; where they have an answer, it counts, too; without them {np.median(table['saved'][met]):.3g}"
    return f"{found}. Scenes without any answer: {np.count_nonzero(~known)}."


CAPTION = (
    "(a) True error, beside fine boundary elements, against the error that the ladder claims; below the line the claim "
    "holds. (b) Cost of fine boundary elements over that of the climb. (c) Claims of every rung below boundary "
    "elements on every scene, asked whether the climb needed it or not. Filled: the first tolerance; open: others."
)


def _numbers(tolerance: float, covered: float, least: float, saved: float) -> list[Number]:
    missing = max(GOAL_COVERED - covered, 0.0)
    return [
        Number(
            quantity=f"claims at {tolerance:.0%}: share of scenes missing to {GOAL_COVERED:.0%} covered",
            value=missing,
            reference=0.0,
            source="the meaning of a 95 % interval",
            tolerance=0.02,
            reason="two scenes in a hundred",
            sample=max(GOAL_COVERED - least, 0.0) - missing,
            role=Role.FINDING,
        ),
        Number(
            quantity=f"median saving at {tolerance:.0%}, decades missing to a factor {GOAL_SAVED:g}",
            value=max(math.log10(GOAL_SAVED / saved), 0.0),
            reference=0.0,
            source="goal",
            tolerance=0.05,
            reason="a tenth of a factor",
            role=Role.FINDING,
        ),
    ]


def _interval(hits: int, size: int) -> tuple[float, float]:
    """Of Clopper and Pearson, 95 %."""
    found = stats.binomtest(hits, size).proportion_ci()
    return float(found.low), float(found.high)


def _ended(table: Table) -> str:
    """On which rungs the climbs ended."""
    names, counts = np.unique(table["rung"], return_counts=True)
    found = dict(zip(names.tolist(), counts.tolist(), strict=True))
    return "Climbs ended on " + ", ".join(f"{name} ({found[name]})" for name in (*RUNGS, NONE) if name in found) + "."


def _table(result: LadderResult) -> Table:
    rows: list[Mapping[str, object]] = []
    for trial, outcome in zip(result.case.trials, result.outcomes, strict=True):
        for i, tolerance in enumerate(result.case.tolerances):
            index = int(outcome["rung"][i])
            rows.append(
                {
                    "kind": trial.kind,
                    "number": trial.number,
                    "want": trial.want,
                    "tolerance": tolerance,
                    "h/d": float(outcome["height"]),
                    "F / (E* h L)": float(outcome["load"]),
                    "rung": RUNGS[index] if index >= 0 else NONE,
                    "met": int(outcome["settled"][i]),
                    "claimed error": float(outcome["claimed"][i]),
                    "true error": float(outcome["true"][i]),
                    "error of the referee": float(outcome["truth"]),
                    "climb [s]": float(outcome["spent"][i]),
                    "fine [s]": float(outcome["fine"][i]),
                    "saved": float(outcome["fine"][i] / outcome["spent"][i]) if outcome["spent"][i] > 0 else math.nan,
                }
            )
    return table_of("scenes", rows)


def _claims(result: LadderResult) -> Table:
    """Of every rung below boundary elements on every scene."""
    rows: list[Mapping[str, object]] = [
        {
            "kind": trial.kind,
            "number": trial.number,
            "want": trial.want,
            "h/d": float(outcome["height"]),
            "F / (E* h L)": float(outcome["load"]),
            "rung": name,
            "claimed error": float(claimed),
            "true error": float(true),
        }
        for trial, outcome in zip(result.case.trials, result.outcomes, strict=True)
        for name, claimed, true in zip(RUNGS, outcome["every claimed"], outcome["every true"], strict=True)
        if np.isfinite(true)
    ]
    return table_of("claims", rows)


def _summary(case: Ladder, table: Table) -> Table:
    rows: list[Mapping[str, object]] = []
    for kind in KINDS:
        for tolerance in case.tolerances:
            mine = table.where(kind=kind, tolerance=tolerance)
            known = np.isfinite(mine["true error"])
            if not known.any():
                continue
            inside = mine["true error"][known] <= mine["claimed error"][known]
            rows.append(
                {
                    "scene": kind,
                    "tolerance": f"{tolerance:.0%}",
                    "scenes": len(mine["kind"]),
                    "tolerance met": int(mine["met"].sum()),
                    "true error within the claim": f"{np.mean(inside):.0%}",
                    "median saving": f"{np.median(mine['saved'][known]):.3g}",
                    "ended on": _ended(mine).removeprefix("Climbs ended on ").rstrip("."),
                }
            )
    return table_of("What the ladder claims, and what it saves", rows)


def _by_rung(claims: Table) -> Table:
    """Of every rung below boundary elements, asked on all scenes: a wide claim of one must not hide a bold one."""
    rows: list[Mapping[str, object]] = []
    for name in RUNGS:
        mine = claims.where(rung=name)
        if not mine["rung"].size:
            continue
        inside = mine["true error"] <= mine["claimed error"]
        least, most = _interval(int(np.count_nonzero(inside)), inside.size)
        bold = ~inside
        rows.append(
            {
                "rung": name,
                "scenes": int(inside.size),
                "true error within the claim": f"{inside.mean():.0%} ({least:.0%} to {most:.0%})",
                "claim over true error, median": f"{np.median(mine['claimed error'] / mine['true error']):.2g}",
                "at most exceeded by": f"{(mine['true error'] / mine['claimed error'])[bold].max():.2g} times"
                if bold.any()
                else "never",
            }
        )
    return table_of("Claims of each rung, asked whether the climb needed it or not", rows)


CASE = Case(
    name="ladder",
    chapter=Chapter.SELECTION,
    place=1,
    claim="The cheapest model that a scene needs can be chosen beforehand, with an honest error.",
    answers="Random scenes up the ladder of models: claimed beside true error, and what was saved",
    quick=Ladder(),
    full=Ladder(punches=110, spheres=24, rolling=8, wheels=4, tolerances=(0.1, 0.3)),
    run=run,
    evidence=evidence,
    needs="chosen scene by scene",
)
