"""Several models on the same recordings."""

import json
import os

from . import _hysteron, _table, _words
from ._hysteron import InputError
from .model import Model, load_model, save_files
from .recordings import as_recordings


class Comparison:
    """Errors, criteria and residuals of several models. `json` is compare.json as a dictionary, `text` what the program
    prints, `warnings` what models were asked beyond what they were fitted on."""

    def __init__(self, files, text, command, warnings):
        self._files = files
        self.text = text
        self.command = command
        self.warnings = tuple(warnings)
        self.json = json.loads(files["compare.json"])

    def __repr__(self):
        return f"<hysteron.Comparison: {', '.join(one['label'] for one in self.json['models'])}>"

    models = property(lambda self: self._table("models.csv"),
                      doc="a row per model: free parameters, NRMSE, AIC and BIC, whiteness of the residual")
    recordings = property(lambda self: self._table("recordings.csv"),
                          doc="a row per recording and model: NRMSE, RMSE, fit, whether it was fitted on")

    def _table(self, name):
        return _table.of_csv(self._files[name].decode())

    def save(self, folder, mat=False):
        """Writes compare.json, models.csv, recordings.csv and report.html, and with mat=True tables.mat, as `hysteron
        compare` does."""
        save_files({name: text for name, text in self._files.items() if mat or name != "tables.mat"}, folder)


def compare(models, recordings, *, normalisation="max-abs", weighting="per-recording", tolerance=1e-4, threads=0,
            out=None, mat=False):
    """Sets several models side by side on the same recordings: errors on what each was fitted on and on others, AIC, BIC,
    whiteness of the residuals, loops on one page.

    models: Model objects or paths of model.json, one or several; out: a folder for the files, mat: with tables.mat. The
    rest as in fit. Returns a Comparison."""
    if isinstance(models, (Model, str, os.PathLike)):
        models = [models]
    models = [one if isinstance(one, Model) else load_model(one) for one in models]
    if not models:
        raise InputError("compare: no models given, expected at least one")
    options = _words.common(normalisation, weighting, tolerance, threads)
    conditions = sorted({name for one in models for name in one.json.get("by", ())})
    recordings = as_recordings(recordings, need_force=True, conditions=conditions)
    _hysteron.refuse_unfollowed([one._stored for one in models], recordings.at)
    command = _words.Command("compare", *(one._path for one in models), *recordings.command_words())
    for name, value in recordings.at.items():
        command.add("--at", f"{name}={value}")
    if mat:
        command.words.append("--mat")
    command.add_common(1, options)
    files, text, remarks = _hysteron.compare(
        [(one._path, one._stored) for one in models], recordings.core(), options, command.text())
    _words.warn(remarks)
    result = Comparison(files, text, command.text(), remarks)
    if out is not None:
        result.save(out, mat)
    return result
