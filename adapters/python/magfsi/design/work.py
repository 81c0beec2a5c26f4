# SPDX-License-Identifier: GPL-2.0-or-later
"""The whole of a design: search, what follows it, results in a folder; stop and go on."""
import hashlib
import io
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from magfsi.design import manufacture, mesh_file, page, result
from magfsi.design.objective import Points
from magfsi.design.problem import Problem
from magfsi.design.program import Failed
from magfsi.design.search import State, Step

STATE = "state.npz"
SAVED_EVERY_S = 5.0
SAME_SHAPE = 0.01  # of the length, between a shape of the search and that of a rising field


class Lost(RuntimeError):
    """There is no design to write."""


@dataclass
class Done:
    folder: Path
    summary: dict
    text: str


def _key(wanted):
    """Of everything that the search depends on."""
    digest = hashlib.sha256(wanted.file.read_bytes())
    digest.update(repr(sorted(wanted.sets.items())).encode())
    scene = wanted.scene / "scene.yaml" if wanted.scene.is_dir() else wanted.scene
    digest.update(scene.read_bytes())
    for pose in wanted.poses:
        for goal in pose.goals:
            if hasattr(goal, "points_m"):
                digest.update(goal.points_m.tobytes())
    return digest.hexdigest()


def explained(problem):
    search, program, wanted = problem.search, problem.program, problem.wanted
    count = sum(term.count for pose in search.poses for term in pose.terms)
    lines = [f"{wanted.name}: {len(wanted.poses)} pose(s) of body {program.facts['body']}, "
             f"{program.facts['elements']} elements, length {1e3 * problem.length_m:.4g} mm",
             f"unknowns: {search.unknowns.size} ({problem.magnetization.group.count} groups of elements); "
             f"conditions: {count}",
             f"magnetisation: {wanted.magnetization.free}, at most "
             f"{wanted.magnetization.strength / 1e3:.4g} kA/m"]
    for pose in wanted.poses:
        size = np.linalg.norm(pose.field_t)
        lines.append(f"pose {pose.name}: {1e3 * size:.4g} mT"
                     + (f", free: {pose.free}" if pose.free else "")
                     + f"; goals: {', '.join(type(g).__name__.removesuffix('Goal').lower() for g in pose.goals)}")
    return "\n".join(lines)


class Keeper:
    """Saves the search now and then, and tells how far it is."""

    def __init__(self, out, shown):
        self.out, self.key, self.shown = out, "", shown
        self._saved = time.monotonic()
        self._wide = 0

    def __call__(self, search):
        last = search.history[-1]
        if self.shown:
            left = ""
            if 0 < last.share < 1:
                left = f", about {last.seconds / last.share * (1 - last.share) + 5:.0f} s left"
            self._say(f"{100 * last.share:.0f} % of the way, off by {100 * last.rms:.2g} % of the "
                      f"length, {last.seconds:.0f} s{left}")

    def _say(self, text):
        if sys.stderr.isatty():
            print("\r" + text.ljust(self._wide), end="", file=sys.stderr, flush=True)
            self._wide = len(text)
        else:
            print(text, file=sys.stderr, flush=True)

    def save(self, search, state, force=False):
        if not force and time.monotonic() - self._saved < SAVED_EVERY_S:
            return
        self._saved = time.monotonic()
        data = io.BytesIO()
        starts = [s for pose in search.poses for t in pose.terms for s in [t.start_state()]]
        np.savez(data, key=np.array(self.key), p=state.p, share=search.share, damping=search.damping,
                 prior=search.prior,
                 seconds=time.monotonic() - search.began,
                 history=np.array([[s.share, s.rms, s.damping, s.trials, s.lost, s.seconds]
                                   for s in search.history]).reshape(-1, 6),
                 **{f"x{i}": x for i, x in enumerate(state.x)},
                 **{f"f{i}": f for i, f in enumerate(state.support) if f is not None},
                 **{f"s{i}": s for i, s in enumerate(starts)})
        result.write_all(self.out, {STATE: data.getvalue()})

    def kept(self, search):
        """The saved state of the same search, or None."""
        path = self.out / STATE
        if not path.exists():
            return None
        with np.load(path) as data:
            if str(data["key"]) != self.key:
                return None
            search.share, search.damping = float(data["share"]), float(data["damping"])
            search.prior = float(data["prior"])
            search.began -= float(data["seconds"])
            search.history = [Step(*row[:3], int(row[3]), int(row[4]), row[5]) for row in data["history"]]
            for i, term in enumerate(t for pose in search.poses for t in pose.terms):
                term.begin_again(data[f"s{i}"])
            poses = range(len(search.poses))
            return State(data["p"], [data[f"x{i}"] for i in poses],
                         [data[f"f{i}"] if f"f{i}" in data else None for i in poses])


def _pages(problem, search, state, facts, out):
    """All files of a design, by name."""
    designs = search.unknowns.designs(state.p)
    texts = {"magnetization.csv": result.magnetization_text(problem.program, designs[0].magnetization),
             "scene.yaml": result.scene_text(problem, designs, out),
             "history.csv": result.history_text(search)}
    if len(designs[0].thickness):
        texts["mesh.msh"] = mesh_file.gmsh_text(
            problem.program, mesh_file.thickened(problem.program, designs[0].thickness))
    for pose, objective, x in zip(problem.wanted.poses, search.poses, state.x):
        for term in objective.terms:
            if isinstance(term, Points) and term.curve:
                texts[f"shape_{pose.name}.csv"] = result.shape_text(term, x)
    texts["figure.png"] = page.figure(problem, search, state, facts)
    texts["design.html"] = page.assemble(problem, search, facts, texts["figure.png"])
    texts["results.json"] = result.as_json(facts)
    return texts


def _facts(problem, search, state, began):
    vectors = search.unknowns.vectors(state.p)
    made = manufacture.cost(problem.program, vectors, problem.magnetization.strength)
    seen, unknowns, _ = manufacture.seen(search, state)
    facts = result.summary(problem, search, state, {
        "directions": made.directions, "vectors": made.vectors,
        "largest_turn_deg_per_mm": made.largest_turn_deg,
        "seen_by_the_fields": seen, "null_space": unknowns - seen})
    risen = search.risen(state)
    for pose, (found, away_m) in zip(problem.wanted.poses, risen):
        facts["poses"][pose.name] |= {
            "followed_by_the_field": found.share, "away_from_rise": away_m / problem.length_m,
            "reached_by_rise": bool(found.reached and away_m < SAME_SHAPE * problem.length_m)}
    facts["seconds"] = time.monotonic() - began
    return facts


def words(facts, out):
    lines = []
    for name, pose in facts["poses"].items():
        line = f"{name}: mean distance {100 * pose['error']:.2g} % of the length" \
            if pose["error"] < 10 else f"{name}: off by {pose['error']:.2g}"
        if pose["error"] > facts["tolerance"]:
            line += f", more than the {100 * facts['tolerance']:g} % that are asked for"
        if not pose["reached_by_rise"]:
            line += ("; raising the field alone does not lead there (a limit point at "
                     f"{100 * pose['followed_by_the_field']:.0f} % of it)"
                     if pose["followed_by_the_field"] < 1 else
                     "; raising the field alone leads to another shape")
        lines.append(line)
    lines.append(f"{facts['null_space']} of {facts['unknowns']} unknowns are not seen by the fields; "
                 f"{facts['directions']} directions, at most {facts['largest_turn_deg_per_mm']:.0f} "
                 f"degrees a millimetre; {facts['seconds']:.0f} s")
    lines.append(f"{out}/design.html, magnetization.csv, scene.yaml")
    return "\n".join(lines)


def design(wanted, out, quantize=None, overwrite=False, shown=False, options=None):
    """Searches and writes `out`. Raises InputError, with nothing written, and Lost."""
    out = Path(out)
    began = time.monotonic()
    keeper = Keeper(out, shown)
    with Problem(wanted, options=options, tell=keeper) as problem:
        search, keeper.key = problem.search, _key(wanted)
        try:
            state = None if overwrite else keeper.kept(search)
            state = state or search.begin(search.unknowns.start())
            search.each_stage = lambda s: keeper.save(search, s)
            try:
                state = search.stages(state)
            finally:
                if search.latest is not None:
                    keeper.save(search, search.latest, force=True)
            if quantize:
                found = manufacture.quantized(problem, state, quantize)
                if not found:
                    raise Lost(f"no design of {quantize} vectors was found from the one of many; take "
                               "more vectors")
                search, state = found
        except Failed as error:
            raise Lost(str(error)) from error
        facts = _facts(problem, search, state, began)
        if quantize:
            facts["quantized"] = quantize
        result.write_all(out, _pages(problem, search, state, facts, out))
        return Done(out, facts, words(facts, out))
