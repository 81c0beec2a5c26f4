# SPDX-License-Identifier: GPL-2.0-or-later
"""Curves: lengths, points at equal shares of the length, and shapes between two curves."""
import numpy as np


def lengths(points):
    """Arc length from the first point, at each point."""
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])


def at_shares(points, shares):
    """Points of a polygon at shares of its length."""
    s = lengths(points)
    return np.stack([np.interp(np.asarray(shares) * s[-1], s, points[:, d]) for d in range(3)], axis=1)


def walk(points, chords):
    """Points along a polygon, from its first one, at these straight distances from each other; past
    its end they go on along the last piece. A mesh bends as straight pieces that keep their lengths:
    to follow a curve its nodes are to be at equal chords, not at equal shares of the arc, which are
    shorter where the curve bends more."""
    ahead = points[-1] - points[-2]
    ahead = ahead / np.linalg.norm(ahead) * (2 * np.sum(chords))
    path = np.vstack([points, points[-1] + ahead])
    out, piece, begin = [points[0]], 0, points[0]
    for chord in chords:
        centre = out[-1]
        while np.linalg.norm(path[piece + 1] - centre) < chord:
            piece, begin = piece + 1, path[piece + 1]
        # Where the rest of this piece leaves the ball of radius `chord` about the last point.
        way, off = path[piece + 1] - begin, begin - centre
        a, b, c = way @ way, off @ way, off @ off - chord**2
        begin = begin + (-b + np.sqrt(max(b * b - a * c, 0.0))) / a * way
        out.append(begin)
    return np.array(out)


def _cross(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def rotation(vector):
    """Matrix of the rotation by |vector| about it."""
    angle = np.linalg.norm(vector)
    if angle < 1e-14:
        return np.eye(3) + _cross(vector)
    k = _cross(vector / angle)
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def turn(a, b):
    """The smallest rotation, as a vector, of the direction a to b."""
    axis = np.cross(a, b)
    sine, cosine = np.linalg.norm(axis), np.dot(a, b)
    if sine < 1e-14:
        if cosine > 0:
            return np.zeros(3)
        axis = np.cross(a, np.eye(3)[np.argmin(np.abs(a))])
        return np.pi * axis / np.linalg.norm(axis)
    return np.arctan2(sine, cosine) * axis / sine


class Between:
    """Shapes between two polygons of equal numbers of points. The bends from piece to piece and
    the lengths of the pieces go linearly from those of `start` to those of `end`, so that a curve
    keeps its length on the way (points that move on straight lines would shorten it).

    anchor: the piece whose place and direction are blended; the rest follows by the bends."""

    def __init__(self, start, end):
        self.start, self.end = start, end
        self._of = [self._measure(points) for points in (start, end)]
        away = np.linalg.norm(end - start, axis=1)
        self._anchor = int(np.argmin(away[:-1] + away[1:]))
        # Bends are counted in a frame that is carried along the curve without twist.
        self._first_turn = turn(self._of[0][1][self._anchor], self._of[1][1][self._anchor])

    @staticmethod
    def _measure(points):
        pieces = np.diff(points, axis=0)
        size = np.linalg.norm(pieces, axis=1)
        return size, pieces / size[:, None]

    def _bends(self, which, frame):
        """Bends between neighbouring pieces in the frame that is carried along from the anchor."""
        _, tangent = self._of[which]
        out = np.zeros((len(tangent) - 1, 3))
        for step in (1, -1):
            carried, i = frame.copy(), self._anchor
            while 0 <= i + step < len(tangent):
                bend = turn(tangent[i], tangent[i + step])
                out[min(i, i + step)] = carried.T @ bend
                carried = rotation(bend) @ carried
                i += step
        return out

    def at(self, share):
        if share <= 0 or share >= 1:
            return (self.start if share <= 0 else self.end).copy()
        end_frame = rotation(self._first_turn)
        bends = ((1 - share) * self._bends(0, np.eye(3)) + share * self._bends(1, end_frame))
        size = (1 - share) * self._of[0][0] + share * self._of[1][0]
        frame = rotation(share * self._first_turn)
        tangent = np.zeros((len(size), 3))
        tangent[self._anchor] = frame @ self._of[0][1][self._anchor]
        for step in (1, -1):
            carried, i = frame.copy(), self._anchor
            while 0 <= i + step < len(tangent):
                turned = rotation(carried @ bends[min(i, i + step)])
                tangent[i + step] = turned @ tangent[i]
                carried = turned @ carried
                i += step
        points = np.concatenate([[np.zeros(3)], np.cumsum(size[:, None] * tangent, axis=0)])
        a = self._anchor
        middle = (1 - share) * self.start[a:a + 2].mean(axis=0) + share * self.end[a:a + 2].mean(axis=0)
        return points + middle - points[a:a + 2].mean(axis=0)
