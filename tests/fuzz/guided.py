"""Lets coverage choose the frames: mutates what reached a new line of the decoder, for a number of seconds.

    python tests/fuzz/guided.py --seconds 60

It needs atheris, which is no part of requirements.lock because not every system has a wheel of it:
`.venv/bin/python -m pip install atheris`. Without it nothing is done, and that is said.
"""

from __future__ import annotations

import argparse
import random
import sys
import tempfile
from contextlib import suppress
from pathlib import Path

import msgspec

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

_LONGEST = 8192  # bytes of a frame; twice the bound of a reply
_MEMORY = 512  # MiB for all of it; a frame that makes the decoder take more is a finding


def main() -> int:
    """Fuzz from the command line; 0 where nothing was found."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--seed", type=int, default=0, help="0 draws one")
    chosen = parser.parse_args()
    try:
        import atheris  # noqa: PLC0415  # may be absent
    except ImportError:
        print("Skipped: atheris is not installed here; try: .venv/bin/python -m pip install atheris")
        return 0
    with atheris.instrument_imports(include=["autograder.sandbox"]):
        from tests.fuzz import frames  # noqa: PLC0415  # instrumented while it is imported

    def one(data: bytes) -> None:
        frames.read(data)

    def mutate(data: bytes, longest: int, seed: int) -> bytes:
        """Change a field of a frame that can be read, else some bytes; begin with a good frame."""
        draw = random.Random(seed)
        choice = draw.random()
        if choice < 0.01 or not data.strip():
            return msgspec.msgpack.encode(draw.choice(frames.GOOD))
        if choice < 0.5:
            with suppress(msgspec.MsgspecError, ValueError, TypeError, OverflowError, RecursionError):
                fields = msgspec.msgpack.decode(data)
                fields[draw.randrange(len(fields))] = frames.value(draw)
                changed = msgspec.msgpack.encode(fields)
                if len(changed) <= longest:
                    return changed
        return bytes(atheris.Mutate(data, longest))

    limits = [f"-max_total_time={chosen.seconds}", f"-max_len={_LONGEST}", "-len_control=0"]
    limits += [f"-rss_limit_mb={_MEMORY}", f"-seed={chosen.seed}"]
    finding = Path(tempfile.gettempdir(), "slam1d-frame-")
    atheris.Setup([sys.argv[0], *limits, f"-artifact_prefix={finding}"], one, custom_mutator=mutate)
    atheris.Fuzz()  # ends the process: 0 where the time is up, else the frame is left in a file that it names
    return 0


if __name__ == "__main__":
    sys.exit(main())
