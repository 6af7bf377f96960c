# The first Python that is new enough; another one by `make PYTHON=...`
PYTHON ?= $(shell for p in python3 python3.14 python3.13 python3.12 python3.11; do \
	$$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $$p && break; done)
VENV := .venv
RUN := $(VENV)/bin/python -m
READY := $(VENV)/ready
PEERS := $(VENV)/peers
STRENGTH := $(VENV)/strength
RECORD := .coverage-times.xml

.PHONY: report full-report reference race test thorough coverage mutation lint types format clean

report: $(READY)  ## the validation report, small: reports/quick/index.html
	$(RUN) validation report $(ARGS)

full-report: $(READY)  ## the real one: reports/full/index.html
	$(RUN) validation report --profile full $(ARGS)

reference: $(PEERS)  ## the committed one, with the race: reports/reference/index.html
	$(RUN) validation report --profile full --out reports/reference

race: $(PEERS)  ## beside the peers, which it installs: reports/race-quick/index.html
	$(RUN) validation race $(ARGS)

test: $(READY)  ## all tests
	$(RUN) pytest -n auto $(ARGS)

thorough: $(READY)  ## the property tests on many more examples
	HYPOTHESIS_PROFILE=thorough $(RUN) pytest -n auto $(ARGS)

# reports and cases execute the methods without looking at them: they do not count here
AT_WORK := architecture command_line endings ensemble evidence fractal_punch ladder limits measured_heights planted_faults \
	precision race readme report_folder rolling_cases rough_punches scene_files wheel_cases wheel_spectra wheel_stability

coverage: $(STRENGTH)  ## every branch of mdr and bem3d, by the tests of these alone; fails where one is missed
	$(RUN) pytest -n auto --cov --cov-context=test --junitxml=$(RECORD) \
		$(AT_WORK:%=--ignore=tests/test_%.py) $(ARGS)

mutation: $(RECORD)  ## small changes in mdr, bem3d and the closed forms, and who notices; ARGS="--sample 300"
	$(RUN) tests.mutation $(ARGS)

$(RECORD): $(STRENGTH) $(wildcard mdr/*.py bem3d/*.py validation/closed_forms.py tests/*.py)
	$(MAKE) coverage ARGS=

lint: $(READY)
	$(RUN) ruff check .
	$(RUN) ruff format --check .

types: $(READY)
	$(RUN) mypy

format: $(READY)
	$(RUN) ruff check --fix .
	$(RUN) ruff format .

$(READY): pyproject.toml
	@test -n "$(PYTHON)" || { echo "Python 3.11 or newer is needed; name one with make PYTHON=..."; exit 2; }
	$(PYTHON) -m venv $(VENV)
	$(RUN) pip install --quiet --upgrade "pip>=25.1"
	$(RUN) pip install --quiet --editable . --group dev
	touch $@

$(PEERS): $(READY)
	$(RUN) pip install --quiet --editable ".[peers]"
	touch $@

$(STRENGTH): $(READY)
	$(RUN) pip install --quiet --group strength
	touch $@

clean:
	rm -rf $(VENV) .hypothesis .mypy_cache .pytest_cache .ruff_cache .coverage $(RECORD) .mutation-killers.json
