# SPDX-License-Identifier: GPL-2.0-or-later
"""Finite elements apart from magfsi: a block of 27-node hexahedra of eq. (1)'s material, nonlinear.

    W = G/2 (F:F - 3) + K/2 ln^2 J - G ln J,   27 Gauss points,
    or with Gent's -G/2 J_m ln(1 - (F:F - 3)/J_m) in place of the first term,
    energy of the field -integral of F M . B, of the weight rho g z, and of a smooth plane
    k z^2 / 2 on the surface nodes below it (Simpson's areas).

Half of the block, y from 0 to half the width, moves symmetrically in the x-z plane. Equilibria are
minima of the energy: Newton's method with the tangent raised until it has a Cholesky factor, and
steps that lower the energy. Frequencies are of the tangent and the consistent mass matrix.
"""

import itertools

import numpy as np
from scipy.linalg import LinAlgError, cho_solve_banded, cholesky_banded
from scipy.sparse import csc_matrix, diags
from scipy.sparse.linalg import LinearOperator, eigsh


def _line(points):
    """Quadratic shape functions of a line from -1 to 1 and their derivatives: (point, node)."""
    x = np.asarray(points)[:, None]
    return (np.hstack([x * (x - 1) / 2, 1 - x**2, x * (x + 1) / 2]),
            np.hstack([x - 0.5, -2 * x, x + 0.5]))


def _shapes():
    """N and dN/dxi at the 27 Gauss points of the cube, and their weights."""
    at, weight = np.polynomial.legendre.leggauss(3)
    n, d = _line(at)
    order = list(itertools.product(range(3), repeat=3))
    values = np.array([[n[p[0], a[0]] * n[p[1], a[1]] * n[p[2], a[2]] for a in order]
                       for p in order])
    slopes = np.array([[[d[p[0], a[0]] * n[p[1], a[1]] * n[p[2], a[2]],
                         n[p[0], a[0]] * d[p[1], a[1]] * n[p[2], a[2]],
                         n[p[0], a[0]] * n[p[1], a[1]] * d[p[2], a[2]]] for a in order]
                       for p in order])
    return values, slopes, np.array([weight[p[0]] * weight[p[1]] * weight[p[2]] for p in order])


class Block:
    """x_cells: the edges of the cells along x; y_cells and z_cells are evenly spaced.
    gent: the limit J_m; without it the material is neo-Hookean."""

    def __init__(self, x_edges, width, height, y_cells, z_cells, g, k, density, gent=None):
        self.g, self.k, self.density, self.gent = g, k, density, gent
        edges = [np.asarray(x_edges, float), np.linspace(0, width / 2, y_cells + 1),
                 np.linspace(-height / 2, height / 2, z_cells + 1)]
        lines = [np.sort(np.concatenate([e, (e[1:] + e[:-1]) / 2])) for e in edges]
        self.shape = tuple(len(line) for line in lines)
        self.rest = np.stack(np.meshgrid(*lines, indexing="ij"), -1).reshape(-1, 3)
        self.dofs = self.rest.size
        number = np.arange(len(self.rest)).reshape(self.shape)
        cells = itertools.product(*(range(len(e) - 1) for e in edges))
        self.nodes = np.array([number[2 * i:2 * i + 3, 2 * j:2 * j + 3, 2 * l:2 * l + 3].ravel()
                               for i, j, l in cells])
        half = np.array([[h / 2 for h in steps] for steps in
                         itertools.product(*(np.diff(e) for e in edges))])
        self.values, slopes, weights = _shapes()
        self.slopes = slopes[None] / half[:, None, None, :]  # dN/dX: cell, point, node, axis
        self.weights = weights[None] * half.prod(1)[:, None]  # cell, point
        self._bands()

    def _bands(self):
        dof = (3 * self.nodes[:, :, None] + np.arange(3)).reshape(len(self.nodes), -1)
        rows, columns = np.broadcast_arrays(dof[:, :, None], dof[:, None, :])
        self.rows, self.columns = rows.ravel(), columns.ravel()
        self.lower = self.rows >= self.columns
        offset = (self.rows - self.columns)[self.lower]
        self.band = offset.max() + 1
        self.places = offset * self.dofs + self.columns[self.lower]

    def banded(self, matrices):
        """Lower bands of the sum of the cells' 81 x 81 matrices."""
        return np.bincount(self.places, matrices.ravel()[self.lower],
                           self.band * self.dofs).reshape(self.band, self.dofs)

    def scatter(self, forces):
        """Sum of the cells' vectors: (cell, node, axis) to (node, axis)."""
        return np.stack([np.bincount(self.nodes.ravel(), forces[..., d].ravel(),
                                     len(self.rest)) for d in range(3)], -1)

    def node(self, x, y, z):
        distance = np.abs(self.rest - [x, y, z]).max(1)
        assert distance.min() < 1e-9, "no node there"
        return int(distance.argmin())

    def charges(self, magnetization):
        """q: the field's energy is -sum q_a x_a . B. magnetization(x): of points (..., 3)."""
        points = np.einsum("qa,ead->eqd", self.values, self.rest[self.nodes])
        return self.scatter(np.einsum("eq,eqd,eqad->ea", self.weights, magnetization(points),
                                      self.slopes)[..., None] * np.ones(3))[:, 0]

    def masses(self):
        """Row sums of the mass matrix."""
        share = self.density * np.einsum("eq,qa->ea", self.weights, self.values)
        return self.scatter(share[..., None] * np.ones(3))[:, 0]

    def mass_matrix(self):
        one = self.density * np.einsum("eq,qa,qb->eab", self.weights, self.values, self.values)
        return np.einsum("eab,ij->eaibj", one, np.eye(3)).reshape(len(one), 81, 81)

    def surface_areas(self):
        """Of the nodes on the outer faces but that of symmetry, by Simpson's rule."""
        out = np.zeros(self.shape)
        lines = [np.unique(self.rest[:, d].round(12)) for d in range(3)]
        simpson = []
        for line in lines:
            w = np.zeros(len(line))
            for i in range(0, len(line) - 2, 2):
                w[i:i + 3] += (line[i + 2] - line[i]) / 6 * np.array([1, 4, 1])
            simpson.append(w)
        for axis, sides in ((0, (0, -1)), (1, (-1,)), (2, (0, -1))):
            across = [simpson[d] for d in range(3) if d != axis]
            for side in sides:
                at = [slice(None)] * 3
                at[axis] = side
                out[tuple(at)] += np.outer(*across)
        return out.ravel()

    def springs(self, f):
        """(W, 2 W', 4 W'') of F:F at each point."""
        s = (f**2).sum((2, 3)) - 3
        if self.gent is None:
            return self.g / 2 * s, self.g, None
        room = 1 - s / self.gent
        if room.min() <= 0:
            return None, None, None
        return (-self.g / 2 * self.gent * np.log(room), self.g / room,
                2 * self.g / self.gent / room**2)

    def elastic(self, x, tangent):
        """Energy, its gradient (node, axis), and the cells' tangents; energy None if inverted."""
        f = np.einsum("ead,eqak->eqdk", x[self.nodes], self.slopes)
        j = np.linalg.det(f)
        if j.min() <= 0:
            return None, None, None
        stretching, pull, stiffening = self.springs(f)
        if stretching is None:
            return None, None, None
        inverse = np.linalg.inv(f)
        log = np.log(j)
        w = self.weights
        pull = np.broadcast_to(pull, w.shape)
        energy = (w * (stretching + self.k / 2 * log**2 - self.g * log)).sum()
        stress = pull[..., None, None] * f \
            + (self.k * log - self.g)[..., None, None] * inverse.swapaxes(2, 3)
        gradient = self.scatter(np.einsum("eq,eqdk,eqak->ead", w, stress, self.slopes,
                                          optimize=True))
        if not tangent:
            return energy, gradient, None
        cells = len(w)
        here = (self.slopes @ inverse).reshape(cells, 27, 81)  # dN/dx: point, (node, axis)
        turned = here.swapaxes(1, 2)
        volume = turned @ (self.k * w[..., None] * here)
        other = turned @ ((self.g - self.k * log)[..., None] * w[..., None] * here)
        other = other.reshape(cells, 27, 3, 27, 3).swapaxes(2, 4)
        flat = self.slopes.swapaxes(1, 2).reshape(cells, 27, 81)
        spring = flat @ (np.repeat(pull * w, 3, 1)[..., None] * flat.swapaxes(1, 2))
        if stiffening is not None:
            push = np.einsum("eqdk,eqak->eqad", f, self.slopes).reshape(cells, 27, 81)
            volume += push.swapaxes(1, 2) @ ((stiffening * w)[..., None] * push)
        matrix = volume.reshape(cells, 27, 3, 27, 3) + other
        for d in range(3):
            matrix[:, :, d, :, d] += spring
        return energy, gradient, matrix.reshape(cells, 81, 81)


class Solver:
    """field: B [T]; weight: g [m/s2], downward; held: degrees of freedom 3 node + axis."""

    def __init__(self, block, charges, held=(), plane=None):
        """plane: (height [m], stiffness [Pa/m]) of a smooth one below."""
        self.block, self.charges, self.plane = block, charges, plane
        free = np.ones(block.dofs, bool)
        middle = np.flatnonzero(block.rest[:, 1] < 1e-12)
        free[3 * middle + 1] = False
        free[list(held)] = False
        self.free = free
        self.masses = block.masses()
        self.areas = block.surface_areas()
        self.mass_band = block.banded(block.mass_matrix())

    def energy(self, x, field, weight, tangent=False):
        block = self.block
        energy, gradient, cells = block.elastic(x, tangent)
        if energy is None:
            return np.inf, None, None
        dead = self.charges[:, None] * np.asarray(field) - \
            self.masses[:, None] * np.array([0, 0, weight])
        energy -= (dead * x).sum()
        gradient = gradient - dead
        diagonal = None
        if self.plane is not None:
            height, stiffness = self.plane
            depth = np.minimum(x[:, 2] - height, 0)
            energy += (stiffness / 2 * self.areas * depth**2).sum()
            gradient[:, 2] += stiffness * self.areas * depth
            diagonal = stiffness * self.areas * (depth < 0)
        if tangent:
            cells = block.banded(cells)
            if diagonal is not None:
                cells[0, 2::3] += diagonal
        return energy, gradient.ravel() * self.free, cells

    def _factor(self, band):
        band = band.copy()
        for d in np.flatnonzero(~self.free):  # rows and columns of what is held
            band[:, d] = 0
            below = np.arange(1, min(self.block.band, d + 1))
            band[below, d - below] = 0
            band[0, d] = band[0].max()
        return cholesky_banded(band, lower=True, overwrite_ab=True, check_finite=False)

    def solve(self, x, field, weight=0.0, tolerance=1e-9, most=400):
        """The equilibrium from x downhill. The largest nodal force left over the
        sum of all loads is the tolerance."""
        scale = np.abs(self.charges).sum() * np.linalg.norm(field) + self.masses.sum() * weight
        raised, start = 0.0, 1e2  # of the raise, times the mass matrix [1/s2]
        step_limit = 0.3 * np.ptp(self.block.rest[:, 2])
        energy, gradient, band = self.energy(x, field, weight, tangent=True)
        for _ in range(most):
            try:
                factor = self._factor(band + raised * self.mass_band if raised else band)
            except LinAlgError:
                raised = max(start, 4 * raised)
                continue
            if np.abs(gradient).max() < tolerance * scale and raised == 0:
                return x
            move = -cho_solve_banded((factor, True), gradient, check_finite=False)
            move *= min(1.0, step_limit / np.abs(move).max())
            share, slope = 1.0, gradient @ move
            while share > 1e-3:
                there = x + share * move.reshape(-1, 3)
                if self.energy(there, field, weight)[0] <= \
                        energy + 1e-4 * share * slope + 1e-13 * abs(energy):
                    break
                share /= 2
            else:  # nodes come to the plane or leave it
                raised = max(start, 4 * raised)
                continue
            x = there
            energy, gradient, band = self.energy(x, field, weight, tangent=True)
            raised = 0.0 if raised < 2 * start else raised / (8 if share == 1 else 1)
        raise RuntimeError("no equilibrium")

    def frequencies(self, x, field, weight=0.0, number=6):
        """Lowest squares of circular frequencies of what is free, and their modes."""
        band = self.energy(x, field, weight, tangent=True)[2]
        shift = 1.0  # (1 rad/s)^2: below all but rigid motions
        factor = self._factor(band + shift * self.mass_band)
        matrices = [self._sparse(b) for b in (band, self.mass_band)]
        keep = np.flatnonzero(self.free)
        stiffness, mass = (m[keep][:, keep] for m in matrices)

        def inverse(v):
            full = np.zeros(self.block.dofs)
            full[keep] = v
            return cho_solve_banded((factor, True), full, check_finite=False)[keep]

        n = len(keep)
        squares, modes = eigsh(stiffness, number, mass, sigma=-shift,
                               OPinv=LinearOperator((n, n), inverse))
        shapes = np.zeros((number, self.block.dofs))
        shapes[:, keep] = modes.T
        return squares, shapes.reshape(number, -1, 3)

    def _sparse(self, band):
        size = self.block.dofs
        lower = diags([band[k, :size - k] for k in range(len(band))],
                      [-k for k in range(len(band))], format="csc")
        return csc_matrix(lower + lower.T - diags(lower.diagonal()))
