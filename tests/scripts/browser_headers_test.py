#!/usr/bin/env python3
"""The boxes that the page for browsers is made of include no header of threads: its standard library has none.

The page itself takes minutes to build (scripts/browser.sh); this finds the fault where it is made.
"""
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# <mutex> is not among them: browser/standard has one that locks nothing.
THREADS = re.compile(r"^\s*#include <(thread|condition_variable|future|latch|barrier|semaphore|stop_token|"
                     r"shared_mutex|pthread\.h)>", re.MULTILINE)
BOXES = ("core", "io", "simulate", "fit", "diagnose", "report", "check", "respond", "compare", "task")
# For solvers that the page leaves out (HYSTERON_LEFT_OUT of cmake/browser.cmake).
LEFT_OUT = ("algorithms/support/rendezvous.hpp",)


class Headers(unittest.TestCase):
    def test_no_box_of_the_page_includes_threads(self):
        files = [file for folder in (*(ROOT / "src" / box for box in BOXES), ROOT / "models", ROOT / "algorithms")
                 for file in folder.rglob("*.?pp")]
        self.assertGreater(len(files), 500)
        found = [str(file.relative_to(ROOT)) for file in files if THREADS.search(file.read_text(encoding="utf-8"))]
        self.assertEqual([file for file in found if file not in LEFT_OUT], [])


if __name__ == "__main__":
    unittest.main()
