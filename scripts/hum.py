#!/usr/bin/env python3
"""Diagnoses campaigns as they are and with hum in their forces, and says how far the answers agree.

    scripts/hum.py OUT [--campaigns N] [--seed N] [--parts 0.01 0.03 0.1] [--binary build/release/hysteron] [--jobs N]
                   [--page results/hum.md] [--label COMMIT]

OUT/challenge holds the campaigns, made by `hysteron challenge --generate-only` where they are not there yet. The hum is a
sine of 50 Hz, where less than three samples make a cycle of 0.31 times the sampling rate, with a phase of its own in each
recording and an amplitude of so much of the largest force of the campaign. Rerun the command to resume.
"""
import argparse
import math
import random

import campaigns as of_challenge

mains = 50.0


def with_hum(source, target, part):
    draw = random.Random(f"{source.name} {part}")

    def change(tables):
        largest = max(abs(value) for table in tables.values() for value in table.values("force"))
        for table in tables.values():
            unit = 1e-3 if "[ms]" in table.names else 1.0
            time = [unit * value for value in table.values("time")]
            rate = (len(time) - 1) / (time[-1] - time[0])
            frequency = mains if rate > 3 * mains else 0.31 * rate
            phase = draw.uniform(0, 2 * math.pi)
            k = table.column("force")
            comma = table.separator != "," and any("," in row[k] for row in table.rows)
            for row, force, t in zip(table.rows, table.values("force"), time):
                text = f"{force + part * largest * math.sin(2 * math.pi * frequency * t + phase):.7g}"
                row[k] = text.replace(".", ",") if comma else text

    of_challenge.changed_copy(source, target, change)


def names(diagnosis):
    return sorted((row["id"], row["grade"]) for row in diagnosis["effects"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    of_challenge.add_options(parser, campaigns=30)
    parser.add_argument("--parts", type=float, nargs="+", default=[0.01, 0.03, 0.1])
    options = parser.parse_args()
    campaigns = of_challenge.made(options)
    tasks = {}
    for campaign in campaigns:
        tasks[campaign.name, 0.0] = campaign
        for part in options.parts:
            data = options.out / "data" / f"{campaign.name}-{part:g}"
            with_hum(campaign, data, part)
            tasks[campaign.name, part] = data
    answers = of_challenge.all_diagnosed(options, tasks)
    words = f"--campaigns {options.campaigns} --seed {options.seed} --parts {' '.join(f'{p:g}' for p in options.parts)}"
    lines = [
        "# The same campaigns with hum in their forces",
        "",
        f"Made by `scripts/hum.py OUT {words} --page results/hum.md` at {of_challenge.commit_of(options)}.",
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
    of_challenge.finish(options, lines)


main()
