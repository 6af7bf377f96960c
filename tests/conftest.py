import os

import pytest
from hypothesis import HealthCheck, Phase, settings

settings.register_profile(
    "default", deadline=None, derandomize=True, max_examples=40, suppress_health_check=[HealthCheck.too_slow]
)
settings.register_profile("thorough", deadline=None, max_examples=2000, suppress_health_check=[HealthCheck.too_slow])
# few and always the same, and none smaller once one has failed: see mutation/runner.py
settings.register_profile(
    "mutation",
    settings.get_profile("default"),
    max_examples=20,
    phases=[Phase.explicit, Phase.generate],
    database=None,
    report_multiple_bugs=False,
)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "default"))


def pytest_configure(config):
    # not in pyproject.toml, which would import them before their coverage is measured
    for package in ("bem3d", "mdr"):
        config.addinivalue_line("filterwarnings", f"ignore::{package}.ContactWarning")


@pytest.fixture
def without_figures(monkeypatch):
    """Reports hold stand-ins for their figures, which take longest."""
    # imported here, since coverage is measured from the first import
    from validation.report import pictures

    monkeypatch.setattr(pictures, "draw_figure", lambda name, *rest: f"<svg>{name}</svg>".encode())
