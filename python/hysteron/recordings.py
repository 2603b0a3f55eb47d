"""Recordings: from files, arrays and DataFrames, in SI units."""

import collections.abc
import os
import typing

import numpy

from . import _hysteron, _table, _words
from ._hysteron import InputError

CHANNELS = ("time", "displacement", "velocity", "acceleration", "force", "current", "voltage", "temperature", "base")
SI_UNITS = ("s", "m", "m/s", "m/s^2", "N", "A", "V", "degC", "m")


class Recording:
    """One test of one damper. Channels are read-only numpy arrays in SI units (temperature in degC) of equal length:
    time, displacement, velocity (recorded, or derived from the displacement), force, and where recorded acceleration,
    current or voltage, temperature, base; None where there is no such channel. `conditions` are what laws may follow
    beside them, by name: values in SI units (one where it does not vary) and their unit. `file` names it in results, `sha256` is of the
    file's bytes."""

    def __init__(self, core, reading_remarks, role="", given=None):
        self._core = core
        self._reading_remarks = reading_remarks  # when it was read; recordings that were read together share it
        self.role = role  # "", "fit" or "validate"
        self._given = given  # names and arrays it was made of, for a file with the same bytes

    file = property(lambda self: self._core.file)
    sha256 = property(lambda self: self._core.sha256)
    velocity_measured = property(lambda self: self._core.velocity_measured)
    time = property(lambda self: self._core.time)
    displacement = property(lambda self: self._core.displacement)
    velocity = property(lambda self: self._core.velocity)
    acceleration = property(lambda self: self._core.acceleration)
    force = property(lambda self: self._core.force)
    current = property(lambda self: self._core.current)
    voltage = property(lambda self: self._core.voltage)
    temperature = property(lambda self: self._core.temperature)
    base = property(lambda self: self._core.base, doc="displacement of what the mass of a response stands on")
    conditions = property(lambda self: self._core.conditions)
    timed = property(lambda self: self._core.timed, doc="whether the time was recorded")

    def __len__(self):
        return len(self._core)

    def __repr__(self):
        seconds = self.time[-1] - self.time[0]
        return f"<hysteron.Recording {self.file}: {len(self)} samples over {seconds:g} s>"

    @property
    def channels(self):
        """The channels there are, by name."""
        there = {name: getattr(self, name) for name in CHANNELS}
        return {name: values for name, values in there.items() if values is not None}

    @property
    def frame(self):
        """The channels and the conditions as a table, a column each."""
        columns = self.channels
        for name, (values, _) in self.conditions.items():
            columns.setdefault(name, numpy.broadcast_to(values, len(self)))
        return _table.of_columns(columns)

    def save(self, path):
        """Writes a CSV file. Of a recording made of arrays it holds those, and a program that reads it works on the same
        numbers under the same sha256; of another one the channels in SI units."""
        if self._given is not None:
            names, arrays = self._given
        else:
            there = {name: unit for name, unit in zip(CHANNELS, SI_UNITS) if getattr(self, name) is not None}
            if not self.velocity_measured:
                there.pop("velocity", None)
            names = [f"{name} [{unit}]" for name, unit in there.items()]
            arrays = [getattr(self, name) for name in there]
            for name, (values, unit) in self.conditions.items():
                if name not in there:
                    names.append(f"{name} [{unit}]" if unit else name)
                    arrays.append(numpy.broadcast_to(values, len(self)))
        _hysteron.write_file(_words.path(path), _hysteron.csv_text(names, arrays))


class Recordings(collections.abc.Sequence):
    """Recordings that belong together. `model`, `by_current`, `by_frequency` and `by` are what campaign.toml says,
    `warnings` what the reader remarked of them and, of recordings that were not read together, what they look like side
    by side."""

    def __init__(self, recordings, model="", by_current=None, by_frequency=None, by=None, warnings=None, paths=None,
                 options=(), at=None):
        self._recordings = tuple(recordings)
        self.model = model
        self.by_current = dict(by_current or {})
        self.by_frequency = dict(by_frequency or {})
        self.by = dict(by or {})
        self.at = dict(at or {})
        self._paths = paths  # of a command line that reads the same; None: the files by name
        self._options = list(options)  # likewise
        remarks = ()
        if warnings is None:
            remarks, warnings = _hysteron.remarks_together([(one._core, one._reading_remarks) for one in self._recordings])
        self.warnings = tuple(warnings)
        self._untold = [text for text, _ in remarks]  # of `warnings`, what was not told when they were read

    def __len__(self):
        return len(self._recordings)

    def __getitem__(self, index):
        if isinstance(index, slice):
            return self._part(self._recordings[index])
        if isinstance(index, str):
            for one in self._recordings:
                if one.file == index:
                    return one
            raise KeyError(index)
        return self._recordings[index]

    def __repr__(self):
        return f"<hysteron.Recordings: {len(self)}, {', '.join(one.file for one in self._recordings[:5])}" + (
            ", ...>" if len(self) > 5 else ">"
        )

    def only(self, text):
        """Those whose file name contains the text."""
        chosen = [one for one in self._recordings if text in one.file]
        if not chosen:
            raise InputError(f"only: no recording's name contains '{text}'")
        return self._part(chosen)

    def _part(self, chosen):
        part = Recordings(chosen, self.model, self.by_current, self.by_frequency, self.by, options=self._options, at=self.at)
        names = tuple(f"{os.path.basename(one.file)}: " for one in self._recordings)
        of_none = [text for text in self.warnings if not text.startswith(names)]  # but of a campaign.toml
        part.warnings = (*of_none, *part.warnings)
        return part

    def tell(self):
        """Warns of what recordings that were not read together look like side by side."""
        _words.warn(self._untold)

    from_paths = property(lambda self: self._paths is not None)

    def command_words(self):
        paths = self._paths if self._paths is not None else [one.file for one in self._recordings]
        words = [*paths, *self._options]
        if "--without-time" not in words and not all(one.timed for one in self._recordings):
            words.append("--without-time")
        return words

    def core(self):
        return [(one._core, one.role) for one in self._recordings]


class Taken(typing.NamedTuple):
    """What is taken of a campaign.toml beside its recordings; a warning names what of it is missed."""

    model: bool = True
    laws: bool = True
    other_laws: tuple = ()  # "current", "frequency" and conditions whose laws are given
    roles: bool = True
    given_later: bool = False  # model and laws, to fit or diagnose


def taken_beside(model, by_current, by_frequency, by):
    """What a fit takes beside what it is given."""
    given = {"current": by_current, "frequency": by_frequency}
    return Taken(model=not model, other_laws=(*(name for name, laws in given.items() if laws), *by))


RECORDINGS_ALONE = Taken(model=False, laws=False, roles=False)


def as_recordings(value, need_force=False, conditions=(), taken=RECORDINGS_ALONE, **read):
    """Of whatever a function is given: recordings, one or several, or paths of them, read with the conditions and what
    else load() takes."""
    if isinstance(value, Recordings):
        result = value
    elif isinstance(value, Recording):
        result = Recordings([value])
    elif isinstance(value, (str, os.PathLike)):
        result = _load([value], taken, conditions=conditions, **read)
    else:
        try:
            items = list(value)
        except TypeError:
            items = [value]
        if items and all(isinstance(one, (str, os.PathLike)) for one in items):
            result = _load(items, taken, conditions=conditions, **read)
        else:
            for one in items:
                if not isinstance(one, Recording):
                    raise InputError(f"{type(one).__name__} is no recording, expected hysteron.load(...) or hysteron.recording(...)")
            result = Recordings(items)
    if len(result) == 0:
        raise InputError("no recordings given, expected at least one")
    seen = set()
    for one in result:
        if one.file in seen:
            raise InputError(f"two recordings are called {one.file}, expected different names")
        seen.add(one.file)
        if need_force and one.force is None:
            raise InputError(f"{one.file}: has no force, expected one to compare with")
    result.tell()
    return result


def as_recording(value, what, **read):
    """One recording, as as_recordings() takes it, with every sample that a file has, and the `at` it was loaded with."""
    if isinstance(value, Recording):
        return value, {}
    recordings = as_recordings(value, keep_samples=0, **read)
    if len(recordings) != 1:
        raise InputError(f"{what}: {len(recordings)} recordings given, expected one")
    return recordings[0], recordings.at


def load(*data, columns=None, group="", skip=0, keep_samples=_hysteron.default_keep_samples, motion_only=False,
         excitation=False, conditions=(), at=None, without_time=False):
    """Reads CSV, MAT, TDMS, MDF 4, RPC III and xlsx files and folders of them, with an optional campaign.toml.

    columns: {"force": "CH1 [kgf]"} maps channels to columns of other names or units; group: of TDMS and MDF files, or
    sheet of workbooks, that is read alone; skip: lines at the head of every CSV file that are not read; keep_samples: of all recordings together, of more several in a row are averaged to one;
    motion_only=True: the force may be missing, for simulation; excitation=True: a force or a motion is enough, for
    Model.respond; conditions: columns that laws are to follow (`by` of fit),
    ["pressure"]; at: {"pressure": "2.1 bar"} of what the laws of a model follow and no column holds, to simulate and
    score; without_time=True: the time may be missing, for laws that do not depend on the rate. Returns Recordings."""
    return _load(data, Taken(given_later=True), columns, group, skip, keep_samples, motion_only, excitation, conditions, at,
                 without_time)


def _load(data, taken, columns=None, group="", skip=0, keep_samples=_hysteron.default_keep_samples, motion_only=False,
          excitation=False, conditions=(), at=None, without_time=False):
    paths = [_words.path(one) for one in data]
    columns = {str(key): str(value) for key, value in (columns or {}).items()}
    skip = _words.whole("skip", skip, 0, 100000)
    keep_samples = _words.whole("keep_samples", keep_samples, 0, 1000000000)
    at = {str(key): str(value) for key, value in (at or {}).items()}
    cores, roles, model, by_current, by_frequency, by, remarks, reading_remarks = _hysteron.load(
        paths, columns, group, skip, keep_samples, required(motion_only, excitation),
        [*_words.names("conditions", conditions), *at], at, bool(without_time), taken)
    _words.warn(text for text, _ in remarks)
    command = _words.Command()
    for channel in sorted(columns):
        command.add("--column", f"{channel}={columns[channel]}")
    command.add("--group", group, "")
    command.add("--skip", skip, 0)
    command.add("--keep-samples", keep_samples, _hysteron.default_keep_samples)
    if without_time:
        command.words.append("--without-time")
    return Recordings(
        (Recording(core, reading_remarks, role) for core, role in zip(cores, roles)),
        model, by_current, by_frequency, by, [warning for _, warning in remarks], paths, command.words, at,
    )


def required(motion_only, excitation):
    """What a recording has to hold beside the time."""
    return "excitation" if excitation else "motion" if motion_only else "force"


def refuse_masked(what, values):
    """What a mask hides would be read as if it had been measured."""
    masked = numpy.ma.count_masked(values) if isinstance(values, numpy.ma.MaskedArray) else 0
    if masked:
        raise InputError(f"{what} has {masked} masked value{'s' if masked > 1 else ''} of {values.size}, expected none: "
                         "those samples removed from all columns, or the values filled")


def refuse_name(what, header):
    if any(sign in header for sign in ",;\"\t\r\n") or header.startswith("#"):
        raise InputError(f"{what}: the column name {header!r} cannot stand in a CSV file, expected no commas, quotes or line ends")


def recording(data=None, *, name="recording.csv", units=None, columns=None, role="",
              keep_samples=_hysteron.default_keep_samples, motion_only=False, excitation=False, conditions=(),
              without_time=False, **channels):
    """A recording of arrays: what the CSV file that holds them would be read as.

    Either channels by keyword (time=, displacement=, force=, and velocity=, acceleration=, current=, voltage=,
    temperature=, base=), or `data`, a DataFrame or dictionary with columns named as in a file ("time", "disp [mm]", ...).
    units: {"displacement": "mm"} by the name of the column, SI without; columns: as in load; name: in results; role: ""
    or "fit" or "validate"; motion_only, excitation, conditions, without_time: as in load."""
    if (data is None) == (not channels):
        raise InputError("recording: expected either data or channels by keyword, e.g. time=..., displacement=..., force=...")
    if data is None:
        for key in channels:
            if key not in CHANNELS:
                raise InputError(f"recording: unknown channel '{key}', expected one of {', '.join(CHANNELS)}")
        data = {key: values for key, values in channels.items() if values is not None}
    file = str(name) if str(name).endswith(".csv") else f"{name}.csv"
    if role not in ("", "fit", "validate"):
        raise InputError(f"{file}: role {role!r} is not known, expected 'fit' or 'validate'")
    units = dict(units or {})
    headers, arrays = [], []
    for key in data.keys():
        values = numpy.asarray(data[key])
        header = str(key)
        if values.dtype.kind not in "biuf":
            if header in CHANNELS or header in units:
                raise InputError(f"{file}: {header} holds no numbers, expected an array of numbers")
            continue  # as a column of words in a file
        refuse_masked(f"{file}: {header}", data[key])
        if values.ndim != 1:
            raise InputError(f"{file}: {header} has {values.ndim} dimensions, expected one")
        refuse_name(file, header)
        if arrays and len(values) != len(arrays[0]):
            raise InputError(f"{file}: {header} has {len(values)} values and {headers[0]} has {len(arrays[0])}, expected the same number")
        finite = numpy.isfinite(values)
        if not finite.all():
            at = int(numpy.argmin(finite))
            raise InputError(f"{file}: value {at} of {header} is {values[at]}, expected a finite number")
        unit = units.pop(key, None)
        headers.append(f"{header} [{unit}]" if unit else header)
        arrays.append(numpy.array(values, dtype=float))
    if units:
        raise InputError(f"{file}: a unit is given for '{next(iter(units))}', which is no column; the columns are {', '.join(headers)}")
    if not arrays:
        raise InputError(f"{file}: no columns of numbers, expected at least time, displacement and force")
    columns = {str(key): str(value) for key, value in (columns or {}).items()}
    core, remarks, reading_remarks = _hysteron.recording(headers, arrays, file, columns, _words.whole("keep_samples", keep_samples, 0, 1000000000),
        required(motion_only, excitation),
        _words.names("conditions", conditions), bool(without_time))
    _words.warn(text for text, _ in remarks)
    return Recording(core, reading_remarks, role, (headers, arrays))


def dataset(name, only="", seed=1):
    """A dataset that ships, see list("datasets"): what `hysteron generate NAME --only TEXT` writes, as Recordings."""
    cores, roles, model, by_current, by_frequency, by, _, reading_remarks = _hysteron.dataset(
        name, only, _words.whole("seed", seed, 0, 2**64 - 1))
    return Recordings((Recording(core, reading_remarks, role) for core, role in zip(cores, roles)), model, by_current, by_frequency, by)
