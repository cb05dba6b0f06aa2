"""Runs a stranger's code: a warm fork server, one locked child a submission, and frames of plain bytes.

Two sides share this folder. The grader imports `host`; everything else except `outputs`, `channel`
and `host` is loaded by the fork server, under the package name `sandbox`, without the rest of the
grader. That is why the files of the child's side import each other relatively and nothing else of
the project.
"""
