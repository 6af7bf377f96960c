"""The rule is exact for polynomials, and the same arrays each time."""

import numpy as np
import pytest

from validation.theory.half_space import gauss_legendre, on_panels


@pytest.mark.parametrize("nodes", [2, 5, 20])
def test_a_rule_is_exact_up_to_its_degree_and_kept(nodes):
    node, weight = gauss_legendre(nodes)
    for power in range(2 * nodes):
        assert weight @ node**power == pytest.approx((1 + (-1) ** power) / (power + 1), abs=1e-14)
    assert abs(weight @ node ** (2 * nodes) - 2 / (2 * nodes + 1)) > 1e-14
    assert gauss_legendre(nodes)[0] is node
    with pytest.raises(ValueError, match="read-only"):
        np.multiply(node, 2, out=node)


def test_a_rule_on_panels_is_exact_on_their_union():
    x, weight = on_panels([1.0, 1.5, 4.0], 3)
    assert x.size == 6 and (np.diff(x) > 0).all()
    assert weight @ x**5 == pytest.approx((4**6 - 1) / 6, rel=1e-14)
