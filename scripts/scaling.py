#!/usr/bin/env python3
"""Makes results/scaling.md: bench/studies/scaling.toml by 1 and 2 ranks of mpirun, timed, and a simulation of many more.

    scripts/scaling.py [BUILD] [--repeats N]

Measured are wall time, the lengths of all runs, the processor time of a question and of taking in stores; the
simulation (bench/scaling.cpp) has nothing else to go by, and is held against the measured 1 and 2 ranks first. On a
machine that does other things too, wall times grow with them: the share of the time that ranks spend in runs is then the
figure to look at, since runs and the rest grow alike.
"""
import argparse
import os
import re
import shutil
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

root = Path(__file__).resolve().parent.parent
study = root / "bench/studies/scaling.toml"
many = ["1", "2", "8", "32", "100", "300", "1000", "3000"]
environment = dict(os.environ, OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def timings(folder):
    with sqlite3.connect(folder / "store.sqlite") as store:
        return [row[0] for row in store.execute("SELECT seconds FROM environment")]


def measure(program, folder, ranks):
    shutil.rmtree(folder, ignore_errors=True)
    begun = time.monotonic()
    done = subprocess.run(["mpirun", "--oversubscribe", "-n", str(ranks), program, "bench", study, "--out", folder],
                          env=environment, capture_output=True, text=True)
    wall = time.monotonic() - begun
    if done.returncode != 0:
        sys.exit(done.stderr)
    questions, answering, gathering = re.search(
        r"ranks: (\d+) questions answered in ([\d.]+) s, stores taken in in ([\d.]+) s", done.stderr).groups()
    runs = timings(folder)
    return {"ranks": ranks, "wall": wall, "runs": runs, "busy": sum(runs) / (ranks * wall),
            "questions": int(questions), "answering": float(answering), "gathering": float(gathering)}


def startup(program, folder, ranks):
    """A call that finds all runs done: start of MPI, planning, reading the store, identifiability, the summary."""
    with sqlite3.connect(folder / "store.sqlite") as store:
        store.execute("DELETE FROM meta WHERE name = 'identifiability'")
    begun = time.monotonic()
    subprocess.run(["mpirun", "--oversubscribe", "-n", str(ranks), program, "bench", study, "--out", folder, "--quiet"],
                   env=environment, capture_output=True, check=True)
    return time.monotonic() - begun


def simulate(simulator, folder, costs, workers, **more):
    words = [simulator, folder, *workers]
    for name, value in {**costs, **more}.items():
        words += [f"--{name}", f"{value:.9g}" if isinstance(value, float) else str(value)]
    text = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=True).stdout
    return text, [[float(cell) for cell in line.strip("| \n").split("|")] for line in text.splitlines()]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", nargs="?", default=root / "build/release", type=Path)
    parser.add_argument("--repeats", type=int, default=3)
    given = parser.parse_args()
    program, simulator = given.build / "hysteron", given.build / "bench/hysteron_scaling"
    work = given.build / "scaling"
    measured = []
    for repeat in range(given.repeats):  # alternating, so that both meet the same other load
        for ranks in (1, 2):
            one = measure(program, work / f"{ranks}-{repeat}", ranks)
            one["startup"] = startup(program, work / f"{ranks}-{repeat}", ranks)
            measured.append(one)
    singles = [one for one in measured if one["ranks"] == 1]
    pairs = [one for one in measured if one["ranks"] == 2]
    questions = sum(one["questions"] for one in pairs)
    mean = sum(map(sum, (one["runs"] for one in singles))) / sum(len(one["runs"]) for one in singles)
    costs = {
        "question": sum(one["answering"] for one in pairs) / questions,
        "latency": 0.001,
        "record": max(0.0, min((one["wall"] - one["startup"] - sum(one["runs"])) / len(one["runs"]) for one in singles)),
        "store": 0.02,
        "row": min(one["gathering"] for one in pairs) / (len(pairs[0]["runs"]) / 2),
    }
    lines = ["# Scaling of studies under mpirun", "",
             f"Made by `scripts/scaling.py --repeats {given.repeats}`: `bench/studies/scaling.toml`, {len(measured[0]['runs'])} runs of "
             f"{1e3 * mean:.0f} ms in the mean, on {os.cpu_count()} cores.", "",
             "## Measured", "",
             "*In runs*: share of ranks x wall time that is spent in runs; the rest is start-up, planning, storing, waiting, "
             "taking in stores, identifiability of the best fits (by the first rank alone), and the summary. *Efficiency*: wall time of one rank of the same repeat / (ranks x wall "
             "time). The load average says what else the machine did: with other work on its cores two ranks cannot "
             "be twice as fast, whatever the dispatch does.", "",
             "| ranks | wall s | of it start and end s | in runs % | efficiency % | questions | question us | stores taken in ms |",
             "|---|---|---|---|---|---|---|---|"]
    for one in measured:
        base = singles[measured.index(one) // 2]["wall"]
        each = f"{1e6 * one['answering'] / one['questions']:.0f}" if one["questions"] else "-"
        lines.append(f"| {one['ranks']} | {one['wall']:.1f} | {one['startup']:.1f} | {100 * one['busy']:.1f} | "
                     f"{100 * base / (one['ranks'] * one['wall']):.1f} | {one['questions']} | {each} | {1e3 * one['gathering']:.0f} |")
    lines += ["", f"Load average of the last minute at the end: {os.getloadavg()[0]:.1f}.", "",
              "## Simulated", "",
              f"With the measured {1e6 * costs['question']:.0f} us a question, {1e3 * costs['record']:.2f} ms to store a run, "
              f"{1e3 * costs['row']:.2f} ms to take in a run, and two assumptions: 1 ms for a message on its way (the longest "
              "pause between looks for messages) and 20 ms to open a store.", "",
              "Against the measurement, start and end left out (the simulation has none), with the run lengths of each "
              "measured study. The time to store a run is the rest of the measured single ranks, so that only two ranks "
              "put the simulation to the test.", "",
              "| ranks | measured s | simulated s |", "|---|---|---|"]
    for one in measured:
        folder = work / f"{one['ranks']}-{measured.index(one) // 2}"
        row = simulate(simulator, folder, costs, [one["ranks"]])[1][0]
        lines.append(f"| {one['ranks']} | {one['wall'] - one['startup']:.1f} | {row[2] + row[6]:.1f} |")
    header = ["", "| workers | runs | s | efficiency % | with taking in stores % | first rank answering % | taking in s |",
              "|---|---|---|---|---|---|---|"]
    base = work / "1-0"
    # What is left of a single rank's wall time is mostly what other programs took; storing itself is below this.
    costs["record"] = 0.0002
    lines += ["", "The study itself, so often repeated that 1000 workers have 60 runs each (100 x), with 0.2 ms to store "
              "a run, more than all of [overhead.md](overhead.md):", *header]
    lines += simulate(simulator, base, costs, many, copies=100)[0].splitlines()
    for length in (0.01, 0.001):
        lines += ["", f"The same with all lengths scaled to a mean of {1e3 * length:g} ms:", *header]
        lines += simulate(simulator, base, costs, many, copies=100, length=length)[0].splitlines()
    saturated = longest = 0.25
    lines += ["", f"A batch is {saturated} s of runs at most, so the first rank answers as many questions as it can with about "
              f"{longest / costs['question']:.0f} workers ({longest} s / {1e6 * costs['question']:.0f} us), or with "
              f"{mean / costs['question']:.0f} where every run of this study goes out alone. Studies of less than a second a worker "
              "saturate earlier, for batches are a share of what is left. Before that it is the end that costs: the first "
              "rank takes the stores in alone.", ""]
    (root / "results/scaling.md").write_text("\n".join(lines))


main()
