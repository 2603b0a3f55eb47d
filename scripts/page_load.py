#!/usr/bin/env python3
"""How long a page takes in headless Chromium from opening it to having drawn it; the best of three.

Usage: scripts/page_load.py PAGE.html
"""
import os
import sys
import time

from chromium import Browser, BrowserError, find


def main():
    if len(sys.argv) != 2:
        print("usage: page_load.py PAGE.html", file=sys.stderr)
        return 2
    chromium = find()
    if chromium is None:
        print("skipped: Chromium is not installed (apt-get install chromium)", file=sys.stderr)
        return 77
    seconds = []
    with Browser(chromium, 300) as browser:
        for _ in range(3):
            begun = time.monotonic()
            browser.open(sys.argv[1], 1280, 900)
            if browser.run("document.documentElement.dataset.ready") != "true":
                raise BrowserError("its script did not finish")
            seconds.append(time.monotonic() - begun)
    print(f"{os.path.basename(sys.argv[1])}: {os.path.getsize(sys.argv[1]) / 1e6:.1f} MB, drawn after {min(seconds):.1f} s.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
