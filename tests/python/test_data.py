"""Numbers in and out, and what is said of wrong ones."""

import gc
import os
import subprocess
import sys
import unittest
import warnings

import numpy
import pandas

import hysteron
from support import InFolder, sine


class Data(InFolder):
    def test_channels_are_the_files_numbers_in_si(self):
        (self.folder / "mm.csv").write_text(
            "time [ms],displacement [mm],force [kN]\n" + "".join(f"{k},{k * k},{2 * k}\n" for k in range(20)))
        one = hysteron.load("mm.csv")[0]
        k = numpy.arange(20.0)
        numpy.testing.assert_allclose(one.time, 1e-3 * k, rtol=1e-15)
        numpy.testing.assert_allclose(one.displacement, 1e-3 * k * k, rtol=1e-15)
        numpy.testing.assert_allclose(one.force, 2e3 * k, rtol=1e-15)
        self.assertIsNone(one.current)
        self.assertFalse(one.velocity_measured)
        numpy.testing.assert_allclose(one.velocity, 2 * k, atol=1e-9)  # of a parabola, at 1 ms a sample
        self.assertEqual(list(one.frame.columns), ["time", "displacement", "velocity", "force"])

    def test_warnings_are_python_and_name_no_file_that_is_none(self):
        time, displacement, force, current = sine(2.0, 0.01, 1.0)
        with self.assertWarnsRegex(hysteron.HysteronWarning, r'columns=\{"displacement": "x \[UNIT\]"\}'):
            hysteron.recording({"time": time, "x": 4e3 * displacement, "force": force})
        one = hysteron.recording(time=time, displacement=displacement, force=force)
        model = hysteron.fit([one], "viscous", budget=50)
        far = hysteron.recording(time=time, displacement=3 * displacement, force=force, name="far")
        with self.assertWarnsRegex(hysteron.HysteronWarning, "and the model was fitted"):
            model.score(far)
        model.save("mine.json")
        with self.assertWarnsRegex(hysteron.HysteronWarning, "and mine.json was fitted"):
            model.score(far)

    def test_errors_name_arguments_not_options(self):
        time, displacement, force, current = sine(2.0, 0.01, 1.0)
        one = hysteron.recording(time=time, displacement=displacement, force=force, current=current)
        with self.assertRaisesRegex(hysteron.InputError, "^by_current: the model has no parameter 'f_c'"):
            hysteron.fit([one], "bingham", by_current={"f_c": 1})

    def test_arrays_frames_and_files_are_one_recording(self):
        time, displacement, force, current = sine(2.0, 0.01, 1.0)
        arrays = hysteron.recording(time=time, displacement=displacement, force=force, current=current)
        frame = hysteron.recording(pandas.DataFrame({
            "time [s]": time, "displacement [m]": displacement, "force [N]": force, "current [A]": current,
            "remark": ["a word"] * len(time)}))
        arrays.save("saved.csv")
        file = hysteron.load("saved.csv")[0]
        self.assertEqual(arrays.sha256, file.sha256)
        for name in ("time", "displacement", "velocity", "force", "current"):
            given = getattr(arrays, name)
            numpy.testing.assert_array_equal(given, getattr(frame, name))
            numpy.testing.assert_array_equal(given, getattr(file, name))
        numpy.testing.assert_array_equal(arrays.force, force)
        other = hysteron.load("data/r0.csv")[0]
        other.save("again.csv")
        numpy.testing.assert_array_equal(hysteron.load("again.csv")[0].force, other.force)

    def test_float32_strides_and_lists(self):
        time, displacement, force, _ = sine(2.0, 0.01, 0.0)
        table = numpy.column_stack([time, displacement, force])
        strided = hysteron.recording(time=table[:, 0], displacement=table[:, 1], force=list(table[:, 2]))
        numpy.testing.assert_array_equal(strided.displacement, displacement)
        single = hysteron.recording(time=time, displacement=displacement.astype("float32"), force=force)
        numpy.testing.assert_array_equal(single.displacement, displacement.astype("float32").astype(float))

    def test_views_are_read_only_and_outlive_their_recording(self):
        force = hysteron.load("data/r0.csv")[0].force
        expected = force.copy()
        gc.collect()
        numpy.testing.assert_array_equal(force, expected)
        with self.assertRaises(ValueError):
            force[0] = 0.0
        self.assertFalse(force.flags.owndata)

    def test_parameters_are_the_truth(self):
        recordings = [hysteron.recording(**dict(zip(("time", "displacement", "force", "current"), sine(
            1.0 + k, 0.01, current, noise=0.0))), name=f"r{k}") for k, current in enumerate((0.0, 1.0, 2.0))]
        smooth = [hysteron.recording(time=one.time, displacement=one.displacement, velocity=one.velocity,
                                     force=(800 + 300 * one.current) * one.velocity, current=one.current,
                                     name=one.file) for one in recordings]
        model = hysteron.fit(smooth, "viscous", by_current={"c0": 1}, budget=2000)
        self.assertAlmostEqual(model.parameters.loc["c0", "value"], 800, delta=0.1)
        self.assertAlmostEqual(model.parameters.loc["c0*i", "value"], 300, delta=0.1)
        self.assertLess(model.nrmse, 1e-3)
        self.assertEqual(model.parameters.loc["c0", "unit"], "N s/m")
        self.assertEqual(set(model.convergence), {"multistart-lm"})
        self.assertTrue((numpy.diff(model.convergence["multistart-lm"][:, 1]) < 0).all())

    def test_a_sequence(self):
        recordings = hysteron.load("data")
        self.assertEqual([one.file for one in recordings], ["r0.csv", "r1.csv", "r2.csv", "r3.csv"])
        self.assertEqual(recordings["r1.csv"].file, "r1.csv")
        self.assertEqual(len(recordings[1:3]), 2)
        self.assertEqual(len(recordings.only("r3")), 1)

    def test_campaign_file(self):
        (self.folder / "data" / "campaign.toml").write_text(
            'schema = "hysteron.campaign/1"\nmodel = "viscous"\n[by_current]\nc0 = 1\n'
            '[[recording]]\nfile = "r0.csv"\nrole = "fit"\n[[recording]]\nfile = "r3.csv"\nrole = "validate"\n'
            '[[recording]]\nfile = "r2.csv"\nrole = "fit"\n')
        recordings = hysteron.load("data")
        self.assertEqual([one.role for one in recordings], ["fit", "validate", "fit"])
        model = hysteron.fit(recordings, budget=300)
        self.assertEqual((model.name, model.json["by_current"]), ("viscous", {"c0": 1}))
        self.assertEqual([one["file"] for one in model.json["fitted_on"]], ["r0.csv", "r2.csv"])
        self.assertIsNotNone(model.nrmse_heldout)

    def test_a_campaign_file_that_is_not_read(self):
        (self.folder / "data" / "campaign.toml").write_text(
            'schema = "hysteron.campaign/1"\nmodel = "bouc-wen"\n[by_current]\nc0 = 1\n')
        files = ["data/r0.csv", "data/r2.csv"]
        not_taken = "its model and laws are not taken: expected the folder in their place, for what it says of them"

        def said(work):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                work()
            return [str(one.message) for one in caught if "campaign.toml: it is not read" in str(one.message)]

        told = said(lambda: hysteron.load(*files))
        self.assertEqual(len(told), 1)
        self.assertTrue(told[0].endswith(f"{not_taken}, or its model and laws given to fit or diagnose"), told)
        loaded = []
        said(lambda: loaded.append(hysteron.load(*files)))
        model = []
        given = {"by_current": {"c0": 1}, "budget": 50}
        self.assertEqual(said(lambda: model.append(hysteron.fit(files, "viscous", **given))), [])
        told = said(lambda: hysteron.fit(files, "viscous", budget=50))
        self.assertEqual(len(told), 1)
        self.assertIn("its laws are not taken", told[0])
        # A model that is identified takes neither.
        self.assertEqual(said(lambda: model[0].score(files)), [])
        self.assertEqual(said(lambda: model[0].simulate("data/r0.csv")), [])

    def test_remarks_are_warnings(self):
        time, displacement, force, _ = sine(2.0, 0.01, 0.0)
        with self.assertWarnsRegex(hysteron.HysteronWarning, "displacement"):
            one = hysteron.recording(time=time, displacement=1e3 * displacement, force=force)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            model = hysteron.fit(one, "viscous", budget=50)
        self.assertTrue(any("displacement" in text for text in model.warnings))

    def said(self, work):
        """What it gives, and the warnings."""
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            result = work()
        return result, [str(one.message) for one in caught if issubclass(one.category, hysteron.HysteronWarning)]

    def test_recordings_that_come_together_are_looked_at_side_by_side(self):
        made = []
        for k in range(5):
            time, displacement, force, _ = sine(1.0 + 0.3 * k, 0.01 + 1e-3 * k, 0.0, seed=k)
            made.append(hysteron.recording(time=time, displacement=displacement, force=force * (1000 if k == 2 else 1), name=f"m{k}"))
        made.append(hysteron.recording(time=made[1].time, displacement=made[1].displacement, force=made[1].force, name="m5"))
        (self.folder / "made").mkdir()
        for one in made:
            one.save(f"made/{one.file}")
        together, expected = self.said(lambda: hysteron.load("made"))
        self.assertTrue(any("factor of a thousand" in text for text in expected), expected)
        self.assertTrue(any("holds the same bytes as m1.csv" in text for text in expected), expected)
        program_fit = hysteron.fit(together, "viscous", budget=50).fit_json["warnings"]
        alone = [hysteron.load(f"made/m{k}.csv")[0] for k in range(6)]
        for given in (made, alone, hysteron.Recordings(made)):
            model, told = self.said(lambda: hysteron.fit(given, "viscous", budget=50))
            self.assertEqual(told[:len(expected)], expected)
            self.assertEqual(model.fit_json["warnings"], program_fit)
            for work in (lambda: model.score(given), lambda: hysteron.compare(model, given)):
                self.assertEqual([text for text in self.said(work)[1] if text in expected], expected)
        # What was said of recordings that were loaded together is not said again.
        model, told = self.said(lambda: hysteron.fit(list(together), "viscous", budget=50))
        self.assertEqual([text for text in told if text in expected], [])
        self.assertEqual(model.fit_json["warnings"], program_fit)
        more = hysteron.load("data/r0.csv")[0]
        self.assertEqual([text for text in self.said(lambda: model.score([*together, more]))[1] if "same bytes" in text], [])

    def test_a_part_has_the_remarks_on_its_recordings(self):
        (self.folder / "odd").mkdir()
        for k in range(4):
            time, displacement, force, current = sine(1.0 + 0.3 * k, 0.01 + 1e-3 * k, 0.0, seed=k)
            given = {"time": time, "displacement": displacement, "force": (1000 if k == 2 else 1) * force,
                     "coil current [A]" if k == 1 else "current": current}
            self.said(lambda: hysteron.recording(given, name=f"r{k}").save(f"odd/r{k}.csv"))
        (self.folder / "odd" / "Campaign.toml").write_text('schema = "hysteron.campaign/1"\n')
        recordings, _ = self.said(lambda: hysteron.load("odd"))
        of_file = {name: [text for text in recordings.warnings if text.startswith(name)]
                   for name in ("Campaign.toml", "r0.csv", "r1.csv", "r2.csv", "r3.csv")}
        for name in ("Campaign.toml", "r2.csv"):
            self.assertEqual(len(of_file[name]), 1, recordings.warnings)
        self.assertEqual(sum(map(len, of_file.values())), len(recordings.warnings))
        self.assertEqual(sorted(recordings[:].warnings), sorted(recordings.warnings))
        for part, name in ((recordings[2:3], "r2.csv"), (recordings.only("r3"), "r3.csv"), (recordings[1:][1:2], "r2.csv")):
            self.assertEqual([*part.warnings], of_file["Campaign.toml"] + of_file[name])
        model, told = self.said(lambda: hysteron.fit(recordings[3:], "viscous", budget=50))
        self.assertEqual([text for text in model.warnings if "r2.csv" in text], [])
        self.assertEqual([text for text in told if "r2.csv" in text or "Campaign.toml" in text], [])

    def test_a_part_counts_its_own_recordings_alike(self):
        (self.folder / "fast").mkdir()
        for k in range(4):
            time = numpy.arange(161) / 40.0
            displacement = 0.01 * numpy.sin(2 * numpy.pi * (3.9 + 0.01 * k) * time)
            self.said(lambda: hysteron.recording(time=time, displacement=displacement, name=f"r{k}",
                                                 force=800 * numpy.gradient(displacement, time)).save(f"fast/r{k}.csv"))
        recordings, _ = self.said(lambda: hysteron.load("fast"))
        for part, first, alike in ((recordings, "r0.csv", "(3 more recordings alike)"),
                                   (recordings[2:], "r2.csv", "(1 more recording alike)")):
            text, = [text for text in part.warnings if "samples a period" in text]
            self.assertTrue(text.startswith(first) and text.endswith(alike), text)

    def test_remarks_of_recordings_that_were_not_read_together(self):
        given = [hysteron.load(f"data/r{k}.csv")[0] for k in range(3)]
        (self.folder / "data" / "copy.csv").write_bytes((self.folder / "data" / "r1.csv").read_bytes())
        given.append(hysteron.load("data/copy.csv")[0])
        recordings, told = self.said(lambda: hysteron.Recordings(given))
        self.assertEqual(told, [])
        copy, = [text for text in recordings.warnings if "the same bytes as r1.csv" in text]
        self.assertNotIn(copy, recordings[2:].warnings)
        self.assertIn(copy, recordings[1:].warnings)
        for part, times in ((recordings, 1), (recordings[1:], 1), (recordings[2:], 0)):
            model, told = self.said(lambda: hysteron.fit(part, "viscous", budget=50))
            self.assertEqual((told.count(copy), model.fit_json["warnings"].count(copy)), (times, times))

    def test_too_few_samples_a_period(self):
        time = numpy.arange(161) / 40.0
        displacement = 0.01 * numpy.sin(2 * numpy.pi * 3.9 * time)
        given = {"time": time, "displacement": displacement, "force": 800 * numpy.gradient(displacement, time)}
        one, told = self.said(lambda: hysteron.recording(**given, name="few"))
        one.save("few.csv")
        self.assertTrue(any("samples a period" in text for text in told), told)
        file, of_file = self.said(lambda: hysteron.load("few.csv"))
        self.assertEqual(told, of_file)
        self.assertEqual(hysteron.fit(one, "viscous", budget=50).fit_json["warnings"],
                         hysteron.fit(file, "viscous", budget=50).fit_json["warnings"])

    def test_without_pandas(self):
        script = ("import sys; sys.modules['pandas'] = None\nimport hysteron\n"
                  "model = hysteron.fit('data', 'viscous', budget=50)\n"
                  "rows = model.parameters\nassert isinstance(rows, list) and rows[0]['name'] == 'c0', rows\n"
                  "assert hysteron.list('models')[0]['id']\n"
                  "assert hysteron.load('data')[0].frame[3]['force'] == hysteron.load('data')[0].force[3]\n")
        subprocess.run([sys.executable, "-c", script], check=True, env=os.environ)


class Errors(InFolder):
    def refuses(self, pattern, function, *arguments, error=hysteron.InputError, **keywords):
        with self.assertRaisesRegex(error, pattern) as caught:
            function(*arguments, **keywords)
        self.assertEqual(str(caught.exception).count("\n"), 0)

    def test_of_files(self):
        self.refuses("nowhere.csv", hysteron.load, "nowhere.csv")
        (self.folder / "bad.csv").write_text("time [s],displacement [mm],force [N]\n0,1,2\n1,x,2\n")
        self.refuses(r"^bad.csv:3: displacement 'x' is not a number, expected", hysteron.load, "bad.csv")
        self.refuses("no recordings given", hysteron.load)
        self.refuses("model.json: .*cannot be read", hysteron.load_model, "model.json")
        (self.folder / "model.json").write_text('{"schema": "hysteron.model/9"}')
        self.refuses(r"^model.json: schema \"hysteron.model/9\" is not known", hysteron.load_model, "model.json")

    def test_of_arrays(self):
        time, displacement, force, _ = sine(2.0, 0.01, 0.0)
        good = {"time": time, "displacement": displacement, "force": force}
        self.refuses("has 399 values", hysteron.recording, **{**good, "force": force[1:]})
        self.refuses("value 5 of force is nan", hysteron.recording,
                     **{**good, "force": numpy.where(numpy.arange(400) == 5, numpy.nan, force)})
        self.refuses("does not increase", hysteron.recording, **{**good, "time": time[::-1]})
        self.refuses("2 dimensions", hysteron.recording, **{**good, "time": time.reshape(20, 20)})
        self.refuses("unknown channel 'forse'", hysteron.recording, **good, forse=force)
        self.refuses("no force column", hysteron.recording, time=time, displacement=displacement)
        motion = hysteron.recording(time=time, displacement=displacement, motion_only=True)
        self.refuses("has no force", hysteron.fit, motion, "viscous")
        self.refuses("furlong", hysteron.recording, **good, units={"displacement": "furlong"})
        self.refuses("no column", hysteron.recording, **good, units={"disp": "mm"})
        self.refuses("called recording.csv", hysteron.fit, [hysteron.recording(**good)] * 2, "viscous")

    def test_of_masked_values(self):
        time, displacement, force, _ = sine(2.0, 0.01, 0.0)
        good = {"time": time, "displacement": displacement, "force": force}
        three = numpy.isin(numpy.arange(400), (5, 6, 7))
        for name, values in good.items():
            wrong = {**good, name: numpy.ma.masked_array(values, mask=three)}
            expected = f"^recording.csv: {name} has 3 masked values of 400, expected none: those samples removed"
            self.refuses(expected, hysteron.recording, **wrong)
            self.refuses(expected, hysteron.recording, wrong)
        self.refuses("force has 1 masked value of 400", hysteron.recording,
                     **{**good, "force": numpy.ma.masked_array(force, mask=numpy.arange(400) == 9)})
        whole = hysteron.recording(**{**good, "force": numpy.ma.masked_array(force, mask=numpy.zeros(400, bool))})
        numpy.testing.assert_array_equal(whole.force, force)
        hysteron.recording({**good, "remark": numpy.ma.masked_array(["a word"] * 400, mask=three)})

    def test_of_arguments(self):
        for pattern, arguments in (
                ("no model", {}), ("bouc-wem", {"model": "bouc-wem"}), ("gax", {"model": "viscous", "solver": "gax"}),
                ("budget: 0 is wrong", {"model": "viscous", "budget": 0}),
                ("budget: 1.5 is wrong", {"model": "viscous", "budget": 1.5}),
                ("seed: -1 is wrong", {"model": "viscous", "seed": -1}),
                ("by_current of c0: 9 is wrong", {"model": "viscous", "by_current": {"c0": 9}}),
                ("c9", {"model": "viscous", "by_current": {"c9": 1}}),
                ("bounds of c0", {"model": "viscous", "bounds": {"c0": (2, 1)}}),
                ("tolerance: nan is wrong", {"model": "viscous", "tolerance": float("nan")}),
                ("normalisation", {"model": "viscous", "normalisation": "peak"}),
                ("given twice", {"model": "viscous", "solver": ["pso", "pso"]})):
            self.refuses(pattern, hysteron.fit, hysteron.load("data"), **arguments)
        self.refuses("expected hysteron.load", hysteron.fit, [1.0], "viscous")
        self.refuses("int is no recording", hysteron.fit, 3, "viscous")
        self.refuses("nothing is listed as 'dampers'", hysteron.list, "dampers")
        self.refuses("nothing is called 'bouc-wan'", hysteron.describe, "bouc-wan")
        self.refuses("most_effects: 9", hysteron.diagnose, "data", most_effects=9)
        self.refuses("gone.toml", hysteron.bench, "gone.toml")
        self.assertTrue(issubclass(hysteron.InputError, ValueError))

    def test_failed_work(self):
        (self.folder / "closed").write_text("a file where a folder is asked for")
        model = hysteron.fit("data", "viscous", budget=50)
        self.refuses("cannot be written", model.save, "nowhere/model.json", error=hysteron.WorkError)
        self.refuses("closed", model.save_all, "closed")


if __name__ == "__main__":
    unittest.main()
