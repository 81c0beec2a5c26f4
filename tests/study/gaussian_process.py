# SPDX-License-Identifier: GPL-2.0-or-later
"""Questions by a Gaussian process: close to a known least value in few runs, the same whenever asked."""
import math
import sys
import unittest

import numpy as np

try:
    import sklearn  # noqa: F401
except ImportError:
    sys.exit(print("no python3-sklearn: not run"))
import optuna
from magfsi import testing
from magfsi.optimize import gaussian_process

LEAST = 0.397887  # of Branin's function, at three places
FAILED = 1e30
optuna.logging.set_verbosity(optuna.logging.ERROR)


def branin(u, v):
    """Dixon and Szego, Towards Global Optimisation 2 (1978), on the unit square."""
    x, y = 15 * u - 5, 15 * v
    return ((y - 5.1 * x * x / (4 * math.pi**2) + 5 * x / math.pi - 6)**2
            + 10 * (1 - 1 / (8 * math.pi)) * math.cos(x) + 10)


def asked(study, number, seed=100_003, start=None):
    study.sampler = gaussian_process.sampler(optuna, seed + number, ["u", "v"], start, 1e18, number)
    space = optuna.distributions.FloatDistribution(0, 1)
    return study.ask({"u": space, "v": space})


class Questions(unittest.TestCase):
    def test_come_close_to_branins_least_value_in_30_runs(self):
        study, values = optuna.create_study(), []
        for number in range(30):
            trial = asked(study, number)
            # Where runs fail, on a quarter of the square, it learns to stay away.
            failed = trial.params["u"] > 0.6 and trial.params["v"] < 0.4
            values.append(FAILED if failed else branin(**trial.params))
            study.tell(trial, values[-1])
        testing.report(f"{min(values) - LEAST:.2g} above the least value")
        self.assertLess(min(values) - LEAST, 0.02)
        self.assertLess(values[10:].count(FAILED), 4)

    def test_are_the_same_again(self):
        def whole():
            study, places = optuna.create_study(), []
            for number in range(0, 8, 2):  # in groups of two
                some = [asked(study, number + i, start={"u": 0.2, "v": 0.7}) for i in range(2)]
                places += [list(trial.params.values()) for trial in some]
                for trial in some:
                    study.tell(trial, branin(**trial.params))
            return np.array(places)
        first = whole()
        np.testing.assert_array_equal(first, whole())
        self.assertEqual(list(first[0]), [0.2, 0.7])
        apart = np.linalg.norm(first[:, None] - first[None], axis=2) + np.eye(len(first))
        self.assertGreater(apart.min(), 1e-3)

    def test_a_process_goes_through_what_it_knows(self):
        points = np.random.default_rng(3).random((12, 2))
        values = np.array([branin(*p) for p in points])
        process = gaussian_process.fitted(points, values, 1)
        mean = process.predict(points)
        self.assertLess(np.abs(mean - values).max(), 0.02 * np.ptp(values))
        gain = gaussian_process.improvement(process, values.min(), points)
        self.assertTrue((gain >= 0).all())
        # Closed form of E max(best - y, 0) against the mean of many draws.
        at = [[0.5, 0.3]]
        (mean,), (deviation,) = process.predict(at, return_std=True)
        draws = np.random.default_rng(5).normal(mean, deviation, 400_000)
        best = float(mean + 0.5 * deviation)
        drawn = np.maximum(best - draws, 0).mean()
        self.assertAlmostEqual(gaussian_process.improvement(process, best, at)[0] / drawn, 1,
                               delta=0.01)


if __name__ == "__main__":
    unittest.main()
