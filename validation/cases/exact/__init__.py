"""Cases with an exact answer."""
