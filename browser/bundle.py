#!/usr/bin/env python3
"""Puts the page together: browser/bundle.py WEB WORK.js PAGE

WEB holds the parts of the page, WORK.js the compiled work with WORK.wasm beside it. The page holds all of them and loads
nothing.
"""
import base64
import gzip
import pathlib
import sys


def packed(data):
    return base64.b64encode(gzip.compress(data, 9, mtime=0)).decode()


def main():
    web, work, page = (pathlib.Path(name) for name in sys.argv[1:4])
    read = lambda name: (web / name).read_text(encoding="utf-8")
    script = work.read_text(encoding="utf-8") + "\n" + read("browser_worker.js")
    parts = {
        "report_css": read("report.css"),
        "browser_css": read("browser.css"),
        "browser_js": read("browser.js"),
        "worker": packed(script.encode()),
        "wasm": packed(work.with_suffix(".wasm").read_bytes()),
    }
    text = read("browser.html")
    for name, part in parts.items():
        text = text.replace("{{" + name + "}}", part)
    page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
