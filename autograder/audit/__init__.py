"""The grader grades itself: everything whose verdict is known goes through the engine, and what comes is compared."""

from autograder.audit.report import Audit, audit

__all__ = ["Audit", "audit"]
