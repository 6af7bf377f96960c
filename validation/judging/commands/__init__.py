"""Commands of this house, a module each."""
