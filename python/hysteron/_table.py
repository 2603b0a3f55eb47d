"""Tables: a pandas.DataFrame where pandas is installed, else a list of dictionaries."""


def pandas():
    try:
        import pandas as module
    except ImportError:
        return None
    return module


def of_rows(rows, index=None):
    """Of dictionaries with the same keys; `index` names the column that tells the rows apart."""
    module = pandas()
    if module is None:
        return rows
    frame = module.DataFrame(rows)
    return frame.set_index(index) if index is not None and len(rows) > 0 else frame


def of_csv(text):
    module = pandas()
    if module is not None:
        import io

        return module.read_csv(io.StringIO(text))
    import csv

    return list(csv.DictReader(text.splitlines()))


def of_columns(columns):
    """Of arrays of one length by name."""
    module = pandas()
    if module is not None:
        return module.DataFrame(columns)
    return [dict(zip(columns, row)) for row in zip(*columns.values())]
