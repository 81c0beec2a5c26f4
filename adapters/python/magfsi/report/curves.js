// SPDX-License-Identifier: GPL-2.0-or-later
// Curves of the probes over time, a panel for each quantity, with a cursor at the view's time.

const DASHES = [[], [6, 3], [2, 2]];

// Panels: columns that differ by x, y, z only stand together.
function panels(allRuns) {
  const found = new Map();
  allRuns.forEach((run, r) => {
    if (!run.probes) return;
    const columns = run.probes.columns.map(c => ({ name: c.name, values: unpack(c.values, Float32Array) }));
    run.t = columns.find(c => c.name === "t[s]").values;
    for (const { name, values } of columns) {
      if (name === "t[s]") continue;
      const key = name.replace(/_(u?)[xyz]\[/, (_, u) => u ? "_u[" : "["), part = /_u?([xyz])\[/.exec(name)?.[1] || "";
      if (!found.has(key)) found.set(key, []);
      found.get(key).push({ run, r, part, values, t: run.t, name });
    }
  });
  return found;
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

// Less the first run's course of the same name; without those that it lacks.
function differences(lines) {
  return lines.filter(l => l.r > 0).map(l => {
    const first = lines.find(o => o.r === 0 && o.name === l.name);
    return first && { ...l, values: Float32Array.from(l.values, (v, i) => v - at(first, l.t[i])) };
  }).filter(Boolean);
}

function ticks(low, high, count) {
  const step0 = (high - low) / count, power = 10 ** Math.floor(Math.log10(step0));
  const step = [1, 2, 5, 10].map(m => m * power).find(s => s >= step0 * (1 - 1e-9)), all = [];
  for (let k = Math.ceil(low / step - 1e-5); k * step <= high + 1e-5 * step; ++k) all.push(k * step);
  return all;
}

class Panel {
  constructor(name, lines, several, pick) {
    this.several = several; this.name = name; this.all = lines;
    this.figure = document.createElement("figure");
    this.figure.dataset.panel = name;
    this.caption = document.createElement("figcaption");
    this.canvas = document.createElement("canvas");
    this.cursor = document.createElement("span");
    this.cursor.className = "cursor";
    const frame = document.createElement("div");
    frame.className = "frame";
    frame.append(this.canvas, this.cursor);
    this.figure.append(this.caption, frame);
    this.take(lines);
    const to = e => pick(this.t[0] + (e.offsetX - 58) / (this.canvas.clientWidth - 78) * (this.t[1] - this.t[0]));
    this.canvas.onpointerdown = to;
    this.canvas.onpointermove = e => { if (e.buttons) to(e); };
  }

  take(lines) {
    this.lines = lines; this.t = [Infinity, -Infinity]; this.y = [Infinity, -Infinity];
    for (const { t, values } of lines) {
      this.t = [Math.min(this.t[0], t[0]), Math.max(this.t[1], t[t.length - 1])];
      for (const v of values) if (isFinite(v)) { if (v < this.y[0]) this.y[0] = v; if (v > this.y[1]) this.y[1] = v; }
    }
    const [low, high] = this.y, largest = Math.max(Math.abs(low), Math.abs(high));
    if (!(high - low > 1e-6 * largest)) { // rounding is no curve
      const v = isFinite(low) ? (low + high) / 2 : 0, width = Math.abs(v) || 2;
      this.y = [v - 0.5 * width, v + 0.5 * width];
    }
    if (!(this.t[1] > this.t[0])) this.t[1] = this.t[0] + 1;
    const unit = /\[(.*)\]$/.exec(this.name)?.[1] || "1";
    [this.factor, this.unit] = scaled(Math.max(Math.abs(this.y[0]), Math.abs(this.y[1])), unit);
    [this.tFactor, this.tUnit] = scaled(Math.max(Math.abs(this.t[0]), this.t[1]), "s");
    this.caption.textContent = `${this.name.replace(/\[.*\]$/, "")} [${this.unit}]`;
  }

  differ(on) { this.take(on ? differences(this.all) : this.all); this.drawCurves(); }

  x(t) { return 58 + (t - this.t[0]) / (this.t[1] - this.t[0]) * (this.canvas.clientWidth - 78); }

  drawCurves() {
    const c = this.canvas, ratio = window.devicePixelRatio || 1, context = c.getContext("2d");
    const [w, h] = [c.clientWidth, c.clientHeight], [left, right, top, bottom] = [58, w - 20, 8, h - 22];
    c.width = ratio * w; c.height = ratio * h;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const y = v => bottom - (v - this.y[0]) / (this.y[1] - this.y[0]) * (bottom - top);
    context.fillStyle = context.strokeStyle = getComputedStyle(c).color; context.font = "11px system-ui, sans-serif";
    context.textAlign = "right"; context.textBaseline = "middle";
    for (const v of ticks(this.factor * this.y[0], this.factor * this.y[1], 4)) {
      const at = y(v / this.factor);
      context.globalAlpha = 0.8; context.fillText(number(v), left - 6, at);
      context.globalAlpha = 0.15; context.fillRect(left, at, right - left, 1);
    }
    context.globalAlpha = 0.8; context.textAlign = "center"; context.textBaseline = "alphabetic";
    const times = ticks(this.tFactor * this.t[0], this.tFactor * this.t[1], Math.max(2, w / 75));
    times.forEach((t, i) => {
      const text = i === times.length - 1 ? `${number(t)} ${this.tUnit}` : number(t), half = context.measureText(text).width / 2;
      context.fillText(text, Math.min(this.x(t / this.tFactor), w - half - 1), h - 6);
    });
    context.globalAlpha = 0.25; context.strokeRect(left, top, right - left, bottom - top);
    context.globalAlpha = 1; context.lineWidth = 1.4; context.textAlign = "left"; context.textBaseline = "middle";
    const marks = [], components = this.lines.some(l => l.part);
    for (const { r, part, values, t } of this.lines) {
      // A magnitude beside its components is none of them.
      const whole = !part && components, axis = part ? "xyz".indexOf(part) : 0;
      context.strokeStyle = whole ? getComputedStyle(c).color : line(this.several ? r : axis);
      context.setLineDash(DASHES[axis]);
      context.beginPath();
      let broken = true;
      values.forEach((v, i) => {
        if (!isFinite(v)) { broken = true; return; }
        context[broken ? "moveTo" : "lineTo"](this.x(t[i]), y(v)); broken = false;
      });
      context.stroke();
      if (values.length === 1) context.fillRect(this.x(t[0]) - 2, y(values[0]) - 2, 4, 4);
      const last = values.findLast(isFinite);
      if ((part || whole) && last !== undefined) marks.push({ part: part || "|·|", at: y(last), style: context.strokeStyle });
    }
    context.setLineDash([]);
    // Of several runs one letter for each axis; each in a place of its own.
    const letters = this.several ? marks.filter((m, i) => marks.findIndex(o => o.part === m.part) === i) : marks;
    letters.sort((a, b) => a.at - b.at);
    letters.forEach((m, i) => { m.at = Math.max(m.at, i ? letters[i - 1].at + 11 : top + 4); });
    for (let i = letters.length - 1, below = bottom - 2; i >= 0; --i, below = letters[i + 1].at - 11)
      letters[i].at = Math.min(letters[i].at, below);
    for (const m of letters) { context.fillStyle = m.style; context.fillText(m.part, right + 6, m.at); }
  }

  draw(time) {
    const x = this.x(Math.min(this.t[1], Math.max(this.t[0], time)));
    this.cursor.style.transform = `translateX(${x}px)`;
  }
}
