"""What the module writes is what the program writes, byte for byte, for the command line that a result names."""

import json
import unittest

import hysteron
from support import InFolder, program, repeat, sine

FIT_FILES = ("model.json", "fit.json", "report.html")
STUDY = """schema = "hysteron.study/1"
title = "Two solvers"
models = ["viscous"]
solvers = ["random-search", "pso"]
budgets = [60]
seeds = 2
targets = [1.01, 1.1]

[[data]]
recordings = "data"
label = "dashpot"
"""


class SameBytes(InFolder):
    def fits(self, *data, **arguments):
        model = hysteron.fit(hysteron.load(*data), **arguments)
        model.save_all("module")
        repeat(model.command, "program", self.folder)
        self.assertSameFiles("module", "program", FIT_FILES)
        return model

    def test_fit(self):
        model = self.fits("data", model="bingham", by_current={"fc": 1, "c0": 1}, budget=3000, seed=7)
        self.assertEqual(
            model.command, "hysteron fit data --model bingham --budget 3000 --by-current fc:1,c0:1 --seed 7")

    def test_fit_with_every_option(self):
        self.fits("data/r0.csv", "data/r1.csv", model="bouc-wen", effects=["offset-force"],
                  solver=["random-search", "multistart-lm"], budget=400, seed=2**63, fix={"k0": 0.0},
                  bounds={"c0": (0.0, 1e4)}, normalisation="std", weighting="pooled", tolerance=1e-3, threads=1)

    def test_fit_in_two_stages(self):
        self.fits("data", model="bingham", by_current={"c0": 1, "fc": 1}, budget=600, two_stages=True)

    def test_threads_change_nothing(self):
        recordings = hysteron.load("data")
        one, two = (hysteron.fit(recordings, "bingham", budget=300, threads=threads) for threads in (1, 2))
        one.save_all("one")
        two.save_all("two")
        self.assertSameFiles("one", "two", FIT_FILES)

    def test_fit_of_arrays_is_the_fit_of_their_files(self):
        recordings = []
        for k, current in enumerate((0.0, 1.0)):
            time, displacement, force, drive = sine(1.0 + k, 0.01, current, seed=k)
            recordings.append(hysteron.recording(
                time=time, displacement=1e3 * displacement, force=1e-3 * force, current=drive,
                units={"displacement": "mm", "force": "kN"}, name=f"rig-{k}"))
            recordings[k].save(recordings[k].file)
        model = hysteron.fit(recordings, "bingham", budget=500)
        model.save_all("module")
        repeat(model.command, "program", self.folder)
        self.assertSameFiles("module", "program", FIT_FILES)

    def test_simulate_and_score(self):
        model = hysteron.fit(hysteron.load("data"), "bingham", by_current={"fc": 1}, budget=500)
        model.save("model.json")
        force = model.simulate(hysteron.load("data/r2.csv"), out="module.csv")
        program("simulate", "model.json", "data/r2.csv", "--out", "program.csv", folder=self.folder)
        self.assertEqual((self.folder / "module.csv").read_bytes(), (self.folder / "program.csv").read_bytes())
        self.assertEqual(len(force), 400)
        again = hysteron.load_model("model.json")
        self.assertEqual(list(again.simulate("data/r2.csv")), list(force))
        told = json.loads(program("score", "model.json", "data", "--json", folder=self.folder))
        score = again.score("data")
        self.assertEqual(score.overall, told["overall"]["nrmse"])
        self.assertEqual([row["nrmse"] for row in told["recordings"]], list(score.recordings["nrmse"]))

    def test_diagnose(self):
        diagnosis = hysteron.diagnose("data", "viscous", by_current={"c0": 1}, laws=[], most_effects=1,
                                      effects=["coulomb-friction", "linear-stiffness"])
        diagnosis.save("module")
        repeat(diagnosis.model.command, "program", self.folder)
        self.assertSameFiles("module", "program", ("diagnosis.json", "model.json", "report.html"))
        self.assertIn("coulomb-friction", diagnosis.model.effects)
        self.assertIn(diagnosis.verdict, ("complete", "missing-physics", "ambiguous", "unattributed"))
        self.assertTrue(diagnosis.text.startswith(f"verdict: {diagnosis.verdict}\n{diagnosis.summary[:40]}"))

    def test_bench(self):
        (self.folder / "study.toml").write_text(STUDY)
        seen = []
        study = hysteron.bench("study.toml", out="module", progress=seen.append)
        program("bench", "study.toml", "--out", "program", "--quiet", folder=self.folder)
        program("report", "program", folder=self.folder)
        study.save("report")
        self.assertSameFiles("report", "program", ("runs.csv", "traces.csv", "parameters.csv", "columns.csv",
                                                   "analysis.json", "report.html", "report.md", "tables.tex"))
        self.assertEqual(len(study.runs), 2 * 2)
        self.assertEqual(seen[-1].share, 1.0)
        self.assertEqual(len(hysteron.bench("study.toml").runs), 4)  # without a folder to keep

    def test_catalogue(self):
        for kind in ("models", "solvers", "effects", "datasets", "tables"):
            told = json.loads(program("list", kind, "--json"))
            self.assertEqual([row["id"] for row in told], list(hysteron.list(kind).index))
        for name in ("bouc-wen", "clearance", "pso", "spencer-1997", "rd8040-twin"):
            self.assertEqual(json.loads(program("describe", name, "--json")), hysteron.describe(name))

    def test_dataset(self):
        program("generate", "rd8040-twin", "--only", "2.0Hz_0.5A", "--out", "twin")
        self.assertEqual([one.sha256 for one in hysteron.load("twin")],
                         [one.sha256 for one in hysteron.dataset("rd8040-twin", "2.0Hz_0.5A")])
        self.assertGreater(len(hysteron.dataset("utfsm-mr-damper")), 4)


if __name__ == "__main__":
    unittest.main()
