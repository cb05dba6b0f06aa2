"""A fork server for a single submission, started before anything else: it loads while the client still reads."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from autograder.sandbox.server import Server


@contextmanager
def early_server(paths: Sequence[Path], out: Path, scheduler: str | None) -> Iterator[Server | None]:
    """Give a fork server that is starting, where one submission is sure to be run here; None anywhere else.

    Parameters
    ----------
    paths : sequence of Path
        What was handed in.
    out : Path
        The folder of the results; one that holds any may have nothing new to grade.
    scheduler : str or None
        The cluster that grades instead of this machine.
    """
    alone = len(paths) == 1 and paths[0].suffix in {".py", ".ipynb"} and paths[0].is_file()
    if scheduler is not None or not alone or (out / "results").exists():
        yield None
        return
    from autograder.sandbox.server import Server

    server = Server()
    try:
        yield server
    finally:
        server.close()
