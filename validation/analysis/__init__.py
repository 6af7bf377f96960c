"""Statistics, spectra and verdicts."""
