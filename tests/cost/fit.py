# SPDX-License-Identifier: GPL-2.0-or-later
"""The fit of magfsi cost on made-up errors of known orders: how often its bars hold, and how wide
they are."""
import unittest

import numpy as np

from magfsi import testing
from magfsi.cost.fit import Fit, Parameter

CASES = 60
LIMIT = 10.0


def points(count):
    """A star of runs, as variants.star makes it."""
    out = [np.ones(count)]
    for k in range(count):
        for size in (0.75, 0.5):
            out.append(np.where(np.arange(count) == k, size, 1.0))
    return np.array([*out, np.full(count, 0.7)])


def made_up(rng):
    """(a Fit, the errors of its runs): orders 0.9 to 2.3, a next order of a third, a product of
    terms, and noise of up to 3 % of the largest error."""
    count = rng.integers(1, 4)
    orders = rng.uniform(0.9, 2.3, count)
    first = rng.normal(size=count) * 10**rng.uniform(-1, 0, count)
    second = rng.normal(size=count) * 0.3 * np.abs(first)
    both = rng.normal() * 0.3 * np.abs(first).min() if count > 1 else 0
    x = points(count)
    errors = x**orders @ first + x**(orders + 1) @ second + both * x[:, 0] * x[:, -1]
    noise = 10**rng.uniform(-4, -1.5) * np.abs(first).max()
    values = LIMIT + errors + noise * rng.normal(size=len(x))
    nominal = rng.choice([1.0, 2.0], count)
    return Fit([Parameter(str(k), x[None, :, k], nominal[k]) for k in range(count)], values,
               LIMIT), errors


class Bars(unittest.TestCase):
    def test_hold_and_are_no_wider_than_needed(self):
        rng = np.random.default_rng(7)
        held = limits = narrow = 0
        for _ in range(CASES):
            fit, errors = made_up(rng)
            error, bar = fit.errors([np.ones((1, 1))] * len(fit.parameters))
            bound = abs(error[0]) + bar[0]
            held += abs(errors[0]) <= bound
            narrow += bound <= 3 * abs(errors[0])
            limit, limit_bar = fit.limit()
            limits += abs(limit - LIMIT) <= limit_bar
        testing.report(f"of {CASES}: bar holds in {held}, at most 3 times the error in {narrow}; "
                       f"the limit's bar holds in {limits}")
        # What is promised of real cases; 2 sigma would be 95 %.
        self.assertGreaterEqual(held, 0.9 * CASES)
        self.assertGreaterEqual(limits, 0.9 * CASES)
        self.assertGreaterEqual(narrow, 0.5 * CASES)

    def test_a_clean_second_order_is_found(self):
        sizes = np.array([[1.0, 0.75, 0.5, 0.375]])
        fit = Fit([Parameter("h", sizes, 2.0)], 3 + 0.5 * sizes[0]**2, 3)
        limit, bar = fit.limit()
        testing.report(f"limit {limit:.5f} +- {bar:.5f}, order {fit.order(0)}")
        # A tenth of the finest run's error.
        self.assertLess(abs(limit - 3), 0.007)
        self.assertAlmostEqual(fit.order(0)[0], 2, delta=0.3)

    def test_no_effect_no_error(self):
        sizes = np.array([[1.0, 0.75, 0.5]])
        fit = Fit([Parameter("h", sizes, 2.0)], np.full(3, 2.0), 2.0)
        error, bar = fit.errors([np.ones((1, 1))])
        # 100 times what no run resolves (floor).
        self.assertLess(abs(error[0]) + bar[0], 2e-4)


if __name__ == "__main__":
    unittest.main()
