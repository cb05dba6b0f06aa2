"""The exam as a file: drawn once, kept, and the same whatever versions are installed later.

Drawing needs Hypothesis, and another version of it draws other cases from the same seed. So what
a class sits is not a seed but a file: the cases, who they are for, and a checksum of it all.
"""

from __future__ import annotations

import hashlib
import platform
import zlib
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path

import msgspec
import numpy as np

from autograder.engine.corpus import Corpus, draw_corpus, load_corpus
from autograder.engine.store import code_digest
from autograder.errors import UsageError
from autograder.stages.catalogue import all_stages
from autograder.writing import write_whole

HOMEWORK = "slam1d"
FORMAT = 1
FILE = "exam"  # its name in the folder of a run
_MAGIC = b"autograder exam "
_LARGEST = 1 << 30  # bytes of a body
_AGAIN = "draw one with `autograder exam -o FILE`"


class _Body(msgspec.Struct, frozen=True, kw_only=True):
    """What stands in the file below its first two lines."""

    homework: str
    content: str
    seed: int
    examples: int
    drawn_with: dict[str, str]
    corpus: bytes
    answers: dict[str, bytes]
    laid_out_by: str
    layout: bytes


@dataclass(frozen=True)
class Exam:
    """One exam: what it was drawn for, its cases, and its bytes as a file has them.

    Attributes
    ----------
    homework : str
        Name of the homework.
    content : str
        Digest of what the homework asks: stages, functions and rungs (`content_digest`).
    seed, examples : int
        What was drawn: from which seed, and how many cases a stage.
    drawn_with : dict
        The versions that drew it, for readers; nothing depends on them.
    digest : str
        Identifies what is asked: homework, seed and cases. Answers are not part of it, for their last bits are those
        of the processor that worked them out; the file as a whole has a checksum beside it.
    answers : dict
        For each check what a verdict needs: right answers and how far one may be off, worked out once.
    laid_out_by, layout : str, bytes
        The calls in the order in which they are made, and the digest of the code that laid them out: other code
        lays them out anew.
    """

    homework: str
    content: str
    seed: int
    examples: int
    drawn_with: dict[str, str]
    digest: str
    data: bytes
    answers: dict[str, bytes]
    laid_out_by: str
    layout: bytes
    _cases: bytes

    @cached_property
    def corpus(self) -> Corpus:
        """The cases."""
        return load_corpus(self._cases)

    def asks_for(self, seed: int | None, examples: int | None) -> bool:
        """Whether this is the exam of a seed and a number of examples; None stands for any."""
        return seed in {None, self.seed} and examples in {None, self.examples}


@lru_cache(maxsize=4)
def draw_exam(seed: int, examples: int) -> Exam:
    """Draw an exam of the homework, for all its stages: a course may use some of them.

    Parameters
    ----------
    seed : int
        The same seed gives the same cases under the same version of Hypothesis.
    examples : int
        Cases to draw a stage, beside the fixed core.
    """
    from importlib.metadata import version  # noqa: PLC0415 - only who draws needs it

    from autograder.engine.laid_out import laid_out  # noqa: PLC0415 - which reads exams itself

    corpus = draw_corpus(tuple(all_stages()), seed, examples)
    answers, layout = laid_out(corpus)
    body = _Body(
        homework=HOMEWORK,
        content=content_digest(),
        seed=seed,
        examples=examples,
        drawn_with={
            "hypothesis": version("hypothesis"),
            "numpy": np.__version__,
            "python": platform.python_version(),
        },
        corpus=corpus.data,
        answers=answers,
        laid_out_by=code_digest(),
        layout=layout,
    )
    packed = zlib.compress(msgspec.msgpack.encode(body), 1)
    checksum = hashlib.sha256(packed).hexdigest()
    return _exam(body, _MAGIC + b"%d\n%s\n" % (FORMAT, checksum.encode()) + packed)


def read_exam(path: Path) -> Exam:
    """Read an exam file, and make sure that it is one, whole, and of this homework.

    Raises
    ------
    UsageError
        Where it cannot be read, is damaged, or belongs to another homework or edition.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise UsageError(f"{path} cannot be read as an exam ({error.strerror}); {_AGAIN}.") from None
    return exam_of(data, str(path))


def exam_of(data: bytes, name: str) -> Exam:
    """Rebuild an exam from the bytes of its file; `name` is what messages call it.

    Raises
    ------
    UsageError
        As for `read_exam`.
    """
    first, _, rest = data.partition(b"\n")
    if not first.startswith(_MAGIC):
        raise UsageError(f"{name} is no exam; expected a file that `autograder exam -o FILE` wrote.")
    if first != _MAGIC + str(FORMAT).encode():
        raise UsageError(
            f"{name} is an exam of format {first.removeprefix(_MAGIC)[:9].decode('ascii', 'replace')}, and this "
            f"autograder reads format {FORMAT}; grade with the version that drew it, or {_AGAIN}."
        )
    checksum, _, packed = rest.partition(b"\n")
    if hashlib.sha256(packed).hexdigest().encode() != checksum:
        raise UsageError(
            f"{name} is damaged: its checksum does not fit. Take another copy of the file, or remove it and {_AGAIN}."
        )
    try:
        body = msgspec.msgpack.decode(_unpacked(packed), type=_Body)
    except (msgspec.MsgspecError, zlib.error) as error:
        raise UsageError(f"{name} is an exam that this autograder cannot read ({error}); {_AGAIN}.") from None
    if body.homework != HOMEWORK:
        raise UsageError(f"{name} is an exam of the homework {body.homework[:40]}, and {HOMEWORK} is graded here.")
    if body.content != content_digest():
        raise UsageError(
            f"{name} was drawn for another edition of {HOMEWORK}, whose stages or checks were others; "
            f"grade with the version that drew it, or {_AGAIN}."
        )
    return _exam(body, data)


def kept_exam(out: Path) -> Exam | None:
    """Return the exam that the results in a folder were graded with; None where none is kept there.

    Raises
    ------
    UsageError
        As for `read_exam`.
    """
    return read_exam(out / FILE) if (out / FILE).exists() else None


def save_exam(exam: Exam, path: Path) -> None:
    """Write an exam, whole or not at all, unless it is there already.

    Raises
    ------
    UsageError
        Where the file cannot be written.
    """
    if not path.exists() or path.read_bytes() != exam.data:
        write_whole(path, exam.data)


def content_digest() -> str:
    """Identify what the homework asks: an exam fits where the same functions are asked in the same checks.

    How cases are drawn and how mistakes are explained does not count: a file keeps its cases
    when the grader learns to draw others.
    """
    found = [
        (
            *(stage.name, stage.function, stage.parts, stage.builds_on),
            *(stage.ladder.name, [rung.name for rung in stage.ladder.rungs]),
        )
        for stage in sorted(all_stages(), key=lambda stage: stage.name)
    ]
    return hashlib.sha256(msgspec.json.encode(found)).hexdigest()


def sizes(exam: Exam) -> dict[str, int]:
    """Return for each stage how many cases the exam holds."""
    return {stage.name: sum(map(len, exam.corpus.cases[stage.ladder.name].values())) for stage in all_stages()}


def _unpacked(data: bytes) -> bytes:
    """Decompress, to a bound: a file of a megabyte could hold a gigabyte of zeros."""
    stream = zlib.decompressobj()
    found = stream.decompress(data, _LARGEST)
    if stream.unconsumed_tail or not stream.eof:
        raise zlib.error("more than an exam has")
    return found


def _exam(body: _Body, data: bytes) -> Exam:
    asked = msgspec.msgpack.encode([body.homework, body.content, body.seed, body.examples, body.corpus])
    return Exam(
        homework=body.homework,
        content=body.content,
        seed=body.seed,
        examples=body.examples,
        drawn_with=body.drawn_with,
        digest=hashlib.sha256(asked).hexdigest(),
        data=data,
        answers=body.answers,
        laid_out_by=body.laid_out_by,
        layout=body.layout,
        _cases=body.corpus,
    )
