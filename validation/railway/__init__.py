"""A wheel on a real rail."""
