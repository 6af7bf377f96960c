"""Why models have their errors, each clause once with the names of all models that have it."""

from collections import Counter
from collections.abc import Iterator, Mapping

CAUSE, CLAUSE = ": ", "; "


def grouped(reasons: Mapping[str, str]) -> Iterator[tuple[tuple[str, ...], str]]:
    """Names of models and the clauses that these and no others have, in their order. reasons: by name."""
    times = Counter(end for reason in set(reasons.values()) for end in _ends(reason))
    names = dict[str, dict[str, None]]()
    for name, reason in reasons.items():
        for clause in _clauses(reason, times):
            names.setdefault(clause, {})[name] = None
    clauses = dict[tuple[str, ...], list[str]]()
    for clause, those in names.items():
        clauses.setdefault(tuple(those), []).append(clause)
    return ((those, CLAUSE.join(same)) for those, same in clauses.items())


def _ends(reason: str) -> set[str]:
    """Clauses, and what stands behind the colon of one."""
    clauses = reason.split(CLAUSE)
    return {*clauses, *(clause.partition(CAUSE)[2] for clause in clauses)}


def _clauses(reason: str, times: Mapping[str, int]) -> Iterator[str]:
    """What stands in several reasons is a clause of its own, but for a word or a number, which says nothing alone."""
    for clause in reason.split(CLAUSE):
        head, _, cause = clause.partition(CAUSE)
        yield from (head, cause) if " " in cause and times[cause] > 1 else (clause,)
