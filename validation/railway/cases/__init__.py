"""Cases of a wheel on a real rail."""
