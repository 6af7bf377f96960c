"""Contact models of one dimension beside boundary elements: which is accurate enough for a scene, and at what cost.

Examples assume ``import validation`` and ``import numpy as np``. Lengths are in metres, forces in newtons.
"""

from importlib import import_module

# a module is imported when its name is first used: rooms import rooms, and none of them needs all others
MODULES = {
    "CASES": "report.contents",
    "Comparison": "selection.compare",
    "IndentationScene": "scenes.indentation",
    "Material": "scenes.material",
    "Judgement": "report.judged",
    "MeasuredHeights": "scenes.measured",
    "RailScene": "scenes.rail",
    "RollingScene": "scenes.rolling",
    "Roughness": "scenes.roughness",
    "WheelScene": "scenes.dynamic_wheel",
    "compare": "selection.compare",
    "contact_filter": "engine.offered",
    "contact_law": "engine.offered",
    "contact_solver": "engine.offered",
    "force_spectrum": "engine.offered",
    "judge": "report.judged",
    "load_scene": "scenes.load",
    "load_wheel_scene": "scenes.dynamic_wheel",
    "measured": "scenes.measured_surface",
    "problems": "benchmarks.judging.discrete",
    "profile_spectrum": "engine.offered",
    "rolling_model": "engine.offered",
    "stiffness_model": "engine.offered",
    "stiffness_of_surface": "engine.offered",
    "summary": "selection.summary",
    "to_csv": "selection.exported",
    "to_figure": "report.compared",
    "to_json": "selection.exported",
}
"""Where each name of the face is defined; `__init__.pyi` says the same to type checkers and editors."""

__all__ = list(MODULES)


def __getattr__(name: str) -> object:
    if name not in MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{MODULES[name]}"), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *MODULES])
