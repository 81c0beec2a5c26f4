// Puts the parts together. Texts of a scene reach the page through textContent only.

const allRuns = JSON.parse(document.getElementById("data").textContent);
const element = id => document.getElementById(id);
function add(parent, tag, text, kind) {
  const made = document.createElement(tag);
  if (text !== undefined) made.textContent = text;
  if (kind) made.className = kind;
  parent.append(made);
  return made;
}
const figure = v => v === 0 ? "0" : Math.abs(v) < 1e-4 ? v.toExponential(1) : `${Number((100 * v).toPrecision(3))} %`;

const shownRun = allRuns[0], several = allRuns.length > 1;
element("title").textContent = allRuns.map(run => run.name).join(", ");
element("outcome").textContent = allRuns.map(run =>
  [run.outcome, run.cause, run.wall_s ? `${Number(run.wall_s.toPrecision(3))} s` : ""].filter(Boolean).join(", ")).join("; ");
if (allRuns.some(run => run.outcome !== "completed")) element("outcome").className = "bad";

function runName(run, i) { return several ? `${i + 1}: ${run.folder}` : run.name; }

allRuns.forEach((run, i) => {
  const box = element("checks");
  if (several) add(box, "p", runName(run, i)).style.color = LINES[i % LINES.length];
  if (!run.checks.length) return add(box, "p", "none: no fluid, and no audit in the scene", "grey");
  const table = add(box, "table");
  for (const check of run.checks) {
    const row = add(table, "tr");
    add(row, "td", check.good ? "good" : "look", check.good ? "good" : "bad");
    add(row, "td", check.name);
    add(row, "td", figure(check.value), "number");
    add(row, "td", `limit ${figure(check.limit)}`, "grey");
  }
});

allRuns.forEach((run, i) => {
  const box = element("tasks");
  for (const [side, tasks] of Object.entries(run.tasks)) {
    const whole = Object.values(tasks).reduce((a, b) => a + b, 0) || 1;
    add(box, "p", `${several ? runName(run, i) + ", " : ""}${side}: ${whole.toPrecision(3)} s`);
    const table = add(box, "table");
    for (const [name, seconds] of Object.entries(tasks).sort((a, b) => b[1] - a[1]).slice(0, 8)) {
      const row = add(table, "tr");
      add(row, "td", name);
      add(row, "td", `${(100 * seconds / whole).toFixed(0)} %`, "number");
      add(add(row, "td"), "span", "", "bar").style.width = `${160 * seconds / whole}px`;
    }
  }
});

allRuns.forEach((run, i) => {
  const box = element("origin"), table = add(box, "table");
  const words = of => Object.entries(of).map(([name, value]) => `${name} ${value}`).join(", ");
  for (const [name, value] of [["run", runName(run, i)], ["begun", run.begun], ["command", run.command],
    ["overrides", run.overrides.join(" ")], ["versions", words(run.versions)], ["machine", run.machine],
    ["ranks", words(run.ranks)], ["steps", run.steps], ["effects", run.effects.join(", ")],
    ["absent", run.absent.join(", ")]]) {
    if (value === undefined || value === null || value === "") continue;
    const row = add(table, "tr");
    add(row, "td", name, "grey"); add(row, "td", String(value));
  }
  const more = add(box, "details");
  add(more, "summary", "the scene");
  add(more, "pre", run.scene);
});

const made = panels(allRuns), view = new View(element("view"), shownRun);
const drawn = [...made].map(([name, lines]) => new Panel(name, lines, several, t => go(t)));
drawn.forEach(panel => element("curves").append(panel.figure));
if (!drawn.length) add(element("curves"), "p", "none: the scene has no probes", "grey");
if (several) allRuns.forEach((run, i) => {
  const line = add(element("legend"), "span", `${runName(run, i)}  `);
  line.style.color = LINES[i % LINES.length];
});

const ends = [shownRun.bodies?.times.at(-1), shownRun.t?.at(-1), shownRun.flow?.times.at(-1)].filter(isFinite);
const end = Math.max(...ends, 1e-9), colours = [["", "plain"]];
if (view.moment) colours.unshift(["magnetization", shownRun.bodies.magnetization.label]);
if (shownRun.bodies?.fastest) colours.push(["speed", `speed, up to ${shownRun.bodies.fastest.toPrecision(3)} m/s`]);
for (const [value, text] of colours) add(element("colour"), "option", text).value = value;
view.colour = colours[0][0];
for (const seconds of [20, 10, 5]) add(element("pace"), "option", `${seconds} s in all`).value = seconds;
element("pace").value = 10;
if (!shownRun.flow) element("shown-flow").remove();
if (!shownRun.bodies && !shownRun.flow) element("scene3d").prepend(add(element("scene3d"), "p",
  "no fields: output.structure in the scene writes them", "grey"));
if (shownRun.flow) add(element("legend"), "p", `flow: speed, up to ${shownRun.flow.fastest.toPrecision(3)} m/s, ` +
  `in the plane ${"xyz"[shownRun.flow.axis]} = ${Number((1e3 * shownRun.flow.at).toPrecision(3))} mm`);
if (several) add(element("legend"), "p", `the robot is that of ${runName(shownRun, 0)}`);
const field = shownRun.column?.("field[T]");
if (shownRun.field && field) view.field = shownRun.field;
const strongest = field ? Math.max(...field.map(Math.abs), 1e-30) : 1;

let now = 0, playing = false, last = 0;
function go(time) {
  now = Math.min(end, Math.max(0, time));
  view.time = now;
  if (view.field) {
    let i = 0;
    while (i + 1 < shownRun.t.length && shownRun.t[i + 1] <= now) ++i;
    view.fieldNow = field[i] / strongest;
  }
  element("time").value = now / end;
  element("now").textContent = `${Number((1e3 * now).toPrecision(4))} ms`;
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
element("colour").onchange = e => { view.colour = e.target.value; view.draw(); };
if (shownRun.flow) element("flow").onchange = e => { view.showsFlow = e.target.checked; view.draw(); };
window.onresize = () => go(now);
// For tests: where a point of the scene [m] is on the view, and the pieces.
window.magfsi = { go, view };
const asked = /[#&]t=([0-9.e-]+)/.exec(location.hash);
go(asked ? Number(asked[1]) : 0);
