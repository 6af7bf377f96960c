"""Contact models, a file each: a module that holds a `MODEL` is found by being here."""
