"""The words of the templates, without code and without what is filled in."""

import re
from importlib import resources

TEMPLATES = resources.files("autograder.render") / "templates"
NAMES = [
    "README.md.j2",
    "slam1d.ipynb.j2",
    "explore.ipynb.j2",
    *(f"parts/{p.name}" for p in (TEMPLATES / "parts").iterdir()),
]
STUDENTS = [name for name in NAMES if not name.startswith(("parts/solution_", "parts/errata", "parts/provided"))]


def prose(name):
    """The words of a template: no code cells, nothing that is filled in."""
    text = (TEMPLATES / name).read_text(encoding="utf-8")
    if name.endswith(".ipynb.j2"):
        cells = re.split(r"^%% ", text, flags=re.MULTILINE)
        text = "".join(cell.partition("\n")[2] for cell in cells if cell.startswith("markdown"))
    return re.sub(r"<<.*?>>|<%.*?%>", "", text)
