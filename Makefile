# Everything runs in an environment of its own, made from a lock file with hashes.
PYTHON ?= python3
VENV ?= .venv
BIN := $(VENV)/bin

# A warning is an error, and so is a reference without a target.
SPHINX = $(BIN)/sphinx-build --quiet --jobs auto --fail-on-warning --keep-going --nitpicky -d docs/_build/doctrees

# Tests that touch every library that is depended on.
LOWEST := cli fit imports micrograph new_laws records user_law

.PHONY: help run test test-slow test-all test-lowest lint docs figures docs-links verify bench lock clean

help: ## list the commands
	@grep -E '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 11

run: $(VENV)/.run ## compute the paper's headline: table here, figure in headline.svg
	$(BIN)/stonepass headline

test: $(VENV)/.dev ## run the fast tests: every command, contract and identity, in about five minutes on two cores
	$(BIN)/pytest -n auto --dist worksteal -m "not slow"

test-slow: $(VENV)/.dev ## run the tests that `make test` leaves out: other programs, browser, fuzzing
	$(BIN)/pytest -n auto --dist worksteal -m slow

test-all: test test-slow ## run all tests

test-lowest: $(VENV)/.lowest ## run tests with the oldest versions allowed: VENV=another-folder
	$(BIN)/pytest -n auto --dist worksteal -m "not slow" $(LOWEST:%=tests/test_%.py)

lint: $(VENV)/.dev ## format, lint, types, layers
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports --no-cache

docs: $(VENV)/.dev ## build the documentation site in docs/_build/html; runs its notebooks and examples
	$(SPHINX) -b html docs docs/_build/html
	$(SPHINX) -b doctest docs docs/_build/doctest
	$(BIN)/python docs/check_offline.py docs/_build/html

figures: $(VENV)/.dev ## draw the figures of the documentation that are out of date; takes minutes for the paper's
	$(BIN)/python docs/make_figures.py

docs-links: $(VENV)/.dev ## check the links of the documentation to other sites
	$(SPHINX) -b linkcheck docs docs/_build/links

verify: $(VENV)/.dev ## slow verification; writes docs/verification.md
	$(BIN)/python verification/run.py

bench: $(VENV)/.dev ## timings against their targets
	$(BIN)/python benchmarks/run.py

lock: ## renew the lock files (needs uv)
	uv pip compile pyproject.toml --group build --universal --generate-hashes --no-annotate --no-header -o requirements.lock
	uv pip compile pyproject.toml --group dev --extra imaging --extra cluster --extra web --universal --generate-hashes --no-annotate --no-header -o requirements-dev.lock
	uv pip compile pyproject.toml --group build --group test --extra imaging --extra cluster --extra web --resolution lowest-direct --python-version 3.11 --generate-hashes --no-annotate --no-header -o requirements-lowest.lock

clean: ## remove the environment and caches
	rm -rf $(VENV) docs/_build docs/generated .pytest_cache .mypy_cache .ruff_cache .hypothesis

$(VENV)/.python:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
		{ echo "Python 3.11 or newer is needed: make PYTHON=/path/to/python3.11 ..." >&2; exit 1; }
	$(PYTHON) -m venv $(VENV)
	@touch $@

$(VENV)/.run: requirements.lock pyproject.toml | $(VENV)/.python
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation -e .
	@touch $@

$(VENV)/.lowest: requirements-lowest.lock pyproject.toml | $(VENV)/.python
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements-lowest.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation -e .
	@touch $@

$(VENV)/.dev: requirements-dev.lock $(VENV)/.run
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements-dev.lock
	@touch $@
