#!/usr/bin/env python3
"""Diagnoses campaigns as they are and with hum in their forces, and says how far the answers agree.

    scripts/hum.py OUT [--campaigns N] [--seed N] [--parts 0.01 0.03 0.1] [--binary build/release/hysteron] [--jobs N]
                   [--page results/hum.md] [--label COMMIT]

OUT/challenge holds the campaigns, made by `hysteron challenge --generate-only` where they are not there yet. The hum is a
sine of 50 Hz, where less than three samples make a cycle of 0.31 times the sampling rate, with a phase of its own in each
recording and an amplitude of so much of the largest force of the campaign. Rerun the command to resume.
"""
import argparse
import concurrent.futures
import json
import math
import random
import shutil
import subprocess
import sys
from pathlib import Path

root = Path(__file__).resolve().parent.parent
mains = 50.0


class Table:
    """A CSV file of the challenge: lines before the rows, and the rows as cells."""

    def __init__(self, file):
        lines = file.read_text(encoding="utf-8").splitlines()
        head = next(k for k, line in enumerate(lines) if not line.startswith("#"))
        self.before, self.names = lines[: head + 1], lines[head]
        self.separator = ";" if ";" in self.names else "\t" if "\t" in self.names else ","
        self.rows = [line.split(self.separator) for line in lines[head + 1:]]

    def column(self, channel):
        names = [name.strip().lower() for name in self.names.split(self.separator)]
        return next(k for k, name in enumerate(names) if name.startswith(channel))

    def values(self, channel):
        k = self.column(channel)
        return [float(row[k].replace(",", ".")) for row in self.rows]

    def write(self, file, force):
        k = self.column("force")
        comma = self.separator != "," and any("," in row[k] for row in self.rows)
        for row, value in zip(self.rows, force):
            row[k] = f"{value:.7g}".replace(".", ",") if comma else f"{value:.7g}"
        file.write_text("\n".join(self.before + [self.separator.join(row) for row in self.rows]) + "\n", encoding="utf-8")


def with_hum(source, target, part):
    target.mkdir(parents=True, exist_ok=True)
    tables = {file.name: Table(file) for file in sorted(source.glob("*.csv"))}
    largest = max(abs(value) for table in tables.values() for value in table.values("force"))
    draw = random.Random(f"{source.name} {part}")
    for name, table in tables.items():
        unit = 1e-3 if "[ms]" in table.names else 1.0
        time = [unit * value for value in table.values("time")]
        rate = (len(time) - 1) / (time[-1] - time[0])
        frequency = mains if rate > 3 * mains else 0.31 * rate
        phase = draw.uniform(0, 2 * math.pi)
        hum = [part * largest * math.sin(2 * math.pi * frequency * t + phase) for t in time]
        table.write(target / name, [a + b for a, b in zip(table.values("force"), hum)])
    for file in source.iterdir():
        if file.suffix != ".csv":
            shutil.copy(file, target / file.name)


def diagnosed(binary, data, out):
    if not (out / "diagnosis.json").exists():
        part = out.with_name(out.name + ".part")
        shutil.rmtree(part, ignore_errors=True)
        words = [str(binary), "diagnose", str(data), "--out", str(part), "--threads", "1", "--quiet"]
        run = subprocess.run(words, capture_output=True, text=True)
        if run.returncode != 0:
            sys.exit(f"{data}: {run.stderr.strip()}")
        part.replace(out)
    return json.loads((out / "diagnosis.json").read_text(encoding="utf-8"))


def names(diagnosis):
    return sorted((row["id"], row["grade"]) for row in diagnosis["effects"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path)
    parser.add_argument("--campaigns", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--parts", type=float, nargs="+", default=[0.01, 0.03, 0.1])
    parser.add_argument("--binary", type=Path, default=root / "build/release/hysteron")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--page", type=Path)
    parser.add_argument("--label", help="commit that the program was built from; default: the one checked out")
    options = parser.parse_args()
    challenge = options.out / "challenge"
    made = ["challenge", "--out", challenge, "--campaigns", options.campaigns, "--seed", options.seed, "--generate-only"]
    subprocess.run([str(word) for word in [options.binary, *made, "--quiet"]], check=True, stdout=subprocess.DEVNULL)
    campaigns = sorted(p for p in challenge.iterdir() if (p / "campaign.toml").exists())
    tasks = {}
    for campaign in campaigns:
        tasks[campaign.name, 0.0] = campaign
        for part in options.parts:
            data = options.out / "data" / f"{campaign.name}-{part:g}"
            with_hum(campaign, data, part)
            tasks[campaign.name, part] = data
    (options.out / "diagnoses").mkdir(parents=True, exist_ok=True)
    answers = {}
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        jobs = {
            pool.submit(diagnosed, options.binary, data, options.out / "diagnoses" / f"{name}-{part:g}"): (name, part)
            for (name, part), data in tasks.items()
        }
        for done, job in enumerate(concurrent.futures.as_completed(jobs), 1):
            answers[jobs[job]] = job.result()
            print(f"\r{done} of {len(jobs)} diagnosed", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    commit = options.label or subprocess.run(
        ["git", "describe", "--always", "--dirty=-changed"], capture_output=True, text=True, cwd=root
    ).stdout.strip()
    words = f"--campaigns {options.campaigns} --seed {options.seed} --parts {' '.join(f'{p:g}' for p in options.parts)}"
    lines = [
        "# The same campaigns with hum in their forces",
        "",
        f"Made by `scripts/hum.py OUT {words} --page results/hum.md` at {commit}.",
        "A sine of 50 Hz (of 0.31 times the sampling rate where that is below 150 Hz) with a phase of its own in each recording is",
        "added to the force; its amplitude is a part of the largest force of the campaign. Told: a note says that a tone was",
        "taken out. Same names: the effects that are named, with their grades. Where nothing else is missing, a campaign that",
        "is complete without the hum is not with it.",
        "",
        "| amplitude | campaigns | told | same names | complete without, not with it | suggestions that only one of both has |",
        "|--:|--:|--:|--:|--:|--:|",
    ]
    changed = []
    for part in options.parts:
        told = same = of_noise = apart = 0
        for campaign in campaigns:
            without, with_it = answers[campaign.name, 0.0], answers[campaign.name, part]
            told += any("taken out of the force" in note for note in with_it["notes"])
            same += names(without) == names(with_it)
            of_noise += without["verdict"] == "complete" and with_it["verdict"] != "complete"
            apart += len({row["id"] for row in without["suggestions"]} ^ {row["id"] for row in with_it["suggestions"]})
            if names(without) != names(with_it):
                changed.append((campaign.name, part, without, with_it))
        lines.append(f"| {part:g} | {len(campaigns)} | {told} | {same} | {of_noise} | {apart} |")
    if changed:
        lines += ["", "Changed names:", "", "| campaign | amplitude | without | with it |", "|---|--:|---|---|"]
        for name, part, before, after in changed:
            cells = [", ".join(f"{grade} {id}" for id, grade in names(one)) or "-" for one in (before, after)]
            lines.append(f"| {name} | {part:g} | {cells[0]} | {cells[1]} |")
    page = "\n".join(lines) + "\n"
    if options.page:
        options.page.write_text(page, encoding="utf-8")
    print(page)


main()
