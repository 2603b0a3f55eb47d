"""Headless Chromium driven over a pipe with its own DevTools protocol: nothing but Python's standard library.

Used by check_reports.py and make_picture.py.
"""
import base64
import fcntl
import json
import os
import select
import shutil
import subprocess
import tempfile
import time


class BrowserError(Exception):
    """The browser did not start, answer or finish; or a script in the page threw."""


def find():
    """Path of a Chromium, $CHROMIUM first; None where there is none."""
    for name in (os.environ.get("CHROMIUM"), "chromium", "chromium-browser", "google-chrome"):
        if name and shutil.which(name):
            return shutil.which(name)
    return None


class Browser:
    """One headless browser with one page. Use as a context manager."""

    def __init__(self, program, seconds=60):
        self.seconds = seconds  # the longest wait for any answer
        self.profile = tempfile.mkdtemp(prefix="hysteron-chromium-")
        to_browser, self.writing = os.pipe()
        self.reading, from_browser = os.pipe()
        # The browser reads commands from file 3 and answers on file 4; copies above 9 cannot collide with those two.
        ends = [fcntl.fcntl(end, fcntl.F_DUPFD, 10) for end in (to_browser, from_browser)]

        def place_pipe():
            os.dup2(ends[0], 3)
            os.dup2(ends[1], 4)

        arguments = [program, "--headless", "--remote-debugging-pipe", "--disable-gpu", "--no-first-run",
                     "--disable-background-networking", "--disable-component-update", "--disable-sync",
                     "--hide-scrollbars", f"--user-data-dir={self.profile}", "about:blank"]
        if os.geteuid() == 0:
            arguments.insert(1, "--no-sandbox")  # Chromium refuses to sandbox itself as root
        self.log = open(os.path.join(self.profile, "log"), "wb")
        self.process = subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stdout=self.log, stderr=self.log,
                                        preexec_fn=place_pipe, close_fds=False)
        for end in (to_browser, from_browser, *ends):
            os.close(end)
        self.buffer = b""
        self.last = 0
        self.events = []
        target = self.call("Target.createTarget", {"url": "about:blank"}, session=None)["targetId"]
        self.session = self.call("Target.attachToTarget", {"targetId": target, "flatten": True}, session=None)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        for end in (self.writing, self.reading):
            os.close(end)  # the browser ends when its pipe does
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.log.close()
        shutil.rmtree(self.profile, ignore_errors=True)

    def message(self, until):
        """The next message of the browser."""
        while b"\0" not in self.buffer:
            if not select.select([self.reading], [], [], max(0.0, until - time.monotonic()))[0]:
                raise BrowserError(f"no answer within {self.seconds} s")
            part = os.read(self.reading, 1 << 20)
            if not part:
                with open(os.path.join(self.profile, "log"), encoding="utf-8", errors="replace") as log:
                    raise BrowserError("the browser ended: " + " ".join(log.read().split("\n")[-4:]))
            self.buffer += part
        text, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, parameters=None, session=""):
        """The result of a protocol method; events that come meanwhile are kept in `events`."""
        self.last += 1
        command = {"id": self.last, "method": method, "params": parameters or {}}
        if session is not None:
            command["sessionId"] = session or self.session
        data = json.dumps(command).encode() + b"\0"
        while data:
            data = data[os.write(self.writing, data):]
        until = time.monotonic() + self.seconds
        while True:
            answer = self.message(until)
            if answer.get("id") == self.last:
                if "error" in answer:
                    raise BrowserError(f"{method}: {answer['error'].get('message')}")
                return answer["result"]
            if "method" in answer:
                self.events.append(answer)

    def open(self, path, width, height, dark=False, scale=1, mobile=False):
        """Loads a local file at a viewport of CSS pixels; `events` then holds what happened since."""
        self.events = []
        self.call("Emulation.setDeviceMetricsOverride",
                  {"width": width, "height": height, "deviceScaleFactor": scale, "mobile": mobile})
        self.call("Emulation.setEmulatedMedia",
                  {"features": [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]})
        self.call("Page.navigate", {"url": "file://" + os.path.abspath(path)})
        until = time.monotonic() + self.seconds
        while not any(event["method"] == "Page.loadEventFired" for event in self.events):
            event = self.message(until)
            if "method" in event:
                self.events.append(event)
        self.settle()

    def settle(self):
        """Waits until the page has drawn what it was asked to."""
        self.run("new Promise(done => setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(() => done(0))), 150))")

    def run(self, script):
        """The value of a JavaScript expression in the page, awaited where it is a promise."""
        answer = self.call("Runtime.evaluate", {"expression": script, "awaitPromise": True, "returnByValue": True})
        if "exceptionDetails" in answer:
            details = answer["exceptionDetails"]
            raise BrowserError(details.get("exception", {}).get("description") or details.get("text"))
        return answer["result"].get("value")

    def screenshot(self, path, clip=None):
        """Writes a PNG of the whole page, or of `clip`: x, y, width, height in CSS pixels of the page."""
        if clip is None:
            size = self.call("Page.getLayoutMetrics")["cssContentSize"]
            clip = {"x": 0, "y": 0, "width": size["width"], "height": size["height"]}
        data = self.call("Page.captureScreenshot",
                         {"format": "png", "captureBeyondViewport": True, "clip": {**clip, "scale": 1}})["data"]
        with open(path, "wb") as file:
            file.write(base64.b64decode(data))
