"""The problem model: pose graphs on a line, and ranges to a beacon beside it.

Of the files that you are given, this is the one to read: your functions use its fields.
`help(PoseGraph)` prints the same. It needs numpy only.
"""

from dataclasses import dataclass, fields
from typing import Any, List, Tuple

import numpy as np

__all__ = ["PoseGraph", "Ranging"]


@dataclass(frozen=True, eq=False, repr=False)
class PoseGraph:
    """Poses on a line, tied together by measurements.

    The worked example of the handout, five poses and one loop closure::

            1.1      1.0      1.1      -2.7
        x0 -----> x1 -----> x2 -----> x3 -----> x4        odometry
         |                                       ^
         +---------------------------------------+        loop closure
                           0.0
        (x0 also has a prior: it is believed to stand at 0)

    Every arrow is one *between* factor, a row of `edges`; the belief about x0 is a *prior* factor.
    The rows of f, J and Omega are ordered like this: edges in the given order, then priors in
    the given order.

    Parameters
    ----------
    n_poses : int
        Number n >= 2 of unknowns x_0 .. x_{n-1} (a landmark is one more unknown).
    edges : (k, 2) int array
        Row (i, j): a between factor from pose i to pose j; any order, j < i is allowed.
    measurements : (k,) float array
        Measured displacement u_ij from x_i to x_j [m].
    edge_variances : (k,) float array
        Variance of each measurement [m^2], > 0.
    priors : (p,) int array
        Poses that carry a prior factor.
    prior_means : (p,) float array
        Prior means [m].
    prior_variances : (p,) float array
        Prior variances [m^2], > 0.

    Raises
    ------
    ValueError
        Where a field breaks a rule; the message names the field, the rule and the value.

    Examples
    --------
    >>> graph = PoseGraph(
    ...     n_poses=3,
    ...     edges=[(0, 1), (1, 2), (0, 2)],
    ...     measurements=[1.0, 1.1, 2.0],
    ...     edge_variances=[0.01, 0.01, 0.04],
    ...     priors=[0],
    ...     prior_means=[0.0],
    ...     prior_variances=[0.001],
    ... )
    >>> graph.n_factors
    4
    >>> graph.dead_reckoning()
    array([0. , 1. , 2.1])
    >>> graph
    PoseGraph with 3 poses, 3 edges and 1 prior
      row 0: edge 0 -> 1, measured 1 m, variance 0.01 m^2
      row 1: edge 1 -> 2, measured 1.1 m, variance 0.01 m^2
      row 2: edge 0 -> 2, measured 2 m, variance 0.04 m^2
      row 3: prior on 0, mean 0 m, variance 0.001 m^2
    """

    n_poses: int
    edges: np.ndarray
    measurements: np.ndarray
    edge_variances: np.ndarray
    priors: np.ndarray
    prior_means: np.ndarray
    prior_variances: np.ndarray

    def __post_init__(self) -> None:
        if isinstance(self.n_poses, bool) or not isinstance(self.n_poses, (int, np.integer)):
            raise ValueError(f"n_poses must be an integer, got {self.n_poses!r}")
        if self.n_poses < 2:
            raise ValueError(f"n_poses must be at least 2, got {self.n_poses}")
        _set(self, "n_poses", int(self.n_poses))
        _set(self, "edges", _integers("edges", self.edges, pairs=True))
        _set(self, "priors", _integers("priors", self.priors))
        k, p = len(self.edges), len(self.priors)
        for name, length in (
            ("measurements", k),
            ("edge_variances", k),
            ("prior_means", p),
            ("prior_variances", p),
        ):
            _set(self, name, _reals(name, getattr(self, name), length))
        _require_poses("edges", self.edges, self.n_poses)
        _require_poses("priors", self.priors, self.n_poses)
        loops = np.flatnonzero(self.edges[:, 0] == self.edges[:, 1])
        if loops.size:
            row = int(loops[0])
            raise ValueError(f"edges must join two different poses, got {tuple(self.edges[row].tolist())} in row {row}")
        _require_positive("edge_variances", self.edge_variances)
        _require_positive("prior_variances", self.prior_variances)

    @property
    def n_factors(self) -> int:
        """Number m = k + p of factors, the rows of f and J."""
        return len(self.edges) + len(self.priors)

    def dead_reckoning(self) -> np.ndarray:
        """Add up the measurements from the first prior of each connected part: the start state.

        Sweeps over the edges in the given order, again and again until nothing new is reached. An
        edge with one end known places its other end; walked from j to i it counts with the
        opposite sign. Each pose is placed once, so a loop closure that comes after the odometry
        changes nothing.

        Returns
        -------
        (n,) float array
            A position for every pose [m].

        Raises
        ------
        ValueError
            Where a connected part of the graph has no prior to start from.

        Examples
        --------
        >>> PoseGraph(2, [(1, 0)], [-1.5], [0.01], [0], [2.0], [0.001]).dead_reckoning()
        array([2. , 3.5])
        """
        edges = [(i, j, u) for (i, j), u in zip(self.edges.tolist(), self.measurements.tolist())]
        x = np.full(self.n_poses, np.nan)
        for pose, mean in zip(self.priors.tolist(), self.prior_means.tolist()):
            if np.isnan(x[pose]):
                x[pose] = mean
                _spread(x, edges)
        lost = np.flatnonzero(np.isnan(x))
        if lost.size:
            raise ValueError(
                f"priors must hold a pose of every connected part, got none for the part of pose {int(lost[0])}"
            )
        return x

    def __eq__(self, other: object) -> bool:
        return _equal(self, other)

    def __hash__(self) -> int:
        return _hash(self)

    def __reduce__(self) -> Tuple[Any, ...]:
        return type(self), _values(self)

    def __repr__(self) -> str:
        k, p = len(self.edges), len(self.priors)
        lines = [f"PoseGraph with {self.n_poses} poses, {k} edge{'s' * (k != 1)} and {p} prior{'s' * (p != 1)}"]
        for row, ((i, j), u, v) in enumerate(
            zip(self.edges.tolist(), self.measurements.tolist(), self.edge_variances.tolist())
        ):
            lines.append(f"row {row}: edge {i} -> {j}, measured {u:g} m, variance {v:g} m^2")
        for row, (i, mean, v) in enumerate(
            zip(self.priors.tolist(), self.prior_means.tolist(), self.prior_variances.tolist()), k
        ):
            lines.append(f"row {row}: prior on {i}, mean {mean:g} m, variance {v:g} m^2")
        return "\n  ".join(lines)


@dataclass(frozen=True, eq=False, repr=False)
class Ranging:
    """Measured distances from poses on the line to one beacon beside it.

    ::

                       o  beacon (b0, b1)
                     . |
            range  .   | b1
                 .     |
        -------x_i-----+--------- the line: pose x_i stands at (x_i, 0)
                       b0

    Parameters
    ----------
    beacon : (2,) float array
        Position of the beacon in the plane [m]; off the line, so its second coordinate is not 0.
    poses : (q,) int array
        Pose of each measurement.
    ranges : (q,) float array
        Measured distances [m], >= 0.
    variances : (q,) float array
        Variance of each measurement [m^2], > 0.

    Raises
    ------
    ValueError
        Where a field breaks a rule; the message names the field, the rule and the value.

    Examples
    --------
    >>> Ranging(beacon=[2.0, 1.0], poses=[3], ranges=[1.4], variances=[0.01])
    Ranging to a beacon at (2, 1)
      row 0: pose 3, measured 1.4 m, variance 0.01 m^2
    """

    beacon: np.ndarray
    poses: np.ndarray
    ranges: np.ndarray
    variances: np.ndarray

    def __post_init__(self) -> None:
        _set(self, "beacon", _reals("beacon", self.beacon, 2))
        if self.beacon[1] == 0:
            raise ValueError(f"beacon must stand off the line (second coordinate not 0), got {self.beacon.tolist()}")
        _set(self, "poses", _integers("poses", self.poses))
        q = len(self.poses)
        _set(self, "ranges", _reals("ranges", self.ranges, q))
        _set(self, "variances", _reals("variances", self.variances, q))
        if q and self.poses.min() < 0:
            raise ValueError(f"poses must be at least 0, got {int(self.poses.min())}")
        if q and self.ranges.min() < 0:
            raise ValueError(f"ranges must be at least 0, got {float(self.ranges.min())!r}")
        _require_positive("variances", self.variances)

    def __eq__(self, other: object) -> bool:
        return _equal(self, other)

    def __hash__(self) -> int:
        return _hash(self)

    def __reduce__(self) -> Tuple[Any, ...]:
        return type(self), _values(self)

    def __repr__(self) -> str:
        lines = ["Ranging to a beacon at ({:g}, {:g})".format(*self.beacon.tolist())]
        for row, (k, z, v) in enumerate(zip(self.poses.tolist(), self.ranges.tolist(), self.variances.tolist())):
            lines.append(f"row {row}: pose {k}, measured {z:g} m, variance {v:g} m^2")
        return "\n  ".join(lines)


def _spread(x: np.ndarray, edges: List[Tuple[int, int, float]]) -> None:
    reached = True
    while reached:
        reached = False
        for i, j, u in edges:
            if np.isnan(x[i]) != np.isnan(x[j]):
                if np.isnan(x[j]):
                    x[j] = x[i] + u
                else:
                    x[i] = x[j] - u
                reached = True


_set = object.__setattr__  # the dataclasses are frozen; construction is the one place that may write


def _frozen(array: np.ndarray) -> np.ndarray:
    """Copy into memory that nobody can make writeable again: a view of immutable bytes."""
    return np.frombuffer(array.tobytes(), dtype=array.dtype).reshape(array.shape)


def _integers(name: str, value: Any, pairs: bool = False) -> np.ndarray:
    rule = "hold pairs of integers, shape (k, 2)" if pairs else "hold integers, shape (p,)"
    array = _array(name, value, rule)
    if array.size == 0:
        array = np.empty((0, 2) if pairs else (0,), dtype=np.int64)
    if array.dtype.kind not in "iu":
        raise ValueError(f"{name} must {rule}, got {_shown(value)}")
    if array.ndim != (2 if pairs else 1) or (pairs and array.shape[1] != 2):
        raise ValueError(f"{name} must {rule}, got shape {array.shape}")
    return _frozen(array.astype(np.int64))


def _reals(name: str, value: Any, length: int) -> np.ndarray:
    rule = f"hold {length} real number{'s' * (length != 1)}"
    array = _array(name, value, rule)
    if array.size and array.dtype.kind not in "iuf":
        raise ValueError(f"{name} must {rule}, got {_shown(value)}")
    if array.shape != (length,):
        raise ValueError(f"{name} must {rule}, got shape {array.shape}")
    array = array.astype(np.float64)
    if not np.isfinite(array).all():
        raise ValueError(f"{name} must be finite, got {_shown(value)}")
    return _frozen(array + 0.0)  # + 0.0 turns -0. into 0., so that equal graphs have equal bytes


def _array(name: str, value: Any, rule: str) -> np.ndarray:
    try:
        return np.asarray(value)
    except (TypeError, ValueError):
        raise ValueError(f"{name} must {rule}, got {_shown(value)}") from None


def _shown(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


def _require_poses(name: str, poses: np.ndarray, n_poses: int) -> None:
    wrong = poses[(poses < 0) | (poses >= n_poses)]
    if wrong.size:
        raise ValueError(f"{name} must name poses 0 to {n_poses - 1}, got {int(wrong.flat[0])}")


def _require_positive(name: str, variances: np.ndarray) -> None:
    wrong = variances[variances <= 0]
    if wrong.size:
        raise ValueError(f"{name} must be > 0, got {float(wrong[0])!r}")


def _values(record: Any) -> Tuple[Any, ...]:
    return tuple(getattr(record, field.name) for field in fields(record))


def _equal(record: Any, other: object) -> bool:
    if type(other) is not type(record):
        return False
    return all(np.array_equal(a, b) for a, b in zip(_values(record), _values(other)))


def _hash(record: Any) -> int:
    return hash(tuple(value.tobytes() if isinstance(value, np.ndarray) else value for value in _values(record)))
