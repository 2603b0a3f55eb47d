#!/usr/bin/env python3
"""Writes results/projection.md: what a solver gains where the coordinates the force is affine in are solved in closed form.

  scripts/projection.py [BINARY [RECORDS]]

Runs bench/studies/projection.toml; the records stay in RECORDS, build/results/projection; rerun the command to resume. The
page names the commit checked out, or what COMMIT in the environment says the program was built from.
"""
import collections
import csv
import math
import os
import statistics
import subprocess
import sys
from pathlib import Path

root = Path(__file__).resolve().parent.parent
binary = sys.argv[1] if len(sys.argv) > 1 else str(root / "build/release/hysteron")
out = Path(sys.argv[2]) if len(sys.argv) > 2 else root / "build/results/projection"
commit = os.environ.get("COMMIT") or subprocess.run(["git", "-C", str(root), "describe", "--always"], check=True, capture_output=True,
                                                    text=True).stdout.strip()
for command in (["bench", str(root / "bench/studies/projection.toml"), "--out", str(out), "--quiet"], ["report", str(out)]):
    if code := subprocess.run([binary, *command], stdout=subprocess.DEVNULL).returncode:
        sys.exit(code)

costs = collections.defaultdict(list)
with open(out / "runs.csv", encoding="utf-8") as file:
    for row in csv.DictReader(file):
        costs[row["solver"], row["problem"]].append((int(row["seed"]), float(row["nrmse"] or "inf")))
problems = sorted({problem for _, problem in costs})
solvers = [solver for solver in dict.fromkeys(s for s, _ in costs) if not solver.endswith(" (projected)")]


def median(solver, problem):
    return statistics.median(cost for _, cost in costs[solver, problem])


seeds = len(costs[solvers[0], problems[0]])
lines = ["# What it is worth to be spared the affine coordinates", "",
         f"Made by `scripts/projection.py`: {len(problems)} problems, {seeds} seeds, 1000 evaluations. Program: commit {commit}. With `project = true` a solver "
         "searches the coordinates the force is not affine in, three of seven of bouc-wen and two of six of hyperbolic-tangent; a point then "
         "costs one evaluation more for each affine coordinate, here five in all, so that it sees a fifth of the points.", "",
         "Median NRMSE without and with; gain: geometric mean over the problems of their ratio. The noise of the recordings is 1 % of "
         "the peak force.", "",
         "| solver | " + " | ".join(problems) + " | gain |", "|---|" + "---|" * len(problems) + "--:|"]
for solver in solvers:
    pairs = [(median(solver, p), median(solver + " (projected)", p)) for p in problems]
    gain = math.exp(statistics.fmean(math.log(a / b) for a, b in pairs))
    lines.append(f"| {solver} | " + " | ".join(f"{a:.3g} to {b:.3g}" for a, b in pairs) + f" | {gain:.2f} |")
(root / "results/projection.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
