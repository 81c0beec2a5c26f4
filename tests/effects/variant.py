# SPDX-License-Identifier: GPL-2.0-or-later
"""A participant built without an effect: without its line of an effects.inc and without its
files. All objects that make something of the line are compiled anew, from a copy of the list, and
the program is linked without the effect's files. Nothing of those files may be left: the linker's
map and the headers that each object has read show it."""

import functools
import os
import re
import shlex
import subprocess
from dataclasses import dataclass
from pathlib import Path

from magfsi import testing

BUILD = testing.BIN.parent


@dataclass(frozen=True)
class Removal:
    """files: globs of what is the effect's alone; registry: the list with its line."""

    name: str
    files: tuple
    registry: str


@functools.cache
def commands(program):
    """The last is that of its link."""
    text = subprocess.run(["ninja", "-C", BUILD, "-t", "commands", program], check=True,
                          capture_output=True, text=True).stdout
    return [line for line in text.splitlines() if not line.startswith("ninja:")]


def in_tree(path):
    """Of a path as the build sees it, that from the tree's root; None of those outside."""
    whole = os.path.normpath(os.path.join(BUILD, path))
    root = f"{testing.ROOT}/"
    return whole.removeprefix(root) if whole.startswith(root) else None


@functools.cache
def read_by():
    """Of each object of the build, the files of the tree that it has been made of."""
    text = subprocess.run(["ninja", "-C", BUILD, "-t", "deps"], check=True,
                          capture_output=True, text=True).stdout
    reads, now = {}, None
    for line in text.splitlines():
        if line.startswith(" "):
            path = in_tree(line.strip())
            if path:
                now.add(path)
        elif line:
            now = reads.setdefault(line.split(":")[0], set())
    return reads


def objects(program):
    """{object: command that makes it}."""
    made = {}
    for command in commands(program)[:-1]:
        words = shlex.split(command)
        if "-c" in words:
            made[words[words.index("-o") + 1]] = words
    return made


@functools.cache
def line_of(removal):
    """The effect's line in the list, and its macro."""
    text = (testing.ROOT / removal.registry).read_text()
    lines = re.findall(rf"^((MAGFSI_\w+)\({removal.name}\)\n)", text, re.M)
    if len(lines) != 1:
        raise AssertionError(f"{removal.registry} has not one line of {removal.name}")
    return lines[0]


@functools.cache
def makes_something(path, removal):
    """Whether the file reads the list and has more than an empty macro for the line."""
    text = (testing.ROOT / path).read_text(errors="replace")
    return (f'#include "{removal.registry}"' in text
            and not re.search(rf"#define {line_of(removal)[1]}\(name\)$", text, re.M))


def overlay(removal, folder):
    """A copy of the list without the effect, below a folder."""
    text = (testing.ROOT / removal.registry).read_text().replace(line_of(removal)[0], "")
    copy = folder / removal.registry
    copy.parent.mkdir(parents=True, exist_ok=True)
    copy.write_text(text)


def compiled(words, target, folder):
    words = list(words)
    words[words.index("-o") + 1] = str(target)
    words[words.index("-MF") + 1] = f"{target}.d"
    source = source_of(words)
    if (folder / source).exists():
        words[-1] = str(folder / source)
    first = next(i for i, word in enumerate(words) if word.startswith("-"))
    words.insert(first, f"-I{folder}")
    words.insert(words.index("-c"), "-Wno-error")  # of what has lost its user
    subprocess.run(words, cwd=BUILD, check=True)
    made_of = Path(f"{target}.d").read_text().replace("\\\n", " ").split()[1:]
    return {in_tree(path) for path in made_of} - {None}


def linked(program, folder, made):
    """made: {object of the build: the one in its place}; returns the objects in the program
    by the names in the linker's map."""
    words = shlex.split(commands(program)[-1].removeprefix(": && ").removesuffix(" && :"))
    words = [word for word in words if word not in made]
    out = words.index("-o")
    words[out + 1] = str(folder / program)
    words[out:out] = [*filter(None, made.values()), f"-Wl,-Map={folder / 'map'}"]
    subprocess.run(words, cwd=BUILD, check=True)
    text = (folder / "map").read_text()
    members = set(re.findall(r"/lib(\w+)\.a\((\S+?\.o)\)", text))
    return {o for o in objects(program)
            if any(library in o and o.endswith("/" + name) for library, name in members)
            or re.search(rf"^(LOAD )?{re.escape(o)}$", text, re.M)}


def without(program, removal):
    """The program's path. Throws if something of the effect is left in it."""
    folder = BUILD / "removed" / f"{removal.name}-{program}"
    subprocess.run(["rm", "-rf", folder], check=True)
    overlay(removal, folder)
    own = {str(path.relative_to(testing.ROOT)) for glob in removal.files
           for path in testing.ROOT.glob(glob)}
    if not own:
        raise AssertionError(f"{removal.name} has no files {removal.files}")
    reads, made, seen = read_by(), {}, {}
    for number, (target, words) in enumerate(objects(program).items()):
        if source_of(words) in own or not any(makes_something(path, removal)
                                              for path in reads[target]):
            continue
        made[target] = str(folder / f"{number}.o")
        seen[made[target]] = compiled(words, made[target], folder)
    sources = {target: words for target, words in objects(program).items()
               if source_of(words) in own and target not in made}
    kept = linked(program, folder, {**made, **dict.fromkeys(sources, "")})
    check_gone(removal, own, {o: reads[o] for o in kept if o not in made} | seen)
    return folder / program


def source_of(words):
    return in_tree(words[-1])


def check_gone(removal, own, made_of):
    left = [f"{', '.join(sorted(files & own))} in {made}" for made, files in made_of.items() if files & own]
    if left:
        raise AssertionError(f"{removal.name} is still there: {'; '.join(left)}")
