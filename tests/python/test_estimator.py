"""The estimator of scikit-learn."""

import sys
import unittest
import warnings

try:
    import sklearn
except ImportError:
    print("scikit-learn is not installed, the estimator is not tested")
    sys.exit(77)

import numpy
import pandas
from sklearn.base import clone
from sklearn.exceptions import NotFittedError
from sklearn.model_selection import GridSearchCV, GroupKFold, cross_val_score
from sklearn.utils.estimator_checks import check_estimator

import hysteron
from support import sine


def campaign():
    """X, y and the number of the recording of four sines."""
    parts = [numpy.column_stack(sine(1.0 + 0.5 * k, 0.01, 0.5 * k, seed=k)) for k in range(4)]
    rows = numpy.vstack(parts)
    groups = numpy.repeat(numpy.arange(4), [len(part) for part in parts])
    return rows[:, [0, 1, 3]], rows[:, 2], groups


class Estimator(unittest.TestCase):
    def test_checks_of_scikit_learn(self):
        # The checks' data are random numbers of any number of columns: the first is taken for a displacement.
        damper = hysteron.Damper("viscous", columns=("displacement", ...), interval=1e-3, budget=40, threads=1)
        expected = damper._more_tags()["_xfail_checks"]
        passed, failed = set(), {}
        for estimator, check in check_estimator(damper, generate_only=True):
            name = check.func.__name__
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                try:
                    # A check that is expected to fail comes wrapped, as one that is skipped.
                    getattr(check.func, "__wrapped__", check.func)(*check.args, estimator, **check.keywords)
                    passed.add(name)
                except Exception as error:
                    failed[name] = repr(error)
        self.assertGreater(len(passed), 30)
        self.assertEqual(set(failed), set(expected), failed)

    def test_what_is_left_out_does_fail(self):
        # Rows in another order are another motion.
        X, y, _ = campaign()
        damper = hysteron.Damper("bouc-wen", columns=("displacement",), interval=1e-3, budget=400).fit(X[:400, 1:2], y[:400])
        self.assertFalse(numpy.allclose(damper.predict(X[:400, 1:2])[::-1], damper.predict(X[399::-1, 1:2])))

    def test_is_the_fit(self):
        X, y, groups = campaign()
        damper = hysteron.Damper("bingham", by_current={"c0": 1, "fc": 1}, budget=1500).fit(X, y)
        recordings = [hysteron.recording(time=X[groups == k, 0], displacement=X[groups == k, 1],
                                         current=X[groups == k, 2], force=y[groups == k], name=f"recording-{k + 1}")
                      for k in range(4)]
        model = hysteron.fit(recordings, "bingham", by_current={"c0": 1, "fc": 1}, budget=1500)
        self.assertEqual(damper.model_.json["parameters"], model.json["parameters"])
        self.assertEqual(len(damper.predict(X)), len(y))
        self.assertGreater(damper.score(X, y), 0.98)
        numpy.testing.assert_array_equal(damper.predict(X)[groups == 2], model.simulate(
            hysteron.recording(time=X[groups == 2, 0], displacement=X[groups == 2, 1], current=X[groups == 2, 2], motion_only=True)))

    def test_frames_name_their_columns(self):
        X, y, groups = campaign()
        frame = pandas.DataFrame({"disp [mm]": 1e3 * X[:, 1], "recording": groups, "current": X[:, 2], "t [ms]": 1e3 * X[:, 0]})
        damper = hysteron.Damper("bingham", by_current={"c0": 1, "fc": 1}, budget=300).fit(frame, y)
        self.assertEqual(len(damper.model_.json["fitted_on"]), 4)
        self.assertGreater(damper.score(frame, y), 0.9)

    def test_a_name_says_the_unit(self):
        X, y, _ = campaign()
        damper = hysteron.Damper("bingham", by_current={"c0": 1, "fc": 1}, budget=300).fit(X, y)
        predicted = damper.predict(X)
        for name, factor in (("force [kN]", 1e-3), ("target (kN)", 1e-3), ("Kraft in kN", 1e-3), ("force [N]", 1), ("y", 1)):
            named = pandas.Series(factor * y, name=name)
            other = clone(damper).fit(X, named)
            numpy.testing.assert_allclose(other.predict(X), predicted, rtol=1e-6, atol=1e-6)
            self.assertAlmostEqual(other.score(X, named), damper.score(X, y), delta=1e-9)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # scikit-learn's, of a column in place of a row
            frame = clone(damper).fit(X, pandas.DataFrame({"force [kN]": 1e-3 * y}))
        numpy.testing.assert_allclose(frame.predict(X), predicted, rtol=1e-6, atol=1e-6)
        for name, expected in (
                ("force [mm]", r"^y 'force \[mm\]': unknown unit 'mm' of force, expected one of N, "),
                ("force [KN]", r"^y 'force \[KN\]': unknown unit 'KN' of force \(did you mean kN\?\), expected"),
                ("force, kN", "^y: the column name 'force, kN' cannot stand in a CSV file, expected no commas")):
            for work in (clone(damper).fit, damper.score):
                with self.assertRaisesRegex(hysteron.InputError, expected) as caught:
                    work(X, pandas.Series(y, name=name))
                self.assertNotIn("\n", str(caught.exception))

    def test_selection(self):
        X, y, groups = campaign()
        damper = hysteron.Damper("bingham", by_current={"c0": 1, "fc": 1}, budget=300)
        scores = cross_val_score(damper, X, y, groups=groups, cv=GroupKFold(4))
        self.assertEqual(len(scores), 4)
        self.assertGreater(scores.min(), 0.9)
        search = GridSearchCV(hysteron.Damper(by_current={"c0": 1}, budget=300), {"model": ["viscous", "bingham"]},
                              cv=GroupKFold(2)).fit(X, y, groups=groups)
        self.assertEqual(search.best_params_, {"model": "bingham"})  # there is dry friction

    def test_wrong_use(self):
        X, y, _ = campaign()
        with self.assertRaises(NotFittedError):
            hysteron.Damper().predict(X)
        with self.assertRaisesRegex(hysteron.InputError, "4 columns without names"):
            hysteron.Damper("viscous").fit(numpy.column_stack([X, y]), y)
        with self.assertRaisesRegex(hysteron.InputError, "2 names and 3 columns"):
            hysteron.Damper("viscous", columns=("time", "displacement")).fit(X, y)
        with self.assertRaisesRegex(hysteron.InputError, "^interval: X has a column 'time', expected either"):
            hysteron.Damper("viscous", columns=("time", "displacement", "current"), interval=1e-3).fit(X, y)
        with self.assertRaisesRegex(hysteron.InputError, "^interval: X has a column 'Zeit \\[s\\]'"):
            frame = pandas.DataFrame(X, columns=("Zeit [s]", "Weg [m]", "current"))
            hysteron.Damper("viscous", interval=1e-3).fit(frame, y)
        with self.assertRaisesRegex(hysteron.InputError, r"^X has two columns named 'displacement \[mm\]', expected"):
            hysteron.Damper("viscous", columns=("time", "displacement [mm]", "displacement [mm]")).fit(X, y)
        masked = numpy.ma.masked_array(X, mask=numpy.zeros(X.shape, bool))
        masked[3:5, 1] = numpy.ma.masked
        with self.assertRaisesRegex(hysteron.InputError, "^X: displacement has 2 masked values of 1600"):
            hysteron.Damper("viscous", columns=("time", "displacement", "current")).fit(masked, y)
        with self.assertRaisesRegex(hysteron.InputError, "^X: column 1 has 2 masked values of 1600"):
            hysteron.Damper("viscous").fit(masked, y)
        with self.assertRaisesRegex(hysteron.InputError, "^y has 1 masked value of 1600"):
            hysteron.Damper("viscous").fit(X, numpy.ma.masked_array(y, mask=numpy.arange(len(y)) == 7))
        self.assertEqual(clone(hysteron.Damper("viscous", budget=7)).get_params()["budget"], 7)


if __name__ == "__main__":
    unittest.main()
