"""Contact models, a file each: a module that has models is found by being here."""
