"""Contact filters as models of `compare`."""
