"""Why models have their errors, each clause once with the names of all models that have it."""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping

CAUSE, CLAUSE = ": ", "; "


def grouped(reasons: Mapping[str, str]) -> Iterator[tuple[tuple[str, ...], str]]:
    """Names of models and the clauses that these and no others have, in their order. reasons: by name."""
    shared = _shared(reasons.values())
    names = dict[str, list[str]]()
    for name, reason in reasons.items():
        for clause in _clauses(reason, shared):
            names.setdefault(clause, []).append(name)
    clauses = dict[tuple[str, ...], list[str]]()
    for clause, those in names.items():
        clauses.setdefault(tuple(dict.fromkeys(those)), []).append(clause)
    return ((those, CLAUSE.join(same)) for those, same in clauses.items())


def _shared(reasons: Iterable[str]) -> set[str]:
    """What stands in several reasons, as a clause or behind the colon of one."""
    ends = Counter(end for reason in set(reasons) for end in _ends(reason))
    return {end for end, count in ends.items() if count > 1}


def _ends(reason: str) -> set[str]:
    clauses = reason.split(CLAUSE)
    return {*clauses, *(clause.partition(CAUSE)[2] for clause in clauses)}


def _clauses(reason: str, shared: set[str]) -> Iterator[str]:
    for clause in reason.split(CLAUSE):
        head, _, cause = clause.partition(CAUSE)
        # a word or a number behind a colon says nothing by itself
        yield from (head, cause) if " " in cause and cause in shared else (clause,)
