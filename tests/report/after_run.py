# SPDX-License-Identifier: GPL-2.0-or-later
"""A page after each run of a person, who starts it by ./magfsi run (MAGFSI_PAGE=yes): none with
`report: off`, with --no-report, or for tests and searches; the run does not wait for it."""
import json
import os
import subprocess
import time
import unittest
from pathlib import Path

from magfsi import runs, testing

BEAM = testing.ROOT / "tutorials/beam"
SHORT = {"time.end": "50 ms", "output.structure.every": "25 ms"}


# No more processes once a file is there.
NO_FORK = """
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdlib.h>
#include <unistd.h>
int fork(void) {
    if (access(getenv("NONE_AFTER"), F_OK) != 0) return ((int (*)(void))dlsym(RTLD_NEXT, "fork"))();
    errno = EAGAIN;
    return -1;
}
"""


def by_a_person(folder, settings=None, more=(), **environment):
    words = [str(word) for word in runs.run_command(BEAM, folder, {**SHORT, **(settings or {})},
                                                    more=more)]
    return subprocess.run(words, capture_output=True, text=True,
                          env={**os.environ, "MAGFSI_PAGE": "yes", **environment})


def came(file, limit_s=600):  # behind all else on the machine
    until = time.monotonic() + limit_s
    while not file.exists() and time.monotonic() < until:
        time.sleep(0.1)
    return file.exists()


class Page(unittest.TestCase):
    def test_it_is_written_when_the_run_has_ended(self):
        folder = Path(testing.new_folder())
        done = by_a_person(folder, MAGFSI_COMMIT="1a2b3c-dirty")
        self.assertEqual(done.returncode, 0, done.stderr)
        versions = json.loads((folder / "run.json").read_text())[-1]["versions"]
        self.assertEqual(versions["commit"], "1a2b3c-dirty")
        self.assertIn("report.html is being written", done.stdout)
        self.assertTrue(came(folder / "report.html"))
        self.assertIn("</html>", (folder / "report.html").read_text())  # whole, as it is renamed
        self.assertEqual(list(folder.glob("*.tmp")), [])
        # The next run sets it aside with the results that it shows.
        self.assertEqual(by_a_person(folder, more=("--no-report",)).returncode, 0)
        self.assertTrue((folder / "earlier-1/report.html").exists())
        self.assertFalse((folder / "report.html").exists())

    def test_no_process_for_it_is_said_and_is_no_fault_of_the_run(self):
        folder, library = Path(testing.new_folder()), Path(testing.new_folder()) / "no_fork.so"
        subprocess.run(["cc", "-shared", "-fPIC", "-x", "c", "-", "-o", library], input=NO_FORK, text=True,
                       check=True)
        done = by_a_person(folder, LD_PRELOAD=str(library), NONE_AFTER=str(folder / "summary.json"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("is being written", done.stdout)
        self.assertEqual(done.stderr.count("warning: no page is written"), 1, done.stderr)
        self.assertIn(f"./magfsi report {folder}", done.stderr)

    def test_of_a_run_that_diverged(self):
        folder = Path(testing.new_folder())
        done = subprocess.run(
            [str(w) for w in runs.run_command(testing.SMALL, folder,
                                              {"magnetic_field.constant.magnitude": "9 T"})],
            capture_output=True, text=True, env={**os.environ, "MAGFSI_PAGE": "yes"})
        self.assertEqual(done.returncode, 3)
        self.assertTrue(came(folder / "report.html"))

    def test_not_where_it_is_not_wanted(self):
        for settings, more, page in (({"report": "off"}, (), "yes"), ({}, ("--no-report",), "yes"),
                                     ({}, (), "no")):
            folder = Path(testing.new_folder())
            words = [str(w) for w in runs.run_command(BEAM, folder, {**SHORT, **settings}, more=more)]
            done = subprocess.run(words, capture_output=True, text=True,
                                  env={**os.environ, "MAGFSI_PAGE": page})
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotIn("is being written", done.stdout)
            self.assertFalse((folder / "report.html").exists())

    def test_the_launcher_asks_for_it_and_nothing_else_does(self):
        launcher = (testing.ROOT / "adapters/app/launcher/commands.bash").read_text()
        self.assertEqual(launcher.count("MAGFSI_PAGE"), 2)  # set once, where the word is run
        self.assertIn("export MAGFSI_PAGE=${MAGFSI_PAGE:-yes}", launcher)

    def test_a_report_of_a_run_that_was_replaced_is_dropped(self):
        from magfsi.report import data
        from magfsi.report.__main__ import write
        run = testing.good_run(BEAM, SHORT)
        real = data.read_run

        def meanwhile(folder, room):
            found = real(folder, room)
            (folder / "run.json").write_text('[{"begun": "later"}]')
            return found

        data.read_run = meanwhile
        try:
            with self.assertRaises(data.NotARun):
                write([run.folder], run.folder / "report.html")
        finally:
            data.read_run = real
        self.assertFalse((run.folder / "report.html").exists())


if __name__ == "__main__":
    unittest.main()
