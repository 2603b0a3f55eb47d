#!/usr/bin/env python3
"""Uses the page of scripts/browser.sh in headless Chromium as a reader would and compares it with the program.

    scripts/check_browser.py [--diagnose] HYSTERON [PAGE [SCREENSHOTS]]     PAGE: build/browser/hysteron.html unless given

Drops recordings of a measured damper on the page, fits them, and compares every parameter and error with those of the
program on the same files; tries a file that the page does not read and one that is no recording; with --diagnose also
diagnoses a simulated device, which takes minutes. Prints the times of both.
Exit status 0: good, 1: findings, 2: wrong call, 77: no Chromium or no page.
"""
import base64
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

from chromium import Browser, BrowserError, find

# Relative difference that is let pass. A browser has no fused multiplication, so that forces differ by some 1e-15, and a
# descent ends where a step is below 1e-9 of the box: what both print, four digits, is the same.
TOLERANCE = 1e-6
PHONE = 400  # CSS pixels

DROP = """(async (files) => {
  const transfer = new DataTransfer();
  for (const [name, text] of files) {
    transfer.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
  }
  document.getElementById("drop").dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
})"""
CHOOSE = """((values) => {
  const form = document.getElementById("form");
  for (const [id, value] of Object.entries(values)) document.getElementById(id).value = value;
  form.dispatchEvent(new Event("change"));
})"""
STATE = """(() => {
  const { state } = window.hysteronPage;
  const error = document.getElementById("error");
  return { looked: Boolean(state.look), busy: state.busy, error: error.hidden ? "" : error.textContent, seconds: state.seconds,
           stage: document.getElementById("stage").textContent };
})()"""
RESULTS = """Object.fromEntries(window.hysteronPage.state.results.map(({ name, bytes }) => [name, new TextDecoder().decode(bytes)]))"""


def until(browser, holds, seconds):
    """The state of the page once `holds` says so."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        state = browser.run(STATE)
        if holds(state):
            return state
        time.sleep(0.2)
    raise BrowserError(f"nothing came within {seconds} s: {state}")


def drop(browser, files):
    browser.run(DROP + "(" + json.dumps([[f.name, base64.b64encode(f.read_bytes()).decode()] for f in files]) + ")")
    return until(browser, lambda s: not s["busy"] and (s["looked"] or s["error"]), 60)


def worked(browser, work, values, seconds):
    """The results of a work begun with the button, as texts by name, and the seconds it took."""
    browser.run(f"document.querySelector('input[value={work}]').checked = true")
    browser.run(CHOOSE + "(" + json.dumps(values) + ")")
    browser.run("document.getElementById('start').click()")
    state = until(browser, lambda s: not s["busy"], seconds)
    if state["error"]:
        raise BrowserError(state["error"])
    return browser.run(RESULTS), state["seconds"]


def natively(hysteron, work, folder, options, out):
    """The same by the program, on one thread."""
    subprocess.run([hysteron, work, str(folder), *options, "--out", str(out), "--threads", "1", "--quiet"], check=True,
                   stdout=subprocess.DEVNULL)
    return json.loads((out / "environment.json").read_text())


def far(here, there):
    return not math.isclose(here, there, rel_tol=TOLERANCE, abs_tol=0.0) and here != there


def differences(here, there):
    """What two model.json differ in by more than the tolerance: parameters, errors, recordings."""
    if [p["name"] for p in here["parameters"]] != [p["name"] for p in there["parameters"]]:
        yield "other parameters"
        return
    for one, other in zip(here["parameters"], there["parameters"]):
        if far(one["value"], other["value"]):
            yield f"{one['name']}: {one['value']} in the page, {other['value']} by the program"
    for kind in ("fit", "heldout"):
        one, other = here["nrmse"].get(kind), there["nrmse"].get(kind)
        if (one is None) != (other is None) or (one is not None and far(one, other)):
            yield f"NRMSE {kind}: {one} in the page, {other} by the program"
    if here["fitted_on"] != there["fitted_on"]:
        yield "other recordings were fitted"


def largest_difference(here, there):
    pairs = [(p["value"], q["value"]) for p, q in zip(here["parameters"], there["parameters"])]
    pairs += [(here["nrmse"][k], there["nrmse"][k]) for k in ("fit", "heldout") if here["nrmse"].get(k)]
    return max(abs(p - q) / max(abs(p), abs(q), 1e-300) for p, q in pairs)


def drawn(browser):
    """Whether the script of the report in its frame came to its end, waited for, and its links stay in it."""
    report = "document.getElementById('report').contentDocument"
    end = time.monotonic() + 60
    while time.monotonic() < end:
        if browser.run(f"{report}?.documentElement.dataset.ready === 'true'"):
            browser.run(f"{report}.querySelector('nav a').click()")
            browser.settle()
            return browser.run(f"{report}.querySelectorAll('.u-wrap canvas').length > 0")
        time.sleep(0.3)
    return False


def looks(browser, page, pictures, width, name):
    """Complaints about how the page stands at a width."""
    browser.call("Emulation.setDeviceMetricsOverride", {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False})
    browser.settle()
    reach = browser.run("document.documentElement.scrollWidth")
    if pictures:
        browser.screenshot(pictures / f"browser-{name}.png")
    if reach > width:
        yield f"{name}: the page is {reach} px wide, expected {width}"


def troubles(browser):
    for event in browser.events:
        if event["method"] == "Runtime.exceptionThrown":
            yield "script error: " + event["params"]["exceptionDetails"].get("text", "")
        if event["method"] == "Log.entryAdded" and event["params"]["entry"]["level"] == "error":
            yield "console: " + event["params"]["entry"]["text"]
        if event["method"] == "Network.requestWillBeSent":
            url = event["params"]["request"]["url"]
            if not url.startswith(("file:", "blob:", "data:")):
                yield "request for " + url


def check(hysteron, browser, page, pictures, scratch, diagnoses):
    root = pathlib.Path(__file__).resolve().parent.parent
    recordings = scratch / "recordings"
    recordings.mkdir()
    for file in sorted((root / "datasets" / "utfsm-mr-damper").glob("*_0.[05]*A.csv")):
        (recordings / file.name).write_bytes(file.read_bytes())
    strange = scratch / "strange.mat"
    strange.write_bytes(b"MATLAB")
    empty = scratch / "empty.csv"
    empty.write_text("time [s],displacement [mm],force [N]\n")

    browser.open(page, 1280, 900)
    until(browser, lambda s: not s["busy"], 60)
    browser.run("new Promise((done) => { const t = setInterval(() => { if (document.documentElement.dataset.ready) { clearInterval(t); done(0); } }, 100); })")
    yield from looks(browser, page, pictures, 1280, "empty")
    for file, word in ((strange, "by the program"), (empty, "empty.csv")):
        said = drop(browser, [file])["error"]
        if word not in said or "\n" in said:
            yield f"{file.name}: '{said}' is said, expected one line with '{word}'"
        browser.run("document.getElementById('clear').click()")
        until(browser, lambda s: not s["busy"], 60)

    said = drop(browser, sorted(recordings.iterdir()))
    if said["error"]:
        yield "recordings: " + said["error"]
        return
    results, seconds = worked(browser, "fit", {"model": "bouc-wen", "laws": "alpha:1,c0:1", "budget": 20000}, 600)
    if not drawn(browser):
        yield "the report does not draw itself in its frame"
    for width, name in ((1280, "wide"), (PHONE, "phone")):
        yield from looks(browser, page, pictures, width, name)
    native = natively(hysteron, "fit", recordings, ["--model", "bouc-wen", "--by-current", "alpha:1,c0:1"], scratch / "out")
    here = json.loads(results["model.json"])
    there = json.loads((scratch / "out" / "model.json").read_text())
    yield from differences(here, there)
    if "report-data" not in results["report.html"]:
        yield "the report is no report"
    print(f"fit of {len(list(recordings.iterdir()))} recordings: NRMSE {here['nrmse']['fit']:.6g}, by the program "
          f"{there['nrmse']['fit']:.6g}; largest relative difference {largest_difference(here, there):.1e}; "
          f"{seconds:.1f} s, the program on one thread {native['wall_seconds']:.1f} s")
    if diagnoses:
        yield from check_diagnosis(hysteron, browser, pictures, scratch)
    yield from troubles(browser)


def check_diagnosis(hysteron, browser, pictures, scratch):
    twin = scratch / "twin" / "recordings"
    subprocess.run([hysteron, "generate", "rd8040-twin", "--only", "2.0Hz", "--out", str(twin)], check=True,
                   stdout=subprocess.DEVNULL)
    browser.run("document.getElementById('clear').click()")
    until(browser, lambda s: not s["busy"], 60)
    drop(browser, sorted(twin.iterdir()))
    results, seconds = worked(browser, "diagnose", {"model": "bouc-wen", "laws": "alpha:1,c0:1"}, 3600)
    yield from looks(browser, None, pictures, 1280, "diagnosis")
    native = natively(hysteron, "diagnose", twin, ["--model", "bouc-wen", "--by-current", "alpha:1,c0:1"], scratch / "diagnosis")
    here = json.loads(results["diagnosis.json"])
    there = json.loads((scratch / "diagnosis" / "diagnosis.json").read_text())
    named = lambda said: (said["verdict"], [(e["id"], e["grade"]) for e in said["effects"] + said["suggestions"]])
    if named(here) != named(there):
        yield f"diagnosis: {named(here)} in the page, {named(there)} by the program"
    print(f"diagnosis of {len(list(twin.iterdir()))} recordings: {named(here)}; {seconds:.1f} s, the program on one thread "
          f"{native['wall_seconds']:.1f} s")


def main():
    diagnoses = "--diagnose" in sys.argv
    words = [word for word in sys.argv[1:] if word != "--diagnose"]
    if len(words) not in (1, 2, 3):
        print("usage: check_browser.py [--diagnose] HYSTERON [PAGE [SCREENSHOTS]]", file=sys.stderr)
        return 2
    page = pathlib.Path(words[1] if len(words) > 1 else "build/browser/hysteron.html")
    if not page.exists():
        print(f"skipped: there is no {page}, scripts/browser.sh makes it", file=sys.stderr)
        return 77
    chromium = find()
    if chromium is None:
        print("skipped: the page is not used, Chromium is not installed (apt-get install chromium)", file=sys.stderr)
        return 77
    pictures = pathlib.Path(words[2]) if len(words) > 2 else None
    if pictures:
        pictures.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch, Browser(chromium, seconds=120) as browser:
        try:
            complaints = list(check(os.path.abspath(words[0]), browser, page, pictures, pathlib.Path(scratch), diagnoses))
        except (BrowserError, subprocess.CalledProcessError) as error:
            complaints = [str(error)]
    for complaint in complaints:
        print(complaint, file=sys.stderr)
    if not complaints:
        print("ok: the page fits as the program does")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
