"""Our solver beside those of others."""
