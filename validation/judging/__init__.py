"""Models and solvers from elsewhere, judged beside the references of the suite."""

COMMANDS = {"judge": "judge a model or a solver of your own, by the decorated functions of a file"}
BRINGS = {
    "models_of_functions": "validation.judging.own_models:of_functions",
    "models_from": "validation.judging.options:ModelsFrom",
    "calibrations": "validation.judging.options:OfCalibrate",
    "solvers_of_files": "validation.judging.own_models:solvers_in",
}
SOLVER, MAPPING = "--mdr-solver", "--mdr-mapping"
"""Options of pytest for the tests of this house."""
