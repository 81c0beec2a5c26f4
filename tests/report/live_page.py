# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi watch: the page of a run that goes on, for nobody but who has its address, and nothing but
that run folder."""
import gzip
import http.client
import json
import re
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path
from unittest import mock

import browser
from magfsi import runs, testing
from magfsi.report import fields
from magfsi.report.growing import GrowingTable


def watched(folder):
    """The process, its port and its token."""
    process = subprocess.Popen([sys.executable, "-P", "-m", "magfsi.watch", str(folder)],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               # A shell has its background jobs ignore it.
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    line = process.stdout.readline()
    found = re.search(r"http://127\.0\.0\.1:(\d+)/([\w-]+)/", line)
    if not found:
        raise AssertionError(line + process.communicate()[1])
    return process, int(found[1]), found[2]


def ask(port, path, method="GET", host=None):
    # The watcher yields to what else runs here: how long an answer takes says nothing.
    connection = http.client.HTTPConnection("127.0.0.1", port)
    connection.putrequest(method, path, skip_host=True)
    connection.putheader("Host", f"127.0.0.1:{port}" if host is None else host)
    connection.endheaders()
    answer = connection.getresponse()
    body = answer.read()
    connection.close()
    return answer.status, body, answer


class Watched(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = testing.good_run(testing.SMALL, {"time.end": "1 ms",
                                                    "output.structure.every": "0.5 ms"})
        cls.folder = Path(cls.run_.folder)
        (cls.folder.parent / "secret").write_text("not for you")
        (cls.folder / "link").symlink_to(cls.folder.parent / "secret")
        (cls.folder / "linked").symlink_to(cls.folder.parent)
        cls.process, cls.port, cls.token = watched(cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.process.send_signal(signal.SIGINT)
        cls.process.communicate(timeout=60)
        (cls.folder.parent / "secret").unlink()

    def get(self, path, **more):
        return ask(self.port, f"/{self.token}/{path}", **more)

    def test_page_data_and_files(self):
        status, body, _ = self.get("")
        self.assertEqual(status, 200)
        self.assertIn(b'"live": true', body)
        status, body, answer = self.get("data.json")
        shown = json.loads(gzip.decompress(body))[0]
        self.assertEqual((status, shown["name"], shown["ended"]), (200, "small_swimmer", True))
        self.assertEqual(len(shown["bodies"]["times"]), 3)
        self.assertEqual(self.get(f"data.json?known={answer.getheader('ETag')}")[0], 204)
        status, body, answer = self.get("files/probes.csv")
        self.assertEqual((status, body), (200, (self.folder / "probes.csv").read_bytes()))
        self.assertEqual(answer.getheader("Content-Disposition"), "attachment")
        self.assertEqual(self.get("files/fields/structure_000000.vtu")[0], 200)

    def test_paths_outside_are_refused(self):
        for path in ("files/../secret", "files/%2e%2e/secret", "files/..%2fsecret", "files/link",
                     "files/linked/secret", f"files/{self.folder.parent}/secret", "files//etc/passwd",
                     "files/fields", "files/", "files/./probes.csv", "files/a%00b", "../secret",
                     "secret", "run.lock", "files/" + "x/" * 3000):
            status, body, _ = self.get(path)
            self.assertIn(status, (403, 404), path)
            self.assertNotIn(b"not for you", body)

    def test_without_the_token_there_is_nothing(self):
        for path in ("/", "/data.json", "/files/probes.csv", f"/{self.token[:-1]}/", "/x" + self.token,
                     f"/{self.token}x/data.json", f"//{self.token}x/", f"/{self.token.lower()}x/"):
            self.assertEqual(ask(self.port, path)[0], 403, path)

    def test_other_methods_are_refused_and_change_nothing(self):
        before = sorted((p.name, p.lstat().st_mtime_ns) for p in self.folder.iterdir())
        for method in ("POST", "PUT", "DELETE", "PATCH", "OPTIONS", "HEAD", "TRACE", "CONNECT"):
            self.assertEqual(self.get("files/probes.csv", method=method)[0], 405, method)
        self.assertEqual(self.get("", method="MKCOL")[0], 501)
        self.assertEqual(sorted((p.name, p.lstat().st_mtime_ns) for p in self.folder.iterdir()), before)

    def test_other_hosts_are_refused(self):
        """A page elsewhere whose name leads to the loopback sends its own name."""
        for host in ("evil.example", f"evil.example:{self.port}", "127.0.0.1.evil.example", "",
                     "0.0.0.0", "localhost.evil.example:80", "127.0.0.1:80:80"):
            self.assertEqual(self.get("data.json", host=host)[0], 403, host)
        for host in ("localhost:8000", "127.0.0.1:1", "[::1]:8000", "LOCALHOST"):  # SSH's other end
            self.assertEqual(self.get("", host=host)[0], 200, host)

    def test_only_the_loopback_listens(self):
        table = Path("/proc/net/tcp").read_text().splitlines()[1:]
        mine = [line.split()[1] for line in table if line.split()[1].endswith(f":{self.port:04X}")
                and line.split()[3] == "0A"]
        self.assertEqual(mine, [f"0100007F:{self.port:04X}"])

    def test_what_is_no_run(self):
        done = subprocess.run([sys.executable, "-P", "-m", "magfsi.watch", testing.new_folder()],
                              capture_output=True, text=True)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (runs.EXIT_INPUT, 1))


class Frames(unittest.TestCase):
    def test_of_a_run_that_grows_are_read_once(self):
        """With frames evenly spread over those that are there, each new one would change all."""
        fields.remember_frames()  # in this process nothing else reads frames
        read = set()
        for count in range(1, 2000):
            shown = fields.chosen(list(range(count)), 100)
            self.assertLessEqual(len(shown), 100)
            self.assertEqual((shown[0], shown[-1]), (0, count - 1))
            self.assertLessEqual(len(set(shown) - read), 1)
            read.update(shown)

    def test_that_are_more_than_can_be_read_come_with_the_next_answers(self):
        """By a clock that goes on by a tenth of the time there is with each frame."""
        fields.remember_frames()
        now, made = [0.0], []

        def make(files):
            now[0] += fields.READING_S / 10
            made.append(files[0])
            return files[0]
        frames = [(n, [f"frame {n}"]) for n in range(45)]
        with mock.patch.object(fields.time, "monotonic", lambda: now[0]):
            counts, left = [], True
            while left:
                found = fields.read(frames, ("body",), make)
                self.assertEqual(found[-1], (frames[-1], "frame 44"))
                self.assertEqual(found, sorted(found))
                counts.append(len(found))
                left = fields.some_left()
        testing.report(f"frames in the answers: {counts}")
        self.assertEqual(counts[-1], 45)
        self.assertEqual(len(made), 45)
        self.assertLessEqual(max(b - a for a, b in zip([0, *counts], counts)), 12)


class Rows(unittest.TestCase):
    def test_of_a_table_that_grows_are_read_once(self):
        """Cut anywhere, also within a row."""
        text = "# of a test\nt[s],x[m]\n" + "".join(f"{n / 4},{n * n}\n" for n in range(50))
        path = Path(testing.new_folder()) / "probes.csv"
        table = GrowingTable(path)
        self.assertEqual(table.read(), {})
        path.write_text("")
        for end in range(0, len(text) + 1, 7):
            with path.open("a") as file:
                file.write(text[path.stat().st_size:end])
            rows = [line for line in text[:end].split("\n")[:-1] if line[0] not in "#t"]
            found = table.read()
            self.assertEqual([f"{t},{x:.0f}" for t, x in zip(found.get("t[s]", []), found.get("x[m]", []))],
                             rows)
            self.assertEqual(table.offset, text.rfind("\n", 0, end) + 1)
        with path.open("a") as file:
            file.write(text[path.stat().st_size:])
        self.assertEqual({name: list(values) for name, values in table.read().items()},
                         runs.read_table(path, float))
        path.write_text(text[:text.index("\n", 60) + 1])  # by a run that goes on from a checkpoint
        self.assertEqual({name: list(values) for name, values in table.read().items()},
                         runs.read_table(path, float))


class WhileItRuns(unittest.TestCase):
    def test_grows_and_ends(self):
        process, folder = testing.get_going(
            # Without weight, which would take it to the bottom while the page is looked at.
            testing.SMALL, {"time.end": "20 s", "gravity": "", "coupling.overlap": "allow",
                            "output.structure.every": "1 ms"})
        try:
            watcher, port, token = watched(folder)
            try:
                self.follow(process, port, token)
            finally:
                watcher.send_signal(signal.SIGINT)
                watcher.communicate(timeout=60)
        finally:
            process.send_signal(signal.SIGTERM)
            process.communicate(timeout=120)

    def follow(self, process, port, token):
        def frames():
            status, body, _ = ask(port, f"/{token}/data.json")
            run = json.loads(gzip.decompress(body))[0] if status == 200 else {}
            return len((run.get("bodies") or {}).get("times", [])), run

        first, run = frames()
        self.assertIn("running", run["progress"] or "")
        self.assertFalse(run["ended"])
        self.assertTrue(testing.wait_until(lambda: frames()[0] > first + 2, process, step_s=0.2))
        self.assertRegex(frames()[1]["progress"] or "", r"running: \d+ %, .* left")
        if testing.has("chromium"):
            self.look(process, f"http://127.0.0.1:{port}/{token}/")
        process.send_signal(signal.SIGTERM)
        process.wait()
        self.assertTrue(frames()[1]["ended"])

    def look(self, process, address):
        """In a browser: it draws itself anew while the run goes on, and no error is in the console."""
        with browser.Browser() as chromium:
            chromium.open(address)

            def updates():
                return int(chromium.run("document.getElementById('title').dataset.updates || 0"))

            self.assertTrue(testing.wait_until(lambda: updates() > 1, process, step_s=0.2))
            self.assertGreater(chromium.run("magfsi.view.shapes[0].bodies.times.length"), 2)
            self.assertIn("running", chromium.run("document.getElementById('outcome').textContent"))
            self.assertEqual(chromium.errors(), [])


if __name__ == "__main__":
    unittest.main()
