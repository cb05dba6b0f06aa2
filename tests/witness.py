"""An independent witness: the formulas of the handout in exact rational arithmetic; no code of the product."""

from fractions import Fraction

from assignment.posegraph import PoseGraph

Vector = list[Fraction]
Matrix = list[Vector]


def rational(values) -> Vector:
    """Read decimals as people write them: 0.1 is one tenth."""
    return [Fraction(repr(float(value))) for value in values]


def exact_problem(x, graph: PoseGraph) -> tuple[Vector, Matrix, Vector]:
    """Return f, J and the diagonal of Omega, row by row from the definition of each factor."""
    x = rational(x)
    f: Vector = []
    J: Matrix = []
    for (i, j), u in zip(graph.edges.tolist(), rational(graph.measurements), strict=True):
        f.append(x[i] + u - x[j])
        J.append([Fraction((c == i) - (c == j)) for c in range(graph.n_poses)])
    for k, mean in zip(graph.priors.tolist(), rational(graph.prior_means), strict=True):
        f.append(x[k] - mean)
        J.append([Fraction(int(c == k)) for c in range(graph.n_poses)])
    return f, J, [1 / v for v in rational([*graph.edge_variances, *graph.prior_variances])]


def exact_normal_equations(f: Vector, J: Matrix, weights: Vector) -> tuple[Matrix, Vector]:
    """Return H and b as sums over the rows of J."""
    n = len(J[0])
    H = [[sum(w * row[a] * row[c] for row, w in zip(J, weights, strict=True)) for c in range(n)] for a in range(n)]
    b = [sum(w * row[a] * r for row, w, r in zip(J, weights, f, strict=True)) for a in range(n)]
    return H, b


def exact_solve(H: Matrix, rhs: Vector) -> Vector:
    """Solve a regular system by Gauss-Jordan elimination."""
    n = len(rhs)
    rows = [[*row, value] for row, value in zip(H, rhs, strict=True)]
    for c in range(n):
        pivot = next(r for r in range(c, n) if rows[r][c] != 0)
        rows[c], rows[pivot] = rows[pivot], rows[c]
        rows[c] = [value / rows[c][c] for value in rows[c]]
        for r in range(n):
            if r != c and rows[r][c] != 0:
                factor = rows[r][c]
                rows[r] = [a - factor * p for a, p in zip(rows[r], rows[c], strict=True)]
    return [row[n] for row in rows]


def exact_step(x, graph: PoseGraph) -> Vector:
    """Return the Gauss-Newton step from x."""
    H, b = exact_normal_equations(*exact_problem(x, graph))
    return exact_solve(H, [-value for value in b])
