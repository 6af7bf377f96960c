"""Whether a contact solver is right, and what is wrong where it is not."""
