# SPDX-License-Identifier: GPL-2.0-or-later
"""Besides pyproject.toml: an installed package knows the checkout whose programs it starts."""
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py


class WithCheckout(build_py):
    def run(self):
        super().run()
        place = Path(self.build_lib) / "magfsi/place.py"
        place.write_text("from pathlib import Path\n\n"
                         f"ROOT = Path({str(Path(__file__).resolve().parent)!r})\n"
                         'PROGRAMS = ROOT / "build/release/bin"\n')


setup(cmdclass={"build_py": WithCheckout})
