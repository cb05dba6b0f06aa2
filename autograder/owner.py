"""Whose an upload is, in the words of the system that it comes from: the border between layouts and the roster."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Owner"]


@dataclass(frozen=True)
class Owner:
    """What the layout of an upload says of who handed it in; nothing here was written by the student.

    Parameters
    ----------
    system : str
        Who says it, such as "Canvas"; "" where it is only a folder that the course named.
    id : str
        The id that the institution gave: Gradescope's SID, the student of nbgrader; "" where there is none.
    email : str
        The address.
    name : str
        The name, as the system writes it.
    number : str
        The system's own number of the person. In another system it means somebody else.
    place : str
        The folder that the course named, in which an id or a name stands; used where `system` is "".
    nobody : str
        Why it is nobody's of the class, such as a test account; "" where it is somebody's.

    Examples
    --------
    >>> Owner("Canvas", name="doejane", number="101").account, Owner("Gradescope", email="j@x.edu").best
    ('Canvas 101', 'j@x.edu')
    """

    system: str = ""
    id: str = ""
    email: str = ""
    name: str = ""
    number: str = ""
    place: str = ""
    nobody: str = ""

    @property
    def best(self) -> str | None:
        """What the person is called where there is no roster to ask; None where nothing is known."""
        return self.id or self.email or self.number or None

    @property
    def account(self) -> str:
        """Name the person for later exports to the same system; "" where it gave no number."""
        return f"{self.system} {self.number}" if self.number else ""

    def __str__(self) -> str:
        """Describe the person to staff."""
        known = ", ".join(filter(None, (self.name, self.id, self.email, self.number)))
        return f"{self.system}'s {known}" if known else f"an upload of {self.system} without a name"
