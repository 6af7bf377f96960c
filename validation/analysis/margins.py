"""Margins that several cases share: one tolerance each, with its reason, whichever model or scene it is found in."""

from collections.abc import Mapping

from validation.analysis.series import Margin

MARGINS: Mapping[str, Margin] = {
    "peak": Margin(
        tolerance=0.005,
        relative=True,
        reason="0.5 %: a small part of the spacing of spectral lines, between which the peak is interpolated",
    ),
    "jump": Margin(
        tolerance=0.03,
        relative=True,
        reason="3 %: half of the main lobe of Hann's window, two lines of a record of 65 longest waves",
    ),
    "slope": Margin(
        tolerance=0.05,
        reason="0.05: 1 %, a difference of slope that is hardly visible on a double-logarithmic plot",
    ),
    "period": Margin(
        tolerance=0.01,
        relative=True,
        reason="1 %: roughness at the edge of the contact changes the contact length to second order",
    ),
    "contrast": Margin(
        tolerance=3.0,
        reason="3 dB: maxima over zeros lower by a factor of two, hardly visible over decades",
    ),
    "lift-off": Margin(
        tolerance=0.2,
        relative=True,
        reason="20 % of h / d: heights of a sweep lie about as far apart",
    ),
    "level": Margin(tolerance=1.0, reason="1 dB: a third of the 3 dB accepted for one-third octaves of rolling noise"),
}
"""Of the wheel and of its contact force; levels are over a reference, in one region of the spectrum."""
FIELD = Margin(tolerance=1.0, reason="1 dB: a tolerance of the field")
REPEATABLE = Margin(tolerance=1.0, reason="1 dB: repeatability of measured one-third octave levels")
THREE_DECIBELS = Margin(
    tolerance=3.0,
    reason="3 dB in one-third octaves: Ford and Thompson, J. Sound Vib. 293 (2006)",
    rms=(REPEATABLE.tolerance, REPEATABLE.reason),
)
"""Of the worst one-third octave of a range; the root mean square over the range has its own."""
