// SPDX-License-Identifier: GPL-2.0-or-later
// Puts the parts together. Texts of a scene reach the page through textContent only.

const element = id => document.getElementById(id);
function add(parent, tag, text, kind) {
  const made = document.createElement(tag);
  if (text !== undefined) made.textContent = text;
  if (kind) made.className = kind;
  parent.append(made);
  return made;
}
const share = v => v === 0 ? "0" : Math.abs(v) < 1e-4 ? v.toExponential(1) : `${round3(100 * v)} %`;
const seconds = v => quantity(v, "s");

const LEAST_SHARE = 0.2; // of the view's width: a robot whose course is so long is followed from the start
const SHORTEST = 1e-9; // s, of a run that shows one instant only
let allRuns = [], shownRun, axis, several = false, drawn = [], end = 1, now = 0, playing = false, last = 0;
const view = new View(element("view"));
const runName = (run, i) => several ? `${i + 1}: ${run.folder}` : run.name;

function showHead() {
  element("title").textContent = allRuns.map(run => run.name).join(", ");
  element("outcome").textContent = allRuns.map(run =>
    [run.outcome, run.cause, run.wall_s ? seconds(run.wall_s) : ""].filter(Boolean).join(", ")).join("; ");
  element("outcome").className = allRuns.every(run => run.outcome === "completed" || run.progress) ? "" : "bad";
}

function showChecks(box) {
  allRuns.forEach((run, i) => {
    if (several) add(box, "p", runName(run, i)).style.color = line(i);
    if (!run.checks.length) return add(box, "p", "none: no fluid, and no audit in the scene", "grey");
    const rows = add(add(box, "div", undefined, "wide"), "table");
    for (const check of run.checks) {
      const row = add(rows, "tr");
      add(row, "td", check.good ? "✓ good" : "✗ look", check.good ? "good" : "bad");
      add(row, "td", check.name);
      add(row, "td", share(check.value), "number");
      add(row, "td", `limit ${share(check.limit)}`, "grey limit");
    }
  });
}

// Values at the last instant that all runs have; differences of the first's largest value until then.
function showEnds(box) {
  if (!several || !allRuns.every(run => run.probes)) return;
  const first = allRuns[0], common = Math.min(...allRuns.map(run => run.t.at(-1)));
  const where = axis.name === "time" ? quantity(common, "s") : `${axis.name} ${quantity(at({ t: first.t, values: first.x }, common), axis.unit)}`;
  add(box, "h2", `Values at ${where}, the last that all runs have`);
  if (allRuns.some(run => run.t.at(-1) > common * (1 + 1e-6))) add(box, "p", `The runs end at ${allRuns.map(run => axis.name === "time" ? quantity(run.t.at(-1), "s") : quantity(run.x.at(-1), axis.unit)).join(", ")}.`, "grey");
  const rows = add(add(box, "div", undefined, "wide"), "table"), head = add(rows, "tr");
  for (const text of ["", ...allRuns.map(runName), ...allRuns.slice(1).map((_, i) => `${i + 2} less 1 (of the largest)`)]) add(head, "th", text);
  for (const lines of panels(allRuns).panels.values()) for (const mine of lines.filter(l => l.r === 0)) {
    const values = allRuns.map((_, r) => { const l = lines.find(o => o.r === r && o.name === mine.name); return l ? at(l, common) : NaN; });
    const unit = unitOf(mine.name), row = add(rows, "tr"), scale = Math.max(...lines.filter(l => l.r === 0)
      .flatMap(l => Array.from(l.values, (v, i) => l.t[i] <= common * (1 + 1e-6) ? Math.abs(v) : 0)));
    add(row, "td", `${mine.place ? "Δ " : ""}${plain(mine.name)}`);
    for (const v of values) add(row, "td", isFinite(v) ? quantity(v, unit) : "", "number");
    for (const v of values.slice(1)) add(row, "td", isFinite(v) && isFinite(values[0]) ?
      `${quantity(v - values[0], unit)}${scale ? ` (${share((v - values[0]) / scale)})` : ""}` : "", "number");
  }
}

function showTasks(box) {
  allRuns.forEach((run, i) => {
    for (const [side, tasks] of Object.entries(run.tasks)) {
      const whole = Object.values(tasks).reduce((a, b) => a + b, 0) || 1, waits = run.waiting?.[side] || {};
      const waited = Object.values(waits).reduce((a, b) => a + b, 0);
      add(box, "p", `${several ? runName(run, i) + ", " : ""}${side}: ${seconds(whole)}` +
        (waited ? `, of them ${seconds(waited)} waiting for its partner` : ""));
      const rows = add(box, "table");
      for (const [name, s] of Object.entries(tasks).sort((a, b) => b[1] - a[1]).slice(0, 8)) {
        const row = add(rows, "tr");
        add(row, "td", name);
        add(row, "td", `${(100 * s / whole).toFixed(0)} %`, "number");
        add(add(row, "td"), "span", "", "bar").style.width = `${Math.max(1, 120 * s / whole)}px`;
      }
    }
    if (run.trace) showTrace(box, run.trace);
  });
}

// Who waits for whom, and a piece of the timeline: work dark, waits hatched by being pale.
function showTrace(box, trace) {
  add(box, "p", `Timeline over ${seconds(trace.seconds)} (trace.json, for ui.perfetto.dev):`);
  const rows = add(add(box, "div", undefined, "wide"), "table");
  for (const r of trace.ranks) {
    const row = add(rows, "tr"), other = r.side === "structure" ? "fluid" : "structure";
    add(row, "td", `${r.side} ${r.rank}`);
    add(row, "td", r.waiting_s > 0.001 * r.tasks_s ? `waits for the ${other} ${(100 * r.waiting_s / r.tasks_s).toFixed(0)} % of its time` : "waits for nobody");
    add(row, "td", r.most.map(([name, s]) => `in "${name}" ${seconds(s)}`).join(", "), "grey");
  }
  const piece = add(add(box, "div", undefined, "wide"), "div", undefined, "lanes"), span = trace.piece.span;
  for (const lane of trace.piece.lanes) {
    add(piece, "span", lane.lane, "grey");
    const bar = add(piece, "div", undefined, "lane");
    for (const [name, start, length, waits] of lane.events) {
      const left = Math.max(0, start), right = Math.min(span, start + length);
      const mark = add(bar, "i", undefined, waits ? "waits" : "works");
      mark.style.left = `${100 * left / span}%`; mark.style.width = `${100 * (right - left) / span}%`;
      mark.title = `${name}: ${seconds(1e-6 * length)}`;
    }
  }
  add(box, "p", `from the middle of the run, ${seconds(1e-6 * span)}: dark works, pale waits`, "grey");
}

function showOrigin(box) {
  allRuns.forEach((run, i) => {
    const rows = add(box, "table"), words = of => Object.entries(of).map(([name, value]) => `${name} ${value}`).join(", ");
    for (const [name, value] of [["run", runName(run, i)], ["begun", run.begun], ["again", run.command],
      ["overrides", run.overrides.join(" ")], ["versions", words(run.versions)], ["machine", run.machine],
      ["ranks", words(run.ranks)], ["steps", run.steps], ["effects", run.effects.join(", ")],
      ["absent", run.absent.join(", ")]]) {
      if (value === undefined || value === null || value === "") continue;
      const row = add(rows, "tr");
      add(row, "td", name, "grey"); add(row, "td", String(value), "text");
    }
    const more = add(box, "details");
    add(more, "summary", "the scene");
    add(more, "pre", run.scene);
  });
}

function showCurves(box) {
  const { panels: made, constants } = panels(allRuns), large = drawn.filter(panel => panel.figure.className).map(panel => panel.name);
  axis = axisOf(allRuns);
  drawn = [...made].map(([name, lines]) => new Panel(name, lines, several, axis, t => go(t)));
  for (const panel of drawn) { if (large.includes(panel.name)) panel.figure.className = "large"; box.append(panel.figure); }
  if (!drawn.length) add(box, "p", "none: the scene has no probes", "grey");
  element("differ-label").hidden = !several;
  element("filter-label").hidden = drawn.length < 4;
  const said = some => {
    const zero = some.filter(c => !c.value).map(c => c.name), other = some.filter(c => c.value).map(c => `${c.name} ${c.value}`);
    return [other.length ? `constant: ${other.join(", ")}` : "", zero.length ? `zero: ${zero.join(", ")}` : ""].filter(Boolean).join("; ");
  };
  element("constants").textContent = allRuns.map((run, r) => said(constants.filter(c => c.r === r)))
    .map((text, r) => several && text ? `${r + 1}: ${text}` : text).filter(Boolean).join(" | ");
  filter();
}

// Panels whose name or explanation has all of the words.
function filter() {
  const words = element("filter").value.toLowerCase().split(/\s+/);
  for (const { figure } of drawn) {
    const text = `${figure.dataset.panel} ${figure.querySelector(".what").textContent}`.toLowerCase();
    figure.hidden = !words.every(word => text.includes(word));
  }
}

// A bar of colours with its ends, for what the robot or the flow is coloured by; range: the part of
// it that is shown.
function legend(box, text, q, glass = 1, range = 1) {
  const item = add(box, "span", undefined, "legend");
  add(item, "span", text);
  const [factor, unit] = scaled(Math.max(Math.abs(q.low), Math.abs(q.high)), q.unit);
  const bar = add(item, "span", undefined, "bar-ends"), beyond = q.beyond || range < 1;
  add(bar, "span", (beyond && q.signed ? "≤ " : "") + number(factor * range * q.low), "number");
  const map = add(add(bar, "span", undefined, "map"), "i"); // on the view's paper, as the slice
  map.style.background = gradient(q); map.style.opacity = glass;
  add(bar, "span", `${beyond ? "≥ " : ""}${number(factor * range * q.high)}${behind(unit)}`, "number");
}

// The levels of the surfaces; go() says of which instant they are.
function legendOfVortices(box) {
  const item = add(box, "span", undefined, "legend"), { levels, unit } = view.vortices;
  add(add(item, "span", "vortices, |curl u|"), "span", "", "instant");
  levels.forEach(({ value }, i) => {
    const level = add(item, "span", undefined, "bar-ends");
    add(level, "i", undefined, "mark").style.background = `rgb(${view.vortices.colour(i).map(v => Math.round(255 * v)).join()})`;
    add(level, "span", `${number(value)}${i === levels.length - 1 ? behind(typeset(unit)) : ""}`, "number");
  });
  sayInstant();
}
function sayInstant() {
  const said = document.querySelector("#legend .instant");
  if (said) said.textContent = ` at ${quantity(view.vortices.times[view.vortices.nearest(now)], "s")}:`;
}

function showLegend() {
  const box = element("legend");
  box.replaceChildren();
  if (several) allRuns.forEach((run, i) => {
    const name = add(box, "span", runName(run, i), "legend");
    name.style.color = line(i);
  });
  const c = shownRun.bodies?.colours[view.colour];
  if (c) legend(box, several ? `robot of run 1: ${c.name}` : c.name, c);
  else if (shownRun.bodies?.names.length > 1) shownRun.bodies.names.forEach((name, i) => {
    const item = add(box, "span", undefined, "legend"), mark = add(item, "i", undefined, "mark");
    mark.style.background = `rgb(${BODIES[i % BODIES.length].join()})`;
    add(item, "span", name);
  });
  const f = shownRun.flow, q = f?.quantities[view.flow];
  if (q) legend(box, `flow at ${"xyz"[f.axis]} = ${quantity(f.at, "m")}: ${q.name}`, q, GLASS, view.range);
  if (view.flow === "vortices") legendOfVortices(box);
  element("range-label").hidden = element("plane-label").hidden = !q; element("arrows-label").hidden = !q || !f.arrows;
  for (const { missing } of shownRun.sources) if (missing) add(box, "span", `${missing}: not drawn, for it follows a formula or a file`, "legend");
  const shown = shownRun.bodies;
  if (shown && shown.times.length < shown.stored) add(box, "span", `${shown.times.length} of ${shown.stored} frames`, "legend");
}

function choices(id, labels, chosen) {
  const box = element(id);
  box.replaceChildren();
  for (const [value, text] of labels) add(box, "option", text).value = value;
  box.value = labels.some(([value]) => value === chosen) ? chosen : labels[0]?.[0] ?? "";
  return box.value;
}

// The whole page of these runs; what the viewer has chosen stays.
function show(runs) {
  const fresh = !allRuns.length, atEnd = !fresh && now >= end * (1 - 1e-9);
  allRuns = runs; shownRun = runs[0]; several = runs.length > 1;
  drawn.forEach(panel => panel.remove());
  for (const id of ["checks", "ends", "tasks", "origin", "curves"]) element(id).replaceChildren();
  showHead(); showChecks(element("checks")); showTasks(element("tasks"));
  showCurves(element("curves")); showEnds(element("ends"));
  showOrigin(element("origin"));
  view.show(runs);
  const colours = (shownRun.bodies?.colours || []).map((c, i) => [String(i), c.name]).concat([["", "body"]]);
  const planes = shownRun.planes ||= [shownRun.flow, ...shownRun.other_flows].filter(Boolean);
  const plane = choices("plane", planes.map((f, i) => [String(i), `${"xyz"[f.axis]} = ${quantity(f.at, "m")}`]), element("plane").value);
  shownRun.flow = planes[plane] || null;
  const flows = (shownRun.flow?.quantities || []).map((q, i) => [String(i), q.name.replace(/ along .$/, "")])
    .concat(shownRun.vortices ? [["vortices", "vortices"]] : [], [["", "none"]]);
  view.colour = choices("colour", colours, fresh ? asked("colour", colours) : view.colour);
  view.flow = choices("flow", flows, fresh ? asked("flow", flows) : view.flow);
  element("flow-label").hidden = flows.length < 2;
  element("no-fields").hidden = shownRun.bodies !== null || shownRun.flow !== null;
  const ends = runs.flatMap(run => [run.bodies?.times.at(-1), run.t?.at(-1), run.flow?.times.at(-1)]).filter(isFinite);
  end = Math.max(...ends, SHORTEST);
  const field = shownRun.field;
  if (field) Object.assign(field, { t: unpack(field.times, Float32Array), unpacked: unpack(field.vectors, Float32Array) });
  element("fit").hidden = !shownRun.bodies || !(shownRun.box || view.sources.length); element("follow").hidden = !shownRun.bodies;
  showLegend();
  drawn.forEach(panel => panel.differ(element("differ").checked && several));
  // A run that goes on is followed; one that has ended begins where it shows most.
  const first = new URLSearchParams(location.hash.slice(1)).has("t") ? Number(asked("t")) : held.live ? end : shownRun.bodies?.begin ?? end;
  if (fresh && view.share() < LEAST_SHARE) aim("follow");
  go(fresh ? first : atEnd && !playing ? end : now);
}

// report.html#t=0.02&colour=speed&flow=none
function asked(name, labels) {
  const text = new URLSearchParams(location.hash.slice(1)).get(name);
  if (!labels || text === null) return text || "0";
  return labels.find(([, label]) => label === text)?.[0] ?? "0";
}

function fieldNow() {
  const f = shownRun.field;
  if (!f) return null;
  const row = view.frame(f.t);
  return [0, 1, 2].map(d => f.unpacked[3 * row + d]);
}

// The time, or what was varied, in words.
function nowSaid() {
  if (!shownRun.load || !shownRun.t) return quantity(now, "s");
  const { name, unit } = shownRun.load, { t, x } = shownRun;
  return `${name} ${quantity(at({ t, values: x }, Math.min(t.at(-1), Math.max(t[0], now))), unit)}`;
}

function go(time) {
  now = end > SHORTEST ? Math.min(end, Math.max(0, time)) : 0;
  view.time = now; view.field = fieldNow();
  element("time").value = now / end;
  element("now").textContent = nowSaid();
  element("time").setAttribute("aria-valuetext", nowSaid());
  view.draw(); sayInstant();
  drawn.forEach(panel => panel.draw(now));
}

// Goes to the next stored instant, or to the one before.
function step(by) {
  const times = shownRun.bodies?.times || shownRun.t || [0], slack = 1e-6 * end;
  go(by > 0 ? times.find(t => t > now + slack) ?? end : [...times].findLast?.(t => t < now - slack) ?? 0);
}

function aim(at) {
  view.aim = at; view.reset();
  element("follow").setAttribute("aria-pressed", at === "follow");
  view.draw();
}
function fit() { // robot, box, all with its magnets, in turns
  const choices = ["robot", ...(shownRun.box ? ["box"] : []), ...(view.sources.length ? ["all"] : [])];
  aim(choices[(choices.indexOf(view.aim) + 1) % choices.length]);
}
function tick(stamp) {
  if (!playing) return;
  const next = now + (stamp - last) / 1e3 * end / element("pace").value;
  last = stamp;
  go(next > end ? 0 : next);
  requestAnimationFrame(tick);
}
function play() {
  playing = !playing;
  element("play").textContent = playing ? "stop" : "play";
  last = performance.now();
  requestAnimationFrame(tick);
}
element("play").onclick = play;
element("fit").onclick = fit;
element("follow").onclick = () => aim(view.aim === "follow" ? "robot" : "follow");
element("plane").onchange = e => { shownRun.flow = shownRun.planes[e.target.value]; view.pictured = null; showLegend(); view.draw(); };
element("filter").oninput = filter;
element("arrows").onchange = e => { view.arrows = e.target.checked; view.draw(); };
element("range").onchange = e => { view.range = Number(e.target.value); showLegend(); view.draw(); };
const KEYS = { " ": play, ArrowRight: () => step(1), ArrowLeft: () => step(-1), Home: () => go(0), End: () => go(end),
  f: () => element("follow").click(), "+": () => view.zoomAt(view.width / 2, view.height / 2, 1.25), "-": () => view.zoomAt(view.width / 2, view.height / 2, 0.8) };
document.onkeydown = e => {
  if (e.ctrlKey || e.altKey || e.metaKey || /INPUT|SELECT|TEXTAREA/.test(e.target.tagName) || e.key === " " && /BUTTON|SUMMARY/.test(e.target.tagName)) return;
  if (KEYS[e.key]) { e.preventDefault(); KEYS[e.key](); }
};
element("time").oninput = e => go(e.target.value * end);
element("colour").onchange = e => { view.colour = e.target.value; showLegend(); view.draw(); };
element("flow").onchange = e => { view.flow = e.target.value; showLegend(); view.draw(); };
element("differ").onchange = e => drawn.forEach(panel => panel.differ(e.target.checked));
for (const s of [40, 20, 10, 5]) add(element("pace"), "option", `${s} s in all`).value = s;
element("pace").value = 10;
for (const part of [1, 0.5, 0.2, 0.1]) add(element("range"), "option", part === 1 ? "all" : share(part)).value = part;
window.onresize = () => view.draw(); // curves see to themselves
window.onbeforeprint = () => drawn.forEach(panel => panel.drawCurves());
DARK.onchange = () => { drawn.forEach(panel => panel.chart && panel.drawCurves()); showLegend(); go(now); };
// For tests: where a point of the scene [m] is on the view, and the pieces.
window.magfsi = { go, view, show, TABLES };
const held = JSON.parse(element("data").textContent);
if (Array.isArray(held)) show(held);
