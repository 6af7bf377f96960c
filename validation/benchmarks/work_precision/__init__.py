"""Error against cost of every method."""
