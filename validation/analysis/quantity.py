"""A quantity of a case: the key by which files and other modules find it, and what people read."""

from __future__ import annotations

from validation.analysis.contents import plain_name

KNOWN: dict[str, Quantity] = {}
"""All that modules have defined, by their keys."""


class Quantity(str):
    """A label as a text, with a key that stays where the label is worded anew.

    The key names the CSV file of the table, and is what `chapter.toml`, judges and templates look for. It has letters,
    digits, underscores and some signs; the label is by default the key with blanks. `+` extends both.
    Raises ValueError for a key that no file name has, or that another label has.
    """

    key: str

    def __new__(cls, key: str, label: str = "") -> Quantity:
        quantity = super().__new__(cls, label or key.replace("_", " "))
        quantity.key = key
        if plain_name(key) != key:
            raise ValueError(f"key must be a name as {plain_name(key)!r}, got {key!r}")
        if KNOWN.setdefault(key, quantity) != quantity:
            raise ValueError(f"key {key!r} is that of {str(KNOWN[key])!r}, got it for {str(quantity)!r}")
        return quantity

    def __add__(self, more: str) -> Quantity:
        return Quantity(plain_name(f"{self.key}_{plain_name(more)}"), str(self) + more)

    def __radd__(self, before: str) -> Quantity:
        return Quantity(plain_name(f"{plain_name(before)}_{self.key}"), before + str(self))

    def __getnewargs__(self) -> tuple[str, str]:  # type: ignore[override]  # of a plain text it is one
        return self.key, str(self)


def key_of(label: str) -> str:
    """The key of a quantity; any other text as `plain_name` has it."""
    return label.key if isinstance(label, Quantity) else plain_name(label)


def quantity_with(text: str) -> str:
    """The quantity of a key, or of a label, today's or of an earlier report; any other text as it is."""
    by_label = next((quantity for quantity in KNOWN.values() if quantity == text), None)
    return by_label or KNOWN.get(text) or KNOWN.get(plain_name(text)) or text


MEAN_STIFFNESS, RELATIVE_DEVIATION = Quantity("mean_stiffness"), Quantity("relative_deviation")
MEAN_FORCE, RMS_FORCE = Quantity("mean_force"), Quantity("rms_force")
"""Quantities that several chapters, benchmarks and judges have."""
