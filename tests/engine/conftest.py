"""Problems of solves that leave a trace."""

import pytest

from tests.engine.toys import Toy


@pytest.fixture
def problems(tmp_path):
    return [Toy(i, str(tmp_path / "log")) for i in range(5)]
