# Two commands: `make run` serves the pendant, `make test` proves it.
PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
# One thread a process: the arrays are small, and threads that wait for each other are slower.
export OMP_NUM_THREADS := 1
export OPENBLAS_NUM_THREADS := 1

.PHONY: run test check format bench golden wheel clean

run: $(VENV)/.installed
	$(BIN)/teachframe serve

test: $(VENV)/.installed-dev browser
	$(BIN)/python -m pytest -n 2 --dist loadgroup -m "not browser"
	$(BIN)/python -m pytest -m browser

check: $(VENV)/.installed-dev
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/pyright

format: $(VENV)/.installed-dev
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

bench: $(VENV)/.installed-dev
	$(BIN)/pip install -q -e '.[bench]' || true
	$(BIN)/python -m benchmarks

golden: $(VENV)/.installed-dev
	TEACHFRAME_REWRITE_GOLDEN=1 $(BIN)/python -m pytest tests -k golden

wheel: $(VENV)/.installed-dev
	$(BIN)/pip wheel -q --no-deps -w dist .

.PHONY: browser
browser:
	@sh .ci/chromium

$(VENV)/.created:
	$(PYTHON) -m venv $(VENV)
	@touch $@

$(VENV)/.installed: pyproject.toml | $(VENV)/.created
	$(BIN)/pip install -q --disable-pip-version-check -e .
	@touch $@

$(VENV)/.installed-dev: pyproject.toml | $(VENV)/.created
	$(BIN)/pip install -q --disable-pip-version-check -e '.[dev]'
	@touch $@ $(VENV)/.installed

clean:
	rm -rf $(VENV) dist build
