# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks who knows whom, on the graph of includes, and that no file grows too long.

    include_graph.py REPOSITORY      prints the violations; exit code 1 when there are any
    include_graph.py --self-test     plants violations in a small tree and expects each

What a file sees through other headers counts as much as what it includes itself.
"""
import collections
import os
import pathlib
import re
import sys
import tempfile

ROOMS = ("structure", "fluid_lbm", "coupler", "adapters", "tests", "tutorials", "base")
CODE = {".h", ".cpp", ".H", ".C"}
COUNTED = CODE | {".py", ".cmake"}
LONGEST_FILE = 450
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)

# Room: the rooms that it must not see.
FORBIDDEN_ROOMS = {
    "base/": ("structure/", "fluid_lbm/", "coupler/", "adapters/"),
    "structure/": ("fluid_lbm/", "coupler/", "adapters/"),
    "fluid_lbm/": ("structure/", "coupler/", "adapters/"),
    "coupler/": ("structure/", "fluid_lbm/", "adapters/"),
}
# Headers from outside: the only rooms that may see them.
LAMMPS_ROOMS = ("structure/lammps/", "adapters/", "tests/")
OPENFOAM_ROOMS = ("adapters/solvers/openfoam/",)
# An effect's folder: nobody but itself, and the tests, may see what is in it.
EFFECT = re.compile(r"^.*?/effects/[^/]+/")


def files(root, suffixes):
    for room in ROOMS:
        for path in sorted((root / room).rglob("*")):
            if path.suffix in suffixes or path.name == "CMakeLists.txt":
                yield path


def is_lammps(name, quoted):
    """LAMMPS's headers have bare names ("atom.h"); ours are named from the top, and those
    of other libraries stand in angle brackets."""
    bare = quoted and "/" not in name and name.endswith(".h")
    return bare or name.startswith("lammps/")


def is_openfoam(name):
    return name.endswith(".H")


def edges(root, path):
    """(what is included, whether it is a file of ours, whether in quotes)."""
    for mark, name in INCLUDE.findall(path.read_text(errors="replace")):
        quoted = mark == '"'
        for base in (root, path.parent) if quoted else (root,):
            if (base / name).is_file():
                resolved = os.path.normpath(base / name)  # "../" names a room, too
                yield os.path.relpath(resolved, root), True, quoted
                break
        else:
            yield name, False, quoted


def reason(file, name, ours, quoted):
    """Why file must not see name; None when it may."""
    if ours:
        for room, forbidden in FORBIDDEN_ROOMS.items():
            if file.startswith(room) and name.startswith(forbidden):
                return f"{room} must not know {name.split('/')[0]}/"
        effect = EFFECT.match(name)
        if effect and not file.startswith((effect[0], "tests/")):
            return f"{effect[0]} is an effect's own folder"
        return None
    if is_openfoam(name) and not file.startswith(OPENFOAM_ROOMS):
        return "OpenFOAM headers are for adapters/solvers/openfoam/ only"
    if is_lammps(name, quoted) and not file.startswith(LAMMPS_ROOMS):
        return "LAMMPS headers are for structure/lammps/ and adapters/ only"
    return None


def forbidden_chains(start, graph):
    """The shortest chain of includes to each header that start must not see, and the
    reason. Where a header in between is to blame, start is not."""
    queue = collections.deque([(start,)])
    visited = set()
    while queue:
        chain = queue.popleft()
        for name, ours, quoted in graph.get(chain[-1], ()):
            if (name, quoted) in visited:
                continue
            visited.add((name, quoted))
            why = reason(start, name, ours, quoted)
            if why and not any(reason(f, name, ours, quoted) for f in chain[1:]):
                yield chain + (name,), why
            elif ours and not why:
                queue.append(chain + (name,))


def violations(root):
    graph = {path.relative_to(root).as_posix(): list(edges(root, path))
             for path in files(root, CODE) if path.suffix in CODE}
    found = [f"{' -> '.join(chain)}: {why}"
             for file in graph for chain, why in forbidden_chains(file, graph)]
    for path in files(root, COUNTED):
        lines = path.read_bytes().count(b"\n")
        if lines > LONGEST_FILE:
            name = path.relative_to(root)
            found.append(f"{name}: {lines} lines, at most {LONGEST_FILE}")
    return found, len(graph)


PLANTED = {  # what one more file holds: what the report must say
    ("structure/a.h", '#include "fluid_lbm/fluid.h"'): "must not know fluid_lbm/",
    ("structure/b.h", '#  include "coupler/c.h"'): "must not know coupler/",
    ("structure/c.h", '#include "atom.h"'): "LAMMPS headers are for",
    ("structure/d.h", "#include <lammps/atom.h>"): "LAMMPS headers are for",
    ("structure/e.h", '#include "structure/lammps/fix.h"'): "fix.h -> atom.h: LAMMPS",
    ("fluid_lbm/a.cpp", '#include "adapters/solvers/lbm/p.h"'): "must not know adapters/",
    ("fluid_lbm/b.cpp", "#include <coupler/c.h>"): "must not know coupler/",
    ("coupler/a.h", '#include "structure/mesh.h"'): "must not know structure/",
    ("coupler/b.h", '#include "../fluid_lbm/fluid.h"'): "must not know fluid_lbm/",
    ("coupler/e.h", '#include "adapters/scene/s.h"'): "must not know adapters/",
    ("coupler/d.h", '#include "lammps.h"'): "LAMMPS headers are for",
    ("adapters/solvers/lbm/a.h", '#include "fvCFD.H"'): "OpenFOAM headers are for",
    ("adapters/solvers/lbm/b.h", '#include "adapters/solvers/openfoam/o.h"'): "OpenFOAM headers are for",
    # structure/innocent.h includes this one, and is not to blame.
    ("structure/guilty.h", '#include "fluid_lbm/fluid.h"'): "guilty.h -> fluid_lbm",
    ("structure/lammps/s.cpp", '#include "structure/lammps/effects/drag/drag.h"'):
        "is an effect's own folder",
    ("tests/long.cpp", "\n" * 451): "tests/long.cpp: 451 lines, at most 450",
}
ALLOWED = {
    "structure/mesh.h": "#include <vector>",
    "structure/lammps/fix.h": '#include "atom.h"\n#include "structure/mesh.h"',
    "fluid_lbm/fluid.h": "#include <mpi.h>",
    "coupler/c.h": '#include "coupler/d2.h"',
    "coupler/d2.h": '// the text "fluid_lbm/fluid.h" in a comment is no include',
    "adapters/solvers/lbm/p.h": '#include "fluid_lbm/fluid.h"\n#include "coupler/c.h"',
    "adapters/scene/s.h": '#include "fluid_lbm/fluid.h"\n#include "coupler/d2.h"',
    "adapters/solvers/openfoam/o.h": '#include "fvCFD.H"',
    "structure/innocent.h": '#include "structure/guilty.h"',
    "structure/lammps/effects/drag/drag.h": "#include <vector>",
    "structure/lammps/effects/drag/drag.cpp":
        '#include "structure/lammps/effects/drag/drag.h"',
    "tests/drag.cpp": '#include "structure/lammps/effects/drag/drag.h"',
    "structure/lammps/ok.cpp": '#include "structure/lammps/fix.h"',
    "tests/as_long_as_allowed.cpp": "\n" * 450,
}


def write(root, name, text):
    path = root / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


def self_test():
    failures = []
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder).resolve()
        for name, text in ALLOWED.items():
            write(root, name, text)
        if violations(root)[0]:
            failures.append(f"allowed, yet reported: {violations(root)[0]}")
        for (name, text), expected in PLANTED.items():
            planted = write(root, name, text)
            report, _ = violations(root)
            if len(report) != 1 or expected not in report[0]:
                failures.append(f"planted in {name}: expected '{expected}', got {report}")
            planted.unlink()
    print(f"{len(PLANTED)} planted violations, {len(failures)} failures")
    return failures


def main(argument):
    if argument == "--self-test":
        found = self_test()
    else:
        found, count = violations(pathlib.Path(argument).resolve())
        print(f"{count} files of C++, {len(found)} violations")
        if count == 0:
            found.append(f"{argument} holds no C++ in {', '.join(ROOMS)}")
    print(*found, sep="\n")
    return 1 if found else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
