"""Error against cost of every method."""

from functools import partial

from validation.report.commands import timed

describe = partial(timed.describe, name="precision")
