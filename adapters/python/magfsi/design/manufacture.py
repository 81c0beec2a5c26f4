# SPDX-License-Identifier: GPL-2.0-or-later
"""What a magnetisation costs to make, what of it the fields can see, and the design of few vectors that
is nearest to one."""
from dataclasses import dataclass

import numpy as np

from magfsi.design.search import Search
from magfsi.design.unknowns import Unknowns, Vectors

WEAK = 0.05  # of the strength: below it a direction does not matter
SEEN = 1e-3  # singular values above this share of the largest change a shape


@dataclass
class Cost:
    directions: int  # that differ by a degree
    vectors: int  # that differ by a degree or a hundredth of the strength
    largest_turn_deg: float  # over a millimetre


def _distinct(rows):
    return len(np.unique(np.round(rows).astype(int), axis=0)) if len(rows) else 0


def cost(program, vectors, strength):
    size = np.linalg.norm(vectors, axis=1)
    strong = size > WEAK * strength
    unit = vectors[strong] / np.maximum(size[strong, None], 1e-30)
    degree = np.degrees(1.0)
    return Cost(_distinct(unit * degree),
                _distinct(np.column_stack([unit * degree, 100 * size[strong] / strength])),
                _largest_turn(program.centres[strong], unit))


def _largest_turn(centres, unit):
    """Between neighbours: angle over distance, but not more than the angle where they are farther
    apart than a millimetre."""
    from scipy.spatial import cKDTree

    if len(centres) < 2:
        return 0.0
    tree = cKDTree(centres)
    distance, near = tree.query(centres, k=min(7, len(centres)))
    cosine = np.clip(np.einsum("ed,ekd->ek", unit, unit[near]), -1, 1)
    angle = np.degrees(np.arccos(cosine))[:, 1:]
    return float((angle * np.minimum(1e-3 / np.maximum(distance[:, 1:], 1e-12), 1)).max())


def seen(search, state):
    """(unknowns that change what is wanted, all unknowns, basis of those that do): singular values of
    the Jacobian at the design. What lies across them is the null space, which the fields cannot see."""
    _, values, basis = np.linalg.svd(search.jacobian(state), full_matrices=False)
    count = int((values > SEEN * values[0]).sum()) if values[0] > 0 else 0
    return count, search.unknowns.size, basis[:count]


# --- few vectors ---

def _clusters(vectors, volumes, count, seed=0):
    """Centres (count, 3) and choice (elements) of k-means, the best of some starts."""
    random, best = np.random.default_rng(seed), (np.inf, None, None)
    for _ in range(8):
        centres = vectors[random.choice(len(vectors), 1)]
        while len(centres) < count:  # far from those that are there (k-means++)
            away = ((vectors[:, None] - centres[None])**2).sum(axis=2).min(axis=1) * volumes
            if not away.sum() > 0:
                break
            centres = np.vstack([centres, vectors[random.choice(len(vectors), p=away / away.sum())]])
        for _ in range(60):
            choice = ((vectors[:, None] - centres[None])**2).sum(axis=2).argmin(axis=1)
            new = np.array([np.average(vectors[choice == k], axis=0, weights=volumes[choice == k])
                            if (choice == k).any() else centres[k] for k in range(len(centres))])
            if np.allclose(new, centres):
                break
            centres = new
        off = (((vectors - centres[choice])**2).sum(axis=1) * volumes).sum()
        if off < best[0]:
            best = (off, centres, choice)
    return best[1], best[2]


def _assigned(jacobian, residual, vectors, few, choice, volumes, strength):
    """Choice of a vector for each element that makes the linearised residual small, element by
    element until nothing changes: neighbours make up for each other's rounding. jacobian (rows,
    elements, 3): by the vectors; vectors: those of the design with this residual."""
    weight = 1e-7 * volumes / volumes.sum() / strength**2
    now = residual + np.einsum("red,ed->r", jacobian, few[choice] - vectors)
    columns = np.einsum("red,kd->ekr", jacobian, few)
    for _ in range(20):
        changed = 0
        for e in np.random.default_rng(1).permutation(len(choice)):
            without = now - columns[e, choice[e]]
            off = ((without + columns[e])**2).sum(axis=1) \
                + weight[e] * ((few - vectors[e])**2).sum(axis=1)
            k = int(off.argmin())
            if k != choice[e]:
                now, changed = without + columns[e, k], changed + 1
                choice[e] = k
        if not changed:
            break
    return choice


class Quantized(Unknowns):
    """Unknowns of a design of few vectors."""

    def __init__(self, full, vectors):
        super().__init__(vectors, full.fields, full.stiffness, full.thickness)


def _by_vectors(search, state):
    """Derivatives of all residuals by the vectors of the elements."""
    designs = search.unknowns.designs(state.p)

    def of_one(i):
        rows = search.poses[i].rows(state.x[i])
        return search.programs[i].sensitivity(state.x[i], designs[i], rows.entries, rows.count)[0]

    return np.concatenate(search._each(of_one))


def quantized(problem, state, count, rounds=5, parts=16):
    """(search, state) of the design of `count` vectors nearest to a design, optimised again: each
    round chooses a vector for each element by the linearised shapes, follows the equilibria there, and
    improves the vectors. The best round counts."""
    full, volumes = problem.search, problem.program.volumes
    strength = problem.magnetization.strength
    vectors = full.unknowns.vectors(state.p)
    few, choice = _clusters(vectors, volumes, count)
    rest = state.p[full.unknowns.magnetization.size:]
    best, now, at = None, full, state
    for _ in range(rounds):
        choice = _assigned(_by_vectors(now, at), now.residual(at, 1.0), now.unknowns.vectors(at.p),
                           few, choice.copy(), volumes, strength)
        part = Vectors(choice, len(few), volumes, strength, problem.magnetization.axes,
                       problem.magnetization.softness)
        search = Search(Quantized(full.unknowns, part), full.poses, full.programs, full.options,
                        full.tell)
        search.share = 1.0
        p = np.concatenate([part.unknowns_of(few), rest])
        there = _followed(now, at, search, p, parts)
        if there is None:
            break
        there = search.final(there)
        few, rest, now, at = part.few(search.unknowns.part(there.p)), there.p[part.size:], search, there
        if best is None or search.rms(there, 1.0) < best[0].rms(best[1], 1.0):
            best = (search, there)
    return best


def _followed(old, state, new, p, parts):
    """The state of another kind of unknowns: the equilibria followed from one design to the other."""
    from magfsi.design.search import State

    before, after = old.unknowns.designs(state.p), new.unknowns.designs(p)
    found = new._each(lambda i: new.programs[i].move(state.x[i], before[i], after[i], 5))
    if not all(one.reached for one in found):
        return None
    x = [one.x for one in found]
    return State(p, x, new._each(lambda i: new._support(i, x[i], after[i])))
