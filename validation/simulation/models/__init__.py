"""Contact models, a file a family; a model is found by being here."""
