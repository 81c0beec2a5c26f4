# SPDX-License-Identifier: GPL-2.0-or-later
"""The unknowns of a design as one vector without bounds, and what they mean: a magnetisation within
its strength, fields, factors of stiffness.

Magnetisation of a group of elements: M = strength q / sqrt(softness^2 + |q|^2), which maps all vectors
q onto the ball of that strength; with softness 0 the strength is given and only the direction is free.
q are the unknowns, smoothed over the elements if a length is given. Each is scaled by the root of its
share of the volume, so that the length of the vector is a mean and does not depend on the mesh."""
import numpy as np

from magfsi.design.program import Design


def ball(q, softness):
    """q / sqrt(softness^2 + |q|^2) and its derivatives (..., i, j) = d_i / dq_j."""
    root = np.sqrt(softness**2 + (q**2).sum(axis=-1, keepdims=True))
    root = np.maximum(root, 1e-12)
    out = q / root
    return out, (np.eye(q.shape[-1]) - out[..., :, None] * out[..., None, :]) / root[..., None]


class Groups:
    """Elements that share a value. number: group of each element; sign (elements, 3): what a
    component of the group's vector is multiplied by, -1 in a mirrored half."""

    def __init__(self, number, sign, centres, volumes):
        _, self.number = np.unique(number, return_inverse=True)
        self.sign, self.count = sign, int(self.number.max()) + 1
        self.volumes = np.bincount(self.number, volumes, self.count)
        self.centres = np.stack([np.bincount(self.number, volumes * centres[:, d], self.count)
                                 for d in range(3)], axis=1) / self.volumes[:, None]


def groups(program, by="element", constant_along=(), mirror=None):
    """mirror: an axis; elements at equal distances on both sides of the body's middle share a
    value."""
    centres, volumes = program.centres, program.volumes
    if by == "region":
        return Groups(np.array(program.facts["region"]), np.ones_like(centres), centres, volumes)
    low, high = program.rest.min(axis=0), program.rest.max(axis=0)
    place, sign = centres.copy(), np.ones_like(centres)
    if mirror is not None:
        away = place[:, mirror] - 0.5 * (low + high)[mirror]
        sign[away < -1e-9 * (high - low).max(), mirror] = -1
        place[:, mirror] = np.abs(away)
    place[:, list(constant_along)] = 0
    step = 1e-6 * (high - low).max()
    _, number = np.unique(np.round(place / step).astype(np.int64), axis=0, return_inverse=True)
    return Groups(number.ravel(), sign, centres, volumes)


def smoothing(group, length_m):
    """Matrix of weights exp(-r^2 / (2 length^2)) between groups, each row with the sum 1; None
    without a length."""
    if not length_m:
        return None
    from scipy.sparse import csr_matrix
    from scipy.spatial import cKDTree

    tree = cKDTree(group.centres)
    pairs = tree.sparse_distance_matrix(tree, 3 * length_m, output_type="coo_matrix")
    weights = np.exp(-0.5 * (pairs.data / length_m)**2) * group.volumes[pairs.col]
    matrix = csr_matrix((weights, (pairs.row, pairs.col)), shape=(group.count, group.count))
    return csr_matrix(matrix.multiply(1 / np.asarray(matrix.sum(axis=1))))


class Magnetization:
    """Vectors of groups within a strength, in a plane or in space. axes: components that are free."""

    def __init__(self, group, strength, axes=(0, 1, 2), length_m=0.0, softness=1.0):
        self.group, self.strength, self.axes = group, strength, list(axes)
        self.softness = softness
        self.filter = smoothing(group, length_m)
        share = group.volumes / group.volumes.sum()
        self._root = np.sqrt(np.repeat(share, len(self.axes)))
        self.size = group.count * len(self.axes)

    def start(self, fields):
        """No magnetisation; where its strength is given, along the fields, which turn nothing then, or
        across them if they cancel."""
        if self.softness > 0:
            return np.zeros(self.size)
        ways = np.array([f[self.axes] / max(np.linalg.norm(f), 1e-30) for f in fields])
        way = ways.mean(axis=0)
        if np.linalg.norm(way) < 0.1:
            way = np.eye(len(self.axes))[np.argmin(np.abs(ways[0]))]
        return self.unknowns_of(np.tile(way / np.linalg.norm(way), (self.group.count, 1)))

    def _q(self, unknowns):
        q = (unknowns / self._root).reshape(-1, len(self.axes))
        return self.filter @ q if self.filter is not None else q

    def unknowns_of(self, q):
        """Those that give the vectors q (groups, axes) where nothing is smoothed."""
        return np.asarray(q).ravel() * self._root

    def vectors(self, unknowns):
        """(elements, 3) [A/m]."""
        out = np.zeros((len(self.group.number), 3))
        m, _ = ball(self._q(unknowns), self.softness)
        out[:, self.axes] = self.strength * m[self.group.number]
        return out * self.group.sign

    def chain(self, unknowns, by_vectors):
        """Derivatives by the unknowns of rows with derivatives by_vectors (rows, elements, 3)."""
        signed = (by_vectors * self.group.sign)[..., self.axes]
        of_groups = np.zeros((len(signed), self.group.count, len(self.axes)))
        order = np.argsort(self.group.number, kind="stable")
        first = np.searchsorted(self.group.number[order], np.arange(self.group.count))
        of_groups = np.add.reduceat(signed[:, order], first, axis=1)
        _, slope = ball(self._q(unknowns), self.softness)
        by_q = self.strength * np.einsum("rgi,gij->rgj", of_groups, slope)
        if self.filter is not None:
            rows, count, axes = by_q.shape
            by_q = (self.filter.T @ by_q.transpose(1, 0, 2).reshape(count, -1)) \
                .reshape(count, rows, axes).transpose(1, 0, 2)
        return by_q.reshape(len(by_q), -1) / self._root


class Vectors:
    """Magnetisation of a few vectors: which of them an element has is given."""

    def __init__(self, choice, count, volumes, strength, axes, softness=1.0):
        share = np.bincount(choice, volumes, count) / volumes.sum()
        self.choice, self.count, self.strength, self.axes = choice, count, strength, list(axes)
        self.softness = softness
        self._root = np.sqrt(np.repeat(np.maximum(share, 1e-9), len(self.axes)))
        self.size = count * len(self.axes)

    def _q(self, unknowns):
        return (unknowns / self._root).reshape(-1, len(self.axes))

    def start(self, _fields):
        return np.zeros(self.size)

    def unknowns_of(self, vectors):
        """Of vectors (count, 3) [A/m] within the strength."""
        m = vectors[:, self.axes] / self.strength
        size = np.minimum(np.linalg.norm(m, axis=1, keepdims=True), 0.9999)
        m = m * size / np.maximum(np.linalg.norm(m, axis=1, keepdims=True), 1e-12)
        return (m / np.sqrt(1 - size**2)).ravel() * self._root

    def few(self, unknowns):
        out = np.zeros((self.count, 3))
        out[:, self.axes] = self.strength * ball(self._q(unknowns), self.softness)[0]
        return out

    def vectors(self, unknowns):
        return self.few(unknowns)[self.choice]

    def chain(self, unknowns, by_vectors):
        here = by_vectors[..., self.axes]
        of_few = np.stack([here[:, self.choice == k].sum(axis=1) for k in range(self.count)], axis=1)
        _, slope = ball(self._q(unknowns), self.softness)
        by_q = self.strength * np.einsum("rgi,gij->rgj", of_few, slope)
        return by_q.reshape(len(by_q), -1) / self._root


class Field:
    """The field of a pose: given, of given magnitude with free direction, or free within a magnitude.
    axes: components that are free."""

    def __init__(self, given, free="", largest=0.0, axes=(0, 1, 2)):
        self.given, self.free, self.axes = np.asarray(given, dtype=float), free, list(axes)
        self.largest = largest or np.linalg.norm(self.given)
        self.size = len(self.axes) if free else 0
        self.softness = 0.0 if free == "direction" else 1.0

    def start(self):
        if not self.free:
            return np.zeros(0)
        b = self.given[self.axes] / self.largest
        if self.free == "direction":
            return b / np.linalg.norm(b)
        b *= min(1.0, 0.95 / max(np.linalg.norm(b), 1e-12))
        return b / np.sqrt(1 - b @ b)

    def vector(self, unknowns):
        if not self.free:
            return self.given
        out = np.zeros(3)
        out[self.axes] = self.largest * ball(unknowns, self.softness)[0]
        return out

    def chain(self, unknowns, by_field):
        if not self.free:
            return np.zeros((len(by_field), 0))
        return self.largest * by_field[:, self.axes] @ ball(unknowns, self.softness)[1]


class Factors:
    """Factors on the moduli, or on the thickness, of some regions, each between two bounds."""

    def __init__(self, regions, free, low, high):
        self.regions, self.free, self.low, self.high = regions, list(free), low, high
        self.size = len(self.free)

    def start(self):
        part = np.clip((1 - self.low) / (self.high - self.low), 0.02, 0.98)
        return np.full(self.size, np.log(part / (1 - part)))

    def _part(self, unknowns):
        return 1 / (1 + np.exp(-unknowns))

    def factors(self, unknowns):
        if not self.size:
            return np.zeros(0)
        out = np.ones(self.regions)
        out[self.free] = self.low + (self.high - self.low) * self._part(unknowns)
        return out

    def chain(self, unknowns, by_factors):
        if not self.size:
            return np.zeros((len(by_factors), 0))
        part = self._part(unknowns)
        return by_factors[:, self.free] * (self.high - self.low) * part * (1 - part)


class Unknowns:
    """All of them: magnetisation, stiffness, thickness, then the fields of the poses in turn."""

    def __init__(self, magnetization, fields, stiffness=None, thickness=None):
        none = Factors(0, (), 0, 1)
        self.magnetization, self.fields = magnetization, fields
        self.stiffness, self.thickness = stiffness or none, thickness or none
        sizes = [part.size for part in (magnetization, self.stiffness, self.thickness, *fields)]
        ends = np.cumsum(sizes)
        self._parts = [slice(end - size, end) for size, end in zip(sizes, ends)]
        self.size = int(ends[-1])

    def start(self):
        return np.concatenate([self.magnetization.start([f.given for f in self.fields]),
                               self.stiffness.start(), self.thickness.start(),
                               *(f.start() for f in self.fields)])

    def part(self, p, which=0):
        return p[self._parts[which]]

    def vectors(self, p):
        return self.magnetization.vectors(self.part(p))

    def designs(self, p):
        """One Design for each pose."""
        m = self.vectors(p)
        factors = self.stiffness.factors(self.part(p, 1)), self.thickness.factors(self.part(p, 2))
        return [Design(m, f.vector(self.part(p, 3 + i)), *factors) for i, f in enumerate(self.fields)]

    def chain(self, p, pose, by_magnetization, by_field, by_stiffness, by_thickness):
        """Jacobian (rows, size) of a pose's rows."""
        out = np.zeros((len(by_magnetization), self.size))
        out[:, self._parts[0]] = self.magnetization.chain(self.part(p), by_magnetization)
        out[:, self._parts[1]] = self.stiffness.chain(self.part(p, 1), by_stiffness)
        out[:, self._parts[2]] = self.thickness.chain(self.part(p, 2), by_thickness)
        out[:, self._parts[3 + pose]] = self.fields[pose].chain(self.part(p, 3 + pose), by_field)
        return out
