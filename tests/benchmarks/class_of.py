"""A generated class: most are right in one style or another, the others wrong in all the usual ways."""

import inspect
import itertools
from collections.abc import Sequence
from pathlib import Path

from autograder.intake.submission import Submission
from autograder.sandbox.frames import Source
from autograder.stages.catalogue import all_stages, slips
from autograder.stages.slips.submission import FUNCTIONS, submission_text
from reference_solution import slam1d

REFERENCE = inspect.getsource(slam1d)
STYLES = Path(__file__).parents[2] / "autograder/specimens/correct"
SLOW_STYLES = {"style_17_fractions", "style_08_conjugate_gradients"}  # these take many times longer than the others
PLAIN_STYLES = (
    "style_01_list_append",
    "style_02_vectorised",
    "style_03_inv",
    "style_04_pinv",
    "style_05_row_form",
    "style_09_inverse_of_covariance",
    "style_16_copy_and_add",
)
CRASHES = (
    "\n\ndef residual(x, graph):\n    return x[graph.n_poses]\n",
    "\n\ndef jacobian(x, graph):\n    raise ValueError('shapes do not match')\n",
    "\n\ndef gauss_newton_step(x, graph):\n    return np.linalg.solve(np.zeros((2, 2)), x)\n",
)
LOOP = "\n\ndef gauss_newton_step(x, graph):\n    while True:\n        x = x + 0\n"


def right_texts() -> list[str]:
    """Return correct submissions in many styles."""
    files = sorted(path for path in STYLES.glob("*.py") if path.stem not in SLOW_STYLES)
    return [REFERENCE, *(path.read_text(encoding="utf-8") for path in files)]


def plain_texts() -> list[str]:
    """Return correct submissions as most students write them: a loop or arrays, and inv, pinv or solve."""
    found = [(STYLES / f"{name}.py").read_text(encoding="utf-8") for name in PLAIN_STYLES]
    return [REFERENCE, *found]


def wrong_texts() -> list[str]:
    """Return submissions with one known mistake each, in turn from all stages."""
    named = [
        [submission_text(slip, stage.function) for slip in slips(stage.name)]
        for stage in all_stages()
        if stage.function in FUNCTIONS
    ]
    return [text for row in itertools.zip_longest(*named) for text in row if text is not None]


def class_of(size: int, right: float = 0.7, loops: int = 0, rights: Sequence[str] | None = None) -> list[Submission]:
    """Make a class in which this share is right; the rest are slips, a tenth of it crashes, and a few loops."""
    texts = []
    rights, wrongs = itertools.cycle(rights or right_texts()), itertools.cycle(wrong_texts())
    crashes = itertools.cycle(CRASHES)
    n_right = round(right * size)
    for number in range(size):
        if number < n_right:
            text = next(rights)
        elif number < n_right + loops:
            text = REFERENCE + LOOP
        elif number % 10 == 0:
            text = REFERENCE + next(crashes)
        else:
            text = next(wrongs)
        texts.append(f"# student {number}\n{text}")
    return [
        Submission(
            id=f"s{number:05d}",
            path=f"s{number:05d}.py",
            source=Source(kind="module", cells=[text], name=f"s{number:05d}.py"),
            digest=f"{number:05d}",
        )
        for number, text in enumerate(texts)
    ]
