"""Independent solves: seeds, workers, stored results."""
