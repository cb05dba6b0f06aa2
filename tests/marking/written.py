"""A class with written answers, made by hand."""

from __future__ import annotations

import msgspec

from autograder.verdicts import Result
from tests.reports.examples import result, stage

EVIL = '<script>document.title="evil"</script><img src="x" onerror="document.title=1">'
TEXTS = {"2": "The second step is *zero*: $x^{(2)} = x^{(1)}$.", "3": "f is affine."}


def answered(name: str, texts: dict[str, str] | None = None, **more: object) -> Result:
    """One submission with all stages passed and answers that wait."""
    texts = TEXTS if texts is None else texts
    verdict = stage("written", "awaiting_mark" if texts else "missing")
    made = result(name, stage("answers"), msgspec.structs.replace(verdict, score=0.0), written=texts, **more)
    waiting = 5.0 if texts else 0.0
    return msgspec.structs.replace(made, max_score=100.0, provisional=bool(texts), awaiting=waiting)


def written_class() -> list[Result]:
    """Four students: two with both answers, one hostile, one silent."""
    return [
        answered("ann"),
        answered("bob", {"3": "=cmd|' /C calc'!A0"}),
        answered("eve", {"2": EVIL, "3": f"[x](javascript:alert(1)) ![y](http://evil.example/y.png) {EVIL}"}),
        answered("sam", {}),
    ]
