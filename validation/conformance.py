"""Properties that every contact solver and every rule for profiles has, as tests for their author.

``pytest --pyargs validation.conformance --mdr-solver my_solver.py:solve --mdr-mapping my_rule.py:rule``

The file is run as a program. Without an option `bem3d` and Geike's rule are tested. A failure ends with the smallest
example that hypothesis finds, as arrays that can be pasted.
"""

from validation.judging.pytest_properties import (
    asked,
    rule,
    test_a_contact_solver_has_the_property,
    test_a_rule_has_the_properties,
)

__all__ = ["asked", "rule", "test_a_contact_solver_has_the_property", "test_a_rule_has_the_properties"]
