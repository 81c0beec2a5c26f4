# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes, runs and their results from Python.

    import magfsi

    scene = magfsi.load("tutorials/swimmer", time={"end": "40 ms"})
    run = magfsi.run(scene, fluid={"spacing": "0.2 mm"})
    run.probes["robot.com_z[m]"]        # a pandas table, units in the columns' names
    run.fields("20 ms").points          # numpy: the robot's nodes at that time [m]

    job = magfsi.start(scene)           # in the background
    job.done_until                      # [s] of the scene's time
    job.stop()                          # in order: with a checkpoint if the scene has them

Settings are written as in the scene, in two ways that can be mixed: nested, fluid={"spacing":
"0.1 mm"}, or as paths, {"fluid.spacing": "0.1 mm"}. None takes a key away.
"""
from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time as clock
from pathlib import Path
from typing import TYPE_CHECKING, Any, Mapping

from magfsi import runs, units

if TYPE_CHECKING:
    import numpy
    import pandas


class Error(RuntimeError):
    """What the launcher said last; `code` is its exit code."""

    code = 1


class SceneError(Error):
    """Bad input, with file, line and column; nothing was written."""

    code = runs.EXIT_INPUT


class Diverged(Error):
    """The numbers left their range: what, where, in which step. Results up to there stay."""

    code = 3


class PartnerLost(Error):
    """One side of a coupled run went away."""

    code = 4


def _raise(code: int, text: str) -> None:
    lines = [line for line in text.strip().splitlines() if not line.startswith("warning: ")]
    kind = {3: Diverged, 4: PartnerLost, runs.EXIT_INPUT: SceneError}.get(code, Error)
    raise kind(lines[-1] if lines else f"ended with exit code {code}; run.log in the run folder "
               "says how far it was")


def _flat(settings: Mapping[str, Any], above: str = "") -> dict[str, str]:
    """{path: text as in a scene} of nested settings."""
    flat: dict[str, str] = {}
    for key, value in settings.items():
        path = f"{above}{key}"
        if isinstance(value, Mapping) and not value:
            flat[path] = "{}"  # an effect with its defaults
        elif isinstance(value, Mapping):
            flat.update(_flat(value, path + "."))
        elif isinstance(value, str):
            flat[path] = value
        elif value is None or isinstance(value, (bool, int, float, list, tuple)):
            flat[path] = json.dumps(value)
        else:
            raise TypeError(f"{path}: found {value!r}; allowed are text, numbers, bool, None, "
                            "lists and dicts")
    return flat


def _both(settings: Mapping[str, Any] | None, more: Mapping[str, Any]) -> dict[str, str]:
    return {**_flat(settings or {}), **_flat(more)}


def _environment() -> dict[str, str]:
    root = {name: "1" for name in ("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM")
            if os.geteuid() == 0}
    # The process of a controller finds the package where this one has it.
    path = [str(Path(__file__).resolve().parents[1]), os.environ.get("PYTHONPATH", "")]
    return {**os.environ, **root, "PYTHONPATH": ":".join(filter(None, path))}


def _seconds(time: str | float) -> float:
    if not isinstance(time, str):
        return float(time)
    parsed = units.parse(time)
    if not parsed or parsed[1] != "s":
        raise ValueError(f"'{time}': write a time as '20 ms', or a number of seconds")
    return parsed[0]


class Scene:
    """A scene file with settings laid over it. Made by `load`; never changed."""

    def __init__(self, path: Path, settings: dict[str, str]):
        self.path, self.settings = path, settings
        command = [str(word) for word in runs.command("explain", path, settings)] + ["--json"]
        done = subprocess.run(command, capture_output=True, text=True, env=_environment())
        if done.returncode != 0:
            _raise(done.returncode, done.stderr)
        explained = json.loads(done.stdout)
        self.values: dict = explained["scene"]  # as read: SI units, with all defaults
        self.warnings: list = explained["warnings"]

    @property
    def name(self) -> str:
        return self.values["name"]

    def __getitem__(self, path: str) -> Any:
        """The value at "fluid.spacing", as read: in SI units."""
        value = self.values
        for key in path.split("."):
            if not isinstance(value, Mapping) or key not in value:
                raise KeyError(f"the scene has no '{path}'")
            value = value[key]
        return value

    def with_(self, settings: Mapping[str, Any] | None = None, **more: Any) -> Scene:
        """Another scene: this one with settings. Raises SceneError."""
        return Scene(self.path, {**self.settings, **_both(settings, more)})

    def __repr__(self) -> str:
        return f"Scene({str(self.path)!r}, {self.settings!r})"


def load(path: str | Path, settings: Mapping[str, Any] | None = None, **more: Any) -> Scene:
    """A scene file or a tutorial's folder. Raises SceneError with file, line and column."""
    return Scene(Path(path), _both(settings, more))


class Fields:
    """The bodies at one instant, as written for ParaView."""

    def __init__(self, time_s: float, file: Path):
        self.time_s, self.file = time_s, file

    @property
    def vtk(self) -> Any:
        """The vtkUnstructuredGrid."""
        from vtk import vtkXMLUnstructuredGridReader

        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(self.file))
        reader.Update()
        return reader.GetOutput()

    @property
    def points(self) -> numpy.ndarray:
        """Positions of the nodes (nodes, 3) [m]."""
        from vtk.util.numpy_support import vtk_to_numpy

        return vtk_to_numpy(self.vtk.GetPoints().GetData())

    @property
    def arrays(self) -> dict[str, numpy.ndarray]:
        """What the file holds of nodes and elements, by name."""
        from vtk.util.numpy_support import vtk_to_numpy

        grid = self.vtk
        return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i))
                for data in (grid.GetPointData(), grid.GetCellData())
                for i in range(data.GetNumberOfArrays())}


class Run:
    """A run folder: of a run that ended, or one that goes on."""

    def __init__(self, folder: str | Path):
        self.folder = Path(folder)

    @property
    def summary(self) -> dict:
        """How it ended and what it took; of a run that has ended."""
        return runs.read_summary(self.folder)

    @property
    def columns(self) -> dict[str, list[float]]:
        """The probes by name, such as "robot.com_z[m]", without pandas."""
        return runs.read_table(self.folder / "probes.csv", float)

    @property
    def probes(self) -> pandas.DataFrame:
        """The probes as a table; units are in the columns' names."""
        try:
            import pandas
        except ImportError:
            raise ImportError("run.probes needs pandas (Debian: apt install python3-pandas); "
                              "run.columns has the same as lists") from None
        return pandas.DataFrame(self.columns)

    @property
    def times_s(self) -> list[float]:
        """Times of the rows of `columns`."""
        return self.columns["t[s]"]

    @property
    def field_times_s(self) -> list[float]:
        """Times at which the bodies' fields are there."""
        return [time_s for time_s, _ in runs.frames(self.folder)]

    def fields(self, time: str | float) -> Fields:
        """The bodies at the stored instant nearest to a time: "20 ms", or in seconds."""
        wanted_s = _seconds(time)
        try:
            stored = runs.frames(self.folder)
        except FileNotFoundError:
            raise FileNotFoundError(f"{self.folder} has no fields: output.structure in the scene "
                                    "writes them") from None
        return Fields(*min(stored, key=lambda frame: abs(frame[0] - wanted_s)))

    def __repr__(self) -> str:
        return f"Run({str(self.folder)!r})"


class Job(Run):
    """A run in the background."""

    def __init__(self, scene: Scene, folder: Path, command: list[str], shown: bool):
        super().__init__(folder)
        self.scene = scene
        to = None if shown else subprocess.DEVNULL
        # A file, not a pipe: nobody reads a pipe while the caller does something else.
        self._errors = folder.parent / f".{folder.name}.{os.getpid()}.stderr"
        folder.parent.mkdir(parents=True, exist_ok=True)
        with open(self._errors, "w") as errors:
            self._process = subprocess.Popen(command, stdout=to, stderr=errors,
                                             stdin=subprocess.DEVNULL, env=_environment(),
                                             start_new_session=True)

    def poll(self) -> bool:
        """Whether it has ended."""
        return self._process.poll() is not None

    @property
    def done_until(self) -> float:
        """The scene's time of the last row of probes [s]; 0 before the first."""
        try:
            return self.columns["t[s]"][-1]
        except (FileNotFoundError, KeyError, IndexError):
            return 0.0

    def stop(self) -> None:
        """Ends it in order, with a checkpoint if the scene has them, and waits until it has."""
        if not self.poll():
            self._process.send_signal(signal.SIGTERM)
        self._process.wait()
        self._errors.unlink(missing_ok=True)

    def wait(self, limit_s: float | None = None) -> Run:
        """The run when it has ended. Raises Error and its kinds where it did not end well, and
        TimeoutError after limit_s, when it still goes on."""
        try:
            code = self._process.wait(limit_s)
        except subprocess.TimeoutExpired:
            raise TimeoutError(f"{self.folder} goes on after {limit_s} s") from None
        said = self._errors.read_text() if self._errors.exists() else ""
        self._errors.unlink(missing_ok=True)
        if code != 0:
            _raise(code, said)
        return Run(self.folder)

    def __enter__(self) -> Job:
        return self

    def __exit__(self, *_: Any) -> None:
        self.stop()


def start(scene: Scene | str | Path, settings: Mapping[str, Any] | None = None, *,
          out: str | Path | None = None, ranks: Mapping[str, int] | None = None,
          restart: str | Path | None = None, overwrite: bool = False, shown: bool = False,
          **more: Any) -> Job:
    """Starts a run in the background. out: its folder (runs/NAME); earlier results there move
    to earlier-N in it, or are dropped with overwrite. ranks: {"structure": 1, "fluid": 2};
    restart: "latest" or a checkpoint; shown: its lines go to this terminal. Raises SceneError."""
    scene = scene if isinstance(scene, Scene) else load(scene)
    if settings or more:
        scene = scene.with_(settings, **more)
    folder = Path(out) if out else Path("runs") / scene.name
    options = [*(["--overwrite"] if overwrite else []),
               *(["--ranks", ",".join(f"{side}={n}" for side, n in ranks.items())]
                 if ranks else [])]
    command = runs.run_command(scene.path, folder, scene.settings, restart=restart, more=options)
    return Job(scene, folder, [str(word) for word in command], shown)


def run(scene: Scene | str | Path, settings: Mapping[str, Any] | None = None, *,
        progress: bool | None = None, **named: Any) -> Run:
    """Runs a scene to its end; arguments as of `start`. progress: a bar on the terminal
    (default: where there is one). Raises Error and its kinds; Ctrl-C ends the run in order."""
    job = start(scene, settings, **named)
    if progress is None:
        progress = sys.stderr.isatty()
    try:
        while progress and not job.poll():
            _draw(job)
            clock.sleep(0.2)
        return job.wait()
    except KeyboardInterrupt:
        job.stop()
        raise
    finally:
        if progress:
            print(file=sys.stderr)


def _draw(job: Job, width: int = 40) -> None:
    end_s = job.scene["time"].get("end", 0)
    part = min(1.0, job.done_until / end_s) if end_s else 0.0
    full = round(part * width)
    print(f"\r{job.scene.name} [{'#' * full}{'.' * (width - full)}] {100 * part:3.0f} %", end="",
          file=sys.stderr, flush=True)
