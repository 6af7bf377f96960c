"""Quantities that several chapters, benchmarks and judges have."""

from validation.analysis.quantity import Quantity

MEAN_STIFFNESS, RELATIVE_DEVIATION = Quantity("mean_stiffness"), Quantity("relative_deviation")
MEAN_FORCE, RMS_FORCE = Quantity("mean_force"), Quantity("rms_force")
