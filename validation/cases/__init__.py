"""One file per piece of evidence; the list of them is that of the report."""
