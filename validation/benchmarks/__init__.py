"""Cost against accuracy, and solvers of others."""
