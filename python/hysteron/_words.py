"""Values of arguments: what they must be, and how the command line writes them."""

import collections.abc
import math
import os
import typing
import warnings

from . import _hysteron
from ._hysteron import InputError


class HysteronWarning(UserWarning):
    """What the program says after `warning:`."""


class Progress(typing.NamedTuple):
    """How far a piece of work is; what does not apply to it is None."""

    stage: str
    share: float  # of the stage for a fit, of the whole for a diagnosis and a study
    evaluations: typing.Optional[int]
    budget: typing.Optional[int]
    nrmse: typing.Optional[float]  # best so far


def observer(progress):
    """What the compiled part calls, of a callable that takes a Progress."""
    if progress is None:
        return None
    if not callable(progress):
        raise InputError("progress: not callable, expected a function of one Progress, or None")
    return lambda *values: progress(Progress(*values))


def hypothesis(model, by_current, by_frequency, by, effects):
    """What is fitted: the law, what its parameters follow, and the effects. `by` has gone through laws() before."""
    return {
        "model": "" if model is None else str(model),
        "by_current": orders("by_current", by_current),
        "by_frequency": orders("by_frequency", by_frequency),
        "by": by,
        "effects": names("effects", effects),
    }


def warn(texts):
    for text in texts:
        warnings.warn(text, HysteronWarning, stacklevel=3)


def whole(name, value, low, high):
    """A whole number from low to high."""
    try:
        number = int(value)
        exact = number == value and not isinstance(value, (bool, str))
    except (TypeError, ValueError, OverflowError):
        exact = False
    if not exact or not low <= number <= high:
        raise InputError(f"{name}: {value!r} is wrong, expected a whole number from {low} to {high}")
    return number


def real(name, value, low=-math.inf, high=math.inf):
    """A finite number from low to high."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number) or not low <= number <= high:
        within = f" from {low:g} to {high:g}" if math.isfinite(low) else ""
        raise InputError(f"{name}: {value!r} is wrong, expected a finite number{within}")
    return number


def names(name, value):
    """A list of names, of one name or several."""
    if value is None:
        return []
    words = [value] if isinstance(value, str) else list(value)
    for word in words:
        if not isinstance(word, str) or not word:
            raise InputError(f"{name}: {word!r} is wrong, expected a name")
    return words


def table(name, value, check):
    """A dictionary of names, each value checked."""
    if value is None:
        return {}
    if not isinstance(value, collections.abc.Mapping):
        raise InputError(f"{name}: {value!r} is wrong, expected a dictionary by name")
    return {str(key): check(f"{name} of {key}", of) for key, of in value.items()}


def orders(name, value):
    """Orders of parameter laws, {"alpha": 1}; None leaves them to the campaign."""
    if value is None:
        return None
    return table(name, value, lambda of, order: whole(of, order, 0, _hysteron.highest_order))


def laws(value):
    """Orders of parameter laws by what they follow, {"pressure": {"alpha": 1}}."""
    result = {}
    for key, of in table("by", value, lambda _, given: given).items():
        name = _hysteron.condition_name(key, "by")
        if name in ("current", "frequency"):
            raise InputError(f"by: {name} has an argument of its own, expected by_{name}")
        if name in result:
            raise InputError(f"by: laws in the {name} are given twice, expected them together")
        result[name] = orders(f"by {name}", of) or {}
        if not result[name]:
            raise InputError(f"by: {name} names no parameter, expected for example {{{name!r}: {{'c0': 1}}}}")
    return result


def interval(name, value):
    try:
        lower, upper = value
    except (TypeError, ValueError):
        raise InputError(f"{name}: {value!r} is wrong, expected (lower, upper)") from None
    lower, upper = real(name, lower), real(name, upper)
    if not lower < upper:
        raise InputError(f"{name}: ({lower:g}, {upper:g}) is empty, expected lower below upper")
    return lower, upper


def common(normalisation, weighting, tolerance, threads):
    """Arguments of every function that compares forces."""
    return {
        "normalisation": normalisation,
        "weighting": weighting,
        "tolerance": real("tolerance", tolerance, 1e-10, 1e-2),
        "threads": whole("threads", threads, 0, 1024),
    }


def path(value):
    return os.fspath(value)


def optional(name, value, low, high):
    """As real(), or None."""
    return None if value is None else real(name, value, low, high)


class Command:
    """The command line that does the same; what is at its default is left out, as one who types it would."""

    def __init__(self, *words):
        self.words = list(words)

    def add(self, option, value, default=None):
        if value != default:
            self.words += [option, value if isinstance(value, str) else number_text(value)]

    def add_list(self, option, values):
        if values:
            self.words += [option, ",".join(values)]

    def add_table(self, option, values, write):
        self.add_list(option, [write(key, value) for key, value in (values or {}).items()])

    def add_laws(self, by_current, by_frequency, by):
        self.add_table("--by-current", by_current, lambda key, order: f"{key}:{order}")
        self.add_table("--by-frequency", by_frequency, lambda key, order: f"{key}:{order}")
        for name, of in by.items():
            self.words += ["--by", name + "=" + ",".join(f"{key}:{order}" for key, order in of.items())]

    def add_common(self, seed, options):
        self.add("--seed", seed, 1)
        self.add("--normalisation", options["normalisation"], "max-abs")
        self.add("--weighting", options["weighting"], "per-recording")
        self.add("--tolerance", options["tolerance"], 1e-4)

    def text(self):
        return _hysteron.command_text(self.words)


def number_text(value):
    return repr(value)
