#!/usr/bin/env python3
"""Reads the IOHprofiler export of a small study by the format alone and holds it against the study's own tables.

    tests/scripts/ioh_reader_test.py HYSTERON

The format: ALGORITHM/IOHprofiler_fK.info has blocks of three lines. The first is KEY = VALUE pairs separated by commas,
texts in single quotes, with suite, funcId, DIM and algId; the second a comment after %; the third the data file, then
", INSTANCE:EVALUATIONS|BEST" for every run. The data file has a block a run: a line of column names in double quotes,
then rows of numbers, evaluations rising and the best value falling, the last row that of the run's last evaluation.
"""
import csv
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

hysteron = Path(sys.argv[1]).resolve()
study = """schema = "hysteron.study/1"
title = "Export"
models = ["bingham", "hyperbolic-tangent"]
solvers = ["random-search", "pso", "multistart-lm"]
budgets = [50, 120]
seeds = 3

[[data]]
dataset = "rd8040-twin"
label = "twin"
only = ["2.0Hz_1.0A"]
"""


def header_of(line):
    pairs = {}
    for part in re.findall(r"(\w+) = ('[^']*'|[^,]*)(?:, |$)", line):
        pairs[part[0]] = part[1].strip("'") if part[1].startswith("'") else int(part[1])
    return pairs


def blocks_of(path):
    """The runs of a data file: rows (evaluations, best)."""
    runs = []
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith('"'):
            assert [name for name in re.findall(r'"([^"]*)"', line)][0] == "function evaluation", line
            runs.append([])
        else:
            evaluations, best = line.split()[:2]
            runs[-1].append((int(evaluations), float(best)))
    return runs


def read(folder):
    """(algorithm, function, dimension, comment, instance) -> rows, checked against the .info file alone."""
    result = {}
    for info in sorted(folder.glob("*/IOHprofiler_f*.info")):
        lines = info.read_text(encoding="utf-8").splitlines()
        assert len(lines) % 3 == 0, info
        for first in range(0, len(lines), 3):
            header = header_of(lines[first])
            assert set(header) >= {"suite", "funcId", "DIM", "algId"}, lines[first]
            assert lines[first + 1].startswith("%"), lines[first + 1]
            path, *runs = lines[first + 2].split(", ")
            blocks = blocks_of(info.parent / path)
            assert len(blocks) == len(runs), path
            for rows, run in zip(blocks, runs):
                instance, evaluations, best = re.fullmatch(r"(\d+):(\d+)\|(\S+)", run).groups()
                assert all(a[0] < b[0] and a[1] >= b[1] for a, b in zip(rows, rows[1:])), path
                assert rows[-1] == (int(evaluations), float(best)), (path, rows[-1], run)
                result[header["algId"], header["funcId"], header["DIM"], lines[first + 1][1:], int(instance)] = rows
    return result


class Export(unittest.TestCase):
    def test_is_what_the_study_says(self):
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place)
            (folder / "study.toml").write_text(study, encoding="utf-8")
            for command in (["bench", "study.toml", "--out", "out", "--quiet"], ["report", "out", "--ioh"]):
                subprocess.run([hysteron, *command], cwd=folder, check=True, stdout=subprocess.DEVNULL)
            runs = read(folder / "out/ioh")
            # Three algorithms on two functions, three instances, the larger budget alone.
            self.assertEqual(len(runs), 18)
            traces = {}
            with open(folder / "out/runs.csv", encoding="utf-8") as file:
                of = {row["key"]: (row["solver"], row["problem"], int(row["seed"]))
                      for row in csv.DictReader(file) if int(row["budget"]) == 120}
            with open(folder / "out/traces.csv", encoding="utf-8") as file:
                for row in csv.DictReader(file):
                    if row["key"] in of:
                        traces.setdefault(of[row["key"]], []).append((int(row["evaluations"]), float(row["nrmse"])))
            self.assertEqual(len(traces), 18)
            for (algorithm, _, _, problem, instance), rows in runs.items():
                own = traces[algorithm, problem, instance]
                self.assertEqual(rows[:len(own)], own)
                # And at most one more, for the evaluations after the last improvement.
                self.assertLessEqual(len(rows), len(own) + 1)
                self.assertLessEqual(rows[-1][0], 120)

    def test_a_failed_run_is_a_run_without_success(self):
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place)
            # No point with derivatives is within that budget.
            small = study.replace('["random-search", "pso", "multistart-lm"]', '["random-search", "lm"]')
            (folder / "study.toml").write_text(small.replace("[50, 120]", "[2]"), encoding="utf-8")
            for command in (["bench", "study.toml", "--out", "out", "--quiet"], ["report", "out", "--ioh"]):
                subprocess.run([hysteron, *command], cwd=folder, check=True, stdout=subprocess.DEVNULL)
            runs = read(folder / "out/ioh")
            self.assertEqual(len(runs), 12)
            self.assertEqual([rows for (algorithm, *_), rows in runs.items() if algorithm == "lm"], [[(1, 1e10)]] * 6)

    def test_the_reader_refuses_what_is_not_the_format(self):
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place) / "solver"
            folder.mkdir()
            (folder / "IOHprofiler_f1.info").write_text(
                "suite = 'x', funcId = 1, DIM = 2, algId = 'solver'\n%note\ndata.dat, 1:20|0.5\n", encoding="utf-8")
            (folder / "data.dat").write_text('"function evaluation" "best-so-far f(x)"\n1 2\n10 0.5\n', encoding="utf-8")
            with self.assertRaises(AssertionError):
                read(Path(place))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
