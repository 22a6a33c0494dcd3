# SPDX-License-Identifier: Apache-2.0
# Everything that is done with this checkout. `make help` lists it.

SHELL := /bin/bash
.DEFAULT_GOAL := help

BIN  := .venv/bin
JOBS ?= 2
# more options for pytest, such as PYTEST_ARGS='-k axil -x'
PYTEST_ARGS ?=
# more options for `relnav landing`, such as LANDING_ARGS='--frames 5 --backend icarus'
LANDING_ARGS ?=
# more options for `relnav proximity`, such as PROXIMITY_ARGS='--camera --frames 50'
PROXIMITY_ARGS ?=
# of `make waves`
CORE ?= oltae_top
# of `make mutate`: MODULE="float_add mux4"; MUTANTS=100 of each, or all
MODULE ?=
MUTANTS ?=
# --quick: a few cases, nothing kept
BENCH_ARGS ?=

# of `make examples`: all by default
EXAMPLES ?=

# --quick; --core oltae; --only 'axil_slave.*'
FAULTS_ARGS ?=

# modules to prove, all by default
FORMAL_ARGS ?=

.PHONY: help setup setup-c sim sim-ivisnav examples test c soak waves synth timing package bench formal docs site verification mutate faults coverage lint format clean distclean

help: ## this list
	@awk -F ':.*## ' '/^[a-z%<>-]+:.*## / { printf "  make %-14s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

setup: ## install what is missing: .venv, and Debian packages where that is possible
	@scripts/setup.sh

setup-c: setup ## also what tests the C driver bare on a Cortex-A9: cross compiler, QEMU, cppcheck (1.1 GB, Debian)
	@scripts/setup.sh --c

sim: setup ## fly the 25-frame landing through OLTAE's RTL and write the report (LANDING_ARGS=...)
	@$(BIN)/relnav landing $(LANDING_ARGS)

sim-ivisnav: setup ## move a plate before iVisNav's beacons, through the RTL, and write the report (PROXIMITY_ARGS=...)
	@$(BIN)/relnav proximity $(PROXIMITY_ARGS)

test: setup ## the whole regression on Icarus and Verilator (JOBS=2, PYTEST_ARGS=...)
	@$(BIN)/python -m pytest -n $(JOBS) $(PYTEST_ARGS)

sim-%: setup ## the testbenches of one module or folder of tb/, e.g. sim-centring, sim-gram
	@folders="$$(find tb -type d -name '$*')"; \
	if [ -z "$$folders" ]; then echo "make: no folder of tb/ is called $*" >&2; exit 2; fi; \
	$(BIN)/python -m pytest $(PYTEST_ARGS) $$folders

c: setup ## build and test the C driver (sw/c), measure its code and stack into sw/c/README.md
	@$(BIN)/python -m scripts.c_size && $(BIN)/python -m pytest $(PYTEST_ARGS) tb/c

soak: setup ## random frames, accesses, resets against the model (MINUTES=10 SEED= CORE=both SIMULATOR=verilator EPISODE=)
	@$(BIN)/python -m tb.soak.soak --jobs $(JOBS) $(if $(MINUTES),--minutes $(MINUTES)) $(if $(SEED),--seed $(SEED)) \
	  $(if $(filter file,$(origin CORE)),,--core $(CORE)) $(if $(SIMULATOR),--simulator $(SIMULATOR)) $(if $(EPISODE),--episode $(EPISODE))

waves: setup ## open GTKWave on the last run of CORE=oltae_top or ivisnav_top (without a screen: write the FST)
	@sim/waves.sh $(CORE)

synth: setup ## area on Xilinx 7 with Yosys, into syn/results.json and the README
	@$(BIN)/python syn/synth.py

timing: setup ## place and route on ECP5-85k with nextpnr (slow), into syn/results.json and the README
	@$(BIN)/python syn/timing.py

examples: setup ## run the examples; pictures into out/examples, tables into examples/README.md (EXAMPLES=landing)
	@$(BIN)/python -m scripts.examples $(EXAMPLES)

docs: setup ## fill README and docs/ from the last runs (after make sim sim-ivisnav), build the site in out/site
	@$(BIN)/python scripts/readme_sim.py && $(BIN)/python scripts/latency.py && \
	  $(BIN)/python scripts/ivisnav_sheet.py && $(BIN)/python scripts/decisions.py && \
	  $(BIN)/python scripts/verification.py && $(BIN)/python scripts/oltae_sheet.py && \
	  $(BIN)/python scripts/figures.py && $(BIN)/python scripts/plots.py && $(BIN)/python scripts/wavedrom_svg.py
	@$(MAKE) --no-print-directory site

site: setup ## the site alone, into out/site
	@NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --quiet --strict && echo "site: out/site/index.html"

verification: setup ## docs/verification.md from the results of formal, mutate, coverage and faults
	@$(BIN)/python scripts/verification.py

package: setup ## file lists, FuseSoC cores, IP-XACT components and the bench without Python, from the sources
	@$(BIN)/python -m package

bench: setup ## accuracy, 3-sigma bounds and flags of the model, into bench/results.json (BENCH_ARGS=--quick)
	@$(BIN)/python -m bench $(BENCH_ARGS)

formal: setup ## proofs with SymbiYosys, and broken copies that must fail (FORMAL_ARGS='axil_slave srt_digit')
	@$(BIN)/python -m formal $(FORMAL_ARGS)

mutate: setup ## put errors into the netlists, the tests must fail: a sample, 10 min (MODULE=..., MUTANTS=100 or all)
	@$(BIN)/python -m mutate --jobs $(JOBS) $(if $(MODULE),--module "$(MODULE)") $(if $(MUTANTS),--mutants $(MUTANTS))

faults: setup ## flip every control flip-flop in mid-frame, and some of the data, into faults/results.json (FAULTS_ARGS=--quick)
	@$(BIN)/python -m faults --jobs $(JOBS) $(FAULTS_ARGS)

coverage: setup ## lines, branches, toggles and cover points of the regression on Verilator; every hole
	@$(BIN)/python -m coverage --jobs $(JOBS)

lint: setup ## ruff, mypy, verible, Verilator on every module alone, Icarus, Yosys, shellcheck
	@scripts/lint.sh

format: setup ## format the Python files
	@$(BIN)/ruff format . && $(BIN)/ruff check --fix .

clean: ## remove what was built; .venv stays
	rm -rf build out .pytest_cache .mypy_cache .ruff_cache
	find bench coverage examples faults formal package mutate sim sw syn tb scripts -name __pycache__ -prune -exec rm -rf {} +

distclean: clean ## remove .venv too
	rm -rf .venv sw/*.egg-info
