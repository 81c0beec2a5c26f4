// Curves of the probes over time, a panel for each quantity, with a cursor at the view's time.

const LINES = matchMedia("(prefers-color-scheme: dark)").matches ?
  ["#79b4f2", "#f0995c", "#8fca88", "#c9a3e0"] : ["#1f5fa8", "#c2410c", "#3f7d3a", "#8b5aa8"];
const DASHES = [[], [6, 3], [2, 2]];

// Panels: columns that differ by x, y, z only stand together.
function panels(allRuns) {
  const found = new Map();
  allRuns.forEach((run, r) => {
    if (!run.probes) return;
    const columns = run.probes.columns.map(c => ({ name: c.name, values: unpack(c.values, Float32Array) }));
    run.t = columns.find(c => c.name === "t[s]").values;
    run.column = name => columns.find(c => c.name === name)?.values;
    for (const { name, values } of columns) {
      if (name === "t[s]") continue;
      const key = name.replace(/_(u?)[xyz]\[/, (_, u) => u ? "_u[" : "["), part = /_u?([xyz])\[/.exec(name)?.[1] || "";
      if (!found.has(key)) found.set(key, []);
      found.get(key).push({ run, r, part, values });
    }
  });
  return found;
}

function number(v) {
  const a = Math.abs(v);
  return a === 0 ? "0" : a < 1e-3 || a >= 1e5 ? v.toExponential(1).replace(".0e", "e") : String(Number(v.toPrecision(3)));
}

function ticks(low, high, count) {
  const step0 = (high - low) / count, power = 10 ** Math.floor(Math.log10(step0));
  const step = [1, 2, 5, 10].map(m => m * power).find(s => s >= step0), all = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) all.push(k * step);
  return all;
}

class Panel {
  constructor(name, lines, several, pick) {
    this.lines = lines; this.several = several;
    this.figure = document.createElement("figure");
    this.figure.dataset.panel = name;
    const caption = document.createElement("figcaption");
    caption.textContent = name;
    this.canvas = document.createElement("canvas");
    this.figure.append(caption, this.canvas);
    this.t = [Infinity, -Infinity]; this.y = [Infinity, -Infinity];
    for (const { run, values } of lines) {
      this.t = [Math.min(this.t[0], run.t[0]), Math.max(this.t[1], run.t[run.t.length - 1])];
      for (const v of values) if (isFinite(v)) this.y = [Math.min(this.y[0], v), Math.max(this.y[1], v)];
    }
    if (!(this.y[1] > this.y[0])) {
      const v = isFinite(this.y[0]) ? this.y[0] : 0, width = Math.abs(v) || 1;
      this.y = [v - 0.5 * width, v + 0.5 * width];
    }
    if (!(this.t[1] > this.t[0])) this.t[1] = this.t[0] + 1;
    const at = e => pick(this.t[0] + (e.offsetX - 62) / (this.canvas.clientWidth - 84) * (this.t[1] - this.t[0]));
    this.canvas.onpointerdown = at;
    this.canvas.onpointermove = e => { if (e.buttons) at(e); };
  }

  draw(time) {
    const c = this.canvas, ratio = window.devicePixelRatio || 1, context = c.getContext("2d");
    const [w, h] = [c.clientWidth, c.clientHeight], [left, right, top, bottom] = [62, w - 22, 8, h - 22];
    c.width = ratio * w; c.height = ratio * h;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const x = t => left + (t - this.t[0]) / (this.t[1] - this.t[0]) * (right - left);
    const y = v => bottom - (v - this.y[0]) / (this.y[1] - this.y[0]) * (bottom - top);
    const ink = getComputedStyle(c).color;
    context.fillStyle = context.strokeStyle = ink; context.font = "11px system-ui, sans-serif";
    context.globalAlpha = 0.75; context.textAlign = "right"; context.textBaseline = "middle";
    for (const v of ticks(...this.y, 5)) context.fillText(number(v), left - 6, y(v));
    context.textAlign = "center"; context.textBaseline = "alphabetic";
    for (const t of ticks(...this.t, Math.max(2, w / 110))) context.fillText(`${number(t)} s`, x(t), h - 6);
    context.globalAlpha = 0.25; context.strokeRect(left, top, right - left, bottom - top);
    context.globalAlpha = 1; context.lineWidth = 1.4; context.textAlign = "left";
    const ends = [];
    for (const { run, r, part, values } of this.lines) {
      const axis = "xyz".indexOf(part);
      context.strokeStyle = context.fillStyle = LINES[(this.several ? r : Math.max(axis, 0)) % LINES.length];
      context.setLineDash(DASHES[this.several ? Math.max(axis, 0) : 0]);
      context.beginPath();
      values.forEach((v, i) => { if (isFinite(v)) context.lineTo(x(run.t[i]), y(v)); });
      context.stroke();
      let place = y(values[values.length - 1]);
      while (ends.some(other => Math.abs(other - place) < 10)) place += 10;
      ends.push(place);
      if (part) { context.textBaseline = "middle"; context.fillText(part, right + 5, place); }
    }
    context.setLineDash([]); context.strokeStyle = ink; context.lineWidth = 1;
    context.beginPath(); context.moveTo(x(time), top); context.lineTo(x(time), bottom); context.stroke();
  }
}
