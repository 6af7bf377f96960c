"""Contact filters, and what lies across a line."""
