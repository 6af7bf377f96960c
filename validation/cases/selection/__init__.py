"""Model selection, tested."""
