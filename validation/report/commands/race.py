"""The solver comparison."""

from functools import partial

from validation.report.commands import timed

describe = partial(timed.describe, name="race")
