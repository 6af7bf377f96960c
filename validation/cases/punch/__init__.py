"""Rough punches."""
