"""SciPy's part of the comparison: least_squares (trf, random restarts) and differential_evolution on plain_rk4.h.

Usage: scipy_peers.py LIBRARY FOLDER [WORD]: methods whose name holds WORD. Reads FOLDER/problem.csv and FOLDER/data.csv written by `hysteron_peers --prepare`,
writes FOLDER/scipy.csv: method,seed,success,evaluations,seconds,best. See run.sh.
"""
import ctypes
import csv
import sys
import time

import numpy
from scipy.optimize import differential_evolution, least_squares

DIMENSION = 8


class PlainProblem(ctypes.Structure):
    _fields_ = [("samples", ctypes.c_size_t)] + [
        (name, ctypes.POINTER(ctypes.c_double)) for name in ("time", "displacement", "velocity", "force")
    ] + [("normaliser", ctypes.c_double), ("lower", ctypes.c_double * DIMENSION),
         ("upper", ctypes.c_double * DIMENSION), ("logarithmic", ctypes.c_int * DIMENSION)]


class Stop(Exception):
    pass


class Objective:
    """Counts evaluations and raises Stop at the target or at the end of the budget."""

    def __init__(self, function, problem, samples, target, budget):
        self.function, self.problem = function, ctypes.byref(problem)
        self.residuals = numpy.empty(samples)
        self.out = self.residuals.ctypes.data_as(ctypes.POINTER(ctypes.c_double))
        self.target, self.budget = target, budget

    def begin(self):
        self.evaluations, self.best, self.success = 0, float("inf"), False
        self.begun = time.process_time()

    def call(self, unit, out):
        point = numpy.ascontiguousarray(unit, dtype=float)
        cost = self.function(self.problem, point.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), out)
        self.evaluations += 1
        self.best = min(self.best, cost)
        if cost <= self.target or self.evaluations >= self.budget:
            self.success = cost <= self.target
            self.seconds = time.process_time() - self.begun
            raise Stop
        return cost

    def scalar(self, unit):
        return self.call(unit, None)

    def vector(self, unit):
        self.call(unit, self.out)
        return self.residuals.copy()


def restarted_least_squares(objective, random):
    while True:
        least_squares(objective.vector, random.uniform(size=DIMENSION), bounds=(0.0, 1.0), method="trf")


def evolution(objective, random):
    while True:
        differential_evolution(objective.scalar, [(0.0, 1.0)] * DIMENSION, seed=int(random.integers(2**31)),
                               maxiter=100000, polish=False)


def main():
    library, folder = sys.argv[1], sys.argv[2]
    only = sys.argv[3] if len(sys.argv) > 3 else ""
    box, facts = [], {}
    with open(folder + "/problem.csv", encoding="utf-8") as file:
        for row in csv.reader(file):
            if row[0] == "box":
                box.append(row[1:])
            else:
                facts[row[0]] = float(row[1])
    data = numpy.loadtxt(folder + "/data.csv", delimiter=",", skiprows=1)
    channels = [numpy.ascontiguousarray(data[:, k]) for k in range(4)]
    problem = PlainProblem(len(data), *[c.ctypes.data_as(ctypes.POINTER(ctypes.c_double)) for c in channels],
                           facts["normaliser"])
    for k, (lower, upper, logarithmic) in enumerate(box):
        problem.lower[k], problem.upper[k], problem.logarithmic[k] = float(lower), float(upper), int(logarithmic)
    function = ctypes.CDLL(library).plain_nrmse
    function.restype = ctypes.c_double
    objective = Objective(function, problem, len(data), facts["target"], int(facts["budget"]))
    with open(folder + "/scipy.csv", "w", encoding="utf-8") as out:
        for name, method in (("SciPy least_squares trf, random restarts", restarted_least_squares),
                             ("SciPy differential_evolution", evolution)):
            if only not in name:
                continue
            print(name, file=sys.stderr)
            for seed in range(1, int(facts["seeds"]) + 1):
                objective.begin()
                try:
                    method(objective, numpy.random.default_rng(seed))
                except Stop:
                    pass
                out.write(f"{name.replace(',', ' with')},{seed},{int(objective.success)},{objective.evaluations},"
                          f"{objective.seconds:.6g},{objective.best:.9g}\n")


if __name__ == "__main__":
    main()
