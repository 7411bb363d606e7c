# `make` alone lists the targets. Everything is installed into .venv; nothing is needed but Python 3.11 and make.

VENV    := .venv
BIN     := $(VENV)/bin
PYTHON  ?= python3.11 python3.12 python3.13 python3
OUT     ?= out
RUNS    ?= 20000
FIRST   ?= 0

.DEFAULT_GOAL := help
.PHONY: help run test soak oracle generated check bench crosscheck docs clean

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z]+:.*## / { printf "  make %-10s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

run: $(VENV)/.test ## derive, check and simulate a flexible structure under El Centro 1940, into out/
	@$(BIN)/python -m rockeom.cli.demo --out $(OUT)

# with bytecode: both workers, and the processes that tests start, read the same files
test: $(VENV)/.test ## run the tests
	PYTHONDONTWRITEBYTECODE= $(BIN)/python -m pytest -n 2 --dist loadfile

soak: $(VENV)/.test ## check random motions and spoiled files, RUNS=20000 of them from seed FIRST=0 on (minutes, and compiling)
	$(BIN)/python -m tests.soak --runs $(RUNS) --first $(FIRST)
	$(BIN)/python -m tests.motion.networks.mutations --runs $(RUNS) --first $(FIRST)
	$(BIN)/python -m tests.space.soak --runs $(RUNS) --first $(FIRST)

oracle: $(VENV)/.test ## compare the machine code of every structure with Python and with numba (minutes)
	$(BIN)/python -m tests.oracle

generated: $(VENV)/.dev ## rewrite generated/ from the symbolic models
	$(BIN)/rockeom generate

check: $(VENV)/.dev ## lint, format, types, import borders, form, generated/ up to date
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/python -m tests.form
	$(BIN)/rockeom generate --check

bench: $(VENV)/.test ## speed and error beside C, heyoka and SciPy, side by side (minutes), into out/
	$(BIN)/python -m benchmarks --out $(OUT)
	$(BIN)/python -m benchmarks.in_space speed first many planar --out $(OUT)

crosscheck: $(VENV)/.crosscheck ## the same motions by MuJoCo, Bullet, Drake, Exudyn and OpenSees, into out/
	$(BIN)/python -m benchmarks.crosscheck --out $(OUT)
	$(BIN)/python -m benchmarks.engines --out $(OUT)
	$(BIN)/python -m benchmarks.in_space engines --out $(OUT)

docs: $(VENV)/.docs ## build the documentation, every example and derivation run, into out/docs
	$(BIN)/python -m sphinx -W --keep-going -b html -d docs/_build/doctrees docs $(OUT)/docs

clean: ## remove .venv, out/ and every cache
	rm -rf $(VENV) out build dist docs/_build docs/derivations docs/derived .pytest_cache .ruff_cache .mypy_cache .import_linter_cache .hypothesis
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

# Stamps: an extra is installed once, and again when pyproject.toml changes.
$(VENV)/.test $(VENV)/.dev $(VENV)/.opensees $(VENV)/.crosscheck $(VENV)/.docs: $(VENV)/.%: pyproject.toml | $(BIN)/python
	$(BIN)/python -m pip install --quiet --editable ".[$*]"
	@touch $@

$(BIN)/python:
	@for python in $(PYTHON); do \
	  if "$$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then \
	    echo "Creating $(VENV) with $$python"; \
	    "$$python" -m venv $(VENV) && exit 0; \
	    rm -rf $(VENV); exit 1; \
	  fi; \
	done; \
	echo "rockeom needs Python 3.11 or newer, and none of these is: $(PYTHON)." >&2; \
	echo "Install one, or name it: make $(firstword $(MAKECMDGOALS)) PYTHON=/path/to/python3.11" >&2; \
	exit 1
