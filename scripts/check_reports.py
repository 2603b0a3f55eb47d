#!/usr/bin/env python3
"""Makes small reports with every command that writes one and looks at them in headless Chromium.

    scripts/check_reports.py HYSTERON [SCREENSHOTS]       e.g. scripts/check_reports.py build/release/hysteron out/pages

Fails on a script error, a request for anything but the page itself, an empty plot, a page wider than a phone, text of
the data that became markup, or a control that does not work. Screenshots go into the folder given.
Exit status 0: all pages good, 1: findings, 2: wrong call, 77: no Chromium.
"""
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from chromium import Browser, BrowserError, find

PHONE = 390  # CSS pixels
MANY = 210  # recordings: more than a page opens with, in pictures and in rows
MARKUP = '<img src=none onerror="throw 1">.csv'

STUDY = """schema = "hysteron.study/1"
title = "Three solvers on two problems"
models = ["viscous", "bingham"]
solvers = ["pso", "cma-es", "multistart-lm"]
budgets = [100, 400]
seeds = 5
[[data]]
dataset = "rd8040-twin"
label = "twin"
only = ["2.0Hz_1.0A"]
"""

# What a diagnosis says of the first campaigns of a challenge, whose page is looked at, not its figures.
SAID = [
    {"schema": "hysteron.diagnosis/2", "verdict": verdict, "effects": effects, "suggestions": [], "locations": [],
     "baseline": {"model": "bouc-wen", "nrmse_fit": 0.03, "nrmse_heldout": 0.034, "noise_floor_nrmse": 0.01},
     "augmented": {"nrmse_fit": 0.01, "nrmse_heldout": 0.011, "remaining_structure": False}}
    for verdict, effects in (
        ("complete", []), ("unattributed", []),
        ("missing-physics", [{"id": "clearance", "grade": "established", "confidence": 0.97, "indistinguishable_from": [],
                              "parameters": []}]),
        ("ambiguous", [{"id": "series-dashpot", "grade": "supported", "confidence": 0.86, "parameters": [],
                        "indistinguishable_from": ["compliance", "pre-yield-hysteresis"]}]))
]

# Names of the plots in which nothing but axes is drawn, and of drawings without a line.
EMPTY_PLOTS = """(() => {
  const probe = document.createElement("canvas").getContext("2d");
  probe.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--grid").trim();
  probe.fillRect(0, 0, 1, 1);
  const grid = probe.getImageData(0, 0, 1, 1).data;
  const name = (node) => (node.closest("figure")?.textContent || node.getAttribute("aria-label") || node.outerHTML).trim().slice(0, 80);
  const empty = [];
  for (const canvas of document.querySelectorAll(".u-wrap canvas")) {
    const over = canvas.parentElement.querySelector(".u-over");
    const ratio = canvas.width / canvas.clientWidth;
    const [x, y, w, h] = [over.offsetLeft, over.offsetTop, over.offsetWidth, over.offsetHeight].map((v) => Math.round(v * ratio));
    const pixels = w > 0 && h > 0 ? canvas.getContext("2d").getImageData(x, y, w, h).data : [];
    let inked = 0;
    for (let i = 0; i < pixels.length; i += 4) {
      const far = Math.abs(pixels[i] - grid[0]) + Math.abs(pixels[i + 1] - grid[1]) + Math.abs(pixels[i + 2] - grid[2]);
      if (pixels[i + 3] > 60 && far > 60) ++inked;
    }
    if (inked < 20) empty.push(name(canvas));
  }
  for (const svg of document.querySelectorAll("main svg")) {
    const drawn = [...svg.querySelectorAll(".curve, line, .dot, .cell, path:not(.grid)")].some((p) => p.getTotalLength() > 0);
    if (!drawn) empty.push(name(svg));
  }
  return empty;
})()"""

# Elements that reach beyond the page to the right without a scroller of their own.
TOO_WIDE = """((width) => {
  if (document.documentElement.scrollWidth <= width) return [];
  const scrolls = (node) => node && node !== document.body && (getComputedStyle(node).overflowX !== "visible" || scrolls(node.parentElement));
  return [...document.querySelectorAll("body *")].filter((n) => n.getBoundingClientRect().right > width + 1 && !scrolls(n.parentElement))
    .slice(0, 5).map((n) => `${n.tagName.toLowerCase()}.${n.className} to ${Math.round(n.getBoundingClientRect().right)} of ${width} px`)
    .concat([`the page is ${document.documentElement.scrollWidth} px wide`]);
})"""

# Tables that a desktop screen cuts off.
CUT_OFF = """[...document.querySelectorAll(".scroll")].filter((n) => n.scrollWidth > n.clientWidth + 1)
  .map((n) => `${n.getAttribute("aria-label")}: ${n.scrollWidth} of ${n.clientWidth} px`)"""

# Writing in drawings that stands on other writing. The box of a slanted name is larger than the name.
OVERLAPPING = """[...document.querySelectorAll("main svg")].flatMap((svg) => {
  const texts = [...svg.querySelectorAll("text")].filter((t) => t.textContent && !/rotate\\(-45/.test(t.getAttribute("transform"))).map((t) => [t, t.getBoundingClientRect()]);
  const meet = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 3 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 4;
  return texts.flatMap(([t, box], k) => texts.slice(k + 1).filter(([, other]) => meet(box, other)).map(([other]) => `"${t.textContent}" on "${other.textContent}" in ${svg.getAttribute("aria-label")}`));
}).slice(0, 5)"""

# Writing in drawings that a phone shows too small to read, tables whose right side it hides.
UNREADABLE = """(() => {
  const size = (text) => parseFloat(getComputedStyle(text).fontSize) * Math.hypot(text.getScreenCTM().a, text.getScreenCTM().b);
  const small = [...document.querySelectorAll("main svg text")].filter((t) => size(t) < 9)
    .map((t) => `${size(t).toFixed(1)} px: ${t.textContent} in ${t.closest("svg").getAttribute("aria-label")}`).slice(0, 5);
  const hidden = [...document.querySelectorAll(".scroll")].filter((n) => n.querySelector("table") && n.scrollWidth > n.clientWidth + 1)
    .map((n) => `${n.getAttribute("aria-label")}: ${n.scrollWidth} of ${n.clientWidth} px`);
  return small.concat(hidden);
})()"""

# What a reader would do: every recording, every choice, every sorting, paper, and a zoom by dragging on every plot with
# a button to undo it. Gives a list of complaints.
WALK = """(async () => {
  const complaints = [];
  const wait = () => new Promise((done) => setTimeout(done, 200));
  const api = window.hysteronReport;
  for (let i = 0; api && i < api.report.recordings.length; ++i) api.select(i);
  for (const select of document.querySelectorAll("select")) {
    for (let k = 0; k < select.options.length; ++k) { select.selectedIndex = k; select.dispatchEvent(new Event("change")); }
    select.selectedIndex = 0;
    select.dispatchEvent(new Event("change"));
  }
  for (const button of document.querySelectorAll("thead button")) { button.click(); button.click(); }
  for (const button of document.querySelectorAll(".more button")) for (let k = 0; k < 100 && !button.hidden; ++k) button.click();
  for (const kind of ["button.mini", "tr.pick"]) {
    const there = document.querySelectorAll(kind).length;
    if (api && there !== api.report.recordings.length) complaints.push(`${there} of ${api.report.recordings.length} ${kind}`);
  }
  window.dispatchEvent(new Event("beforeprint"));
  if (api && document.querySelectorAll(".print-only svg").length !== 4) complaints.push("no plots for paper");
  window.dispatchEvent(new Event("afterprint"));
  await wait();
  const over = [...document.querySelectorAll("figure.plot .u-over")];
  const fire = (target, type, share) => {
    const box = target.getBoundingClientRect();
    target.dispatchEvent(new MouseEvent(type, { bubbles: true, movementX: 1, movementY: 1, clientX: box.left + share * box.width, clientY: box.top + share * box.height, button: 0 }));
  };
  const zoomed = () => [...document.querySelectorAll("figure.plot .reset")].filter((b) => !b.hidden).length;
  for (const plot of over) for (const [type, share] of [["mouseenter", 0.3], ["mousemove", 0.3], ["mousedown", 0.3], ["mousemove", 0.6], ["mouseup", 0.6]]) fire(plot, type, share);
  await wait();
  if (api && zoomed() !== over.length) complaints.push(`${zoomed()} of ${over.length} plots zoom by dragging`);
  for (const plot of over) fire(plot, "dblclick", 0.5);
  await wait();
  if (zoomed() !== 0) complaints.push("a double click does not undo a zoom");
  return complaints;
})()"""


def make_reports(program, folder):
    """The pages as {name: (path, least number of canvases)}, made in `folder`."""

    def run(*words):
        subprocess.run([program, *words, "--quiet"] if words[0] not in ("generate", "report") else [program, *words],
                       cwd=folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    run("generate", "rd8040-twin", "--only", "2.0Hz", "--out", "twin")
    few = folder / "few"
    few.mkdir()
    for current in ("0.0", "0.4", "0.7", "1.0"):
        shutil.copy(folder / "twin" / f"2.0Hz_{current}A.csv", few)
    run("fit", "few", "--model", "bouc-wen", "--by-current", "alpha:1,c0:1", "--solver", "pso,ga,multistart-lm",
        "--budget", "500", "--stages", "two", "--out", "fit")
    marked = folder / "marked"
    marked.mkdir()
    shutil.copy(folder / "twin" / "2.0Hz_0.5A.csv", marked / MARKUP)
    run("fit", "marked", "--model", "viscous", "--budget", "100", "--out", "fit-marked")
    many = folder / "many"
    many.mkdir()
    for k in range(MANY):
        rows = [f"{0.01 * n:.2f},{(5 + k % 5) * math.sin(0.1 * n):.4f},{(5 + k % 5) * math.cos(0.1 * n) + 2:.4f}" for n in range(130)]
        (many / f"r{k:03}.csv").write_text("time [s],displacement [mm],force [N]\n" + "\n".join(rows) + "\n", encoding="utf-8")
    run("fit", "many", "--model", "viscous", "--budget", "60", "--out", "fit-many")
    run("diagnose", "few", "--model", "bingham", "--by-current", "fc:1,c0:1", "--out", "diagnose")
    (folder / "study.toml").write_text(STUDY, encoding="utf-8")
    run("fit", "few", "--model", "bingham", "--by-current", "fc:1,c0:1", "--budget", "200", "--out", "fit-bingham")
    run("compare", "fit/model.json", "fit-bingham/model.json", "few", "--out", "compare")
    # Forces so small that the labels of an axis are long.
    small = folder / "small"
    small.mkdir()
    for recording in few.iterdir():
        text = recording.read_text(encoding="utf-8")
        if "force [N]" not in text:
            raise SystemExit(f"error: {recording.name} has no column force [N]")
        (small / recording.name).write_text(text.replace("force [N]", "force [uN]"), encoding="utf-8")
    run("fit", "small", "--model", "viscous", "--budget", "100", "--out", "fit-small")
    run("compare", "fit-small/model.json", "small", "--out", "compare-small")
    run("challenge", "--out", "challenge", "--campaigns", "4", "--seed", "5", "--generate-only")
    for k, said in enumerate(SAID):
        answer = folder / "challenge" / "diagnoses" / f"campaign-{k + 1:04}"
        answer.mkdir(parents=True)
        (answer / "diagnosis.json").write_text(json.dumps(said), encoding="utf-8")
    run("challenge", "--out", "challenge", "--score-only")
    # As of a fit that was interrupted before it knew its standard errors.
    page = (folder / "fit" / "report.html").read_text(encoding="utf-8")
    (folder / "fit-open").mkdir()
    page = page.replace('"identifiable":false', '"identifiable":true')
    page = re.sub(r'"std_error":[-+.e0-9]+', '"std_error":null', page)
    (folder / "fit-open" / "report.html").write_text(re.sub(r'"at_bound":"[a-z]+"', '"at_bound":null', page), encoding="utf-8")
    run("bench", "study.toml", "--out", "study")
    run("report", "study")
    return {name: (folder / path / "report.html", canvases)
            for name, path, canvases in (("fit", "fit", 4), ("fit-marked", "fit-marked", 4), ("fit-many", "fit-many", 4), ("diagnose", "diagnose", 4), ("study", "study", 5),
                                         ("fit-open", "fit-open", 4), ("compare", "compare", 0), ("fit-small", "fit-small", 4), ("compare-small", "compare-small", 0), ("challenge", "challenge", 0))}


def troubles(events, page):
    """What the browser reported since the page was opened."""
    for event in events:
        parameters = event["params"]
        if event["method"] == "Runtime.exceptionThrown":
            details = parameters["exceptionDetails"]
            yield "script error: " + (details.get("exception", {}).get("description") or details["text"])
        elif event["method"] == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "assert"):
            yield "console: " + " ".join(str(a.get("value", a.get("description"))) for a in parameters["args"])
        elif event["method"] == "Log.entryAdded" and parameters["entry"]["level"] == "error":
            yield "log: " + parameters["entry"]["text"]
        elif event["method"] == "Network.requestWillBeSent":
            url = parameters["request"]["url"]
            if not url.startswith("data:") and url != page.resolve().as_uri():
                yield "request for " + url


def check(browser, page, canvases, picture):
    """Complaints about a page; `picture(kind)` is where its screenshots go, or None."""
    for kind, width, height, dark in (("wide", 1280, 900, False), ("dark", 1280, 900, True), ("phone", PHONE, 844, False)):
        browser.open(page, width, height, dark=dark, scale=2 if kind == "phone" else 1, mobile=kind == "phone")
        said = []
        if browser.run("document.scripts.length > 0 && document.documentElement.dataset.ready !== 'true'"):
            said.append("its script did not finish")
        found = browser.run("document.querySelectorAll('.u-wrap canvas').length")
        if found < canvases:
            said.append(f"{found} plots, expected {canvases}")
        if browser.run("document.querySelectorAll('body img, body iframe, body object').length"):
            said.append("text of the data became markup")
        if page.parent.name == "fit-open" and "standard errors were not worked out" not in browser.run("document.querySelector('header').innerText"):
            said.append("it claims to know what was not worked out")
        if page.parent.name == "fit" and browser.run("['#known .bars tr', '#known svg.map', '#residual svg'].some((s) => !document.querySelector(s))"):
            said.append("sensitivities, correlations or what is left over are missing")
        if "held-out" in browser.run("document.querySelector('.tiles')?.innerText || ''") and \
                "no recording was held out" in browser.run("document.querySelector('header').innerText"):
            said.append("it denies the held-out recordings whose error it shows")
        said += [f"empty plot: {name}" for name in browser.run(EMPTY_PLOTS)]
        said += [f"too wide: {what}" for what in browser.run(f"{TOO_WIDE}({width})")]
        said += [f"overlapping: {what}" for what in browser.run(OVERLAPPING)]
        if kind == "phone":
            said += [f"not to be read: {what}" for what in browser.run(UNREADABLE)]
        else:
            said += [f"cut off: {what}" for what in browser.run(CUT_OFF)]
        path = picture(kind)
        if path:
            browser.screenshot(path)
        if kind == "wide":
            said += browser.run(WALK)
            browser.settle()
            said += [f"empty plot after use: {name}" for name in browser.run(EMPTY_PLOTS)]
        said += troubles(browser.events, page)
        yield from (f"{kind}: {what}" for what in said)


def main():
    if len(sys.argv) not in (2, 3):
        print("usage: check_reports.py HYSTERON [SCREENSHOTS]", file=sys.stderr)
        return 2
    chromium = find()
    if chromium is None:
        print("skipped: reports are not looked at, Chromium is not installed (apt-get install chromium)", file=sys.stderr)
        return 77
    pictures = pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else None
    if pictures:
        pictures.mkdir(parents=True, exist_ok=True)
    bad = 0
    with tempfile.TemporaryDirectory() as work:
        try:
            pages = make_reports(os.path.abspath(sys.argv[1]), pathlib.Path(work))
        except subprocess.CalledProcessError as error:
            print(f"error: {' '.join(map(str, error.cmd))}: {error.stderr.strip()}", file=sys.stderr)
            return 1
        with Browser(chromium) as browser:
            for name, (page, canvases) in pages.items():
                try:
                    complaints = list(check(browser, page, canvases, lambda kind: pictures and pictures / f"{name}-{kind}.png"))
                except BrowserError as error:
                    complaints = [str(error)]
                for complaint in complaints:
                    print(f"{name}: {complaint}", file=sys.stderr)
                bad += bool(complaints)
    if not bad:
        print(f"ok: {len(pages)} reports drawn, wide, dark and on a phone")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
