# `make` alone explains itself; the environment .venv is made when it is first needed.

PYTHON ?= python3
VENV := .venv
PY := $(VENV)/bin/python
PIP := $(PY) -m pip --disable-pip-version-check --no-input -q
UV_VERSION := 0.13.9
FRAMES ?= 1000000
GUIDED_SECONDS ?= 60
ANYTHING ?= 3000

# What .venv was made for; when it was copied from elsewhere or for another Python, it is made anew.
PLACE := $(CURDIR) $(PYTHON)
ifneq ($(shell cat $(VENV)/made-for 2>/dev/null),$(PLACE))
ANEW := anew
endif

.PHONY: help demo test interop bench fuzz crashes mutants lock clean anew
.DELETE_ON_ERROR:

help:
	@echo "make demo    grade a small sample class, print the table and say where to look"
	@echo "make test    check format, lint and types, then run all tests"
	@echo "make interop install nbgrader and Otter beside .venv and compare their marks with ours (network, ten minutes)"
	@echo "make bench   measure the grader beside its floor and other graders, and a class of 1,000 (network, half an hour)"
	@echo "make fuzz    throw a million random frames and 3,000 odd submissions at the grader, then fresh examples at the properties"
	@echo "make mutants change the reference everywhere, one place at a time: does the exam notice?"
	@echo "make hostile print which attacks of the hostile corpus get through, with the locks and without"
	@echo "make crashes kill workers, fork servers and the grader fifty times, and compare what they leave"
	@echo "make lock    write requirements.lock anew from pyproject.toml"
	@echo "make clean   remove everything that make made"
	@echo ""
	@echo "The first of them sets up .venv; it needs python3 >= 3.11 with venv."
	@echo "Another Python: make test PYTHON=python3.13"

demo: $(VENV)/ready
	@$(PY) -m autograder demo

test: $(VENV)/ready
	@echo "--- format: ruff format"
	@$(PY) -m ruff format --check --quiet .
	@echo "--- lint: ruff check"
	@$(PY) -m ruff check --quiet .
	@echo "--- types: mypy"
	@$(PY) -m mypy --no-error-summary
	@echo "--- tests: pytest"
	@$(PY) -m pytest -q -n 2 --dist loadfile --cov --cov-report=term

interop: $(VENV)/ready
	@INTEROP=1 INTEROP_ENVIRONMENTS=$(CURDIR)/$(VENV)/interop $(PY) -m pytest -q -s tests/exports/interop

bench: $(VENV)/ready
	@$(PY) -m tests.benchmarks --environments $(VENV)/peers

fuzz: $(VENV)/ready
	@echo "--- frames: random"
	@$(PY) tests/fuzz/frames.py --frames $(FRAMES)
	@echo "--- frames: guided by coverage"
	@$(PY) tests/fuzz/guided.py --seconds $(GUIDED_SECONDS)
	@echo "--- values: submissions that return anything"
	@$(PY) -m tests.fuzz.values --count $(ANYTHING)
	@echo "--- property tests: fresh examples"
	@$(PY) -m pytest -q --hypothesis-profile=fuzz -m "hypothesis and not slow"

crashes: $(VENV)/ready
	@$(PY) -m pytest -q -s tests/engine/test_crashes.py

mutants: $(VENV)/ready
	@$(PY) -m tests.mutation

hostile: $(VENV)/ready
	@$(PY) -m tests.hostile.table

lock: $(VENV)/ready
	@echo "--- requirements.lock"
	@$(PIP) install uv==$(UV_VERSION)
	@$(VENV)/bin/uv pip compile --quiet --upgrade --universal --python-version 3.11 --generate-hashes \
		--custom-compile-command "make lock" --group dev pyproject.toml --output-file requirements.lock

clean:
	@rm -rf $(VENV) dist bench slam1d-demo .coverage .hypothesis .mypy_cache .pytest_cache .ruff_cache
	@find . -name __pycache__ -type d -prune -exec rm -rf {} +
	@echo "clean"

$(VENV)/ready: requirements.lock pyproject.toml $(ANEW)
	@command -v $(PYTHON) >/dev/null || { \
		echo "$(PYTHON) was not found; install Python 3.11 or newer (Debian, Ubuntu: apt-get install python3 python3-venv)." >&2; exit 1; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
		echo "$(PYTHON) is $$($(PYTHON) -V 2>&1), but 3.11 or newer is needed; name another one: make test PYTHON=python3.13" >&2; exit 1; }
	@$(PYTHON) -c 'import venv, ensurepip' 2>/dev/null || { \
		echo "$(PYTHON) has no venv or no pip; install the package python3-venv (Debian, Ubuntu: apt-get install python3-venv)." >&2; exit 1; }
	@echo "--- setting up $(VENV) with $$($(PYTHON) -V) (once; about a minute)"
	@test -z "$(ANEW)" || test ! -e $(VENV)/made-for || rm -rf $(VENV)
	@$(PY) -m pip --version >/dev/null 2>&1 || $(PYTHON) -m venv $(VENV)
	@$(PIP) install --no-deps --require-hashes -r requirements.lock
	@$(PIP) install --no-deps --no-build-isolation -e .
	@echo "$(PLACE)" > $(VENV)/made-for
	@touch $@
