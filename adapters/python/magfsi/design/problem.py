# SPDX-License-Identifier: GPL-2.0-or-later
"""From a design file to a search: programs, unknowns, objectives. Checks what only the body shows."""
import os

import numpy as np

from magfsi.design import curves
from magfsi.design.design_file import CurveGoal, ForceGoal, OpeningGoal, PointGoal
from magfsi.design.objective import Force, Opening, Points, PoseObjective
from magfsi.design.program import Failed, Program
from magfsi.design.search import Options, Search
from magfsi.design.unknowns import Factors, Field, Magnetization, Unknowns, groups
from magfsi.study.marked import InputError

LENGTH_TOLERANCE = 0.02  # of a curve against the centre line, and of its start at a clamp


class Reach:
    """How far each node can be from what is held: along the edges and diagonals of the elements."""

    def __init__(self, program):
        from scipy.sparse import coo_matrix
        from scipy.sparse.csgraph import dijkstra

        held = np.array(program.facts["held"])
        self.held = np.flatnonzero(held == 7)
        self.rest = program.rest
        self.length_m = None
        if not len(self.held):
            return
        elements = np.array(program.facts["element_nodes"])
        a, b = np.triu_indices(8, 1)
        ends = np.stack([elements[:, a].ravel(), elements[:, b].ravel()])
        size = np.linalg.norm(self.rest[ends[0]] - self.rest[ends[1]], axis=1)
        ends, first = np.unique(np.sort(ends, axis=0), axis=1, return_index=True)
        graph = coo_matrix((size[first], ends), shape=(len(self.rest),) * 2)
        self.length_m = dijkstra(graph.tocsr(), directed=False, indices=self.held, min_only=True)

    def _away(self, places):
        """Distances from the nearest node that is held."""
        return np.linalg.norm(places[:, None] - self.rest[self.held][None], axis=2).min(axis=1)

    def nearest(self, place):
        """The place of the nearest node that is held, or None."""
        if self.length_m is None:
            return None
        return self.rest[self.held[np.argmin(np.linalg.norm(self.rest[self.held] - place, axis=1))]]

    def check(self, mark, nodes, weights, goal):
        """Refuses places farther from everything held than the body is long."""
        if self.length_m is None:
            return
        most = (weights * self.length_m[nodes]).sum(axis=1)
        # A point between nodes that are held is at some distance from each of them.
        places = np.einsum("pa,pad->pd", weights, self.rest[nodes])
        most = 1.02 * np.maximum(most, self._away(places))
        away = self._away(goal)
        # Nodes that are held stay where they are, but for rounding of what was typed.
        most = np.maximum(most, LENGTH_TOLERANCE * np.ptp(self.rest, axis=0).max())
        worst = int(np.argmax(away - most))
        if away[worst] > most[worst]:
            mark.refuse(f"the place {_mm(goal[worst])} out of reach: {1e3 * away[worst]:.4g} mm from "
                        "what is held", f"at most {1e3 * most[worst]:.4g} mm for this point of the body")


def _mm(point):
    return "(" + ", ".join(f"{1e3 * c:.4g}" for c in point) + ") mm"


def _in_plane(wanted, rest, axes):
    """Places wanted, of a body that stays in a plane: across it where they are at rest. Strips that
    are to bend twist otherwise, as little resists it."""
    out = rest.copy()
    out[:, list(axes)] = wanted[:, list(axes)]
    return out


def _curve(goal, program, reach, axes, length_m):
    nodes, weights = program.centre_line()
    if len(nodes) < 2:
        goal.mark.refuse("a curve for a body without a centre line",
                         "points, or a mesh with one: a block, an arc, a helix, or the line "
                         "centre_line of a Gmsh file")
    line = np.einsum("pa,pad->pd", weights, program.rest[nodes])
    body_m, curve_m = curves.lengths(line)[-1], curves.lengths(goal.points_m)[-1]
    if abs(curve_m / body_m - 1) > LENGTH_TOLERANCE:
        goal.mark.refuse(f"a curve {1e3 * curve_m:.4g} mm long",
                         f"the length of the body's centre line within 2 %: {1e3 * body_m:.4g} mm")
    wanted = curves.walk(goal.points_m, np.diff(curves.lengths(line)))
    some = np.unique(np.round(np.linspace(0, len(line) - 1, min(goal.count, len(line)))).astype(int))
    nodes, weights, wanted = nodes[some], weights[some], _in_plane(wanted[some], line[some], axes)
    reach.check(goal.mark, nodes, weights, wanted)
    return Points(nodes, weights, wanted, goal.weight, length_m, curve=True)


def _term(goal, program, reach, axes, length_m):
    if isinstance(goal, CurveGoal):
        return _curve(goal, program, reach, axes, length_m)
    if isinstance(goal, ForceGoal):
        faces = program.facts["faces"]
        if goal.face not in faces:
            goal.mark.refuse(f'the face "{goal.face}"', ", ".join(faces))
        nodes = np.array(faces[goal.face])
        if not (np.array(program.facts["held"])[nodes] > 0).any():
            goal.mark.refuse(f'the face "{goal.face}", which nothing holds', "a face with a clamp")
        return Force(nodes, goal.direction, goal.force_n, goal.weight)
    places = goal.between_m if isinstance(goal, OpeningGoal) else goal.at_m[None]
    try:
        nodes, weights = program.locate(places)
    except InputError as error:
        goal.mark.refuse(str(error), "points of the body at rest")
    if isinstance(goal, OpeningGoal):
        return Opening(nodes, weights, goal.distance_m, goal.weight, length_m)
    rest = np.einsum("pa,pad->pd", weights, program.rest[nodes])
    wanted = _in_plane(goal.to_m[None], rest, axes)
    reach.check(goal.mark, nodes, weights, wanted)
    return Points(nodes, weights, wanted, goal.weight, length_m, curve=False, pivot=reach.nearest(rest[0]))


class Problem:
    """A design file with the programs that know its body. `search` looks for the design."""

    def __init__(self, wanted, processes=None, options=None, tell=lambda search: None):
        self.wanted = wanted
        count = min(len(wanted.poses), processes or len(os.sched_getaffinity(0)))
        self.own = []
        try:
            for _ in range(count):
                self.own.append(Program(wanted.scene, wanted.body, wanted.sets))
            self._assemble(options, tell)
        except BaseException as error:
            self.close()
            if isinstance(error, Failed):
                raise Failed(f"{wanted.file}: {error}") from error
            raise

    @property
    def program(self):
        return self.own[0]

    def _assemble(self, options, tell):
        wanted, program = self.wanted, self.program
        m = wanted.magnetization
        if m.by == "region" and not program.facts["regions"]:
            m.mark.refuse("by: region for a body without regions", "by: element, or regions in the scene")
        group = groups(program, m.by, m.constant_along, m.mirror)
        self.magnetization = Magnetization(group, m.strength, m.axes, m.smoothing_m,
                                           softness=0.0 if m.free == "direction" else 1.0)
        fields = [Field(p.field_t, p.free, p.largest_t, m.axes) for p in wanted.poses]
        self.unknowns = Unknowns(self.magnetization, fields, self._factors(wanted.stiffness),
                                 self._factors(wanted.thickness))
        line = np.ptp(program.rest, axis=0)
        self.length_m = float(line.max())
        nodes, weights = program.centre_line()
        if len(nodes) > 1:
            self.length_m = float(curves.lengths(
                np.einsum("pa,pad->pd", weights, program.rest[nodes]))[-1])
        reach = Reach(program)
        poses = [PoseObjective([_term(g, program, reach, m.axes, self.length_m)
                                for g in p.goals]) for p in wanted.poses]
        programs = [self.own[i % len(self.own)] for i in range(len(poses))]
        self.search = Search(self.unknowns, poses, programs, options or Options(), tell)

    def _factors(self, wanted):
        names = self.program.facts["regions"]
        if not wanted:
            return None
        for name in wanted.regions:
            if name not in names:
                wanted.mark.refuse(f'the region "{name}"', ", ".join(names) or "none: the body has none")
        return Factors(len(names), [names.index(n) for n in wanted.regions], wanted.low, wanted.high)

    def close(self):
        if hasattr(self, "search"):
            self.search.close()
        for program in self.own:
            program.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
