"""`.ci/calibrate.py` as a module."""

import importlib.util
import sys
from pathlib import Path

PLACE = Path(__file__).parents[2] / ".ci" / "calibrate.py"
SPEC = importlib.util.spec_from_file_location("calibrate_script", PLACE)
calibrate = importlib.util.module_from_spec(SPEC)
sys.modules[SPEC.name] = calibrate
SPEC.loader.exec_module(calibrate)


def run(*words):
    """Exit status of the script with these words."""
    return calibrate.main(words, calibrate.parser())
