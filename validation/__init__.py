"""Contact models of one dimension beside boundary elements: which is accurate enough for a scene, and at what cost.

Examples assume ``import validation`` and ``import numpy as np``. Lengths are in metres, forces in newtons.
"""

from importlib import import_module
from importlib.util import find_spec

# a module is imported when its name is first used: rooms import rooms, and none of them needs all others
MODULES = {
    "CASES": "report.contents",
    "Comparison": "advice.compare",
    "IndentationScene": "scenes.indentation",
    "Material": "scenes.material",
    "JudgedNumber": "judging.judgement",
    "JudgedRange": "judging.judgement",
    "Judgement": "judging.judge",
    "KnownContact": "benchmarks.discrete",
    "MeasuredHeights": "scenes.measured_heights",
    "RailScene": "railway.scenes.rail",
    "RollingScene": "scenes.rolling",
    "Roughness": "scenes.roughness",
    "Tolerance": "advice.tolerance",
    "Verdict": "analysis.evidence",
    "WheelScene": "scenes.dynamic_wheel",
    "compare": "advice.compare",
    "contact_filter": "judging.registry",
    "contact_law": "judging.registry",
    "contact_solver": "judging.registry",
    "force_spectrum": "judging.registry",
    "interface_model": "judging.registry",
    "judge": "judging.judge",
    "load_scene": "scenes.load",
    "load_wheel_scene": "scenes.dynamic_wheel",
    "measured": "scenes.measured_surface",
    "problems": "benchmarks.discrete",
    "profile_spectrum": "judging.registry",
    "rolling_model": "judging.registry",
    "stiffness_model": "judging.registry",
    "stiffness_of_surface": "judging.registry",
    "summary": "advice.summary",
    "to_csv": "advice.exported",
    "to_figure": "advice.figure",
    "to_json": "advice.exported",
}
"""Where each name of the face is defined; `__init__.pyi` says the same to type checkers and editors."""
MODULES = {name: module for name, module in MODULES.items() if find_spec(f"{__name__}.{module.partition('.')[0]}")}
# of the packages that are there

__all__ = list(MODULES)


def __getattr__(name: str) -> object:
    if name not in MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{MODULES[name]}"), name)


def __dir__() -> list[str]:
    """The names of the face, and none of what this module imports."""
    return sorted([*(name for name in globals() if name.startswith("__")), *MODULES])
