#!/usr/bin/env python3
"""Chooses defaults of solvers by racing candidate settings on training problems, and writes results/defaults.md.

  scripts/race.py [--binary build/release/hysteron] [--seeds 7] [--threads 1] [--study bench/studies/training.toml]

Candidates of a family (the label before the colon) run the same problems and seeds, one seed more a round. After the
third round a candidate leaves when it is behind the leader of its family on the problems: one-sided sign-flip test on the
mean log cost ratio, a problem counted once, at 5 % divided by the candidates left. The records stay in
build/results/training; rerun the command to resume.
"""
import argparse
import csv
import itertools
import math
import re
import statistics
import subprocess
import sys
from pathlib import Path

root = Path(__file__).resolve().parent.parent
first_elimination = 3


def candidates(text):
    """Head of the study, and its [[solver]] tables by label."""
    head, *tables = re.split(r"(?m)^\[\[solver\]\]", text)
    return head, {re.search(r'label = "(.*)"', table)[1]: "[[solver]]" + table for table in tables}


def family(label):
    return label.split(":")[0]


def costs(runs):
    """Cost by (label, problem, seed); infinite where nothing finite was found."""
    with open(runs, encoding="utf-8") as file:
        return {(row["solver"], row["problem"], int(row["seed"])): float(row["nrmse"] or "inf") for row in csv.DictReader(file)}


def log_ratios(table, label, other, problems, seeds):
    """Mean over the seeds of the log cost ratio, a problem each; a run without a finite cost counts as ratio 1000."""
    def one(a, b):
        if math.isinf(a) or math.isinf(b):
            return 0.0 if a == b else math.copysign(math.log(1e3), a - b)
        return math.log(a / b)

    return [statistics.fmean(one(table[label, p, s], table[other, p, s]) for s in seeds) for p in problems]


def behind(values):
    """Probability of so large a mean if the sign of every problem's difference were chance."""
    total = sum(values)
    signs = itertools.product((1, -1), repeat=len(values))
    return statistics.fmean(sum(s * abs(v) for s, v in zip(pattern, values)) >= total - 1e-12 for pattern in signs)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", default=str(root / "build/release/hysteron"))
    parser.add_argument("--study", default=str(root / "bench/studies/training.toml"))
    parser.add_argument("--seeds", type=int, default=7)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--out", default=str(root / "results/defaults.md"))
    options = parser.parse_args()

    head, racing = candidates(Path(options.study).read_text(encoding="utf-8"))
    everyone = list(racing)
    work = root / "build/results/training"
    work.mkdir(parents=True, exist_ok=True)
    last_seed = {}
    table = {}
    for seed in range(1, options.seeds + 1):
        last_seed |= {label: seed for label in racing}
        study = re.sub(r"(?m)^seeds = .*$", f"seeds = [{', '.join(map(str, range(1, seed + 1)))}]", head) + "".join(racing.values())
        (work / "round.toml").write_text(study, encoding="utf-8")
        for command in (["bench", str(work / "round.toml"), "--out", str(work / "records"), "--threads", str(options.threads),
                         "--quiet"],
                        ["report", str(work / "records"), "--out", str(work / "report")]):
            done = subprocess.run([options.binary, *command], stdout=subprocess.DEVNULL)
            if done.returncode:
                sys.exit(done.returncode)
        table |= costs(work / "report/runs.csv")
        problems = sorted({problem for _, problem, _ in table})
        if seed < first_elimination:
            continue
        seeds = range(1, seed + 1)
        for name in {family(label) for label in racing}:
            own = [label for label in racing if family(label) == name]
            score = {a: statistics.fmean(log_ratios(table, a, own[0], problems, seeds)[k] for k in range(len(problems))) for a in own}
            leader = min(own, key=score.get)
            for label in own:
                if label != leader and behind(log_ratios(table, label, leader, problems, seeds)) < 0.05 / (len(own) - 1):
                    del racing[label]
        print(f"seed {seed}: {len(racing)} of {len(everyone)} candidates left", file=sys.stderr)

    floor = next(label for label in everyone if family(label) == "random-search")
    lines = ["# Defaults of solvers, chosen on training problems", "",
             f"Made by `scripts/race.py --seeds {options.seeds}`: candidates of `bench/studies/training.toml` on "
             f"{len(problems)} problems that no ranking uses, 1000 evaluations.", "",
             "Ratio: geometric mean over the problems of the NRMSE over that of random search at the same seeds. Worse on: problems "
             "where the geometric mean over the seeds is above random search. Seeds: how long a candidate stayed in the race; it "
             "leaves when it is shown to be behind the leader of its family (the row in bold, lowest ratio of those left).", "",
             "| candidate | ratio to random search | worse on | seeds |", "|---|--:|--:|--:|"]
    rows = []
    for label in everyone:
        values = log_ratios(table, label, floor, problems, range(1, last_seed[label] + 1))
        rows.append((label, math.exp(statistics.fmean(values)), sum(v > 0 for v in values)))
    leaders = {name: min((r for r in rows if family(r[0]) == name and r[0] in racing), key=lambda r: r[1])[0]
               for name in dict.fromkeys(map(family, everyone))}
    for label, ratio, worse in rows:
        shown = f"**{label}**" if label in leaders.values() else label
        lines.append(f"| {shown} | {ratio:.3f} | {worse} of {len(problems)} | {last_seed[label]} |")
    Path(options.out).write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
