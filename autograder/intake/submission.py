"""Uploads become submissions: the one door through which students' work enters the grader."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from autograder.errors import RejectedUpload, UsageError
from autograder.intake.archive import class_archive_tree
from autograder.intake.folder import file_entry, folder_tree
from autograder.intake.inside import problem_inside
from autograder.intake.layouts import detect, named
from autograder.intake.naming import distinct_names, printable
from autograder.intake.reading import digest, read_entry
from autograder.intake.tree import PROVIDED_FILES, Entry, Tree, is_candidate
from autograder.intake.upload import Upload
from autograder.owner import Owner
from autograder.sandbox.frames import Source

_TRY = "give .py, .ipynb or .zip files, a folder of them, or a folder that holds one folder a student"
_CLASS_LAYOUT = 0.5  # an archive is a whole class only where a layout is sure of it


@dataclass(frozen=True)
class Submission:
    """One submission, read or rejected.

    Parameters
    ----------
    id : str
        Its name in every result: safe as a file name, distinct in the run without regard to case.
    path : str
        Where it came from, for staff; relative to what the user gave.
    source : Source or None
        The text to execute in the sandbox; None where the upload was rejected.
    rejection : str
        One sentence that says why there is no source; "" where there is one.
    flags : tuple of str
        What of its reading a human should look at.
    notes : tuple of str
        What staff should know about how it was read; no note names another student.
    digest : str
        SHA-256 of kind and cells as hex; "" where rejected.
    owner : Owner or None
        Who handed it in, where the layout says it.
    file : str
        The name that the student gave the file; "" where there is none.
    layout : str
        The layout it was found in; "file" for a file given by itself.
    late : bool or None
        Whether the system of the course marked it late; None where it does not say.
    submitted : str
        When it was handed in, as the layout has it; "" where it does not say.
    markdown : tuple of str
        The markdown cells of a notebook, for a human reader; never executed.
    variant : str
        The variant that a notebook's metadata name; "" where none. A claim, not a fact.
    pictures : mapping of str to str
        Pictures in the markdown cells, by the names that these use, as data URIs.
    """

    id: str
    path: str
    source: Source | None
    rejection: str = ""
    notes: tuple[str, ...] = ()
    flags: tuple[str, ...] = ()
    digest: str = ""
    owner: Owner | None = None
    layout: str = "file"
    late: bool | None = None
    submitted: str = ""
    markdown: tuple[str, ...] = ()
    variant: str = ""
    pictures: Mapping[str, str] = field(default_factory=dict)
    file: str = ""

    @property
    def student_id(self) -> str | None:
        """The id that the system of the course gave the student, where the layout has one."""
        return None if self.owner is None else self.owner.best


@dataclass(frozen=True)
class _Found:
    """An upload with where it was found: layout, and the path to show."""

    upload: Upload
    layout: str
    path: str


def collect(paths: Sequence[Path], layout: str | None = None) -> list[Submission]:
    """Read every submission in files, folders and archives, sorted by id.

    Parameters
    ----------
    paths : sequence of Path
        Files, folders or exports of an LMS.
    layout : str, optional
        Name of the layout of folders and class archives; without it each is recognised by itself.

    Returns
    -------
    list of Submission
        What cannot be read is in the list too, with its `rejection`.

    Raises
    ------
    UsageError
        Where there is nothing to read at all: no path, a missing path, a folder without submissions.
    """
    if not paths:
        raise UsageError(f"No path was given; {_TRY}.")
    if layout is not None:
        named(layout)
    found: list[_Found] = []
    problems: list[_Found] = []
    for path in paths:
        try:
            found += _gather(Path(path), layout)
        except UsageError as error:
            problems.append(_Found(Upload(name=Path(path).name, entry=None, problem=str(error)), "file", _show(path)))
    if not found:
        raise UsageError(" ".join(dict.fromkeys(problem.upload.problem for problem in problems)))
    once = {_key(item): item for item in reversed(found)}
    found = sorted(once.values(), key=lambda item: (item.path, item.upload.name)) + problems
    ids = distinct_names([(item.upload.name, item.upload.folder) for item in found])
    return sorted((_read(item, name) for item, name in zip(found, ids, strict=True)), key=lambda each: each.id)


def _gather(path: Path, layout: str | None) -> list[_Found]:
    """Find the uploads under one path; raises UsageError where there is none."""
    shown = _show(path)
    try:
        if not path.exists() and not path.is_symlink():
            raise UsageError(f"{shown} does not exist; check the path, and {_TRY}.")
        is_folder = path.is_dir()
    except (OSError, ValueError) as error:
        raise UsageError(f"{shown} cannot be opened ({type(error).__name__}); check the path.") from None
    if is_folder:
        found = _from_tree(folder_tree(path), layout, shown)
        if not found:
            raise UsageError(f"{shown} holds no submission; {_TRY}.")
        return found
    entry = file_entry(path)
    if entry.suffix == ".zip" and not entry.problem:
        tree = _class_archive(path, layout)
        if tree is not None:
            return _from_tree(tree, layout, shown)
    problem = entry.problem
    if not problem and not is_candidate(entry):
        provided = entry.name.casefold() in PROVIDED_FILES
        problem = "is a file that was handed out, not a submission" if provided else problem_inside(entry)
    folder = path.parent.name or path.resolve().parent.name
    owner, own_name = _named_by_a_system(entry, folder)
    upload = Upload(entry.stem, entry, problem, folder, owner=owner, own_name=own_name)
    return [_Found(upload, "file", shown)]


def _named_by_a_system(entry: Entry, folder: str) -> tuple[Owner | None, str]:
    """Say who handed in a file that is given by itself, and under which name, where a system named the file."""
    chosen, tree = detect(Tree(folder, (entry,)))
    upload = next(iter(chosen.gather(tree)), None) if chosen.recognise(tree) >= _CLASS_LAYOUT else None
    if upload is None or upload.entry is None:
        return None, ""
    return upload.owner, upload.own_name or upload.entry.name


def _class_archive(path: Path, layout: str | None) -> Tree | None:
    """Return the tree of an archive that holds a whole class, None where it is one student's."""
    try:
        tree = class_archive_tree(path)
    except (RejectedUpload, OSError, ValueError):
        return None  # read again as one upload, which says what is wrong
    chosen, inner = detect(tree)
    return tree if layout is not None or chosen.recognise(inner) >= _CLASS_LAYOUT else None


def _from_tree(tree: Tree, layout: str | None, shown: str) -> list[_Found]:
    chosen, inner = detect(tree, layout)
    found = []
    for upload in chosen.gather(inner):
        below = "/".join(upload.entry.parts) if upload.entry is not None else upload.folder
        found.append(_Found(upload, chosen.name, f"{shown}/{printable(below)}".rstrip("/")))
    return found


def _read(item: _Found, name: str) -> Submission:
    upload = item.upload
    notes = upload.notes
    if name != upload.name:
        notes = (*notes, f"Named {name} in the results; it was handed in as {printable(upload.name)[:120]}.")
    submission = Submission(
        name, item.path, None, notes=notes, owner=upload.owner, layout=item.layout, late=upload.late,
        submitted=upload.submitted, file=upload.own_name or (upload.entry.name if upload.entry is not None else ""),
    )  # fmt: skip
    try:
        if upload.problem or upload.entry is None:
            raise RejectedUpload(upload.problem or "holds no submission")
        content = read_entry(upload.entry)
    except RejectedUpload as error:
        return replace(submission, rejection=_sentence(item, str(error)))
    return replace(
        submission, source=content.source, notes=(*notes, *content.notes), flags=content.flags,
        digest=digest(content.source),
        markdown=content.markdown, variant=content.variant, pictures=content.pictures,
    )  # fmt: skip


def _sentence(item: _Found, problem: str) -> str:
    """Make the sentence from the end of it; problems of a path are whole sentences already."""
    if item.upload.entry is None and problem.endswith("."):
        return problem
    subject = item.upload.entry.name if item.upload.entry is not None else item.upload.name
    return f"{printable(subject)[:80]} {problem}."


def _key(item: _Found) -> tuple[str, str]:
    """Tell uploads apart: the same file given twice is one submission, unless two students share it."""
    entry = item.upload.entry
    return (entry.origin if entry is not None else item.path, item.upload.name)


def _show(path: Path) -> str:
    """Return a path as staff see it: as given where it is relative, else its last part."""
    path = Path(path)
    if path.is_absolute() or ".." in path.parts:
        path = Path(path.name or path.anchor)
    return printable(path.as_posix())
