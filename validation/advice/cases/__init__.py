"""Whether the errors that models claim hold."""
