"""Rolling force."""
