"""Studies: solvers compared on models, data and seeds."""

import json
import tempfile

from . import _hysteron, _table, _words
from .model import save_files


class Study:
    """The records of a study, finished or not. `text` is the report as the program prints it."""

    def __init__(self, folder):
        self._files, self.text = _hysteron.report(_words.path(folder))
        self.json = json.loads(self._files["analysis.json"])

    def __repr__(self):
        return f"<hysteron.Study {self.json['title']}>" if "title" in self.json else "<hysteron.Study>"

    runs = property(lambda self: self._table("runs.csv"), doc="a row per run: problem, solver, budget, seed, result")
    traces = property(lambda self: self._table("traces.csv"), doc="best error against evaluations of every run")
    parameters = property(lambda self: self._table("parameters.csv"), doc="what every run found")
    columns = property(lambda self: self._table("columns.csv"), doc="what the columns of these tables mean")

    def _table(self, name):
        return _table.of_csv(self._files[name].decode())

    def save(self, folder):
        """Writes the report's files, as `hysteron report` does."""
        save_files(self._files, folder)


def bench(study, out=None, threads=0, progress=None):
    """Runs a study file and returns its Study. out: folder of the records, where an interrupted study goes on; without
    it the records are not kept. Ctrl-C keeps the finished runs in `out`."""
    threads = _words.whole("threads", threads, 0, 1024)
    if out is None:
        with tempfile.TemporaryDirectory(prefix="hysteron-") as folder:
            return bench(study, folder, threads, progress)
    _hysteron.bench(_words.path(study), _words.path(out), threads, _words.observer(progress))
    return Study(out)
