"""Names of version 0.3 that are read, or written beside today's, for one release."""

import warnings
from collections.abc import Callable, Mapping
from functools import wraps
from typing import Any, TypeVar

Class = TypeVar("Class")


def with_current_keys(tables: Mapping[str, Any], renamed: Mapping[str, str]) -> tuple[dict[str, Any], list[str]]:
    """The tables of a file with today's keys in place of former ones, each with a note.

    renamed: former "table.key" to today's. Raises ValueError for a table with both.
    """
    tables, notes = dict(tables), list[str]()
    for former, current in renamed.items():
        (name, _, old), new = former.partition("."), current.rpartition(".")[2]
        if not isinstance(tables.get(name), dict) or old not in tables[name]:
            continue
        if new in tables[name]:
            raise ValueError(f"{name} must have {new} alone, got {old}, its former name, too")
        tables[name] = {new if key == old else key: value for key, value in tables[name].items()}
        notes.append(f"{former} is named {current} now: the former key is read for one release.")
    return tables, notes


def with_former_keys(record: Mapping[str, Any], former: Mapping[str, str]) -> dict[str, Any]:
    """A record of JSON in which each key that had another name stands under both. former: by today's key."""
    keys = {key: (key, former[key]) if key in former else (key,) for key in record}
    return {name: value for key, value in record.items() for name in keys[key]}


def value_of(record: Mapping[str, Any], key: str, former: str) -> Any:
    """Read record[key], or record[former] where the file was written before the key was renamed. Raises KeyError."""
    return record[key] if key in record else record[former]


def renamed_field(former: str, current: str) -> Callable[[type[Class]], type[Class]]:
    """Decorate a dataclass, so that the former keyword and attribute of a field still work, with a FutureWarning."""

    def warn(owner: str) -> None:
        warnings.warn(f"{owner}.{former} is named {current} now", FutureWarning, stacklevel=3)

    def accepting_former(owner: Any) -> Any:
        initialise = owner.__init__

        @wraps(initialise)
        def with_former(self: Any, *positional: Any, **values: Any) -> None:
            if former in values:
                warn(owner.__name__)
                values[current] = values.pop(former)
            initialise(self, *positional, **values)

        def value_of(self: Any) -> Any:
            warn(owner.__name__)
            return getattr(self, current)

        owner.__init__ = with_former
        setattr(owner, former, property(value_of))
        return owner

    return accepting_former
