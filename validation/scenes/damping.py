"""A dashpot between the wheel and the inertial frame, by its damping ratio; it acts while contact is lost, too."""

from dataclasses import dataclass

from mdr.checks import finite
from validation.scenes.wheel_body import Wheel


@dataclass(frozen=True, kw_only=True)
class DampedWheel(Wheel):
    """A wheel with a dashpot: M z'' = F - F_N - c z', c = 2 zeta M omega_eigen, whatever its contact is.

    damping: zeta, of critical, at least zero and below one; ValueError for another.
    """

    damping: float = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        check_damping(self.damping, self.mass)


def damping_rate(wheel: Wheel) -> float:
    """c / M = 2 zeta omega_eigen [1/s]; zero without a dashpot."""
    return 2 * wheel.damping * wheel.eigenfrequency if isinstance(wheel, DampedWheel) else 0.0


def check_damping(damping: float, mass: float | None) -> None:
    """Raises ValueError for a ratio out of range, or of a wheel without a mass."""
    if not 0 <= finite("wheel.damping", damping) < 1:
        raise ValueError(
            f'wheel.damping must be at least 0 and below 1, which is critical, got {damping:g}, as: damping = "2 %"'
        )
    if damping and mass is None:
        raise ValueError(
            f"wheel.damping needs a mass: a wheel without one keeps its approach and does not vibrate, got "
            f'{in_per_cent(damping)} alone, as: mass = "500 kg"'
        )


def in_per_cent(damping: float) -> str:
    return f"{100 * damping:.4g} %"
