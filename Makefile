# The two commands of the README, and those of a developer. uv makes the environment; where it is
# missing, pip puts it into .tools.
UV := $(shell command -v uv 2>/dev/null || echo .tools/bin/uv)

# Blender's Python module exists for Python 3.11 and 3.13: take one of them where there is one.
PYTHON = $(shell $(UV) python find --system --no-python-downloads '>=3.11,<3.12' 2>/dev/null \
	|| $(UV) python find --system --no-python-downloads '>=3.13,<3.14' 2>/dev/null || echo 3.13)
RUN = $(UV) run --quiet --python "$(PYTHON)" --extra blender

.PHONY: demo test lint slow format addon docs dist

demo: $(UV)  ## the main job, from a scan to a picture: make demo [MODEL=path]
	$(RUN) pdtheory demo $(if $(MODEL),--model "$(MODEL)")

test: lint  ## lint, types, layers and the default tests
	$(RUN) pytest

addon: $(UV)  ## the zips of the Blender extension, with their wheels, into dist/
	$(RUN) pdtheory addon build

docs: $(UV)  ## the documentation, into docs/_build/html; warnings are errors, nothing is fetched
	$(RUN) --group docs sphinx-build -W --keep-going -q -b html docs docs/_build/html

dist: $(UV)  ## sdist and wheel, each checked in an empty environment, into dist/: make dist [TAG=v1.2.3]
	UV="$(UV)" $(RUN) --group dist python tools/check_dist.py $(if $(TAG),--tag "$(TAG)")

slow: $(UV)  ## the long checks
	$(RUN) pytest -m slow

lint: $(UV)
	$(RUN) ruff check .
	$(RUN) ruff format --check .
	$(RUN) mypy
	$(RUN) lint-imports

format: $(UV)
	$(RUN) ruff check --fix .
	$(RUN) ruff format .

.tools/bin/uv:
	python3 -m venv .tools
	.tools/bin/python -m pip install --quiet uv
