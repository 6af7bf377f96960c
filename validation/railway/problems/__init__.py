"""One problem of a wheel on a rail in, plain arrays out."""
