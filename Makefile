# The first Python that is new enough; another one by `make PYTHON=...`
PYTHON ?= $(shell for p in python3 python3.14 python3.13 python3.12 python3.11; do \
	$$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $$p && break; done)
VENV := .venv
RUN := $(VENV)/bin/python -m
READY := $(VENV)/ready
PEERS := $(VENV)/peers
AXE := $(VENV)/accessibility
STRENGTH := $(VENV)/strength
DOCS := $(VENV)/docs
# the oldest dependencies have no files for Python 3.14
OLDEST_PYTHON ?= $(shell for p in python3.11 python3.12 python3.13 python3; do \
	$$p -c 'import sys; sys.exit(not (3, 11) <= sys.version_info < (3, 14))' 2>/dev/null && echo $$p && break; done)
OLDEST := .venv-oldest
RECORD := .coverage-times.xml
RECORD_OF_VERDICTS := .coverage-verdicts-times.xml

.PHONY: report full-report reference answers benchmark race peers docs check fast test accessibility oldest-python oldest thorough coverage verdicts mutation lint types format clean

report: $(READY)  ## the validation report, small: reports/quick/index.html
	$(RUN) validation report $(ARGS)

full-report: $(READY)  ## the real one: reports/full/index.html
	$(RUN) validation report --profile full $(ARGS)

reference: $(PEERS)  ## the committed one, with the solver benchmark: reports/reference/index.html
	$(RUN) validation report --profile full --out reports/reference; status=$$?; $(MAKE) answers; exit $$status

answers: $(READY)  ## what README.md and the documentation quote: answers of the committed report, output of commands
	$(VENV)/bin/python .ci/readme.py

benchmark: $(PEERS)  ## solvers beside the peers, which it installs: reports/benchmark-quick/index.html
	$(RUN) validation benchmark $(ARGS)

race: $(PEERS)  ## the former name of benchmark, for one release: reports/race-quick/index.html
	$(RUN) validation race $(ARGS)

peers: $(PEERS)  ## the packages of the solver comparison; tests beside them are skipped without

docs: $(DOCS)  ## the documentation: reports/docs/_build/html/index.html
	$(RUN) sphinx --quiet --nitpicky --fail-on-warning --keep-going -d reports/docs/_build/doctrees \
		reports/docs reports/docs/_build/html $(ARGS)

# a worker more than cores, since some tests wait, and one thread each; tests of a file on the same one, which share their
# fixtures, until it takes what is left of another
WORKERS := $(shell $(PYTHON) -c "import os; print((os.cpu_count() or 1) + 1)" 2>/dev/null)
SHARED := -n $(or $(WORKERS),auto) --dist worksteal
fast test oldest coverage verdicts: export OMP_NUM_THREADS := 1

check: lint types fast  ## for the loop while one works, a minute: lint, types and the tests not marked slow

fast: $(READY)
	$(RUN) pytest -q $(SHARED) -m "not slow" $(ARGS)

test: $(READY)  ## all tests
	$(RUN) pytest $(SHARED) $(ARGS)

oldest-python:
	@test -n "$(OLDEST_PYTHON)" || { echo "the oldest dependencies need a Python from 3.11 to 3.13, and none is installed"; exit 2; }

oldest: oldest-python $(if $(OLDEST_PYTHON),$(OLDEST)/ready)  ## the tests not marked slow, on the oldest versions that pyproject.toml allows
	# an old library says of its own imports that they are deprecated
	# seeded faults and mutants try the tests, cases what they say, the table of imports our own files: no library
	$(OLDEST)/bin/python -m pytest -q $(SHARED) -m "not slow" -W ignore::DeprecationWarning \
		$(addprefix --ignore=tests/,test_seeded_faults.py cases mutation test_architecture.py) $(ARGS)

accessibility: $(AXE)  ## the page of a report by axe-core in a headless chromium, which has to be there
	$(RUN) pytest -q $(SHARED) tests/report/test_axe.py $(ARGS)

thorough: $(READY)  ## the property tests on many more examples
	HYPOTHESIS_PROFILE=thorough $(RUN) pytest -n auto $(ARGS)

# who looks at the methods; reports and cases execute them without looking
METHODS := tests/mdr tests/bem3d tests/theory tests/test_bad_input.py tests/test_interpreter.py tests/test_read_only_results.py
# who looks at what makes verdicts and claims
GUARDS := tests/analysis tests/theory tests/scenes tests/simulation tests/benchmarks tests/cases tests/engine tests/report tests/advice tests/railway tests/judging

coverage: $(STRENGTH)  ## every branch of mdr and bem3d, by the tests of these alone; fails where one is missed
	$(RUN) pytest -n auto --cov --cov-context=test --junitxml=$(RECORD) \
		$(METHODS) $(ARGS)

verdicts: $(STRENGTH)  ## which test of verdicts and claims has executed which line of them
	COVERAGE_FILE=.coverage-verdicts $(RUN) pytest -n auto -p tests.mutation.fixture_times --cov --cov-context=test \
		--cov-config=tests/mutation/verdicts.coveragerc --cov-report= --junitxml=$(RECORD_OF_VERDICTS) \
		$(GUARDS) $(ARGS)

# small changes and who notices: in mdr, bem3d, closed forms; ARGS="--sample 300"; in what makes verdicts, and in what
# claims rest on: ARGS="--of verdicts", "--of claims"; --only PATH for some of their files
mutation: $(RECORD) $(RECORD_OF_VERDICTS)
	$(RUN) tests.mutation.runner $(ARGS)

$(RECORD): $(STRENGTH) $(wildcard mdr/*.py bem3d/*.py validation/theory/closed_forms.py tests/*.py tests/*/*.py)
	$(MAKE) coverage ARGS=

$(RECORD_OF_VERDICTS): $(STRENGTH) $(wildcard validation/*/*.py validation/*/*/*.py tests/*.py tests/*/*.py)
	$(MAKE) verdicts ARGS=

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

$(OLDEST)/ready: pyproject.toml .ci/oldest.py
	$(OLDEST_PYTHON) -m venv $(OLDEST)
	$(OLDEST)/bin/python -m pip install --quiet --upgrade "pip>=25.1"
	$(OLDEST)/bin/python .ci/oldest.py > $(OLDEST)/oldest.txt
	$(OLDEST)/bin/python -m pip install --quiet --constraint $(OLDEST)/oldest.txt --editable . --group test
	touch $@

$(PEERS): $(READY)
	$(RUN) pip install --quiet --editable ".[peers]"
	touch $@

$(DOCS): $(READY)
	$(RUN) pip install --quiet --group docs
	touch $@

$(AXE): $(READY)
	$(RUN) pip install --quiet --group accessibility
	touch $@

$(STRENGTH): $(READY)
	$(RUN) pip install --quiet --group strength
	touch $@

clean:
	rm -rf $(VENV) $(OLDEST) reports/docs/_build reports/docs/examples reports/docs/report .hypothesis .mypy_cache .pytest_cache .ruff_cache .coverage .coverage-verdicts $(RECORD) $(RECORD_OF_VERDICTS)
