"""What each kind of model is judged by."""

from collections.abc import Callable, Iterator, Mapping
from pkgutil import resolve_name

from validation.analysis.judgement import JudgedPoint
from validation.engine.offered import Caller

Judge = Callable[[Caller, float], Iterator[JudgedPoint]]
JUDGES: Mapping[str, str] = {
    "stiffness_model": "stiffness:judged",
    "stiffness_of_surface": "surfaces:judged",
    "force_spectrum": "spectra:judged",
    "rolling_model": "rolling:judged",
    "contact_filter": "filters:judged",
    "profile_spectrum": "laws:judged_profile_spectrum",
    "contact_law": "laws:judged",
}
"""Module beside this one, and its function, by the decorator; a contact solver is judged among the benchmarks."""


def judge_of(kind: str) -> Judge:
    """Of a reduced model."""
    judge: Judge = resolve_name(f"{__package__}.{JUDGES[kind]}")
    return judge
