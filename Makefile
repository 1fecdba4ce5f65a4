# Two commands: `make demo` and `make test`.  Everything happens in .venv; nothing else on the machine is touched but by `make system`.
PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
JOBS   ?= 2
export MPLBACKEND = Agg
unexport PYTHONDONTWRITEBYTECODE  # tests start hundreds of processes; without bytecode each of them reads all sources anew

.PHONY: demo quick test test-slow durations system bench growth wheel docs lint clean

demo: $(VENV)/core.ready
	$(BIN)/drivewright examples --run all --out out

# About a minute: without the tests that tests/durations.json lists as long, and without those whose kernels are not compiled yet.
quick: $(VENV)/test.ready
	OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 $(BIN)/python -m pytest -n $(JOBS) -m "not slow and not needs_browser" --quick $(ARGS)

# Measures all tests but the slow ones, kernels compiled (so after `make test`), and writes tests/durations.json.
durations: $(VENV)/test.ready
	OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 $(BIN)/python -m pytest -n $(JOBS) -m "not slow" --record-durations $(ARGS)

test: $(VENV)/test.ready
	OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 $(BIN)/python -m pytest -n $(JOBS) -m "not slow" $(ARGS)

test-slow: $(VENV)/test.ready
	OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 $(BIN)/python -m pytest -n $(JOBS) -m slow $(ARGS)

bench: $(VENV)/test.ready
	OPENBLAS_NUM_THREADS=1 $(BIN)/python benchmarks/run.py

# How run time grows with size, and a study with its workers: docs/growth.md and its figures, about six minutes.
growth: $(VENV)/test.ready
	OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 $(BIN)/python benchmarks/growth.py

# Linux x86-64: a wheel with compiled kernels, so that the first run of whoever installs it compiles nothing.
wheel: $(VENV)/core.ready
	$(BIN)/python scripts/wheel.py

# The site, readable from disk: about three minutes. FULL=1 computes all cases of the worked studies and all parts of the papers, too.
docs: $(VENV)/docs.ready
	OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 $(BIN)/python docs/generate.py $(if $(FULL),--full)
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --strict
	$(BIN)/python docs/check_site.py site

lint: $(VENV)/test.ready
	$(BIN)/ruff check src tests benchmarks docs
	$(BIN)/ruff format --check src tests benchmarks docs
	$(BIN)/codespell src docs examples benchmarks scripts README.md CONTRIBUTING.md CHANGELOG.md
	$(BIN)/basedpyright

system:
	scripts/system.sh install

clean:
	rm -rf $(VENV) out site dist

# .venv counts as ready only after pip has succeeded, and is remade when pyproject.toml changes.
$(VENV)/core.ready: pyproject.toml scripts/venv.sh
	scripts/venv.sh "$(PYTHON)" "$(VENV)" core

$(VENV)/test.ready: pyproject.toml scripts/venv.sh
	scripts/system.sh offer
	scripts/venv.sh "$(PYTHON)" "$(VENV)" test

$(VENV)/docs.ready: pyproject.toml scripts/venv.sh
	scripts/venv.sh "$(PYTHON)" "$(VENV)" docs
