"""Contact models: a function with a declaration each."""
