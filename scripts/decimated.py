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
import math

import campaigns as of_challenge

fewest_of_a_period = 60


def samples_of_a_period(file):
    """Samples between upward crossings of the mean displacement, the median; infinite for a motion without two."""
    x = of_challenge.Table(file).values("displacement")
    middle = (max(x) + min(x)) / 2
    ups = [n for n in range(1, len(x)) if x[n - 1] < middle <= x[n]]
    gaps = sorted(b - a for a, b in zip(ups, ups[1:]))
    return gaps[len(gaps) // 2] if gaps else math.inf


def decimated(source, target, every):
    def change(tables):
        for table in tables.values():
            table.rows = table.rows[::every]

    of_challenge.changed_copy(source, target, change)


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
    of_challenge.add_options(parser, campaigns=150)
    parser.add_argument("--every", type=int, nargs="+", default=[2, 4, 8])
    parser.add_argument("--first", type=int, default=40)
    options = parser.parse_args()
    campaigns = of_challenge.made(options)
    tasks = {}
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
                tasks[campaign.name, every] = data
    answers = of_challenge.all_diagnosed(options, tasks)
    words = f"--campaigns {options.campaigns} --seed {options.seed} --first {options.first}"
    lines = [
        "# The same campaigns at lower sampling rates",
        "",
        f"Made by `scripts/decimated.py OUT {words} --page results/decimation.md` at",
        f"{of_challenge.commit_of(options)}. Only every k-th sample of each recording is kept, as long as that leaves {fewest_of_a_period} samples of the",
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
    of_challenge.finish(options, lines)


main()
