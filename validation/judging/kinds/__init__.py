"""What each kind of model is judged by, and its references."""
