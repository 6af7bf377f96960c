"""The dynamic wheel."""
