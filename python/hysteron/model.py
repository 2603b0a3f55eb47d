"""Identification, and models that have been identified."""

import json
import os
import typing

import numpy

from . import _hysteron, _table, _words
from ._hysteron import InputError
from .recordings import as_recording, as_recordings, taken_beside


class Score(typing.NamedTuple):
    """Errors of a model on recordings."""

    overall: float  # NRMSE
    recordings: object  # table by file: nrmse, rmse_n, fit_percent


class Model:
    """A damper law with effects and parameter values. `json` is its model.json as a dictionary; `fit_json` and
    `warnings` are of the fit that made it, None and () where it was read from a file."""

    def __init__(self, text, path=None, files=None, warnings=()):
        self._text = bytes(text)
        self._file = path  # None: of no file
        self._stored = _hysteron.parse_model(self._text, self._called)
        self._files = files
        self.json = json.loads(self._text)
        self.fit_json = json.loads(files["fit.json"]) if files and "fit.json" in files else None
        self.warnings = tuple(warnings)

    def __reduce__(self):
        return Model, (self._text, self._file, self._files, self.warnings)

    _path = property(lambda self: self._file or "model.json", doc="for a command line")
    _called = property(lambda self: self._file or "the model", doc="in messages")

    def __repr__(self):
        parts = " with ".join([self.name, ", ".join(self.effects)]) if self.effects else self.name
        return f"<hysteron.Model {parts}, NRMSE {self.nrmse:.4g}>"

    name = property(lambda self: self.json["model"])
    effects = property(lambda self: tuple(self.json.get("effects", ())))
    nrmse = property(lambda self: self.json["nrmse"]["fit"], doc="over the recordings fitted")
    nrmse_heldout = property(lambda self: self.json["nrmse"]["heldout"], doc="None where nothing was held out")
    command = property(lambda self: self.json["provenance"]["command"], doc="the command line that makes it again")

    @property
    def parameters(self):
        """Terms by name: value and standard error (NaN where the data do not determine it) in `unit`, the bound met,
        whether the data determine it, whether it was held."""
        rows = []
        for one in self.json["parameters"]:
            error = one.get("std_error")
            rows.append({
                "name": one["name"], "value": one["value"], "std_error": numpy.nan if error is None else error,
                "unit": one["unit"], "at_bound": one.get("at_bound"),
                "identifiable": one.get("identifiable", True), "fixed": one.get("fixed", False),
            })
        return _table.of_rows(rows, "name")

    @property
    def convergence(self):
        """Of every solver compared, by id: an array of two columns, evaluations and best NRMSE."""
        if self.fit_json is None:
            return {}
        return {one["id"]: numpy.array(one["trace"], dtype=float).reshape(-1, 2) for one in self.fit_json["solvers"]}

    def simulate(self, recording, out=None, tolerance=1e-4):
        """Force in N on the motion of a recording, an array with a value per sample; `out`: a file for it, CSV, or MAT by
        its ending."""
        recording = self._one(recording, "simulate", motion_only=True)
        force, remarks = _hysteron.simulate(
            self._stored, self._called, recording._core, _words.real("tolerance", tolerance, 1e-10, 1e-2))
        _words.warn(remarks)
        if out is not None:
            write_force(out, recording, force)
        return force

    def score(self, recordings, out=None, normalisation="max-abs", weighting="per-recording", tolerance=1e-4):
        """Errors on recordings that the model need not have seen; `out`: a file for the table, CSV, or MAT by its
        ending."""
        options = _words.common(normalisation, weighting, tolerance, 0)
        recordings = as_recordings(recordings, need_force=True, conditions=self.json.get("by", ()))
        _hysteron.refuse_unfollowed([self._stored], recordings.at)
        text, csv, remarks = _hysteron.score(self._stored, self._called, recordings.core(), options)
        _words.warn(remarks)
        if out is not None:
            write_table(out, csv.encode())
        result = json.loads(text)
        return Score(result["overall"]["nrmse"], _table.of_rows(result["recordings"], "file"))

    def respond(self, recording, mass, *, stiffness=0.0, damping=0.0, excitation="auto", interpolation="cubic", periods=0,
                x0=0.0, v0=0.0, drive=None, frequency=None, tolerance=1e-8, out=None):
        """Motion of a mass (kg) on the model under the force of a recording, or on a base that has its displacement.

        recording: a file, or of load(..., excitation=True) or recording(..., excitation=True); stiffness (N/m), damping
        (N s/m): of a spring and a dashpot beside the model; excitation: "force" or "base" where it holds both;
        interpolation: of it between samples, "linear", "cubic", "band-limited"; periods: it is one period, repeated so
        many times, of which the last is answered; x0, v0: displacement and velocity at the start, relative to the base;
        drive: a constant current or voltage in place of the recording's; frequency: in Hz, for parameters that follow it,
        default the dominant one; tolerance: relative error of a step; out: a file for the table, CSV, or MAT by its
        ending. Returns a Response. Ctrl-C ends it."""
        limit = _hysteron.farthest_motion
        options = {
            "mass": _words.real("mass", mass, 1e-9, 1e12),
            "stiffness": _words.real("stiffness", stiffness, -1e15, 1e15),
            "damping": _words.real("damping", damping, -1e15, 1e15),
            "excitation": excitation,
            "interpolation": interpolation,
            "periods": _words.whole("periods", periods, 0, 10000),
            "x0": _words.real("x0", x0, -limit, limit),
            "v0": _words.real("v0", v0, -1e9, 1e9),
            "drive": _words.optional("drive", drive, -1e9, 1e9),
            "frequency": _words.optional("frequency", frequency, 0.0, 1e9),
            "tolerance": _words.real("tolerance", tolerance, 1e-13, 1e-2),
        }
        recording = self._one(recording, "respond", excitation=True)
        names, columns, csv, remarks = _hysteron.respond(self._stored, self._called, recording._core, options)
        _words.warn(remarks)
        response = Response(names, columns, csv)
        if out is not None:
            response.save(out)
        return response

    def export(self, to, out=None, *, name="", motion=None, at=None, tolerance=1e-4,
               most_substeps=_hysteron.default_most_substeps, substeps=0):
        """Writes the model for use elsewhere, with a test vector; see docs/export.md.

        to: "c", "fmu", "simulink", "modelica" or "python"; out: a folder, or the main file by its ending, default: nothing
        is written; name: identifier in the code, default that of the file or the law; motion: a recording that the test
        vector replays; at: {"pressure": "2.1 bar"} of conditions that parameters follow; tolerance: of the integration;
        most_substeps, substeps: its steps between two samples, at most or always. Returns an Export."""
        options = {
            "to": str(to),
            "out": None if out is None else _words.path(out),
            "name": str(name),
            "tolerance": _words.real("tolerance", tolerance, 1e-10, 1e-2),
            "most_substeps": _words.whole("most_substeps", most_substeps, 1, _hysteron.default_most_substeps),
            "substeps": _words.whole("substeps", substeps, 0, _hysteron.default_most_substeps),
        }
        if motion is not None:
            motion = as_recording(motion, "motion", motion_only=True)[0]._core
        at = {str(key): str(value) for key, value in (at or {}).items()}
        *result, remarks = _hysteron.export_to(self._stored, self._called, at, motion, options)
        _words.warn(remarks)
        return Export(*result)

    def _one(self, recording, what, **read):
        recording, at = as_recording(recording, what, conditions=self.json.get("by", ()), **read)
        _hysteron.refuse_unfollowed([self._stored], at)
        return recording

    def save(self, path):
        """Writes model.json, the bytes that the program writes; messages name the model by this file from then on."""
        _hysteron.write_file(_words.path(path), self._text)
        self._file = _words.path(path)

    def save_all(self, folder):
        """Writes model.json and, of a fit, fit.json and report.html into a folder, as `hysteron fit --out` does."""
        save_files(self._files or {"model.json": self._text}, folder)

    def plot_loops(self, recordings, **arguments):
        """See hysteron.plot.loops."""
        from . import plot

        return plot.loops(recordings, self, **arguments)


class Response:
    """Motion of a mass: time, displacement, velocity and acceleration relative to the base, `damper_force` of the model,
    where there are such `force` on the mass, `current` or `voltage`, `base` and `absolute_displacement` (else None):
    arrays in SI units."""

    def __init__(self, names, columns, csv):
        self._csv = csv
        self.channels = {name.split(" [")[0].replace(" ", "_"): column for name, column in zip(names, columns)}

    def __getattr__(self, name):
        if name in ("time", "displacement", "velocity", "acceleration", "force", "damper_force", "current", "voltage",
                    "base", "absolute_displacement"):
            return self.channels.get(name)
        raise AttributeError(f"'Response' object has no attribute '{name}'")

    def __getstate__(self):
        return self.__dict__

    def __setstate__(self, state):
        self.__dict__.update(state)

    def __len__(self):
        return len(self.channels["time"])

    def __repr__(self):
        largest = numpy.abs(self.channels["displacement"]).max()
        return f"<hysteron.Response: {len(self)} samples, largest displacement {1e3 * largest:.4g} mm>"

    @property
    def frame(self):
        """The channels as a table, a column each."""
        return _table.of_columns(self.channels)

    def save(self, path):
        """Writes the table that `hysteron respond` writes, CSV, or MAT by its ending."""
        write_table(path, self._csv)


class Export(typing.NamedTuple):
    """An exported model."""

    files: dict  # contents, bytes, by path below the folder
    paths: list  # of the files that were written, empty without `out`
    note: str  # how to use it


def write_table(out, csv):
    out = _words.path(out)
    _hysteron.check_table(out, [])
    _hysteron.write_file(out, _hysteron.table_bytes(out, csv))


def write_force(out, recording, force):
    write_table(out, _hysteron.csv_text(["time [s]", "force [N]"], [recording.time, force]))


def simulate_preset(preset, recording, *, drive=None, quantities=None, tolerance=1e-4, out=None):
    """Force in N of a published parameter set on the motion of a recording.

    preset: see describe("bouc-wen"); drive: a constant current or voltage in place of the recording's; quantities:
    {"alpha_a": 14649} by the names and in the units of the source, see describe(preset); out: a file for the force, CSV,
    or MAT by its ending."""
    recording, at = as_recording(recording, "simulate_preset", motion_only=True)
    if at:
        raise InputError(f"simulate_preset: recordings were loaded with at={at!r}, which belongs to a model.json")
    force, remarks = _hysteron.simulate_preset(
        str(preset), _words.table("quantities", quantities, _words.real),
        _words.optional("drive", drive, -1e9, 1e9), recording._core, _words.real("tolerance", tolerance, 1e-10, 1e-2))
    _words.warn(remarks)
    if out is not None:
        write_force(out, recording, force)
    return force


def save_files(files, folder):
    folder = _words.path(folder)
    _hysteron.make_folder(folder)
    for name, content in files.items():
        _hysteron.write_file(os.path.join(folder, name), content)


def load_model(path):
    """Reads a model.json of `hysteron fit` or `hysteron diagnose`."""
    path = _words.path(path)
    inside = os.path.join(path, "model.json")
    if os.path.isfile(inside):
        raise InputError(f"{path}: is a folder, expected the file in it: {inside}")
    try:
        with open(path, "rb") as file:
            text = file.read()
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}), expected a model.json written by hysteron") from None
    return Model(text, path)


def fit(recordings, model=None, *, by_current=None, by_frequency=None, by=None, effects=(), solver="multistart-lm",
        budget=20000, seed=1, fix=None, bounds=None, settings=None, two_stages=False, response=None,
        normalisation="max-abs", weighting="per-recording", tolerance=1e-4, threads=0, progress=None):
    """Identifies one parameter set over all recordings.

    model: a damper law, see list("models"), default the campaign's; by_current, by_frequency: parameters that are
    polynomials, {"alpha": 1}; by: likewise in conditions of the recordings, {"pressure": {"alpha": 1}}; effects: put behind the law; solver: one name or several to compare; budget: evaluations
    each may use; fix: {"k0": 0.0} held, bounds: {"c0": (0, 5000)}, in SI units; settings: of the solver; two_stages:
    also the laws through values of conditions fitted freely; response: {"mass": 250, "stiffness": 2e4, "damping": 0,
    "interpolation": "cubic", "excitation": "auto"}, the recordings are of a mass on the damper; threads: 0 takes OMP_NUM_THREADS or all cores;
    progress: a function that is called with a Progress now and then. Ctrl-C, or an exception of `progress`, ends it."""
    by = _words.laws(by)
    # As the program reads them: of a mass the force may be what excites it, or missing.
    recordings = as_recordings(recordings, need_force=response is None, conditions=by,
                               taken=taken_beside(model, by_current, by_frequency, by), motion_only=response is not None)
    refuse_numbers(recordings, "fit")
    if response is not None:
        defaults = {"stiffness": 0.0, "damping": 0.0, "interpolation": "cubic", "excitation": "auto"}
        unknown = set(response) - {"mass", *defaults}
        response = {**defaults, **response}
        if unknown or "mass" not in response:
            raise InputError("response: expected mass, and stiffness, damping, interpolation, excitation where they are not 0, 0, 'cubic', 'auto'")
        response["mass"] = _words.real("mass", response["mass"], 1e-9, 1e12)
        for key in ("stiffness", "damping"):
            response[key] = _words.real(key, response[key], -1e15, 1e15)
    solvers = _words.names("solver", solver) or ["multistart-lm"]
    options = {
        **_words.hypothesis(model, by_current, by_frequency, by, effects),
        "solver": solvers,
        "budget": _words.whole("budget", budget, 1, 1000000000),
        "seed": _words.whole("seed", seed, 0, 2**64 - 1),
        "fix": _words.table("fix", fix, _words.real),
        "bounds": _words.table("bounds", bounds, _words.interval),
        "settings": _words.table("settings", settings, _words.real),
        "two_stages": bool(two_stages),
        "response": response,
        **_words.common(normalisation, weighting, tolerance, threads),
    }
    typed = as_typed(recordings, options)
    command = _words.Command("fit", *recordings.command_words())
    command.add("--model", typed["model"], "")
    command.add_list("--effects", options["effects"])
    command.add("--solver", ",".join(solvers), "multistart-lm")
    command.add("--budget", options["budget"], 20000)
    command.add_laws(typed["by_current"], typed["by_frequency"], typed["by"])
    command.add("--stages", "two" if two_stages else "one", "one")
    command.add_table("--fix", options["fix"], lambda key, value: f"{key}={value!r}")
    command.add_table("--bounds", options["bounds"], lambda key, value: f"{key}={value[0]!r}:{value[1]!r}")
    command.add_table("--set", options["settings"], lambda key, value: f"{key}={value!r}")
    if response is not None:
        command.words.append("--response")
        command.add("--mass", response["mass"])
        command.add("--stiffness", response["stiffness"], 0.0)
        command.add("--damping", response["damping"], 0.0)
        command.add("--excitation", response["excitation"], "auto")
        command.add("--interpolation", response["interpolation"], "cubic")
    command.add_common(options["seed"], options)
    warnings = recordings.warnings
    result = _hysteron.fit(
        recordings.core(), recordings.model, with_campaign(recordings, options), warnings, command.text(), _words.observer(progress))
    _words.warn(result["warnings"][len(warnings):])
    files = result["files"]
    return Model(files["model.json"], None, files, result["warnings"])


def with_campaign(recordings, options):
    """Model and laws that are not given are the campaign's."""
    return {
        **options,
        "model": options["model"] or recordings.model,
        "by_current": options["by_current"] or recordings.by_current,
        "by_frequency": options["by_frequency"] or recordings.by_frequency,
        "by": {**recordings.by, **options["by"]},
    }


def refuse_numbers(recordings, what):
    """Numbers of load(..., at=...), which no command line can say to a fit or a diagnosis."""
    if recordings.at:
        raise InputError(f"{what}: recordings were loaded with at={recordings.at!r}, which is for simulate and score; "
                         "expected a number of each recording in campaign.toml")


def as_typed(recordings, options):
    """What a command line has to say: not what campaign.toml says to it."""
    return options if recordings.from_paths else with_campaign(recordings, options)
