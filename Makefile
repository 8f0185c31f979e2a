# Every target sets up .venv by itself; a second call is quick.
#   make PYTHON=/path/to/python3.13 ...   another Python
#   make VENV=.venv311 ...                another virtual environment
#   make DISTRO=kilted ...                another ROS distribution, in .venv-kilted

VENV ?= .venv$(addprefix -,$(DISTRO))
BIN = $(abspath $(VENV))/bin
COMPILED = $(shell find ros_packages/interfaces sim/world/rays -type f -not -path '*/__pycache__/*' -not -path '*/build/*')

export PYTHON WHEELS DISTRO
# Equal runs need equal dictionary orders and equal sums on every machine.
export PYTHONHASHSEED = 0
export OPENBLAS_NUM_THREADS = 1
# Hundreds of processes would compile all that they import again; containers often say that they should.
unexport PYTHONDONTWRITEBYTECODE
# Another environment's ROS libraries must not leak into this one.
unexport LD_LIBRARY_PATH _ROS_WHEELS_BOOTSTRAP_COMPLETE

.PHONY: help lab teach test parts solutions demo exercises league handout site hub bench tidy lint setup tools wheels release lock clean

help:  ## this list
	@grep -hE '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 12

lab: setup  ## open the course in JupyterLab
	JUPYTER_CONFIG_PATH=$(CURDIR)/jupyter $(BIN)/jupyter-lab

teach: setup  ## the instructor's JupyterLab: formgrader, Create Assignment
	JUPYTER_CONFIG_PATH=$(CURDIR)/jupyter/teach $(BIN)/jupyter-lab

# Two processes more than cores: browsers, kernels and robots that run in real time are often waited for.
TESTERS = $$($(BIN)/python -c "import os; print(2 + len(os.sched_getaffinity(0)))")
TESTS = $(if $(filter extras,$(firstword $(ARGS))),-m 'extras and not soak' $(wordlist 2,99,$(ARGS)),$(ARGS))
test: tools  ## run the tests, on all cores (make test ARGS="-k notebooks" runs some, ARGS=extras what only CI runs each time)
	@sh .ci/javascript install
	$(BIN)/python -m pytest -n $(TESTERS) --dist loadfile $(TESTS)

parts: tools  ## test each part alone, with only its dependencies (make parts ARGS=sim tests one)
	@$(BIN)/python .ci/parts $(ARGS)

solutions: setup  ## run every lesson and every solution (make solutions ARGS="--junit FILE")
	$(BIN)/python -m grader.marking.release.run_solutions $(ARGS)

demo: setup  ## release, mark three sample submissions, give feedback; no browser
	$(BIN)/python -m grader.marking.release.demo

exercises: setup  ## make exercises/ from solutions/
	$(BIN)/python -m grader.marking.release.make_exercises

league: setup  ## let a class's delivery robots compete (make league ARGS="--worlds 3")
	$(BIN)/python -m grader league $(ARGS)

handout: setup  ## make what students get, a folder and a ZIP, in dist/
	$(BIN)/python -m grader.marking.release.handout $(ARGS)

site: setup $(VENV)-site/.site  ## the executed lessons as a web site, in dist/site/
	$(BIN)/python -m grader.marking.release.make_site --sphinx $(abspath $(VENV))-site/bin/sphinx-build $(ARGS)
# In an environment of its own: it needs other versions of some packages than the course.
$(VENV)-site/.site: .ci/site.lock
	@sh .ci/setup $(VENV)-site .ci/site.lock
	@touch $@

hub: setup  ## a JupyterHub for a class, as class/hub.toml says (make hub ARGS=--check)
	$(BIN)/python -m grader hub $(ARGS)

bench: tools  ## print the benchmarks (make bench ARGS=scenario prints one)
	$(BIN)/python -m tests.bench $(ARGS)

tidy: tools  ## normalize the notebooks, sort imports
	$(BIN)/python -m grader.course_files.notebook_format
	$(BIN)/python -m grader.marking.release.service_notebooks
	$(BIN)/ruff check --fix

# One spelling, the American one of ROS's names; pyproject.toml has the rest of its settings.
SPELLING = git ls-files -z | xargs -0 $(BIN)/codespell --dictionary - --dictionary .ci/words.txt

lint: tools  ## say what is untidy, change nothing
	$(BIN)/ruff check
	$(BIN)/mypy
	@$(SPELLING)
	$(BIN)/python -m grader.course_files.notebook_format --check
	$(BIN)/python -m grader.marking.release.make_exercises --check
	@sh .ci/javascript
	@$(BIN)/python -m tests.soak_record

setup: $(VENV)/.interfaces  ## make .venv and nothing more

tools: setup $(VENV)/.tools  ## and what tests, lint and several machines need on top
$(VENV)/.tools: .ci/tools.lock $(VENV)/.requirements
	@sh .ci/setup $(VENV) .ci/tools.lock
	@touch $@

SOURCES = pyproject.toml .ci/setup sim/absent_packages.toml $(wildcard ros_packages/cmake/*.* ros_packages/cmake/*/*) \
    $(wildcard ros_packages/interfaces/definitions/*/*/*)

$(VENV)/.requirements: requirements.lock $(SOURCES)
	@sh .ci/setup $(VENV)
	@touch $@

$(VENV)/.interfaces: $(VENV)/.requirements $(COMPILED)
	@$(BIN)/python ros_packages/interfaces/install.py
	@touch $@

wheels: tools  ## build the course for pip in wheels/ (make wheels ARGS=--offline adds all that set-up downloads)
	@$(BIN)/python .ci/wheels $(filter --offline,$(ARGS))

release: wheels  ## build a release in dist/release/ (make release ARGS="--tag v0.1.0 --site dist/site")
	@$(BIN)/python -m grader.marking.release.make_release $(ARGS)

# Left out: jsonschema takes more than a second to import it, and checks with it what no notebook has.
COMPILE = $(BIN)/uv pip compile --quiet --upgrade --universal --python-version 3.11 --generate-hashes \
    --no-emit-index-url --no-emit-find-links --no-emit-package rfc3987-syntax --custom-compile-command 'make lock'
lock: tools  ## take the newest versions into requirements.lock and its like
	$(COMPILE) --group build --extra lab pyproject.toml --output-file requirements.lock
	$(COMPILE) --group tools --constraint requirements.lock --output-file .ci/tools.lock
	$(COMPILE) --group hub --constraint requirements.lock --constraint .ci/tools.lock --output-file .ci/hub.lock
	$(COMPILE) --group kilted --output-file .ci/kilted.lock
	$(COMPILE) --group site --output-file .ci/site.lock
	$(COMPILE) --group install --constraint .ci/tools.lock --output-file .ci/uv.txt

clean:  ## remove the set-up and what tools left; class/, work/ and wheels/ stay
	rm -rf .venv* *.egg-info build sim/world/rays/*.egg-info sim/world/rays/build dist test-artifacts .pytest_cache .ruff_cache .mypy_cache
	find . -name __pycache__ -prune -exec rm -rf {} +
