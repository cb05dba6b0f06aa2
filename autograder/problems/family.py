"""What a family of variants is, and the options that an instructor may set."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from autograder.errors import UsageError
from autograder.problems.band import Band
from autograder.problems.circulation import Circulation, Draw, Pairs, rounds_of
from autograder.problems.exact import decimal
from autograder.problems.stream import Stream

__all__ = ["Family", "Options", "circulating", "parse_options"]

FEWEST_POSES = 3
MOST_POSES = 24  # with steps up to 3 m they stay within the 100 m that the contract judges


@dataclass(frozen=True)
class Options:
    """What may be changed about a family; None keeps the family's own value.

    Parameters
    ----------
    poses : int, optional
        Number of poses, 3 to 24.
    loops : tuple of pairs, optional
        Loop closures (i, j), i + 1 < j.
    prior_mean : Fraction, optional
        Mean of the prior on pose 0 [m].
    decimals : int, optional
        Most decimals of any number of the problem and its answer: 1, 2 or 3.

    Raises
    ------
    UsageError
        Where a value is out of its range.
    """

    poses: int | None = None
    loops: Pairs | None = None
    prior_mean: Fraction | None = None
    decimals: int | None = None

    def __post_init__(self) -> None:
        if self.poses is not None and not FEWEST_POSES <= self.poses <= MOST_POSES:
            raise UsageError(f"Option poses is {self.poses}; expected {FEWEST_POSES} to {MOST_POSES}.")
        if self.decimals not in {None, 1, 2, 3}:
            raise UsageError(f"Option decimals is {self.decimals}; expected 1, 2 or 3.")

    @property
    def text(self) -> str:
        """The options as they are written after the family's name; "" where none is set."""
        words = [
            f"poses={self.poses}" if self.poses is not None else "",
            "loops=" + "+".join(f"{i}-{j}" for i, j in self.loops) if self.loops is not None else "",
            f"prior_mean={decimal(self.prior_mean)}" if self.prior_mean is not None else "",
            f"decimals={self.decimals}" if self.decimals is not None else "",
        ]
        return ",".join(word for word in words if word)


@dataclass(frozen=True)
class Family:
    """A kind of variant: how one is drawn, and what all have in common.

    Parameters
    ----------
    letter, name : str
        Short and long name; both may be typed.
    draw : callable
        Draws a problem with its answer from a stream.
    band : Band
        The difficulty band.
    options : Options
        What was changed about it.
    landmarks : tuple of int
        Unknowns that are landmarks and not poses.
    by_hand : bool
        Whether it is meant to be solved by hand as well.
    personal : bool
        Whether no two students may have the same numbers.
    raw_count : int
        Number of different data before any filter.
    """

    letter: str
    name: str
    draw: Callable[[Stream], Draw]
    band: Band
    options: Options
    landmarks: tuple[int, ...] = ()
    by_hand: bool = True
    personal: bool = True
    raw_count: int = 1

    @property
    def label(self) -> str:
        """Letter and options: what the ledger stores, what the stream depends on, and what may be typed."""
        return f"{self.letter}:{self.options.text}" if self.options.text else self.letter


def circulating(
    letter: str,
    name: str,
    *,
    poses: int,
    loops: Pairs,
    options: Options,
    prior_means: Sequence[int] = (0,),
    tree: Pairs | None = None,
    landmarks: tuple[int, ...] = (),
    equal_variances: bool = False,
    both_signs: bool = True,
    by_hand: bool = True,
    long_numbers: tuple[int, int],
) -> Family:
    """Build a family whose problems are circulations round the loops of one topology.

    Parameters
    ----------
    letter, name : str
        Its names.
    poses : int
        Unknowns, where the options say nothing.
    loops : tuple of pairs
        Loop closures, where the options say nothing.
    options : Options
        What the instructor changed.
    prior_means : sequence of int
        Means of the prior, one of which is drawn [m].
    tree : tuple of pairs, optional
        What dead reckoning walks; the chain 0 -> 1 -> ... where not given.
    landmarks : tuple of int
        Unknowns that are landmarks.
    equal_variances, both_signs, by_hand : bool
        One variance for all edges; forces of both signs; meant for a solution by hand.
    long_numbers : tuple of int
        Least and most measurements with all decimals.

    Raises
    ------
    UsageError
        Where the options make no problem.
    """
    decimals = 2 if options.decimals is None else options.decimals
    n = options.poses or poses
    chain = tuple((k, k + 1) for k in range(n - 1)) if tree is None else tree
    closures = options.loops if options.loops is not None else loops
    _check_loops(closures, n, chain)
    means = tuple(map(Fraction, prior_means)) if options.prior_mean is None else (options.prior_mean,)
    if any(10**decimals % mean.denominator or abs(mean) > 10 for mean in means):
        raise UsageError(
            f"Option prior_mean is {decimal(means[0])}; expected at most {decimals} decimals, from -10 to 10."
        )
    # Forces in halves: with one decimal only variance times 10 is short, with three decimals halves are.
    sizes = {1: (20,), 2: (6, 8, 10, 12, 14), 3: (5, 7, 9, 11, 13)}[decimals]
    if equal_variances:
        sizes = {1: (20,), 2: (6, 10, 14, 18), 3: (5, 7, 9, 11, 13)}[decimals]
    half_forces = tuple(-size for size in sizes) + (sizes if both_signs else ())
    products = len({row for path in rounds_of(chain, closures) for row, _ in path}) + len(closures)
    low, high = long_numbers if decimals == 2 and not options.text else (0, len(chain) + len(closures))
    largest = Fraction((25 if decimals == 1 else 10) * len(closures) * max(7, products), 7)
    band = Band(n, len(closures), products, decimals, (low, high), (Fraction(3, 4), largest))
    plan = Circulation(
        tree=chain,
        loops=closures,
        band=band,
        steps=(-3, -2, -1, 1, 2, 3),
        offsets=(-2, -1, 0, 1, 2),
        variances=(1, 2, 4, 5),
        half_forces=half_forces,
        prior_means=means,
        equal_variances=equal_variances,
    )
    return Family(
        letter, name, plan.draw, band, options, landmarks=landmarks, by_hand=by_hand, raw_count=plan.raw_count
    )


def _check_loops(loops: Pairs, poses: int, chain: Pairs) -> None:
    if not loops:
        raise UsageError("Option loops is empty; expected at least one loop closure, such as loops=0-4.")
    for i, j in loops:
        if not (0 <= i < j < poses) or (i, j) in chain:
            raise UsageError(f"Loop {i}-{j} does not fit {poses} poses; expected i-j with i + 1 < j < {poses}.")
    if len(set(loops)) < len(loops):
        raise UsageError("Option loops names a loop twice; expected each once.")


def parse_options(text: str) -> Options:
    """Read options such as "poses=6,loops=0-5+1-4,prior_mean=2,decimals=1".

    Raises
    ------
    UsageError
        Where a word is no option, or its value does not fit.

    Examples
    --------
    >>> parse_options("poses=6,loops=0-3+2-5").text
    'poses=6,loops=0-3+2-5'
    """
    values: dict[str, str] = {}
    for word in filter(None, (word.strip() for word in text.split(","))):
        key, equals, value = (part.strip() for part in word.partition("="))
        pattern = _PATTERNS.get(key)
        if pattern is None or not equals:
            raise UsageError(f"Family option {word!r} is unknown; expected one of {', '.join(_PATTERNS)} with a value.")
        if not re.fullmatch(pattern, value, re.ASCII):
            raise UsageError(f"Family option {key} has the value {value!r}; expected for example {_EXAMPLES[key]}.")
        if key in values:
            raise UsageError(f"Family option {key} is set twice; expected once.")
        values[key] = value
    pairs = [pair.split("-") for pair in values["loops"].split("+")] if "loops" in values else None
    return Options(
        poses=int(values["poses"]) if "poses" in values else None,
        loops=tuple((int(i), int(j)) for i, j in pairs) if pairs is not None else None,
        prior_mean=Fraction(values["prior_mean"]) if "prior_mean" in values else None,
        decimals=int(values["decimals"]) if "decimals" in values else None,
    )


_PATTERNS = {
    "poses": r"\d{1,3}",
    "loops": r"\d{1,3}-\d{1,3}(\+\d{1,3}-\d{1,3})*",
    "prior_mean": r"-?\d{1,3}(\.\d{1,3})?",
    "decimals": r"\d",
}
_EXAMPLES = {"poses": "poses=6", "loops": "loops=0-5+1-4", "prior_mean": "prior_mean=1.5", "decimals": "decimals=2"}
