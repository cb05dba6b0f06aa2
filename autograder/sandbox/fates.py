"""What became of a function that was asked for, in words: whoever wrote something hears about it."""

from __future__ import annotations

from autograder.sandbox import frames
from autograder.sandbox.frames import Source
from autograder.sandbox.outputs import Fate, place, printable


def fates_of(source: Source, report: frames.LoadReport) -> dict[str, Fate]:
    """Read what a child says of the functions; it is data of the submission, bounded and printable."""
    return {
        each.name: Fate(_words(source, each), each.how not in {"near", "value"}, each.how != "value")
        for each in report.fates
        if each.name.isidentifier()
    }


def _words(source: Source, fate: frames.Fate) -> str:
    name, words = fate.name, printable(fate.words)
    where, by = place(source, fate.cell, fate.line), place(source, fate.by_cell, fate.by_line)
    cell = where.partition(", line")[0]
    said: dict[str, str] = {
        "failed": f"{name} could not be defined, {where}: {words or 'it ended the process or ran out of time'}.",
        "skipped": f"{name} is not defined: it stands in {cell}, and {words}.",
        "replaced": f"{name} is no function any more: {where} defines it, and {by} puts {words} in its place.",
        "deleted": f"{name} is no function any more: {where} defines it, and {by} deletes it.",
        "redefined": f"{by} defines {name} again, with the parameters ({words}), in the place of that of {where}.",
        "inside": f"{name} is not defined at the top level: {where} has it in {words}. It is called by its name alone.",
        "value": f"{name} is no function: {where} makes it {words}.",
        "near": f"{name} is not defined in the submission, which has {words}; the name is read to the letter.",
    }
    return said[fate.how]
