"""The reference agrees with exact rational arithmetic on hundreds of generated graphs."""

import numpy as np
import pytest
from hypothesis import given, settings

from autograder.problems.strategies import STRATEGIES
from reference_solution import slam1d
from tests.witness import exact_normal_equations, exact_problem, exact_step


def _floats(values):
    return np.array([[float(v) for v in row] if isinstance(row, list) else float(row) for row in values])


@pytest.mark.parametrize("rung", sorted(STRATEGIES["graphs"]))
def test_every_function_agrees(rung):
    """f, J, Omega, H, b and dx are the exact rational values, rounded."""

    @settings(max_examples=80)
    @given(STRATEGIES["graphs"][rung])
    def agree(case):
        x, graph = case
        f, J, weights = exact_problem(x, graph)
        H, b = exact_normal_equations(f, J, weights)
        np.testing.assert_allclose(slam1d.residual(x, graph), _floats(f), atol=1e-12)
        np.testing.assert_array_equal(slam1d.jacobian(x, graph), _floats(J))
        np.testing.assert_allclose(slam1d.information_matrix(graph), np.diag(_floats(weights)), rtol=1e-14)
        got_H, got_b = slam1d.normal_equations(_floats(J), np.diag(_floats(weights)), _floats(f))
        scale = np.abs(_floats(H)).max()
        np.testing.assert_allclose(got_H, _floats(H), atol=1e-13 * scale)
        np.testing.assert_allclose(got_b, _floats(b), atol=1e-12 * scale * (1 + np.abs(x).max()))
        np.testing.assert_allclose(slam1d.gauss_newton_step(x, graph), _floats(exact_step(x, graph)), atol=1e-7)

    agree()
