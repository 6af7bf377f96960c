"""Models from elsewhere beside the references: what each kind is judged by."""
