#!/usr/bin/env python3
"""Makes results/overhead.md: what a study costs beside its evaluations.

    scripts/overhead.py [BUILD] [--repeats N]

10,000 runs with 40 evaluations and with 400: processor time grows by 360 evaluations a run (and by what solvers do in
them); the line through both, at no evaluations, is what planning, starting, scoring again, recording, checking and
reporting take. Processor time, which other work on the machine still lengthens, as caches and clock are shared; the least
of the repeats. The page names the commit checked out, or what COMMIT in the environment says the program was built from.
"""
import argparse
import os
import resource
import shutil
import subprocess
from pathlib import Path

root = Path(__file__).resolve().parent.parent
runs = 10000
budgets = (40, 400)
study = """schema = "hysteron.study/1"
title = "Overhead"
models = ["viscous"]
solvers = ["pso", "ga", "cma-es", "de"]
budgets = [{budget}]
seeds = {seeds}
[[data]]
dataset = "rd8040-twin"
label = "twin"
only = ["2.0Hz_1.0A"]
"""


def processor_seconds(words):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([str(word) for word in words], check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", nargs="?", default=root / "build/release", type=Path)
    parser.add_argument("--repeats", type=int, default=5)
    given = parser.parse_args()
    program, work = given.build / "hysteron", given.build / "overhead"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    seconds, again = {}, []
    for budget in budgets:
        file = work / f"{budget}.toml"
        file.write_text(study.format(budget=budget, seeds=runs // 4))
        taken = []
        for repeat in range(given.repeats):
            bench = [program, "bench", file, "--out", work / f"{budget}-{repeat}", "--threads", "1", "--quiet"]
            taken.append(processor_seconds(bench))
            if budget == budgets[0] and repeat == 0:
                again = processor_seconds(bench)
        seconds[budget] = min(taken)
    commit = os.environ.get("COMMIT") or subprocess.run(["git", "-C", str(root), "describe", "--always"], check=True,
                                                        capture_output=True, text=True).stdout.strip()
    low, high = budgets
    slope = (seconds[high] - seconds[low]) / (high - low)
    each = (seconds[low] - low * slope) / runs
    lines = ["# Overhead of studies", "",
             f"Made by `scripts/overhead.py`: {runs} runs on one thread, one recording, the cheapest model; processor time. "
             f"Program: commit {commit}.",
             "",
             "| evaluations a run | study s | a run ms |", "|---|---|---|",
             *(f"| {budget} | {seconds[budget]:.2f} | {1e3 * seconds[budget] / runs:.3f} |" for budget in budgets), "",
             f"An evaluation with what its solver does: {1e6 * slope / runs:.2f} us. Beside the evaluations: "
             f"**{1e3 * each:.2f} ms a run** (of which {1e3 * again / runs:.2f} ms are reading, checking and summing up: a "
             f"call that finds everything done). Below 2 % of studies whose runs take {1e3 * each / 0.02:.0f} ms or more in "
             "the mean.", "",
             "| runs take | overhead % |", "|---|---|",
             *(f"| {length} ms | {100 * each / (each + 1e-3 * length):.1f} |" for length in (1, 2, 5, 10, 20, 50, 100)), ""]
    (root / "results/overhead.md").write_text("\n".join(lines))


main()
