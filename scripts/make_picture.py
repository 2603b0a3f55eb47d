#!/usr/bin/env python3
"""Makes the picture of the README, the top of the report that README's first identification writes; or that of a report
of one's own.

    scripts/make_picture.py HYSTERON [PICTURE]       e.g. scripts/make_picture.py build/release/hysteron
    scripts/make_picture.py REPORT.html PICTURE
"""
import os
import pathlib
import subprocess
import sys
import tempfile

from chromium import Browser, find

PICTURE = pathlib.Path(__file__).resolve().parent.parent / "docs" / "pictures" / "fit-report.png"
COMMANDS = ("generate rd8040-twin --only 2.0Hz --out twin",
            "fit twin --model bouc-wen --by-current alpha:2,c0:2 --quiet --out out")
# Head, key figures and the loops of every recording; of a diagnosis, all down to the maps of what is left.
TOP = """(() => {
  const since = [...document.querySelectorAll("#diagnosis h3")].find((h) => h.textContent.includes("last reversal"));
  const loops = document.querySelector("#overview .minis");
  const end = since ? since.getBoundingClientRect().top - 16 : loops.getBoundingClientRect().bottom;
  return { x: 0, y: 0, width: document.documentElement.clientWidth, height: Math.ceil(end) + 16 };
})()"""


def main():
    if len(sys.argv) not in (2, 3):
        print("usage: make_picture.py HYSTERON [PICTURE] | REPORT.html PICTURE", file=sys.stderr)
        return 2
    chromium = find()
    if chromium is None:
        print("error: no Chromium found, expected one on the path or in CHROMIUM", file=sys.stderr)
        return 2
    picture = pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else PICTURE
    picture.parent.mkdir(parents=True, exist_ok=True)
    program = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as work:
        report = program
        if not program.endswith(".html"):
            for command in COMMANDS:
                subprocess.run([program, *command.split()], cwd=work, check=True, stdout=subprocess.DEVNULL)
            report = os.path.join(work, "out", "report.html")
        with Browser(chromium) as browser:
            browser.open(report, 1120, 800)
            browser.screenshot(picture, browser.run(TOP))
    print(picture)
    return 0


if __name__ == "__main__":
    sys.exit(main())
