"""The verdict of a number: one vocabulary and one rule."""

from enum import StrEnum

Place = str | float | tuple[float, float]
"""A region by its name, a parameter by its value, or a range of it by both ends."""


class Verdict(StrEnum):
    """Of a number relative to its reference; the last two are of a model that has no number.

    WITHIN, OUTSIDE: the whole 95 % interval lies within the tolerance, or outside; INCONCLUSIVE: it straddles the
    limit; NOT_SERVED: the model rejects the scene; NO_RESULT: the model failed.
    """

    WITHIN = "within tolerance"
    OUTSIDE = "outside tolerance"
    INCONCLUSIVE = "inconclusive"
    NOT_SERVED = "not served"
    NO_RESULT = "no result"

    @classmethod
    def _missing_(cls, value: object) -> "Verdict | None":
        """The verdict whose value in files of schema 1 this is; None where there is none."""
        return next((verdict for verdict, earlier in EARLIER_VERDICTS.items() if earlier == value), None)

    @property
    def earlier(self) -> str:
        """Its value in files of schema 1, which schema 2 keeps for one release under the same key."""
        return EARLIER_VERDICTS[self]

    @property
    def css(self) -> str:
        """A class of the style sheet: "within", "outside", "inconclusive", "not-served", "no-result"."""
        return self.removesuffix(" tolerance").replace(" ", "-")

    @property
    def sign(self) -> str:
        """One character of a strip: = within tolerance, # outside, ? inconclusive, r not served, x no result."""
        return SIGNS[self]


EARLIER_VERDICTS = {
    Verdict.WITHIN: "agree",
    Verdict.OUTSIDE: "differ",
    Verdict.INCONCLUSIVE: "undecided",
    Verdict.NOT_SERVED: "refused",
    Verdict.NO_RESULT: "failed",
}
OF_NUMBERS = (Verdict.WITHIN, Verdict.OUTSIDE, Verdict.INCONCLUSIVE)
"""Verdicts that a number has."""
SIGNS = dict(zip(Verdict, "=#?rx", strict=True))


def verdict_of(difference: float, half_width: float, tolerance: float, rounding: float = 0.0) -> Verdict:
    """WITHIN where |difference| + half_width <= tolerance, OUTSIDE where |difference| - half_width > tolerance.

    Else INCONCLUSIVE. All three in one unit; half_width: of the 95 % interval; rounding: relative to the tolerance, of
    values that are computed from each other.
    """
    limit = tolerance * (1 + rounding)
    if abs(difference) + half_width <= limit:
        return Verdict.WITHIN
    return Verdict.OUTSIDE if abs(difference) - half_width > limit else Verdict.INCONCLUSIVE
