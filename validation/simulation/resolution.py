"""What an answer must stand on to be one."""

FEWEST_IN_CONTACT = 6
"""Cells or springs: an answer that stands on fewer is that of the grid, and none."""


def too_few(count: float, what: str) -> str:
    """Why there is no answer where half of the contacts have fewer than six cells or springs; empty where they have."""
    if count >= FEWEST_IN_CONTACT:
        return ""
    return f"half of the contacts have {count:.2g} {what} or fewer: the answer would be that of the grid"
