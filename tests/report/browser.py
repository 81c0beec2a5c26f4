# SPDX-License-Identifier: GPL-2.0-or-later
"""A headless Chromium for tests, driven over two pipes (--remote-debugging-pipe of the DevTools
protocol: JSON messages that end with a zero byte), so that no library for sockets is needed."""
import base64
import json
import os
import select
import subprocess
import time
from pathlib import Path

from magfsi import testing


class Browser:
    def __init__(self, *more):
        to_read, self.to = os.pipe()
        self.source, to_write = os.pipe()

        def descriptors():  # the browser's 3 and 4, whatever numbers they have here
            first, second = os.dup(to_read), os.dup(to_write)
            os.dup2(first, 3)
            os.dup2(second, 4)

        self.process = subprocess.Popen(
            ["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run",
             "--hide-scrollbars", "--remote-debugging-pipe", *more,
             f"--user-data-dir={testing.new_folder()}", "about:blank"],
            preexec_fn=descriptors, close_fds=False, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL)
        os.close(to_read)
        os.close(to_write)
        self.numbers, self.pending, self.events = 0, b"", []
        target = self("Target.createTarget", url="about:blank")["targetId"]
        self.session = None
        self.session = self("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self(f"{domain}.enable")
        self("Page.setLifecycleEventsEnabled", enabled=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self.to)
        self.process.terminate()
        self.process.wait(timeout=30)
        os.close(self.source)

    def _message(self, until):
        while b"\0" not in self.pending:
            left = until - time.monotonic()
            if left <= 0 or not select.select([self.source], [], [], left)[0]:
                raise AssertionError("the browser did not answer in time")
            more = os.read(self.source, 1 << 20)
            if not more:
                raise AssertionError("the browser has ended")
            self.pending += more
        line, _, self.pending = self.pending.partition(b"\0")
        return json.loads(line)

    def __call__(self, method, limit_s=120, **parameters):
        self.numbers += 1
        message = {"id": self.numbers, "method": method, "params": parameters}
        if getattr(self, "session", None):
            message["sessionId"] = self.session
        os.write(self.to, json.dumps(message).encode() + b"\0")
        until = time.monotonic() + limit_s
        while True:
            answer = self._message(until)
            if answer.get("id") == self.numbers:
                if "error" in answer:
                    raise AssertionError(f"{method}: {answer['error']}")
                return answer["result"]
            if "method" in answer:
                self.events.append(answer)

    def load(self, address, limit_s=60):
        """Waits for this very page: events of the one before may still come."""
        loader = self("Page.navigate", url=address)["loaderId"]
        until = time.monotonic() + limit_s
        while not any(event["method"] == "Page.lifecycleEvent" and
                      event["params"]["loaderId"] == loader and event["params"]["name"] == "load"
                      for event in self.events):
            message = self._message(until)
            if "method" in message:
                self.events.append(message)

    def open(self, address, width=1400, height=1000, dark=False, limit_s=60):
        """Returns seconds until the page is loaded, its scripts have run and it is drawn."""
        self("Emulation.setDeviceMetricsOverride", width=width, height=height,
             deviceScaleFactor=1, mobile=False)
        self("Emulation.setEmulatedMedia", features=[
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        self.load("about:blank")  # or another time of the same page would load nothing
        self.events = []
        began = time.monotonic()
        self.load(address, limit_s)
        self.run("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
        return time.monotonic() - began

    def run(self, expression):
        """The value of an expression, or of what it promises."""
        done = self("Runtime.evaluate", expression=expression, awaitPromise=True,
                    returnByValue=True)
        if "exceptionDetails" in done:
            raise AssertionError(f"{expression}: {done['exceptionDetails']}")
        return done["result"].get("value")

    def processor_s(self):
        """Seconds of a processor that all of its processes have had."""
        ticks, to_see = 0, [self.process.pid]
        for pid in to_see:
            try:
                words = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
                for task in os.listdir(f"/proc/{pid}/task"):
                    to_see += map(int, Path(f"/proc/{pid}/task/{task}/children").read_text().split())
            except FileNotFoundError:
                continue  # ended meanwhile
            ticks += int(words[11]) + int(words[12])
        return ticks / os.sysconf("SC_CLK_TCK")

    def errors(self):
        """What the console has had of errors and warnings since the page was opened."""
        found = []
        for event in self.events:
            parameters = event["params"]
            if event["method"] == "Runtime.exceptionThrown":
                found.append(str(parameters["exceptionDetails"]))
            elif event["method"] == "Log.entryAdded":
                found.append(parameters["entry"]["text"])
            elif event["method"] == "Runtime.consoleAPICalled" and \
                    parameters["type"] in ("error", "warning", "assert"):
                found.append(str(parameters["args"]))
        return found

    def picture(self, file=None, whole=False):
        """A PNG of what is to be seen, or of the whole page."""
        data = base64.b64decode(self("Page.captureScreenshot", format="png",
                                     captureBeyondViewport=whole)["data"])
        if file:
            with open(file, "wb") as out:
                out.write(data)
        return data
