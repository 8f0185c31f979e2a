# Every target sets up .venv by itself; a second call is quick.
#   make PYTHON=/path/to/python3.13 ...   another Python
#   make VENV=.venv311 ...                another virtual environment

VENV = .venv
BIN = $(abspath $(VENV))/bin
INTERFACES = $(shell find interfaces -type f -not -path '*/__pycache__/*')

export PYTHON
# Equal runs need equal dictionary orders and equal sums on every machine.
export PYTHONHASHSEED = 0
export OPENBLAS_NUM_THREADS = 1
# Another environment's ROS libraries must not leak into this one.
unexport LD_LIBRARY_PATH _ROS_WHEELS_BOOTSTRAP_COMPLETE

.PHONY: help lab teach test demo exercises bench tidy lint setup lock clean

help:  ## this list
	@grep -hE '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 12

lab: setup  ## open the course in JupyterLab
	JUPYTER_CONFIG_PATH=$(CURDIR)/jupyter $(BIN)/jupyter-lab

teach: setup  ## the instructor's JupyterLab: formgrader, Create Assignment
	JUPYTER_CONFIG_PATH=$(CURDIR)/jupyter/teach $(BIN)/jupyter-lab

test: setup  ## run the tests, on all cores (make test ARGS="-k notebooks" runs some)
	$(BIN)/python -m pytest -n auto --dist loadfile $(ARGS)

demo: setup  ## release, mark three sample submissions, give feedback; no browser
	$(BIN)/python -m grader.marking.release.demo

exercises: setup  ## make exercises/ from solutions/
	$(BIN)/python -m grader.marking.release.make_exercises

bench: setup  ## print the benchmarks (make bench ARGS=scenario prints one)
	$(BIN)/python -m tests.bench $(ARGS)

tidy: setup  ## normalise the notebooks, sort imports
	$(BIN)/python -m grader.notebooks
	$(BIN)/ruff check --fix

lint: setup  ## say what is untidy, change nothing
	$(BIN)/ruff check
	$(BIN)/python -m grader.notebooks --check
	$(BIN)/python -m grader.marking.release.make_exercises --check

setup: $(VENV)/.interfaces  ## make .venv and nothing more

$(VENV)/.packages: requirements.lock pyproject.toml .ci/setup sim/world/rays/pyproject.toml sim/world/rays/setup.py sim/world/rays/rays.py sim/world/rays/rays.c
	@.ci/setup $(VENV)
	@touch $@

$(VENV)/.interfaces: $(VENV)/.packages $(INTERFACES)
	@$(BIN)/python interfaces/install.py
	@touch $@

lock: setup  ## take the newest versions into requirements.lock
	$(BIN)/uv pip compile --quiet --upgrade --universal --python-version 3.11 --group dev --generate-hashes \
	    --no-emit-index-url --no-emit-find-links --custom-compile-command 'make lock' \
	    pyproject.toml --output-file requirements.lock

clean:  ## remove the set-up and what tools left; class/ stays
	rm -rf .venv* *.egg-info build sim/world/rays/*.egg-info sim/world/rays/build dist test-artifacts .pytest_cache .ruff_cache
	find . -name __pycache__ -prune -exec rm -rf {} +
