#!/usr/bin/env python3
"""Diagnoses campaigns at their own sampling rate and decimated, and says how far the answers agree.

    scripts/decimated.py OUT [--campaigns N] [--seed N] [--binary build/release/hysteron] [--every 2 4 8] [--first N]
                         [--jobs N] [--page results/decimation.md] [--label COMMIT]

OUT/challenge holds the campaigns, made by `hysteron challenge --generate-only` where they are not there yet; the first N
that can be decimated at all are diagnosed. Every k-th row of each recording is kept; a campaign is decimated no further
than to 60 samples of its fastest recording's period, below which the motion itself is lost. The decision is the verdict
with the names that have no rival. Evidence is the gain of the strongest effect and the block score of the augmented over
the base model. Rerun the command to resume.
"""
import argparse
import concurrent.futures
import json
import math
import shutil
import subprocess
import sys
from pathlib import Path

root = Path(__file__).resolve().parent.parent
fewest_of_a_period = 60


def rows_of(file):
    lines = file.read_text(encoding="utf-8").splitlines()
    head = next(k for k, line in enumerate(lines) if not line.startswith("#"))
    return lines[: head + 1], lines[head + 1:]


def samples_of_a_period(file):
    """Samples between upward crossings of the mean displacement, the median; infinite for a motion without two."""
    head, rows = rows_of(file)
    separator = ";" if ";" in head[-1] else "\t" if "\t" in head[-1] else ","
    names = [name.strip().lower() for name in head[-1].split(separator)]
    column = next(k for k, name in enumerate(names) if name.startswith("displacement"))
    x = [float(row.split(separator)[column].replace(",", ".")) for row in rows]
    middle = (max(x) + min(x)) / 2
    ups = [n for n in range(1, len(x)) if x[n - 1] < middle <= x[n]]
    gaps = sorted(b - a for a, b in zip(ups, ups[1:]))
    return gaps[len(gaps) // 2] if gaps else math.inf


def decimated(source, target, every):
    target.mkdir(parents=True, exist_ok=True)
    for file in sorted(source.iterdir()):
        if file.suffix == ".csv":
            head, rows = rows_of(file)
            (target / file.name).write_text("\n".join(head + rows[::every]) + "\n", encoding="utf-8")
        else:
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


def decision(diagnosis):
    names = sorted(row["id"] for row in diagnosis["effects"] if not row["indistinguishable_from"])
    return diagnosis["verdict"], tuple(names)


def evidence(diagnosis):
    held = diagnosis["evidence"]
    gain = held["candidates"][0]["gain"] / held["base"]["squares"] if held["candidates"] else None
    score = held["augmented_over_base"]["mean"] if held["candidates"] else None
    return {"gain": gain, "score": score}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path)
    parser.add_argument("--campaigns", type=int, default=150)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--binary", type=Path, default=root / "build/release/hysteron")
    parser.add_argument("--every", type=int, nargs="+", default=[2, 4, 8])
    parser.add_argument("--first", type=int, default=40)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--page", type=Path)
    parser.add_argument("--label", help="commit that the program was built from; default: the one checked out")
    options = parser.parse_args()
    challenge = options.out / "challenge"
    made = ["challenge", "--out", challenge, "--campaigns", options.campaigns, "--seed", options.seed, "--generate-only"]
    subprocess.run([str(word) for word in [options.binary, *made, "--quiet"]], check=True, stdout=subprocess.DEVNULL)
    campaigns = sorted(p for p in challenge.iterdir() if (p / "campaign.toml").exists())
    tasks = []
    taken = 0
    for campaign in campaigns:
        period = min(samples_of_a_period(file) for file in campaign.glob("*.csv"))
        if taken == options.first or period / min(options.every) < fewest_of_a_period:
            continue
        taken += 1
        for every in [1, *options.every]:
            if every == 1 or period / every >= fewest_of_a_period:
                data = options.out / "data" / f"{campaign.name}-{every}"
                decimated(campaign, data, every)
                tasks.append((campaign.name, every, data))
    (options.out / "diagnoses").mkdir(parents=True, exist_ok=True)
    answers = {}
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        jobs = {
            pool.submit(diagnosed, options.binary, data, options.out / "diagnoses" / data.name): (name, every)
            for name, every, data in tasks
        }
        for done, job in enumerate(concurrent.futures.as_completed(jobs), 1):
            answers[jobs[job]] = job.result()
            print(f"\r{done} of {len(jobs)} diagnosed", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    commit = options.label or subprocess.run(
        ["git", "describe", "--always", "--dirty=-changed"], capture_output=True, text=True, cwd=root
    ).stdout.strip()
    words = f"--campaigns {options.campaigns} --seed {options.seed} --first {options.first}"
    lines = [
        "# The same campaigns at lower sampling rates",
        "",
        f"Made by `scripts/decimated.py OUT {words} --page results/decimation.md` at",
        f"{commit}. Only every k-th sample of each recording is kept, as long as that leaves {fewest_of_a_period} samples of the",
        f"shortest period; {taken} of the {len(campaigns)} campaigns can be decimated so and were diagnosed. Decision: the verdict with the",
        "names that have no rival. Evidence kept: of campaigns with an effect in the model at both rates, those in which the",
        "strongest effect's gain, or the block score, differs by less than 20 %.",
        "",
        "| every | campaigns | same decision | same strongest effect | gain within 20 % | block score within 20 % |",
        "|--:|--:|--:|--:|--:|--:|",
    ]
    changed = []
    for every in options.every:
        names = [name for name, k in answers if k == every]
        same = same_first = both = gains = scores = 0
        for name in sorted(names):
            whole, part = answers[name, 1], answers[name, every]
            same += decision(whole) == decision(part)
            if decision(whole) != decision(part):
                changed.append((name, every, decision(whole), decision(part)))
            a, b = evidence(whole), evidence(part)
            if a["gain"] is not None and b["gain"] is not None:
                both += 1
                first = [d["evidence"]["candidates"][0]["id"] for d in (whole, part)]
                same_first += first[0] == first[1]
                gains += abs(b["gain"] - a["gain"]) <= 0.2 * abs(a["gain"])
                scores += abs(b["score"] - a["score"]) <= 0.2 * abs(a["score"])
        lines.append(f"| {every} | {len(names)} | {same} | {same_first} of {both} | {gains} of {both} | {scores} of {both} |")
    if changed:
        lines += ["", "Changed decisions:", "", "| campaign | every | at its own rate | decimated |", "|---|--:|---|---|"]
        for name, every, before, after in changed:
            words = [f"{verdict} {', '.join(held)}".strip() for verdict, held in (before, after)]
            lines.append(f"| {name} | {every} | {words[0]} | {words[1]} |")
    page = "\n".join(lines) + "\n"
    if options.page:
        options.page.write_text(page, encoding="utf-8")
    print(page)


main()
