"""Slips of `normal_equations`: what comes instead of H and b, for any real J and f.

`minimum_poses` counts the columns of J here.
"""
# ruff: noqa: ARG001, D401 - a slip has the stage's signature, used or not, and its docstring states what is wrong

from __future__ import annotations

import numpy as np

from autograder.stages.slips import narrow
from autograder.stages.slips.catalogue import Catalogue
from autograder.stages.slips.patterns import product_sizes, regularised, rounded, single_precision
from reference_solution import slam1d as right

Pair = tuple[np.ndarray, np.ndarray]

slip = Catalogue()


@slip("H1", minimum_poses=1)
def b_has_opposite_sign(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """The vector b has the opposite sign.

    The minus stands in the equation that is solved for the step, not in b; write it in one place only.
    """
    H, b = right.normal_equations(J, omega, f)
    return H, -b


@slip("H2", minimum_poses=1)
def weights_missing_in_b(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """The vector b is formed without the weights.

    H and b come from the same cost: every factor must count in both with the same weight.
    """
    return J.T @ omega @ J, J.T @ f


@slip("H3", minimum_poses=1)
def weights_missing_in_h(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """H is formed without the weights.

    H says how firmly the poses are held; can a loose measurement hold as firmly as a tight one?
    """
    return J.T @ J, J.T @ omega @ f


@slip("H4", minimum_poses=1)
def weights_missing_in_both(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """H and b are both formed without the weights.

    That is least squares without weights: the tight measurements and the loose ones pull alike. Where does Omega go?
    """
    return J.T @ J, J.T @ f


@slip("H5", minimum_poses=1)
def first_weight_for_all_in_h(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """H gives every factor the first weight.

    The diagonal of Omega need not be constant, so no single number can be pulled out in front of the product.
    """
    return omega[0, 0] * (J.T @ J), J.T @ omega @ f


@slip(minimum_poses=1)  # H5 carried through to b
def first_weight_for_all_in_both(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """H and b both give every factor the first weight.

    Equal weights are an accident of the odometry in the worked example; each row has a weight of its own.
    """
    return omega[0, 0] * (J.T @ J), omega[0, 0] * (J.T @ f)


@slip(minimum_poses=1)
def weights_applied_twice(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """The weights are applied twice.

    J is not weighted yet when it arrives; how often does Omega stand in the formula?
    """
    return J.T @ omega @ omega @ J, J.T @ omega @ omega @ f


@slip(minimum_poses=1)
def square_roots_of_weights(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """The square roots of the weights are used in place of the weights.

    Whitening scales J and f by the square root, each once; in the product of two whitened things the root is squared.
    """
    root = np.sqrt(omega)
    return J.T @ root @ J, J.T @ root @ f


@slip(minimum_poses=1)
def b_half_whitened(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """The vector b is made of a whitened J and an f that is not whitened.

    Whitening is one change of units for the whole row: it must be applied to both sides or to none.
    """
    return J.T @ omega @ J, J.T @ np.sqrt(omega) @ f


@slip(minimum_poses=1)
def weights_inverted_again(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """Omega is inverted, as if it were the covariance.

    What arrives is the information matrix already; large entries belong to the factors that are certain.
    """
    covariance = np.linalg.inv(omega)
    return J.T @ covariance @ J, J.T @ covariance @ f


@slip(minimum_poses=1)
def b_doubled(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """The vector b is the whole gradient of the cost, twice what it should be.

    The square brings a factor 2 to the gradient and to the Hessian alike; the handout drops it from both.
    """
    H, b = right.normal_equations(J, omega, f)
    return H, 2.0 * b


@slip(minimum_poses=1)
def h_doubled(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """H is the whole Hessian of the cost, twice what it should be.

    With b as the handout has it, a doubled H halves the step; the 2 must be kept in both or dropped from both.
    """
    H, b = right.normal_equations(J, omega, f)
    return 2.0 * H, b


@slip(minimum_poses=1)
def factor_two_kept_in_both(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """H and b are the whole Hessian and gradient, both twice what they should be.

    The step is the same, and other texts do it; here H is to be the information of the state, without the 2.
    """
    H, b = right.normal_equations(J, omega, f)
    return 2.0 * H, 2.0 * b


@slip("H8", minimum_poses=4)
def diagonal_copied_from_notes(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """Entry (3, 3) of H is 300, a number that was printed once by mistake.

    Without the prior every row of a graph's H adds up to 0; trust your product, not a printed number.
    """
    H, b = right.normal_equations(J, omega, f)
    if len(H) > 3:
        H[3, 3] = 300.0
    return H, b


@slip(minimum_poses=1)
def normal_equations_of_worked_example(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """H and b are those of the worked example.

    Those numbers hold for one graph at one state; make them from the J, Omega and f that you are given.
    """
    H = np.diag([1200.0, 200.0, 200.0, 200.0, 200.0])
    for i, j in [(0, 1), (1, 2), (2, 3), (3, 4), (0, 4)]:
        H[i, j] = H[j, i] = -100.0
    return H, np.array([-50.0, 0.0, 0.0, 0.0, 50.0])


@slip("H11", minimum_poses=1)
def h_assigned_instead_of_added(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """Where several factors share an entry of H, the last one overwrites the others.

    Every factor brings its own certainty to the poses that it touches; what do two certainties about one pose do?
    """
    n = J.shape[1]
    H = np.zeros((n, n))
    for row, weight in zip(J, np.diag(omega), strict=True):
        for a in np.flatnonzero(row):
            for c in np.flatnonzero(row):
                H[a, c] = weight * row[a] * row[c]
    return H, J.T @ omega @ f


@slip(minimum_poses=1)
def b_assigned_instead_of_added(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """Where several factors pull at one pose, the last one overwrites the others in b.

    b balances all the pulls at a pose; how do forces at one point combine?
    """
    b = np.zeros(J.shape[1])
    for row, weight, value in zip(J, np.diag(omega), f, strict=True):
        for a in np.flatnonzero(row):
            b[a] = weight * row[a] * value
    return J.T @ omega @ J, b


@slip("H13")
def off_diagonal_signs_flipped(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """The entries of H beside the diagonal have the opposite sign.

    H is no table of who is joined to whom: the two poses of an edge stand in its row of J with different signs.
    """
    H, b = right.normal_equations(J, omega, f)
    return 2.0 * np.diag(np.diag(H)) - H, b


@slip()  # the same as H13 where J is that of a graph, but not for any J
def signs_dropped_in_h(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """H is formed from J without its signs.

    Products of entries with different signs are negative, and H needs them: they let the poses move together.
    """
    J_without_signs = np.abs(J)
    return J_without_signs.T @ omega @ J_without_signs, J.T @ omega @ f


@slip()
def only_diagonal_of_h(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """H holds its diagonal only.

    The entries beside the diagonal tie two poses together; without them each pose is corrected as if it were alone.
    """
    H, b = right.normal_equations(J, omega, f)
    return np.diag(np.diag(H)), b


@slip()
def only_upper_triangle_of_h(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """H is filled above its diagonal only.

    If pose i tells something about pose j, then pose j tells as much about pose i: what does that say about H?
    """
    H, b = right.normal_equations(J, omega, f)
    return np.triu(H), b


@slip(minimum_poses=1)
def returned_in_the_other_order(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """The vector is returned first and the matrix second.

    The order of a returned pair is part of the promise: H, then b.
    """
    H, b = right.normal_equations(J, omega, f)
    return b, H


@slip(minimum_poses=1)
def last_row_left_out(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """The last factor is left out.

    Count how often your loop runs; the last row, often a prior, has its say as well.
    """
    return right.normal_equations(J[:-1], omega[:-1, :-1], f[:-1])


@slip(minimum_poses=1, pattern=regularised)
def h_regularised(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """A small number is added to the diagonal of H.

    That helps where H is singular, but changes the question where it is not; why is it not singular here?
    """
    H, b = right.normal_equations(J, omega, f)
    return H + 1e-3 * np.eye(len(H)), b


@slip(minimum_poses=1, pattern=rounded(right.normal_equations, product_sizes))
def normal_equations_rounded(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """The numbers of H or b are rounded.

    Round what you print, never what you go on calculating with.
    """
    H, b = right.normal_equations(J, omega, f)
    return np.round(H, 4), np.round(b, 4)


@slip("S24", minimum_poses=1, pattern=single_precision(right.normal_equations, product_sizes, terms=64))
def normal_equations_in_single_precision(J: np.ndarray, omega: np.ndarray, f: np.ndarray) -> Pair:
    """H and b are worked out in single precision.

    Sums of large and small weights need every digit; what type do your arrays have?
    """
    return right.normal_equations(J.astype(np.float32), omega.astype(np.float32), f.astype(np.float32))


SLIPS = (*slip.entries, *narrow.EQUATIONS)
