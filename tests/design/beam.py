# SPDX-License-Identifier: GPL-2.0-or-later
"""A planar beam in the place of magfsi-design: rigid pieces with hinges, exact and quick, so that the
search is tested apart from the solid. The same attributes and functions as of Program."""
import numpy as np

from magfsi.design.program import Found


class Beam:
    """Clamped at x = 0, in the plane xz. Headings of the pieces are its unknowns; hinge i is between
    the pieces i - 1 and i, the first one between the clamp and half a piece."""

    def __init__(self, strip, pieces=60, parts=1):
        """parts: elements in each cross-section, of equal areas."""
        self.strip, self.pieces, self.parts = strip, pieces, parts
        self.piece_m = strip.length_m / pieces
        s = np.linspace(0, strip.length_m, pieces + 1)
        self.rest = np.column_stack([s, np.full_like(s, strip.width_m / 2), np.full_like(s, strip.height_m / 2)])
        middle = 0.5 * (self.rest[1:] + self.rest[:-1])
        self.centres = np.repeat(middle, parts, axis=0)
        self.volumes = np.full(pieces * parts, self.piece_m * strip.area_m2() / parts)
        self.moves = 0
        self.facts = {"body": "strip", "nodes": pieces + 1, "elements": pieces * parts, "regions": [],
                      "region": [], "faces": {}, "held": [7] + [0] * pieces,
                      "element_nodes": [[i, i + 1] * 4 for i in range(pieces) for _ in range(parts)]}
        stiff = np.full(pieces, strip.bending_nm2() / self.piece_m)
        stiff[0] *= 2
        self._elastic = np.diag(stiff)
        self._elastic[np.arange(pieces - 1), np.arange(pieces - 1)] += stiff[1:]
        self._elastic -= np.diag(stiff[1:], 1) + np.diag(stiff[1:], -1)

    def close(self):
        pass

    # --- mechanics ---

    def _moment(self, m):
        """(pieces, 2): in the body, x and z [A m2]."""
        return (m * self.volumes[:, None]).reshape(self.pieces, self.parts, 3).sum(axis=1)[:, [0, 2]]

    def _headings(self, x):
        return np.unwrap(np.arctan2(np.diff(x[:, 2]), np.diff(x[:, 0])))

    def _positions(self, heading):
        x = self.rest.copy()
        x[1:, 0] = np.cumsum(self.piece_m * np.cos(heading))
        x[1:, 2] = self.rest[0, 2] + np.cumsum(self.piece_m * np.sin(heading))
        return x

    def _forces(self, heading, m, field):
        """Residual and tangent: torque of the field less that of the hinges."""
        moment, (bx, bz) = self._moment(m), field[[0, 2]]
        c, s = np.cos(heading), np.sin(heading)
        mx, mz = moment[:, 0] * c - moment[:, 1] * s, moment[:, 0] * s + moment[:, 1] * c
        return mx * bz - mz * bx - self._elastic @ heading, self._elastic + np.diag(mx * bx + mz * bz)

    def _newton(self, heading, m, field):
        """Headings of the stable equilibrium near these, or None."""
        start = heading
        for _ in range(30):
            residual, tangent = self._forces(heading, m, field)
            if np.abs(residual).max() < 1e-13 * self._elastic.max():
                stable = np.linalg.eigvalsh(tangent)[0] > 0
                return heading if stable and np.abs(heading - start).max() < 0.6 else None
            heading = heading + np.linalg.solve(tangent, residual)
            if not np.abs(heading - start).max() < 2:
                return None
        return None

    # --- what Program has ---

    def move(self, x, old, new, halvings=3):
        self.moves += 1
        heading, share, step = self._headings(x), 0.0, 1.0
        while share < 1:
            ahead = min(1.0, share + step)
            m = (1 - ahead) * old.magnetization + ahead * new.magnetization
            found = self._newton(heading, m, (1 - ahead) * old.field + ahead * new.field)
            if found is not None:
                heading, step, share = found, 1.5 * (ahead - share), ahead
            elif step > 2.0**-halvings:
                step = max(0.5 * (ahead - share), 2.0**-halvings)
            else:
                break
        return Found(self._positions(heading), share, 1)

    def rise(self, design):
        from dataclasses import replace

        return self.move(self.rest, replace(design, field=np.zeros(3)), design, 8)

    def release(self, x, design):
        return self.move(x, design, design)

    def support(self, x, design):
        raise NotImplementedError

    def sensitivity(self, x, design, entries, rows):
        heading = self._headings(x)
        _, tangent = self._forces(heading, design.magnetization, design.field)
        by_positions = np.zeros((rows, x.size))
        np.add.at(by_positions, (entries[:, 0].astype(int), entries[:, 1].astype(int)), entries[:, 2])
        after = np.tril(np.ones((self.pieces, self.pieces)))  # of a node by the pieces before it
        grid = by_positions.reshape(rows, -1, 3)[:, 1:]
        by_heading = self.piece_m * (-(grid[..., 0] @ after) * np.sin(heading)
                                     + (grid[..., 2] @ after) * np.cos(heading))
        adjoint = np.linalg.solve(tangent, by_heading.T).T  # (rows, pieces)
        c, s, (bx, bz) = np.cos(heading), np.sin(heading), design.field[[0, 2]]
        by_moment = np.zeros((self.pieces, 3))
        by_moment[:, 0], by_moment[:, 2] = c * bz - s * bx, -s * bz - c * bx
        torque = (by_moment[None] * adjoint[..., None])
        by_m = np.repeat(torque, self.parts, axis=1) * self.volumes[None, :, None]
        moment = self._moment(design.magnetization)
        mx, mz = moment[:, 0] * c - moment[:, 1] * s, moment[:, 0] * s + moment[:, 1] * c
        by_b = np.stack([-adjoint @ mz, np.zeros(rows), adjoint @ mx], axis=1)
        return by_m, by_b, np.zeros((rows, 0)), np.zeros((rows, 0))

    def locate(self, points):
        place = np.clip(np.atleast_2d(points)[:, 0] / self.piece_m, 0, self.pieces - 1e-9)
        first = np.minimum(np.floor(place + 1e-9).astype(int), self.pieces - 1)
        nodes, weights = np.zeros((len(place), 8), dtype=int), np.zeros((len(place), 8))
        nodes[:, 0], nodes[:, 1] = first, first + 1
        weights[:, 1] = place - first
        weights[:, 0] = 1 - weights[:, 1]
        return nodes, weights

    def centre_line(self):
        return self.locate(self.rest)
