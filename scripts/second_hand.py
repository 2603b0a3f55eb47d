#!/usr/bin/env python3
"""Diagnoses campaigns of another generator and scores them against their answers.

    scripts/second_hand.py CAMPAIGNS OUT [--binary build/release/hysteron] [--jobs N] [--limit SECONDS]
                           [--rejudge] [--label COMMIT] [--page results/second-hand.md]

CAMPAIGNS holds answers.json, {"folder/campaign": {"effects": [ids], "foreign": [words], "level": word}, ...}, and those
folders. Each is diagnosed by `hysteron diagnose FOLDER --threads 1` into OUT; a diagnosis that uses more processor time
than the limit is ended, which its run.json says. Rerun the command to resume; OUT belongs to one program. With
--rejudge nothing is diagnosed: the evidence in OUT is judged by the tables of today's program (hysteron_verdicts beside
the binary). The rates are printed and written to OUT/score.json; the page gets a column in its table and a section.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import resource
import shutil
import signal
import statistics
import subprocess
import sys
import threading
import time
from pathlib import Path

root = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(root / "scripts"))
import second_hand_score as score  # noqa: E402


class Stopped(Exception):
    pass


def write_atomically(path, text):
    part = path.with_name(path.name + ".part")
    part.write_text(text, encoding="utf-8")
    part.replace(path)


def read_json(path):
    return json.loads(path.read_text(encoding="utf-8"))


class Runner:
    """Diagnoses campaigns one by one, from several threads."""

    def __init__(self, campaigns, out, binary, limit):
        self.campaigns, self.out, self.binary, self.limit = campaigns, out, binary, limit
        self.running, self.lock, self.stopped = set(), threading.Lock(), False

    def stop(self):
        with self.lock:
            self.stopped = True
            for process in self.running:
                process.kill()

    def done(self, case):
        """Its run.json where it is finished; one that a lower limit ended is not."""
        file = self.out / case / "run.json"
        if not file.exists():
            return None
        run = read_json(file)
        return None if run["ended"] == "limit" and run["limit_s"] < self.limit else run

    def limited(self):
        resource.setrlimit(resource.RLIMIT_CPU, (self.limit, self.limit + 5))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    def diagnose(self, case):
        """Into a folder of its own, which takes its name when all of it is there."""
        part = self.out / "unfinished" / case
        shutil.rmtree(part, ignore_errors=True)
        part.mkdir(parents=True)
        words = [str(self.binary), "diagnose", str(self.campaigns / case), "--out", str(part), "--threads", "1", "--quiet"]
        with self.lock:
            if self.stopped:
                raise Stopped
            process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, preexec_fn=self.limited)
            self.running.add(process)
        error = process.stderr.read().decode(errors="replace")
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        process.stderr.close()
        with self.lock:
            self.running.discard(process)
            if self.stopped:
                raise Stopped
        seconds = usage.ru_utime + usage.ru_stime
        over = process.returncode in (-signal.SIGXCPU, -signal.SIGKILL) and seconds > 0.9 * self.limit
        there = process.returncode == 0 and (part / "diagnosis.json").exists()
        run = {"ended": "done" if there else "limit" if over else "failed", "processor_s": round(seconds, 2),
               "limit_s": self.limit, "status": process.returncode, "error": error.strip()[-2000:]}
        write_atomically(part / "run.json", json.dumps(run, indent=1) + "\n")
        there = self.out / case
        shutil.rmtree(there, ignore_errors=True)
        there.parent.mkdir(parents=True, exist_ok=True)
        part.rename(there)
        return run


def diagnose_all(runner, cases, jobs):
    open_cases = [case for case in cases if runner.done(case) is None]
    begun, ended = time.monotonic(), 0
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        futures = {pool.submit(runner.diagnose, case): case for case in open_cases}
        try:
            for future in concurrent.futures.as_completed(futures):
                run = future.result()
                ended += 1
                left = (time.monotonic() - begun) / ended * (len(open_cases) - ended)
                print(f"{len(cases) - len(open_cases) + ended} of {len(cases)}: {futures[future]} {run['ended']} after "
                      f"{run['processor_s']:.0f} s; about {left / 60:.0f} min left", file=sys.stderr)
        except BaseException:
            for future in futures:
                future.cancel()
            runner.stop()
            raise
    shutil.rmtree(runner.out / "unfinished", ignore_errors=True)


def program_of(binary, label):
    """Commit of the source and hash of the program: what a column stands for."""
    def git(*words):
        return subprocess.run(["git", "-C", str(root), *words], capture_output=True, text=True, check=False)

    if label is None:
        label = git("rev-parse", "--short", "HEAD").stdout.strip() or "unknown"
        if git("diff", "--quiet", "HEAD", "--", "src", "models", "algorithms").returncode == 1:
            label += "-changed"
    return {"commit": label, "sha256": hashlib.sha256(binary.read_bytes()).hexdigest()}


def own(out, binary, program):
    """The program whose diagnoses OUT holds; another one is refused. OUT keeps a copy, which builds meanwhile leave."""
    file = out / "program.json"
    if file.exists():
        held = read_json(file)
        if held["sha256"] != program["sha256"]:
            sys.exit(f"error: {out} holds diagnoses of the program of {held['commit']}; give another folder, or --rejudge")
        return held
    out.mkdir(parents=True, exist_ok=True)
    shutil.copy2(binary, out / "program")
    write_atomically(file, json.dumps(program, indent=1) + "\n")
    return program


def rejudged(binary, out):
    """Diagnoses as far as a verdict goes, by campaign, of the evidence in OUT."""
    judge = binary.parent / "bench/hysteron_verdicts"
    result = subprocess.run([str(judge), str(out), "--plain"], capture_output=True, text=True, check=False)
    if result.returncode != 0:
        sys.exit(f"error: {judge}: {result.stderr.strip()}")
    return json.loads(result.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("campaigns", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--binary", type=Path, default=root / "build/release/hysteron")
    parser.add_argument("--jobs", type=int, default=1, help="diagnoses at a time, of one thread each")
    parser.add_argument("--limit", type=int, default=600, help="processor seconds that a diagnosis may use")
    parser.add_argument("--rejudge", action="store_true", help="judge the stored evidence, diagnose nothing")
    parser.add_argument("--label", help="commit that the column is named by; default that of the checkout")
    parser.add_argument("--page", type=Path, help="page that gets a column and a section")
    given = parser.parse_args()
    answers_file = given.campaigns / "answers.json"
    for file in (answers_file, given.binary):
        if not file.exists():
            sys.exit(f"error: {file} is not there")
    answers = read_json(answers_file)
    program = program_of(given.binary, given.label)
    runner = Runner(given.campaigns, given.out, (given.out / "program").resolve(), given.limit)
    label = program["commit"]
    if given.rejudge:
        if not (given.out / "program.json").exists():
            sys.exit(f"error: {given.out} holds no diagnoses")
        label = f"search of {read_json(given.out / 'program.json')['commit']}, verdict of {label}"
    else:
        label = own(given.out, given.binary, program)["commit"]
        signal.signal(signal.SIGTERM, signal.default_int_handler)
        try:
            diagnose_all(runner, list(answers), given.jobs)
        except (KeyboardInterrupt, Stopped):
            print("interrupted; what is finished is kept", file=sys.stderr)
            sys.exit(130)
    runs = {case: read_json(given.out / case / "run.json") for case in answers
            if (given.out / case / "run.json").exists()}
    diagnoses = {case: read_json(given.out / case / "diagnosis.json") for case, run in runs.items()
                 if run["ended"] == "done"}
    if given.rejudge:
        again = rejudged(given.binary, given.out)
        without = [case for case in diagnoses if case not in again]
        if without:
            print(f"{len(without)} diagnoses hold no evidence and are left out", file=sys.stderr)
        diagnoses = {case: {**diagnoses[case], **again[case]} for case in diagnoses if case in again}
    result = score.scored(answers, diagnoses, [run["ended"] for run in runs.values()])
    result["program"] = label
    result["median_processor_s"] = statistics.median(run["processor_s"] for run in runs.values()) if runs else None
    write_atomically(given.out / "score.json", json.dumps(result, indent=1) + "\n")
    print(score.section(result))
    if given.page:
        before = given.page.read_text(encoding="utf-8") if given.page.exists() else ""
        write_atomically(given.page, score.with_result(before, result))


if __name__ == "__main__":
    main()
