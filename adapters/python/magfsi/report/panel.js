// SPDX-License-Identifier: GPL-2.0-or-later
// A panel of curves, drawn by Chart.js when it comes into sight, with a cursor at the view's time.

const DASHES = [[], [6, 3], [2, 2], [9, 2, 2, 2]];
const style = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// Finds on each curve the point nearest to the pointer, since runs have different instants.
Chart.Interaction.modes.ofEach = (chart, event) => {
  const at = chart.scales.x.getValueForPixel(event.x), found = [];
  chart.getSortedVisibleDatasetMetas().forEach(meta => {
    const data = chart.data.datasets[meta.index].data;
    let nearest = 0;
    data.forEach((p, i) => { if (Math.abs(p.x - at) < Math.abs(data[nearest].x - at)) nearest = i; });
    if (data.length) found.push({ element: meta.data[nearest], datasetIndex: meta.index, index: nearest });
  });
  return found;
};
// Saved pictures have the page's paper behind them.
const PAPER = { id: "paper", beforeDraw: chart => {
  chart.ctx.fillStyle = style("--soft"); chart.ctx.fillRect(0, 0, chart.width, chart.height);
} };

class Panel {
  constructor(name, lines, several, axis, pick) {
    Object.assign(this, { name, all: lines, lines, several, axis, pick });
    this.figure = document.createElement("figure");
    this.figure.dataset.panel = name;
    this.caption = add(this.figure, "figcaption");
    this.title = add(this.caption, "b");
    const tools = add(this.caption, "span", undefined, "tools");
    const tool = (text, says, act) => { const b = add(tools, "button", text); b.title = says; b.ariaLabel = `${says}: ${plain(name)}`; b.onclick = act; };
    tool("⤢", "enlarge, or back", () => { this.figure.classList.toggle("large"); });
    for (const kind of ["csv", "svg", "png"]) tool(kind, `save as ${kind.toUpperCase()}`, () => save(`${plain(name)}.${kind}`, kind, this[kind]()));
    add(this.figure, "p", explained(plain(name), lines[0].run), "grey what");
    const frame = add(this.figure, "div", undefined, "frame");
    this.canvas = add(frame, "canvas");
    this.canvas.setAttribute("role", "img");
    this.cursor = add(frame, "span", undefined, "cursor");
    this.take(lines);
    this.observer = new IntersectionObserver(([entry]) => { if (entry.isIntersecting && !this.chart) this.drawCurves(); },
      { rootMargin: "200px" });
    this.observer.observe(this.figure);
    const to = e => { if (this.chart) pick(this.timeAt(this.chart.scales.x.getValueForPixel(e.offsetX) / this.xFactor)); };
    this.canvas.onpointerdown = to;
    this.canvas.onpointermove = e => { if (e.buttons) to(e); };
  }

  remove() { this.observer.disconnect(); this.chart?.destroy(); }

  take(lines) {
    this.lines = lines;
    const [low, high] = spread(lines.flatMap(l => spread(l.values))), xs = spread(lines.flatMap(l => spread(this.axis.of(l.run))));
    this.x = xs[1] > xs[0] ? xs : [xs[0], xs[0] + 1];
    [this.factor, this.unit] = scaled(Math.max(Math.abs(low), Math.abs(high)), unitOf(this.name));
    [this.xFactor, this.xUnit] = scaled(Math.max(...this.x.map(Math.abs)), this.axis.unit);
    const unit = this.unit && ` [${this.unit}]`;
    this.title.textContent = `${lines[0]?.place ? "Δ " : ""}${plain(this.name)}${unit}`;
    this.canvas.ariaLabel = `${this.title.textContent} over ${this.axis.name}: ${lines.map(l => {
      const [a, b] = spread(l.values);
      return `${this.label(l)} from ${quantity(a, unitOf(l.name))} to ${quantity(b, unitOf(l.name))}`;
    }).join("; ")}`;
  }

  differ(on) { this.take(on ? differences(this.all) : this.all); if (this.chart) this.drawCurves(); }

  // A magnitude beside its components is none of them; one with a sign says so.
  label({ r, part, values, name }) {
    const whole = !part && this.all.some(l => l.part) ? spread(values)[0] < 0 ? "with its sign" : "magnitude" : "";
    const alone = !part && !whole || this.all.filter(l => l.r === r).length === 1; // beside no other of its run
    return [this.several ? String(r + 1) : "", alone ? (this.several ? "" : plain(name)) : part || whole].filter(Boolean).join(" ");
  }

  // The first run's time at a place of the axis.
  timeAt(x) {
    if (this.axis.name === "time") return x;
    const { run } = this.lines[0], xs = this.axis.of(run);
    return run.t[xs.reduce((best, v, i) => Math.abs(v - x) < Math.abs(xs[best] - x) ? i : best, 0)];
  }

  drawCurves() {
    this.chart?.destroy();
    const ink = style("--ink"), grid = style("--line"), components = this.all.some(l => l.part), single = this.lines.length < 2;
    const datasets = this.lines.map(l => {
      // A magnitude beside components: black in one run, in the run's colour with dashes of its own in several.
      const whole = !l.part && components, axis = l.part ? PARTS[l.part] : whole && this.several ? DASHES.length - 1 : 0;
      const xs = this.axis.of(l.run), colour = whole && !this.several ? ink : line(this.several ? l.r : axis);
      const data = Array.from(l.values, (v, i) => ({ x: this.xFactor * xs[i], y: this.factor * v }));
      if (data.at(-1).x < data[0].x) data.reverse();
      return { data, label: this.label(l), borderColor: colour, backgroundColor: colour, borderDash: DASHES[axis], borderWidth: 1.5,
        pointRadius: l.values.length === 1 ? 2 : 0, pointHitRadius: 0 };
    });
    const [lowest, highest] = [Math.min, Math.max].map(most => datasets.reduce((v, d) => d.data.reduce((w, p) => most(w, p.y), v), 0));
    const axis = (title, more) => ({ grid: { color: grid, drawBorder: false }, ticks: { color: ink, maxRotation: 0, includeBounds: false, autoSkipPadding: 12, callback: number, ...more },
      title: { display: title !== "", text: title, color: ink, padding: 0 } });
    const one = behind(this.xUnit), y = behind(this.unit);
    this.chart = new Chart(this.canvas, { type: "line", data: { datasets }, plugins: [PAPER, { id: "cursor", afterDraw: () => this.draw(this.time) }], options: {
      animation: false, parsing: false, maintainAspectRatio: false, events: ["mousemove", "mouseout", "click", "touchstart", "touchmove"],
      interaction: { mode: "ofEach", intersect: false }, layout: { padding: { top: 6, right: 12 } },
      plugins: { legend: { display: !single, align: "end", labels: { color: ink, usePointStyle: true, pointStyle: "line", boxWidth: 22, padding: 6 } },
        tooltip: { callbacks: { title: items => `${this.axis.name} ${number(items[0].parsed.x)}${one}`,
          label: item => `${item.dataset.label} ${number(item.parsed.y)}${y}` } } },
      scales: { x: { type: "linear", min: this.xFactor * this.x[0], max: this.xFactor * this.x[1], ...axis(`${this.axis.name}${one && ` [${this.xUnit}]`}`) },
        // Rounding below zero takes no room.
        y: { ...(lowest < 0 && lowest > -1e-6 * highest ? { min: 0 } : {}), ...axis("", { maxTicksLimit: 6 }) } } } });
    this.draw(this.time);
  }

  draw(time) {
    this.time = time;
    if (!this.chart?.chartArea || !this.lines.length) return;
    const run = this.lines[0].run, x = this.axis.name === "time" ? time : at({ t: run.t, values: run.x }, Math.max(run.t[0], time));
    const { left, right, top, bottom } = this.chart.chartArea, place = this.chart.scales.x.getPixelForValue(this.xFactor * x);
    this.cursor.style.transform = `translateX(${Math.min(right, Math.max(left, place))}px)`;
    this.cursor.style.top = `${top}px`; this.cursor.style.height = `${bottom - top}px`;
  }

  csv() {
    const columns = [];
    for (const run of new Set(this.lines.map(l => l.run))) {
      const before = this.several ? `run ${this.lines.find(l => l.run === run).r + 1}: ` : "";
      columns.push([`${before}t[s]`, run.t]);
      if (this.axis.name !== "time") columns.push([`${before}${this.axis.name}[${this.axis.unit}]`, run.x]);
      for (const l of this.lines) if (l.run === run) columns.push([`${before}${l.place ? "change of " : ""}${l.name}`, l.values]);
    }
    const rows = Math.max(...columns.map(([, values]) => values.length));
    const row = i => columns.map(([, values]) => i < values.length ? String(Number(values[i].toPrecision(7))) : "").join(",");
    return [columns.map(([name]) => name).join(","), ...Array.from({ length: rows }, (_, i) => row(i)), ""].join("\n");
  }

  png() { if (!this.chart) this.drawCurves(); return this.chart.toBase64Image(); }

  // Chart.js draws on a canvas: its axes, ticks and points again as lines and words.
  svg() {
    if (!this.chart) this.drawCurves();
    const { width, height, chartArea: a, scales: { x, y } } = this.chart, ink = style("--ink"), grid = style("--line");
    const safe = text => String(text).replace(/[&<>"]/g, c => `&#${c.charCodeAt(0)};`), parts = [];
    const text = (at, up, words, anchor, colour) => parts.push(`<text x="${at}" y="${up}" text-anchor="${anchor}" fill="${colour}">${safe(words)}</text>`);
    const rule = (x1, y1, x2, y2) => parts.push(`<path d="M${x1} ${y1}L${x2} ${y2}" stroke="${grid}"/>`);
    x.ticks.forEach(({ value, label }) => { const at = x.getPixelForValue(value); rule(at, a.top, at, a.bottom); text(at, a.bottom + 16, label, "middle", ink); });
    y.ticks.forEach(({ value, label }) => { const at = y.getPixelForValue(value); rule(a.left, at, a.right, at); text(a.left - 6, at + 4, label, "end", ink); });
    text((a.left + a.right) / 2, height - 2, x.options.title.text, "middle", ink);
    this.chart.data.datasets.forEach((set, i) => {
      const points = this.chart.getDatasetMeta(i).data.filter(p => isFinite(p.y)).map(p => `${p.x.toFixed(2)},${p.y.toFixed(2)}`).join(" ");
      parts.push(`<polyline points="${points}" fill="none" stroke="${set.borderColor}" stroke-width="1.5" stroke-dasharray="${set.borderDash}"/>`);
      if (this.lines.length > 1) text(a.right, a.top + 14 * (i + 1), set.label, "end", set.borderColor);
    });
    text(a.left, 12, this.title.textContent, "start", ink);
    return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" font-family="sans-serif" font-size="11">${parts.join("")}</svg>`;
  }
}
