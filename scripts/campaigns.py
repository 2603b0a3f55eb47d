"""Campaigns of a challenge and their diagnoses, for the scripts that change the one and compare the other."""
import concurrent.futures
import json
import shutil
import subprocess
import sys
from pathlib import Path

root = Path(__file__).resolve().parent.parent


class Table:
    """A CSV file of a campaign: the lines up to the names of its columns, and the rows behind as cells."""

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

    def write(self, file):
        lines = self.before + [self.separator.join(row) for row in self.rows]
        file.write_text("\n".join(lines) + "\n", encoding="utf-8")


def changed_copy(source, target, change):
    """Copies a campaign; `change` gets the tables of its CSV files by name, and alters them."""
    target.mkdir(parents=True, exist_ok=True)
    tables = {file.name: Table(file) for file in sorted(source.glob("*.csv"))}
    change(tables)
    for name, table in tables.items():
        table.write(target / name)
    for file in source.iterdir():
        if file.suffix != ".csv":
            shutil.copy(file, target / file.name)


def add_options(parser, campaigns):
    """What all these scripts take."""
    parser.add_argument("out", type=Path)
    parser.add_argument("--campaigns", type=int, default=campaigns)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--binary", type=Path, default=root / "build/release/hysteron")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--page", type=Path)
    parser.add_argument("--label", help="commit that the program was built from; default: the one checked out")


def made(options):
    """The campaigns in OUT/challenge, made where they are not there yet."""
    challenge = options.out / "challenge"
    words = ["challenge", "--out", challenge, "--campaigns", options.campaigns, "--seed", options.seed]
    words = [options.binary, *words, "--generate-only", "--quiet"]
    subprocess.run([str(word) for word in words], check=True, stdout=subprocess.DEVNULL)
    return sorted(p for p in challenge.iterdir() if (p / "campaign.toml").exists())


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


def all_diagnosed(options, tasks):
    """Diagnoses the folders of `tasks`, by a key of a name and a number, into OUT/diagnoses/NAME-NUMBER."""
    (options.out / "diagnoses").mkdir(parents=True, exist_ok=True)
    answers = {}
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        jobs = {
            pool.submit(diagnosed, options.binary, data, options.out / "diagnoses" / f"{name}-{number:g}"): (name, number)
            for (name, number), data in tasks.items()
        }
        for done, job in enumerate(concurrent.futures.as_completed(jobs), 1):
            answers[jobs[job]] = job.result()
            print(f"\r{done} of {len(jobs)} diagnosed", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    return answers


def commit_of(options):
    words = ["git", "describe", "--always", "--dirty=-changed"]
    return options.label or subprocess.run(words, capture_output=True, text=True, cwd=root).stdout.strip()


def finish(options, lines):
    page = "\n".join(lines) + "\n"
    if options.page:
        options.page.write_text(page, encoding="utf-8")
    print(page)
