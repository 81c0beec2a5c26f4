# SPDX-License-Identifier: GPL-2.0-or-later
"""The search itself: Optuna asks, magfsi runs, Optuna is told. What has been done is in the output
folder, and the same command goes on from there."""
import bisect
import math
import os
import statistics
import threading
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

from magfsi.optimize import gaussian_process
from magfsi.optimize.search_file import Search
from magfsi.study import marked, norms, store

# For runs without a value: methods look at the order of values only, or nearly so.
FAILED, BROKEN, HOPELESS = 1e30, 1e24, 1e18
# Runs to compare with before one may be called hopeless.
LEAST_RUNS_BEFORE = 5


class Missing(Exception):
    """A package is not installed."""


def optuna(method):
    try:
        import optuna as library
        if method == "cmaes":
            import cmaes  # noqa: F401
        if method == "gaussian_process":
            import sklearn  # noqa: F401
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
        self.value_at = {}  # the objective by what was measured until then, by time
        self.beaten_by = 0.0  # a hopeless one: share of the runs before that were better then

    def _known(self, search, until_s=math.inf):
        """{name: number} of parameters and measures, from the rows up to a time."""
        known = {n: v for n, v in self.values.items() if not isinstance(v, str)}
        for name, norm in search.measures.items():
            _, course = norms.course(self.run, replace(norm, end_s=min(norm.end_s, until_s)))
            known[name] = float(norms.one_number(norm.norm, course))
        return known

    def hopeless(self, search, before):
        """Whether, at a time of `stop_early`, the objective so far is worse than the median of the
        runs before at that time: the median rule of Golovin et al., KDD 2017."""
        for at in search.stop_early:
            try:
                any_norm = replace(next(iter(search.measures.values())), end_s=math.inf)
                if norms.course(self.run, any_norm)[0][-1] <= at:
                    break  # the last row of a run under way may not be whole
                self.value_at[at] = float(search.objective(**self._known(search, at)))
            except (norms.NoError, ArithmeticError, ValueError):
                continue
            sign = -1 if search.maximize else 1
            others = sorted(sign * p.value_at[at] for p in before if at in p.value_at)
            mine = sign * self.value_at[at]
            if len(others) >= LEAST_RUNS_BEFORE and mine > statistics.median(others):
                self.beaten_by = bisect.bisect_left(others, mine) / len(others)
                self.why = (f"hopeless at {at:g} s: {self.value_at[at]:.4g}, worse than "
                            f"{100 * self.beaten_by:.0f} % of those before")
                return True
        return False

    def evaluate(self, search: Search, before=()):
        """Fills in what follows from the run; `why` says why there is no value. before: the points
        that a hopeless one is told by."""
        if self.hopeless(search, before):
            return
        if not self.run.completed():
            self.why = self.why or self.run.record.get("outcome", "not run")
            return
        try:
            known = self._known(search)
            self.measured = {name: known[name] for name in search.measures}
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
        if self.beaten_by:
            return HOPELESS * (1 + self.beaten_by)
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
    start = start if len(start) == len(search.parameters) else None
    if search.method == "gaussian_process":
        return gaussian_process.sampler(library, seed, list(search.parameters), start, HOPELESS,
                                        number)
    return library.samplers.CmaEsSampler(x0=start, seed=seed, warn_independent_sampling=False)


def ranked(points, search):
    """The good ones, the best first."""
    return sorted((p for p in points if p.good), key=lambda p: p.told(search))


# By the run's key: equal words may be asked for twice in a group.
_in_work = defaultdict(threading.Lock)


def run_at(search, values, out, more=None, watch=None):
    """The run of these values, done now unless it is there already. watch(run): store.do."""
    scene = store.scene_file(search.scene)
    run = store.planned(scene, search.cell(values, more), out)
    with _in_work[run.key]:
        store.do(scene, search.limit_s, [run], lambda r: norms.check_probes(search.probed(), r),
                 quiet=True, watch=watch)
    return run


class _Ended(Exception):
    """The search was told to end."""


def _share_of_cores(workers):
    """For the first lines of each worker's thread: runs beside each other keep to cores of their
    own."""
    cores = sorted(os.sched_getaffinity(0))
    shares = iter([cores[i::workers] for i in range(workers)])
    lock = threading.Lock()

    def take():
        with lock:
            os.sched_setaffinity(0, next(shares))
    return take


class Searching:
    def __init__(self, search, out):
        self.search, self.out = search, out
        self.library = optuna(search.method)
        out.mkdir(parents=True, exist_ok=True)
        self.study = self._read()
        self._check_same()
        self.points = []
        self.ending = threading.Event()

    def _read(self):
        """From the file: what Optuna remembers besides has the parameters in another order, and
        asks otherwise then."""
        return self.library.create_study(
            storage=f"sqlite:///{os.path.abspath(self.out)}/search.db",
            study_name=self.search.name, load_if_exists=True)

    def _check_same(self):
        """A search that asks for something else has no use for what was done."""
        s = self.search
        now = {"method": s.method, "seed": s.seed, "at_a_time": s.at_a_time,
               "stop_early": s.stop_early,
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

    def _ask(self, number):
        """As many questions: those that were not answered when the search was ended, then new
        ones. Returns [(number of the trial, values)]."""
        self.study = self._read()
        state, asked = self.library.trial.TrialState, []
        for trial in self.study.get_trials(deepcopy=False):
            if trial.state != state.RUNNING:
                continue
            if trial.params.keys() == self.search.parameters.keys():
                asked.append((trial.number, self._values(trial)))
            else:
                self.study.tell(trial.number, state=state.FAIL)
        while len(asked) < number:
            self.study.sampler = _sampler(self.library, self.search, len(self.study.trials))
            trial = self.study.ask(_distributions(self.library, self.search))
            asked.append((trial.number, self._values(trial)))
        return asked

    def _values(self, trial):
        return {n: p.from_unit(trial.params[n]) for n, p in self.search.parameters.items()}

    def _point(self, number, values, before):
        """One run, to its end or to where it is hopeless, and what came of it."""
        def watch(run):
            if self.ending.is_set():
                raise _Ended
            return Point(number, values, run).hopeless(self.search, before)
        point = Point(number, values, run_at(self.search, values, self.out, watch=watch))
        if point.run.record.get("outcome") == "refused" and not before:
            self.search.scene_mark.refuse(f"what cannot run ({point.run.record['cause']})",
                                          "a scene that can")
        point.evaluate(self.search, before)
        return point

    def _answered(self):
        """[(number, values)] of an earlier go, in their order."""
        complete = self.library.trial.TrialState.COMPLETE
        return [(t.number, self._values(t)) for t in self.study.get_trials(deepcopy=False)
                if t.state == complete]

    def go(self):
        """All runs, `at_a_time` of them beside each other; returns the points in their order.
        What a run is compared with, and what is known when it is asked for, are the points of the
        groups before: the same whatever order a group's runs end in."""
        size, whole = self.search.at_a_time, self.search.runs
        answered = self._answered()
        workers = min(size, len(os.sched_getaffinity(0)))
        begin = {"initializer": _share_of_cores(workers)} if workers > 1 else {}
        with ThreadPoolExecutor(workers, **begin) as pool:
            try:
                while len(self.points) < whole:
                    before = list(self.points)
                    group = answered[len(before):len(before) + size][:whole - len(before)]
                    told = len(group)
                    wanted = min(size, whole - len(before))
                    group += self._ask(wanted - told) if told < wanted else []
                    some = pool.map(lambda asked: self._point(*asked, before), group)
                    for i, point in enumerate(list(some)):
                        self.points.append(point)
                        if i >= told:
                            self.study.tell(point.number, point.told(self.search))
                            self._say(point)
            except BaseException:
                self.ending.set()  # the threads end their runs
                raise
        return self.points

    def _say(self, point):
        values = ", ".join(f"{n} {self.search.parameters[n].text(v)}"
                           for n, v in point.values.items())
        found = f"{point.value:.6g}" if point.value is not None else "no value"
        best = ranked(self.points, self.search)
        print(f"{len(self.points)} of {self.search.runs}: {values}: {found}"
              + (f" ({point.why})" if point.why else "")
              + (f"; best {best[0].value:.6g}" if best else ""), flush=True)
