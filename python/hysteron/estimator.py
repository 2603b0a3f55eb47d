"""The estimator interface of scikit-learn."""

import numpy
from sklearn.base import BaseEstimator, RegressorMixin
from sklearn.utils.validation import check_is_fitted

from . import _hysteron
from . import recordings as _recordings
from ._hysteron import InputError
from .model import fit

# A prediction follows from the motion before it, not from its row alone.
_HISTORY = "the force depends on the motion before a sample: rows are one recording in time order"
_SHORT = "a model is identified from 16 samples or more, and the check has 10"
_XFAIL_CHECKS = {
    "check_methods_subset_invariance": _HISTORY,
    "check_methods_sample_order_invariance": _HISTORY,
    "check_estimators_nan_inf": _SHORT,
    "check_fit2d_1feature": _SHORT,
    "check_regressors_no_decision_function": _SHORT,
}


_COUNT = "count of rows [s]"  # a name that no y has


def _in_newtons(y):
    """How many N a 1 of y is, by the unit in its name: what the reader makes of such a column that counts."""
    columns = getattr(y, "columns", ())  # of a DataFrame
    name = columns[0] if len(columns) == 1 else getattr(y, "name", None)
    if not isinstance(name, str) or not name.strip():
        return 1.0
    _recordings.refuse_name("y", name)
    count = numpy.arange(16.0)
    try:
        read, *_ = _hysteron.recording(
            [_COUNT, name], [count, count], "y", {"time": _COUNT, "force": name}, 0, "excitation", [], False)
    except InputError as error:
        raise InputError(f"y {name!r}: {str(error).partition(': ')[2]}") from None
    return read.force[1]


class Damper(RegressorMixin, BaseEstimator):
    """Force of a damper (y) from its motion (X), rows in time order.

    y: in N, or in the unit that the name of a Series says ("force [kN]"), for fit and for score; predictions are in N.
    columns: the columns of X, as in the header of a CSV file ("time", "displacement [mm]", "current [A]", ...);
    "recording" is a number that tells recordings apart, and a last ... (Ellipsis) stands for columns that are not used.
    Default: the names of a DataFrame, else time, displacement, and the current as a third. interval: seconds between
    rows where there is no column of time. A new recording begins where `recording` changes or time does not increase.
    The other parameters are those of hysteron.fit. After fit, `model_` is the Model."""

    def __init__(self, model="bouc-wen", *, columns=None, interval=None, by_current=None, by_frequency=None, effects=(),
                 solver="multistart-lm", budget=20000, seed=1, fix=None, bounds=None, settings=None, threads=0):
        self.model = model
        self.columns = columns
        self.interval = interval
        self.by_current = by_current
        self.by_frequency = by_frequency
        self.effects = effects
        self.solver = solver
        self.budget = budget
        self.seed = seed
        self.fix = fix
        self.bounds = bounds
        self.settings = settings
        self.threads = threads

    def fit(self, X, y):
        newtons = _in_newtons(y)
        X, y = self._checked(X, y)
        self.model_ = fit(
            self._split(X, newtons * y), self.model, by_current=self.by_current, by_frequency=self.by_frequency,
            effects=self.effects, solver=self.solver, budget=self.budget, seed=self.seed, fix=self.fix,
            bounds=self.bounds, settings=self.settings, threads=self.threads)
        return self

    def predict(self, X):
        """Force in N, whatever the unit of y was, a value per row."""
        check_is_fitted(self)
        X = self._checked(X)
        return numpy.concatenate([self.model_.simulate(one) for one in self._split(X)])

    def score(self, X, y, sample_weight=None):
        """R^2 of the prediction; y as in fit."""
        return super().score(X, _in_newtons(y) * numpy.asarray(y), sample_weight)

    def _checked(self, X, *y):
        """X, and y where it is given, as arrays of finite numbers."""
        if numpy.ma.isMaskedArray(X) and X.ndim == 2:
            names = [one for one in self.columns or () if one is not Ellipsis]
            for k in range(X.shape[1]):
                _recordings.refuse_masked(f"X: {names[k] if k < len(names) else f'column {k}'}", X[:, k])
        for forces in y:
            _recordings.refuse_masked("y", forces)
        options = {"dtype": numpy.float64, "reset": bool(y)}
        if y:
            options.update(y_numeric=True, ensure_min_samples=2)
        try:
            from sklearn.utils.validation import validate_data  # from scikit-learn 1.6 on
        except ImportError:
            return self._validate_data(X, *y, **options)
        return validate_data(self, X, *y, **options)

    def _names(self):
        count = self.n_features_in_
        if self.columns is not None:
            names = list(self.columns)
            if names and names[-1] is Ellipsis:
                names = names[:-1]
                if len(names) > count:
                    raise InputError(f"columns: {len(names)} names and {count} columns, expected no more names")
            elif len(names) != count:
                raise InputError(f"columns: {len(names)} names and {count} columns, expected as many; a last ... leaves out the rest")
        elif hasattr(self, "feature_names_in_"):
            names = list(self.feature_names_in_)
        else:
            names = (["time"] if self.interval is None else []) + ["displacement", "current"]
            if count > len(names):
                raise InputError(f"X has {count} columns without names, expected columns=(...) that names them")
            names = names[:count]
        for k, name in enumerate(names):
            if name in names[:k]:
                raise InputError(f"X has two columns named {name!r}, expected different names")
        return names

    def _split(self, X, y=None):
        """Recordings of the rows."""
        data = {name: X[:, k] for k, name in enumerate(self._names())}
        number = data.pop("recording", None)
        rows = len(X)
        if self.interval is not None:
            for name in filter(_hysteron.is_time, map(str, data)):
                raise InputError(f"interval: X has a column {name!r}, expected either the interval or a column of time")
            data["time"] = float(self.interval) * numpy.arange(rows)
        if y is not None:
            data["force"] = y
        begins = numpy.zeros(rows, dtype=bool)
        begins[0] = True
        for name, values in data.items():
            if _hysteron.is_time(str(name)):
                begins[1:] |= numpy.diff(values) <= 0
        if number is not None:
            begins[1:] |= numpy.diff(number) != 0
        edges = [*numpy.flatnonzero(begins), rows]
        result = []
        for k, (first, end) in enumerate(zip(edges, edges[1:])):
            part = {name: values[first:end] for name, values in data.items()}
            result.append(_recordings.recording(part, name=f"recording-{k + 1}.csv", motion_only=y is None))
        return result

    def _more_tags(self):
        return {"poor_score": True, "_xfail_checks": _XFAIL_CHECKS}

    def __sklearn_tags__(self):  # from scikit-learn 1.6 on
        tags = super().__sklearn_tags__()
        tags.regressor_tags.poor_score = True
        return tags
