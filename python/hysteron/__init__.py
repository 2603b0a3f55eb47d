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
from .diagnosis import Diagnosis, diagnose
from .model import Model, Score, fit, load_model
from .recordings import Recording, Recordings, dataset, load, recording
from .study import Study, bench

__version__ = _hysteron.version
__all__ = [
    "Damper", "Diagnosis", "HysteronWarning", "InputError", "Model", "Progress", "Recording", "Recordings", "Score",
    "Study", "WorkError", "bench", "dataset", "describe", "diagnose", "fit", "list", "load", "load_model", "plot",
    "recording",
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
