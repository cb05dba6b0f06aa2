"""The grader's side of the sandbox: start a fork server, open a submission, run its functions.

Nothing here imports, unpickles or evaluates what a submission made. What comes back is bytes,
from which `outputs` rebuilds numbers and bounded words.
"""

from __future__ import annotations

import secrets
from collections.abc import Collection
from types import TracebackType

from autograder.errors import SandboxError, SandboxLost
from autograder.sandbox import frames
from autograder.sandbox.channel import Budget, Ended
from autograder.sandbox.frames import Inputs, Kind, Outcome, Source
from autograder.sandbox.outputs import Answers, Expected, Failure, Loaded, Note, Outputs
from autograder.sandbox.server import Confinement, Limits, Server, confinement_of
from autograder.sandbox.session import Session

__all__ = [
    "Answers",
    "Confinement",
    "Failure",
    "Kind",
    "Limits",
    "Loaded",
    "Note",
    "Outcome",
    "Outputs",
    "Sandbox",
    "Server",
    "Session",
]


class Sandbox:
    """One fork server with the inputs of a run in it; a context manager.

    Parameters
    ----------
    inputs : bytes
        What `frames.encode_inputs` made.
    limits : Limits
        Time, memory and output that a submission may use.
    allow_unconfined : bool
        Go on where this machine has no lock that holds.
    without : collection of str
        Locks to leave off, of "seccomp", "landlock" and "rlimits". For tests that show what each
        of them is good for.
    server : Server or None
        A fork server that was started early; it belongs to the sandbox from now on.

    Raises
    ------
    SandboxError
        Where the fork server does not start, where there is no lock and that was not allowed, or
        where a lock is there but does not hold.
    """

    def __init__(
        self,
        inputs: bytes,
        limits: Limits = Limits(),  # noqa: B008  # frozen
        *,
        allow_unconfined: bool = False,
        without: Collection[str] = (),
        server: Server | None = None,
    ) -> None:
        self.limits = limits
        self.server = server or Server()
        self.server.set_up(inputs, limits, without)
        try:
            self._expected = [Expected.of(batch) for batch in frames.decode(inputs, Inputs).batches]
            self.confinement: Confinement = confinement_of(self.server.ready)
            if self.confinement.level == "none" and not allow_unconfined:
                raise SandboxError(
                    f"This machine cannot confine a submission: {self.confinement.detail} Grade in a Linux container "
                    "or in WSL2, or pass --allow-unconfined if you trust every submission."
                )
            if self.confinement.level != "none":
                self._require_that_it_holds()
        except BaseException:
            self.close()
            raise

    def probe(self) -> list[str]:
        """Let a canary try to escape; give the names of the attempts that succeeded."""
        budget = Budget(10.0, 10.0)
        channel, pid = self.server.fork(budget, self.limits.output_bytes)
        try:
            nonce = secrets.randbits(62)
            channel.begin(frames.pack(frames.Probe(nonce)), nonce)
            channel.reply(frames.LOAD_BOUND, 10.0, nonce=0)
            report = channel.reply(frames.LOAD_BOUND, 10.0)
        except Ended as end:
            kind = SandboxLost if self.server.killed else SandboxError
            raise kind(f"The canary of the sandbox did not answer ({end.reason}).{_memory_bound()}") from end
        finally:
            channel.close()
            self.server.kill(pid)
        if not isinstance(report, frames.ProbeReport):
            raise SandboxError("The canary of the sandbox answered something else than was asked.")
        return report.succeeded

    def _require_that_it_holds(self) -> None:
        succeeded = self.probe()
        if succeeded:
            raise SandboxError(
                f"The lock ({self.confinement.wording}) does not hold on this machine: a locked process could "
                f"{', '.join(succeeded)}. Nothing is graded; see SECURITY.md for how to report this."
            )

    def open(self, source: Source) -> Session:
        """Begin with a submission."""
        return Session(self.server, self.limits, self._expected, source)

    def close(self) -> None:
        """End the fork server and every child of it."""
        self.server.close()

    def __enter__(self) -> Sandbox:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()


def _memory_bound() -> str:
    """Name a bound on memory that this process has been started with: it may be why a child could not live."""
    import resource  # noqa: PLC0415 - not on every system, and there nothing bounds memory

    soft, _ = resource.getrlimit(resource.RLIMIT_AS)
    if soft == resource.RLIM_INFINITY:
        return ""
    return f" This shell allows {soft >> 20} MiB of memory (`ulimit -v`), which may be too little; raise that limit."
