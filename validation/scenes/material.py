"""Whose modulus it is: the contact modulus E* of two bodies, and how it came about."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

from mdr.checks import finite, positive
from validation.analysis.escapes import one_line, quoted
from validation.scenes.reader import nonblank_text, table, values
from validation.scenes.units import in_unit

ELASTIC_KEYS = ("youngs_modulus", "poisson_ratio", "counterface")
"""Keys that stand in the place of a contact modulus."""


@dataclass(frozen=True, kw_only=True)
class Elastic:
    """An isotropic body; the material that holds it checks it. youngs_modulus: E [Pa]; poisson_ratio: nu."""

    youngs_modulus: float
    poisson_ratio: float

    @property
    def against_rigid(self) -> float:
        """E / (1 - nu^2) [Pa]."""
        return self.youngs_modulus / (1 - self.poisson_ratio**2)

    def __str__(self) -> str:
        return f"E = {in_unit(self.youngs_modulus, 'pressure')}, nu = {self.poisson_ratio:.5g}"


@dataclass(frozen=True, kw_only=True)
class Material:
    """Contact modulus of two bodies, and what it is made of.

    Parameters
    ----------
    contact_modulus : float, optional
        E* itself [Pa]; then nothing else.
    youngs_modulus, poisson_ratio : float, optional
        E [Pa] and nu, in [0, 0.5], of one body.
    counterface : {"rigid", "same"} or Elastic, optional
        The other body: rigid, equal to the first, or with moduli of its own.

    Raises
    ------
    ValueError, TypeError
        If a value is missing, contradicts another or is out of range; the message names the key of a scene file.

    Notes
    -----
    1 / E* = (1 - nu_1^2) / E_1 + (1 - nu_2^2) / E_2.

    Examples
    --------
    >>> steel = validation.Material(youngs_modulus=210e9, poisson_ratio=0.3, counterface="same")
    >>> print(f"{steel.modulus:.4g} Pa")
    1.154e+11 Pa
    """

    contact_modulus: float | None = None
    youngs_modulus: float | None = None
    poisson_ratio: float | None = None
    counterface: Literal["rigid", "same"] | Elastic | None = None

    def __post_init__(self) -> None:
        keys = [key for key in ELASTIC_KEYS if getattr(self, key) is not None]
        if self.contact_modulus is not None:
            if keys:
                raise ValueError(f"material.contact_modulus must stand alone, got {', '.join(keys)} beside it")
            positive("material.contact_modulus", self.contact_modulus)
            return
        if not keys:
            raise ValueError(f"material must have contact_modulus, or else {', '.join(ELASTIC_KEYS)}, got none of them")
        for key in ELASTIC_KEYS[:2]:
            if key not in keys:
                raise ValueError(f"material.{key} is missing, material must have it")
        _check_moduli("material", self._body)
        self._check_counterface()
        positive("material: E* of both bodies", self.modulus)

    def __repr__(self) -> str:
        given = ((name, getattr(self, name)) for name in ("contact_modulus", *ELASTIC_KEYS))
        cells = (f"{name}={value:.5g}" if isinstance(value, float) else f"{name}={value!r}" for name, value in given)
        return one_line(f"Material({', '.join(cell for cell in cells if not cell.endswith('=None'))})")

    @property
    def modulus(self) -> float:
        """The contact modulus E* of both bodies [Pa]: given as such, or from their elastic constants."""
        if self.contact_modulus is not None:
            return self.contact_modulus
        body = self._body
        if isinstance(self.counterface, Elastic):
            return 1 / (1 / body.against_rigid + 1 / self.counterface.against_rigid)
        return body.against_rigid if self.counterface == "rigid" else body.against_rigid / 2

    @property
    def origin(self) -> str:
        """How E* came about, in words."""
        if self.contact_modulus is not None:
            return "given directly"
        if isinstance(self.counterface, Elastic):
            return f"a body of {self._body} on one of {self.counterface}"
        return f"{'the other body is rigid' if self.counterface == 'rigid' else 'two equal bodies'}, {self._body}"

    @property
    def _body(self) -> Elastic:
        """The first body, where E* is not a value of its own."""
        assert self.youngs_modulus is not None  # unless E* was given
        assert self.poisson_ratio is not None
        return Elastic(youngs_modulus=self.youngs_modulus, poisson_ratio=self.poisson_ratio)

    def _check_counterface(self) -> None:
        other, alone = self.counterface, self._body.against_rigid
        if other is None:
            rigid, same = in_unit(alone, "pressure", digits=6), in_unit(alone / 2, "pressure", digits=6)
            raise ValueError(
                "material.counterface is missing: E* depends on the other body, too. Add one of these lines to "
                "[material]\n"
                f'    counterface = "rigid"   # the other body is rigid: E* = E / (1 - nu^2) = {rigid}\n'
                f'    counterface = "same"    # two equal bodies: E* = E / (2 (1 - nu^2)) = {same}\n'
                "or a table [material.counterface] with youngs_modulus and poisson_ratio of the other body"
            )
        if isinstance(other, Elastic):
            _check_moduli("material.counterface", other)
        elif other not in ("rigid", "same"):
            raise ValueError(
                'material.counterface must be "rigid", "same", or a table with youngs_modulus and poisson_ratio of the '
                f"other body, got {quoted(other)}"
            )


def material_of(name: str, value: object) -> Material:
    """The material of a table in a scene file."""
    readers = {**values("contact_modulus"), **BODY, "counterface": _read_counterface}
    return Material(**table(readers, tuple(readers), name, value))


def check_scene(scene: Any, keys: Sequence[str], optional: Sequence[str] = ()) -> None:
    """Check the name of a scene, the positive values of `keys`, and E*, which must be that of its material.

    Raises ValueError or TypeError. optional: keys of values that may be None.
    """
    nonblank_text("name", scene.name)
    for key in (*keys, *optional):
        value = getattr(scene, key.rpartition(".")[2])
        if value is not None or key in keys:
            positive(key, value)
    positive("modulus", scene.modulus)
    if scene.material is not None and scene.material.modulus != scene.modulus:
        raise ValueError(
            f"modulus must be that of the material, {scene.material.modulus:g} Pa, got {scene.modulus:g} Pa"
        )


BODY = values("youngs_modulus", "poisson_ratio")


def _read_counterface(name: str, value: object) -> object:
    """The other body of a table, or the value itself, which the material checks."""
    return Elastic(**table(BODY, (), name, value)) if isinstance(value, dict) else value


def _check_moduli(key: str, body: Elastic) -> None:
    """Raise ValueError unless E > 0 and 0 <= nu <= 0.5; the message begins with the key of the body."""
    positive(f"{key}.youngs_modulus", body.youngs_modulus)
    if not 0 <= finite(f"{key}.poisson_ratio", body.poisson_ratio) <= 0.5:
        raise ValueError(f"{key}.poisson_ratio must lie in [0, 0.5], got {body.poisson_ratio}")
