# SPDX-License-Identifier: GPL-2.0-or-later
"""Every block of code in the documents, in the words of the reader.

sh: each command is run from a folder that looks like the checkout. What takes long is cut: a run to
four coupled steps, or to its first equilibrium, on a grid of 60,000 cells if it is uniform; scenes
of more than a million cells (OpenFOAM: 60,000) are checked in place of run. A search makes one run,
studies and costs list theirs, pictures are of short runs, tests are listed. What needs whole
runs (scripts of figures, a calibration, `cost` itself) is done by figures.py, which is long; here its
options must be known and its files be there. Anything else must say in the line above the block why
it is not run: <!-- not run: REASON -->
yaml: a part of a scene is put into a small one, which `check` must call good; searches are read.
python: run. cpp: must be lines of a file that the build compiles. text: no code.
"""
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import yaml

from magfsi import runs, testing

ROOT = testing.ROOT
# blocks.py --first: what a newcomer types; else all pages.
FIRST = "--first" in sys.argv
PAGES = [ROOT / name for name in ("README.md", "docs/first_robot.md")] if FIRST else [
         ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md",
         *sorted((ROOT / "docs").rglob("*.md")), *sorted((ROOT / "tutorials").rglob("*.md"))]
NO_CODE = ("text", "{literalinclude}", "{eval-rst}")
# Run elsewhere: by the test of this name.
ELSEWHERE = {("docs/python.md", "python"): "python_api"}
# What other tests run, by their names; here the options are looked at.
WHOLE = {"python": "documentation_figures", "bench": "documentation_figures",
         "watch": "report_watch", "gallery": "report_gallery", "film": "report_drawing", "cite": "launcher_words",
         "compare": "compare_both_fluids", "design": "design_letter"}
BLOCK = re.compile(r"(?:^<!-- not run: (?P<why>.+?) -->\n)?^```(?P<kind>[^\n]*)\n(?P<text>.*?)^```$",
                   re.M | re.S)


def blocks():
    """[(page, language, text, reason not to run)]"""
    return [(str(page.relative_to(ROOT)), match["kind"].strip(), match["text"], match["why"])
            for page in PAGES for match in BLOCK.finditer(page.read_text())]


def commands(text):
    return [line.strip() for line in text.replace("\\\n", " ").splitlines()
            if line.strip() and not line.startswith("#")]


def maker_of(run, page):
    """Words of the command that makes a run folder: a line of the page, or that of the scene of this name; None
    without."""
    for text in (text for where, kind, text, _ in blocks() if where == page and kind == "sh"):
        for line in commands(text):
            words = shlex.split(line, comments=True)
            if words[:2] == ["./magfsi", "run"] and options_of(words, ("--out",)) == ["--out", run]:
                return words
    name = Path(run).name
    scene = next((scene for scene in (f"tutorials/{name}", f"docs/howto/{name}.yaml") if (ROOT / scene).exists()), None)
    return ["./magfsi", "run", scene, "--out", run] if scene else None


def runs_of(words):
    """Run folders that a script draws, unless it makes its own."""
    if "--run" in words:
        return []
    return [word for word in words[3:] if word.startswith("runs/") and not word.endswith(".png")]


class Folder:
    """Looks like the checkout; what is written into it goes with the test."""

    def __init__(self):
        self.path = Path(testing.new_folder())
        self.limit_s = 600
        for name in ("magfsi", "tutorials", "docs", "tests", "build", "packaging", "cluster", ".ci"):
            (self.path / name).symlink_to(ROOT / name)
        (self.path / "my_scene.yaml").write_text(testing.SMALL.read_text())
        search = (ROOT / "docs/optimize.md").read_text().split("```yaml\n")[1].split("```")[0]
        (self.path / "search.yaml").write_text(search.replace("../tutorials", "tutorials"))
        self.environment = {**os.environ, "MAGFSI_INSTALL": "no",
                            "MAGFSI_PRESET": runs.BIN.parent.name}

    def call(self, words, **named):
        return subprocess.run(words, cwd=self.path, capture_output=True, text=True,
                              env=self.environment, timeout=self.limit_s, **named)

    def good(self, words):
        done = self.call(words)
        if done.returncode != 0:
            raise AssertionError(f"{shlex.join(words)}\nexit code {done.returncode}\n{done.stdout[-500:]}"
                                 f"\n{done.stderr[-2000:]}")
        return done.stdout

    def facts(self, scene, options):
        return json.loads(self.good(["./magfsi", "explain", scene, *options, "--json"]))


def options_of(words, names):
    """Those of a command line that are of these names, with their values."""
    found = []
    for i, word in enumerate(words):
        if word in names:
            found += words[i:i + 2]
    return found


def cells(scene):
    fluid = scene.get("fluid")
    if not fluid:
        return 0
    number = 1
    for length in fluid["box"]:
        number *= length / fluid["spacing"]
    return number * (2 if "refinement" in fluid else 1)  # patches hold less than that


def coarsened(scene):
    """Settings with which a grid of ours that is uniform has at most 60,000 cells, if its sides allow."""
    fluid = scene.get("fluid", {})
    if fluid.get("solver", "lbm") != "lbm" or not fluid or "refinement" in fluid:
        return []
    counts = [round(length / fluid["spacing"]) for length in fluid["box"]]
    factor = 1
    while counts[0] * counts[1] * counts[2] / factor**3 > 6e4 and not any(n % (2 * factor) for n in counts):
        factor *= 2
    return ["--set", f"fluid.spacing={factor * fluid['spacing']:.17g} m"] if factor > 1 else []


def shortened(facts, keeps):
    """Settings that make it a short run, in place of what the scene or the line says; keeps: with
    checkpoints, and twice as long for a run that goes on."""
    scene = facts["scene"]
    every = scene.get("probes", {}).get("every")
    no_page = ["--set", "report=off"]  # which takes longer than such a run; report_after_run has it
    if "equilibrium" in scene["time"]:
        return [*no_page, *(["--set", f"time.end={every} s"] if every else [])]
    step = scene["time"].get("step") or (facts.get("fluid") or facts["structure"])["step_s"]
    count = 8 if keeps == "goes on" else 4
    short = [*no_page, "--set", f"time.end={count * step:.17g} s"]
    if "checkpoint" in scene or keeps:
        short += ["--set", f"checkpoint.every={2 * step:.17g} s"]
    for key in ("probes", "output.structure", "output.fluid"):
        part = scene
        for name in key.split("."):
            part = part.get(name, {})
        if "every" in part:
            short += ["--set", f"{key}.every={step:.17g} s"]
    return short


class Shell(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Folder()
        cls.openfoam = "not there" not in cls.folder.call(["./magfsi", "doctor"]).stdout
        cls.done = set()

    def run_scene(self, words):
        scene = words[2]
        given = options_of(words, ("--set", "--fluid", "--ranks"))
        if "openfoam" in words and not self.openfoam:
            return
        facts = self.folder.facts(scene, given)
        coarse = coarsened(facts["scene"])
        if coarse:
            words = [*words, *coarse]
            facts = self.folder.facts(scene, given + coarse)
        most = 6e4 if facts["scene"].get("fluid", {}).get("solver") == "openfoam" else 1e6
        if "--error" in words or cells(facts["scene"]) > most:
            self.folder.good(["./magfsi", "check", scene, *options_of(words, ("--set", "--fluid"))])
            return
        if "--restart" in words:  # from what the same line without it leaves
            at = words.index("--restart")
            first = words[:at] + words[at + 2:]
            self.folder.good([*first, *shortened(facts, "kept"), "--overwrite"])
        self.folder.good([*words, *shortened(facts, "goes on" if "--restart" in words else "")])

    def folder_of_a_run(self, word):
        if word.startswith("runs/") and not (self.folder.path / word / "summary.json").exists():
            self.folder.good(["./magfsi", "run", "my_scene.yaml", "--set", "time.end=1 ms", "--out", word])

    def words_are_known(self, words):
        """Of what is not repeated here."""
        text = self.folder.call([*words[:2], "--help"]).stdout
        if words[1] == "python":
            text = (ROOT / words[2]).read_text() if len(words) > 2 else "prompt"
        for word in words[2:]:
            if word.startswith("--"):
                self.assertTrue(word.partition("=")[0] in text or words[1] == "bench",
                                f"{words}: {word} is no option")
            elif re.match(r"(tutorials|docs|tests)/", word):
                self.assertTrue((ROOT / word).exists() or word.startswith("docs/"), f"{word} is not there")

    def run_line(self, line, page):
        line = line.replace("SCENE", "my_scene.yaml").replace("my_search.yaml", "search.yaml")
        words = shlex.split(line, comments=True)
        if words[0] in ("mpirun",):
            binary = str(runs.BIN)
            words = [word.replace("build/release/bin", binary) for word in words]
            at = words.index("-n")
            words[at:at] = ["--oversubscribe"] + (["--allow-run-as-root"] if os.getuid() == 0 else [])
            short = ["--set", "time.end=80 us", "--set", "probes.every=20 us"]
            colon = words.index(":")
            self.folder.good([*words[:colon], *short, *words[colon:], *short])
            return
        if words[0] == "source" or "||" in words:
            self.folder.good(["bash", "-ec", line])
            return
        self.assertEqual(words[0], "./magfsi", f"{page}: \"{line}\" is no command that is run here; say why")
        words = words[:words.index(">")] if ">" in words else words
        command = words[1] if len(words) > 1 else ""
        if command in ("study", "cost") and "--list" not in words:
            words.append("--list")
        if tuple(words) in self.done:
            return
        self.done.add(tuple(words))
        if command == "run":
            self.folder_of_a_run(words[2])
            self.run_scene(words)
        elif command in ("study", "cost"):
            self.folder.good(words)
        elif command == "test":
            self.assertRegex(self.folder.good([*words, "-N"]), r"Total Tests: \d\d+")
        elif command == "optimize" and FIRST:
            self.words_are_known(words)
        elif command == "optimize":
            self.folder.good([*words, "--runs", "1", "--search-only", "--set", "fluid.spacing=0.4 mm"])
        elif command in WHOLE and not (command == "compare" and words[2].startswith("runs/")):
            self.words_are_known(words)
        elif command in ("plot", "figure", "report", "render", "compare"):
            for word in words[2:]:
                self.folder_of_a_run(word)
            self.folder.good(words)
        else:
            self.folder.good(words)

    def test_every_command_runs(self):
        count = 0
        for page, kind, text, why in blocks():
            if kind != "sh" or why:
                continue
            for line in commands(text):
                count += 1
                with self.subTest(f"{page}: {line}"):
                    self.run_line(line, page)
        self.assertGreater(count, 6 if FIRST else 60)


class Texts(unittest.TestCase):
    def test_every_block_has_a_language_that_is_tested(self):
        for page, kind, text, why in blocks():
            self.assertTrue(kind in ("sh", "yaml", "python", "cpp", "lammps") or kind in NO_CODE
                            or kind.split(" ")[0] in NO_CODE, f"{page}: a block of '{kind}'\n{text}")
            self.assertTrue(kind != "lammps" or why, f"{page}: lammps blocks are not run: say why")

    def test_commands_stand_in_blocks(self):
        """Indented text is formulas: a command there would escape the tests."""
        for page in PAGES:
            outside = BLOCK.sub("", page.read_text())
            found = re.findall(r"^    (?:\./magfsi|magfsi|cmake|python3|mpirun) .*", outside, re.M)
            self.assertEqual(found, [], page)

    def test_figures_are_of_runs_that_the_page_makes(self):
        for page, kind, text, why in blocks():
            for line in commands(text) if kind == "sh" and not why else ():
                words = shlex.split(line, comments=True)
                if words[:2] == ["./magfsi", "python"] and not words[2].endswith("draw_map.py"):
                    missing = [run for run in runs_of(words) if maker_of(run, page) is None]
                    self.assertEqual(missing, [], f"{page}: {line}")

    def test_a_reason_is_a_sentence_of_some_words(self):
        for page, _, _, why in blocks():
            self.assertTrue(why is None or len(why.split()) > 4, f"{page}: {why}")


class Yaml(unittest.TestCase):
    """Parts of scenes, put over a small one."""

    BASE = {"time": {"end": "1 ms", "step": "20 us"},
            "bodies": {"robot": {
                "mesh": {"box": {"size": ["3.7 mm", "1.5 mm", "0.185 mm"], "elements": [20, 8, 1]}},
                "material": {"shear_modulus": "33 kPa", "lame_lambda": "660 kPa",
                             "density": "1860 kg/m3"},
                "magnetization": {"uniform": ["62 kA/m", "0 kA/m", "0 kA/m"]},
                "initial": {"position": ["8 mm", "4 mm", "4 mm"]}}}}
    FLUID = {"box": ["16 mm", "8 mm", "16 mm"], "spacing": "0.4 mm", "density": "1000 kg/m3",
             "viscosity": "1 mm2/s", "expected_speed": "0.5 m/s"}

    def scene_of(self, part):
        scene = {**self.BASE, **part}
        if "fluid" in part and "box" in part["fluid"]:
            scene.pop("bodies") if "bodies" not in part else None
            scene["time"] = {"end": "1 s"}
        elif "fluid" in part or "coupling" in part:
            scene["fluid"] = {**self.FLUID, **part.get("fluid", {})}
            scene["time"] = {"end": "1 ms"}
        if part.get("coupling", {}).get("structure") == "own":
            scene.pop("bodies")
        elif "bodies" in part:
            scene["magnetic_field"] = {"constant": {"magnitude": "1 mT", "direction": "0 deg"}}
        return scene

    def test_parts_of_scenes_are_good(self):
        folder, count = Path(testing.new_folder()), 0
        for page, kind, text, why in blocks():
            values = yaml.safe_load(text) if kind == "yaml" and not why else None
            if not isinstance(values, dict):
                continue
            count += 1
            with self.subTest(page):
                if "scene" in values:
                    self.read_study(page, values)
                    continue
                file = folder / "scene.yaml"
                file.write_text(yaml.safe_dump(self.scene_of(values)))
                done = subprocess.run([runs.BIN / "magfsi", "check", file], capture_output=True,
                                      text=True)
                self.assertEqual(done.returncode, 0, f"{page}\n{text}\n{done.stderr}")
        self.assertGreater(count, 5)

    def read_study(self, page, values):
        """What a study or a search is made of: the words of the page's own table are its keys."""
        text = (ROOT / page).read_text()
        for key in values:
            self.assertIn(key, text.replace("```yaml", "", 1))
        self.assertTrue({"axes", "parameters"} & set(values), values.keys())


class Python(unittest.TestCase):
    def test_blocks_run(self):
        folder = Folder()
        count = 0
        for page, kind, text, why in blocks():
            if kind != "python" or why or (page, kind) in ELSEWHERE:
                continue
            count += 1
            with self.subTest(page):
                folder.good([sys.executable, "-c", text])
        self.assertGreater(count, 0)

    def test_those_run_elsewhere_are(self):
        for (page, _), test in ELSEWHERE.items():
            name = test.split("_")[1]
            self.assertIn(page, (ROOT / f"tests/python/{name}.py").read_text())
        lists = "".join(path.read_text() for path in (ROOT / "tests").rglob("CMakeLists.txt"))
        for test in WHOLE.values():
            self.assertIn(f"magfsi_python_test({test} ", lists)


class Cpp(unittest.TestCase):
    def test_blocks_are_lines_of_compiled_files(self):
        sources = [path.read_text() for folder in ("docs/examples", "coupler", "structure", "fluid_lbm",
                                                   "adapters", "tests")
                   for path in (ROOT / folder).rglob("*") if path.suffix in (".cpp", ".h")]
        for page, kind, text, why in blocks():
            if kind == "cpp" and not why:
                self.assertTrue(any(text.strip() in source for source in sources), f"{page}\n{text}")


if __name__ == "__main__":
    names = ["Shell", "Texts"] if FIRST else []
    unittest.main(argv=[sys.argv[0], *names])
