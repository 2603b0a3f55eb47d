"""Identification of damper models, comparison of solvers, diagnosis of missing physics.

    import hysteron
    recordings = hysteron.load("recordings/")
    model = hysteron.fit(recordings, "bouc-wen", by_current={"alpha": 1, "c0": 1})
    print(model.nrmse, model.parameters)

Results are those of the program `hysteron`, byte for byte: `model.command` is the command line that makes them again.
"""

import pathlib as _pathlib

from . import _hysteron, plot
from ._hysteron import InputError, WorkError
from ._words import HysteronWarning, Progress
from .catalogue import describe, list
from .comparison import Comparison, compare
from .diagnosis import Diagnosis, diagnose
from .model import Export, Model, Response, Score, fit, load_model, simulate_preset
from .recordings import Recording, Recordings, dataset, load, recording
from .study import Study, bench

__version__ = _hysteron.version
__all__ = [
    "Comparison", "Damper", "Diagnosis", "Export", "HysteronWarning", "InputError", "Model", "Progress", "Recording",
    "Recordings", "Response", "Score", "Study", "WorkError", "bench", "compare", "dataset", "describe", "diagnose", "fit",
    "list", "load", "load_model", "plot", "recording", "simulate_preset",
]

# Datasets that ship are beside the folder that holds the package, or below the prefix where it is installed.
for _folder in _pathlib.Path(__file__).resolve().parents[1:5]:
    if (_folder / "share" / "hysteron" / "datasets").is_dir():
        _hysteron.look_beside(str(_folder))


def __getattr__(name):
    # scikit-learn takes a second to import, which only the estimator needs.
    if name == "Damper":
        from .estimator import Damper

        return Damper
    raise AttributeError(f"module 'hysteron' has no attribute '{name}'")
