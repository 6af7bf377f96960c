"""One file per case: its figures, drawn from the tables of its evidence and nothing else."""

from collections.abc import Callable

from matplotlib.figure import Figure

from validation.evidence import Evidence
from validation.report.figures import (
    fractal_punch,
    geike,
    hertz,
    mdr_limits,
    normalisation,
    precision,
    race,
    ridges,
    rolling,
    rolling_input,
    square_punch,
    westergaard,
    wheel,
    wheel_3d,
    wheel_distance,
    wheel_stability,
)

DRAW: dict[str, Callable[[Evidence], Figure]] = {
    "hertz": hertz.draw,
    "square_punch": square_punch.draw,
    "westergaard": westergaard.draw,
    "geike": geike.draw,
    "fractal_punch": fractal_punch.draw,
    "fractal_punch-overlay": fractal_punch.draw_overlay,
    "fractal_punch-difference": fractal_punch.draw_difference,
    "fractal_punch-mean": fractal_punch.draw_mean,
    "fractal_punch-exponent": fractal_punch.draw_exponent,
    "normalisation": normalisation.draw,
    "mdr_limits": mdr_limits.draw,
    "ridges": ridges.draw,
    "rolling-line": rolling.draw_line,
    "rolling": rolling.draw,
    "rolling-coherence": rolling.draw_coherence,
    "rolling-map": rolling.draw_map,
    "rolling_input": rolling_input.draw,
    "rolling_input-springs": rolling_input.draw_springs,
    "rolling_input-punch": rolling_input.draw_punch,
    "wheel-contact": wheel.draw_contact,
    "wheel": wheel.draw,
    "wheel-parameters": wheel.draw_parameters,
    "wheel_distance": wheel_distance.draw,
    "wheel_distance-cause": wheel_distance.draw_cause,
    "wheel_3d": wheel_3d.draw,
    "wheel_stability": wheel_stability.draw,
    "wheel_stability-rough": wheel_stability.draw_rough,
    "precision-summary": precision.draw_summary,
    "precision": precision.draw,
    "precision-visits": precision.draw_visits,
    "race": race.draw,
    "race-rolling": race.draw_rolling,
    "race-wheel": race.draw_wheel,
}
