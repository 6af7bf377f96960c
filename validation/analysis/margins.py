"""Margins that several cases share: one tolerance each, with its reason, whichever model or scene it is found in."""

from collections.abc import Mapping

from validation.analysis.series import Margin

MARGINS: Mapping[str, Margin] = {
    "peak": Margin(
        tolerance=0.005,
        relative=True,
        reason="0.5 %: a small part of the spacing of spectral lines, between which the peak is interpolated",
        source="",
    ),
    "level": Margin(
        tolerance=1.0, reason="1 dB: a third of the 3 dB accepted for one-third octaves of rolling noise", source=""
    ),
}
