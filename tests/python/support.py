"""The program, and small campaigns with known truth."""

import os
import pathlib
import shlex
import subprocess
import tempfile
import unittest

import numpy

PROGRAM = os.environ["HYSTERON_PROGRAM"]


def program(*words, folder=None):
    """Runs the program; its standard output."""
    done = subprocess.run([PROGRAM, *map(str, words)], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, f"{words}: {done.stderr}"
    return done.stdout


def complaint(*words, folder=None):
    """Runs the program on what it refuses; its one line, without "error: "."""
    done = subprocess.run([PROGRAM, *map(str, words)], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 2, f"{words}: {done.returncode}, {done.stderr}"
    return done.stderr.splitlines()[-1].removeprefix("error: ")


def repeat(command, out, folder):
    """Runs the command line that a result says it can be made again by."""
    words = shlex.split(command)
    assert words[0] == "hysteron", command
    program(*words[1:], "--out", out, folder=folder)


def sine(frequency, amplitude, current, samples=400, periods=4, noise=0.5, seed=1):
    """Time, displacement, force, current of a dashpot with dry friction, both growing with the current; SI units."""
    time = numpy.arange(samples) * periods / frequency / samples
    phase = 2 * numpy.pi * frequency * time
    displacement = amplitude * numpy.sin(phase)
    velocity = amplitude * 2 * numpy.pi * frequency * numpy.cos(phase)
    force = (800 + 300 * current) * velocity + (20 + 60 * current) * numpy.tanh(velocity / 1e-3)
    force += noise * numpy.random.default_rng(seed).standard_normal(samples)
    return time, displacement, force, numpy.full(samples, float(current))


def write_campaign(folder, currents=(0.0, 0.5, 1.0, 1.5)):
    """CSV files of sines, one a current."""
    for k, current in enumerate(currents):
        rows = numpy.column_stack(sine(1.0 + 0.5 * k, 0.01, current, seed=k))
        numpy.savetxt(pathlib.Path(folder) / f"r{k}.csv", rows, delimiter=",", comments="", fmt="%.9g",
                      header="time [s],displacement [m],force [N],current [A]")


class InFolder(unittest.TestCase):
    """A folder of its own, with the campaign in `data`."""

    def setUp(self):
        keep = tempfile.TemporaryDirectory(prefix="hysteron-python-")
        self.addCleanup(keep.cleanup)
        self.folder = pathlib.Path(keep.name)
        (self.folder / "data").mkdir()
        write_campaign(self.folder / "data")
        before = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, before)

    def assertSameFiles(self, one, other, names):
        for name in names:
            first, second = (self.folder / one / name).read_bytes(), (self.folder / other / name).read_bytes()
            self.assertGreater(len(first), 0)
            self.assertEqual(first, second, f"{name} differs")
