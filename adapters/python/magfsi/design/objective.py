# SPDX-License-Identifier: GPL-2.0-or-later
"""What a pose is to be: residuals, one number for each thing that is wanted, and their derivatives by
the positions of the nodes. All residuals are shares: distances of the body's length, forces of the
force that is wanted."""
from dataclasses import dataclass

import numpy as np

from magfsi.design.curves import Between, rotation, turn


@dataclass
class Rows:
    """Entries (row, 3 node + axis, weight, of support) of `count` linear functionals."""
    entries: np.ndarray
    count: int


def _joined(parts):
    entries, first = [], 0
    for part in parts:
        moved = part.entries.copy()
        moved[:, 0] += first
        entries.append(moved)
        first += part.count
    return Rows(np.concatenate(entries) if entries else np.zeros((0, 4)), first)


def _turned(a, b, share):
    """Between a and b as the tip of a body that bends: the angle is linear, and the length comes nearer
    with its square. On a straight line a body would have to be shortened first."""
    size, goal = np.linalg.norm(a), np.linalg.norm(b)
    if min(size, goal) < 1e-9 * max(size, goal, 1e-30):
        return (1 - share) * a + share * b
    return rotation(share * turn(a / size, b / goal)) @ a * (1 + (goal / size - 1) * share**2)


class Points:
    """Material points at places: a centre line on a curve, or single points. pivot: a place that is
    held, about which single points turn on their way."""

    def __init__(self, nodes, weights, goal, weight, length_m, curve, pivot=None):
        self.nodes, self.weights, self.goal = nodes, weights, goal
        self.length_m, self.curve, self.pivot = length_m, curve, pivot
        self.scale = np.sqrt(weight / len(nodes)) / length_m
        self.count, self.unit = 3 * len(nodes), self.scale * length_m

    def places(self, x):
        return np.einsum("pa,pad->pd", self.weights, x[self.nodes])

    def begin(self, x, _support):
        self.begin_again(self.places(x))

    def begin_again(self, start):
        """With a start_state() of before."""
        self._between = Between(start, self.goal) if self.curve else None
        self._start = start

    def start_state(self):
        return self._start

    def target(self, share):
        if self._between:
            return self._between.at(share)
        if self.pivot is None:
            return (1 - share) * self._start + share * self.goal
        return np.array([self.pivot + _turned(a, b, share)
                         for a, b in zip(self._start - self.pivot, self.goal - self.pivot)])

    def residual(self, x, share, _support):
        away = self.places(x) - self.target(share)
        return self.scale * away.ravel()

    def rows(self, x):
        entries = np.zeros((len(self.nodes), 3, 8, 4))
        entries[..., 0] = np.arange(self.count).reshape(-1, 3, 1)
        entries[..., 1] = 3 * self.nodes[:, None, :] + np.arange(3)[:, None]
        entries[..., 2] = self.scale * self.weights[:, None, :]
        entries = entries.reshape(-1, 4)
        return Rows(entries[entries[:, 2] != 0], self.count)

    def distances_m(self, x):
        """Of all points from where they are to be."""
        return np.linalg.norm(self.places(x) - self.goal, axis=1)

    def error(self, x, _support):
        """Mean distance over the body's length."""
        return float(self.distances_m(x).mean() / self.length_m)


class Opening:
    """The distance of two material points."""

    def __init__(self, nodes, weights, goal_m, weight, length_m):
        self.nodes, self.weights, self.goal_m = nodes, weights, goal_m
        self.length_m, self.scale = length_m, np.sqrt(weight) / length_m
        self.count, self.unit = 1, np.sqrt(weight)

    def _apart(self, x):
        a, b = np.einsum("pa,pad->pd", self.weights, x[self.nodes])
        return a - b

    def begin(self, x, _support):
        self._start_m = float(np.linalg.norm(self._apart(x)))

    def begin_again(self, start):
        self._start_m = float(start)

    def start_state(self):
        return np.array(self._start_m)

    def residual(self, x, share, _support):
        goal = (1 - share) * self._start_m + share * self.goal_m
        return np.array([self.scale * (np.linalg.norm(self._apart(x)) - goal)])

    def rows(self, x):
        apart = self._apart(x)
        way = apart / max(np.linalg.norm(apart), 1e-30)
        entries = [(0, 3 * node + d, self.scale * sign * weight * way[d], 0)
                   for sign, nodes, weights in zip((1, -1), self.nodes, self.weights)
                   for node, weight in zip(nodes, weights) for d in range(3)]
        return Rows(np.array(entries), 1)

    def error(self, x, _support):
        return float(abs(np.linalg.norm(self._apart(x)) - self.goal_m) / self.length_m)


class Force:
    """The force of the body on what holds a face, along a direction."""

    def __init__(self, nodes, direction, goal_n, weight):
        self.nodes, self.direction, self.goal_n = nodes, direction, goal_n
        self.scale = np.sqrt(weight) / abs(goal_n)
        self.count, self.unit = 1, np.sqrt(weight)

    def value_n(self, support):
        return float(-(support[self.nodes] @ self.direction).sum())

    def begin(self, _x, support):
        self._start_n = self.value_n(support)

    def begin_again(self, start):
        self._start_n = float(start)

    def start_state(self):
        return np.array(self._start_n)

    def residual(self, _x, share, support):
        goal = (1 - share) * self._start_n + share * self.goal_n
        return np.array([self.scale * (self.value_n(support) - goal)])

    def rows(self, _x):
        entries = [(0, 3 * node + d, -self.scale * self.direction[d], 1)
                   for node in self.nodes for d in range(3)]
        return Rows(np.array(entries), 1)

    def error(self, _x, support):
        return abs(self.value_n(support) - self.goal_n) / abs(self.goal_n)


class PoseObjective:
    """All that one pose is to be."""

    def __init__(self, terms):
        self.terms = terms
        self.needs_support = any(isinstance(term, Force) for term in terms)

    def begin(self, x, support):
        for term in self.terms:
            term.begin(x, support)

    def residual(self, x, share, support=None):
        return np.concatenate([term.residual(x, share, support) for term in self.terms])

    def rows(self, x):
        return _joined([term.rows(x) for term in self.terms])

    def error(self, x, support=None):
        """The largest of its terms."""
        return max(term.error(x, support) for term in self.terms)
