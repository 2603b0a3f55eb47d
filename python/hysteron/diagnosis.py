"""Diagnosis: what physics a model leaves out."""

import json

from . import _hysteron, _table, _words
from .model import Model, as_typed, refuse_numbers, save_files, with_campaign
from .recordings import as_recordings, taken_beside


class Diagnosis:
    """A verdict with its evidence. `json` is diagnosis.json as a dictionary, `model` the augmented Model, `text` what
    the program prints."""

    def __init__(self, files, text):
        self._files = files
        self.text = text
        self.json = json.loads(files["diagnosis.json"])
        self.model = Model(files["model.json"])

    def __repr__(self):
        named = self.json["effects"]
        return f"<hysteron.Diagnosis {self.verdict}{': ' if named else ''}{', '.join(one['id'] for one in named)}>"

    verdict = property(lambda self: self.json["verdict"], doc="complete, missing-physics, ambiguous or unattributed")
    summary = property(lambda self: " ".join(self.json["summary"]), doc="the paragraph that opens the report")

    @property
    def effects(self):
        """What is named, by id: grade, confidence, family, held-out NRMSE before and after, sentence."""
        return self._named("effects")

    @property
    def suggestions(self):
        """What is not sure enough to be named, likewise."""
        return self._named("suggestions")

    def _named(self, which):
        keys = ("id", "grade", "confidence", "family", "nrmse_heldout_before", "nrmse_heldout_after", "sentence")
        rows = [{key: one.get(key) for key in keys} for one in self.json[which]]
        return _table.of_rows(rows, "id")

    def save(self, folder):
        """Writes diagnosis.json, model.json and report.html, the bytes that the program writes."""
        save_files(self._files, folder)


def diagnose(recordings, model=None, *, by_current=None, by_frequency=None, by=None, effects=(), laws=None, most_effects=5,
             seed=1, normalisation="max-abs", weighting="per-recording", tolerance=1e-4, threads=0, progress=None):
    """Finds where recordings and simulation differ, names what physics is left out, models it and refits.

    model: base damper law, default the campaign's, else bouc-wen; effects: those to consider, default all; laws: damper
    laws that the base law is set against, [] takes it for right, default those that list themselves; most_effects: that
    the augmented model may have. The rest as in fit. Ctrl-C ends it; nothing is kept of an unfinished diagnosis."""
    by = _words.laws(by)
    recordings = as_recordings(recordings, need_force=True, conditions=by,
                               taken=taken_beside(model, by_current, by_frequency, by))
    refuse_numbers(recordings, "diagnose")
    options = {
        **_words.hypothesis(model, by_current, by_frequency, by, effects),
        "laws": None if laws is None else _words.names("laws", laws),
        "most_effects": _words.whole("most_effects", most_effects, 1, 7),
        "seed": _words.whole("seed", seed, 0, 2**64 - 1),
        **_words.common(normalisation, weighting, tolerance, threads),
    }
    typed = as_typed(recordings, options)
    command = _words.Command("diagnose", *recordings.command_words())
    command.add("--model", typed["model"], "")
    command.add_laws(typed["by_current"], typed["by_frequency"], typed["by"])
    command.add_list("--effects", options["effects"])
    command.add_list("--laws", ["none"] if options["laws"] == [] else options["laws"])
    command.add("--most-effects", options["most_effects"], 5)
    command.add_common(options["seed"], options)
    result = _hysteron.diagnose(
        recordings.core(), recordings.model, with_campaign(recordings, options), recordings.warnings, command.text(),
        _words.observer(progress))
    return Diagnosis(result["files"], result["text"])
