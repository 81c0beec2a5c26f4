# SPDX-License-Identifier: GPL-2.0-or-later
"""The numerical parameters of a scene: which it has, and how its own keys make each coarser or
finer. A setting is a factor for each, how many times finer than in the scene; the keys follow."""
import math
from dataclasses import dataclass, field

RATIO_MAX = 8.0  # from the scene's own value, either way
ROUNDING = 0.12  # of elements along an axis, where all axes are refined together
ROUNDED_IS_FAR = 4  # so much further than a factor that is off by as much itself
OFF_PLACE = 0.2  # how rounded half a cell of another place in the grid counts, over cells
COARSEST_STEP = 2.0  # a lattice speed of 0.05 is then 0.1: beyond it, sound counts


@dataclass
class Parameter:
    """factors: those that can be, ascending. shares: sizes of an arm over that of its coarsest
    run: cheap parameters have wide ones, for an order shows better there."""
    name: str
    factors: list
    nominal: float  # order
    shares: tuple
    words: object  # of (facts): how large it is, for people
    rounding: dict = field(default_factory=dict)  # of the factors that whole numbers bend

    def nearest(self, factor, above=None):
        known = [f for f in self.factors if above is None or f > above * (1 + 1e-9)]

        def distance(f):
            return abs(math.log(f / factor)) + ROUNDED_IS_FAR * self.rounding.get(f, 0)
        return min(known, key=distance) if known else None


def _number(value, unit):
    return f"{value:.12g} {unit}"


def _thinned(factors, rounding=None):
    """Ascending, at least 8 % apart, the least rounded of those that are closer; 1 stays."""
    rounding = rounding or {}
    out = []
    for f in sorted(set(factors)):
        if not out or f / out[-1] >= 1.08:
            out.append(f)
        elif f == 1 or (out[-1] != 1 and rounding.get(f, 0) < rounding.get(out[-1], 0)):
            out[-1] = f
    return out


# --- the fluid ----------------------------------------------------------------------


def _cells(fluid):
    return [round(side / fluid["spacing"]) for side in fluid["box"]]


def _off_place(scene, factor):
    """By how many cells bodies start elsewhere between the nodes of a grid so many times finer.
    What a sheet of one layer does depends on that by some per cent
    (docs/lab/coupling_measurements.md), which on an arm would look like the spacing's."""
    h = finest_spacing(scene)
    at = [x / h for body in scene.get("bodies", {}).values()
          for x in body.get("initial", {}).get("position", [])]
    return max((abs((x * factor - x + 0.5) % 1 - 0.5) for x in at), default=0)


def _spacing(scene):
    fluid = scene["fluid"]
    common = math.gcd(*_cells(fluid))
    factors = [m / common for m in range(1, math.ceil(RATIO_MAX * common) + 1)]
    off = {f: OFF_PLACE * round(_off_place(scene, f), 6) for f in factors
           if 1 / RATIO_MAX <= f <= RATIO_MAX}
    body = bool(scene.get("bodies"))
    return Parameter("spacing", _thinned(off, off), 1.3 if body else 2.0, (1, 0.75, 0.5),
                     lambda facts: f"{1e3 * finest_spacing(facts['scene']):.4g} mm", off)


def levels(scene):
    return scene["fluid"].get("refinement", {}).get("levels", 0)


def finest_spacing(scene):
    return scene["fluid"]["spacing"] / 2**levels(scene)


def coarsest_spacing(scene):
    """Times coarser than in the scene: bodies stay a cell thick, or as thick as they are."""
    if "fluid" not in scene:
        return RATIO_MAX
    thin = [thickness(b["mesh"]) for b in scene.get("bodies", {}).values()]
    cells = [t / finest_spacing(scene) for t in thin if t]
    return max(1, min(cells)) if cells else RATIO_MAX


def _steps_between_rows(facts):
    """The time between rows, and how many coupled steps the present run has in it."""
    scene = facts["scene"]
    every = scene["probes"]["every"] if "probes" in scene else scene["time"]["end"]
    return every, every / facts["fluid"]["step_s"]


def _fluid_sets(facts, setting):
    """Spacing, levels and step. The step divides the time between rows, that rows of all runs
    are of the same instants."""
    scene = facts["scene"]
    sets = {}
    finer, step = setting.get("spacing", 1), setting.get("step", 1)
    outside = setting.get("outer spacing", 1)
    if outside != 1:
        sets["fluid.refinement.levels"] = str(levels(scene) - round(math.log2(outside)))
        if sets["fluid.refinement.levels"] == "0":
            sets = {"fluid.refinement": ""}
    if finer * outside != 1:
        sets["fluid.spacing"] = _number(scene["fluid"]["spacing"] / finer / outside, "m")
    if finer * step != 1:
        every, steps = _steps_between_rows(facts)
        whole = 2**levels(scene)
        rows = max(1, round(steps * finer * step / whole)) * whole
        sets["time.step"] = _number(every / rows, "s")
    return sets


def _step(scene):
    factors = [2**(i / 2) for i in range(-2, 9)]
    factors = [f for f in factors if 1 / f <= COARSEST_STEP * 1.01]
    return Parameter("step", factors, 1.5, (1, 0.5, 0.25),
                     lambda facts: f"{1e6 * facts['fluid']['step_s']:.4g} us")


def _outer(scene):
    count = levels(scene)
    factors = [2.0**i for i in range(count - 3, count + 1)]
    return Parameter("outer spacing", [f for f in factors if f >= 0.5], 2.0, (1, 0.5),
                     lambda facts: f"{1e3 * facts['scene']['fluid']['spacing']:.4g} mm")


# --- bodies -------------------------------------------------------------------------


def _counts(mesh):
    """(counts of elements, their key, lengths of the body) of a mesh that can be refined."""
    if "box" in mesh:
        return mesh["box"]["elements"], "box", mesh["box"]["size"]
    if "oblique" in mesh:
        m = mesh["oblique"]
        return m["elements"], "oblique", [m["length_a"], m["length_b"], m["thickness"]]
    return None


def element_counts(mesh):
    found = _counts(mesh)
    return found and found[0]


def thickness(mesh):
    """Least extent of a body; None where a file has it."""
    found = _counts(mesh)
    return min(found[2]) if found else None


def _plane_axes(body):
    """Along which no plane can move: one element across is then exact."""
    held = {(face, roller["axis"]) for roller in body.get("rollers", [])
            for face in ([roller["face"]] if isinstance(roller["face"], str) else roller["face"])}
    return [i for i, axis in enumerate("xyz")
            if {(f"{axis}_min", axis), (f"{axis}_max", axis)} <= held]


def _axes(body):
    """(axes that are refined together, that of the layers or None)."""
    counts, kind, lengths = _counts(body["mesh"])
    free = [i for i in range(3) if i not in _plane_axes(body)]
    thin = min(free, key=lambda i: lengths[i], default=None)
    others = [lengths[i] for i in free if i != thin]
    layers = thin if kind == "oblique" or (others and lengths[thin] <= 0.5 * min(others)
                                           and counts[thin] <= 3) else None
    # One element across is a plane problem, and stays one.
    return [i for i in free if i != layers and counts[i] > 1], layers


def _refined(counts, axes, factor):
    return [max(1, round(n * factor)) if i in axes else n for i, n in enumerate(counts)]


def _element_factors(counts, axes):
    """{factor: how far whole numbers of elements are off it}."""
    longest = max(counts[i] for i in axes)
    found = {}
    for m in range(1, math.ceil(4 * longest) + 1):
        f = m / longest
        off = max(abs(round(counts[i] * f) / (counts[i] * f) - 1) for i in axes)
        if off <= ROUNDING and f >= 1 / RATIO_MAX:
            found[f] = off
    return found


def _meshes(scene):
    for name, body in scene.get("bodies", {}).items():
        if not _counts(body["mesh"]):
            continue
        counts, _, _ = _counts(body["mesh"])
        axes, layer = _axes(body)

        def words(facts, name=name, which=axes):
            found = _counts(facts["scene"]["bodies"][name]["mesh"])[0]
            return " x ".join(str(found[i]) for i in which)
        if axes:
            off = _element_factors(counts, axes)
            yield Parameter(f"elements of {name}", _thinned(off, off), 2.0, (1, 0.75, 0.5),
                            words, off)
        if layer is not None:
            n = counts[layer]
            yield Parameter(f"layers of {name}", [k / n for k in range(1, 4 * n + 1)], 2.0,
                            (1, 0.5, 0.34), lambda facts, words=words, layer=layer:
                            words(facts, which=[layer]))


def _mesh_sets(scene, setting):
    sets = {}
    for name, body in scene.get("bodies", {}).items():
        fine, layer = setting.get(f"elements of {name}", 1), setting.get(f"layers of {name}", 1)
        if fine == layer == 1:
            continue
        counts, kind, _ = _counts(body["mesh"])
        axes, thin = _axes(body)
        counts = _refined(counts, axes, fine)
        if thin is not None:
            counts[thin] = max(1, round(counts[thin] * layer))
        sets[f"bodies.{name}.mesh.{kind}.elements"] = str(counts)
    return sets


def not_varied(scene):
    """What this command leaves as it is, in words."""
    return [f"the mesh of {name}, which is a file" for name, body in
            scene.get("bodies", {}).items() if not _counts(body["mesh"])]


def _substeps(scene):
    return Parameter("substeps", [1, 2, 4], 2.0, (1, 0.5),
                     lambda facts: f"{1e6 * facts['structure']['step_s']:.4g} us")


def _substep_sets(scene, setting, facts_without):
    """Steps of the structure: in a fluid so many a coupled step, alone its own."""
    factor = setting.get("substeps", 1)
    if factor == 1:
        return {}
    if "fluid" in scene:
        count = facts_without["structure"]["substeps"]
        return {"coupling.substeps": str(round(count * factor))}
    every = scene["probes"]["every"] if "probes" in scene else scene["time"]["end"]
    steps = round(factor * every / facts_without["structure"]["step_s"])
    return {"time.step": _number(every / steps, "s")}


# --- a scene ------------------------------------------------------------------------


def parameters(scene):
    """Of the scene in SI, as explain --json has it."""
    out = []
    if "fluid" in scene:
        out += [_spacing(scene), _step(scene)]
        if levels(scene):
            out.append(_outer(scene))
    out += _meshes(scene)
    if scene.get("bodies") and "equilibrium" not in scene["time"]:
        out.append(_substeps(scene))
    return [p for p in out if len(p.factors) > 1]


def sets_of(facts, setting, explain):
    """What --set takes for a setting. explain(sets): the facts of such a scene."""
    sets = _mesh_sets(facts["scene"], setting)
    if "fluid" in facts["scene"]:
        sets |= _fluid_sets(facts, setting)
    if setting.get("substeps", 1) != 1:
        sets |= _substep_sets(facts["scene"], setting, explain(sets))
    return sets


def sizes(present, facts, setting):
    """{parameter: [size over that of the scene, by each measure]}."""
    out = {name: [1 / factor] for name, factor in setting.items()}
    a, b = present["scene"], facts["scene"]
    if "fluid" in a:
        h = finest_spacing(b) / finest_spacing(a)
        dt = facts["fluid"]["step_s"] / present["fluid"]["step_s"]
        out["spacing"] = [h]
        out["step"] = [dt / h, dt]  # compressibility goes with the first, lag with the second
        if "outer spacing" in out:
            out["outer spacing"] = [b["fluid"]["spacing"] / a["fluid"]["spacing"]]
    for name, body in a.get("bodies", {}).items():
        if f"elements of {name}" in out:
            axes, _ = _axes(body)
            pairs = [(_counts(body["mesh"])[0][i], _counts(b["bodies"][name]["mesh"])[0][i])
                     for i in axes]
            out[f"elements of {name}"] = [math.prod(m / n for m, n in pairs)**(1 / len(pairs))]
    return out
