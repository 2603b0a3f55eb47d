"""What is done with a model, by the module and by the program: the same bytes, the same complaints."""

import pathlib
import pickle
import unittest
import warnings

import hysteron
import numpy
from support import InFolder, complaint, program


class Use(InFolder):
    def setUp(self):
        super().setUp()
        self.model = hysteron.fit("data", "bingham", by_current={"fc": 1, "c0": 1}, budget=500)
        self.model.save("model.json")
        time = numpy.arange(0, 2, 1 / 256)
        force = 300 * numpy.sin(2 * numpy.pi * 2 * time) + 40 * numpy.sin(2 * numpy.pi * 5 * time)
        self.load = hysteron.recording(time=time, force=force, current=0.5 + 0 * time, excitation=True, name="load")
        self.load.save("load.csv")
        self.road = hysteron.recording(time=time, base=1e-5 * force, current=0.5 + 0 * time, excitation=True, name="road")
        self.road.save("road.csv")
        warnings.simplefilter("ignore", hysteron.HysteronWarning)

    def same(self, one, other):
        first, second = pathlib.Path(one).read_bytes(), pathlib.Path(other).read_bytes()
        self.assertGreater(len(first), 0)
        self.assertEqual(first, second, f"{one} and {other} differ")

    def test_respond(self):
        for excitation, options, words in (
                (self.load, {"stiffness": 2e4, "x0": 0.001}, ["--stiffness", 2e4, "--x0", 0.001]),
                (self.load, {"periods": 3, "drive": 0.25, "interpolation": "band-limited"},
                 ["--periods", 3, "--drive", 0.25, "--interpolation", "band-limited"]),
                (self.road, {"stiffness": 3e4, "damping": 20.0, "v0": 0.01, "tolerance": 1e-6},
                 ["--stiffness", 3e4, "--damping", 20, "--v0", 0.01, "--tolerance", 1e-6])):
            for ending in ("csv", "mat"):
                response = self.model.respond(excitation, 250, **options, out=f"module.{ending}")
                program("respond", "model.json", excitation.file, "--mass", 250, *words, "--out", f"program.{ending}")
                self.same(f"module.{ending}", f"program.{ending}")
        self.assertEqual(len(response), 512)
        numpy.testing.assert_array_equal(response.absolute_displacement, response.base + response.displacement)
        self.assertIsNone(response.voltage)
        self.assertEqual(list(response.frame.columns), list(response.channels))
        numpy.testing.assert_array_equal(pickle.loads(pickle.dumps(response)).damper_force, response.damper_force)
        self.assertIsNone(response.force)
        of_file = hysteron.load_model("model.json").respond("road.csv", mass=250, stiffness=3e4, damping=20.0, v0=0.01,
                                                            tolerance=1e-6)
        numpy.testing.assert_array_equal(of_file.displacement, response.displacement)

    def test_export(self):
        for target, out in (("c", "e/{}"), ("fmu", "{}.fmu"), ("simulink", "e/{}"), ("modelica", "e/{}"),
                            ("python", "{}.py"), ("c", "e/{}/damper.c")):
            here, there = pathlib.Path("m", out.format("one")), pathlib.Path("p", out.format("one"))
            result = self.model.export(target, here, motion="data/r1.csv")
            told = program("export", "model.json", "--to", target, "--out", there, "--motion", "data/r1.csv").splitlines()
            self.assertEqual([str(pathlib.Path("p", pathlib.Path(path).relative_to("m"))) for path in result.paths],
                             told[:len(result.paths)])
            self.assertEqual(result.note.splitlines(), told[len(result.paths):])
            for path in result.paths:
                self.same(path, pathlib.Path("p", pathlib.Path(path).relative_to("m")))
        names = self.model.export("c", name="damper", substeps=20).files
        self.assertEqual(sorted(names), ["damper.c", "damper.h", "damper_test.c"])
        module = {}
        exec(self.model.export("python", name="damper").files["damper.py"].decode(), module)
        self.assertTrue(any(hasattr(value, "step") for value in module.values()))

    def test_compare(self):
        other = hysteron.fit("data", "viscous", budget=300)
        pathlib.Path("b").mkdir()
        other.save("b/model.json")
        comparison = hysteron.compare([self.model, "b/model.json"], "data", out="module", mat=True)
        told = program("compare", "model.json", "b/model.json", "data", "--mat", "--out", "program")
        self.assertSameFiles("module", "program", ("compare.json", "models.csv", "recordings.csv", "report.html", "tables.mat"))
        self.assertEqual(comparison.text + "report: program/report.html\n", told)
        self.assertEqual(comparison.command, "hysteron compare model.json b/model.json data --mat")
        self.assertLess(comparison.models["nrmse_overall"][0], comparison.models["nrmse_overall"][1])
        self.assertEqual(len(comparison.recordings), 2 * 4)
        comparison.save("without")
        self.assertFalse(pathlib.Path("without/tables.mat").exists())

    def test_simulate_and_score_to_files(self):
        for ending in ("csv", "mat"):
            self.model.simulate("data/r2.csv", out=f"module.{ending}")
            program("simulate", "model.json", "data/r2.csv", "--out", f"program.{ending}")
            self.same(f"module.{ending}", f"program.{ending}")
            self.model.score("data", out=f"module.{ending}")
            program("score", "model.json", "data", "--out", f"program.{ending}")
            self.same(f"module.{ending}", f"program.{ending}")

    def test_simulate_without_a_force(self):
        time = numpy.arange(0, 1, 0.005)
        hysteron.recording(time=time, displacement=0.01 * numpy.sin(9 * time), motion_only=True).save("motion.csv")
        self.model.simulate("motion.csv", out="module.csv")
        program("simulate", "model.json", "motion.csv", "--out", "program.csv")
        self.same("module.csv", "program.csv")

    def test_simulate_preset(self):
        hysteron.simulate_preset("spencer-1997", "data/r1.csv", out="module.csv", drive=1.5)
        program("simulate", "--preset", "spencer-1997", "--drive", 1.5, "data/r1.csv", "--out", "program.csv")
        self.same("module.csv", "program.csv")
        name = hysteron.describe("spencer-1997")["quantities"][0]["name"]
        force = hysteron.simulate_preset("spencer-1997", "data/r1.csv", drive=1.5, quantities={name: 2.0})
        program("simulate", "--preset", "spencer-1997", "--drive", 1.5, "--set", f"{name}=2", "data/r1.csv", "--out", "set.csv")
        numpy.testing.assert_array_equal(numpy.loadtxt("set.csv", delimiter=",", skiprows=1)[:, 1], force)

    def test_complaints_are_those_of_the_program(self):
        cases = (
            (lambda: self.model.respond("data/r0.csv", 250), ["respond", "model.json", "data/r0.csv", "--mass", 250]),
            (lambda: self.model.respond("load.csv", 250, excitation="base"),
             ["respond", "model.json", "load.csv", "--mass", 250, "--excitation", "base"]),
            (lambda: self.model.respond("road.csv", 250, interpolation="linear"),
             ["respond", "model.json", "road.csv", "--mass", 250, "--interpolation", "linear"]),
            (lambda: self.model.export("matlab"), ["export", "model.json", "--to", "matlab"]),
            (lambda: self.model.export("c", name="2nd"), ["export", "model.json", "--to", "c", "--name", "2nd"]),
            (lambda: self.model.export("c", motion="load.csv"), ["export", "model.json", "--to", "c", "--motion", "load.csv"]),
            (lambda: self.model.simulate("load.csv"), ["simulate", "model.json", "load.csv"]),
            (lambda: hysteron.simulate_preset("spencer-1979", "data/r1.csv"), ["simulate", "--preset", "spencer-1979", "data/r1.csv"]),
            (lambda: hysteron.simulate_preset("spencer-1997", "data/r1.csv", quantities={"beta": 1}),
             ["simulate", "--preset", "spencer-1997", "data/r1.csv", "--set", "beta=1"]),
            (lambda: hysteron.compare("model.json", "load.csv"), ["compare", "model.json", "load.csv"]),
        )
        for call, words in cases:
            with self.assertRaises(hysteron.InputError) as raised:
                call()
            told = complaint(*words, "--out", "nowhere")
            self.assertNotIn("\n", str(raised.exception))
            told = told.removesuffix(f" (see hysteron {words[0]} --help)")
            named = told.replace("--column ", "--columns ").replace("--", "")  # options are arguments here
            self.assertEqual(str(raised.exception).replace("_", "-"), named.replace("_", "-"), words)

    def test_complaints_of_arguments(self):
        for call in (lambda: self.model.respond("load.csv", -1), lambda: self.model.respond("load.csv", 250, periods=1.5),
                     lambda: self.model.export("c", substeps=-1), lambda: hysteron.compare([], "data"),
                     lambda: self.model.simulate("data"), lambda: self.model.simulate("data/r1.csv", out="force.xlsx"),
                     lambda: self.model.simulate(hysteron.load("data/r1.csv", at={"pressure": "2 bar"}))):
            with self.assertRaises(hysteron.InputError) as raised:
                call()
            self.assertNotIn("\n", str(raised.exception))
        pathlib.Path("mine").mkdir()
        pathlib.Path("mine/damper.c").write_text("int main(void) { return 0; }\n")
        with self.assertRaisesRegex(hysteron.InputError, "was not written by hysteron"):
            self.model.export("c", "mine", name="damper")


if __name__ == "__main__":
    unittest.main()
