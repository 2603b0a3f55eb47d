"""Laws in any column, recordings without time, a mass on a base: what the program does, byte for byte."""

import json
import unittest

import numpy

import hysteron
from support import InFolder, program, repeat

FIT_FILES = ("model.json", "fit.json", "report.html")


def pressed(pressure, seed):
    """Time, displacement, force of a dashpot of 500 N s/m and 200 N s/m a bar."""
    time = numpy.arange(400) / 200
    displacement = 0.01 * numpy.sin(2 * numpy.pi * 2 * time)
    velocity = 0.04 * numpy.pi * numpy.cos(2 * numpy.pi * 2 * time)
    noise = 0.05 * numpy.random.default_rng(seed).standard_normal(len(time))
    return time, displacement, (500 + 200 * pressure) * velocity + noise


class Conditions(InFolder):
    def setUp(self):
        super().setUp()
        (self.folder / "pressed").mkdir()
        for k, pressure in enumerate((1.0, 2.0, 4.0)):
            columns = numpy.column_stack([*pressed(pressure, k), numpy.full(400, pressure)])
            numpy.savetxt(f"pressed/p{k}.csv", columns, delimiter=",", comments="", fmt="%.12g",
                          header="time [s],displacement [m],force [N],pressure [bar]")

    def same(self, model):
        model.save_all("module")
        repeat(model.command, "program", self.folder)
        self.assertSameFiles("module", "program", FIT_FILES)

    def check(self, model):
        self.assertAlmostEqual(model.parameters.loc["c0", "value"], 500, delta=1)
        self.assertAlmostEqual(1e5 * model.parameters.loc["c0*pressure", "value"], 200, delta=1)

    def test_a_column(self):
        model = hysteron.fit("pressed", "viscous", by={"Pressure": {"c0": 1}}, budget=2000)
        self.check(model)
        self.assertEqual(model.command, "hysteron fit pressed --model viscous --budget 2000 --by pressure=c0:1")
        self.same(model)
        one = hysteron.load("pressed/p1.csv", conditions=["pressure"])[0]
        values, unit = one.conditions["pressure"]
        self.assertEqual((unit, list(values)), ("Pa", [2e5]))
        self.assertEqual(list(one.frame.columns), ["time", "displacement", "velocity", "force", "pressure"])
        self.assertEqual(set(one.frame.pressure), {2e5})
        force = model.simulate(one)
        numpy.testing.assert_array_equal(model.simulate("pressed/p1.csv"), force)
        told = json.loads(program("score", "module/model.json", "pressed", "--json"))
        self.assertEqual(model.score("pressed").overall, told["overall"]["nrmse"])
        one.save("again.csv")
        numpy.testing.assert_allclose(model.simulate("again.csv"), force, rtol=1e-3, atol=0.5)

    def test_arrays(self):
        recordings = []
        for k, pressure in enumerate((1.0, 2.0, 4.0)):
            time, displacement, force = pressed(pressure, k)
            recordings.append(hysteron.recording(
                {"time": time, "displacement": displacement, "force": force, "pressure": numpy.full(400, pressure)},
                units={"pressure": "bar"}, name=f"a{k}", conditions=["pressure"]))
            recordings[k].save(recordings[k].file)
        model = hysteron.fit(recordings, "viscous", by={"pressure": {"c0": 1}}, budget=2000)
        self.check(model)
        self.same(model)

    def test_the_campaigns_laws(self):
        (self.folder / "pressed" / "campaign.toml").write_text(
            'schema = "hysteron.campaign/1"\nmodel = "viscous"\n[by.pressure]\nc0 = 1\n')
        recordings = hysteron.load("pressed")
        self.assertEqual(recordings.by, {"pressure": {"c0": 1}})
        model = hysteron.fit(recordings, budget=2000)
        self.check(model)
        self.same(model)

    def test_a_number_for_what_no_column_holds(self):
        model = hysteron.fit("pressed", "viscous", by={"pressure": {"c0": 1}}, budget=2000)
        time, displacement, force = pressed(3.0, 9)
        hysteron.recording(time=time, displacement=displacement, force=force, name="bare").save("bare.csv")
        recordings = hysteron.load("bare.csv", at={"pressure": "3 bar"})
        self.assertLess(model.score(recordings).overall, 2e-3)
        for call, words in (
            (lambda: model.simulate(hysteron.load("bare.csv")[0]), "bare.csv: read without the pressure"),
            (lambda: model.simulate("bare.csv"), "no column 'pressure'"),
            (lambda: hysteron.load("bare.csv", at={"pressure": "much"}), "'much' of pressure is not a number"),
            (lambda: hysteron.fit(recordings, "viscous"), "which is for simulate and score"),
            (lambda: hysteron.fit("pressed", "viscous", by={"current": {"c0": 1}}), "expected by_current"),
            (lambda: hysteron.fit("pressed", "viscous", by={"pressure": {}}), "names no parameter"),
            (lambda: hysteron.fit("pressed", "viscous", by={"force": {"c0": 1}}), "force"),
            (lambda: hysteron.fit(hysteron.load("pressed"), "viscous", by={"pressure": {"c0": 1}}), "read without it"),
        ):
            with self.assertRaises(hysteron.InputError) as caught:
                call()
            self.assertIn(words, str(caught.exception))
            self.assertNotIn("\n", str(caught.exception))

    def test_without_time(self):
        x = 0.01 * numpy.sin(numpy.linspace(0, 8 * numpy.pi, 400))
        turn = numpy.concatenate([[0.0], numpy.diff(x)])
        loop = hysteron.recording({"displacement": x, "force": 2e4 * x + 30 * numpy.sign(turn)}, name="loop",
                                  without_time=True)
        self.assertFalse(loop.timed)
        loop.save("loop.csv")
        fix = {"c0": 0.0}
        model = hysteron.fit(loop, "bouc-wen", fix=fix, budget=500)
        self.assertIn("--without-time", model.command)
        self.same(model)
        with self.assertRaisesRegex(hysteron.InputError, "depends on the rate"):
            hysteron.fit(loop, "bouc-wen", budget=500)
        with self.assertRaisesRegex(hysteron.InputError, "time"):
            hysteron.load("loop.csv")

    def test_on_a_base(self):
        # m x'' + c x' + k x = -m b'': started in the steady state of a sine, x relative to the base.
        mass, c, k, omega, amplitude = 10.0, 60.0, 4e3, 12.0, 0.004
        time = numpy.arange(600) / 300
        x = amplitude * mass * omega**2 / (k - mass * omega**2 + 1j * c * omega) * numpy.exp(1j * omega * time)
        rig = hysteron.recording(time=time, displacement=x.imag, base=amplitude * numpy.sin(omega * time), name="rig",
                                 motion_only=True)
        rig.save("rig.csv")
        model = hysteron.fit(rig, "viscous", response={"mass": mass}, fix={"f0": 0.0}, budget=1000)
        self.assertAlmostEqual(model.parameters.loc["c0", "value"], c, delta=0.01 * c)
        self.assertAlmostEqual(model.parameters.loc["k0", "value"], k, delta=0.001 * k)
        self.assertEqual(model.fit_json["response"]["excitation"], "base")
        self.same(model)
        with self.assertRaisesRegex(hysteron.InputError, "no force column, expected one for excitation force"):
            hysteron.fit(rig, "viscous", response={"mass": mass, "excitation": "force"})

    def test_under_a_force(self):
        # What `respond` writes: the force on the mass, with that of the damper beside it.
        damper = hysteron.fit("pressed/p0.csv", "viscous", fix={"f0": 0.0, "k0": 0.0}, budget=1000)
        time = numpy.arange(800) / 200
        load = hysteron.recording(time=time, force=300 * numpy.sin(25 * time) + 200 * numpy.sin(61 * time), name="load",
                                  excitation=True)
        damper.respond(load, 10, stiffness=4e3, out="shaker.csv")
        model = hysteron.fit("shaker.csv", "viscous", response={"mass": 10, "stiffness": 4e3}, fix={"f0": 0.0, "k0": 0.0},
                             budget=1000)
        c0 = damper.parameters.loc["c0", "value"]
        self.assertAlmostEqual(model.parameters.loc["c0", "value"], c0, delta=0.01 * c0)
        self.assertEqual(model.fit_json["response"]["excitation"], "force")
        self.same(model)


if __name__ == "__main__":
    unittest.main()
