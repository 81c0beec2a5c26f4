# SPDX-License-Identifier: GPL-2.0-or-later
"""Questions by a Gaussian process: the next is where it expects the largest improvement on the best
value so far (Jones, Schonlau and Welch, J. Global Optim. 13 (1998) 455). For Optuna, which keeps what
was asked and answered."""
import numpy as np

CANDIDATES, POLISHED = 512, 2  # of a question: points of a Sobol sequence, and those climbed from
# Values whose measure is noise to the search: of the spread of all.
LEAST_SPREAD = 1e-12


def first_runs(parameters):
    """So many questions spread evenly come before the first by the process."""
    return max(4, 2 * parameters)


def _even(parameters, seed, count):
    from scipy.stats import qmc

    return qmc.Sobol(parameters, seed=seed).random_base2(int(np.ceil(np.log2(count))))[:count]


def fitted(points, values, seed):
    """The process through these values: a Matern kernel with a length for each parameter, and room
    for noise. values: scaled to mean 0 and deviation 1 inside."""
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import ConstantKernel, Matern, WhiteKernel

    parameters = points.shape[1]
    kernel = (ConstantKernel(1.0, (1e-2, 1e3))
              * Matern(np.full(parameters, 0.3), [(0.02, 20.0)] * parameters, nu=2.5)
              + WhiteKernel(1e-5, (1e-9, 0.1)))
    process = GaussianProcessRegressor(kernel, normalize_y=True, n_restarts_optimizer=1,
                                       random_state=seed)
    return process.fit(points, values)


def improvement(process, best, at):
    """Expected, below `best`, at each of the points."""
    from scipy.stats import norm

    mean, deviation = process.predict(np.atleast_2d(at), return_std=True)
    deviation = np.maximum(deviation, 1e-12)
    z = (best - mean) / deviation
    return deviation * (z * norm.cdf(z) + norm.pdf(z))


def next_point(points, values, seed):
    """In the unit cube, from those asked and their values, to be made small."""
    import warnings

    from scipy.optimize import minimize

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of lengths at their bounds, where a parameter does nothing
        process = fitted(points, values, seed)
    parameters, best = points.shape[1], values.min()
    # Everywhere, and around the best, ever closer.
    some = _even(parameters, seed, CANDIDATES)
    widths = np.logspace(-0.5, -3, CANDIDATES // 2)[:, None]
    near = points[values.argmin()] + widths * (some[:len(widths)] - 0.5)
    some = np.clip(np.concatenate([some, near]), 0, 1)
    gain = improvement(process, best, some)
    starts = some[np.argsort(-gain, kind="stable")[:POLISHED]]
    scale = max(gain.max(), 1e-300)
    climbed = [minimize(lambda x: -improvement(process, best, x)[0] / scale, start,
                        method="L-BFGS-B", bounds=[(0, 1)] * parameters).x for start in starts]
    some = np.clip(np.array([*starts, *climbed]), 0, 1)
    return some[improvement(process, best, some).argmax()]


def usable(values, worthless):
    """Failed and hopeless runs count as the worst that has a value, and a bit more."""
    values = np.array(values, float)
    good = values < worthless
    if not good.any():
        return values, good
    spread = max(np.ptp(values[good]), LEAST_SPREAD)
    return np.where(good, values, values[good].max() + 0.1 * spread), good


def sampler(library, seed, names, start, worthless, number):
    """For one question, the number-th, of parameters between 0 and 1. start: of all, or {}."""
    class GaussianProcess(library.samplers.BaseSampler):
        def infer_relative_search_space(self, study, trial):
            return {name: library.distributions.FloatDistribution(0, 1) for name in names}

        def sample_relative(self, study, trial, search_space):
            return dict(zip(names, map(float, self.point(study))))

        def sample_independent(self, study, trial, name, distribution):
            raise AssertionError(f"{name} is no number")

        def point(self, study):
            if number == 0 and start:
                return [start[name] for name in names]
            # Those of a group that are still asked count as if they found the best: the others
            # look elsewhere (the constant liar of Ginsbourger et al., 2010).
            asked = [t for t in study.get_trials(deepcopy=False)
                     if t.number < number and t.params.keys() == set(names)]
            told = [t for t in asked if t.value is not None]
            values, good = usable([t.value for t in told], worthless)
            if good.sum() < first_runs(len(names)):
                return _even(len(names), seed // 100_003, number + 1)[number]
            lies = [values.min()] * (len(asked) - len(told))
            order = told + [t for t in asked if t.value is None]
            points = np.array([[t.params[name] for name in names] for t in order])
            return next_point(points, np.concatenate([values, lies]), seed)

    return GaussianProcess()
