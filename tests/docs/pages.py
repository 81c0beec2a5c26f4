# SPDX-License-Identifier: GPL-2.0-or-later
"""The site builds without a warning (a link that leads nowhere is one), every key of the schema has an
example in a scene that `check` calls good, every probe is defined."""
import importlib.util
import json
import re
import subprocess
import unittest
from pathlib import Path

from magfsi import runs, testing

spec = importlib.util.spec_from_file_location("documentation", testing.ROOT / "docs/make_site.py")
documentation = importlib.util.module_from_spec(spec)
spec.loader.exec_module(documentation)

# The only links that leave: a test has no network. The DOI is that of the given reference text.
OUTSIDE = {"https://doi.org/10.1039/D0SM01662D", "https://semver.org"}
PAGES = [testing.ROOT / name for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md")] + [
    *(testing.ROOT / "docs").rglob("*.md"), *(testing.ROOT / "tutorials").rglob("*.md")]


def schema():
    return json.loads(subprocess.run([runs.BIN / "magfsi", "schema"], capture_output=True, text=True,
                                     check=True).stdout)


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.out = Path(testing.new_folder()) / "site"
        cls.code, cls.text, _ = documentation.build(cls.out)

    def test_it_builds_without_a_warning(self):
        self.assertEqual((self.code, self.text), (0, ""))
        home = (self.out / "html/docs/index.html").read_text()
        for page in ("install", "first_robot", "howto/gmsh", "theory", "limits", "scene_examples",
                     "cpp_reference", "python_reference"):
            self.assertIn(f'href="{page}.html"', home)
        self.assertIn("run_structure", (self.out / "html/docs/cpp_reference.html").read_text())
        self.assertIn("PartnerLost", (self.out / "html/docs/python_reference.html").read_text())

    def test_links_of_the_html_lead_somewhere(self):
        """Once more on what a reader has: files and anchors."""
        html, missing = self.out / "html", []
        pages = {page: page.read_text() for page in html.rglob("*.html")}
        for page, text in pages.items():
            for link in set(re.findall(r'(?:href|src)="([^"]+)"', text)):
                if re.match(r"https?:|mailto:|data:", link):
                    continue
                path, _, anchor = link.partition("#")
                path = path.partition("?")[0]  # Sphinx marks versions of its files there
                target = (page.parent / path).resolve() if path else page
                if not target.exists():
                    missing.append(f"{page.relative_to(html)}: {link}")
                elif anchor and target in pages and f'id="{anchor}"' not in pages[target]:
                    missing.append(f"{page.relative_to(html)}: {link}")
        self.assertGreater(len(pages), 40)
        self.assertEqual(missing, [])


class Links(unittest.TestCase):
    def test_those_that_leave_are_known(self):
        found = {link for page in PAGES for link in re.findall(r"\]\((https?:[^)\s]+)\)",
                                                               page.read_text())}
        self.assertEqual(found - OUTSIDE, set())


class Keys(unittest.TestCase):
    def test_every_key_has_an_example(self):
        _, missing = documentation.scene_examples(schema())
        self.assertEqual(missing, [], "add them to a scene of docs/examples/scenes")

    def test_a_key_without_an_example_is_found(self):
        added = schema()
        added["properties"]["gravity"]["properties"]["colour"] = {"type": "string"}
        _, missing = documentation.scene_examples(added)
        self.assertIn("gravity.colour", missing)

    def test_the_scenes_are_good(self):
        for file, _ in documentation.examples():
            with self.subTest(file.name):
                done = subprocess.run([runs.BIN / "magfsi", "check", file], capture_output=True,
                                      text=True)
                openfoam = "openfoam" in done.stderr and "install" in done.stderr
                self.assertTrue(done.returncode == 0 or openfoam, done.stderr)


class Probes(unittest.TestCase):
    def test_every_one_is_defined(self):
        """Those that a scene can ask for, and the columns of runs that ask for all of them."""
        text = (testing.ROOT / "docs/probes.md").read_text()
        probes = schema()["properties"]["probes"]["properties"]
        for list_ in ("bodies", "fluid"):
            for word in probes[list_]["items"]["enum"]:
                self.assertIn(f"`{word}`", text, f"docs/probes.md says nothing of {word}")
        for key in probes:
            if key not in ("every", "bodies", "fluid"):
                self.assertIn(f"`{key}`", text, f"docs/probes.md says nothing of probes.{key}")


if __name__ == "__main__":
    unittest.main()
