# SPDX-License-Identifier: GPL-2.0-or-later
"""The site builds without a warning (a link that leads nowhere is one), every key of the schema has an
example in a scene that `check` calls good, every probe is defined. In headless Chromium no page is wider
than a phone, equations are drawn, the search shows words in their context, and nothing needs a network."""
import functools
import importlib.util
import json
import re
import subprocess
import sys
import unittest
from pathlib import Path

from magfsi import runs, testing
from PIL import Image

sys.path.append(str(testing.ROOT / "tests/report"))
import browser  # noqa: E402

spec = importlib.util.spec_from_file_location("documentation", testing.ROOT / "docs/make_site.py")
documentation = importlib.util.module_from_spec(spec)
spec.loader.exec_module(documentation)

# The only links that leave: a test has no network. The DOI is that of the given reference text.
OUTSIDE = {"https://doi.org/10.1039/D0SM01662D", "https://semver.org"}
PAGES = [testing.ROOT / name for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md")] + [
    *(testing.ROOT / "docs").rglob("*.md"), *(testing.ROOT / "tutorials").rglob("*.md")]
# Their subject is files of the source.
OF_FILES = ("CONTRIBUTING.md", "adding_an_effect.md", "adding_a_fluid.md")
PHONE = 420
# How far the page goes to the right, and what goes beyond the edge and is in no part that scrolls by itself.
WIDE = """(() => {
  const article = document.querySelector("article"), width = document.documentElement.clientWidth;
  const right = part => part.getBoundingClientRect().left + Math.max(part.scrollWidth, part.offsetWidth || 0);
  let most = 0;
  for (let part = article; part; part = part.parentElement) most = Math.max(most, right(part));
  const held = part => part !== article &&
    (/auto|scroll/.test(getComputedStyle(part).overflowX) || held(part.parentElement));
  const beyond = [...article.querySelectorAll("*")].filter(part => right(part) > width && !held(part));
  return [most, beyond.slice(-3).map(part => `${part.tagName}: ${part.textContent.slice(0, 60)}`)]; })()"""


def schema():
    return json.loads(subprocess.run([runs.BIN / "magfsi", "schema"], capture_output=True, text=True,
                                     check=True).stdout)


@functools.lru_cache(None)
def site():
    """(folder, exit code, text) of one build for all tests."""
    out = Path(testing.new_folder()) / "site"
    return out, *documentation.build(out)[:2]


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.out, cls.code, cls.text = site()

    def test_it_builds_without_a_warning(self):
        self.assertEqual((self.code, self.text), (0, ""))
        home = (self.out / "html/docs/index.html").read_text()
        for page in ("install", "first_robot", "howto/gmsh", "theory", "limits", "scene_examples",
                     "cpp_reference", "python_reference"):
            self.assertIn(f'href="{page}.html"', home)
        self.assertIn("run_structure", (self.out / "html/docs/cpp_reference.html").read_text())
        self.assertIn("PartnerLost", (self.out / "html/docs/python_reference.html").read_text())

    def test_front_page_has_a_card_of_every_tutorial(self):
        cards = (testing.ROOT / "docs/index.md").read_text().split("\n## Tutorials\n")[1].split("\n## ")[0]
        names = {scene.parent.name for scene in (testing.ROOT / "tutorials").glob("*/scene.yaml")}
        found = dict(re.findall(r'^- \[<img src="(pictures/\w+\.png)" alt="[^"]+" width="\d+">\]'
                                r"\(\.\./tutorials/(\w+)/README\.md\)\\\n"
                                r"  \*\*\[[^]]+\]\([^)]+\)\*\*: [^*]+ \*[^*]+\*$", cards, re.M))
        self.assertEqual(set(found.values()), names, "a picture, what happens, what it costs")
        for picture in found:
            self.assertTrue((testing.ROOT / "docs" / picture).exists(), picture)

    def test_nothing_is_loaded_from_elsewhere(self):
        for page in (self.out / "html").rglob("*.html"):
            loaded = re.findall(r'<(?:script|img|link|iframe)[^>]*(?:src|href)="(?:https?:)?//[^"]*"', page.read_text())
            self.assertEqual(loaded, [], page)

    def test_pictures_of_the_front_page_lead_to_their_tutorials(self):
        """A link in a link would take the reader to the picture's file."""
        home = (self.out / "html/docs/index.html").read_text()
        found = re.findall(r'<a [^>]*href="\.\./tutorials/(\w+)/README\.html">(?:<span[^>]*>)?<img ', home)
        names = {scene.parent.name for scene in (testing.ROOT / "tutorials").glob("*/scene.yaml")}
        self.assertEqual(set(found), names)

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


class Pictures(unittest.TestCase):
    """Figures in the width of the site's text, 46 em of 16 pixels less its margins. Matplotlib says in the file how wide it
    meant them; their scripts' letters have 7 points at least."""
    TEXT, LEAST, POINTS = 736, 8, 7  # pixels, pixels, points
    # Of runs of OpenFOAM, and of hours.
    WIDER = {"docs/compare.png", "docs/turek_hron.png"}

    def test_letters_can_be_read(self):
        small = set()
        for folder in ("docs", "tutorials"):
            for file in (testing.ROOT / folder).rglob("*.png"):
                with Image.open(file) as picture:
                    if "dpi" in picture.info:  # of others there are no letters
                        inches = picture.size[0] / picture.info["dpi"][0]
                        if self.TEXT / inches * self.POINTS / 72 < self.LEAST:
                            small.add(str(file.relative_to(testing.ROOT)))
        self.assertEqual(small, self.WIDER)


class Links(unittest.TestCase):
    def test_those_that_leave_are_known(self):
        found = {link for page in PAGES for link in re.findall(r"\]\((https?:[^)\s]+)\)",
                                                               page.read_text())}
        self.assertEqual(found - OUTSIDE, set())


    def test_they_carry_names(self):
        for page in PAGES:
            text = re.sub(r"```.*?```", "", page.read_text(), flags=re.S)
            files = [] if page.name in OF_FILES else re.findall(r"\[[^]\s]*\.[a-z]{1,5}\]\((?!http)[^)]*\)", text)
            self.assertEqual(files + re.findall(r"\[[^]\s]*\.md\]\([^)]*\)", text), [], page)


@testing.needs("chromium")
class Looked(unittest.TestCase):
    """From the folder, as a reader opens it."""

    @classmethod
    def setUpClass(cls):
        cls.html = site()[0] / "html"
        cls.browser = browser.Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    def open(self, page, width=1400, **how):
        # Seventy pages on a busy machine: one may wait for its turn for more than a minute.
        self.browser.open(f"file://{self.html}/{page}", width=width, limit_s=600, **how)
        if self.browser.run("!!document.querySelector('.math')"):
            self.browser.run("new Promise(done => MathJax.Hub.Queue(() => done(1)))")
        self.assertEqual(self.browser.errors(), [], page)

    def test_no_page_is_wider_than_a_phone(self):
        pages = [page for page in sorted(self.html.rglob("*.html")) if "<article" in page.read_text()]
        self.assertGreater(len(pages), 60)
        for page in pages:
            self.open(page.relative_to(self.html), PHONE)
            self.browser.run("document.querySelectorAll('details').forEach(part => { part.open = true; })")
            self.assertLessEqual(self.browser.run(WIDE), [PHONE, []], page)

    def test_commands_and_their_remarks_are_read_without_scrolling(self):
        """A remark stands beside its command or, as a whole, in the lines below."""
        for page in ("docs/index.html", "tutorials/swimmer/README.html", "docs/report.html"):
            for width in (PHONE, 1400):
                self.open(page, width)
                self.assertEqual(self.browser.run(
                    "[...document.querySelectorAll('.highlight-sh pre')].filter(part => part.scrollWidth > part.clientWidth + 1)"
                    ".map(part => part.textContent)"), [])
                self.assertEqual(self.browser.run(
                    "[...document.querySelectorAll('.highlight-sh pre .c1')].filter(part => part.getClientRects().length > 1)"
                    ".map(part => part.textContent)"), [])

    def test_what_is_wider_is_found(self):
        self.open("docs/scene.html", PHONE)
        self.browser.run("""document.querySelectorAll("h3").forEach(part => { part.style.whiteSpace = "nowrap"; })""")
        most, beyond = self.browser.run(WIDE)
        self.assertGreater(most, PHONE)
        self.assertIn("coupling.immersed_boundary", " ".join(beyond))

    def test_reference_of_scenes_is_folded(self):
        self.open("docs/scene.html", PHONE)
        self.assertLess(self.browser.run("document.documentElement.scrollHeight"), 20000)
        self.assertGreater(self.browser.run("document.querySelectorAll('details:not([open])').length"), 15)

    def test_equations_are_drawn(self):
        self.open("docs/theory.html")
        self.assertGreater(self.browser.run("document.querySelectorAll('.math svg').length"), 20)
        self.assertEqual(self.browser.run("document.querySelectorAll('.merror, [data-mjx-error]').length"), 0)
        self.assertNotIn("$", self.browser.run("document.querySelector('article').innerText"))

    def test_search_shows_words_in_their_context(self):
        self.open("search.html?q=viscosity")
        shown = self.browser.run("""new Promise(done => { const look = () => {
          const found = [...document.querySelectorAll("#search-results li")];
          if (/finished/.test(document.querySelector(".search-summary").textContent) &&
              found.every(item => item.children.length > 1)) done(found.map(item => item.innerText));
          else setTimeout(look, 50); }; look(); })""")
        self.assertGreater(len(shown), 15)
        self.assertTrue(shown[0].startswith("The scene file"), shown[0])
        for text in shown[:10]:
            self.assertRegex(text.partition("\n")[2].lower(), "viscosity")
        self.assertEqual(self.browser.errors(), [])

    def test_dark_by_the_system_and_by_the_button(self):
        paper = "getComputedStyle(document.body).backgroundColor"
        self.open("docs/index.html", dark=True)
        self.assertEqual(self.browser.run(paper), "rgb(19, 20, 22)")
        self.open("docs/index.html")
        self.assertEqual(self.browser.run(paper), "rgb(255, 255, 255)")
        seen = [self.browser.run(f"document.querySelector('.theme-toggle').click(); {paper}") for _ in range(3)]
        self.assertEqual(set(seen), {"rgb(19, 20, 22)", "rgb(255, 255, 255)"})

    def test_the_way_through_the_pages(self):
        self.open("docs/coupling.html")
        for part in (".next-page", ".prev-page", ".toc-tree a[href='#schemes']", ".sidebar-tree a"):
            self.assertTrue(self.browser.run(f'!!document.querySelector("{part}")'), part)


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
