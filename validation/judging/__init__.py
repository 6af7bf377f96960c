"""Models and solvers from elsewhere, judged beside the references of the suite."""
