"""The secret of a course: what makes variants unforeseeable. It is read from a file and never shown."""

from __future__ import annotations

import hmac
from dataclasses import dataclass, field
from pathlib import Path

from autograder.errors import UsageError
from autograder.problems.stream import Stream

__all__ = ["Secret", "read_secret"]

SHORTEST = 16
LONGEST = 4096
ADVICE = "make one with: python3 -c 'import secrets; print(secrets.token_hex(32))'"


@dataclass(frozen=True)
class Secret:
    """Key of every stream of a course; its text never appears in a message or a repr.

    Examples
    --------
    >>> Secret(b"not to be shown at all")
    Secret()
    """

    key: bytes = field(repr=False)

    def stream(self, *labels: str) -> Stream:
        """Open the stream of integers that the labels name."""
        return Stream(self.key, *labels)

    def check(self, term: str) -> str:
        """Return 16 hexadecimal digits that tell this secret and term from others, and nothing else about them."""
        return hmac.digest(self.key, b"check:" + term.encode("utf-8"), "sha256").hex()[:16]

    def seed(self, term: str) -> int:
        """Derive the seed of a grading run: the same for everybody in a term, unforeseeable without the secret."""
        return int.from_bytes(hmac.digest(self.key, b"seed:" + term.encode("utf-8"), "sha256")[:4], "big")


def read_secret(path: Path) -> Secret:
    """Read a secret from a file; white space round it does not count.

    Raises
    ------
    UsageError
        Where the file cannot be read, or holds fewer than 16 bytes or more than one line.
    """
    try:
        with path.open("rb") as file:
            text = file.read(LONGEST + 1)
    except OSError as error:
        raise UsageError(f"Secret file {path} cannot be read ({error.strerror}); {ADVICE}.") from None
    key = text.strip()
    if len(text) > LONGEST:
        raise UsageError(f"Secret file {path} is longer than {LONGEST} bytes; expected one line of random characters.")
    if len(key) < SHORTEST:
        raise UsageError(f"Secret file {path} holds {len(key)} bytes; expected at least {SHORTEST}; {ADVICE}.")
    if len(key.splitlines()) > 1:
        raise UsageError(f"Secret file {path} holds several lines; expected one line of random characters.")
    return Secret(key)
