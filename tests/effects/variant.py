"""A participant as if an effect had never been written: the registration line is taken out of
the effect's list, the files that read the list are compiled anew, and the program is linked
from the other objects of the build. The linker's map shows that nothing of the effect's folder
is in it; that no other file includes one of the folder's headers, house_include_graph shows."""

import functools
import re
import shlex
import subprocess
from pathlib import Path

import magfsi_runs as magfsi

BUILD = magfsi.BIN.parent


@functools.cache
def commands(program):
    """Of its build, the last being that of its link."""
    text = subprocess.run(["ninja", "-C", BUILD, "-t", "commands", program], check=True,
                          capture_output=True, text=True).stdout
    return [line for line in text.splitlines() if not line.startswith("ninja:")]


def list_without(registry, effect, folder):
    """The list of effects with one line less, below a folder to look for headers in."""
    text = (magfsi.ROOT / registry).read_text()
    line = f"MAGFSI_EFFECT({effect})\n"
    if text.count(line) != 1:
        raise AssertionError(f"{registry} has not one line {line}")
    path = folder / registry
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text.replace(line, ""))


def readers(registry):
    """The sources that read the list."""
    include = f'#include "{registry}"'
    return [path for path in Path(magfsi.ROOT, registry).parent.rglob("*.cpp")
            if include in path.read_text()]


def compiled(source, program, folder):
    command = next(c for c in commands(program) if c.endswith(f"-c {source}"))
    target = folder / (source.stem + ".o")
    words = shlex.split(command)
    words[words.index("-o") + 1] = str(target)
    words[words.index("-MF") + 1] = str(target) + ".d"
    compiler = next(i for i, word in enumerate(words) if word.startswith("-"))
    words.insert(compiler, f"-I{folder}")
    subprocess.run(words, cwd=BUILD, check=True)
    return str(target)


def without(program, registry, effect):
    """The program's path. Throws if an object of the effect's folder is still in it."""
    folder = Path(magfsi.new_folder())
    list_without(registry, effect, folder)
    objects = [compiled(source, program, folder) for source in readers(registry)]
    link = commands(program)[-1].removeprefix(": && ").removesuffix(" && :")
    words = shlex.split(link)
    out = words.index("-o")
    words[out + 1] = str(folder / program)
    words[out:out] = [*objects, f"-Wl,-Map={folder / 'map'}"]
    subprocess.run(words, cwd=BUILD, check=True)
    linked = set(re.findall(r"\(([^()]+\.cpp)\.o\)", (folder / "map").read_text()))
    own = {path.name for path in (magfsi.ROOT / registry).parent.glob(f"effects/{effect}/*.cpp")}
    if not own or own & linked:
        raise AssertionError(f"{effect} is still in {program}: {own & linked or 'no folder'}")
    return folder / program
