"""One audit with few examples, shared by the tests of it."""

import pytest

from autograder.audit import Audit, audit
from autograder.course import Course


@pytest.fixture(scope="session")
def found() -> Audit:
    """The audit of the default course, five drawn examples a stage, without the hostile cases.

    Those have tests of their own, which also see that nothing beside the verdict was done.
    """
    return audit(Course(), 0, 5, wanted=lambda case: case.kind != "hostile")
