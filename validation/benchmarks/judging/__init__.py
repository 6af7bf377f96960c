"""Whether a contact solver of anyone is right."""
