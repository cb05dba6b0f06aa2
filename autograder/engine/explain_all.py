"""The last pass of a run: every wrong stage gets its smallest witness, found once for each behaviour group."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from autograder.engine.explain import wants_explanation
from autograder.engine.pool import Answer, Pool
from autograder.engine.store import DRAFT
from autograder.engine.worker import Explain, Explained, Known, Trouble
from autograder.intake.submission import Submission
from autograder.verdicts import Result, StageVerdict

Group = tuple[str, str]
"""Name of a stage, and the known mistake or the digest of what was answered to it."""


def explain_all(
    pool: Pool,
    submissions: Sequence[Submission],
    results: Mapping[str, Result],
    finish: Callable[[Submission, Answer], None],
) -> None:
    """Explain all drafts among the results: the leaders of their groups first, then every member.

    The leader of a group is its member with the smallest digest of the source, whether it was
    graded now or in an earlier run, so that a resumed run explains as an undisturbed one does.
    Where a leader's worker is lost twice, its groups stay drafts: their members are not explained
    in another way than they would be without the loss, and the next run goes on from there.

    Parameters
    ----------
    pool : Pool
        Who does the work.
    submissions : sequence of Submission
        The class.
    results : mapping
        Results so far, by submission.
    finish : callable
        Called with every draft's submission and the answer to it.
    """
    found = [results.get(submission.id) for submission in submissions]
    drafts = [index for index, result in enumerate(found) if result is not None and result.fingerprint.endswith(DRAFT)]
    wanted = [_wanted(result) for result in found]
    order = sorted(range(len(submissions)), key=lambda index: submissions[index].digest)
    shared: dict[Group, Known] = {}
    adrift: set[Group] = set()

    def job(index: int, verdicts: Sequence[StageVerdict]) -> tuple[int, Explain]:
        source = submissions[index].source
        assert source is not None  # it was graded
        given = tuple(shared.get(_group(verdict)) for verdict in verdicts)
        return index, Explain(source, tuple(verdicts), given)

    def led(index: int, answer: Answer) -> None:
        if isinstance(answer, Trouble) and answer.lost:
            adrift.update(map(_group, leaders[index]))
        if isinstance(answer, Explained):
            for verdict, known in zip(answer.verdicts, answer.known, strict=True):
                shared.setdefault(_group(verdict), known)

    leaders = _leaders(drafts, order, wanted)
    pool.run([job(index, verdicts) for index, verdicts in leaders.items()], led)
    pool.run(
        [job(index, wanted[index]) for index in drafts if adrift.isdisjoint(map(_group, wanted[index]))],
        lambda index, answer: finish(submissions[index], answer),
    )


def _group(verdict: StageVerdict) -> Group:
    return verdict.name, verdict.slip or verdict.group


def _wanted(result: Result | None) -> list[StageVerdict]:
    return [] if result is None else [verdict for verdict in result.stages if wants_explanation(verdict)]


def _leaders(
    drafts: Sequence[int], order: Sequence[int], wanted: Sequence[list[StageVerdict]]
) -> dict[int, list[StageVerdict]]:
    """Return for each leader of a group with a draft in it the verdicts that it is to explain."""
    leaderless = {_group(verdict) for index in drafts for verdict in wanted[index]}
    leaders: dict[int, list[StageVerdict]] = {}
    for index in order:
        for verdict in wanted[index]:
            if _group(verdict) in leaderless:
                leaderless.discard(_group(verdict))
                leaders.setdefault(index, []).append(verdict)
    return leaders
