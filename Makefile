# Two commands: `make run` serves the pendant, `make test` proves it.
PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
# One thread a process: the arrays are small, and threads that wait for each other are slower.
export OMP_NUM_THREADS := 1
export OPENBLAS_NUM_THREADS := 1
# Who forbids it for other programs still has his tests compiled once, not by each of the tests' processes.
export PYTHONDONTWRITEBYTECODE :=

.PHONY: run test check audit format bench golden wheel fuzz clean

run: $(VENV)/.installed
	$(BIN)/teachframe serve

test: $(VENV)/.installed-dev browser
	$(BIN)/python -m pytest -n 3 --dist loadgroup -m "not browser"
	$(BIN)/python -m pytest -n 2 --dist loadgroup -m browser tests/browser

check: $(VENV)/.installed-dev
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/pyright

# Advisories on what is installed; where no registry or no advisories answer, a line says so.
audit: $(VENV)/.installed-dev
	$(BIN)/python .ci/audit

format: $(VENV)/.installed-dev
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

bench: $(VENV)/.installed-dev
	$(BIN)/pip install -q -e '.[bench]' || true
	$(BIN)/python -m benchmarks

golden: $(VENV)/.installed-dev
	TEACHFRAME_REWRITE_GOLDEN=1 $(BIN)/python -m pytest tests -k golden

# The nightly run: a million made-up files through whole commands, on all cores.
fuzz: $(VENV)/.installed-dev
	$(BIN)/python -m tests.hardening.fuzz 1000000

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
