# SPDX-License-Identifier: GPL-2.0-or-later
"""The search for a design: Gauss and Newton's method with damping (Levenberg, Marquardt) on a goal that
moves.

The goals of all poses move together from the shapes that the body has at the start to those that are
wanted, in stages. Each stage begins with the design and the equilibria of the one before, so that every
trial starts from an equilibrium nearby, in the field at full strength. A trial whose equilibria
cannot be followed from there (Newton's method fails, jumps or meets a limit point) is a step that was
too long: it is shortened, and the design that is accepted always has stable equilibria."""
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np


@dataclass
class State:
    """An accepted design: unknowns, and for each pose its equilibrium and the supports' forces."""
    p: np.ndarray
    x: list
    support: list


@dataclass
class Step:
    """A line of the history."""
    share: float  # of the way from the first shapes to those that are wanted
    rms: float  # against the stage's goal, of the body's length
    damping: float
    trials: int
    lost: int  # trials whose equilibrium was lost
    seconds: float


@dataclass
class Options:
    first_stage: float = 0.1
    stage_iterations: int = 4
    final_iterations: int = 40
    stage_rms: float = 3e-3
    enough_rms: float = 1e-3  # what the poses may be off by
    # Weight of the unknowns' mean square. It begins with the first value and falls, in factors of
    # ten, until the poses are met: of all designs that meet them this is about the weakest, and none
    # that makes up for the last digits of a mesh by large magnetisations to and fro.
    prior: float = 1e-4
    least_prior: float = 1e-9
    largest_move: float = 0.12  # predicted of a point in one trial, in lengths of the body
    trials: int = 12
    limit_s: float = float("inf")


class Search:
    """poses: PoseObjectives; programs: one for each pose (an object may be there several times)."""

    def __init__(self, unknowns, poses, programs, options=None, tell=lambda step: None):
        self.unknowns, self.poses, self.programs = unknowns, poses, programs
        self.options, self.tell = options or Options(), tell
        self.history, self.damping, self.share = [], 1e-3, 0.0
        self.prior = self.options.prior
        self.began = time.monotonic()
        self.latest, self.each_stage = None, lambda state: None
        self.first = unknowns.start()  # the weight is of what differs from it
        # Poses that share a process take turns; the others run at the same time.
        self._turns = {}
        for i, program in enumerate(programs):
            self._turns.setdefault(id(program), []).append(i)
        self._pool = ThreadPoolExecutor(len(self._turns))

    def _each(self, work):
        """work(pose) of all poses, those of different processes at the same time."""
        out = [None] * len(self.poses)

        def of_one(indices):
            for i in indices:
                out[i] = work(i)

        for done in [self._pool.submit(of_one, indices) for indices in self._turns.values()]:
            done.result()
        return out

    # --- equilibria ---

    def _support(self, i, x, design):
        return self.programs[i].support(x, design) if self.poses[i].needs_support else None

    def begin(self, p):
        """The state at the start: each pose by a rise of its loads from the body at rest."""
        designs = self.unknowns.designs(p)
        found = self._each(lambda i: self.programs[i].rise(designs[i]))
        for i, one in enumerate(found):
            if not one.reached:
                found[i] = self.programs[i].release(one.x, designs[i])
        x = [one.x for one in found]
        support = self._each(lambda i: self._support(i, x[i], designs[i]))
        for objective, positions, forces in zip(self.poses, x, support):
            objective.begin(positions, forces)
        return State(p, x, support)

    def moved(self, state, p):
        """The state of other unknowns, followed from this one; None if an equilibrium is lost."""
        old, new = self.unknowns.designs(state.p), self.unknowns.designs(p)
        found = self._each(lambda i: self.programs[i].move(state.x[i], old[i], new[i]))
        if not all(one.reached for one in found):
            return None
        x = [one.x for one in found]
        return State(p, x, self._each(lambda i: self._support(i, x[i], new[i])))

    def residual(self, state, share):
        return np.concatenate([objective.residual(x, share, support) for objective, x, support
                               in zip(self.poses, state.x, state.support)])

    def jacobian(self, state):
        designs = self.unknowns.designs(state.p)

        def of_one(i):
            rows = self.poses[i].rows(state.x[i])
            found = self.programs[i].sensitivity(state.x[i], designs[i], rows.entries, rows.count)
            return self.unknowns.chain(state.p, i, *found)

        return np.concatenate(self._each(of_one))

    def errors(self, state):
        return [objective.error(x, support) for objective, x, support
                in zip(self.poses, state.x, state.support)]

    # --- steps ---

    def _cost(self, r, p):
        away = p - self.first
        return r @ r + self.prior * (away @ away)

    def _direction(self, j, gram, r, p, damping):
        """Minimum of |r + J d|^2 + prior |p + d - first|^2 + damping |d|^2."""
        prior = self.prior
        total = prior + damping
        slope = j.T @ r + prior * (p - self.first)
        if gram is not None:  # fewer residuals than unknowns
            inner = gram + total * np.eye(len(gram))
            d = -(slope - j.T @ np.linalg.solve(inner, j @ slope)) / total
        else:
            d = -np.linalg.solve(j.T @ j + total * np.eye(len(p)), slope)
        return d

    def _decrease(self, j, r, p, d):
        ahead = r + j @ d
        return self._cost(r, p) - self._cost(ahead, p + d)

    def _largest_move(self, change):
        """Largest predicted change of what a residual measures: lengths of the body, or shares of
        the force."""
        first, out = 0, 0.0
        for term in (term for objective in self.poses for term in objective.terms):
            part = change[first:first + term.count]
            first += term.count
            out = max(out, float(np.abs(part).max()) / term.unit)
        return out

    def improved(self, state, share):
        """One accepted step towards the stage's goal; None if no step makes it better."""
        options = self.options
        r, j = self.residual(state, share), self.jacobian(state)
        gram = j @ j.T if len(r) < self.unknowns.size else None
        before, lost = self._cost(r, state.p), 0
        for trial in range(1, options.trials + 1):
            d = self._direction(j, gram, r, state.p, self.damping)
            largest = self._largest_move(j @ d)
            d *= min(1.0, options.largest_move / max(largest, 1e-30))
            expected = self._decrease(j, r, state.p, d)
            if not expected > 1e-3 * before:
                return None
            new = self.moved(state, state.p + d)
            gain = -1.0
            if new is None:
                lost += 1
            else:
                gain = (before - self._cost(self.residual(new, share), new.p)) / expected
            if gain > 1e-3:
                self.damping = max(self.damping * (0.1 if gain > 0.7 else 0.5 if gain > 0.3 else 2.0),
                                   1e-9)
                self.history.append(Step(share, self.rms(new, share), self.damping, trial, lost,
                                         time.monotonic() - self.began))
                self.latest = new
                self.tell(self)
                return new
            self.damping *= 8.0
        return None

    def rms(self, state, share):
        """Root of the mean square of what the poses are off by."""
        return float(np.linalg.norm(self.residual(state, share)) / np.sqrt(len(self.poses)))

    def out_of_time(self):
        return time.monotonic() - self.began > self.options.limit_s

    def stages(self, state):
        """From the share that was reached to the whole way."""
        options, step = self.options, self.options.first_stage
        while self.share < 1 and not self.out_of_time():
            share = min(1.0, self.share + step)
            iterations = 0
            while iterations < options.stage_iterations and self.rms(state, share) > options.stage_rms:
                new = self.improved(state, share)
                if new is not None:
                    state, iterations = new, iterations + 1
                elif self.prior > self.options.least_prior:
                    self.prior *= 0.1
                    self.damping = min(self.damping, 1e-3)
                else:
                    break
            self.share = share
            self.each_stage(state)
            step = min(0.25, step * (1.5 if iterations <= 2 else 1.0 if iterations < 4 else 0.7))
            self.damping = min(self.damping, 1e-2)
        return self.final(state)

    def final(self, state):
        """Iterates on the wanted goal until it is met, or nothing is gained any more."""
        left = self.options.final_iterations
        while self.rms(state, 1.0) > self.options.enough_rms and left > 0 and not self.out_of_time():
            new = self.improved(state, 1.0)
            left -= 1
            if new is not None:
                before, state = self._cost(self.residual(state, 1.0), state.p), new
                if self._cost(self.residual(state, 1.0), state.p) < 0.98 * before:
                    continue
            if self.prior <= self.options.least_prior:
                break
            self.prior *= 0.1
            self.damping = min(self.damping, 1e-3)
        return state

    # --- afterwards ---

    def risen(self, state):
        """For each pose what comes of raising its loads from the body at rest: the equilibrium, and
        how far it lies from the one of the search, largest over nodes [m]."""
        designs = self.unknowns.designs(state.p)
        found = self._each(lambda i: self.programs[i].rise(designs[i]))
        return [(one, float(np.linalg.norm(one.x - x, axis=1).max())) for one, x in zip(found, state.x)]

    def close(self):
        self._pool.shutdown()
