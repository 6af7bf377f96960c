"""The wheel on a real rail."""
