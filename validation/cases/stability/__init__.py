"""Stability of time stepping."""
