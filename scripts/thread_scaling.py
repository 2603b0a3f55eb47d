#!/usr/bin/env python3
"""Writes results/threads.md: PSO, GA and multistart-lm on one thread and on two.

  scripts/thread_scaling.py [BINARY] [--repeats N] [--anyway]

One fit each of modified-bouc-wen to a simulated recording and to twenty measured ones, the numbers of threads in turn, so
that what else the machine does meets both. Refuses a machine that is not quiet (load average above 0.5 before or 2.5 at the
end), unless told --anyway, which the page then says. The results of both must be the same bytes.
"""
import argparse
import filecmp
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

root = Path(__file__).resolve().parent.parent
parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("binary", nargs="?", default=str(root / "build/release/hysteron"))
parser.add_argument("--repeats", type=int, default=5)
parser.add_argument("--anyway", action="store_true")
options = parser.parse_args()

load = os.getloadavg()[0]
if load > 0.5 and not options.anyway:
    sys.exit(f"error: the load average is {load:.1f}, expected at most 0.5: times on a busy machine say nothing; --anyway measures")
if (os.cpu_count() or 1) < 2:
    sys.exit("error: one core, expected two")

cases = [("pso", 20000, 2000), ("ga", 20000, 2000), ("multistart-lm", 8000, 800)]
motions = [("one simulated recording, 301 samples", ["twin"], []),
           ("twenty measured recordings", [str(root / "datasets/utfsm-mr-damper")], ["--by-current", "alpha:1,c0:1,c1:1"])]


def timed(arguments):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.monotonic()
    subprocess.run(arguments, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    wall = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


rows = []
with tempfile.TemporaryDirectory() as place:
    os.chdir(place)
    subprocess.run([options.binary, "generate", "rd8040-twin", "--only", "2.0Hz_1.0A", "--out", "twin"], check=True,
                   stdout=subprocess.DEVNULL)
    for motion, (title, data, laws) in enumerate(motions):
        for solver, *budgets in cases:
            walls = {1: [], 2: []}
            used = {1: [], 2: []}
            for _ in range(options.repeats):
                for threads in (1, 2):
                    arguments = [options.binary, "fit", *data, "--model", "modified-bouc-wen", *laws, "--solver", solver, "--budget",
                                 str(budgets[motion]), "--seed", "1", "--threads", str(threads), "--quiet", "--out", f"out{threads}"]
                    wall, cpu = timed(arguments)
                    walls[threads].append(wall)
                    used[threads].append(cpu)
                if not filecmp.cmp("out1/model.json", "out2/model.json", shallow=False):
                    sys.exit(f"error: {solver} on {title}: one and two threads give different models")
            one, two = (statistics.median(walls[t]) for t in (1, 2))
            extra = statistics.median(used[2]) / statistics.median(used[1])
            rows.append(f"| {title} | {solver} | {budgets[motion]} | {one:.2f} | {two:.2f} | {one / two:.2f} | {extra:.2f} |")

after = os.getloadavg()[0]
# Two threads of this measurement are a load of two.
if after > 2.5 and not options.anyway:
    sys.exit(f"error: the load average is {after:.1f} at the end, expected at most 2.5: another program came in between, no page written")
lines = ["# One thread and two", "",
         f"Made by `scripts/thread_scaling.py --repeats {options.repeats}{' --anyway' if options.anyway else ''}`: whole `hysteron fit` "
         f"commands, reading, standard errors and report included, medians of {options.repeats} in turn. Load average {load:.1f} before, "
         f"{after:.1f} at the end." + (" The machine was not quiet: the ratios are of what was left of it." if load > 0.5 else ""), "",
         "Both give the same model.json, byte for byte.", "",
         "| data | solver | evaluations | 1 thread, s | 2 threads, s | faster | processor time, 2 over 1 |", "|---|---|--:|--:|--:|--:|--:|",
         *rows, ""]
(root / "results/threads.md").write_text("\n".join(lines), encoding="utf-8")
