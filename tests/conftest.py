"""What every test shares: examples that are the same in every run, and no explanation that fails unseen."""

import os

from hypothesis import HealthCheck, settings

from autograder.attempts import STRICT

os.environ[STRICT] = "1"  # workers too: an explanation that fails fails the test

settings.register_profile("default", derandomize=True, database=None, deadline=None, print_blob=False)
settings.register_profile(
    "fuzz",
    derandomize=False,
    database=None,
    deadline=None,
    max_examples=2000,
    print_blob=True,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("default")  # pytest --hypothesis-profile=fuzz draws fresh examples instead
