"""Earlier names of a wheel that rolls along a track in time, for one release."""

import warnings
from pathlib import Path

from validation.scenes.load import load_scene_with_track
from validation.scenes.material import Material
from validation.scenes.rolling import RollingScene
from validation.scenes.roughness import Roughness


def WheelScene(  # noqa: N802  # the class that it was
    *,
    name: str,
    radius: float,
    mass: float,
    load: float,
    speed: float,
    material: Material,
    wheel: Roughness | None,
    distance: float,
    springs: int,
    damping: float = 0.0,
    rail: Roughness | None,
) -> RollingScene:
    """Earlier name of `RollingScene` with a track, for one release: ``rail`` is its ``ground``.

    Parameters
    ----------
    name, radius, mass, load, speed, material, wheel, distance, springs, damping
        As of `RollingScene`.
    rail : Roughness or None
        Its ``ground``.

    Returns
    -------
    RollingScene
        With a motion and a track.

    Examples
    --------
    >>> steel = validation.Material(contact_modulus=236.25e9)
    >>> rough = validation.Roughness(rms=0.5e-6, hurst=0.7, longest=10e-3, shortest=1e-3)
    >>> scene = validation.RollingScene(
    ...     name="my wheel", radius=0.5, mass=500, load=4905, speed=20, material=steel,
    ...     ground=rough, distance=0.65, springs=100,
    ... )
    >>> print(f"time step {scene.time_step:.3g} s")
    time step 9.91e-07 s
    """
    _warn("WheelScene is RollingScene now, its rail the ground")
    return RollingScene(
        name=name,
        radius=radius,
        load=load,
        ground=rail,
        mass=mass,
        speed=speed,
        material=material,
        damping=damping,
        wheel=wheel,
        distance=distance,
        springs=springs,
    )


def load_wheel_scene(scene: str | Path) -> RollingScene:
    """Earlier name of `load_scene`, for one release; it refuses a file without ``[simulation]``.

    Parameters
    ----------
    scene : str or Path
        Path of a scene file, or the name of a shipped scene: "rough_wheel" or "table_14_1".

    Returns
    -------
    RollingScene
        With a motion and a track.

    Raises
    ------
    ValueError
        If no shipped scene has the name, or a value of the file is missing, unknown or out of range; the message
        names it.
    OSError
        If the file cannot be read.

    Examples
    --------
    >>> wheel = validation.load_scene("table_14_1")
    >>> print(f"{wheel.eigenfrequency:.4g} rad/s")
    1369 rad/s
    """
    _warn("load_wheel_scene is load_scene now")
    return load_scene_with_track(scene)


def _warn(sentence: str) -> None:
    """Warns, with the line that has called the earlier name, that this goes with the next release."""
    warnings.warn(f"{sentence}; the earlier name goes with the next release", FutureWarning, stacklevel=3)
