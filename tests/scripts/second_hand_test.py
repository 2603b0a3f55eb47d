#!/usr/bin/env python3
"""Tests scripts/second_hand.py: on a stand-in for the program that says what is written for it, and once on the program.

    tests/scripts/second_hand_test.py HYSTERON [VERDICTS]     VERDICTS: the built hysteron_verdicts
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

root = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(root / "scripts"))
import second_hand_score as score  # noqa: E402

hysteron, verdicts = Path(sys.argv[1]).resolve(), None
if len(sys.argv) > 2 and Path(sys.argv[2]).exists():
    verdicts = Path(sys.argv[2]).resolve()

# Writes CAMPAIGN/says.json as the diagnosis; counts its calls; idles where the campaign says so.
stand_in = """#!/usr/bin/env python3
import pathlib, sys
data, out = pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[sys.argv.index("--out") + 1])
with open(data / "calls", "a") as calls:
    calls.write("x")
while (data / "idles").exists():
    pass
if not (data / "says.json").exists():
    sys.exit("error: nothing to say")
(out / "diagnosis.json").write_text((data / "says.json").read_text())
"""


def name(effect, *others, confidence=0.9):
    return {"id": effect, "grade": "supported", "confidence": confidence, "indistinguishable_from": list(others)}


def said(verdict, *effects, suggestions=()):
    return {"verdict": verdict, "effects": list(effects), "suggestions": list(suggestions)}


def truth(*effects, foreign=(), level="plain"):
    return {"effects": list(effects), "foreign": list(foreign), "level": level}


class Scores(unittest.TestCase):
    def rates(self, *pairs):
        answers = {str(k): answer for k, (answer, _) in enumerate(pairs)}
        diagnoses = {str(k): diagnosis for k, (_, diagnosis) in enumerate(pairs)}
        result = score.scored(answers, diagnoses, ["done"] * len(pairs))
        return result, {what: (one["hits"], one["trials"]) for what, one in result["rates"].items()}

    def test_plain(self):
        a = truth("inertia")
        _, rates = self.rates((a, said("missing-physics", name("inertia"))),
                              (a, said("missing-physics", name("inertia"), name("stiction"))),
                              (a, said("ambiguous", name("stiction", "inertia"))),
                              (a, said("ambiguous", name("stiction", "asymmetry"))),
                              (a, said("unattributed", suggestions=[name("stiction")])))
        self.assertEqual(rates["plain: right"], (1, 5))
        self.assertEqual(rates["plain: right, with a second name that is not in the truth"], (1, 5))
        self.assertEqual(rates["plain: in a set"], (1, 5))
        self.assertEqual(rates["plain: a name or set without a cause"], (2, 5))
        self.assertEqual(rates["all: campaigns with a name or set without a cause"], (2, 5))
        self.assertEqual(rates["all: names and sets that hold a cause"], (3, 5))

    def test_a_name_of_schema_1_counts_where_it_is_asserted(self):
        old = {"id": "stiction", "confidence": 0.9, "indistinguishable_from": []}
        _, rates = self.rates((truth("inertia"), said("missing-physics", old)), (truth("inertia"), said("ambiguous", old)))
        self.assertEqual(rates["plain: a name or set without a cause"], (1, 2))

    def test_other_kinds(self):
        pair, compound = truth("inertia", "stiction"), truth("inertia", "stiction", "asymmetry", foreign=["ripple"])
        foreign, nothing = truth(foreign=["tone"]), truth()
        _, rates = self.rates((pair, said("missing-physics", name("inertia"), name("stiction"))),
                              (pair, said("missing-physics", name("inertia"))),
                              (pair, said("missing-physics", name("inertia"), name("end-stop"))),
                              (compound, said("missing-physics", name("asymmetry"))),
                              (compound, said("ambiguous", name("end-stop", "inertia"))),
                              (foreign, said("unattributed")), (foreign, said("complete")),
                              (foreign, said("missing-physics", name("inertia"))),
                              (nothing, said("complete")), (nothing, said("unattributed")),
                              (truth("inertia", level="buried"), said("complete")))
        self.assertEqual(rates["pairs: both"], (1, 3))
        self.assertEqual(rates["pairs: one, or a set"], (1, 3))
        self.assertEqual(rates["pairs: a name or set without a cause"], (1, 3))
        self.assertEqual(rates["compound: a cause named"], (1, 2))
        self.assertEqual(rates["compound: a cause named or in a set"], (2, 2))
        self.assertEqual(rates["foreign: refused (no name, not complete)"], (1, 3))
        self.assertEqual(rates["foreign: complete"], (1, 3))
        self.assertEqual(rates["foreign: a name or set"], (1, 3))
        self.assertEqual(rates["nothing missing: complete"], (1, 2))
        self.assertEqual(rates["nothing missing: no name"], (2, 2))
        self.assertEqual(rates["at or below the noise: right"], (0, 1))

    def test_stated_probability_in_bins(self):
        a = truth("inertia")
        result, _ = self.rates((a, said("missing-physics", name("inertia", confidence=0.97))),
                               (a, said("missing-physics", name("stiction", confidence=0.95))),
                               (a, said("unattributed", suggestions=[name("inertia", confidence=0.55)])))
        bins = {row["from"]: (row["right"]["hits"], row["right"]["trials"]) for row in result["reliability"]}
        self.assertEqual(bins, {0.5: (1, 1), 0.95: (1, 2)})
        self.assertAlmostEqual(result["reliability"][1]["mean_confidence"], 0.96)

    def test_bounds_are_those_of_clopper_and_pearson(self):
        # Nought of n: 1 - 0.025^(1/n). Five of ten as tabulated, symmetric.
        self.assertAlmostEqual(score.clopper_pearson(0, 20)[1], 1 - 0.025 ** (1 / 20), 9)
        self.assertAlmostEqual(score.clopper_pearson(20, 20)[0], 0.025 ** (1 / 20), 9)
        low, high = score.clopper_pearson(5, 10)
        self.assertAlmostEqual(low, 0.1871, 4)
        self.assertAlmostEqual(low + high, 1.0, 9)
        self.assertEqual(score.clopper_pearson(0, 0), (0.0, 1.0))


class Pages(unittest.TestCase):
    def result(self, program, diagnosis):
        result = score.scored({"a": truth("inertia")}, {"a": diagnosis}, ["done"])
        return {**result, "program": program, "median_processor_s": 2.0}

    def test_earlier_columns_stay_and_a_program_has_one(self):
        page = "# Page\n\nProse.\n\n| what | old |\n|---|--:|\n| plain: right | 28 of 40 |\n| own row | 7 |\n\nMore prose.\n"
        page = score.with_result(page, self.result("aaa", said("complete")))
        page = score.with_result(page, self.result("bbb", said("complete")))
        page = score.with_result(page, self.result("aaa", said("missing-physics", name("inertia"))))
        self.assertIn("| what | old | aaa | bbb |", page)
        self.assertIn("| plain: right | 28 of 40 | 1 of 1 | 0 of 1 |", page)
        self.assertIn("| own row | 7 | - | - |", page)
        self.assertIn("\nMore prose.\n", page)
        self.assertEqual(page.count("## aaa"), 1)
        self.assertEqual(page.count("## bbb"), 1)

    def test_a_page_that_is_not_there(self):
        self.assertIn("| plain: right | 0 of 1 |", score.with_result("", self.result("aaa", said("complete"))))


class Command(unittest.TestCase):
    def setUp(self):
        held = tempfile.TemporaryDirectory()
        self.addCleanup(held.cleanup)
        self.folder = Path(held.name)
        self.binary = self.folder / "program"
        self.binary.write_text(stand_in)
        self.binary.chmod(0o755)
        self.answers = {"one/a": truth("inertia"), "one/b": truth("inertia"), "two/c": truth()}
        for case in self.answers:
            (self.folder / "campaigns" / case).mkdir(parents=True)
        self.say("one/a", said("missing-physics", name("inertia")))
        self.say("one/b", said("missing-physics", name("stiction")))
        (self.folder / "campaigns/answers.json").write_text(json.dumps(self.answers))

    def say(self, case, diagnosis):
        (self.folder / "campaigns" / case / "says.json").write_text(json.dumps(diagnosis))

    def run_command(self, *words, binary=None):
        command = [sys.executable, root / "scripts/second_hand.py", self.folder / "campaigns", self.folder / "out",
                   "--binary", binary or self.binary, *words]
        return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)

    def calls(self, case):
        return (self.folder / "campaigns" / case / "calls").read_text().count("x")

    def score(self):
        return json.loads((self.folder / "out/score.json").read_text())

    def test_goes_on_and_says_what_failed_or_took_too_long(self):
        (self.folder / "campaigns/one/b/idles").touch()
        outcome = self.run_command("--jobs", 2, "--limit", 3, "--label", "abc", "--page", self.folder / "page.md")
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        self.assertEqual((self.score()["diagnosed"], self.score()["limit"], self.score()["failed"]), (1, 1, 1))
        self.assertIn("3 of 3", outcome.stderr)
        self.assertIn("1 of 3, 1 at the time limit, 1 failed", (self.folder / "page.md").read_text())
        # What is there is not made again, but what a lower limit ended.
        (self.folder / "campaigns/one/b/idles").unlink()
        self.assertEqual(self.run_command("--limit", 3).returncode, 0)
        self.assertEqual([self.calls(case) for case in self.answers], [1, 1, 1])
        self.assertEqual(self.run_command("--limit", 60).returncode, 0)
        self.assertEqual([self.calls(case) for case in self.answers], [1, 2, 1])
        self.assertEqual(self.score()["rates"]["plain: right"]["hits"], 1)
        self.assertEqual(self.score()["program"], "abc")

    def test_diagnoses_of_two_programs_are_not_mixed(self):
        self.assertEqual(self.run_command().returncode, 0)
        self.binary.write_text(stand_in + "# another\n")
        outcome = self.run_command()
        self.assertEqual(outcome.returncode, 1)
        self.assertIn("holds diagnoses of the program of", outcome.stderr)

    @unittest.skipIf(verdicts is None, "hysteron_verdicts is not built")
    def test_the_verdict_is_taken_again_from_the_evidence(self):
        samples = subprocess.run([hysteron, "generate", "rd8040-twin", "--only", "2.0Hz_0.5A", "--out",
                                  self.folder / "campaigns/two/c"], capture_output=True, text=True, check=False)
        self.assertEqual(samples.returncode, 0, samples.stderr)
        (self.folder / "campaigns/answers.json").write_text(json.dumps({"two/c": truth()}))
        build = self.folder / "build"
        (build / "bench").mkdir(parents=True)
        os.symlink(hysteron, build / "hysteron")
        os.symlink(verdicts, build / "bench/hysteron_verdicts")
        outcome = self.run_command("--label", "abc", binary=build / "hysteron")
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        first = self.score()["outcomes"]
        # Another verdict than its evidence gives is put right.
        file = self.folder / "out/two/c/diagnosis.json"
        diagnosis = json.loads(file.read_text())
        diagnosis.update(said("missing-physics", name("end-stop")))
        file.write_text(json.dumps(diagnosis))
        outcome = self.run_command("--rejudge", "--label", "def", binary=build / "hysteron")
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        self.assertEqual(self.score()["outcomes"], first)
        self.assertEqual(self.score()["program"], "search of abc, verdict of def")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
