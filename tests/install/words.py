# SPDX-License-Identifier: GPL-2.0-or-later
"""The launcher: its list of words, near misses, completion, new scenes; help builds nothing."""
import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from magfsi import runs, testing

LAUNCHER = testing.ROOT / "magfsi"
FORBIDDEN = ("apt-get", "sudo", "cmake", "ninja", "c++", "g++", "dpkg-query")


def call(*words, launcher=LAUNCHER, **named):
    return subprocess.run([str(word) for word in (launcher, *words)], capture_output=True,
                          text=True, **named)


def bash(script, **named):
    return subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True,
                          **named).stdout


class Checkout:
    """The launcher with what it needs of a checkout, unbuilt, where nothing can be built."""

    def __init__(self):
        self.folder = Path(testing.new_folder())
        self.top = self.folder / "magfsi"
        for part in ("adapters/app/launcher", "adapters/python", "tutorials/strip"):
            shutil.copytree(testing.ROOT / part, self.top / part,
                            ignore=shutil.ignore_patterns("__pycache__"))
        for part in ("magfsi", "CMakeLists.txt"):
            shutil.copy(testing.ROOT / part, self.top / part)
        self.bin = self.folder / "bin"
        self.bin.mkdir()
        self.told = self.folder / "told"
        for name in FORBIDDEN:
            self.tool(name, f"echo {name} >>{self.told}\nexit 1")

    def tool(self, name, script):
        (self.bin / name).write_text(f"#!/bin/sh\n{script}\n")
        (self.bin / name).chmod(0o755)

    def call(self, *words):
        # As a person's shell has it: without what stops Python from leaving bytecode behind.
        environment = {name: value for name, value in os.environ.items()
                       if not name.startswith(("MAGFSI", "PYTHON"))}
        environment["PATH"] = f"{self.bin}:{environment['PATH']}"
        return call(*words, launcher=self.top / "magfsi", env=environment, cwd=self.folder)


class Help(unittest.TestCase):
    def test_it_lists_every_command_with_a_line(self):
        text = call("--help").stdout
        listed = dict(re.findall(r"^  ([\w-]+) +(\S.*)$", text, re.M))
        package = testing.ROOT / "adapters/python/magfsi"
        modules = {path.parent.name for path in package.glob("*/__main__.py")} | {
            path.stem for path in package.glob("*.py") if "__name__ ==" in path.read_text()}
        # Under another word: bench --calibrate, test --installed, a run's controller; no command: for
        # the tests.
        modules -= {"calibrate", "installed", "controller", "testing", "instructions"}
        words = subprocess.run([runs.BIN / "magfsi", "--help"], capture_output=True, text=True)
        programs = re.findall(r"^  (\w+) {2,}", words.stdout.split("Subcommands:")[1], re.M)
        self.assertGreaterEqual(len(programs), 5)
        for word in [*modules, *programs, "bench", "lammps", "test", "python", "new", "build"]:
            word = word.replace("_", "-")
            self.assertIn(word, listed, f"{word} is a command that --help does not list")
        for line in text.splitlines():
            self.assertLessEqual(len(line), 110, line)

    def test_it_builds_and_installs_nothing(self):
        checkout = Checkout()
        for words in ([], ["--help"], ["help", "run"], ["run", "--help"], ["study", "--help"],
                      ["--version"], ["bench", "-h"], ["completion", "bash"], ["--commands"]):
            done = checkout.call(*words)
            self.assertEqual(done.returncode, 0, f"{words}\n{done.stderr}")
            self.assertTrue(done.stdout.strip(), words)
        self.assertEqual(checkout.call("rnu").returncode, 2)
        self.assertFalse(checkout.told.exists(), checkout.told.exists() and checkout.told.read_text())
        self.assertFalse((checkout.top / "build").exists())
        # The tools that say so are found: a build does call them.
        self.assertNotEqual(checkout.call("build").returncode, 0)
        self.assertTrue(checkout.told.exists())

    def test_what_is_optional_is_installed_when_it_is_asked_for(self):
        checkout = Checkout()
        for part in testing.ROOT.glob("packages*.txt"):
            shutil.copy(part, checkout.top)
        # All is installed but OpenFOAM; what builds does nothing.
        checkout.tool("dpkg-query", 'case "$*" in *openfoam*) ;; *) echo -n installed ;; esac')
        for name in ("cmake", "ninja", "c++", "mpirun", "sudo", "apt-get"):
            checkout.tool(name, f'echo {name} "$@" >>{checkout.told}')
        scene = checkout.top / "tutorials/strip"
        checkout.call("run", scene)
        self.assertIn("ninja", checkout.told.read_text())
        self.assertNotIn("openfoam", checkout.told.read_text())
        for words in (["run", scene, "--fluid", "openfoam"], ["build"], ["optimize", "search.yaml"]):
            shutil.rmtree(checkout.top / "build")
            checkout.told.unlink()
            checkout.call(*words)
            self.assertRegex(checkout.told.read_text(), "apt-get install .*openfoam", words)
            self.assertIn("ninja", checkout.told.read_text())
        shutil.rmtree(checkout.top / "build")
        checkout.told.unlink()
        (scene / "scene.yaml").write_text("fluid: {solver: openfoam}\n")
        checkout.call("run", scene)
        self.assertRegex(checkout.told.read_text(), "apt-get install .*openfoam")

    def test_the_version_is_the_projects(self):
        (version,) = re.findall(r"project\(magfsi VERSION ([0-9.]+)",
                                (testing.ROOT / "CMakeLists.txt").read_text())
        self.assertEqual(call("--version").stdout, f"magfsi {version}\n")
        self.assertIn(f'version = "{version}"', (testing.ROOT / "pyproject.toml").read_text())
        self.assertIn(f"\nversion: {version}\n", (testing.ROOT / "CITATION.cff").read_text())
        self.assertIn(f"\n## {version}", (testing.ROOT / "CHANGELOG.md").read_text())


class NearMisses(unittest.TestCase):
    def test_the_right_word_is_suggested(self):
        for found, meant in (("rnu", "run"), ("runn", "run"), ("exlain", "explain"),
                             ("optimise", "optimize"), ("plott", "plot"), ("chekc", "check"),
                             ("doktor", "doctor"), ("lamps", "lammps")):
            done = call(found)
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"did you mean {meant}?", done.stderr, found)

    def test_what_is_nothing_gets_the_list_alone(self):
        done = call("frobnicate")
        self.assertEqual(done.returncode, 2)
        self.assertNotIn("did you mean", done.stderr)
        self.assertIn("explain run", done.stderr)


class Cite(unittest.TestCase):
    def test_magfsi_and_the_paper(self):
        checkout = Checkout()
        shutil.copy(testing.ROOT / "CITATION.cff", checkout.top)
        done = checkout.call("cite")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(re.findall(r"^@(\w+)\{(\w+),$", done.stdout, re.M),
                         [("software", "magfsi"), ("article", "ye2021")])
        self.assertEqual(done.stdout.count("{"), done.stdout.count("}"))
        version = re.search(r"^project\(magfsi VERSION ([0-9.]+)", (testing.ROOT / "CMakeLists.txt").read_text(),
                            re.M)[1]
        self.assertIn(f"version = {{{version}}}", done.stdout)
        self.assertIn("author = {Ye, Huilin and Li, Ying and Zhang, Teng}", done.stdout)
        self.assertIn("pages = {3560--3568}", done.stdout)
        self.assertFalse(checkout.told.exists())


class Film(unittest.TestCase):
    """On a machine without ffmpeg; what is built stands."""

    def setUp(self):
        self.checkout = Checkout()
        for part in testing.ROOT.glob("packages*.txt"):
            shutil.copy(part, self.checkout.top)
        self.checkout.tool("dpkg-query", "echo -n unknown")
        self.checkout.tool("apt-get", f'echo apt-get "$@" >>{self.checkout.told}\n'
                           "echo 0 upgraded, 86 newly installed, 0 to remove\necho Need to get 47 MB of archives.")
        self.command = [self.checkout.top / "magfsi", "film", "runs/none"]
        # Without the folder where a real ffmpeg may be.
        tools = Path(testing.new_folder())
        for name in ("bash", "env", "dirname", "readlink", "id", "sed", "grep", "perl", "sleep", "true"):
            (tools / name).symlink_to(shutil.which(name))
        self.environment = {"PATH": f"{self.checkout.bin}:{tools}", "HOME": str(tools)}
        self.checkout.tool("sudo", 'exec "$@"')

    def test_says_how_much_it_installs(self):
        done = subprocess.run(self.command, env=self.environment, capture_output=True, text=True,
                              stdin=subprocess.DEVNULL)
        self.assertIn("film needs ffmpeg", done.stderr)
        self.assertIn("86 newly installed", done.stderr)
        self.assertIn("Need to get 47 MB", done.stderr)
        self.assertIn("-y -qq --no-install-recommends ffmpeg", self.checkout.told.read_text())

    def test_asks_at_a_terminal(self):
        try:
            master, slave = os.openpty()
        except OSError as none:
            self.skipTest(f"no pseudo-terminals here, as in a chroot without /dev/pts ({none})")
        os.write(master, b"n\n")
        done = subprocess.run(self.command, env=self.environment, stdin=slave, stdout=subprocess.PIPE,
                              stderr=slave)
        os.close(slave)
        said = everything_from(master)
        os.close(master)
        self.assertEqual(done.returncode, 1, said)
        self.assertIn("install it? [Y/n]", said)
        self.assertNotIn(" -y ", self.checkout.told.read_text())


def everything_from(terminal):
    """One read may return before the kernel has passed on all; the end is an error or nothing."""
    said = b""
    try:
        while part := os.read(terminal, 1 << 16):
            said += part
    except OSError:
        pass
    return said.decode()


class New(unittest.TestCase):
    def test_a_scene_of_ones_own(self):
        folder = Path(testing.new_folder())
        done = call("new", "my_robot", "--like", "strip", cwd=folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (folder / "my_robot/scene.yaml").read_text()
        self.assertIn("\nname: my_robot\n", text)
        self.assertIn("yaml-language-server: $schema=scene.schema.json\n", text)
        self.assertIn('"bodies"', (folder / "my_robot/scene.schema.json").read_text())
        checked = subprocess.run([runs.BIN / "magfsi", "check", folder / "my_robot"],
                                 capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_all_tutorials_can_be_taken(self):
        folder = Path(testing.new_folder())
        for scene in (testing.ROOT / "tutorials").glob("*/scene.yaml"):
            name = f"my_{scene.parent.name}"
            self.assertEqual(call("new", name, "--like", scene.parent.name, cwd=folder).returncode, 0)
            checked = subprocess.run([runs.BIN / "magfsi", "check", folder / name],
                                     capture_output=True, text=True)
            self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_what_its_comments_and_scripts_name_is_there(self):
        folder, named = Path(testing.new_folder()), 0
        for scene in (testing.ROOT / "tutorials").glob("*/scene.yaml"):
            call("new", scene.parent.name, "--like", scene.parent.name, cwd=folder)
            texts = [file.read_text() for file in (scene, *scene.parent.glob("*.py"))]
            for file in scene.parent.iterdir():
                if any(file.name in text for text in texts) and file.suffix not in (".md", ".png"):
                    named += 1
                    self.assertTrue((folder / scene.parent.name / file.name).exists(), file)
        self.assertGreater(named, 20)

    def test_what_is_wrong_is_said_and_nothing_written(self):
        folder = Path(testing.new_folder())
        for words, said in ((["new"], "the name ''"), (["new", "a b"], "the name 'a b'"),
                            (["new", "mine", "--like", "fish"], "swimmer"),
                            (["new", "mine", "--colour"], "--colour"),
                            (["new", "mine", "yours"], "'yours'")):
            done = call(*words, cwd=folder)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn(said, done.stderr)
        self.assertEqual(list(folder.iterdir()), [])
        (folder / "mine").mkdir()
        self.assertIn("is there already", call("new", "mine", cwd=folder).stderr)


class Completion(unittest.TestCase):
    def words(self, *line):
        """What bash offers for the last of the words."""
        array = " ".join(f"'{word}'" for word in (LAUNCHER, *line))
        return bash(f"source <({LAUNCHER} completion bash); COMP_WORDS=({array}); "
                    f"COMP_CWORD={len(line)}; _magfsi; printf '%s\\n' \"${{COMPREPLY[@]}}\"",
                    cwd=testing.ROOT).split()

    def test_bash_offers_commands_options_and_files(self):
        self.assertEqual(self.words("exp"), ["explain"])
        self.assertIn("optimize", self.words(""))
        self.assertIn("--restart", self.words("run", "--re"))
        self.assertIn("--results", self.words("study", "--"))
        self.assertEqual(self.words("run", "tutorials/swi"), ["tutorials/swimmer"])
        self.assertEqual(self.words("completion", "z"), ["zsh"])

    @unittest.skipUnless(shutil.which("zsh"), "packages-tests.txt has zsh")
    def test_zsh_offers_the_same(self):
        """By a completion function's own means: what it hands to _describe and compadd."""
        script = ("autoload -Uz compinit; compinit -D -u; source <({0} completion zsh); "
                  "_describe() {{ print -l ${{(P)2}}; }}; compadd() {{ print -l $@; }}; "
                  "words=({0} {1}); CURRENT={2}; _magfsi")

        def offered(line, at):
            return subprocess.run(["zsh", "-f", "-c", script.format(LAUNCHER, line, at)],
                                  capture_output=True, text=True, check=True).stdout.splitlines()
        found = offered("''", 2)
        self.assertIn('check:one clear error, or "good"', found)
        self.assertTrue(any(line.startswith("optimize:") for line in found), found)
        self.assertIn("--restart", offered("run --", 3))


if __name__ == "__main__":
    unittest.main()
