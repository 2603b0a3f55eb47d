"""Plots show what they say."""

import sys
import unittest

try:
    import matplotlib
except ImportError:
    print("matplotlib is not installed, plots are not tested")
    sys.exit(77)

matplotlib.use("Agg")

import numpy

import hysteron
from support import InFolder


class Plots(InFolder):
    def test_lines_are_the_numbers(self):
        recordings = hysteron.load("data")
        model = hysteron.fit(recordings, "bingham", by_current={"c0": 1, "fc": 1}, budget=300)
        axes = hysteron.plot.loops(recordings, model)
        self.assertEqual(len(axes.lines), 8)
        numpy.testing.assert_array_equal(axes.lines[0].get_xdata(), 1e3 * recordings[0].displacement)
        numpy.testing.assert_array_equal(axes.lines[1].get_ydata(), model.simulate(recordings[0]))
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("displacement [mm]", "force [N]"))
        axes = hysteron.plot.loops(recordings, over="velocity")
        numpy.testing.assert_array_equal(axes.lines[3].get_xdata(), 1e3 * recordings[3].velocity)
        axes = hysteron.plot.force_time(recordings[1], model)
        numpy.testing.assert_array_equal(axes.lines[0].get_xdata(), recordings[1].time)
        axes = hysteron.plot.convergence(model)
        numpy.testing.assert_array_equal(axes.lines[0].get_ydata(), model.convergence["multistart-lm"][:, 1])
        axes.figure.savefig("convergence.png")

    def test_what_cannot_be_drawn(self):
        with self.assertRaisesRegex(ValueError, "over: 'time'"):
            hysteron.plot.loops("data", over="time")
        hysteron.fit("data", "viscous", budget=50).save("model.json")
        with self.assertRaisesRegex(ValueError, "read from a file"):
            hysteron.plot.convergence(hysteron.load_model("model.json"))


if __name__ == "__main__":
    unittest.main()
