"""The catalogue: models, solvers, effects, datasets and published tables."""

import json

from . import _hysteron, _table


def list(kind):
    """What there is of "models", "solvers", "effects", "datasets" or "tables": a table by id."""
    return _table.of_rows(json.loads(_hysteron.list(kind)), "id")


def describe(name):
    """One entry as a dictionary: equations, parameters with units and bounds, settings, source."""
    return json.loads(_hysteron.describe(name))
