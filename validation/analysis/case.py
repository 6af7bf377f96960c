"""A case of the report: the claim under test, its two sizes, and how its evidence comes about."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from validation.analysis.evidence import Evidence
    from validation.analysis.study import Study

Profile = Literal["quick", "full"]


class Chapter(StrEnum):
    """A chapter of the report; the order is that of its argument."""

    EXACT = "What is known exactly"
    PRESSED = "Rough punches: the stiffness and its fluctuation"
    ROLLING = "Rolling: the force along the track"
    RAIL = "The wheel on a real rail"
    WHEEL = "The dynamic wheel"
    LIMITS = "Where each method fails"
    SPEED = "Speed against accuracy"
    SELECTION = "The cheapest sufficient model"


@dataclass(frozen=True, kw_only=True)
class Case:
    """One claim of the report: its settings in two sizes, its solves and its study.

    A module in a folder ``cases`` that holds one as ``CASE`` is found by it.

    Attributes
    ----------
    name : str
        On the command line, of its figures and of its data.
    chapter : Chapter
        Where it stands.
    place : int
        Position in the chapter: cases stand in ascending order.
    answers : str
        Which figure or question of the book it answers.
    quick, full : object
        Settings in both sizes, frozen dataclasses of one type.
    run : callable
        From settings and an `Engine` to a result.
    needs : str or callable
        The cheapest sufficient model: a text, or a function of the settings.
    study : Study
        What the result shows.
    timed : bool
        Whether it measures times, and so runs last and alone.

    Examples
    --------
    >>> from validation.case import SERIAL
    >>> case = validation.CASES["geike"]
    >>> case.chapter.value, case.model_needed(case.quick)
    ('What is known exactly', 'closed form: spectra alone')
    >>> result = case.run(case.settings("quick", seed=7), SERIAL)
    >>> print(case.evidence(result).claims[0].status)
    supported
    """

    name: str
    chapter: Chapter
    place: int
    answers: str
    quick: Any
    full: Any
    run: Callable[[Any, Any], Any]
    needs: Callable[[Any], str] | str
    study: "Study"
    timed: bool = False

    def evidence(self, result: Any) -> "Evidence":
        """The tables, numbers, claims and charts that the study derives from a result of `run`."""
        return self.study.evidence(result)

    @property
    def claim(self) -> str:
        """The first of the study, empty where it has none."""
        return self.study.claims[0].says if self.study.claims else ""

    def settings(self, profile: Profile, seed: int | None, scene: Any = None, own: str = "") -> Any:
        """The settings of a profile; seed, scene and the file `own` replace those fields that the settings have."""
        settings = self.quick if profile == "quick" else self.full
        if seed is not None and hasattr(settings, "seed"):
            settings = replace(settings, seed=seed)
        if own and hasattr(settings, "own"):
            settings = replace(settings, own=own)
        return replace(settings, scene=scene) if scene is not None and hasattr(settings, "scene") else settings

    def model_needed(self, settings: Any) -> str:
        """The cheapest model that these settings need."""
        return self.needs if isinstance(self.needs, str) else self.needs(settings)
