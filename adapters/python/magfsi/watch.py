# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi watch [RUN] [--port N]: the page of a run while it goes on, on this machine's loopback.

Read-only: GET of the page, of its data, and of files of that run folder; all else is refused. The
address has a token; whoever does not know it gets nothing. By SSH from another machine:

    ssh -L 8000:127.0.0.1:PORT MACHINE        and open http://127.0.0.1:8000/TOKEN/
"""
import argparse
import datetime
import gzip
import hmac
import http.server
import os
import secrets
import stat
import sys
import threading
import time
import urllib.parse
from pathlib import Path

from magfsi import runs
from magfsi.report import data, fields, page
from magfsi.report.growing import GrowingTable

ROOM = 4e6  # bytes of fields in an answer: it may come through SSH
LOOPBACK = ("127.0.0.1", "localhost", "[::1]")
MOST_PATH = 4096


def newest_run():
    """Of those below runs/."""
    found = sorted(Path("runs").glob("*/run.json"), key=lambda file: file.stat().st_mtime)
    if not found:
        raise data.NotARun("found no run below runs/; allowed is the folder of a run")
    return found[-1].parent


def open_inside(folder, path):
    """A descriptor of a regular file below the folder, through no link. Raises OSError."""
    parts = path.split("/")
    if any(part in ("", ".", "..") or "\0" in part for part in parts):
        raise FileNotFoundError(path)
    here = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        for part in parts[:-1]:
            below = os.open(part, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW, dir_fd=here)
            os.close(here)
            here = below
        file = os.open(parts[-1], os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK, dir_fd=here)
    finally:
        os.close(here)
    if not stat.S_ISREG(os.fstat(file).st_mode):
        os.close(file)
        raise FileNotFoundError(path)
    return file


def left_in_words(seconds):
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"


class Source:
    """The run as the page wants it, read anew when its files have changed."""

    def __init__(self, folder):
        self.folder, self.lock = folder, threading.Lock()
        self.known, self.text = None, b""
        self.begin_anew(None)

    def begin_anew(self, start):
        """With what a start of the run has written: another start may write the same files again."""
        self.start = start
        self.first_seen = None  # (time of the clock, time of the scene)
        self.table = GrowingTable(self.folder / "probes.csv")
        fields.remember_frames()

    def fingerprint(self):
        parts = []
        for name in ("run.json", "probes.csv", "structure.pvd", "fluid.pvd", "summary.json"):
            try:
                found = (self.folder / name).stat()
                parts.append(f"{found.st_mtime_ns:x}.{found.st_size:x}")
            except OSError:
                parts.append("-")
        return "_".join(parts)

    def progress(self, run, columns):
        if run["outcome"] != "not ended" or not run["end"]:
            return None
        reached = max([part["times"][-1] for part in (run["bodies"], run["flow"]) if part] +
                      [(columns.get("t[s]") or [0.0])[-1]])
        now, share = time.time(), reached / run["end"]
        begun = datetime.datetime.fromisoformat(run["begun"].replace("Z", "+00:00")).timestamp()
        self.first_seen = self.first_seen or (now, reached)
        since, at = self.first_seen
        if reached <= at:  # nothing seen yet: as fast as since its begin
            since, at = begun, 0.0
        text = f"running: {100 * share:.0f} %"
        if not run["load"]:  # the time of equilibria is none
            text += f", {reached:.4g} of {run['end']:.4g} s"
        if reached > at:
            text += f", {left_in_words((run['end'] - reached) * (now - since) / (reached - at))} left"
        return text

    def now(self):
        """(fingerprint, JSON, compressed)"""
        with self.lock:
            print_ = self.fingerprint()
            if print_ != self.known:
                start = print_.partition("_")[0]  # that of run.json
                if start != self.start:
                    self.begin_anew(start)
                columns = self.table.read()
                run = data.read_run(self.folder, ROOM, columns, surfaces=False)
                run["progress"] = self.progress(run, columns)
                run["ended"] = run["outcome"] != "not ended"
                self.text = gzip.compress(page.as_json([run]).encode(), 1)
                # With frames left to the next answer, that is another one even if no file changes.
                self.known = None if fields.some_left() else print_
            return print_, self.text


class Handler(http.server.BaseHTTPRequestHandler):
    server_version, sys_version, protocol_version = "magfsi", "", "HTTP/1.1"
    timeout = 60
    source, token, page = None, "", b""

    def answer(self, code, body=b"", kind="text/plain; charset=utf-8", **more):
        self.send_response(code)
        for name, value in {"Content-Type": kind, "Content-Length": str(len(body)),
                            "Cache-Control": "no-store", "X-Content-Type-Options": "nosniff",
                            "Referrer-Policy": "no-referrer", "X-Frame-Options": "DENY",
                            "Cross-Origin-Resource-Policy": "same-origin", **more}.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)

    def refused(self):
        """Whether it was: a page of another host that leads here by its name (DNS rebinding), or
        who lacks the token."""
        host = self.headers.get("Host", "").rsplit(":", 1)
        name = host[0] if len(host) == 1 or host[1].isdigit() else ":".join(host)
        if name.lower() not in LOOPBACK:
            self.answer(403, b"this is only for the loopback address\n")
            return True
        given = urllib.parse.urlsplit(self.path).path.lstrip("/").partition("/")[0]
        if len(self.path) > MOST_PATH or not hmac.compare_digest(given.encode(), self.token.encode()):
            self.answer(403, b"the address lacks the token that magfsi watch has printed\n")
            return True
        return False

    def do_GET(self):
        if self.refused():
            return
        address = urllib.parse.urlsplit(self.path)
        path = urllib.parse.unquote(address.path).lstrip("/").partition("/")[2]
        if path == "":
            self.answer(200, self.page, "text/html; charset=utf-8")
        elif path == "data.json":
            self.send_data(urllib.parse.parse_qs(address.query).get("known", [""])[0])
        elif path.startswith("files/"):
            self.send_file(path.removeprefix("files/"))
        else:
            self.answer(404, b"nothing of this name\n")

    def send_data(self, known):
        if known and known == self.source.fingerprint() == self.source.known:
            return self.answer(204)
        try:
            fingerprint, text = self.source.now()
        except (data.NotARun, OSError, ValueError, AttributeError, KeyError):
            return self.answer(204)  # files that are being written or moved: the next time
        self.answer(200, text, "application/json", **{"Content-Encoding": "gzip",
                                                      "ETag": fingerprint})

    def send_file(self, path):
        try:
            with os.fdopen(open_inside(self.source.folder, path), "rb") as file:
                body = file.read()
        except (OSError, ValueError):
            return self.answer(404, b"no such file in the run folder\n")
        # Never shown as a page of this address.
        self.answer(200, body, "application/octet-stream", **{"Content-Disposition": "attachment"})

    def other(self):
        self.close_connection = True
        if not self.refused():
            self.answer(405, b"only GET\n", Allow="GET", Connection="close")

    do_HEAD = do_POST = do_PUT = do_DELETE = do_PATCH = do_OPTIONS = do_TRACE = do_CONNECT = other

    def log_message(self, *_):
        pass


def serve(folder, port):
    """The server, not yet running, and its address."""
    token = secrets.token_urlsafe(24)
    name = data.read_json(folder / "scene.json", {}).get("name", folder.name)
    handler = type("Bound", (Handler,), {"source": Source(folder), "token": token,
                                         "page": page.live(str(name)).encode()})
    server = http.server.ThreadingHTTPServer(("127.0.0.1", port), handler)
    server.daemon_threads = True
    return server, f"http://127.0.0.1:{server.server_port}/{token}/"


def main():
    options = argparse.ArgumentParser(prog="magfsi watch", description=__doc__.splitlines()[0])
    options.add_argument("run", nargs="?", type=Path, metavar="RUN",
                         help="run folder (default: the newest below runs/)")
    options.add_argument("--port", type=int, default=0, help="of the loopback (default: a free one)")
    chosen = options.parse_args()
    try:
        folder = (chosen.run or newest_run()).resolve()
        if not (folder / "scene.json").is_file():
            raise data.NotARun(f"{folder}: found no scene.json; allowed are folders that "
                               "./magfsi run has written")
        os.nice(10)  # the run goes first
        server, address = serve(folder, chosen.port)
    except (data.NotARun, OSError, OverflowError) as error:
        print(f"magfsi watch: {error}", file=sys.stderr)
        return runs.EXIT_INPUT
    print(f"{folder.name}: {address}\n(Ctrl-C ends it; from another machine: "
          f"ssh -L {server.server_port}:127.0.0.1:{server.server_port} HERE)", flush=True)
    try:
        server.serve_forever()
    except KeyboardInterrupt:
        pass
    return 0


if __name__ == "__main__":
    sys.exit(main())
