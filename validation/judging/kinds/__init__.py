"""What each kind of model is judged by, and its references.

Who adds a kind adds it to `JUDGES` of `judge`, and, as it applies, to `JUDGES` of `held_out_points`, `OF_ANSWERS` and
`SWEEPS` of `properties` and `MAIN` of `own`; to `SOURCES` of `from_report` where a report has its reference; to
`SERVED` of `validation.judging.own_models` where `compare` takes it.
"""
