# `make` alone explains itself; the environment .venv is made when it is first needed.

PYTHON ?= python3
FLOORS := .venv-floors
UV_VERSION := 0.13.9
FRAMES ?= 1000000
GUIDED_SECONDS ?= 60

# Every Python has an environment of its own: .venv, or .venv-python3.13 where PYTHON=python3.13 is named.
empty :=
VENV := .venv$(if $(filter-out python3,$(PYTHON)),-$(subst $(empty) ,_,$(subst /,_,$(PYTHON))))
PY := $(VENV)/bin/python
PIP := $(PY) -m pip --disable-pip-version-check --no-input -q
FROM_LOCK := $(PIP) install --no-deps --require-hashes
COMPILE := $(VENV)/bin/uv pip compile --quiet --python-version 3.11

# What an environment was made for, and how many files it had: one that was copied or half deleted is made anew.
PLACE := $(CURDIR) $(PYTHON)
COUNT = find $(VENV)/bin $(VENV)/lib '(' -name '*.py' -o -name '*.so' -o -path '*/bin/*' ')' 2>/dev/null | wc -l
ifneq ($(wildcard $(VENV)),)
ifneq ("$(shell cat $(VENV)/made-for 2>/dev/null)","$(PLACE)")
ANEW := anew
else ifeq ($(shell test $$($(COUNT)) -ge $$(cat $(VENV)/files 2>/dev/null || echo 999999) && echo whole),)
ANEW := anew
endif
endif

.PHONY: help demo test floors interop bench fuzz crashes mutants hostile lock clean anew
.DELETE_ON_ERROR:

help:
	@echo "make demo    grade a small sample class, print the table and say where to look"
	@echo "make test    check format, lint and types, then run all tests"
	@echo "make floors  run the quick tests with the lowest versions that pyproject.toml allows (network)"
	@echo "make interop install nbgrader and Otter beside .venv and compare their marks with ours (network, ten minutes)"
	@echo "make bench   measure the grader beside its floor and other graders, and a class of 1,000 (network, half an hour)"
	@echo "make fuzz    throw a million random frames and 3,000 odd submissions at the grader, then fresh examples at the properties"
	@echo "make mutants change the reference everywhere, one place at a time: does the exam notice?"
	@echo "make hostile print which attacks of the hostile corpus get through, with the locks and without"
	@echo "make crashes kill workers, fork servers and the grader fifty times, interrupt it at 100 moments, and compare what they leave"
	@echo "make lock    write requirements.lock anew from pyproject.toml"
	@echo "make clean   remove everything that make made"
	@echo ""
	@echo "The first of them sets up .venv; it needs python3 >= 3.11 with venv."
	@echo "Another Python, with an environment of its own: make test PYTHON=python3.13"

demo: $(VENV)/ready
	@$(PY) -m autograder demo

test: $(VENV)/ready-dev
	@echo "--- format: ruff format"
	@$(PY) -m ruff format --check --quiet .
	@echo "--- lint: ruff check"
	@$(PY) -m ruff check --quiet .
	@echo "--- types: mypy"
	@$(PY) -m mypy --no-error-summary
	@echo "--- tests: pytest"
	@$(PY) -m pytest -q -n 2 --dist loadfile --cov --cov-report=term

interop: $(VENV)/ready-dev
	@INTEROP=1 INTEROP_ENVIRONMENTS="$(CURDIR)/$(VENV)/interop" $(PY) -m pytest -q -s tests/exports/interop

bench: $(VENV)/ready-dev
	@$(PY) -m tests.benchmarks --environments $(VENV)/peers

fuzz: $(VENV)/ready-dev
	@echo "--- frames: random"
	@$(PY) tests/fuzz/frames.py --frames $(FRAMES)
	@echo "--- frames: guided by coverage"
	@$(PY) tests/fuzz/guided.py --seconds $(GUIDED_SECONDS)
	@echo "--- values: submissions that return anything"
	@$(PY) -m tests.fuzz.values --count $(ANYTHING)
	@echo "--- property tests: fresh examples"
	@$(PY) -m pytest -q --hypothesis-profile=fuzz -m "hypothesis and not slow"

crashes: $(VENV)/ready-dev
	@MOMENTS=100 $(PY) -m pytest -q -s tests/engine/test_crashes.py tests/engine/test_signals.py

mutants: $(VENV)/ready-mutants
	@$(PY) -m tests.mutation

hostile: $(VENV)/ready-dev
	@$(PY) -m tests.hostile.table

# The slow tests and those in a browser depend on no version of a package that the quick ones do not use.
floors: $(FLOORS)/ready
	@echo "--- tests with the lowest versions: pytest"
	@$(FLOORS)/bin/python -m pytest -q -n 2 --dist loadfile -m "not slow" --ignore tests/reports/test_pages_in_a_browser.py

lock: $(VENV)/uv
	@echo "--- requirements.lock, requirements-dev.lock, requirements-mutants.lock"
	@for group in build dev mutants; do \
		case $$group in build) lock=requirements.lock;; *) lock=requirements-$$group.lock;; esac; \
		$(COMPILE) --upgrade --universal --generate-hashes --custom-compile-command "make lock" --group $$group \
			$${before:+--constraint $$before} pyproject.toml --output-file $$lock || exit 1; \
		before=requirements.lock; \
	done

clean:
	@rm -rf .venv .venv-* dist bench slam1d-demo .coverage .hypothesis .mypy_cache .pytest_cache .ruff_cache
	@find . -name __pycache__ -type d -prune -exec rm -rf {} +
	@echo "clean"

# What `make demo` needs: the program, and what builds it.
$(VENV)/ready: requirements.lock pyproject.toml $(ANEW)
	@command -v "$(PYTHON)" >/dev/null || { \
		echo "$(PYTHON) was not found; install Python 3.11 or newer (Debian, Ubuntu: apt-get install python3 python3-venv)." >&2; exit 1; }
	@"$(PYTHON)" -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
		echo "$(PYTHON) is $$("$(PYTHON)" -V 2>&1), but 3.11 or newer is needed; name another one: make test PYTHON=python3.13" >&2; exit 1; }
	@"$(PYTHON)" -c 'import venv, ensurepip' 2>/dev/null || { \
		echo "$(PYTHON) has no venv or no pip; install the package python3-venv (Debian, Ubuntu: apt-get install python3-venv)." >&2; exit 1; }
	@echo "--- setting up $(VENV) with $$("$(PYTHON)" -V) (once; about a minute)"
	@test -z "$(ANEW)" || rm -rf $(VENV)
	@$(PY) -m pip --version >/dev/null 2>&1 || "$(PYTHON)" -m venv --clear $(VENV)
	@echo "$(PLACE)" > $(VENV)/made-for
	@$(FROM_LOCK) -r requirements.lock
	@$(PIP) install --no-deps --no-build-isolation -e .
	@$(COUNT) > $(VENV)/files
	@touch $@

# What is needed to change the program and to test it.
$(VENV)/ready-dev: $(VENV)/ready requirements-dev.lock
	@echo "--- adding what the tests need to $(VENV)"
	@$(FROM_LOCK) -r requirements-dev.lock
	@$(COUNT) > $(VENV)/files
	@touch $@

$(VENV)/ready-mutants: $(VENV)/ready-dev requirements-mutants.lock
	@echo "--- adding what mutates the reference to $(VENV)"
	@$(FROM_LOCK) -r requirements-mutants.lock
	@$(COUNT) > $(VENV)/files
	@touch $@

$(VENV)/uv: $(VENV)/ready-dev
	@$(PIP) install uv==$(UV_VERSION)
	@touch $@

$(FLOORS)/ready: pyproject.toml $(VENV)/uv
	@echo "--- setting up $(FLOORS) with the lowest versions"
	@"$(PYTHON)" -m venv --clear $(FLOORS)
	@$(COMPILE) --resolution lowest-direct --group dev pyproject.toml --output-file $(FLOORS)/requirements.txt
	@$(FLOORS)/bin/python -m pip --disable-pip-version-check --no-input -q install --no-deps -r $(FLOORS)/requirements.txt
	@$(FLOORS)/bin/python -m pip --disable-pip-version-check --no-input -q install --no-deps --no-build-isolation -e .
	@touch $@
