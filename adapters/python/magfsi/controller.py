# SPDX-License-Identifier: GPL-2.0-or-later
"""The process of a controller in a run: it joins the MPI job, loads the script that the scene's
`control` names, and asks its class Controller for the field whenever the structure asks.

Started by the launcher as one more program of mpirun. docs/control.md says what a script holds;
coupler/participants/controller.cpp is the other end of the messages.
"""
from __future__ import annotations

import ast
import ctypes
import faulthandler
import fcntl
import importlib.util
import json
import math
import os
import pickle
import signal
import struct
import sys
import traceback
from collections.abc import Mapping
from pathlib import Path
from typing import Any

ROLE_STRUCTURE, ROLE_CONTROL = 1, 3  # coupler/participants/world.h
JOINING_TAG, TAG = 75, 76
# A process of the job, as all of them learn of it: role, hash of the scene, program, process.
MEMBER = struct.Struct("=qQ32sqqQ")
STEP = struct.Struct("=qd")  # in front of the probes
EXIT_PARTNER = 4
MODULE = "magfsi_control_script"
NO_CONTROLLER = "no class Controller with a method step"
STEP_TAKES = 3  # self, time, probes


class Nonsense(Exception):
    """What a script has or returns is none of what it may be."""


# --- a process of the job ----------------------------------------------------------------


def die_with_mpirun() -> None:
    """As every process of the job (coupler/participants/processes.cpp)."""
    parent = os.getppid()
    children = Path(f"/proc/{parent}/task/{parent}/children")
    of_mpirun = {"OMPI_COMM_WORLD_LOCAL_SIZE", "PMIX_RANK"} & set(os.environ)
    if of_mpirun and children.exists() and str(os.getpid()) in children.read_text().split():
        ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG
        if os.getppid() == 1:
            os._exit(1)


def hash_of(text: bytes) -> int:
    """coupler/hash.h"""
    value = 14695981039346656037
    for byte in text:
        value = (value ^ byte) * 1099511628211 % 2**64
    return value


def member() -> bytes:
    status = Path("/proc/self/stat").read_text().rpartition(")")[2].split()
    machine = (Path("/proc/sys/kernel/random/boot_id").read_text().strip()
               + os.readlink("/proc/self/ns/pid"))
    return MEMBER.pack(ROLE_CONTROL, 0, b"magfsi.controller", os.getpid(), int(status[19]),
                       hash_of(machine.encode()))


def lock(folder: str) -> int:
    """The run folder stays this run's until this process, too, is gone (FolderLock::member)."""
    file = os.open(Path(folder) / "run.lock", os.O_RDWR | os.O_NOFOLLOW)
    try:
        fcntl.fcntl(file, fcntl.F_OFD_SETLK,
                    struct.pack("hhqqi4x", fcntl.F_RDLCK, os.SEEK_SET, 2, 1, 0))
    except OSError:
        pass  # a file system without locks
    return file


class Link:
    """Messages from and to the structure."""

    def __init__(self) -> None:
        import mpi4py
        mpi4py.rc.threads = False
        from mpi4py import MPI

        world = MPI.COMM_WORLD
        everyone = bytearray(MEMBER.size * world.size)
        world.Allgather(member(), everyone)
        roles = [MEMBER.unpack_from(everyone, MEMBER.size * i)[0] for i in range(world.size)]
        if ROLE_STRUCTURE not in roles or roles.count(ROLE_CONTROL) > 1:
            print("magfsi controller: found "
                  + ("two controllers" if ROLE_STRUCTURE in roles else "no structure")
                  + " in this MPI job; start it with ./magfsi run SCENE", file=sys.stderr)
            world.Abort(EXIT_PARTNER)
        local = world.Split(ROLE_CONTROL, world.rank)
        self.comm = local.Create_intercomm(0, world, roles.index(ROLE_STRUCTURE), JOINING_TAG)
        self.status = MPI.Status()

    def receive(self) -> bytes:
        """Sleeps until the structure wakes this process up, for a core that waits in turns is one
        that the others lack; it looks by itself, too, where that cannot reach it."""
        # The first look takes a message in, and a later one sees it.
        while not any(self.comm.Iprobe(0, TAG, self.status) for _ in range(3)):
            signal.sigtimedwait({signal.SIGUSR2}, 0.02)
        message = bytearray(self.status.Get_count())
        self.comm.Recv(message, 0, TAG)
        return bytes(message)

    def send(self, message: bytes) -> None:
        self.comm.Send(message, 0, TAG)


# --- the script --------------------------------------------------------------------------


def law(answer: Any) -> str:
    """The answer as a map of the scene's `magnetic_field`, in JSON."""
    if isinstance(answer, Mapping):
        return json.dumps({"magnetic_field": answer}, default=float)
    try:
        values = [float(value) for value in answer]
    except (TypeError, ValueError):
        values = []
    if isinstance(answer, str) or len(values) != 3:
        raise Nonsense(f"step returned {answer!r}; allowed are three components of the field [T], "
                       "or a dict such as magnetic_field of the scene takes it")
    if not all(map(math.isfinite, values)):
        raise Nonsense(f"step returned {answer!r}; allowed are finite components of the field [T]")
    return json.dumps({"magnetic_field": {"vector": [f"{value!r} T" for value in values]}})


class Script:
    """The user's: a class Controller, an object of it, and what it is asked."""

    def __init__(self, plan: dict) -> None:
        self.path, self.probes = Path(plan["script"]), plan["probes"]
        sys.path.append(str(self.path.resolve().parent))
        spec = importlib.util.spec_from_file_location(MODULE, self.path)
        module = importlib.util.module_from_spec(spec)
        sys.modules[MODULE] = module  # where pickle looks for its classes
        spec.loader.exec_module(module)
        kind = getattr(module, "Controller", None)
        if not isinstance(kind, type) or not callable(getattr(kind, "step", None)):
            raise Nonsense(NO_CONTROLLER)
        self.controller = None if plan["restored"] else kind()
        if plan["keeps"] and not plan["restored"]:
            self.keep()  # to know now, not when the first checkpoint is written

    def step(self, content: bytes) -> bytes:
        _, time_s = STEP.unpack_from(content)
        values = struct.unpack_from(f"={len(self.probes)}d", content, STEP.size)
        return law(self.controller.step(time_s, dict(zip(self.probes, values)))).encode()

    def keep(self) -> bytes:
        state = pickle.dumps(self.controller, protocol=4)
        pickle.loads(state)  # what cannot come back is no state
        return state

    def restore(self, state: bytes) -> bytes:
        self.controller = pickle.loads(state)
        return b""


def fault_in_text(path: str) -> str:
    """What is seen to be wrong in a script without running it, which may be a stranger's; or ""."""
    try:
        tree = ast.parse(Path(path).read_bytes(), path)
    except (SyntaxError, ValueError) as fault:
        return f"{path}:{getattr(fault, 'lineno', None) or 1}: {getattr(fault, 'msg', fault)}"
    kinds = [node for node in tree.body
             if isinstance(node, ast.ClassDef) and node.name == "Controller"]
    words = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    words |= {name.asname or name.name for node in ast.walk(tree)
              if isinstance(node, (ast.Import, ast.ImportFrom)) for name in node.names}
    if not kinds and not words & {"Controller", "*", "globals"}:
        return f"{path}: {NO_CONTROLLER}"
    steps = [node for kind in kinds for node in kind.body
             if isinstance(node, ast.FunctionDef) and node.name == "step"
             and not node.decorator_list]
    if len(kinds) == len(steps) == 1:
        taken = steps[0].args
        most = len(taken.posonlyargs) + len(taken.args)
        least = most - len(taken.defaults) + sum(v is None for v in taken.kw_defaults)
        if least > STEP_TAKES or (most < STEP_TAKES and taken.vararg is None):
            return (f"{path}:{steps[0].lineno}: step takes {most} arguments; it is called with "
                    "self, the time and the probes")
    if len(kinds) == 1 and not kinds[0].bases and not steps and "step" not in words | {
            node.name for node in ast.walk(kinds[0]) if isinstance(node, ast.FunctionDef)}:
        return f"{path}:{kinds[0].lineno}: {NO_CONTROLLER}"
    return ""


# --- what is asked -----------------------------------------------------------------------


class Served:
    """Answers to the structure, one after the other; faults are answers as well."""

    def __init__(self) -> None:
        self.script: Script | None = None
        self.timeout_s = 0.0
        # Of a call that hangs, in C as well: faulthandler writes here where, at the alarm, and the
        # structure reads it.
        self.trace = os.fdopen(os.memfd_create("trace"), "w")
        faulthandler.register(signal.SIGALRM, file=self.trace, all_threads=False)
        self.locked, self.path = None, ""

    def begin(self, content: bytes) -> bytes:
        plan = json.loads(content)
        self.timeout_s = plan["timeout_s"]
        signal.setitimer(signal.ITIMER_REAL, self.timeout_s)
        self.locked = lock(plan["out"])
        self.path = plan["script"]
        self.script = Script(plan)
        return b""

    def greeting(self) -> bytes:
        return f"=/proc/{os.getpid()}/fd/{self.trace.fileno()}".encode()

    def answer(self, message: bytes) -> bytes:
        kind, content = message[:1], message[1:]
        signal.setitimer(signal.ITIMER_REAL, self.timeout_s)
        try:
            if kind == b"s":
                found = self.script.step(content)
            elif kind == b"k":
                found = self.script.keep()
            elif kind == b"r":
                found = self.script.restore(content)
            else:
                found = self.begin(content) if kind == b"b" else b""
            return b"=" + found
        except Nonsense as fault:
            return f"!the controller {self.path}: {fault}".encode()
        except BaseException:  # SystemExit, too: nothing ends this process but the structure
            return b"!the controller failed:\n" + own_traceback().encode()
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)


def own_traceback() -> str:
    """Of the exception, without the frames of this file."""
    kind, fault, frames = sys.exc_info()
    here = [frame.filename for frame in traceback.extract_tb(frames)]
    while frames.tb_next is not None and here[0] in (__file__, "<frozen importlib._bootstrap>",
                                                     "<frozen importlib._bootstrap_external>"):
        frames, here = frames.tb_next, here[1:]
    return "".join(traceback.format_exception(kind, fault, frames)).rstrip()


def main() -> None:
    if len(sys.argv) > 1:  # a script to look at (adapters/app/run_checks.cpp)
        print(fault_in_text(sys.argv[1]), end="")
        return
    die_with_mpirun()
    # Threads of libraries inherit the mask: the signal is for this one's sleep only.
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGUSR2})
    for ignored in (signal.SIGUSR1, signal.SIGINT):  # the structure answers them
        signal.signal(ignored, signal.SIG_IGN)
    sys.stdout.reconfigure(line_buffering=True)
    sys.dont_write_bytecode = True
    link, served = Link(), Served()
    link.send(served.greeting())
    message = b""
    while message[:1] != b"e":
        message = link.receive()
        link.send(served.answer(message))


if __name__ == "__main__":
    main()
