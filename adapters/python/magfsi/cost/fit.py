# SPDX-License-Identifier: GPL-2.0-or-later
"""The error of a scene as a sum over its numerical parameters, fitted to a few runs.

    y(u) = Q + sum_k (c_k u_k^p_k + d_k u_k^(p_k + 1)) + sum_k<l e_kl u_k^p_k u_l^p_l

y is a number of a run, u_k the size of parameter k over that of the coarsest run. A lattice's step
may act another way: finer ones at the same spacing lower the relaxation time and with it what the
collision resolves, so that the spacing's error grows, as u_h^p log(1 / u), and goes with the
spacing alone; runs finer in both tell it from a step whose error stays. The orders
p_k are not known: all between 0.8 and 2.5 are admissible (L. Eca, M. Hoekstra, J. Comput. Phys.
262 (2014) 104, let the observed order in that range and fall back on 1 and 2 elsewhere; T. Xing,
F. Stern, J. Fluids Eng. 132 (2010) 061403, widen the bar where it is far from the formal one).
Each choice of orders and of noise is a linear least-squares problem with Gaussian priors, whose
marginal likelihood is its weight; the bar covers the spread over all of them, the noise, and what
leaving out any one run changes.
"""
import itertools
from dataclasses import dataclass

import numpy as np

ORDERS = (0.8, 1.0, 1.3, 1.6, 2.0, 2.5)
FEW_ORDERS = (0.9, 1.4, 2.2)  # of parameters with the lesser arms, beyond two
ORDER_SPREAD = 0.45  # of the prior, in ln(order) about the nominal one
NOISE = (3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1)  # of the largest arm; all alike likely at first
LEADING = 10.0  # prior of c_k: as good as free, in sizes of the parameter's arm
NEXT = 0.35  # of d_k: runs are coarse, the next order is not negligible
BOTH = 0.5  # of e_kl, of the mean of the two arms (the geometric one)
SIGMAS = 2.0  # of the bar: 95 % of a normal distribution
SCALES = -1  # the measure of a parameter that scales another's error
KEPT = 400  # hypotheses, by weight
NEGLIGIBLE = 0.01  # of the largest arm: such a parameter's order is not looked for


@dataclass
class Parameter:
    """sizes: of each run; a row for each way to measure them (a step by itself, or relative to
    the spacing), all of them admissible."""
    name: str
    sizes: np.ndarray  # (measures, runs)
    nominal: float  # order
    scaled: int = None  # the parameter whose error it may scale
    scales: bool = False  # it does; its own error is not looked for


@dataclass
class Hypothesis:
    orders: tuple
    measures: tuple
    sigma: float
    weight: float
    mean: np.ndarray
    covariance: np.ndarray


def _features(u, orders, scaled):
    """(choices, points, features): constant, leading terms, next terms, products; of sizes
    (points, parameters) and orders (choices, parameters). scaled: {parameter: the one whose error
    it scales}."""
    powers = u[None, :, :]**orders[:, None, :]
    following = u[None, :, :] * powers
    for k, other in scaled.items():
        powers[:, :, k] = powers[:, :, other] * -np.log(np.minimum(u[:, k], 1))
        following[:, :, k] = u[:, k]**2  # compressibility
    pairs = [powers[:, :, k] * powers[:, :, m]
             for k, m in itertools.combinations(range(u.shape[1]), 2)]
    return np.concatenate([np.ones_like(powers[:, :, :1]), powers, following,
                           *(p[:, :, None] for p in pairs)], axis=2)


def arm(sizes, k):
    """Runs that differ in parameter k only, from large sizes to small: the most of them that there
    are. sizes: (runs, parameters)."""
    others = np.delete(sizes, k, axis=1)
    best = []
    for row in others:
        alike = np.flatnonzero(np.all(np.abs(others - row) <= 1e-6 * np.abs(row), axis=1))
        _, first = np.unique(sizes[alike, k], return_index=True)
        if len(first) > len(best):
            best = alike[first]
    return np.array(best, dtype=int)[::-1]


class Fit:
    """Of one number of all runs. Errors are signed: value less limit."""

    def __init__(self, parameters, values, scale, floor=1e-6, settings=None):
        """scale: of the values, for what is negligible and (floor) what no run resolves.
        settings (runs, parameters) tell which runs differ in one only; without it, sizes do."""
        self.parameters = parameters
        self.values = np.asarray(values, float)
        first = np.array([p.sizes[0] for p in parameters]).T.reshape(len(self.values), -1)
        alike = first if settings is None else np.asarray(settings, float)
        self.arms = [arm(alike, k) for k in range(len(parameters))]
        self.coarsest = [p.sizes.max(axis=1) for p in parameters]
        self.ranges = np.array([np.ptp(self.values[a]) for a in self.arms])
        self.floor = floor * scale
        widest = max([*self.ranges, np.ptp(self.values), self.floor])
        # An arm shows only a part of its parameter's error, even one of first order.
        shown = np.array([max(0.2, 1 - first[a, k].min() / first[a, k].max()) if len(a) else 1
                          for k, a in enumerate(self.arms)])
        self.sizes = np.maximum(self.ranges / shown, 1e-4 * widest)
        self.widest = widest
        self.hypotheses = self._weighed(self._choices(), np.arange(len(self.values)))
        self._without = None

    def _choices(self):
        """{measures: (orders (choices, parameters), logarithms of their priors)}."""
        each, large = [], np.sort(self.ranges)[-2:]
        for k, p in enumerate(self.parameters):
            known = self.ranges[k] < NEGLIGIBLE * self.widest
            orders = (p.nominal,) if known else (
                ORDERS if self.ranges[k] >= large[0] else FEW_ORDERS)
            measures = range(1 if known else len(p.sizes))
            each.append([(o, m) for o in orders for m in measures])
            if p.scaled is not None and not known:
                each[-1] = [*([] if p.scales else each[-1]), (p.nominal, SCALES)]
        found = {}
        for choice in itertools.product(*each):
            found.setdefault(tuple(m for _, m in choice), []).append([o for o, _ in choice])
        nominal = np.array([p.nominal for p in self.parameters])
        return {measures: (np.array(orders), -0.5 * np.sum(
            (np.log(np.array(orders) / nominal) / ORDER_SPREAD)**2, axis=1))
            for measures, orders in found.items()}

    def _rows(self, sizes, orders, measures):
        """Features of settings; sizes: (parameters of (measures, points))."""
        u = [s[max(m, 0)] / self.coarsest[k][max(m, 0)]
             for k, (s, m) in enumerate(zip(sizes, measures))]
        return _features(np.column_stack(u), np.asarray(orders),
                         {k: self.parameters[k].scaled
                          for k, m in enumerate(measures) if m == SCALES})

    def _prior(self, measures):
        following = np.where(np.array(measures) == SCALES, 1, NEXT)
        pairs = [BOTH * np.sqrt(a * b) for a, b in itertools.combinations(self.sizes, 2)]
        level = 10 * np.abs(self.values).max() + 100 * self.widest
        return np.concatenate([[level], LEADING * self.sizes, following * self.sizes, pairs])**2

    def _weighed(self, choices, kept):
        """Hypotheses of the runs kept, by their marginal likelihood."""
        y = self.values[kept]
        noise = np.hypot(np.array(NOISE) * self.widest, self.floor)**2
        found = []
        for measures, (orders, log_prior) in choices.items():
            x = self._rows([p.sizes for p in self.parameters], orders, measures)[:, kept]
            prior = self._prior(measures)
            spread, axes = np.linalg.eigh((x * prior) @ x.transpose(0, 2, 1))
            seen = np.einsum("hij,i->hj", axes, y)
            evidence = np.maximum(spread, 0)[:, None, :] + noise[None, :, None]
            weight = log_prior[:, None] - 0.5 * np.sum(
                seen[:, None, :]**2 / evidence + np.log(evidence), axis=2)
            for h, s in np.argwhere(weight > weight.max() - 12):
                found.append((weight[h, s], orders[h], measures, s, x[h], prior,
                              axes[h], seen[h], evidence[h, s]))
        found = sorted(found, key=lambda f: -f[0])[:KEPT]
        out = []
        for weight, orders, measures, s, x, prior, axes, seen, evidence in found:
            if weight < found[0][0] - 12:
                break
            gain = (axes / np.sqrt(evidence)).T @ (x * prior)
            out.append(Hypothesis(tuple(orders), measures, np.sqrt(noise[s]),
                                  np.exp(weight - found[0][0]), gain.T @ (seen / np.sqrt(evidence)),
                                  np.diag(prior) - gain.T @ gain))
        total = sum(h.weight for h in out)
        for h in out:
            h.weight /= total
        return out

    def _moments(self, hypotheses, rows):
        """rows(hypothesis): functionals (points, features). Means and standard deviations."""
        mean = second = 0
        for h in hypotheses:
            g = rows(h)
            m = g @ h.mean
            mean = mean + h.weight * m
            second = second + h.weight * (np.einsum("ij,jk,ik->i", g, h.covariance, g) + m**2)
        return mean, np.sqrt(np.maximum(0, second - mean**2))

    def _leaving_one_out(self):
        """Hypotheses of the likeliest orders, without each run in turn."""
        if self._without is None:
            likely = {}
            for h in self.hypotheses[:40]:
                likely.setdefault(h.measures, set()).add(h.orders)
            likely = {m: (np.array(sorted(o)), np.zeros(len(o))) for m, o in likely.items()}
            every = np.arange(len(self.values))
            self._without = [self._weighed(likely, np.delete(every, i)) for i in every
                             ] if len(every) > 3 else []
        return self._without

    def _bar(self, rows):
        mean, spread = self._moments(self.hypotheses, rows)
        bar = SIGMAS * spread
        for others in self._leaving_one_out():
            moved, _ = self._moments(others, rows)
            bar = np.maximum(bar, np.abs(moved - mean))
        return mean, bar

    def limit(self):
        """(value, bar) with all parameters at zero."""
        mean, bar = self._bar(lambda h: np.eye(1, len(h.mean)))
        return float(mean[0]), float(bar[0])

    def errors(self, sizes, only=None):
        """(errors, bars) of settings; sizes: for each parameter (measures, settings). only: of
        that parameter's terms alone."""
        count = len(self.parameters)

        def rows(h):
            g = self._rows(sizes, [h.orders], h.measures)[0]
            g[:, 0] = 0
            if only is not None:
                mine = np.zeros(g.shape[1], bool)
                mine[[1 + only, 1 + count + only]] = True
                g[:, ~mine] = 0
            return g
        return self._bar(rows)

    def order(self, k):
        """Mean and standard deviation over the hypotheses."""
        values = np.array([h.orders[k] for h in self.hypotheses])
        weights = np.array([h.weight for h in self.hypotheses])
        mean = float(weights @ values)
        return mean, float(np.sqrt(max(0, weights @ values**2 - mean**2)))
