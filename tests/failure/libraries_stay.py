# SPDX-License-Identifier: GPL-2.0-or-later
"""MPI_Finalize unloads no library, since a thread of Open MPI may still call it
(base/process/keep_libraries.h). The loader's own log tells it (LD_DEBUG, see ld.so(8))."""

import re
import subprocess
import unittest
from pathlib import Path

from magfsi import testing


class LibrariesStay(unittest.TestCase):
    def test_in_finalize(self):
        folder = Path(testing.new_folder())
        words = ["mpirun", "--oversubscribe"]
        for program in ("magfsi-structure", "magfsi-fluid-lbm"):
            words += [":"] * (len(words) > 2) + [
                "-n", "1", "env", "LD_DEBUG=files", f"LD_DEBUG_OUTPUT={folder}/{program}",
                testing.BIN / program, testing.SMALL, "--out", folder / "run",
                "--set", "time.end=0.1 ms"]
        subprocess.run(words, check=True, capture_output=True)
        for program in ("magfsi-structure", "magfsi-fluid-lbm"):
            log, = [text for text in (path.read_text() for path in folder.glob(f"{program}.*"))
                    if f"initialize program: {testing.BIN / program}" in text]
            kept = log.rindex("activating NODELETE")
            self.assertIn("/libmpi", log[:kept])
            self.assertEqual(re.findall("file=(.*);  destroying", log[kept:]), [], program)


if __name__ == "__main__":
    testing.main()
