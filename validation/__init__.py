"""What compares the two methods: closed forms, cases, ensembles, evidence and the report."""
