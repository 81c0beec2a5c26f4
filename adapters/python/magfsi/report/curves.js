// SPDX-License-Identifier: GPL-2.0-or-later
// The curves of a run's probes with their explanations. Constants and rounding noise become a line of text.

const ROUNDING = 1e-6; // of the largest value on the same axis: no eye sees less
const NOTHING = 1e-12; // of a quantity without unit: two sums of the same terms differ by as much

// Explanations by the last word of a column's name (docs/probes.md).
const WORDS = {
  field: "applied field, the same everywhere", com: "centre of mass, from the start", speed: "velocity of the centre of mass",
  end_to_end: "distance of the ends of the centre line", mid_rise: "height of the middle over the line between the ends",
  bend: "angle from one end's tangent to the other's; positive: ends up", max_displacement: "of the node furthest from its start",
  fluid_force: "force of the fluid on the body, buoyancy with it", fluid_torque: "torque of the fluid about the centre of mass",
  reaction: "force of what holds or moves the face", energy_elastic: "strain energy", energy_kinetic: "of the body's nodes",
  work_magnetic: "done on the body by the field since the start", magnetic_force: "force of the field on the body",
  magnetic_torque: "torque of the field about the centre of mass", momentum: "mass times velocity", flow: "volume through the plane a second",
  momentum_flux: "momentum through the plane, without pressure", pressure: "mean over the plane's fluid", kinetic_energy: "of the fluid",
  enstrophy: "mean of half the vorticity squared", mass: "of the fluid", max_speed: "largest speed in a cell of the fluid",
  drag: "force along the flow", lift: "force across the flow", force: "force of the fluid on the obstacle",
  contact_force: "force of contact with bodies, platform, sides and obstacles", contact_torque: "torque of contact about the centre of mass",
  rigid: "centre of mass of the rigid part, from the start", rigid_q: "turn of its frame in space, as a unit quaternion",
  rigid_angles: "the same as turns about the axes x, y, z of space, in this order",
  rigid_velocity: "of its centre of mass", rigid_spin: "angular velocity along axes of space",
  momentum_mismatch: "given by one side less received by the other", power_mismatch: "given by one side less received by the other" };
function explained(key, run) {
  const at = /^field_at_(.*)/.exec(key);
  if (at) return `field of all at the middle of ${at[1]}`;
  const moved = /^(.*)_u$/.exec(key), point = run.points[moved ? moved[1] : key];
  if (point) return `point of ${point.body} that was at ${point.at.map(v => number(1e3 * v)).join(", ")} mm in its mesh: ${moved ? "displacement" : "place"} from the start`;
  if (/\.u$/.exec(key)) return "mean displacement of the part";
  return WORDS[key.split(".").at(-1)] || WORDS[key.split("_").slice(-2).join("_")] || "";
}

const unitOf = name => /\[(.*)\]$/.exec(name)?.[1] || "1";
const plain = name => name.replace(/\[.*\]$/, "");
// Components of a vector, of a quaternion, and angles: each has its place among the colours.
const PARTS = { x: 0, y: 1, z: 2, w: 3, roll: 0, pitch: 1, yaw: 2 };
const ORIENTATION = /^(.*\brigid)_(?:(q)_([wxyz])|(roll|pitch|yaw))\[(.*)\]$/;
// "tip_ux[m]": ["tip_u[m]", "x"], "ball.rigid_q_w[1]": ["ball.rigid_q[1]", "w"], "ball.rigid_yaw[rad]": ["ball.rigid_angles[rad]", "yaw"]
function keyed(name) {
  const turn = ORIENTATION.exec(name);
  return turn ? [`${turn[1]}_${turn[2] || "angles"}[${turn[5]}]`, turn[3] || turn[4]] : keyedByAxis(name);
}
const keyedByAxis = name => [name.replace(/([._]u?)[xyz]\[/, (_, before) => `${before.replace(/^[._]$/, "")}[`), /[._]u?([xyz])\[/.exec(name)?.[1] || ""];

function spread(values) { // [lowest, highest]
  let low = Infinity, high = -Infinity;
  for (const v of values) if (isFinite(v)) { if (v < low) low = v; if (v > high) high = v; }
  return [low, high];
}

const largest = values => Math.max(0, ...spread(values).filter(isFinite).map(Math.abs));

// The horizontal axis: the quantity that was varied, if all runs have the same, else the time.
function axisOf(runs) {
  const name = runs[0].load?.name;
  return name && runs.every(run => run.load?.name === name) ? { ...runs[0].load, of: run => run.x } : { name: "time", unit: "s", of: run => run.t };
}

// {panels: Map of lines by key, constants: [{r: run number, name, value: "" for zero}]}. Columns that differ by x, y, z only, and those of
// one orientation, stand together. Places are from the start: what is drawn of a point is its displacement.
function panels(allRuns) {
  const found = new Map(), constants = [];
  allRuns.forEach((run, r) => {
    if (!run.probes) return;
    for (const c of run.probes.columns) c.line ||= unpack(c.values, Float32Array);
    run.t = run.probes.columns.find(c => c.name === "t[s]").line;
    if (run.load) run.x ||= unpack(run.load.values, Float32Array);
    const names = new Set(run.probes.columns.map(c => c.name)), groups = new Map();
    for (const { name, line, base = 0 } of run.probes.columns) {
      if (name === "t[s]") continue;
      const [key, part] = keyed(name), beside = name.replace(/_([xyz])\[/, "_u$1[");
      if (beside !== name && names.has(beside)) continue;
      const place = part !== "" && unitOf(name) === "m" && !/[._]u\[/.test(key), values = place || !base ? line : line.map(v => v + base);
      if (!groups.has(key)) groups.set(key, []);
      groups.get(key).push({ run, r, part, values, t: run.t, name, key, place, size: largest(values) + (place ? Math.abs(base) : 0) });
    }
    for (const [key, all] of groups) {
      const unit = unitOf(key), scale = Math.max(...all.map(l => l.size), unit === "1" ? NOTHING / ROUNDING : 0);
      // A field along x is its x: one curve.
      const whole = all.find(l => !l.part), again = l => l.part && whole && l.values.every((v, i) => Math.abs(v - whole.values[i]) <= ROUNDING * scale);
      const lines = all.filter(l => !again(l)), curves = lines.filter(l => {
        const [low, high] = spread(l.values);
        // A change of place is compared with the place itself, of which single precision keeps seven digits.
        return high - low > Math.max((l.place ? 1e-9 : ROUNDING) * scale, 3e-7 * largest(l.values));
      });
      for (const l of lines) if (!curves.includes(l)) constants.push({ r, name: `${l.place ? "Δ " : ""}${plain(l.name)}`,
        value: Math.abs(l.values[0]) > ROUNDING * scale ? quantity(l.values[0], unit) : "" });
      if (curves.length) found.set(key, [...(found.get(key) || []), ...curves]);
    }
  });
  return { panels: found, constants };
}

// The value of a course at a time, on straight lines.
function at(line, time) {
  const { t, values } = line;
  let a = 0, b = t.length - 1;
  if (time < t[0] - 1e-9 * Math.abs(t[0]) || time > t[b] * (1 + 1e-6)) return NaN;
  while (b - a > 1) { const m = (a + b) >> 1; if (t[m] <= time) a = m; else b = m; }
  const part = t[b] > t[a] ? Math.min(1, Math.max(0, (time - t[a]) / (t[b] - t[a]))) : 0;
  return values[a] + part * (values[b] - values[a]);
}

// Less the first run's course of the same name, where both are; without those that it lacks.
function differences(lines) {
  return lines.filter(l => l.r > 0).map(l => {
    const first = lines.find(o => o.r === 0 && o.name === l.name);
    return first && { ...l, values: Float32Array.from(l.values, (v, i) => v - at(first, l.t[i])) };
  }).filter(Boolean);
}

function save(name, kind, text) {
  const link = document.createElement("a");
  link.download = name;
  link.href = kind === "png" ? text : URL.createObjectURL(new Blob([text], { type: kind === "svg" ? "image/svg+xml" : "text/csv" }));
  link.click();
}
