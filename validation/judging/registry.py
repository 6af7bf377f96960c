"""What somebody offers to be judged: a function, its name, and what it asks for by the names of its arguments."""

import functools
import inspect
import math
import pickle
import sys
import types
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Generic, NamedTuple, ParamSpec, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from validation.analysis.escapes import one_line

FloatArray = NDArray[np.float64]
P = ParamSpec("P")
R = TypeVar("R")
Given = Mapping[str, Any]
Shape = tuple[int, ...]
LOOSEST = 1e-3
"""Residual that a solver may name: one that is looser leaves its answers free."""


class OfferedError(TypeError):
    """A function cannot be offered, in one sentence."""


@dataclass(frozen=True)
class Failed:
    """What stands in the place of a value: the reason, in words; refused: whether the function itself says so; late: it
    was not awaited."""

    reason: str
    refused: bool = False
    late: bool = False


def _scalar(arguments: Given) -> tuple[Shape, ...]:
    return ((),)


class OfferedKind(NamedTuple):
    """arguments: that a function may ask for; returns: in words; needs: arguments that it must ask for; either: one of
    each pair, or both where both are None by default; shapes: that a value may have; options: of the decorator, by
    default; check: of a name and options, raises ValueError."""

    arguments: tuple[str, ...]
    returns: str
    example: str
    needs: tuple[str, ...] = ()
    either: tuple[tuple[str, str], ...] = ()
    shapes: Callable[[Given], tuple[Shape, ...]] = _scalar
    options: Given = MappingProxyType({})
    check: Callable[[str, Given], None] = lambda name, options: None


def _mean_and_deviation(arguments: Given) -> tuple[Shape, ...]:
    return ((),) if "rng" in arguments else ((), (2,))


def _along(arguments: Given) -> tuple[Shape, ...]:
    return (np.shape(arguments.get("height", arguments.get("line")))[:1],)


def _can_be_judged(name: str, options: Given) -> None:
    if not (options["free"] or options["periodic"]):
        raise ValueError(f"{name!r}: free or periodic must be True, got neither")
    if not 0 < options["residual"] <= LOOSEST:
        raise ValueError(f"{name!r}: residual must be above zero and at most {LOOSEST:g}, got {options['residual']:g}")
    if not options["cells"] >= 1:
        raise ValueError(
            f"{name!r}: cells must be one or more, the most that a grid may have, got {options['cells']:g}"
        )


def _as(*names: str) -> Callable[[Given], tuple[Shape, ...]]:
    return lambda arguments: (np.broadcast_shapes(*(np.shape(arguments[name]) for name in names if name in arguments)),)


KINDS: Mapping[str, OfferedKind] = {
    "stiffness_model": OfferedKind(
        ("load", "side", "modulus", "roughness", "rng"),
        "mean stiffness [N/m], or (mean, standard deviation); with rng that of one realisation a call",
        "def half(load, side, modulus, roughness):\n    return 1 / (1 / (modulus * side) + roughness.rms / load)",
        shapes=_mean_and_deviation,
    ),
    "stiffness_of_surface": OfferedKind(
        ("height", "spacing", "modulus", "load"),
        "stiffness of that surface [N/m]; height (n, n) is positive towards the other body",
        "def highest(height, spacing, modulus, load):\n    return 2 * modulus * spacing * (height > 0).sum() ** 0.5",
        needs=("height",),
    ),
    "force_spectrum": OfferedKind(
        ("q", "contact_radius", "approach", "radius", "modulus", "roughness"),
        "two-sided density [N² m] at q > 0 [rad/m]; its integral over all q is the variance of the force",
        "def linear(q, contact_radius, modulus, roughness):\n"
        "    return (2 * modulus * contact_radius) ** 2 * roughness.c1d(q)",
        needs=("q",),
        shapes=_as("q"),
    ),
    "rolling_model": OfferedKind(
        ("height", "line", "spacing", "radius", "modulus", "approach", "load"),
        "force (nx,) [N] at an approach from the mean plane, entry i with the wheel above cell i; or under a load the "
        "approach (nx,) [m]. height (nx, ny) is periodic along axis 0, line (nx,) is its middle",
        "def stiff(line, radius, modulus, approach):\n"
        "    return 4 / 3 * modulus * radius**0.5 * (approach + line).clip(0) ** 1.5",
        either=(("height", "line"), ("approach", "load")),
        shapes=_along,
    ),
    "contact_filter": OfferedKind(
        ("k_x", "k_y", "a_x", "a_y", "approach", "alpha"),
        "amplitude abs(H) of waves k_x, k_y [rad/m], not its square, one for long waves; without k_y that of the line",
        "def smooth(k_x, a_x):\n    return 1 / (1 + (k_x * a_x) ** 2 / 4) ** 0.5",
        needs=("k_x",),
        shapes=_as("k_x", "k_y"),
    ),
    "profile_spectrum": OfferedKind(
        ("q", "roughness"),
        "C_1D [m³] at q [rad/m]: a rule like Geike's",
        "def like_geike(q, roughness):\n    return 3 * q * roughness.c2d(q)",
        needs=("q", "roughness"),
        shapes=_as("q"),
    ),
    "interface_model": OfferedKind(
        ("pressure", "modulus", "roughness", "quantity"),
        'a number of a rough interface without edges under a mean pressure [Pa]: by quantity, "area_fraction", the '
        'true contact area over the nominal area; "mean_gap" [m], the distance of the mean planes; or '
        '"stiffness", -dp/du [Pa/m]. NotImplementedError where it has none',
        "def linear(pressure, roughness, quantity):\n"
        "    if quantity != 'stiffness':\n"
        "        raise NotImplementedError('a stiffness alone')\n"
        "    return pressure / (0.48 * roughness.rms)",
        needs=("pressure", "quantity"),
    ),
    "contact_law": OfferedKind(
        ("approach", "position"),
        "force [N] of a wheel with a mass",
        "def linear_law(approach):\n    return 1e8 * approach",
        needs=("approach",),
        shapes=_as("approach", "position"),
    ),
    "contact_solver": OfferedKind(
        ("gap", "spacing", "modulus", "periodic", "tolerance", "force", "approach"),
        "pressure (n, m) [Pa]; gap (n, m) is read-only",
        "def even(gap, spacing, force):\n    return gap * 0 + force / (gap.size * spacing[0] * spacing[1])",
        needs=("gap",),
        either=(("force", "approach"),),
        shapes=_as("gap"),
        options={"free": True, "periodic": False, "residual": 1e-4, "cells": math.inf},
        check=_can_be_judged,
    ),
}


@dataclass(frozen=True, eq=False)
class Offered(Generic[P, R]):
    """A function that is offered under a name. It is called as before; its signature and docstring are its own.

    It is pickled by its place in its module, as a function is. One without a place, or of a script or notebook, needs
    `cloudpickle` to reach a process that does not have it.
    """

    kind: str
    name: str
    function: Callable[P, R] = field(repr=False)
    asks: tuple[str, ...]
    options: Given

    def __post_init__(self) -> None:
        wrapper: Any = types.SimpleNamespace()
        functools.update_wrapper(wrapper, self.function)
        own = {"__doc__": f"@{self.kind}({self.name!r}), a function without a docstring."}
        vars(self).update({**own, **{name: value for name, value in vars(wrapper).items() if value}, **vars(self)})

    def __repr__(self) -> str:
        name = getattr(self, "__name__", "function")
        return one_line(f"<@{self.kind}({self.name!r}) {name}({', '.join(self.asks)})>")

    def __call__(self, *arguments: P.args, **named: P.kwargs) -> R:
        return self.function(*arguments, **named)

    def __copy__(self) -> "Offered[P, R]":
        """Itself, as of a function."""
        return self

    def __deepcopy__(self, memo: object) -> "Offered[P, R]":
        return self

    def __reduce__(self) -> str | tuple[Any, ...]:
        module, place = (str(getattr(self, name, "")) for name in ("__module__", "__qualname__"))
        is_placed = _placed(module, place) is self
        if is_placed and module != "__main__":
            return place
        contents = _by_value(self.function)
        if contents is None and not is_placed:
            raise pickle.PicklingError(
                f"{self.name!r} must stand at the top of a module to be pickled, got {place or 'a function'}: or "
                "install cloudpickle"
            )
        return _restored, (module, place, self.kind, self.name, dict(self.options), contents)


def _placed(module: str, place: str) -> object:
    """What a module that is imported has at a place; None where it has nothing."""
    found: object = sys.modules.get(module)
    for name in place.split("."):
        found = getattr(found, name, None)
    return found


def _by_value(function: Callable[..., Any]) -> bytes | None:
    """A function with its code; None without `cloudpickle`, and where it holds what cannot be pickled."""
    try:
        from cloudpickle import dumps

        contents: bytes = dumps(function)
    except (ImportError, pickle.PicklingError, TypeError, RecursionError):
        return None
    return contents


def _restored(
    module: str, place: str, kind: str, name: str, options: Given, contents: bytes | None
) -> "Offered[..., Any]":
    """The function of a script where this process has run it, else as it was pickled."""
    found = _placed(module, place)
    if isinstance(found, Offered) and (found.kind, found.name) == (kind, name):
        return found
    if contents is None:
        raise pickle.UnpicklingError(f"{name!r} is not in module {module!r} of this process: install cloudpickle")
    return offer(kind, name, options, pickle.loads(contents))


class Caller(Protocol):
    """An offered function as a judge sees it, in this process or in one of its own.

    `call` takes all that there is and passes on what the function asks for. It returns finite numbers of the right
    shape, or Failed. `calls` does so for each value of one argument, which takes less time; `warned` is what the
    function warned of in the last ones.
    """

    offered: Offered[..., Any]

    @property
    def kind(self) -> str:
        return self.offered.kind

    @property
    def name(self) -> str:
        return self.offered.name

    @property
    def asks(self) -> tuple[str, ...]:
        return self.offered.asks

    @property
    def options(self) -> Given:
        return self.offered.options

    @property
    def warned(self) -> str: ...

    def calls(self, name: str, values: Sequence[Any], arguments: Given) -> list[FloatArray | Failed]: ...

    def call(self, **arguments: Any) -> FloatArray | Failed:
        return self.calls("", [None], arguments)[0]


class Decorator(Protocol):
    """What stands above a function, whose types stay."""

    def __call__(self, function: Callable[P, R], /) -> Offered[P, R]: ...


class Named(Protocol):
    """A decorator with the name of a model."""

    def __call__(self, name: str, /) -> Decorator: ...


class NamedSolver(Protocol):
    """A decorator with the name of a solver, and what that serves."""

    def __call__(
        self, name: str, /, *, free: bool = ..., periodic: bool = ..., residual: float = ..., cells: float = ...
    ) -> Decorator: ...


DECORATED: list[tuple[Given, Offered[..., Any]]] = []
"""All functions of this process, each with the names of the module that decorated it."""


def _asked(kind: str, function: Callable[..., Any]) -> tuple[str, ...]:
    """Names of the arguments. Raises TypeError for one that the kind has not, for one too many or too few."""
    of, accepted = KINDS[kind], f"@{kind} may ask for {', '.join(KINDS[kind].arguments)}"
    if not callable(function) or isinstance(function, type | Offered):
        what = "one that is offered already" if isinstance(function, Offered) else repr(function)
        raise TypeError(f"@{kind} must stand above a function, got {what}")
    # what a partial function has already is not asked for
    bound = function.keywords if isinstance(function, functools.partial) else {}
    parameters = {name: value for name, value in inspect.signature(function).parameters.items() if name not in bound}
    for name, parameter in parameters.items():
        if parameter.kind not in (parameter.POSITIONAL_OR_KEYWORD, parameter.KEYWORD_ONLY):
            raise TypeError(f"arguments go by name, one by one, got {parameter}: {accepted}")
        if name not in of.arguments:
            raise TypeError(f"{name} is unknown: {accepted}")
    if missing := [name for name in of.needs if name not in parameters]:
        raise TypeError(f"{missing[0]} must be asked for: {accepted}")
    for pair in of.either:
        present = [name for name in pair if name in parameters]
        if not present or (len(present) > 1 and any(parameters[name].default is not None for name in present)):
            raise TypeError(
                f"either {pair[0]} or {pair[1]} must be asked for, got {' and '.join(present) or 'neither'}"
            )
    return tuple(parameters)


def offer(kind: str, name: str, options: Given, function: Callable[P, R]) -> Offered[P, R]:
    """The function under its name. Raises OfferedError in one sentence that begins with the name."""
    try:
        return Offered(kind, name, function, _asked(kind, function), dict(options))
    except TypeError as error:
        raise OfferedError(f"{name!r}: {error}") from None


def _decorator(kind: str) -> Callable[..., Decorator]:
    of = KINDS[kind]

    def decorate(*names: str, **options: Any) -> Decorator:
        name = names[0] if len(names) == 1 else ""
        if not isinstance(name, str) or not name.strip() or not name.isprintable():
            got = ", ".join(map(repr, names)) or "none"
            raise OfferedError(f'@{kind} must have a name, as @{kind}("my model"), got {got}')
        if unknown := [option for option in options if option not in of.options]:
            raise OfferedError(f"option {unknown[0]} is unknown: @{kind} has {', '.join(of.options) or 'none'}")
        for option, value in options.items():
            default = of.options[option]
            if isinstance(default, bool) != isinstance(value, bool) or not isinstance(value, float | int):
                raise OfferedError(f"option {option} must be as {of.options[option]}, got {value!r}")
        of.check(name, {**of.options, **options})

        def decorated(function: Callable[P, R]) -> Offered[P, R]:
            offered = offer(kind, name, {**of.options, **options}, function)
            DECORATED.append((sys._getframe(1).f_globals, offered))
            return offered

        return decorated

    keyword = inspect.Parameter.KEYWORD_ONLY
    options = [inspect.Parameter(option, keyword, default=value) for option, value in of.options.items()]
    named = inspect.Parameter("name", inspect.Parameter.POSITIONAL_ONLY)
    decorate.__signature__ = inspect.Signature([named, *options])  # type: ignore[attr-defined]  # of any function
    decorate.__name__ = decorate.__qualname__ = kind
    decorate.__doc__ = _documented(kind, of)
    return decorate


def _documented(kind: str, of: OfferedKind) -> str:
    options = "".join(
        f"{name} : {type(value).__name__}, optional\n    What it serves; by default {value}.\n"
        for name, value in of.options.items()
    )
    shown = of.example.replace("\n", "\n... ")
    function = of.example.partition("(")[0].removeprefix("def ")
    either = "".join(f" Either {a} or {b}." for a, b in of.either)
    return f"""Offer a function to `judge`: {kind.replace("_", " ")}.

The function returns {of.returns}.
It asks for some of {", ".join(of.arguments)}, by these names, in SI units.{either}

Parameters
----------
name : str
    Under which it is judged.
{options}
Returns
-------
callable
    The decorator of the function, which is called as before.

Raises
------
TypeError
    For an argument that it cannot have, with the list of those that it can, for too few, and for a name that is none.
{_refused(of)}
Examples
--------
>>> @validation.{kind}("my model")
... {shown}
>>> {function}.name
'my model'
"""


def _refused(of: OfferedKind) -> str:
    bounds = f"a residual that is not above zero or above {LOOSEST:g}, and cells below one"
    unjudged = f"ValueError\n    For no half-space, {bounds}.\n"
    return unjudged if of.check is _can_be_judged else ""


stiffness_model: Named = _decorator("stiffness_model")
stiffness_of_surface: Named = _decorator("stiffness_of_surface")
force_spectrum: Named = _decorator("force_spectrum")
rolling_model: Named = _decorator("rolling_model")
contact_filter: Named = _decorator("contact_filter")
profile_spectrum: Named = _decorator("profile_spectrum")
interface_model: Named = _decorator("interface_model")
contact_law: Named = _decorator("contact_law")
contact_solver: NamedSolver = _decorator("contact_solver")
