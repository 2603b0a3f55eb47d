#!/usr/bin/env python3
"""Writes results/populations.md: what the size of a population is worth at small and larger budgets.

  scripts/populations.py [BINARY [RECORDS]]

Runs bench/studies/populations.toml; the records stay in RECORDS, build/results/populations; rerun the command to resume.
"""
import collections
import csv
import math
import statistics
import subprocess
import sys
from pathlib import Path

root = Path(__file__).resolve().parent.parent
binary = sys.argv[1] if len(sys.argv) > 1 else str(root / "build/release/hysteron")
out = Path(sys.argv[2]) if len(sys.argv) > 2 else root / "build/results/populations"
for command in (["bench", str(root / "bench/studies/populations.toml"), "--out", str(out), "--quiet"], ["report", str(out)]):
    if code := subprocess.run([binary, *command], stdout=subprocess.DEVNULL).returncode:
        sys.exit(code)

reference = "random-search: uniform"
tolerance = 1.01  # of the median: what counts as worse
costs = collections.defaultdict(list)
with open(out / "runs.csv", encoding="utf-8") as file:
    for row in csv.DictReader(file):
        costs[row["solver"], row["problem"], int(row["budget"])].append(float(row["nrmse"] or "inf"))
problems = sorted({problem for _, problem, _ in costs})
budgets = sorted({budget for _, _, budget in costs})
solvers = [solver for solver in dict.fromkeys(solver for solver, _, _ in costs) if solver != reference]


def cell(solver, budget):
    ratios = [statistics.median(costs[solver, problem, budget]) / statistics.median(costs[reference, problem, budget])
              for problem in problems]
    worse = sum(ratio > tolerance for ratio in ratios)
    mean = math.exp(statistics.fmean(math.log(ratio) for ratio in ratios))
    return f"{mean:.3f}" + (f" ({worse})" if worse else "")


seeds = len(costs[reference, problems[0], budgets[0]])
lines = ["# Sizes of populations", "",
         "Made by `scripts/populations.py` from `bench/studies/populations.toml`: "
         f"{len(problems)} problems of which none is one of the suite, {seeds} seeds.", "",
         "NRMSE over that of random search with the same budget: geometric mean over the problems of the ratio of the medians over",
         "the seeds; in brackets on how many problems it is worse by more than 1 %. Behind the solver the size of its population, of",
         "shuffled-frog-leaping the frogs of all memeplexes, of shrinking-box-lm the descents a stage.", "",
         "| solver: size | " + " | ".join(f"{budget} evaluations" for budget in budgets) + " |",
         "|---|" + "--:|" * len(budgets)]
lines += [f"| {solver} | " + " | ".join(cell(solver, budget) for budget in budgets) + " |" for solver in solvers]
lines += ["", "The defaults follow the budget so: a population has ten generations at least, as that of `ga` has, and `spso-2011` a hundred,",
          "as the swarm of `pso` has, `crow-search` twenty; `css` has 10 particles. `grasshopper` keeps its 30: 20 did better here and, at 1000",
          "evaluations, not on the suite. `shrinking-box-lm`",
          "has no more descents a stage than the budget holds to their end, of 25 points each.", ""]
(root / "results/populations.md").write_text("\n".join(lines), encoding="utf-8")
