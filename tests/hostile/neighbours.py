"""The honest submissions that sit in one class with the hostile ones."""

from __future__ import annotations

from pathlib import Path

from tests.specimens.first_line import SPECIMENS

MARK = "only-in-the-neighbour-7f3a"  # one hostile specimen searches its memory for this
_SAMPLE = ("ada_lindqvist.py", "kofi_mensah.py", "farah_aziz.ipynb")

# A mistake that is in no catalogue: it is explained by asking a member of its group, and a hostile one is in it, too.
SHARED_MISTAKE = "unknown_mistake"
UNKNOWN = """
import numpy as np


def information_matrix(graph):
    return np.diag(1 / (0.125 + np.concatenate([graph.edge_variances, graph.prior_variances])))
"""


def write(folder: Path) -> list[str]:
    """Write the honest submissions into a folder and return their names."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in _SAMPLE:
        text = (SPECIMENS / "sample" / name).read_text("utf-8")
        (folder / name).write_text(text + (f"\n# {MARK}\n" if name.endswith(".py") else ""), "utf-8")
    (folder / f"{SHARED_MISTAKE}.py").write_text(f"{UNKNOWN}\n# {MARK}\n", "utf-8")
    return sorted(path.stem for path in folder.iterdir())
