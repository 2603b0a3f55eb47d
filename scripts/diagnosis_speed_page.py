#!/usr/bin/env python3
"""Page of the times that scripts/diagnosis_speed.sh took, on standard output.

    scripts/diagnosis_speed_page.py TIMES BEFORE NOW THREADS

TIMES is its times.csv, BEFORE and NOW programs as it calls them: COMMIT or COMMIT+HASH. Of repeats the least counts. A
part is shown where both programs have been timed; of a challenge the campaigns that both have been.
"""
import csv
import os
import platform
import statistics
import sys
from collections import defaultdict
from pathlib import Path

parts = {
    "press": ("twenty recordings of the press damper", 4),
    "crank": ("thirty recordings of the crank damper", 4),
    "rotary": ("six recordings of the rotary device", 8),
    "long": ("two recordings of 66,000 samples at 3 kHz", 8),
}


def processor():
    info = Path("/proc/cpuinfo")
    names = [line.split(":", 1)[1].strip() for line in (info.read_text().splitlines() if info.exists() else [])
             if line.startswith("model name")]
    return names[0] if names else platform.machine()


def line(what, before, now, aim):
    """A row: wall seconds of both, their ratio, that of the processor times, the aim."""
    return (f"| {what} | {before[0]:.1f} | {now[0]:.1f} | {before[0] / now[0]:.1f} | {before[1] / now[1]:.1f} | {aim} |")


def tenth(cases, times):
    """Mean wall and processor seconds of these campaigns."""
    return tuple(statistics.fmean(times[case][k] for case in cases) for k in (0, 1))


def main():
    file, before, now, threads = sys.argv[1:]
    commit_now = now.split("+")[0]
    taken = {before: defaultdict(list), now: defaultdict(list)}
    loads, failed = [], []
    with open(file, encoding="utf-8", newline="") as rows:
        for part, case, _, commit, of_threads, wall, used, load, status in csv.reader(rows):
            if commit not in taken or of_threads != threads:
                continue
            loads.append(float(load))
            if int(status) == 0:
                taken[commit][part, case].append((float(wall), float(used)))
            else:
                failed.append(f"{part} {case} with {commit}: exit status {status}")
    least = {commit: {key: min(values) for key, values in of.items()} for commit, of in taken.items()}
    both = [key for key in least[before] if key in least[now]]
    rows = [line(parts[part][0], least[before][part, case], least[now][part, case], parts[part][1])
            for part, case in both if part in parts]
    campaigns = sorted((key for key in both if key[0] == "challenge"), key=lambda key: least[before][key])
    if campaigns:
        median = [tuple(statistics.median(least[commit][key][k] for key in campaigns) for k in (0, 1))
                  for commit in (before, now)]
        slow = campaigns[-max(1, len(campaigns) // 10):]
        rows.append(line(f"{len(campaigns)} campaigns of a challenge: median", *median, 3))
        rows.append(line(f"of these the tenth slowest with {before} ({len(slow)}): mean",
                         tenth(slow, least[before]), tenth(slow, least[now]), 5))
    untimed = [what for part, (what, _) in parts.items() if not any(key[0] == part for key in both)]
    untimed += [] if campaigns else ["campaigns of a challenge"]
    print("\n".join([
        "# Time of a whole diagnosis", "",
        f"Made by `scripts/diagnosis_speed.sh`: `hysteron diagnose` of commit {before} and of {commit_now}, in turn on the same",
        f"machine with `--threads {threads}`: {processor()}, {os.cpu_count()} cores. Load of the last minute before each call:",
        f"median {statistics.median(loads):.1f}, largest {max(loads):.1f}, the call before it included." if loads
        else "Nothing was timed.", "",
        f"| what | {before} s | {commit_now} s | ratio | of processor times | aim |", "|---|--:|--:|--:|--:|--:|", *rows, "",
        *(["Not timed with this program: " + "; ".join(untimed) + ".", ""] if untimed else []),
        *(["Failed, and in no row:", "", *(f"- {one}" for one in failed), ""] if failed else [])]), end="")


main()
