"""The oldest versions that pyproject.toml allows, as constraints for pip: `python .ci/oldest.py > oldest.txt`."""

import tomllib
from pathlib import Path

project = tomllib.loads((Path(__file__).parents[1] / "pyproject.toml").read_text(encoding="utf-8"))
for wanted in [*project["project"]["dependencies"], *project["dependency-groups"]["test"]]:
    print(wanted.replace(">=", "=="))
