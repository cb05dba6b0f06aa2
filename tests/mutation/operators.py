"""Operators for what cosmic-ray does not know: matrix products, transposes, and the order in a list of things."""

from __future__ import annotations

from collections.abc import Iterator
from copy import deepcopy
from typing import Any

from cosmic_ray.operators.operator import Operator
from parso.python.tree import Name
from parso.python.tree import Operator as Sign

LISTS = ("arglist", "testlist_comp", "testlist_star_expr", "exprlist", "subscriptlist", "testlist")
Span = tuple[tuple[int, int], tuple[int, int]]


class _Leaf(Operator):  # type: ignore[misc]  # cosmic-ray has no annotations
    """Writes another text for one word or sign."""

    old = new = ""
    kind: type = Sign

    def mutation_positions(self, node: Any) -> Iterator[Span]:
        """Yield where the word stands."""
        if isinstance(node, self.kind) and node.value == self.old:
            yield node.start_pos, node.end_pos

    def mutate(self, node: Any, index: int) -> Any:
        """Return the node with the other text."""
        changed = deepcopy(node)
        changed.value = self.new
        return changed

    @classmethod
    def examples(cls) -> tuple[()]:
        """Return nothing: the table of the mutants shows what is done."""
        return ()


class MatrixProductToProduct(_Leaf):
    """Multiplies entry by entry."""

    old, new = "@", "*"


class MatrixProductToSum(_Leaf):
    """Adds."""

    old, new = "@", "+"


class TransposeLeftOut(_Leaf):
    """Takes the matrix as it stands."""

    old, new, kind = "T", "copy()", Name


class ListTurned(Operator):  # type: ignore[misc]  # as above
    """Exchanges the first two of a list of things: arguments, entries, targets, indices."""

    def mutation_positions(self, node: Any) -> Iterator[Span]:
        """Yield every list of at least two."""
        if node.type in LISTS and len(node.children) >= 3 and getattr(node.children[1], "value", "") == ",":
            yield node.start_pos, node.end_pos

    def mutate(self, node: Any, index: int) -> Any:
        """Return the list with the two exchanged, and the spaces where they were."""
        first, second = node.children[0], node.children[2]
        before, between = first.get_first_leaf(), second.get_first_leaf()
        before.prefix, between.prefix = between.prefix, before.prefix
        node.children[0], node.children[2] = second, first
        return node

    @classmethod
    def examples(cls) -> tuple[()]:
        """Return nothing: the table of the mutants shows what is done."""
        return ()


OPERATORS = (MatrixProductToProduct, MatrixProductToSum, TransposeLeftOut, ListTurned)
