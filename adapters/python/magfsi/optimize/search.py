"""The search itself: Optuna asks, magfsi runs, Optuna is told. What has been done is in the output
folder, and the same command goes on from there."""
import math
import os

from magfsi.optimize.search_file import Search
from magfsi.study import marked, norms, store

# For runs without a value: methods look at the order of values only, or nearly so.
FAILED, BROKEN = 1e30, 1e24


class Missing(Exception):
    """A package is not installed."""


def optuna(method):
    try:
        import optuna as library
        if method == "cmaes":
            import cmaes  # noqa: F401
    except ImportError as error:
        raise Missing(f"magfsi optimize: needs the Python package {error.name} (Debian: apt "
                      f"install python3-{error.name})") from error
    library.logging.set_verbosity(library.logging.ERROR)
    return library


class Point:
    """A set of values that was run: what came of it."""

    def __init__(self, number, values, run):
        self.number, self.values, self.run = number, values, run
        self.measured, self.value, self.why = {}, None, run.record.get("cause", "")
        self.broken = 0.0  # by how much of the bounds, in all

    def evaluate(self, search: Search):
        """Fills in what follows from the run; `why` says why there is no value."""
        if not self.run.completed():
            self.why = self.why or self.run.record.get("outcome", "not run")
            return
        numbers = {n: v for n, v in self.values.items() if not isinstance(v, str)}
        try:
            for name, norm in search.measures.items():
                _, course = norms.course(self.run, norm)
                self.measured[name] = float(norms.one_number(norm.norm, course))
            known = {**numbers, **self.measured}
            value = float(search.objective(**known))
            for bound in search.require:
                found = float(bound.formula(**known))
                beyond = max(bound.at_least - found, found - bound.at_most, 0.0)
                if beyond > 0:
                    self.broken += beyond / (abs(found) + beyond)
                    self.why = f"{bound.name} is {found:.4g}"
        except (norms.NoError, ZeroDivisionError, OverflowError, ValueError) as error:
            self.why = str(error)
            return
        if not math.isfinite(value):
            self.why = "the objective is not finite"
            return
        self.value = value

    @property
    def good(self):
        return self.value is not None and self.broken == 0

    def told(self, search):
        """To be made small."""
        if self.value is None:
            return FAILED
        if self.broken:
            return BROKEN * self.broken
        return -self.value if search.maximize else self.value


def _distributions(library, search):
    return {n: library.distributions.CategoricalDistribution(p.words) if p.words else
            library.distributions.FloatDistribution(0, 1)
            for n, p in search.parameters.items()}


def _sampler(library, search, number):
    """Of one question: seeded by its number, so that a search gone on with asks the same."""
    seed = search.seed * 100_003 + number
    if search.method == "random":
        return library.samplers.RandomSampler(seed=seed)
    if search.method == "tpe":
        return library.samplers.TPESampler(seed=seed, multivariate=True,
                                           warn_independent_sampling=False)
    start = {n: (p.start - p.low) / (p.high - p.low)
             for n, p in search.parameters.items() if p.start is not None}
    return library.samplers.CmaEsSampler(
        x0=start if len(start) == len(search.parameters) else None, seed=seed,
        warn_independent_sampling=False)


def ranked(points, search):
    """The good ones, the best first."""
    return sorted((p for p in points if p.good), key=lambda p: p.told(search))


def run_at(search, values, out, more=None):
    """The run of these values, done now unless it is there already."""
    scene = store.scene_file(search.scene)
    run = store.planned(scene, search.cell(values, more), out)
    store.do(scene, search.limit_s, [run], lambda r: norms.check_probes(search.probed(), r),
             quiet=True)
    return run


class Searching:
    def __init__(self, search, out):
        self.search, self.out = search, out
        self.library = optuna(search.method)
        out.mkdir(parents=True, exist_ok=True)
        self.study = self._read()
        self._check_same()
        self.points = []

    def _read(self):
        """From the file: what Optuna remembers besides has the parameters in another order, and
        asks otherwise then."""
        return self.library.create_study(
            storage=f"sqlite:///{os.path.abspath(self.out)}/search.db",
            study_name=self.search.name, load_if_exists=True)

    def _check_same(self):
        """A search that asks for something else has no use for what was done."""
        s = self.search
        now = {"method": s.method, "seed": s.seed,
               "parameters": [[p.name, p.low, p.high, p.words] for p in s.parameters.values()],
               "objective": [s.maximize, s.objective.text],
               "require": [[r.name, r.formula.text, str(r.at_least), str(r.at_most)]
                           for r in s.require]}
        before = self.study.user_attrs.get("search")
        if before is None:
            self.study.set_user_attr("search", now)
        elif before != now:
            changed = next(key for key in now if now[key] != before[key])
            raise marked.InputError(f"{s.file}: found other {changed} than the search in "
                                    f"{self.out} had; allowed the same, or another --out")

    def _next(self):
        """A question that was not answered when the search was ended, or a new one."""
        self.study = self._read()
        state = self.library.trial.TrialState.RUNNING
        for trial in [t for t in self.study.get_trials(deepcopy=False) if t.state == state]:
            if trial.params.keys() == self.search.parameters.keys():
                return trial.number, self._values(trial)
            self.study.tell(trial.number, state=self.library.trial.TrialState.FAIL)
        self.study.sampler = _sampler(self.library, self.search, len(self.study.trials))
        trial = self.study.ask(_distributions(self.library, self.search))
        return trial.number, self._values(trial)

    def _values(self, trial):
        return {n: p.from_unit(trial.params[n]) for n, p in self.search.parameters.items()}

    def go(self):
        """All runs; returns the points in their order."""
        while len(self.points) < self.search.runs:
            done = [t for t in self.study.get_trials(deepcopy=False)
                    if t.state == self.library.trial.TrialState.COMPLETE]
            if len(self.points) < len(done):
                trial = done[len(self.points)]
                number, values = trial.number, self._values(trial)
            else:
                trial, (number, values) = None, self._next()
            run = run_at(self.search, values, self.out)
            if run.record.get("outcome") == "refused" and not self.points:
                self.search.scene_mark.refuse(f"what cannot run ({run.record['cause']})",
                                              "a scene that can")
            point = Point(number, values, run)
            point.evaluate(self.search)
            self.points.append(point)
            if trial is None:
                self.study.tell(number, point.told(self.search))
                self._say(point)
        return self.points

    def _say(self, point):
        values = ", ".join(f"{n} {self.search.parameters[n].text(v)}"
                           for n, v in point.values.items())
        found = f"{point.value:.6g}" if point.value is not None else "no value"
        best = ranked(self.points, self.search)
        print(f"{len(self.points)} of {self.search.runs}: {values}: {found}"
              + (f" ({point.why})" if point.why else "")
              + (f"; best {best[0].value:.6g}" if best else ""), flush=True)
