"""The errors that a user may see: one or two sentences, what came, what was expected, what to try."""


class AutograderError(Exception):
    """Base of every error that is ours; its text is shown to the user as it is.

    `exit_code` is what the command line ends with.
    """

    exit_code = 3


class UsageError(AutograderError):
    """Bad usage or unreadable input: the person at the keyboard can mend it."""

    exit_code = 2


class RejectedUpload(AutograderError):
    """One upload that cannot be read as a submission; the others of the run go on."""


class SandboxError(AutograderError):
    """The confinement could not be set up or broke: the grader's fault, never the student's."""


class SandboxLost(SandboxError):
    """The fork server is gone, as after a kill: the same work in a new one may well succeed."""
