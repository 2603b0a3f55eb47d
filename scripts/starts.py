#!/usr/bin/env python3
"""Diagnoses campaigns whose files say when their tests were made, with those lines and without, and sets the answers
beside each other.

    scripts/starts.py CHALLENGE OUT [--binary build/release/hysteron] [--jobs N] [--page results/starts.md]

CHALLENGE is an --out of `hysteron challenge --generate-only --level plain --effect self-heating degradation`; campaigns
without starts are left out. The truth is the same in both columns: the damper goes on from test to test. Rerun the
command to resume.
"""
import argparse
import concurrent.futures
import json
import shutil
import subprocess
import sys
from collections import Counter
from pathlib import Path
from statistics import median

root = Path(__file__).resolve().parent.parent


def says_its_start(campaign):
    return all(file.read_text(encoding="utf-8").startswith("# start") for file in campaign.glob("*.csv"))


def without_starts(campaign, copy):
    if copy.exists():
        shutil.rmtree(copy)
    shutil.copytree(campaign, copy)
    for file in copy.glob("*.csv"):
        lines = file.read_text(encoding="utf-8").splitlines(keepends=True)
        file.write_text("".join(line for line in lines if not line.startswith("# start")), encoding="utf-8")


def diagnose(binary, campaign, out):
    if not (out / "diagnosis.json").exists():
        subprocess.run([binary, "diagnose", str(campaign), "--out", str(out), "--threads", "1", "--quiet"], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return json.loads((out / "diagnosis.json").read_text(encoding="utf-8"))


def answer(diagnosis, truth, accepted):
    """What the names of at least `supported` say of the truth, and how they read."""
    words, outcomes = [], set()
    for effect in diagnosis["effects"]:
        members = sorted({effect["id"], *effect.get("indistinguishable_from", [])})
        words.append(" or ".join(members) + f" ({effect['confidence']:.2f})")
        if not set(members) & accepted:
            outcomes.add("a name without a cause")
        elif len(members) > 1:
            outcomes.add("in a set")
        elif members[0] in truth:
            outcomes.add("named alone")
    for outcome in ("a name without a cause", "named alone", "in a set"):
        if outcome in outcomes:
            return outcome, "; ".join(sorted(set(words)))
    return "not named", "; ".join(sorted(set(words))) or diagnosis["verdict"]


def over_noise(diagnosis):
    """Held-out error of the augmented model over the noise."""
    return diagnosis["augmented"]["nrmse_heldout"] / diagnosis["baseline"]["noise_floor_heldout_nrmse"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("challenge", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--binary", default=str(root / "build/release/hysteron"))
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--page", type=Path)
    arguments = parser.parse_args()
    sealed = json.loads((arguments.challenge / "answers.sealed").read_text(encoding="utf-8"))
    answers = sealed["campaigns"]
    last, seed = len(answers), sealed["seed"]
    causes = {effect["id"] for row in answers for effect in row["effects"]}
    if causes != {"self-heating", "degradation"} or any(row["level"] != "plain" for row in answers):
        sys.exit(f"error: {arguments.challenge}: holds {', '.join(sorted(causes))}, expected plain campaigns of self-heating and "
                 "degradation")
    answers = [row for row in answers if says_its_start(arguments.challenge / row["campaign"])]

    def both(row):
        campaign = arguments.challenge / row["campaign"]
        bare = arguments.out / "without" / row["campaign"]
        if not bare.exists():
            bare.parent.mkdir(parents=True, exist_ok=True)
            without_starts(campaign, bare)
        truth = {effect["id"] for effect in row["effects"]}
        accepted = truth | set(row["acceptable"])
        diagnoses = [diagnose(arguments.binary, of, arguments.out / into / row["campaign"])
                     for of, into in ((bare, "diagnoses-without"), (campaign, "diagnoses-with"))]
        return [(*answer(one, truth, accepted), over_noise(one)) for one in diagnoses]

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = []
        for row, result in zip(answers, pool.map(both, answers)):
            results.append((row, result))
            print(f"\r{len(results)} of {len(answers)} campaigns", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    counts = [Counter(result[k][0] for _, result in results) for k in range(2)]
    lines = ["# Starts of the recordings", "", "Made by", "",
             "    build/release/hysteron challenge --generate-only --out slow --level plain --effect self-heating degradation "
             f"--campaigns {last} --seed {seed}",
             "    scripts/starts.py slow slow-diagnosed --page results/starts.md", "",
             f"{len(results)} campaigns of one slow cause whose files say when their tests were made, and the same files without "
             "those lines. With them heat and wear go on from one recording to the next.", "",
             "| | without the starts | with them |", "|---|--:|--:|"]
    for outcome in ("named alone", "in a set", "not named", "a name without a cause"):
        lines.append(f"| {outcome} | {counts[0][outcome]} | {counts[1][outcome]} |")
    ratios = [[result[k][2] for _, result in results] for k in range(2)]
    lines.append("| held-out error of the augmented model over the noise, median | "
                 f"{median(ratios[0]):.2f} | {median(ratios[1]):.2f} |")
    lines.append("| the same, largest | " + f"{max(ratios[0]):.2f} | {max(ratios[1]):.2f} |")
    lines += ["", "In brackets the stated probability, then that error over the noise.", "",
              "| campaign | truth | without the starts | with them |", "|---|---|---|---|"]
    for row, result in results:
        words = [f"{result[k][1]}; {result[k][2]:.2f}" for k in range(2)]
        lines.append(f"| {row['campaign'][-4:]} | {', '.join(row['forms'])} | {words[0]} | {words[1]} |")
    text = "\n".join(lines) + "\n"
    if arguments.page:
        arguments.page.write_text(text, encoding="utf-8")
    else:
        print(text)


if __name__ == "__main__":
    main()
