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

const SHORTEST = 1e-9; // s, of a run that shows one instant only
let allRuns = [], shownRun, several = false, drawn = [], end = 1, now = 0, playing = false, last = 0;
const view = new View(element("view"));
const runName = (run, i) => several ? `${i + 1}: ${run.folder}` : run.name;
const colourOf = i => `--line: ${i}`;

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

// Where the runs end, and by how much they differ from the first.
function showEnds(box) {
  if (!several) return;
  const first = allRuns[0];
  if (!first.probes) return;
  add(box, "h2", "Last values, and differences from the first run");
  const rows = add(add(box, "div", undefined, "wide"), "table"), head = add(rows, "tr");
  for (const text of ["", ...allRuns.map(runName), ...allRuns.slice(1).map((_, i) => `${i + 2} less 1`)]) add(head, "th", text);
  for (const { name } of first.probes.columns) {
    const lines = allRuns.map(run => run.probes?.columns.find(c => c.name === name)).map(c => c && unpack(c.values, Float32Array));
    const ends = lines.map(values => values?.findLast(isFinite)), unit = /\[(.*)\]$/.exec(name)?.[1] || "1", row = add(rows, "tr");
    add(row, "td", name.replace(/\[.*\]$/, ""));
    for (const v of ends) add(row, "td", v === undefined ? "" : quantity(v, unit), "number");
    for (const v of ends.slice(1)) {
      const known = v !== undefined && ends[0] !== undefined;
      add(row, "td", known ? quantity(v - ends[0], unit) + (ends[0] ? ` (${share((v - ends[0]) / Math.abs(ends[0]))})` : "") : "", "number");
    }
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
  const made = panels(allRuns);
  drawn = [...made].map(([name, lines]) => new Panel(name, lines, several, t => go(t)));
  drawn.forEach(panel => box.append(panel.figure));
  if (!drawn.length) add(box, "p", "none: the scene has no probes", "grey");
  element("differ-label").hidden = !several;
}

// A bar of colours with its ends, for what the robot or the flow is coloured by.
function legend(box, text, q) {
  const item = add(box, "span", undefined, "legend");
  add(item, "span", text);
  const [factor, unit] = scaled(Math.max(Math.abs(q.low), Math.abs(q.high)), q.unit);
  const bar = add(item, "span", undefined, "bar-ends");
  add(bar, "span", (q.beyond && q.signed ? "≤ " : "") + number(factor * q.low), "number");
  add(bar, "i", undefined, "map").style.background = gradient(q);
  add(bar, "span", `${q.beyond ? "≥ " : ""}${number(factor * q.high)}${unit === "1" ? "" : " " + unit}`, "number");
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
  if (q) legend(box, `flow at ${"xyz"[f.axis]} = ${quantity(f.at, "m")}: ${q.name}`, q);
  const shown = shownRun.bodies;
  if (shown && shown.times.length < shown.stored) add(box, "span", `${shown.times.length} of ${shown.stored} frames`, "legend");
}

function choices(id, labels, chosen) {
  const box = element(id);
  box.replaceChildren();
  for (const [value, text] of labels) add(box, "option", text).value = value;
  box.value = labels.some(([value]) => value === chosen) ? chosen : labels[0][0];
  return box.value;
}

// The whole page of these runs; what the viewer has chosen stays.
function show(runs) {
  const fresh = !allRuns.length, atEnd = !fresh && now >= end * (1 - 1e-9);
  allRuns = runs; shownRun = runs[0]; several = runs.length > 1;
  for (const id of ["checks", "ends", "tasks", "origin", "curves"]) element(id).replaceChildren();
  showHead(); showChecks(element("checks")); showEnds(element("ends")); showTasks(element("tasks"));
  showCurves(element("curves"));
  showOrigin(element("origin"));
  view.show(runs);
  const colours = (shownRun.bodies?.colours || []).map((c, i) => [String(i), c.name]).concat([["", "body"]]);
  const flows = (shownRun.flow?.quantities || []).map((q, i) => [String(i), q.name]).concat([["", "none"]]);
  view.colour = choices("colour", colours, fresh ? asked("colour", colours) : view.colour);
  view.flow = choices("flow", flows, fresh ? asked("flow", flows) : view.flow);
  element("flow-label").hidden = flows.length < 2;
  element("no-fields").hidden = shownRun.bodies !== null || shownRun.flow !== null;
  const ends = runs.flatMap(run => [run.bodies?.times.at(-1), run.t?.at(-1), run.flow?.times.at(-1)]).filter(isFinite);
  end = Math.max(...ends, SHORTEST);
  if (shownRun.field && shownRun.t) shownRun.field.unpacked = unpack(shownRun.field.vectors, Float32Array);
  showLegend();
  drawn.forEach(panel => panel.differ(element("differ").checked && several));
  go(fresh ? Number(asked("t") || 0) : atEnd && !playing ? end : now);
}

// report.html#t=0.02&colour=speed&flow=none
function asked(name, labels) {
  const text = new URLSearchParams(location.hash.slice(1)).get(name);
  if (!labels || text === null) return text || "0";
  return labels.find(([, label]) => label === text)?.[0] ?? "0";
}

function fieldNow() {
  const f = shownRun.field;
  if (!f || !shownRun.t) return null;
  let a = 0, b = shownRun.t.length - 1;
  while (a < b) { const m = (a + b + 1) >> 1; if (shownRun.t[m] <= now * (1 + 1e-9)) a = m; else b = m - 1; }
  return [0, 1, 2].map(d => f.unpacked[3 * a + d]);
}

function go(time) {
  now = end > SHORTEST ? Math.min(end, Math.max(0, time)) : 0;
  view.time = now; view.field = fieldNow();
  element("time").value = now / end;
  element("now").textContent = quantity(now, "s");
  view.draw();
  drawn.forEach(panel => panel.draw(now));
}
function tick(stamp) {
  if (!playing) return;
  const next = now + (stamp - last) / 1e3 * end / element("pace").value;
  last = stamp;
  go(next > end ? 0 : next);
  requestAnimationFrame(tick);
}
element("play").onclick = () => {
  playing = !playing;
  element("play").textContent = playing ? "stop" : "play";
  last = performance.now();
  requestAnimationFrame(tick);
};
element("time").oninput = e => go(e.target.value * end);
element("colour").onchange = e => { view.colour = e.target.value; showLegend(); view.draw(); };
element("flow").onchange = e => { view.flow = e.target.value; showLegend(); view.draw(); };
element("differ").onchange = e => drawn.forEach(panel => panel.differ(e.target.checked));
for (const s of [40, 20, 10, 5]) add(element("pace"), "option", `${s} s in all`).value = s;
element("pace").value = 10;
const redraw = () => { drawn.forEach(panel => panel.drawCurves()); showLegend(); go(now); };
window.onresize = redraw;
DARK.onchange = redraw;
// For tests: where a point of the scene [m] is on the view, and the pieces.
window.magfsi = { go, view, show, MAGNITUDE, SIGNED };
const held = JSON.parse(element("data").textContent);
if (Array.isArray(held)) show(held);
