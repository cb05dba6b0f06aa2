"""The reference reproduces the worked example to the last digit, and the source's misprint is a misprint."""

from fractions import Fraction

import numpy as np

from autograder.problems.families.worked_example import worked_example
from reference_solution import slam1d
from tests.witness import exact_normal_equations, exact_problem, exact_step

GRAPH = worked_example()
START = GRAPH.dead_reckoning()

H = np.array(
    [
        [1200, -100, 0, 0, -100],
        [-100, 200, -100, 0, 0],
        [0, -100, 200, -100, 0],
        [0, 0, -100, 200, -100],
        [-100, 0, 0, -100, 200],
    ]
)
B = np.array([-50, 0, 0, 0, 50])
STEP = np.array([0, -0.1, -0.2, -0.3, -0.4])


def test_start_is_dead_reckoning():
    """Dead reckoning gives (0, 1.1, 2.1, 3.2, 0.5)."""
    np.testing.assert_allclose(START, [0, 1.1, 2.1, 3.2, 0.5], atol=1e-15)


def test_residual():
    """F is zero but for the loop: (0, 0, 0, 0, -0.5, 0)."""
    np.testing.assert_allclose(slam1d.residual(START, GRAPH), [0, 0, 0, 0, -0.5, 0], atol=1e-15)


def test_jacobian():
    """J is the printed 6 x 5 matrix."""
    printed = [
        [1, -1, 0, 0, 0],
        [0, 1, -1, 0, 0],
        [0, 0, 1, -1, 0],
        [0, 0, 0, 1, -1],
        [1, 0, 0, 0, -1],
        [1, 0, 0, 0, 0],
    ]
    np.testing.assert_array_equal(slam1d.jacobian(START, GRAPH), printed)


def test_information_matrix():
    """Omega is diag(100 x 5, 1000)."""
    np.testing.assert_allclose(slam1d.information_matrix(GRAPH), np.diag([100.0] * 5 + [1000.0]), rtol=1e-15)


def test_normal_equations():
    """H[3, 3] is 200, and b = (-50, 0, 0, 0, 50)."""
    got_H, got_b = slam1d.normal_equations(
        slam1d.jacobian(START, GRAPH), slam1d.information_matrix(GRAPH), slam1d.residual(START, GRAPH)
    )
    np.testing.assert_allclose(got_H, H, rtol=1e-13)
    np.testing.assert_allclose(got_b, B, atol=1e-12)


def test_step_and_minimum():
    """Dx = (0, -.1, -.2, -.3, -.4) leads to (0, 1, 1.9, 2.9, .1)."""
    step = slam1d.gauss_newton_step(START, GRAPH)
    np.testing.assert_allclose(step, STEP, atol=1e-14)
    np.testing.assert_allclose(START + step, [0, 1.0, 1.9, 2.9, 0.1], atol=1e-14)


def test_printed_300_is_an_erratum():
    """The published step solves H dx = -b with H[3, 3] = 200 exactly; with 300 a rest of -30 stays in row 3."""
    exact_H, exact_b = exact_normal_equations(*exact_problem([0, 1.1, 2.1, 3.2, 0.5], GRAPH))
    assert exact_H == [[Fraction(int(value)) for value in row] for row in H]
    assert exact_b == [Fraction(int(value)) for value in B]
    step = exact_step([0, 1.1, 2.1, 3.2, 0.5], GRAPH)
    assert step == [Fraction(-k, 10) for k in range(5)]

    def rest(entry):
        rows = [list(row) for row in exact_H]
        rows[3][3] = Fraction(entry)
        return [sum(a * d for a, d in zip(row, step, strict=True)) + b for row, b in zip(rows, exact_b, strict=True)]

    assert rest(200) == [0] * 5
    assert rest(300) == [0, 0, 0, -30, 0]
